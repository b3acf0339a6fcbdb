//! A batch: the heads of each number.

use std::path::{Path, PathBuf};

use frisure_hairstyle::Draws;

use super::sheet::Sheet;
use super::views::Views;
use super::way::{self, Kind, Parameter, Value, Written};
use crate::edit::{EditError, set_key, set_keys};
use crate::key_groups::PATHS;
use crate::scene::Scene;
use crate::source::Source;
use frisure_digest::Digest;

/// Most heads of a batch.
pub const MOST_HEADS: usize = 1_000_000_000;

/// The stream of scenes' seeds.
pub(super) const SEED: &str = "seed";

/// Many scenes; every key and range was checked.
#[derive(Clone, Debug)]
pub struct Batch {
    pub(super) source: Source,
    pub(super) base: Scene,
    /// Where the base scene is, and with it what paths in it begin from.
    pub(super) folder: PathBuf,
    pub(super) seed: u64,
    pub(super) same_seed: bool,
    /// Draws for each place of the grid.
    pub(super) samples: usize,
    pub(super) rows: usize,
    pub(super) points: Option<usize>,
    pub(super) volume: bool,
    pub(super) views: Option<Views>,
    /// Keys that are the same for all heads.
    pub(super) fixed: Vec<(String, String)>,
    /// Keys of the grid, then those that are drawn.
    pub(super) parameters: Vec<Parameter>,
    pub(super) sheets: Vec<Sheet>,
    pub(super) digest: [u8; 16],
}

/// One head of a batch, described.
#[derive(Debug)]
pub struct Sample {
    /// Its number.
    pub index: usize,
    /// What drives the randomness of its scene.
    pub seed: u64,
    /// What it has of each of [`Batch::parameters`]; SI units.
    pub values: Vec<Value>,
    /// The text of its scene, or why there is none.
    pub text: Result<String, EditError>,
}

impl Batch {
    /// How many heads it has.
    #[must_use]
    pub fn heads(&self) -> usize {
        self.cells() * self.samples
    }

    /// How many heads there are in a file of them.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Points of each guide, if the batch gives a number.
    #[must_use]
    pub fn points(&self) -> Option<usize> {
        self.points
    }

    /// Whether the volume of the hair is measured.
    #[must_use]
    pub fn volume(&self) -> bool {
        self.volume
    }

    /// The pictures of each head, if it has any.
    #[must_use]
    pub fn views(&self) -> Option<&Views> {
        self.views.as_ref()
    }

    /// Where paths in its scenes begin from.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The files that it was read from, but for its own.
    #[must_use]
    pub fn inputs(&self) -> Vec<&Path> {
        let tables = self.sheets.iter().map(|sheet| sheet.table.path.as_path());
        tables.chain(Some(Path::new(&self.base.source.name))).collect()
    }

