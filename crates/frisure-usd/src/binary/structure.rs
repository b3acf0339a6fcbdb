//! The sections of a binary file: words, fields, paths, specs.

use super::compressed::{unpack, unpack_integers};
use super::{HEAD, MAGIC, ValueRep};
use crate::layer::MAX_DEPTH;

/// Bytes that may be unpacked for each byte of a file, and beside them.
const MOST: (usize, usize) = (16, 256 << 20);

/// Bytes to be read one after another.
#[derive(Clone, Copy)]
pub(super) struct Bytes<'a> {
    all: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub(super) fn new(all: &'a [u8], at: u64) -> Result<Self, String> {
        let end = all.len();
        let found = usize::try_from(at).ok().filter(|&at| at <= end);
        let at = found.ok_or_else(|| format!("it points to byte {at}, and it has {end}"))?;
        Ok(Self { all, at })
    }

    pub(super) fn take(&mut self, n: u64) -> Result<&'a [u8], String> {
        let left = &self.all[self.at..];
        let taken = usize::try_from(n).ok().and_then(|n| left.get(..n)).ok_or_else(|| {
            format!("it is cut short: {n} bytes at byte {}, and it has {}", self.at, self.all.len())
        })?;
        self.at += taken.len();
        Ok(taken)
    }

    pub(super) fn u8(&mut self) -> Result<u8, String> {
        Ok(self.take(1)?[0])
    }

    pub(super) fn u32(&mut self) -> Result<u32, String> {
        let b = self.take(4)?;
        Ok(u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
    }

    pub(super) fn u64(&mut self) -> Result<u64, String> {
        let b = self.take(8)?;
        Ok(u64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]))
    }

    /// Goes to where the next 8 bytes point, from themselves.
    pub(super) fn follow(&mut self) -> Result<(), String> {
        let from = self.at as u64;
        let to = from.checked_add_signed(self.u64()?.cast_signed());
        *self = Self::new(self.all, to.ok_or("it points before its beginning")?)?;
        Ok(())
    }

    /// A list of indices, with its length before it.
    pub(super) fn indices(&mut self) -> Result<Vec<u32>, String> {
        let n = self.u64()?;
        let bytes = self.take(n.saturating_mul(4))?;
        Ok(bytes.as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect())
    }

    /// Bytes that begin with how many they are.
    pub(super) fn sized(&mut self) -> Result<&'a [u8], String> {
        let n = self.u64()?;
        self.take(n)
    }

    fn skip(&mut self, n: u64) -> Result<(), String> {
        self.take(n).map(|_| ())
    }
}

/// How much may still be unpacked (bytes): what is small packed can be anything.
pub(super) struct Budget(usize);

impl Budget {
    fn of(bytes: &[u8]) -> Self {
        Self(bytes.len().saturating_mul(MOST.0).saturating_add(MOST.1))
    }

    /// Reserves room for items of a size; returns their number.
    pub(super) fn take(&mut self, count: u64, size: usize) -> Result<usize, String> {
        let too_much = || format!("{count} items of {size} bytes are more than its size backs up");
        let count = usize::try_from(count).map_err(|_| too_much())?;
        let bytes = count.checked_mul(size).ok_or_else(too_much)?;
        self.0 = self.0.checked_sub(bytes).ok_or_else(too_much)?;
        Ok(count)
    }
}

/// A node of the tree of paths.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Node {
    /// The path that it is in; of the root and of what is not in the tree, none.
    pub(super) parent: Option<u32>,
    /// The index of its name.
    pub(super) name: u32,
    pub(super) is_property: bool,
    known: bool,
}

/// The sections of a file, without values.
#[derive(Default)]
pub(super) struct Structure {
    /// The middle number of the version: all differences follow from it.
    pub(super) version: u8,
    pub(super) words: Vec<String>,
    pub(super) strings: Vec<u32>,
    pub(super) fields: Vec<(u32, ValueRep)>,
    pub(super) sets: Vec<u32>,
    /// By the index of the path.
    pub(super) nodes: Vec<Node>,
    /// Paths in the order of the tree.
    pub(super) order: Vec<u32>,
    /// Path, where its set of fields begins, what it is.
    pub(super) specs: Vec<[u32; 3]>,
}

/// Reads the sections of a file.
pub(super) fn read(bytes: &[u8]) -> Result<(Structure, Budget), String> {
    if bytes.len() < HEAD || !bytes.starts_with(MAGIC) {
        return Err(format!("it has {} bytes, and the head alone has {HEAD}", bytes.len()));
    }
    let [major, minor, patch] = [bytes[8], bytes[9], bytes[10]];
    if major != 0 || minor < 4 {
        return Err(format!("its version is {major}.{minor}.{patch}: read are 0.4.0 and later"));
    }
    let version = minor;
    let mut budget = Budget::of(bytes);
    let contents = Contents::read(bytes)?;
    let mut file = Structure { version, ..Structure::default() };
    file.words = words(&mut contents.section("TOKENS")?, &mut budget)?;
    file.strings = contents.section("STRINGS")?.indices()?;
    file.fields = fields(&mut contents.section("FIELDS")?, &mut budget)?;
    file.sets = integers(&mut contents.section("FIELDSETS")?, &mut budget)?;
    file.paths(&mut contents.section("PATHS")?, &mut budget)?;
    file.specs = specs(&mut contents.section("SPECS")?, &mut budget)?;
    Ok((file, budget))
}

/// The table of contents.
struct Contents<'a> {
    bytes: &'a [u8],
    sections: Vec<(&'a [u8], u64)>,
}

