//! Work in a Web Worker, with the page's own compiled program.
//!
//! One order is with the worker at a time, the others wait here. To stop it, a number in shared
//! memory is set; where a page may not share memory, a worker that does not finish soon is ended
//! and another takes its place.

use super::Worker;
use crate::page::{Opened, fewer_hairs, opened};
use crate::window::Wake;
use frisure_engine::{Diagnostic, Request, Response};
use js_sys::{Array, Atomics, Int32Array, Object, Reflect, SharedArrayBuffer, Uint8Array};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, VecDeque};
use std::rc::{Rc, Weak};
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, MessageEvent, WorkerOptions, WorkerType};
use web_time::Instant;

/// How long a worker that cannot be told to stop may go on (ms): its memory is worth waiting for.
const PATIENCE: i32 = 1500;

thread_local! {
    static TOOK: Cell<f64> = const { Cell::new(0.0) };
}

/// How long the last order took that was carried out to its end (s).
pub(crate) fn last_took() -> f64 {
    TOOK.get()
}

/// The ticket of a worker that says that it is broken.
const BROKEN: f64 = -1.0;

/// The ticket of an order whose answer nobody waits for.
const UNASKED: f64 = -2.0;

/// A worker of the page. Dropped, it ends.
pub struct WebWorker(Rc<RefCell<Desk>>);

impl WebWorker {
    /// Starts one.
    ///
    /// # Errors
    /// The browser's words, if it does not start workers.
    pub fn start(wake: Wake) -> Result<Self, String> {
        let opened = opened().ok_or("only a page has workers")?;
        let desk = Rc::new(RefCell::new(Desk::new(opened, wake)));
        desk.borrow_mut().me = Rc::downgrade(&desk);
        desk.borrow_mut().hire().map_err(|e| format!("{e:?}"))?;
        Ok(Self(desk))
    }
}

impl Worker for WebWorker {
    fn send(&mut self, ticket: u64, order: Request) {
        self.0.borrow_mut().send(ticket, order);
    }

    fn cancel(&mut self, ticket: u64) {
        self.0.borrow_mut().cancel(ticket);
    }

    fn poll(&mut self) -> Option<(u64, Response)> {
        self.0.borrow_mut().answers.pop_front()
    }
}

/// The worker at work, how it is stopped, and what listens to it.
struct Hired {
    worker: web_sys::Worker,
    stop: Option<Int32Array>,
    _heard: Closure<dyn Fn(MessageEvent)>,
    _failed: Closure<dyn Fn(ErrorEvent)>,
}

impl Drop for Hired {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

/// Where orders wait and answers lie.
struct Desk {
    opened: Opened,
    wake: Wake,
    me: Weak<RefCell<Desk>>,
    hired: Option<Hired>,
    /// Files that were given, for a worker that takes the place of this one.
    kept: BTreeMap<String, Request>,
    waiting: VecDeque<(u64, Request)>,
    busy: Option<u64>,
    since: Instant,
    outdated: bool,
    answers: VecDeque<(u64, Response)>,
}

impl Desk {
    fn new(opened: Opened, wake: Wake) -> Self {
        Self {
            opened,
            wake,
            me: Weak::new(),
            hired: None,
            kept: BTreeMap::new(),
            waiting: VecDeque::new(),
            busy: None,
            since: Instant::now(),
            outdated: false,
            answers: VecDeque::new(),
        }
    }

    /// Starts a worker, with the files that are known.
    fn hire(&mut self) -> Result<(), JsValue> {
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        options.set_name("frisure");
        let worker = web_sys::Worker::new_with_options(&self.opened.worker(), &options)?;
        let stop = shared_number();
        worker.post_message(self.first_message(stop.as_ref())?.as_ref())?;
        for kept in self.kept.values() {
            post(&worker, UNASKED, kept)?;
        }
        let heard = self.listener(|desk, event: MessageEvent| desk.heard(&event.data().into()));
        worker.set_onmessage(Some(heard.as_ref().unchecked_ref()));
        let failed = self.listener(|desk, event: ErrorEvent| desk.broken(&event.message()));
        worker.set_onerror(Some(failed.as_ref().unchecked_ref()));
        self.hired = Some(Hired { worker, stop, _heard: heard, _failed: failed });
        Ok(())
    }

    fn first_message(&self, stop: Option<&Int32Array>) -> Result<Object, JsValue> {
        let message = Object::new();
        Reflect::set(&message, &"module".into(), &self.opened.module())?;
        Reflect::set(&message, &"build".into(), &self.opened.build().into())?;
        Reflect::set(&message, &"stop".into(), &stop.map_or(JsValue::UNDEFINED, JsValue::from))?;
        Ok(message)
    }

    /// A listener of events, which does nothing once the desk is gone.
    fn listener<E: wasm_bindgen::convert::FromWasmAbi + 'static>(
        &self,
        act: impl Fn(&mut Self, E) + 'static,
    ) -> Closure<dyn Fn(E)> {
        let me = self.me.clone();
        Closure::new(move |event| {
            let Some(desk) = me.upgrade() else { return };
            act(&mut desk.borrow_mut(), event);
            (desk.borrow().wake)();
        })
    }

