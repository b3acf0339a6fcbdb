//! Braids the tail of a hair tie in three.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::error::StyleError;
use super::gather::PACKING;
use super::settle::{Act, DraftRest};
use crate::contact::{BraidPath, HAIR_PER_LENGTH};
use crate::equilibrium::Effort;
use crate::hairstyle::{Fastener, Grip, Hairstyle, Styling};
use crate::head::Head;

/// Length (m) of hair that is left beyond the elastic at the end of a braid. Chosen.
const TAIL: f64 = 0.04;

/// Fewest pitches of a braid: with fewer no lock comes back to its side. Chosen.
const FEWEST_PITCHES: f64 = 1.0;

/// Room (m) between braid and body. Chosen: the hair between them.
const CLEAR: f64 = 3e-3;

/// Farthest (m) that a braid stands off, and the steps (m) in which that is looked for. Chosen.
const FARTHEST: f64 = 0.3;
const STEP: f64 = 5e-3;

/// A wisp in the tie.
struct Tied {
    wisp: usize,
    /// Which place of it is in the tie, 0 (root) to 1 (tip).
    at: f64,
    /// Where that is, from the middle of the tie (m).
    place: DVec3,
    /// Length beyond (m).
    beyond: f64,
}

/// Braids those of the chosen wisps that are in a tie: a third of them in each lock, by where they are in the tie.
///
/// # Errors
/// [`StyleError::TooShortToBraid`], if half of the hair ends within a pitch.
pub(super) fn braided(act: &Act<'_>, chosen: &[bool]) -> Result<Hairstyle, StyleError> {
    let before = act.before;
    let (mut middle, mut tied) = (DVec3::ZERO, Vec::new());
    for (wisp, state) in before.styling.wisps.iter().enumerate().filter(|(i, _)| chosen[*i]) {
        if let Some(Grip::Clip { at, to, by: Fastener::Tie { middle: of, .. } }) = state.grip {
            middle = of;
            let beyond = before.guides[wisp].rod.length() * (1.0 - at);
            tied.push(Tied { wisp, at, place: to - of, beyond });
        }
    }
    if tied.is_empty() {
        return Ok(before.clone());
    }
    let ways = ways(plan(before, act.head, middle, &tied)?, &tied);
    let laid = |styling: &Styling| {
        let mut styling = styling.clone();
        for &(wisp, at, path) in &ways {
            let state = &mut styling.wisps[wisp];
            state.moved += 1;
            state.grip = Some(Grip::Braid { at, path });
        }
        styling
    };
    // Fingers lay each wisp in its lock before it meets the others.
    let alone = Effort { sweeps: 0, ..Effort::FULL };
    let hand = Act { draft: Some(DraftRest { effort: alone, stride: 1, like: None }), ..*act };
    let in_hand = hand.with(laid(&before.styling))?;
    let styling = laid(&in_hand.styling);
    act.on(&in_hand).with(styling)
}

/// The braid as a whole: how thick it is, how long, and how it hangs.
fn plan(
    hairstyle: &Hairstyle,
    head: &Head,
    middle: DVec3,
    tied: &[Tied],
) -> Result<BraidPath, StyleError> {
    let hairs = hairstyle.grown() / hairstyle.guides.len() as f64;
    let section = |tied: &Tied| hairstyle.guides[tied.wisp].rod.spec().section.area();
    let area = tied.iter().map(section).sum::<f64>() * hairs / PACKING;
    let (away, face) = (middle - head.landmarks().cranium_centre, head.landmarks().face);
    // It hangs along gravity, wherever that pulls in the head's frame.
    let down = hairstyle.spec.pose.down();
    let across_down = |v: DVec3| v - down * v.dot(down);
    let aside = down.any_orthonormal_vector();
    let mut path = BraidPath {
        middle,
        down,
        out: across_down(away).normalize_or(across_down(-face).normalize_or(aside)),
        stand_off: 0.0,
        lock: (area / 3.0 / PI).sqrt(),
        phase: 0.0,
        in_tie: DVec3::ZERO,
        in_lock: [0.0; 2],
        end: 0.0,
    };
    // The elastic is where half of the hair still has its tail.
    let mut lengths: Vec<f64> = tied.iter().map(|tied| tied.beyond).collect();
    lengths.sort_by(f64::total_cmp);
    let beyond = lengths[lengths.len() / 2];
    path.end = (beyond - TAIL) / *HAIR_PER_LENGTH;
    if path.end < FEWEST_PITCHES * path.pitch() {
        let needed = FEWEST_PITCHES * path.pitch() * *HAIR_PER_LENGTH + TAIL;
        return Err(StyleError::TooShortToBraid { beyond, needed });
    }
    path.stand_off = stand_off(head, path);
    Ok(path)
}

/// The least distance (m) by which a braid stands off in the end so that it is clear of head and body on its way.
fn stand_off(head: &Head, path: BraidPath) -> f64 {
    let needed = path.half_depth() + CLEAR;
    let steps = (path.end / STEP).ceil() as usize;
    // Beside the tie hair lies on the head.
    let first = (path.half_depth() / STEP).ceil() as usize + 1;
    let is_clear = |path: &BraidPath| {
        (first..=steps).all(|i| head.signed_distance().value(path.axis(i as f64 * STEP)) >= needed)
    };
    let tries = (0..=(FARTHEST / STEP) as usize).map(|i| i as f64 * STEP);
    let found = tries.into_iter().find(|&off| is_clear(&BraidPath { stand_off: off, ..path }));
    found.unwrap_or(FARTHEST)
}

/// Each wisp with its place in the tie and its way through the braid.
fn ways(plan: BraidPath, tied: &[Tied]) -> Vec<(usize, f64, BraidPath)> {
    let across = plan.across();
    let mut order: Vec<&Tied> = tied.iter().collect();
    order.sort_by(|a, b| {
        let (a_side, b_side) = (a.place.dot(across), b.place.dot(across));
        a_side.total_cmp(&b_side).then(a.wisp.cmp(&b.wisp))
    });
    // Locks begin where sin φ puts them: at −1, in the middle, at +1 across.
    let phases = [2.0 * TAU / 3.0, 0.0, TAU / 3.0];
    let count = order.len();
    let mut all = Vec::with_capacity(count);
    for (lock, phase) in phases.into_iter().enumerate() {
        let (from, to) = (lock * count / 3, (lock + 1) * count / 3);
        for (rank, tied) in order[from..to].iter().enumerate() {
            // Evenly over the round lock: Vogel's spiral.
            let reach = plan.lock * ((rank as f64 + 0.5) / (to - from) as f64).sqrt();
            let angle = rank as f64 * GOLDEN;
            let in_lock = [reach * angle.cos(), reach * angle.sin()];
            let path = BraidPath { phase, in_tie: tied.place, in_lock, ..plan };
            all.push((tied.wisp, tied.at, path));
        }
    }
    all
}

/// The golden angle (rad), π (3 − √5).
const GOLDEN: f64 = 2.399_963_229_728_653;