impl<'a> Contents<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, String> {
        let at = Bytes::new(bytes, 16)?.u64()?;
        let mut table = Bytes::new(bytes, at)?;
        let count = table.u64()?;
        if count > 64 {
            return Err(format!("its table of contents has {count} sections"));
        }
        let mut sections = Vec::new();
        for _ in 0..count {
            let name = table.take(16)?;
            sections.push((name, table.u64()?));
            table.skip(8)?;
        }
        Ok(Self { bytes, sections })
    }

    fn section(&self, name: &str) -> Result<Bytes<'a>, String> {
        let named = |(title, _): &&(&[u8], u64)| {
            title.strip_prefix(name.as_bytes()).is_some_and(|rest| rest[0] == 0)
        };
        let section = self.sections.iter().find(named);
        let (_, start) = section.ok_or_else(|| format!("it has no section {name}"))?;
        Bytes::new(self.bytes, *start).map_err(|e| format!("section {name}: {e}"))
    }
}

fn words(bytes: &mut Bytes, budget: &mut Budget) -> Result<Vec<String>, String> {
    let count = bytes.u64()?;
    let size = budget.take(bytes.u64()?, 1)?;
    let text = unpack(bytes.sized()?, size)?;
    let mut words: Vec<String> = Vec::new();
    // Each word takes room beside its letters.
    budget.take(count.min(text.len() as u64), size_of::<String>())?;
    for word in text.split(|&b| b == 0) {
        words.push(String::from_utf8_lossy(word).into_owned());
    }
    if count > words.len() as u64 {
        return Err(format!("it has {} words and says that there are {count}", words.len()));
    }
    words.truncate(usize::try_from(count).unwrap_or(0));
    Ok(words)
}

/// Compressed integers that begin with how many they are.
fn integers(bytes: &mut Bytes, budget: &mut Budget) -> Result<Vec<u32>, String> {
    let count = bytes.u64()?;
    some_integers(bytes, count, budget)
}

fn some_integers(bytes: &mut Bytes, count: u64, budget: &mut Budget) -> Result<Vec<u32>, String> {
    let packed = bytes.sized()?;
    let count = budget.take(count, 4)?;
    Ok(unpack_integers(packed, count, false)?.iter().map(|&x| x as u32).collect())
}

fn fields(bytes: &mut Bytes, budget: &mut Budget) -> Result<Vec<(u32, ValueRep)>, String> {
    let count = bytes.u64()?;
    let names = some_integers(bytes, count, budget)?;
    let size = budget.take(count.saturating_mul(8), 1)?;
    let values = unpack(bytes.sized()?, size)?;
    let values = values.as_chunks().0.iter().map(|b| ValueRep(u64::from_le_bytes(*b)));
    Ok(names.into_iter().zip(values).collect())
}

fn specs(bytes: &mut Bytes, budget: &mut Budget) -> Result<Vec<[u32; 3]>, String> {
    let count = bytes.u64()?;
    let paths = some_integers(bytes, count, budget)?;
    let sets = some_integers(bytes, count, budget)?;
    let kinds = some_integers(bytes, count, budget)?;
    Ok((0..paths.len()).map(|i| [paths[i], sets[i], kinds[i]]).collect())
}

impl Structure {
    /// The word of an index.
    pub(super) fn word(&self, index: u32) -> Result<&str, String> {
        let word = self.words.get(index as usize);
        word.map(String::as_str)
            .ok_or_else(|| format!("it names word {index}, and there are {}", self.words.len()))
    }

    fn paths(&mut self, bytes: &mut Bytes, budget: &mut Budget) -> Result<(), String> {
        let (count, stated) = (bytes.u64()?, bytes.u64()?);
        let paths = some_integers(bytes, stated, budget)?;
        let names = some_integers(bytes, stated, budget)?;
        let jumps = some_integers(bytes, stated, budget)?;
        // Each path is in the tree.
        if count > stated.saturating_add(1) {
            return Err(format!("it has {stated} paths and says that there are {count}"));
        }
        self.nodes = vec![Node::default(); budget.take(count, size_of::<Node>())?];
        // Where a node is, what it is in, how deep.
        let mut waiting: Vec<(usize, Option<u32>, usize)> = vec![(0, None, 0)];
        while let Some((at, parent, depth)) = waiting.pop() {
            if at >= paths.len() {
                return Err(format!("its tree of paths leads to {at} of {stated}"));
            }
            if depth > MAX_DEPTH {
                return Err(format!("its paths are more than {MAX_DEPTH} deep"));
            }
            let (path, name) = (paths[at], names[at].cast_signed());
            self.put(path, parent, name)?;
            let jump = jumps[at].cast_signed();
            if jump >= 0 {
                // The next sibling, behind all that is in this one.
                let far = usize::try_from(jump).unwrap_or(0).max(1);
                waiting.push((at + far, parent, depth));
            }
            if jump > 0 || jump == -1 {
                waiting.push((at + 1, Some(path), depth + 1));
            }
        }
        Ok(())
    }

    /// Puts a path into the tree; the index of a property's name is negative.
    fn put(&mut self, path: u32, parent: Option<u32>, name: i32) -> Result<(), String> {
        let count = self.nodes.len();
        let node = self.nodes.get_mut(path as usize);
        let node = node.ok_or_else(|| format!("its tree has path {path} of {count}"))?;
        if node.known {
            return Err(format!("path {path} is twice in its tree"));
        }
        let (is_property, name) = (name < 0, name.unsigned_abs());
        *node = Node { parent, name, is_property, known: true };
        self.order.push(path);
        Ok(())
    }
}
