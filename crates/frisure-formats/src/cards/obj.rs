//! Cards as OBJ with a library of materials: an object for each level.

use std::io::{self, Write};

use frisure_cards::Cards;
use frisure_files::frame::Frame;

/// The file of materials; `named` gives the file of a texture of a level.
pub(super) fn materials(
    out: &mut dyn Write,
    cards: &Cards,
    named: impl Fn(usize, &str) -> String,
) -> io::Result<()> {
    writeln!(
        out,
        "# Hair cards by frisure: map_Kd is colour, map_d the part that hair covers (alpha of the same file)."
    )?;
    for level in 0..cards.levels.len() {
        let colour = named(level, "color");
        writeln!(out, "newmtl hair_LOD{level}\nKd 1 1 1\nKs 0.04 0.04 0.04\nNs 60\nillum 2")?;
        writeln!(out, "map_Kd {colour}\nmap_d -imfchan m {colour}")?;
    }
    Ok(())
}

/// The meshes, which name the file of materials `library`.
pub(super) fn meshes(out: &mut dyn Write, cards: &Cards, library: &str) -> io::Result<()> {
    writeln!(out, "# Hair cards by frisure, metres, y up\nmtllib {library}")?;
    let mut first = 1;
    for (level, of) in cards.levels.iter().enumerate() {
        writeln!(out, "o hair_LOD{level}")?;
        for p in &of.mesh.positions {
            let p = Frame::METRES_Y.position_to_file(*p);
            writeln!(out, "v {:.7} {:.7} {:.7}", p.x, p.y, p.z)?;
        }
        for [u, v] in &of.mesh.uvs {
            writeln!(out, "vt {:.6} {:.6}", u, 1.0 - v)?;
        }
        for n in &of.mesh.normals {
            let n = Frame::METRES_Y.direction_to_file(*n);
            writeln!(out, "vn {:.5} {:.5} {:.5}", n.x, n.y, n.z)?;
        }
        writeln!(out, "usemtl hair_LOD{level}")?;
        for corners in &of.mesh.triangles {
            let [a, b, c] = corners.map(|v| first + v);
            writeln!(out, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
        }
        first += of.mesh.positions.len() as u32;
    }
    Ok(())
}
