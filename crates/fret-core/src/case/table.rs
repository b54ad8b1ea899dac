//! A loading history from a CSV table: one row after the other, columns named like the controls.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;

use super::judge::Judge;
use super::stage_file::StageFile;
use super::units::Units;

/// Controls a column can hold, by the names of `history.csv`.
pub(super) const COLUMNS: [&str; 19] = [
    "normal_force",
    "approach",
    "tangential_force_x",
    "tangential_force_y",
    "shift_x",
    "shift_y",
    "twist_moment",
    "twist",
    "tilt_moment_x",
    "tilt_moment_y",
    "tilt_x",
    "tilt_y",
    "bulk_stress_x",
    "bulk_stress_y",
    "upper_bulk_stress_x",
    "upper_bulk_stress_y",
    "actuator_x",
    "actuator_y",
    "actuator_approach",
];

/// Where the actuator along x and y stands among them.
pub(super) const ACTUATOR: [usize; 2] = [16, 17];
/// Where its approach does.
pub(super) const ACTUATOR_APPROACH: usize = 18;

/// Columns that prescribe one thing, of which a table may have one.
const RIVALS: [&[usize]; 10] =
    [&[0, 1, 18], &[2, 4, 16], &[3, 5, 17], &[6, 7], &[8, 10], &[9, 11], &[12], &[13], &[14], &[15]];

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
        // a table of results has units in its head
        Ok(names) => names.iter().map(|name| column_name(name).to_owned()).collect(),
        Err(error) => return at.refuse(judge, &unreadable(&error), ""),
    };
    let chosen = chosen(judge, file, &names, &at)?;
    let mut columns: Columns = chosen.iter().map(|&(control, _)| (control, Vec::new())).collect();
    for row in reader.records() {
        let row = match row {
            Ok(row) => row,
            Err(error) => return at.refuse(judge, &unreadable(&error), ""),
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

/// The name of a column: of one of the controls without the unit that may stand behind it.
fn column_name(head: &str) -> &str {
    let name = Units::name_of(head);
    if COLUMNS.contains(&name) { name } else { head }
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
    for rivals in RIVALS {
        let there: Vec<&str> = rivals
            .iter()
            .flat_map(|&rival| chosen.iter().filter(move |(known, _)| *known == COLUMNS[rival]))
            .map(|(known, _)| *known)
            .collect();
        if let [one, other, ..] = there[..] {
            let message = if one == other {
                format!("column {one:?} stands there twice")
            } else {
                format!("{one} and {other} prescribe one thing, and one column may do so")
            };
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

#[cfg(test)]
mod tests {
    use crate::case::{Attachments, Case};

    const HEAD: &str = "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\n\
                        substrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = 100.0\n\
                        [friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.01\nincrements = 1\n";

    /// Messages of a case whose second stage reads `more` and whose only file holds `file`.
    fn refusal(more: &str, file: &str) -> String {
        let text = format!("{HEAD}[[load]]\nincrements = 2\n{more}\n");
        let attachments = |name: &str| match name {
            "path.csv" => Ok(file.as_bytes().to_vec()),
            _ => Err("no such file".to_owned()),
        };
        match Case::from_toml_with(&text, "case.toml", Attachments::files(&attachments)) {
            Ok(_) => String::new(),
            Err(error) => {
                assert_eq!(error.mistakes().len(), 1, "{error}");
                assert!(error.place(&error.mistakes()[0]).is_some(), "{error}");
                error.mistakes()[0].message.clone()
            }
        }
    }

    #[test]
    fn a_good_table_is_read_whatever_its_separator() {
        for file in [
            "tangential_force_x,twist\n1e-3,0\n-1e-3,1e-4\n",
            "\u{feff}# rig 3\ntangential_force_x; twist\n 1e-3 ; 0\n-1e-3;1e-4\n",
            "tangential_force_x\ttwist\n1e-3\t0\n-1e-3\t1e-4",
        ] {
            assert_eq!(refusal("table = \"path.csv\"", file), "");
        }
    }

    #[test]
    fn every_wrong_table_is_refused_once_and_in_words() {
        let table = "table = \"path.csv\"";
        let named = "table = \"path.csv\"\ncolumns = { shift_x = \"Q\" }";
        for (more, file, words) in [
            ("table = \"other.csv\"", "", "\"other.csv\": no such file"),
            (table, "force\n1.0\n", "column \"force\" is no control"),
            (table, "", "no column"),
            (table, "shift_x\n", "0 rows"),
            (table, "shift_x,shift_y\n1e-3\n", "line 2 has 1 cell, its head 2 cells"),
            (table, "shift_x,shift_x\n1e-3,1e-3\n", "column \"shift_x\" stands there twice"),
            (table, "shift_x\n1e-3\nnan\n", "line 3, column \"shift_x\": \"nan\" is no finite number"),
            (table, "shift_x\n1,5\n", "line 2 has 2 cells, its head 1 cell"),
            (table, "shift_x,tangential_force_x\n1e-3,0\n", "one column may do so"),
            (named, "time,P\n0,1\n", "no column \"Q\"; it has: time, P"),
            ("table = \"path.csv\"\ncolumns = { pull = \"Q\" }", "Q\n1\n", "no control is called \"pull\""),
            ("table = \"path.csv\"\nshift = [1.0, 0.0]", "shift_y\n1\n", "a table and a control"),
            ("table = \"path.csv\"\nramp = \"cubic\"", "shift_y\n1\n", "ramp and table"),
            (table, "normal_force\n0.01\n-0.01\n", "normal_force reaches -0.01"),
            (table, "tangential_force_x\n0.02\n", "friction carries at most"),
            ("columns = { shift_x = \"Q\" }\nshift = [1.0, 0.0]", "", "there is no table"),
        ] {
            let found = refusal(more, file);
            assert!(found.contains(words), "{more} {file:?}: {found:?}, expected {words:?}");
        }
    }

    #[test]
    fn wrong_cycles_waves_and_steady_states_are_refused() {
        for (more, words) in [
            ("shift = [1.0, 0.0]\ncycles = 2", "the reversal points of this cycle need at least 4"),
            ("shift = [1.0, 0.0]\nwaveform = \"sine\"", "the stage has no cycles"),
            ("shift = [1.0, 0.0]\nphase = { shift = [90.0, 0.0] }", "the stage has no cycles"),
            ("shift = [1.0, \"held\"]\ntangential_force = [0.0, 0.0]", "both at once"),
            ("shift = [\"held\", \"held\"]", "nothing is prescribed"),
            (
                "shift = [1.0, 0.0]\ncycles = 1\nuntil_steady = { tolerance = 1e-3, most_cycles = 3 }",
                "both at once",
            ),
            ("shift = [1.0, 0.0]\nuntil_steady = { tolerance = 2.0, most_cycles = 3 }", "between 0 and 1"),
        ] {
            let found = refusal(more, "");
            assert!(found.contains(words), "{more}: {found:?}, expected {words:?}");
        }
    }

    #[test]
    fn wrong_words_of_a_cycle_are_refused() {
        for (more, words) in [
            ("shift = [1.0, 0.0]\nphase = { twist = 90.0 }", "this stage has no twist"),
            ("shift = [1.0, 0.0]\ndwell = 0.1", "only a trapezoid"),
            ("shift = [1.0, 0.0]\nwaveform = \"trapezoid\"\ndwell = 0.5", "between 0.001 and 0.499"),
            ("shift = [1.0, 0.0]\nramp = \"cubic\"", "ramp and cycles"),
            ("normal_force = 0.02", "normal_force reaches -0.01"),
            ("tangential_force = [2e-3, 2e-3]\nphase = { tangential_force = [inf, 0] }", "must be finite"),
        ] {
            let text = format!("{HEAD}[[load]]\nincrements = 8\ncycles = 1\n{more}\n");
            let error = Case::from_toml(&text, "case.toml").unwrap_err();
            assert_eq!(error.mistakes().len(), 1, "{error}");
            assert!(error.mistakes()[0].message.contains(words), "{error}");
        }
    }

    #[test]
    fn a_motion_of_a_table_has_no_meaning_in_a_periodic_problem() {
        let head = HEAD.replace("size = [3.0, 3.0]", "size = [3.0, 3.0]\nperiodic = true");
        let text = format!("{head}[[load]]\nincrements = 1\ntable = \"path.csv\"\n");
        for (table, words) in [
            ("twist\n1e-3\n", "a rotation is not periodic"),
            ("approach\n1e-3\n", "half-space under a periodic load has no such rigid motion"),
            (
                "normal_force,shift_x\n1e-3,1e-3\n",
                "half-space under a periodic load has no such rigid motion",
            ),
        ] {
            let files = |_: &str| Ok(table.as_bytes().to_vec());
            let error = Case::from_toml_with(&text, "case.toml", Attachments::files(&files)).unwrap_err();
            assert!(error.to_string().contains(words), "{error}");
        }
    }

    #[test]
    fn wrong_wear_is_refused() {
        for (wear, words) in [
            ("coefficient = -1.0", "must be zero or positive"),
            ("coefficient = 1.0\nevery = 0", "between 1 and"),
            ("coefficient = 1.0\nlargest_step = 0.0", "must lie above 0"),
            ("coefficient = 1.0\nlimit = 0.0", "positive finite length"),
            ("coefficient = 1.0\nthrough_coating_of = \"lower\"", "this body has no coating"),
            ("coefficient = 1.0\nthrough_coating_of = \"upper\"", "this body has no coating"),
        ] {
            let error = Case::from_toml(&format!("{HEAD}[wear]\n{wear}\n"), "case.toml").unwrap_err();
            assert_eq!(error.mistakes().len(), 1, "{error}");
            assert!(error.mistakes()[0].message.contains(words), "{error}");
        }
    }
}
