//! A loading history from a CSV table: one row after the other, columns named like the controls.

use std::collections::BTreeMap;

use super::loads_layout::{Layout, layout};
use crate::document::{Mistake, Named};
use crate::model::Dimension;
use crate::model::controls::{Column, LARGEST, columns};
use crate::numbers::{NoNumber, number};
use crate::units::{Conversion, Heading, UnitError, Units, conversion, is_unit, known_units};

/// Rows of a table, at the most.
const MOST_ROWS: usize = 1_000_000;

/// Values of the controls, each in the order of the rows.
pub type Loads = BTreeMap<String, Vec<f64>>;

/// A chosen column: its control, where it stands, its name, and how its numbers become those of the case.
struct Chosen {
    control: Column,
    index: usize,
    name: String,
    unit: Option<String>,
    conversion: Conversion,
}

/// Reads a table of loads, in the `units` of a case of this `dimension`; `given`: its columns by their controls, where these have other names.
///
/// # Errors
/// With what is wrong in the table; what is wrong with a column that is given stands there.
pub fn loads(
    text: &str,
    given: Option<&Named>,
    units: Option<&Units>,
    dimension: Dimension,
) -> Result<Loads, Mistake> {
    let Layout { delimiter, line: head_line, text } = layout(text);
    let decimal_comma = delimiter != b',';
    let mut reader =
        csv::ReaderBuilder::new().delimiter(delimiter).trim(csv::Trim::All).from_reader(text.as_bytes());
    let names: Vec<String> = match reader.headers() {
        Ok(names) => names.iter().map(str::to_owned).collect(),
        Err(error) => return Err(Mistake::new(unreadable(&error), "")),
    };
    let mut chosen = chosen(given, &names, head_line)?;
    let mut columns: Loads = chosen.iter().map(|column| (column.control.name.clone(), Vec::new())).collect();
    let (mut is_first, mut decimals) = (true, Decimals::default());
    for row in reader.records() {
        let row = match row {
            Ok(row) => row,
            Err(error) => {
                let help = if delimiter == b',' && is_longer(&error) { DECIMAL_COMMAS } else { "" };
                return Err(Mistake::new(unreadable(&error), help));
            }
        };
        let line = row.position().map_or(0, csv::Position::line);
        if row.iter().all(str::is_empty) {
            continue;
        }
        if is_first {
            is_first = false;
            let are_units = units_below(&row, &mut chosen);
            convert((units, dimension), if are_units { line as usize } else { head_line }, &mut chosen)?;
            if are_units {
                continue;
            }
        }
        for column in &chosen {
            let cell = row.get(column.index).unwrap_or("");
            if decimals.are_mixed(cell) {
                let message = format!(
                    "line {line}, column {:?}: {cell:?}, in a table with decimal commas and decimal points",
                    column.name
                );
                return Err(Mistake::new(message, DECIMAL_COMMAS));
            }
            let found = number(cell, decimal_comma)
                .map(|value| column.conversion.of(value))
                .and_then(|value| if value.is_finite() { Ok(value) } else { Err(NoNumber::NotFinite) });
            if found.as_ref().is_ok_and(|value| value.abs() > LARGEST) {
                let message =
                    format!("line {line}, column {:?}: {cell:?}: must be 1e100 at the most", column.name);
                return Err(Mistake::new(message, ""));
            }
            match (found, columns.get_mut(&column.control.name)) {
                (Ok(value), Some(values)) => values.push(value),
                (Ok(_), None) => {}
                (Err(why), _) => {
                    let message = format!("line {line}, column {:?}: {cell:?} {why}", column.name);
                    return Err(Mistake::new(message, ""));
                }
            }
        }
    }
    let rows = columns.values().next().map_or(0, Vec::len);
    if !(1..=MOST_ROWS).contains(&rows) {
        let message = format!("{rows} rows below its head; between 1 and {MOST_ROWS} are allowed");
        return Err(Mistake::new(message, ""));
    }
    Ok(columns)
}

const DECIMAL_COMMAS: &str =
    "write decimal points; or decimal commas, with semicolons or tabs between the columns";

/// Decimal points and decimal commas of a table, of which there may be one kind.
#[derive(Default)]
struct Decimals {
    comma: bool,
    point: bool,
}

impl Decimals {
    /// Whether both kinds have been seen, with this cell.
    fn are_mixed(&mut self, cell: &str) -> bool {
        self.comma |= cell.contains(',');
        self.point |= cell.contains('.') && !cell.starts_with("1.#");
        self.comma && self.point
    }
}

/// Takes the units of a row below the head, where every chosen cell of it is a unit and no number.
fn units_below(row: &csv::StringRecord, chosen: &mut [Chosen]) -> bool {
    let unit = |column: &Chosen| {
        let cell = row.get(column.index).unwrap_or("");
        let inside = cell.strip_prefix('[').and_then(|cell| cell.strip_suffix(']'));
        let inside = inside.or_else(|| cell.strip_prefix('(').and_then(|cell| cell.strip_suffix(')')));
        let is_unit = number(cell, true) == Err(NoNumber::Other) && (inside.is_some() || is_unit(cell));
        is_unit.then(|| inside.unwrap_or(cell).trim().to_owned())
    };
    let units: Option<Vec<String>> = chosen.iter().map(unit).collect();
    let Some(units) = units else { return false };
    for (column, unit) in chosen.iter_mut().zip(units) {
        column.unit = Some(unit);
    }
    true
}

