//! States as bytes: the one form in which numbers, poses and shapes are stored, and a reader that believes nothing.
//!
//! Everything is little-endian and of fixed width; lists begin with their length in 32 bits, choices with a tag of 8. What
//! several owners share through an [`Arc`] is written where it first occurs and named by its number afterwards, so that
//! sharing survives. Reading takes the very bits, where constructors might round anew, and checks what constructors check.
//! Lists grow only as their elements are read, so that no length makes a reader ask for memory beyond a fixed multiple of
//! the bytes there are.
//!
//! Written by hand and not through a serialisation framework: every number has to be checked against its own range in any
//! case, arrays whose length is a constant parameter are not covered by the common derive macros, and code that is not
//! called costs a program nothing.

mod shapes;

use std::any::Any;
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt;
use std::sync::Arc;

use hyperbody_math::{Bivector, Matrix, Pose, Rotation, Vector, planes};

use crate::Aabb;

pub(crate) use shapes::shape_bytes;

/// Why bytes could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BytesError {
    at: usize,
    message: String,
}

impl BytesError {
    /// Where the reader stood: the offset behind what it refused.
    #[must_use]
    pub fn at(&self) -> usize {
        self.at
    }
}

impl fmt::Display for BytesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.at, self.message)
    }
}

impl Error for BytesError {}

/// Bytes in the making.
#[derive(Debug, Default)]
pub struct Writer {
    bytes: Vec<u8>,
    /// Numbers of what is shared, by address: looked up, never walked.
    shared: BTreeMap<usize, u32>,
}

impl Writer {
    /// Nothing written yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends bytes as they are.
    pub fn raw(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// The length of a list, which comes before its elements. Lists of 2³² elements and more do not fit into a world.
    pub fn length(&mut self, length: usize) {
        debug_assert!(u32::try_from(length).is_ok());
        (length as u32).write(self);
    }

    /// What was written.
    #[must_use]
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// Bytes to be read, from the front.
pub struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    shared: Vec<Arc<dyn Any + Send + Sync>>,
}

impl<'a> Reader<'a> {
    /// At the first of these bytes.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, shared: Vec::new() }
    }

    /// Bytes not read yet.
    #[must_use]
    pub fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// An error at this place.
    #[must_use]
    pub fn error(&self, message: impl Into<String>) -> BytesError {
        BytesError { at: self.at, message: message.into() }
    }

    /// The next bytes.
    ///
    /// # Errors
    /// If there are fewer.
    pub fn take(&mut self, count: usize) -> Result<&'a [u8], BytesError> {
        if count > self.remaining() {
            let remaining = self.remaining();
            return Err(self.error(format!("{count} more bytes are needed, but only {remaining} are left")));
        }
        let start = self.at;
        self.at += count;
        Ok(&self.bytes[start..self.at])
    }

    fn array<const M: usize>(&mut self) -> Result<[u8; M], BytesError> {
        let mut array = [0; M];
        array.copy_from_slice(self.take(M)?);
        Ok(array)
    }

    /// The length of a list whose elements take at least one byte each.
    ///
    /// # Errors
    /// If fewer bytes are left.
    pub fn length(&mut self) -> Result<usize, BytesError> {
        let length = u32::read(self)? as usize;
        if length > self.remaining() {
            let remaining = self.remaining();
            return Err(self.error(format!("a list of {length} elements cannot fit into the {remaining} bytes left")));
        }
        Ok(length)
    }

    /// That everything was read.
    ///
    /// # Errors
    /// If bytes are left.
    pub fn finish(&self) -> Result<(), BytesError> {
        if self.remaining() == 0 {
            return Ok(());
        }
        Err(self.error(format!("{} bytes are left over", self.remaining())))
    }
}

/// What can be stored: `read` takes what `write` gave to the last bit, and refuses everything else with a reason.
pub trait Stored: Sized {
    /// Appends it.
    fn write(&self, out: &mut Writer);

    /// Reads it.
    ///
    /// # Errors
    /// If the bytes end too early, or do not mean one.
    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError>;
}

