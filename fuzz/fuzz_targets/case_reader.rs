//! Any bytes as a case: read or refused, never a panic; what is refused is shown, what is read is planned.

#![no_main]

use fret_core::case::Case;
use fret_core::plan::Plan;
use libfuzzer_sys::fuzz_target;

/// Cells up to which a case is planned: a plan may look for the contact on a coarse grid.
const PLANNED: usize = 1 << 12;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    for read in [Case::from_toml(text, "case.toml"), Case::from_json(text, "case.json")] {
        match read {
            Ok(case) if case.cells[0] * case.cells[1] <= PLANNED => {
                if let Err(error) = Plan::new(case) {
                    let _ = error.render(true);
                }
            }
            Ok(_) => {}
            Err(error) => {
                assert!(!error.mistakes().is_empty());
                let _ = error.render(true);
            }
        }
    }
});
