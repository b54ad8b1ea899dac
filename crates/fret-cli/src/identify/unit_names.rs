//! Units of a log, turned into those of the case, and said.

use fret_core::case::{Units, conversion, is_unit, known_units};

use super::log::Table;
use super::{Request, refused};
use crate::failure::Failure;

/// Units of other columns: known so that a line of units is not taken for names.
const OTHERS: [&str; 17] =
    ["s", "sec", "ms", "min", "h", "Hz", "1/s", "°C", "C", "K", "%", "V", "mV", "A", "mm/s", "um/s", "rpm"];
/// Units of mass, of which many load cells write their weights.
const MASSES: [&str; 4] = ["g", "kg", "mg", "lb"];

/// Factors from the columns of a log to the units of the case: of displacements, forces, normal forces.
///
/// # Errors
/// When a unit is none of a length or a force.
pub fn scales(
    table: &Table,
    request: &Request,
    units: Option<&Units>,
    notes: &mut Vec<String>,
) -> Result<[f64; 3], Failure> {
    let mut found = [1.0; 3];
    let own = units.cloned().unwrap_or_else(|| Units::new("m", "N"));
    for (slot, role, what, base) in
        [(0, 0, "displacement", "m"), (1, 1, "force", "N"), (2, 3, "normal_force", "N")]
    {
        let Some(column) = &table.columns[role] else { continue };
        let given = request.units.iter().find(|(of, _)| of == what).map(|(_, unit)| unit.clone());
        let Some(unit) = given.or_else(|| column.unit.clone()) else {
            notes.push(format!("column {:?} names no unit: taken in that of the case", column.name));
            continue;
        };
        let (kind, into) = if slot == 0 { ("length", &own.length) } else { ("force", &own.force) };
        if unit == *into {
            continue;
        }
        let is_mass = kind == "force" && MASSES.contains(&unit.as_str());
        let weight = if is_mass { format!("{unit}f") } else { unit.clone() };
        let Ok(into_own) = conversion(&weight, kind, Some(&own)) else {
            return Err(refused(
                &table.name,
                &format!(
                    "column {:?} is in {unit:?}, and the case in {into:?}: nothing is known between them",
                    column.name
                ),
                &format!("--units \"{what}={base}\" says what it is in; {}", known_units(kind)),
            ));
        };
        found[slot] = into_own.factor();
        if is_mass {
            notes.push(format!("column {:?} is in {unit}: taken as the weight of that mass", column.name));
        }
        if units.is_none() {
            notes.push(format!(
                "column {:?} is in {unit}, and the case names no units: the case is taken in {base}",
                column.name
            ));
        }
    }
    if let Some((of, _)) =
        request.units.iter().find(|(of, _)| !["displacement", "force", "normal_force"].contains(&of.as_str()))
    {
        return Err(refused(
            &table.name,
            &format!("units: {of:?} has none here"),
            "units are those of displacement, force and normal_force",
        ));
    }
    Ok(found)
}

/// Whether a word is a unit of something that logs hold.
pub fn is_known(word: &str) -> bool {
    OTHERS.contains(&word) || MASSES.contains(&word) || is_unit(word)
}
