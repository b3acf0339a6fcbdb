//! What a hair feels: the skin, and the hairs around it.

use frisure_rod::batch::{Surroundings, Touch};
use glam::{DMat3, DVec3};

use crate::contact::outer;
use crate::spec::Body;
use crate::strands::course::Course;
use crate::strands::population::Population;
use crate::strands::skin::LEAST_DISTANCE;

/// The skin, and around each hair a tube between its neighbours.
///
/// Hairs of a wisp lie side by side: each has the tube of the radius ρ for itself in which hairs of one wisp wander
/// (see [`crate::contact::Thickness`]), about the place that it is carried to by its guides. Beyond it neighbours push
/// back, softly at first (van Wyk 1946): `k e³/6ρ` for the distance e beyond, k the stiffness of hair. That is a mean
/// field: neighbours do not answer.
///
/// Skin begins a little outside, where the line of a hair has to be: `k e³/6m` for the depth e below that margin m, k
/// the stiffness of skin. It begins as softly as hair, since what begins at once takes Newton's steps to and fro.
pub(super) struct Envelope<'a> {
    population: &'a Population<'a>,
    elements: usize,
    /// Factor on all stiffnesses.
    pub(super) hardness: f64,
    /// Length of an element of each hair (m).
    lengths: Vec<f64>,
    /// Of the ends of links, those of a hair one after the other.
    places: Vec<Place>,
}

/// Where the end of a link would be between its guides.
struct Place {
    /// There (m).
    at: DVec3,
    /// ρ (m).
    wide: f64,
    /// Distance (m) from the skin.
    clear: f64,
}

/// Steepest slope of the distance from the skin: it is 1 but for the smoothing.
const STEEPEST: f64 = 1.25;

/// How much wider the tube of a hair is that leaves its wisp.
const STRAY: f64 = 12.0;

impl<'a> Envelope<'a> {
    pub(super) fn new(population: &'a Population<'a>, elements: usize, hairs: usize) -> Self {
        let places = Vec::with_capacity(elements * hairs);
        Self { population, elements, hardness: 1.0, lengths: Vec::with_capacity(hairs), places }
    }

    /// The next hair, of a length (m).
    pub(super) fn add(&mut self, course: &Course<'_>, length: f64) {
        let h = length / self.elements as f64;
        let thickness = &self.population.guides[course.main()].thickness;
        let wide = if course.stray() { STRAY } else { 1.0 };
        for joint in 0..self.elements {
            let s = (h * (joint as f64 + 1.5)).min(length);
            let at = self.population.followed_point(course, s / course.length);
            let clear = match self.population.spec.contact.body {
                Body::None => f64::INFINITY,
                _ => self.population.head.signed_distance().value(at),
            };
            self.places.push(Place { at, wide: wide * thickness.tube(s), clear });
        }
        self.lengths.push(h);
    }

    /// Energy, gradient and Hessian per length of what begins at `e = 0` with the stiffness `k e/m`, for a distance
    /// that has these derivatives.
    fn pushed(
        &self,
        k: f64,
        m: f64,
        e: f64,
        gradient: DVec3,
        hessian: DMat3,
    ) -> (f64, DVec3, DMat3) {
        let stiffness = self.hardness * k * e / m;
        let force = 0.5 * stiffness * e;
        (force * e / 3.0, gradient * force, outer(gradient, gradient) * stiffness + hessian * force)
    }
}

impl Surroundings for Envelope<'_> {
    fn felt(&self, hair: usize, s: f64, position: DVec3) -> Touch {
        let joint = ((s / self.lengths[hair] - 1.0) as usize).min(self.elements - 1);
        let Place { at, wide, clear } = self.places[hair * self.elements + joint];
        let contact = &self.population.spec.contact;
        let mut free = f64::INFINITY;
        let mut felt: Option<(f64, DVec3, DMat3)> = None;
        let mut add = |(energy, gradient, hessian): (f64, DVec3, DMat3)| {
            let sum = felt.get_or_insert((0.0, DVec3::ZERO, DMat3::ZERO));
            *sum = (sum.0 + energy, sum.1 + gradient, sum.2 + hessian);
        };
        let away = position - at;
        let distance = away.length();
        if distance < wide {
            free = wide - distance;
        } else {
            let n = away / distance;
            let round = (DMat3::IDENTITY - outer(n, n)) * (1.0 / distance);
            add(self.pushed(contact.hair_stiffness, wide, distance - wide, n, round));
        }
        let margin = LEAST_DISTANCE * (s / 0.003).min(1.0);
        let clear = clear - STEEPEST * distance - margin;
        if clear > 0.0 {
            free = free.min(clear / STEEPEST);
        } else {
            let skin = self.population.head.signed_distance();
            let out = skin.value(position) - margin;
            if out > 0.0 {
                free = free.min(out);
            } else {
                let (distance, gradient, hessian) = skin.value_gradient_hessian(position);
                let (gradient, hessian) = (-gradient, -hessian);
                add(self.pushed(contact.stiffness, margin, margin - distance, gradient, hessian));
            }
        }
        match felt {
            None => Touch::Free(free),
            Some((energy, gradient, hessian)) => Touch::Felt { energy, gradient, hessian },
        }
    }
}
