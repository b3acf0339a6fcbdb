//! Where all guides of a head are, and what they feel there.

use frisure_rod::Equilibrium;
use frisure_rod::derivatives::{DerivativeError, Sensitivity};
use frisure_rod::minimise::SecondVariation;
use frisure_rod::potential::Yielding;
use glam::DVec3;

use super::super::friction_solver::Hold;
use super::super::wisp::{
    Anchor, Settled, Wisp, friction_gaps, press, rest_among, rest_in, wisps_on_bed,
    wisps_with_pairs,
};
use super::hessian::{Controls, JointHessian};
use super::others::Others;
use crate::contact::{Arrival, Density, Departure, FrictionGap, Layer, Pull, SwitchDistance};
use crate::guides::Guide;
use crate::hairstyle::Rest;
use crate::head::Head;
use crate::parallel;
use crate::spec::{HairContact, HairstyleSpec};

/// Least distance (m) beyond their thickness within which neighbours are searched. Chosen: a fraction of a wisp's radius.
const LEAST_REACH: f64 = 6e-4;

/// Reach of a guide after a search, as a multiple of the move ahead: a longer one makes lists longer, a shorter one more
/// searches. Chosen by trial: 3 takes a tenth more time.
const MOVES_PER_SEARCH: f64 = 1.2;

/// Change of the limits of friction, relative to them, and excess of friction over its limit, at which they agree with where
/// wisps are. Asked of a certificate: |f_t| ≤ 1.001 μ f_n.
const AGREEMENT: f64 = 1e-3;

/// Largest derivative by any control of a guide, relative to its moment scale EI/L + ρSgL².
fn steepest(wisp: &Wisp<'_>, gradient: &[DVec3]) -> f64 {
    gradient.iter().map(|v| v.length()).fold(0.0, f64::max) / wisp.moment_scale()
}

/// All guides of a head.
pub(super) struct HeadState<'a> {
    wisps: Vec<Wisp<'a>>,
    others: Others,
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

/// Where one guide would be, while all others hold still.
pub(super) struct GuideArrival {
    settled: Settled,
    points: Vec<DVec3>,
    arrival: Option<Arrival>,
    /// The guide's own part of the energy, and by how much that of all others grows (J).
    pub(super) energy: f64,
}

impl<'a> HeadState<'a> {
    pub(super) fn new(
        spec: &HairstyleSpec,
        head: &'a Head,
        guides: &'a [Guide],
        alone: &'a [Equilibrium],
        hold: Hold,
    ) -> Self {
        let (wisps, others) = match spec.contact.hair {
            HairContact::Density => {
                let wisps = wisps_on_bed(spec, head, guides, alone, hold);
                let strands = wisps.iter().map(Wisp::strand).collect();
                let density = Density::new(strands, spec.contact.hair_stiffness);
                (wisps, Others::Density(Box::new(density)))
            }
            HairContact::Wisps => {
                let (wisps, pairs) = wisps_with_pairs(spec, head, guides, alone, hold);
                (wisps, Others::Pairs(Box::new(pairs)))
            }
            HairContact::None | HairContact::Layers => {
                (wisps_on_bed(spec, head, guides, alone, hold), Others::Apart)
            }
        };
        let count = wisps.len();
        let mut state = Self {
            wisps,
            others,
            stiffness: spec.contact.hair_stiffness,
            layers: guides.iter().map(|guide| guide.layer).collect(),
            anchors: (0..count).map(|_| None).collect(),
            reach: vec![LEAST_REACH; count],
            drift: vec![f64::INFINITY; count],
        };
        state.make_room(&vec![0.0; count]);
        state.measure();
        state
    }

    /// Sets how the hairs inside each wisp stick.
    pub(super) fn set_locks(&mut self, locks: Vec<Option<Yielding>>) {
        for (wisp, lock) in self.wisps.iter_mut().zip(locks) {
            wisp.set_lock(lock);
        }
    }

    /// Lets hairs inside wisps that slipped stick where they are now.
    pub(super) fn follow_locks(&mut self) {
        parallel::for_each_mut(&mut self.wisps, |_, wisp| wisp.follow_lock());
    }

