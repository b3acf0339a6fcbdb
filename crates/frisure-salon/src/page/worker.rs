//! The worker's side: executes requests one after the other.
//!
//! Incoming messages are `[job, request]`, outgoing ones `[job, response]`, or `[-1, report]` after a failure.

use super::failure;
use frisure::progress::Progress;
use frisure_engine::{Request, Response, Session};
use js_sys::{Array, Atomics, Int32Array, Uint8Array};
use std::cell::{Cell, RefCell};
use wasm_bindgen::prelude::*;
use web_sys::DedicatedWorkerGlobalScope;
use web_time::{Duration, Instant};

/// Minimum time between two reports of progress.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(60);

thread_local! {
    static SESSION: RefCell<Session> = RefCell::new(Session::new());
    static CANCEL: RefCell<Option<Int32Array>> = const { RefCell::new(None) };
    static JOB: Cell<f64> = const { Cell::new(0.0) };
    static LAST_REPORT: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// Initializes a worker; `cancel` is shared memory that cancels the job when it is not 0, if the page may
/// share memory.
#[wasm_bindgen]
pub fn worker_main(cancel: Option<Int32Array>) {
    CANCEL.set(cancel);
    let failed = Closure::<dyn Fn(JsValue, String)>::new(|_, report: String| {
        post(&Array::of2(&JsValue::from_f64(-1.0), &report.into()), &Array::new());
    });
    failure::set_handler(failed.into_js_value().unchecked_into());
}

/// Executes the request of a message.
#[wasm_bindgen]
pub fn worker_message(message: &Array) {
    JOB.set(message.get(0).as_f64().unwrap_or_default());
    LAST_REPORT.set(None);
    let bytes = Uint8Array::new(&message.get(1)).to_vec();
    // Page and worker are the same build, so they have the same serialization.
    let request = postcard::from_bytes::<Request>(&bytes).expect("a request");
    let response = SESSION.with_borrow_mut(|session| {
        session.execute_with(&request, &JobProgress, &mut |partial| respond(&partial))
    });
    respond(&response);
}

fn respond(response: &Response) {
    let bytes = postcard::to_stdvec(response).expect("a response as bytes");
    let bytes = Uint8Array::from(bytes.as_slice()).buffer();
    post(&Array::of2(&JOB.get().into(), &bytes), &Array::of1(&bytes));
}

fn post(message: &Array, transfer: &Array) {
    let worker: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    worker.post_message_with_transfer(message, transfer).expect("a message to the page");
}

/// Progress and cancellation of the current job.
struct JobProgress;

impl Progress for JobProgress {
    fn report(&self, stage: &str, fraction: f64) {
        if LAST_REPORT.get().is_none_or(|last| last.elapsed() >= PROGRESS_INTERVAL) {
            LAST_REPORT.set(Some(Instant::now()));
            respond(&Response::progress(stage, fraction));
        }
    }

    fn is_cancelled(&self) -> bool {
        CANCEL.with_borrow(|cancel| {
            cancel.as_ref().is_some_and(|cancel| Atomics::load(cancel, 0).is_ok_and(|c| c != 0))
        })
    }
}
