//! The description of a hairstyle: plain data, SI units.

use frisure_digest::digestible;
use frisure_rod::{Load, Section};

use super::load::{Pose, Wind};
use crate::fibre::{Curl, Fibre, Wetting};
use crate::head::{Hairline, Region};
use crate::rod_digest::{add_element, add_resolution};

digestible! {
    /// A whole head of hair, described.
    ///
    /// A preset is a place to start:
    ///
    /// ```
    /// let mut spec = frisure_hairstyle::preset("caucasian-curly").expect("a preset").spec();
    /// spec.length.mean = 0.3;
    /// assert!(spec.check().is_ok());
    /// spec.length.mean = 30.0;
    /// assert_eq!(spec.check().unwrap_err().to_string(), "hair.length is 30; it must be between 1 mm and 3 m");
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    pub struct HairstyleSpec {
        /// Drives all randomness.
        pub seed: u64,
        /// Section and material.
        pub fibre: Fibre,
        /// What water makes of the fibre.
        pub wetting: Wetting,
        /// Natural curl.
        pub curl: Curl,
        /// How long the hair is.
        pub length: Length,
        /// How hair leaves the scalp.
        pub implantation: Implantation,
        /// What parts of the scalp have that the rest has not; later ones override earlier ones.
        pub regions: Vec<RegionStyle>,
        /// Guides and the drawn hairs around them.
        pub wisps: Wisps,
        /// Hair against the body.
        pub contact: Contact,
        /// How the equilibrium of guides is computed.
        pub equilibrium: Settling,
        /// Acceleration of gravity (m/s²), along [`Pose::down`].
        pub gravity: f64,
        /// How the head is held against gravity.
        pub pose: Pose,
        /// Wind on the hair.
        pub wind: Wind,
    }
}

digestible! {
    /// Length of the hair.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Length {
        /// Mean length of guides along the fibre (m).
        pub mean: f64,
        /// Standard deviation between wisps, as a fraction of the mean.
        pub variation_between: f64,
        /// How fast it grows (m/s).
        pub growth_rate: f64,
    }
}

impl Default for Length {
    fn default() -> Self {
        Self { mean: 0.25, variation_between: 0.05, growth_rate: 4e-9 }
    }
}

digestible! {
    /// How hair leaves the scalp.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Implantation {
        /// The direction along the scalp.
        pub flow: Flow,
        /// Where hair turns, if it flows as it grows.
        pub whorls: Whorls,
        /// Lines from which hair is combed away to both sides. Without any, [`Flow::Parted`] has one of
        /// its own; with some, these are taken instead.
        pub partings: Vec<Parting>,
        /// The angle to the skin.
        pub lift: Lift,
        /// Standard deviation of the direction between wisps (rad).
        pub jitter: f64,
        /// Hairs that grow per area of scalp (1/m²), whether or not all of them are drawn.
        pub density: f64,
        /// The edge of the hair, on a head whose scalp does not come with its mesh.
        pub hairline: Hairline,
        /// Force per length, in weights of the hair, with which friction on the hair beneath holds combed hair out of the face and on
        /// its side of a parting.
        pub hold: f64,
        /// Fraction of the hairs within 1.5 cm of the edge that stay short and thin, 0 to 1: twice as many at the edge, none at
        /// 1.5 cm. From 0.5 on all at the edge are, so that 1 gives three quarters.
        pub baby_hairs: f64,
    }
}

impl Default for Implantation {
    fn default() -> Self {
        Self {
            flow: Flow::Whorl,
            whorls: Whorls::default(),
            partings: Vec::new(),
            lift: Lift::Regional { scale: 1.0 },
            jitter: 0.05,
            density: 2e6,
            hairline: Hairline::default(),
            hold: 1.2,
            baby_hairs: 0.25,
        }
    }
}

digestible! {
    /// Where hair turns at the crown.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Whorls {
        /// One, or two side by side as about 5 % of people have them.
        pub count: usize,
        /// Distance of the whorl, or of the middle between two, from the usual place (m): to the head's
        /// left, and back.
        pub offset: [f64; 2],
        /// Which way hair turns; of two, the one on the right.
        pub turn: Turn,
    }
}

