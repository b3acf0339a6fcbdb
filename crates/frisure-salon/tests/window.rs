//! The real window, without a display: driven through its accessibility tree, drawn by whatever
//! graphics there are.
//!
//! With `FRISURE_SCREENSHOTS=FOLDER` each screen is written there, which is how the pictures of
//! `docs/salon.md` are made.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use frisure_salon::locale::{self, Locale};
use frisure_salon::state::{Badge, Command, Destination, Document, EXERCISES, Tool, code};
use frisure_salon::window::desktop::Desktop;
use frisure_salon::window::platform::InputFile;
use frisure_salon::window::{App, Parts};
use frisure_salon::work::Worker;
use frisure_salon::work::native::Thread;

/// Longest that hair may take to settle on the slowest machine.
const PATIENCE: Duration = Duration::from_secs(120);

struct Window {
    harness: Harness<'static, App>,
    folder: tempfile::TempDir,
    screens: usize,
}

/// Whether there is something to draw with. Where the gate has installed it, there has to be.
fn has_graphics() -> bool {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapters = instance.enumerate_adapters(wgpu::Backends::from_env().unwrap_or_default());
    let any = !pollster::block_on(adapters).is_empty();
    assert!(any || std::env::var_os("FRISURE_NEEDS_GPU").is_none(), "no graphics driver");
    any
}

impl Window {
    fn open(size: [f32; 2], scale: f32) -> Self {
        Self::open_in(Locale::English, size, scale)
    }

    fn open_in(locale: Locale, size: [f32; 2], scale: f32) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let kept = folder.path().join("kept.toml");
        let harness = Harness::builder()
            .with_size(vec2(size[0], size[1]))
            .with_pixels_per_point(scale)
            .with_max_steps(64)
            .wgpu()
            .build_eframe(move |cc| {
                let worker = || -> Box<dyn Worker> {
                    Box::new(Thread::start(Arc::new(|| ())).expect("a thread"))
                };
                let platform = Box::new(Desktop::new(Some(kept), Arc::new(|| ())));
                let parts = Parts {
                    workers: [worker(), worker()],
                    platform,
                    samples: 1,
                    locale: Some(locale),
                };
                App::new(cc, parts)
            });
        Self { harness, folder, screens: 0 }
    }

    fn steps(&mut self, count: usize) {
        for _ in 0..count {
            self.harness.step();
        }
    }

    /// Lets the hair come to rest, and the picture with it.
    fn settle(&mut self) {
        self.wait("the hair", |app| app.salon().is_settled() && app.salon().background().is_none());
        // Pictures are complete a moment after the last movement.
        for _ in 0..30 {
            self.harness.step();
        }
    }

    fn wait(&mut self, what: &str, done: impl Fn(&App) -> bool) {
        let since = Instant::now();
        loop {
            self.steps(2);
            if done(self.harness.state()) {
                return;
            }
            let salon = self.harness.state().salon();
            let (badge, messages) = (salon.badge(), &salon.messages);
            let (tool, isolated) =
                (salon.tool, salon.isolated.as_ref().map(|isolated| isolated.wisp));
            assert!(
                since.elapsed() < PATIENCE,
                "{what} is late: {badge:?} {tool:?} {isolated:?} {messages:?}"
            );
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Clicks what has a name.
    fn click(&mut self, label: &str) {
        self.harness.get_by_role_and_label(Role::Button, label).click();
        self.steps(3);
    }

    fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.steps(3);
    }

    /// Draws with the left button held.
    fn drag(&mut self, path: &[Pos2], modifiers: Modifiers) {
        let button = |pos, pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers,
        };
        self.harness.event_modifiers(Event::PointerMoved(path[0]), modifiers);
        self.steps(1);
        self.harness.event(button(path[0], true));
        self.steps(1);
        for at in path {
            self.harness.event_modifiers(Event::PointerMoved(*at), modifiers);
            self.steps(1);
        }
        self.harness.event(button(path[path.len() - 1], false));
        self.harness.event(Event::ModifiersChanged(Modifiers::NONE));
        self.steps(2);
    }

    /// Presses the left button and lets it go at once.
    fn press(&mut self, pos: Pos2) {
        self.harness.event(Event::PointerMoved(pos));
        for pressed in [true, false] {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            self.harness.event(Event::PointerButton { pos, button, pressed, modifiers });
        }
        self.steps(3);
    }

    /// Gives the button of a name the focus, as Tab does, and presses it with the keyboard.
    fn press_focused(&mut self, label: &str) {
        self.harness.get_by_role_and_label(Role::Button, label).focus();
        self.steps(2);
        self.key(Modifiers::NONE, Key::Space);
        self.steps(2);
    }

    /// Writes into the field of a name.
    fn write(&mut self, label: &str, text: &str) {
        let field = self.harness.get_by_role_and_label(Role::TextInput, label);
        field.focus();
        self.steps(2);
        self.key(Modifiers::COMMAND, Key::A);
        self.harness.get_by_role_and_label(Role::TextInput, label).type_text(text);
        self.steps(2);
    }

    /// A picture of the window, which has to show something.
    fn screen(&mut self, name: &str) -> Vec<u8> {
        // A driver that compiles its shaders at the first picture may be late, and is asked again.
        let since = Instant::now();
        let image = loop {
            match self.harness.render() {
                Ok(image) => break image,
                Err(late) => assert!(since.elapsed() < PATIENCE, "{name}: {late}"),
            }
        };
        let pixels = image.as_raw().clone();
        let first = &pixels[..4];
        assert!(pixels.chunks_exact(4).any(|p| p != first), "{name} is blank");
        self.screens += 1;
        if let Some(folder) = std::env::var_os("FRISURE_SCREENSHOTS") {
            let path = PathBuf::from(folder).join(format!("{name}.png"));
            image.save(path).expect("a file");
        }
        pixels
    }

    /// Opens a head with few hairs.
    fn small(&mut self, hair_type: &str) {
        let text = format!(
            "[hair]\ntype = \"{hair_type}\"\n\n[wisps]\ncount = 40\nhairs = 1500\npoints = 12\n"
        );
        let file = InputFile { path: None, name: "small.toml".into(), bytes: text.into_bytes() };
        self.harness.state_mut().take(file);
        self.settle();
    }

    fn text(&self) -> String {
        self.harness.state().salon().document.as_ref().expect("a document").text().to_owned()
    }
}

