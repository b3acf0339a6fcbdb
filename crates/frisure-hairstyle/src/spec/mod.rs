//! The description of a hairstyle: everything that [`crate::Hairstyle`] is computed from.
//!
//! Plain data, SI units; a scene file is one way to write it down.

mod ranges;

use crate::fibre::{Curl, Fibre, Wetting};
use crate::head::Region;
use crate::math::segments_cross;

pub use crate::head::Hairline;
pub(crate) use ranges::range;
use ranges::within;
pub use ranges::{InvalidSpec, RANGES, Range, range_of};

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
    /// Acceleration of gravity (m/s²), along −z.
    pub gravity: f64,
}

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
    /// Fraction of the hairs within 1.5 cm of the edge that stay short and thin, 0 to 1.
    pub baby_hairs: f64,
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
            baby_hairs: 0.15,
        }
    }
}

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

/// A height on the head that hair can reach down to.
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
    /// Number of thinner wisps that each wisp splits into towards its tip; 1 does not split.
    pub splits: usize,
    /// How far hairs stray from their place in the wisp, as a fraction of the wisp's radius.
    pub fuzziness: f64,
    /// Standard deviation of the length of hairs within a wisp, as a fraction.
    pub length_variation: f64,
    /// Fraction of hairs that leave their wisp.
    pub flyaways: f64,
    /// How far neighbouring wisps blend into each other, 0 (distinct) to 1 (a smooth mass).
    pub blending: f64,
    /// Points along each drawn hair.
    pub points: usize,
    /// What drawn hairs are.
    pub strands: HairModel,
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

/// Most hairs of a head. A guard on memory, ten times the hairs of a head.
const MAX_HAIRS: usize = 1_000_000;

/// Most points of all drawn hairs of a head: 3 GB of positions and radii.
const MAX_POINTS: usize = 200_000_000;

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

    /// Checks how much is drawn on a scalp of this weighted area (m²).
    pub(crate) fn check_size(&self, scalp_area: f64) -> Result<(), InvalidSpec> {
        let hairs = self.hair_count(scalp_area);
        let refuse = |field, allowed| Err(InvalidSpec { field, value: hairs.to_string(), allowed });
        if hairs > MAX_HAIRS {
            return match self.hairs {
                Hairs::Count(_) => refuse("wisps.hairs", "between 1 and 1000000"),
                Hairs::PerWisp(_) => {
                    refuse("wisps.hairs_per_wisp", "so few that a head has at most 1000000 hairs")
                }
                Hairs::Density(_) => {
                    refuse("wisps.density", "so low that this head has at most 1000000 hairs")
                }
            };
        }
        if hairs.saturating_mul(self.points) > MAX_POINTS {
            let value = format!("{} for each of {hairs} hairs", self.points);
            let allowed = "so few that there are at most 200000000 points in all";
            return Err(InvalidSpec { field: "wisps.points", value, allowed });
        }
        Ok(())
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
}

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
}

/// How the equilibrium of guides is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settling {
    /// Elements per guide, or an accuracy to reach.
    pub resolution: frisure_rod::Resolution,
    /// Which element.
    pub element: frisure_rod::ElementKind,
    /// Relative gradient of each guide at which wisps that make way for each other are at rest.
    /// Friction between hairs, of which the energy knows nothing, would hold a hundred times 1e-3.
    pub tolerance: f64,
}

impl HairstyleSpec {
    /// Checks every number against the range in which it means something.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first field that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        within("hair.length", self.length.mean)?;
        within("hair.length_variation", self.length.variation_between)?;
        within("hair.fibre.variation", self.fibre.variation)?;
        within("hair.growth_rate", self.length.growth_rate)?;
        self.wetting.check()?;
        within("hair.fibre.axis_ratio_variation", self.fibre.axis_ratio_variation)?;
        within("hair.curl", self.curl.strain.length())?;
        within("hair.curl.variation_between", self.curl.variation_between)?;
        within("hair.curl.variation_along", self.curl.variation_along)?;
        within("hair.curl.variation_scale", self.curl.variation_scale)?;
        self.implantation.check()?;
        self.regions.iter().try_for_each(RegionStyle::check)?;
        within("wisps.count", self.wisps.count as f64)?;
        match self.wisps.hairs {
            Hairs::Count(hairs) => within("wisps.hairs", hairs as f64)?,
            Hairs::PerWisp(each) => {
                within("wisps.hairs_per_wisp", each as f64)?;
            }
            Hairs::Density(density) => {
                within("wisps.density", density)?;
            }
        }
        within("wisps.clumping", self.wisps.clumping)?;
        within("wisps.fuzziness", self.wisps.fuzziness)?;
        within("wisps.length_variation", self.wisps.length_variation)?;
        within("wisps.flyaways", self.wisps.flyaways)?;
        within("wisps.splits", self.wisps.splits as f64)?;
        for factor in self.wisps.profile {
            within("wisps.profile", factor)?;
        }
        within("wisps.blending", self.wisps.blending)?;
        within("wisps.points", self.wisps.points as f64)?;
        // What does not depend on the scalp is refused here, the rest when there is a head.
        if !matches!(self.wisps.hairs, Hairs::Density(_)) {
            self.wisps.check_size(0.0)?;
        }
        within("contact.stiffness", self.contact.stiffness)?;
        within("contact.hair_stiffness", self.contact.hair_stiffness)?;
        within("wisps.density", self.implantation.density)?;
        within("contact.volume", self.contact.volume)?;
        within("gravity", self.gravity)?;
        if let frisure_rod::Resolution::Elements(n) = self.equilibrium.resolution {
            within("equilibrium.elements", n as f64)?;
        }
        within("equilibrium.tolerance", self.equilibrium.tolerance)?;
        self.equilibrium.resolution.check().map_err(|e| InvalidSpec {
            field: "equilibrium",
            value: e.value.to_string(),
            allowed: e.allowed,
        })
    }
}