impl Default for Whorls {
    fn default() -> Self {
        Self { count: 1, offset: [0.0; 2], turn: Turn::Clockwise }
    }
}

/// Which way hair turns about a whorl, seen from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turn {
    /// As in most people.
    #[default]
    Clockwise,
    /// The other way.
    Anticlockwise,
}

/// A line on the scalp from which hair is combed away to both sides.
///
/// Places are measured with a tape on the skin: back from the forehead's hairline along the middle
/// of the head, and from there across to the head's left.
#[derive(Clone, Debug, PartialEq)]
pub enum Parting {
    /// From the hairline to the whorl.
    Straight {
        /// Distance from the middle at the hairline (m), positive to the head's left.
        offset: f64,
    },
    /// The same with a zigzag of about a centimetre.
    Zigzag {
        /// Distance from the middle (m), positive to the head's left.
        offset: f64,
    },
    /// A smooth curve through points: across and back (m).
    Through(Vec<[f64; 2]>),
}

digestible! {
    /// What a part of the scalp has that the rest has not. Over about a centimetre at the border,
    /// directions, angles and curls pass into those outside; lengths jump, as a cut does.
    #[derive(Clone, Debug, Default, PartialEq)]
    pub struct RegionStyle {
        /// Where: in any of these.
        pub places: Vec<Place>,
        /// Length of the hair.
        pub length: Option<RegionLength>,
        /// Direction along the skin.
        pub comb: Option<Comb>,
        /// Angle to the skin (rad).
        pub lift: Option<f64>,
        /// Factor on the natural curl.
        pub curl: Option<f64>,
    }
}

/// A part of the scalp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// One region.
    Region(Region),
    /// Its left half.
    LeftOf(Region),
    /// Its right half.
    RightOf(Region),
    /// The head's left half.
    Left,
    /// The head's right half.
    Right,
    /// All of it.
    Everywhere,
}

/// Length of the hair of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RegionLength {
    /// Along the fibre (m).
    Mean(f64),
    /// As long as it takes to reach down to a level.
    DownTo(Level),
}

/// A height on the head or below it that hair can reach down to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// The brows.
    Brows,
    /// The eyes.
    Eyes,
    /// The middle of the ears.
    Ears,
    /// The chin.
    Chin,
    /// The lowest hair in the neck.
    Nape,
    /// The shoulders, where the neck meets them.
    Shoulders,
    /// The chest, as high as the armpits.
    Chest,
}

/// The direction in which hair is combed, along the skin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comb {
    /// Over the head to the face, and down the forehead.
    Forward,
    /// Over the head to the neck.
    Back,
    /// Down.
    Down,
    /// To the head's left, and down.
    Left,
    /// To the head's right, and down.
    Right,
}

/// The direction in which hair leaves the scalp, along the skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flow {
    /// As it grows: around a whorl at the crown, forward over the forehead.
    Whorl,
    /// Combed to both sides of a parting line, `offset` (m) to the left (+) of the middle.
    Parted {
        /// Distance of the parting from the middle (m), positive to the head's left.
        offset: f64,
    },
    /// Combed back from the forehead.
    SweptBack,
}

/// The angle between hair and skin at the root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lift {
    /// Measured means by region (hairline 15°, temples 7°, mid-scalp 30°, crown 60°), scaled.
    Regional {
        /// Factor on the measured angles; 1 is as measured.
        scale: f64,
    },
    /// The same everywhere (rad); π/2 is perpendicular to the skin.
    Uniform(f64),
}

