//! The salon in a browser, as a person and as a program has it.

use crate::chromium::Chromium;
use crate::picture::{self, Picture};
use crate::site::{self, Site};
use crate::{SIZE, browser};
use serde_json::{Value, json};
use std::sync::MutexGuard;
use std::time::{Duration, Instant};

/// Seconds for what takes a second on a computer with a graphics card and nothing else to do.
pub(crate) const LONG: u64 = 240;

/// A page that is open.
pub(crate) struct Salon {
    pub(crate) page: Chromium,
    site: Site,
    _turn: MutexGuard<'static, ()>,
}

impl Salon {
    /// Opens the page with a query, from a server with these arguments, in a browser with more
    /// arguments; `None` where there is no browser.
    pub(crate) fn open(query: &str, server: &[&str], flags: &[&str]) -> Option<Self> {
        let (program, turn) = browser()?;
        let site = site::serve(server);
        let mut page = Chromium::start(&program, SIZE, flags);
        page.open(&format!("{}{query}", site.address));
        Some(Self { page, site, _turn: turn })
    }

    /// Opens it again, in the same browser.
    pub(crate) fn again(&mut self, query: &str) {
        // The way through an empty page ends the old one, whatever state it is in.
        self.page.open("about:blank");
        let address = format!("{}{query}", self.site.address);
        self.page.open(&address);
    }

    /// Waits until it runs, and gives the time it took.
    pub(crate) fn runs(&mut self) -> Duration {
        let start = Instant::now();
        self.page.wait_for("window.frisure?.state()", LONG);
        start.elapsed()
    }

    /// Waits until the browser has kept the files of the page.
    pub(crate) fn kept(&mut self) {
        self.page.wait_for("document.documentElement.dataset.kept", LONG);
    }

    /// Ends the server of the page.
    pub(crate) fn stop_server(&mut self) {
        self.site.stop();
    }

    /// Waits until something holds of its state, called `s`.
    pub(crate) fn until(&mut self, condition: &str) {
        self.page.wait_for(&format!("((s) => s && ({condition}))(window.frisure?.state())"), LONG);
    }

    /// Part of its state.
    pub(crate) fn state(&mut self, path: &str) -> Value {
        self.page.evaluate(&format!("window.frisure.state().{path}"))
    }

    /// Clicks what has this accessible name.
    pub(crate) fn click(&mut self, label: &str) {
        let [x, y] = self.middle(label);
        self.page.click(x, y);
    }

    /// The middle of what has this accessible name, once it is there and stays where it is.
    pub(crate) fn middle(&mut self, label: &str) -> [f64; 2] {
        let found = format!(
            "((w) => w && w.enabled ? [w.x + w.width / 2, w.y + w.height / 2] : null)(window.frisure.widget({label:?}))"
        );
        let mut last = self.page.wait_for(&found, LONG);
        loop {
            std::thread::sleep(Duration::from_millis(300));
            let now = self.page.wait_for(&found, LONG);
            if now == last {
                return [0, 1].map(|i| now[i].as_f64().expect("a place"));
            }
            last = now;
        }
    }

    /// Has it do something by name.
    pub(crate) fn command(&mut self, name: &str) {
        self.page.evaluate(&format!("window.frisure.command({name:?})"));
    }

    /// A picture of it, which is kept.
    pub(crate) fn picture(&mut self, name: &str) -> Picture {
        let png = self.page.screenshot();
        std::fs::write(picture::folder().join(format!("{name}.png")), &png).expect("a picture");
        Picture::read(&png)
    }

    /// What the page says over the canvas, once it says something.
    pub(crate) fn notice(&mut self) -> String {
        let shown = "!document.getElementById('notice').hidden && document.getElementById('progress').hidden";
        self.page.wait_for(shown, LONG);
        let text = self.page.evaluate("document.getElementById('notice').innerText");
        text.as_str().unwrap_or_default().to_owned()
    }

    /// Prints what the page and its browser's processes have done so far (seconds of a core).
    pub(crate) fn tell_work(&mut self, when: &str) {
        let processes = self.page.call_browser("SystemInfo.getProcessInfo", &json!({}));
        let work: Vec<String> = processes["processInfo"]
            .as_array()
            .into_iter()
            .flatten()
            .filter(|p| p["type"] == "GPU" || p["type"] == "renderer")
            .map(|p| format!("{} {:.1} s", p["type"], p["cpuTime"].as_f64().unwrap_or(0.0)))
            .collect();
        let measured = self.page.evaluate("JSON.stringify(window.frisure.measured())");
        println!("{when}: {measured}; {}", work.join(", "));
    }

    /// Nothing was written to the console that somebody should see.
    pub(crate) fn is_quiet(&self) {
        let loud = |line: &&String| line.starts_with("error") || line.starts_with("uncaught");
        let loud: Vec<&String> = self.page.console.iter().filter(loud).collect();
        assert!(loud.is_empty(), "{loud:#?}");
    }
}
