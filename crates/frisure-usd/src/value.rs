//! Values of attributes and metadata, flat.

use std::borrow::Cow;

/// The type of a single number or word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScalarType {
    /// `bool`
    Bool,
    /// `uchar`
    UChar,
    /// `int`
    Int,
    /// `uint`
    UInt,
    /// `int64`
    Int64,
    /// `uint64`
    UInt64,
    /// `half`
    Half,
    /// `float`
    Float,
    /// `double`
    Double,
    /// `timecode`
    TimeCode,
    /// `string`
    String,
    /// `token`
    Token,
    /// `asset`
    Asset,
}

/// How many scalars make one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A single number or word.
    One,
    /// A tuple of 2 to 4.
    Tuple(usize),
    /// Real part first.
    Quaternion,
    /// Square, row after row.
    Matrix(usize),
}

/// The type of a value, but for whether it is an array and for its role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ValueType {
    /// The type of its numbers or words.
    pub scalar: ScalarType,
    /// How many of them make one value.
    pub shape: Shape,
}

/// All types: code in binary layers, name in text, type.
pub(crate) const TYPES: [(u8, &str, ValueType); 31] = {
    use ScalarType::{Double, Float, Half, Int};
    const fn new(scalar: ScalarType, shape: Shape) -> ValueType {
        ValueType { scalar, shape }
    }
    [
        (1, "bool", ValueType::one(ScalarType::Bool)),
        (2, "uchar", ValueType::one(ScalarType::UChar)),
        (3, "int", ValueType::one(Int)),
        (4, "uint", ValueType::one(ScalarType::UInt)),
        (5, "int64", ValueType::one(ScalarType::Int64)),
        (6, "uint64", ValueType::one(ScalarType::UInt64)),
        (7, "half", ValueType::one(Half)),
        (8, "float", ValueType::one(Float)),
        (9, "double", ValueType::one(Double)),
        (10, "string", ValueType::one(ScalarType::String)),
        (11, "token", ValueType::one(ScalarType::Token)),
        (12, "asset", ValueType::one(ScalarType::Asset)),
        (13, "matrix2d", new(Double, Shape::Matrix(2))),
        (14, "matrix3d", new(Double, Shape::Matrix(3))),
        (15, "matrix4d", new(Double, Shape::Matrix(4))),
        (16, "quatd", new(Double, Shape::Quaternion)),
        (17, "quatf", new(Float, Shape::Quaternion)),
        (18, "quath", new(Half, Shape::Quaternion)),
        (19, "double2", ValueType::tuple(Double, 2)),
        (20, "float2", ValueType::tuple(Float, 2)),
        (21, "half2", ValueType::tuple(Half, 2)),
        (22, "int2", ValueType::tuple(Int, 2)),
        (23, "double3", ValueType::tuple(Double, 3)),
        (24, "float3", ValueType::tuple(Float, 3)),
        (25, "half3", ValueType::tuple(Half, 3)),
        (26, "int3", ValueType::tuple(Int, 3)),
        (27, "double4", ValueType::tuple(Double, 4)),
        (28, "float4", ValueType::tuple(Float, 4)),
        (29, "half4", ValueType::tuple(Half, 4)),
        (30, "int4", ValueType::tuple(Int, 4)),
        (56, "timecode", ValueType::one(ScalarType::TimeCode)),
    ]
};

impl ValueType {
    /// A single number or word.
    pub const fn one(scalar: ScalarType) -> Self {
        Self { scalar, shape: Shape::One }
    }

    /// A tuple of `n` numbers.
    pub const fn tuple(scalar: ScalarType, n: usize) -> Self {
        Self { scalar, shape: Shape::Tuple(n) }
    }

    /// How many numbers or words one value has.
    pub fn width(self) -> usize {
        match self.shape {
            Shape::One => 1,
            Shape::Tuple(n) => n,
            Shape::Quaternion => 4,
            Shape::Matrix(n) => n * n,
        }
    }

    /// The type of a name such as `point3f[]`, and whether it is an array.
    pub fn of(name: &str) -> Option<(Self, bool)> {
        let (name, array) = match name.strip_suffix("[]") {
            Some(name) => (name, true),
            None => (name, false),
        };
        let name = without_role(name);
        let (.., ty) = TYPES.iter().find(|(_, known, _)| *known == name)?;
        Some((*ty, array))
    }
}

