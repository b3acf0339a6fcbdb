//! The part of Wavefront OBJ that heads need: vertices, texture coordinates, faces and their groups.
//!
//! Read here and not by a library, for two reasons: vertices that groups share stay
//! one vertex (a split seam would be a hole in the signed distance), and an error names its line.

use std::borrow::Cow;

use super::format::{MeshFormat, Problem};
use super::mesh::{MAX_CORNERS, Mesh};
use crate::accessory_names::OBJECT;
use frisure_files::frame::Frame;

/// The declaration of the format.
pub(super) static FORMAT: MeshFormat = MeshFormat {
    extensions: &["obj"],
    expected: "an OBJ mesh",
    begins: |_| true,
    is_text: true,
    read: |bytes, _| {
        let text = std::str::from_utf8(bytes).map_err(|e| e.to_string())?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        // Old Macs ended lines with a carriage return alone.
        let lines = match text.contains('\n') {
            true => Cow::Borrowed(text),
            false => Cow::Owned(text.replace('\r', "\n")),
        };
        parse(&lines).map_err(|(line, what)| Problem { line: Some(line), what })
    },
};

/// A line's number from 1, and what is wrong with it.
type Fault = (usize, String);

/// Reads the text of a file.
fn parse(text: &str) -> Result<Mesh, Fault> {
    let mut mesh = Mesh { frame: Some(Frame::METRES_Y), ..Mesh::default() };
    let mut colours: Vec<f64> = Vec::new();
    let mut current: Vec<String> = Vec::new();
    let mut material: Option<String> = None;
    let mut object: Option<String> = None;
    for (number, line) in logical_lines(text) {
        let fault = |problem: String| (number, problem);
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let p = numbers::<3>(words.clone()).map_err(fault)?;
                mesh.positions.push(p);
                // Some write a colour behind the place.
                if words.clone().count() == 6 {
                    colours.extend(numbers::<3>(words.skip(3)).map_err(fault)?);
                }
            }
            Some("vt") => {
                let uv = numbers::<2>(words).map_err(fault)?;
                mesh.uvs.push(uv);
            }
            // Several names put the faces in several groups.
            Some("g") => current = words.map(str::to_owned).collect(),
            Some("o") => object = words.next().map(str::to_owned),
            Some("usemtl") => material = words.next().map(str::to_owned),
            // What holds the hair of a groom is no head.
            Some("f") if object.as_ref().is_some_and(|name| name.starts_with(OBJECT)) => {}
            Some("f") => {
                let names = current.iter().chain(&object).chain(&material);
                mesh.face(words, names).map_err(fault)?;
            }
            // Normals are computed, and the rest is not about shape.
            _ => {}
        }
    }
    if !colours.is_empty() && colours.len() == 3 * mesh.positions.len() {
        mesh.colours(0, &colours, 3);
    }
    Ok(mesh)
}

/// Lines with their numbers, joined where one ends in a backslash, without comments.
fn logical_lines(text: &str) -> impl Iterator<Item = (usize, String)> {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (index, first) = lines.next()?;
        let mut line = first.to_owned();
        while line.ends_with('\\') {
            line.pop();
            let Some((_, next)) = lines.next() else { break };
            line.push(' ');
            line.push_str(next);
        }
        if let Some(comment) = line.find('#') {
            line.truncate(comment);
        }
        Some((index + 1, line))
    })
}

/// The first `N` words as finite numbers.
fn numbers<'a, const N: usize>(
    mut words: impl Iterator<Item = &'a str>,
) -> Result<[f64; N], String> {
    let mut out = [0.0; N];
    for x in &mut out {
        let word = words.next().ok_or_else(|| format!("there should be {N} numbers"))?;
        *x = word.parse().map_err(|_| format!("`{word}` is not a number"))?;
        if !f64::is_finite(*x) {
            return Err(format!("`{word}` is not a finite number"));
        }
    }
    Ok(out)
}

impl Mesh {
    fn face<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        groups: impl Iterator<Item = &'a String>,
    ) -> Result<(), String> {
        let mut corners: Vec<(u32, Option<u32>)> = Vec::new();
        for word in words {
            let mut parts = word.split('/');
            let vertex = index(parts.next().unwrap_or(""), self.positions.len(), "vertex")?;
            let uv = match parts.next() {
                None | Some("") => None,
                Some(uv) => Some(index(uv, self.uvs.len(), "texture coordinate")?),
            };
            corners.push((vertex, uv));
        }
        if corners.len() < 3 || corners.len() > MAX_CORNERS {
            return Err(format!("a face has {} corners", corners.len()));
        }
        let first_triangle = self.triangles.len();
        for pair in corners[1..].windows(2) {
            let fan = [corners[0], pair[0], pair[1]];
            self.triangles.push(fan.map(|c| c.0));
            let uvs = fan.map(|c| c.1);
            self.triangle_uvs.push(match uvs {
                [Some(a), Some(b), Some(c)] => Some([a, b, c]),
                _ => None,
            });
        }
        for name in groups {
            self.group(name, first_triangle);
        }
        Ok(())
    }
}

/// An index from 0: files count from 1, or backwards from −1, the latest.
fn index(word: &str, count: usize, what: &str) -> Result<u32, String> {
    let n: i64 = word.parse().map_err(|_| format!("`{word}` is not the number of a {what}"))?;
    let at = if n < 0 {
        i64::try_from(count).ok().and_then(|c| c.checked_add(n))
    } else {
        n.checked_sub(1)
    };
    at.filter(|&i| i >= 0)
        .and_then(|i| u32::try_from(i).ok())
        .filter(|&i| (i as usize) < count)
        .ok_or_else(|| format!("the face names {what} {n}, and there are {count} so far"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUAD: &str = "o head\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\n";

    fn with(tail: &str) -> Result<Mesh, Fault> {
        parse(&format!("{QUAD}{tail}"))
    }

    #[test]
    fn polygons_become_fans_and_groups_share_vertices() {
        let mesh = with("g scalp top\nf 1 2 3 4\ng\nf -4//1 -3//1 -2//1\n").unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
        assert_eq!(mesh.groups["scalp"].triangles, [0, 1]);
        assert_eq!(mesh.groups["top"].triangles, [0, 1]);
        assert_eq!(mesh.groups["head"].triangles, [0, 1, 2]);
        assert_eq!(mesh.positions.len(), 4);
    }

    #[test]
    fn texture_coordinates_comments_and_continued_lines() {
        let mesh = with("f 1/1 2/2 \\\n 3/1 # the face\r\n").unwrap();
        assert_eq!(mesh.triangle_uvs, [Some([0, 1, 0])]);
    }

    #[test]
    fn errors_name_their_line() {
        let fault = |tail: &str| with(tail).unwrap_err();
        assert_eq!(
            fault("\nf 1 2 9"),
            (9, "the face names vertex 9, and there are 4 so far".into())
        );
        assert_eq!(fault("f 1 2 0").0, 8);
        assert_eq!(fault("f 1 2 -5").0, 8);
        assert_eq!(fault("f 1 2 -9223372036854775808").0, 8);
        assert_eq!(fault("f 1 2"), (8, "a face has 2 corners".into()));
        assert_eq!(fault("f 1/9 2/1 3/1").0, 8);
        assert_eq!(fault("v 1 2"), (8, "there should be 3 numbers".into()));
        assert_eq!(fault("v 1 2 nan"), (8, "`nan` is not a finite number".into()));
        assert_eq!(fault("v 1 2 1e999").0, 8);
        assert_eq!(fault("f a b c"), (8, "`a` is not the number of a vertex".into()));
    }
}