digestible! {
    /// Guides and the drawn hairs around them.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Wisps {
        /// Number of wisps, each with one guide.
        pub count: usize,
        /// How many hairs are drawn.
        pub hairs: Hairs,
        /// How much a wisp gathers towards its tip, from the patch of skin that it grows on (0) to the
        /// thickness that its hairs need (1): pronounced locks have more.
        pub clumping: f64,
        /// Further factors on the width of a wisp at its root, middle and tip.
        pub profile: [f64; 3],
        /// Number of thinner wisps that each wisp splits into towards its tip, in the mean; 1 does not split.
        pub splits: usize,
        /// Standard deviation of the logarithm of the width of splits.
        pub split_variation: f64,
        /// How much of the way to the middle of its split a hair has come at the tip, at most: the loosest splits gather less
        /// than half as much.
        pub split_clumping: f64,
        /// Number of still thinner wisps that each split splits into; 1 does not split.
        pub subsplits: usize,
        /// How far the curls of splits are out of step with their guide, 0 (in step) to 1 (independent).
        pub split_phase: f64,
        /// How far the curls of hairs are out of step with their split, 0 to 1.
        pub hair_phase: f64,
        /// Standard deviation of the radius of curls between splits and between hairs, as a fraction.
        pub radius_variation: f64,
        /// How far hairs stray from their place in the wisp, as a fraction of the wisp's radius.
        pub fuzziness: f64,
        /// Standard deviation of the length of hairs within a wisp, as a fraction.
        pub length_variation: f64,
        /// Fraction of hairs that leave their wisp.
        pub flyaways: f64,
        /// Fraction of hairs that have not grown to the length of the others yet.
        pub growing: f64,
        /// How far neighbouring wisps blend into each other, 0 (distinct) to 1 (a smooth mass).
        pub blending: f64,
        /// Points along each drawn hair.
        pub points: usize,
        /// What drawn hairs are.
        pub strands: HairModel,
        /// How simulated hairs touch each other.
        pub contact: StrandContact,
    }
}

impl Default for Wisps {
    fn default() -> Self {
        Self {
            count: 220,
            hairs: Hairs::Density(2e6),
            clumping: 0.6,
            profile: [1.0; 3],
            splits: 8,
            split_variation: 0.5,
            split_clumping: 0.5,
            subsplits: 6,
            split_phase: 0.0,
            hair_phase: 0.0,
            radius_variation: 0.0,
            fuzziness: 0.06,
            length_variation: 0.06,
            flyaways: 0.01,
            growing: 0.1,
            blending: 0.7,
            points: 32,
            strands: HairModel::Interpolated,
            contact: StrandContact::Tube,
        }
    }
}

/// What drawn hairs are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HairModel {
    /// Hairs that go with the guides around them.
    #[default]
    Interpolated,
    /// Rods with fibres of their own, each at rest on the skin and between its neighbours. Hairs of a groom keep their
    /// shapes all the same.
    Simulated,
}

/// How simulated hairs ([`HairModel::Simulated`]) touch each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StrandContact {
    /// Each in a tube that its neighbours leave it, and which it does not push: a mean field.
    #[default]
    Tube,
    /// Each pushes and rubs every other that it touches; a tube as wide as its wisp keeps it in that.
    Contacts,
    /// All are a volume that presses where it is too dense, without friction; tubes are those of [`Self::Contacts`].
    Density,
}

/// How many hairs are drawn on a head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hairs {
    /// So many on the whole head.
    Count(usize),
    /// So many around each guide, on average.
    PerWisp(usize),
    /// As many as grow on the scalp at this density (1/m²).
    Density(f64),
}

impl Wisps {
    /// Number of drawn hairs on a scalp of this weighted area (m²), at least one.
    #[must_use]
    pub fn hair_count(&self, scalp_area: f64) -> usize {
        match self.hairs {
            Hairs::Count(count) => count,
            Hairs::PerWisp(each) => self.count.saturating_mul(each),
            Hairs::Density(density) => ((density * scalp_area).round() as usize).max(1),
        }
    }

    /// Mean number of hairs of a wisp on a scalp of this weighted area (m²).
    #[must_use]
    pub fn hairs_per_wisp(&self, scalp_area: f64) -> f64 {
        self.hair_count(scalp_area) as f64 / self.count.max(1) as f64
    }
}

/// The body that hair lies on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Body {
    /// Hair passes through the body.
    None,
    /// Spheres fitted to the head. \[paper\] §3.1
    Spheres,
    /// The signed distance of the head's mesh.
    #[default]
    SignedDistance,
}

