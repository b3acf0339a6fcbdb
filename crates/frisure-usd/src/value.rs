//! Values of attributes and metadata, flat.

/// What single numbers and words of a value are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
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

/// How many of them make one value.
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

/// The type of a value, but for whether it is an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kind {
    /// The type of its numbers or words.
    pub base: Base,
    /// How many of them make one value.
    pub shape: Shape,
}

impl Kind {
    /// A single number or word.
    pub const fn one(base: Base) -> Self {
        Self { base, shape: Shape::One }
    }

    /// A tuple of `n` numbers.
    pub const fn tuple(base: Base, n: usize) -> Self {
        Self { base, shape: Shape::Tuple(n) }
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

    /// The kind that a type's name stands for, and whether it is an array.
    pub fn of(name: &str) -> Option<(Self, bool)> {
        let (name, array) = match name.strip_suffix("[]") {
            Some(name) => (name, true),
            None => (name, false),
        };
        Some((Self::of_one(name)?, array))
    }

    fn of_one(name: &str) -> Option<Self> {
        let plain = match name {
            "bool" => Base::Bool,
            "uchar" => Base::UChar,
            "int" => Base::Int,
            "uint" => Base::UInt,
            "int64" => Base::Int64,
            "uint64" => Base::UInt64,
            "half" => Base::Half,
            "float" => Base::Float,
            "double" => Base::Double,
            "timecode" => Base::TimeCode,
            "string" => Base::String,
            "token" => Base::Token,
            "asset" => Base::Asset,
            "frame4d" => return Some(Self { base: Base::Double, shape: Shape::Matrix(4) }),
            _ => return Self::of_several(name),
        };
        Some(Self::one(plain))
    }

    fn of_several(name: &str) -> Option<Self> {
        if let Some(n) = name.strip_prefix("matrix").and_then(|n| n.strip_suffix('d')) {
            let n = n.parse().ok().filter(|n| (2..=4).contains(n))?;
            return Some(Self { base: Base::Double, shape: Shape::Matrix(n) });
        }
        let letter = |c: &str| match c {
            "h" => Some(Base::Half),
            "f" => Some(Base::Float),
            "d" => Some(Base::Double),
            _ => None,
        };
        if let Some(base) = name.strip_prefix("quat").and_then(letter) {
            return Some(Self { base, shape: Shape::Quaternion });
        }
        for role in ["point", "vector", "normal", "color", "texCoord"] {
            if let Some((n, base)) = name.strip_prefix(role).and_then(|r| r.split_at_checked(1)) {
                return Some(Self::tuple(letter(base)?, size(n)?));
            }
        }
        let (base, n) = name.split_at_checked(name.len().saturating_sub(1))?;
        let base = [Base::Int, Base::Half, Base::Float, Base::Double]
            .into_iter()
            .find(|b| Self::one(*b).name() == base)?;
        Some(Self::tuple(base, size(n)?))
    }

    /// The name of a type without a role.
    fn name(self) -> &'static str {
        match self.base {
            Base::Int => "int",
            Base::Half => "half",
            Base::Float => "float",
            Base::Double => "double",
            _ => "",
        }
    }
}

fn size(digit: &str) -> Option<usize> {
    digit.parse().ok().filter(|n| (2..=4).contains(n))
}

/// Numbers or words, all values one after another.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    /// Of `bool`, `uchar` and `int`.
    I32(Vec<i32>),
    /// Of the wider integers; of `uint64` the same bits.
    I64(Vec<i64>),
    /// Of `half` and `float`.
    F32(Vec<f32>),
    /// Of `double` and `timecode`.
    F64(Vec<f64>),
    /// Of `string`, `token` and `asset`.
    Words(Vec<String>),
}

