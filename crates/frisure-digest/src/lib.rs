//! Stable digests of named fields, for keys that are stored on disk: of checkpoints, batches and pictures.
//!
//! A digest depends on the names, types and values of the fields, and on nothing else: not on the compiler,
//! the platform, or how a type prints. It guards against accidents, not against forgers.
//!
//! ```
//! use frisure_digest::{Digest, digest_fields};
//!
//! struct Camera {
//!     eye: [f64; 3],
//!     f_number: Option<f64>,
//! }
//! digest_fields!(Camera { eye, f_number });
//!
//! let key = |camera: &Camera| Digest::new("camera").with("camera", camera).key();
//! let camera = Camera { eye: [0.0, -1.0, 0.2], f_number: None };
//! assert_eq!(key(&camera), key(&Camera { ..camera }));
//! assert_ne!(key(&camera), key(&Camera { f_number: Some(2.8), ..camera }));
//! ```

#![forbid(unsafe_code)]

use std::sync::Arc;

use glam::{DVec3, Vec3};
use twox_hash::XxHash3_128;
use twox_hash::xxhash3_128::Hasher;

/// A digest under construction: XXH3 with 128 bits over tagged fields.
#[derive(Clone)]
pub struct Digest(Hasher);

/// A value that a [`Digest`] can take.
pub trait Digestible {
    /// Adds the value, with its type, to `digest`.
    fn add_to(&self, digest: &mut Digest);
}

impl std::fmt::Debug for Digest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Digest({:032x})", self.0.finish_128())
    }
}

impl Digest {
    /// A digest without fields; digests of different subjects differ.
    #[must_use]
    pub fn new(subject: &str) -> Self {
        let mut digest = Self(Hasher::new());
        subject.add_to(&mut digest);
        digest
    }

    /// Adds a field.
    pub fn field<T: Digestible + ?Sized>(&mut self, name: &str, value: &T) -> &mut Self {
        name.add_to(self);
        value.add_to(self);
        self
    }

    /// The digest with one field more.
    #[must_use]
    pub fn with<T: Digestible + ?Sized>(mut self, name: &str, value: &T) -> Self {
        self.field(name, value);
        self
    }

    /// Adds a sequence of values that is not in memory as one.
    pub fn sequence<T: Digestible>(&mut self, name: &str, values: impl IntoIterator<Item = T>) {
        name.add_to(self);
        self.raw(b'[', &[]);
        values.into_iter().for_each(|value| value.add_to(self));
        self.raw(b']', &[]);
    }

    /// Adds a sequence of numbers as their little-endian bytes, with one tag for all of them: for the points of a
    /// hundred thousand hairs and the pixels of a picture.
    pub fn packed<const N: usize>(
        &mut self,
        name: &str,
        numbers: impl IntoIterator<Item = [u8; N]>,
    ) -> &mut Self {
        name.add_to(self);
        self.raw(b'p', &[]);
        let mut bytes = 0_u64;
        for number in numbers {
            self.0.write(&number);
            bytes += N as u64;
        }
        // The length stands at the end, where it is known.
        bytes.add_to(self);
        self
    }

    /// The digest of the fields so far.
    #[must_use]
    pub fn bytes(&self) -> [u8; 16] {
        self.0.finish_128().to_le_bytes()
    }

    /// The digest of the fields so far, as hexadecimal digits.
    #[must_use]
    pub fn text(&self) -> String {
        hexadecimal(self.bytes())
    }

    /// The first half of the digest of the fields so far.
    #[must_use]
    pub fn key(&self) -> u64 {
        self.0.finish_128() as u64
    }

    fn raw(&mut self, tag: u8, bytes: &[u8]) {
        self.0.write(&[tag]);
        self.0.write(bytes);
    }
}

/// A digest as 32 hexadecimal digits.
#[must_use]
pub fn hexadecimal(digest: [u8; 16]) -> String {
    digest.map(|byte| format!("{byte:02x}")).concat()
}

/// The digest of bytes without names: a checksum.
#[must_use]
pub fn checksum(bytes: &[u8]) -> [u8; 16] {
    XxHash3_128::oneshot(bytes).to_le_bytes()
}

macro_rules! numbers {
    ($($type:ty: $tag:literal),*) => {$(
        impl Digestible for $type {
            fn add_to(&self, digest: &mut Digest) {
                digest.raw($tag, &self.to_le_bytes());
            }
        }
    )*};
}

numbers!(u8: b'b', u32: b'u', i32: b'i', u64: b'U', i64: b'I', f32: b'f', f64: b'F');

impl Digestible for usize {
    fn add_to(&self, digest: &mut Digest) {
        (*self as u64).add_to(digest);
    }
}

impl Digestible for bool {
    fn add_to(&self, digest: &mut Digest) {
        digest.raw(b'?', &[u8::from(*self)]);
    }
}

impl Digestible for str {
    fn add_to(&self, digest: &mut Digest) {
        digest.raw(b's', &(self.len() as u64).to_le_bytes());
        digest.0.write(self.as_bytes());
    }
}

impl Digestible for String {
    fn add_to(&self, digest: &mut Digest) {
        self.as_str().add_to(digest);
    }
}

impl<T: Digestible + ?Sized> Digestible for &T {
    fn add_to(&self, digest: &mut Digest) {
        (**self).add_to(digest);
    }
}

impl<T: Digestible> Digestible for Option<T> {
    fn add_to(&self, digest: &mut Digest) {
        digest.raw(b'o', &[u8::from(self.is_some())]);
        if let Some(value) = self {
            value.add_to(digest);
        }
    }
}

