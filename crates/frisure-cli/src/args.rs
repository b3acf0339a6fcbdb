//! The command line.

use std::fmt::Write;
use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args, Parser, Subcommand, ValueEnum};
use frisure::files::frame::{Frame, FrameChoice, UpAxis};
use frisure::formats::groom::{Fit, Format, MAX_STRANDS, Points, Program};
use frisure::hairstyle::{PRESETS, Preset, preset};
use frisure::look::{CAMERAS, NamedCamera};
use frisure::render::trace::TraceOptions;
use frisure::scene::Scene;
use frisure::scene::quantity::{Dimension, LENGTH, RATIO, STRAIN};

#[cfg(feature = "batch")]
mod batch;
mod fit;
mod measure;
mod picture;
mod transfer;
#[cfg(feature = "validate")]
mod validate;

#[cfg(feature = "batch")]
pub(crate) use batch::Batch;
pub(crate) use fit::{FitFibres, Quantity as FitQuantity};
pub(crate) use measure::MeasurePhoto;
pub(crate) use picture::{Pictured, Render, View};
pub(crate) use transfer::Transfer;
#[cfg(feature = "validate")]
pub(crate) use validate::Validate;

#[cfg(not(feature = "batch"))]
pub(crate) type Batch = NotBuilt;
#[cfg(not(feature = "validate"))]
pub(crate) type Validate = NotBuilt;

/// Any arguments, for a command that this build does not have.
#[cfg(not(all(feature = "batch", feature = "validate")))]
#[derive(Args, Debug)]
#[command(disable_help_flag = true)]
pub(crate) struct NotBuilt {
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    _rest: Vec<std::ffi::OsString>,
}

const EXAMPLES: &str = "\
Examples:
  frisure new caucasian-curly > mine.toml
  frisure predict mine.toml -o out/mine.hair --image out/mine.png
  frisure style mine.toml --step 'cut = { below = \"chin\" }'
  frisure hair mine.toml --json --points 100

Exit status:
  0    done
  1    a file could not be written, or something else failed
  2    the command line, the scene or the head is wrong
  3    computed and written, but some equilibrium did not converge or is unstable, or a verdict fails
  4    computed and written, but some equilibrium misses the requested accuracy or may be unstable
  5    the photo does not tell: `frisure measure` says why
  130  interrupted; no file is left half-written";

/// Predicts how natural hair falls, from the physics of its fibres.
#[derive(Debug, Parser)]
#[command(name = "frisure", version, after_help = EXAMPLES, max_term_width = 100)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,

    /// Number of threads; by default one per processor. Results do not depend on it.
    #[arg(long, global = true, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<usize>,

    /// No progress and no summary.
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Predict a whole head of hair, and write it as a groom, a picture, a report.
    Predict(Predict),
    /// Predict many heads from one scene, over ranges and measured distributions, as Parquet.
    Batch(Batch),
    /// Add steps to a scene, take one out, or list them: what is done to the hair.
    Style(Style),
    /// Draw the final picture of a head of hair, by following the light.
    Render(Render),
    /// Draw pictures of a scene or a groom in seconds, as `frisure predict --image` does.
    View(View),
    /// Read a groom and write it in another format, with other units, axes or points.
    Convert(Convert),
    /// Make hair cards for games: textured strips in levels of detail, in place of strands.
    Cards(Cards),
    /// Put the hair of a groom on another head, where it comes to rest.
    Transfer(Transfer),
    /// Compute one hair: its shape, its energies, and how sure they are.
    Hair(Hair),
    /// List the hair types that a scene can start from, or all that is measured of one.
    Presets(Presets),
    /// Print a commented scene to start from.
    New(New),
    /// Turn tables of measured hair into a scene of that hair.
    Measured(Measured),
    /// Measure the curl of one lock in a photo, with error bars.
    Measure(MeasurePhoto),
    /// Fit digitised fibres: natural strain and stiffness over weight, with error bars.
    Fit(FitFibres),
    /// Print the JSON Schema of scenes: every key, its unit and its range.
    Schema,
    /// Compare frisure with independent physics and the paper, and write the validation report.
    Validate(Validate),
}

