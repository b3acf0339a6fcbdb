//! Where the hair of one lock of a braid of three lies.
//!
//! The braid hangs from a tie. With a the drop below the tie and H the distance by which the braid stands off in the end, its middle is at
//! `m(a) = m₀ + H (1 − e^(−a/ℓ)) e_out + a e_down`. A lock goes to and fro across the braid once in a pitch P, and over and under the others
//! twice: with θ = 2π a/P + φ and the locks' phases φ = 0, 2π/3, 4π/3 it is at `A sin θ` across and `B sin 2θ` out of the braid's middle.
//! Two locks are at the same place across where their θ are 30° and 150°; there they are √3 B apart in depth, and 3/2 A from the
//! third.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use glam::DVec3;

/// The braid that a tail is made into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BraidPath {
    /// The middle of the tie (m).
    pub middle: DVec3,
    /// Unit vector in which gravity pulls.
    pub down: DVec3,
    /// Unit vector at right angles to it, away from the head.
    pub out: DVec3,
    /// How far (m) the braid stands off from the tie at its end.
    pub stand_off: f64,
    /// Radius (m) of each of the three locks.
    pub lock: f64,
    /// Phase φ of the lock (rad).
    pub phase: f64,
    /// Place (m) of the wisp in the tie, from its middle.
    pub in_tie: DVec3,
    /// Place (m) of the wisp in its lock: across, and out.
    pub in_lock: [f64; 2],
    /// Drop (m) of the elastic at the end of the braid.
    pub end: f64,
}

frisure_digest::digest_fields!(BraidPath {
    middle,
    down,
    out,
    stand_off,
    lock,
    phase,
    in_tie,
    in_lock,
    end
});

/// Drop (m) in which the braid comes away from the tie: ℓ. Chosen: the width of a hand.
const BEND: f64 = 0.06;

/// A over the radius of a lock: the third lock beside two that cross leaves each its round section, 3/2 A = 2 r.
const ACROSS: f64 = 4.0 / 3.0;

/// B over the radius of a lock. Chosen: round locks would need 2/√3 = 1.15; locks under tension are flat.
const DEPTH: f64 = 0.85;

/// Pitch over the radius of a lock. Chosen: a lock crosses at about 45 degrees, as in a braid that a hand has drawn tight.
const PITCH: f64 = 8.0;

/// How much nearer to the middle hair is in the elastic than in the braid. Chosen: three locks side by side become one round bundle.
const PRESSED: f64 = 0.5;

/// A smooth step from 0 to 1, with no slope at either end.
fn smoothed(way: f64) -> f64 {
    let way = way.clamp(0.0, 1.0);
    way * way * (3.0 - 2.0 * way)
}

impl BraidPath {
    /// Length (m) of the braid in which a lock comes back to its side.
    #[must_use]
    pub(crate) fn pitch(&self) -> f64 {
        PITCH * self.lock
    }

    /// Half of the depth of the braid (m).
    #[must_use]
    pub(crate) fn half_depth(&self) -> f64 {
        (DEPTH + 1.0) * self.lock
    }

    /// Unit vector across the braid.
    #[must_use]
    pub(crate) fn across(&self) -> DVec3 {
        self.down.cross(self.out)
    }

    /// The middle of the braid (m) at a drop (m) below the tie.
    #[must_use]
    pub(crate) fn axis(&self, drop: f64) -> DVec3 {
        self.middle + self.out * (self.stand_off * (1.0 - (-drop / BEND).exp())) + self.down * drop
    }

