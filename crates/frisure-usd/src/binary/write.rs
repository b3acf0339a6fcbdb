//! Layers written in binary.

use std::collections::BTreeMap;
use std::io::{self, Write};

use half::f16;

use super::compressed::{pack, pack_integers};
use super::{FEW, HEAD, MAGIC, ValueRep, code, spec};
use crate::layer::{Attribute, Layer, Prim, Relationship, Specifier};
use crate::value::{Data, ScalarType, Shape, TYPES, Value};

const VERSION: [u8; 8] = [0, 8, 0, 0, 0, 0, 0, 0];

/// Writes a layer.
///
/// # Errors
/// Those of `out`, and [`io::ErrorKind::InvalidInput`] for a path that leads to nothing in the layer.
pub fn write(out: &mut dyn Write, layer: &Layer) -> io::Result<()> {
    out.write_all(&Crate::of(layer)?.finish())
}

/// Fields of a spec, each a word and a value.
type Fields = Vec<(u32, ValueRep)>;

/// A node of the tree of paths; its place in the list is the index of its path.
struct Node {
    name: u32,
    is_property: bool,
    /// Nodes under it and itself.
    size: usize,
    has_sibling: bool,
}

struct Crate {
    bytes: Vec<u8>,
    words: Vec<String>,
    places: BTreeMap<String, u32>,
    strings: Vec<u32>,
    nodes: Vec<Node>,
    paths: BTreeMap<String, u32>,
    specs: Vec<(u32, Fields)>,
}

impl Crate {
    fn of(layer: &Layer) -> io::Result<Self> {
        let mut file = Self {
            bytes: vec![0; HEAD],
            words: Vec::new(),
            places: BTreeMap::new(),
            strings: Vec::new(),
            nodes: Vec::new(),
            paths: BTreeMap::new(),
            specs: Vec::new(),
        };
        // The index of a property's name is negated in the tree: the first word can be none.
        file.word(";-)");
        let root = file.word("");
        file.node(root, false, "/".into());
        for prim in &layer.prims {
            file.grow(prim, "");
        }
        file.close(0, 1);
        let mut fields = file.metadata(&layer.metadata)?;
        file.children(&mut fields, &layer.prims);
        file.specs.push((spec::ROOT, fields));
        for prim in &layer.prims {
            file.prim(prim)?;
        }
        Ok(file)
    }

    /// The index of a word.
    fn word(&mut self, word: &str) -> u32 {
        if let Some(&place) = self.places.get(word) {
            return place;
        }
        let place = index(self.words.len());
        self.words.push(word.into());
        self.places.insert(word.into(), place);
        place
    }

    fn node(&mut self, name: u32, is_property: bool, path: String) {
        self.paths.insert(path, index(self.nodes.len()));
        self.nodes.push(Node { name, is_property, size: 1, has_sibling: true });
    }

    /// Adds the paths of a prim, of its properties and of what is in it.
    fn grow(&mut self, prim: &Prim, above: &str) {
        let path = format!("{above}/{}", prim.name);
        let (name, at) = (self.word(&prim.name), self.nodes.len());
        self.node(name, false, path.clone());
        for property in properties(prim) {
            let name = self.word(property);
            self.node(name, true, format!("{path}.{property}"));
        }
        for child in &prim.children {
            self.grow(child, &path);
        }
        self.close(at, at + 1);
    }

    /// Ends the node `at`, whose first child is next.
    fn close(&mut self, at: usize, first: usize) {
        self.nodes[at].size = self.nodes.len() - at;
        let mut last = None;
        let mut child = first;
        while child < self.nodes.len() {
            last = Some(child);
            child += self.nodes[child].size;
        }
        if let Some(last) = last {
            self.nodes[last].has_sibling = false;
        }
        if at == 0 {
            self.nodes[0].has_sibling = false;
        }
    }

    fn prim(&mut self, prim: &Prim) -> io::Result<()> {
        let at = Specifier::ALL.iter().position(|s| *s == prim.specifier).unwrap_or(0);
        let mut fields = Vec::new();
        self.field(&mut fields, "specifier", ValueRep::inlined(code::SPECIFIER, index(at)));
        if !prim.type_name.is_empty() {
            let value = self.value(&Value::token(&prim.type_name))?;
            self.field(&mut fields, "typeName", value);
        }
        if !prim.schemas.is_empty() {
            let schemas = self.prepended(&prim.schemas);
            self.field(&mut fields, "apiSchemas", schemas);
        }
        fields.extend(self.metadata(&prim.metadata)?);
        let properties: Vec<&str> = properties(prim).collect();
        if !properties.is_empty() {
            let properties = self.word_list(properties.into_iter());
            self.field(&mut fields, "properties", properties);
        }
        self.children(&mut fields, &prim.children);
        self.specs.push((spec::PRIM, fields));
        for attribute in &prim.attributes {
            self.attribute(attribute)?;
        }
        for relationship in &prim.relationships {
            self.relationship(relationship)?;
        }
        prim.children.iter().try_for_each(|child| self.prim(child))
    }

