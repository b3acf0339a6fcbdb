//! Which graphics of the browser are used, and what if they are lost.

use super::trouble;
use eframe::CreationContext;
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use wgpu::{Backends, DeviceLostReason};

/// `webgl`, `webgpu`, or any: WebGPU where it works, else WebGL 2.
pub(crate) fn wanted(backend: &str) -> WgpuConfiguration {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = match backend {
        "webgl" => Backends::GL,
        "webgpu" => Backends::BROWSER_WEBGPU,
        _ => Backends::BROWSER_WEBGPU | Backends::GL,
    };
    WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..Default::default() }
}

/// Says so on the page if the device goes away. (The canvas itself tells it of WebGL 2.)
pub(crate) fn tell_when_lost(cc: &CreationContext<'_>) {
    let Some(state) = &cc.wgpu_render_state else { return };
    state.device.set_device_lost_callback(|reason, told| {
        if reason != DeviceLostReason::Destroyed {
            trouble::tell("graphics", &format!("{reason:?}: {told}"));
        }
    });
}
