//! The keys of a scene, as they stand in the file.
//!
//! The comments here are the reference: they become the descriptions in the JSON Schema and in
//! `docs/scene.md`. The range of a number that a hairstyle checks stands with its description
//! ([`frisure_hairstyle::RANGES`]) and takes the place of `{}` in the comment; every other
//! range stands here, and is checked from here. What a table is about stands at the field that holds it.

use std::f64::consts::{FRAC_PI_2, PI};

use frisure_look::{Setup, ToneCurve};
use schemars::JsonSchema;
use serde::Deserialize;

use super::key::{
    Acceleration, Angle, BackdropKind, Colour, Count, Density, FaceSize, Flag, Key, Length,
    Modulus, NumberDensity, OneOf, Pair, Point, Points, Ratio, Speed, Strain, Text, Vector,
};
use super::step::Step;
use super::words::{
    BodyWord, BranchKind, FlowWord, HairContactWord, HairType, Handed, PartingPlace, Places,
    ShadeWord, UnitWord, WettingWord, Which,
};
use frisure_files::frame::UpAxis;

/// A scene: hair, the head it grows on, and how to look at it.
///
/// Every key has a default. Quantities are texts with a unit ("25 cm", "70 um", "2.5 GPa",
/// "80 deg") or bare numbers in SI units.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct File {
    /// A name for people.
    pub(super) name: Key<Text>,
    /// Drives all randomness: the same scene and seed give the same bytes. Default 1.
    pub(super) seed: Key<Count>,
    /// Acceleration of gravity, along -z; {}. Default 9.81 m/s^2.
    pub(super) gravity: Key<Acceleration>,
    /// What the hair is: a type, and what differs from it.
    pub(super) hair: Hair,
    /// The head that hair grows on; left out, the built-in mannequin.
    pub(super) head: Head,
    /// Hair from another program instead of predicted hair: its strands, or those that it calls guides, become guides with the
    /// fibre of `[hair]`, so curled that they hang as they were modelled, and can be wetted, cut and grown. They carry the other
    /// strands. Length and curl of `[hair]` count for nothing then.
    pub(super) groom: Groom,
    /// How hair leaves the scalp.
    pub(super) implantation: Implantation,
    /// What parts of the scalp have that the rest has not; later ones override earlier ones.
    pub(super) region: Vec<Region>,
    /// Guides and the drawn hairs around them.
    pub(super) wisps: Wisps,
    /// Hair against the head and against hair.
    pub(super) contact: Contact,
    /// How the equilibrium of each guide is computed.
    pub(super) equilibrium: Equilibrium,
    /// What is done to the hair, in this order; each step has exactly one of these keys.
    pub(super) step: Vec<Step>,
    /// Colours.
    pub(super) look: Look,
    /// Where the picture is taken from. All of the hair and the head is always in it, though not
    /// the shoulders.
    pub(super) camera: Camera,
    /// What lights the head: a setup whose lamps turn with the camera, or sky or surroundings that
    /// stay, and further lamps. With `azimuth` or `elevation` the main lamp stands elsewhere.
    pub(super) light: Light,
    /// The picture's size.
    pub(super) output: Output,
}

/// `[hair]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Hair {
    /// The hair type to start from; every other key overrides it. Default "caucasian-straight".
    #[serde(rename = "type")]
    pub(super) kind: Key<OneOf<HairType>>,
    /// Mean length along the fibre; {} on a head.
    pub(super) length: Key<Length>,
    /// Standard deviation of the length between wisps, as a fraction; {}.
    pub(super) length_variation: Key<Ratio>,
    /// Which shape of the type's section is taken, where `[hair.fibre]` gives none. Default
    /// "measured".
    pub(super) ellipticity: Key<OneOf<Which<frisure_hairstyle::Ellipticity>>>,
    /// How fast it grows; {}. Default the type's.
    pub(super) growth_rate: Key<Speed>,
    /// What water makes of a fibre. Default "paper".
    pub(super) wetting: Key<OneOf<Which<WettingWord>>>,
    /// Section and material of a fibre. The section is said in one way: `diameter` or
    /// `mean_radius`, with `eccentricity` or `axis_ratio`; or both semi-axes.
    pub(super) fibre: Fibre,
    /// Natural curl, the shape without weight. It is said in one way: `radius` and `pitch`; or
    /// strains; or, for one hair, strains `along` it.
    pub(super) curl: Curl,
    /// The material frame in which the hair of `frisure hair` is clamped (heads have their scalp):
    /// two of three unit vectors at right angles, d1 x d2 = t, or all. By default the hair leaves
    /// horizontally: t along +x, d1 along +y, d2 along +z.
    pub(super) root: Root,
}

