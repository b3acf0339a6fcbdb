//! A rod divided into elements, and the shapes that it can take.

use glam::{DMat3, DVec3};

use crate::element::Geometry;
use crate::resolution::ElementKind;
use crate::rod::Rod;
use crate::strain::NaturalStrain;

/// Largest departure (rad) of an element's control from its natural value in a start that is carried over by moments.
/// Chosen: about a quarter of a turn; it bounds how far off a start is where one stiffness is many times another.
const LARGEST_BEND: f64 = 1.5;

/// A rod divided into elements.
///
/// ```
/// use frisure_rod::{
///     Chain, ElementKind, Material, NaturalStrain, Rod, RodSpec, Load, Root, Section, TorsionConstant,
/// };
/// use glam::DVec3;
///
/// // A quarter of a circle with a radius of 10 cm: exact with any number of helix elements.
/// let arc = std::f64::consts::FRAC_PI_2 * 0.1;
/// let rod = Rod::new(RodSpec {
///     length: arc,
///     section: Section::circular(35e-6)?,
///     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
///     torsion: TorsionConstant::SaintVenant,
///     natural: NaturalStrain::helix(0.1, 0.0)?,
///     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
///     load: Load::NONE,
/// })?;
/// let chain = Chain::uniform(&rod, ElementKind::Helix, 3);
/// let shape = chain.natural_shape();
/// assert!((shape.positions[3].length() - 0.1 * 2.0_f64.sqrt()).abs() < 1e-12);
/// // The natural shape has no internal moment.
/// assert!(chain.moments(&shape).iter().all(|moment| moment.length() == 0.0));
/// # Ok::<(), frisure_rod::InvalidQuantity>(())
/// ```
#[derive(Clone, Debug)]
pub struct Chain<'a> {
    rod: &'a Rod,
    kind: ElementKind,
    /// Arc length of each node (m), one more than elements.
    arc: Vec<f64>,
    /// One per element, or a single one when all are equal.
    geometry: Vec<Geometry>,
}

impl<'a> Chain<'a> {
    /// Divides a rod into `elements` equal elements.
    ///
    /// # Panics
    /// If `elements` is zero.
    #[must_use]
    pub fn uniform(rod: &'a Rod, kind: ElementKind, elements: usize) -> Self {
        assert!(elements > 0, "a rod has at least one element");
        let kind = kind.chosen_for(rod);
        let h = rod.length() / elements as f64;
        let arc: Vec<f64> = (0..=elements)
            // The last node is at L exactly: N h may round to less, and a search by arc length would miss the tip.
            .map(|i| if i == elements { rod.length() } else { h * i as f64 })
            .collect();
        let natural = rod.natural();
        let element = |from: f64, to: f64| {
            let middle = 0.5 * (from + to);
            let halves = [natural.mean(from, middle), natural.mean(middle, to)];
            Geometry::new(kind, h, halves, rod.stiffness())
        };
        // Equal elements share one geometry, with the sines and cosines of its natural pieces.
        let geometry = match natural {
            NaturalStrain::Uniform(_) => vec![element(0.0, h)],
            NaturalStrain::Varying(_) => arc.windows(2).map(|s| element(s[0], s[1])).collect(),
        };
        Self { rod, kind, arc, geometry }
    }

