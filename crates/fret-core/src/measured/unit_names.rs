//! Units of measured columns, turned into those of a case, and said.

use crate::units::{Units, conversion, known_units};

use super::asked::Asked;
use super::error::{MeasuredError, refused};
use super::head::MASSES;
use super::role::{Kind, Role, listed};
use super::table::Table;
use crate::model::Dimension;

/// Factors from the columns of a table to the units of the case, which has areas in contact or is a line contact, by role; 1 of numbers
/// without a unit.
///
/// # Errors
/// When a unit is none of what its column holds.
pub fn scales(
    table: &Table,
    (roles, asked): (&[Role], &Asked),
    (units, dimension): (Option<&Units>, Dimension),
    notes: &mut Vec<String>,
) -> Result<Vec<f64>, MeasuredError> {
    let mut found = vec![1.0; roles.len()];
    let own = units.cloned().unwrap_or_else(|| Units::new("m", "N"));
    for ((role, column), found) in roles.iter().zip(&table.columns).zip(&mut found) {
        let (Some((kind, base)), Some(column)) = (role.kind.unit(dimension), column) else { continue };
        let given = asked.unit_of(role.name).map(str::to_owned);
        let Some(unit) = given.or_else(|| column.unit.clone()) else {
            let of_a_line = if kind == "force/length" { ", that of forces per length" } else { "" };
            notes.push(format!(
                "column {:?} names no unit: taken in that of the case{of_a_line}",
                column.name
            ));
            continue;
        };
        let into = own.of(kind);
        if unit == into {
            continue;
        }
        let is_mass = role.kind == Kind::Force && MASSES.contains(&unit.as_str());
        let weight = if is_mass { format!("{unit}f") } else { unit.clone() };
        let Ok(into_own) = conversion(&weight, kind, Some(&own)) else {
            if kind == "force/length" && (is_mass || conversion(&unit, "force", Some(&own)).is_ok()) {
                return Err(refused(
                    &table.name,
                    &format!(
                        "column {:?} is in {unit:?}, and the case is a line contact, whose forces are those of a unit of its length, in {into:?}",
                        column.name
                    ),
                    "divide the column by the length of the contact",
                ));
            }
            return Err(refused(
                &table.name,
                &format!(
                    "column {:?} is in {unit:?}, and the case in {into:?}: nothing is known between them",
                    column.name
                ),
                &format!("--units \"{}={base}\" says what it is in; {}", role.name, known_units(kind)),
            ));
        };
        *found = into_own.factor();
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
    let with_units: Vec<&str> =
        roles.iter().filter(|role| role.kind.unit(dimension).is_some()).map(|role| role.name).collect();
    if let Some((of, _)) = asked.units.iter().find(|(of, _)| !with_units.contains(&of.as_str())) {
        return Err(refused(
            &table.name,
            &format!("units: {of:?} has none here"),
            &format!("units are those of {}", listed(&with_units)),
        ));
    }
    Ok(found)
}
