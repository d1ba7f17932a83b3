//! Lists of a known length, read strictly: serde's own take what they need, and some formats drop the rest in silence.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

/// `#[serde(deserialize_with = "array")]` of `[T; N]`.
pub(crate) fn array<'de, D: Deserializer<'de>, T: Deserialize<'de> + Copy + Default, const N: usize>(
    deserializer: D,
) -> Result<[T; N], D::Error> {
    Array::deserialize(deserializer).map(|Array(items)| items)
}

/// As [`array`], of `Option<[T; N]>`.
pub(crate) fn optional_array<'de, D: Deserializer<'de>, T: Deserialize<'de> + Copy + Default, const N: usize>(
    deserializer: D,
) -> Result<Option<[T; N]>, D::Error> {
    array(deserializer).map(Some)
}

/// As [`array`], of `Vec<[T; N]>`.
pub(crate) fn arrays<'de, D: Deserializer<'de>, T: Deserialize<'de> + Copy + Default, const N: usize>(
    deserializer: D,
) -> Result<Vec<[T; N]>, D::Error> {
    Vec::deserialize(deserializer).map(|arrays| arrays.into_iter().map(|Array(items)| items).collect())
}

struct Array<T, const N: usize>([T; N]);

impl<'de, T: Deserialize<'de> + Copy + Default, const N: usize> Deserialize<'de> for Array<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ArrayVisitor(PhantomData)).map(Self)
    }
}

struct ArrayVisitor<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + Copy + Default, const N: usize> Visitor<'de> for ArrayVisitor<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of length {N}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<[T; N], A::Error> {
        let mut array = [T::default(); N];
        for (i, item) in array.iter_mut().enumerate() {
            *item = seq.next_element()?.ok_or_else(|| Error::invalid_length(i, &self))?;
        }
        match seq.next_element::<T>()? {
            None => Ok(array),
            Some(_) => Err(Error::invalid_length(N + 1, &self)),
        }
    }
}
