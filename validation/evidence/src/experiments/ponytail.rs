//! The ponytail of Goldstein, Warren and Ball (2012): many rods that touch against the equation of their envelope.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use frisure::hairstyle::head::{Head, ScalpSource};
use frisure::hairstyle::{
    Body, Curl, Guide, HairContact, Hairs, Hairstyle, HairstyleSpec, HeadMethod, Lift,
    PredictOptions, predict, preset, settling_report,
};
use frisure::progress::Progress;
use frisure::rod::{Equilibrium, Material, Resolution, Section};
use frisure::strands::Surface;
use glam::{DVec2, DVec3};

use crate::experiment::check;
use crate::extremes::largest;
use crate::finding::{Finding, Limit, Table};
use crate::plot::{Mark, Plot, Scale};
use crate::reference::banded::Banded;
use crate::{Effort, Experiment, Stopped};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "ponytail",
    title: "The envelope of a ponytail",
    question: "Do many hairs that push each other apart fill the envelope that elasticity, gravity and their pressure give a bundle?",
    method: "Goldstein, Warren and Ball (2012) describe a ponytail by the radius R(s) of its envelope, with \
             ℓ³ R⁗ − (L − s) R″ + R′ = Π(R), ℓ³ = EI/ρSg, where Π is the pressure with which hairs push each other apart. \
             Here 300 straight fibres, for which ℓ is 5 cm as for human hair, hang from a disc of 2 cm that is slightly domed, so that they leave it as a fan. \
             Each is the middle of a tube, and tubes repel where they overlap, as in a head of wisps. The tubes are wide and soft: some \
             twenty others are within reach of each, so that the pressure of the bundle is that of a gas of tubes, in closed form: \
             per length U = ½ I ∫ n² dA, with n hairs per area and I = 8π k D⁴/315. In a bundle that swells alike everywhere n is a \
             parabola over the section, so U = ½ I 4N²/9πq², q the root-mean-square radius; evenly filled it would be \
             ½ I N²/2πq². The equation holds for q as for R. It is solved by finite differences and compared with the fibres at rest, \
             at several lengths with one and the same pressure, as the paper did with a switch of hair that was trimmed. The paper's measured \
             pressure is not used: its numbers were not at hand.",
    run,
};

/// Radius (m) of the disc and of the sphere that it is cut from.
const DISC: f64 = 0.01;
const DOME: f64 = 0.10;

/// Fibres, and their radius (m).
const FIBRES: usize = 300;
const FIBRE: f64 = 75e-6;

/// Radius (m) of a tube and stiffness (Pa) of tubes: soft, and so wide that each has many others within reach.
const TUBE: f64 = 2.5e-3;
const STIFFNESS: f64 = 0.004;

