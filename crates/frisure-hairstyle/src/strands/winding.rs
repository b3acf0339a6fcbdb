//! How the curl of a hair or of a split lies about the axis of its guide.

use std::f64::consts::PI;

use glam::DVec3;

use crate::random::Stream;

/// Largest factor on the radius of a curl: a wider one would be longer than its hair. Chosen.
const WIDEST: f64 = 1.1;

/// How the curl of a strand differs from that of its guide.
#[derive(Clone, Copy, Debug)]
pub(super) struct OwnCurl {
    /// Angle (rad) by which it is turned about the axis.
    pub(super) phase: f64,
    /// Factor on its radius.
    pub(super) radius: f64,
}

impl OwnCurl {
    /// That of the guide.
    pub(super) const GUIDE: Self = Self { phase: 0.0, radius: 1.0 };

    /// Turned by up to half a turn times `phase` to both sides, and as much wider or narrower as `deviation` says.
    pub(super) fn new(phase: f64, deviation: f64, random: &mut Stream) -> Self {
        let phase = phase.min(1.0) * PI * random.between(-1.0, 1.0);
        Self { phase, radius: random.factor(deviation).min(WIDEST) }
    }

    /// One after the other.
    pub(super) fn and(self, other: Self) -> Self {
        let radius = (self.radius * other.radius).min(WIDEST);
        Self { phase: self.phase + other.phase, radius }
    }
}

/// The guide whose curl a strand has, and how its own differs from that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Winding {
    pub(super) main: usize,
    pub(super) curl: OwnCurl,
    /// Sine and cosine of the phase: it is the same along most of a hair.
    turn: (f64, f64),
}

impl Winding {
    pub(super) fn new(main: usize, curl: OwnCurl) -> Self {
        Self { main, curl, turn: curl.phase.sin_cos() }
    }

    /// The curl of the guide (m, from its axis) turned about the direction of the axis (unit) and widened, both by the share `departed`.
    pub(super) fn turned(&self, curl: DVec3, direction: DVec3, departed: f64) -> DVec3 {
        let OwnCurl { phase, radius } = self.curl;
        let (sin, cos) = if departed < 1.0 { (phase * departed).sin_cos() } else { self.turn };
        // Rodrigues' formula.
        let turned = curl * cos
            + direction.cross(curl) * sin
            + direction * (direction.dot(curl) * (1.0 - cos));
        turned * (1.0 + (radius - 1.0) * departed)
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    #[test]
    fn a_curl_turns_about_its_axis() {
        let (curl, direction) = (DVec3::new(3.0, -1.0, 2.0), DVec3::new(1.0, 2.0, -2.0) / 3.0);
        let winding = Winding::new(0, OwnCurl { phase: 2.0, radius: 1.1 });
        for departed in [0.0, 0.3, 1.0] {
            let turn = DQuat::from_axis_angle(direction, 2.0 * departed);
            let turned = turn * curl * (1.0 + 0.1 * departed);
            assert!(turned.distance(winding.turned(curl, direction, departed)) < 1e-14);
        }
    }
}