#[test]
fn a_session_in_the_window() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 1.0);
    window.steps(3);
    let gallery = window.screen("gallery");
    // The gallery's own button, then a head with fewer hairs, for the time's sake.
    window.click("Begin: Curly");
    assert_eq!(window.harness.state().salon().document.as_ref().map(Document::name), Some("Curly"));
    window.small("curly");
    let dry = window.screen("test-dry");
    assert!(dry != gallery);

    window.click("Wet");
    window.settle();
    let wet = window.screen("test-wet");
    assert!(wet != dry && window.text().contains("wet = {}"));

    window.click("Fringe");
    window.wait("the choice", |app| app.salon().selected.count().is_some());
    window.click("Cut");
    window.steps(10);
    window.screen("test-cut");
    window.click("Cut here");
    window.settle();
    assert!(window.text().contains("cut = {"), "{}", window.text());

    window.click("Dry");
    window.settle();
    assert!(window.text().contains("dry = {"), "{}", window.text());
    window.click("Undo");
    window.settle();
    assert!(!window.text().contains("dry = {"));
    window.key(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    window.settle();
    assert!(window.text().contains("dry = {"));

    let scene = window.folder.path().join("curls.toml");
    window.key(Modifiers::COMMAND, Key::S);
    window.write("File", &scene.display().to_string());
    window.click("Save scene");
    window.steps(3);
    assert_eq!(std::fs::read_to_string(&scene).expect("a file"), window.text());

    let groom = window.folder.path().join("curls.hair");
    window.key(Modifiers::COMMAND, Key::E);
    window.write("File", &groom.display().to_string());
    window.click("Export groom");
    window.settle();
    assert_eq!(&std::fs::read(&groom).expect("a file")[..4], b"HAIR");
}