const PREDICT_EXAMPLES: &str = "\
Examples:
  frisure predict scenes/curly.toml -o out/curly.hair --image out/curly.png
  frisure predict scenes/wavy.toml -o wavy.obj -o wavy.ply --report wavy.json
  frisure new frizzy | frisure predict - --image frizzy.png
  frisure predict scenes/curly.toml --image curly.png --quality final
  frisure predict scenes/bob.toml --image bob.png --camera front,side,back
  frisure predict scenes/growth.toml --each-step --image out/growth.png
  frisure predict scenes/growth.toml --each-step --time-samples -o out/growth.abc

The command creates the folders of its outputs. Paths in a scene are relative to the scene, or to
the current folder if the scene comes from standard input.

With 50 000 or more simulated hairs ([wisps] strands = \"simulated\") the command saves a checkpoint,
OUTPUT.hairs.part, until the output is written: after Ctrl-C or a crash the same command resumes
from it.";

/// Arguments of `frisure predict`.
#[derive(Args, Debug)]
#[command(after_help = PREDICT_EXAMPLES)]
pub(crate) struct Predict {
    /// The scene (TOML), or `-` for standard input.
    pub(crate) scene: PathBuf,

    /// Write the groom; the extension names the format, as `frisure convert --help` lists them. May be
    /// repeated.
    #[arg(long = "output", short, value_name = "GROOM")]
    pub(crate) outputs: Vec<PathBuf>,

    /// What is in grooms, and how.
    #[command(flatten)]
    pub(crate) writing: Writing,

    /// Write into grooms, for every hair, what its fibre is like along it: directors and natural
    /// strains. Guides have them anyway.
    #[arg(long)]
    pub(crate) fibres: bool,

    /// Write into grooms what holds the hair (rollers, hair ties, pins, clips) as meshes named
    /// 'accessories/roller_0' and so on; for .usdc, .usda, .usdz, .abc, .glb and .obj.
    #[arg(long, conflicts_with = "time_samples")]
    pub(crate) accessories: bool,

    /// Write a picture (.png, or .exr with its light as it is).
    #[arg(long, value_name = "PICTURE")]
    pub(crate) image: Option<PathBuf>,

    /// Write numbers about the result (.json).
    #[arg(long, value_name = "JSON")]
    pub(crate) report: Option<PathBuf>,

    /// Predict this many replicas more, whose lengths and curl are changed by up to a millionth, and tell
    /// how far guides move: those that lie where they lie by chance jump. Each takes as long as the head.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) replicas: Option<u32>,

    /// How the picture is made.
    #[arg(long, value_enum, default_value_t = Quality::Preview, value_name = "QUALITY")]
    pub(crate) quality: Quality,

    /// Where the picture is taken from, instead of the scene's place. Several, as `front,side,back`, give a
    /// picture each, whose file has the name of the camera: hair-front.png.
    #[arg(long, value_parser = cameras(), value_name = "CAMERA", value_delimiter = ',', requires = "image")]
    pub(crate) camera: Vec<NamedCamera>,

    /// How final pictures are traced.
    #[command(flatten)]
    pub(crate) tracing: Tracing,

    /// Write a groom and a picture before the first step and after each, numbered: hair-00.png,
    /// hair-01.png and so on, all from one place. Growth in stages counts each stage.
    #[arg(long)]
    pub(crate) each_step: bool,

    /// With `--each-step`: write one groom with the hair before the first step and after each as time
    /// samples, in place of numbered grooms (.abc, .usda, .usdc, .usdz).
    #[arg(long, requires = "each_step", requires = "outputs")]
    pub(crate) time_samples: bool,

    /// Seconds from one time sample to the next, 0.001 to 3600.
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, requires = "time_samples")]
    #[arg(value_parser = interval)]
    pub(crate) interval: f64,
}

/// Reads the time between samples.
fn interval(text: &str) -> Result<f64, String> {
    let range = 0.001..=3600.0;
    let seconds = text.parse().ok().filter(|seconds| range.contains(seconds));
    seconds.ok_or_else(|| "it must be a number of seconds between 0.001 and 3600".into())
}

const STYLE_EXAMPLES: &str = "\
Examples:
  frisure style mine.toml --step 'wet = {}' --step 'cut = { below = \"brows\", where = \"fringe\" }'
  frisure style mine.toml --list
  frisure style mine.toml --at 2 --step 'comb = { to = \"left\" }'
  frisure style mine.toml --remove 3 --at 3 --step 'dry = {}'
  frisure style mine.toml --step 'grow = { months = 3 }' -o later.toml

