//! What the loop of a cycle tells: the sliding condition and the numbers that tribologists compare. Terminal and page say it from here.

use fret_core::history::{CycleRecord, CycleRegime, Drive, RunningCondition};

/// A number of a loop: its name, the kind of its unit, its value where the loop has one.
pub type LoopNumber = (&'static str, &'static str, Option<f64>);

/// The numbers of a cycle.
pub fn loop_numbers(cycle: &CycleRecord) -> [LoopNumber; 5] {
    let turns = cycle.drive == Drive::Torsional;
    let [force, motion] = if turns {
        [("moment amplitude", "force x length"), ("rotation amplitude", "rad")]
    } else {
        [("force amplitude Q*", "force"), ("displacement amplitude d*", "length")]
    };
    let slope = if turns { "force x length" } else { "force/length" };
    [
        (force.0, force.1, Some(cycle.force_amplitude)),
        (motion.0, motion.1, Some(cycle.displacement_amplitude)),
        ("stiffness after reversal", slope, cycle.stiffness),
        ("energy ratio A", "", cycle.energy_ratio),
        ("sliding ratio D", "", cycle.sliding_ratio),
    ]
}

/// The sliding condition of a cycle, in words.
pub fn sliding_condition(cycle: &CycleRecord) -> String {
    cycle.regime.map_or_else(|| "-".to_owned(), regime)
}

/// A sliding condition in words.
pub fn regime(regime: CycleRegime) -> String {
    regime.name().replace('_', " ")
}

/// The running condition of all cycles of a stage, in words.
pub fn running_condition(condition: Option<RunningCondition>) -> &'static str {
    match condition {
        Some(RunningCondition::Partial) => "partial slip",
        Some(RunningCondition::Mixed) => "mixed",
        Some(RunningCondition::Gross) => "gross slip",
        None => "-",
    }
}