    /// Sets the share of the stiffness with which wisps repel each other. The bed of hair, which stands for the other wisps
    /// while a guide is alone, has the rest.
    pub(super) fn harden(&mut self, share: f64) {
        // Hair of a density is as hard as it is from the start, and its bed stays: which hair lies beneath which is finer
        // than the kernel.
        let Some(pairs) = self.others.pairs_mut() else { return };
        pairs.set_stiffness(self.stiffness * share);
        for (wisp, layer) in self.wisps.iter_mut().zip(&self.layers) {
            wisp.set_layer(layer.scaled(1.0 - share));
        }
    }

    /// Lets friction follow where wisps are: what touches sticks, what slipped is followed by its anchors.
    pub(super) fn press(&mut self) {
        press(&mut self.wisps, self.others.pairs_mut());
    }

    /// Whether the forces of friction agree with where wisps are. docs/theory.md (F3)
    pub(super) fn friction_agrees(&self) -> bool {
        let gaps = friction_gaps(&self.wisps, self.others.pairs());
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
        friction_gaps(&self.wisps, self.others.pairs()).iter().map(|gap| gap.ratio).collect()
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
        self.others.update_neighbours(&self.reach, &used_up);
    }

    /// Counts a move of a fraction of `lengths` (m).
    pub(super) fn moved(&mut self, lengths: &[f64], fraction: f64) {
        for (drift, length) in self.drift.iter_mut().zip(lengths) {
            *drift += fraction * length;
        }
    }

    /// Largest distance (m) that a step moves a node of each guide.
    pub(super) fn lengths(&self, step: &Controls) -> Vec<f64> {
        parallel::map(self.wisps.len(), |i| self.wisps[i].length_of(&step[i]))
    }

    /// Whether hair is a density.
    pub(super) fn is_density(&self) -> bool {
        self.others.is_density()
    }

    /// Where the guides are.
    pub(super) fn shapes(&self) -> Vec<Settled> {
        self.wisps.iter().map(|wisp| wisp.settled().clone()).collect()
    }

    /// Goes a fraction of a step from given shapes.
    pub(super) fn go(&mut self, from: &[Settled], step: &Controls, fraction: f64) {
        let points =
            parallel::map_mut(&mut self.wisps, |i, wisp| wisp.go(&from[i], &step[i], fraction));
        self.others.place(points);
    }

    /// Energy of the head (J), with that of the tethers.
    pub(super) fn energy(&self) -> f64 {
        let share =
            |i: usize| self.wisps[i].share(&*self.others.shared(i), self.anchors[i].as_ref());
        // Summed in order, so that it does not depend on threads.
        parallel::map(self.wisps.len(), share).iter().sum()
    }

    /// The second variation of that energy.
    pub(super) fn hessian(&self) -> JointHessian {
        let coupling = self.others.coupling(self.wisps.len());
        let guides = parallel::map(self.wisps.len(), |i| {
            let around = self.others.around_with(i, &coupling);
            self.wisps[i].second_variation(&*around, self.anchors[i].as_ref())
        });
        JointHessian { guides, coupling }
    }

    /// Guides in groups of which no two change what the other feels, taken in the given order.
    pub(super) fn groups_apart(&self, order: &[usize]) -> Vec<Vec<usize>> {
        self.others.groups_apart(order)
    }

    /// The second variation of the energy by one guide while all others hold still.
    pub(super) fn variation_of(&self, guide: usize) -> SecondVariation {
        let around = self.others.around(guide);
        self.wisps[guide].second_variation(&*around, self.anchors[guide].as_ref())
    }

    /// A guide's own part of the energy (J).
    pub(super) fn energy_of(&self, guide: usize) -> f64 {
        self.wisps[guide].share(&*self.others.around(guide), self.anchors[guide].as_ref())
    }

    /// Largest derivative by any control of one guide, relative to its moment scale.
    pub(super) fn relative_of(&self, guide: usize, gradient: &[DVec3]) -> f64 {
        steepest(&self.wisps[guide], gradient)
    }

    /// Stiffness (N/m) of a tether of each node against which weight and elasticity move a guide by some millimetres.
    pub(super) fn node_firmness(&self, guide: usize) -> f64 {
        self.wisps[guide].node_firmness()
    }

