//! How a key varies from head to head.

use frisure_digest::digest_fields;
use frisure_hairstyle::Draws;
use serde_spanned::Spanned;
use toml::Value as Toml;

use crate::kind::read_quantity;
use crate::quantity::Dimension;

/// What kind of values a varied key has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Numbers; SI units.
    Number,
    /// Whole numbers.
    Whole,
    /// True or false.
    Flag,
    /// Words, and whatever else is written as a scene writes it.
    Text,
}

/// One value of a varied key; SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Of [`Kind::Number`].
    Number(f64),
    /// Of [`Kind::Whole`].
    Whole(i64),
    /// Of [`Kind::Flag`].
    Flag(bool),
    /// Of [`Kind::Text`].
    Text(String),
}

/// A value, and how a scene writes it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Written {
    pub(super) value: Value,
    pub(super) literal: String,
}

/// A key that differs from head to head.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub(super) key: String,
    pub(super) kind: Kind,
    pub(super) way: Way,
}

/// How it differs; SI units.
#[derive(Clone, Debug)]
pub(super) enum Way {
    /// Each of some values at a place of the grid.
    Grid(Vec<Written>),
    /// One of some values, with the sum of all weights up to each.
    Choice { choices: Vec<Written>, sums: Vec<f64> },
    /// As likely everywhere in a range.
    Uniform { range: [f64; 2], scale: Scale, whole: bool },
    /// Normal on a scale, within limits.
    Normal { centre: f64, deviation: f64, limits: [f64; 2], scale: Scale, whole: bool },
    /// A column of a table: a value for each row that counts.
    Column { sheet: usize, cells: Vec<Written> },
}

/// The scale of differences.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    /// As they are.
    Linear,
    /// As ratios.
    Log,
}

digest_fields!(Kind: Number, Whole, Flag, Text);
digest_fields!(Value: Number(x), Whole(x), Flag(x), Text(x));
digest_fields!(Written { value, literal });
digest_fields!(Parameter { key, kind, way });
digest_fields!(Way:
    Grid(values),
    Choice { choices, sums },
    Uniform { range, scale, whole },
    Normal { centre, deviation, limits, scale, whole },
    Column { sheet, cells },
);
digest_fields!(Scale: Linear, Log);

impl Scale {
    fn to(self, x: f64) -> f64 {
        if self == Self::Log { x.ln() } else { x }
    }

    fn back(self, x: f64) -> f64 {
        if self == Self::Log { x.exp() } else { x }
    }
}

impl Written {
    /// A number, bare.
    pub(super) fn number(x: f64) -> Self {
        // `{:?}` is the shortest text that reads as the same number, and TOML.
        Self { value: Value::Number(x), literal: format!("{x:?}") }
    }

    /// A whole number.
    #[expect(clippy::cast_possible_truncation, reason = "counts are small")]
    pub(super) fn whole(x: f64) -> Self {
        let x = x.round() as i64;
        Self { value: Value::Whole(x), literal: x.to_string() }
    }

    /// A word.
    pub(super) fn word(word: &str) -> Self {
        Self { value: Value::Text(word.to_owned()), literal: quoted(word) }
    }

    /// What is written as a scene writes it, for a key of a dimension.
    pub(super) fn literal(text: &str, dimension: Option<&'static Dimension>) -> Self {
        let Some(toml) = understood(text) else { return Self::word(text) };
        let quantity = dimension.and_then(|dimension| read_quantity(&toml, dimension).ok());
        let value = match (quantity, toml) {
            (Some(x), _) | (None, Toml::Float(x)) => Value::Number(x),
            (None, Toml::Integer(i)) => Value::Whole(i),
            (None, Toml::Boolean(flag)) => Value::Flag(flag),
            (None, Toml::String(word)) => Value::Text(word),
            _ => Value::Text(text.to_owned()),
        };
        Self { value, literal: text.to_owned() }
    }

    pub(super) fn is_number(&self) -> bool {
        matches!(self.value, Value::Number(_) | Value::Whole(_))
    }

    /// The value as one of a kind that all values of its key have.
    #[expect(clippy::cast_precision_loss, reason = "as for any number with more than 15 digits")]
    pub(super) fn value_as(&self, kind: Kind) -> Value {
        match (kind, &self.value) {
            (Kind::Number, Value::Whole(i)) => Value::Number(*i as f64),
            (Kind::Text, Value::Text(word)) => Value::Text(word.clone()),
            (Kind::Text, _) => Value::Text(self.literal.clone()),
            (_, value) => value.clone(),
        }
    }
}

