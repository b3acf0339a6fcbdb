//! The shapes of a suspended curly hair.

use frisure::rod::{Stability, equilibrium};
use glam::DVec3;
use rayon::prelude::*;

use super::buckling::hanging_curl;
use super::curls::turns;
use super::plane::{first, hook_leaves, reference_leaves};
use crate::plot::{Mark, Plot, Scale};
use crate::rods::{LENGTH, to_accuracy};
use crate::{Effort, Experiment, Finding, Limit, Monitor, Stopped, Table};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "suspended",
    title: "The shapes of a suspended curly hair (Miller et al. 2014)",
    question: "Does a naturally curved hair that hangs from a vertical clamp take the three shapes that Miller, \
        Lazarus, Audoly and Reis found (planar curl, helix near the tip, helix all along), each where it must?",
    method: "A round rod (GJ/EI = 2/3), its natural shape a circle of curvature κ, hangs from a clamp that \
        points down. Two numbers remain: κL and Γ = ρSgL³/EI. We have the abstract of the paper, not its \
        diagram, and so compute the borders ourselves: the plane is left where Morse's index of the planar \
        solution of the boundary-value problem turns from 0 to 1.\n\n\
        Out of the plane and far from the clamp, each piece hangs under the tension T = ρSg(L − s) of what is \
        below it. A helix that winds about the vertical at the angle θ has the least energy of bending, twist \
        and tension for T/EIκ² = b cos θ/(b − (b − 1) cos²θ)², b = EI/GJ (from ½EI(Ω sin θ − κ)² + ½GJ(Ω cos θ)² − \
        T cos θ, first by Ω). It is straight for T ≥ bEIκ²: the helix reaches up to bκ²EI/ρSg from the tip, and \
        through the whole hair where Γ < b(κL)². The height of the hair is the integral of cos θ. These \
        closed forms know nothing of clamp and tip, which spoil about a turn each.",
    run,
};

/// EI/GJ of the rods.
const B: f64 = 1.5;

/// The cosine of the angle at which a curl of κL hangs under a tension T L²/EI.
fn cosine(tension: f64, kappa: f64) -> f64 {
    let ratio = tension / kappa.powi(2);
    if ratio >= B {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let c: f64 = 0.5 * (low + high);
        if B * c / (B - (B - 1.0) * c * c).powi(2) < ratio {
            low = c;
        } else {
            high = c;
        }
    }
    0.5 * (low + high)
}

/// Height over length by the closed form.
fn height(gamma: f64, kappa: f64) -> f64 {
    let n = 2000;
    (0..n).map(|i| cosine(gamma * (f64::from(i) + 0.5) / f64::from(n), kappa)).sum::<f64>()
        / f64::from(n)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Planar,
    Local,
    Global,
}

/// A hair of the diagram.
struct Hung {
    gamma: f64,
    kappa: f64,
    line: Vec<DVec3>,
    stable: bool,
}

impl Hung {
    fn new(gamma: f64, kappa: f64) -> Result<Self, Stopped> {
        let rod = hanging_curl(gamma, kappa).rod()?;
        let found = equilibrium(&rod, &[], &to_accuracy(&rod, 1e-4));
        let line = found.centre_line(2001).iter().map(|p| *p / LENGTH).collect();
        let stable = found.certificate.stability == Stability::Stable;
        Ok(Self { gamma, kappa, line, stable })
    }

    fn leaves(&self) -> bool {
        self.line.iter().any(|p| p.y.abs() > 1e-3)
    }

    /// The helix is global if the tangents of the upper tenth of the hair still wind.
    fn phase(&self) -> Phase {
        let upper = &self.line[100..500];
        let descent = (upper[0].z - upper[upper.len() - 1].z) * 2000.0 / (upper.len() - 1) as f64;
        match self.leaves() {
            false => Phase::Planar,
            true if descent < 0.95 => Phase::Global,
            true => Phase::Local,
        }
    }
}

fn run(effort: Effort, monitor: &dyn Monitor) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    shapes(&mut finding)?;
    super::check(monitor, "suspended", 0.1)?;
    helices(&mut finding)?;
    super::check(monitor, "suspended", 0.2)?;
    diagram(&mut finding, effort, monitor)?;
    Ok(finding)
}

