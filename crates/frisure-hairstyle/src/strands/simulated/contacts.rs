//! Simulated hairs that push each other: first each at rest in its tube, then all together.

use frisure_progress::{Cancelled, Progress, StageCounter};
use frisure_rod::batch::{BatchSolution, ConfinementTube, Contact, ContactField};
use frisure_rod::{Node, Rod, Stability};
use glam::DVec3;

use super::envelope::{Envelope, Room};
use super::{CHUNK, ELEMENTS, Planned, Rested, Simulated, Simulation, TOLERANCE, counts};
use crate::implantation::Root;
use crate::parallel;
use crate::strand_contact::{InteractionForm, SettledStrands, StrandSystem, settle, stages};
use crate::strands::curve::Hair;

/// A hair at rest in its tube.
struct Started<'a> {
    planned: Planned<'a>,
    rod: Rod,
    /// Turns of its joints (rad).
    controls: Vec<DVec3>,
}

/// Hairs as they are drawn, if they are known; hairs at rest in their tubes; and their counts.
type Begun<'a> = (Vec<Option<Hair>>, Vec<Started<'a>>, Simulation);

/// Envelopes of hairs of as many elements each, one after the other.
struct Envelopes<'a> {
    /// The first hair of each, and the envelope.
    groups: Vec<(usize, Envelope<'a>)>,
}

impl<'a> Envelopes<'a> {
    fn of(&self, hair: usize) -> (&Envelope<'a>, usize) {
        let group = self.groups.partition_point(|(first, _)| *first <= hair) - 1;
        let (first, envelope) = &self.groups[group];
        (envelope, hair - first)
    }
}

impl ContactField for Envelopes<'_> {
    fn confinement(&self, hair: usize, s: f64) -> ConfinementTube {
        let (envelope, hair) = self.of(hair);
        envelope.confinement(hair, s)
    }

    fn contact(&self, hair: usize, s: f64, position: DVec3) -> Contact {
        let (envelope, hair) = self.of(hair);
        envelope.contact(hair, s, position)
    }
}

