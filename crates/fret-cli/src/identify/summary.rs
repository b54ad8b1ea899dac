//! What a person reads of an identification.

use fret_core::identify::{Identification, Quantities};

use super::constant::line;
use super::over_cycles::in_words;
use super::record::rows_in_words;
use super::repeated;
use crate::figures::figure;
use crate::loop_numbers::regime;

/// What is told of the fitted cycle: its name, its unit, and what it is.
type Told = (&'static str, &'static str, fn(&Quantities) -> Option<f64>);

const TOLD: [Told; 10] = [
    ("dissipated energy W_d", "force x length", |all| Some(all.dissipated_energy)),
    ("force amplitude Q*", "force", |all| Some(all.force_amplitude)),
    ("displacement amplitude", "length", |all| Some(all.displacement_amplitude)),
    ("delta_0", "length", |all| Some(all.opening)),
    ("A", "", |all| Some(all.energy_ratio)),
    ("D", "", |all| Some(all.sliding_ratio)),
    ("A of the contact", "", |all| all.contact_energy_ratio),
    ("D of the contact", "", |all| all.contact_sliding_ratio),
    ("mu of the plateaus", "", |all| all.plateau_friction),
    ("mu by energy", "", |all| all.energy_friction),
];

/// What a person reads.
pub fn summary(found: &Identification) -> String {
    let count = found.cycles.len();
    let skipped = found.skipped().count();
    let of = if skipped == 0 { String::new() } else { format!("{} of ", count - skipped) };
    let fitted = found.fitted_cycle();
    let mut lines = vec![format!(
        "{}: {of}{count} cycle{}{}, fitted: cycle {}",
        found.log,
        if count == 1 { "" } else { "s" },
        if skipped == 0 { "" } else { " used" },
        fitted.measured.name
    )];
    for words in [found.skipped_in_words(), rows_in_words(&found.bad_rows)].into_iter().flatten() {
        lines.push(format!("  skipped: {words}"));
    }
    for constant in &found.constants {
        let value = format!("{} {}", figure(constant.value), found.units.of(constant.unit));
        lines.push(line(constant, &value, (22, "loop", "")));
    }
    for (words, unit, of) in TOLD {
        if let Some(value) = fitted.quantities.as_ref().and_then(of) {
            lines.push(
                format!("  {words:<22} {} {}", figure(value), found.unit_of(unit)).trim_end().to_owned(),
            );
        }
    }
    lines.push(format!("  sliding condition      {}", regime(found.regime)));
    lines.extend(in_words(found).map(|words| format!("  over the cycles        {words}")));
    lines.extend(repeated::in_words(found));
    let removed = &found.removed;
    let told =
        |value: f64, kind: &str| format!("{} {}", figure(value), found.unit_of(kind)).trim_end().to_owned();
    lines.push(format!(
        "  removed from the log: displacement offset {}, drift {} over the cycle{}; force offset {}",
        told(removed.displacement_offset, "length"),
        told(removed.displacement_drift, "length"),
        match removed.displacement_bend {
            0.0 => String::new(),
            bend => format!(", which bends by {}", told(bend, "length")),
        },
        told(removed.force_offset, "force")
    ));
    lines.extend(found.notes.iter().map(|note| format!("  note: {note}")));
    lines.join("\n")
}