    fn send(&mut self, ticket: u64, order: Request) {
        if let Request::ProvideFile { path, .. } = &order {
            self.kept.insert(path.clone(), order.clone());
        }
        self.waiting.push_back((ticket, fewer_hairs(order)));
        self.next();
    }

    /// Gives the worker what waits longest, if it has nothing to do.
    fn next(&mut self) {
        if self.busy.is_some() {
            return;
        }
        let Some((ticket, order)) = self.waiting.pop_front() else { return };
        (self.busy, self.since) = (Some(ticket), Instant::now());
        self.outdated = false;
        if let Err(reason) = self.post(ticket, &order) {
            self.broken(&format!("{reason:?}"));
        }
    }

    fn post(&mut self, ticket: u64, order: &Request) -> Result<(), JsValue> {
        if self.hired.is_none() {
            self.hire()?;
        }
        let Some(hired) = &self.hired else { return Ok(()) };
        if let Some(stop) = &hired.stop {
            Atomics::store(stop, 0, 0)?;
        }
        // Tickets count up from 1: f64 holds them for ever.
        post(&hired.worker, ticket as f64, order)
    }

    fn heard(&mut self, message: &Array) {
        let ticket = message.get(0).as_f64().unwrap_or(BROKEN);
        if ticket == BROKEN {
            self.broken(&message.get(1).as_string().unwrap_or_default());
        }
        if ticket < 0.0 {
            return;
        }
        let bytes = Uint8Array::new(&message.get(1)).to_vec();
        match postcard::from_bytes::<Response>(&bytes) {
            Ok(answer) => self.answered(ticket as u64, answer),
            Err(mistake) => self.broken(&format!("an answer cannot be read: {mistake}")),
        }
    }

    fn answered(&mut self, ticket: u64, answer: Response) {
        let last = !matches!(answer, Response::Progress { .. } | Response::PartialPicture { .. });
        let answer = match self.outdated {
            true if last => Response::Cancelled,
            true => return,
            false => answer,
        };
        self.answers.push_back((ticket, answer));
        if last {
            if !self.outdated {
                TOOK.set(self.since.elapsed().as_secs_f64());
            }
            self.busy = None;
            self.next();
        }
    }

    fn cancel(&mut self, ticket: u64) {
        if self.busy == Some(ticket) {
            self.outdated = true;
            self.stop(ticket);
        } else if let Some(place) = self.waiting.iter().position(|(t, _)| *t == ticket) {
            self.waiting.remove(place);
            self.answers.push_back((ticket, Response::Cancelled));
            (self.wake)();
        }
    }

    /// Tells the worker to stop; one that cannot be told has some patience left, and is ended.
    fn stop(&self, ticket: u64) {
        match self.hired.as_ref().and_then(|hired| hired.stop.as_ref()) {
            Some(stop) => drop(Atomics::store(stop, 0, 1)),
            None => {
                let me = self.me.clone();
                after(PATIENCE, move || {
                    let Some(desk) = me.upgrade() else { return };
                    desk.borrow_mut().end(ticket);
                    (desk.borrow().wake)();
                });
            }
        }
    }

    /// Ends the worker if it still works at this.
    fn end(&mut self, ticket: u64) {
        if self.busy == Some(ticket) && self.outdated {
            self.hired = None;
            self.answered(ticket, Response::Cancelled);
        }
    }

    /// The worker broke: what it was at is refused, and another will take what comes next.
    fn broken(&mut self, report: &str) {
        self.hired = None;
        let Some(ticket) = self.busy.take() else { return };
        let answer = match self.outdated {
            true => Response::Cancelled,
            false => Response::Failed(refusal(report)),
        };
        self.answers.push_back((ticket, answer));
        self.next();
    }
}

/// Sends an order; its memory goes over, it is not copied.
fn post(worker: &web_sys::Worker, ticket: f64, order: &Request) -> Result<(), JsValue> {
    let bytes = postcard::to_stdvec(order).map_err(|e| JsValue::from(e.to_string()))?;
    let bytes = Uint8Array::from(bytes.as_slice()).buffer();
    let message = Array::of2(&ticket.into(), &bytes);
    worker.post_message_with_transfer(&message, &Array::of1(&bytes))
}

fn refusal(report: &str) -> Diagnostic {
    let first = report.lines().find(|line| !line.trim().is_empty()).unwrap_or("no reason given");
    Diagnostic {
        problem: format!("the computation broke down: {first}"),
        hint: "Undo the last change, or draw fewer hairs; perhaps the browser has no memory left."
            .into(),
        ..Diagnostic::default()
    }
}

/// Shared memory for one number, where the page may share.
fn shared_number() -> Option<Int32Array> {
    let isolated = Reflect::get(&js_sys::global(), &"crossOriginIsolated".into()).ok()?;
    isolated.is_truthy().then(|| Int32Array::new(&SharedArrayBuffer::new(4)))
}

/// Does something later.
fn after(milliseconds: i32, act: impl FnOnce() + 'static) {
    let act = Closure::once_into_js(act);
    if let Some(window) = web_sys::window() {
        let _ = window.set_timeout_with_callback_and_timeout_and_arguments_0(
            act.unchecked_ref(),
            milliseconds,
        );
    }
}
