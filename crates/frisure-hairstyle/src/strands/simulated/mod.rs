//! Drawn hairs that are rods themselves: each with its own fibre and its own rest, on the skin and among the
//! hairs around it.
//!
//! Hundreds of them rest side by side in the lanes of vectors ([`frisure_rod::batch`]). They start where their guides
//! put them, turned as the guide that they follow.

mod checkpoint;
mod contacts;
mod envelope;
mod fibre;
mod key;
mod simulation;

use frisure_rod::batch::{Batch, BatchSolution, Frames, InitialShape, RodSolution};
use frisure_rod::{Node, Rod, Stability, centre_line};
use glam::{DMat3, DQuat, DVec3};

use super::binding::StrandBinding;
use super::curve::Hair;
use super::population::Population;
use super::skin::{Free, LAID};
use crate::hairstyle::Hairstyle;
use crate::implantation::Root;
use crate::parallel;
pub use checkpoint::Checkpoint;
use checkpoint::{part_from_bytes, part_to_bytes};
use envelope::{Envelope, Room};
use frisure_progress::{Cancelled, StageCounter};
pub(crate) use key::key;
pub use simulation::Simulation;

/// How many elements hairs have: the least of these that resolves the curl.
const ELEMENTS: [usize; 11] = [12, 16, 20, 24, 32, 48, 64, 96, 128, 192, 256];

/// Elements per turn of the natural curl: the tip is then within a per cent of the length (docs/validation.md).
const PER_TURN: f64 = 6.0;

/// Longest element (m): contact with the skin is evaluated at joints. Chosen by trial; not measured further.
const LONGEST: f64 = 0.012;

/// Hairs that are looked after together: enough to keep vectors filled. Chosen; a part of a checkpoint is one of these.
const CHUNK: usize = 1024;

/// Gradient at rest, relative to the moment of the hair's weight. docs/theory.md, "Hairs that are rods themselves".
const TOLERANCE: f64 = 1e-5;

/// Most iterations of a hair: contact comes and goes. Chosen by trial; the rest goes to `patiently`.
const MAX_ITERATIONS: usize = 400;

/// For a hair that did not come to rest: how hard skin and neighbours are, as fractions of what they are, and by how
/// much (rad) each joint is turned before. They become harder and harder; then a hair on a saddle is pushed off it.
/// Chosen by trial; not measured further.
const PATIENCE: [(f64, f64); 7] =
    [(1e-3, 0.0), (0.03, 0.0), (1.0, 0.0), (1.0, 1e-3), (1.0, -3e-3), (1.0, 0.01), (1.0, -0.03)];

/// Most iterations at each of them. Chosen by trial; not measured further.
const MOST_ITERATIONS: usize = 4000;

/// A hair before it has come to rest.
struct Planned<'a> {
    /// Its place in the chunk.
    place: usize,
    binding: StrandBinding<'a>,
    /// How its root is turned from its guide's.
    turned: DQuat,
}

/// Hairs of as many elements.
#[derive(Default)]
struct Group<'a> {
    planned: Vec<Planned<'a>>,
    /// One for each.
    rods: Vec<Rod>,
}

/// Hairs that have come to rest.
struct Rested {
    found: BatchSolution,
    /// Those of a hair one after the other.
    nodes: Vec<Node>,
}

/// Hairs as rods.
pub(super) struct Simulated<'a> {
    population: &'a Population<'a>,
    hairstyle: &'a Hairstyle,
    /// Material frames of each guide at rest, at its nodes.
    frames: Vec<Vec<DQuat>>,
}

impl<'a> Simulated<'a> {
    pub(super) fn new(population: &'a Population<'a>, hairstyle: &'a Hairstyle) -> Self {
        let quaternion = |frame: &DMat3| DQuat::from_mat3(frame).normalize();
        let frames = (hairstyle.rest.guides.iter())
            .map(|rest| rest.shape.frames.iter().map(quaternion).collect())
            .collect();
        Self { population, hairstyle, frames }
    }

