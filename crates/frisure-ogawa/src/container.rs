//! Ogawa, the container of Alembic files: a tree of groups and of blocks of data.
//!
//! A file begins with `Ogawa`, 0xff (it was finished), the version 0 1, and the place of the root group. A
//! group is the number of its children and a reference to each; a block is its size and its bytes; all
//! numbers are little-endian u64. A reference is a place in the file, with the highest bit set for a block; 0
//! and that bit alone are the empty group and the empty block.

use std::cell::Cell;
use std::io::{self, Write};

/// The bit that distinguishes a reference to a block from one to a group.
const BLOCK: u64 = 1 << 63;

const HEADER: usize = 16;

/// A function that appends bytes.
type Fill<'a> = Box<dyn Fn(&mut Vec<u8>) + 'a>;

/// A node of a file to be written.
pub(crate) enum Node<'a> {
    /// Its children.
    Group(Vec<Node<'a>>),
    /// Bytes.
    Block(Block<'a>),
}

/// Bytes that are made when their turn comes, so that only one block at a time is in memory.
pub(crate) struct Block<'a> {
    /// How many there are.
    pub(crate) size: usize,
    /// Appends just as many.
    pub(crate) fill: Fill<'a>,
}

impl Node<'_> {
    /// A block of bytes that are there already.
    pub(crate) fn bytes(bytes: Vec<u8>) -> Self {
        let size = bytes.len();
        Self::Block(Block { size, fill: Box::new(move |out| out.extend_from_slice(&bytes)) })
    }
}

/// The position of a node in the file.
struct Place {
    reference: u64,
    children: Vec<Place>,
}

/// Writes a file of a root group.
pub(crate) fn write(out: &mut dyn Write, root: &Node<'_>) -> io::Result<()> {
    let place = place(root, &mut (HEADER as u64));
    out.write_all(b"Ogawa\xff\x00\x01")?;
    out.write_all(&place.reference.to_le_bytes())?;
    write_node(out, root, &place)
}

/// Children stand before their group.
fn place(node: &Node<'_>, at: &mut u64) -> Place {
    let (children, size, mark) = match node {
        Node::Group(nodes) => {
            let children: Vec<Place> = nodes.iter().map(|n| place(n, at)).collect();
            let size = 8 * children.len();
            (children, size, 0)
        }
        Node::Block(block) => (Vec::new(), block.size, BLOCK),
    };
    if size == 0 {
        return Place { reference: mark, children };
    }
    let reference = *at | mark;
    *at += 8 + size as u64;
    Place { reference, children }
}

fn write_node(out: &mut dyn Write, node: &Node<'_>, place: &Place) -> io::Result<()> {
    match node {
        Node::Group(nodes) => {
            for (node, place) in nodes.iter().zip(&place.children) {
                write_node(out, node, place)?;
            }
            if nodes.is_empty() {
                return Ok(());
            }
            out.write_all(&(nodes.len() as u64).to_le_bytes())?;
            for child in &place.children {
                out.write_all(&child.reference.to_le_bytes())?;
            }
            Ok(())
        }
        Node::Block(Block { size: 0, .. }) => Ok(()),
        Node::Block(block) => {
            let mut bytes = Vec::with_capacity(block.size);
            (block.fill)(&mut bytes);
            assert_eq!(bytes.len(), block.size, "a block has the size that was said");
            out.write_all(&(block.size as u64).to_le_bytes())?;
            out.write_all(&bytes)
        }
    }
}

/// A file that is read.
pub(crate) struct Container<'a> {
    bytes: &'a [u8],
    /// How many more bytes are looked at. References may lead anywhere, to the same place again too.
    left: Cell<u64>,
}

/// A child of a group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reference(u64);

impl Reference {
    fn is_block(self) -> bool {
        self.0 & BLOCK != 0
    }
}