/// `[hair.fibre]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Fibre {
    /// Mean diameter 2 sqrt(ab); more than 0.
    #[schemars(range(min = 0.0))]
    pub(super) diameter: Key<Length>,
    /// Mean radius sqrt(ab); more than 0.
    #[schemars(range(min = 0.0))]
    pub(super) mean_radius: Key<Length>,
    /// Semi-axis along the director d1; more than 0. The fibre bends most easily about the longer.
    #[schemars(range(min = 0.0))]
    pub(super) semi_axis_a: Key<Length>,
    /// Semi-axis along the director d2; more than 0.
    #[schemars(range(min = 0.0))]
    pub(super) semi_axis_b: Key<Length>,
    /// sqrt(1 - b^2/a^2) at constant mean radius; 0 (a circle) to less than 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) eccentricity: Key<Ratio>,
    /// Longer over shorter axis, at constant mean radius; at least 1 (a circle).
    #[schemars(range(min = 1.0))]
    pub(super) axis_ratio: Key<Ratio>,
    /// Young's modulus; more than 0. Default 3.9 GPa.
    #[schemars(range(min = 0.0))]
    pub(super) youngs_modulus: Key<Modulus>,
    /// Shear modulus; more than 0. Default 0.9 GPa, also when Young's modulus is given.
    #[schemars(range(min = 0.0))]
    pub(super) shear_modulus: Key<Modulus>,
    /// Poisson's ratio, instead of the shear modulus: it is E / 2(1 + nu) then; more than -1, at
    /// most 0.5.
    #[schemars(range(min = -1.0, max = 0.5))]
    pub(super) poisson_ratio: Key<Ratio>,
    /// Density; more than 0. Default 1.3 g/cm^3.
    #[schemars(range(min = 0.0))]
    pub(super) density: Key<Density>,
    /// Standard deviation of the diameter between guides, as a fraction of the mean; {}.
    pub(super) variation: Key<Ratio>,
    /// Standard deviation between guides of what the axis ratio exceeds 1 by, as a fraction of the
    /// mean; {}. A circle stays one.
    pub(super) axis_ratio_variation: Key<Ratio>,
    /// Which torsion constant the section is given. Default "saint-venant".
    pub(super) torsion: Key<OneOf<Which<frisure_rod::TorsionConstant>>>,
}

/// `[hair.curl]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Curl {
    /// Radius of the natural helix; more than 0, at least 0.05 mm on a head.
    #[schemars(range(min = 0.0))]
    pub(super) radius: Key<Length>,
    /// Advance of the natural helix per turn; negative turns it left-handed.
    pub(super) pitch: Key<Length>,
    /// Natural curvature about d1. If a strain is given, those not given are 0.
    pub(super) kappa1: Key<Strain>,
    /// Natural curvature about d2.
    pub(super) kappa2: Key<Strain>,
    /// Natural twist.
    pub(super) tau: Key<Strain>,
    /// Natural strains at increasing distances from the root, linear between them and constant
    /// outside; for `frisure hair` only.
    pub(super) along: Vec<Knot>,
    /// Which way curls turn on a head. Default "random".
    pub(super) handedness: Key<OneOf<Handed>>,
    /// Standard deviation of the strain between wisps, as a fraction; {}.
    pub(super) variation_between: Key<Ratio>,
    /// Standard deviation of the strain along a hair, as a fraction; {}.
    pub(super) variation_along: Key<Ratio>,
    /// Correlation length of the variation along a hair; 1 mm to 1 m.
    pub(super) variation_scale: Key<Length>,
}

