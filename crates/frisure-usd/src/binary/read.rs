//! Layers read from binary.

use std::collections::BTreeMap;

use super::structure::{self, Structure};
use super::values::Source;
use super::{ValueRep, spec};
use crate::layer::{
    Attribute, Layer, Prim, Relationship, Specifier, is_composition_arc, metadata_type,
};
use crate::value::Value;

/// A layer, or what is wrong with it.
pub(crate) fn read(bytes: &[u8]) -> Result<Layer, String> {
    let (structure, budget) = structure::read(bytes)?;
    let tree = Tree::of(&structure)?;
    let mut reader = Reader { source: Source { bytes, structure, budget }, tree };
    reader.layer()
}

/// The tree of paths.
struct Tree {
    /// The spec of each path: where its set of fields begins, what it is.
    specs: Vec<Option<(u32, u32)>>,
    /// The paths in each, as the tree has them.
    children: Vec<Vec<u32>>,
    root: u32,
}

impl Tree {
    fn of(structure: &Structure) -> Result<Self, String> {
        let count = structure.nodes.len();
        let mut specs = vec![None; count];
        for &[path, set, kind] in &structure.specs {
            let slot = specs.get_mut(path as usize);
            let slot = slot.ok_or_else(|| format!("a spec is of path {path} of {count}"))?;
            if slot.is_some() {
                return Err(format!("path {path} has two specs"));
            }
            *slot = Some((set, kind));
        }
        let mut children = vec![Vec::new(); count];
        for &path in &structure.order {
            if let Some(parent) = structure.nodes[path as usize].parent {
                children[parent as usize].push(path);
            }
        }
        let root = structure.order.first().copied().ok_or("it has no paths")?;
        Ok(Self { specs, children, root })
    }
}

/// The fields of a spec.
type Fields = BTreeMap<String, ValueRep>;

struct Reader<'a> {
    source: Source<'a>,
    tree: Tree,
}