impl<'a> Container<'a> {
    /// A file, and the children of its root group.
    pub(crate) fn open(bytes: &'a [u8]) -> Result<(Self, Vec<Reference>), String> {
        if bytes.starts_with(b"\x89HDF") {
            return Err(
                "it is an Alembic file of the old kind, HDF5, and only Ogawa is read".into()
            );
        }
        if !bytes.starts_with(b"Ogawa") {
            return Err("it does not begin with `Ogawa`".into());
        }
        if bytes.len() < HEADER {
            return Err(format!("it is cut short: {} bytes", bytes.len()));
        }
        if bytes[5] != 0xff {
            return Err("its writer did not finish".into());
        }
        if bytes[6..8] != [0, 1] {
            return Err(format!("its version is {}.{}, and 0.1 is read", bytes[6], bytes[7]));
        }
        // The library shares what is equal, so that a little may be looked at more than once.
        let left = Cell::new(4 * bytes.len() as u64 + (1 << 20));
        let container = Self { bytes, left };
        let root = Reference(container.word(8)?);
        let children = container.group(root)?;
        Ok((container, children))
    }

    /// The children of a group.
    pub(crate) fn group(&self, group: Reference) -> Result<Vec<Reference>, String> {
        if group.is_block() {
            return Err(format!("byte {:#x} is data, and not a group", group.0 & !BLOCK));
        }
        let words = self.counted(group.0, 8)?.as_chunks().0.iter();
        Ok(words.map(|w| Reference(u64::from_le_bytes(*w))).collect())
    }

    /// The bytes of a block.
    pub(crate) fn block(&self, block: Reference) -> Result<&'a [u8], String> {
        if !block.is_block() {
            return Err(format!("byte {:#x} is a group, and not data", block.0));
        }
        self.counted(block.0 & !BLOCK, 1)
    }

    /// What follows the number of its parts, of `each` bytes.
    fn counted(&self, at: u64, each: u64) -> Result<&'a [u8], String> {
        if at == 0 {
            self.spend(8)?;
            return Ok(&[]);
        }
        let count = self.word(at)?;
        let beyond = || format!("{count} parts at byte {at:#x} reach beyond its end");
        let size = count.checked_mul(each).ok_or_else(beyond)?;
        let start = at as usize + 8;
        let size = usize::try_from(size).map_err(|_| beyond())?;
        let end = start.checked_add(size).ok_or_else(beyond)?;
        let bytes = self.bytes.get(start..end).ok_or_else(beyond)?;
        self.spend(8 + bytes.len() as u64)?;
        Ok(bytes)
    }

    fn word(&self, at: u64) -> Result<u64, String> {
        let found = usize::try_from(at).ok().and_then(|at| self.bytes.get(at..)?.first_chunk());
        let word = found.ok_or_else(|| format!("it is cut short: nothing at byte {at:#x}"))?;
        Ok(u64::from_le_bytes(*word))
    }

    fn spend(&self, bytes: u64) -> Result<(), String> {
        let left = self.left.get().checked_sub(bytes);
        self.left.set(left.ok_or("its parts contain each other")?);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file() -> Vec<u8> {
        let inner = Node::Group(vec![Node::bytes(b"abc".to_vec()), Node::Group(Vec::new())]);
        let root = Node::Group(vec![inner, Node::bytes(Vec::new()), Node::bytes(vec![7])]);
        let mut out = Vec::new();
        write(&mut out, &root).unwrap();
        out
    }

    #[test]
    fn what_was_written_is_read() {
        let bytes = file();
        let (container, root) = Container::open(&bytes).unwrap();
        assert_eq!(root.len(), 3);
        let inner = container.group(root[0]).unwrap();
        assert_eq!(container.block(inner[0]).unwrap(), b"abc");
        assert!(container.group(inner[1]).unwrap().is_empty());
        assert!(container.block(root[1]).unwrap().is_empty());
        assert_eq!(container.block(root[2]).unwrap(), [7]);
        assert!(container.block(root[0]).is_err() && container.group(root[1]).is_err());
    }

    #[test]
    fn a_group_that_contains_itself_ends() {
        let mut bytes = b"Ogawa\xff\x00\x01".to_vec();
        for word in [16_u64, 1, 16] {
            bytes.extend(word.to_le_bytes());
        }
        let (container, mut children) = Container::open(&bytes).unwrap();
        while let Ok(next) = container.group(children[0]) {
            children = next;
        }
    }

    #[test]
    fn sizes_that_lie_are_told() {
        let mut bytes = file();
        for size in [5_u64, u64::MAX, u64::MAX / 8 + 1] {
            bytes[16..24].copy_from_slice(&size.to_le_bytes());
            let (container, root) = Container::open(&bytes).unwrap();
            let inner = container.group(root[0]).unwrap();
            let block = container.block(inner[0]);
            assert!(size == 5 || block.is_err());
        }
    }
}
