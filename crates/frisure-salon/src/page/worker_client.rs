//! The page's side of a Web Worker, which runs the page's own compiled program.
//!
//! The worker has one request at a time; the others wait here. A number in shared memory cancels it; if a
//! page may not share memory, a worker that does not finish soon is terminated and replaced.

use super::options::{self, PageOptions, limit_strands};
use crate::work::{Wake, Worker};
use frisure_engine::{Diagnostic, Request, Response};
use js_sys::{Array, Atomics, Int32Array, Object, Reflect, SharedArrayBuffer, Uint8Array};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, VecDeque};
use std::rc::{Rc, Weak};
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, MessageEvent, WorkerOptions, WorkerType};
use web_time::Instant;

/// Time that a worker without shared memory has to finish after a cancellation (ms), because its caches are valuable.
const CANCEL_TIMEOUT: i32 = 1500;

thread_local! {
    static LAST_DURATION: Cell<f64> = const { Cell::new(0.0) };
}

/// The duration of the last job that was not cancelled (s).
pub(crate) fn last_duration() -> f64 {
    LAST_DURATION.get()
}

/// The job number with which a worker reports its failure.
const FAILED: f64 = -1.0;

/// The job number of a request whose response is ignored.
const IGNORED: f64 = -2.0;

/// A worker of the page, which ends when this is dropped.
pub(super) struct WebWorker(Rc<RefCell<Client>>);

impl WebWorker {
    /// Starts a worker.
    ///
    /// # Errors
    /// The browser's message, if it cannot start workers.
    pub(super) fn start(wake: Wake) -> Result<Self, String> {
        let options = options::get().ok_or("workers exist only in a page")?;
        let client = Rc::new_cyclic(|this| {
            RefCell::new(Client {
                options,
                wake,
                this: this.clone(),
                process: None,
                uploads: BTreeMap::new(),
                waiting: VecDeque::new(),
                running: None,
                cancelled: false,
                responses: VecDeque::new(),
            })
        });
        client.borrow_mut().spawn().map_err(|e| format!("{e:?}"))?;
        Ok(Self(client))
    }
}

impl Worker for WebWorker {
    fn send(&mut self, job: u64, request: Request) {
        self.0.borrow_mut().send(job, request);
    }

    fn cancel(&mut self, job: u64) {
        self.0.borrow_mut().cancel(job);
    }

    fn poll(&mut self) -> Option<(u64, Response)> {
        self.0.borrow_mut().responses.pop_front()
    }
}

/// A worker of the browser, its shared memory, and its listeners.
struct Process {
    worker: web_sys::Worker,
    cancel: Option<Int32Array>,
    _on_message: Closure<dyn Fn(MessageEvent)>,
    _on_error: Closure<dyn Fn(ErrorEvent)>,
}

impl Drop for Process {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

/// The queued requests and the responses.
struct Client {
    options: PageOptions,
    wake: Wake,
    this: Weak<RefCell<Client>>,
    process: Option<Process>,
    /// Uploaded files, for a replacement of the worker.
    uploads: BTreeMap<String, Request>,
    waiting: VecDeque<(u64, Request)>,
    running: Option<(u64, Instant)>,
    /// Whether the running job is cancelled.
    cancelled: bool,
    responses: VecDeque<(u64, Response)>,
}

impl Client {
    /// Starts a worker and uploads the known files.
    fn spawn(&mut self) -> Result<(), JsValue> {
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        options.set_name("frisure");
        let worker = web_sys::Worker::new_with_options(&self.options.worker(), &options)?;
        let cancel = shared_number();
        let first = Object::new();
        Reflect::set(&first, &"module".into(), &self.options.module())?;
        Reflect::set(&first, &"build".into(), &self.options.build().into())?;
        let memory = cancel.as_ref().map_or(JsValue::UNDEFINED, JsValue::from);
        Reflect::set(&first, &"cancel".into(), &memory)?;
        worker.post_message(&first)?;
        for upload in self.uploads.values() {
            post(&worker, IGNORED, upload)?;
        }
        let message =
            self.listener(|client, event: MessageEvent| client.receive(&event.data().into()));
        worker.set_onmessage(Some(message.as_ref().unchecked_ref()));
        let error = self.listener(|client, event: ErrorEvent| client.fail(&event.message()));
        worker.set_onerror(Some(error.as_ref().unchecked_ref()));
        self.process = Some(Process { worker, cancel, _on_message: message, _on_error: error });
        Ok(())
    }

    /// A listener of events, which does nothing once the client is dropped.
    fn listener<E: wasm_bindgen::convert::FromWasmAbi + 'static>(
        &self,
        act: impl Fn(&mut Self, E) + 'static,
    ) -> Closure<dyn Fn(E)> {
        let this = self.this.clone();
        Closure::new(move |event| with(&this, |client| act(client, event)))
    }

    fn send(&mut self, job: u64, request: Request) {
        if let Request::ProvideFile { path, .. } = &request {
            self.uploads.insert(path.clone(), request.clone());
        }
        self.waiting.push_back((job, limit_strands(request)));
        self.advance();
    }