    /// The rod.
    #[must_use]
    pub fn rod(&self) -> &'a Rod {
        self.rod
    }

    /// Which curve the elements can take.
    #[must_use]
    pub fn kind(&self) -> ElementKind {
        self.kind
    }

    /// Number of elements.
    #[must_use]
    pub fn len(&self) -> usize {
        self.arc.len() - 1
    }

    /// Always false: there is at least one element.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Arc length of each node (m), one more than elements.
    #[must_use]
    pub fn arc(&self) -> &[f64] {
        &self.arc
    }

    #[inline]
    pub(crate) fn geometry(&self, element: usize) -> &Geometry {
        if self.geometry.len() == 1 { &self.geometry[0] } else { &self.geometry[element] }
    }

    /// The same rod with each jointed element as three, whose motions are its halves and its joint; `None` for helices. A
    /// derivative by the natural strain of a half is one by the control of its piece.
    pub(crate) fn in_pieces(&self) -> Option<Self> {
        let mut arc = vec![self.arc[0]];
        let mut geometry = Vec::with_capacity(3 * self.len());
        for (i, ends) in self.arc.windows(2).enumerate() {
            geometry.extend(self.geometry(i).pieces()?);
            let middle = 0.5 * (ends[0] + ends[1]);
            arc.extend([middle, middle, ends[1]]);
        }
        Some(Self { rod: self.rod, kind: self.kind, arc, geometry })
    }

    /// The natural shape.
    #[must_use]
    pub fn natural_shape(&self) -> Shape {
        self.shape((0..self.len()).map(|i| self.geometry(i).rest()).collect())
    }

    /// The shape at given controls (rad), one per element.
    ///
    /// # Panics
    /// If there is not one control per element.
    #[must_use]
    pub fn shape(&self, controls: Vec<DVec3>) -> Shape {
        assert_eq!(controls.len(), self.len(), "one control per element");
        let mut frames = Vec::with_capacity(self.arc.len());
        let mut positions = Vec::with_capacity(self.arc.len());
        let (mut frame, mut position) = (self.rod.root().frame(), self.rod.root().position());
        frames.push(frame);
        positions.push(position);
        // r⁺ = r + R p(c), R⁺ = R Q(c), from root to tip.
        for (i, &c) in controls.iter().enumerate() {
            let motion = self.geometry(i).motion(c);
            position += frame * motion.advance();
            frame *= motion.rotation();
            frames.push(frame);
            positions.push(position);
        }
        Shape { controls, frames, positions }
    }

    /// Internal moment of each element in the world frame (N m), at the middle of the element.
    #[must_use]
    pub fn moments(&self, shape: &Shape) -> Vec<DVec3> {
        (0..self.len())
            .map(|i| {
                // Hooke's law: m = K/h (c − c⁰), in the frame of the joint or of the middle of a helix.
                let (g, c) = (self.geometry(i), shape.controls[i]);
                shape.frames[i] * (g.moment_frame(c) * (g.stiffness() * (c - g.rest())))
            })
            .collect()
    }

    /// The shape whose internal moments (N m, world frame, as a function of arc length) are given:
    /// how a shape is carried from one division of a rod to another.
    #[must_use]
    pub fn shape_with_moments(&self, moment: impl Fn(f64) -> DVec3) -> Shape {
        let mut frame = self.rod.root().frame();
        let mut controls = Vec::with_capacity(self.len());
        for i in 0..self.len() {
            let g = self.geometry(i);
            let m = moment(0.5 * (self.arc[i] + self.arc[i + 1]));
            // The frame in which the moment acts depends on the control itself; that of the natural control is near enough for a start.
            let inside = (frame * g.moment_frame(g.rest())).transpose() * m;
            // Hooke's law inverted, c = c⁰ + (K/h)⁻¹ m. A moment of another division can lead to more than a turn: such a
            // start is useless.
            let bent = (inside / g.stiffness()).clamp_length_max(LARGEST_BEND);
            let c = g.rest() + bent;
            controls.push(c);
            frame *= g.motion(c).rotation();
        }
        self.shape(controls)
    }

    /// The shape whose node frames are as close as they can be to given ones (one per node; the
    /// root's is the clamp's).
    ///
    /// # Panics
    /// If there is not one frame per node.
    #[must_use]
    pub fn shape_through(&self, frames: &[DMat3]) -> Shape {
        self.shape_through_near(frames, |_| None)
    }

    /// The same, with controls (rad) that are known to be near, by the index of the element: an element that turns by more than half a turn is
    /// otherwise taken to turn the other way where that is nearer to its natural control.
    pub(crate) fn shape_through_near(
        &self,
        frames: &[DMat3],
        near: impl Fn(usize) -> Option<DVec3>,
    ) -> Shape {
        assert_eq!(frames.len(), self.arc.len(), "one frame per node");
        let mut frame = self.rod.root().frame();
        let mut controls = Vec::with_capacity(self.len());
        for (i, next) in frames[1..].iter().enumerate() {
            let g = self.geometry(i);
            let c = g.control_for(&(frame.transpose() * *next), near(i).unwrap_or(g.rest()));
            controls.push(c);
            frame *= g.motion(c).rotation();
        }
        self.shape(controls)
    }

    /// Centre line (m) and material frame at arc length `s` (m), clamped to the rod. The turn of a
    /// joint is spread along its element, so that the line is smooth.
    #[must_use]
    pub fn point(&self, shape: &Shape, s: f64) -> (DVec3, DMat3) {
        let s = s.clamp(0.0, self.rod.length());
        let i = self.arc.partition_point(|&a| a <= s).clamp(1, self.len()) - 1;
        let (turn, advance) = self.geometry(i).inside(shape.controls[i], s - self.arc[i]);
        let (position, frame) = (shape.positions[i], shape.frames[i]);
        (position + frame * advance, frame * turn)
    }
}

/// A shape of a [`Chain`]: controls, and the frames and positions that follow from them.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Rotation of each element: `h u` for helices, that of the joint for jointed ones (rad).
    pub controls: Vec<DVec3>,
    /// Material frame at each node, columns d1, d2, t.
    pub frames: Vec<DMat3>,
    /// Position of each node (m).
    pub positions: Vec<DVec3>,
}
