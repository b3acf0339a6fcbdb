//! The report of a hairstyle and its drawn hairs.

use frisure::hairstyle::contact::Thickness;
use frisure::hairstyle::{
    Body, Contact, DrawnHair, HairContact, Hairstyle, InteractionForm, JointCertificate,
    SettlingReport, Simulation, StrandCertificate, Volume, WetLockSizes, volume,
};
use frisure::rod::{Energy, Equilibrium};
use frisure::strands::Strands;
use serde::Serialize;

use super::StepReport;
use crate::adoption::AdoptionReport;
use crate::replicas::ReplicaReport;
use crate::runner::LoadedScene;

/// A hairstyle and its drawn hairs in numbers; SI units. No time and no machine: the same scene gives the same bytes.
#[derive(Clone, Debug, Serialize)]
pub struct HairstyleReport {
    /// Name of the scene; may be empty.
    pub scene: String,
    /// What was guessed of the head, and warnings about it, a line each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub head_notes: Vec<String>,
    /// Name of the hair type.
    pub hair_type: &'static str,
    /// Seed of all randomness.
    pub seed: u64,
    /// How the guides came to rest.
    pub guides: GuideReport,
    /// How well the scene's groom keeps its shape; none without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub groom: Option<AdoptionReport>,
    /// The models of contact.
    pub contact: ContactReport,
    /// Means over wisps, half-way along.
    pub thickness: ThicknessReport,
    /// The locks of wet hair, with `wetting = "capillary"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wet_locks: Option<WetLockReport>,
    /// Energies of all guides.
    pub energy: EnergyReport,
    /// Number of drawn hairs.
    pub hairs: usize,
    /// Points of the drawn hairs.
    pub points: usize,
    /// How the drawn hairs came to rest; none if they are interpolated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub simulated: Option<SimulationReport>,
    /// Deepest that a drawn hair is inside the head (m), if it was measured.
    pub hair_penetration: Option<f64>,
    /// How much shorter than they are guides are drawn by lines through as many points as hairs have; none if all are within a twentieth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coarse_lines: Option<CoarseLines>,
    /// Space that the drawn hairs take, if it was measured.
    pub volume: Option<VolumeReport>,
    /// Smallest and largest corner of the box around the hair (m); none without hairs.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// Mass of all hair that grows on the head, and of the water in it (kg).
    pub mass: f64,
    /// The steps in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<StepReport>,
}

/// Depth in the head above which hair is inside it (m). Chosen: some hairs thick, as deep as contact that yields lets a
/// guide sink.
pub const DEEP: f64 = 5e-4;

/// Hair that winds so tightly that the points of its lines do not follow it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CoarseLines {
    /// Guides whose lines are too short by more than a twentieth.
    pub guides: usize,
    /// Length of the line that is shortest, over that of its guide.
    pub shortest: f64,
    /// Points with which all lines are within a twentieth.
    pub points: usize,
}

impl CoarseLines {
    /// Share of its length that a line may lack. Chosen: what is seen.
    const LACKING: f64 = 0.05;
    /// Most points of a line that are tried.
    const MOST_POINTS: usize = 2000;

    fn of(hairstyle: &Hairstyle) -> Option<Self> {
        let drawn = |guide: &Equilibrium, points: usize| {
            let line = guide.centre_line(points.max(2));
            line.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() / guide.rod.length()
        };
        let points = hairstyle.spec().wisps.points;
        let guides = hairstyle.equilibria();
        let shares: Vec<f64> = guides.iter().map(|guide| drawn(guide, points)).collect();
        let coarse = |share: f64| share < 1.0 - Self::LACKING;
        let shortest = shares.iter().copied().fold(1.0, f64::min);
        let worst = guides.iter().zip(&shares).min_by(|a, b| a.1.total_cmp(b.1))?.0;
        let more = |points: &usize| Some((points + points / 2).min(Self::MOST_POINTS));
        let enough = std::iter::successors(Some(points), more)
            .find(|&points| points >= Self::MOST_POINTS || !coarse(drawn(worst, points)))?;
        let count = shares.iter().filter(|share| coarse(**share)).count();
        (count > 0).then_some(Self { guides: count, shortest, points: enough })
    }
}