The command replaces the scene atomically and changes only its steps: comments and layout stay. If a
step is invalid or a number in it is out of range, the scene stays unchanged. `frisure predict`
reports errors that depend on the hair, such as a cut above all roots or a wisp that does not exist.
Steps are numbered from 1; `--remove` applies before `--at`. docs/scene.md lists the keys of steps.";

/// Arguments of `frisure style`.
#[derive(Args, Debug)]
#[command(after_help = STYLE_EXAMPLES)]
#[command(group = ArgGroup::new("what").required(true).multiple(true))]
pub(crate) struct Style {
    /// The scene (TOML), or `-` for standard input.
    pub(crate) scene: PathBuf,

    /// Add a step after the others, written as in a scene. May be repeated.
    #[arg(long = "step", value_name = "STEP", group = "what")]
    pub(crate) steps: Vec<String>,

    /// Add the steps before the one with this number instead.
    #[arg(long, value_name = "N", value_parser = step_number, requires = "steps")]
    pub(crate) at: Option<usize>,

    /// Take out the step with this number, and the comments directly above it.
    #[arg(long, value_name = "N", value_parser = step_number, group = "what")]
    pub(crate) remove: Option<usize>,

    /// Print the steps, numbered, and change nothing.
    #[arg(long, group = "what", conflicts_with_all = ["steps", "remove", "output"])]
    pub(crate) list: bool,

    /// Write the scene here (.toml) instead of back to where it was read; `-` for standard output.
    #[arg(long, short, value_name = "SCENE")]
    pub(crate) output: Option<PathBuf>,
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Quality {
    /// In seconds, by projection, with shadows.
    Preview,
    /// In minutes, by following the light from hair to hair.
    Final,
}

/// How much light is followed.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct Tracing {
    /// Most paths of light per pixel of a final picture, 1 to 65536: noise falls with their root.
    /// [default: 256]
    #[arg(long, value_name = "N", value_parser = paths)]
    pub(crate) paths: Option<usize>,

    /// Noise at which a part of a final picture is good enough and gets no more paths, in percent of
    /// the way from black to white; 0: all parts get all. [default: 2]
    #[arg(long, value_name = "PERCENT", value_parser = noise)]
    pub(crate) noise: Option<f32>,

    /// Most times that a path of light is followed on, 1 to 10000; light hair needs 50 and more.
    /// [default: 100]
    #[arg(long, value_name = "N", value_parser = bounces)]
    pub(crate) bounces: Option<u32>,

    /// Firefly clamp: the most light that one path may bring which was scattered twice or more, 0.01 to
    /// 1e6, where white paper has about 1. It takes away single bright pixels and darkens the picture a
    /// little; 10 is weak, 2 strong. By default there is none.
    #[arg(long, value_name = "LIGHT", value_parser = clamp)]
    pub(crate) clamp: Option<f32>,

    /// Take out what noise is left, by Open Image Denoise, if it is installed: pleasant for few paths,
    /// but no longer the truth. FRISURE_OIDN names its library where the system does not know it.
    /// `--denoise=50` takes out half of it where hair is, which keeps the finest hairs, and all elsewhere.
    #[arg(long, value_name = "PERCENT", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "100", value_parser = noise)]
    pub(crate) denoise: Option<f32>,
}

impl Tracing {
    /// Whether any of them is given.
    pub(crate) fn is_given(self) -> bool {
        let Self { paths, noise, bounces, clamp, denoise } = self;
        let tracing = paths.is_some() || noise.is_some() || bounces.is_some() || clamp.is_some();
        tracing || denoise.is_some()
    }

    /// The renderer's options, for a picture of a scene's size, with the scene's seed.
    pub(crate) fn options(self, scene: &Scene) -> TraceOptions {
        TraceOptions {
            width: scene.output.width,
            height: scene.output.height,
            samples: self.paths.unwrap_or(256),
            noise: Some(0.01 * self.noise.unwrap_or(2.0)).filter(|noise| *noise > 0.0),
            bounces: self.bounces.unwrap_or(100),
            clamp: self.clamp,
            // The cast takes the low bits, which is as good a seed.
            seed: scene.look.hair.seed,
        }
    }
}

