//! Arguments of `frisure transfer`.

use std::path::{Path, PathBuf};

use clap::Args;
use frisure::files::head::HeadFile;
use frisure::hairstyle::Preset;
use frisure::hairstyle::head::Head;
use frisure::scene::HeadSource;

use super::{ReadAxes, Writing, hair_type};

const EXAMPLES: &str = "\
Examples:
  frisure transfer curly.usdc --from mannequin --to european-woman -o hers.usdc --image hers.png
  frisure transfer scan.hair --from-unit mm --from head.obj --to other.glb -o other.abc

A HEAD is a mesh (OBJ, USD, glTF or PLY) or the name of a built-in head. Roots go to the places that
correspond by the landmarks of both heads. Each guide keeps its length and the natural curl with which
it hangs as the groom has it, and comes to rest on the other head; the other hairs follow the guides.
In a scene, `head_mesh` and `head_model` of `[groom]` do the same, and steps can follow.";

/// Arguments of `frisure transfer`.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Transfer {
    /// The groom; its extension names the format, as `frisure convert --help` lists them.
    pub(crate) groom: PathBuf,

    /// The head that the groom was made on.
    #[arg(long, value_name = "HEAD", value_parser = head)]
    pub(crate) from: HeadSource,

    /// The head that gets the hair.
    #[arg(long, value_name = "HEAD", value_parser = head)]
    pub(crate) to: HeadSource,

    /// Write it here; the extension names the format. May be repeated.
    #[arg(long = "output", short, value_name = "GROOM", required = true)]
    pub(crate) outputs: Vec<PathBuf>,

    /// What is written, and how.
    #[command(flatten)]
    pub(crate) writing: Writing,

    /// Write a picture (.png, or .exr with its light as it is).
    #[arg(long, value_name = "PICTURE")]
    pub(crate) image: Option<PathBuf>,

    /// Write numbers about the result (.json).
    #[arg(long, value_name = "JSON")]
    pub(crate) report: Option<PathBuf>,

    /// The hair type whose fibre it is; `frisure presets` describes them. [default: caucasian-straight]
    #[arg(long = "type", value_name = "TYPE", hide_possible_values = true)]
    #[arg(value_parser = hair_type())]
    pub(crate) hair_type: Option<&'static Preset>,

    /// What the groom that is read has.
    #[command(flatten)]
    pub(crate) read: ReadAxes,
}

/// A built-in head by its name, or a mesh.
fn head(text: &str) -> Result<HeadSource, String> {
    if let Some(head) = HeadSource::built_in(text) {
        return Ok(head);
    }
    if Path::new(text).exists() {
        return Ok(HeadSource::Mesh(HeadFile::new(text.into())));
    }
    let names = Head::names().collect::<Vec<_>>().join(", ");
    Err(format!("there is no such file, and no built-in head of this name: {names}"))
}
