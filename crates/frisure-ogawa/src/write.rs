//! Objects and properties written as groups and blocks of the container.
//!
//! An object is a group of its properties, of its children, and a block that names the children. A compound
//! property is a group of its properties and a block that names them; a scalar one, a group of a sample; an
//! array, a group of a sample and its dimensions. A sample is a digest (`MurmurHash3`) and the values.

use std::io::{self, Write};

use super::container::{self, Block, Node};
use crate::murmur::murmur3;

/// Types of numbers (`Alembic::Util::PlainOldDataType`), as files number them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pod {
    /// `bool_t`
    Bool = 0,
    /// `uint8_t`
    U8 = 1,
    /// `int16_t`
    I16 = 4,
    /// `uint32_t`
    U32 = 5,
    /// `int32_t`
    I32 = 6,
    /// `float32_t`
    F32 = 10,
    /// `float64_t`
    F64 = 11,
    /// `string`
    Text = 12,
}

impl Pod {
    /// The name that metadata use.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bool => "bool_t",
            Self::U8 => "uint8_t",
            Self::I16 => "int16_t",
            Self::U32 => "uint32_t",
            Self::I32 => "int32_t",
            Self::F32 => "float32_t",
            Self::F64 => "float64_t",
            Self::Text => "string",
        }
    }
}

/// The values of a property at one time.
pub struct Sample<'a> {
    pod: Pod,
    /// How many numbers make one value.
    extent: u8,
    /// Number of values.
    count: usize,
    digest: [u8; 16],
    block: Block<'a>,
}

impl<'a> Sample<'a> {
    /// A sample of `count` values of `extent` numbers each; `fill` is called twice, for the digest and for the file.
    pub fn of(pod: Pod, extent: u8, count: usize, fill: impl Fn(&mut Vec<u8>) + 'a) -> Self {
        let mut bytes = Vec::new();
        fill(&mut bytes);
        let size = bytes.len();
        Self {
            pod,
            extent,
            count,
            digest: murmur3(&bytes),
            block: Block { size, fill: Box::new(fill) },
        }
    }

    /// A string, or several.
    #[must_use]
    pub fn texts(texts: &[&str]) -> Self {
        let bytes = texts.iter().flat_map(|t| t.bytes().chain([0])).collect::<Vec<u8>>();
        Self::of(Pod::Text, 1, texts.len(), move |out| out.extend_from_slice(&bytes))
    }

    /// The type of the numbers, and how many make one value.
    pub fn kind(&self) -> (Pod, u8) {
        (self.pod, self.extent)
    }

    fn sample(self) -> Node<'a> {
        let Self { digest, block, .. } = self;
        if block.size == 0 {
            return Node::bytes(Vec::new());
        }
        let fill = move |out: &mut Vec<u8>| {
            out.extend_from_slice(&digest);
            (block.fill)(out);
        };
        Node::Block(Block { size: 16 + block.size, fill: Box::new(fill) })
    }
}

/// A property to be written.
pub struct Property<'a> {
    /// Its name.
    pub name: String,
    /// `key=value` with semicolons between, in the order of the keys.
    pub metadata: String,
    /// Its values, or the properties in it.
    pub data: PropertyData<'a>,
}

