//! Layers written as text.

use std::io::{self, Write};

use crate::layer::{Attribute, Layer, Prim, Relationship};
use crate::value::{Data, ScalarType, Shape, Value, ValueType};

/// Bytes that are collected before they are written.
const BUFFER: usize = 1 << 16;

/// Writes a layer.
pub fn write(out: &mut dyn Write, layer: &Layer) -> io::Result<()> {
    let mut text = Text { out, buffer: Vec::with_capacity(2 * BUFFER), depth: 0 };
    text.word("#usda 1.0\n(\n");
    for (key, value) in &layer.metadata {
        text.word("    ");
        text.metadata(key, value)?;
        text.word("\n");
    }
    text.word(")\n");
    for prim in &layer.prims {
        text.word("\n");
        text.prim(prim)?;
    }
    text.out.write_all(&text.buffer)
}

struct Text<'a> {
    out: &'a mut dyn Write,
    buffer: Vec<u8>,
    depth: usize,
}

impl Text<'_> {
    fn word(&mut self, word: &str) {
        self.buffer.extend_from_slice(word.as_bytes());
    }

    fn words(&mut self, words: &[&str]) {
        words.iter().for_each(|word| self.word(word));
    }

    fn indent(&mut self) {
        for _ in 0..self.depth {
            self.word("    ");
        }
    }

    /// Begins a line.
    fn line(&mut self, words: &[&str]) {
        self.indent();
        self.words(words);
    }

    /// Writes what is collected, if it is much.
    fn pass(&mut self) -> io::Result<()> {
        if self.buffer.len() > BUFFER {
            self.out.write_all(&self.buffer)?;
            self.buffer.clear();
        }
        Ok(())
    }

    fn metadata(&mut self, key: &str, value: &Value) -> io::Result<()> {
        // The text of a layer or prim has another name in text than in binary.
        let key = if key == "documentation" { "doc" } else { key };
        self.words(&[key, " = "]);
        self.value(value)
    }

    fn prim(&mut self, prim: &Prim) -> io::Result<()> {
        self.line(&[prim.specifier.word(), " "]);
        if !prim.type_name.is_empty() {
            self.words(&[&prim.type_name, " "]);
        }
        self.quoted(&prim.name);
        self.about(prim)?;
        self.word("\n");
        self.line(&["{\n"]);
        self.depth += 1;
        for attribute in &prim.attributes {
            self.attribute(attribute)?;
        }
        for relationship in &prim.relationships {
            self.relationship(relationship);
        }
        for (i, child) in prim.children.iter().enumerate() {
            if i > 0 || !prim.attributes.is_empty() || !prim.relationships.is_empty() {
                self.word("\n");
            }
            self.prim(child)?;
        }
        self.depth -= 1;
        self.line(&["}\n"]);
        Ok(())
    }

    /// The metadata of a prim.
    fn about(&mut self, prim: &Prim) -> io::Result<()> {
        if prim.schemas.is_empty() && prim.metadata.is_empty() {
            return Ok(());
        }
        self.word(" (\n");
        self.depth += 1;
        if !prim.schemas.is_empty() {
            self.line(&["prepend apiSchemas = ["]);
            for (i, schema) in prim.schemas.iter().enumerate() {
                self.word(if i > 0 { ", " } else { "" });
                self.quoted(schema);
            }
            self.word("]\n");
        }
        self.entries(&prim.metadata)
    }

    fn attribute(&mut self, attribute: &Attribute) -> io::Result<()> {
        let custom = if attribute.custom { "custom " } else { "" };
        let uniform = if attribute.uniform { "uniform " } else { "" };
        let head = [custom, uniform, &attribute.type_name, " ", &attribute.name];
        if attribute.value.is_some() || attribute.connections.is_empty() {
            self.line(&head);
            if let Some(value) = &attribute.value {
                self.word(" = ");
                self.value(value)?;
            }
            self.brackets(&attribute.metadata)?;
            self.word("\n");
        }
        if !attribute.samples.is_empty() {
            self.line(&head);
            self.word(".timeSamples = {\n");
            self.depth += 1;
            for (time, value) in &attribute.samples {
                self.line(&[&time.to_string(), ": "]);
                self.value(value)?;
                self.word(",\n");
            }
            self.depth -= 1;
            self.line(&["}\n"]);
        }
        if !attribute.connections.is_empty() {
            self.line(&head);
            self.word(".connect = ");
            self.paths(&attribute.connections);
        }
        Ok(())
    }

    /// Metadata, a line each, and the bracket that closes them.
    fn entries(&mut self, metadata: &[(String, Value)]) -> io::Result<()> {
        for (key, value) in metadata {
            self.indent();
            self.metadata(key, value)?;
            self.word("\n");
        }
        self.depth -= 1;
        self.line(&[")"]);
        Ok(())
    }

    /// The metadata of an attribute.
    fn brackets(&mut self, metadata: &[(String, Value)]) -> io::Result<()> {
        if metadata.is_empty() {
            return Ok(());
        }
        self.word(" (\n");
        self.depth += 1;
        self.entries(metadata)
    }

    fn relationship(&mut self, relationship: &Relationship) {
        self.line(&["rel ", &relationship.name]);
        if relationship.targets.is_empty() {
            return self.word("\n");
        }
        self.word(" = ");
        self.paths(&relationship.targets);
    }

    fn paths(&mut self, paths: &[String]) {
        match paths {
            [path] => self.words(&["<", path, ">\n"]),
            _ => {
                let all: Vec<_> = paths.iter().map(|path| format!("<{path}>")).collect();
                self.words(&["[", &all.join(", "), "]\n"]);
            }
        }
    }

    fn value(&mut self, value: &Value) -> io::Result<()> {
        if !value.array {
            self.one(value.ty, &value.data, 0);
            return self.pass();
        }
        self.word("[");
        for i in 0..value.len() {
            if i > 0 {
                self.word(", ");
            }
            self.one(value.ty, &value.data, i * value.ty.width());
            self.pass()?;
        }
        self.word("]");
        Ok(())
    }

    /// The value that begins with this number or word.
    fn one(&mut self, ty: ValueType, data: &Data, at: usize) {
        match ty.shape {
            Shape::One => self.element(ty.scalar, data, at),
            Shape::Tuple(_) | Shape::Quaternion => self.tuple(ty, data, at, ty.width()),
            Shape::Matrix(n) => {
                self.word("( ");
                for row in 0..n {
                    if row > 0 {
                        self.word(", ");
                    }
                    self.tuple(ty, data, at + row * n, n);
                }
                self.word(" )");
            }
        }
    }

    fn tuple(&mut self, ty: ValueType, data: &Data, at: usize, n: usize) {
        for i in 0..n {
            self.word(if i > 0 { ", " } else { "(" });
            self.element(ty.scalar, data, at + i);
        }
        self.word(")");
    }

    fn element(&mut self, scalar: ScalarType, data: &Data, at: usize) {
        match data {
            Data::I32(v) if scalar == ScalarType::Bool => {
                self.word(if v[at] == 0 { "false" } else { "true" });
            }
            Data::I32(v) => self.integer(i64::from(v[at])),
            Data::I64(v) if scalar == ScalarType::UInt64 => self.word(&(v[at] as u64).to_string()),
            Data::I64(v) => self.integer(v[at]),
            Data::F32(v) => self.float(v[at]),
            Data::F64(v) => self.word(&v[at].to_string()),
            // What has an `@` is between three of them.
            Data::Words(v) if scalar == ScalarType::Asset => {
                let mark = if v[at].contains('@') { "@@@" } else { "@" };
                self.words(&[mark, &v[at].replace("@@@", "\\@@@"), mark]);
            }
            Data::Words(v) => self.quoted(&v[at]),
        }
    }

    fn integer(&mut self, x: i64) {
        // A formatter costs more than the digits.
        let mut digits = [0_u8; 20];
        let (mut rest, mut first) = (x.unsigned_abs(), digits.len());
        loop {
            first -= 1;
            digits[first] = b'0' + (rest % 10) as u8;
            rest /= 10;
            if rest == 0 {
                break;
            }
        }
        if x < 0 {
            self.word("-");
        }
        self.buffer.extend_from_slice(&digits[first..]);
    }

    /// Writes the shortest text that reads back as the same number.
    fn float(&mut self, x: f32) {
        if x == 0.0 {
            self.word(if x.is_sign_negative() { "-0" } else { "0" });
        } else if x == x.trunc() && x.abs() < 1e6 {
            self.integer(x as i64);
        } else if x.is_finite() {
            let mut digits = zmij::Buffer::new();
            self.word(digits.format_finite(x));
        } else {
            self.word(if x.is_nan() {
                "nan"
            } else if x < 0.0 {
                "-inf"
            } else {
                "inf"
            });
        }
    }

    fn quoted(&mut self, text: &str) {
        self.word("\"");
        for c in text.chars() {
            match c {
                '"' => self.word("\\\""),
                '\\' => self.word("\\\\"),
                '\n' => self.word("\\n"),
                '\r' => self.word("\\r"),
                '\t' => self.word("\\t"),
                c if c.is_control() && c.is_ascii() => self.word(&format!("\\x{:02x}", c as u32)),
                c => self.word(c.encode_utf8(&mut [0; 4])),
            }
        }
        self.word("\"");
    }
}
