//! The scalp: density of hair at each vertex of a mesh, from 0 to 1.

use std::io::Cursor;
use std::path::Path;

use super::mesh::Mesh;
use super::source::{HeadFileError, MAX_SIZE, not_a_mesh};
use frisure_files::Files;

/// Largest mask that is decoded (bytes of pixels): a small file can claim a huge picture.
const MAX_PIXELS: usize = 1 << 28;

/// 1 at the vertices of a group's faces.
pub(super) fn from_group(mesh: &Mesh, name: &str, path: &Path) -> Result<Vec<f64>, HeadFileError> {
    let group = mesh.groups.get(name).ok_or_else(|| HeadFileError::NoGroup {
        path: path.into(),
        group: name.into(),
        known: mesh.groups.keys().cloned().collect(),
    })?;
    let mut weights = vec![0.0; mesh.positions.len()];
    for &triangle in &group.triangles {
        for v in mesh.triangles[triangle] {
            weights[v as usize] = 1.0;
        }
    }
    Ok(weights)
}

/// A number that the file has at each vertex, as far as it is between 0 and 1.
pub(super) fn from_channel(
    mesh: &Mesh,
    name: &str,
    path: &Path,
) -> Result<Vec<f64>, HeadFileError> {
    let channel = mesh.channels.get(name).ok_or_else(|| HeadFileError::NoChannel {
        path: path.into(),
        channel: name.into(),
        known: mesh.channels.keys().cloned().collect(),
    })?;
    let mut weights: Vec<f64> = channel.iter().map(|x| x.clamp(0.0, 1.0)).collect();
    weights.resize(mesh.positions.len(), 0.0);
    Ok(weights)
}

/// The mask's brightness at each vertex, averaged over the corners that meet there: vertices on a
/// seam have several texture coordinates.
pub(super) fn from_mask(
    mesh: &Mesh,
    (mask, files): (&Path, &Files),
    path: &Path,
) -> Result<Vec<f64>, HeadFileError> {
    if mesh.triangle_uvs.iter().all(Option::is_none) {
        let problem = "a scalp mask needs texture coordinates, and its faces have none";
        return Err(not_a_mesh(path, problem));
    }
    let picture = Mask::read(mask, files)?;
    let mut sums = vec![(0.0, 0_u32); mesh.positions.len()];
    for (triangle, uvs) in mesh.triangles.iter().zip(&mesh.triangle_uvs) {
        let Some(uvs) = uvs else { continue };
        for (&v, &uv) in triangle.iter().zip(uvs) {
            let (sum, count) = &mut sums[v as usize];
            *sum += picture.at(mesh.uvs[uv as usize]);
            *count += 1;
        }
    }
    Ok(sums.into_iter().map(|(sum, count)| sum / f64::from(count.max(1))).collect())
}

/// Smallest and largest texture coordinate of the faces, if some are not between 0 and 1.
pub(super) fn beyond(mesh: &Mesh) -> Option<[f64; 2]> {
    let used = mesh.triangle_uvs.iter().flatten().flatten();
    let all = used.flat_map(|&uv| mesh.uvs[uv as usize]);
    let [low, high] =
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    (low < 0.0 || high > 1.0).then_some([low, high])
}

/// One number per line and vertex.
pub(super) fn from_text(
    mesh: &Mesh,
    path: &Path,
    files: &Files,
) -> Result<Vec<f64>, HeadFileError> {
    let text = files.read_text(path, MAX_SIZE, "a list of weights")?;
    let fault = |line, problem| HeadFileError::Line { path: path.into(), line, problem };
    let mut weights = Vec::with_capacity(mesh.file_vertices());
    for (i, line) in text.lines().enumerate() {
        let word = line.split('#').next().unwrap_or("").trim();
        if word.is_empty() {
            continue;
        }
        let weight: f64 =
            word.parse().map_err(|_| fault(i + 1, format!("`{word}` is not a number")))?;
        if !(0.0..=1.0).contains(&weight) {
            return Err(fault(i + 1, format!("{word} is not between 0 and 1")));
        }
        weights.push(weight);
    }
    let (found, expected) = (weights.len(), mesh.file_vertices());
    if found == expected && mesh.joined.is_empty() {
        return Ok(weights);
    }
    if found == expected {
        return Ok(mesh.averaged(&weights, mesh.positions.len()));
    }
    let problem = format!("it has {found} numbers, and the mesh has {expected} vertices");
    Err(HeadFileError::Format { path: path.into(), expected: "a list of scalp weights", problem })
}

/// A grey picture.
struct Mask {
    width: usize,
    height: usize,
    values: Vec<f64>,
}

impl Mask {
    fn read(path: &Path, files: &Files) -> Result<Self, HeadFileError> {
        let bytes = files.read_bytes(path, MAX_SIZE, "a mask")?;
        Self::decode(&bytes).map_err(|problem| HeadFileError::Format {
            path: path.into(),
            expected: "a PNG picture",
            problem,
        })
    }

    fn decode(bytes: &[u8]) -> Result<Self, String> {
        let limits = png::Limits { bytes: MAX_PIXELS };
        let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
        let size = reader.output_buffer_size().filter(|&n| n <= MAX_PIXELS);
        let mut pixels = vec![0; size.ok_or("it has too many pixels")?];
        let frame = reader.next_frame(&mut pixels).map_err(|e| e.to_string())?;
        let samples = frame.color_type.samples();
        let values = pixels[..frame.buffer_size()]
            .chunks_exact(samples)
            .map(|pixel| {
                // Alpha is no brightness.
                let colours = if samples > 2 { &pixel[..3] } else { &pixel[..1] };
                colours.iter().map(|&c| f64::from(c)).sum::<f64>() / (255.0 * colours.len() as f64)
            })
            .collect();
        Ok(Self { width: frame.width as usize, height: frame.height as usize, values })
    }

    /// Brightness between the four nearest pixels; `v` grows upwards, and the picture repeats.
    fn at(&self, [u, v]: [f64; 2]) -> f64 {
        let wrap = |t: f64, n: usize| {
            let x = t.rem_euclid(1.0) * n as f64 - 0.5;
            let low = x.floor();
            let at = |i: f64| i.rem_euclid(n as f64) as usize % n;
            (at(low), at(low + 1.0), x - low)
        };
        // 1 is the last pixel's far edge, not the first's near one.
        let [u, v] = [u, v].map(|t| if t == 1.0 { 1.0 - f64::EPSILON } else { t });
        let (x0, x1, fx) = wrap(u, self.width);
        let (y0, y1, fy) = wrap(1.0 - f64::EPSILON - v, self.height);
        let value = |x: usize, y: usize| self.values[y * self.width + x];
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        mix(mix(value(x0, y0), value(x1, y0), fx), mix(value(x0, y1), value(x1, y1), fx), fy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_are_read_with_v_upwards() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header().unwrap();
        // White above, black below.
        writer.write_image_data(&[255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 0, 0]).unwrap();
        drop(writer);
        let mask = Mask::decode(&bytes).unwrap();
        assert!((mask.at([0.5, 0.75]) - 1.0).abs() < 1e-9);
        assert!(mask.at([0.5, 0.25]).abs() < 1e-9);
        assert!((mask.at([0.25, 0.5]) - 0.5).abs() < 1e-9);
        for uv in [[0.0, 0.0], [1.0, 1.0], [-3.7, 1e12], [1e300, -1e300]] {
            assert!((0.0..=1.0).contains(&mask.at(uv)));
        }
        assert!(Mask::decode(&bytes[..40]).is_err());
        assert!(Mask::decode(b"not a picture").is_err());
    }
}