/// What is in a groom file, and how.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct Writing {
    /// The content of a groom. By default both, in formats that distinguish guides from hairs, and hairs in others.
    #[arg(long, value_enum, value_name = "CONTENT")]
    pub(crate) content: Option<Content>,

    /// Resample each strand to this number of points, evenly spaced along it: 2 to 65536. The command prints the
    /// largest distance from the original strands.
    #[arg(long, value_name = "N", value_parser = groom_points, conflicts_with = "max_points")]
    pub(crate) points: Option<usize>,

    /// Keep at most this number of points of each strand, 2 to 65536: root, tip and those without which the
    /// strand would be farthest from its place. The command prints the largest distance.
    #[arg(long, value_name = "N", value_parser = groom_points)]
    pub(crate) max_points: Option<usize>,

    /// Write this number of hairs, evenly chosen over the scalp, so much wider that they cover the same area.
    #[arg(long, value_name = "N", value_parser = groom_hairs)]
    pub(crate) hairs: Option<usize>,

    /// With fewer hairs: leave each as wide as it is.
    #[arg(long, requires = "hairs")]
    pub(crate) keep_widths: bool,

    /// Write what a program expects: unit, axes, numbers of hairs and points, attributes. `--unit`, `--up`,
    /// `--hairs`, `--points` and `--max-points` have precedence.
    #[arg(long = "for", value_name = "PROGRAM", value_parser = program())]
    pub(crate) program: Option<&'static Program>,

    /// Unit and axes of what is written.
    #[command(flatten)]
    pub(crate) axes: Axes,
}

impl Writing {
    /// The hairs and points that are asked for.
    pub(crate) fn fit(self) -> Fit {
        let even = self.points.map(Points::Even);
        let points = even.or(self.max_points.map(Points::AtMost)).unwrap_or_default();
        Fit { hairs: self.hairs, keep_widths: self.keep_widths, points }
    }
}

/// Unit and axes of a groom's file.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct Axes {
    /// The unit of the groom's positions and widths, instead of its own or its format's.
    #[arg(long, value_parser = named(&UNITS), value_name = "UNIT")]
    pub(crate) unit: Option<f64>,

    /// The axis that points up in the groom, instead of its own or its format's: y (the face looks along z)
    /// or z (along -y).
    #[arg(long, value_parser = named(&UP_AXES), value_name = "AXIS")]
    pub(crate) up: Option<UpAxis>,
}

impl Axes {
    /// Whether any of them is given.
    pub(crate) fn is_given(self) -> bool {
        self.unit.is_some() || self.up.is_some()
    }

    /// The choice of a frame.
    pub(crate) fn choice(self) -> FrameChoice {
        FrameChoice { metres: self.unit, up: self.up, ..FrameChoice::default() }
    }
}

/// What a groom file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Content {
    /// The drawn hairs.
    Hairs,
    /// The guides.
    Guides,
    /// Both, as separate groups.
    Both,
}

/// Units of length (m).
const UNITS: [(&str, &str, f64); 5] = [
    ("m", "Metres", 1.0),
    ("dm", "Decimetres", 0.1),
    ("cm", "Centimetres", 0.01),
    ("mm", "Millimetres", 0.001),
    ("in", "Inches", 0.0254),
];

/// Axes that can point up.
const UP_AXES: [(&str, &str, UpAxis); 2] = [("y", "y", UpAxis::Y), ("z", "z", UpAxis::Z)];

const CONVERT_EXAMPLES: &str = "\
Examples:
  frisure convert wDemo.hair -o demo.ply
  frisure convert scan.hair --from-unit mm --from-up y -o scan.obj --points 100
  frisure convert curly.usdc -o curly.html
  frisure convert curly.usdc --for unreal --hairs 30000 -o curly.abc";

/// Arguments of `frisure convert`.
#[derive(Args, Debug)]
#[command(after_help = after_convert())]
pub(crate) struct Convert {
    /// The groom; its extension names the format.
    pub(crate) groom: PathBuf,

    /// Write it here; the extension names the format. May be repeated.
    #[arg(long = "output", short, value_name = "GROOM", required = true)]
    pub(crate) outputs: Vec<PathBuf>,

    /// What is written, and how.
    #[command(flatten)]
    pub(crate) writing: Writing,

    /// What the groom that is read has.
    #[command(flatten)]
    pub(crate) read: ReadAxes,
}

/// Unit and axes of a groom that is read, of a command that writes another.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct ReadAxes {
    /// The unit of the groom that is read, instead of its own or its format's.
    #[arg(long, value_parser = named(&UNITS), value_name = "UNIT")]
    from_unit: Option<f64>,

    /// The axis that points up in the groom that is read, instead of its own or its format's.
    #[arg(long, value_parser = named(&UP_AXES), value_name = "AXIS")]
    from_up: Option<UpAxis>,
}