/// Finds how the numbers of each column become those of the case.
fn convert(
    (units, dimension): (Option<&Units>, Dimension),
    line: usize,
    chosen: &mut [Chosen],
) -> Result<(), Mistake> {
    for column in chosen {
        let Some(unit) = &column.unit else { continue };
        let Column { name: control, way, .. } = &column.control;
        let kind = dimension.kind(way.unit);
        match conversion(unit, kind, units) {
            Ok(conversion) => column.conversion = conversion,
            Err(error) => {
                let message = format!("line {line}, column {:?}: {control} in {error}", column.name);
                let help = match error {
                    UnitError::CaseWithout(_) => {
                        "[units] length = \"mm\", force = \"N\" says what the case is in; without it units of SI without a prefix are taken"
                    }
                    _ => known_units(kind),
                };
                return Err(Mistake::new(message, help));
            }
        }
    }
    Ok(())
}

/// Why a row cannot be read.
fn unreadable(error: &csv::Error) -> String {
    let cells = |count: u64| if count == 1 { "1 cell".to_owned() } else { format!("{count} cells") };
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            format!("line {line} has {}, its head {}", cells(*len), cells(*expected_len))
        }
        csv::ErrorKind::Utf8 { pos, .. } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            format!("line {line} is not a text in UTF-8")
        }
        _ => format!("not readable as CSV: {error}"),
    }
}

/// Whether a row has more cells than the head.
fn is_longer(error: &csv::Error) -> bool {
    matches!(error.kind(), csv::ErrorKind::UnequalLengths { expected_len, len, .. } if len > expected_len)
}

/// Which column of the file holds which control.
fn chosen(given: Option<&Named>, names: &[String], line: usize) -> Result<Vec<Chosen>, Mistake> {
    let all = columns();
    let controls = || all.iter().map(|known| known.name.as_str()).collect::<Vec<_>>().join(", ");
    let control_of = |word: &str| all.iter().find(|known| known.name == word).cloned();
    let mut headings: Vec<Option<Heading>> = names.iter().map(|name| Heading::of(name)).collect();
    let mut found: Vec<(Column, usize)> = Vec::new();
    if let Some(given) = given {
        for (control, column) in &given.0 {
            let Some(known) = control_of(control) else {
                let message = format!("no control is called {:?}", &control.value);
                let help = format!("controls are: {}", controls());
                return Err(Mistake::new(message, &help).at(control.span()));
            };
            let wanted = &column.value;
            let whole = names.iter().position(|name| name == wanted);
            let without_unit =
                |heading: &Option<Heading>| heading.as_ref().is_some_and(|heading| heading.name == *wanted);
            let Some(index) = whole.or_else(|| headings.iter().position(without_unit)) else {
                let message = format!("no column {wanted:?}; it has: {}", names.join(", "));
                return Err(Mistake::new(message, "").at(column.span()));
            };
            found.push((known, index));
        }
    } else {
        for (index, name) in names.iter().enumerate() {
            let Some(heading) = &headings[index] else { return Err(unclosed(line, name)) };
            let Some(known) = control_of(&heading.name) else {
                let message = format!("column {name:?} is no control");
                let help = format!(
                    "controls are: {}; columns of other names are chosen with columns = {{ shift_x = {name:?} }}",
                    controls()
                );
                return Err(Mistake::new(message, &help));
            };
            found.push((known, index));
        }
    }
    // in the order of the controls, whatever that of the columns
    let order = |known: &Column| all.iter().position(|other| other.name == known.name);
    let mut there: Vec<&Column> = found.iter().map(|(known, _)| known).collect();
    there.sort_by_key(|known| (known.freedom, order(known)));
    if let Some([one, other]) = there.windows(2).find(|two| two[0].freedom == two[1].freedom) {
        let message = if one.name == other.name {
            format!("column {:?} stands there twice", one.name)
        } else {
            format!("{} and {} prescribe one thing, and one column may do so", one.name, other.name)
        };
        return Err(Mistake::new(message, ""));
    }
    if found.is_empty() {
        return Err(Mistake::new("no column", &format!("controls are: {}", controls())));
    }
    let mut chosen = Vec::new();
    for (control, index) in found {
        let name = names[index].clone();
        let Some(heading) = headings[index].take() else { return Err(unclosed(line, &name)) };
        chosen.push(Chosen { control, index, name, unit: heading.unit, conversion: Conversion::NONE });
    }
    Ok(chosen)
}

fn unclosed(line: usize, name: &str) -> Mistake {
    Mistake::new(
        format!("line {line}, column {name:?}: a bracket that is not closed, or closed twice"),
        "a name and its unit are written like normal_force [N]",
    )
}