/// The kind that all of some values have.
pub(super) fn kind_of(all: &[Written]) -> Kind {
    let is = |fits: fn(&Value) -> bool| all.iter().all(|written| fits(&written.value));
    if is(|value| matches!(value, Value::Whole(_))) {
        Kind::Whole
    } else if is(|value| matches!(value, Value::Whole(_) | Value::Number(_))) {
        Kind::Number
    } else if is(|value| matches!(value, Value::Flag(_))) {
        Kind::Flag
    } else {
        Kind::Text
    }
}

impl Parameter {
    /// The values at the places of the grid, if it belongs to that.
    pub(super) fn cells(&self) -> Option<&[Written]> {
        match &self.way {
            Way::Grid(choices) => Some(choices),
            _ => None,
        }
    }
}

impl Way {
    /// A value for a head, `rows` being the row that it has of each table.
    pub(super) fn draw(&self, draws: &mut Draws, rows: &[usize]) -> Written {
        match self {
            Self::Grid(choices) => choices[draws.one_of(choices.len())].clone(),
            Self::Choice { choices, sums } => {
                let most = sums.last().copied().unwrap_or(1.0);
                let drawn = draws.between(0.0, most);
                let place = sums.partition_point(|sum| *sum <= drawn);
                choices[place.min(choices.len() - 1)].clone()
            }
            Self::Uniform { range: [from, to], whole: true, .. } => {
                Written::whole(draws.between(from - 0.5, to + 0.5).clamp(*from, *to))
            }
            Self::Uniform { range, scale, .. } => {
                let [from, to] = range.map(|x| scale.to(x));
                Written::number(scale.back(draws.between(from, to)).clamp(range[0], range[1]))
            }
            Self::Normal { centre, deviation, limits, scale, whole } => {
                let [low, high] = limits.map(|x| (scale.to(x) - scale.to(*centre)) / deviation);
                let x = scale.back(scale.to(*centre) + deviation * truncated(draws, low, high));
                let x = x.clamp(limits[0], limits[1]);
                if *whole { Written::whole(x) } else { Written::number(x) }
            }
            Self::Column { sheet, cells } => cells[rows[*sheet]].clone(),
        }
    }

    /// Values to try on the scene: the ends of a range, every choice, and of a
    /// column the extremes and the words.
    pub(super) fn ends(&self) -> Vec<Written> {
        let number =
            |whole: bool, x: f64| if whole { Written::whole(x) } else { Written::number(x) };
        match self {
            Self::Grid(choices) | Self::Choice { choices, .. } => extremes(choices),
            Self::Uniform { range, whole, .. } => range.map(|x| number(*whole, x)).to_vec(),
            Self::Normal { centre, limits, scale, whole, .. } => {
                let all = [limits[0], centre.clamp(limits[0], limits[1]), limits[1]].into_iter();
                // Without a limit a draw may be anything, and a head that cannot be is a failure of its own.
                let least = if *scale == Scale::Log { 0.0 } else { f64::NEG_INFINITY };
                let said = all.filter(|x| x.is_finite() && *x > least);
                said.map(|x| number(*whole, x)).collect()
            }
            Self::Column { cells, .. } => extremes(cells),
        }
    }
}

/// Most words of one key that are tried.
const MOST_WORDS: usize = 200;

/// Of some values the least and the largest number, and everything else once.
fn extremes(all: &[Written]) -> Vec<Written> {
    let size = |written: &Written| match written.value {
        Value::Number(x) => Some(x),
        Value::Whole(i) => Some(i as f64),
        _ => None,
    };
    let numbers = || all.iter().filter_map(|written| size(written).map(|x| (x, written)));
    let least = numbers().min_by(|a, b| a.0.total_cmp(&b.0));
    let most = numbers().max_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<Written> = least.into_iter().chain(most).map(|(_, w)| w.clone()).collect();
    for written in all.iter().filter(|written| size(written).is_none()) {
        if found.len() > MOST_WORDS {
            break;
        }
        if !found.contains(written) {
            found.push(written.clone());
        }
    }
    found
}

