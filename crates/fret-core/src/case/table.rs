//! A loading history from a CSV table: one row after the other, columns named like the controls.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;

use super::judge::Judge;
use super::stage_file::StageFile;

/// Controls a column can hold, by the names of `history.csv`.
pub(super) const COLUMNS: [&str; 8] = [
    "normal_force",
    "approach",
    "tangential_force_x",
    "tangential_force_y",
    "shift_x",
    "shift_y",
    "twist_moment",
    "twist",
];

/// Rows of a table, at the most.
const MOST_ROWS: usize = 1_000_000;

/// Values of the controls, each in the order of the rows.
pub(super) type Columns = BTreeMap<&'static str, Vec<f64>>;

/// The table of a stage; `None` when it was refused.
pub(super) fn table(
    judge: &mut Judge,
    place: &str,
    file: &StageFile,
    name: &Spanned<String>,
) -> Option<Columns> {
    let text = judge.attached_text(&format!("{place}.table"), name)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let at = Words { place: format!("{place}.table {:?}", name.get_ref()), span: name.span() };
    let head = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or("");
    let delimiter = [';', '\t'].into_iter().find(|&mark| head.contains(mark)).unwrap_or(',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter as u8)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let names: Vec<String> = match reader.headers() {
        Ok(names) => names.iter().map(str::to_owned).collect(),
        Err(error) => return at.refuse(judge, &format!("not readable as CSV: {error}"), ""),
    };
    let chosen = chosen(judge, file, &names, &at)?;
    let mut columns: Columns = chosen.iter().map(|&(control, _)| (control, Vec::new())).collect();
    for row in reader.records() {
        let row = match row {
            Ok(row) => row,
            Err(error) => return at.refuse(judge, &format!("not readable as CSV: {error}"), ""),
        };
        let line = row.position().map_or(0, csv::Position::line);
        for &(control, index) in &chosen {
            let cell = row.get(index).unwrap_or("");
            match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => {
                    if let Some(column) = columns.get_mut(control) {
                        column.push(value);
                    }
                }
                _ => {
                    let message =
                        format!("line {line}, column {:?}: {cell:?} is no finite number", names[index]);
                    return at.refuse(judge, &message, "");
                }
            }
        }
    }
    let rows = columns.values().next().map_or(0, Vec::len);
    if !(1..=MOST_ROWS).contains(&rows) {
        let message = format!("{rows} rows below its head; between 1 and {MOST_ROWS} are allowed");
        return at.refuse(judge, &message, "");
    }
    Some(columns)
}

/// Which column of the file holds which control.
fn chosen(
    judge: &mut Judge,
    file: &StageFile,
    names: &[String],
    at: &Words,
) -> Option<Vec<(&'static str, usize)>> {
    let control_of = |word: &str| COLUMNS.into_iter().find(|control| *control == word);
    let mut chosen = Vec::new();
    if let Some(given) = &file.columns {
        for (control, column) in given {
            let Some(known) = control_of(control.get_ref()) else {
                let message = format!("{}: no control is called {:?}", at.place, control.get_ref());
                return judge.refuse(
                    control.span(),
                    message,
                    &format!("controls are: {}", COLUMNS.join(", ")),
                );
            };
            let Some(index) = names.iter().position(|name| name == column.get_ref()) else {
                let message =
                    format!("{}: no column {:?}; it has: {}", at.place, column.get_ref(), names.join(", "));
                return judge.refuse(column.span(), message, "");
            };
            chosen.push((known, index));
        }
    } else {
        for (index, name) in names.iter().enumerate() {
            let Some(known) = control_of(name) else {
                let message = format!("column {name:?} is no control");
                let help = format!(
                    "controls are: {}; columns of other names are chosen with columns = {{ shift_x = {name:?} }}",
                    COLUMNS.join(", ")
                );
                return at.refuse(judge, &message, &help);
            };
            chosen.push((known, index));
        }
    }
    for pair in [[0, 1], [2, 4], [3, 5], [6, 7]] {
        let [force, motion] = pair.map(|index| COLUMNS[index]);
        let has = |control: &str| chosen.iter().filter(|(known, _)| *known == control).count();
        if has(force) + has(motion) > 1 {
            let message = format!("{force} and {motion} prescribe one thing, and one column may do so");
            return at.refuse(judge, &message, "");
        }
    }
    if chosen.is_empty() {
        return at.refuse(judge, "no column", &format!("controls are: {}", COLUMNS.join(", ")));
    }
    Some(chosen)
}

/// Where messages about a table stand.
struct Words {
    place: String,
    span: Range<usize>,
}

impl Words {
    fn refuse<T>(&self, judge: &mut Judge, message: &str, help: &str) -> Option<T> {
        judge.refuse(self.span.clone(), format!("{}: {message}", self.place), help)
    }
}
