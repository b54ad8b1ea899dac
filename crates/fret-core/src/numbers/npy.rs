//! An array of numbers from the bytes of a .npy file of `NumPy`.
//!
//! The readers of .npy among the crates bring a C compiler into the build; what is needed of the format is a page.
//! Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>, versions 1 to 3.

use ndarray::{Array2, ShapeBuilder};

use super::error::NumbersError;

/// What such a file begins with.
pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// Array `[row, column]` of the file; numbers of one dimension become a column.
pub(super) fn npy(bytes: &[u8]) -> Result<Array2<f64>, NumbersError> {
    let cut = || NumbersError::CutHeader(bytes.len());
    let version = *bytes.get(6).ok_or_else(cut)?;
    let (start, length) = match version {
        1 => (10, bytes.get(8..10).map(|b| usize::from(u16::from_le_bytes([b[0], b[1]])))),
        2 | 3 => (12, bytes.get(8..12).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize)),
        other => return Err(NumbersError::Header(format!("version {other}"))),
    };
    let end = start + length.ok_or_else(cut)?;
    let header = std::str::from_utf8(bytes.get(start..end).ok_or_else(cut)?)
        .map_err(|_| NumbersError::Header("not a text".to_owned()))?;
    let missing = |key: &str| NumbersError::Header(format!("no {key}"));
    let kind = value_of(header, "descr").ok_or_else(|| missing("descr"))?;
    let kind = kind.trim_matches(['\'', '"']);
    let fortran = match value_of(header, "fortran_order").ok_or_else(|| missing("fortran_order"))? {
        "True" => true,
        "False" => false,
        other => return Err(NumbersError::Header(format!("fortran_order {other}"))),
    };
    let shape = value_of(header, "shape").ok_or_else(|| missing("shape"))?;
    let shape: Vec<usize> = shape
        .trim_matches(['(', ')'])
        .split(',')
        .map(str::trim)
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().map_err(|_| NumbersError::Header(format!("shape {shape}"))))
        .collect::<Result<_, _>>()?;
    let [rows, columns] = match shape[..] {
        [rows, columns] => [rows, columns],
        [rows] => [rows, 1],
        _ => return Err(NumbersError::Dimensions(shape)),
    };
    let (width, read) = reader(kind).ok_or_else(|| NumbersError::Kind(kind.to_owned()))?;
    let expected = rows.checked_mul(columns).and_then(|count| count.checked_mul(width)).unwrap_or(usize::MAX);
    let body = &bytes[end..];
    if body.len() != expected {
        return Err(NumbersError::Length { found: body.len(), expected });
    }
    let values: Vec<f64> = body.chunks_exact(width).map(read).collect();
    Array2::from_shape_vec((rows, columns).set_f(fortran), values)
        .map_err(|error| NumbersError::Header(error.to_string()))
}

/// What stands after a key of the header's dictionary, up to the comma or brace that ends it.
fn value_of<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let after = ['\'', '"'].iter().find_map(|quote| {
        let quoted = format!("{quote}{key}{quote}");
        header.find(&quoted).map(|at| &header[at + quoted.len()..])
    })?;
    let value = after.trim_start().strip_prefix(':')?.trim_start();
    let end = if value.starts_with('(') { value.find(')')? + 1 } else { value.find([',', '}'])? };
    Some(value[..end].trim())
}

type Read = fn(&[u8]) -> f64;

