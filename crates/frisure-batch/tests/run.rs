//! A batch from a program: what is in its parts, and that it can be stopped.

use std::fs::File;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use frisure::progress::Progress;
use frisure_batch::{Batch, BatchError, Done, Run, Shard};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};

/// Some lengths are below zero.
const TEXT: &str = r#"
    samples = 6
    rows = 4
    [set]
    wisps = { count = 3, hairs = 20, points = 8 }
    [vary]
    hair.length = { normal = ["1 cm", "2 cm"] }
    wisps.clumping = [0.5, 0.6]
    head.mesh = ["none.obj"]
"#;

fn run(text: &str, folder: &Path) -> Run {
    let batch = Batch::parse("batch", text, Path::new("")).unwrap();
    Run::new(batch, folder, Shard::WHOLE).unwrap()
}

fn rows(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    reader.get_row_iter(None).unwrap().map(Result::unwrap).collect()
}

fn field<'a>(row: &'a Row, name: &str) -> &'a Field {
    row.get_column_iter().find(|(other, _)| *other == name).map(|(_, field)| field).unwrap()
}

#[test]
fn rows_have_all_of_a_head_or_why_there_is_none() {
    let text = TEXT.replace("head.mesh = [\"none.obj\"]", "");
    let folder = tempfile::tempdir().unwrap();
    let run = run(&text, folder.path());
    let done = run.all(&()).unwrap();
    assert!(done.failed > 0 && done.failed < 6, "{done:?}");
    let parts: Vec<_> = run.parts().map(|part| run.path(part)).collect();
    let all: Vec<Row> = parts.iter().flat_map(|path| rows(path)).collect();
    let mut failed = 0;
    for (index, row) in all.iter().enumerate() {
        assert_eq!(*field(row, "index"), Field::Long(index as i64));
        let Field::Double(length) = field(row, "hair.length") else { panic!("{row}") };
        let Field::Str(status) = field(row, "status") else { panic!("{row}") };
        match field(row, "guides") {
            Field::ListInternal(points) => {
                assert_eq!((points.len(), status.as_str()), (3 * 8 * 3, "ok"));
                assert_eq!(*field(row, "guide_count"), Field::Int(3));
                assert_eq!(*field(row, "error"), Field::Null);
                let Field::Double(drop) = field(row, "drop") else { panic!("{row}") };
                assert!((-1.0..=1.0).contains(drop));
                assert!(matches!(field(row, "scene"), Field::Str(text) if text.contains("[hair]")));
            }
            Field::Null => {
                assert!(*length < 1e-3 && status == "failed");
                assert_eq!(*field(row, "volume"), Field::Null);
                let Field::Str(error) = field(row, "error") else { panic!("{row}") };
                assert!(error.contains("must be between 1 mm and 3 m"), "{error}");
                failed += 1;
            }
            other => panic!("{other}"),
        }
    }
    assert_eq!((all.len(), failed), (6, done.failed));
    assert_eq!(run.all(&()).unwrap(), Done { heads: 6, before: 6, failed: 0 });
}

#[test]
fn a_head_whose_files_are_missing_fails_alone() {
    let folder = tempfile::tempdir().unwrap();
    let run = run(TEXT, folder.path());
    assert_eq!(run.all(&()).unwrap(), Done { heads: 6, before: 0, failed: 6 });
    let row = &rows(&run.path(run.parts().next().unwrap()))[0];
    let Field::Str(error) = field(row, "error") else { panic!("{row}") };
    assert!(error.contains("none.obj") || error.contains("1 mm"), "{error}");
}

/// Says to stop after so many heads.
struct Patience(AtomicUsize);

impl Progress for Patience {
    fn report(&self, _stage: &str, _fraction: f64) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) <= 1
    }
}

#[test]
fn what_is_stopped_keeps_whole_parts() {
    let text = TEXT.replace("head.mesh = [\"none.obj\"]", "").replace("rows = 4", "rows = 1");
    let folder = tempfile::tempdir().unwrap();
    let run = run(&text, folder.path());
    let stopped = run.all(&Patience(AtomicUsize::new(4)));
    assert!(matches!(stopped, Err(BatchError::Cancelled)), "{stopped:?}");
    let missing = run.missing().unwrap().len();
    assert!((1..6).contains(&missing), "{missing}");
    assert_eq!(run.all(&()).unwrap().before, 6 - missing);
}

/// Files of a folder with their bytes, and those of the folder of views.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    for inner in [folder.to_owned(), folder.join("_views")] {
        let entries = std::fs::read_dir(inner).unwrap().map(|entry| entry.unwrap().path());
        all.extend(entries.filter(|path| path.is_file()).map(|path| {
            (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(path).unwrap())
        }));
    }
    all.sort();
    all
}

#[test]
fn views_are_a_row_each_and_the_same_bytes_from_any_shards() {
    let text = TEXT.replace("head.mesh = [\"none.obj\"]", "");
    let text = text.replace(
        "[set]",
        "[views]\ncameras = [\"front\", { azimuth = \"50 deg\" }]\nsize = [40, 30]\n[set]",
    );
    let folder = tempfile::tempdir().unwrap();
    let whole = run(&text, folder.path());
    let done = whole.all(&()).unwrap();
    let expected = ["part-000000000", "part-000000004", "views-000000000", "views-000000004"];
    let names: Vec<String> = files(folder.path()).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, expected.map(|name| format!("{name}.parquet")));

    let mut views = 0;
    for part in whole.parts() {
        let heads = rows(&whole.path(part));
        let good: Vec<_> = heads.iter().filter(|row| *field(row, "error") == Field::Null).collect();
        let seen = rows(&whole.views_path(part).unwrap());
        assert_eq!(seen.len(), 2 * good.len());
        for (place, view) in seen.iter().enumerate() {
            assert_eq!(field(view, "index"), field(good[place / 2], "index"));
            assert_eq!(*field(view, "view"), Field::Int((place % 2) as i32));
            let bytes = |name: &str| match field(view, name) {
                Field::Bytes(bytes) => bytes.len(),
                other => panic!("{other}"),
            };
            let pixels = 40 * 30;
            let sizes = ["depth", "direction", "tangent", "strand", "guide"].map(bytes);
            assert_eq!(sizes, [4, 4, 6, 4, 4].map(|size| size * pixels));
            assert!(bytes("color") > 100 && bytes("mask") > 50 && bytes("body") > 50);
            views += 1;
        }
    }
    assert_eq!(views, 2 * (6 - done.failed));

    // A part without its views is made again, to the same bytes; so are shards.
    let before = files(folder.path());
    std::fs::remove_file(folder.path().join("_views/views-000000004.parquet")).unwrap();
    assert_eq!(whole.missing().unwrap().len(), 1);
    assert_eq!(whole.all(&()).unwrap().before, 4);
    assert!(files(folder.path()) == before);
    let other = tempfile::tempdir().unwrap();
    for shard in ["2/2", "1/2"] {
        let batch = Batch::parse("batch", text.as_str(), Path::new("")).unwrap();
        Run::new(batch, other.path(), shard.parse().unwrap()).unwrap().all(&()).unwrap();
    }
    assert!(files(other.path()) == before);
}