    /// Posts the next request, if none is running.
    fn advance(&mut self) {
        if self.running.is_some() {
            return;
        }
        let Some((job, request)) = self.waiting.pop_front() else { return };
        (self.running, self.cancelled) = (Some((job, Instant::now())), false);
        if let Err(reason) = self.post(job, &request) {
            self.fail(&format!("{reason:?}"));
        }
    }

    fn post(&mut self, job: u64, request: &Request) -> Result<(), JsValue> {
        if self.process.is_none() {
            self.spawn()?;
        }
        let Some(process) = &self.process else { return Ok(()) };
        if let Some(cancel) = &process.cancel {
            Atomics::store(cancel, 0, 0)?;
        }
        // Jobs count up from 1, so that f64 is exact.
        post(&process.worker, job as f64, request)
    }

    fn receive(&mut self, message: &Array) {
        let job = message.get(0).as_f64().unwrap_or(FAILED);
        if job == FAILED {
            self.fail(&message.get(1).as_string().unwrap_or_default());
        }
        if job < 0.0 {
            return;
        }
        let bytes = Uint8Array::new(&message.get(1)).to_vec();
        match postcard::from_bytes::<Response>(&bytes) {
            Ok(response) => self.respond(job as u64, response),
            Err(error) => self.fail(&format!("a response cannot be read: {error}")),
        }
    }

    fn respond(&mut self, job: u64, response: Response) {
        let last = !matches!(response, Response::Progress { .. } | Response::PartialPicture { .. });
        match (self.cancelled, last) {
            (true, false) => return,
            (true, true) => self.responses.push_back((job, Response::Cancelled)),
            (false, _) => self.responses.push_back((job, response)),
        }
        if last {
            if let Some((_, start)) = self.running.take().filter(|_| !self.cancelled) {
                LAST_DURATION.set(start.elapsed().as_secs_f64());
            }
            self.advance();
        }
    }

    fn is_running(&self, job: u64) -> bool {
        self.running.is_some_and(|(running, _)| running == job)
    }

    fn cancel(&mut self, job: u64) {
        if self.is_running(job) {
            self.cancelled = true;
            self.request_cancel(job);
        } else if let Some(index) = self.waiting.iter().position(|(j, _)| *j == job) {
            self.waiting.remove(index);
            self.responses.push_back((job, Response::Cancelled));
            (self.wake)();
        }
    }

    /// Cancels through shared memory, or terminates the worker after [`CANCEL_TIMEOUT`].
    fn request_cancel(&self, job: u64) {
        match self.process.as_ref().and_then(|process| process.cancel.as_ref()) {
            Some(cancel) => drop(Atomics::store(cancel, 0, 1)),
            None => {
                let this = self.this.clone();
                after(CANCEL_TIMEOUT, move || with(&this, |client| client.terminate(job)));
            }
        }
    }

    /// Terminates the worker if it still runs a cancelled job.
    fn terminate(&mut self, job: u64) {
        if self.is_running(job) && self.cancelled {
            self.process = None;
            self.respond(job, Response::Cancelled);
        }
    }

    /// Refuses the running job after a failure of the worker, and continues with another worker.
    fn fail(&mut self, report: &str) {
        self.process = None;
        let Some((job, _)) = self.running.take() else { return };
        let response = match self.cancelled {
            true => Response::Cancelled,
            false => Response::Failed(diagnostic(report)),
        };
        self.responses.push_back((job, response));
        self.advance();
    }
}

/// Calls a function with the client, if it still exists, and repaints the window.
fn with(client: &Weak<RefCell<Client>>, act: impl FnOnce(&mut Client)) {
    let Some(client) = client.upgrade() else { return };
    act(&mut client.borrow_mut());
    (client.borrow().wake)();
}

/// Posts a request; its bytes are moved, not copied.
fn post(worker: &web_sys::Worker, job: f64, request: &Request) -> Result<(), JsValue> {
    let bytes = postcard::to_stdvec(request).map_err(|e| JsValue::from(e.to_string()))?;
    let bytes = Uint8Array::from(bytes.as_slice()).buffer();
    worker.post_message_with_transfer(&Array::of2(&job.into(), &bytes), &Array::of1(&bytes))
}

fn diagnostic(report: &str) -> Diagnostic {
    let first = report.lines().find(|line| !line.trim().is_empty()).unwrap_or("no reason given");
    Diagnostic {
        problem: format!("the computation failed: {first}"),
        hint: "Undo the last change, or draw fewer hairs; the browser may be out of memory.".into(),
        ..Diagnostic::default()
    }
}

/// Shared memory for one number; `None` if the page may not share memory.
fn shared_number() -> Option<Int32Array> {
    let isolated = Reflect::get(&js_sys::global(), &"crossOriginIsolated".into()).ok()?;
    isolated.is_truthy().then(|| Int32Array::new(&SharedArrayBuffer::new(4)))
}

/// Calls a function after a delay.
fn after(milliseconds: i32, act: impl FnOnce() + 'static) {
    let act = Closure::once_into_js(act);
    if let Some(window) = web_sys::window() {
        let _ = window.set_timeout_with_callback_and_timeout_and_arguments_0(
            act.unchecked_ref(),
            milliseconds,
        );
    }
}
