//! What a device draws. On a machine without any, these tests pass without a look, unless
//! `FRISURE_NEEDS_GPU` says that there must be one.

#[path = "../../examples/support/mod.rs"]
mod support;
#[path = "../../../frisure-render/examples/support/wig.rs"]
mod wig;

mod accessories;
mod agreement;
mod coverage;
mod extras;
mod odd;
mod shade;

use std::io::Write as _;
use std::ops::Deref;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use support::Gpu;

/// The device for one test: OpenGL does not wait long for another thread.
struct Turn {
    gpu: &'static Gpu,
    _turn: MutexGuard<'static, ()>,
}

impl Deref for Turn {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        self.gpu
    }
}

/// The device, if there is one, once no other test has it.
fn gpu() -> Option<Turn> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    static TURN: Mutex<()> = Mutex::new(());
    // A test that failed leaves nothing behind that another would see.
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let gpu = GPU.get_or_init(Gpu::new);
    let needed = std::env::var_os("FRISURE_NEEDS_GPU").is_some();
    assert!(gpu.is_some() || !needed, "FRISURE_NEEDS_GPU is set, and there is no graphics adapter");
    if gpu.is_none() {
        // A closed pipe is no reason to fail.
        let _ = writeln!(std::io::stderr(), "no graphics adapter: nothing was drawn");
    }
    gpu.as_ref().map(|gpu| Turn { gpu, _turn: turn })
}
