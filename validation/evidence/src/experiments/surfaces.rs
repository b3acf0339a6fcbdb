//! What rods lie on, rub against and stick to in closed forms.

use frisure::hairstyle::contact::{FrictionSurface, Pressed};
use frisure::rod::potential::Field;
use glam::{DMat3, DVec3};

/// A hard surface that presses back with `k d` per length at the depth d.
pub(super) struct Ground {
    /// k (Pa).
    pub(super) stiffness: f64,
    /// Coefficient of friction.
    pub(super) coefficient: f64,
    pub(super) form: Form,
}

/// The form of a [`Ground`].
pub(super) enum Form {
    /// Through the origin, with this normal (unit).
    Plane(DVec3),
    /// About the y axis, of this radius (m).
    Cylinder(f64),
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

impl Ground {
    /// Distance (m), gradient and Hessian (1/m).
    fn distance(&self, p: DVec3) -> (f64, DVec3, DMat3) {
        match self.form {
            Form::Plane(normal) => (normal.dot(p), normal, DMat3::ZERO),
            Form::Cylinder(radius) => {
                let away = DVec3::new(p.x, 0.0, p.z);
                let (reach, normal) = (away.length(), away.normalize());
                let around = DVec3::new(normal.z, 0.0, -normal.x);
                (reach - radius, normal, outer(around) * (1.0 / reach))
            }
        }
    }
}

impl Field for Ground {
    fn energy(&self, _: f64, p: DVec3) -> f64 {
        0.5 * self.stiffness * (-self.distance(p).0).max(0.0).powi(2)
    }

    fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let (distance, normal, bend) = self.distance(p);
        let (k, depth) = (self.stiffness, -distance);
        (depth > 0.0).then(|| (normal * (-k * depth), outer(normal) * k - bend * (k * depth)))
    }
}

impl FrictionSurface for Ground {
    fn pressed(&self, _: f64, p: DVec3) -> Option<Pressed> {
        let (distance, normal, _) = self.distance(p);
        let limit = self.coefficient * self.stiffness * -distance;
        (limit > 0.0).then_some(Pressed { normal, limit })
    }
}

/// The same force per length (N/m) on a piece of a rod.
pub(super) struct Push {
    /// From where to where (m).
    pub(super) piece: [f64; 2],
    pub(super) force: DVec3,
}

impl Push {
    fn acts(&self, s: f64) -> bool {
        (self.piece[0]..self.piece[1]).contains(&s)
    }
}

impl Field for Push {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        if self.acts(s) { -self.force.dot(p) } else { 0.0 }
    }

    fn derivatives(&self, s: f64, _: DVec3) -> Option<(DVec3, DMat3)> {
        self.acts(s).then(|| (-self.force, DMat3::ZERO))
    }
}

/// A plane z = 0 that a rod sticks to within `reach` (m), with `adhesion` (J/m) per length, and that it cannot pass.
pub(super) struct StickyPlane {
    pub(super) adhesion: f64,
    pub(super) reach: f64,
}

/// Stiffness of the wall below a [`StickyPlane`], in adhesion over its squared reach: much stiffer than the well.
const WALL: f64 = 200.0;

impl StickyPlane {
    /// Energy per length (J/m) at a height (m), and its first two derivatives: −G (1 − u²)³ above the plane, u = z/reach, and
    /// a wall below.
    fn law(&self, z: f64) -> [f64; 3] {
        let (g, r) = (self.adhesion, self.reach);
        let u = z / r;
        if u < 0.0 {
            let k = WALL * g / (r * r);
            return [-g + 0.5 * k * z * z, k * z, k];
        }
        if u >= 1.0 {
            return [0.0; 3];
        }
        let left = 1.0 - u * u;
        [
            -g * left.powi(3),
            6.0 * g / r * u * left * left,
            6.0 * g / (r * r) * left * (1.0 - 5.0 * u * u),
        ]
    }
}

impl Field for StickyPlane {
    fn energy(&self, _: f64, p: DVec3) -> f64 {
        self.law(p.z)[0]
    }

    fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let [_, slope, bend] = self.law(p.z);
        Some((DVec3::Z * slope, DMat3::from_diagonal(DVec3::Z * bend)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_energies() {
        let p = DVec3::new(0.7, 0.2, 0.6);
        let ground = |form| Ground { stiffness: 3.0, coefficient: 0.0, form };
        let fields: [(&dyn Field, DVec3); 4] = [
            (&ground(Form::Plane(DVec3::new(0.0, -0.6, -0.8))), p),
            (&ground(Form::Cylinder(1.5)), p),
            (&StickyPlane { adhesion: 2.0, reach: 1.0 }, p),
            (&StickyPlane { adhesion: 2.0, reach: 1.0 }, -p * 0.1),
        ];
        for (field, p) in fields {
            let (gradient, hessian) = field.derivatives(0.0, p).unwrap();
            let h = 1e-6;
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let [low, high] = [p - axis * h, p + axis * h];
                let slope = (field.energy(0.0, high) - field.energy(0.0, low)) / (2.0 * h);
                assert!((slope - gradient.dot(axis)).abs() < 1e-6, "{slope} {gradient}");
                let by = |p| field.derivatives(0.0, p).unwrap().0;
                let bend = (by(high) - by(low)) / (2.0 * h);
                assert!((bend - hessian * axis).length() < 1e-4, "{bend} {hessian}");
            }
        }
    }
}