/// A natural strain at one place of a hair.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Knot {
    /// Distance from the root along the hair; default 0.
    pub(super) s: Key<Length>,
    /// Natural curvature about d1; default 0.
    pub(super) kappa1: Key<Strain>,
    /// Natural curvature about d2; default 0.
    pub(super) kappa2: Key<Strain>,
    /// Natural twist; default 0.
    pub(super) tau: Key<Strain>,
}

/// `[hair.root]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Root {
    /// First principal axis of the section.
    pub(super) d1: Key<Vector>,
    /// Second principal axis of the section.
    pub(super) d2: Key<Vector>,
    /// Tangent, out of the scalp.
    pub(super) t: Key<Vector>,
}

/// `[head]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Head {
    /// Path of a mesh (OBJ, USD, glTF or PLY), relative to the scene. Left out, the built-in mannequin.
    pub(super) mesh: Key<Text>,
    /// Which axis of the mesh points up; the face looks along +z or -y then. Default that of the file or format, "y" of
    /// most.
    pub(super) up: Key<OneOf<Which<UpAxis>>>,
    /// Unit of the mesh. Default that of the file or format; of OBJ and PLY, which say none, "m", or as the size shows.
    pub(super) unit: Key<OneOf<UnitWord>>,
    /// Metres per unit of the mesh, instead of `unit`; more than 0.
    #[schemars(range(min = 0.0))]
    pub(super) scale: Key<Ratio>,
    /// Group of faces on which hair grows, or the material that they have. Without scalp keys, the scalp is guessed.
    pub(super) scalp_group: Key<Text>,
    /// What is painted on the mesh's vertices where hair grows: "red", "green", "blue", "alpha" or "brightness" of their
    /// colours, or the name of another attribute with numbers from 0 to 1.
    pub(super) scalp_colour: Key<Text>,
    /// Path of a PNG over the mesh's texture coordinates, white where hair grows.
    pub(super) scalp_mask: Key<Text>,
    /// Path of a text file with one density from 0 to 1 per vertex, in the order of the mesh.
    pub(super) scalp_weights: Key<Text>,
}

/// `[groom]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Groom {
    /// Path of the groom, relative to the scene: .hair, .obj, .ply, .usd, .abc, .data or .npz. It is rooted on the head of `[head]`.
    pub(super) file: Key<Text>,
    /// Which axis of the groom points up; the face looks along +z or -y then. Default that of the file or format.
    pub(super) up: Key<OneOf<Which<UpAxis>>>,
    /// Unit of the groom. Default that of the file or format.
    pub(super) unit: Key<OneOf<UnitWord>>,
    /// How many of its strands become guides at most, evenly chosen; these carry the others. 1 to 100000. Default 300.
    #[schemars(range(min = 1, max = 100_000))]
    pub(super) guides: Key<Count>,
}

