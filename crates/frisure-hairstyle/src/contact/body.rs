//! Contact (collision) of hair with the head: the penalty energy of skin and of the hair on it.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

use super::bed::Bed;
use super::friction::{FrictionSurface, Pressed};
use super::layers::Layer;
use super::switch::SwitchDistance;
use super::thickness::Thickness;
use crate::head::{Head, Sphere};
use crate::math::{outer, smooth_step};
use crate::spec::Body;

/// The body under a guide: hard skin, and on it the soft thickness of the guide's own wisp and of
/// the hair beneath it.
///
/// At the distance D from the skin the energy per length of hair is `½ k_skin d²` for the depth d = −D in the
/// skin (\[paper\] §3.1), and `k_hair e³/6K` for the depth e = K − D in hair, which is as thick as the
/// radius of its wisp and the bed it lies on together, K. Hair is soft at first and stiffens as it
/// is pressed (van Wyk 1946).
#[derive(Clone, Copy, Debug)]
pub struct BodyContact<'a> {
    /// The head.
    pub head: &'a Head,
    /// Which model of the body is used.
    pub body: Body,
    /// Stiffness of skin per length of hair (Pa).
    pub skin: f64,
    /// Stiffness of hair per length of hair (Pa).
    pub hair: f64,
    /// Radius of the wisp.
    pub thickness: Thickness,
    /// Hair beneath the wisp.
    pub layer: Layer,
    /// Height of the hair beneath a guide that comes from a groom; it replaces thickness and layer.
    pub bed: Option<&'a Bed>,
    /// Coefficients of friction.
    pub friction: FrictionCoefficients,
    /// What holds combed hair.
    pub hold: CombedHold,
}

/// The friction that holds combed hair where it was combed, at its limit: a force per length on the part of a hair that lies on
/// the head, against the direction in which it would slide. It has a potential, `−f·r`, where Coulomb's law has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CombedHold {
    /// Force per length (N/m) near the root.
    pub force: DVec3,
    /// Arc length (m) up to which it acts; it fades over the last third.
    pub reach: f64,
}

impl CombedHold {
    /// The force per length (N/m) at arc length `s` (m), zero where it does not act.
    pub(crate) fn force(&self, s: f64) -> DVec3 {
        self.at(s).unwrap_or(DVec3::ZERO)
    }

    /// The same where it acts.
    fn at(&self, s: f64) -> Option<DVec3> {
        let acts = self.force != DVec3::ZERO && s < self.reach;
        acts.then(|| self.force * (1.0 - smooth_step(self.reach * 2.0 / 3.0, self.reach, s)))
    }
}

/// Coefficients of friction of hair along its scales, tangential over normal force; 0 without friction. With cohesion hair begins to
/// slide at `μ λ_n + c` (Coulomb's law for what sticks, docs/theory.md, "Friction").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionCoefficients {
    /// Against skin.
    pub skin: f64,
    /// Against other hair.
    pub hair: f64,
    /// Friction against the scales over that along them.
    pub against_scales: f64,
    /// Cohesion c by a styling product: force per length (N/m) that it takes to slide what lies on something without weight.
    pub cohesion: f64,
    /// Between the hairs of its wisp; 0: they slide freely as it bends.
    pub lock: f64,
    /// The cohesion (N/m) of hairs that lie side by side in the wisp.
    pub lock_cohesion: f64,
}

frisure_digest::digest_fields!(FrictionCoefficients {
    skin,
    hair,
    against_scales,
    cohesion,
    lock,
    lock_cohesion,
});

/// Cohesion over the normal force per length below which contact is too light for all of it. Chosen: hair that lies with its own weight
/// sticks with ten times that.
const FULLY_STUCK: f64 = 10.0;

impl Default for FrictionCoefficients {
    /// Hair slides freely.
    fn default() -> Self {
        Self {
            skin: 0.0,
            hair: 0.0,
            against_scales: 1.0,
            cohesion: 0.0,
            lock: 0.0,
            lock_cohesion: 0.0,
        }
    }
}

impl FrictionCoefficients {
    /// Whether hair slides freely on everything outside of its wisp.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.skin == 0.0 && self.hair == 0.0 && self.cohesion == 0.0
    }

    /// What cohesion adds to the largest friction per length (N/m) of hair that is pressed with λ_n (N/m): all of it but where hair hardly
    /// touches, so that the law is continuous.
    fn sticks(self, pressed: f64) -> f64 {
        self.cohesion.min(FULLY_STUCK * pressed)
    }

    /// The same of hair of another wetness, which has `factor` times the friction.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            skin: self.skin * factor,
            hair: self.hair * factor,
            lock: self.lock * factor,
            ..self
        }
    }
}

