//! The program cannot go on: whoever waits for it is told, with what is known.

use js_sys::Function;
use std::cell::RefCell;
use std::panic::PanicHookInfo;
use wasm_bindgen::prelude::*;

thread_local! {
    static TOLD: RefCell<Option<Function>> = const { RefCell::new(None) };
}

#[wasm_bindgen]
extern "C" {
    type Error;
    #[wasm_bindgen(constructor)]
    fn new() -> Error;
    #[wasm_bindgen(method, getter)]
    fn stack(this: &Error) -> Option<String>;
}

/// Calls `told(kind, report)` when the program cannot go on, also on a panic.
pub(crate) fn call(told: Function) {
    let first = TOLD.with(|known| known.borrow_mut().replace(told).is_none());
    if first {
        std::panic::set_hook(Box::new(panicked));
    }
}

/// The kind is `panic` or `graphics`.
pub(crate) fn tell(kind: &str, report: &str) {
    let told = TOLD.with(|told| told.borrow().clone());
    if let Some(told) = told {
        // There is nobody else to tell if this fails.
        let _ = told.call2(&JsValue::NULL, &kind.into(), &report.into());
    }
}

fn panicked(panic: &PanicHookInfo<'_>) {
    console_error_panic_hook::hook(panic);
    let stack = Error::new().stack().unwrap_or_default();
    tell("panic", &format!("{panic}\n\n{stack}"));
}