/// The content of a property.
pub enum PropertyData<'a> {
    /// Further properties.
    Compound(Vec<Property<'a>>),
    /// One value at each time.
    Scalar(Vec<Sample<'a>>),
    /// Any number of values at each time.
    Array(Vec<Sample<'a>>),
}

/// The times at which properties of several samples have them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSampling {
    /// The number of samples.
    pub count: u32,
    /// From one sample to the next (s); the first is at 0.
    pub interval: f64,
}

impl<'a> Property<'a> {
    /// Properties under a name.
    #[must_use]
    pub fn compound(name: &str, metadata: &str, parts: Vec<Self>) -> Self {
        Self { name: name.into(), metadata: metadata.into(), data: PropertyData::Compound(parts) }
    }

    /// One value, at all times.
    #[must_use]
    pub fn scalar(name: &str, metadata: &str, values: Sample<'a>) -> Self {
        Self::scalars(name, metadata, vec![values])
    }

    /// One value at each time of the archive's [`TimeSampling`]; a single sample is the value at all times.
    #[must_use]
    pub fn scalars(name: &str, metadata: &str, samples: Vec<Sample<'a>>) -> Self {
        Self { name: name.into(), metadata: metadata.into(), data: PropertyData::Scalar(samples) }
    }

    /// Any number of values, at all times.
    #[must_use]
    pub fn array(name: &str, metadata: &str, values: Sample<'a>) -> Self {
        Self::arrays(name, metadata, vec![values])
    }

    /// Values, as many at each time of the archive's [`TimeSampling`]; a single sample is the values at all times.
    #[must_use]
    pub fn arrays(name: &str, metadata: &str, samples: Vec<Sample<'a>>) -> Self {
        Self { name: name.into(), metadata: metadata.into(), data: PropertyData::Array(samples) }
    }
}

/// An object to be written.
pub struct Object<'a> {
    /// Its name.
    pub name: String,
    /// `key=value` with semicolons between, in the order of the keys.
    pub metadata: String,
    /// Its properties.
    pub properties: Vec<Property<'a>>,
    /// The objects in it.
    pub children: Vec<Object<'a>>,
}

/// The version of the Alembic library whose layout is written.
const LIBRARY: i32 = 1_08_12;

/// The samplings in time, each as the number of samples, the interval, and the one time that is stored: that of what does
/// not change, and that of what does.
fn times(sampling: Option<TimeSampling>) -> Vec<u8> {
    let still = TimeSampling { count: 1, interval: 1.0 };
    let mut bytes = Vec::new();
    for TimeSampling { count, interval } in [still].into_iter().chain(sampling) {
        bytes.extend(count.to_le_bytes());
        bytes.extend(interval.to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend(0.0_f64.to_le_bytes());
    }
    bytes
}

/// Writes an archive of objects. Properties of several samples have them at the times of `sampling`.
///
/// # Errors
/// Those of `out`.
///
/// # Panics
/// If a property has several samples, but not as many as `sampling` has.
pub fn write_archive(
    out: &mut dyn Write,
    metadata: &str,
    sampling: Option<TimeSampling>,
    objects: Vec<Object<'_>>,
) -> io::Result<()> {
    let count = sampling.map_or(1, |sampling| sampling.count as usize);
    let mut names = Names { metadata: Metadata::default(), samples: count };
    let top = Object {
        name: "ABC".into(),
        metadata: String::new(),
        properties: Vec::new(),
        children: objects,
    };
    let (top, _) = object(top, &mut names);
    let root = Node::Group(vec![
        Node::bytes(0_i32.to_le_bytes().to_vec()),
        Node::bytes(LIBRARY.to_le_bytes().to_vec()),
        top,
        Node::bytes(metadata.as_bytes().to_vec()),
        Node::bytes(times(sampling)),
        Node::bytes(names.metadata.bytes()),
    ]);
    container::write(out, &root)
}

/// What an archive has once for all its objects.
struct Names {
    metadata: Metadata,
    /// How many samples a property has that changes.
    samples: usize,
}

/// Metadata that are numbered: each is written once.
#[derive(Default)]
struct Metadata(Vec<String>);

impl Metadata {
    /// A number from 1, 0 for none, or 255 for what has to be written out.
    fn number(&mut self, text: &str) -> u8 {
        if text.is_empty() {
            return 0;
        }
        if let Some(i) = self.0.iter().position(|t| t == text) {
            return i as u8 + 1;
        }
        if text.len() > 255 || self.0.len() >= 254 {
            return 255;
        }
        self.0.push(text.into());
        self.0.len() as u8
    }

    fn bytes(&self) -> Vec<u8> {
        self.0.iter().flat_map(|t| [t.len() as u8].into_iter().chain(t.bytes())).collect()
    }
}

/// An object, and a digest of all that is in it.
fn object<'a>(object: Object<'a>, names: &mut Names) -> (Node<'a>, [u8; 16]) {
    let (properties, mut hashes) = compound(object.properties, names);
    let mut nodes = vec![properties];
    let mut headers = Vec::new();
    let mut inner = Vec::new();
    for child in object.children {
        let number = names.metadata.number(&child.metadata);
        headers.extend((child.name.len() as u32).to_le_bytes());
        headers.extend(child.name.as_bytes());
        headers.push(number);
        if number == 255 {
            headers.extend((child.metadata.len() as u32).to_le_bytes());
            headers.extend(child.metadata.as_bytes());
        }
        let (node, hash) = self::object(child, names);
        nodes.push(node);
        inner.extend(hash);
    }
    // Programs compare these to find what they have read already.
    hashes.extend(murmur3(&inner));
    headers.extend(murmur3(&hashes));
    headers.extend(if inner.is_empty() { [0; 16] } else { murmur3(&inner) });
    nodes.push(Node::bytes(headers));
    (Node::Group(nodes), murmur3(&hashes))
}

