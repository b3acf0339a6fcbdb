//! Layers read from text.

use super::lexer::{Lexer, Token};
use crate::MAX_DEPTH;
use crate::layer::{
    Attribute, Layer, Prim, Relationship, Specifier, is_from_elsewhere, metadata_kind,
};
use crate::value::{Base, Data, Kind, Shape, Value};

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
            other => return Err(reader.unknown(&other.shown())),
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
    elsewhere: Vec<String>,
}

struct Reader<'a> {
    lexer: Lexer<'a>,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn unknown(&self, what: &str) -> String {
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
            other => Err(self.lexer.fault(format!("a name is expected, not {}", other.shown()))),
        }
    }

    fn string(&mut self) -> Result<String, String> {
        match self.lexer.next()? {
            Token::Text(text) => Ok(text),
            other => Err(self.lexer.fault(format!("a string is expected, not {}", other.shown()))),
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
            prim.elsewhere = metadata.elsewhere;
        }
        self.lexer.expect(b'{')?;
        self.body(&mut prim)?;
        self.depth -= 1;
        Ok(prim)
    }

    /// What is in a prim, to its closing brace.
    fn body(&mut self, prim: &mut Prim) -> Result<(), String> {
        loop {
            match self.lexer.next()? {
                Token::Mark(b'}') => return Ok(()),
                Token::Mark(b';') => {}
                Token::Name("variantSet") => {
                    self.variants()?;
                    if !prim.elsewhere.iter().any(|e| e == "variantSets") {
                        prim.elsewhere.push("variantSets".into());
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
                other => return Err(self.unknown(&other.shown())),
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
                let first = self.samples(type_name)?;
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
                    let problem = format!("a path is expected, not {}", other.shown());
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
                other => return Err(self.unknown(&other.shown())),
            }
        }
    }

    /// An entry of metadata, after its key.
    fn entry(&mut self, key: &str, metadata: &mut Metadata) -> Result<(), String> {
        let key = if key == "doc" { "documentation" } else { key };
        self.lexer.expect(b'=')?;
        if key == "apiSchemas" {
            metadata.schemas.extend(self.schemas()?);
        } else if let Some(kind) = metadata_kind(key) {
            if let Some(value) = self.value(kind, false)? {
                keep(metadata, key, value);
            }
        } else {
            if is_from_elsewhere(key) {
                metadata.elsewhere.push(key.into());
            }
            self.pass()?;
            // The layer offset of a reference.
            if is_from_elsewhere(key) && self.lexer.takes(b'(')? {
                self.pass_to(b')')?;
            }
        }
        Ok(())
    }

    fn schemas(&mut self) -> Result<Vec<String>, String> {
        let value = self.value(Kind::one(Base::Token), true)?;
        Ok(value.map(|v| v.all_words().to_vec()).unwrap_or_default())
    }

    fn value_of(&mut self, type_name: &str) -> Result<Option<Value>, String> {
        match Kind::of(type_name) {
            Some((kind, array)) => self.value(kind, array),
            // Dictionaries, expressions and what is not known yet.
            None => self.pass().map(|()| None),
        }
    }

    /// A value; none for `None`.
    fn value(&mut self, kind: Kind, array: bool) -> Result<Option<Value>, String> {
        if *self.lexer.peek()? == Token::Name("None") {
            self.lexer.next()?;
            return Ok(None);
        }
        let mut data = Data::empty(kind.base);
        if !array {
            self.one(kind, &mut data)?;
            return Ok(Some(Value { kind, array, data }));
        }
        self.lexer.expect(b'[')?;
        while !self.lexer.takes(b']')? {
            self.one(kind, &mut data)?;
            if !self.lexer.takes(b',')? {
                self.lexer.expect(b']')?;
                break;
            }
        }
        Ok(Some(Value { kind, array, data }))
    }

    /// The first of samples in time, which are in the order of time.
    fn samples(&mut self, type_name: &str) -> Result<Option<Value>, String> {
        self.lexer.expect(b'{')?;
        let mut first = None;
        while !self.lexer.takes(b'}')? {
            self.lexer.number()?;
            self.lexer.expect(b':')?;
            if first.is_none() {
                first = self.value_of(type_name)?;
            } else {
                self.pass()?;
            }
            self.lexer.takes(b',')?;
        }
        Ok(first)
    }

    /// One value of a kind.
    fn one(&mut self, kind: Kind, data: &mut Data) -> Result<(), String> {
        match kind.shape {
            Shape::One => self.element(kind.base, data),
            Shape::Tuple(n) => self.tuple(kind.base, n, data),
            Shape::Quaternion => self.tuple(kind.base, 4, data),
            Shape::Matrix(n) => {
                self.lexer.expect(b'(')?;
                for _ in 0..n {
                    self.tuple(kind.base, n, data)?;
                    self.lexer.takes(b',')?;
                }
                self.lexer.expect(b')')
            }
        }
    }

    fn tuple(&mut self, base: Base, n: usize, data: &mut Data) -> Result<(), String> {
        self.lexer.expect(b'(')?;
        for i in 0..n {
            self.element(base, data)?;
            if i + 1 < n {
                self.lexer.expect(b',')?;
            }
        }
        self.lexer.takes(b',')?;
        self.lexer.expect(b')')
    }

    fn element(&mut self, base: Base, data: &mut Data) -> Result<(), String> {
        if let Data::Words(words) = data {
            let word = match self.lexer.next()? {
                Token::Text(text) => text,
                Token::Asset(asset) => asset.to_owned(),
                // Metadata has some words without quotes.
                Token::Name(word) => word.to_owned(),
                other => {
                    let problem = format!("a word is expected, not {}", other.shown());
                    return Err(self.lexer.fault(problem));
                }
            };
            words.push(word);
            return Ok(());
        }
        let word = self.lexer.number()?;
        let bad = || format!("`{word}` is no {base:?}");
        let done = match data {
            Data::I32(v) => whole(word, base).map(|x| v.push(x)),
            Data::I64(v) if base == Base::UInt64 => {
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
            token @ (Token::Mark(_) | Token::End) => Err(self.unknown(&token.shown())),
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
                    let problem =
                        format!("`{}` is expected, not {}", char::from(close), token.shown());
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
fn whole(word: &str, base: Base) -> Option<i32> {
    match (base, word) {
        (Base::Bool, "true" | "True" | "yes") => Some(1),
        (Base::Bool, "false" | "False" | "no") => Some(0),
        _ => word.parse().ok(),
    }
}
