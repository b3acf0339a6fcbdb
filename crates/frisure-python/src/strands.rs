//! Strands as arrays.

use std::sync::Arc;

use frisure::formats::groom::Groom;
use frisure::strands::{AttributeValues, Domain, Strands};
use pyo3::prelude::*;

use crate::array::{Memory, Row};

/// The drawn hairs or the guides of a hairstyle; they never change.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct StrandData {
    pub(crate) groom: Arc<Groom>,
    pub(crate) part: Part,
}

/// Which strands of a groom.
#[derive(Clone, Copy)]
pub(crate) enum Part {
    Hairs,
    Guides,
}

impl Part {
    fn of(self, groom: &Groom) -> &Strands {
        match self {
            Self::Hairs => &groom.hairs,
            Self::Guides => &groom.guides,
        }
    }
}

impl StrandData {
    fn strands(&self) -> &Strands {
        self.part.of(&self.groom)
    }

    /// Rows of the groom as an array.
    fn rows<R: Row>(&self, rows: &[R]) -> Memory {
        Memory::rows(self.groom.clone(), rows)
    }
}

#[pymethods]
impl StrandData {
    /// Points (m), three numbers each.
    fn points(&self) -> Memory {
        self.rows(self.strands().points())
    }

    /// Radii at the points (m).
    fn radii(&self) -> Memory {
        self.rows(self.strands().radii())
    }

    /// Where each strand begins among the points; one more at the end.
    fn offsets(&self) -> Memory {
        self.rows(self.strands().offsets())
    }

    /// Names of the attributes, and whether each has a value per point (true) or per strand.
    fn attributes(&self) -> Vec<(String, bool)> {
        let attributes = self.strands().attributes().iter();
        attributes.map(|a| (a.name.clone(), a.domain == Domain::Point)).collect()
    }

    /// The values of an attribute; `None` if there is no such attribute.
    fn attribute(&self, name: &str) -> Option<Memory> {
        Some(match &self.strands().attribute(name)?.values {
            AttributeValues::U32(rows) => self.rows(rows),
            AttributeValues::U32x3(rows) => self.rows(rows),
            AttributeValues::F32(rows) => self.rows(rows),
            AttributeValues::F32x2(rows) => self.rows(rows),
            AttributeValues::F32x3(rows) => self.rows(rows),
        })
    }
}
