//! The keys of a scene.
//!
//! The comments here are the reference: they become the descriptions in the JSON Schema and in `docs/scene.md`. The range of a
//! number that a hairstyle checks stands with its description ([`frisure_hairstyle::number`]) and takes the place of `{}` in the
//! comment; every other range stands here, and is checked from here.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

use frisure_files::frame::UpAxis;
use frisure_hairstyle::{
    Body, Comb, Ellipticity, HairContact, HairModel, Hairs, HairstyleSpec, Handedness, HeadMethod,
    Level, Lift, Scalar, StrandContact, Turn,
};
use frisure_look::{Scattering, Setup, ToneCurve};
use frisure_rod::{ElementKind, Material, TorsionConstant};

use crate::choice::OneOf;
use crate::control::{
    ACCELERATION, CM, DEGREES, DENSITY, GPA, METRES_PER_SECOND, MM, NUMBER, PER_CM2, PERCENT,
    Panel, SPEED, STOPS, TIMES, TO_ONE, UM,
};
use crate::declaration::{Access, Declaration, field, number, table, value};
use crate::keywords::{
    BackdropKind, BranchKind, FlowWord, FrictionWord, HairType, Keyword, ModelWord, PartingPlace,
    Places, ShadeWord, UnitWord, WettingWord,
};
use crate::kind::{
    Angle, Colour, Count, Density, FaceSize, Flag, Gravity, Length, Modulus, NumberDensity, Pair,
    Point, Points, Ratio, Speed, Strain, Text, Vector, Velocity,
};
use crate::operation::{Steps, Where};
use crate::scene::Scene;

/// A degree (rad).
const DEG: f64 = PI / 180.0;