/// Bytes of a number and how it is read, by `NumPy`'s name of its type.
#[expect(
    clippy::cast_lossless,
    reason = "eight-byte integers have no exact conversion, and all types share one macro"
)]
fn reader(kind: &str) -> Option<(usize, Read)> {
    macro_rules! number {
        ($type:ty, $from:ident) => {
            Some((size_of::<$type>(), |bytes| {
                let mut own = [0; size_of::<$type>()];
                own.copy_from_slice(bytes);
                <$type>::$from(own) as f64
            }))
        };
    }
    let (order, name) = kind.split_at_checked(1)?;
    match (order, name) {
        ("<" | "=", "f8") => number!(f64, from_le_bytes),
        ("<" | "=", "f4") => number!(f32, from_le_bytes),
        ("<" | "=", "i8") => number!(i64, from_le_bytes),
        ("<" | "=", "i4") => number!(i32, from_le_bytes),
        ("<" | "=", "i2") => number!(i16, from_le_bytes),
        ("<" | "=", "u8") => number!(u64, from_le_bytes),
        ("<" | "=", "u4") => number!(u32, from_le_bytes),
        ("<" | "=", "u2") => number!(u16, from_le_bytes),
        (">", "f8") => number!(f64, from_be_bytes),
        (">", "f4") => number!(f32, from_be_bytes),
        (">", "i8") => number!(i64, from_be_bytes),
        (">", "i4") => number!(i32, from_be_bytes),
        (">", "i2") => number!(i16, from_be_bytes),
        (">", "u8") => number!(u64, from_be_bytes),
        (">", "u4") => number!(u32, from_be_bytes),
        (">", "u2") => number!(u16, from_be_bytes),
        (_, "i1") => number!(i8, from_le_bytes),
        (_, "u1") => number!(u8, from_le_bytes),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use ndarray::array;

    use super::super::{NumbersError, numbers};

    /// A .npy file of version 1, as `NumPy` writes it.
    fn file(header: &str, body: &[u8]) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(body);
        bytes
    }

    #[test]
    fn rows_columns_and_types_come_out_as_numpy_means_them() {
        let body: Vec<u8> = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0_f64].iter().flat_map(|v| v.to_le_bytes()).collect();
        let rows = file("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n", &body);
        assert_eq!(numbers(&rows).unwrap(), array![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        let columns = file("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }\n", &body);
        assert_eq!(numbers(&columns).unwrap(), array![[1.0, 3.0, 5.0], [2.0, 4.0, 6.0]]);
        let line = file("{'descr': '<f8', 'fortran_order': False, 'shape': (6,), }\n", &body);
        assert_eq!(numbers(&line).unwrap(), array![[1.0], [2.0], [3.0], [4.0], [5.0], [6.0]]);
        let whole =
            file("{'descr': '>i2', 'fortran_order': False, 'shape': (1, 2), }\n", &[0xff, 0xfe, 1, 0]);
        assert_eq!(numbers(&whole).unwrap(), array![[-2.0, 256.0]]);
    }

    #[test]
    fn every_type_of_number_is_read_in_both_orders_of_bytes() {
        // 2 bytes and more: 258 is 0x0102; in one byte 2; floats by their bits: 2.0 is 0x40000000 and 0x4000000000000000
        let float = |width: usize| [vec![0x40], vec![0; width - 1]].concat();
        let whole = |width: usize| [vec![0; width - 2], vec![1, 2]].concat();
        for (kind, big, value) in [
            ("f8", float(8), 2.0),
            ("f4", float(4), 2.0),
            ("i8", whole(8), 258.0),
            ("i4", whole(4), 258.0),
            ("i2", whole(2), 258.0),
            ("u8", whole(8), 258.0),
            ("u4", whole(4), 258.0),
            ("u2", whole(2), 258.0),
            ("i1", vec![2], 2.0),
            ("u1", vec![2], 2.0),
            ("i8", vec![0xff; 8], -1.0),
            ("i4", vec![0xff; 4], -1.0),
            ("i2", vec![0xff; 2], -1.0),
            ("i1", vec![0xff], -1.0),
            ("u8", vec![0xff; 8], 2.0_f64.powi(64)),
            ("u4", vec![0xff; 4], 4_294_967_295.0),
            ("u2", vec![0xff; 2], 65_535.0),
            ("u1", vec![0xff], 255.0),
        ] {
            let little: Vec<u8> = big.iter().rev().copied().collect();
            for (order, body) in [(">", &big), ("<", &little), ("=", &little), ("|", &big)] {
                let header =
                    format!("{{\"descr\": \"{order}{kind}\", 'fortran_order': False, 'shape': (1, 1)}}");
                let read = numbers(&file(&header, body));
                if order == "|" && body.len() > 1 {
                    assert_eq!(read, Err(NumbersError::Kind(format!("|{kind}"))));
                } else {
                    assert_eq!(read.unwrap(), array![[value]], "{order}{kind}");
                }
            }
        }
        // versions 2 and 3 have four bytes of length, and version 1 two: 0x0101 spaces behind the head
        let mut long = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 1), }".to_owned();
        long.push_str(&" ".repeat(0x0101 - long.len()));
        assert_eq!(numbers(&file(&long, &[7])).unwrap(), array![[7.0]]);
        for version in [2, 3] {
            let head = [b"\x93NUMPY", &[version, 0, 1, 1, 0, 0][..], long.as_bytes()].concat();
            assert_eq!(numbers(&[&head[..], &[7]].concat()).unwrap(), array![[7.0]]);
            assert_eq!(numbers(&head[..100]), Err(NumbersError::CutHeader(100)));
            assert_eq!(numbers(&head[..11]), Err(NumbersError::CutHeader(11)));
        }
    }

    #[test]
    fn what_is_no_array_is_told_why() {
        let good = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1), }\n";
        let words = |bytes: &[u8]| numbers(bytes).unwrap_err().to_string();
        assert!(words(&file(good, &[0; 7])).contains("7 bytes of numbers: its header says 8"));
        assert!(words(&file(good, &[0; 8])[..40]).contains("cut off"));
        assert!(words(b"\x93NUMPY").contains("cut off"));
        assert!(words(&file(&good.replace("<f8", "<c16"), &[0; 16])).contains("c16"));
        assert!(
            words(&file(&good.replace("(1, 1)", "(1, 1, 1)"), &[0; 8])).contains("one or two dimensions")
        );
        assert!(words(&file(&good.replace("(1, 1)", "()"), &[0; 8])).contains("one or two dimensions"));
        assert!(
            words(&file(&good.replace("(1, 1)", "(4294967296, 4294967296)"), &[])).contains("header says")
        );
        assert!(words(&file("{}", &[])).contains("no descr"));
        assert!(words(&file("{'descr': '<f8'}", &[])).contains("no fortran_order"));
        assert!(words(&file(&good.replace("shape", "size"), &[0; 8])).contains("no shape"));
        assert!(words(&file(&good.replace("False", "Maybe"), &[0; 8])).contains("fortran_order Maybe"));
        assert!(words(&file(&good.replace("(1, 1)", "(1, x)"), &[0; 8])).contains("shape (1, x)"));
        assert!(words(b"\x93NUMPY\x04\x00    ").contains("version 4"));
        assert!(words(&[7, 1, 2]).contains("neither"));
    }
}
