//! Units of a log, turned into those of the case, and said.

use fret_core::case::Units;

use super::log::Table;
use super::{Request, refused};
use crate::failure::Failure;

/// Powers of ten of prefixes.
const PREFIXES: [(&str, i32); 9] =
    [("", 0), ("k", 3), ("M", 6), ("c", -2), ("m", -3), ("u", -6), ("µ", -6), ("μ", -6), ("n", -9)];

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
    for (slot, role, what, base) in
        [(0, 0, "displacement", "m"), (1, 1, "force", "N"), (2, 3, "normal_force", "N")]
    {
        let Some(column) = &table.columns[role] else { continue };
        let given = request.units.iter().find(|(of, _)| of == what).map(|(_, unit)| unit.clone());
        let Some(unit) = given.or_else(|| column.unit.clone()) else {
            notes.push(format!("column {:?} names no unit: taken in that of the case", column.name));
            continue;
        };
        let into = units.map_or(base, |units| if slot == 0 { &units.length } else { &units.force });
        if unit == into {
            continue;
        }
        let (Some(from), Some(to)) = (power(&unit, base), power(into, base)) else {
            return Err(refused(
                &table.name,
                &format!(
                    "column {:?} is in {unit:?}, and the case in {into:?}: nothing is known between them",
                    column.name
                ),
                &format!(
                    "--units \"{what}={base}\" says what it is in: {base} with a prefix, such as um, mm, mN, kN"
                ),
            ));
        };
        found[slot] = 10_f64.powi(from - to);
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

fn power(unit: &str, base: &str) -> Option<i32> {
    let prefix = unit.strip_suffix(base)?;
    PREFIXES.iter().find(|(known, _)| *known == prefix).map(|(_, power)| *power)
}
