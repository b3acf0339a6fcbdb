//! The other side: in a worker, orders are carried out one after the other.
//!
//! Messages in are `[ticket, order]`, messages out `[ticket, answer]`, or `[-1, report]` when the worker is
//! broken.

use super::trouble;
use frisure::progress::Progress;
use frisure_engine::{Request, Response, Session};
use js_sys::{Array, Atomics, Int32Array, Uint8Array};
use std::cell::{Cell, RefCell};
use wasm_bindgen::prelude::*;
use web_sys::DedicatedWorkerGlobalScope;
use web_time::{Duration, Instant};

/// Progress is told no more often.
const OFTEN: Duration = Duration::from_millis(60);

thread_local! {
    static SESSION: RefCell<Session> = RefCell::new(Session::new());
    static STOP: RefCell<Option<Int32Array>> = const { RefCell::new(None) };
    static TICKET: Cell<f64> = const { Cell::new(0.0) };
    static TOLD: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// Makes this the program of a worker; `stop` is shared memory that says when to stop, if the page
/// may share any.
#[wasm_bindgen]
pub fn worker_main(stop: Option<Int32Array>) {
    STOP.with(|known| *known.borrow_mut() = stop);
    let broken = Closure::<dyn Fn(JsValue, String)>::new(|_, report: String| {
        post(&Array::of2(&JsValue::from_f64(-1.0), &report.into()), &Array::new());
    });
    trouble::call(broken.into_js_value().unchecked_into());
}

/// Does what a message says.
#[wasm_bindgen]
pub fn worker_message(message: &Array) {
    let bytes = Uint8Array::new(&message.get(1)).to_vec();
    carry_out(message.get(0).as_f64().unwrap_or_default(), &bytes);
}

fn carry_out(ticket: f64, order: &[u8]) {
    TICKET.set(ticket);
    TOLD.set(None);
    let answer = match postcard::from_bytes::<Request>(order) {
        Ok(order) => SESSION.with_borrow_mut(|session| {
            session.execute_with(&order, &Page, &mut |answer| answer_with(&answer))
        }),
        // Both sides are one program: only a mistake in it can come here.
        Err(mistake) => panic!("an order cannot be read: {mistake}"),
    };
    answer_with(&answer);
}

fn answer_with(answer: &Response) {
    // Plain data has no way to fail, but for memory.
    let bytes = postcard::to_stdvec(answer).expect("an answer as bytes");
    let bytes = Uint8Array::from(bytes.as_slice()).buffer();
    post(&Array::of2(&TICKET.get().into(), &bytes), &Array::of1(&bytes));
}

fn post(message: &Array, transfer: &Array) {
    let worker: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    worker.post_message_with_transfer(message, transfer).expect("a message to the page");
}

/// Whoever is at the page.
struct Page;

impl Progress for Page {
    fn report(&self, stage: &str, fraction: f64) {
        if TOLD.get().is_none_or(|told| told.elapsed() >= OFTEN) {
            TOLD.set(Some(Instant::now()));
            answer_with(&Response::progress(stage, fraction));
        }
    }

    fn is_cancelled(&self) -> bool {
        STOP.with(|stop| {
            stop.borrow().as_ref().is_some_and(|stop| Atomics::load(stop, 0).is_ok_and(|s| s != 0))
        })
    }
}