/// How guides came to rest.
#[derive(Clone, Debug, Serialize)]
pub struct GuideReport {
    /// Number of guides.
    pub count: usize,
    /// Those at a minimum of their energy.
    pub stable: usize,
    /// Those at a saddle of their energy.
    pub saddles: usize,
    /// Those at a minimum or a saddle, which their divisions cannot tell apart.
    pub undecided: usize,
    /// Those that did not converge.
    pub not_converged: usize,
    /// Those whose division misses a requested accuracy, measured without contact.
    pub accuracy_missed: usize,
    /// Elements of all guides.
    pub elements: usize,
    /// Iterations of the minimiser of all guides.
    pub iterations: usize,
    /// Sweeps over all guides in which wisps made way for each other.
    pub sweeps: usize,
    /// Largest relative gradient.
    pub gradient_norm: f64,
    /// The relative gradient at which guides in contact count as converged.
    pub tolerance: f64,
    /// Deepest that a guide is inside the head (m).
    pub penetration: f64,
    /// The first that holds of `"not converged"`, `"on a saddle"`, `"undecided"` (perhaps on a saddle), `"inside the head"` (a
    /// penetration above [`DEEP`]), `"accuracy missed"` (the requested one, or the default) and `"at rest"`.
    pub status: &'static str,
    /// What was checked of all guides together, with `contact.hair = "density"` or `equilibrium.method = "continuation"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<JointReport>,
    /// What friction holds; none if hair slides freely.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<FrictionReport>,
    /// How far guides move in replicas of the hairstyle, if any were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replicas: Option<ReplicaReport>,
}

/// What friction holds. With friction, where hair rests depends on how it got there.
#[derive(Clone, Debug, Serialize)]
pub struct FrictionReport {
    /// Coefficient of hair against hair.
    pub hair: f64,
    /// Coefficient of hair against skin.
    pub skin: f64,
    /// Largest friction of any contact over the most that its normal force allows: 1 where it slips, more by what normal
    /// forces and shapes do not agree.
    pub largest_ratio: f64,
    /// How the hairs inside wisps hold as these bend; none if they slide freely.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub locks: Option<LockReport>,
    /// How the hair came to where it rests.
    pub history: &'static str,
}

/// How the hairs inside wisps hold as these bend.
#[derive(Clone, Debug, Serialize)]
pub struct LockReport {
    /// Coefficient of friction of hairs inside a wisp.
    pub friction: f64,
    /// Largest moment that they carry over that at which they slip: at most 1.
    pub largest_ratio: f64,
    /// Share of the length of wisps, in the mean, that carries as much as it can: there they would slip on, or slipped last.
    pub slipping: f64,
}

/// What was checked of all guides of a head together.
#[derive(Clone, Debug, Serialize)]
pub struct JointReport {
    /// Whether they are at rest at a minimum of the energy of the head.
    pub stable: bool,
    /// Largest derivative of the energy of the head, relative to the moment scale of its guide.
    pub gradient_norm: f64,
    /// Lowest eigenvalue of the second variation of the head, relative to that of its guides one by one; none if a guide is
    /// at no minimum by itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lowest_eigenvalue: Option<f64>,
    /// Residual of that eigenvalue.
    pub eigenvalue_error: f64,
}

/// The models of contact, as scenes name them.
#[derive(Clone, Debug, Serialize)]
pub struct ContactReport {
    /// Hair against the body.
    pub body: &'static str,
    /// Hair against hair.
    pub hair: &'static str,
}

/// The cross section of wisps.
#[derive(Clone, Debug, Serialize)]
pub struct ThicknessReport {
    /// Packed radius (m).
    pub radius: f64,
    /// Fraction of a wisp that is hair.
    pub packing: f64,
}

/// Locks of wet hair at three quarters of its length, by the law of capillarity.
#[derive(Clone, Debug, Serialize)]
pub struct WetLockReport {
    /// Number of wet hairs on the head.
    pub hairs: f64,
    /// Hairs of a lock; 1 where hair forms none.
    pub hairs_per_lock: f64,
    /// Radius of a lock (m).
    pub radius: f64,
    /// Distance (m) from the roots at which two hairs meet; none if they do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meeting: Option<f64>,
}

impl From<WetLockSizes> for WetLockReport {
    fn from(WetLockSizes { hairs, hairs_per_lock, radius, meeting }: WetLockSizes) -> Self {
        Self { hairs, hairs_per_lock, radius, meeting }
    }
}

/// Energies (J).
#[derive(Clone, Debug, Serialize)]
pub struct EnergyReport {
    /// Elastic energy.
    pub elastic: f64,
    /// Energy of gravity.
    pub gravity: f64,
    /// Energy of contact.
    pub contact: f64,
    /// Their sum.
    pub total: f64,
}

/// How simulated hairs came to rest.
#[derive(Clone, Debug, Serialize)]
pub struct SimulationReport {
    /// Number of hairs.
    pub hairs: usize,
    /// Those at a minimum of their energy.
    pub stable: usize,
    /// Elements of all hairs.
    pub elements: usize,
    /// Iterations of the minimiser of all hairs.
    pub iterations: usize,
    /// Contact of the hairs with each other, if they push each other. `stable` is then where that begins: each hair in its tube.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<StrandContactReport>,
}

