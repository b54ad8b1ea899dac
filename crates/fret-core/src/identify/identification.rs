//! The whole question: a log, identified by a case.

use serde::Serialize;

use crate::case::Case;
use crate::history::{CycleRegime, SLIDING_ENERGY_RATIO};
use crate::measured::scales;
use crate::model::Dimension;
use crate::units::Units;

use super::cycles::{self, MeasuredCycle};
use super::direction::{self, Direction};
use super::drift;
use super::error::{IdentifyError, refused};
use super::fit::{bent, time};
use super::flanks::Flanks;
use super::found::{Constant, Fitted, fitted};
use super::log;
use super::model::Model;
use super::quantities::{Known, Quantities};
use super::repeated::{RepeatedFit, repeated};
use super::request::{Key, Request};

/// What a log tells; lengths and forces in the units of the case, forces and energies of a line contact those of a unit of its length.
#[derive(Debug, Clone)]
pub struct Identification {
    /// The name of the log.
    pub log: String,
    /// Units of all numbers; metres and newtons where the case names none.
    pub units: Units,
    /// Whether the case or the log names units.
    pub has_units: bool,
    /// Whether the case has areas in contact, or is a line contact.
    pub dimension: Dimension,
    /// Place of the fitted cycle among the cycles.
    pub fitted: usize,
    /// Normal force of the case [force].
    pub normal_force: f64,
    /// Friction coefficient, stiffness of the rig, amplitude of the actuator, and the key.
    pub constants: Vec<Constant>,
    /// Standard deviation of the points about the computed loop, relative to the amplitudes.
    pub noise: f64,
    /// What was taken off the fitted cycle.
    pub removed: Removed,
    /// What was turned for the loops to run forwards.
    pub turned: Direction,
    /// Rows without a number that were skipped: their lines and what is wrong there.
    pub bad_rows: Vec<String>,
    /// Sliding condition of the fitted cycle.
    pub regime: CycleRegime,
    /// Computed stiffness of the contact directly after reversal [force/length].
    pub contact_stiffness: f64,
    /// All cycles of the log.
    pub cycles: Vec<Cycle>,
    /// The fit repeated over them, where that was asked for.
    pub repeated: Vec<RepeatedFit>,
    /// The computed loop: displacement of the actuator, tangential force, displacement of the contact, around from the largest displacement.
    pub computed: Vec<[f64; 3]>,
    /// What the data cannot tell, and what was assumed.
    pub notes: Vec<String>,
}

/// A cycle of a log.
#[derive(Debug, Clone)]
pub struct Cycle {
    /// As measured.
    pub measured: MeasuredCycle,
    /// What is read from it; nothing where it was skipped.
    pub quantities: Option<Quantities>,
}

/// What was taken off the fitted cycle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Removed {
    /// Offset of the displacement [length].
    pub displacement_offset: f64,
    /// Its drift from the first point to the last [length].
    pub displacement_drift: f64,
    /// By how much that drift bends, from the middle of the cycle to its ends [length].
    pub displacement_bend: f64,
    /// Offset of the force [force].
    pub force_offset: f64,
    /// By how much the middle of the displacement wanders from cycle to cycle [length]; nothing for a single one.
    pub drift_per_cycle: Option<f64>,
}