impl Wetting {
    /// Checks every factor against the range in which it means something.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        within("hair.wetting.youngs_modulus", self.youngs_modulus)?;
        within("hair.wetting.shear_modulus", self.shear_modulus)?;
        within("hair.wetting.diameter", self.diameter)?;
        within("hair.wetting.length", self.length)?;
        within("hair.wetting.wisp", self.wisp)
    }
}

impl Implantation {
    fn check(&self) -> Result<(), InvalidSpec> {
        within("implantation.jitter", self.jitter)?;
        if let Flow::Parted { offset } = self.flow {
            within("implantation.parting", offset)?;
        }
        match self.lift {
            Lift::Regional { scale } => {
                within("implantation.lift_scale", scale)?;
            }
            Lift::Uniform(angle) => {
                within("implantation.lift", angle)?;
            }
        }
        self.partings.iter().try_for_each(Parting::check)?;
        within("implantation.whorls", self.whorls.count as f64)?;
        for x in self.whorls.offset {
            within("implantation.whorl_offset", x)?;
        }
        within("implantation.baby_hairs", self.baby_hairs)?;
        let h = &self.hairline;
        within("implantation.hairline.irregularity", h.irregularity)?;
        within("implantation.hairline.height", h.height)?;
        within("implantation.hairline.recession", h.recession)?;
        within("implantation.hairline.widows_peak", h.widows_peak)
    }
}

impl Parting {
    /// Checks what can be checked without a head.
    ///
    /// # Errors
    /// [`InvalidSpec`], if it is out of reach, not a line, or crosses itself.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        let points = match self {
            Self::Straight { offset } | Self::Zigzag { offset } => {
                return within("implantation.partings.offset", *offset);
            }
            Self::Through(points) => points,
        };
        let field = "implantation.partings.line";
        let refuse = |value: String, allowed| Err(InvalidSpec { field, value, allowed });
        if !(2..=100).contains(&points.len()) {
            return refuse(format!("of {} points", points.len()), "a line of 2 to 100 points");
        }
        let reached = |p: &[f64; 2]| p[0].abs() <= 0.25 && (-0.05..=0.45).contains(&p[1]);
        if let Some([x, y]) = points.iter().find(|p| !reached(p)) {
            let allowed = "within 25 cm across, and -5 to 45 cm back";
            return refuse(format!("through [{x}, {y}] m"), allowed);
        }
        if points.windows(2).any(|w| (w[0][0] - w[1][0]).hypot(w[0][1] - w[1][1]) < 1e-3) {
            return refuse(
                "through two points at one place".into(),
                "of points 1 mm apart or more",
            );
        }
        let crossed = (0..points.len() - 1).find_map(|i| {
            let later = (i + 2..points.len() - 1)
                .find(|&j| segments_cross(points[i], points[i + 1], points[j], points[j + 1]));
            later.map(|j| (i + 1, j + 1))
        });
        match crossed {
            Some((i, j)) => {
                let value = format!("crossing itself: piece {i} crosses piece {j}");
                refuse(value, "a line that does not cross itself")
            }
            None => Ok(()),
        }
    }
}

impl RegionStyle {
    /// Checks every number against the range in which it means something.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first field that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        if self.places.is_empty() {
            let value = "nowhere".to_owned();
            return Err(InvalidSpec { field: "region.where", value, allowed: "one place or more" });
        }
        if let Some(RegionLength::Mean(length)) = self.length {
            within("region.length", length)?;
        }
        if let Some(lift) = self.lift {
            within("region.lift", lift)?;
        }
        within("region.curl", self.curl.unwrap_or(1.0))
    }
}
