//! Sessions of a person.

use crate::salon::Salon;

/// Few hairs and one sample: all is drawn without a graphics card.
const QUERY: &str = "?backend=webgl&samples=1&hairs=150";

/// A scene that takes no time.
const SMALL: &str = "[hair]\ntype = \"straight\"\nlength = \"9 cm\"\n[wisps]\ncount = 30\n";

/// Where the head is in a picture: left, top, width and height as parts of 1.
const HEAD: [f64; 4] = [0.05, 0.15, 0.5, 0.7];

#[test]
fn a_head_is_opened_wetted_cut_dried_saved_and_exported() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    println!("the page runs after {:.1} s", salon.runs().as_secs_f64());
    assert_eq!(salon.page.evaluate("window.crossOriginIsolated"), true);
    let gallery = salon.picture("1-gallery");
    assert!(gallery.colours([0.0, 0.0, 1.0, 1.0]) > 500, "an empty gallery");

    let start = std::time::Instant::now();
    salon.click("Begin: Curly");
    salon.until("s.drawn && s.name");
    println!("the first head after {:.1} s more", start.elapsed().as_secs_f64());
    let curly = salon.picture("2-curly");
    assert!(curly.colours(HEAD) > 500, "no head");

    salon.click("Wet");
    salon.until("s.wet");
    let wet = salon.picture("3-wet");
    assert!(wet.change(&curly, HEAD) > 0.003, "wet hair looks as dry hair");

    salon.click("Fringe");
    salon.until("s.selected == 'fringe' && s.selectedWisps > 0");
    let before = salon.state("mass").as_f64().expect("a mass");
    salon.click("Cut");
    // Drags the plane above the selected tips.
    let [x, y] = salon.middle("The head");
    salon.page.drag([x, y + 120.0], [x, y - 60.0]);
    salon.picture("4-plane");
    salon.click("Cut here");
    salon.until(&format!("s.mass < {before} - 1e-5"));
    let cut = salon.picture("5-cut");
    assert!(cut.change(&wet, HEAD) > 0.0003, "a cut fringe looks as before");

    salon.click("Dry");
    salon.until("!s.wet && s.history.length == s.at + 1");
    salon.picture("6-dry");
    let done = salon.state("history.map((label) => label.split(' ')[0])");
    assert_eq!(done, serde_json::json!(["Curly", "Wet:", "Cut:", "Dry:"]));

    salon.click("Undo");
    salon.until("s.wet && s.at == 2");

    salon.click("Save…");
    salon.click("Save scene");
    let scene = String::from_utf8(salon.page.downloaded("curly.toml")).expect("a text");
    assert!(scene.contains("wet") && scene.contains("cut"), "{scene}");
    assert_eq!(serde_json::json!(scene), salon.state("text"));

    salon.click("Export…");
    salon.click("Export groom");
    let groom = salon.page.downloaded("curly.hair");
    assert_eq!(&groom[..4], b"HAIR");
    let strands = u32::from_le_bytes([groom[4], groom[5], groom[6], groom[7]]);
    assert!(strands > 50_000, "all hairs are exported, not those that are drawn: {strands}");
    println!("memory: {}", salon.page.evaluate("frisure.measured().memory / 1e6"));
    salon.picture("7-saved");
    salon.is_quiet();
}

#[test]
fn unsaved_work_is_recovered_after_leaving_the_page() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.drop_file("small.toml", SMALL);
    salon.until("s.drawn");
    salon.click("Wet");
    salon.until("s.at == 1");
    salon.page.wait_for("Object.keys(localStorage).length", 60);
    let text = salon.state("text");
    salon.again(QUERY);
    salon.runs();
    salon.picture("kept");
    salon.click("Recover");
    salon.until("s.drawn");
    assert_eq!(salon.state("text"), text);
}

#[test]
fn files_are_opened_by_drop_and_by_dialog() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.drop_file("broken.toml", "[hair]\nlenght = \"20 cm\"\n");
    salon.until("s.messages.some((m) => m.includes('lenght') && m.includes('line 2'))");
    salon.page.drop_file("notes.doc", "hair");
    salon.until("s.messages.some((m) => m.includes('notes.doc'))");
    salon.click("Open…");
    salon.click("Choose a file…");
    salon.page.choose_file("short.toml", SMALL);
    salon.until("s.name == 'short.toml' && s.drawn");
    salon.page.drop_file("ball.obj", "v 0 0 0\nf 1 1 9\n");
    salon.until("s.messages.some((m) => m.includes('ball.obj'))");
    salon.picture("files");
}

