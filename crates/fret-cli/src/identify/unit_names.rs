//! Units of a log, turned into those of the case, and said.

use fret_core::case::Units;

use super::log::Table;
use super::{Request, refused};
use crate::failure::Failure;

/// Powers of ten of prefixes.
const PREFIXES: [(&str, i32); 9] =
    [("", 0), ("k", 3), ("M", 6), ("c", -2), ("m", -3), ("u", -6), ("µ", -6), ("μ", -6), ("n", -9)];
/// Units of force in newtons: weights of a gram, a kilogram and a pound, of which many load cells write the mass alone.
const FORCES: [(&str, f64); 6] = [
    ("N", 1.0),
    ("gf", 9.806_65e-3),
    ("g", 9.806_65e-3),
    ("kp", 9.806_65),
    ("lbf", 4.448_221_615_260_5),
    ("lb", 4.448_221_615_260_5),
];
/// Units of length in metres.
const LENGTHS: [(&str, f64); 3] = [("m", 1.0), ("in", 0.0254), ("inch", 0.0254)];
/// Units of other columns: known so that a line of units is not taken for names.
const OTHERS: [&str; 22] = [
    "-", "s", "sec", "ms", "min", "h", "Hz", "1/s", "°C", "C", "K", "%", "V", "mV", "A", "deg", "°", "Pa",
    "MPa", "mm/s", "1", "rpm",
];
/// Those of mass, read as their weights.
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
        let known: &[(&str, f64)] = if slot == 0 { &LENGTHS } else { &FORCES };
        let (Some((from, ten)), Some((to, ten_to))) = (in_base(&unit, known), in_base(into, known)) else {
            let others = if slot == 0 { "or in" } else { "or gf, kgf, lbf" };
            return Err(refused(
                &table.name,
                &format!(
                    "column {:?} is in {unit:?}, and the case in {into:?}: nothing is known between them",
                    column.name
                ),
                &format!(
                    "--units \"{what}={base}\" says what it is in: {base} with a prefix, such as um, mm, mN, kN, {others}"
                ),
            ));
        };
        found[slot] = from / to * 10_f64.powi(ten - ten_to);
        if slot > 0 && MASSES.contains(&unit.as_str()) {
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
    OTHERS.contains(&word) || in_base(word, &LENGTHS).is_some() || in_base(word, &FORCES).is_some()
}

/// A unit in the base unit, and its prefix as a power of ten.
fn in_base(unit: &str, known: &[(&str, f64)]) -> Option<(f64, i32)> {
    known.iter().find_map(|(base, factor)| {
        let prefix = unit.strip_suffix(base)?;
        PREFIXES.iter().find(|(known, _)| *known == prefix).map(|(_, power)| (*factor, *power))
    })
}