    /// The hairs rooted at some places, in their order; those that a checkpoint has are not simulated again.
    ///
    /// # Errors
    /// [`Cancelled`], if the progress says so.
    pub(super) fn hairs(
        &self,
        roots: &[(usize, Root)],
        stage: &StageCounter<'_>,
        checkpoint: Option<&dyn Checkpoint>,
    ) -> Result<(Vec<Hair>, Simulation), Cancelled> {
        let chunks: Vec<_> = roots.chunks(CHUNK).collect();
        let chunk = |part: usize| {
            let roots = chunks[part];
            let saved = checkpoint.and_then(|checkpoint| checkpoint.find(part));
            if let Some(known) = saved.and_then(|bytes| part_from_bytes(bytes, roots.len())) {
                roots.iter().for_each(|_| stage.advance());
                return Ok(known);
            }
            let (hairs, simulation) = self.chunk(roots, stage)?;
            if let Some(checkpoint) = checkpoint {
                checkpoint.save(part, &part_to_bytes(&hairs, simulation));
            }
            Ok((hairs, simulation))
        };
        let chunks = parallel::try_map(chunks.len(), chunk)?;
        let mut hairs = Vec::with_capacity(roots.len());
        let mut simulation = Simulation::default();
        for (some, of) in chunks {
            hairs.extend(some);
            simulation = simulation.and(of);
        }
        Ok((hairs, simulation))
    }

    fn chunk(
        &self,
        roots: &[(usize, Root)],
        stage: &StageCounter<'_>,
    ) -> Result<(Vec<Hair>, Simulation), Cancelled> {
        let (mut drawn, groups) = self.groups(roots);
        let mut simulation = Simulation::default();
        for (group, elements) in groups.into_iter().zip(ELEMENTS) {
            stage.check()?;
            let Rested { found, nodes } = self.settle(&group, elements);
            let Group { planned, rods } = group;
            simulation = simulation.and(counts(&found, elements));
            for (hair, (planned, rod)) in planned.into_iter().zip(&rods).enumerate() {
                let place = planned.place;
                let nodes = &nodes[hair * (elements + 1)..(hair + 1) * (elements + 1)];
                drawn[place] = Some(match found.rods[hair].stability {
                    Stability::Stable => self.drawn(&planned, rod, nodes),
                    // On its way a hair can be anywhere: it is drawn between its guides.
                    _ => self.population.hair(&roots[place].1, roots[place].0),
                });
                stage.advance();
            }
        }
        Ok((drawn.into_iter().flatten().collect(), simulation))
    }

    /// Hairs rooted at some places by their number of elements, and those that are too short for rods, as they are drawn.
    fn groups(&self, roots: &[(usize, Root)]) -> (Vec<Option<Hair>>, Vec<Group<'a>>) {
        let mut drawn: Vec<Option<Hair>> = Vec::new();
        drawn.resize_with(roots.len(), || None);
        let mut groups: Vec<Group<'a>> = ELEMENTS.iter().map(|_| Group::default()).collect();
        for (place, (index, root)) in roots.iter().enumerate() {
            // It deviates by its own physics, not by chance.
            let binding = self.population.bind(root, *index).without_deviation();
            let Some(rod) = fibre::rod(self.population, &binding, *index) else {
                drawn[place] = Some(self.population.hair(root, *index));
                continue;
            };
            // The turn from the root of its guide to its own, which the whole start shape takes.
            let frame = DQuat::from_mat3(&rod.root().frame());
            let turned = frame * self.frames[binding.main()][0].inverse();
            let group = &mut groups[division(&rod)];
            group.planned.push(Planned { place, binding, turned });
            group.rods.push(rod);
        }
        (drawn, groups)
    }

    /// A hair whose nodes are at rest.
    fn drawn(&self, planned: &Planned<'_>, rod: &Rod, nodes: &[Node]) -> Hair {
        let StrandBinding { root, thickness, cut, .. } = &planned.binding;
        Hair {
            guide: planned.binding.main() as u32,
            thickness: *thickness,
            cut: *cut,
            points: self.points(root, rod.length(), nodes),
        }
    }