impl<T: Digestible> Digestible for [T] {
    fn add_to(&self, digest: &mut Digest) {
        digest.raw(b'a', &(self.len() as u64).to_le_bytes());
        self.iter().for_each(|value| value.add_to(digest));
    }
}

impl<T: Digestible> Digestible for Vec<T> {
    fn add_to(&self, digest: &mut Digest) {
        self.as_slice().add_to(digest);
    }
}

impl<T: Digestible, const N: usize> Digestible for [T; N] {
    fn add_to(&self, digest: &mut Digest) {
        self.as_slice().add_to(digest);
    }
}

impl<T: Digestible + ?Sized> Digestible for Arc<T> {
    fn add_to(&self, digest: &mut Digest) {
        (**self).add_to(digest);
    }
}

impl Digestible for Vec3 {
    fn add_to(&self, digest: &mut Digest) {
        self.to_array().add_to(digest);
    }
}

impl Digestible for DVec3 {
    fn add_to(&self, digest: &mut Digest) {
        self.to_array().add_to(digest);
    }
}

impl<A: Digestible, B: Digestible> Digestible for (A, B) {
    fn add_to(&self, digest: &mut Digest) {
        self.0.add_to(digest);
        self.1.add_to(digest);
    }
}

/// Implements [`Digestible`] for a struct, or an enum with named fields, by all of its fields.
///
/// A field or variant that is missing in the list does not compile.
#[macro_export]
macro_rules! digest_fields {
    ($type:ty { $($field:ident),* $(,)? }) => {
        impl $crate::Digestible for $type {
            fn add_to(&self, digest: &mut $crate::Digest) {
                let Self { $($field),* } = self;
                $(digest.field(stringify!($field), $field);)*
            }
        }
    };
    ($type:ty: $($variant:ident $({ $($named:ident),* })? $(($($value:ident),*))?),* $(,)?) => {
        impl $crate::Digestible for $type {
            fn add_to(&self, digest: &mut $crate::Digest) {
                match self {
                    $(Self::$variant $({ $($named),* })? $(($($value),*))? => {
                        digest.field("variant", stringify!($variant));
                        $($(digest.field(stringify!($named), $named);)*)?
                        $($(digest.field(stringify!($value), $value);)*)?
                    })*
                }
            }
        }
    };
}

/// Declares structs that implement [`Digestible`] by all of their fields.
///
/// `field: Type => function` adds a field of a type that does not implement it by `function(&mut Digest, &Type)`.
///
/// ```
/// use frisure_digest::{Digest, digestible};
///
/// digestible! {
///     struct Fibre {
///         length: f64,
///         kind: Option<char> => |digest: &mut Digest, kind: &Option<char>| {
///             digest.field("kind", &kind.map(u32::from));
///         },
///     }
/// }
/// let key = |length| Digest::new("fibre").with("fibre", &Fibre { length, kind: None }).key();
/// assert_ne!(key(1.0), key(2.0));
/// ```
#[macro_export]
macro_rules! digestible {
    ($(
        $(#[$meta:meta])*
        $vis:vis struct $Name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $Type:ty $(=> $add:expr)?),* $(,)?
        }
    )*) => {$(
        $(#[$meta])*
        $vis struct $Name {
            $($(#[$field_meta])* $field_vis $field: $Type),*
        }

        impl $crate::Digestible for $Name {
            fn add_to(&self, digest: &mut $crate::Digest) {
                let Self { $($field),* } = self;
                $($crate::digestible!(@add digest, $field $(, $add)?);)*
            }
        }
    )*};
    (@add $digest:ident, $field:ident) => { $digest.field(stringify!($field), $field) };
    (@add $digest:ident, $field:ident, $add:expr) => { ($add)($digest, $field) };
}

#[cfg(test)]
mod tests {
    use super::*;

    enum Shape {
        Point,
        Ball(f64),
        Box { width: f64, height: f64 },
    }
    digest_fields!(Shape: Point, Ball(radius), Box { width, height });

    #[test]
    fn digests_are_stable() {
        let digest = Digest::new("test").with("name", "curl").with("turns", &3_u32);
        // A change of this value makes every stored key invalid.
        assert_eq!(digest.text(), "3e6b68942e7b0e703e33ea6d8cb7f843");
    }

    #[test]
    fn digests_of_different_fields_differ() {
        let shapes = [
            Shape::Point,
            Shape::Ball(1.0),
            Shape::Box { width: 1.0, height: 2.0 },
            Shape::Box { width: 2.0, height: 1.0 },
        ];
        let mut keys = shapes.map(|shape| Digest::new("shape").with("shape", &shape).key());
        keys.sort_unstable();
        assert!(keys.windows(2).all(|pair| pair[0] != pair[1]));
        let of = |name: &str, value: &str| Digest::new("text").with(name, value).key();
        assert_ne!(of("a", "bc"), of("ab", "c"));
        let packed = |a: &[u16], b: &[u16]| {
            let bytes =
                |numbers: &[u16]| numbers.iter().map(|n| n.to_le_bytes()).collect::<Vec<_>>();
            Digest::new("packed").packed("a", bytes(a)).packed("b", bytes(b)).key()
        };
        assert_eq!(packed(&[1, 2], &[3]), packed(&[1, 2], &[3]));
        assert_ne!(packed(&[1, 2], &[3]), packed(&[1], &[2, 3]));
        let split = |a: &[f64], b: &[f64]| Digest::new("split").with("a", a).with("b", b).key();
        assert_ne!(split(&[1.0, 2.0], &[]), split(&[1.0], &[2.0]));
    }

    #[test]
    fn a_checksum_changes_with_each_byte() {
        assert_ne!(checksum(b"guides"), checksum(b"guidet"));
        assert_eq!(checksum(b""), XxHash3_128::oneshot(b"").to_le_bytes());
    }
}