impl Data {
    /// Nothing, of what a base is kept as.
    pub fn empty(base: Base) -> Self {
        match base {
            Base::Bool | Base::UChar | Base::Int => Self::I32(Vec::new()),
            Base::UInt | Base::Int64 | Base::UInt64 => Self::I64(Vec::new()),
            Base::Half | Base::Float => Self::F32(Vec::new()),
            Base::Double | Base::TimeCode => Self::F64(Vec::new()),
            Base::String | Base::Token | Base::Asset => Self::Words(Vec::new()),
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
}

/// The value of an attribute or a metadata key.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// The type of one value.
    pub kind: Kind,
    /// Whether it is an array.
    pub array: bool,
    /// Its numbers or words.
    pub data: Data,
}

impl Value {
    /// A token.
    pub fn token(word: &str) -> Self {
        Self::words(Base::Token, word)
    }

    /// A string.
    pub fn string(text: &str) -> Self {
        Self::words(Base::String, text)
    }

    fn words(base: Base, word: &str) -> Self {
        Self { kind: Kind::one(base), array: false, data: Data::Words(vec![word.into()]) }
    }

    /// A double.
    pub fn double(x: f64) -> Self {
        Self { kind: Kind::one(Base::Double), array: false, data: Data::F64(vec![x]) }
    }

    /// A float.
    pub fn float(x: f32) -> Self {
        Self { kind: Kind::one(Base::Float), array: false, data: Data::F32(vec![x]) }
    }

    /// An int.
    pub fn int(x: i32) -> Self {
        Self { kind: Kind::one(Base::Int), array: false, data: Data::I32(vec![x]) }
    }

    /// A tuple of three floats.
    pub fn float3(x: [f32; 3]) -> Self {
        Self { kind: Kind::tuple(Base::Float, 3), array: false, data: Data::F32(x.to_vec()) }
    }

    /// An array of ints.
    pub fn ints(data: Vec<i32>) -> Self {
        Self { kind: Kind::one(Base::Int), array: true, data: Data::I32(data) }
    }

    /// An array of tuples of ints.
    pub fn int_tuples<const N: usize>(data: &[[i32; N]]) -> Self {
        let data = Data::I32(data.as_flattened().to_vec());
        Self { kind: Kind::tuple(Base::Int, N), array: true, data }
    }

    /// An array of floats.
    pub fn floats(data: Vec<f32>) -> Self {
        Self { kind: Kind::one(Base::Float), array: true, data: Data::F32(data) }
    }

    /// An array of tuples of floats.
    pub fn float_tuples<const N: usize>(data: &[[f32; N]]) -> Self {
        let data = Data::F32(data.as_flattened().to_vec());
        Self { kind: Kind::tuple(Base::Float, N), array: true, data }
    }

    /// How many values there are.
    #[expect(clippy::len_without_is_empty, reason = "no caller needs `is_empty`")]
    pub fn len(&self) -> usize {
        self.data.len() / self.kind.width()
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
        Some(match &self.data {
            Data::I32(v) => v.iter().map(|&x| f64::from(x)).collect(),
            #[expect(clippy::cast_precision_loss, reason = "as near as may be")]
            Data::I64(v) => v.iter().map(|&x| x as f64).collect(),
            Data::F32(v) => v.iter().map(|&x| f64::from(x)).collect(),
            Data::F64(v) => v.clone(),
            Data::Words(_) => return None,
        })
    }

    /// The only number.
    pub fn number(&self) -> Option<f64> {
        if self.data.len() != 1 {
            return None;
        }
        self.numbers()?.first().copied()
    }

    /// Numbers as `f32`; none of words.
    #[expect(clippy::cast_possible_truncation, reason = "bulk data are of single precision")]
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
        let of = |name| Kind::of(name).unwrap();
        assert_eq!(of("int"), (Kind::one(Base::Int), false));
        assert_eq!(of("int3[]"), (Kind::tuple(Base::Int, 3), true));
        assert_eq!(of("point3f[]"), (Kind::tuple(Base::Float, 3), true));
        assert_eq!(of("texCoord2h"), (Kind::tuple(Base::Half, 2), false));
        assert_eq!(of("double4").0.width(), 4);
        assert_eq!(of("matrix3d").0.width(), 9);
        assert_eq!(of("quatf").0.shape, Shape::Quaternion);
        for name in
            ["", "int5", "point3", "point3x", "quat", "matrix9d", "é", "pointé", "dictionary"]
        {
            assert_eq!(Kind::of(name), None, "{name}");
        }
    }
}
