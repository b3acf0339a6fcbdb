//! The graphics backend of the browser, and its loss.

use super::failure;
use eframe::CreationContext;
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use wgpu::{Backends, DeviceLostReason};

/// The configuration for `webgl`, `webgpu`, or any: WebGPU if it works, else WebGL 2.
pub(crate) fn configuration(backend: &str) -> WgpuConfiguration {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = match backend {
        "webgl" => Backends::GL,
        "webgpu" => Backends::BROWSER_WEBGPU,
        _ => Backends::BROWSER_WEBGPU | Backends::GL,
    };
    WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..Default::default() }
}

/// Reports the loss of the device; the page handles that of WebGL 2.
pub(crate) fn report_loss(cc: &CreationContext<'_>) {
    let Some(state) = &cc.wgpu_render_state else { return };
    state.device.set_device_lost_callback(|reason, message| {
        if reason != DeviceLostReason::Destroyed {
            failure::report("graphics", &format!("{reason:?}: {message}"));
        }
    });
}
