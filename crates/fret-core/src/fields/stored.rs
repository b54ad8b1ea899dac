//! Fields as they are stored: their shape and the bytes of their numbers, lowest byte first, in the order of their index. For
//! `#[serde(with = "stored")]`; numbers one by one would cost many times as much.

use std::borrow::Cow;

use ndarray::Array2;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A field, or some of them.
pub trait Stored: Sized {
    /// Writes what can be read back.
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;
    /// Reads what was written.
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;
}

/// Writes a field.
pub fn serialize<T: Stored, S: Serializer>(field: &T, serializer: S) -> Result<S::Ok, S::Error> {
    field.write(serializer)
}

/// Reads a field.
pub fn deserialize<'de, T: Stored, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    T::read(deserializer)
}

/// What a cell of a field holds.
pub trait Number: Copy {
    /// Bytes of the numbers of some cells.
    fn bytes(numbers: &[Self]) -> Cow<'_, [u8]>;
    /// Numbers from their bytes; `None` when these are none.
    fn numbers(bytes: &[u8]) -> Option<Vec<Self>>;
}

impl Number for f64 {
    fn bytes(numbers: &[Self]) -> Cow<'_, [u8]> {
        if cfg!(target_endian = "little") {
            Cow::Borrowed(bytemuck::cast_slice(numbers))
        } else {
            Cow::Owned(numbers.iter().flat_map(|number| number.to_le_bytes()).collect())
        }
    }

    fn numbers(bytes: &[u8]) -> Option<Vec<Self>> {
        let (numbers, rest) = bytes.as_chunks();
        rest.is_empty().then(|| numbers.iter().map(|number| Self::from_le_bytes(*number)).collect())
    }
}

struct Bytes<'a>(&'a [u8]);

impl Serialize for Bytes<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(self.0)
    }
}

impl Stored for Vec<f64> {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Bytes(&f64::bytes(self)).serialize(serializer)
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        f64::numbers(Deserialize::deserialize(deserializer)?).ok_or_else(|| D::Error::custom("a torn number"))
    }
}

impl<T: Number> Stored for Array2<T> {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let ordered = self.as_standard_layout();
        let numbers = ordered.as_slice().ok_or_else(|| S::Error::custom("a field without order"))?;
        (self.dim(), Bytes(&T::bytes(numbers))).serialize(serializer)
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (shape, bytes): ((usize, usize), &[u8]) = Deserialize::deserialize(deserializer)?;
        let numbers = T::numbers(bytes).ok_or_else(|| D::Error::custom("bytes that are no numbers"))?;
        Self::from_shape_vec(shape, numbers).map_err(D::Error::custom)
    }
}

/// One field of some, on its way.
struct One<T>(T);

impl<T: Stored> Serialize for One<&T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.write(serializer)
    }
}

impl<'de, T: Stored> Deserialize<'de> for One<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::read(deserializer).map(Self)
    }
}

impl<T: Stored> Stored for [T; 2] {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.each_ref().map(One).serialize(serializer)
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let fields: [One<T>; 2] = Deserialize::deserialize(deserializer)?;
        Ok(fields.map(|One(field)| field))
    }
}

impl<T: Stored> Stored for Option<T> {
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.as_ref().map(One).serialize(serializer)
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let field: Option<One<T>> = Deserialize::deserialize(deserializer)?;
        Ok(field.map(|One(field)| field))
    }
}

#[cfg(test)]
mod tests {
    use ndarray::array;

    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Fields {
        #[serde(with = "super")]
        pair: [Array2<f64>; 2],
        #[serde(with = "super")]
        perhaps: Option<Array2<f64>>,
        #[serde(with = "super")]
        alone: Array2<f64>,
        #[serde(with = "super")]
        flat: Vec<f64>,
    }

    #[test]
    fn fields_are_read_back_to_the_bit_and_torn_ones_are_refused() {
        let column = array![[0.1, -0.0, f64::MIN_POSITIVE], [1e300, -2.5, 3.0]];
        let fields = Fields {
            // Once in the order of columns, as other programs hand fields over.
            pair: [column.clone(), column.clone().reversed_axes()],
            perhaps: Some(column),
            alone: array![[3.0], [2.0], [1.0]],
            flat: vec![1.0 / 3.0, -7.0],
        };
        let bytes = postcard::to_stdvec(&fields).unwrap();
        let read: Fields = postcard::from_bytes(&bytes).unwrap();
        assert_eq!(read, fields);
        assert!(read.pair[0][[0, 1]].is_sign_negative());
        // The first number, written out as the format says: two lengths, the number of bytes, the lowest byte first.
        assert_eq!(bytes[..3], [2, 3, 48]);
        assert_eq!(bytes[3..11], 0.1_f64.to_le_bytes());
        for length in 0..bytes.len() {
            assert!(postcard::from_bytes::<Fields>(&bytes[..length]).is_err(), "{length} bytes");
        }
        let mut other = bytes;
        other[0] = 4; // four rows of three numbers have more bytes
        assert!(postcard::from_bytes::<Fields>(&other).is_err());
    }
}