#[test]
fn a_groom_is_opened_by_drop_and_by_dialog_and_wetted() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.drop_file("small.toml", format!("{SMALL}hairs = 150\n"));
    salon.until("s.drawn && s.settled");
    salon.click("Export…");
    salon.click("Export groom");
    let groom = salon.page.downloaded("small.hair");

    // In an empty salon it begins a scene.
    salon.again(QUERY);
    salon.runs();
    salon.page.drop_file("her-hair.hair", &groom);
    salon.until(
        "s.settled && s.name == 'her-hair' && s.drawn == 150 && s.held.includes('within 1 mm')",
    );
    salon.until("s.messages.some((m) => m.startsWith('groom: '))");
    let dry = salon.picture("groom");
    assert!(dry.colours(HEAD) > 500, "no hair");
    salon.click("Wet");
    salon.until("s.wet && s.settled");
    assert!(salon.picture("groom-wet").change(&dry, HEAD) > 0.003, "wet hair looks as dry hair");

    // A damaged one is reported, and undone.
    salon.click("Open…");
    salon.click("Choose a file…");
    salon.page.choose_file("cut.hair", &groom[..groom.len() / 2]);
    salon.until("s.messages.some((m) => m.includes('cut.hair'))");
    salon.command("undo");
    salon.until("s.settled && s.wet && s.text.includes('her-hair.hair')");
    salon.is_quiet();
}

#[test]
fn the_page_runs_without_headers_and_under_a_path() {
    let server = ["--plain", "--under", "some/where"];
    let Some(mut salon) = Salon::open(&format!("{QUERY}&scene=bob"), &server, &[]) else { return };
    salon.runs();
    // What the address asks for is begun; what is outdated ends, and what comes after it is done.
    salon.until("!s.gallery");
    salon.page.drop_file("small.toml", SMALL);
    assert_eq!(salon.page.evaluate("window.crossOriginIsolated"), false);
    salon.until("s.drawn");
    salon.command("wet");
    salon.command("undo");
    salon.command("wet");
    salon.until("s.wet");
    salon.is_quiet();
}

#[test]
fn a_screen_reader_finds_and_uses_widgets() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.page.evaluate("document.getElementById('describe').click()");
    let card = "document.querySelector('#aria-tree button[aria-label=\"Begin: Straight\"]')";
    salon.page.wait_for(card, 60);
    salon.page.drop_file("small.toml", SMALL);
    salon.until("s.drawn");
    let wet = "document.querySelector('#aria-tree button[aria-label=\"Wet\"]')";
    salon.page.wait_for(wet, 60);
    salon.page.evaluate(&format!("{wet}.click()"));
    salon.until("s.wet");
    let length = "document.querySelector('#aria-tree [role=slider][aria-label=\"Length\"]')";
    salon.page.wait_for(length, 60);
    let value = format!("Number({length}.getAttribute('aria-valuenow'))");
    let before = salon.page.evaluate(&value).as_f64().expect("a length");
    salon.page.evaluate(&format!(
        "{length}.dispatchEvent(new KeyboardEvent('keydown', {{ key: 'ArrowUp' }}))"
    ));
    salon.page.wait_for(&format!("{value} > {before}"), 60);
}

/// Not a test: the figures of `docs/page.md`, for a computer that has nothing else to do.
#[test]
#[ignore = "measures"]
fn measures() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    println!("the gallery after {:.2} s", salon.runs().as_secs_f64());
    salon.tell_work("gallery");
    salon.page.drop_file("small.toml", SMALL);
    salon.until("s.settled");
    salon.picture("measured-small");
    salon.tell_work("a small head");
    salon.command("begin curly");
    salon.until("s.drawn && s.name == 'Curly'");
    salon.picture("measured-first");
    salon.tell_work("the first head");
    salon.until("s.settled");
    salon.picture("measured-rest");
    salon.tell_work("at rest");
    std::thread::sleep(std::time::Duration::from_secs(5));
    salon.tell_work("5 s later");
}
