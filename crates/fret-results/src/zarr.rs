//! The form of `fields.zarr`: the metadata of its arrays, and chunks with their checksums. Those who write and those who read it look here.
//!
//! Every chunk ends with a checksum, by Zarr's own codec `crc32c`; stores of the first builds have none, and are read as well.
//! Format: <https://zarr-specs.readthedocs.io/en/latest/v3/core/index.html>.

use fret_core::model::{Dimension, SurfaceGrid};
use serde_json::{Value, json};

/// Bytes of a checksum.
const CHECKSUM: usize = 4;

/// Whether an array holds zones, a byte a cell; all others hold numbers of eight bytes.
pub fn is_zone(name: &str) -> bool {
    name == "zone"
}

/// Bytes of a field.
pub fn bytes_of(grid: &SurfaceGrid, name: &str) -> usize {
    if is_zone(name) { grid.len() } else { 8 * grid.len() }
}

/// Where a field of the increment at a place along `increment` lies in the store.
pub fn chunk(grid: &SurfaceGrid, name: &str, place: usize) -> String {
    format!("{name}/c/{place}{}", "/0".repeat(grid.dimension().axes().len()))
}

/// The metadata of a field over so many increments.
pub fn field_metadata(
    grid: &SurfaceGrid,
    name: &str,
    steps: usize,
    is_checked: bool,
    attributes: &Value,
) -> Value {
    let [nx, ny] = grid.cells();
    let mut codecs = codecs(is_checked);
    let (shape, chunk, names) = match grid.dimension() {
        Dimension::Plane => {
            // Seen with y before x, stored with x before y; of a line contact there is no y.
            codecs.insert(0, json!({ "name": "transpose", "configuration": { "order": [0, 2, 1] } }));
            (json!([steps, ny, nx]), json!([1, ny, nx]), json!(["increment", "y", "x"]))
        }
        Dimension::Line => (json!([steps, nx]), json!([1, nx]), json!(["increment", "x"])),
    };
    json!({
        "zarr_format": 3,
        "node_type": "array",
        "shape": shape,
        "data_type": if is_zone(name) { "uint8" } else { "float64" },
        "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": chunk } },
        "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
        "fill_value": if is_zone(name) { json!(255) } else { json!("NaN") },
        "codecs": codecs,
        "attributes": attributes,
        "dimension_names": names,
    })
}

/// The metadata of an axis in one chunk.
pub fn axis_metadata(name: &str, length: usize, is_checked: bool, attributes: &Value) -> Value {
    json!({
        "zarr_format": 3,
        "node_type": "array",
        "shape": [length],
        "data_type": if name == "increment" { "int64" } else { "float64" },
        "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": [length.max(1)] } },
        "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
        "fill_value": 0,
        "codecs": codecs(is_checked),
        "attributes": attributes,
        "dimension_names": [name],
    })
}

fn codecs(is_checked: bool) -> Vec<Value> {
    let mut codecs = vec![json!({ "name": "bytes", "configuration": { "endian": "little" } })];
    if is_checked {
        codecs.push(json!({ "name": "crc32c" }));
    }
    codecs
}

/// Whether the chunks of an array have checksums, by its metadata; `None` where these are not what a run writes, which is
/// `written` with and without checksums.
pub fn is_checked(found: &Value, written: impl Fn(bool, &Value) -> Value) -> Option<bool> {
    let attributes = &found["attributes"]; // words, which another version may choose otherwise
    [true, false].into_iter().find(|&is_checked| *found == written(is_checked, attributes))
}

/// What stands behind the bytes of a chunk.
pub fn checksum(bytes: &[u8], is_checked: bool) -> Vec<u8> {
    if is_checked { crc32c::crc32c(bytes).to_le_bytes().to_vec() } else { Vec::new() }
}

/// The bytes of a chunk without its checksum, or in a few words why they are not those that were written; `expected`: how many.
pub fn checked(mut chunk: Vec<u8>, expected: Option<usize>, is_checked: bool) -> Result<Vec<u8>, String> {
    let sealed = if is_checked { CHECKSUM } else { 0 };
    let found = chunk.len().saturating_sub(sealed);
    if let Some(expected) = expected.filter(|expected| *expected != found || chunk.len() < sealed) {
        return Err(format!("{found} bytes where the grid asks for {expected}"));
    }
    let seal = chunk.split_off(found);
    if checksum(&chunk, is_checked) != seal && !(chunk.is_empty() && seal.is_empty()) {
        return Err("damaged: its checksum does not fit".to_owned());
    }
    Ok(chunk)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The check value of CRC-32C (Castagnoli), of the digits 1 to 9: RFC 3720 and every catalogue of checksums.
    #[test]
    fn the_checksum_is_the_one_of_the_codec() {
        assert_eq!(checksum(b"123456789", true), 0xe306_9283_u32.to_le_bytes());
        assert!(checksum(b"123456789", false).is_empty());
    }

    #[test]
    fn every_changed_bit_of_a_chunk_is_seen() {
        let bytes: Vec<u8> = (0..40).collect();
        let whole = [bytes.clone(), checksum(&bytes, true)].concat();
        assert_eq!(checked(whole.clone(), Some(40), true), Ok(bytes.clone()));
        assert_eq!(checked(bytes.clone(), Some(40), false), Ok(bytes));
        for bit in 0..8 * whole.len() {
            let mut flipped = whole.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(checked(flipped, Some(40), true).unwrap_err().contains("checksum"), "{bit}");
        }
        for end in 0..whole.len() {
            assert!(checked(whole[..end].to_vec(), Some(40), true).is_err(), "{end}");
        }
        assert!(checked(whole, Some(40), false).unwrap_err().contains("44 bytes"));
    }
}
