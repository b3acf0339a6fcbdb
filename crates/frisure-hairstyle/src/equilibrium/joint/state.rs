//! Where all guides of a head are, and what they feel there.

use frisure_rod::Equilibrium;
use rayon::prelude::*;

use super::super::friction_solver::Hold;
use super::super::wisp::{
    Anchor, Settled, Wisp, friction_gaps, press, rest_among, wisps_with_pairs,
};
use super::hessian::{Controls, JointHessian};
use crate::contact::{ContactPairs, FrictionGap, Layer, Pull};
use crate::guides::Guide;
use crate::hairstyle::Rest;
use crate::head::Head;
use crate::spec::HairstyleSpec;

/// Least distance (m) beyond their thickness within which neighbours are searched. Chosen: a fraction of a wisp's radius.
const LEAST_REACH: f64 = 6e-4;

/// Reach of a guide after a search, as a multiple of the move ahead: a longer one makes lists longer, a shorter one more
/// searches. Chosen by trial: 3 takes a tenth more time.
const MOVES_PER_SEARCH: f64 = 1.2;

/// Change of the limits of friction, relative to them, and excess of friction over its limit, at which they agree with where
/// wisps are. Asked of a certificate: |f_t| ≤ 1.001 μ f_n.
const AGREEMENT: f64 = 1e-3;

/// All guides of a head.
pub(super) struct HeadState<'a> {
    wisps: Vec<Wisp<'a>>,
    pairs: ContactPairs,
    /// Stiffness of hair per length of hair (Pa), in full.
    stiffness: f64,
    /// The bed of hair of each guide, in full.
    layers: Vec<Layer>,
    /// Where each guide is held, if it is.
    anchors: Vec<Option<Anchor>>,
    /// How far each guide may move (m) before its neighbours are searched again …
    reach: Vec<f64>,
    /// How far each guide may have moved (m) since its neighbours were searched.
    drift: Vec<f64>,
}

impl<'a> HeadState<'a> {
    pub(super) fn new(
        spec: &HairstyleSpec,
        head: &'a Head,
        guides: &'a [Guide],
        alone: &'a [Equilibrium],
        hold: Hold,
    ) -> Self {
        let (wisps, pairs) = wisps_with_pairs(spec, head, guides, alone, hold);
        let count = wisps.len();
        let mut state = Self {
            wisps,
            pairs,
            stiffness: spec.contact.hair_stiffness,
            layers: guides.iter().map(|guide| guide.layer).collect(),
            anchors: (0..count).map(|_| None).collect(),
            reach: vec![LEAST_REACH; count],
            drift: vec![f64::INFINITY; count],
        };
        state.make_room(&vec![0.0; count]);
        state
    }

    /// Sets the share of the stiffness with which wisps repel each other. The bed of hair, which stands for the other wisps
    /// while a guide is alone, has the rest.
    pub(super) fn harden(&mut self, share: f64) {
        self.pairs.set_stiffness(self.stiffness * share);
        for (wisp, layer) in self.wisps.iter_mut().zip(&self.layers) {
            wisp.set_layer(layer.scaled(1.0 - share));
        }
    }

    /// Lets friction follow where wisps are: what touches sticks, what slipped is followed by its anchors.
    pub(super) fn press(&mut self) {
        press(&mut self.wisps, &mut self.pairs);
    }

    /// Whether the forces of friction agree with where wisps are. docs/theory.md (F3)
    pub(super) fn friction_agrees(&self) -> bool {
        let gaps = friction_gaps(&self.wisps, &self.pairs);
        let all = gaps.into_iter().fold(FrictionGap::default(), FrictionGap::and);
        all.change <= AGREEMENT * all.limit && all.ratio <= 1.0 + AGREEMENT
    }

    /// Sets what pulls at guides while they let go: a share of what is gone.
    pub(super) fn let_go(&mut self, gone: &[Option<Pull>], share: f64) {
        for (wisp, gone) in self.wisps.iter_mut().zip(gone) {
            wisp.let_go(gone.map(|gone| gone.scaled(share)));
        }
    }

