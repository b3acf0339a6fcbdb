//! Parts: the files of a batch, each with neighbouring heads.

use std::ops::Range;

/// The folder of views beside the parts. Readers of a folder of Parquet skip names that begin so: the table of heads stays one.
pub(crate) const VIEWS: &str = "_views";

/// Neighbouring heads in one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Index of the part.
    pub number: usize,
    /// Index of the first head.
    pub first: usize,
    /// Number of heads.
    pub heads: usize,
}

impl Part {
    /// All parts of `heads` heads, with `rows` in each but the last.
    pub(crate) fn all(heads: usize, rows: usize) -> impl Iterator<Item = Self> {
        (0..heads.div_ceil(rows)).map(move |number| {
            let first = number * rows;
            Self { number, first, heads: rows.min(heads - first) }
        })
    }

    /// The indices of its heads.
    #[must_use]
    pub fn range(self) -> Range<usize> {
        self.first..self.first + self.heads
    }

    /// The name of its file, such as `part-000000120.parquet` for the part that begins with head 120.
    #[must_use]
    pub fn name(self) -> String {
        format!("part-{:09}.parquet", self.first)
    }

    /// The name of the file of its views, in the folder `_views`: `views-000000120.parquet`.
    #[must_use]
    pub fn views_name(self) -> String {
        format!("views-{:09}.parquet", self.first)
    }

    /// The first head of the part with a file name; none for other names.
    pub(crate) fn first_of(name: &str) -> Option<usize> {
        let digits = name.strip_prefix("part-")?.strip_suffix(".parquet")?;
        digits.bytes().all(|b| b.is_ascii_digit()).then(|| digits.parse().ok())?
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_a_batch() {
        let parts: Vec<Part> = Part::all(37, 16).collect();
        assert_eq!(parts.iter().map(|part| part.heads).collect::<Vec<_>>(), [16, 16, 5]);
        let heads: Vec<usize> = parts.iter().flat_map(|part| part.range()).collect();
        assert_eq!(heads, (0..37).collect::<Vec<_>>());
        assert_eq!(parts[2].name(), "part-000000032.parquet");
        assert_eq!(Part::first_of(&parts[2].name()), Some(32));
        assert_eq!(Part::first_of("part-x.parquet"), None);
        assert_eq!(Part::all(0, 4).count(), 0);
    }
}
