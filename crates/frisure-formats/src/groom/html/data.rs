//! The groom of a page: whole numbers, compressed, as text. `page/groom.js` reads it.
//!
//! Coordinates are multiples of [`STEP`] from the low corner. Of each strand the root is stored as its difference from the
//! root before, and each following point as the change of the difference: a smooth hair has small ones. Numbers are written
//! in 7 bits a byte with the sign in the lowest bit, deflated, and in base 64.
//!
//! Strands are in another order: any first part of them is spread over the head, so that a slow machine can draw only that
//! part while the hair is turned.

use std::io::{self, Write};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use frisure_strands::{AttributeValues, Domain, Strands, Surface};
use glam::{DVec3, Vec3};
use serde_json::json;

use super::super::attributes::COLOUR;
use super::super::data::Groom;

/// Distance between coordinates that can be stored (m): a hair is as far from its place as half its thickness at most.
const STEP: f64 = 4e-5;

/// Largest distance from the low corner (m). Chosen: coordinates and their second differences stay below 2^28.
const FARTHEST: f64 = 2000.0;

/// Colour of hair without a colour, linear: brown.
const BROWN: [f32; 3] = [0.1, 0.05, 0.025];

/// The parts of a page that are its groom.
pub(super) struct PageData {
    /// What stands in JSON.
    pub(super) header: String,
    /// The numbers, compressed, in base 64.
    pub(super) text: String,
}

/// Checks that coordinates and colours can be written.
pub(super) fn check(strands: &Strands, head: Option<&Surface>) -> Result<(), String> {
    let size = (corner(strands, head).1 - corner(strands, head).0).max_element();
    if size > FARTHEST {
        return Err(format!("hair {size:.0} m across: at most {FARTHEST} m"));
    }
    if let Some(head) = head
        && i32::try_from(head.positions().len()).is_err()
    {
        return Err(format!("a head of {} vertices", head.positions().len()));
    }
    Ok(())
}

impl PageData {
    pub(super) fn new(groom: &Groom) -> io::Result<Self> {
        let strands = groom.strands();
        let low = corner(strands, groom.head.as_ref()).0;
        let order = spread(strands.len());
        let widest = 2.0 * strands.radii().iter().copied().fold(0.0, f32::max);
        let same = strands.strand(0).points.len();
        let same = if strands.iter().all(|s| s.points.len() == same) { same } else { 0 };
        let mut out = Numbers(Vec::new());
        for &s in order.iter().filter(|_| same == 0) {
            out.push(strands.strand(s).points.len() as i32);
        }
        (0..3).for_each(|axis| out.coordinate(strands, &order, axis, low[axis]));
        out.widths(strands, &order, widest);
        let colours = out.colours(strands, &order);
        if let Some(head) = &groom.head {
            out.head(head, low);
        }
        let mut deflate = DeflateEncoder::new(Vec::new(), Compression::best());
        deflate.write_all(&out.0)?;
        let text = STANDARD.encode(deflate.finish()?);
        let head = groom.head.as_ref().map(
            |head| json!({ "vertices": head.positions().len(), "faces": head.triangles().len() }),
        );
        let colour = groom.colour.map_or(BROWN, |c| c.colour).map(to_srgb8);
        let header = json!({
            "strands": strands.len(), "points": strands.points().len(), "count": same,
            "low": low.to_array(), "step": STEP, "widest": widest,
            "colour": colour, "colours": colours, "head": head,
        });
        Ok(Self { header: header.to_string(), text })
    }
}

/// The corners of the box around hair and head (m).
fn corner(strands: &Strands, head: Option<&Surface>) -> (DVec3, DVec3) {
    let hair = strands.bounds().map(|(low, high)| (low.as_dvec3(), high.as_dvec3()));
    let boxes = hair.into_iter().chain(head.map(Surface::bounds));
    boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or_default()
}

/// The numbers below `count` in an order of which each first part is evenly spread: steps of about the golden section.
fn spread(count: usize) -> Vec<usize> {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let coprime = |step: &usize| {
        let (mut a, mut b) = (*step, count);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a == 1
    };
    let near = ((count as f64 * GOLDEN) as usize).max(1);
    // 1 is coprime to any count.
    let step = (1..=near).rev().find(coprime).unwrap_or(1);
    (0..count).map(|i| (i as u64 * step as u64 % count.max(1) as u64) as usize).collect()
}