/// `[implantation]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Implantation {
    /// The direction along the scalp. Default "parted".
    pub(super) flow: Key<OneOf<FlowWord>>,
    /// Where the parting is: a word, or its distance from the middle at the hairline, positive to
    /// the head's left; within 6 cm. Default 2 cm.
    #[schemars(range(min = -0.06, max = 0.06))]
    pub(super) parting: Key<PartingPlace>,
    /// Several partings, or ones drawn through points, instead of `parting`.
    pub(super) partings: Vec<Parting>,
    /// Whorls at the crown about which hair turns as it grows: 1, or 2 as about 5 % of people have
    /// them. Default 1.
    pub(super) whorls: Key<Count>,
    /// Distance of the whorl from its usual place, to the head's left and back; within 5 cm.
    pub(super) whorl_offset: Key<Pair>,
    /// Which way hair turns about the whorl, seen from outside; of two, the right one. Default
    /// "clockwise", as in most people.
    pub(super) whorl_turn: Key<OneOf<Which<frisure_hairstyle::Turn>>>,
    /// Angle to the skin, the same everywhere; {}.
    pub(super) lift: Key<Angle>,
    /// Instead of `lift`: factor on the angles measured by region; {}.
    pub(super) lift_scale: Key<Ratio>,
    /// Standard deviation of the direction between wisps; 0 to 1 rad.
    pub(super) jitter: Key<Angle>,
    /// Fraction of the hairs within 1.5 cm of the edge that stay short and thin; {}. Default
    /// 0.15.
    pub(super) baby_hairs: Key<Ratio>,
    /// The edge of the hair, against the usual line. A scalp that comes with a mesh keeps its own.
    pub(super) hairline: Hairline,
}

/// One of `[[implantation.partings]]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Parting {
    /// Where a straight one is, as `parting` says it.
    pub(super) at: Key<PartingPlace>,
    /// Points that it goes smoothly through, each as distances on the skin: across, from the middle
    /// to the head's left, and back, behind the forehead's hairline.
    pub(super) line: Key<Points>,
}

/// `[implantation.hairline]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Hairline {
    /// Standard deviation from a smooth line; {}. Default 1.5 mm.
    pub(super) irregularity: Key<Length>,
    /// How much higher it is over the forehead; {}. Default 0.
    pub(super) height: Key<Length>,
    /// How far it recedes at the temples; {}. Default 3 mm.
    pub(super) recession: Key<Length>,
    /// How far it comes forward to a point in the middle; {}. Default 0.
    pub(super) widows_peak: Key<Length>,
}

/// One of `[[region]]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Region {
    /// Which part of the scalp, or a list of parts.
    #[serde(rename = "where")]
    pub(super) place: Key<Places>,
    /// Length along the fibre; {}. It changes at once at the region's border, as cut.
    pub(super) length: Key<Length>,
    /// Instead of `length`: as long as it takes to reach down to here, cut to a line.
    pub(super) down_to: Key<OneOf<Which<frisure_hairstyle::Level>>>,
    /// Direction along the skin.
    pub(super) comb: Key<OneOf<Which<frisure_hairstyle::Comb>>>,
    /// Angle to the skin; {}.
    pub(super) lift: Key<Angle>,
    /// Factor on the natural curl; {}.
    pub(super) curl: Key<Ratio>,
}

/// `[wisps]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Wisps {
    /// Number of wisps, each with one computed guide; {}.
    pub(super) count: Key<Count>,
    /// Drawn hairs per area of scalp, instead of `hairs`; {}. Default that of the hair
    /// type.
    pub(super) density: Key<NumberDensity>,
    /// Number of drawn hairs on the whole head; {}. Default by `density`.
    pub(super) hairs: Key<Count>,
    /// Mean number of drawn hairs around each guide, instead of `hairs`; {}.
    pub(super) hairs_per_wisp: Key<Count>,
    /// How much a wisp gathers to its tip: 0 (as wide as at the scalp) to 1 (as thick as its hairs
    /// need).
    pub(super) clumping: Key<Ratio>,
    /// Further factors on the width of a wisp at root, middle and tip; each 0 to 10. Default
    /// [1, 1, 1].
    pub(super) profile: Key<Vector>,
    /// Number of thinner wisps that each wisp splits into; {}.
    pub(super) splits: Key<Count>,
    /// How far hairs stray from their place, as a fraction of the wisp's radius; {}.
    pub(super) fuzziness: Key<Ratio>,
    /// Standard deviation of the length within a wisp, as a fraction; {}.
    pub(super) length_variation: Key<Ratio>,
    /// Fraction of hairs that leave their wisp; {}.
    pub(super) flyaways: Key<Ratio>,
    /// How far neighbouring wisps blend: 0 (distinct) to 1 (a smooth mass).
    pub(super) blending: Key<Ratio>,
    /// Points along each drawn hair; {}.
    pub(super) points: Key<Count>,
    /// What drawn hairs are. Default "interpolated".
    pub(super) strands: Key<OneOf<Which<frisure_hairstyle::HairModel>>>,
}

