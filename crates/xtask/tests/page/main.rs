//! The salon's page in a real browser.
//!
//! Where no Chromium is installed these tests say so and pass; with `FRISURE_NEEDS_BROWSER` set they
//! fail then. Pictures of the run are kept in `target/tmp/page`.

mod chromium;
mod picture;
mod site;

use chromium::Chromium;
use picture::Picture;
use std::path::PathBuf;

/// A laptop's window.
const SIZE: [u32; 2] = [1280, 800];

fn browser() -> Option<PathBuf> {
    let found = chromium::installed();
    let needed = std::env::var_os("FRISURE_NEEDS_BROWSER").is_some();
    assert!(found.is_some() || !needed, "FRISURE_NEEDS_BROWSER is set, but there is no Chromium");
    found
}

fn keep(page: &mut Chromium, name: &str) -> Picture {
    let png = page.screenshot();
    std::fs::write(picture::folder().join(format!("{name}.png")), &png).expect("a picture");
    Picture::read(&png)
}

fn widget(page: &mut Chromium, label: &str) -> [f64; 2] {
    let found = page.wait_for(&format!("window.frisure.widget({label:?})"), 60);
    let at = |corner: &str, size: &str| {
        found[corner].as_f64().unwrap_or(0.0) + 0.5 * found[size].as_f64().unwrap_or(0.0)
    };
    [at("x", "width"), at("y", "height")]
}

fn click(page: &mut Chromium, label: &str) {
    let [x, y] = widget(page, label);
    page.click(x, y);
}

#[test]
fn first() {
    let Some(program) = browser() else { return };
    if std::env::var_os("NOBUILD").is_none() {
        site::build();
    }
    let site = site::serve(&[]);
    let mut page = Chromium::start(&program, SIZE);
    let t = std::time::Instant::now();
    page.open(&format!("{}?backend=webgl", site.address));
    page.wait_for("window.frisure", 20);
    println!("frisure after {:?}", t.elapsed());
    page.wait_for("window.frisure.state()?.head", 20);
    println!("head after {:?}", t.elapsed());
    keep(&mut page, "first");
    println!("{}", page.evaluate("JSON.stringify(frisure.widgets())"));
    click(&mut page, "Wet");
    page.wait_for("window.frisure.state()?.wet", 20);
    click(&mut page, "Save");
    let saved = page.downloaded("scene.toml");
    println!("{}", String::from_utf8_lossy(&saved));
    click(&mut page, "Work");
    page.wait_for("window.frisure.state().told.length > 3", 20);
    println!("isolated {}", page.evaluate("crossOriginIsolated"));
    let t = std::time::Instant::now();
    click(&mut page, "Cancel");
    page.wait_for("window.frisure.state().told.at(-1).includes('cancelled')", 20);
    println!("cancel after {:?}", t.elapsed());
    page.evaluate("document.getElementById('spoken').click()");
    page.wait_for("document.querySelector('#mirror button')", 20);
    println!("{}", page.evaluate("document.getElementById('mirror').outerHTML"));
    keep(&mut page, "second");
    page.evaluate("frisure.command('panic')");
    page.wait_for("!document.getElementById('notice').hidden", 20);
    keep(&mut page, "third");
    println!("{:#?}", page.console);
}