    /// The keys that differ from head to head, and what kind of values they have: of the grid first, then
    /// those that are drawn, each in the order in which they are written.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, Kind)> {
        self.parameters.iter().map(|parameter| (parameter.key.as_str(), parameter.kind))
    }

    /// A digest of this batch: 32 hexadecimal digits over its parameters, its scene, the files that
    /// this reads, and the version of this program. How many heads there are does not count, since the others
    /// stay the same.
    #[must_use]
    pub fn digest(&self) -> String {
        frisure_digest::hexadecimal(self.digest)
    }

    /// The head of a number less than [`Self::heads`].
    #[must_use]
    pub fn sample(&self, index: usize) -> Sample {
        let drawn = self.drawn(index);
        let values = self.parameters.iter().zip(&drawn).map(|(p, w)| w.value_as(p.kind)).collect();
        let written = drawn.iter().map(|written| written.literal.clone()).collect::<Vec<_>>();
        Sample {
            index,
            seed: self.seed_of(index, &drawn),
            values,
            text: self.text(index, &written),
        }
    }

    /// The same as a scene in another folder: paths in it are absolute.
    ///
    /// # Errors
    /// [`EditError`], where there is no such scene.
    pub fn scene_elsewhere(&self, index: usize) -> Result<String, EditError> {
        let mut text = self.sample(index).text?;
        for key in PATHS {
            let source = Source { name: String::new(), text };
            let value = source.find(key).map(|(span, _)| source.slice(span).to_owned());
            text = source.text;
            if let Some(path) = value.as_deref().and_then(way::word) {
                let whole = std::path::absolute(self.folder.join(&path));
                let whole = whole.unwrap_or_else(|_| self.folder.join(&path));
                text = set_key(&text, key, &way::quoted(&whole.to_string_lossy()))?;
            }
        }
        Ok(text)
    }

    /// What of each parameter the head of a number has.
    pub(super) fn drawn(&self, index: usize) -> Vec<Written> {
        let rows: Vec<usize> =
            self.sheets.iter().map(|sheet| sheet.row(self.seed, index)).collect();
        let mut cell = index % self.cells();
        let mut drawn: Vec<Written> = Vec::with_capacity(self.parameters.len());
        // The last of the grid changes from head to head.
        for parameter in self.parameters.iter().rev() {
            drawn.push(match parameter.cells() {
                Some(choices) => {
                    let place = cell % choices.len();
                    cell /= choices.len();
                    choices[place].clone()
                }
                None => {
                    let mut draws = Draws::new(self.seed, &parameter.key, index);
                    parameter.way.draw(&mut draws, &rows)
                }
            });
        }
        drawn.reverse();
        drawn
    }

    /// The scene with a literal for each parameter.
    pub(super) fn text(&self, index: usize, literals: &[String]) -> Result<String, EditError> {
        let mut changes: Vec<(&str, Option<&str>)> = Vec::new();
        changes.extend(self.fixed.iter().map(|(key, value)| (key.as_str(), Some(value.as_str()))));
        let varied = self.parameters.iter().zip(literals);
        changes
            .extend(varied.map(|(parameter, text)| (parameter.key.as_str(), Some(text.as_str()))));
        let seed = self.own_seed(index).map(|seed| seed.to_string());
        changes.extend(seed.as_deref().map(|seed| (SEED, Some(seed))));
        set_keys(self.base.text(), &changes)
    }

    /// The seed that is drawn for a head, if the batch does not give it.
    fn own_seed(&self, index: usize) -> Option<u64> {
        let said = self.fixed.iter().any(|(key, _)| key == SEED)
            || self.parameters.iter().any(|parameter| parameter.key == SEED);
        (!said && !self.same_seed).then(|| Draws::new(self.seed, SEED, index).seed())
    }

    /// The seed that a head has.
    fn seed_of(&self, index: usize, drawn: &[Written]) -> u64 {
        let varied = self.parameters.iter().zip(drawn).find(|(p, _)| p.key == SEED);
        let fixed = self.fixed.iter().find(|(key, _)| key == SEED).map(|(_, text)| text.as_str());
        let literal = varied.map(|(_, written)| written.literal.as_str()).or(fixed);
        let said = literal.and_then(|text| text.replace('_', "").parse().ok());
        self.own_seed(index).or(said).unwrap_or(self.base.spec.seed)
    }

    /// Places of the grid.
    fn cells(&self) -> usize {
        self.parameters.iter().filter_map(Parameter::cells).map(<[Written]>::len).product()
    }

    pub(super) fn digest_with(&self, files: &[Vec<u8>]) -> [u8; 16] {
        let Self { seed, same_seed, rows, points, volume, views, fixed, parameters, .. } = self;
        let mut digest = Digest::new("batch");
        digest
            .field("version", env!("CARGO_PKG_VERSION"))
            .field("seed", seed)
            .field("same_seed", same_seed)
            .field("rows", rows)
            .field("points", points)
            .field("volume", volume)
            .field("fixed", fixed)
            .field("parameters", parameters)
            .field("scene", self.base.text())
            .field("files", files);
        // Folders of batches without pictures stay valid.
        if let Some(views) = views {
            digest.field("views", views);
        }
        digest.bytes()
    }
}