/// One hair of each kind.
fn shapes(finding: &mut Finding) -> Result<(), Stopped> {
    let kinds = [
        ("planar curl", 30.0, 4.0),
        ("helix near the tip", 3000.0, 32.0),
        ("helix all along", 1000.0, 45.0),
    ];
    let wanted = [Phase::Planar, Phase::Local, Phase::Global];
    let mut plot = Plot::new(
        "Three hairs, seen from the front and from the side",
        "over the length",
        "height over the length",
        [Scale::Linear; 2],
    );
    plot.equal = true;
    plot.size = [640.0, 460.0];
    let mut right = 0;
    for (i, (name, gamma, kappa)) in kinds.into_iter().enumerate() {
        let hung = Hung::new(gamma, kappa)?;
        right += usize::from(hung.phase() == wanted[i]);
        let at = 0.55 * i as f64;
        let name = format!("{name}: Γ = {gamma}, κL = {kappa}");
        plot.add(&name, Mark::Line, hung.line.iter().map(|p| (at + p.x, p.z))).colour = Some(i);
        plot.add("", Mark::Line, hung.line.iter().map(|p| (at + 0.25 + p.y, p.z))).colour = Some(i);
    }
    finding.plot(plot);
    finding.judge(
        "of three hairs, those with the shape expected",
        right as f64,
        Limit::AtLeast(3.0),
    );
    Ok(())
}

/// Angles and heights against the closed form.
fn helices(finding: &mut Finding) -> Result<(), Stopped> {
    let mut plot = Plot::new(
        "How steeply a curl descends, turn by turn",
        "arc length over length",
        "descent over arc length",
        [Scale::Linear; 2],
    );
    let mut table = Table::new(
        "Height of a hanging curl over its length",
        &["κL", "Γ", "turns of the natural circle", "closed form", "frisure", "difference"],
    );
    let (mut worst, mut angle) = (0.0_f64, 0.0_f64);
    for (i, (kappa, gamma)) in
        [(60.0, 2000.0), (60.0, 8000.0), (120.0, 6000.0), (120.0, 20_000.0)].into_iter().enumerate()
    {
        let hung = Hung::new(gamma, kappa)?;
        let tip = -hung.line[hung.line.len() - 1].z;
        let exact = height(gamma, kappa);
        worst = worst.max((tip - exact).abs());
        let name = format!("κL = {kappa}, Γ = {gamma}");
        let steps = (0..=100).map(|k| f64::from(k) / 100.0);
        plot.add(&name, Mark::Line, steps.map(|s| (s, cosine(gamma * (1.0 - s), kappa)))).colour =
            Some(i);
        let turns = turns(&hung.line);
        // The first turns at either end belong to clamp and tip.
        for turn in turns.iter().skip(1).filter(|t| t.middle > 0.1) {
            angle = angle.max((turn.descent - cosine(gamma * (1.0 - turn.middle), kappa)).abs());
        }
        plot.add("", Mark::Points, turns.iter().map(|t| (t.middle, t.descent))).colour = Some(i);
        table.row([
            format!("{kappa}"),
            format!("{gamma}"),
            format!("{:.1}", kappa / std::f64::consts::TAU),
            format!("{exact:.4}"),
            format!("{tip:.4}"),
            format!("{:.4}", tip - exact),
        ]);
    }
    finding.plot(plot);
    finding.table(table);
    finding.judge(
        "largest difference of the height from the closed form, over the length",
        worst,
        Limit::AtMost(0.005),
    );
    finding.judge(
        "largest difference of a turn's descent from the closed form, but for the turns at the ends",
        angle,
        Limit::AtMost(0.01),
    );
    Ok(())
}

fn diagram(finding: &mut Finding, effort: Effort, monitor: &dyn Monitor) -> Result<(), Stopped> {
    let (columns, rows) = effort.pick((9, 9), (25, 25));
    let at = |i: usize, n: usize, low: f64, high: f64| {
        low * (high / low).powf(i as f64 / (n - 1) as f64)
    };
    let mut hairs = Vec::new();
    for i in 0..columns {
        super::check(monitor, "suspended", 0.2 + 0.6 * i as f64 / columns as f64)?;
        let gamma = at(i, columns, 3.0, 3000.0);
        let column = (0..rows).into_par_iter().map(|j| Hung::new(gamma, at(j, rows, 2.5, 60.0)));
        hairs.extend(column.collect::<Result<Vec<_>, _>>()?);
    }
    let borders = borders(effort)?;
    let mut plot = Plot::new(
        "Shapes of a suspended curly hair",
        "Γ = ρSgL³/EI",
        "natural curvature κL",
        [Scale::Log, Scale::Log],
    );
    plot.size = [640.0, 480.0];
    for (i, (phase, name)) in [
        (Phase::Planar, "planar"),
        (Phase::Local, "helix near the tip"),
        (Phase::Global, "helix all along"),
    ]
    .into_iter()
    .enumerate()
    {
        let these = hairs.iter().filter(|h| h.phase() == phase).map(|h| (h.gamma, h.kappa));
        plot.add(name, Mark::Points, these).colour = Some(i);
    }
    let [coils, hooks] = &borders;
    plot.add("out of the plane (boundary-value problem)", Mark::Line, coils.clone()).colour =
        Some(6);
    plot.add("", Mark::Line, hooks.clone()).colour = Some(6);
    let border = [40.0, 1500.0, 3000.0].map(|g: f64| (g, (g / B).sqrt()));
    plot.add("Γ = (EI/GJ)(κL)²", Mark::Dashed, border).colour = Some(3);
    finding.plot(plot);
    judge(finding, &hairs, &borders);
    Ok(())
}

