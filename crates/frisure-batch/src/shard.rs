//! Shards: equal shares of a batch, each for one program or machine.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// Most shards; chosen.
const MOST: usize = 1_000_000;

/// One of several equal shares of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Index from 0.
    index: usize,
    count: usize,
}

/// Why a text is no shard.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ShardError {
    /// It is not two numbers.
    #[error("it must be two whole numbers with `/` between, such as 3/8, the third of eight")]
    NotTwoNumbers,
    /// The number is 0.
    #[error("shards are numbered from 1, as in 1/{of}; where a number counts from 0, add 1 to it")]
    Zero {
        /// Number of shards.
        of: usize,
    },
    /// The number is above that of the last shard.
    #[error("there is no shard {number} of {of}; the last is {of}/{of}")]
    Beyond {
        /// The number.
        number: usize,
        /// Number of shards.
        of: usize,
    },
    /// The number of shards is out of range.
    #[error("there may be 1 to {MOST} shards")]
    Count,
}

impl Shard {
    /// The whole batch.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Shard `number`, from 1, of `of` shards.
    ///
    /// # Errors
    /// [`ShardError`].
    pub fn new(number: usize, of: usize) -> Result<Self, ShardError> {
        match number {
            _ if !(1..=MOST).contains(&of) => Err(ShardError::Count),
            0 => Err(ShardError::Zero { of }),
            number if number > of => Err(ShardError::Beyond { number, of }),
            number => Ok(Self { index: number - 1, count: of }),
        }
    }

    /// Whether a part, by its index from 0, belongs to the shard. Shards take turns, since the cost of heads
    /// grows along a grid.
    #[must_use]
    pub fn has(self, part: usize) -> bool {
        part % self.count == self.index
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
        write!(f, "{}/{}", self.index + 1, self.count)
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
