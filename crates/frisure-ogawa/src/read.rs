//! Objects and properties of an archive that is read; [`crate::write`] describes the layout.

use super::container::{Container, Reference};

/// Bytes of a name that are kept.
const LONGEST: usize = 256;

/// An archive.
pub struct Archive<'a> {
    container: Container<'a>,
    /// Metadata that are numbered, the first of them none.
    metadata: Vec<&'a [u8]>,
    top: Reference,
}

/// An object of an archive.
pub struct Object<'a> {
    /// Its name, cut to 256 bytes.
    pub name: String,
    metadata: &'a [u8],
    reference: Reference,
}

/// A property of an object.
#[derive(Clone, Copy)]
pub struct Property<'a> {
    /// Its name.
    pub name: &'a [u8],
    metadata: &'a [u8],
    /// Whether it has values or properties.
    pub kind: Kind,
    reference: Reference,
}

/// Whether a property has values or properties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Properties under a name.
    Compound,
    /// Values of a type of number.
    Values {
        /// The number of a [`crate::write::Pod`].
        pod: u8,
        /// How many make one.
        extent: u8,
        /// How many samples in time it has that differ; 1 of what does not change.
        samples: usize,
    },
}

/// A value of `key` in metadata.
fn lookup<'a>(metadata: &'a [u8], key: &str) -> Option<&'a [u8]> {
    let mut pairs = metadata.split(|b| *b == b';');
    pairs.find_map(|pair| pair.strip_prefix(key.as_bytes())?.strip_prefix(b"="))
}

impl<'a> Property<'a> {
    /// The value of a key of its metadata.
    #[must_use]
    pub fn metadata(&self, key: &str) -> Option<&'a [u8]> {
        lookup(self.metadata, key)
    }
}

impl Object<'_> {
    /// Its schema, such as `AbcGeom_Curve_v2`.
    #[must_use]
    pub fn schema(&self) -> &[u8] {
        lookup(self.metadata, "schema").unwrap_or_default()
    }
}

/// Bytes that are taken from the front.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let Some((head, tail)) = self.0.split_at_checked(count) else {
            return Err(format!("a header ends {} bytes early", count - self.0.len()));
        };
        self.0 = tail;
        Ok(head)
    }

    /// A number of `width` bytes, at most 4.
    fn number(&mut self, width: usize) -> Result<usize, String> {
        let mut word = [0; 4];
        word[..width].copy_from_slice(self.take(width)?);
        Ok(u32::from_le_bytes(word) as usize)
    }
}

impl<'a> Archive<'a> {
    /// Opens a file.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn open(bytes: &'a [u8]) -> Result<Self, String> {
        let (container, root) = Container::open(bytes)?;
        let [_, _, top, _, _, names, ..] = root[..] else {
            return Err(format!("its root has {} parts, and should have 6", root.len()));
        };
        let mut rest = Bytes(container.block(names)?);
        let mut metadata = vec![&[][..]];
        while !rest.0.is_empty() {
            let size = rest.number(1)?;
            metadata.push(rest.take(size)?);
        }
        Ok(Self { container, metadata, top })
    }

    /// The object that all others are under.
    #[must_use]
    pub fn top(&self) -> Object<'a> {
        Object { name: String::new(), metadata: &[], reference: self.top }
    }

    /// The children of an object.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn children(&self, object: &Object<'a>) -> Result<Vec<Object<'a>>, String> {
        let parts = self.container.group(object.reference)?;
        let [_, groups @ .., headers] = &parts[..] else { return Ok(Vec::new()) };
        if groups.is_empty() {
            return Ok(Vec::new());
        }
        // Two digests are at the end.
        let headers = self.container.block(*headers)?;
        let mut rest = Bytes(&headers[..headers.len().saturating_sub(32)]);
        let mut children = Vec::new();
        for &reference in groups {
            let size = rest.number(4)?;
            let name = rest.take(size)?;
            let name = String::from_utf8_lossy(&name[..name.len().min(LONGEST)]).into_owned();
            let index = rest.number(1)?;
            let metadata = self.metadata(index, 4, &mut rest)?;
            children.push(Object { name, metadata, reference });
        }
        Ok(children)
    }

    fn metadata(
        &self,
        index: usize,
        width: usize,
        rest: &mut Bytes<'a>,
    ) -> Result<&'a [u8], String> {
        if index == 255 {
            let size = rest.number(width)?;
            return rest.take(size);
        }
        let known = self.metadata.len();
        let found = self.metadata.get(index).copied();
        found.ok_or_else(|| format!("metadata {index} is missing: there are {known}"))
    }

    /// The properties of an object.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn properties(&self, object: &Object<'a>) -> Result<Vec<Property<'a>>, String> {
        match self.container.group(object.reference)?.first() {
            Some(&properties) => self.under(properties),
            None => Ok(Vec::new()),
        }
    }

    /// The properties of a compound one.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn parts(&self, property: &Property<'a>) -> Result<Vec<Property<'a>>, String> {
        match property.kind {
            Kind::Compound => self.under(property.reference),
            Kind::Values { .. } => Ok(Vec::new()),
        }
    }

    fn under(&self, group: Reference) -> Result<Vec<Property<'a>>, String> {
        let parts = self.container.group(group)?;
        let [groups @ .., headers] = &parts[..] else { return Ok(Vec::new()) };
        let mut rest = Bytes(self.container.block(*headers)?);
        let mut properties = Vec::new();
        for &reference in groups {
            let info = rest.number(4)?;
            let width = match info >> 2 & 3 {
                0 => 1,
                1 => 2,
                _ => 4,
            };
            let kind = if info & 3 == 0 {
                Kind::Compound
            } else {
                // The number of samples, the first and last that differ, and the times.
                // A property that is said to be constant stores its first sample alone.
                let all = rest.number(width)?;
                let samples = if info & 0x800 == 0 { all } else { all.min(1) };
                for present in [info & 0x200 != 0, info & 0x200 != 0, info & 0x100 != 0] {
                    if present {
                        rest.number(width)?;
                    }
                }
                Kind::Values { pod: (info >> 4 & 15) as u8, extent: (info >> 12) as u8, samples }
            };
            let size = rest.number(width)?;
            let name = rest.take(size)?;
            let metadata = self.metadata(info >> 20 & 255, width, &mut rest)?;
            properties.push(Property { name, metadata, kind, reference });
        }
        Ok(properties)
    }

    /// The bytes of the first sample of a property; none where it has no sample.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn sample(&self, property: &Property<'a>) -> Result<&'a [u8], String> {
        let Some(&first) = self.container.group(property.reference)?.first() else {
            return Ok(&[]);
        };
        let bytes = self.container.block(first)?;
        // A digest is in front.
        if bytes.is_empty() {
            Ok(bytes)
        } else {
            bytes.get(16..).ok_or_else(|| "a sample of less than 16 bytes".into())
        }
    }
}
