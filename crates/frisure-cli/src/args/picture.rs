//! Arguments of `frisure render` and `frisure view`.

use std::path::PathBuf;

use clap::Args;
use frisure::look::NamedCamera;

use super::{Axes, Tracing, cameras, number};

const RENDER_EXAMPLES: &str = "\
Examples:
  frisure render scenes/curly.toml -o curly.png
  frisure render scenes/afro.toml -o back.exr --camera back --size 512x640 --noise 1
  frisure render scenes/bob.toml -o bob.png --camera front,side,back
  frisure render scenes/wavy.toml -o turn/wavy.png --turntable 36
  frisure render mine.hair -o mine.png --look scenes/curly.toml
  frisure render scan.ply --unit mm --up y -o scan.png

The command saves the picture and a checkpoint, PICTURE.part, every minute and at Ctrl-C; the same
command then resumes from the checkpoint. PNG has display colours (sRGB); EXR has linear light with
layers for compositors and denoisers: albedo, normal, tangent, depth, hair, wisp.";

const VIEW_EXAMPLES: &str = "\
Examples:
  frisure view scenes/bob.toml -o bob.png --camera front,side,back
  frisure view mine.usdc -o mine.png
  frisure view mine.hair -o mine.png --look scenes/curly.toml
  frisure view scenes/wavy.toml -o turn/wavy.png --turntable 24

The pictures are made by projection, with approximate shadows and scattering; `frisure render` follows
the light.";

/// Arguments of `frisure render`.
#[derive(Args, Debug)]
#[command(after_help = RENDER_EXAMPLES)]
pub(crate) struct Render {
    /// What is shown, and from where.
    #[command(flatten)]
    pub(crate) pictured: Pictured,

    /// How it is traced.
    #[command(flatten)]
    pub(crate) tracing: Tracing,
}

/// Arguments of `frisure view`.
#[derive(Args, Debug)]
#[command(after_help = VIEW_EXAMPLES)]
pub(crate) struct View {
    /// What is shown, and from where.
    #[command(flatten)]
    pub(crate) pictured: Pictured,
}

/// What is shown in pictures, and from where.
#[derive(Args, Debug)]
pub(crate) struct Pictured {
    /// The scene (TOML), `-` for standard input, or a groom of a format that `frisure convert` reads.
    #[arg(value_name = "SCENE|GROOM")]
    pub(crate) scene: PathBuf,

    /// The picture (.png or .exr).
    #[arg(long, short, value_name = "PICTURE")]
    pub(crate) output: PathBuf,

    /// Width and height (pixels), instead of the scene's: at most 16384 each, and in a traced picture 67108864 pixels, as 8192x8192.
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(crate) size: Option<(usize, usize)>,

    /// Where it is taken from, instead of the scene's place. Several, as `front,side,back`, give a picture
    /// each, whose file has the name of the camera: hair-front.png.
    #[arg(long, value_parser = cameras(), value_name = "CAMERA", value_delimiter = ',')]
    pub(crate) camera: Vec<NamedCamera>,

    /// So many pictures from all around, numbered, in the studio's light; the head turns to its right.
    #[arg(long, value_name = "FRAMES", value_parser = frames)]
    pub(crate) turntable: Option<usize>,

    /// The number of the first frame of the turntable that is drawn: to go on with one.
    #[arg(long, value_name = "FRAME", requires = "turntable", default_value_t = 0)]
    pub(crate) from: usize,

    /// For a groom: the scene whose head, look, camera and light it is shown with. Without it, a groom
    /// has no head, and the colours of its file.
    #[arg(long, value_name = "SCENE")]
    pub(crate) look: Option<PathBuf>,

    /// What a groom that is read has.
    #[command(flatten)]
    pub(crate) axes: Axes,
}

fn size(text: &str) -> Result<(usize, usize), String> {
    let (width, height) = text.split_once('x').ok_or("it must be such as 1024x1280")?;
    Ok((number(width, 1, 16_384)?, number(height, 1, 16_384)?))
}

fn frames(text: &str) -> Result<usize, String> {
    number(text, 2, 10_000)
}
