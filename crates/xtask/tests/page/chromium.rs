//! Chromium without a window, driven through a pipe: its DevTools protocol, one line of JSON each
//! way, needs nothing but the browser.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// What the browser says of an expression whose page is left before it is evaluated.
const NAVIGATED: &str = "Inspected target navigated or closed";

/// Pixels for each unit of a page's size: half of them along each side leave a quarter to the rasteriser in the processor, which
/// takes longer than all else.
const SCALE: f64 = 0.5;

/// For one answer of the browser.
const PATIENCE: Duration = Duration::from_secs(120);

/// What browsers are called.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// One page in one browser with an empty profile.
pub(crate) struct Chromium {
    browser: Child,
    to: ChildStdin,
    from: Receiver<Value>,
    session: Option<String>,
    last: u64,
    /// What the page wrote to its console, and what it did not catch.
    pub(crate) console: Vec<String>,
    /// The identifiers and names of downloads that began, and whether they are complete.
    arrivals: Vec<(String, String, bool)>,
    folder: tempfile::TempDir,
}

/// A browser, if one is installed.
pub(crate) fn installed() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    NAMES.iter().flat_map(|name| folders.iter().map(move |f| f.join(name))).find(|p| p.is_file())
}

impl Chromium {
    /// Starts it with an empty page of this size, and with more flags.
    pub(crate) fn start(program: &Path, [width, height]: [u32; 2], flags: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let log = std::fs::File::create(folder.path().join("log")).expect("a log");
        // The protocol goes through the files 3 and 4, which a shell can set.
        let mut browser = Command::new("sh")
            .args(["-c", r#"exec "$0" "$@" 3<&0 4>&1 1>&2 0</dev/null"#])
            .arg(program)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic"])
            .args(["--no-first-run", "--disable-background-networking", "--disable-sync"])
            .args(["--disable-component-update", "--enable-unsafe-swiftshader"])
            .args(["--hide-scrollbars", "--force-color-profile=srgb", "--force-dark-mode"])
            .arg(format!("--force-device-scale-factor={SCALE}"))
            .args([format!("--window-size={width},{height}"), "--remote-debugging-pipe".into()])
            .args(flags)
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(log)
            .spawn()
            .expect("a browser");
        let to = browser.stdin.take().expect("a pipe");
        let from = messages(browser.stdout.take().expect("a pipe"));
        let (session, console, arrivals) = (None, Vec::new(), Vec::new());
        let mut this = Self { browser, to, from, session, last: 0, console, arrivals, folder };
        this.open_page([width, height]);
        this
    }

    fn open_page(&mut self, [width, height]: [u32; 2]) {
        let target = self.call("Target.createTarget", &json!({ "url": "about:blank" }));
        let request = json!({ "targetId": target["targetId"], "flatten": true });
        let attached = self.call("Target.attachToTarget", &request);
        self.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page.enable", "Runtime.enable", "DOM.enable"] {
            self.call(domain, &json!({}));
        }
        let size = json!({
            "width": width, "height": height, "deviceScaleFactor": 0, "mobile": false
        });
        self.call("Emulation.setDeviceMetricsOverride", &size);
        let downloads = json!({
            "behavior": "allow", "downloadPath": self.downloads(), "eventsEnabled": true
        });
        self.call_browser("Browser.setDownloadBehavior", &downloads);
    }

    /// Where downloads arrive.
    pub(crate) fn downloads(&self) -> PathBuf {
        self.folder.path().join("downloads")
    }

    /// The bytes of a file in that folder, once the browser says that it is complete: before that,
    /// an empty file may already have the name.
    pub(crate) fn downloaded(&mut self, name: &str) -> Vec<u8> {
        let until = Instant::now() + PATIENCE;
        while Instant::now() < until {
            if self.arrivals.iter().any(|(_, of, complete)| of == name && *complete) {
                return std::fs::read(self.downloads().join(name)).expect("a download");
            }
            if let Ok(event) = self.from.recv_timeout(Duration::from_millis(100)) {
                self.note(&event);
            }
        }
        let there: Vec<_> = std::fs::read_dir(self.downloads())
            .map(|entries| entries.flatten().map(|e| e.file_name()).collect())
            .unwrap_or_default();
        panic!(
            "{name} did not arrive; there are {there:?}; begun: {:?}; console: {:#?}",
            self.arrivals, self.console
        )
    }

    /// Goes to an address.
    pub(crate) fn open(&mut self, address: &str) {
        let reply = self.call("Page.navigate", &json!({ "url": address }));
        assert!(reply["errorText"].is_null(), "{address}: {reply}");
    }

    /// Lets the page have nothing from such addresses any more.
    pub(crate) fn block(&mut self, pattern: &str) {
        self.call("Network.enable", &json!({}));
        self.call("Network.setCacheDisabled", &json!({ "cacheDisabled": true }));
        self.call("Network.setBlockedURLs", &json!({ "urls": [pattern] }));
    }

    /// What an expression of JavaScript gives; promises are waited for.
    pub(crate) fn evaluate(&mut self, expression: &str) -> Value {
        let request =
            json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let reply = self.call("Runtime.evaluate", &request);
        assert!(reply["exceptionDetails"].is_null(), "{expression}: {reply}");
        reply["result"]["value"].clone()
    }

    /// The first value of an expression that is true in JavaScript's sense. While it cannot be
    /// evaluated, it is not.
    pub(crate) fn wait_for(&mut self, expression: &str, seconds: u64) -> Value {
        let until = Instant::now() + Duration::from_secs(seconds);
        let guarded = format!(
            "(() => {{ try {{ return ({expression}) || null }} catch {{ return null }} }})()"
        );
        loop {
            let value = self.evaluate(&guarded);
            if !value.is_null() {
                return value;
            }
            if Instant::now() > until {
                self.give_up(&format!("not in {seconds} s: {expression}"));
            }
            std::thread::sleep(Duration::from_millis(150));
        }
    }

    /// Fails with all that is known.
    fn give_up(&mut self, reason: &str) -> ! {
        let notice = self.evaluate("document.getElementById('notice')?.textContent");
        let state = self.evaluate("JSON.stringify(window.frisure?.state())");
        let path = crate::picture::folder().join("failed.png");
        std::fs::write(path, self.screenshot()).expect("a picture");
        panic!("{reason}\nnotice: {notice}\nstate: {state}\nconsole: {:#?}", self.console)
    }

    /// Presses and releases the left button there.
    pub(crate) fn click(&mut self, x: f64, y: f64) {
        self.mouse("mouseMoved", x, y, 0);
        // At once, as a finger does: what is held for a second, because the page is busy between, is
        // no click.
        let press = self.send("Input.dispatchMouseEvent", &left("mousePressed", x, y, 1));
        let release = self.send("Input.dispatchMouseEvent", &left("mouseReleased", x, y, 0));
        self.answer(press, "mousePressed");
        self.answer(release, "mouseReleased");
    }

    /// Drags from one place to another.
    pub(crate) fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.mouse("mouseMoved", from[0], from[1], 0);
        self.mouse("mousePressed", from[0], from[1], 1);
        for part in [0.25, 0.5, 0.75, 1.0] {
            let at = [0, 1].map(|i| from[i] + part * (to[i] - from[i]));
            self.mouse("mouseMoved", at[0], at[1], 1);
        }
        self.mouse("mouseReleased", to[0], to[1], 0);
    }