/// Whole numbers in bytes.
struct Numbers(Vec<u8>);

impl Numbers {
    fn push(&mut self, value: i32) {
        let mut rest = ((value << 1) ^ (value >> 31)) as u32;
        while rest > 127 {
            self.0.push((rest & 127) as u8 | 128);
            rest >>= 7;
        }
        self.0.push(rest as u8);
    }

    fn coordinate(&mut self, strands: &Strands, order: &[usize], axis: usize, low: f64) {
        let place = |p: &Vec3| steps(f64::from(p[axis]) - low);
        let mut root = 0;
        for &s in order {
            let (mut before, mut slope) = (None, 0);
            for value in strands.strand(s).points.iter().map(place) {
                match before {
                    None => {
                        self.push(value - root);
                        root = value;
                    }
                    Some(before) => {
                        self.push(value - before - slope);
                        slope = value - before;
                    }
                }
                before = Some(value);
            }
        }
    }

    /// Widths in parts of 255 of the widest.
    fn widths(&mut self, strands: &Strands, order: &[usize], widest: f32) {
        let scale = if widest > 0.0 { 510.0 / widest } else { 0.0 };
        let mut before = 0;
        for radius in order.iter().flat_map(|&s| strands.strand(s).radii) {
            let width = (radius * scale).round() as i32;
            self.push(width - before);
            before = width;
        }
    }

    /// Colours that strands or points have of their own, in the encoding of displays; says which of them.
    fn colours(&mut self, strands: &Strands, order: &[usize]) -> &'static str {
        let own = strands.attribute(COLOUR).map(|a| (a.domain, &a.values));
        let Some((domain, AttributeValues::F32x3(values))) = own else { return "one" };
        let offsets = strands.offsets();
        for channel in 0..3 {
            let mut before = 0;
            for &s in order {
                let rows = match domain {
                    Domain::Strand => s..s + 1,
                    Domain::Point => offsets[s] as usize..offsets[s + 1] as usize,
                };
                for value in &values[rows] {
                    let value = i32::from(to_srgb8(value[channel]));
                    self.push(value - before);
                    before = value;
                }
            }
        }
        if domain == Domain::Strand { "strand" } else { "point" }
    }

    fn head(&mut self, head: &Surface, low: DVec3) {
        for axis in 0..3 {
            let mut before = 0;
            for p in head.positions() {
                let value = steps(p[axis] - low[axis]);
                self.push(value - before);
                before = value;
            }
        }
        let mut before = 0;
        for &corner in head.triangles().as_flattened() {
            // The check refuses more vertices.
            let corner = corner as i32;
            self.push(corner - before);
            before = corner;
        }
    }
}

/// A distance (m) in steps. The check refuses those that have no room.
fn steps(distance: f64) -> i32 {
    (distance / STEP).round() as i32
}

/// Linear light from 0 to 1 in the encoding of displays.
fn to_srgb8(x: f32) -> u8 {
    let x = x.clamp(0.0, 1.0);
    let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_order_has_every_strand_once_and_its_first_part_is_spread() {
        for count in [1, 2, 3, 10, 999, 20_000] {
            let order = spread(count);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.iter().copied().eq(0..count), "{count}");
        }
        // No gap of the first tenth is three times the mean one.
        let mut part = spread(10_000)[..1000].to_vec();
        part.sort_unstable();
        assert!(part.windows(2).all(|pair| pair[1] - pair[0] < 30));
    }

    proptest! {
        #[test]
        fn numbers_come_back(values in proptest::collection::vec(-(1_i32 << 28)..1 << 28, 0..50)) {
            let mut numbers = Numbers(Vec::new());
            values.iter().for_each(|v| numbers.push(*v));
            let mut at = numbers.0.iter();
            for value in values {
                let (mut found, mut shift) = (0_u32, 0);
                loop {
                    let byte = *at.next().unwrap();
                    found |= u32::from(byte & 127) << shift;
                    shift += 7;
                    if byte < 128 { break; }
                }
                prop_assert_eq!((found >> 1) as i32 ^ -((found & 1) as i32), value);
            }
        }
    }
}