/// Contact of simulated hairs with each other, and how near to rest they are together. Whether the shape is a minimum in all
/// directions is not checked.
#[derive(Clone, Debug, Serialize)]
pub struct StrandContactReport {
    /// How hairs act on each other: "contacts", or "density", a volume without friction.
    pub form: &'static str,
    /// Hairs in contact with each other.
    pub hairs: usize,
    /// How many hairs that grow each of them stands for.
    pub represented: f64,
    /// Points of a hair that touch another hair.
    pub contacts: usize,
    /// Hairs in balance: with a gradient of at most 1e-5.
    pub balanced: usize,
    /// Largest gradient of a hair in the energy of all, relative to ρSgL² + EI/L.
    pub largest_gradient: f64,
    /// Root mean square of the largest gradient of each hair.
    pub rms_gradient: f64,
    /// Deepest overlap of two hairs over their contact distance.
    pub deepest_overlap: f64,
    /// Largest tangential force over friction limit of contacts that bear more than a tenth of the mean; 0 without friction.
    pub friction_ratio: f64,
    /// Change of the friction limits at the last search for contacts over their sum; 0 without friction.
    pub friction_change: f64,
    /// Sum of all forces between hairs over the sum of their magnitudes.
    pub imbalance: f64,
    /// Iterations on all hairs together.
    pub iterations: usize,
}

impl From<StrandCertificate> for StrandContactReport {
    fn from(certificate: StrandCertificate) -> Self {
        let StrandCertificate {
            form,
            strands: hairs,
            represented,
            contacts,
            balanced,
            largest_gradient,
            rms_gradient,
            deepest_overlap,
            friction_ratio,
            friction_change,
            imbalance,
            iterations,
        } = certificate;
        Self {
            form: match form {
                InteractionForm::Contacts => "contacts",
                InteractionForm::Density => "density",
            },
            hairs,
            represented,
            contacts,
            balanced,
            largest_gradient,
            rms_gradient,
            deepest_overlap,
            friction_ratio,
            friction_change,
            imbalance,
            iterations,
        }
    }
}

/// Space that drawn hairs take.
#[derive(Clone, Debug, Serialize)]
pub struct VolumeReport {
    /// The region that they occupy, air between hairs included (m³).
    pub region: f64,
    /// The hairs themselves, for as many as grow (m³).
    pub hair: f64,
    /// Side of the cells over which hair was averaged (m).
    pub cell: f64,
}

impl LoadedScene {
    /// The report of the hairstyle, and of its drawn hairs if there are some.
    #[must_use]
    pub fn report(&self, drawn: Option<&DrawnHair>) -> HairstyleReport {
        let (spec, metrics) = (self.hairstyle.spec(), self.metrics());
        let strands = drawn.map(|drawn| &drawn.strands);
        let bounds = strands.and_then(Strands::bounds);
        let simulation = drawn.map(|drawn| drawn.simulation).filter(|s| s.hairs > 0);
        HairstyleReport {
            scene: self.scene.name.clone(),
            head_notes: self.note.iter().flat_map(|note| note.lines()).map(str::to_owned).collect(),
            hair_type: self.scene.hair_type,
            seed: spec.seed,
            guides: GuideReport {
                friction: friction(&self.hairstyle, &metrics.settling),
                ..GuideReport::new(&metrics.settling, spec.equilibrium.tolerance)
            },
            groom: self.adoption.clone(),
            contact: ContactReport { body: body(spec.contact.body), hair: hair(spec.contact.hair) },
            thickness: thickness(&self.hairstyle),
            wet_locks: self.hairstyle.wet_locks().map(WetLockReport::from),
            energy: EnergyReport::from(metrics.settling.energy),
            hairs: strands.map_or(0, Strands::len),
            points: strands.map_or(0, |strands| strands.points().len()),
            simulated: simulation.map(|simulation| {
                let Simulation { hairs, at_rest, elements, iterations, contact } = simulation;
                let contact = contact.map(StrandContactReport::from);
                SimulationReport { hairs, stable: at_rest, elements, iterations, contact }
            }),
            hair_penetration: None,
            coarse_lines: strands.and_then(|_| CoarseLines::of(&self.hairstyle)),
            volume: strands.map(|strands| {
                let Volume { region, hair, cell } =
                    volume(strands, &self.head, self.hairstyle.grown());
                VolumeReport { region, hair, cell }
            }),
            bounds: bounds.map(|(low, high)| [low.to_array(), high.to_array()]),
            mass: metrics.mass,
            steps: Vec::new(),
        }
    }
}

