//! A guide that is held off the head and let down on it.
//!
//! Hair that grows against an ear has its natural shape in it, and contact is a penalty: in what is thin it pushes out on both sides, so that
//! every way that begins in there can end in there. A hand that lifts the hair begins outside.

use frisure_rod::potential::Potential;
use frisure_rod::{Equilibrium, Options, Resolution, equilibrium, equilibrium_from};
use glam::DVec3;

use super::fields::{along, body, layer};
use crate::contact::Pull;
use crate::guides::Guide;
use crate::head::Head;
use crate::spec::HairstyleSpec;

/// Length (m) of hair in which a hand that lifts it bends it off the skin, as a beam under the tension F, √(EI/F). Chosen: less than roots
/// are from an ear.
const BEND: f64 = 4e-3;

/// How hard the hand pulls from one step to the next, and at last, in weights of the hair. Chosen: about the steps in
/// which a comb lets go; hair sinks to where it is let go.
const EASING: f64 = 0.4;
const LEAST: f64 = 0.02;

/// Brings a guide to rest on the body from off it, with the number of elements of the options.
pub(super) fn let_down(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    options: &Options,
) -> Equilibrium {
    let Resolution::Elements(elements) = options.resolution else {
        unreachable!("the division is fixed before")
    };
    let rod = &guide.rod;
    let off = head.signed_distance().value_gradient(rod.root().position()).1.normalize_or(DVec3::Z);
    let firmest = rod.stiffness().truncate().max_element() / (BEND.powi(2) * rod.length());
    let lift = |force: f64| Pull::Comb { force: off * force, until: f64::INFINITY };
    // 1. In the hand, before there is a body.
    let full = lift(firmest);
    let held = along(&full, guide, elements);
    let mut rest = equilibrium(rod, &[&held], options);
    // 2. Down on the body, from the shape of each step to the next.
    let body = body(spec, head, guide, layer(spec, guide));
    let body = along(&body, guide, elements);
    let own = guide.pull.as_ref().map(|pull| along(pull, guide, elements));
    let easing = std::iter::successors(Some(firmest), |force| Some(force * EASING));
    let forces = easing.take_while(|force| *force > LEAST * rod.weight()).chain([0.0]);
    for lift in forces.map(lift) {
        let lift = along(&lift, guide, elements);
        let mut felt: Vec<&dyn Potential> = vec![&body, &lift];
        felt.extend(own.iter().map(|pull| pull as &dyn Potential));
        let before = rest.certificate.iterations;
        rest = equilibrium_from(rod, &felt, options, &rest);
        rest.certificate.iterations += before;
    }
    rest
}

#[cfg(test)]
mod tests {
    use frisure_rod::{Material, NaturalStrain, Rod, RodSpec, Stability};

    use super::*;
    use crate::equilibrium::fields::depth;
    use crate::equilibrium::{Effort, GuideStart, SettleOptions, settle};
    use crate::guides::plan;
    use crate::hairstyle::RootPlacement;
    use crate::implantation::Layout;
    use crate::preset;

    /// Guides of coily hair rooted on the temples, up to 25 mm in front of the ears, each in a stiff two-strand twist.
    fn twisted_beside_the_ears(spec: &HairstyleSpec, head: &Head) -> Vec<Guide> {
        let placement = RootPlacement::new(spec, head).unwrap();
        let ear = head.landmarks().ear;
        let beside = placement.roots().iter().filter(|root| {
            let way = root.position - ear;
            (-0.025..0.0).contains(&way.y) && way.z < 0.0
        });
        let roots: Vec<_> = beside.copied().collect();
        let layout = Layout::new(spec, head).unwrap();
        let mut guides = plan(spec, head, &layout, &roots, placement.area()).unwrap();
        for guide in &mut guides {
            let free = guide.rod.spec().clone();
            let [young, shear] = [free.material.youngs_modulus(), free.material.shear_modulus()];
            let material = Material::new(10.0 * young, 10.0 * shear, free.material.density());
            let natural = NaturalStrain::helix(0.003, 0.03).unwrap();
            guide.rod = Rod::new(RodSpec { natural, material: material.unwrap(), ..free }).unwrap();
            let tension = guide.rod.up() * (-2.0 * guide.rod.weight());
            guide.pull = Some(Pull::Comb { force: tension, until: f64::INFINITY });
            guide.firmness = 10.0;
        }
        guides
    }

    #[test]
    fn hair_that_grows_against_an_ear_comes_to_lie_on_it() {
        let head = Head::named("african-woman").unwrap();
        let mut spec = preset("african-coily").unwrap().spec();
        spec.length.mean = 0.2;
        for seed in [1, 2, 5] {
            spec.seed = seed;
            let guides = twisted_beside_the_ears(&spec, &head);
            let (start, effort) = (GuideStart::Natural, Effort::FULL);
            let options = SettleOptions { start, effort, locks: Vec::new() };
            let rest = settle(&spec, &head, &guides, options, &()).unwrap();
            assert!(guides.len() > 5);
            for guide in &rest.guides {
                assert_eq!(guide.certificate.stability, Stability::Stable);
                // What the gate calls inside the head.
                assert!(depth(&head, guide) < 5e-4, "{seed}: {}", depth(&head, guide));
            }
        }
    }
}
