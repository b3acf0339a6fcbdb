//! Reports failures after which the program cannot continue.

use js_sys::Function;
use std::cell::RefCell;
use std::panic::PanicHookInfo;
use wasm_bindgen::prelude::*;

thread_local! {
    static HANDLER: RefCell<Option<Function>> = const { RefCell::new(None) };
}

#[wasm_bindgen]
extern "C" {
    type Error;
    #[wasm_bindgen(constructor)]
    fn new() -> Error;
    #[wasm_bindgen(method, getter)]
    fn stack(this: &Error) -> Option<String>;
}

/// Sets the function that is called as `handler(kind, report)` on a failure; panics are failures.
pub(crate) fn set_handler(handler: Function) {
    let is_first = HANDLER.replace(Some(handler)).is_none();
    if is_first {
        std::panic::set_hook(Box::new(panicked));
    }
}

/// Reports a failure; the kind is `panic` or `graphics`.
pub(crate) fn report(kind: &str, report: &str) {
    if let Some(handler) = HANDLER.with_borrow(Clone::clone) {
        // There is no other place to report an error of the handler.
        let _ = handler.call2(&JsValue::NULL, &kind.into(), &report.into());
    }
}

fn panicked(panic: &PanicHookInfo<'_>) {
    console_error_panic_hook::hook(panic);
    let stack = Error::new().stack().unwrap_or_default();
    report("panic", &format!("{panic}\n\n{stack}"));
}