/// Identifies a log, whose name and bytes are given, by a case, of which a number may be fitted, too.
///
/// # Errors
/// When the log cannot be read as fretting loops of such a case, or the case cannot be solved.
pub fn identify(
    (name, bytes): (&str, &[u8]),
    case: Case,
    key: Option<Key<'_>>,
    request: &Request,
) -> Result<Identification, IdentifyError> {
    let asked = request.beside(&case.log_columns);
    let table = log::read(name, bytes, &asked, request.strict)?;
    let mut notes = Vec::new();
    let dimension = case.dimension();
    let scale = scales(&table, (&log::ROLES, &asked), (case.units.as_ref(), dimension), &mut notes)?;
    let has_units =
        case.units.is_some() || table.columns.iter().flatten().any(|column| column.unit.is_some());
    if !table.heads.is_empty() {
        let blocks = table.heads.len() + 1;
        notes.push(format!(
            "the log has {blocks} blocks with a head each: they were read one after the other"
        ));
    }
    let mut measured = cycles::split(&table, &scale);
    let turned = direction::of(&measured);
    if let (Some(what), true) = (turned.in_words(), request.strict) {
        return Err(refused(
            name,
            &what,
            "turn the column, or leave out --strict: then it is turned and told",
        ));
    }
    turned.apply(&mut measured);
    notes.extend(turned.note());
    if let (Some(fault), true) = (measured.iter().find_map(|cycle| cycle.fault.as_ref()), request.strict) {
        return Err(refused(name, &fault.what, &fault.help));
    }
    let units = case.units.clone().unwrap_or_else(|| Units::new("m", "N"));
    let model = Model::new(case, key)?;
    let place = cycles::choose(&measured, request.cycle, name)?;
    let found = fitted(name, &measured[place], &model, drift::bend(&measured, place))?;
    let every = request.every.map(|every| repeated(name, &measured, &model, every));
    let mut repeated = every.transpose()?.unwrap_or_default();
    let friction = found.friction().or_else(|| model.friction()).unwrap_or(0.5);
    // Without it friction is not read from the single cycles; the fit itself stands.
    let flanks = Flanks::of(&model, friction, found.value_of_key).ok();
    let known = Known {
        normal_force: found.normal_force,
        stiffness: found.stiffness(),
        flanks: flanks.as_ref(),
        correlation: found.correlation,
    };
    let own = measured[place].quantities(known);
    let drift_per_cycle = drift::per_cycle(&measured);
    let cycles = measured
        .into_iter()
        .map(|measured| {
            let quantities = measured.fault.is_none().then(|| measured.quantities(known));
            Cycle { measured, quantities }
        })
        .collect();
    let Fitted { mut constants, normal_force, noise, removed, contact_stiffness, slides, computed, .. } =
        found;
    let of_repeated = repeated.iter_mut().flat_map(|fit| &mut fit.constants);
    for constant in constants.iter_mut().chain(of_repeated) {
        constant.unit = dimension.kind(constant.unit);
    }
    notes.extend(found.notes);
    let [displacement_offset, displacement_drift, displacement_bend, force_offset] = removed;
    Ok(Identification {
        log: name.to_owned(),
        units,
        has_units,
        dimension,
        fitted: place,
        normal_force,
        constants,
        noise,
        removed: Removed {
            displacement_offset,
            displacement_drift,
            displacement_bend,
            force_offset,
            drift_per_cycle,
        },
        turned,
        bad_rows: table.bad.into_iter().map(|row| row.what).collect(),
        regime: regime(own.contact_energy_ratio.unwrap_or(own.energy_ratio), slides),
        contact_stiffness,
        cycles,
        repeated,
        computed,
        notes,
    })
}

/// By the energy ratio of the contact, and by whether all of it slides in the computed loop.
fn regime(energy_ratio: f64, slides: bool) -> CycleRegime {
    match (energy_ratio >= SLIDING_ENERGY_RATIO, slides) {
        (true, true) => CycleRegime::GrossSlip,
        (false, false) => CycleRegime::PartialSlip,
        _ => CycleRegime::Mixed,
    }
}

impl Identification {
    /// The unit of a kind of quantity, in the words of [`Units::of`].
    pub fn unit_of(&self, kind: &str) -> String {
        self.units.of(self.dimension.kind(kind))
    }

    /// The cycle that was fitted.
    pub fn fitted_cycle(&self) -> &Cycle {
        &self.cycles[self.fitted]
    }

    /// Cycles that were skipped, with the reason.
    pub fn skipped(&self) -> impl Iterator<Item = (&MeasuredCycle, &cycles::Fault)> {
        self.cycles.iter().filter_map(|cycle| Some((&cycle.measured, cycle.measured.fault.as_ref()?)))
    }

    /// The same in words, `1234 (does not close), 5000 (ends early)`; `None` where there are none.
    pub fn skipped_in_words(&self) -> Option<String> {
        let words = cycles::skipped(self.cycles.iter().map(|cycle| &cycle.measured));
        (!words.is_empty()).then_some(words)
    }

    /// Displacement and force of the fitted cycle, without offset and drift.
    pub fn points(&self) -> Vec<[f64; 2]> {
        let MeasuredCycle { displacement, force, .. } = &self.fitted_cycle().measured;
        let (removed, count) = (&self.removed, force.len());
        let point = |(row, (displacement, force)): (usize, (&f64, &f64))| {
            let time = time(row, count);
            [
                displacement
                    - removed.displacement_offset
                    - time * removed.displacement_drift
                    - bent(time) * removed.displacement_bend,
                force - removed.force_offset,
            ]
        };
        displacement.iter().zip(force).enumerate().map(point).collect()
    }
}