    /// Largest distance (m) that a step moves a node of one guide.
    pub(super) fn length_of(&self, guide: usize, step: &[DVec3]) -> f64 {
        self.wisps[guide].length_of(step)
    }

    /// How far (m) a guide may move before its neighbours are searched again.
    pub(super) fn room_of(&self, guide: usize) -> f64 {
        self.reach[guide] - self.drift[guide]
    }

    /// What the energy of all loses if one guide leaves where it is.
    pub(super) fn departure(&self, guide: usize) -> Option<Departure> {
        self.others.departure(guide)
    }

    /// Where a fraction of a step would take one guide, which has left.
    pub(super) fn arrival(
        &self,
        guide: usize,
        from: Option<&Departure>,
        step: &[DVec3],
        fraction: f64,
    ) -> GuideArrival {
        let wisp = &self.wisps[guide];
        let settled = wisp.after(step, fraction);
        let points = wisp.points_at(&settled);
        let arrival = self.others.arrival(from, &points);
        let around = self.others.around_at(guide, arrival.as_ref());
        let own = wisp.share_at(&settled, &*around, self.anchors[guide].as_ref());
        drop(around);
        let energy = own + arrival.as_ref().map_or(0.0, |arrival| arrival.growth);
        GuideArrival { settled, points, arrival, energy }
    }

    /// Moves one guide alone to where it arrives. [`Self::measure`] has to follow.
    pub(super) fn arrive(&mut self, guide: usize, to: GuideArrival) {
        self.others.arrive(guide, to.points, to.arrival.as_ref());
        self.wisps[guide].take(to.settled);
    }

    /// Counts a move (m) of one guide.
    pub(super) fn moved_alone(&mut self, guide: usize, length: f64) {
        self.drift[guide] += length;
    }

    /// Measures again where all guides are, after some moved alone.
    pub(super) fn measure(&mut self) {
        self.others.measure();
    }

    /// The parts of the derivatives of each guide.
    ///
    /// # Errors
    /// The first guide that has none, and why.
    pub(super) fn sensitivities(&self) -> Result<Vec<Sensitivity>, (usize, DerivativeError)> {
        parallel::try_map(self.wisps.len(), |i| {
            self.wisps[i].sensitivity(&*self.others.around(i)).map_err(|error| (i, error))
        })
    }

    /// How near each guide is to where contact begins or ends.
    pub(super) fn switch_distances(&self) -> Vec<SwitchDistance> {
        parallel::map(self.wisps.len(), |i| {
            let alone = self.wisps[i].switch_distance();
            SwitchDistance { hair: alone.hair.min(self.others.switch_distance(i)), ..alone }
        })
    }

    /// Derivative of the energy by every control (N m), by the stiffness of hair and by that of skin (Pa): ∂g/∂p. The stiffness of skin that a tight
    /// curl needs does not change with that of the description.
    pub(super) fn gradients_by_stiffness(&self, spec: &HairstyleSpec) -> [Controls; 2] {
        let of_hair = |i: usize| {
            let mut gradient = self.wisps[i].gradient_by_hair();
            let others = self.wisps[i].gradient_among(&*self.others.around(i));
            gradient.iter_mut().zip(others).for_each(|(g, of)| *g += of / self.stiffness);
            gradient
        };
        let of_skin = |wisp: &Wisp<'_>| wisp.gradient_by_skin(spec);
        let hair = parallel::map(self.wisps.len(), of_hair);
        [hair, parallel::map_slice(&self.wisps, of_skin)]
    }

    /// Largest derivative by any control, relative to the moment scale EI/L + ρSgL² of its guide.
    pub(super) fn relative(&self, gradient: &Controls) -> f64 {
        let guides = self.wisps.iter().zip(gradient);
        guides.map(|(wisp, gradient)| steepest(wisp, gradient)).fold(0.0, f64::max)
    }

    /// The guides as they are, each certified to a relative gradient of `tolerance` while the others hold still.
    pub(super) fn rest(&self, tolerance: f64) -> Rest {
        match &self.others {
            Others::Pairs(pairs) => rest_among(&self.wisps, pairs, tolerance),
            Others::Density(_) | Others::Apart => {
                rest_in(&self.wisps, |guide| self.others.around(guide), tolerance)
            }
        }
    }
}