/// What a wisp makes of the other wisps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HairContact {
    /// Wisps pass through each other.
    None,
    /// Wisps lie on a bed of hair, the thicker the higher they are rooted. \[paper\] §3.1
    Layers,
    /// Wisps repel each other where they overlap.
    #[default]
    Wisps,
    /// Wisps lie on a bed of hair as with [`Self::Layers`], and press on each other where together they take more room than
    /// there is. All come to rest together, whatever [`Settling::method`] says.
    Density,
}

digestible! {
    /// Hair against the body and against hair.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Contact {
        /// What the hair lies on.
        pub body: Body,
        /// What a wisp makes of the others.
        pub hair: HairContact,
        /// Penalty stiffness k of the skin per length of hair (N/m per m = Pa), of E_c = ½ k d².
        pub stiffness: f64,
        /// The same of hair (Pa), which is softer.
        pub hair_stiffness: f64,
        /// Factor on the thickness of wisps.
        pub volume: f64,
        /// Coefficient of friction of dry hair against hair, along its scales: largest tangential over normal force. 0: hair slides freely.
        pub friction: f64,
        /// Coefficient of friction of hair against skin.
        pub skin_friction: f64,
        /// Friction of wet hair over that of dry.
        pub wet_friction: f64,
        /// Friction of hair that goes towards its tip, against its scales, over that towards its root.
        pub scales: f64,
        /// Coefficient of friction of the hairs inside a wisp, which stick and slip as it bends. 0: they slide freely, and a wisp bends as one
        /// of its hairs does.
        pub lock_friction: f64,
    }
}

impl Default for Contact {
    fn default() -> Self {
        Self {
            body: Body::SignedDistance,
            hair: HairContact::Wisps,
            stiffness: 2000.0,
            hair_stiffness: 0.5,
            volume: 1.0,
            friction: 0.0,
            skin_friction: 0.0,
            // Both chosen: wet hair has more than dry, and hair more against the scales than along them (Robbins); no numbers
            // were at hand.
            wet_friction: 1.3,
            scales: 1.4,
            lock_friction: 0.0,
        }
    }
}

digestible! {
    /// How the equilibrium of guides is computed.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Settling {
        /// Elements per guide, or an accuracy to reach.
        pub resolution: frisure_rod::Resolution => add_resolution,
        /// Which element.
        pub element: frisure_rod::ElementKind => add_element,
        /// Relative gradient of each guide at which wisps that make way for each other are at rest.
        /// Friction between hairs, of which the energy knows nothing, would hold a hundred times 1e-3.
        /// Only for [`HeadMethod::Sweeps`].
        pub tolerance: f64,
        /// How wisps that make way for each other come to rest.
        pub method: HeadMethod,
    }
}

/// How wisps that make way for each other come to rest together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HeadMethod {
    /// One after the other and along conjugate directions, until the gradient is below a tolerance: fast. Which wisp lies on
    /// which depends on where the iteration stops, so that a small change of the input can move guides by centimetres.
    #[default]
    Sweeps,
    /// All together, while their hardness grows: several times slower, to a gradient of 1e-8 and with a certificate of the
    /// head. A small change of the input mostly moves guides little; sometimes a wisp still snaps past another.
    Continuation,
}

impl Default for Settling {
    fn default() -> Self {
        let resolution = frisure_rod::Resolution::Accuracy(5e-4);
        Self {
            resolution,
            element: frisure_rod::ElementKind::default(),
            tolerance: 3e-2,
            method: HeadMethod::default(),
        }
    }
}

impl HairstyleSpec {
    /// What pulls on a hair of this section, in the frame of the head.
    ///
    /// The drag is that of the mean diameter 2√(ab), and does not change as the hair turns into the wind: a force with a
    /// potential. Wet hair has the force of dry hair.
    #[must_use]
    pub fn load(&self, section: &Section) -> Load {
        let force = self.wind.exposure * self.wind.drag(2.0 * section.mean_radius());
        Load { gravity: self.pose.down() * self.gravity, force: self.wind.direction() * force }
    }
}
