//! Bobby pins over tucked hair, and bar clips.

use glam::DVec3;

use super::accessory::Accessory;
use super::kind::AccessoryKind;
use super::mesh::{Axis, bar};
use super::place::{Piece, clearance, mean};
use super::ties::bundles;
use crate::hairstyle::{Fastener, Grip, Hairstyle};
use crate::head::Head;

/// Lengths (m) between which a pin is as long as its hair is wide and a part more on each side. Chosen: bobby pins have 40 to 65 mm.
const LENGTHS: (f64, f64) = (0.035, 0.06);
const MORE: f64 = 8e-3;

/// Half of the width and of the height (m) of a pin's prong, and of a clip's bar. Chosen after usual ones.
const PRONG: [f64; 2] = [1.0e-3, 0.5e-3];
const BAR: [f64; 2] = [4.5e-3, 1.2e-3];

/// Distance (m) of the prong under the hair from the skin. Chosen.
const OFF_SKIN: f64 = 1.2e-3;

/// Least distance (m) of the middles of both prongs. Chosen: the gap of a pin that is pushed open by hair.
const OPEN: f64 = 2.5e-3;

/// Distance (m) from the nearest hair up to which hair that is held at the same point is in one clip. Chosen.
const CLIPPED: f64 = 0.012;

/// How far (m) from a pin, along the hair, other hair is under it, and how far outwards at most. Chosen.
const BESIDE: f64 = 4e-3;
const THICKEST: f64 = 0.02;

/// Points along one prong. Chosen.
const POINTS: usize = 24;

/// Room (m) about the held place. Chosen.
const AROUND: [f64; 2] = [0.01, 0.01];

/// Pins and clips of a hairstyle.
pub(super) fn pins(hairstyle: &Hairstyle, head: &Head) -> Vec<Accessory> {
    let pinned = |grip: &Grip| match *grip {
        Grip::Clip { at, by: Fastener::Pin { middle }, .. } => Some((at, middle)),
        _ => None,
    };
    let clipped = |grip: &Grip| match *grip {
        Grip::Clip { at, to, by: Fastener::Clip } => Some((at, to)),
        _ => None,
    };
    let pins = bundles(hairstyle, pinned, AROUND);
    let mut pins: Vec<Accessory> =
        pins.iter().filter_map(|pieces| Lying::new(pieces, hairstyle, head)?.pin(head)).collect();
    pins.sort_by(|a, b| a.wisps.cmp(&b.wisps));
    let clips = bundles(hairstyle, clipped, AROUND).into_iter().map(together);
    let mut clips: Vec<Accessory> =
        clips.filter_map(|pieces| Lying::new(&pieces, hairstyle, head)?.clip(head)).collect();
    clips.sort_by(|a, b| a.wisps.cmp(&b.wisps));
    pins.into_iter().chain(clips).collect()
}

/// The pieces of hair that came together where they are held: hair that is pulled towards the same point from afar is not in the clip.
fn together(pieces: Vec<Piece>) -> Vec<Piece> {
    let places: Vec<DVec3> = pieces.iter().map(|piece| piece.at(0).0).collect();
    let near = |p: DVec3| places.iter().filter(|q| q.distance(p) <= CLIPPED).count();
    // The most hair; the first of equal ones.
    let most = (0..places.len()).rev().max_by_key(|&i| near(places[i]));
    let Some(middle) = most.map(|i| places[i]) else { return pieces };
    pieces.into_iter().filter(|piece| piece.at(0).0.distance(middle) <= CLIPPED).collect()
}

/// Hair that something lies across.
struct Lying {
    wisps: Vec<usize>,
    centre: DVec3,
    /// Direction (unit) across the hair, along the skin.
    across: DVec3,
    /// Direction (unit) out of the hair, away from the skin.
    out: DVec3,
    /// From the centre to either side, and outwards (m), as far as hair reaches.
    reach: (f64, f64),
    /// From the centre towards the skin (m), as far as the held hair reaches.
    under: f64,
}

impl Lying {
    fn new(pieces: &[Piece], hairstyle: &Hairstyle, head: &Head) -> Option<Self> {
        let first = pieces.first()?;
        let Axis { centre, direction } = mean(pieces, 0);
        let (_, gradient) = head.signed_distance().value_gradient(centre);
        let out = (gradient - gradient.dot(direction) * direction)
            .normalize_or(direction.any_orthonormal_vector());
        let across = direction.cross(out);
        let most = |along: DVec3| {
            let reach = |piece: &Piece| (piece.at(0).0 - centre).dot(along).abs();
            pieces.iter().map(reach).fold(0.0, f64::max)
        };
        let alone = first.thickness.min(3e-3);
        let reach = (most(across).max(alone), most(out).max(0.5 * alone));
        let wisps = pieces.iter().map(|piece| piece.wisp).collect();
        let under = reach.1;
        let mut lying = Self { wisps, centre, across, out, reach, under };
        lying.reach.1 = lying.over(hairstyle, direction).max(lying.reach.1);
        Some(lying)
    }

