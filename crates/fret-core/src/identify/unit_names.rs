//! Units of a log, turned into those of the case, and said.

use crate::case::{Units, conversion, known_units};

use super::error::{IdentifyError, refused};
use super::head::MASSES;
use super::log::Table;
use super::request::Request;

/// Factors from the columns of a log to the units of the case: of displacements, forces, normal forces.
///
/// # Errors
/// When a unit is none of a length or a force.
pub fn scales(
    table: &Table,
    request: &Request,
    units: Option<&Units>,
    notes: &mut Vec<String>,
) -> Result<[f64; 3], IdentifyError> {
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
