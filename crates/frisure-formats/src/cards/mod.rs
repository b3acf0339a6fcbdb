//! Hair cards in files of other programs: one mesh for each level of detail, with its textures.
//!
//! | module | file | textures |
//! | --- | --- | --- |
//! | `gltf` | `.glb`, metres, y up | in the file |
//! | `obj` | `.obj` and `.mtl`, metres, y up | PNG files beside it |
//! | `usd` | `.usdc`, `.usda`, metres, z up | PNG files beside it |

mod error;
mod gltf;
mod obj;
mod texture;
#[cfg(feature = "usd")]
mod usd;

use std::path::{Path, PathBuf};

use frisure_cards::{Cards, TEXTURES};
use frisure_files::write_atomically;

pub use error::{CardsFileError, EXTENSIONS};
use texture::texture;

/// A format of cards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Gltf,
    Obj,
    #[cfg(feature = "usd")]
    UsdBinary,
    #[cfg(feature = "usd")]
    UsdText,
}

fn kind(path: &Path) -> Result<Kind, CardsFileError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    match extension.to_ascii_lowercase().as_str() {
        "glb" => Ok(Kind::Gltf),
        "obj" => Ok(Kind::Obj),
        #[cfg(feature = "usd")]
        "usdc" => Ok(Kind::UsdBinary),
        #[cfg(feature = "usd")]
        "usda" => Ok(Kind::UsdText),
        _ => Err(CardsFileError::Extension { path: path.into() }),
    }
}

/// All files that cards in a file of this name consist of, the file itself last.
///
/// # Errors
/// [`CardsFileError::Extension`].
pub fn files(path: &Path, levels: usize) -> Result<Vec<PathBuf>, CardsFileError> {
    let kind = kind(path)?;
    let mut all = Vec::new();
    if kind != Kind::Gltf {
        let names =
            (0..levels).flat_map(|level| TEXTURES.map(|name| texture_name(path, level, name)));
        all.extend(names.map(|name| path.with_file_name(name)));
    }
    if kind == Kind::Obj {
        all.push(path.with_extension("mtl"));
    }
    all.push(path.into());
    Ok(all)
}

/// Writes cards in the format that the path's extension names, each file atomically and the one of that name last.
///
/// # Errors
/// [`CardsFileError`].
pub fn write(path: &Path, cards: &Cards) -> Result<(), CardsFileError> {
    let kind = kind(path)?;
    if kind == Kind::Gltf {
        let bytes = gltf::encode(cards)?;
        return Ok(write_atomically(path, |out| out.write_all(&bytes))?);
    }
    for (level, of) in cards.levels.iter().enumerate() {
        for (index, name) in TEXTURES.iter().enumerate() {
            let file = path.with_file_name(texture_name(path, level, name));
            let bytes = texture(&of.atlas, index);
            write_atomically(&file, |out| out.write_all(&bytes))?;
        }
    }
    let named = |level: usize, name: &str| texture_name(path, level, name);
    match kind {
        Kind::Obj => {
            let library = path.with_extension("mtl");
            write_atomically(&library, |out| obj::materials(out, cards, named))?;
            let name = library.file_name().unwrap_or_default().to_string_lossy().into_owned();
            write_atomically(path, |out| obj::meshes(out, cards, &name))?;
        }
        Kind::Gltf => {}
        #[cfg(feature = "usd")]
        Kind::UsdBinary => {
            write_atomically(path, |out| {
                frisure_usd::write_binary(out, &usd::layer(cards, named))
            })?;
        }
        #[cfg(feature = "usd")]
        Kind::UsdText => {
            write_atomically(path, |out| frisure_usd::write_text(out, &usd::layer(cards, named)))?;
        }
    }
    Ok(())
}

/// The file of a texture beside the file of the cards: `hair.obj` has `hair-lod0-color.png`.
fn texture_name(path: &Path, level: usize, name: &str) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    format!("{stem}-lod{level}-{name}.png")
}