/// `[contact]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Contact {
    /// What the hair lies on. Default "signed-distance".
    pub(super) body: Key<OneOf<BodyWord>>,
    /// What a wisp makes of the other wisps. Default "wisps".
    pub(super) hair: Key<OneOf<HairContactWord>>,
    /// Stiffness of skin per length of hair; {}. Default 2000 Pa.
    pub(super) stiffness: Key<Modulus>,
    /// Stiffness of hair per length of hair; {}. Default 0.5 Pa.
    pub(super) hair_stiffness: Key<Modulus>,
    /// Factor on the thickness of wisps, which follows from their hairs; {}. Default 1.
    pub(super) volume: Key<Ratio>,
}

/// `[equilibrium]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Equilibrium {
    /// Number of elements per hair; 1 to 10000, at most 1000 on a head.
    #[schemars(range(min = 1, max = 10_000))]
    pub(super) elements: Key<Count>,
    /// Instead of `elements`: as many as it takes to be this near to the exact shape; more than 0.
    /// Default 0.5 mm.
    #[schemars(range(min = 0.0))]
    pub(super) accuracy: Key<Length>,
    /// Slope, relative to the weight of a hair, at which wisps that make way for each other are at
    /// rest; {}. Default 0.03, which friction would hold ten times over.
    pub(super) tolerance: Key<Ratio>,
    /// The curve that an element can take. Default "auto".
    pub(super) element: Key<OneOf<Which<frisure_rod::ElementKind>>>,
    /// Which equilibrium, where there are several; for `frisure hair`. Default "gravity".
    pub(super) branch: Key<OneOf<Which<BranchKind>>>,
    /// Number of starting shapes that `branch = "lowest"` tries; 1 to 1000. Default 16.
    #[schemars(range(min = 1, max = 1000))]
    pub(super) starts: Key<Count>,
}

/// `[look]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Look {
    /// Colour of natural hair, by its name; the keys below override its numbers. Default "brown".
    pub(super) colour: Key<OneOf<ShadeWord>>,
    /// Concentration of the brown pigment: about 0.1 blond, 0.8 brown, 3 black; 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub(super) eumelanin: Key<Ratio>,
    /// Concentration of the red pigment; 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub(super) pheomelanin: Key<Ratio>,
    /// Instead of pigments: the colour (sRGB) that much of this hair has, as measured.
    pub(super) reflectance: Key<Colour>,
    /// Instead of pigments: absorption of red, green and blue light per radius of the fibre; each 0
    /// to 1000.
    pub(super) absorption: Key<Vector>,
    /// Fraction of the hairs that have no pigment: grey hair; 0 to 1. Default that of the colour.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) white_share: Key<Ratio>,
    /// Relative variation of the pigment from hair to hair; 0 to 1. Default 0.18.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) variation: Key<Ratio>,
    /// Pigment at the roots.
    pub(super) roots: LookEnd,
    /// Pigment at the tips, which the sun bleaches.
    pub(super) tips: LookEnd,
    /// Hair coloured on purpose.
    pub(super) dye: LookDye,
    /// Roughness along the fibre: 0.1 has narrow highlights, 0.5 is matt; 0.05 to 1. Default 0.2.
    #[schemars(range(min = 0.05, max = 1.0))]
    pub(super) roughness: Key<Ratio>,
    /// Roughness around the fibre; 0.05 to 1. Default 0.3.
    #[schemars(range(min = 0.05, max = 1.0))]
    pub(super) roughness_around: Key<Ratio>,
    /// Tilt of the cuticle's scales, which moves the highlights apart; -20 to 20 deg. Default 3 deg.
    #[schemars(range(min = (-20_f64).to_radians(), max = 20_f64.to_radians()))]
    pub(super) tilt: Key<Angle>,
    /// Refractive index of the fibre; 1.05 to 3. Default 1.55.
    #[schemars(range(min = 1.05, max = 3.0))]
    pub(super) index: Key<Ratio>,
    /// Colour of the skin (sRGB).
    pub(super) skin: Key<Colour>,
    /// What is behind the head. Default "surroundings" where sky or an environment light it, else "wall".
    pub(super) background: Key<BackdropKind>,
    /// Colour of a floor under the head (sRGB), which catches its shadow in a final picture. Left out,
    /// there is none.
    pub(super) floor: Key<Colour>,
}

