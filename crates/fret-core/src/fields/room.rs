//! Room of fields that are used again and again: as much as they need.

use super::registers::Number;

/// What a field that must grow is given beyond its length: a sixteenth. Contacts grow little by little, and a vector that grows by
/// itself takes twice its length.
const RESERVE: usize = 16;

/// Gives a field so many cells; what was in them is lost.
pub fn reset<N: Number>(field: &mut Vec<N>, cells: usize) {
    if field.capacity() < cells {
        *field = Vec::new();
        field.reserve_exact(cells + cells / RESERVE);
    }
    field.resize(cells, N::default());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_that_grow_take_little_more_than_they_need() {
        let mut field = vec![1.0; 64];
        for cells in [64, 65, 66, 80, 10, 81, 200, 0] {
            reset(&mut field, cells);
            assert_eq!(field.len(), cells);
            assert!(field.capacity() <= 201 + 200 / RESERVE, "{cells}: {}", field.capacity());
            if cells == 66 {
                // Room for a little more was there already.
                assert_eq!(field.capacity(), 65 + 65 / RESERVE);
            }
        }
    }
}
