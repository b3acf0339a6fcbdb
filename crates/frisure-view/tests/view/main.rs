//! What a device draws. On a machine without any, these tests pass without a look, unless
//! `FRISURE_NEEDS_GPU` says that there must be one.

#[path = "../../examples/support/mod.rs"]
mod support;
#[path = "../../../frisure-render/examples/support/wig.rs"]
mod wig;

mod agreement;
mod coverage;
mod extras;
mod odd;
mod shade;

use std::io::Write as _;
use std::sync::OnceLock;

use support::Gpu;

/// The device, if there is one.
fn gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    let gpu = GPU.get_or_init(Gpu::new);
    let needed = std::env::var_os("FRISURE_NEEDS_GPU").is_some();
    assert!(gpu.is_some() || !needed, "FRISURE_NEEDS_GPU is set, and there is no graphics adapter");
    if gpu.is_none() {
        // A closed pipe is no reason to fail.
        let _ = writeln!(std::io::stderr(), "no graphics adapter: nothing was drawn");
    }
    gpu.as_ref()
}