/// `[look.roots]` and `[look.tips]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct LookEnd {
    /// Factor on the pigment at this end; 0 to 10. Default 1.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub(super) pigment: Key<Ratio>,
    /// Distance from the end over which this fades away; 0 to 3 m. Default 5 cm.
    #[schemars(range(min = 0.0, max = 3.0))]
    pub(super) fade: Key<Length>,
}

/// `[look.dye]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct LookDye {
    /// Colour (sRGB) that much hair has with this dye.
    pub(super) colour: Key<Colour>,
    /// How much of the natural colour it takes the place of; 0 to 1. Default 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) strength: Key<Ratio>,
    /// Length at the roots that has grown since, without dye; 0 to 3 m. Default 0.
    #[schemars(range(min = 0.0, max = 3.0))]
    pub(super) regrowth: Key<Length>,
}

/// `[camera]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Camera {
    /// Around the head: 0 faces it, 90 deg sees its left side, -90 deg its right. Default 30 deg.
    pub(super) azimuth: Key<Angle>,
    /// Above the horizon; -85 to 85 deg. Default 5 deg.
    #[schemars(range(min = (-85_f64).to_radians(), max = 85_f64.to_radians()))]
    pub(super) elevation: Key<Angle>,
    /// Angle from the picture's bottom to its top; 1 to 120 deg. Default 24 deg, a portrait lens.
    #[schemars(range(min = 1_f64.to_radians(), max = 120_f64.to_radians()))]
    pub(super) field_of_view: Key<Angle>,
    /// How far the lens is closed, in a final picture: at 2.8 what is out of its focus is blurred as in a
    /// portrait; 0.5 to 64. Left out, everything is sharp.
    #[schemars(range(min = 0.5, max = 64.0))]
    pub(super) f_number: Key<Ratio>,
    /// Distance from the camera that is sharp, with `f_number`; 1 cm to 1 km. Default what is nearest in
    /// the middle of the picture.
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub(super) focus: Key<Length>,
}

/// `[light]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Light {
    /// How the lights are set. Default "studio"; with an `environment` "dark", with a sun "daylight".
    pub(super) setup: Key<OneOf<Which<Setup>>>,
    /// Where the main lamp stands: to the right of the camera, seen from the head; negative is to
    /// its left. -180 to 180 deg.
    #[schemars(range(min = -PI, max = PI))]
    pub(super) azimuth: Key<Angle>,
    /// How far the main lamp stands above the horizon; -90 to 90 deg.
    #[schemars(range(min = -FRAC_PI_2, max = FRAC_PI_2))]
    pub(super) elevation: Key<Angle>,
    /// How large the main lamp is, as the angle from edge to edge under which the head sees it: a larger
    /// one is softer. 0 to 170 deg; the studio's is about 10 deg, the sun 0.5 deg.
    #[schemars(range(min = 0.0, max = 170_f64.to_radians() + 1e-9))]
    pub(super) size: Key<Angle>,
    /// Factor on the strength of all lamps; 0 to 100. Default 1.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub(super) strength: Key<Ratio>,
    /// Factor on the light that comes from all around: of the room, the sky or the environment; 0 to
    /// 1000. Default 1.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub(super) sky_strength: Key<Ratio>,
    /// An equirectangular picture of surroundings with all of their light, `.hdr` or `.exr`, linear sRGB.
    pub(super) environment: Key<Text>,
    /// How far the environment is turned towards the head's left. Its middle is before the face at 0,
    /// the default.
    pub(super) rotation: Key<Angle>,
    /// Where the sun of `setup = "daylight"` stands around the head: 0 before the face, 90 deg at its
    /// left. It stays there when the camera moves. Default 50 deg.
    #[schemars(range(min = -2.0 * PI, max = 2.0 * PI))]
    pub(super) sun_azimuth: Key<Angle>,
    /// How far the sun stands above the horizon; 0 to 90 deg. Default 40 deg.
    #[schemars(range(min = 0.0, max = FRAC_PI_2))]
    pub(super) sun_elevation: Key<Angle>,
    /// Haze of the daylight: 2 after rain, 3 clear, 6 hazy, 10 dull; 1.9 to 10. Default 3.
    #[schemars(range(min = 1.9, max = 10.0))]
    pub(super) turbidity: Key<Ratio>,
    /// Further lamps. Each is far away, or at a place with `distance` or `position`.
    pub(super) lamp: Vec<Lamp>,
}