#[test]
fn pointer_and_keys_orbit_select_cut_and_pick() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 1.0);
    window.small("curly");
    let before = window.harness.state().salon().orbit;
    let path: Vec<Pos2> = (0..10).map(|i| pos2(400.0 + 12.0 * i as f32, 400.0)).collect();
    window.drag(&path, Modifiers::NONE);
    assert!(window.harness.state().salon().orbit.azimuth != before.azimuth);

    window.key(Modifiers::NONE, Key::Num1);
    window.key(Modifiers::NONE, Key::F);
    window.key(Modifiers::NONE, Key::L);
    let around = [(250.0, 150.0), (700.0, 150.0), (700.0, 320.0), (250.0, 320.0), (250.0, 160.0)];
    let path: Vec<Pos2> = around.iter().map(|(x, y)| pos2(*x, *y)).collect();
    window.drag(&path, Modifiers::NONE);
    window.wait("the choice", |app| app.salon().selected.count().is_some());
    let count = window.harness.state().salon().selected.count().expect("wisps");
    assert!(count > 0 && count < 40, "{count}");

    window.key(Modifiers::NONE, Key::C);
    let plane = window.harness.state().salon().plane;
    let path: Vec<Pos2> = (0..6).map(|i| pos2(450.0, 500.0 - 8.0 * i as f32)).collect();
    window.drag(&path, Modifiers::NONE);
    let raised = window.harness.state().salon().plane;
    assert!(raised.point.z > plane.point.z + 0.005, "{plane:?} {raised:?}");
    window.drag(&[pos2(450.0, 400.0), pos2(500.0, 400.0)], Modifiers::SHIFT);
    assert!(window.harness.state().salon().plane.roll != 0.0);
    window.key(Modifiers::NONE, Key::Enter);
    window.settle();
    assert!(window.text().contains("cut = {"), "{}", window.text());

    window.key(Modifiers::NONE, Key::H);
    window.press(pos2(450.0, 250.0));
    window.wait("the hair", |app| app.salon().isolated.as_ref().is_some_and(|a| a.hair.is_some()));
    window.screen("test-isolated");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(window.harness.state().salon().isolated.is_none());
}

#[test]
fn enter_and_escape_end_what_is_typed_in_a_field_and_do_nothing_else() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 1.0);
    window.small("wavy");
    window.click("Fringe");
    window.wait("the choice", |app| app.salon().selected.count().is_some());
    window.key(Modifiers::NONE, Key::C);
    for (end, height) in [(Key::Enter, -0.12), (Key::Escape, -0.08)] {
        let at = window.harness.get_by_role_and_label(Role::SpinButton, "Height").rect().center();
        window.press(at);
        window.key(Modifiers::COMMAND, Key::A);
        window.harness.event(Event::Text(if end == Key::Enter { "-12" } else { "-8" }.into()));
        window.steps(2);
        window.key(Modifiers::NONE, end);
        window.settle();
        let salon = window.harness.state().salon();
        assert!(!salon.document.as_ref().expect("one").text().contains("cut = {"), "{end:?}");
        assert_eq!(salon.tool, Tool::Cut, "{end:?}");
        assert!(salon.selected.count().is_some(), "{end:?}");
        assert!((salon.plane.point.z - height).abs() < 1e-9, "{end:?}: {:?}", salon.plane);
    }
}

#[test]
fn one_drag_of_a_slider_is_one_edit() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 1.0);
    window.small("wavy");
    let edits = window.harness.state().salon().document.as_ref().expect("one").edits().len();
    let slider = window.harness.get_by_role_and_label(Role::Slider, "Diameter").rect();
    let y = slider.center().y;
    let path: Vec<Pos2> = (0..5).map(|i| pos2(slider.left() + 20.0 + 8.0 * i as f32, y)).collect();
    window.drag(&path, Modifiers::NONE);
    window.settle();
    let document = window.harness.state().salon().document.as_ref().expect("one").clone();
    assert_eq!(document.edits().len(), edits + 1, "one edit for one drag");
    assert!(document.text().contains("diameter"), "{}", document.text());
    let labels: Vec<_> = document.edits().iter().map(|e| e.label.clone()).collect();
    assert!(labels[edits].starts_with("Diameter: "), "{labels:?}");
}

