//! What goes wrong is told, with what to do.

use crate::salon::Salon;

const QUERY: &str = "?backend=webgl&samples=1&hairs=150";

#[test]
fn a_program_that_breaks_down_says_so_and_opens_again() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.evaluate("(() => { try { window.frisure.breakDown() } catch {} })()");
    let told = salon.notice();
    assert!(told.contains("The salon stopped") && told.contains("Reload"), "{told}");
    salon.picture("trouble-panic");
    let report = salon.page.evaluate("document.getElementById('report').textContent");
    assert!(report.as_str().is_some_and(|r| r.contains("asked to break down")), "{report}");
    salon.page.evaluate("document.getElementById('again').click()");
    salon.runs();
}

#[test]
fn lost_graphics_are_told() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.evaluate(
        "document.getElementById('salon').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()",
    );
    let told = salon.notice();
    assert!(told.contains("The graphics were lost") && told.contains("Reload"), "{told}");
    salon.picture("trouble-graphics");
}

#[test]
fn a_browser_without_graphics_is_told_what_to_do() {
    let Some(mut salon) = Salon::open("", &[], &["--disable-3d-apis", "--disable-features=WebGPU"])
    else {
        return;
    };
    let told = salon.notice();
    assert!(told.contains("hardware acceleration"), "{told}");
    salon.picture("trouble-no-graphics");
}

#[test]
fn a_connection_that_breaks_off_is_told() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.block("*salon_bg.wasm*");
    salon.again(QUERY);
    let told = salon.notice();
    assert!(told.contains("could not be opened") && told.contains("connection"), "{told}");
}
