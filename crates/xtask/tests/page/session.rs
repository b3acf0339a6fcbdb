//! Sessions of a person.

use crate::salon::Salon;

#[test]
fn the_page_runs_without_headers_and_under_a_path() {
    let server = ["--plain", "--under", "some/where"];
    let Some(mut salon) = Salon::open("?backend=webgl&hairs=500", &server, &[]) else { return };
    salon.runs();
    assert_eq!(salon.page.evaluate("window.crossOriginIsolated"), false);
    salon.until("s.head");
    salon.is_quiet();
}