impl ReadAxes {
    pub(crate) fn axes(self) -> Axes {
        Axes { unit: self.from_unit, up: self.from_up }
    }
}

/// Examples, and the formats.
fn after_convert() -> String {
    let mut text = format!("{CONVERT_EXAMPLES}\n\nFormats:\n");
    for &format in Format::ALL {
        let names = format.extensions().iter().map(|e| format!(".{e}")).collect::<Vec<_>>();
        let Frame { metres, up } = format.frame();
        let unit = if metres == 1.0 { "m" } else { "cm" };
        let up = if up == UpAxis::Y { "y" } else { "z" };
        let how = if format.is_read() { "" } else { "; written only" };
        let _ = writeln!(text, "  {:16}{} ({unit}, {up} up{how})", names.join(" "), format.title());
    }
    text.push_str("\ndocs/formats.md describes the content of each.");
    text
}

const CARDS_EXAMPLES: &str = "\
Examples:
  frisure cards scenes/curly.toml -o out/curly.glb
  frisure cards curly.usdc -o curly.glb -o curly.obj --cards 400 --lods 3 --texture-size 1024

Each level of detail has 2.5 times fewer cards than the one before, and textures half as large. The
command prints for each level how far the cards are from the strands, seen from six sides: the part of
the silhouette that differs, and the mean difference of what is covered. A .glb has all textures in
it; .obj, .usdc and .usda have PNG files beside them. docs/cards.md describes the textures.";

/// Arguments of `frisure cards`.
#[derive(Args, Debug)]
#[command(after_help = CARDS_EXAMPLES)]
pub(crate) struct Cards {
    /// The scene (TOML), `-` for standard input, or a groom of a format that `frisure convert` reads.
    #[arg(value_name = "SCENE|GROOM")]
    pub(crate) input: PathBuf,

    /// Write them here (.glb, .obj, .usdc, .usda). May be repeated.
    #[arg(long = "output", short, value_name = "CARDS", required = true)]
    pub(crate) outputs: Vec<PathBuf>,

    /// About as many cards in the first level, 1 to 20000.
    #[arg(long, value_name = "N", value_parser = card_count, default_value_t = 800)]
    pub(crate) cards: usize,

    /// Levels of detail, 1 to 8.
    #[arg(long, value_name = "N", value_parser = levels, default_value_t = 4)]
    pub(crate) lods: usize,

    /// Side of the first level's textures (texels), 64 to 8192.
    #[arg(long, value_name = "N", value_parser = texture_size, default_value_t = 2048)]
    pub(crate) texture_size: usize,

    /// What a groom that is read has.
    #[command(flatten)]
    pub(crate) axes: Axes,
}

fn card_count(text: &str) -> Result<usize, String> {
    number(text, 1, 20_000)
}

fn levels(text: &str) -> Result<usize, String> {
    number(text, 1, 8)
}

fn texture_size(text: &str) -> Result<usize, String> {
    number(text, 64, 8192)
}

const HAIR_EXAMPLES: &str = "\
Examples:
  frisure hair scenes/curly.toml
  frisure hair scenes/curly.toml --json --points 200 > hair.json

The hair is that of `[hair]`, without variation, clamped at the origin in the frame of `[hair.root]`.
JSON is in SI units: `length`, `elements`, `tip`, `energy` (`elastic`, `gravity`, `contact`,
`total`), `gradient_norm` (relative), `min_eigenvalue` (1 without load, 0 where stability is lost)
and its `eigenvalue_error`, `stable`, `stability` (`stable`, `unstable`, `undecided`,
`not converged`), `iterations`, `error_estimate`, `requested_accuracy` and `accuracy_met` (null if
`[equilibrium]` has a number of elements), and with --points also `points`.";

/// Arguments of `frisure hair`.
#[derive(Args, Debug)]
#[command(after_help = HAIR_EXAMPLES)]
pub(crate) struct Hair {
    /// The scene (TOML), or `-` for standard input.
    pub(crate) scene: PathBuf,

    /// Print JSON instead of a table.
    #[arg(long)]
    pub(crate) json: bool,