/// Properties, and digests of them.
fn compound<'a>(properties: Vec<Property<'a>>, names: &mut Names) -> (Node<'a>, Vec<u8>) {
    let mut nodes = Vec::new();
    let (mut headers, mut hashes) = (Vec::new(), Vec::new());
    for property in properties {
        let header = header(&property, names);
        hashes.extend(&header);
        headers.extend(header);
        nodes.push(match property.data {
            PropertyData::Compound(parts) => {
                let (node, inner) = compound(parts, names);
                hashes.extend(inner);
                node
            }
            PropertyData::Scalar(samples) => {
                samples.iter().for_each(|values| hashes.extend(values.digest));
                Node::Group(samples.into_iter().map(Sample::sample).collect())
            }
            PropertyData::Array(samples) => {
                samples.iter().for_each(|values| hashes.extend(values.digest));
                // Each with its dimensions. The number of texts is not the number of bytes.
                let nodes = samples.into_iter().flat_map(|values| {
                    let is_text = values.pod == Pod::Text;
                    let size =
                        if is_text { (values.count as u64).to_le_bytes().to_vec() } else { vec![] };
                    [values.sample(), Node::bytes(size)]
                });
                Node::Group(nodes.collect())
            }
        });
    }
    if !headers.is_empty() {
        nodes.push(Node::bytes(headers));
    }
    (Node::Group(nodes), hashes)
}

/// The header of a property: bits, the number of samples, name, and metadata.
fn header(property: &Property<'_>, names: &mut Names) -> Vec<u8> {
    let Property { name, metadata, data } = property;
    // Bytes of the numbers below: 1, 2, or 4.
    let hint = match name.len().max(metadata.len()).max(names.samples) {
        0..256 => 0,
        256..65_536 => 1,
        _ => 2,
    };
    let number = |n: usize| n.to_le_bytes()[..1 << hint].to_vec();
    let index = names.metadata.number(metadata);
    let mut info = u32::from(index) << 20 | hint << 2;
    // One sample that never changes, or each another than that before, at the times of the second sampling; of the same
    // size every time.
    let all_times = |samples: &[Sample<'_>]| {
        assert!([1, names.samples].contains(&samples.len()), "a sample for each time, or one");
        let v = &samples[0];
        let changes = if samples.len() > 1 { 0x100 } else { 0x800 };
        changes | 0x400 | u32::from(v.extent) << 12 | (v.pod as u32) << 4 | u32::from(v.count == 1)
    };
    let (kind, samples) = match data {
        PropertyData::Compound(_) => (0, 0),
        PropertyData::Scalar(v) => (1 | all_times(v), v.len()),
        PropertyData::Array(v) => (2 | all_times(v), v.len()),
    };
    info |= kind;
    let mut bytes = info.to_le_bytes().to_vec();
    if samples > 0 {
        bytes.extend(number(samples));
    }
    if samples > 1 {
        bytes.extend(number(1));
    }
    bytes.extend(number(name.len()));
    bytes.extend(name.as_bytes());
    if index == 255 {
        bytes.extend(number(metadata.len()));
        bytes.extend(metadata.as_bytes());
    }
    bytes
}