    /// Largest |f_t| / μ f_n of each guide.
    pub(super) fn friction_ratios(&self) -> Vec<f64> {
        friction_gaps(&self.wisps, &self.pairs).iter().map(|gap| gap.ratio).collect()
    }

    /// Holds every guide where it is by a tether of a share of its firmness; with 0 lets go.
    pub(super) fn hold(&mut self, share: f64) {
        let anchor = |wisp: &Wisp<'_>| (share > 0.0).then(|| wisp.anchor(share));
        self.anchors = self.wisps.iter().map(anchor).collect();
    }

    /// Makes sure that neighbours are known while guides move by up to `lengths` (m).
    pub(super) fn make_room(&mut self, lengths: &[f64]) {
        let used_up: Vec<bool> = (lengths.iter().zip(&self.drift).zip(&self.reach))
            .map(|((length, drift), reach)| drift + length > *reach)
            .collect();
        if !used_up.contains(&true) {
            return;
        }
        for i in (0..lengths.len()).filter(|&i| used_up[i]) {
            self.reach[i] = (MOVES_PER_SEARCH * lengths[i]).max(LEAST_REACH);
            self.drift[i] = 0.0;
        }
        self.pairs.update_neighbours(&self.reach, &used_up);
    }

    /// Counts a move of a fraction of `lengths` (m).
    pub(super) fn moved(&mut self, lengths: &[f64], fraction: f64) {
        for (drift, length) in self.drift.iter_mut().zip(lengths) {
            *drift += fraction * length;
        }
    }

    /// Largest distance (m) that a step moves a node of each guide.
    pub(super) fn lengths(&self, step: &Controls) -> Vec<f64> {
        self.wisps.par_iter().zip(step).map(|(wisp, x)| wisp.length_of(x)).collect()
    }

    /// Where the guides are.
    pub(super) fn shapes(&self) -> Vec<Settled> {
        self.wisps.iter().map(|wisp| wisp.settled().clone()).collect()
    }

    /// Goes a fraction of a step from given shapes.
    pub(super) fn go(&mut self, from: &[Settled], step: &Controls, fraction: f64) {
        let points: Vec<_> = (self.wisps.par_iter_mut().enumerate())
            .map(|(i, wisp)| wisp.go(&from[i], &step[i], fraction))
            .collect();
        for (i, points) in points.into_iter().enumerate() {
            self.pairs.place(i, points);
        }
    }

    /// Energy of the head (J), with that of the tethers.
    pub(super) fn energy(&self) -> f64 {
        let share =
            |(i, wisp): (usize, &Wisp<'_>)| wisp.share(&self.pairs, i, self.anchors[i].as_ref());
        // Summed in order, so that it does not depend on threads.
        self.wisps.par_iter().enumerate().map(share).collect::<Vec<f64>>().iter().sum()
    }

    /// The second variation of that energy.
    pub(super) fn hessian(&self) -> JointHessian {
        let guides = (self.wisps.par_iter().enumerate())
            .map(|(i, wisp)| wisp.second_variation(&self.pairs, i, self.anchors[i].as_ref()))
            .collect();
        let contacts =
            (0..self.wisps.len()).into_par_iter().map(|i| self.pairs.contacts(i)).collect();
        JointHessian { guides, contacts }
    }

    /// Largest derivative by any control, relative to the moment scale EI/L + ρSgL² of its guide.
    pub(super) fn relative(&self, gradient: &Controls) -> f64 {
        let of_guide = |(wisp, g): (&Wisp<'_>, &Vec<glam::DVec3>)| {
            g.iter().map(|v| v.length()).fold(0.0, f64::max) / wisp.moment_scale()
        };
        self.wisps.iter().zip(gradient).map(of_guide).fold(0.0, f64::max)
    }

    /// The guides as they are, each certified to a relative gradient of `tolerance` while the others hold still.
    pub(super) fn rest(&self, tolerance: f64) -> Rest {
        rest_among(&self.wisps, &self.pairs, tolerance)
    }
}
