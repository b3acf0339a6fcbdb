//! The salon in a window of the desktop.

// What `wasm_bindgen` generates is unsafe.
#![cfg_attr(not(target_arch = "wasm32"), forbid(unsafe_code))]

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
    use std::sync::{Arc, Mutex};

    use clap::{Parser, ValueEnum};
    use eframe::egui::ViewportBuilder;
    use eframe::{CreationContext, NativeOptions, egui, egui_wgpu, wgpu};
    use frisure_salon::state::{Command, Salon};
    use frisure_salon::window::desktop::Desktop;
    use frisure_salon::window::{App, Parts, Wake, wake};
    use frisure_salon::work::native::Thread;

    /// See a head of natural hair, change its fibres, wet it, cut it, dry it.
    #[derive(Parser)]
    #[command(name = "frisure-salon", version, about)]
    struct Arguments {
        /// A scene to open (.toml), a head or a groom, or several of them; without any the gallery is shown
        files: Vec<PathBuf>,
        /// Begin with this hair of the gallery, such as `curly`
        #[arg(long, value_name = "NAME", conflicts_with = "files")]
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
        let mut taken_over = None;
        for _ in 0..MOST_WINDOWS {
            let lost = Lost::default();
            let salon = taken_over.take();
            let create = |cc: &CreationContext<'_>| window(cc, arguments, &lost, salon);
            eframe::run_native("frisure salon", options(arguments), Box::new(create))
                .map_err(|e| explained(&e))?;
            taken_over = lost.salon();
            if taken_over.is_none() {
                return Ok(());
            }
        }
        Err("the graphics device was lost again and again; what was not saved is kept, and offered at \
             the next start\n  hint: update the graphics driver, or try --backend gl".into())
    }

    /// Windows that are opened one after the other as graphics devices are lost.
    const MOST_WINDOWS: usize = 5;

    fn options(arguments: &Arguments) -> NativeOptions {
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
        options
    }

    /// Whether the graphics device is gone, and the salon that the next window takes over.
    #[derive(Clone, Default)]
    struct Lost {
        why: Arc<Mutex<Option<String>>>,
        salon: Arc<Mutex<Option<Salon>>>,
    }

    impl Lost {
        fn salon(&self) -> Option<Salon> {
            self.salon.lock().ok()?.take()
        }

        fn why(&self) -> Option<String> {
            self.why.lock().ok()?.take()
        }

        /// Has a device tell when it is gone.
        fn watch(&self, device: &wgpu::Device, wake: Wake) {
            let why = Arc::clone(&self.why);
            device.set_device_lost_callback(move |reason, message| {
                // Dropped at the end of a window, it is not lost.
                if reason == wgpu::DeviceLostReason::Unknown
                    && let Ok(mut why) = why.lock()
                {
                    *why = Some(message);
                    wake();
                }
            });
        }
    }

    /// A window that hands its salon over when its graphics device is lost.
    struct Window {
        app: App,
        lost: Lost,
    }

    impl eframe::App for Window {
        fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
            if let Some(why) = self.lost.why() {
                let mut salon = self.app.hand_over();
                let hint = "Nothing is lost but the picture, which was drawn anew.";
                salon.tell(format!("the graphics device was lost: {why}"), hint, true);
                if let Ok(mut slot) = self.lost.salon.lock() {
                    *slot = Some(salon);
                }
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
            self.app.logic(ctx, frame);
        }

        fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
            self.app.ui(ui, frame);
        }
    }

    type Created = Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>>;

    fn window(
        cc: &CreationContext<'_>,
        arguments: &Arguments,
        lost: &Lost,
        salon: Option<Salon>,
    ) -> Created {
        let wake = wake(&cc.egui_ctx);
        if let Some(state) = &cc.wgpu_render_state {
            lost.watch(&state.device, Arc::clone(&wake));
        }
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
        match (salon, &arguments.begin) {
            (Some(salon), _) => app.take_over(salon),
            (None, Some(name)) => app.run(Command::Begin(name.clone())),
            (None, None) => arguments.files.iter().for_each(|file| app.open(file)),
        }
        Ok(Box::new(Window { app, lost: lost.clone() }))
    }

    /// What a newcomer can do about it.
    fn explained(error: &eframe::Error) -> String {
        let hint = match error {
            eframe::Error::Wgpu(_) => {
                "The salon needs a graphics driver with Vulkan, Metal, DirectX 12 or OpenGL. On Linux \
                 without a GPU, install the software drivers (on Debian: mesa-vulkan-drivers), or try \
                 another --backend. The command `frisure` works without."
            }
            _ => {
                "The salon needs a screen. Without one, use the command `frisure`, or the page in a \
                 browser."
            }
        };
        // Where in whose source it was found helps nobody here.
        let told = error.to_string();
        let words = told.split_whitespace().filter(|word| !word.contains("/registry/"));
        let told = words.collect::<Vec<_>>().join(" ");
        format!("the window cannot be opened: {told}\n  hint: {hint}")
    }
}