/// A ball (m) whose lowest part has hair.
fn dome() -> Result<Head, Stopped> {
    const RINGS: usize = 180;
    const AROUND: usize = 96;
    let point = |i: usize, j: usize| {
        let (polar, turn) = (PI * i as f64 / RINGS as f64, TAU * j as f64 / AROUND as f64);
        DVec3::new(polar.sin() * turn.cos(), polar.sin() * turn.sin(), -polar.cos()) * DOME
    };
    let mut positions = vec![point(0, 0), point(RINGS, 0)];
    let ring = |i: usize, j: usize| (2 + (i - 1) * AROUND + j % AROUND) as u32;
    for i in 1..RINGS {
        positions.extend((0..AROUND).map(|j| point(i, j)));
    }
    let mut triangles = Vec::new();
    for j in 0..AROUND {
        triangles.push([0, ring(1, j + 1), ring(1, j)]);
        triangles.push([1, ring(RINGS - 1, j), ring(RINGS - 1, j + 1)]);
        for i in 1..RINGS - 1 {
            let [a, b, c, d] = [ring(i, j), ring(i, j + 1), ring(i + 1, j + 1), ring(i + 1, j)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let hair = |p: &DVec3| f64::from(u8::from(p.z < 0.0 && p.truncate().length() < DISC));
    let weights = positions.iter().map(hair).collect();
    let other = |e: &dyn std::fmt::Display| Stopped::Other(e.to_string());
    let surface = Surface::new(positions, triangles).map_err(|e| other(&e))?;
    Head::from_surface(surface, ScalpSource::Weights(weights)).map_err(|e| other(&e))
}

/// Fibres of a length (m) that hang from the dome.
fn tail(length: f64, stiffness: f64) -> Result<HairstyleSpec, Stopped> {
    let preset = preset("caucasian-straight");
    let mut spec = preset.ok_or_else(|| Stopped::Other("no such preset".to_owned()))?.spec();
    spec.fibre.section = Section::circular(FIBRE)?;
    (spec.fibre.variation, spec.fibre.axis_ratio_variation) = (0.0, 0.0);
    spec.fibre.material = Material::new(1.2e9, 0.4e9, 1300.0)?;
    spec.curl = Curl::STRAIGHT;
    (spec.length.mean, spec.length.variation_between) = (length, 0.0);
    (spec.implantation.lift, spec.implantation.jitter) = (Lift::Uniform(FRAC_PI_2), 0.0);
    (spec.implantation.hold, spec.implantation.baby_hairs) = (0.0, 0.0);
    (spec.wisps.count, spec.wisps.hairs) = (FIBRES, Hairs::Count(FIBRES));
    spec.contact.body = Body::None;
    spec.contact.hair = HairContact::Wisps;
    spec.contact.hair_stiffness = stiffness;
    spec.contact.volume = 10.0;
    // As many hairs to a tube as make it so wide.
    let hairs = (TUBE / spec.contact.volume).powi(2) * PI / (12.0_f64.sqrt() * FIBRE * FIBRE);
    spec.implantation.density = hairs * FIBRES as f64 / (PI * DISC * DISC);
    spec.equilibrium.method = HeadMethod::Sweeps;
    spec.equilibrium.tolerance = 1e-5;
    spec.equilibrium.resolution = Resolution::Elements(40);
    Ok(spec)
}

/// Root-mean-square distance (m) of fibres from their middle at a share of their length.
fn spread(tail: &Hairstyle, share: f64) -> f64 {
    let at = |e: &Equilibrium| e.at(&e.chain(), share).0.truncate();
    let points: Vec<_> = tail.equilibria().iter().map(at).collect();
    let count = points.len() as f64;
    let middle = points.iter().sum::<DVec2>() / count;
    (points.iter().map(|p| p.distance_squared(middle)).sum::<f64>() / count).sqrt()
}

/// The envelope equation of a tail, for its root-mean-square radius q.
struct Envelope {
    /// EI (N m²), weight per length (N/m), length (m).
    bending: f64,
    weight: f64,
    length: f64,
    /// q (m) and its slope where the tail begins.
    start: [f64; 2],
    /// c(s) (N m²) of the pressure Π = c/q³, at the points of [`Self::solve`].
    pressure: Vec<f64>,
}

/// Pieces of the finite differences. With twice as many q changes by less than 1e-5 of itself.
const PIECES: usize = 400;

impl Envelope {
    /// The envelope of a tail whose fibres fill it as `filling` says: U = ½ I N² filling / q².
    fn new(tail: &Hairstyle, filling: f64) -> Self {
        let guides = tail.guides();
        let rod = &guides[0].rod;
        let q = spread(tail, 0.0);
        // The slope at the root that is in proportion to the distance from the axis.
        let outwards =
            |g: &Guide| g.root.position.truncate().dot(g.rod.spec().root.frame().z_axis.truncate());
        let slope = guides.iter().map(outwards).sum::<f64>() / (guides.len() as f64 * q);
        let length = rod.length();
        let pressure = |k: usize| {
            let reach = 2.0 * guides[0].thickness.at(length * k as f64 / PIECES as f64);
            let gas = 8.0 * PI * tail.spec().contact.hair_stiffness * reach.powi(4) / 315.0;
            // −dU/dq per fibre.
            gas * guides.len() as f64 * filling
        };
        let pressure = (0..=PIECES).map(pressure).collect();
        Self {
            bending: rod.stiffness().x,
            weight: rod.weight(),
            length,
            start: [q, slope],
            pressure,
        }
    }

    /// q (m) at equal steps: least energy ½ EI q″² + ½ w (L − s) q′² + c/2q², by Newton's method. It is convex.
    fn solve(&self) -> Option<Vec<f64>> {
        let (n, h) = (PIECES, self.length / PIECES as f64);
        let [first, slope] = self.start;
        let mut q = vec![first; n + 1];
        for _ in 0..100 {
            let mut gradient = vec![0.0; n + 1];
            let mut hessian = vec![[0.0; 5]; n + 1];
            // A quadratic term ½ a (Σ cᵢ q[kᵢ] − b)².
            let mut add = |a: f64, terms: &[(usize, f64)], b: f64| {
                let value = terms.iter().map(|(k, c)| c * q[*k]).sum::<f64>() - b;
                for &(i, c) in terms {
                    gradient[i] += a * c * value;
                    for &(j, d) in terms {
                        hessian[i][j + 2 - i] += a * c * d;
                    }
                }
            };
            // The clamp: a point before the root that has the slope.
            let bend = self.bending * h;
            add(0.5 * bend, &[(0, -2.0 / (h * h)), (1, 2.0 / (h * h))], 2.0 * slope / h);
            for k in 1..n {
                let second = [(k - 1, 1.0 / (h * h)), (k, -2.0 / (h * h)), (k + 1, 1.0 / (h * h))];
                add(bend, &second, 0.0);
            }
            for k in 0..n {
                let tension = self.weight * (self.length - (k as f64 + 0.5) * h);
                add(tension * h, &[(k, -1.0 / h), (k + 1, 1.0 / h)], 0.0);
            }
            for k in 0..=n {
                let c = self.pressure[k] * if k == n { 0.5 * h } else { h };
                gradient[k] -= c / q[k].powi(3);
                hessian[k][2] += 3.0 * c / q[k].powi(4);
            }
            let mut matrix = Banded::new(n + 1);
            matrix.set(0, 0, 1.0);
            for (i, row) in hessian.iter().enumerate().skip(1) {
                for (d, value) in row.iter().enumerate() {
                    if let Some(j) = (i + d).checked_sub(2).filter(|j| *j <= n) {
                        matrix.set(i, j, *value);
                    }
                }
            }
            gradient[0] = 0.0;
            let step = matrix.solve(gradient)?;
            // c/q³ changes as the fourth power of the length of a step: no longer ones than by half.
            let far = largest(step.iter().zip(&q).map(|(step, q)| step.abs() / q));
            let share = (0.5 / far).min(1.0);
            q.iter_mut().zip(&step).for_each(|(q, step)| *q -= share * step);
            if far < 1e-12 {
                return Some(q);
            }
        }
        None
    }
}

/// Shares of the length at which fibres and envelope are compared.
fn shares() -> impl Iterator<Item = f64> {
    (1..=20).map(|k| f64::from(k) / 20.0)
}

/// A bundle at rest beside its envelope.
struct Beside {
    /// q (m) of the fibres at each of [`shares`].
    found: Vec<f64>,
    /// q (m) of the envelope's equation, and of one that is evenly filled, at equal steps.
    solved: Vec<f64>,
    even: Vec<f64>,
    /// Length over ℓ.
    slenderness: f64,
    /// Fibres that are not at rest.
    moving: usize,
}

impl Beside {
    fn new(
        head: &Head,
        length: f64,
        stiffness: f64,
        progress: &dyn Progress,
    ) -> Result<Self, Stopped> {
        let tail = predict(&tail(length, stiffness)?, head, PredictOptions::default(), progress)?;
        let none = || Stopped::Other("the envelope's equation was not solved".to_owned());
        let envelope = Envelope::new(&tail, 4.0 / (9.0 * PI));
        let report = settling_report(&tail, head);
        Ok(Self {
            found: shares().map(|share| spread(&tail, share)).collect(),
            solved: envelope.solve().ok_or_else(none)?,
            even: Envelope::new(&tail, 0.5 / PI).solve().ok_or_else(none)?,
            slenderness: length / (envelope.bending / envelope.weight).cbrt(),
            moving: report.guides - report.stable,
        })
    }

    /// q (m) of the envelope's equation at a share of the length.
    fn at(&self, share: f64) -> f64 {
        self.solved[(share * PIECES as f64).round() as usize]
    }

    /// Largest relative difference of the fibres from the envelope.
    fn difference(&self) -> f64 {
        largest(
            shares().zip(&self.found).map(|(share, found)| (found / self.at(share) - 1.0).abs()),
        )
    }

    /// Cells of a table: q (mm) at the tip, and the difference.
    fn cells(&self) -> [String; 4] {
        let tip = [self.found[self.found.len() - 1], self.at(1.0), self.even[PIECES]];
        let [found, solved, even] = tip.map(|q| format!("{:.3}", 1e3 * q));
        [found, solved, even, format!("{:.2} %", 100.0 * self.difference())]
    }
}

/// Titles of [`Beside::cells`].
const CELLS: [&str; 4] = [
    "q at the tip (mm)",
    "of the envelope (mm)",
    "of one evenly filled (mm)",
    "largest relative difference",
];

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    let head = dome()?;
    let lengths: &[f64] = effort.pick(&[0.20], &[0.05, 0.10, 0.15, 0.20, 0.25]);
    let firmer: &[f64] = effort.pick(&[], &[4.0, 16.0]);
    let cases = (lengths.len() + firmer.len()) as f64;
    let [tip, solved, even, differs] = CELLS;
    let mut table = Table::new(
        "Bundles that differ in length alone",
        &["length (cm)", "length over ℓ", tip, solved, even, differs],
    );
    let mut plot = Plot::new(
        "Root-mean-square radius of a ponytail: fibres (points) and envelope (lines)",
        "distance from the tie (cm)",
        "mm",
        [Scale::Linear; 2],
    );
    let mut differences = Vec::new();
    let mut moving = 0;
    for (k, &length) in lengths.iter().enumerate() {
        check(progress, EXPERIMENT.name, k as f64 / cases)?;
        let beside = Beside::new(&head, length, STIFFNESS, progress)?;
        let cells = [format!("{:.0}", 100.0 * length), format!("{:.2}", beside.slenderness)];
        table.row(cells.into_iter().chain(beside.cells()));
        let at = |share: f64| 100.0 * share * length;
        let line = (0..=PIECES).map(|k| k as f64 / PIECES as f64);
        let name = format!("{:.0} cm", 100.0 * length);
        let line = line.map(|x| (at(x), 1e3 * beside.at(x)));
        plot.add(&name, Mark::Line, line).colour = Some(k);
        let points = shares().zip(&beside.found).map(|(x, q)| (at(x), 1e3 * q));
        plot.add("", Mark::Points, points).colour = Some(k);
        differences.push(beside.difference());
        moving += beside.moving;
    }
    finding.table(table);
    finding.plot(plot);
    if !firmer.is_empty() {
        let mut table = Table::new(
            "Firmer tubes swell more, so that fewer are within reach of each (20 cm)",
            &["stiffness over that above", tip, solved, even, differs],
        );
        for (k, &factor) in firmer.iter().enumerate() {
            check(progress, EXPERIMENT.name, (lengths.len() + k) as f64 / cases)?;
            let beside = Beside::new(&head, 0.20, factor * STIFFNESS, progress)?;
            table.row([format!("{factor:.0}")].into_iter().chain(beside.cells()));
            moving += beside.moving;
        }
        finding.table(table);
    }
    finding.check(
        "largest relative difference of the radius from the envelope's",
        largest(differences),
        Limit::AtMost(0.03),
    );
    finding.check("fibres that are not at rest", moving as f64, Limit::AtMost(0.0));
    Ok(finding)
}
