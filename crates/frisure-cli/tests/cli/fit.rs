//! `frisure fit`.

use std::fmt::Write;

use crate::room::Room;

/// A curl of radius 6 mm that lies flat, without weight.
fn table() -> String {
    let mut text = String::from("fibre,x (mm),y (mm),z (mm),gx,gy,gz\n");
    let (radius, rise) = (6.0_f64, 2.5_f64);
    for i in 0..=40 {
        let angle = 0.35 * f64::from(i);
        let _ = writeln!(
            text,
            "a,{},{},{},0,0,0",
            radius * angle.cos(),
            radius * angle.sin(),
            rise * angle
        );
    }
    text
}

#[test]
fn a_flat_curl_has_its_radius_and_tells_nothing_of_its_stiffness() {
    let room = Room::new().with("lines.csv", table());
    let ran =
        room.run(&["fit", "lines.csv", "--noise", "0.02 mm", "-o", "fits.html", "-o", "fits.json"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{}", ran.out);
    assert!(ran.out.starts_with("fibre a: radius 6.0"), "{}", ran.out);
    assert!(ran.out.contains("stiffness over weight cannot be told from this pose"), "{}", ran.out);
    assert_eq!(room.names(), ["fits.html", "fits.json", "lines.csv"]);
    let quiet = room.run(&["fit", "lines.csv", "--noise", "0.02 mm", "--quiet"]);
    assert_eq!((quiet.code, quiet.out.as_str()), (Some(0), ""));
}

#[test]
fn what_does_not_fit_has_an_exit_status() {
    let rows = (0..20).map(|i| format!("{},{},{}\n", i * 7 % 5, i * 3 % 7, i * 5 % 11));
    let text = format!("x (mm),y (mm),z (mm)\n{}", rows.collect::<String>());
    let ran = Room::new().with("lines.csv", text).run(&["fit", "lines.csv", "--noise", "0.1 mm"]);
    assert_eq!(ran.code, Some(3), "{}", ran.err);
    assert!(ran.out.contains("say nothing"), "{}", ran.out);
}

#[test]
fn wrong_input_is_told_with_file_line_and_hint() {
    let bad = table().replacen("a,6,0,0,0,0,0", "a,six,0,0,0,0,0", 1);
    let room = Room::new().with("bad.csv", bad).with("good.csv", table());
    let cases: [(&[&str], &[&str]); 7] = [
        (&["fit", "bad.csv"], &["bad.csv: line 2: `six` in the column `x (mm)`", "--help"]),
        (&["fit", "none.csv"], &["none.csv"]),
        (&["fit", "good.csv", "-o", "fits.pdf"], &["fits.pdf is no report", ".html or .json"]),
        (&["fit", "good.csv", "--known", "radius=3"], &["`radius` is unknown", "axis-ratio"]),
        (&["fit", "good.csv", "--known", "axis-ratio=0.5"], &["axis ratio is 0.5", "from 1 to 20"]),
        (&["fit", "good.csv", "--knots", "40"], &["number of knots is 40", "from 1 to 16"]),
        (&["fit", "good.csv", "--gravity", "0 0 1"], &["--gravity is for grooms", "gx"]),
    ];
    for (arguments, parts) in cases {
        let ran = room.run(arguments);
        assert_eq!(ran.code, Some(2), "{arguments:?}: {}", ran.err);
        for part in parts {
            assert!(ran.err.contains(part), "{arguments:?}: {part}: {}", ran.err);
        }
    }
}