    /// How far outwards (m) any hair reaches that lies where the pin does: what hangs over the held hair is under the pin too.
    fn over(&self, hairstyle: &Hairstyle, direction: DVec3) -> f64 {
        let half = 0.5 * self.length();
        let height = |p: DVec3| {
            let away = p - self.centre;
            let near = away.dot(self.across).abs() < half && away.dot(direction).abs() < BESIDE;
            let out = away.dot(self.out);
            (near && out < THICKEST).then_some(out)
        };
        let guides = hairstyle.equilibria().iter().zip(hairstyle.guides());
        let highest = guides.map(|(rest, guide)| {
            let count = (rest.rod.length() / BESIDE).ceil() as usize + 1;
            let thickness = guide.thickness.packed(0.5 * rest.rod.length()).min(BESIDE);
            let out = rest.centre_line(count).into_iter().filter_map(height);
            out.fold(f64::NEG_INFINITY, f64::max) + 0.5 * thickness
        });
        highest.fold(0.0, f64::max)
    }

    fn length(&self) -> f64 {
        (2.0 * (self.reach.0 + MORE)).clamp(LENGTHS.0, LENGTHS.1)
    }

    /// A point (m) on the hair and the direction (unit) out of the skin there: from the centre so far along the pin and out of the hair
    /// (m), and at least `off` (m) off the skin.
    fn place(&self, head: &Head, along: f64, out: f64, off: f64) -> (DVec3, DVec3) {
        let mut p = self.centre + along * self.across + out * self.out;
        let skin = head.signed_distance();
        for _ in 0..3 {
            let (distance, gradient) = skin.value_gradient(p);
            p += (off - distance).max(0.0) * gradient.normalize_or(self.out);
        }
        let (_, gradient) = skin.value_gradient(p);
        let up = gradient.normalize_or(self.out);
        (p, (up + self.out).normalize_or(self.out))
    }

    /// A bobby pin: one prong on the hair and one under it, joined at one end.
    fn pin(self, head: &Head) -> Option<Accessory> {
        let length = self.length();
        let half = 0.5 * length;
        let at = |k: usize| length * k as f64 / (POINTS - 1) as f64 - half;
        let [_, height] = PRONG;
        let mut path: Vec<(DVec3, DVec3)> = (0..POINTS)
            .map(|k| {
                // Over the hair in the middle, and down to the skin at the ends.
                let x = (at(k) / (self.reach.0 + 0.5 * MORE)).abs().min(1.0);
                let over = (self.reach.1 + height) * (1.0 - x * x);
                self.place(head, at(k), over, OFF_SKIN + OPEN)
            })
            .collect();
        let (over, _) = path[POINTS - 1];
        let under = |k: usize| self.place(head, at(k), -self.under - height, OFF_SKIN).0;
        path.extend(self.bend(over, under(POINTS - 1)));
        path.extend((0..POINTS).rev().map(|k| (under(k), -self.out)));
        let mesh = bar(&path, PRONG)?;
        self.accessory(AccessoryKind::Pin, mesh, head, [PRONG[0], length])
    }

    /// Points and directions as those of [`Self::place`] on a half circle from one point (m) to another, without both.
    fn bend(&self, from: DVec3, to: DVec3) -> impl Iterator<Item = (DVec3, DVec3)> {
        const POINTS: usize = 6;
        let (middle, arm) = (0.5 * (from + to), 0.5 * (from - to));
        let (along, out) = (self.across, self.out);
        (1..POINTS).map(move |k| {
            let (sine, cosine) = (std::f64::consts::PI * k as f64 / POINTS as f64).sin_cos();
            let p = middle + cosine * arm + sine * arm.length() * along;
            (p, cosine * out + sine * along)
        })
    }

    /// A bar across the hair, on its outside.
    fn clip(self, head: &Head) -> Option<Accessory> {
        let length = self.length();
        let out = self.reach.1 + BAR[1];
        let at = |k: usize| length * (k as f64 / (POINTS - 1) as f64 - 0.5);
        let path: Vec<(DVec3, DVec3)> =
            (0..POINTS).map(|k| self.place(head, at(k), out, OFF_SKIN + BAR[1])).collect();
        let mesh = bar(&path, BAR)?;
        self.accessory(AccessoryKind::Clip, mesh, head, [BAR[0], length])
    }

    fn accessory(
        self,
        kind: AccessoryKind,
        mesh: frisure_strands::Surface,
        head: &Head,
        [radius, length]: [f64; 2],
    ) -> Option<Accessory> {
        let Self { wisps, centre, across: axis, .. } = self;
        let clear = clearance(&mesh, head) > 0.0;
        clear.then_some(Accessory { kind, wisps, centre, axis, radius, length, mesh })
    }
}
