//! Values of a binary file.

use half::f16;

use super::compressed::unpack_integers;
use super::structure::{Budget, Bytes, Structure};
use super::{FEW, ValueRep, code};
use crate::value::{Data, ScalarType, Shape, TYPES, Value, ValueType};

/// A file whose values are read.
pub(super) struct Source<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) structure: Structure,
    pub(super) budget: Budget,
}

impl Source<'_> {
    /// A plain value; none of other types (blocks, dictionaries, …).
    pub(super) fn value(&mut self, rep: ValueRep) -> Result<Option<Value>, String> {
        let Some((.., ty)) = TYPES.iter().find(|(code, ..)| *code == rep.code()) else {
            return Ok(None);
        };
        if rep.has(ValueRep::EDIT) {
            return Err("it edits an array of another layer".into());
        }
        if rep.has(ValueRep::ARRAY) {
            return self.array(rep, *ty).map(Some);
        }
        let data = if rep.has(ValueRep::INLINED) {
            self.inlined(rep, *ty)?
        } else {
            let mut here = Bytes::new(self.bytes, rep.payload())?;
            self.raw(&mut here, *ty, 1)?
        };
        Ok(Some(Value { ty: *ty, array: false, data }))
    }

    /// The first of samples in time.
    pub(super) fn first_sample(&mut self, rep: ValueRep) -> Result<(Option<Value>, usize), String> {
        if rep.code() != code::TIME_SAMPLES || rep.has(ValueRep::INLINED) {
            return Ok((None, 0));
        }
        let mut here = Bytes::new(self.bytes, rep.payload())?;
        // Times, then values.
        here.follow()?;
        here.u64()?;
        here.follow()?;
        let times = here.u64()?;
        if times == 0 {
            return Ok((None, 0));
        }
        let first = ValueRep(here.u64()?);
        Ok((self.value(first)?, usize::try_from(times).unwrap_or(usize::MAX)))
    }

    /// Indices of words, of a list or of a change to one.
    pub(super) fn words(&mut self, rep: ValueRep) -> Result<Vec<String>, String> {
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
    pub(super) fn paths(&mut self, rep: ValueRep) -> Result<Vec<u32>, String> {
        let paths = if rep.code() == code::PATH_LIST_OP { self.list(rep)? } else { Vec::new() };
        self.budget.take(paths.len() as u64, 4)?;
        Ok(paths)
    }

    /// The items of a list edit, without those that it deletes.
    fn list(&self, rep: ValueRep) -> Result<Vec<u32>, String> {
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

    fn inlined(&mut self, rep: ValueRep, ty: ValueType) -> Result<Data, String> {
        let payload = rep.payload() as u32;
        let bytes = payload.to_le_bytes();
        if let Shape::Matrix(n) = ty.shape {
            // Only a diagonal of small numbers.
            let mut all = vec![0.0; n * n];
            for (i, b) in bytes.into_iter().take(n).enumerate() {
                all[i * n + i] = f64::from(b.cast_signed());
            }
            return Ok(Data::F64(all));
        }
        if ty.shape != Shape::One {
            let small = bytes.map(u8::cast_signed);
            let small = &small[..ty.width()];
            return Ok(match Data::empty(ty.scalar) {
                Data::I32(_) => Data::I32(small.iter().map(|&x| x.into()).collect()),
                Data::F32(_) => Data::F32(small.iter().map(|&x| x.into()).collect()),
                _ => Data::F64(small.iter().map(|&x| x.into()).collect()),
            });
        }
        // Wide numbers are inlined where a narrower type has them exactly.
        match ty.scalar {
            ScalarType::UInt64 => Ok(Data::I64(vec![payload.into()])),
            ScalarType::Int64 => Ok(Data::I64(vec![payload.cast_signed().into()])),
            ScalarType::Double | ScalarType::TimeCode => {
                Ok(Data::F64(vec![f32::from_bits(payload).into()]))
            }
            scalar => self.scalars(&bytes[..size(scalar)], scalar),
        }
    }

    fn string(&self, index: u32) -> Result<String, String> {
        let strings = &self.structure.strings;
        let word = strings.get(index as usize);
        let word = word
            .ok_or_else(|| format!("it names string {index}, and there are {}", strings.len()))?;
        Ok(self.structure.word(*word)?.into())
    }

    fn array(&mut self, rep: ValueRep, ty: ValueType) -> Result<Value, String> {
        let empty = Value { ty, array: true, data: Data::empty(ty.scalar) };
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
        let data = if rep.has(ValueRep::COMPRESSED) && count >= FEW {
            self.packed(&mut here, ty, count)?
        } else {
            self.raw(&mut here, ty, count)?
        };
        Ok(Value { data, ..empty })
    }

    /// Values that are not compressed.
    fn raw(&mut self, here: &mut Bytes, ty: ValueType, count: u64) -> Result<Data, String> {
        let count = count.saturating_mul(ty.width() as u64);
        let bytes = here.take(count.saturating_mul(size(ty.scalar) as u64))?;
        let kept = match Data::empty(ty.scalar) {
            Data::Words(_) => size_of::<String>(),
            Data::I64(_) | Data::F64(_) => 8,
            _ => 4,
        };
        self.budget.take(count, kept)?;
        let mut data = self.scalars(bytes, ty.scalar)?;
        if ty.shape == Shape::Quaternion {
            real_first(&mut data);
        }
        Ok(data)
    }

    fn scalars(&mut self, bytes: &[u8], scalar: ScalarType) -> Result<Data, String> {
        Ok(match scalar {
            ScalarType::Bool | ScalarType::UChar => {
                Data::I32(bytes.iter().map(|&b| b.into()).collect())
            }
            ScalarType::Int => Data::I32(each(bytes, i32::from_le_bytes)),
            ScalarType::UInt => Data::I64(each(bytes, |b| u32::from_le_bytes(b).into())),
            ScalarType::Int64 | ScalarType::UInt64 => Data::I64(each(bytes, i64::from_le_bytes)),
            ScalarType::Half => Data::F32(each(bytes, |b| f16::from_le_bytes(b).to_f32())),
            ScalarType::Float => Data::F32(each(bytes, f32::from_le_bytes)),
            ScalarType::Double | ScalarType::TimeCode => Data::F64(each(bytes, f64::from_le_bytes)),
            ScalarType::Token => Data::Words(
                self.all_words(bytes, |file, i| file.structure.word(i).map(str::to_owned))?,
            ),
            ScalarType::String | ScalarType::Asset => {
                Data::Words(self.all_words(bytes, Self::string)?)
            }
        })
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
    fn packed(&mut self, here: &mut Bytes, ty: ValueType, count: u64) -> Result<Data, String> {
        if ty.shape != Shape::One {
            return Err("tuples cannot be compressed".into());
        }
        match ty.scalar {
            ScalarType::Int | ScalarType::UInt | ScalarType::Int64 | ScalarType::UInt64 => {
                self.packed_integers(here, ty.scalar, count)
            }
            ScalarType::Half | ScalarType::Float | ScalarType::Double => {
                self.packed_floats(here, ty, count)
            }
            _ => Err("only numbers can be compressed".into()),
        }
    }

    fn packed_integers(
        &mut self,
        here: &mut Bytes,
        scalar: ScalarType,
        count: u64,
    ) -> Result<Data, String> {
        let packed = here.sized()?;
        let is_wide = matches!(scalar, ScalarType::Int64 | ScalarType::UInt64);
        let count = self.budget.take(count, if scalar == ScalarType::Int { 4 } else { 8 })?;
        let all = unpack_integers(packed, count, is_wide)?;
        Ok(match scalar {
            ScalarType::Int => Data::I32(all.iter().map(|&x| x as i32).collect()),
            ScalarType::UInt => Data::I64(all.iter().map(|&x| i64::from(x as u32)).collect()),
            _ => Data::I64(all),
        })
    }

    /// Numbers that are integers, or of which few differ.
    fn packed_floats(
        &mut self,
        here: &mut Bytes,
        ty: ValueType,
        count: u64,
    ) -> Result<Data, String> {
        let table = match here.u8()? {
            b'i' => None,
            b't' => {
                let n = here.u32()?;
                Some(self.raw(here, ty, n.into())?)
            }
            other => return Err(format!("its floats are compressed in an unknown way, {other}")),
        };
        let packed = here.sized()?;
        let is_double = ty.scalar == ScalarType::Double;
        let count = self.budget.take(count, if is_double { 8 } else { 4 })?;
        let integers = unpack_integers(packed, count, false)?;
        Ok(match table {
            None if is_double => Data::F64(integers.iter().map(|&x| x as f64).collect()),
            None => Data::F32(integers.iter().map(|&x| x as f32).collect()),
            Some(Data::F64(table)) => Data::F64(looked_up(&table, &integers)?),
            Some(Data::F32(table)) => Data::F32(looked_up(&table, &integers)?),
            Some(other) => other,
        })
    }
}

/// Bytes of a scalar that is not compressed.
fn size(scalar: ScalarType) -> usize {
    match scalar {
        ScalarType::Bool | ScalarType::UChar => 1,
        ScalarType::Half => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::String | ScalarType::Token | ScalarType::Asset => 4,
        ScalarType::Int64 | ScalarType::UInt64 | ScalarType::Double | ScalarType::TimeCode => 8,
    }
}

/// The numbers of a table that indices name.
fn looked_up<T: Copy>(table: &[T], indices: &[i64]) -> Result<Vec<T>, String> {
    let number = |&i: &i64| {
        let found = usize::try_from(i).ok().and_then(|i| table.get(i)).copied();
        found.ok_or_else(|| format!("its floats name {i} of a table that is shorter"))
    };
    indices.iter().map(number).collect()
}

fn each<const N: usize, T>(bytes: &[u8], value: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks().0.iter().map(|b| value(*b)).collect()
}

/// Moves the real part of quaternions, which is last in a file, to the front.
fn real_first(data: &mut Data) {
    match data {
        Data::F32(v) => v.chunks_exact_mut(4).for_each(|q| q.rotate_right(1)),
        Data::F64(v) => v.chunks_exact_mut(4).for_each(|q| q.rotate_right(1)),
        _ => {}
    }
}
