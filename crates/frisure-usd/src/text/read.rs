//! Layers read from text.

use super::lexer::{Lexer, Token};
use crate::layer::{
    Attribute, Layer, MAX_DEPTH, Prim, Relationship, Specifier, is_composition_arc, metadata_type,
};
use crate::value::{Data, ScalarType, Shape, Value, ValueType};

/// A layer, or what is wrong with it, with its line.
pub(crate) fn read(text: &str) -> Result<Layer, String> {
    let mut reader = Reader { lexer: Lexer::new(text), depth: 0 };
    let mut layer = Layer::default();
    if reader.lexer.takes(b'(')? {
        layer.metadata = reader.metadata()?.kept;
    }
    loop {
        match reader.lexer.next()? {
            Token::End => return Ok(layer),
            Token::Name("reorder") => reader.assigned()?,
            Token::Name(word) => {
                let specifier = specifier(word);
                let specifier = specifier.ok_or_else(|| reader.unknown(word))?;
                layer.prims.push(reader.prim(specifier)?);
            }
            Token::Mark(b';') => {}
            other => return Err(reader.unknown(other)),
        }
    }
}

fn specifier(word: &str) -> Option<Specifier> {
    Specifier::ALL.into_iter().find(|s| s.word() == word)
}

/// Metadata of a prim or property.
#[derive(Default)]
struct Metadata {
    kept: Vec<(String, Value)>,
    schemas: Vec<String>,
    arcs: Vec<String>,
}