    fn attribute(&mut self, attribute: &Attribute) -> io::Result<()> {
        let mut fields = Vec::new();
        if attribute.custom {
            self.field(&mut fields, "custom", ValueRep::inlined(1, 1));
        }
        let kind = self.value(&Value::token(&attribute.type_name))?;
        self.field(&mut fields, "typeName", kind);
        if attribute.uniform {
            self.field(&mut fields, "variability", ValueRep::inlined(code::VARIABILITY, 1));
        }
        if let Some(value) = &attribute.value {
            let value = self.value(value)?;
            self.field(&mut fields, "default", value);
        }
        if !attribute.samples.is_empty() {
            let samples = self.time_samples(&attribute.samples)?;
            self.field(&mut fields, "timeSamples", samples);
        }
        if !attribute.connections.is_empty() {
            let paths = self.path_list(&attribute.connections)?;
            self.field(&mut fields, "connectionPaths", paths);
        }
        fields.extend(self.metadata(&attribute.metadata)?);
        self.specs.push((spec::ATTRIBUTE, fields));
        Ok(())
    }

    /// Values at times: where the list of times is, the number of values, and each of them.
    fn time_samples(&mut self, samples: &[(f64, Value)]) -> io::Result<ValueRep> {
        let times = self.place();
        self.bytes.extend((samples.len() as u64).to_le_bytes());
        self.bytes.extend(samples.iter().flat_map(|(time, _)| time.to_le_bytes()));
        let times = ValueRep::at(code::DOUBLE_VECTOR, times, 0);
        let values = samples.iter().map(|(_, value)| self.value(value));
        let values = values.collect::<io::Result<Vec<ValueRep>>>()?;
        let at = self.place();
        // Each of the two parts begins with the way from there to where it goes on: values that it has may stand between,
        // but these stand before.
        const NOTHING_BETWEEN: u64 = 8;
        self.bytes.extend(NOTHING_BETWEEN.to_le_bytes());
        self.bytes.extend(times.0.to_le_bytes());
        self.bytes.extend(NOTHING_BETWEEN.to_le_bytes());
        self.bytes.extend((values.len() as u64).to_le_bytes());
        self.bytes.extend(values.iter().flat_map(|rep| rep.0.to_le_bytes()));
        Ok(ValueRep::at(code::TIME_SAMPLES, at, 0))
    }

    fn relationship(&mut self, relationship: &Relationship) -> io::Result<()> {
        let mut fields = Vec::new();
        self.field(&mut fields, "variability", ValueRep::inlined(code::VARIABILITY, 1));
        if !relationship.targets.is_empty() {
            let paths = self.path_list(&relationship.targets)?;
            self.field(&mut fields, "targetPaths", paths);
        }
        self.specs.push((spec::RELATIONSHIP, fields));
        Ok(())
    }

    fn metadata(&mut self, metadata: &[(String, Value)]) -> io::Result<Fields> {
        let mut fields = Vec::new();
        for (key, value) in metadata {
            let value = self.value(value)?;
            self.field(&mut fields, key, value);
        }
        Ok(fields)
    }

    fn field(&mut self, fields: &mut Fields, name: &str, value: ValueRep) {
        let name = self.word(name);
        fields.push((name, value));
    }

    fn children(&mut self, fields: &mut Fields, prims: &[Prim]) {
        if prims.is_empty() {
            return;
        }
        let names = self.word_list(prims.iter().map(|p| p.name.as_str()));
        self.field(fields, "primChildren", names);
    }

    fn word_list<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> ValueRep {
        let words: Vec<u32> = words.map(|word| self.word(word)).collect();
        let at = self.place();
        self.indices(&words);
        ValueRep::at(code::TOKEN_VECTOR, at, 0)
    }

    fn prepended(&mut self, words: &[String]) -> ValueRep {
        let words: Vec<u32> = words.iter().map(|word| self.word(word)).collect();
        let at = self.place();
        // Prepended items, and nothing else.
        self.bytes.push(1 << 5);
        self.indices(&words);
        ValueRep::at(code::TOKEN_LIST_OP, at, 0)
    }

    fn path_list(&mut self, paths: &[String]) -> io::Result<ValueRep> {
        let known = |path: &String| {
            self.paths.get(path).copied().ok_or_else(|| {
                io::Error::new(io::ErrorKind::InvalidInput, format!("nothing is at <{path}>"))
            })
        };
        let paths = paths.iter().map(known).collect::<io::Result<Vec<u32>>>()?;
        let at = self.place();
        // Explicit, with explicit items.
        self.bytes.push(0b11);
        self.indices(&paths);
        Ok(ValueRep::at(code::PATH_LIST_OP, at, 0))
    }