impl BodyContact<'_> {
    /// Distance (m) from the skin at which the contact energy begins, at arc length `s` (m).
    fn clearance(&self, s: f64) -> f64 {
        match self.bed {
            Some(bed) => bed.at(s),
            None => self.thickness.at(s) + self.layer.at(s),
        }
    }

    /// Calls `touch` with the distance (m), its gradient and its Hessian (1/m), for each part of the
    /// body nearer than `clearance` (m).
    fn for_each_near(&self, clearance: f64, p: DVec3, mut touch: impl FnMut(f64, DVec3, DMat3)) {
        match self.body {
            Body::None => {}
            Body::Spheres => {
                for sphere in self.head.spheres() {
                    if let Some((distance, gradient, hessian)) = near(sphere, clearance, p) {
                        touch(distance, gradient, hessian);
                    }
                }
            }
            Body::SignedDistance => {
                // Most points are far from the skin: the value alone costs a fraction of the derivatives.
                let field = self.head.signed_distance();
                if field.may_be_nearer(p, clearance) && field.value(p) < clearance {
                    let (distance, gradient, hessian) = field.value_gradient_hessian(p);
                    touch(distance, gradient, hessian);
                }
            }
        }
    }

    /// Coefficient of friction of the soft contact at arc length `s` (m): the wisp lies on hair as far as the thickness
    /// beneath it is that of other hair, and on skin as far as it is its own.
    fn soft_friction(&self, s: f64) -> f64 {
        let FrictionCoefficients { skin, hair, .. } = self.friction;
        if self.bed.is_some() {
            return hair;
        }
        let (own, beneath) = (self.thickness.at(s), self.layer.at(s));
        let share = if beneath > 0.0 { beneath / (own + beneath) } else { 0.0 };
        skin + share * (hair - skin)
    }

    /// Force per length of hair (N/m) with which the body presses on it at arc length `s` (m) and position `p` (m).
    pub(crate) fn normal_force(&self, s: f64, p: DVec3) -> f64 {
        let clearance = self.clearance(s);
        let mut force = 0.0;
        self.for_each_near(clearance.max(0.0), p, |distance, _, _| {
            force -= self.penalty(clearance, distance)[1];
        });
        force
    }

    /// How far the point at arc length `s` (m) and position `p` (m) is from where skin and hair begin to press on it.
    pub(crate) fn switch_distance(&self, s: f64, p: DVec3) -> SwitchDistance {
        let (clearance, mut found) = (self.clearance(s), SwitchDistance::FAR);
        let mut at = |distance: f64| {
            if self.skin > 0.0 {
                found.skin = found.skin.min(distance.abs());
            }
            if self.hair > 0.0 && clearance > 0.0 {
                found.hair = found.hair.min((clearance - distance).abs());
            }
        };
        match self.body {
            Body::None => {}
            Body::Spheres => (self.head.spheres().iter())
                .for_each(|sphere| at((p - sphere.centre).length() - sphere.radius)),
            Body::SignedDistance => at(self.head.signed_distance().value(p)),
        }
        found
    }

    /// Energy per length (J/m) at a distance (m), and its first two derivatives.
    fn penalty(&self, clearance: f64, distance: f64) -> [f64; 3] {
        // e = K − D and d = −D, docs/theory.md, "Hair on the body"; derivatives by D, hence the sign of the slope.
        let (soft, hard) = ((clearance - distance).max(0.0), (-distance).max(0.0));
        let hair = if soft > 0.0 && clearance > 0.0 { self.hair * soft / clearance } else { 0.0 };
        let skin = if hard > 0.0 { self.skin } else { 0.0 };
        [
            hair * soft * soft / 6.0 + 0.5 * skin * hard * hard,
            -(0.5 * hair * soft + skin * hard),
            hair + skin,
        ]
    }
}

/// Distance of a point to a sphere with derivatives, if it is less than `clearance` (m).
fn near(sphere: &Sphere, clearance: f64, p: DVec3) -> Option<(f64, DVec3, DMat3)> {
    let away = p - sphere.centre;
    let reach = away.length();
    let distance = reach - sphere.radius;
    if !(distance < clearance && reach > 0.0) {
        return None;
    }
    // φ = |r − o| − ρ: gradient n, Hessian (I − n nᵀ)/|r − o|. docs/theory.md, "Contact with the body"
    let normal = away / reach;
    Some((distance, normal, (DMat3::IDENTITY - outer(normal, normal)) * (1.0 / reach)))
}

impl Field for BodyContact<'_> {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        let clearance = self.clearance(s);
        let held = self.hold.at(s).map_or(0.0, |force| -force.dot(p));
        if self.body == Body::SignedDistance {
            let field = self.head.signed_distance();
            let near = field.may_be_nearer(p, clearance.max(0.0));
            let pressed = if near { self.penalty(clearance, field.value(p))[0] } else { 0.0 };
            return pressed + held;
        }
        let mut energy = held;
        self.for_each_near(clearance, p, |distance, _, _| {
            energy += self.penalty(clearance, distance)[0];
        });
        energy
    }

    fn derivatives(&self, s: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let clearance = self.clearance(s);
        // E = −f·r is linear: no stiffness.
        let mut sum: Option<(DVec3, DMat3)> = self.hold.at(s).map(|force| (-force, DMat3::ZERO));
        self.for_each_near(clearance, p, |distance, gradient, hessian| {
            let [_, slope, bend] = self.penalty(clearance, distance);
            let (force, stiffness) = sum.get_or_insert((DVec3::ZERO, DMat3::ZERO));
            // E(D(r)): ∇E = E′ ∇D and ∇²E = E″ ∇D ∇Dᵀ + E′ ∇²D; |∇D| is 1 but for the smoothing of the distance.
            *force += gradient * slope;
            *stiffness += outer(gradient, gradient) * bend + hessian * slope;
        });
        sum
    }
}

