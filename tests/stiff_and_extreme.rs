//! Cases that are stiff or extreme in one respect, on coarse grids; `cargo xtask extremes` solves all of them on finer ones.

use fret_validation::stiff_cases::{Row, families, row};
use rayon::prelude::*;

#[test]
fn the_invariants_hold_in_every_family() {
    let rows: Vec<Row> = families(true).par_iter().map(row).collect();
    assert!(rows.len() >= 13);
    for row in &rows {
        assert!(row.holds(), "{row:?}");
        let worst = row.worst.unwrap();
        // The second implementation, the matrix and the energies have been asked: rounding is never exactly nothing.
        assert!(worst.response < 1e-12 && worst.pivot > 0.0 && worst.balance > 0.0, "{row:?}");
    }
}
