//! Failures are reported, with a hint.

use crate::salon::Salon;

const QUERY: &str = "?backend=webgl&samples=1&hairs=150";

#[test]
fn a_panic_is_reported_and_the_page_can_be_reloaded() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.evaluate("(() => { try { window.frisure.breakDown() } catch {} })()");
    let notice = salon.notice();
    assert!(notice.contains("The salon stopped") && notice.contains("Reload"), "{notice}");
    salon.picture("failure-panic");
    let report = salon.page.evaluate("document.getElementById('report').textContent");
    assert!(report.as_str().is_some_and(|r| r.contains("panic by command")), "{report}");
    salon.page.evaluate("document.getElementById('again').click()");
    salon.runs();
}

#[test]
fn lost_graphics_are_reported() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.evaluate(
        "document.getElementById('salon').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()",
    );
    let notice = salon.notice();
    assert!(notice.contains("The graphics were lost") && notice.contains("Reload"), "{notice}");
    salon.picture("failure-graphics");
}

#[test]
fn a_browser_without_graphics_gets_a_hint() {
    let Some(mut salon) = Salon::open("", &[], &["--disable-3d-apis", "--disable-features=WebGPU"])
    else {
        return;
    };
    let notice = salon.notice();
    assert!(notice.contains("hardware acceleration"), "{notice}");
    salon.picture("failure-no-graphics");
}

#[test]
fn a_lost_connection_is_reported() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    // On a visit whose files the browser has not kept.
    salon.kept();
    let forget = "navigator.serviceWorker.getRegistrations().then((all) => Promise.all(all.map((one) => one.unregister())))\
                  .then(() => caches.keys()).then((names) => Promise.all(names.map((name) => caches.delete(name))))\
                  .then(() => { window.forgotten = true; })";
    salon.page.evaluate(&format!("({forget}, true)"));
    salon.page.wait_for("window.forgotten", 30);
    salon.page.block("*salon_bg.wasm*");
    salon.again(QUERY);
    let notice = salon.notice();
    assert!(notice.contains("could not be opened") && notice.contains("connection"), "{notice}");
}

#[test]
fn the_salon_opens_without_a_connection_after_the_first_visit() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.kept();
    salon.stop_server();
    salon.again(&format!("{QUERY}&scene=curly"));
    salon.runs();
    salon.until("s.drawn && s.name");
    salon.picture("offline");
}