/// Declares keys: documentation, path, and the kind of value.
macro_rules! keys {
    ($($(#[doc = $doc:literal])+ $path:literal => $value:expr;)*) => {
        vec![$(Declaration::new($path, &[$($doc),+], $value)),*]
    };
}

/// All keys of a scene; a table is declared before its keys.
pub static KEYS: LazyLock<Vec<Declaration>> = LazyLock::new(|| {
    keys! {
        /// A name of the scene, for reports and file names.
        "name" => value::<Text>();
        /// Drives all randomness: the same scene and seed give the same bytes. Default 1.
        "seed" => value::<Count>();
        /// What the hair is: a type, and what differs from it.
        "hair" => table();
        /// The hair type to start from; every other key overrides it. Default "caucasian-straight".
        "hair.type" => value::<OneOf<HairType>>();
        /// Mean length along the fibre; {} on a head.
        "hair.length" => number::<Length>()
            .slider(Panel::Length, "Length", CM, (0.5, 150.0), 1, "Mean length along the hair, however curly.")
            .logarithmic();
        /// Standard deviation of the length between wisps, as a fraction; {}.
        "hair.length_variation" => number::<Ratio>()
            .slider(Panel::Length, "Length varies by", PERCENT, (0.0, 50.0), 0,
                "Standard deviation of the length from wisp to wisp.");
        /// Which shape of the type's section is taken, where `[hair.fibre]` gives none. Default
        /// "measured".
        "hair.ellipticity" => value::<OneOf<Keyword<Ellipticity>>>();
        /// How fast it grows; {}. Default the type's.
        "hair.growth_rate" => number::<Speed>()
            .slider(Panel::Length, "Growth", SPEED, (0.0, 5.0), 2, "How fast it grows when time passes.");
        /// What water makes of a fibre. Default "paper".
        "hair.wetting" => value::<OneOf<WettingWord>>()
            .options(Panel::Fibre, "Water", "What water makes of a fibre.");
        /// Section and material of a fibre. The section is said in one way: `diameter` or
        /// `mean_radius`, with `eccentricity` or `axis_ratio`; or both semi-axes.
        "hair.fibre" => table();
        /// Mean diameter 2 sqrt(ab); more than 0, between 5 um and 0.5 mm on a head.
        "hair.fibre.diameter" => number::<Length>().bounds(0.0, f64::INFINITY)
            .slider(Panel::Fibre, "Diameter", UM, (20.0, 200.0), 0,
                "Mean diameter of a hair. Twice the diameter is sixteen times as stiff and four times as heavy.")
            .shows(|scene| 2.0 * scene.spec.fibre.section.mean_radius());
        /// Mean radius sqrt(ab); more than 0.
        "hair.fibre.mean_radius" => number::<Length>().bounds(0.0, f64::INFINITY)
            .shows(|scene| scene.spec.fibre.section.mean_radius());
        /// Semi-axis along the director d1; more than 0. The fibre bends most easily about the longer.
        "hair.fibre.semi_axis_a" => number::<Length>().bounds(0.0, f64::INFINITY)
            .shows(|scene| scene.spec.fibre.section.a());
        /// Semi-axis along the director d2; more than 0.
        "hair.fibre.semi_axis_b" => number::<Length>().bounds(0.0, f64::INFINITY)
            .shows(|scene| scene.spec.fibre.section.b());
        /// sqrt(1 - b^2/a^2) at constant mean radius; 0 (a circle) to less than 1.
        "hair.fibre.eccentricity" => number::<Ratio>().bounds(0.0, 1.0)
            .shows(|scene| scene.spec.fibre.section.eccentricity());
        /// Longer over shorter axis, at constant mean radius; at least 1 (a circle).
        "hair.fibre.axis_ratio" => number::<Ratio>().bounds(1.0, f64::INFINITY)
            .slider(Panel::Fibre, "Ellipticity", TO_ONE, (1.0, 3.0), 2,
                "Longer over shorter axis of the section. A flat hair bends more easily about its longer axis.")
            .shows(|scene| scene.spec.fibre.section.axis_ratio());
        /// Young's modulus; more than 0, between 1 MPa and 1000 GPa on a head. Default 3.9 GPa.
        "hair.fibre.youngs_modulus" => number::<Modulus>().bounds(0.0, f64::INFINITY)
            .slider(Panel::Fibre, "Stiffness", GPA, (0.2, 20.0), 2,
                "Young's modulus: how hard it is to bend. Human hair has some 4 GPa when dry.")
            .logarithmic()
            .shows(|scene| scene.spec.fibre.material.youngs_modulus());
        /// Shear modulus; more than 0, between 0.1 MPa and 1000 GPa on a head. Default 0.9 GPa, also when Young's modulus is given.
        "hair.fibre.shear_modulus" => number::<Modulus>().bounds(0.0, f64::INFINITY)
            .slider(Panel::Fibre, "Torsional stiffness", GPA, (0.05, 8.0), 2, "Shear modulus: how hard it is to twist.")
            .logarithmic()
            .shows(|scene| scene.spec.fibre.material.shear_modulus());
        /// Poisson's ratio, instead of the shear modulus: it is E / 2(1 + nu) then; more than -1, at
        /// most 0.5.
        "hair.fibre.poisson_ratio" => number::<Ratio>().bounds(-1.0, 0.5)
            .shows(|scene| poissons_ratio(&scene.spec.fibre.material));
        /// Density; more than 0, between 0.01 and 20 g/cm^3 on a head. Default 1.3 g/cm^3.
        "hair.fibre.density" => number::<Density>().bounds(0.0, f64::INFINITY)
            .slider(Panel::Fibre, "Density", DENSITY, (0.5, 3.0), 2, "Mass per volume.")
            .shows(|scene| scene.spec.fibre.material.density());
        /// Standard deviation of the diameter between hairs, as a fraction of the mean; {}.
        "hair.fibre.variation" => number::<Ratio>()
            .slider(Panel::Fibre, "Diameter varies by", PERCENT, (0.0, 50.0), 0,
                "Standard deviation of the diameter from hair to hair.");
        /// Standard deviation between hairs of what the axis ratio exceeds 1 by, as a fraction of the
        /// mean; {}. A circle stays one.
        "hair.fibre.axis_ratio_variation" => number::<Ratio>();
        /// How much of these variations is found between guides, which stand for the mean hairs of their wisps: 0 for guides that
        /// are all alike, 1 for guides that differ as hairs do; {}. Default 0.25, chosen by eye.
        "hair.fibre.coherence" => number::<Ratio>();
        /// Which torsion constant the section is given. Default "saint-venant".
        "hair.fibre.torsion" => value::<OneOf<Keyword<TorsionConstant>>>();
        /// Natural curl, the shape without weight. It is said in one way: `radius` and `pitch`; or
        /// strains; or, for one hair, strains `along` it.
        "hair.curl" => table();
        /// Radius of the natural helix; more than 0, at most 100 m. The strain, 1/`radius` at most, may be 1e5 rad/m, on a head 20 000.
        "hair.curl.radius" => number::<Length>().bounds(0.0, 100.0)
            .slider(Panel::Curl, "Curl radius", MM, (0.5, 200.0), 1, "Radius of the curl that a hair would have without weight.")
            .logarithmic()
            .shows(|scene| helix(&scene.spec)[0]);
        /// Advance of the natural helix per turn, at most 100 m; negative turns it left-handed.
        "hair.curl.pitch" => number::<Length>().bounds(-100.0, 100.0)
            .slider(Panel::Curl, "Curl pitch", MM, (-500.0, 500.0), 1,
                "How far a curl advances in a turn, without weight. A negative pitch reverses the handedness.")
            .logarithmic()
            .shows(|scene| helix(&scene.spec)[1]);
        /// Natural curvature about d1. If a strain is given, those not given are 0.
        "hair.curl.kappa1" => number::<Strain>()
            .shows(|scene| scene.spec.curl.strain.x);
        /// Natural curvature about d2.
        "hair.curl.kappa2" => number::<Strain>()
            .shows(|scene| scene.spec.curl.strain.y);
        /// Natural twist.
        "hair.curl.tau" => number::<Strain>()
            .shows(|scene| scene.spec.curl.strain.z);
        /// Natural strains at increasing distances from the root, linear between them and constant
        /// outside; for `frisure hair` only. At most 10000.
        "hair.curl.along[]" => table();
        /// Distance from the root along the hair; default 0.
        "hair.curl.along[].s" => number::<Length>();
        /// Natural curvature about d1; default 0.
        "hair.curl.along[].kappa1" => number::<Strain>();
        /// Natural curvature about d2; default 0.
        "hair.curl.along[].kappa2" => number::<Strain>();
        /// Natural twist; default 0.
        "hair.curl.along[].tau" => number::<Strain>();
        /// Which way curls turn on a head. Default "random".
        "hair.curl.handedness" => value::<OneOf<Keyword<Handedness>>>();
        /// Standard deviation of the strain between wisps, as a fraction; {}.
        "hair.curl.variation_between" => number::<Ratio>()
            .slider(Panel::Curl, "Varies between wisps by", PERCENT, (0.0, 100.0), 0,
                "Standard deviation of the curl from wisp to wisp.");
        /// Standard deviation of the strain along a hair, as a fraction; {}.
        "hair.curl.variation_along" => number::<Ratio>()
            .slider(Panel::Curl, "Varies along a hair by", PERCENT, (0.0, 100.0), 0,
                "Standard deviation of the curl along a hair: much of it is frizz.");
        /// Correlation length of the variation along a hair; 1 mm to 1 m.
        "hair.curl.variation_scale" => number::<Length>()
            .slider(Panel::Curl, "… over a distance of", CM, (0.1, 20.0), 1, "Distance along a hair over which its curl changes.");
        /// The material frame in which the hair of `frisure hair` is clamped (heads have their scalp):
        /// two of three unit vectors at right angles, d1 x d2 = t, or all. By default the hair leaves
        /// horizontally: t along +x, d1 along +y, d2 along +z.
        "hair.root" => table();
        /// First principal axis of the section.
        "hair.root.d1" => value::<Vector>();
        /// Second principal axis of the section.
        "hair.root.d2" => value::<Vector>();
        /// Tangent, out of the scalp.
        "hair.root.t" => value::<Vector>();
        /// The head that hair grows on; left out, the built-in mannequin.
        "head" => table();
        /// A built-in head. Default "mannequin".
        "head.model" => value::<OneOf<ModelWord>>();
        /// Seed of the face of a built-in person: nose, mouth, chin, cheeks, eyes and brows differ from those of the model by chance, and
        /// another number gives another face. Scalp and ears stay. Default 0, the face of the model.
        "head.face" => number::<Count>().range(0.0, 1e6, "between 0 and 1000000");
        /// Path of a mesh (OBJ, USD, glTF or PLY), relative to the scene. Left out, a built-in head.
        "head.mesh" => value::<Text>();
        /// Unit of the mesh. Default: the unit that the file or its format states. OBJ and PLY state none: "m", or a guess from
        /// the size of the mesh.
        "head.unit" => value::<OneOf<UnitWord>>()
            .options(Panel::Files, "Unit of the head", "What the mesh is in.");
        /// Which axis of the mesh points up; the face looks along +z or -y then. Default: the axis that the file or its format states, mostly
        /// "y".
        "head.up" => value::<OneOf<Keyword<UpAxis>>>()
            .options(Panel::Files, "Up in the head", "The axis of the mesh that points up.");
        /// Metres per unit of the mesh, instead of `unit`; more than 0.
        "head.scale" => number::<Ratio>().bounds(0.0, f64::INFINITY);
        /// Turns of the mesh about the axes x (to the head's left), y (backwards) and z (up), one after the other, in degrees, so that it
        /// stands upright with its face towards -y. Left out, the mesh is as its file has it, and a head that lies is refused.
        "head.turn" => value::<Vector>();
        /// Group of faces on which hair grows, or the material that they have. Without scalp keys, the scalp is guessed.
        "head.scalp_group" => value::<Text>();
        /// What is painted on the mesh's vertices where hair grows: "red", "green", "blue", "alpha" or "brightness" of their
        /// colours, or the name of another attribute with numbers from 0 to 1.
        "head.scalp_colour" => value::<Text>();
        /// Path of a PNG over the mesh's texture coordinates, white where hair grows.
        "head.scalp_mask" => value::<Text>();
        /// Path of a text file with one density from 0 to 1 per vertex, in the order of the mesh.
        "head.scalp_weights" => value::<Text>();
        /// Hair from another program instead of predicted hair. The guides of the groom, or its strands if it has none, become guides
        /// with the fibre of `[hair]`; frisure computes the natural curl with which they hang in the shape of the groom. Steps apply to
        /// them. The other strands follow the guides. Length and curl of `[hair]` have no effect then.
        "groom" => table();
        /// Path of the groom, relative to the scene: .hair, .obj, .ply, .usd, .abc, .data or .npz. It is rooted on the head of `[head]`.
        "groom.file" => value::<Text>();
        /// The built-in head that the groom was made on, if that is another than the head of `[head]`: its roots go to the places that
        /// correspond by landmarks, each guide keeps its length and its natural curl, and comes to rest on the head of `[head]`.
        "groom.head_model" => value::<OneOf<ModelWord>>();
        /// Path of the mesh that the groom was made on, relative to the scene, instead of a built-in head. Its unit and axes are those
        /// that the file or its format states.
        "groom.head_mesh" => value::<Text>();
        /// Unit of the groom. Default that of the file or format.
        "groom.unit" => value::<OneOf<UnitWord>>()
            .options(Panel::Files, "Unit of the groom", "What the groom is in.");
        /// Which axis of the groom points up; the face looks along +z or -y then. Default that of the file or format.
        "groom.up" => value::<OneOf<Keyword<UpAxis>>>()
            .options(Panel::Files, "Up in the groom", "The axis of the groom that points up.");
        /// Factor on all lengths of the groom, after its unit; {}. Default 1.
        "groom.scale" => number::<Ratio>().range(1e-6, 1e6, "between 1e-6 and 1e6");
        /// Turns of the groom about the axes x, y and z of the head, one after the other, in degrees. Default none.
        "groom.turn" => value::<Vector>();
        /// Displacement of the groom after scale and turns, in the frame of the head: x to its left, y backwards, z up. Default none.
        "groom.move" => value::<Point>();
        /// How many of its strands become guides at most, evenly chosen; these carry the others. {}. Default 300.
        "groom.guides" => number::<Count>().range(1.0, 100_000.0, "between 1 and 100000");
        /// How hair leaves the scalp.
        "implantation" => table();
        /// The direction along the scalp. Default "parted".
        "implantation.flow" => value::<OneOf<FlowWord>>()
            .options(Panel::Implantation, "Flow", "The direction in which hair leaves the scalp.");
        /// Where the parting is: a word, or its distance from the middle at the hairline, positive to
        /// the head's left; within 6 cm. Default 2 cm.
        "implantation.parting" => value::<PartingPlace>()
            .options(Panel::Implantation, "Parting", "Where hair parts.");
        /// Several partings, or ones drawn through points, instead of `parting`; at most 32.
        "implantation.partings[]" => table();
        /// Where a straight one is, as `parting` says it.
        "implantation.partings[].at" => value::<PartingPlace>();
        /// Points that it goes smoothly through, each as distances on the skin: across, from the middle
        /// to the head's left, and back, behind the forehead's hairline.
        "implantation.partings[].line" => value::<Points>();
        /// Whorls at the crown about which hair turns that lies as it grows (`flow = "whorl"`; combed hair has none): 1, or 2 as about 5 % of
        /// people have them. Default 1.
        "implantation.whorls" => number::<Count>();
        /// Distance of the whorl from its usual place, to the head's left and back; within 5 cm. For `flow = "whorl"`.
        "implantation.whorl_offset" => value::<Pair>();
        /// Which way hair turns about the whorl, seen from outside; of two, the right one. For `flow = "whorl"`. Default
        /// "clockwise", as in most people.
        "implantation.whorl_turn" => value::<OneOf<Keyword<Turn>>>();
        /// Angle to the skin, the same everywhere; {}.
        "implantation.lift" => number::<Angle>();
        /// Instead of `lift`: factor on the angles measured by region; {}. No combed hair is steeper than 70 degrees by it.
        "implantation.lift_scale" => number::<Ratio>()
            .slider(Panel::Implantation, "Lift", TIMES, (0.0, 4.0), 2,
                "Factor on the angle at which hair leaves the skin, as measured by region.")
            .shows(lift_scale);
        /// Standard deviation of the direction between wisps; 0 to 1 rad.
        "implantation.jitter" => number::<Angle>()
            .slider(Panel::Implantation, "Disorder", DEGREES, (0.0, 57.0), 0,
                "Standard deviation of the direction in which neighbouring wisps leave the scalp.");
        /// Force per length, in weights of the hair, with which friction on the hair beneath holds combed hair out of the face and on its
        /// side of a parting, where it is not as it grows (`flow = "whorl"`); {}. Default 1.2.
        "implantation.hold" => number::<Ratio>()
            .slider(Panel::Implantation, "Hold", TIMES, (0.0, 3.0), 2,
                "How well combed hair stays out of the face, in weights of the hair.");
        /// The edge of the hair, against the usual line. A scalp that comes with a mesh keeps its own.
        "implantation.hairline" => table();
        /// Standard deviation from a smooth line; {}. Default 1.5 mm.
        "implantation.hairline.irregularity" => number::<Length>();
        /// How much higher it is over the forehead; {}. Default 0, on the built-in women -4 mm.
        "implantation.hairline.height" => number::<Length>()
            .slider(Panel::Implantation, "Hairline", CM, (-3.0, 5.0), 1,
                "How much higher than usual the hair begins over the forehead.");
        /// How far it recedes at the temples; {}. Default 3 mm, on the built-in women 0.
        "implantation.hairline.recession" => number::<Length>()
            .slider(Panel::Implantation, "Receding temples", CM, (0.0, 4.0), 1, "How far the hairline recedes at the temples.");
        /// How far it comes forward to a point in the middle; {}. Default 0.
        "implantation.hairline.widows_peak" => number::<Length>()
            .slider(Panel::Implantation, "Widow's peak", CM, (0.0, 3.0), 1, "How far the hairline comes forward in the middle.");
        /// How much higher sideburns end than usual, which is beside the middle of the ear; {}. Default 0, on the built-in women 1 cm.
        "implantation.hairline.sideburns" => number::<Length>()
            .slider(Panel::Implantation, "Sideburns", CM, (0.0, 2.5), 1, "How much higher than usual the hair before the ears ends.");
        /// How much higher the hair ends at the nape than usual; {}. Default 0.
        "implantation.hairline.nape" => number::<Length>()
            .slider(Panel::Implantation, "Nape", CM, (0.0, 3.0), 1, "How much higher than usual the hair ends at the nape.");
        /// Fraction of the hairs within 1.5 cm of the edge that stay short and thin, more of those nearer to it: from 0.5 on
        /// all at the edge, with 1 three quarters; {}. Default 0.25.
        "implantation.baby_hairs" => number::<Ratio>()
            .slider(Panel::Implantation, "Baby hairs", PERCENT, (0.0, 100.0), 0, "Share of short thin hairs along the edge.");
        /// Acceleration of gravity; {}. Default 9.81 m/s^2. Or the acceleration as a vector in the frame of the head, such as
        /// [0, 0, -9.81], in place of `pose`.
        "gravity" => number::<Gravity>()
            .slider(Panel::Surroundings, "Gravity", ACCELERATION, (0.0, 30.0), 2, "9.81 on Earth, 1.62 on the Moon.");
        /// How the head is held. Gravity turns in the frame of the head, which stays as it is: x to its left, y back, z up. Left
        /// out, the head is upright.
        "pose" => table();
        /// How far the head nods, the face down; negative is back. {}. Default 0.
        "pose.pitch" => number::<Angle>()
            .slider(Panel::Surroundings, "Nod", DEGREES, (-180.0, 180.0), 0, "How far the head is bent forward; negative is back. At -90 it lies on its back.");
        /// How far the head leans to its left, before it nods; {}. Default 0.
        "pose.roll" => number::<Angle>()
            .slider(Panel::Surroundings, "Lean", DEGREES, (-180.0, 180.0), 0, "How far the head leans to its left.");
        /// Instead of these: the direction in which gravity pulls in the frame of the head, of any length, such as [0, 1, 0] for a head
        /// on its back.
        "pose.down" => value::<Vector>();
        /// A steady wind. Its force is the same on every length of hair, whatever its direction.
        "wind" => table();
        /// Speed far from the head; {}. Default 0.
        "wind.speed" => number::<Velocity>()
            .slider(Panel::Surroundings, "Wind", METRES_PER_SECOND, (0.0, 20.0), 1, "Speed of a steady wind.");
        /// Where it comes from: 0 from before the face, 90 deg from the head's left; {}. Default 0.
        "wind.azimuth" => number::<Angle>()
            .slider(Panel::Surroundings, "Wind from", DEGREES, (-180.0, 180.0), 0, "Where the wind comes from: 0 from before the face, 90 from the head's left.");
        /// How far above the level of the head it comes from; {}. Default 0.
        "wind.elevation" => number::<Angle>();
        /// Part of the drag of a single hair in the open that acts on each hair; the other hairs shelter it. {}. Default 0.01, an estimate
        /// for a head; 1 is for one hair in the open.
        "wind.exposure" => number::<Ratio>();
        /// What parts of the scalp have that the rest has not; later ones override earlier ones. At most 1000.
        "region[]" => table();
        /// Which part of the scalp, or a list of at most 100 parts.
        "region[].where" => value::<Places>();
        /// Length along the fibre; {}. It changes at once at the region's border, as cut.
        "region[].length" => number::<Length>();
        /// Instead of `length`: as long as it takes to reach down to here, cut to a line.
        "region[].down_to" => value::<OneOf<Keyword<Level>>>();
        /// Direction along the skin.
        "region[].comb" => value::<OneOf<Keyword<Comb>>>();
        /// Angle to the skin; {}.
        "region[].lift" => number::<Angle>();
        /// Factor on the natural curl; {}.
        "region[].curl" => number::<Ratio>();
        /// Parts of the hair that the salon works on one after the other, as layers of a picture: shown or not, locked or not. They
        /// change neither hair nor pictures. At most 200.
        "section[]" => table();
        /// Its name; no other section has it.
        "section[].name" => value::<Text>();
        /// Which wisps, as in a step.
        "section[].where" => value::<Where>();
        /// Whether the salon does not show it. Default false.
        "section[].hidden" => value::<Flag>();
        /// Whether steps that are made in the salon leave it as it is. Default false.
        "section[].locked" => value::<Flag>();
        /// Guides and the drawn hairs around them.
        "wisps" => table();
        /// Number of wisps, each with one computed guide; {}.
        "wisps.count" => number::<Count>()
            .slider(Panel::Wisps, "Wisps", NUMBER, (20.0, 1500.0), 0,
                "Number of wisps, each with one computed guide. The other hairs follow the guides.")
            .logarithmic();
        /// Drawn hairs per area of scalp, instead of `hairs`; {}. Default that of the hair
        /// type.
        "wisps.density" => number::<NumberDensity>()
            .slider(Panel::Wisps, "Hairs", PER_CM2, (5.0, 400.0), 0,
                "Hairs drawn for each square centimetre of scalp; some 200 grow there.")
            .shows(drawn_density);
        /// Number of drawn hairs on the whole head; {}. Default by `density`.
        "wisps.hairs" => number::<Count>();
        /// Mean number of drawn hairs around each guide, instead of `hairs`; {}.
        "wisps.hairs_per_wisp" => number::<Count>();
        /// How much a wisp gathers to its tip: 0 (as wide as at the scalp) to 1 (as thick as its hairs
        /// need).
        "wisps.clumping" => number::<Ratio>()
            .slider(Panel::Wisps, "Clumping", PERCENT, (0.0, 100.0), 0, "How far the hairs of a wisp gather.");
        /// Further factors on the width of a wisp at root, middle and tip; each 0 to 10. Default
        /// [1, 1, 1].
        "wisps.profile" => value::<Vector>();
        /// Number of thinner wisps that each wisp splits into, in the mean; {}, 1 for none.
        "wisps.splits" => number::<Count>()
            .slider(Panel::Wisps, "Splits", NUMBER, (1.0, 20.0), 0, "Thinner wisps into which each wisp parts.");
        /// Standard deviation of the logarithm of the width of splits; {}.
        "wisps.split_variation" => number::<Ratio>()
            .slider(Panel::Wisps, "Split sizes", PERCENT, (0.0, 100.0), 0, "How much splits differ in width.");
        /// How far hairs gather to the middle of their split at the tip; {}.
        "wisps.split_clumping" => number::<Ratio>()
            .slider(Panel::Wisps, "Split clumping", PERCENT, (0.0, 100.0), 0, "How far the hairs of a split gather.");
        /// Number of still thinner wisps in each split; {}, 1 for none.
        "wisps.subsplits" => number::<Count>()
            .slider(Panel::Wisps, "Subsplits", NUMBER, (1.0, 20.0), 0, "Still thinner wisps into which each split parts.");
        /// How far the curls of splits are out of step with their guide; {}, 1 for any phase.
        "wisps.split_phase" => number::<Ratio>()
            .slider(Panel::Wisps, "Split phase", PERCENT, (0.0, 100.0), 0, "How far the curls of splits are out of step.");
        /// How far the curls of hairs are out of step with their split; {}.
        "wisps.hair_phase" => number::<Ratio>()
            .slider(Panel::Wisps, "Hair phase", PERCENT, (0.0, 100.0), 0, "How far the curls of single hairs are out of step.");
        /// Standard deviation of the radius of curls between splits and between hairs, as a fraction; {}.
        "wisps.radius_variation" => number::<Ratio>()
            .slider(Panel::Wisps, "Curl widths", PERCENT, (0.0, 50.0), 0, "How much curls differ in width.");
        /// How far hairs stray from their place, as a fraction of the wisp's radius, and from its curl,
        /// as a fraction of the variation between wisps, which makes wisps thicker; {}.
        "wisps.fuzziness" => number::<Ratio>()
            .slider(Panel::Wisps, "Fuzziness", TIMES, (0.0, 2.0), 2, "How far hairs stray from their wisp.");
        /// Standard deviation of the length within a wisp, as a fraction; {}.
        "wisps.length_variation" => number::<Ratio>();
        /// Fraction of hairs that leave their wisp; {}.
        "wisps.flyaways" => number::<Ratio>()
            .slider(Panel::Wisps, "Flyaways", PERCENT, (0.0, 20.0), 1, "Share of the hairs that stand off.");
        /// Fraction of hairs that have not grown to the length of the others yet; {}.
        "wisps.growing" => number::<Ratio>()
            .slider(Panel::Wisps, "Growing hairs", PERCENT, (0.0, 50.0), 0, "Share of the hairs that are still growing.");
        /// How far neighbouring wisps blend: 0 (distinct) to 1 (a smooth mass).
        "wisps.blending" => number::<Ratio>()
            .slider(Panel::Wisps, "Blending", PERCENT, (0.0, 100.0), 0,
                "How far hairs follow the neighbouring wisps, too: straight hair is a smooth mass.");
        /// Points along each drawn hair; {}.
        "wisps.points" => number::<Count>();
        /// What drawn hairs are. Default "interpolated".
        "wisps.strands" => value::<OneOf<Keyword<HairModel>>>();
        /// How simulated hairs touch each other; only with `strands = "simulated"`. Friction is that of `contact.friction`. Where fewer
        /// hairs are drawn than grow, each is as thick as those that it stands for. Default "tube".
        "wisps.contact" => value::<OneOf<Keyword<StrandContact>>>();
        /// Contact of hair with the head and with hair.
        "contact" => table();
        /// Model of the head in contact. Default "signed-distance".
        "contact.body" => value::<OneOf<Keyword<Body>>>();
        /// Model of the contact between wisps. Default "density", and "layers" for tight coils; choose "wisps" where hair is tied or is to stick to other hair.
        "contact.hair" => value::<OneOf<Keyword<HairContact>>>();
        /// Stiffness of skin per length of hair; {}. Default 2000 Pa.
        "contact.stiffness" => number::<Modulus>();
        /// Stiffness of hair per length of hair; {}. Default 0.5 Pa.
        "contact.hair_stiffness" => number::<Modulus>();
        /// Factor on the thickness of wisps, which follows from their hairs; {}. Default 1.
        "contact.volume" => number::<Ratio>()
            .slider(Panel::Wisps, "Volume", TIMES, (0.0, 4.0), 2, "Factor on how much room wisps take from each other.");
        /// Where the coefficients of friction come from that are not given. Default "free".
        "contact.coefficients" => value::<OneOf<FrictionWord>>()
            .options(Panel::Wisps, "Friction of", "Whether hair that was combed holds as hair of this type does.");
        /// Coefficient of friction of dry hair against hair along its scales, which holds what was combed, as a density on the bed beneath alone; {}.
        /// Default by `coefficients`, 0 without: hair slides freely.
        "contact.friction" => number::<Ratio>()
            .slider(Panel::Wisps, "Friction", PERCENT, (0.0, 100.0), 0, "How well hair holds on hair after it was combed.");
        /// The same against skin; {}. Default by `coefficients`, 0 without.
        "contact.skin_friction" => number::<Ratio>();
        /// Friction of wet hair over that of dry hair; {}. Default 1.3.
        "contact.wet_friction" => number::<Ratio>();
        /// Friction of hair that goes towards its tip, against its scales, over that towards its root; {}. Default 1.4.
        "contact.scales" => number::<Ratio>();
        /// Coefficient of friction between the hairs of a wisp: they stick and slip as it bends, so that it keeps part of a bend, more with a
        /// product; {}. Default 0: hairs of a wisp slide freely.
        "contact.lock_friction" => number::<Ratio>();
        /// How the equilibrium of each guide is computed.
        "equilibrium" => table();
        /// Number of elements per hair; 1 to 10000, at most 1000 on a head.
        "equilibrium.elements" => number::<Count>().bounds(1.0, 10_000.0);
        /// Instead of `elements`: as many as it takes to be this near to the exact shape; {}.
        /// Default 0.5 mm.
        "equilibrium.accuracy" => number::<Length>().range(f64::MIN_POSITIVE, 1.0, "greater than zero, at most 1 m");
        /// Largest gradient of a guide, relative to the moment of its weight, at which wisps in contact count as at rest;
        /// {}. Default 0.03, a tenth of what friction between hairs would hold.
        "equilibrium.tolerance" => number::<Ratio>();
        /// How wisps that make way for each other come to rest; for `contact.hair = "wisps"`. Default "sweeps".
        "equilibrium.method" => value::<OneOf<Keyword<HeadMethod>>>();
        /// The curve that an element can take. Default "auto".
        "equilibrium.element" => value::<OneOf<Keyword<ElementKind>>>();
        /// Which equilibrium, where there are several; for `frisure hair`. Default "gravity".
        "equilibrium.branch" => value::<OneOf<BranchKind>>();
        /// Number of starting shapes that `branch = "lowest"` tries; {}. Default 16.
        "equilibrium.starts" => number::<Count>().range(1.0, 1000.0, "between 1 and 1000");
        /// What is done to the hair, in this order; each step has exactly one of these keys.
        "step" => value::<Steps>();
        /// Colours.
        "look" => table();
        /// Colour of natural hair, by its name; the keys below override its numbers. Default: that of
        /// the hair type.
        "look.colour" => value::<OneOf<ShadeWord>>()
            .options(Panel::Look, "Colour", "Natural colours by name.");
        /// Concentration of the brown pigment: about 0.1 blond, 0.8 brown, 3 black; {}.
        "look.eumelanin" => number::<Ratio>().range(0.0, 100.0, "between 0 and 100")
            .field(field!(look.hair.melanin.eumelanin))
            .slider(Panel::Look, "Eumelanin", NUMBER, (0.0, 10.0), 2,
                "The brown pigment: about 0.1 in blond hair, 0.8 in brown, 3 in black.");
        /// Concentration of the red pigment; {}.
        "look.pheomelanin" => number::<Ratio>().range(0.0, 100.0, "between 0 and 100")
            .field(field!(look.hair.melanin.pheomelanin))
            .slider(Panel::Look, "Pheomelanin", NUMBER, (0.0, 5.0), 2, "The red pigment.");
        /// Instead of pigments: the colour (sRGB) that much of this hair has, as measured.
        "look.reflectance" => value::<Colour>();
        /// Instead of pigments: absorption of red, green and blue light per radius of the fibre; each 0
        /// to 1000.
        "look.absorption" => value::<Vector>();
        /// Fraction of the hairs that have no pigment: grey hair; {}. Default that of the colour.
        "look.white_share" => number::<Ratio>().range(0.0, 1.0, "between 0 and 1")
            .field(field!(look.hair.white_share))
            .slider(Panel::Look, "White hairs", PERCENT, (0.0, 100.0), 0, "Share of the hairs that have no pigment.");
        /// Relative variation of the pigment from hair to hair; {}. Default 0.18.
        "look.variation" => number::<Ratio>().range(0.0, 1.0, "between 0 and 1")
            .field(field!(look.hair.variation));
        /// Pigment at the roots.
        "look.roots" => table();
        /// Factor on the pigment at this end; {}. Default 1.
        "look.roots.pigment" => number::<Ratio>().range(0.0, 10.0, "between 0 and 10");
        /// Distance from the end over which this fades away; {}. Default 5 cm.
        "look.roots.fade" => number::<Length>().range(0.0, 3.0, "between 0 and 3 m");
        /// Pigment at the tips, which the sun bleaches.
        "look.tips" => table();
        /// Factor on the pigment at this end; {}. Default 1.
        "look.tips.pigment" => number::<Ratio>().range(0.0, 10.0, "between 0 and 10");
        /// Distance from the end over which this fades away; {}. Default 5 cm.
        "look.tips.fade" => number::<Length>().range(0.0, 3.0, "between 0 and 3 m");
        /// Hair coloured on purpose.
        "look.dye" => table();
        /// Colour (sRGB) that much hair has with this dye.
        "look.dye.colour" => value::<Colour>();
        /// How much of the natural colour it takes the place of; {}. Default 1.
        "look.dye.strength" => number::<Ratio>().range(0.0, 1.0, "between 0 and 1");
        /// Length at the roots that has grown since, without dye; {}. Default 0.
        "look.dye.regrowth" => number::<Length>().range(0.0, 3.0, "between 0 and 3 m");
        /// Roughness along the fibre: 0.1 has narrow highlights, 0.5 is matt; {}. Default 0.25.
        "look.roughness" => number::<Ratio>().range(0.05, 1.0, "between 0.05 and 1")
            .field(field!(look.hair.surface.longitudinal_roughness))
            .slider(Panel::Look, "Roughness", NUMBER, (0.05, 1.0), 2, "How wide the highlights are: 0.1 is glossy, 0.5 is matt.");
        /// Roughness around the fibre; {}. Default 0.4.
        "look.roughness_around" => number::<Ratio>().range(0.05, 1.0, "between 0.05 and 1")
            .field(field!(look.hair.surface.azimuthal_roughness));
        /// Tilt of the cuticle's scales, which moves the highlights apart; {}. Default 3 deg.
        "look.tilt" => number::<Angle>().range(-20.0 * DEG, 20.0 * DEG, "between -20 and 20 deg")
            .field(field!(look.hair.surface.tilt));
        /// Refractive index of the fibre; {}. Default 1.55.
        "look.index" => number::<Ratio>().range(1.05, 3.0, "between 1.05 and 3")
            .field(field!(look.hair.surface.index));
        /// How a fibre scatters light, for final pictures. Default "chiang".
        "look.scattering" => value::<OneOf<Keyword<Scattering>>>();
        /// Colour of the skin (sRGB). Default: that of the hair type.
        "look.skin" => value::<Colour>();
        /// How far light goes beneath the skin, for final pictures: the diffuse mean free path of red light; {}. Default 3.7 mm; 0
        /// for none.
        "look.scatter" => number::<Length>().range(0.0, 0.02, "between 0 and 20 mm")
            .field(field!(look.skin.scatter));
        /// Strength of the skin's soft gloss; {}. Default 0.12.
        "look.gloss" => number::<Ratio>().range(0.0, 1.0, "between 0 and 1")
            .field(field!(look.skin.gloss));
        /// Strength of the fine structure of skin, lips and cloth (relief, blotches, freckles, threads), relief in final pictures only; {}. Default 1; 0 for
        /// smooth surfaces.
        "look.texture" => number::<Ratio>().range(0.0, 3.0, "between 0 and 3")
            .field(field!(look.skin.texture))
            .slider(Panel::Look, "Skin texture", NUMBER, (0.0, 3.0), 2, "How much pores, blotches and freckles are seen.");
        /// Colour of the irises (sRGB) of a head with open eyes. Default: that of the hair type.
        "look.iris" => value::<Colour>();
        /// Colour of the garment (sRGB) of a head that wears one. Default a dark grey.
        "look.garment" => value::<Colour>();
        /// What is behind the head. Default "surroundings" where sky or an environment light it, else "wall".
        "look.background" => value::<BackdropKind>()
            .options(Panel::Look, "Background", "What is behind the head.");
        /// Colour of a floor under the head (sRGB), which catches its shadow in a final picture. Left out,
        /// there is none.
        "look.floor" => value::<Colour>();
        /// Where the picture is taken from. All of the hair and the head is always in it, though not
        /// the shoulders.
        "camera" => table();
        /// Around the head: 0 faces it, 90 deg sees its left side, -90 deg its right; {}. Default 30 deg.
        "camera.azimuth" => number::<Angle>().range(-20.0 * PI, 20.0 * PI, "at most ten turns")
            .field(field!(camera.azimuth));
        /// Above the horizon; {}. Default 5 deg.
        "camera.elevation" => number::<Angle>().range(-85.0 * DEG, 85.0 * DEG, "between -85 and 85 deg")
            .field(field!(camera.elevation));
        /// Angle from the picture's bottom to its top; {}. Default 24 deg, a portrait lens.
        "camera.field_of_view" => number::<Angle>().range(DEG, 120.0 * DEG, "between 1 and 120 deg")
            .field(field!(camera.field_of_view));
        /// How far the lens is closed, in a final picture: at 2.8 what is out of its focus is blurred as in a
        /// portrait; {}. Left out, everything is sharp.
        "camera.f_number" => number::<Ratio>().range(0.5, 64.0, "between 0.5 and 64");
        /// Distance from the camera that is sharp, with `f_number`; {}. Default what is nearest in
        /// the middle of the picture.
        "camera.focus" => number::<Length>().range(0.01, 1000.0, "between 1 cm and 1 km");
        /// What lights the head: a setup whose lamps turn with the camera, or sky or surroundings that
        /// stay, and further lamps. With `azimuth` or `elevation` the main lamp stands elsewhere.
        "light" => table();
        /// How the lights are set. Default "studio"; with an `environment` "dark", with a sun "daylight".
        "light.setup" => value::<OneOf<Keyword<Setup>>>()
            .options(Panel::Look, "Light", "How the head is lit, as photographers set it.");
        /// Where the main lamp stands: to the right of the camera, seen from the head; negative is to
        /// its left. {}.
        "light.azimuth" => number::<Angle>().range(-PI, PI, "between -180 and 180 deg");
        /// How far the main lamp stands above the horizon; {}.
        "light.elevation" => number::<Angle>().range(-FRAC_PI_2, FRAC_PI_2, "between -90 and 90 deg");
        /// How large the main lamp is, as the angle from edge to edge under which the head sees it: a larger
        /// one is softer. {}; the studio's is 23 deg, the sun 0.5 deg.
        "light.size" => number::<Angle>().range(0.0, 170.0 * DEG + 1e-9, "between 0 and 170 deg");
        /// Factor on the strength of all lamps, of which an overcast day has none (`sky_strength`); {}. Default 1.
        "light.strength" => number::<Ratio>().range(0.0, 100.0, "between 0 and 100")
            .field(field!(light.strength))
            .slider(Panel::Look, "Lamps", TIMES, (0.0, 4.0), 2, "Factor on the strength of all lamps.");
        /// Factor on the light that comes from all around: of the room, the sky or the environment; {}. Default 1.
        "light.sky_strength" => number::<Ratio>().range(0.0, 1000.0, "between 0 and 1000")
            .field(field!(light.sky_strength))
            .slider(Panel::Look, "Sky", TIMES, (0.0, 4.0), 2, "Factor on the light that comes from all around.");
        /// An equirectangular picture of surroundings with all of their light, `.hdr` or `.exr`, linear sRGB.
        "light.environment" => value::<Text>();
        /// How far the environment is turned towards the head's left. Its middle is before the face at 0,
        /// the default.
        "light.rotation" => number::<Angle>().field(field!(light.environment_rotation));
        /// Where the sun of `setup = "daylight"` stands around the head: 0 before the face, 90 deg at its
        /// left. It stays there when the camera moves. Default 50 deg.
        "light.sun_azimuth" => number::<Angle>().range(-2.0 * PI, 2.0 * PI, "a turn at most");
        /// How far the sun stands above the horizon; {}. Default 40 deg.
        "light.sun_elevation" => number::<Angle>().range(0.0, FRAC_PI_2, "between 0 and 90 deg");
        /// Haze of the daylight: 2 after rain, 3 clear, 6 hazy, 10 dull; {}. Default 3.
        "light.turbidity" => number::<Ratio>().range(1.9, 10.0, "between 1.9 and 10");
        /// Further lamps, at most 100. Each is far away, or at a place with `distance` or `position`. One of `azimuth`, `elevation`, `distance`
        /// and `position` is needed.
        "light.lamp[]" => table();
        /// Where it stands: to the right of the camera, seen from the head; negative is to its left. {}.
        /// Default 0.
        "light.lamp[].azimuth" => number::<Angle>().range(-PI, PI, "between -180 and 180 deg");
        /// How far it stands above the horizon; {}. Default 0.
        "light.lamp[].elevation" => number::<Angle>().range(-FRAC_PI_2, FRAC_PI_2, "between -90 and 90 deg");
        /// How far from the middle of the head; {}. Left out, it is very far away.
        "light.lamp[].distance" => number::<Length>().range(0.01, 1000.0, "between 1 cm and 1 km");
        /// Instead of these: its place, with x to the head's left, y back, z up; within 1 km.
        "light.lamp[].position" => value::<Point>();
        /// Angle from edge to edge of a lamp that is very far away; {}. Default 34 deg, as a softbox of 1.2 m has at two metres.
        "light.lamp[].angle" => number::<Angle>().range(0.0, 170.0 * DEG + 1e-9, "between 0 and 170 deg");
        /// Size of a lamp that is not: diameter of a disc, or width and height of a rectangle, facing the
        /// head; 1 mm to 100 m. Left out, it shines from a point to all sides.
        "light.lamp[].size" => value::<FaceSize>();
        /// Its brightness in the middle of the head, against the studio's main lamp; {}. Default 1.
        "light.lamp[].strength" => number::<Ratio>().range(0.0, 100.0, "between 0 and 100");
        /// Its colour (sRGB). Default white.
        "light.lamp[].colour" => value::<Colour>();
        /// Instead of `colour`: its colour temperature in kelvin, 1667 to 25000: 1900 a candle, 2900 a bulb,
        /// 5500 noon, 6500 white, 10000 blue sky.
        "light.lamp[].temperature" => number::<Ratio>().range(1667.0, 25_000.0, "between 1667 and 25000 K");
        /// Whether a lamp with a `size` is seen in the traced picture. Default false.
        "light.lamp[].shown" => value::<Flag>();
        /// The picture's size.
        "output" => table();
        /// Pixels across; {}. Default 900.
        "output.width" => number::<Count>().range(1.0, 16_384.0, "between 1 and 16384")
            .field(field!(output.width));
        /// Pixels down; {}. Default 1100.
        "output.height" => number::<Count>().range(1.0, 16_384.0, "between 1 and 16384")
            .field(field!(output.height));
        /// Samples of the head per pixel of a preview, across and down; {}. Default 4.
        "output.samples" => number::<Count>().range(1.0, 8.0, "between 1 and 8")
            .field(field!(output.samples));
        /// Stops by which a PNG is lighter than the light; {}. Default 0.
        "output.exposure" => number::<Ratio>().range(-20.0, 20.0, "between -20 and 20")
            .field(field!(output.exposure))
            .slider(Panel::Look, "Exposure", STOPS, (-4.0, 4.0), 1, "Stops by which the picture is lighter.");
        /// How light becomes a PNG's colours. Default "shoulder".
        "output.tone" => value::<OneOf<ToneCurve>>();
        /// Whether pictures show what holds the hair: rollers, hair ties, pins and clips. Default true.
        "output.accessories" => value::<Flag>();
    }
});

/// The radius and pitch (m) of the natural helix; straight hair has the largest radius of the slider.
fn helix(spec: &HairstyleSpec) -> [f64; 2] {
    let strain = spec.curl.strain;
    let (bend, twist) = (strain.x.hypot(strain.y), strain.z);
    let total = bend * bend + twist * twist;
    if total < 1e-6 {
        return [0.2, 0.0];
    }
    [(bend / total).max(5e-4), TAU * twist / total]
}

/// E / 2μ − 1.
fn poissons_ratio(material: &Material) -> f64 {
    0.5 * material.youngs_modulus() / material.shear_modulus() - 1.0
}

fn lift_scale(scene: &Scene) -> f64 {
    match scene.spec.implantation.lift {
        Lift::Regional { scale } => scale,
        Lift::Uniform(_) => 1.0,
    }
}

fn drawn_density(scene: &Scene) -> f64 {
    match scene.spec.wisps.hairs {
        Hairs::Density(density) => density,
        Hairs::Count(_) | Hairs::PerWisp(_) => scene.spec.implantation.density,
    }
}
