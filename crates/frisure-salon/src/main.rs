//! The salon in a window of the desktop.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    desktop::main()
}

#[cfg(not(target_arch = "wasm32"))]
mod desktop {
    use std::io::Write;
    use std::path::PathBuf;
    use std::process::ExitCode;
    use std::sync::Arc;

    use clap::{Parser, ValueEnum};
    use eframe::egui::ViewportBuilder;
    use eframe::{CreationContext, NativeOptions, egui_wgpu, wgpu};
    use frisure_salon::state::Command;
    use frisure_salon::window::desktop::Desktop;
    use frisure_salon::window::{App, Parts, wake};
    use frisure_salon::work::native::Thread;

    /// See a head of natural hair, change its fibres, wet it, cut it, dry it.
    #[derive(Parser)]
    #[command(name = "frisure-salon", version, about)]
    struct Arguments {
        /// A scene to open (.toml); without one the gallery is shown
        scene: Option<PathBuf>,
        /// Begin with this hair of the gallery, such as `curly`
        #[arg(long, value_name = "NAME", conflicts_with = "scene")]
        begin: Option<String>,
        /// Which graphics interface to draw with; by default the best there is
        #[arg(long, value_enum)]
        backend: Option<Backend>,
        /// Samples for each pixel: 1 on a slow device
        #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=8))]
        samples: u32,
        /// Where work that was not saved is kept over a crash; by default in the user's data folder
        #[arg(long, value_name = "FILE")]
        kept: Option<PathBuf>,
    }

    #[derive(Clone, Copy, ValueEnum)]
    enum Backend {
        Vulkan,
        Metal,
        Dx12,
        Gl,
    }

    impl Backend {
        fn mask(self) -> wgpu::Backends {
            match self {
                Self::Vulkan => wgpu::Backends::VULKAN,
                Self::Metal => wgpu::Backends::METAL,
                Self::Dx12 => wgpu::Backends::DX12,
                Self::Gl => wgpu::Backends::GL,
            }
        }
    }

    pub(super) fn main() -> ExitCode {
        let arguments = Arguments::parse();
        match run(&arguments) {
            Ok(()) => ExitCode::SUCCESS,
            Err(problem) => {
                // A closed pipe is no reason to fail differently.
                let _ = writeln!(std::io::stderr().lock(), "{problem}");
                ExitCode::FAILURE
            }
        }
    }

    fn run(arguments: &Arguments) -> Result<(), String> {
        if let Some(name) = &arguments.begin
            && frisure_salon::state::card(name).is_none()
        {
            return Err(format!("there is no hair called `{name}` in the gallery"));
        }
        let viewport = ViewportBuilder::default()
            .with_title("frisure salon")
            .with_app_id("frisure-salon")
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([800.0, 560.0])
            .with_drag_and_drop(true);
        let mut options = NativeOptions { viewport, ..NativeOptions::default() };
        if let Some(backend) = arguments.backend
            && let egui_wgpu::WgpuSetup::CreateNew(setup) = &mut options.wgpu_options.wgpu_setup
        {
            setup.instance_descriptor.backends = backend.mask();
        }
        let create = |cc: &CreationContext<'_>| app(cc, arguments);
        let result = eframe::run_native("frisure salon", options, Box::new(create));
        result.map_err(|e| explained(&e))
    }

    type Created = Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>>;

    fn app(cc: &CreationContext<'_>, arguments: &Arguments) -> Created {
        let wake = wake(&cc.egui_ctx);
        let worker = || {
            let wake = wake.clone();
            Thread::start(Box::new(move || wake()))
        };
        let parts = Parts {
            hair: Box::new(worker()?),
            aside: Box::new(worker()?),
            outside: Box::new(Desktop::new(arguments.kept.clone(), Arc::clone(&wake))),
            samples: arguments.samples,
        };
        let mut app = App::new(cc, parts);
        if let Some(scene) = &arguments.scene {
            app.open(scene);
        }
        if let Some(name) = &arguments.begin {
            app.run(Command::Begin(name.clone()));
        }
        Ok(Box::new(app))
    }

    /// What a newcomer can do about it.
    fn explained(error: &eframe::Error) -> String {
        let hint = match error {
            eframe::Error::Wgpu(_) => {
                "The salon needs a graphics driver with Vulkan, Metal, DirectX 12 or OpenGL. On Linux \
                 without a GPU, install the software drivers (on Debian: mesa-vulkan-drivers), or try \
                 --backend gl. The command `frisure` works without."
            }
            _ => {
                "The salon needs a screen. Without one, use the command `frisure`, or the page in a \
                 browser."
            }
        };
        format!("the window cannot be opened: {error}\n  hint: {hint}")
    }
}