    fn indices(&mut self, indices: &[u32]) {
        self.bytes.extend((indices.len() as u64).to_le_bytes());
        self.bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    }

    /// The next place for a value; arrays of 8-byte numbers can be used as they lie in the file.
    fn place(&mut self) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
        self.bytes.len()
    }

    fn value(&mut self, value: &Value) -> io::Result<ValueRep> {
        let code = TYPES.iter().find(|(.., ty)| *ty == value.ty).map(|(code, ..)| *code);
        let code = code.ok_or_else(|| {
            io::Error::new(io::ErrorKind::InvalidInput, format!("no code for {:?}", value.ty))
        })?;
        if value.array {
            return Ok(self.array(code, value));
        }
        if let Some(payload) = self.short(value) {
            return Ok(ValueRep::inlined(code, payload));
        }
        let at = self.place();
        self.raw(value);
        Ok(ValueRep::at(code, at, 0))
    }

    /// A single number or word of at most 4 bytes.
    fn short(&mut self, value: &Value) -> Option<u32> {
        if value.ty.shape != Shape::One {
            return None;
        }
        match (&value.data, value.ty.scalar) {
            (Data::I32(v), _) => Some(v[0].cast_unsigned()),
            (Data::I64(v), ScalarType::UInt) => Some(v[0] as u32),
            (Data::F32(v), ScalarType::Half) => Some(f16::from_f32(v[0]).to_bits().into()),
            (Data::F32(v), _) => Some(v[0].to_bits()),
            (Data::F64(v), ScalarType::Double) if f64::from(v[0] as f32) == v[0] => {
                Some((v[0] as f32).to_bits())
            }
            (Data::Words(v), ScalarType::String) => Some(self.string(&v[0])),
            (Data::Words(v), _) => Some(self.word(&v[0])),
            _ => None,
        }
    }

    /// The index of a string.
    fn string(&mut self, text: &str) -> u32 {
        let word = self.word(text);
        if let Some(at) = self.strings.iter().position(|&w| w == word) {
            return index(at);
        }
        self.strings.push(word);
        index(self.strings.len() - 1)
    }

    fn array(&mut self, code: u8, value: &Value) -> ValueRep {
        let count = value.len() as u64;
        if count == 0 {
            return ValueRep::at(code, 0, ValueRep::ARRAY);
        }
        let at = self.place();
        self.bytes.extend(count.to_le_bytes());
        match &value.data {
            Data::I32(v) if code == 3 && count >= FEW => {
                let packed = pack_integers(v);
                self.bytes.extend((packed.len() as u64).to_le_bytes());
                self.bytes.extend(packed);
                return ValueRep::at(code, at, ValueRep::ARRAY | ValueRep::COMPRESSED);
            }
            _ => self.raw(value),
        }
        ValueRep::at(code, at, ValueRep::ARRAY)
    }

    /// All numbers or words, one after another.
    fn raw(&mut self, value: &Value) {
        let quaternions = value.ty.shape == Shape::Quaternion;
        match &value.data {
            Data::I32(v) if value.ty.scalar == ScalarType::Int => {
                self.bytes.extend(v.iter().flat_map(|x| x.to_le_bytes()));
            }
            Data::I32(v) => self.bytes.extend(v.iter().map(|&x| x as u8)),
            Data::I64(v) if value.ty.scalar == ScalarType::UInt => {
                self.bytes.extend(v.iter().flat_map(|&x| (x as u32).to_le_bytes()));
            }
            Data::I64(v) => self.bytes.extend(v.iter().flat_map(|x| x.to_le_bytes())),
            Data::F32(v) if value.ty.scalar == ScalarType::Half => {
                let all = real_last(v, quaternions);
                self.bytes.extend(all.iter().flat_map(|&x| f16::from_f32(x).to_le_bytes()));
            }
            Data::F32(v) => {
                self.bytes.reserve(4 * v.len());
                let all = real_last(v, quaternions);
                self.bytes.extend(all.iter().flat_map(|x| x.to_le_bytes()));
            }
            Data::F64(v) => {
                let all = real_last(v, quaternions);
                self.bytes.extend(all.iter().flat_map(|x| x.to_le_bytes()));
            }
            Data::Words(v) => {
                let token = value.ty.scalar == ScalarType::Token;
                let indices: Vec<u32> =
                    v.iter().map(|w| if token { self.word(w) } else { self.string(w) }).collect();
                self.bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
            }
        }
    }

    /// The whole file.
    fn finish(mut self) -> Vec<u8> {
        let (mut fields, mut sets, mut specs) = (Vec::new(), Vec::new(), [vec![], vec![], vec![]]);
        for (path, (kind, own)) in self.specs.iter().enumerate() {
            for (all, x) in specs.iter_mut().zip([index(path), index(sets.len()), *kind]) {
                all.push(x.cast_signed());
            }
            sets.extend((0..own.len()).map(|i| index(fields.len() + i).cast_signed()));
            // The end of a set.
            sets.push(-1);
            fields.extend(own);
        }
        let mut sections = Vec::new();
        let mut begin = |file: &mut Self, name: &'static str| {
            sections.push((name, file.place()));
        };
        begin(&mut self, "TOKENS");
        self.put_words();
        begin(&mut self, "STRINGS");
        let strings = std::mem::take(&mut self.strings);
        self.indices(&strings);
        begin(&mut self, "FIELDS");
        self.put_fields(&fields);
        begin(&mut self, "FIELDSETS");
        self.put_count(sets.len());
        self.put_packed(&pack_integers(&sets));
        begin(&mut self, "PATHS");
        self.put_paths();
        begin(&mut self, "SPECS");
        self.put_count(specs[0].len());
        specs.iter().for_each(|all| self.put_packed(&pack_integers(all)));
        self.put_contents(&sections);
        self.bytes
    }

    fn put_count(&mut self, n: usize) {
        self.bytes.extend((n as u64).to_le_bytes());
    }

    fn put_packed(&mut self, packed: &[u8]) {
        self.put_count(packed.len());
        self.bytes.extend(packed);
    }

    fn put_words(&mut self) {
        let mut text = Vec::new();
        for word in &self.words {
            text.extend(word.as_bytes());
            text.push(0);
        }
        self.put_count(self.words.len());
        self.put_count(text.len());
        self.put_packed(&pack(&text));
    }

    fn put_fields(&mut self, fields: &[(u32, ValueRep)]) {
        let names: Vec<i32> = fields.iter().map(|(name, _)| name.cast_signed()).collect();
        let values: Vec<u8> = fields.iter().flat_map(|(_, rep)| rep.0.to_le_bytes()).collect();
        self.put_count(fields.len());
        self.put_packed(&pack_integers(&names));
        self.put_packed(&pack(&values));
    }

    fn put_paths(&mut self) {
        let nodes = std::mem::take(&mut self.nodes);
        let indices: Vec<i32> = (0..nodes.len()).map(|i| index(i).cast_signed()).collect();
        let names: Vec<i32> = nodes.iter().map(Node::signed_name).collect();
        let jumps: Vec<i32> = nodes.iter().map(Node::jump).collect();
        self.put_count(nodes.len());
        self.put_count(nodes.len());
        for all in [indices, names, jumps] {
            self.put_packed(&pack_integers(&all));
        }
    }

    /// The table of contents, and the head.
    fn put_contents(&mut self, sections: &[(&str, usize)]) {
        let contents = self.place();
        let ends = sections[1..].iter().map(|(_, start)| *start).chain([contents]);
        self.put_count(sections.len());
        for ((name, start), end) in sections.iter().zip(ends) {
            let mut title = [0; 16];
            title[..name.len()].copy_from_slice(name.as_bytes());
            self.bytes.extend(title);
            self.put_count(*start);
            self.put_count(end - start);
        }
        self.bytes[..8].copy_from_slice(MAGIC);
        self.bytes[8..16].copy_from_slice(&VERSION);
        self.bytes[16..24].copy_from_slice(&(contents as u64).to_le_bytes());
    }
}

impl Node {
    /// The name's index, negative for a property.
    fn signed_name(&self) -> i32 {
        let name = self.name.cast_signed();
        if self.is_property { -name } else { name }
    }

    /// How far the next sibling is; 0 next, -1 there is none but a child, -2 there is neither.
    fn jump(&self) -> i32 {
        match (self.size > 1, self.has_sibling) {
            (true, true) => index(self.size).cast_signed(),
            (true, false) => -1,
            (false, true) => 0,
            (false, false) => -2,
        }
    }
}

fn properties(prim: &Prim) -> impl Iterator<Item = &str> {
    let relationships = prim.relationships.iter().map(|r| r.name.as_str());
    prim.attributes.iter().map(|a| a.name.as_str()).chain(relationships)
}

/// Quaternions with their real part last, as the file has them; other values as they are.
fn real_last<T: Copy>(values: &[T], quaternions: bool) -> std::borrow::Cow<'_, [T]> {
    if !quaternions {
        return values.into();
    }
    values.chunks_exact(4).flat_map(|q| [q[1], q[2], q[3], q[0]]).collect::<Vec<_>>().into()
}

/// An index in the file's own width: a layer has fewer entries than that.
fn index(i: usize) -> u32 {
    i as u32
}
