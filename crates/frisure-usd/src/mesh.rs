//! Meshes of a stage.

use glam::DVec3;

use super::layer::Prim;
use super::stage::StagePrim;
use super::value::Value;

/// Corners of one face, at most.
const MAX_CORNERS: usize = 1000;

/// A mesh as it is in a stage: in its unit and axes, in the place that it has there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Its vertices.
    pub positions: Vec<[f64; 3]>,
    /// Counter-clockwise seen from outside; polygons are cut into fans.
    pub triangles: Vec<[u32; 3]>,
    /// Index of the face of each triangle.
    pub faces: Vec<usize>,
    /// Indices of each triangle's corners among all corners of the file.
    pub corners: Vec<[usize; 3]>,
    /// How many corners the file has.
    pub corner_count: usize,
}

impl StagePrim<'_> {
    /// The mesh of a `Mesh` prim.
    pub fn mesh(&self) -> Result<Mesh, String> {
        let positions = self.prim.value("points").and_then(Value::numbers).unwrap_or_default();
        if !positions.len().is_multiple_of(3) || u32::try_from(positions.len()).is_err() {
            return Err("its points have not three coordinates each".into());
        }
        let place = |p: &[f64; 3]| self.world.transform_point3(DVec3::from_array(*p)).to_array();
        let positions: Vec<[f64; 3]> = positions.as_chunks().0.iter().map(place).collect();
        let mut mesh = Mesh { positions, ..Mesh::default() };
        // A mirror turns faces inside out, as does the other hand.
        let left = self.prim.word("orientation") == Some("leftHanded");
        mesh.cut(self.prim, left != (self.world.determinant() < 0.0))?;
        Ok(mesh)
    }
}

impl Mesh {
    fn cut(&mut self, prim: &Prim, flipped: bool) -> Result<(), String> {
        let whole = |name| prim.value(name).and_then(Value::to_integers).unwrap_or_default();
        let (counts, indices) = (whole("faceVertexCounts"), whole("faceVertexIndices"));
        let points = self.positions.len();
        let mut first = 0;
        for (face, count) in counts.into_iter().enumerate() {
            let count = usize::try_from(count).ok().filter(|n| (3..=MAX_CORNERS).contains(n));
            let count =
                count.ok_or_else(|| format!("face {face} has not 3 to {MAX_CORNERS} corners"))?;
            let corners = indices.get(first..first + count);
            let corners =
                corners.ok_or_else(|| format!("the corners of face {face} are missing"))?;
            let vertex = |k: usize| {
                let found = u32::try_from(corners[k]).ok().filter(|&v| (v as usize) < points);
                found.ok_or_else(|| {
                    format!("face {face} names vertex {}, and there are {points}", corners[k])
                })
            };
            for k in 1..count - 1 {
                let fan = if flipped { [0, k + 1, k] } else { [0, k, k + 1] };
                let [a, b, c] = fan.map(vertex);
                self.triangles.push([a?, b?, c?]);
                self.corners.push(fan.map(|k| first + k));
                self.faces.push(face);
            }
            first += count;
        }
        self.corner_count = first;
        Ok(())
    }
}