/// A number that may be infinite.
pub struct Wide(
    /// Not NaN.
    pub f64,
);

impl Stored for Wide {
    fn write(&self, out: &mut Writer) {
        out.raw(&self.0.to_le_bytes());
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let value = f64::from_le_bytes(from.array()?);
        if value.is_nan() {
            return Err(from.error("a number is NaN"));
        }
        Ok(Self(value))
    }
}

impl Stored for f64 {
    fn write(&self, out: &mut Writer) {
        out.raw(&self.to_le_bytes());
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let value = Self::from_le_bytes(from.array()?);
        if !value.is_finite() {
            return Err(from.error(format!("a number is {value}; it must be finite")));
        }
        Ok(value)
    }
}

impl Stored for f32 {
    fn write(&self, out: &mut Writer) {
        out.raw(&self.to_le_bytes());
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let value = Self::from_le_bytes(from.array()?);
        if !value.is_finite() {
            return Err(from.error(format!("a number is {value}; it must be finite")));
        }
        Ok(value)
    }
}

macro_rules! integers {
    ($($integer:ty),*) => { $(
        impl Stored for $integer {
            fn write(&self, out: &mut Writer) {
                out.raw(&self.to_le_bytes());
            }

            fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
                Ok(Self::from_le_bytes(from.array()?))
            }
        }
    )* };
}
integers!(u8, u32, u64);

impl Stored for bool {
    fn write(&self, out: &mut Writer) {
        u8::from(*self).write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(from.error(format!("a yes or no is {other}; it must be 0 or 1"))),
        }
    }
}