/// The two borders of the plane, as points (Γ, κL): that of curls as the weight grows, and that of hooks as the
/// curvature grows.
fn borders(effort: Effort) -> Result<[Vec<(f64, f64)>; 2], Stopped> {
    let kappas: Vec<f64> = effort
        .pick(vec![7.0, 12.0, 60.0], vec![6.6, 7.0, 8.0, 10.0, 13.0, 17.0, 24.0, 34.0, 46.0, 60.0]);
    let coils = kappas.par_iter().map(|&kappa| {
        let found = first(1.0, 1.15, (3000.0, 9), |g| reference_leaves(&hanging_curl(g, kappa)))?;
        Ok(found.map(|gamma| (gamma, kappa)))
    });
    let coils: Vec<Option<(f64, f64)>> = coils.collect::<Result<_, Stopped>>()?;
    let gammas: Vec<f64> = effort
        .pick(vec![40.0, 300.0, 3000.0], vec![25.0, 40.0, 70.0, 150.0, 400.0, 1000.0, 3000.0]);
    let hooks = gammas.par_iter().map(|&gamma| {
        let found = first(2.0, 1.1, (60.0, 9), |k| hook_leaves(&hanging_curl(gamma, k)))?;
        Ok(found.map(|kappa| (gamma, kappa)))
    });
    let hooks: Vec<Option<(f64, f64)>> = hooks.collect::<Result<_, Stopped>>()?;
    Ok([coils.into_iter().flatten().collect(), hooks.into_iter().flatten().collect()])
}

/// Where a curve is at x, straight between its points in logarithms; none beyond its ends.
fn along(curve: &[(f64, f64)], x: f64) -> Option<f64> {
    let pair = curve.windows(2).find(|p| (p[0].0..=p[1].0).contains(&x))?;
    let t = (x / pair[0].0).ln() / (pair[1].0 / pair[0].0).ln();
    Some(pair[0].1 * (pair[1].1 / pair[0].1).powf(t))
}

fn judge(finding: &mut Finding, hairs: &[Hung], [coils, hooks]: &[Vec<(f64, f64)>; 2]) {
    let stable = hairs.iter().filter(|h| h.stable).count();
    finding.judge(
        "share of the diagram's hairs that are stable",
        stable as f64 / hairs.len() as f64,
        Limit::AtLeast(1.0),
    );
    let by_kappa: Vec<(f64, f64)> = coils.iter().map(|&(g, k)| (k, g)).collect();
    let (mut asked, mut right) = (0, 0);
    let (mut helices, mut placed) = (0, 0);
    for hair in hairs {
        let (gamma, kappa) = (hair.gamma, hair.kappa);
        let inside = match (along(&by_kappa, kappa), along(hooks, gamma)) {
            (Some(least), Some(from)) => Some(gamma > least && kappa > from),
            (Some(least), None) => Some(gamma > least),
            (None, Some(from)) if kappa < from => Some(false),
            _ => None,
        };
        // A border is drawn through few points: what is within 8 % of it is not asked.
        let near = |x: Option<f64>, y: f64| x.is_some_and(|x| (y / x).ln().abs() < 0.08);
        if let Some(inside) = inside
            && !near(along(&by_kappa, kappa), gamma)
            && !near(along(hooks, gamma), kappa)
        {
            asked += 1;
            right += usize::from(hair.leaves() == inside);
        }
        let tension = gamma / (B * kappa * kappa);
        if hair.leaves() && !(0.5..2.0).contains(&tension) {
            helices += 1;
            placed += usize::from((hair.phase() == Phase::Global) == (tension < 1.0));
        }
    }
    finding.judge(
        format!("share of {asked} hairs that are in or out of the plane as the border has it"),
        f64::from(right as u32) / f64::from(asked),
        Limit::AtLeast(0.98),
    );
    finding.judge(
        format!("share of {helices} helices, off Γ = (EI/GJ)(κL)² by a factor of 2, that are near the tip or all along as it has it"),
        f64::from(placed as u32) / f64::from(helices),
        Limit::AtLeast(0.95),
    );
}