/// The name of a type without its role: `float3` of `point3f`.
fn without_role(name: &str) -> Cow<'_, str> {
    if name == "frame4d" {
        return "matrix4d".into();
    }
    let roles = ["point", "vector", "normal", "color", "texCoord"];
    let rest = roles.iter().find_map(|role| name.strip_prefix(role));
    match rest.and_then(|rest| rest.split_at_checked(1)) {
        Some((size, "h")) => format!("half{size}").into(),
        Some((size, "f")) => format!("float{size}").into(),
        Some((size, "d")) => format!("double{size}").into(),
        _ => name.into(),
    }
}

/// Numbers or words, all values one after another.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    /// Values of `bool`, `uchar` and `int`.
    I32(Vec<i32>),
    /// Values of the wider integers; of `uint64` the same bits.
    I64(Vec<i64>),
    /// Values of `half` and `float`.
    F32(Vec<f32>),
    /// Values of `double` and `timecode`.
    F64(Vec<f64>),
    /// Values of `string`, `token` and `asset`.
    Words(Vec<String>),
}

impl Data {
    /// No values, as those of a scalar type are stored.
    pub fn empty(scalar: ScalarType) -> Self {
        match scalar {
            ScalarType::Bool | ScalarType::UChar | ScalarType::Int => Self::I32(Vec::new()),
            ScalarType::UInt | ScalarType::Int64 | ScalarType::UInt64 => Self::I64(Vec::new()),
            ScalarType::Half | ScalarType::Float => Self::F32(Vec::new()),
            ScalarType::Double | ScalarType::TimeCode => Self::F64(Vec::new()),
            ScalarType::String | ScalarType::Token | ScalarType::Asset => Self::Words(Vec::new()),
        }
    }

    /// How many numbers or words there are.
    #[expect(clippy::len_without_is_empty, reason = "no caller needs `is_empty`")]
    pub fn len(&self) -> usize {
        match self {
            Self::I32(v) => v.len(),
            Self::I64(v) => v.len(),
            Self::F32(v) => v.len(),
            Self::F64(v) => v.len(),
            Self::Words(v) => v.len(),
        }
    }

    /// Some of the values, each of `width` scalars, in an order.
    ///
    /// # Panics
    /// If there is no such value.
    #[must_use]
    pub fn picked(&self, rows: &[usize], width: usize) -> Self {
        fn of<T: Clone>(values: &[T], rows: &[usize], width: usize) -> Vec<T> {
            rows.iter().flat_map(|&i| values[i * width..(i + 1) * width].iter().cloned()).collect()
        }
        match self {
            Self::I32(v) => Self::I32(of(v, rows, width)),
            Self::I64(v) => Self::I64(of(v, rows, width)),
            Self::F32(v) => Self::F32(of(v, rows, width)),
            Self::F64(v) => Self::F64(of(v, rows, width)),
            Self::Words(v) => Self::Words(of(v, rows, width)),
        }
    }

    /// All numbers; none of words.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        Some(match self {
            Self::I32(v) => v.iter().map(|&x| f64::from(x)).collect(),
            Self::I64(v) => v.iter().map(|&x| x as f64).collect(),
            Self::F32(v) => v.iter().map(|&x| f64::from(x)).collect(),
            Self::F64(v) => v.clone(),
            Self::Words(_) => return None,
        })
    }
}

/// The value of an attribute or a metadata key.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// The type of one value.
    pub ty: ValueType,
    /// Whether it is an array.
    pub array: bool,
    /// Its numbers or words.
    pub data: Data,
}

impl Value {
    fn single(scalar: ScalarType, data: Data) -> Self {
        Self { ty: ValueType::one(scalar), array: false, data }
    }

    fn several<const N: usize>(scalar: ScalarType, array: bool, data: Data) -> Self {
        Self { ty: ValueType::tuple(scalar, N), array, data }
    }

    /// A token.
    pub fn token(word: &str) -> Self {
        Self::single(ScalarType::Token, Data::Words(vec![word.into()]))
    }