    /// Turns the wheel there: what is below comes up.
    pub(crate) fn scroll(&mut self, [x, y]: [f64; 2], down: f64) {
        self.mouse("mouseMoved", x, y, 0);
        let event = json!({ "type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": down });
        self.call("Input.dispatchMouseEvent", &event);
    }

    fn mouse(&mut self, kind: &str, x: f64, y: f64, buttons: u32) {
        self.call("Input.dispatchMouseEvent", &left(kind, x, y, buttons));
    }

    /// Presses a key, by its name and code in the DOM.
    pub(crate) fn key(&mut self, key: &str, code: &str) {
        for kind in ["keyDown", "keyUp"] {
            let mut event = json!({ "type": kind, "key": key, "code": code });
            if kind == "keyDown" && key.len() == 1 {
                event["text"] = json!(key);
            }
            self.call("Input.dispatchKeyEvent", &event);
        }
    }

    /// Drops a file with these bytes on the middle of the page.
    pub(crate) fn drop_file(&mut self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.file(name, bytes);
        let data = json!({ "items": [], "files": [path], "dragOperationsMask": 1 });
        for kind in ["dragEnter", "dragOver", "drop"] {
            let event = json!({ "type": kind, "x": 400, "y": 400, "data": data });
            self.call("Input.dispatchDragEvent", &event);
        }
    }