impl GuideReport {
    fn new(settling: &SettlingReport, tolerance: f64) -> Self {
        Self {
            count: settling.guides,
            stable: settling.stable,
            saddles: settling.saddles,
            undecided: settling.undecided,
            not_converged: settling.not_converged,
            accuracy_missed: settling.accuracy_missed,
            elements: settling.elements,
            iterations: settling.iterations,
            sweeps: settling.sweeps,
            gradient_norm: settling.gradient_norm,
            tolerance,
            penetration: settling.penetration,
            status: status(settling),
            joint: settling.joint.map(JointReport::from),
            friction: None,
            replicas: None,
        }
    }
}

/// The status of guides: the first that holds of those of [`GuideReport::status`].
#[must_use]
pub fn status(settling: &SettlingReport) -> &'static str {
    match settling {
        SettlingReport { not_converged: 1.., .. } => "not converged",
        SettlingReport { saddles: 1.., .. } => "on a saddle",
        SettlingReport { undecided: 1.., .. } => "undecided",
        settling if settling.penetration > DEEP => "inside the head",
        SettlingReport { accuracy_missed: 1.., .. } => "accuracy missed",
        _ => "at rest",
    }
}

/// What friction holds of a hairstyle; none without friction.
fn friction(hairstyle: &Hairstyle, settling: &SettlingReport) -> Option<FrictionReport> {
    let contact = hairstyle.spec().contact;
    let Contact { friction: hair, skin_friction: skin, lock_friction: lock, .. } = contact;
    let locks = (lock > 0.0).then_some(LockReport {
        friction: lock,
        largest_ratio: settling.lock.ratio,
        slipping: settling.lock.slipping,
    });
    let history = history(contact.hair, hairstyle.is_styled(), locks.is_some());
    let largest_ratio = settling.friction;
    let any = hair > 0.0 || skin > 0.0 || lock > 0.0;
    any.then_some(FrictionReport { hair, skin, largest_ratio, locks, history })
}

/// How hair came to where it rests; `locks`: whether the hairs inside wisps stick.
fn history(model: HairContact, styled: bool, locks: bool) -> &'static str {
    match (model, styled, locks) {
        (_, true, false) => {
            "the prediction, then the steps in their order, each from where hair lay, held by friction"
        }
        (_, true, true) => {
            "the prediction, then the steps in their order, each from where hair lay, held by friction; hairs inside wisps stuck where \
             it came to rest or was last washed, and slipped as it bent since"
        }
        (HairContact::Wisps, false, false) => {
            "each guide alone, gravity turned on without friction; then all wisps pressed together, with friction"
        }
        (HairContact::Wisps, false, true) => {
            "each guide alone, gravity turned on without friction; then hairs inside wisps stick, and all wisps are pressed together, with \
             friction"
        }
        (HairContact::None | HairContact::Layers, false, false) => {
            "gravity turned on without friction"
        }
        (HairContact::None | HairContact::Layers, false, true) => {
            "gravity turned on without friction; then hairs inside wisps stick"
        }
        (HairContact::Density, false, false) => {
            "each guide alone, gravity turned on without friction; then all guides pressed together, with friction on the bed"
        }
        (HairContact::Density, false, true) => {
            "each guide alone, gravity turned on without friction; then hairs inside wisps stick, and all guides are pressed together, with \
             friction on the bed"
        }
    }
}

impl From<JointCertificate> for JointReport {
    fn from(certificate: JointCertificate) -> Self {
        Self {
            stable: certificate.stable,
            gradient_norm: certificate.gradient_norm,
            lowest_eigenvalue: certificate.lowest_eigenvalue,
            eigenvalue_error: certificate.eigenvalue_error,
        }
    }
}

impl From<Energy> for EnergyReport {
    fn from(energy: Energy) -> Self {
        Self {
            elastic: energy.elastic,
            gravity: energy.gravity,
            contact: energy.external,
            total: energy.total(),
        }
    }
}

fn body(body: Body) -> &'static str {
    match body {
        Body::None => "none",
        Body::Spheres => "spheres",
        Body::SignedDistance => "signed-distance",
    }
}

fn hair(hair: HairContact) -> &'static str {
    match hair {
        HairContact::None => "none",
        HairContact::Layers => "layers",
        HairContact::Wisps => "wisps",
        HairContact::Density => "density",
    }
}

fn thickness(hairstyle: &Hairstyle) -> ThicknessReport {
    let guides = hairstyle.guides();
    let mean = |of: fn(&Thickness, f64) -> f64| {
        let sum: f64 = guides.iter().map(|g| of(&g.thickness, 0.5 * g.rod.length())).sum();
        sum / guides.len().max(1) as f64
    };
    ThicknessReport { radius: mean(Thickness::packed), packing: mean(Thickness::packing) }
}