/// Width (deviations) below which a range is hit more often by trying all of it than by trying the curve.
const NARROW: f64 = 2.5;

/// Most tries; the ranges that are accepted are never so rare.
const MOST_TRIES: usize = 1_000_000;

/// Standard normal between two limits, by rejection.
fn truncated(draws: &mut Draws, low: f64, high: f64) -> f64 {
    let narrow = high - low < NARROW;
    // Where in the range it is likeliest.
    let peak = 0.0_f64.clamp(low, high);
    for _ in 0..MOST_TRIES {
        let x = if narrow { draws.between(low, high) } else { draws.gaussian() };
        let kept = match narrow {
            true => draws.unit() < (0.5 * (peak * peak - x * x)).exp(),
            false => (low..=high).contains(&x),
        };
        if kept {
            return x;
        }
    }
    peak
}

/// A text as TOML has it.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// What a literal is, if it is TOML.
pub(super) fn understood(text: &str) -> Option<Toml> {
    #[derive(serde::Deserialize)]
    struct One {
        value: Spanned<Toml>,
    }
    let one: One = toml::from_str(&format!("value = {text}")).ok()?;
    Some(one.value.into_inner())
}

/// The word that a literal is.
pub(super) fn word(literal: &str) -> Option<String> {
    understood(literal)?.as_str().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(low: f64, high: f64) -> Vec<f64> {
        (0..20_000).map(|i| truncated(&mut Draws::new(1, "a", i), low, high)).collect()
    }

    /// Mean of the standard normal between limits: (φ(a) − φ(b)) / (Φ(b) − Φ(a)), tables of the normal
    /// distribution.
    #[test]
    fn a_truncated_normal_has_its_mean() {
        for (low, high, mean) in [
            (f64::NEG_INFINITY, f64::INFINITY, 0.0),
            (0.0, f64::INFINITY, 0.797_885),
            (-1.0, 1.0, 0.0),
            (1.0, 2.0, 1.383_154),
            (-0.5, 3.0, 0.503_735),
            (2.0, f64::INFINITY, 2.373_216),
        ] {
            let all = drawn(low, high);
            assert!(all.iter().all(|x| (low..=high).contains(x)));
            let found = all.iter().sum::<f64>() / all.len() as f64;
            assert!((found - mean).abs() < 0.02, "{low} to {high}: {found}");
        }
    }

    #[test]
    fn whole_numbers_are_all_as_likely() {
        let way = Way::Uniform { range: [2.0, 4.0], scale: Scale::Linear, whole: true };
        let mut counts = [0; 3];
        for i in 0..3000 {
            let Value::Whole(x) = way.draw(&mut Draws::new(3, "b", i), &[]).value else { panic!() };
            counts[usize::try_from(x - 2).unwrap()] += 1;
        }
        assert!(counts.iter().all(|count| (900..1100).contains(count)), "{counts:?}");
    }

    #[test]
    fn choices_have_their_weights() {
        let choices = ["a", "b", "c"].map(Written::word).to_vec();
        let way = Way::Choice { choices, sums: vec![1.0, 1.0, 4.0] };
        let words = (0..4000).map(|i| way.draw(&mut Draws::new(1, "c", i), &[]).literal);
        let words: Vec<String> = words.collect();
        let count = |word: &str| words.iter().filter(|w| *w == word).count();
        assert_eq!(count("\"b\""), 0);
        assert!((900..1100).contains(&count("\"a\"")));
    }

    #[test]
    fn literals_are_read_as_the_scene_reads_them() {
        use crate::quantity::LENGTH;
        let value = |text, dimension| Written::literal(text, dimension).value;
        assert_eq!(value("\"25 cm\"", Some(&LENGTH)), Value::Number(0.25));
        assert_eq!(value("1", Some(&LENGTH)), Value::Number(1.0));
        assert_eq!(value("1", None), Value::Whole(1));
        assert_eq!(value("'left'", Some(&LENGTH)), Value::Text("left".into()));
        assert_eq!(value("[1, 2]", None), Value::Text("[1, 2]".into()));
        let mixed = [Written::whole(1.0), Written::number(0.5)];
        assert_eq!(kind_of(&mixed), Kind::Number);
        assert_eq!(kind_of(&[Written::word("a"), Written::number(1.0)]), Kind::Text);
    }
}