impl<'a> Simulated<'a> {
    /// The hairs rooted at some places, in their order, in contact with each other.
    ///
    /// # Errors
    /// [`Cancelled`], if the progress says so.
    pub(in crate::strands) fn in_contact(
        &self,
        roots: &[(usize, Root)],
        form: InteractionForm,
        stage: &StageCounter<'_>,
        progress: &dyn Progress,
    ) -> Result<(Vec<Hair>, Simulation), Cancelled> {
        let (mut drawn, started, mut simulation) = self.started(roots, stage)?;
        if started.is_empty() {
            return Ok((drawn.into_iter().flatten().collect(), simulation));
        }
        let elements: Vec<usize> = started.iter().map(|hair| hair.controls.len()).collect();
        let envelopes = self.envelopes(&started);
        let represented = (self.hairstyle.grown() / roots.len() as f64).max(1.0);
        let guides = self.population.guides;
        // What a hair stands for goes its way, and packs like wires.
        let radius =
            |hair: &Started<'_>| hair.rod.spec().section.mean_radius() * represented.sqrt();
        let friction = |hair: &Started<'_>| guides[hair.planned.binding.main()].friction;
        let system = StrandSystem {
            rods: started.iter().map(|hair| hair.rod.clone()).collect(),
            elements: elements.clone(),
            radii: started.iter().map(radius).collect(),
            friction: started.iter().map(friction).collect(),
            form,
            field: &envelopes,
        };
        let controls = started.iter().flat_map(|hair| &hair.controls).copied().collect();
        let stage = StageCounter::new(progress, "hairs in contact", stages());
        let SettledStrands { controls, mut certificate } =
            settle(&system, controls, TOLERANCE, &stage)?;
        certificate.represented = represented;
        simulation.contact = Some(certificate);
        let mut first = 0;
        let places: Vec<(usize, &Started<'_>)> = (started.iter().zip(&elements))
            .map(|(hair, n)| {
                first += n;
                (first - n, hair)
            })
            .collect();
        let hairs = parallel::map_slice(&places, |(first, hair)| {
            let n = hair.controls.len();
            (hair.planned.place, self.line(hair, controls[*first..first + n].to_vec()))
        });
        for (place, hair) in hairs {
            drawn[place] = Some(hair);
        }
        Ok((drawn.into_iter().flatten().collect(), simulation))
    }

    /// Hairs at rest in their tubes, those of as many elements together; all others as they are drawn.
    fn started(
        &self,
        roots: &[(usize, Root)],
        stage: &StageCounter<'_>,
    ) -> Result<Begun<'a>, Cancelled> {
        let chunk = |roots: &[(usize, Root)]| {
            stage.check()?;
            let (mut drawn, groups) = self.groups(roots);
            let mut started: Vec<Vec<Started<'a>>> = Vec::new();
            let mut simulation = Simulation::default();
            for (group, elements) in groups.into_iter().zip(ELEMENTS) {
                let Rested { found, .. } = self.settle(&group, elements);
                simulation = simulation.and(counts(&found, elements));
                let mut some = Vec::new();
                let hairs = group.planned.into_iter().zip(group.rods).enumerate();
                for (hair, (planned, rod)) in hairs {
                    if found.rods[hair].stability == Stability::Stable {
                        let controls = found.controls[hair * elements..][..elements].to_vec();
                        some.push(Started { planned, rod, controls });
                    } else {
                        let (index, root) = &roots[planned.place];
                        drawn[planned.place] = Some(self.population.hair(root, *index));
                    }
                    stage.advance();
                }
                started.push(some);
            }
            Ok((drawn, started, simulation))
        };
        let chunks: Vec<_> = roots.chunks(CHUNK).collect();
        let chunks = parallel::try_map(chunks.len(), |i| chunk(chunks[i]))?;
        let mut drawn = Vec::with_capacity(roots.len());
        let mut groups: Vec<Vec<Started<'a>>> = ELEMENTS.iter().map(|_| Vec::new()).collect();
        let mut simulation = Simulation::default();
        for (some, started, of) in chunks {
            let first = drawn.len();
            drawn.extend(some);
            simulation = simulation.and(of);
            for (group, some) in groups.iter_mut().zip(started) {
                group.extend(some.into_iter().map(|mut hair| {
                    hair.planned.place += first;
                    hair
                }));
            }
        }
        Ok((drawn, groups.into_iter().flatten().collect(), simulation))
    }

    /// The skin, and tubes as wide as wisps.
    fn envelopes(&self, started: &[Started<'a>]) -> Envelopes<'_> {
        let mut first = 0;
        let groups = started.chunk_by(|a, b| a.controls.len() == b.controls.len());
        let groups: Vec<_> = groups
            .map(|group| {
                first += group.len();
                (first - group.len(), group)
            })
            .collect();
        let envelope = |&(first, group): &(usize, &[Started<'a>])| {
            let elements = group[0].controls.len();
            let mut envelope = Envelope::new(self.population, Room::Wisp, elements, group.len());
            for Started { planned, rod, .. } in group {
                envelope.add(&planned.binding, rod.length());
            }
            (first, envelope)
        };
        Envelopes { groups: parallel::map_slice(&groups, envelope) }
    }

    /// The drawn line of a hair whose joints are turned so (rad).
    fn line(&self, hair: &Started<'_>, controls: Vec<DVec3>) -> Hair {
        let elements = controls.len();
        let shape = BatchSolution { elements, controls, rods: Vec::new() }.shape(&hair.rod, 0);
        let nodes: Vec<Node> = (shape.positions.iter().zip(&shape.frames))
            .map(|(position, frame)| Node { position: *position, tangent: frame.z_axis })
            .collect();
        self.drawn(&hair.planned, &hair.rod, &nodes)
    }
}
