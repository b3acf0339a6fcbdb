//! Which parts of a batch are one program's.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// Most shards.
const MOST: usize = 1_000_000;

/// One of several equal shares of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 0.
    number: usize,
    of: usize,
}

/// Why a text names no shard.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ShardError {
    /// It is not two numbers.
    #[error("it must be two whole numbers with `/` between, such as 3/8, the third of eight")]
    NotTwoNumbers,
    /// It counts from 0.
    #[error("shards are numbered from 1, as in 1/{of}; where a number counts from 0, add 1 to it")]
    Zero {
        /// How many there are.
        of: usize,
    },
    /// There is no such shard.
    #[error("there is no shard {number} of {of}; the last is {of}/{of}")]
    Beyond {
        /// The number asked for.
        number: usize,
        /// How many there are.
        of: usize,
    },
    /// There are too many or none.
    #[error("there may be 1 to {MOST} shards")]
    Count,
}

impl Shard {
    /// All of a batch.
    pub const WHOLE: Self = Self { number: 0, of: 1 };

    /// The shard of a number, from 1, of so many.
    ///
    /// # Errors
    /// [`ShardError`].
    pub fn new(number: usize, of: usize) -> Result<Self, ShardError> {
        match number {
            _ if !(1..=MOST).contains(&of) => Err(ShardError::Count),
            0 => Err(ShardError::Zero { of }),
            number if number > of => Err(ShardError::Beyond { number, of }),
            number => Ok(Self { number: number - 1, of }),
        }
    }

    /// Whether a part is its, by the part's number from 0. Shards take turns, since the heads of a grid
    /// grow dearer from its one end to the other.
    #[must_use]
    pub fn has(self, part: usize) -> bool {
        part % self.of == self.number
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let (number, of) = text.split_once('/').ok_or(ShardError::NotTwoNumbers)?;
        let read = |text: &str| text.trim().parse().map_err(|_| ShardError::NotTwoNumbers);
        Self::new(read(number)?, read(of)?)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number + 1, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_one_shards() {
        for of in 1..9 {
            let shards: Vec<Shard> = (1..=of).map(|i| Shard::new(i, of).unwrap()).collect();
            for part in 0..40 {
                assert_eq!(shards.iter().filter(|shard| shard.has(part)).count(), 1);
            }
        }
    }

    #[test]
    fn texts_are_understood_or_refused_with_a_reason() {
        assert_eq!("3/8".parse(), Shard::new(3, 8));
        assert_eq!(Shard::new(3, 8).unwrap().to_string(), "3/8");
        for (text, part) in [
            ("3", "two whole numbers"),
            ("a/2", "two whole numbers"),
            ("-1/2", "two whole numbers"),
            ("0/4", "from 1"),
            ("5/4", "the last is 4/4"),
            ("1/0", "1 to 1000000"),
            ("1/99999999", "1 to 1000000"),
        ] {
            let error = text.parse::<Shard>().unwrap_err().to_string();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