    /// Place (m) of the hair at a drop (m) below the tie.
    #[must_use]
    pub(crate) fn place(&self, drop: f64) -> DVec3 {
        // The locks leave the round tie within half a pitch.
        let share = smoothed(drop / (0.5 * self.pitch()));
        // The elastic presses them together again.
        let pressed = smoothed((drop - self.end) / (0.4 * self.pitch()) + 1.0);
        let open = share * (1.0 - PRESSED * pressed);
        let angle = TAU * drop / self.pitch() + self.phase;
        let wave = [ACROSS * angle.sin(), DEPTH * (2.0 * angle).sin()];
        let offset = |i: usize| open * (wave[i] * self.lock + self.in_lock[i]);
        let down = self.out * (self.stand_off / BEND * (-drop / BEND).exp()) + self.down;
        let across = self.across();
        let out = across.cross(down).normalize_or(self.out);
        self.axis(drop) + self.in_tie * (1.0 - share) + across * offset(0) + out * offset(1)
    }

    /// Place (m) of hair that is an arc length (m) beyond the tie.
    #[must_use]
    pub(crate) fn place_beyond(&self, beyond: f64) -> DVec3 {
        self.place(beyond / *HAIR_PER_LENGTH)
    }

    /// Arc length (m) beyond the tie at which hair reaches the elastic.
    #[must_use]
    pub(crate) fn reach(&self) -> f64 {
        self.end * *HAIR_PER_LENGTH
    }
}

/// Length of hair over the length of the braid: the mean of √(1 + x'² + y'²) over a pitch, the same for every braid of these
/// proportions.
pub(crate) static HAIR_PER_LENGTH: LazyLock<f64> = LazyLock::new(|| {
    const STEPS: usize = 64;
    let slope = |i: usize| {
        let angle = TAU * i as f64 / STEPS as f64;
        let x = ACROSS * TAU / PITCH * angle.cos();
        let y = DEPTH * 2.0 * TAU / PITCH * (2.0 * angle).cos();
        (1.0 + x * x + y * y).sqrt()
    };
    (0..STEPS).map(slope).sum::<f64>() / STEPS as f64
});

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn path(phase: f64) -> BraidPath {
        BraidPath {
            middle: DVec3::new(0.0, 0.1, -0.05),
            down: DVec3::NEG_Z,
            out: DVec3::Y,
            stand_off: 0.05,
            lock: 7e-3,
            phase,
            in_tie: DVec3::ZERO,
            in_lock: [0.0; 2],
            end: 0.4,
        }
    }

    #[test]
    fn the_three_locks_keep_clear_of_each_other_and_cross() {
        let locks = [0, 1, 2].map(|i| path(TAU / 3.0 * f64::from(i)));
        let pitch = locks[0].pitch();
        let mut order = std::collections::BTreeSet::new();
        for i in 0..600 {
            let drop = 0.5 * pitch + 3.0 * pitch * f64::from(i) / 600.0;
            let places = locks.map(|lock| lock.place(drop));
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                // Flat locks: nearest where cos² of half of the sum of two θ is 0.19, 1.36 r apart.
                assert!(places[a].distance(places[b]) > 1.35 * locks[0].lock, "{drop}");
            }
            let mut by_side = [0, 1, 2];
            by_side.sort_by(|a, b| places[*a].x.total_cmp(&places[*b].x));
            order.insert(by_side);
        }
        assert_eq!(order.len(), 6, "each lock is at the left, in the middle and at the right");
    }

    #[test]
    fn hair_is_as_long_as_its_way() {
        let lock = path(0.3);
        let (from, to) = (2.0 * lock.pitch(), 5.0 * lock.pitch());
        let steps = 20_000;
        let at = |i: usize| lock.place(from + (to - from) * i as f64 / steps as f64);
        let way: f64 = (0..steps).map(|i| at(i).distance(at(i + 1))).sum();
        // The braid hangs straight down there, but for e^(−a/ℓ) of the bend.
        let error = way / *HAIR_PER_LENGTH / (to - from) - 1.0;
        assert!(error.abs() < 0.02, "{error}");
        assert!((lock.place(0.0) - lock.middle).length() < 1e-12);
        let turned = path(0.3 + 2.0 * PI).place(0.1).distance(lock.place(0.1));
        assert!(turned < 1e-12);
    }
}