impl FrictionSurface for BodyContact<'_> {
    fn against_scales(&self) -> f64 {
        self.friction.against_scales
    }

    fn pressed(&self, s: f64, p: DVec3) -> Option<Pressed> {
        if self.friction.is_zero() {
            return None;
        }
        let clearance = self.clearance(s);
        let soft = self.soft_friction(s);
        let (mut normal, mut limit, mut pressed) = (DVec3::ZERO, 0.0, 0.0);
        self.for_each_near(clearance.max(0.0), p, |distance, gradient, _| {
            let [_, slope, _] = self.penalty(clearance, distance);
            // λ_n = −E′ of the skin, and that of the hair: each has its own coefficient.
            let on_skin = self.skin * (-distance).max(0.0);
            let on_hair = (-slope - on_skin).max(0.0);
            normal += gradient * -slope;
            limit += self.friction.skin * on_skin + soft * on_hair;
            pressed += on_skin + on_hair;
        });
        limit += self.friction.sticks(pressed);
        let normal = normal.try_normalize()?;
        (limit > 0.0).then_some(Pressed { normal, limit })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::test_field::{agrees_with_differences, wisp};

    #[test]
    fn derivatives_agree_with_differences() {
        let head = Head::mannequin();
        let top = head.landmarks().whorl;
        for body in [Body::Spheres, Body::SignedDistance] {
            let layer = Layer { slope: 0.1, most: 0.1 };
            let contact = BodyContact {
                head: &head,
                body,
                skin: 1000.0,
                hair: 2.0,
                thickness: wisp(),
                layer,
                bed: None,
                friction: FrictionCoefficients::default(),
                hold: CombedHold { force: DVec3::new(2e-5, 4e-5, 0.0), reach: 0.05 },
            };
            // In the hair over the skin, and in the skin.
            for out in [0.003, -0.004] {
                let p = top + top.normalize() * out + DVec3::new(0.003, 0.001, 0.0);
                agrees_with_differences(&contact, 0.04, p);
            }
            // Without any hair there is the skin alone.
            let bare = BodyContact {
                thickness: contact.thickness.scaled(0.0),
                layer: Layer::NONE,
                ..contact
            };
            agrees_with_differences(&bare, 0.04, top - top.normalize() * 0.004);
            let loose = BodyContact { hold: CombedHold::default(), ..contact };
            assert_eq!(loose.derivatives(0.04, top * 2.0), None);
            assert_eq!(loose.energy(0.04, top * 2.0), 0.0);
            // Beyond its reach nothing holds.
            assert_eq!(contact.derivatives(0.05, top * 2.0), None);
        }
    }

    #[test]
    fn cohesion_is_added_to_friction_and_begins_with_contact() {
        let head = Head::mannequin();
        let (top, cohesion) = (head.landmarks().whorl, 4e-4);
        let contact = BodyContact {
            head: &head,
            body: Body::SignedDistance,
            skin: 1000.0,
            hair: 2.0,
            thickness: wisp(),
            layer: Layer::NONE,
            bed: None,
            friction: FrictionCoefficients { cohesion, ..FrictionCoefficients::default() },
            hold: CombedHold::default(),
        };
        let rough = FrictionCoefficients { skin: 0.3, ..contact.friction };
        let rough = BodyContact { friction: rough, ..contact };
        let limit = |contact: &BodyContact<'_>, out: f64| {
            let p = top + top.normalize() * out;
            contact.pressed(0.04, p).map_or(0.0, |pressed| pressed.limit)
        };
        // Off the hair, and pressed: all of the cohesion, and the coefficient times what presses.
        assert_eq!(limit(&contact, 0.05), 0.0);
        assert_eq!(limit(&contact, -0.001), cohesion);
        let slid = BodyContact {
            friction: FrictionCoefficients { cohesion: 0.0, ..rough.friction },
            ..contact
        };
        assert!((limit(&rough, -0.001) - limit(&slid, -0.001) - cohesion).abs() < 1e-15);
        // It grows with the contact, without a jump.
        let steps: Vec<f64> =
            (0..200).map(|k| limit(&contact, 0.01 - 1e-4 * f64::from(k))).collect();
        assert!(steps.windows(2).all(|pair| pair[1] >= pair[0]), "{steps:?}");
        assert!(steps.iter().any(|&limit| limit > 0.0 && limit < 0.5 * cohesion), "{steps:?}");
    }
}
