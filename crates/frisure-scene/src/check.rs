//! What a scene describes, with every number in range; and errors that are found later.

use std::f64::consts::FRAC_PI_2;

use frisure_hairstyle::styling::{Operation, StyleError};
use frisure_hairstyle::{Body, HairstyleSpec, InvalidSpec, MOST_ELEMENTS, Range};
use frisure_rod::{InvalidQuantity, NaturalStrain, Options, Resolution, Rod, RodSpec, Root};
use glam::DVec3;

use crate::error::{Diagnostic, SceneError};
use crate::key_location::{locate_any, quantity_error, spec_error};
use crate::operation::step_error;
use crate::scene::{Scene, SingleHair};
use crate::unit_hint;

/// Largest weight against elasticity, ρ S g L³ / EI. A hair of a metre has some ten thousand; beyond
/// this a unit was mistaken, and a head would take hours.
const MAX_HEAVINESS: f64 = 1e8;

/// Most by which an element may turn with the natural curl (rad), where hair touches a head. Tuned on hair of 20 cm,
/// frizzy, coily, kinky and curly, in 15 to 90 elements: above, guides were 1.0 to 4.1 mm inside the head, below
/// 0.01 to 0.6 mm.
const WIDEST_ELEMENT: f64 = FRAC_PI_2;

/// Lengths of one hair (m). Chosen: beyond, a unit was mistaken; the smallest and largest numbers leave their range as squares and cubes.
const ONE_HAIR: Range = Range::new("hair.length", 1e-6, 100.0, "between 1 um and 100 m");

/// The numbers of a scene that one hair may have more of than a head; [`Rod`] checks them.
const WIDER_FOR_ONE_HAIR: [&str; 7] = [
    "hair.length",
    "hair.fibre.diameter",
    "hair.fibre.youngs_modulus",
    "hair.fibre.shear_modulus",
    "hair.fibre.density",
    "hair.curl",
    "equilibrium.elements",
];

impl Scene {
    /// The whole head of hair that the scene describes, with every number in range.
    ///
    /// # Errors
    /// [`SceneError`] for a number out of range, and for natural strains along a hair: the wisps of a head vary at random.
    pub fn hairstyle_spec(&self) -> Result<HairstyleSpec, SceneError> {
        if self.along.is_some() {
            let problem = "natural strains along the hair are for one hair (`frisure hair`)";
            let hint = "give a whole head `radius` and `pitch`, and let it vary by \
                        `variation_along` and `variation_between`";
            return Err(self.error_at("hair.curl.along", problem, hint));
        }
        self.spec.check().map_err(|e| self.spec_error(&e))?;
        self.check_division()?;
        // A fibre that cannot be is refused whichever way it leaves the scalp.
        self.single_hair()?;
        Ok(self.spec.clone())
    }

    /// Refuses elements that are too long for the curl to feel the head: curls would hang inside it.
    fn check_division(&self) -> Result<(), SceneError> {
        let spec = &self.spec;
        if spec.contact.body == Body::None {
            return Ok(());
        }
        let angle = spec.curl.strain.length() * spec.length.mean;
        let needed = (angle / WIDEST_ELEMENT).ceil() as usize;
        let given = match spec.equilibrium.resolution {
            Resolution::Elements(given) if given < needed => given,
            Resolution::Accuracy(_) if needed > MOST_ELEMENTS => {
                let longest = 1e2 * spec.length.mean * MOST_ELEMENTS as f64 / needed as f64;
                let problem = format!(
                    "hair of this length and natural curl follows the head with at least {needed} elements; a guide has at most {MOST_ELEMENTS}"
                );
                let hint = format!("make the hair shorter than {longest:.3} cm, or curl it less");
                return Err(self.error_at("hair.curl", problem, &hint));
            }
            Resolution::Elements(_) | Resolution::Accuracy(_) => return Ok(()),
        };
        let problem = format!(
            "`equilibrium.elements` is {given}; hair of this length and natural curl follows the head with at least {needed}"
        );
        let hint = format!("write `elements = {needed}`, or `accuracy` instead");
        Err(self.error_at("equilibrium.elements", problem, hint))
    }

    /// The single hair that the scene describes, without variation; its root is at the origin.
    ///
    /// # Errors
    /// [`SceneError`] for a number out of range.
    pub fn single_hair(&self) -> Result<SingleHair, SceneError> {
        self.check_one_hair()?;
        let spec = &self.spec;
        let [d1, d2, t] = self.frame;
        let refuse = |e: InvalidQuantity| self.quantity_error(&e);
        let rod = RodSpec {
            length: spec.length.mean,
            section: spec.fibre.section,
            material: spec.fibre.material,
            torsion: spec.fibre.torsion,
            natural: match &self.along {
                Some(profile) => NaturalStrain::Varying(profile.clone()),
                None => NaturalStrain::Uniform(spec.curl.strain),
            },
            root: Root::new(DVec3::ZERO, d1, d2, t).map_err(refuse)?,
            load: spec.load(&spec.fibre.section),
        };
        let rod = Rod::new(rod).map_err(refuse)?;
        if !(rod.heaviness() <= MAX_HEAVINESS) {
            let (key, span, _) = locate_any(&["hair.fibre", "hair.length"], &self.source);
            let problem = format!(
                "the hair is too limp to compute: rho S g L^3 / EI is {:.1e}, and may be {MAX_HEAVINESS:.0e}",
                rod.heaviness()
            );
            let longest = rod.length() * (MAX_HEAVINESS / rod.heaviness()).cbrt();
            let hint = format!(
                "such hair may be {longest:.2} m long; check the units of length, diameter, moduli and density"
            );
            return Err(Diagnostic::new(problem).key(key).hint(hint).at(&self.source, span));
        }
        let (resolution, element) = (spec.equilibrium.resolution, spec.equilibrium.element);
        let branch = self.branch;
        Ok(SingleHair {
            rod,
            options: Options { resolution, element, branch, ..Options::default() },
        })
    }

    /// Refuses lengths that one hair is not computed with, and what no scene may have, also of what one hair does not need.
    fn check_one_hair(&self) -> Result<(), SceneError> {
        let spec = &self.spec;
        ONE_HAIR.check(spec.length.mean).map_err(|e| self.spec_error(&e))?;
        spec.check_except(&WIDER_FOR_ONE_HAIR).map_err(|e| self.spec_error(&e))
    }

    /// The error about the value of `key`, such as a mesh at `head.mesh` that is no head; `hint` may be empty.
    #[must_use]
    pub fn error_at(
        &self,
        key: &str,
        problem: impl Into<String>,
        hint: impl Into<String>,
    ) -> SceneError {
        let span = self.source.locate(key);
        let value = self.source.slice(span.clone()).to_owned();
        Diagnostic::new(problem).key(key).value(value).hint(hint).at(&self.source, span)
    }

    /// The error about a quantity that is refused, at the key that it comes from.
    #[must_use]
    pub fn quantity_error(&self, error: &InvalidQuantity) -> SceneError {
        unit_hint::add(quantity_error(error, &self.source))
    }

    /// The error about a number of the description that is refused, at the key that it comes from.
    #[must_use]
    pub fn spec_error(&self, error: &InvalidSpec) -> SceneError {
        unit_hint::add(spec_error(error, &self.source))
    }

    /// The error about a step, counted from 0, at the step or at the key in it that is wrong.
    #[must_use]
    pub fn step_error(&self, index: usize, error: &StyleError) -> SceneError {
        let operation = self.steps.get(index).map_or("", Operation::name);
        unit_hint::add(step_error(index, operation, error, &self.source))
    }
}