impl Reader<'_> {
    fn layer(&mut self) -> Result<Layer, String> {
        let root = self.tree.root;
        let (fields, _) = self
            .spec(root)?
            .filter(|(_, kind)| *kind == spec::ROOT)
            .ok_or("its first path is not the root")?;
        let metadata = self.metadata(&fields)?;
        Ok(Layer { metadata, prims: self.prims(root, &fields)? })
    }

    /// The fields of a path's spec, and what it is.
    fn spec(&mut self, path: u32) -> Result<Option<(Fields, u32)>, String> {
        let Some((set, kind)) = self.tree.specs[path as usize] else { return Ok(None) };
        let structure = &self.source.structure;
        let own = structure.sets.get(set as usize..);
        let own = own.ok_or_else(|| {
            format!("a spec has fields {set}, and there are {}", structure.sets.len())
        })?;
        let mut fields = Fields::new();
        for &field in own.iter().take_while(|field| **field != u32::MAX) {
            let field = structure.fields.get(field as usize).ok_or_else(|| {
                format!("a spec has field {field}, and there are {}", structure.fields.len())
            })?;
            let name = structure.word(field.0)?;
            // Many specs can have the same set.
            self.source.budget.take(name.len() as u64 + 64, 1)?;
            if fields.insert(name.to_owned(), field.1).is_some() {
                // Also what ends a set that has no end: a spec has a field of a name once.
                return Err(format!("a spec has `{name}` twice"));
            }
        }
        Ok(Some((fields, kind)))
    }

    fn metadata(&mut self, fields: &Fields) -> Result<Vec<(String, Value)>, String> {
        let mut metadata = Vec::new();
        for (key, rep) in fields.iter().filter(|(key, _)| metadata_type(key).is_some()) {
            if let Some(value) = self.source.value(*rep)? {
                metadata.push((key.clone(), value));
            }
        }
        Ok(metadata)
    }

    /// The children of a path, in the order of a field.
    fn inside(&self, path: u32, properties: bool, order: &[String]) -> Result<Vec<u32>, String> {
        let structure = &self.source.structure;
        let mut named = BTreeMap::new();
        for &child in &self.tree.children[path as usize] {
            let node = structure.nodes[child as usize];
            if node.is_property == properties {
                named.insert(structure.word(node.name)?, child);
            }
        }
        // Each once, whatever the field says.
        Ok(order.iter().filter_map(|name| named.remove(name.as_str())).collect())
    }

    fn prims(&mut self, path: u32, fields: &Fields) -> Result<Vec<Prim>, String> {
        let Some(order) = fields.get("primChildren") else { return Ok(Vec::new()) };
        let order = self.source.words(*order)?;
        let mut prims = Vec::new();
        for child in self.inside(path, false, &order)? {
            if let Some((fields, spec::PRIM)) = self.spec(child)? {
                prims.push(self.prim(child, &fields)?);
            }
        }
        Ok(prims)
    }

    fn prim(&mut self, path: u32, fields: &Fields) -> Result<Prim, String> {
        let name = self.name(path)?;
        let mut prim = Prim { name, ..Prim::default() };
        if let Some(kind) = self.token(fields, "typeName")? {
            prim.type_name = kind;
        }
        if let Some(rep) = fields.get("specifier") {
            let which = usize::try_from(rep.payload()).unwrap_or(0);
            prim.specifier = *Specifier::ALL.get(which).unwrap_or(&Specifier::Over);
        }
        if let Some(rep) = fields.get("apiSchemas") {
            prim.schemas = self.source.words(*rep)?;
        }
        prim.metadata = self.metadata(fields)?;
        let arcs = fields.keys().map(|key| match key.as_str() {
            "variantSetNames" => "variantSets",
            "inheritPaths" => "inherits",
            key => key,
        });
        prim.arcs = arcs.filter(|key| is_composition_arc(key)).map(str::to_owned).collect();
        if let Some(order) = fields.get("properties") {
            let order = self.source.words(*order)?;
            for property in self.inside(path, true, &order)? {
                self.property(property, &mut prim)?;
                prim.check_properties()?;
            }
        }
        prim.children = self.prims(path, fields)?;
        Ok(prim)
    }

    fn name(&mut self, path: u32) -> Result<String, String> {
        let node = self.source.structure.nodes[path as usize];
        let name = self.source.structure.word(node.name)?.to_owned();
        self.source.budget.take(name.len() as u64, 1)?;
        Ok(name)
    }

    fn token(&mut self, fields: &Fields, key: &str) -> Result<Option<String>, String> {
        let Some(rep) = fields.get(key) else { return Ok(None) };
        let value = self.source.value(*rep)?;
        Ok(value.and_then(|v| v.word().map(str::to_owned)))
    }

    fn property(&mut self, path: u32, prim: &mut Prim) -> Result<(), String> {
        let Some((fields, kind)) = self.spec(path)? else { return Ok(()) };
        let name = self.name(path)?;
        let wrong = |e: String| format!("`{name}` of prim `{}`: {e}", prim.name);
        match kind {
            spec::ATTRIBUTE => {
                let attribute = self.attribute(&name, &fields).map_err(wrong)?;
                prim.attributes.push(attribute);
            }
            spec::RELATIONSHIP => {
                let targets = self.paths(&fields, "targetPaths").map_err(wrong)?;
                prim.relationships.push(Relationship { name, targets });
            }
            _ => {}
        }
        Ok(())
    }

    fn attribute(&mut self, name: &str, fields: &Fields) -> Result<Attribute, String> {
        let is = |key: &str| fields.get(key).is_some_and(|rep| rep.payload() == 1);
        let mut attribute = Attribute {
            name: name.into(),
            type_name: self.token(fields, "typeName")?.unwrap_or_default(),
            uniform: is("variability"),
            custom: is("custom"),
            connections: self.paths(fields, "connectionPaths")?,
            metadata: self.metadata(fields)?,
            value: None,
            samples: Vec::new(),
            times: 0,
        };
        if let Some(rep) = fields.get("default") {
            attribute.value = self.source.value(*rep)?;
        }
        if let Some(rep) = fields.get("timeSamples") {
            let (first, times) = self.source.first_sample(*rep)?;
            attribute.times = times;
            attribute.value = attribute.value.or(first);
        }
        Ok(attribute)
    }

    /// The paths of a field, as text.
    fn paths(&mut self, fields: &Fields, key: &str) -> Result<Vec<String>, String> {
        let Some(rep) = fields.get(key) else { return Ok(Vec::new()) };
        let paths = self.source.paths(*rep)?;
        let mut all = Vec::new();
        for path in paths {
            let text = self.path(path)?;
            self.source.budget.take(text.len() as u64 + 24, 1)?;
            all.push(text);
        }
        Ok(all)
    }

    fn path(&self, path: u32) -> Result<String, String> {
        let structure = &self.source.structure;
        let mut parts = Vec::new();
        let mut at = Some(path);
        while let Some(path) = at {
            let node = structure.nodes.get(path as usize);
            let node = node.ok_or_else(|| format!("it names path {path}"))?;
            if node.parent.is_some() {
                let mark = if node.is_property { "." } else { "/" };
                parts.push(format!("{mark}{}", structure.word(node.name)?));
            }
            at = node.parent;
        }
        parts.reverse();
        Ok(parts.concat())
    }
}
