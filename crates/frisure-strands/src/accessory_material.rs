//! What accessories are made of, and which faces of a mesh are accessories.

/// What an accessory is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccessoryMaterial {
    /// Its name, in lower case with underscores.
    pub name: &'static str,
    /// Diffuse reflectance (linear sRGB).
    pub colour: [f32; 3],
    /// Strength of its gloss, in the unit of that of skin (`look.gloss`).
    pub gloss: f32,
    /// Roughness of its gloss (α of GGX).
    pub roughness: f32,
}

/// Which faces of a surface are accessories, and what these are made of.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AccessoryFaces {
    /// Number of faces before the first accessory.
    first: usize,
    /// For each accessory, the number of the face after its last one, and its material.
    ends: Vec<(usize, AccessoryMaterial)>,
}

impl AccessoryFaces {
    /// Accessories after `first` other faces; `ends` has the number of the face after the last one of each, rising.
    pub(crate) fn new(first: usize, ends: Vec<(usize, AccessoryMaterial)>) -> Self {
        Self { first, ends }
    }

    /// The material of a face; none of what is no accessory.
    pub(crate) fn material(&self, face: usize) -> Option<&AccessoryMaterial> {
        if face < self.first {
            return None;
        }
        let index = self.ends.partition_point(|(end, _)| *end <= face);
        self.ends.get(index).map(|(_, material)| material)
    }
}