    /// A string.
    pub fn string(text: &str) -> Self {
        Self::single(ScalarType::String, Data::Words(vec![text.into()]))
    }

    /// A double.
    pub fn double(x: f64) -> Self {
        Self::single(ScalarType::Double, Data::F64(vec![x]))
    }

    /// A float.
    pub fn float(x: f32) -> Self {
        Self::single(ScalarType::Float, Data::F32(vec![x]))
    }

    /// A truth value.
    pub fn bool(x: bool) -> Self {
        Self::single(ScalarType::Bool, Data::I32(vec![x.into()]))
    }

    /// The path of an asset, such as a texture.
    pub fn asset(path: &str) -> Self {
        Self::single(ScalarType::Asset, Data::Words(vec![path.into()]))
    }

    /// An int.
    pub fn int(x: i32) -> Self {
        Self::single(ScalarType::Int, Data::I32(vec![x]))
    }

    /// A tuple of three floats.
    pub fn float3(x: [f32; 3]) -> Self {
        Self::several::<3>(ScalarType::Float, false, Data::F32(x.to_vec()))
    }

    /// An array of ints.
    pub fn ints(data: Vec<i32>) -> Self {
        Self { array: true, ..Self::single(ScalarType::Int, Data::I32(data)) }
    }

    /// An array of floats.
    pub fn floats(data: Vec<f32>) -> Self {
        Self { array: true, ..Self::single(ScalarType::Float, Data::F32(data)) }
    }

    /// An array of tuples of ints.
    pub fn int_tuples<const N: usize>(data: &[[i32; N]]) -> Self {
        Self::several::<N>(ScalarType::Int, true, Data::I32(data.as_flattened().to_vec()))
    }

    /// An array of tuples of floats.
    pub fn float_tuples<const N: usize>(data: &[[f32; N]]) -> Self {
        Self::several::<N>(ScalarType::Float, true, Data::F32(data.as_flattened().to_vec()))
    }

    /// How many values there are.
    #[expect(clippy::len_without_is_empty, reason = "no caller needs `is_empty`")]
    pub fn len(&self) -> usize {
        self.data.len() / self.ty.width()
    }

    /// The only word.
    pub fn word(&self) -> Option<&str> {
        match &self.data {
            Data::Words(words) if words.len() == 1 => Some(&words[0]),
            _ => None,
        }
    }

    /// Words, of an array or single.
    pub fn all_words(&self) -> &[String] {
        match &self.data {
            Data::Words(words) => words,
            _ => &[],
        }
    }

    /// All numbers; none of words.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        self.data.numbers()
    }

    /// The only number.
    pub fn number(&self) -> Option<f64> {
        if self.data.len() != 1 {
            return None;
        }
        self.numbers()?.first().copied()
    }

    /// Numbers as `f32`; none of words.
    pub fn to_floats(&self) -> Option<Vec<f32>> {
        match &self.data {
            Data::F32(v) => Some(v.clone()),
            _ => Some(self.numbers()?.iter().map(|&x| x as f32).collect()),
        }
    }

    /// Whole numbers; none of others.
    pub fn to_integers(&self) -> Option<Vec<i64>> {
        match &self.data {
            Data::I32(v) => Some(v.iter().map(|&x| i64::from(x)).collect()),
            Data::I64(v) => Some(v.clone()),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_types() {
        let of = |name| ValueType::of(name).unwrap();
        assert_eq!(of("int"), (ValueType::one(ScalarType::Int), false));
        assert_eq!(of("int3[]"), (ValueType::tuple(ScalarType::Int, 3), true));
        assert_eq!(of("point3f[]"), (ValueType::tuple(ScalarType::Float, 3), true));
        assert_eq!(of("texCoord2h"), (ValueType::tuple(ScalarType::Half, 2), false));
        assert_eq!(of("double4").0.width(), 4);
        assert_eq!(of("matrix3d").0.width(), 9);
        assert_eq!(of("quatf").0.shape, Shape::Quaternion);
        for name in
            ["", "int5", "point3", "point3x", "quat", "matrix9d", "é", "pointé", "dictionary"]
        {
            assert_eq!(ValueType::of(name), None, "{name}");
        }
    }
}
