//! The shapes of a suspended curly hair.

mod diagram;
mod helix;
mod hung;

use crate::experiment::check;
use crate::plot::{Mark, Plot, Scale};
use crate::{Effort, Experiment, Finding, Limit, Progress, Stopped};
use hung::{Hung, Phase};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "suspended",
    title: "The shapes of a suspended curly hair (Miller et al. 2014)",
    question: "Does a naturally curved hair that hangs from a vertical clamp take the three shapes of Miller, \
        Lazarus, Audoly and Reis (planar curl, helix near the tip, helix all along), each in its region?",
    method: "A round rod (GJ/EI = 2/3), its natural shape a circle of curvature κ, hangs from a clamp that \
        points down. Two numbers remain: κL and Γ = ρSgL³/EI. We have the abstract of the paper, not its \
        diagram, and so compute the borders ourselves: the hair leaves the plane where Morse's index of the planar \
        solution of the boundary-value problem changes from 0 to 1. The criterion for every hair of the diagram is that index of \
        its own planar shapes, both the one that natural curls reach as the weight increases and the one that \
        straight hair reaches as its curl increases: the hair must be in the plane if either is stable, and out of it if none \
        is.\n\n\
        Out of the plane and far from the clamp, each piece hangs under the tension T = ρSg(L − s) of the hair \
        below it. A helix that winds about the vertical at the angle θ has the least energy of bending, twist \
        and tension for T/EIκ² = b cos θ/(b − (b − 1) cos²θ)², b = EI/GJ (from ½EI(Ω sin θ − κ)² + ½GJ(Ω cos θ)² − \
        T cos θ, first by Ω). It is straight for T ≥ bEIκ²: the helix extends up to bκ²EI/ρSg from the tip, and \
        through the whole hair where Γ < b(κL)². The height of the hair is the integral of cos θ. These \
        closed forms contain neither clamp nor tip, which change about a turn each. The criterion for a helix all along is the \
        upper part of the hair: between 5 and 25 % of the length it descends by less than 0.95 of its arc length. We chose \
        this 0.95, and the factor of 2 by which a hair must be off Γ = b(κL)² for the comparison.",
    run,
};

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    shapes(&mut finding)?;
    check(progress, "suspended", 0.1)?;
    helix::add(&mut finding)?;
    check(progress, "suspended", 0.2)?;
    diagram::add(&mut finding, effort, progress)?;
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
    finding.check(
        "of three hairs, those with the shape expected",
        right as f64,
        Limit::AtLeast(3.0),
    );
    Ok(())
}