    /// Also print the centre line as N points, evenly spaced from root to tip; 2 to 1000000.
    #[arg(long, value_name = "N", value_parser = points)]
    pub(crate) points: Option<usize>,
}

const PRESETS_EXAMPLES: &str = "\
Examples:
  frisure presets
  frisure presets african-coily
  frisure presets --json > types.json

JSON is in SI units, one object per type, or one object for the named type. docs/hair-types.md has
the source of each number.";

/// Arguments of `frisure presets`.
#[derive(Args, Debug)]
#[command(after_help = PRESETS_EXAMPLES)]
pub(crate) struct Presets {
    /// One hair type: print all its numbers.
    #[arg(value_name = "TYPE", hide_possible_values = true)]
    #[arg(value_parser = hair_type())]
    pub(crate) hair_type: Option<&'static Preset>,

    /// Print JSON instead of a table.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Arguments of `frisure new`.
#[derive(Args, Debug)]
pub(crate) struct New {
    /// The hair type; `frisure presets` describes them.
    #[arg(value_parser = hair_type(), default_value = "caucasian-wavy")]
    pub(crate) hair_type: &'static Preset,
}

const MEASURED_EXAMPLES: &str = "\
Examples:
  frisure measured summary_section_data.csv analysis/ImageSum_*.csv -o mine.toml
  frisure measured WithinElement/*.csv --pitch '24 mm' -o mine.toml
  frisure measured lab.csv --column 'D1=max diameter (um)' --column 'D2=min diameter (um)'
  frisure measured people.csv --rows 'texture=curly'

The command reads the tables of fibermorph, and columns of other tables with these headings and a unit:
  diameter (um), min diameter (um), max diameter (um), area (um^2), axis ratio, eccentricity,
  curvature (1/mm), curve diameter (mm), curl radius (mm), curl diameter (mm), pitch (mm),
  curl index, turns (1/cm), hair length (cm), Young's modulus (GPa), shear modulus (GPa),
  density (g/cm^3)
A column `hair` groups the rows of one hair, such as windows along it; `n` is the number of hairs of a
row; headings with mean, median or sd are for many hairs. Comments in the scene give the source of each
number and what was not measured. docs/measurements.md describes the method.";

/// Arguments of `frisure measured`.
#[derive(Args, Debug)]
#[command(after_help = MEASURED_EXAMPLES)]
#[command(group = ArgGroup::new("steepness"))]
pub(crate) struct Measured {
    /// The tables (CSV, with commas, semicolons or tabs).
    #[arg(value_name = "TABLE", required = true)]
    pub(crate) tables: Vec<PathBuf>,

    /// Write the scene here instead of to standard output.
    #[arg(long, short, value_name = "SCENE")]
    pub(crate) output: Option<PathBuf>,

    /// The hair type for all other numbers. By default the type with the nearest curl.
    #[arg(long = "type", value_name = "TYPE", hide_possible_values = true)]
    #[arg(value_parser = hair_type())]
    pub(crate) hair_type: Option<&'static Preset>,

    /// Read a column as if it had another heading: 'D1=max diameter (um)'. May be repeated.
    #[arg(long = "column", value_name = "COLUMN=HEADING", value_parser = pair)]
    pub(crate) columns: Vec<(String, String)>,

    /// Use only rows with this text in that column; `*` matches any text. May be repeated.
    #[arg(long = "rows", value_name = "COLUMN=TEXT", value_parser = pair)]
    pub(crate) rows: Vec<(String, String)>,

    /// The length of the window, for curvatures measured with several. [default: the longest]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) window: Option<f64>,

    /// Use the shape of sections and not their size, for micrographs without a scale.
    #[arg(long)]
    pub(crate) shape_only: bool,

    /// The pitch of the curl without weight, such as '24 mm': the curvature does not determine it.
    #[arg(long, value_name = "LENGTH", value_parser = length, group = "steepness")]
    pub(crate) pitch: Option<f64>,

    /// Instead of the pitch: the radius of the curl without weight.
    #[arg(long, value_name = "LENGTH", value_parser = length, group = "steepness")]
    pub(crate) radius: Option<f64>,

    /// Instead of the pitch: length along the hair over the distance that it spans, without weight.
    #[arg(long, value_name = "RATIO", value_parser = curl_index, group = "steepness")]
    pub(crate) curl_index: Option<f64>,

    /// Instead of the pitch: turns per length along the hair, such as '0.8 1/cm'.
    #[arg(long, value_name = "TURNS", value_parser = turns, group = "steepness")]
    pub(crate) turns: Option<f64>,
}

/// Reads the name of a hair type.
fn hair_type() -> impl TypedValueParser<Value = &'static Preset> {
    let known = "the parser accepts the names of presets alone";
    PossibleValuesParser::new(PRESETS.iter().map(|p| p.name)).map(|n| preset(&n).expect(known))
}

/// Reads the name of a program.
fn program() -> impl TypedValueParser<Value = &'static Program> {
    let known = "the parser accepts the names of programs alone";
    let possible = Program::ALL.iter().map(|p| PossibleValue::new(p.name).help(p.title));
    PossibleValuesParser::new(possible)
        .map(|name| Program::ALL.iter().find(|p| p.name == name).expect(known))
}

/// Reads the name of one of some values, each with a name and a description.
fn named<T: Copy + Send + Sync>(
    values: &'static [(&'static str, &'static str, T)],
) -> impl TypedValueParser<Value = T> {
    let known = "the parser accepts these names alone";
    let possible = values.iter().map(|(name, help, _)| PossibleValue::new(*name).help(*help));
    PossibleValuesParser::new(possible)
        .map(|name| values.iter().find(|value| value.0 == name).expect(known).2)
}

/// Reads the name of a camera.
fn cameras() -> impl TypedValueParser<Value = NamedCamera> {
    let possible = CAMERAS.iter().map(|of| PossibleValue::new(of.name).help(of.description));
    let known = "the parser accepts these names alone";
    PossibleValuesParser::new(possible)
        .map(|name| *CAMERAS.iter().find(|camera| camera.name == name).expect(known))
}

/// Reads two texts with `=` between.
fn pair(text: &str) -> Result<(String, String), String> {
    let (left, right) = text.split_once('=').ok_or("it must be two texts with `=` between")?;
    Ok((left.trim().to_owned(), right.trim().to_owned()))
}

fn length(text: &str) -> Result<f64, String> {
    positive(&LENGTH, text)
}

fn turns(text: &str) -> Result<f64, String> {
    positive(&STRAIN, text)
}

/// Most threads. Chosen: more than any machine that computes hair has processors.
pub(crate) const MAX_THREADS: usize = 1024;

fn curl_index(text: &str) -> Result<f64, String> {
    positive(&RATIO, text)
        .and_then(|x| if x > 1.0 { Ok(x) } else { Err("it must be more than 1".into()) })
}

fn positive(dimension: &Dimension, text: &str) -> Result<f64, String> {
    let value = dimension.parse(text);
    let value = value.map_err(|e| format!("{e}; it must be such as \"{}\"", dimension.example))?;
    if value > 0.0 { Ok(value) } else { Err("it must be more than 0".into()) }
}

fn threads(text: &str) -> Result<usize, String> {
    number(text, 1, MAX_THREADS)
}

fn points(text: &str) -> Result<usize, String> {
    number(text, 2, 1_000_000)
}

fn groom_points(text: &str) -> Result<usize, String> {
    number(text, 2, 65_536)
}

fn groom_hairs(text: &str) -> Result<usize, String> {
    number(text, 1, MAX_STRANDS)
}

fn step_number(text: &str) -> Result<usize, String> {
    number(text, 1, usize::MAX).map_err(|_| "steps are numbered from 1".into())
}

fn paths(text: &str) -> Result<usize, String> {
    number(text, 1, 65_536)
}

fn bounces(text: &str) -> Result<u32, String> {
    number(text, 1, 10_000).map(|n| u32::try_from(n).expect("at most 10000"))
}

fn clamp(text: &str) -> Result<f32, String> {
    let outside = || "it must be a number between 0.01 and 1e6".to_owned();
    text.parse().ok().filter(|n| (0.01..=1e6).contains(n)).ok_or_else(outside)
}

fn noise(text: &str) -> Result<f32, String> {
    let text = text.strip_suffix('%').unwrap_or(text).trim();
    let outside = || "it must be a number of percent between 0 and 100".to_owned();
    text.parse().ok().filter(|n| (0.0..=100.0).contains(n)).ok_or_else(outside)
}

fn number(text: &str, min: usize, max: usize) -> Result<usize, String> {
    let outside = || format!("it must be a whole number between {min} and {max}");
    text.parse().ok().filter(|n| (min..=max).contains(n)).ok_or_else(outside)
}