struct Reader<'a> {
    lexer: Lexer<'a>,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn unknown(&self, what: impl std::fmt::Display) -> String {
        self.lexer.fault(format!("{what} has no place here"))
    }

    /// One level more.
    fn deeper(&mut self) -> Result<(), String> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self.lexer.fault(format!("nested more than {MAX_DEPTH} deep")));
        }
        Ok(())
    }

    fn name(&mut self) -> Result<&'a str, String> {
        match self.lexer.next()? {
            Token::Name(name) => Ok(name),
            other => Err(self.lexer.fault(format!("a name is expected, not {other}"))),
        }
    }

    fn string(&mut self) -> Result<String, String> {
        match self.lexer.next()? {
            Token::Text(text) => Ok(text),
            other => Err(self.lexer.fault(format!("a string is expected, not {other}"))),
        }
    }

    /// A prim, after its specifier.
    fn prim(&mut self, specifier: Specifier) -> Result<Prim, String> {
        self.deeper()?;
        let mut prim = Prim { specifier, ..Prim::default() };
        if let Token::Name(kind) = *self.lexer.peek()? {
            prim.type_name = kind.into();
            self.lexer.next()?;
        }
        prim.name = self.string()?;
        if self.lexer.takes(b'(')? {
            let metadata = self.metadata()?;
            (prim.metadata, prim.schemas) = (metadata.kept, metadata.schemas);
            prim.arcs = metadata.arcs;
        }
        self.lexer.expect(b'{')?;
        self.body(&mut prim)?;
        self.depth -= 1;
        Ok(prim)
    }

    /// Reads the contents of a prim, to its closing brace.
    fn body(&mut self, prim: &mut Prim) -> Result<(), String> {
        loop {
            match self.lexer.next()? {
                Token::Mark(b'}') => return Ok(()),
                Token::Mark(b';') => {}
                Token::Name("variantSet") => {
                    self.variants()?;
                    if !prim.arcs.iter().any(|arc| arc == "variantSets") {
                        prim.arcs.push("variantSets".into());
                    }
                }
                Token::Name("reorder") => self.assigned()?,
                Token::Name(word) => match specifier(word) {
                    Some(specifier) => {
                        let child = self.prim(specifier)?;
                        prim.children.push(child);
                    }
                    None => {
                        self.property(word, prim)?;
                        prim.check_properties().map_err(|e| self.lexer.fault(e))?;
                    }
                },
                other => return Err(self.unknown(other)),
            }
        }
    }

    /// `nameChildren = [...]` and the like, passed over.
    fn assigned(&mut self) -> Result<(), String> {
        self.name()?;
        self.lexer.expect(b'=')?;
        self.pass()
    }

    /// The variants of a set, passed over.
    fn variants(&mut self) -> Result<(), String> {
        self.string()?;
        self.lexer.expect(b'=')?;
        self.pass()
    }

    /// A property, after its first word.
    fn property(&mut self, first: &'a str, prim: &mut Prim) -> Result<(), String> {
        let mut word = first;
        let (mut custom, mut uniform) = (false, false);
        loop {
            match word {
                "custom" => custom = true,
                "uniform" => uniform = true,
                "varying" | "config" | "prepend" | "append" | "add" | "delete" | "reorder" => {}
                _ => break,
            }
            word = self.name()?;
        }
        if word == "rel" {
            return self.relationship(prim);
        }
        let (type_name, full) = (word, self.name()?);
        let (name, part) = match full.rsplit_once('.') {
            Some((name, part)) => (name, part),
            None => (full, ""),
        };
        let at = prim.attributes.iter().position(|a| a.name == name).unwrap_or_else(|| {
            let (name, type_name) = (name.into(), type_name.into());
            prim.attributes.push(Attribute { name, type_name, ..Attribute::default() });
            prim.attributes.len() - 1
        });
        let attribute = &mut prim.attributes[at];
        attribute.custom |= custom;
        attribute.uniform |= uniform;
        match part {
            "" => {
                if self.lexer.takes(b'=')? {
                    let value = self.value_of(type_name)?;
                    attribute.value = value;
                }
            }
            "timeSamples" => {
                self.lexer.expect(b'=')?;
                let (first, times) = self.samples(type_name)?;
                attribute.times = times;
                if attribute.value.is_none() {
                    attribute.value = first;
                }
            }
            "connect" => {
                self.lexer.expect(b'=')?;
                attribute.connections.extend(self.paths()?);
            }
            _ => {
                self.lexer.expect(b'=')?;
                self.pass()?;
            }
        }
        if self.lexer.takes(b'(')? {
            let metadata = self.metadata()?;
            attribute.metadata.extend(metadata.kept);
        }
        Ok(())
    }

    fn relationship(&mut self, prim: &mut Prim) -> Result<(), String> {
        let name = self.name()?;
        let mut targets = Vec::new();
        if self.lexer.takes(b'=')? {
            targets = self.paths()?;
        }
        if self.lexer.takes(b'(')? {
            self.metadata()?;
        }
        match prim.relationships.iter_mut().find(|r| r.name == name) {
            Some(relationship) => relationship.targets.extend(targets),
            None => prim.relationships.push(Relationship { name: name.into(), targets }),
        }
        Ok(())
    }

    /// A path, several in brackets, or `None`.
    fn paths(&mut self) -> Result<Vec<String>, String> {
        let mut paths = Vec::new();
        let several = self.lexer.takes(b'[')?;
        loop {
            match self.lexer.next()? {
                Token::Path(path) => paths.push(path.to_owned()),
                Token::Name("None") if !several => return Ok(paths),
                Token::Mark(b']') if several => return Ok(paths),
                other => {
                    let problem = format!("a path is expected, not {other}");
                    return Err(self.lexer.fault(problem));
                }
            }
            if !several {
                return Ok(paths);
            }
            self.lexer.takes(b',')?;
        }
    }

    /// Metadata to its closing bracket.
    fn metadata(&mut self) -> Result<Metadata, String> {
        let mut metadata = Metadata::default();
        loop {
            match self.lexer.next()? {
                Token::Mark(b')') => return Ok(metadata),
                Token::Mark(b';' | b',') => {}
                Token::Text(text) => keep(&mut metadata, "documentation", Value::string(&text)),
                Token::Name("prepend" | "append" | "add" | "reorder") => {}
                Token::Name("delete") => {
                    self.name()?;
                    self.lexer.expect(b'=')?;
                    self.pass()?;
                }
                Token::Name(key) => self.entry(key, &mut metadata)?,
                other => return Err(self.unknown(other)),
            }
        }
    }

    /// An entry of metadata, after its key.
    fn entry(&mut self, key: &str, metadata: &mut Metadata) -> Result<(), String> {
        let key = if key == "doc" { "documentation" } else { key };
        self.lexer.expect(b'=')?;
        if key == "apiSchemas" {
            metadata.schemas.extend(self.schemas()?);
        } else if let Some(ty) = metadata_type(key) {
            if let Some(value) = self.value(ty, false)? {
                keep(metadata, key, value);
            }
        } else {
            if is_composition_arc(key) {
                metadata.arcs.push(key.into());
            }
            self.pass()?;
            // The layer offset of a reference.
            if is_composition_arc(key) && self.lexer.takes(b'(')? {
                self.pass_to(b')')?;
            }
        }
        Ok(())
    }

    fn schemas(&mut self) -> Result<Vec<String>, String> {
        let value = self.value(ValueType::one(ScalarType::Token), true)?;
        Ok(value.map(|v| v.all_words().to_vec()).unwrap_or_default())
    }

    fn value_of(&mut self, type_name: &str) -> Result<Option<Value>, String> {
        match ValueType::of(type_name) {
            Some((ty, array)) => self.value(ty, array),
            // Dictionaries, expressions and what is not known yet.
            None => self.pass().map(|()| None),
        }
    }

    /// A value; none for `None`.
    fn value(&mut self, ty: ValueType, array: bool) -> Result<Option<Value>, String> {
        if *self.lexer.peek()? == Token::Name("None") {
            self.lexer.next()?;
            return Ok(None);
        }
        let mut data = Data::empty(ty.scalar);
        if !array {
            self.one(ty, &mut data)?;
            return Ok(Some(Value { ty, array, data }));
        }
        self.lexer.expect(b'[')?;
        while !self.lexer.takes(b']')? {
            self.one(ty, &mut data)?;
            if !self.lexer.takes(b',')? {
                self.lexer.expect(b']')?;
                break;
            }
        }
        Ok(Some(Value { ty, array, data }))
    }

    /// The first of samples in time, which are in the order of time.
    fn samples(&mut self, type_name: &str) -> Result<(Option<Value>, usize), String> {
        self.lexer.expect(b'{')?;
        let (mut first, mut times) = (None, 0);
        while !self.lexer.takes(b'}')? {
            times += 1;
            self.lexer.number()?;
            self.lexer.expect(b':')?;
            if first.is_none() {
                first = self.value_of(type_name)?;
            } else {
                self.pass()?;
            }
            self.lexer.takes(b',')?;
        }
        Ok((first, times))
    }

    /// One value of a type.
    fn one(&mut self, ty: ValueType, data: &mut Data) -> Result<(), String> {
        match ty.shape {
            Shape::One => self.element(ty.scalar, data),
            Shape::Tuple(n) => self.tuple(ty.scalar, n, data),
            Shape::Quaternion => self.tuple(ty.scalar, 4, data),
            Shape::Matrix(n) => {
                self.lexer.expect(b'(')?;
                for _ in 0..n {
                    self.tuple(ty.scalar, n, data)?;
                    self.lexer.takes(b',')?;
                }
                self.lexer.expect(b')')
            }
        }
    }

    fn tuple(&mut self, scalar: ScalarType, n: usize, data: &mut Data) -> Result<(), String> {
        self.lexer.expect(b'(')?;
        for i in 0..n {
            self.element(scalar, data)?;
            if i + 1 < n {
                self.lexer.expect(b',')?;
            }
        }
        self.lexer.takes(b',')?;
        self.lexer.expect(b')')
    }

    fn element(&mut self, scalar: ScalarType, data: &mut Data) -> Result<(), String> {
        if let Data::Words(words) = data {
            let word = match self.lexer.next()? {
                Token::Text(text) => text,
                Token::Asset(asset) => asset.replace("\\@@@", "@@@"),
                // Metadata has some words without quotes.
                Token::Name(word) => word.to_owned(),
                other => {
                    let problem = format!("a word is expected, not {other}");
                    return Err(self.lexer.fault(problem));
                }
            };
            words.push(word);
            return Ok(());
        }
        let word = self.lexer.number()?;
        let bad = || format!("`{word}` is no {scalar:?}");
        let done = match data {
            Data::I32(v) => whole(word, scalar).map(|x| v.push(x)),
            Data::I64(v) if scalar == ScalarType::UInt64 => {
                word.parse::<u64>().ok().map(|x| v.push(x.cast_signed()))
            }
            Data::I64(v) => word.parse().ok().map(|x| v.push(x)),
            Data::F32(v) => word.parse().ok().map(|x| v.push(x)),
            Data::F64(v) => word.parse().ok().map(|x| v.push(x)),
            Data::Words(_) => None,
        };
        done.ok_or_else(|| self.lexer.fault(bad()))
    }

    /// Passes over one value of whatever kind.
    fn pass(&mut self) -> Result<(), String> {
        match self.lexer.next()? {
            Token::Mark(b'(') => self.pass_to(b')'),
            Token::Mark(b'[') => self.pass_to(b']'),
            Token::Mark(b'{') => self.pass_to(b'}'),
            Token::Asset(_) => {
                // The prim in another file.
                if let Token::Path(_) = self.lexer.peek()? {
                    self.lexer.next()?;
                }
                Ok(())
            }
            token @ (Token::Mark(_) | Token::End) => Err(self.unknown(token)),
            _ => Ok(()),
        }
    }

    /// Passes over everything to the mark that closes it.
    fn pass_to(&mut self, close: u8) -> Result<(), String> {
        let mut closes = vec![close];
        while let Some(&close) = closes.last() {
            match self.lexer.next()? {
                Token::Mark(mark) if mark == close => {
                    closes.pop();
                }
                Token::Mark(b'(') => closes.push(b')'),
                Token::Mark(b'[') => closes.push(b']'),
                Token::Mark(b'{') => closes.push(b'}'),
                token @ (Token::Mark(b')' | b']' | b'}') | Token::End) => {
                    let problem = format!("`{}` is expected, not {token}", char::from(close));
                    return Err(self.lexer.fault(problem));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

fn keep(metadata: &mut Metadata, key: &str, value: Value) {
    if metadata.kept.iter().all(|(k, _)| k != key) {
        metadata.kept.push((key.into(), value));
    }
}

/// A small whole number, or a word for yes and no.
fn whole(word: &str, scalar: ScalarType) -> Option<i32> {
    match (scalar, word) {
        (ScalarType::Bool, "true" | "True" | "yes") => Some(1),
        (ScalarType::Bool, "false" | "False" | "no") => Some(0),
        _ => word.parse().ok(),
    }
}
