//! A web page in one file (`.html`) that turns the hair in a browser, without a network.
//!
//! The page is a template of HTML, style, JavaScript and GLSL in `page/`, and the groom as compressed text in it: see
//! [`data`]. It draws with WebGL 2 and needs nothing else.

mod data;

use std::io::{self, Write};

use super::data::Groom;
use super::format::Declaration;
use data::PageData;
use frisure_files::frame::Frame;

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["html"],
    title: "web page that turns the hair, offline",
    frame: Frame::METRES_Z,
    holds_guides: false,
    usual_points: None,
    most_hairs: Some(20_000),
    check,
    write: |out, samples, frame| encode(out, samples.groom, frame),
    moves: false,
    read: None,
};

/// The files of the page, each by the name that stands for it in `page.html`.
const FILES: [(&str, &str); 7] = [
    ("style", include_str!("page/page.css")),
    ("hair.vert", include_str!("page/hair.vert")),
    ("hair.frag", include_str!("page/hair.frag")),
    ("skin.vert", include_str!("page/skin.vert")),
    ("skin.frag", include_str!("page/skin.frag")),
    ("whole.vert", include_str!("page/whole.vert")),
    ("whole.frag", include_str!("page/whole.frag")),
];

/// The parts of the script, in the order of the computation.
const SCRIPTS: [&str; 5] = [
    include_str!("page/groom.js"),
    include_str!("page/light.js"),
    include_str!("page/camera.js"),
    include_str!("page/draw.js"),
    include_str!("page/start.js"),
];

/// Checks that there is something to draw.
fn check(groom: &Groom) -> Result<(), String> {
    let strands = groom.strands();
    let drawn = strands.iter().filter(|s| s.points.len() > 1).count();
    if drawn == 0 {
        return Err("a groom without lines".into());
    }
    data::check(strands, groom.head.as_ref())
}

/// Writes what [`check`] has passed.
fn encode(out: &mut dyn Write, groom: &Groom, _: Frame) -> io::Result<()> {
    let PageData { header, text } = PageData::new(groom)?;
    let name = if groom.name.is_empty() { "hair" } else { &groom.name };
    let what = format!("{} hairs", groom.strands().len());
    let template = include_str!("page/page.html");
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (key, after) = after.split_once("}}").expect("the template closes what it opens");
        out.write_all(before.as_bytes())?;
        match key {
            "title" => out.write_all(escaped(name).as_bytes())?,
            "what" => out.write_all(what.as_bytes())?,
            "header" => out.write_all(header.as_bytes())?,
            "data" => out.write_all(text.as_bytes())?,
            "script" => SCRIPTS.iter().try_for_each(|s| out.write_all(s.as_bytes()))?,
            _ => {
                let file = FILES.iter().find(|(of, _)| *of == key);
                out.write_all(file.expect("a file for each key of the template").1.as_bytes())?;
            }
        }
        rest = after;
    }
    out.write_all(rest.as_bytes())
}

/// A text as HTML has it, in elements and attributes.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use frisure_strands::Strands;
    use glam::Vec3;

    fn page(groom: &Groom) -> String {
        check(groom).unwrap();
        let mut out = Vec::new();
        encode(&mut out, groom, Frame::METRES_Z).unwrap();
        String::from_utf8(out).unwrap()
    }

    fn one() -> Groom {
        let mut hairs = Strands::new();
        hairs.push(&[Vec3::ZERO, Vec3::new(0.0, 0.0, -0.1)], &[35e-6; 2]);
        Groom::of(hairs)
    }

    #[test]
    fn a_name_is_text_and_no_markup() {
        let page = page(&Groom { name: "</title><script>alert(\"1\")".into(), ..one() });
        assert!(page.contains("<title>&lt;/title&gt;&lt;script&gt;alert(&quot;1&quot;)</title>"));
        assert!(!page.contains("<script>alert"));
    }

    #[test]
    fn the_page_has_all_its_parts_and_names_no_other_file() {
        let page = page(&one());
        assert!(!page.contains("{{"), "a part of the template is open");
        for word in ["http:", "https:", " src=", " href=", "fetch(", "import "] {
            assert!(!page.contains(word), "{word}");
        }
        assert!(page.contains("default-src 'none'"));
    }

    #[test]
    fn points_without_lines_have_no_place() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::X], &[1e-5]);
        assert!(check(&Groom::of(strands)).is_err());
        assert!(check(&Groom::default()).is_err());
    }
}
