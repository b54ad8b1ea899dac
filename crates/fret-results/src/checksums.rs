//! Checksums of the texts of a run: written into its record when it ends, compared by everyone who reads the folder.

use std::collections::BTreeMap;

use crate::names::HISTORY;

/// The one column that is another one whenever a case is solved.
const TIMES: &str = "wall_s";

/// The checksums (CRC-32) of texts, by their names. The history has two: of its numbers, which are the same whenever its case is solved, and
/// of its times.
pub fn checksums<'a>(texts: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> BTreeMap<String, u32> {
    let of = |(name, text): (&str, &[u8])| {
        if name != HISTORY {
            return vec![(name.to_owned(), crc32fast::hash(text))];
        }
        let [numbers, times] = of_history(text);
        vec![(name.to_owned(), numbers), (TIMES.to_owned(), times)]
    };
    texts.into_iter().flat_map(of).collect()
}

/// Of all columns but the times, and of the times.
fn of_history(table: &[u8]) -> [u32; 2] {
    let mut sums = [crc32fast::Hasher::new(), crc32fast::Hasher::new()];
    let mut times = None;
    for line in table.split(|byte| *byte == b'\n') {
        let cells = || line.split(|byte| *byte == b',');
        let times = *times.get_or_insert_with(|| cells().position(|name| name.starts_with(TIMES.as_bytes())));
        for (column, cell) in cells().enumerate() {
            let sum = &mut sums[usize::from(times == Some(column))];
            sum.update(cell);
            sum.update(b",");
        }
        sums[0].update(b"\n");
    }
    sums.map(crc32fast::Hasher::finalize)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CRC-32 of the digits 1 to 9 is 0xcbf43926 (every catalogue of checksums).
    #[test]
    fn times_change_the_checksum_of_times_alone_and_every_bit_changes_one() {
        assert_eq!(checksums([("a", &b"123456789"[..])])["a"], 0xcbf4_3926_u32);
        let table = b"increment,wall_s [s],approach\n0,0.25,1e-9\n1,0.5,2e-9\n".to_vec();
        let of = |table: &[u8]| checksums([(HISTORY, table)]);
        let (whole, other) = (of(&table), of(b"increment,wall_s [s],approach\n0,7,1e-9\n1,11.5,2e-9\n"));
        assert_eq!(whole.len(), 2);
        assert!(whole[HISTORY] == other[HISTORY] && whole[TIMES] != other[TIMES]);
        for bit in 0..8 * table.len() {
            let mut flipped = table.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert_ne!(of(&flipped), whole, "{bit}");
        }
        for end in 0..table.len() {
            assert_ne!(of(&table[..end]), whole, "{end}");
        }
    }
}