    /// Chooses a file with these bytes where the page asks for one.
    pub(crate) fn choose_file(&mut self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.file(name, bytes);
        let field = "document.querySelector('input[type=file]')";
        self.wait_for(field, 60);
        let found = self.call("Runtime.evaluate", &json!({ "expression": field }));
        let object = &found["result"]["objectId"];
        self.call("DOM.setFileInputFiles", &json!({ "files": [path], "objectId": object }));
    }

    fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.path().join(name);
        std::fs::write(&path, bytes).expect("a file");
        path
    }

    /// What is seen now, as the bytes of a PNG.
    pub(crate) fn screenshot(&mut self) -> Vec<u8> {
        let reply = self.call("Page.captureScreenshot", &json!({ "format": "png" }));
        BASE64_STANDARD.decode(reply["data"].as_str().expect("a picture")).expect("base64")
    }

    /// Calls a method of the protocol.
    pub(crate) fn call(&mut self, method: &str, params: &Value) -> Value {
        let id = self.send(method, params);
        self.answer(id, method)
    }

    /// Calls a method that is about the whole browser.
    pub(crate) fn call_browser(&mut self, method: &str, params: &Value) -> Value {
        let session = self.session.take();
        let id = self.send(method, params);
        self.session = session;
        self.answer(id, method)
    }

    fn send(&mut self, method: &str, params: &Value) -> u64 {
        self.last += 1;
        let mut message = json!({ "id": self.last, "method": method, "params": params });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        self.to.write_all(format!("{message}\0").as_bytes()).expect("a message to the browser");
        self.last
    }

    fn answer(&mut self, id: u64, method: &str) -> Value {
        loop {
            let answer = self.from.recv_timeout(PATIENCE).unwrap_or_else(|_| {
                let log = std::fs::read_to_string(self.folder.path().join("log"));
                panic!("no answer to {method}; the browser's log: {}", log.unwrap_or_default())
            });
            if answer["id"] == json!(id) {
                // The page was left while the question was on its way: it has no answer, and is asked again.
                if answer["error"]["message"] == json!(NAVIGATED) {
                    return Value::Null;
                }
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.note(&answer);
        }
    }

    /// Keeps what the page writes to its console, and what is downloaded.
    fn note(&mut self, event: &Value) {
        let params = &event["params"];
        match event["method"].as_str() {
            Some("Runtime.consoleAPICalled") => {
                let words: Vec<String> = params["args"]
                    .as_array()
                    .into_iter()
                    .flatten()
                    .map(|arg| {
                        arg["value"]
                            .as_str()
                            .map_or_else(|| arg["description"].to_string(), str::to_owned)
                    })
                    .collect();
                self.console.push(format!(
                    "{}: {}",
                    params["type"].as_str().unwrap_or(""),
                    words.join(" ")
                ));
            }
            Some("Runtime.exceptionThrown") => {
                self.console.push(format!("uncaught: {}", params["exceptionDetails"]));
            }
            Some("Browser.downloadWillBegin") => {
                let text = |key: &str| params[key].as_str().unwrap_or("").to_owned();
                self.arrivals.push((text("guid"), text("suggestedFilename"), false));
            }
            Some("Browser.downloadProgress") if params["state"] == json!("completed") => {
                let done = self.arrivals.iter_mut().filter(|(id, ..)| params["guid"] == json!(id));
                done.for_each(|(.., complete)| *complete = true);
            }
            _ => {}
        }
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        // Politely first: it ends its own processes.
        let _ = self.to.write_all(b"{\"id\":0,\"method\":\"Browser.close\"}\0");
        let until = Instant::now() + Duration::from_secs(5);
        while Instant::now() < until {
            if matches!(self.browser.try_wait(), Ok(Some(_))) {
                return;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        let _ = self.browser.kill();
        let _ = self.browser.wait();
    }
}

/// An event of the mouse with its left button, or with none while it moves freely.
fn left(kind: &str, x: f64, y: f64, buttons: u32) -> Value {
    let button = if kind == "mouseMoved" && buttons == 0 { "none" } else { "left" };
    json!({ "type": kind, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": 1 })
}

/// Messages of the browser, each ended by a zero byte.
fn messages(pipe: impl std::io::Read + Send + 'static) -> Receiver<Value> {
    let (send, receive) = channel();
    std::thread::spawn(move || {
        let mut pipe = BufReader::new(pipe);
        let mut bytes = Vec::new();
        while pipe.read_until(0, &mut bytes).is_ok_and(|n| n > 0) {
            bytes.pop();
            let Ok(message) = serde_json::from_slice(&bytes) else { break };
            if send.send(message).is_err() {
                break;
            }
            bytes.clear();
        }
    });
    receive
}
