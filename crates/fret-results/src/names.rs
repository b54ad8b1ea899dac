//! Names of what lies in a folder of results.

/// The text of the case.
pub const CASE: &str = "case.toml";
/// How it was computed and how it ended.
pub const RECORD: &str = "run.json";
/// The table of increments.
pub const HISTORY: &str = "history.csv";
/// The table of cycles.
pub const CYCLES: &str = "cycles.csv";
/// The store of fields.
pub const FIELDS: &str = "fields.zarr";
/// Error bars of the quantities of interest, where they were asked for.
pub const ERROR_BARS: &str = "error_bars.json";
/// States to start from, beside the kept fields.
pub const STATES: &str = "states";
/// The state that the run started from.
pub const START: &str = "start.state";
/// Where an unfinished run stands.
pub const CHECKPOINT: &str = "checkpoint";

/// Stresses of a run: their folder below the results, and the record in it.
pub const STRESS: [&str; 2] = ["stress", "stress.json"];
/// Temperatures of a run.
pub const HEAT: [&str; 2] = ["heat", "heat.json"];
/// A comparison of its scar with a measured one.
pub const SCAR: [&str; 2] = ["scar", "scar.json"];
/// What is computed of a run when it is over, and shown beside it; with the names of what stands beside the record, in which `#` is a number.
pub const ANSWERS: [([&str; 2], &[&str]); 3] = [
    (STRESS, &["depths.csv", "fatigue.csv", "crack.csv", "von_mises-#.svg", "volume-#.vtr"]),
    (HEAT, &["temperature.npz"]),
    (SCAR, &["scar.csv", "scar.svg"]),
];

/// Whether a name is one of a pattern, in which `#` is a number.
pub fn is_named(name: &str, pattern: &str) -> bool {
    pattern.split_once('#').map_or(name == pattern, |(before, after)| {
        let number = name.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        number.is_some_and(|number| !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit()))
    })
}

/// All that a run writes.
pub const WRITTEN: [&str; 9] = [CASE, RECORD, HISTORY, CYCLES, FIELDS, ERROR_BARS, STATES, START, CHECKPOINT];
