//! Values of a binary file.

use half::f16;

use super::compressed::unpack_integers;
use super::structure::{Budget, Bytes, Structure};
use super::{FEW, KINDS, Rep, code};
use crate::value::{Base, Data, Kind, Shape, Value};

/// A file whose values are read.
pub(super) struct Source<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) structure: Structure,
    pub(super) budget: Budget,
}

impl Source<'_> {
    /// A plain value; none of what is none (blocks, dictionaries, …).
    pub(super) fn value(&mut self, rep: Rep) -> Result<Option<Value>, String> {
        let Some((_, kind)) = KINDS.iter().find(|(code, _)| *code == rep.code()) else {
            return Ok(None);
        };
        if rep.has(Rep::EDIT) {
            return Err("it edits an array of another layer".into());
        }
        if rep.has(Rep::ARRAY) {
            return self.array(rep, *kind).map(Some);
        }
        let data = if rep.has(Rep::INLINED) {
            self.inlined(rep, *kind)?
        } else {
            let mut here = Bytes::new(self.bytes, rep.payload())?;
            self.raw(&mut here, *kind, 1)?
        };
        Ok(Some(Value { kind: *kind, array: false, data }))
    }

    /// The first of samples in time.
    pub(super) fn first_sample(&mut self, rep: Rep) -> Result<Option<Value>, String> {
        if rep.code() != code::TIME_SAMPLES || rep.has(Rep::INLINED) {
            return Ok(None);
        }
        let mut here = Bytes::new(self.bytes, rep.payload())?;
        // Times, then values.
        here.follow()?;
        here.u64()?;
        here.follow()?;
        if here.u64()? == 0 {
            return Ok(None);
        }
        let first = Rep(here.u64()?);
        self.value(first)
    }

    /// Indices of words, of a list or of a change to one.
    pub(super) fn words(&mut self, rep: Rep) -> Result<Vec<String>, String> {
        let indices = match rep.code() {
            code::TOKEN_VECTOR => Bytes::new(self.bytes, rep.payload())?.indices()?,
            code::TOKEN_LIST_OP => self.list(rep)?,
            _ => Vec::new(),
        };
        let mut words = Vec::new();
        for i in indices {
            let word = self.structure.word(i)?;
            // Many lists can be the same bytes.
            self.budget.take(word.len() as u64 + 24, 1)?;
            words.push(word.to_owned());
        }
        Ok(words)
    }

    /// Indices of paths.
    pub(super) fn paths(&mut self, rep: Rep) -> Result<Vec<u32>, String> {
        let paths = if rep.code() == code::PATH_LIST_OP { self.list(rep)? } else { Vec::new() };
        self.budget.take(paths.len() as u64, 4)?;
        Ok(paths)
    }

    /// What a change to a list has in it, but for what it takes out.
    fn list(&self, rep: Rep) -> Result<Vec<u32>, String> {
        let mut here = Bytes::new(self.bytes, rep.payload())?;
        let flags = here.u8()?;
        let mut all = Vec::new();
        // Explicit, added, prepended, appended, deleted, ordered, as they follow.
        for (flag, counts) in [(1, true), (2, true), (5, true), (6, true), (3, false), (4, false)] {
            if flags & (1 << flag) != 0 {
                let items = here.indices()?;
                if counts {
                    all.extend(items);
                }
            }
        }
        Ok(all)
    }

    #[expect(clippy::cast_possible_truncation, reason = "the low bytes of the payload")]
    fn inlined(&self, rep: Rep, kind: Kind) -> Result<Data, String> {
        let payload = rep.payload() as u32;
        if let Shape::Matrix(n) = kind.shape {
            // Only a diagonal of small numbers.
            let mut all = vec![0.0; n * n];
            for (i, b) in payload.to_le_bytes().into_iter().take(n).enumerate() {
                all[i * n + i] = f64::from(b.cast_signed());
            }
            return Ok(Data::F64(all));
        }
        if kind.shape != Shape::One {
            let small = payload.to_le_bytes().map(u8::cast_signed);
            let small = &small[..kind.width()];
            return Ok(match Data::empty(kind.base) {
                Data::I32(_) => Data::I32(small.iter().map(|&x| x.into()).collect()),
                Data::F32(_) => Data::F32(small.iter().map(|&x| x.into()).collect()),
                _ => Data::F64(small.iter().map(|&x| x.into()).collect()),
            });
        }
        Ok(match kind.base {
            Base::Bool | Base::UChar => Data::I32(vec![(payload & 0xff).cast_signed()]),
            Base::Int => Data::I32(vec![payload.cast_signed()]),
            Base::UInt | Base::UInt64 => Data::I64(vec![payload.into()]),
            Base::Int64 => Data::I64(vec![payload.cast_signed().into()]),
            Base::Half => Data::F32(vec![f16::from_bits(payload as u16).to_f32()]),
            Base::Float => Data::F32(vec![f32::from_bits(payload)]),
            Base::Double | Base::TimeCode => Data::F64(vec![f32::from_bits(payload).into()]),
            Base::String => Data::Words(vec![self.string(payload)?]),
            Base::Token | Base::Asset => Data::Words(vec![self.structure.word(payload)?.into()]),
        })
    }

    fn string(&self, index: u32) -> Result<String, String> {
        let strings = &self.structure.strings;
        let word = strings.get(index as usize);
        let word = word
            .ok_or_else(|| format!("it names string {index}, and there are {}", strings.len()))?;
        Ok(self.structure.word(*word)?.into())
    }

    fn array(&mut self, rep: Rep, kind: Kind) -> Result<Value, String> {
        let empty = Value { kind, array: true, data: Data::empty(kind.base) };
        if rep.payload() == 0 {
            return Ok(empty);
        }
        let mut here = Bytes::new(self.bytes, rep.payload())?;
        let minor = self.structure.version;
        if minor < 5 {
            // How many dimensions it has: one.
            here.u32()?;
        }
        let count = if minor < 7 { u64::from(here.u32()?) } else { here.u64()? };
        let data = if rep.has(Rep::COMPRESSED) && count >= FEW {
            self.packed(&mut here, kind, count)?
        } else {
            self.raw(&mut here, kind, count)?
        };
        Ok(Value { data, ..empty })
    }

    /// Values as they lie in memory elsewhere.
    fn raw(&mut self, here: &mut Bytes, kind: Kind, count: u64) -> Result<Data, String> {
        let size = match kind.base {
            Base::Bool | Base::UChar => 1,
            Base::Half => 2,
            Base::Int | Base::UInt | Base::Float => 4,
            Base::String | Base::Token | Base::Asset => 4,
            Base::Int64 | Base::UInt64 | Base::Double | Base::TimeCode => 8,
        };
        let count = count.saturating_mul(kind.width() as u64);
        let bytes = here.take(count.saturating_mul(size))?;
        let kept = match Data::empty(kind.base) {
            Data::Words(_) => size_of::<String>(),
            Data::I64(_) | Data::F64(_) => 8,
            _ => 4,
        };
        self.budget.take(count, kept)?;
        let mut data = match kind.base {
            Base::Bool | Base::UChar => Data::I32(bytes.iter().map(|&b| b.into()).collect()),
            Base::Int => Data::I32(each(bytes, i32::from_le_bytes)),
            Base::UInt => Data::I64(each(bytes, |b| u32::from_le_bytes(b).into())),
            Base::Int64 | Base::UInt64 => Data::I64(each(bytes, i64::from_le_bytes)),
            Base::Half => Data::F32(each(bytes, |b| f16::from_le_bytes(b).to_f32())),
            Base::Float => Data::F32(each(bytes, f32::from_le_bytes)),
            Base::Double | Base::TimeCode => Data::F64(each(bytes, f64::from_le_bytes)),
            Base::Token => Data::Words(
                self.all_words(bytes, |file, i| file.structure.word(i).map(str::to_owned))?,
            ),
            Base::String | Base::Asset => Data::Words(self.all_words(bytes, Self::string)?),
        };
        if kind.shape == Shape::Quaternion {
            real_first(&mut data);
        }
        Ok(data)
    }

    fn all_words(
        &mut self,
        indices: &[u8],
        word: impl Fn(&Self, u32) -> Result<String, String>,
    ) -> Result<Vec<String>, String> {
        let mut all = Vec::new();
        for b in indices.as_chunks().0 {
            let word = word(self, u32::from_le_bytes(*b))?;
            // One long word can be named many times.
            self.budget.take(word.len() as u64, 1)?;
            all.push(word);
        }
        Ok(all)
    }

    /// Compressed numbers.
    fn packed(&mut self, here: &mut Bytes, kind: Kind, count: u64) -> Result<Data, String> {
        if kind.shape != Shape::One {
            return Err("tuples cannot be compressed".into());
        }
        match kind.base {
            Base::Int | Base::UInt | Base::Int64 | Base::UInt64 => {
                self.whole(here, kind.base, count)
            }
            Base::Half | Base::Float | Base::Double => self.floats(here, kind, count),
            _ => Err("only numbers can be compressed".into()),
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "as its type has it"
    )]
    fn whole(&mut self, here: &mut Bytes, base: Base, count: u64) -> Result<Data, String> {
        let packed = here.sized()?;
        let wide = matches!(base, Base::Int64 | Base::UInt64);
        let count = self.budget.take(count, if base == Base::Int { 4 } else { 8 })?;
        if base == Base::Int {
            let mut all = Vec::new();
            unpack_integers(packed, count, wide, |x| all.push(x as i32))?;
            return Ok(Data::I32(all));
        }
        let mut all = Vec::new();
        let unsigned = base == Base::UInt;
        unpack_integers(packed, count, wide, |x| {
            all.push(if unsigned { i64::from(x as u32) } else { x });
        })?;
        Ok(Data::I64(all))
    }

    /// Numbers that are whole, or of which few differ.
    #[expect(clippy::cast_precision_loss, reason = "they are floats")]
    fn floats(&mut self, here: &mut Bytes, kind: Kind, count: u64) -> Result<Data, String> {
        let how = here.u8()?;
        let table = match how {
            b'i' => None,
            b't' => {
                let n = here.u32()?;
                Some(self.raw(here, kind, n.into())?)
            }
            other => return Err(format!("its floats are compressed in an unknown way, {other}")),
        };
        let packed = here.sized()?;
        let wide = matches!(Data::empty(kind.base), Data::F64(_));
        let count = self.budget.take(count, if wide { 8 } else { 4 })?;
        let mut missing = None;
        let mut look = |i: i64, n: usize| {
            let found = usize::try_from(i).ok().filter(|&i| i < n);
            if found.is_none() {
                missing = Some(i);
            }
            found.unwrap_or(0)
        };
        let data = match table {
            None if wide => {
                let mut all = Vec::new();
                unpack_integers(packed, count, false, |x| all.push(x as f64))?;
                Data::F64(all)
            }
            None => {
                let mut all = Vec::new();
                unpack_integers(packed, count, false, |x| all.push(x as f32))?;
                Data::F32(all)
            }
            Some(Data::F64(t)) => {
                let mut all = Vec::new();
                let mut at = |x| all.push(t.get(look(x, t.len())).copied().unwrap_or(0.0));
                unpack_integers(packed, count, false, &mut at)?;
                Data::F64(all)
            }
            Some(Data::F32(t)) => {
                let mut all = Vec::new();
                let mut at = |x| all.push(t.get(look(x, t.len())).copied().unwrap_or(0.0));
                unpack_integers(packed, count, false, &mut at)?;
                Data::F32(all)
            }
            Some(other) => other,
        };
        match missing {
            Some(i) => Err(format!("its floats name {i} of a table that is shorter")),
            None => Ok(data),
        }
    }
}

fn each<const N: usize, T>(bytes: &[u8], value: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks().0.iter().map(|b| value(*b)).collect()
}

/// Quaternions lie in memory with their real part last.
fn real_first(data: &mut Data) {
    match data {
        Data::F32(v) => v.chunks_exact_mut(4).for_each(|q| q.rotate_right(1)),
        Data::F64(v) => v.chunks_exact_mut(4).for_each(|q| q.rotate_right(1)),
        _ => {}
    }
}