#[test]
fn every_control_has_a_name_at_twice_the_scale_and_in_the_light_theme() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 2.0);
    window.small("curly");
    window.screen("test-twice");
    window.click("Light");
    window.settle();
    window.screen("test-light");
    // Everything that can be pressed has a name.
    let root = window.harness.root();
    let nameless = root.children_recursive().filter(|node| {
        let node = node.accesskit_node();
        matches!(node.role(), Role::Button | Role::Slider | Role::CheckBox | Role::ComboBox)
            && node.label().is_none_or(|label| label.trim().is_empty())
    });
    let nameless: Vec<_> = nameless.map(|n| format!("{n:?}")).collect();
    assert!(nameless.is_empty(), "{nameless:#?}");
}

#[test]
fn every_button_of_a_small_window_and_of_a_phone_is_inside() {
    if !has_graphics() {
        return;
    }
    let sizes = [([900.0, 600.0], "small"), ([390.0, 844.0], "phone")];
    let each = Locale::ALL.into_iter().flat_map(|locale| sizes.map(|(s, name)| (locale, s, name)));
    for (locale, size, name) in each {
        let name = &format!("test-{name}-{}", locale.tag());
        let mut window = Window::open_in(locale, size, 1.0);
        locale::set(locale);
        window.steps(3);
        window.screen(&format!("{name}-gallery"));
        window.small("wavy");
        for tool in ["scissors", "cut", "lift", "clippers", "comb", "part", "turn"] {
            window.click(&locale::text(&format!("tool-{tool}")));
            window.steps(3);
            // Across: what is below scrolls.
            let inside = -1.0..=size[0] + 1.0;
            let root = window.harness.root();
            let outside: Vec<_> = (root.children_recursive())
                .filter(|node| {
                    let role = node.accesskit_node().role();
                    matches!(
                        role,
                        Role::Button | Role::ComboBox | Role::CheckBox | Role::SpinButton
                    )
                })
                .filter(|node| {
                    let across = node.rect().x_range();
                    !inside.contains(&across.min) || !inside.contains(&across.max)
                })
                .map(|node| format!("{:?} {:?}", node.accesskit_node().label(), node.rect()))
                .collect();
            assert!(outside.is_empty(), "{name}, {tool}: {outside:#?}");
        }
        window.screen(name);
        if size[0] > 700.0 {
            window.key(Modifiers::NONE, Key::U);
            window.harness.event(Event::PointerMoved(pos2(250.0, 160.0)));
            window.steps(3);
            window.screen(&format!("{name}-lift"));
            window.key(Modifiers::NONE, Key::C);
            window.steps(3);
            window.screen(&format!("{name}-levels"));
        }
        if size[0] < 700.0 {
            window.click(&locale::text("panels"));
            let diameter = locale::named("key", "hair.fibre.diameter", "Diameter");
            let slider = window.harness.query_by_role_and_label(Role::Slider, &diameter);
            assert!(slider.is_some());
            window.screen(&format!("{name}-panels"));
        }
    }
}

#[test]
fn broken_files_dropped_on_the_window_are_reported() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 1.0);
    window.small("curly");
    let text = window.text();
    let files: [(&str, &[u8]); 5] = [
        ("bad.toml", b"[hair]\ntype = \"curvy\"\n"),
        ("binary.toml", &[0xff, 0xfe, 0, 1, 2]),
        ("picture.png", b"\x89PNG"),
        ("empty", b""),
        ("empty.toml", b"\0"),
    ];
    for (name, bytes) in files {
        let file = InputFile { path: None, name: name.into(), bytes: bytes.to_vec() };
        window.harness.state_mut().take(file);
        window.steps(3);
        let message = window.harness.state().salon().messages.last().cloned();
        assert!(message.as_ref().is_some_and(|m| m.is_error), "{name}: {message:?}");
    }
    let message =
        |app: &App| app.salon().messages.last().is_some_and(|m| m.text.contains("no-head"));
    let file = InputFile { path: None, name: "no-head.obj".into(), bytes: b"nonsense".to_vec() };
    window.harness.state_mut().take(file);
    window.wait("what it is", message);
    assert_eq!(window.text(), text);
    let bytes = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec();
    window.harness.state_mut().take(InputFile { path: None, name: "flat.obj".into(), bytes });
    window.wait("the refusal", |app| matches!(app.salon().badge(), Badge::Refused(_)));
    window.harness.state_mut().run(Command::Undo);
    window.settle();
    assert_eq!(window.text(), text);
    window.screen("test-message");
}

