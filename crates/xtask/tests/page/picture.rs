//! What is in a screenshot.

use std::path::PathBuf;

/// A screenshot, as numbers.
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// Reads a PNG of eight bits.
    pub(crate) fn read(png: &[u8]) -> Self {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut bytes).expect("a picture");
        let channels = info.color_type.samples();
        let pixels = bytes[..info.buffer_size()]
            .chunks(channels)
            .map(|p| [p[0], p[1 % channels], p[2 % channels]])
            .collect();
        Self { width: info.width as usize, height: info.height as usize, pixels }
    }

    /// How many different colours a part of it has: `x`, `y`, width and height as parts of 1.
    pub(crate) fn colours(&self, part: [f64; 4]) -> usize {
        let colours: std::collections::BTreeSet<_> = self.part(part).collect();
        colours.len()
    }

    /// Part of the pixels (0 to 1) that differ visibly from another's.
    pub(crate) fn change(&self, other: &Self, part: [f64; 4]) -> f64 {
        let differs = |(a, b): ([u8; 3], [u8; 3])| a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 12);
        let all = self.part(part).count();
        self.part(part).zip(other.part(part)).filter(|pair| differs(*pair)).count() as f64
            / all as f64
    }

    fn part(&self, [x, y, width, height]: [f64; 4]) -> impl Iterator<Item = [u8; 3]> + '_ {
        let at = |part: f64, size: usize| ((part * size as f64) as usize).min(size);
        let columns = at(x, self.width)..at(x + width, self.width);
        let rows = at(y, self.height)..at(y + height, self.height);
        rows.flat_map(move |y| columns.clone().map(move |x| self.pixels[y * self.width + x]))
    }
}

/// Where pictures of a run are kept, for a look.
pub(crate) fn folder() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("page");
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}
