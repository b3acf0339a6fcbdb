//! A triangle mesh that was checked when it was made.

use std::sync::Arc;

use glam::DVec3;
use thiserror::Error;

use crate::accessory_material::{AccessoryFaces, AccessoryMaterial};
use crate::features::{Features, Tint};

/// A triangle mesh in metres, counter-clockwise seen from outside; every index is valid, every
/// coordinate finite, and there is at least one triangle of positive area.
///
/// ```
/// use frisure_strands::{Surface, SurfaceError};
/// use glam::DVec3;
///
/// // A right-angled triangle with sides of 1 m.
/// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
/// let surface = Surface::new(corners.clone(), vec![[0, 1, 2]])?;
/// assert_eq!(surface.area(), 0.5);
/// assert_eq!(surface.vertex_normals()[0], DVec3::Z);
///
/// // A mesh with a bad index is refused.
/// let error = Surface::new(corners, vec![[0, 1, 7]]).unwrap_err();
/// assert_eq!(error, SurfaceError::Index { face: 0, vertex: 7, count: 3 });
/// # Ok::<(), SurfaceError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    texture: Vec<[[f32; 2]; 3]>,
    features: Option<Arc<Features>>,
    accessories: Option<Arc<AccessoryFaces>>,
}

/// Why a mesh is not a [`Surface`].
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SurfaceError {
    /// No triangle of positive area.
    #[error("the mesh has no face with an area")]
    NoFaces,
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are only {count}")]
    Index {
        /// Index of the face, from 0.
        face: usize,
        /// The vertex it names, from 0.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite: {position}")]
    NotFinite {
        /// Index of the vertex, from 0.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// Texture coordinates are not those of the faces.
    #[error("there are texture coordinates for {given} faces, but there are {faces} faces")]
    TextureCount {
        /// Number of faces that have texture coordinates.
        given: usize,
        /// Number of faces.
        faces: usize,
    },
    /// Tints are not those of the vertices.
    #[error("there are tints for {given} vertices, but there are {vertices} vertices")]
    TintCount {
        /// Number of tints.
        given: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// A texture coordinate is infinite or not a number.
    #[error("face {face} has a texture coordinate that is not finite")]
    TextureNotFinite {
        /// Index of the face, from 0.
        face: usize,
    },
}

impl Surface {
    /// Checks and wraps a mesh: positions (m) and faces counter-clockwise seen from outside.
    ///
    /// # Errors
    /// [`SurfaceError`], if an index or coordinate is bad or no face has an area.
    pub fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, SurfaceError> {
        let count = positions.len();
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(SurfaceError::NotFinite { vertex, position: positions[vertex] });
        }
        for (face, triangle) in triangles.iter().enumerate() {
            if let Some(&vertex) = triangle.iter().find(|&&v| v as usize >= count) {
                return Err(SurfaceError::Index { face, vertex, count });
            }
        }
        let (texture, features, accessories) = (Vec::new(), None, None);
        let surface = Self { positions, triangles, texture, features, accessories };
        if surface.area() > 0.0 { Ok(surface) } else { Err(SurfaceError::NoFaces) }
    }

    /// The same mesh with texture coordinates (u, v) at the three corners of each face, v upwards.
    ///
    /// # Errors
    /// [`SurfaceError::TextureCount`], if there is not one triple for each face;
    /// [`SurfaceError::TextureNotFinite`], if a coordinate is not finite.
    pub fn with_texture(mut self, texture: Vec<[[f32; 2]; 3]>) -> Result<Self, SurfaceError> {
        let (given, faces) = (texture.len(), self.triangles.len());
        if given != faces {
            return Err(SurfaceError::TextureCount { given, faces });
        }
        let bad = |t: &[[f32; 2]; 3]| !t.as_flattened().iter().all(|x| x.is_finite());
        if let Some(face) = texture.iter().position(bad) {
            return Err(SurfaceError::TextureNotFinite { face });
        }
        self.texture = texture;
        Ok(self)
    }

    /// Texture coordinates (u, v) at the corners of each face, v upwards; empty if the mesh has none.
    #[must_use]
    pub fn texture(&self) -> &[[[f32; 2]; 3]] {
        &self.texture
    }

    /// The same mesh with eyes, lips, brows and what else a face has.
    ///
    /// # Errors
    /// [`SurfaceError::TintCount`], if there are tints, but not one for each vertex.
    pub fn with_features(mut self, features: Features) -> Result<Self, SurfaceError> {
        let (given, vertices) = (features.tints.len(), self.positions.len());
        if given != 0 && given != vertices {
            return Err(SurfaceError::TintCount { given, vertices });
        }
        self.features = Some(Arc::new(features));
        Ok(self)
    }

    /// Eyes, lips, brows and what else the face has; none of a mesh that is skin alone.
    #[must_use]
    pub fn features(&self) -> Option<&Features> {
        self.features.as_deref()
    }

    /// The tint of a point of face `index` with these weights of its corners.
    ///
    /// # Panics
    /// If there is no such face.
    #[must_use]
    pub fn tint(&self, index: usize, weights: [f32; 3]) -> Tint {
        let Some(features) = self.features().filter(|f| !f.tints.is_empty()) else {
            return Tint::default();
        };
        let corners = self.triangles[index].map(|v| features.tints[v as usize]);
        corners.iter().zip(weights).fold(Tint::default(), |sum, (tint, w)| sum + *tint * w)
    }

    /// What the accessory is made of that face `index` is part of; none of a face of the head.
    #[must_use]
    pub fn accessory(&self, index: usize) -> Option<&AccessoryMaterial> {
        self.accessories.as_ref()?.material(index)
    }

    /// Sets which faces are accessories.
    pub(crate) fn set_accessories(&mut self, faces: AccessoryFaces) {
        self.accessories = Some(Arc::new(faces));
    }

    /// The same mesh without the vertices that no face uses, and the former index of each that is left.
    #[must_use]
    pub fn without_strays(mut self) -> (Self, Vec<u32>) {
        let mut used = vec![false; self.positions.len()];
        self.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
        let kept: Vec<u32> = (0..used.len() as u32).filter(|&v| used[v as usize]).collect();
        if kept.len() < used.len() {
            let mut now = vec![0; used.len()];
            kept.iter().zip(0..).for_each(|(&v, new)| now[v as usize] = new);
            self.positions = kept.iter().map(|&v| self.positions[v as usize]).collect();
            self.triangles.iter_mut().flatten().for_each(|v| *v = now[*v as usize]);
            if let Some(features) = self.features.as_mut().filter(|f| !f.tints.is_empty()) {
                let features = Arc::make_mut(features);
                features.tints = kept.iter().map(|&v| features.tints[v as usize]).collect();
            }
        }
        (self, kept)
    }

    /// The same mesh with every face turned to the other side.
    #[must_use]
    pub fn turned_over(mut self) -> Self {
        self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        self.texture.iter_mut().for_each(|corners| corners.swap(1, 2));
        self
    }

    /// The volume that the faces enclose (m³), seen from the mean of their middles; negative where they look inwards. Of an open mesh it is
    /// that up to this point.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let faces = 0..self.triangles.len();
        let (sum, area) = faces.clone().fold((DVec3::ZERO, 0.0), |(sum, area), face| {
            let own = self.doubled_area_vector(face).length();
            let [a, b, c] = self.corners(face);
            (sum + own * (a + b + c) / 3.0, area + own)
        });
        let middle = sum / area;
        // A tetrahedron over each face.
        let over = |face: usize| {
            let [a, b, c] = self.corners(face).map(|p| p - middle);
            a.dot(b.cross(c)) / 6.0
        };
        faces.map(over).sum()
    }

    /// Adds the vertices and faces of another mesh, without its texture and features.
    pub(crate) fn append(&mut self, other: &Self) {
        let first = self.positions.len() as u32;
        self.positions.extend_from_slice(&other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        if !self.texture.is_empty() {
            self.texture.resize(self.triangles.len(), [[0.0; 2]; 3]);
        }
        // What is no skin has no tint.
        if let Some(features) = self.features.as_mut().filter(|f| !f.tints.is_empty()) {
            Arc::make_mut(features).tints.resize(self.positions.len(), Tint::default());
        }
    }

    /// Vertices (m).
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Three vertex indices per face, counter-clockwise seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of face `index` (m).
    ///
    /// # Panics
    /// If there is no such face.
    #[must_use]
    pub fn corners(&self, index: usize) -> [DVec3; 3] {
        self.triangles[index].map(|v| self.positions[v as usize])
    }

    /// Twice the area vector of face `index` (m²): its direction is the outward normal.
    ///
    /// # Panics
    /// If there is no such face.
    #[must_use]
    pub fn doubled_area_vector(&self, index: usize) -> DVec3 {
        let [a, b, c] = self.corners(index);
        (b - a).cross(c - a)
    }

    /// Area of all faces (m²).
    #[must_use]
    pub fn area(&self) -> f64 {
        (0..self.triangles.len()).map(|i| 0.5 * self.doubled_area_vector(i).length()).sum()
    }

    /// Unit normal at each vertex, the area-weighted mean of its faces' (+z where it has none).
    #[must_use]
    pub fn vertex_normals(&self) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for (i, triangle) in self.triangles.iter().enumerate() {
            let area = self.doubled_area_vector(i);
            for &v in triangle {
                sums[v as usize] += area;
            }
        }
        sums.iter().map(|n| n.try_normalize().unwrap_or(DVec3::Z)).collect()
    }

    /// Smallest and largest corner of the box around the mesh (m).
    #[must_use]
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let first = self.positions[0];
        self.positions.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_meshes_are_refused() {
        let p = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        assert!(Surface::new(p.clone(), vec![[0, 1, 2]]).is_ok());
        assert_eq!(Surface::new(p.clone(), vec![]), Err(SurfaceError::NoFaces));
        assert_eq!(Surface::new(p.clone(), vec![[0, 1, 1]]), Err(SurfaceError::NoFaces));
        assert!(matches!(
            Surface::new(p, vec![[0, 1, 3]]),
            Err(SurfaceError::Index { vertex: 3, .. })
        ));
        let nan = vec![DVec3::ZERO, DVec3::X, DVec3::new(0.0, f64::NAN, 0.0)];
        assert!(matches!(
            Surface::new(nan, vec![[0, 1, 2]]),
            Err(SurfaceError::NotFinite { vertex: 2, .. })
        ));
    }

    #[test]
    fn strays_go_and_meshes_turn_over() {
        // A tetrahedron whose faces look outwards, and two vertices of no face.
        let p = [DVec3::NAN, DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE];
        let p = p.map(|p| if p.is_nan() { DVec3::NEG_ONE } else { p });
        let faces = vec![[1, 3, 2], [1, 2, 4], [1, 4, 3], [2, 3, 4]];
        let texture = (0..4).map(|k| [[0.0, 0.0], [1.0, k as f32], [0.0, 1.0]]).collect();
        let tints = (0..6).map(|k| Tint { lips: k as f32, ..Tint::default() }).collect();
        let surface = Surface::new(p.to_vec(), faces).unwrap().with_texture(texture).unwrap();
        let surface = surface.with_features(Features { tints, ..Features::default() }).unwrap();
        let corners: Vec<_> = (0..4).map(|face| surface.corners(face)).collect();
        assert!((surface.volume() - 1.0 / 6.0).abs() < 1e-15);
        let (clean, kept) = surface.clone().without_strays();
        assert_eq!(kept, [1, 2, 3, 4]);
        assert_eq!(clean.positions(), &p[1..5]);
        assert_eq!((0..4).map(|face| clean.corners(face)).collect::<Vec<_>>(), corners);
        assert_eq!(clean.texture(), surface.texture());
        assert_eq!(clean.features().unwrap().tints[0].lips, 1.0);
        let over = clean.clone().turned_over();
        assert!((over.volume() + 1.0 / 6.0).abs() < 1e-15);
        assert_eq!(over.texture()[2], [[0.0, 0.0], [0.0, 1.0], [1.0, 2.0]]);
        assert_eq!(over.turned_over(), clean);
        let whole = clean.clone().without_strays();
        assert_eq!(whole, (clean, vec![0, 1, 2, 3]));
    }

    #[test]
    fn bad_texture_coordinates_are_refused() {
        let p = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let surface = Surface::new(p, vec![[0, 1, 2]]).unwrap();
        assert!(surface.texture().is_empty());
        let few = surface.clone().with_texture(vec![]);
        assert_eq!(few, Err(SurfaceError::TextureCount { given: 0, faces: 1 }));
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, f32::NAN]];
        let bad = surface.clone().with_texture(vec![corners]);
        assert_eq!(bad, Err(SurfaceError::TextureNotFinite { face: 0 }));
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(surface.with_texture(vec![corners]).unwrap().texture(), [corners]);
    }

    #[test]
    fn tints_are_one_for_each_vertex_and_linear_between() {
        let p = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let surface = Surface::new(p, vec![[0, 1, 2]]).unwrap();
        assert_eq!(surface.tint(0, [1.0, 0.0, 0.0]), Tint::default());
        let red = Tint { lips: 1.0, ..Tint::default() };
        let with = |tints| surface.clone().with_features(Features { tints, ..Features::default() });
        assert_eq!(with(vec![red]), Err(SurfaceError::TintCount { given: 1, vertices: 3 }));
        let face = with(vec![red, Tint::default(), Tint::default()]).unwrap();
        assert_eq!(face.tint(0, [0.25, 0.5, 0.25]).lips, 0.25);
        assert!(surface.features().is_none() && face.features().is_some());
    }

    #[test]
    fn accessories_follow_the_head_and_have_its_tints_no_more() {
        let p = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let surface = Surface::new(p, vec![[0, 1, 2]]).unwrap();
        let red = Tint { lips: 1.0, ..Tint::default() };
        let features = Features { tints: vec![red; 3], ..Features::default() };
        let head = surface.clone().with_features(features).unwrap();
        let head = head.with_texture(vec![[[0.5; 2]; 3]]).unwrap();
        let material =
            |name| AccessoryMaterial { name, colour: [0.5; 3], gloss: 0.0, roughness: 1.0 };
        let mesh = |name| crate::AccessoryMesh {
            name: String::new(),
            material: material(name),
            surface: surface.clone(),
        };
        let meshes = [mesh("a"), mesh("b")];
        let joined = Surface::with_accessories(Some(&head), &meshes).unwrap();
        let names = |s: &Surface| -> Vec<_> {
            (0..s.triangles().len()).map(|i| s.accessory(i).map(|m| m.name)).collect()
        };
        assert_eq!(names(&joined), [None, Some("a"), Some("b")]);
        assert_eq!(joined.positions().len(), 9);
        assert_eq!(
            (joined.tint(0, [1.0, 0.0, 0.0]), joined.tint(2, [1.0, 0.0, 0.0])),
            (red, Tint::default())
        );
        assert_eq!(joined.texture().len(), 3);
        let alone = Surface::with_accessories(None, &meshes).unwrap();
        assert_eq!(names(&alone), [Some("a"), Some("b")]);
        assert_eq!(Surface::with_accessories(Some(&head), &[]), Some(head));
        assert_eq!(Surface::with_accessories(None, &[]), None);
    }

    #[test]
    fn a_right_triangle_has_its_area_and_normal() {
        let s = Surface::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]]).unwrap();
        assert!((s.area() - 0.5).abs() < 1e-15);
        assert_eq!(s.vertex_normals(), vec![DVec3::Z; 3]);
    }
}