    /// Brings hairs of `elements` elements to rest, each in its tube.
    fn settle(&self, group: &Group<'_>, elements: usize) -> Rested {
        let Group { planned, rods } = group;
        let mut envelope = Envelope::new(self.population, Room::Hair, elements, planned.len());
        for (Planned { binding, .. }, rod) in planned.iter().zip(rods) {
            envelope.add(binding, rod.length());
        }
        let frames = |hair: usize, s: f64| self.frame(&planned[hair], s);
        let batch = Batch {
            elements,
            tolerance: TOLERANCE,
            max_iterations: MAX_ITERATIONS,
            ..Batch::default()
        };
        // 1. All hairs in lanes. 2. Those that did not come to rest, one by one and step by step.
        let (mut found, mut nodes) =
            batch.solve_in_contact(rods, InitialShape::Frames(&frames), &envelope, 0);
        for (hair, rod) in rods.iter().enumerate() {
            if found.rods[hair].stability == Stability::Stable {
                continue;
            }
            let (again, line) = patiently(&batch, rod, &frames, &mut envelope, hair);
            let iterations = found.rods[hair].iterations + again.rods[0].iterations;
            found.rods[hair] = RodSolution { iterations, ..again.rods[0] };
            found.controls[hair * elements..(hair + 1) * elements].copy_from_slice(&again.controls);
            nodes[hair * (elements + 1)..(hair + 1) * (elements + 1)].copy_from_slice(&line);
        }
        Rested { found, nodes }
    }

    /// The frame that a hair has at arc length `s` (m) if it goes as its guide does, but for having been turned at the
    /// root.
    fn frame(&self, Planned { binding, turned, .. }: &Planned<'_>, s: f64) -> DMat3 {
        let guide = binding.main();
        let frames = &self.frames[guide];
        let last = frames.len() - 1;
        let x = (s / self.hairstyle.guides[guide].rod.length()).min(1.0) * last as f64;
        let i = (x as usize).min(last - 1);
        DMat3::from_quat(*turned * frames[i].lerp(frames[i + 1], x - i as f64).normalize())
    }

    /// The line of a hair at rest, out of the skin.
    fn points(&self, root: &Root, length: f64, nodes: &[Node]) -> Vec<glam::Vec3> {
        let count = self.population.spec.wisps.points;
        let step = length / (count - 1) as f64;
        let mut free = Free::NOWHERE;
        let mut points: Vec<DVec3> = (centre_line(nodes, length, count).enumerate())
            .map(|(k, p)| self.population.skin.lay(root, p, k as f64 * step, LAID, &mut free))
            .collect();
        // A line that still cuts is reported with the depth of hair.
        let _ = self.population.skin.lift_lines(&mut points);
        points.into_iter().map(DVec3::as_vec3).collect()
    }
}

/// Brings a hair to rest step by step, by [`PATIENCE`], from given frames; returns its nodes, too.
fn patiently(
    batch: &Batch,
    rod: &Rod,
    frames: Frames<'_>,
    envelope: &mut Envelope<'_>,
    hair: usize,
) -> (BatchSolution, Vec<Node>) {
    let batch = Batch { max_iterations: MOST_ITERATIONS, ..*batch };
    let mut iterations = 0;
    let mut start = InitialShape::Frames(frames);
    let mut at_rest = None;
    for (hardness, kick) in PATIENCE {
        envelope.hardness = hardness;
        // All joints turned alike about d1: a saddle's negative curvature has some part along that.
        if let InitialShape::Controls(controls) = &mut start {
            controls.iter_mut().for_each(|control| control.x += kick);
        }
        let (found, nodes) =
            batch.solve_in_contact(std::slice::from_ref(rod), start, envelope, hair);
        iterations += found.rods[0].iterations;
        start = InitialShape::Controls(found.controls.clone());
        let stable = found.rods[0].stability == Stability::Stable;
        at_rest = Some((found, nodes));
        if hardness == 1.0 && stable {
            break;
        }
    }
    envelope.hardness = 1.0;
    let (mut found, nodes) = at_rest.expect("there are steps");
    found.rods[0].iterations = iterations;
    (found, nodes)
}

/// How hairs of `elements` elements came to rest.
fn counts(found: &BatchSolution, elements: usize) -> Simulation {
    let at_rest = |hair: &&RodSolution| hair.stability == Stability::Stable;
    Simulation {
        hairs: found.rods.len(),
        at_rest: found.rods.iter().filter(at_rest).count(),
        elements: elements * found.rods.len(),
        iterations: found.rods.iter().map(|hair| hair.iterations).sum(),
        contact: None,
    }
}

/// Which of [`ELEMENTS`] a hair has.
fn division(rod: &Rod) -> usize {
    let length = rod.length();
    let turns = rod.natural().mean(0.0, length).length() * length / std::f64::consts::TAU;
    let needed = (PER_TURN * turns).max(length / LONGEST);
    ELEMENTS.iter().position(|n| *n as f64 >= needed).unwrap_or(ELEMENTS.len() - 1)
}
