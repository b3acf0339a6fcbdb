//! How much of the page goes over the line.

use super::compile::target_folder;
use anyhow::{Result, bail};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// What the page may weigh, compressed as every host can (bytes).
const MOST: usize = 4_100_000;

/// A file, and how large it is as it is, with gzip and with brotli (bytes).
struct Sizes {
    name: String,
    raw: usize,
    gzip: usize,
    brotli: usize,
}

/// All files.
pub(crate) struct Table(Vec<Sizes>);

/// Writes `.gz` and `.br` beside each file, for hosts that send them.
pub(crate) fn compress(folder: &Path, quick: bool) -> Result<Table> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    paths.sort();
    let sizes = paths.iter().map(|path| compress_one(path, quick)).collect::<Result<_>>()?;
    Ok(Table(sizes))
}

fn compress_one(path: &Path, quick: bool) -> Result<Sizes> {
    let bytes = fs::read(path)?;
    let gzip = kept(&bytes, quick, "gz", || gzip(&bytes, quick))?;
    let brotli = kept(&bytes, quick, "br", || brotli(&bytes, quick))?;
    fs::write(beside(path, ".gz"), &gzip)?;
    fs::write(beside(path, ".br"), &brotli)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Sizes { name, raw: bytes.len(), gzip: gzip.len(), brotli: brotli.len() })
}

/// Files from which on their packed form is kept for the next build: the WebAssembly takes half a minute (bytes).
const LARGE: usize = 1_000_000;

/// The packed bytes: those of an earlier build of the same bytes, or new ones.
fn kept(
    bytes: &[u8],
    quick: bool,
    ending: &str,
    pack: impl FnOnce() -> Result<Vec<u8>>,
) -> Result<Vec<u8>> {
    if bytes.len() < LARGE {
        return pack();
    }
    let mut sum = flate2::Crc::new();
    sum.update(bytes);
    let quality = if quick { "quick" } else { "small" };
    let name = format!("{:08x}-{}-{quality}.{ending}", sum.sum(), bytes.len());
    let folder = target_folder().join("packed");
    let path = folder.join(name);
    if let Ok(packed) = fs::read(&path) {
        return Ok(packed);
    }
    let packed = pack()?;
    fs::create_dir_all(&folder)?;
    // Those of other builds are of no more use.
    for entry in fs::read_dir(&folder)?.flatten() {
        if entry.path().extension().is_some_and(|other| other == ending) {
            fs::remove_file(entry.path())?;
        }
    }
    // Renamed when it is whole: a build that was killed leaves no half of it.
    let unfinished = path.with_extension(format!("{ending}-part"));
    fs::write(&unfinished, &packed)?;
    fs::rename(unfinished, path)?;
    Ok(packed)
}

/// A path with an ending more.
pub(crate) fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

fn gzip(bytes: &[u8], quick: bool) -> Result<Vec<u8>> {
    let level = flate2::Compression::new(if quick { 1 } else { 9 });
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), level);
    packed.write_all(bytes)?;
    Ok(packed.finish()?)
}

fn brotli(bytes: &[u8], quick: bool) -> Result<Vec<u8>> {
    let quality = if quick { 1 } else { 10 };
    let params = brotli::enc::BrotliEncoderParams { quality, lgwin: 24, ..Default::default() };
    let mut packed = Vec::new();
    brotli::BrotliCompress(&mut &*bytes, &mut packed, &params)?;
    Ok(packed)
}

impl Table {
    /// For a person.
    pub(crate) fn table(&self) -> String {
        let head = format!("{:<16} {:>10} {:>10} {:>10}", "kB", "raw", "gzip", "brotli");
        let sum = Sizes {
            name: "all".into(),
            raw: self.sum(|s| s.raw),
            gzip: self.sum(|s| s.gzip),
            brotli: self.sum(|s| s.brotli),
        };
        let rows = self.0.iter().chain([&sum]).map(Sizes::row);
        std::iter::once(head).chain(rows).collect::<Vec<_>>().join("\n")
    }

    fn sum(&self, part: impl Fn(&Sizes) -> usize) -> usize {
        self.0.iter().map(part).sum()
    }

    /// Refuses a page that would keep people waiting.
    pub(crate) fn check(&self) -> Result<()> {
        let weight = self.sum(|s| s.gzip);
        if weight > MOST {
            bail!("the page weighs {} kB with gzip; {} are allowed", kb(weight), kb(MOST));
        }
        Ok(())
    }
}

impl Sizes {
    fn row(&self) -> String {
        let Self { name, raw, gzip, brotli } = self;
        format!("{name:<16} {:>10} {:>10} {:>10}", kb(*raw), kb(*gzip), kb(*brotli))
    }
}

fn kb(bytes: usize) -> String {
    format!("{:.1}", bytes as f64 / 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    fn page_of(bytes: &[u8]) -> (tempfile::TempDir, Table) {
        let folder = tempfile::tempdir().expect("folder");
        fs::write(folder.path().join("a.js"), bytes).expect("write");
        let table = compress(folder.path(), false).expect("compress");
        (folder, table)
    }

    #[test]
    fn what_is_compressed_comes_back() {
        let text = b"let hair = 'hair hair hair hair hair';".repeat(20);
        let (folder, table) = page_of(&text);
        let packed = fs::read(folder.path().join("a.js.gz")).expect("gz");
        let mut back = Vec::new();
        flate2::read::GzDecoder::new(&*packed).read_to_end(&mut back).expect("gzip");
        assert_eq!(back, text);
        let packed = fs::read(folder.path().join("a.js.br")).expect("br");
        let mut back = Vec::new();
        brotli::BrotliDecompress(&mut &*packed, &mut back).expect("brotli");
        assert_eq!(back, text);
        assert!(table.check().is_ok() && table.table().contains("a.js"));
    }

    #[test]
    fn a_page_that_is_too_heavy_is_refused() {
        let size = Sizes { name: "a".into(), raw: 9_000_000, gzip: 4_100_001, brotli: 3_000_000 };
        let told = Table(vec![size]).check().expect_err("too heavy").to_string();
        assert!(told.contains("4100.0"), "{told}");
    }
}