#[test]
fn a_killed_window_offers_its_autosaved_work() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1000.0, 700.0], 1.0);
    window.small("curly");
    window.click("Wet");
    window.settle();
    let kept = window.folder.path().join("kept.toml");
    let since = Instant::now();
    while !kept.exists() && since.elapsed() < PATIENCE {
        window.steps(1);
        std::thread::sleep(Duration::from_millis(50));
    }
    let text = window.text();
    let Window { harness, folder, .. } = window;
    drop(harness);
    let mut next = Window::open([1000.0, 700.0], 1.0);
    std::fs::copy(folder.path().join("kept.toml"), next.folder.path().join("kept.toml"))
        .expect("kept");
    let kept = std::fs::read_to_string(next.folder.path().join("kept.toml")).expect("kept");
    next.harness.state_mut().offer_recovery(&kept);
    next.steps(3);
    next.screen("recovery");
    next.click("Recover");
    next.settle();
    assert_eq!(next.text(), text);
}

#[test]
fn a_groom_opened_in_the_window_is_held_and_its_axis_can_be_set() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 1.0);
    window.small("wavy");
    let groom = window.folder.path().join("her-hair.npz");
    window.harness.state_mut().run(Command::Export(Destination::Path(groom.clone())));
    window.settle();
    window.small("straight");
    let straight = window.screen("test-before-groom");

    window.key(Modifiers::COMMAND, Key::O);
    window.write("File", &groom.display().to_string());
    window.click("Open file");
    window.wait("the groom", |app| app.salon().files().groom);
    window.settle();
    assert!(window.screen("test-groom") != straight);
    let message = "guides stay within 1 mm";
    let is_told = |app: &App| app.salon().messages.iter().any(|m| m.text.contains(message));
    assert!(is_told(window.harness.state()));
    assert!(window.harness.query_by_role_and_label(Role::Slider, "Curl radius").is_none());
    assert!(window.harness.query_by_role_and_label(Role::Slider, "Diameter").is_some());

    window.harness.get_by_role_and_label(Role::ComboBox, "Up in the groom").click();
    window.steps(3);
    window.click("y, the face along z");
    window.wait("the refusal", |app| matches!(app.salon().badge(), Badge::Refused(_)));
    window.steps(3);
    window.screen("test-groom-axis");
    window.click("Undo");
    window.settle();
    window.click("Use the scene's own hair");
    window.settle();
    assert!(!window.text().contains("her-hair"), "{}", window.text());
}

#[test]
fn the_tour_can_be_taken_without_a_pointer() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([900.0, 600.0], 1.0);
    window.press_focused("Take the tour");
    // A head with fewer hairs, for the time's sake.
    window.small("curly");
    let done = |window: &Window| window.harness.state().salon().is_step_done();
    window.key(Modifiers::NONE, Key::ArrowLeft);
    assert!(done(&window), "turned");
    window.press_focused("Next");
    window.key(Modifiers::NONE, Key::W);
    window.settle();
    assert!(done(&window), "wet");
    window.press_focused("Next");
    window.press_focused("Fringe");
    window.wait("the choice", |app| app.salon().selected.count().is_some());
    window.screen("tour");
    window.press_focused("Next");
    window.key(Modifiers::NONE, Key::C);
    window.press_focused("Cut here");
    window.settle();
    assert!(done(&window), "cut: {}", window.text());
    window.press_focused("Next");
    window.key(Modifiers::NONE, Key::A);
    window.key(Modifiers::NONE, Key::W);
    window.settle();
    window.key(Modifiers::NONE, Key::X);
    window.settle();
    assert!(done(&window), "dried and compared");
    window.press_focused("Next");
    window.press_focused("End");
    assert!(window.harness.state().salon().tour.is_none());
}

