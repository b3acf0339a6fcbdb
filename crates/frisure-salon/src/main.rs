//! The salon on the desktop.

// `wasm_bindgen` generates unsafe code.
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
    use frisure_salon::locale::{self, Locale, text_with};
    use frisure_salon::state::{Command, Salon};
    use frisure_salon::window::desktop::Desktop;
    use frisure_salon::window::{App, Parts, waker};
    use frisure_salon::work::native::Thread;
    use frisure_salon::work::{Wake, Worker};

    /// Shows a head of natural hair, to edit and style it.
    #[derive(Parser)]
    #[command(name = "frisure-salon", version, about)]
    struct Arguments {
        /// Scenes (.toml), heads or grooms to open; without any, the gallery opens
        files: Vec<PathBuf>,
        /// Start with a card of the gallery, such as `curly`
        #[arg(long, value_name = "NAME", conflicts_with = "files")]
        begin: Option<String>,
        /// Begin with an exercise, such as `bob`, or one from a link
        #[arg(long, value_name = "NAME", conflicts_with_all = ["files", "begin"])]
        exercise: Option<String>,

        /// The graphics interface; by default the best one available
        #[arg(long, value_enum)]
        backend: Option<Backend>,
        /// Samples per pixel: 1 for a slow device
        #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=8))]
        samples: u32,
        /// The language of the salon, `en` or `fr`; by default the one chosen before, or that of the system
        #[arg(long, value_name = "TAG", value_parser = language)]
        language: Option<Locale>,
        /// The autosave file; by default one in the user's data folder
        #[arg(long, value_name = "FILE", alias = "kept")]
        autosave: Option<PathBuf>,
    }

    /// The language of a tag.
    fn language(tag: &str) -> Result<Locale, String> {
        Locale::of(tag).ok_or_else(|| {
            let known =
                Locale::ALL.map(|locale| format!("{} ({})", locale.tag(), locale.endonym()));
            format!("the salon speaks {}", known.join(" and "))
        })
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
        let mut salon = None;
        for _ in 0..MAX_RESTARTS {
            let lost = DeviceLoss::default();
            let restored = salon.take();
            let create = |cc: &CreationContext<'_>| window(cc, arguments, &lost, restored);
            eframe::run_native("frisure salon", options(arguments), Box::new(create))
                .map_err(|e| explained(&e))?;
            salon = take(&lost.salon);
            if salon.is_none() {
                return Ok(());
            }
        }
        Err("the graphics device was lost repeatedly; the next start offers the autosaved work\n  hint: update the graphics driver, or try --backend gl".into())
    }

    /// Maximum number of consecutive windows after losses of the graphics device.
    const MAX_RESTARTS: usize = 5;

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

    /// The reason for the loss of the graphics device, and the state for the next window.
    #[derive(Clone, Default)]
    struct DeviceLoss {
        reason: Arc<Mutex<Option<String>>>,
        salon: Arc<Mutex<Option<Salon>>>,
    }

    fn take<T>(slot: &Mutex<Option<T>>) -> Option<T> {
        slot.lock().ok()?.take()
    }

    impl DeviceLoss {
        /// Records the loss of a device.
        fn watch(&self, device: &wgpu::Device, wake: Wake) {
            let slot = Arc::clone(&self.reason);
            device.set_device_lost_callback(move |reason, message| {
                // A device that is dropped with its window is not lost.
                if reason == wgpu::DeviceLostReason::Unknown
                    && let Ok(mut slot) = slot.lock()
                {
                    *slot = Some(message);
                    wake();
                }
            });
        }
    }

    /// A window that closes and passes its state on when its graphics device is lost.
    struct Window {
        app: App,
        lost: DeviceLoss,
    }

    impl eframe::App for Window {
        fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
            if let Some(reason) = take(&self.lost.reason) {
                let mut salon = self.app.take_salon();
                let text = text_with("device-lost", &[("reason", reason.into())]);
                salon.notify(text, locale::text("device-lost.hint"), true);
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
        lost: &DeviceLoss,
        salon: Option<Salon>,
    ) -> Created {
        let wake = waker(&cc.egui_ctx);
        if let Some(state) = &cc.wgpu_render_state {
            lost.watch(&state.device, Arc::clone(&wake));
        }
        let worker =
            || -> std::io::Result<Box<dyn Worker>> { Ok(Box::new(Thread::start(wake.clone())?)) };
        let parts = Parts {
            workers: [worker()?, worker()?],
            platform: Box::new(Desktop::new(arguments.autosave.clone(), wake.clone())),
            samples: arguments.samples,
            locale: arguments.language,
        };
        let mut app = App::new(cc, parts);
        match (salon, &arguments.begin) {
            (Some(salon), _) => app.restore(salon),
            (None, Some(name)) => app.run(Command::Begin(name.clone())),
            (None, None) if arguments.exercise.is_some() => {
                app.run(Command::BeginExercise(arguments.exercise.clone().unwrap_or_default()));
            }
            (None, None) => arguments.files.iter().for_each(|file| app.open(file)),
        }
        Ok(Box::new(Window { app, lost: lost.clone() }))
    }

    /// An error with a hint for the user.
    fn explained(error: &eframe::Error) -> String {
        let hint = match error {
            eframe::Error::Wgpu(_) => {
                "The salon needs a graphics driver with Vulkan, Metal, DirectX 12 or OpenGL. On Linux \
                 without a GPU, install the software drivers (on Debian: mesa-vulkan-drivers), or try \
                 another --backend. The command `frisure` works without."
            }
            _ => {
                "The salon needs a display. Without one, use the command `frisure`, or the page in a \
                 browser."
            }
        };
        // Without the source locations that wgpu adds.
        let text = error.to_string();
        let words = text.split_whitespace().filter(|word| !word.contains("/registry/"));
        let text = words.collect::<Vec<_>>().join(" ");
        format!("the window cannot be opened: {text}\n  hint: {hint}")
    }
}