impl<T: Stored> Stored for Option<T> {
    fn write(&self, out: &mut Writer) {
        self.is_some().write(out);
        if let Some(value) = self {
            value.write(out);
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        Ok(if bool::read(from)? { Some(T::read(from)?) } else { None })
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn write(&self, out: &mut Writer) {
        out.length(self.len());
        self.iter().for_each(|element| element.write(out));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let length = from.length()?;
        let mut list = Self::new();
        for _ in 0..length {
            list.push(T::read(from)?);
        }
        Ok(list)
    }
}

impl<T: Stored, const M: usize> Stored for [T; M] {
    fn write(&self, out: &mut Writer) {
        self.iter().for_each(|element| element.write(out));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let list = (0..M).map(|_| T::read(from)).collect::<Result<Vec<T>, BytesError>>()?;
        list.try_into().map_err(|_| from.error("an array has another length"))
    }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn write(&self, out: &mut Writer) {
        self.0.write(out);
        self.1.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        Ok((A::read(from)?, B::read(from)?))
    }
}

impl<T: Stored> Stored for Box<T> {
    fn write(&self, out: &mut Writer) {
        self.as_ref().write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        Ok(Self::new(T::read(from)?))
    }
}

impl<T: Stored + Send + Sync + 'static> Stored for Arc<T> {
    fn write(&self, out: &mut Writer) {
        let next = out.shared.len() as u32;
        let number = *out.shared.entry(Self::as_ptr(self) as usize).or_insert(next);
        number.write(out);
        if number == next {
            self.as_ref().write(out);
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let number = u32::read(from)? as usize;
        if number == from.shared.len() {
            let shared = Self::new(T::read(from)?);
            from.shared.push(shared.clone());
            return Ok(shared);
        }
        let known = from.shared.get(number).cloned().and_then(|known| known.downcast::<T>().ok());
        known.ok_or_else(|| from.error(format!("number {number} names nothing that was stored before")))
    }
}

impl<const N: usize> Stored for Vector<N> {
    fn write(&self, out: &mut Writer) {
        self.0.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        Stored::read(from).map(Self)
    }
}

impl<const N: usize> Stored for Bivector<N> {
    fn write(&self, out: &mut Writer) {
        self.planes().for_each(|value| value.write(out));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let values = (0..planes::count(N)).map(|_| f64::read(from)).collect::<Result<Vec<f64>, BytesError>>()?;
        Self::from_planes(&values).ok_or_else(|| from.error("a bivector has another number of planes"))
    }
}

impl<const N: usize> Stored for Rotation<N> {
    fn write(&self, out: &mut Writer) {
        self.matrix().0.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let matrix = Matrix(Stored::read(from)?);
        Self::from_exact_matrix(matrix).ok_or_else(|| from.error("a matrix is no rotation"))
    }
}

impl<const N: usize> Stored for Pose<N> {
    fn write(&self, out: &mut Writer) {
        self.rotation.write(out);
        self.translation.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        Ok(Self::new(Stored::read(from)?, Stored::read(from)?))
    }
}

impl<const N: usize> Stored for Aabb<N> {
    fn write(&self, out: &mut Writer) {
        self.lower.write(out);
        self.upper.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let (lower, upper): (Vector<N>, Vector<N>) = Stored::read(from)?;
        if (0..N).any(|axis| lower[axis] > upper[axis]) {
            return Err(from.error("a box ends before it begins"));
        }
        Ok(Self { lower, upper })
    }
}

/// Implements [`Stored`] for a structure by its fields, all of them, in this order. `wide` marks a number that may be
/// infinite, `wide_option` an option of one, `open` an optional range whose end may be, `unset` a field that is not stored and begins as its default.
#[macro_export]
macro_rules! stored {
    ($type:ident $(<$n:ident>)? { $($field:ident $(: $how:ident)?),* $(,)? }) => {
        impl$(<const $n: usize>)? $crate::bytes::Stored for $type$(<$n>)? {
            fn write(&self, out: &mut $crate::bytes::Writer) {
                $( $crate::stored!(@write self $field out $($how)?); )*
            }

            fn read(from: &mut $crate::bytes::Reader<'_>) -> ::std::result::Result<Self, $crate::bytes::BytesError> {
                Ok(Self { $($field: $crate::stored!(@read from $($how)?)),* })
            }
        }
    };
    (@write $self:ident $field:ident $out:ident) => { $crate::bytes::Stored::write(&$self.$field, $out) };
    (@write $self:ident $field:ident $out:ident wide) => {
        $crate::bytes::Stored::write(&$crate::bytes::Wide($self.$field), $out)
    };
    (@write $self:ident $field:ident $out:ident wide_option) => {
        $crate::bytes::Stored::write(&$self.$field.map($crate::bytes::Wide), $out)
    };
    (@write $self:ident $field:ident $out:ident open) => {
        $crate::bytes::Stored::write(&$self.$field.map(|(least, most)| (least, $crate::bytes::Wide(most))), $out)
    };
    (@write $self:ident $field:ident $out:ident unset) => {};
    (@read $from:ident) => { $crate::bytes::Stored::read($from)? };
    (@read $from:ident wide) => { <$crate::bytes::Wide as $crate::bytes::Stored>::read($from)?.0 };
    (@read $from:ident wide_option) => {
        <Option<$crate::bytes::Wide> as $crate::bytes::Stored>::read($from)?.map(|wide| wide.0)
    };
    (@read $from:ident open) => {
        <Option<(f64, $crate::bytes::Wide)> as $crate::bytes::Stored>::read($from)?.map(|(least, most)| (least, most.0))
    };
    (@read $from:ident unset) => { ::std::default::Default::default() };
}

/// Implements [`Stored`] for an enumeration without contents: a tag a variant.
#[macro_export]
macro_rules! stored_choice {
    ($type:ident { $($variant:ident = $tag:literal),* $(,)? }) => {
        impl $crate::bytes::Stored for $type {
            fn write(&self, out: &mut $crate::bytes::Writer) {
                let tag: u8 = match self { $( Self::$variant => $tag ),* };
                $crate::bytes::Stored::write(&tag, out);
            }

            fn read(from: &mut $crate::bytes::Reader<'_>) -> ::std::result::Result<Self, $crate::bytes::BytesError> {
                match <u8 as $crate::bytes::Stored>::read(from)? {
                    $( $tag => Ok(Self::$variant), )*
                    other => Err(from.error(format!("{other} stands for no {}", stringify!($type)))),
                }
            }
        }
    };
}