/// `[[light.lamp]]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Lamp {
    /// Where it stands: to the right of the camera, seen from the head; negative is to its left. -180 to
    /// 180 deg, default 0.
    #[schemars(range(min = -PI, max = PI))]
    pub(super) azimuth: Key<Angle>,
    /// How far it stands above the horizon; -90 to 90 deg. Default 0.
    #[schemars(range(min = -FRAC_PI_2, max = FRAC_PI_2))]
    pub(super) elevation: Key<Angle>,
    /// How far from the middle of the head; 1 cm to 1 km. Left out, it is very far away.
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub(super) distance: Key<Length>,
    /// Instead of these: its place, with x to the head's left, y back, z up; within 1 km.
    pub(super) position: Key<Point>,
    /// Angle from edge to edge of a lamp that is very far away; 0 to 170 deg. Default 10 deg.
    #[schemars(range(min = 0.0, max = 170_f64.to_radians() + 1e-9))]
    pub(super) angle: Key<Angle>,
    /// Size of a lamp that is not: diameter of a disc, or width and height of a rectangle, facing the
    /// head; 1 mm to 100 m. Left out, it shines from a point to all sides.
    pub(super) size: Key<FaceSize>,
    /// Its brightness in the middle of the head, against the studio's main lamp; 0 to 100. Default 1.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub(super) strength: Key<Ratio>,
    /// Its colour (sRGB). Default white.
    pub(super) colour: Key<Colour>,
    /// Instead of `colour`: its colour temperature in kelvin, 1667 to 25000: 1900 a candle, 2900 a bulb,
    /// 5500 noon, 6500 white, 10000 blue sky.
    #[schemars(range(min = 1667.0, max = 25_000.0))]
    pub(super) temperature: Key<Ratio>,
    /// Whether a lamp with a `size` is seen in the traced picture. Default false.
    pub(super) shown: Key<Flag>,
}

/// `[output]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Output {
    /// Pixels across; 1 to 16384. Default 900.
    #[schemars(range(min = 1, max = 16_384))]
    pub(super) width: Key<Count>,
    /// Pixels down; 1 to 16384. Default 1100.
    #[schemars(range(min = 1, max = 16_384))]
    pub(super) height: Key<Count>,
    /// Samples of the head per pixel of a preview, across and down; 1 to 8. Default 4.
    #[schemars(range(min = 1, max = 8))]
    pub(super) samples: Key<Count>,
    /// Stops by which a PNG is lighter than the light; -20 to 20. Default 0.
    #[schemars(range(min = -20.0, max = 20.0))]
    pub(super) exposure: Key<Ratio>,
    /// How light becomes a PNG's colours. Default "shoulder".
    pub(super) tone: Key<OneOf<ToneCurve>>,
}
