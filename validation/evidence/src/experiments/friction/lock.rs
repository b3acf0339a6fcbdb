//! A lock whose hairs stick and slip as it bends, to and fro.

use frisure::rod::potential::{YieldLaw, Yielding};
use frisure::rod::{Load, NaturalStrain, Options, Rod, Root, equilibrium, equilibrium_from};
use glam::DVec3;

use super::fibre::{at_rest, fibre, options};
use crate::extremes::largest;
use crate::{Effort, Finding, Limit, Stopped, Table};

const LENGTH: f64 = 0.1;

/// Load (m/s²) so light that the lock stays straight to 1e-4 of its length, as linear theory has it.
const LIGHT: f64 = 1e-3;

/// What a level cantilever loses of the work of its load as it is bent to and fro, and the set that is left.
struct Bent {
    /// Energy lost (J) by what slips.
    lost: f64,
    /// The same by the work of the load over the cycle, by trapezia.
    work: f64,
    /// Set of the tip (m) where the load is taken off at first.
    set: f64,
}

/// A law by K_f over K and m_y over qL².
struct Case {
    stiffness: f64,
    moment: f64,
}

impl Case {
    fn law(&self, rod: &Rod) -> YieldLaw {
        let moment = self.moment * rod.weight() * LENGTH * LENGTH;
        YieldLaw { stiffness: self.stiffness * rod.stiffness().x, moment }
    }

    /// Bends the lock to the load, takes it off, bends it the other way, and back, each in so many steps.
    fn bend(&self, elements: usize, steps: u32) -> Result<Bent, Stopped> {
        let rod = |share: f64| {
            let root = Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?;
            let gravity = DVec3::NEG_Z * (LIGHT * share);
            let load = Load { gravity, ..Load::NONE };
            fibre(LENGTH, 5e-5, load, NaturalStrain::STRAIGHT, root)
        };
        let options = Options { tolerance: 1e-13, ..options(elements) };
        let (free, heavy) = (rod(0.0)?, rod(1.0)?);
        let mut rest = equilibrium(&free, &[], &options);
        let mut lock = Yielding::stuck_at(&rest.chain(), &rest.shape, |_| self.law(&heavy));
        let to = |from: f64, to: f64| {
            (1..=steps).map(move |k| from + (to - from) * f64::from(k) / f64::from(steps))
        };
        let way = to(0.0, 1.0).chain(to(1.0, 0.0)).chain(to(0.0, -1.0)).chain(to(-1.0, 1.0));
        let (mut lost, mut path, mut set) = (Vec::new(), Vec::new(), 0.0);
        for (k, share) in way.enumerate() {
            rest = equilibrium_from(&rod(share)?, &[&lock], &options, &rest);
            at_rest(&rest)?;
            lost.push(lock.follow(&rest.chain(), &rest.shape));
            // The load does work on the mean sag: q ∫ w ds is −E_g of the whole load.
            let sags = rest.shape.positions.windows(2).map(|p| -0.5 * (p[0].z + p[1].z));
            let sag = sags.sum::<f64>() * LENGTH / elements as f64;
            path.push((share * heavy.weight(), sag));
            if k + 1 == 2 * steps as usize {
                set = -rest.tip().z;
            }
        }
        // The closed loop begins and ends at the whole load.
        let from = steps as usize - 1;
        let work = path[from..].windows(2).map(|p| 0.5 * (p[0].0 + p[1].0) * (p[1].1 - p[0].1));
        Ok(Bent { lost: lost[from + 1..].iter().sum(), work: work.sum(), set })
    }

    /// The energy that is lost (J) and the set (m) of linear theory.
    fn closed_form(&self) -> Result<[f64; 2], Stopped> {
        let root = Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?;
        let rod = fibre(LENGTH, 5e-5, Load::down(LIGHT), NaturalStrain::STRAIGHT, root)?;
        let (k, q) = (rod.stiffness().x, rod.weight());
        let YieldLaw { stiffness: f, moment: m } = self.law(&rod);
        // At ξ from the tip the load has the moment qξ²/2; hairs slip where it is above M = m (K + K_f)/K_f, to (qξ²/2 − m)/K.
        let most = m * (k + f) / f;
        let from = (2.0 * most / q).sqrt();
        // To and fro an element loses 4 m (e − m/K_f) per length.
        let lost = |x: f64| 4.0 * m * (q * x.powi(3) / (6.0 * k) - x * m * (1.0 / k + 1.0 / f));
        // Taken off, the load leaves K_f (qξ²/2 − M)/(K (K + K_f)), or m/K where hairs slip back: beyond qξ²/2 = M + m (K + K_f)/K_f = 2 M.
        let back = (4.0 * most / q).sqrt().min(LENGTH);
        let left = f / (k * (k + f));
        let set = |x: f64| left * (q * x.powi(4) / 8.0 - most * x * x / 2.0);
        let slipped_back = m / k * (LENGTH * LENGTH - back * back) / 2.0;
        Ok([lost(LENGTH) - lost(from), set(back) - set(from) + slipped_back])
    }
}

/// Adds the table and criteria of the lock.
pub(super) fn add(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let case = |(stiffness, moment)| Case { stiffness, moment };
    let cases = [(4.0, 0.256), (9.0, 0.05), (50.0, 0.2), (50.0, 0.02)].map(case);
    let cases = effort.pick(&cases[..2], &cases[..]);
    let elements = 400;
    let mut table = Table::new(
        "A lock that a load bends to and fro",
        &[
            "K_f/K",
            "m_y/qL²",
            "steps",
            "lost, over the closed form",
            "by the work of the load",
            "set, over the closed form",
        ],
    );
    let (mut errors, mut sets, mut works) = (Vec::new(), Vec::new(), Vec::new());
    for case in cases {
        let [lost, set] = case.closed_form()?;
        for &steps in effort.pick(&[1][..], &[1, 4, 64]) {
            let bent = case.bend(elements, steps)?;
            let work = bent.work / lost;
            table.row([
                format!("{}", case.stiffness),
                format!("{}", case.moment),
                format!("{steps}"),
                format!("{:.6}", bent.lost / lost),
                if steps == 64 { format!("{work:.4}") } else { "–".to_owned() },
                format!("{:.6}", bent.set / set),
            ]);
            errors.push((bent.lost / lost - 1.0).abs());
            sets.push((bent.set / set - 1.0).abs());
            if steps == 64 {
                works.push((work - 1.0).abs());
            }
        }
    }
    finding.table(table);
    let limit = Limit::AtMost(1e-3);
    finding.check(
        "lock: largest relative error of the energy that is lost",
        largest(errors),
        limit,
    );
    finding.check("lock: largest relative error of the set", largest(sets), limit);
    if !works.is_empty() {
        finding.check(
            "lock: largest relative error of the work over the cycle, in 64 steps",
            largest(works),
            Limit::AtMost(0.01),
        );
    }
    Ok(())
}