/// The pictures of `docs/salon.md`, with all hairs: only where somebody asks for them.
#[test]
fn the_tour() {
    if std::env::var_os("FRISURE_SCREENSHOTS").is_none() || !has_graphics() {
        return;
    }
    let mut window = Window::open([1280.0, 800.0], 1.0);
    window.click("Begin: Curly");
    window.settle();
    window.key(Modifiers::NONE, Key::F);
    window.settle();
    window.screen("head");
    window.click("Wet");
    window.settle();
    window.screen("wet");
    window.click("Fringe");
    window.settle();
    window.click("Front");
    window.click("Cut");
    let plane = frisure_salon::state::CutPlane::level(0.0);
    window.harness.state_mut().run(Command::Plane(plane));
    window.settle();
    window.screen("cut");
    window.click("Cut here");
    window.settle();
    window.click("Dry");
    window.settle();
    window.click("Turn");
    window.click("All");
    window.harness.state_mut().run(Command::Compare(Some(0)));
    window.settle();
    window.screen("compare");
    window.harness.state_mut().run(Command::Compare(None));
    window.click("Three-quarter");
    window.click("One hair");
    window.harness.state_mut().run(Command::Isolate(Some(20)));
    window.settle();
    window.screen("isolated");
    window.click("All hair");
    window.key(Modifiers::COMMAND, Key::P);
    window.steps(5);
    window.screen("picture");
    window.click("Close");
    window.key(Modifiers::NONE, Key::F1);
    window.steps(5);
    window.screen("keys");
    window.click("Close");
    window.harness.state_mut().run(Command::BeginExercise("bob".into()));
    window.settle();
    window.harness.state_mut().run(Command::CompareGoal);
    window.harness.state_mut().run(Command::ToggleGoalMarks);
    window
        .wait("the goal", |app| app.salon().comparison.as_ref().is_some_and(|c| c.hair.is_some()));
    window.settle();
    window.screen("exercise-bob");
    window.harness.state_mut().run(Command::BeginExercise("braid".into()));
    window.settle();
    window.harness.state_mut().run(Command::ToggleReplay);
    window.wait("the braid", |app| {
        app.salon().exercise.as_ref().is_some_and(|e| e.replay.is_none() && e.goal().is_some())
    });
    window.settle();
    window.screen("braid");
}

#[test]
fn an_exercise_is_done_in_the_window_with_its_goal_in_sight() {
    if !has_graphics() {
        return;
    }
    let mut window = Window::open([1000.0, 700.0], 1.0);
    window.steps(3);
    window.click("Begin: A bob");
    // An exercise with fewer hairs, for the time's sake.
    let card = &EXERCISES[1];
    let few =
        [("wisps.count", Some("24")), ("wisps.hairs", Some("1200")), ("wisps.points", Some("10"))];
    let scene = frisure::scene::edit::set_keys(card.scene, &few).expect("a scene");
    window.harness.state_mut().run(Command::BeginExercise(code(&scene)));
    window.settle();
    window.press_focused("Goal");
    window
        .wait("the goal", |app| app.salon().comparison.as_ref().is_some_and(|c| c.hair.is_some()));
    window.press_focused("What is left");
    window.settle();
    window.screen("exercise");
    window.press_focused("Show me");
    window.wait("the solution", |app| {
        app.salon().exercise.as_ref().is_some_and(|e| e.replay.is_none() && e.goal().is_some())
    });
    window.settle();
    let nearness = window.harness.state_mut().nearness().expect("a measure");
    assert!(nearness.done > 0.999, "{nearness:?}");
    window.screen("exercise-done");

    // A parting, and one of its sections hidden, by the keyboard.
    window.press_focused("End");
    window.key(Modifiers::NONE, Key::Num6);
    window.key(Modifiers::NONE, Key::P);
    window.drag(&[pos2(330.0, 200.0), pos2(330.0, 560.0)], Modifiers::NONE);
    window.settle();
    assert_eq!(window.harness.state().salon().sections.len(), 2);
    window.press_focused("Hide Section 1");
    window.settle();
    window.key(Modifiers::NONE, Key::Num1);
    window.settle();
    window.screen("sections");
    assert!(window.text().contains("hidden = true"), "{}", window.text());
}
