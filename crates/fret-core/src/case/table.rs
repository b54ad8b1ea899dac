//! A loading history from a CSV table: one row after the other, columns named like the controls.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;

use super::heading::Heading;
use super::judge::Judge;
use super::known_units::{Conversion, UnitError, conversion, is_unit, known_units};
use super::numbers::{NoNumber, is_comment, number};
use super::stage_file::StageFile;
use super::units::Units;

/// Controls a column can hold, by the names of `history.csv`, and what kind of quantity each is in a point contact.
pub(super) const CONTROLS: [(&str, &str); 19] = [
    ("normal_force", "force"),
    ("approach", "length"),
    ("tangential_force_x", "force"),
    ("tangential_force_y", "force"),
    ("shift_x", "length"),
    ("shift_y", "length"),
    ("twist_moment", "force x length"),
    ("twist", "rad"),
    ("tilt_moment_x", "force x length"),
    ("tilt_moment_y", "force x length"),
    ("tilt_x", "-"),
    ("tilt_y", "-"),
    ("bulk_stress_x", "pressure"),
    ("bulk_stress_y", "pressure"),
    ("upper_bulk_stress_x", "pressure"),
    ("upper_bulk_stress_y", "pressure"),
    ("actuator_x", "length"),
    ("actuator_y", "length"),
    ("actuator_approach", "length"),
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

/// A chosen column: its control, where it stands, its name, and how its numbers become those of the case.
struct Chosen {
    control: usize,
    index: usize,
    name: String,
    unit: Option<String>,
    conversion: Conversion,
}

/// The table of a stage, in the units of the case; `None` when it was refused.
pub(super) fn table(
    judge: &mut Judge,
    place: &str,
    file: &StageFile,
    name: &Spanned<String>,
) -> Option<Columns> {
    let text = judge.attached_text(&format!("{place}.table"), name)?;
    let at = Words { place: format!("{place}.table {:?}", name.get_ref()), span: name.span() };
    let Layout { delimiter, line: head_line, text } = layout(&text);
    let decimal_comma = delimiter != b',';
    let mut reader =
        csv::ReaderBuilder::new().delimiter(delimiter).trim(csv::Trim::All).from_reader(text.as_bytes());
    let names: Vec<String> = match reader.headers() {
        Ok(names) => names.iter().map(str::to_owned).collect(),
        Err(error) => return at.refuse(judge, &unreadable(&error), ""),
    };
    let mut chosen = chosen(judge, file, &names, &at, head_line)?;
    let mut columns: Columns = chosen.iter().map(|column| (CONTROLS[column.control].0, Vec::new())).collect();
    let (mut is_first, mut decimals) = (true, Decimals::default());
    for row in reader.records() {
        let row = match row {
            Ok(row) => row,
            Err(error) => {
                let help = if delimiter == b',' && is_longer(&error) { DECIMAL_COMMAS } else { "" };
                return at.refuse(judge, &unreadable(&error), help);
            }
        };
        let line = row.position().map_or(0, csv::Position::line);
        if row.iter().all(str::is_empty) {
            continue;
        }
        if is_first && units_below(&row, &mut chosen) {
            is_first = false;
            continue;
        }
        if is_first {
            convert(judge, &at, head_line, &mut chosen)?;
            is_first = false;
        }
        for column in &chosen {
            let cell = row.get(column.index).unwrap_or("");
            let found = decimals.seen(cell).and_then(|()| number(cell, decimal_comma));
            let found = found
                .map(|value| column.conversion.of(value))
                .and_then(|value| if value.is_finite() { Ok(value) } else { Err(NoNumber::NotFinite) });
            match (found, columns.get_mut(CONTROLS[column.control].0)) {
                (Ok(value), Some(values)) => values.push(value),
                (Ok(_), None) => {}
                (Err(why), _) => {
                    let help = if why == NoNumber::CommaAndPoint { DECIMAL_COMMAS } else { "" };
                    let message = format!("line {line}, column {:?}: {cell:?} {why}", column.name);
                    return at.refuse(judge, &message, help);
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

const DECIMAL_COMMAS: &str =
    "write decimal points; or decimal commas, with semicolons or tabs between the columns";

/// Decimal points and decimal commas of a table, of which there may be one kind.
#[derive(Default)]
struct Decimals {
    comma: bool,
    point: bool,
}

impl Decimals {
    fn seen(&mut self, cell: &str) -> Result<(), NoNumber> {
        self.comma |= cell.contains(',');
        self.point |= cell.contains('.') && !cell.starts_with("1.#");
        if self.comma && self.point { Err(NoNumber::CommaAndPoint) } else { Ok(()) }
    }
}

/// Where a table begins.
struct Layout {
    delimiter: u8,
    /// Line of the head, from 1.
    line: usize,
    /// The table from its head on, its comments as empty lines.
    text: String,
}

/// Finds the head of a table: its first line that is no comment, or where that is a line of numbers, the comment above it.
fn layout(text: &str) -> Layout {
    let delimiter_of = |line: &str| [';', '\t'].into_iter().find(|&mark| line.contains(mark)).unwrap_or(',');
    let words = |line: &str| {
        line.split(delimiter_of(line)).map(|cell| cell.trim().to_owned()).collect::<Vec<String>>()
    };
    let is_of_numbers = |line: &str| words(line).iter().all(|cell| number(cell, true).is_ok());
    let plain = |line: &str| !line.trim().is_empty() && !is_comment(line);
    // a semicolon that begins a line makes it a comment where semicolons part nothing
    let parts = |line: &str| line.trim_start_matches(';').contains(';');
    let semicolons_part = text.lines().find(|line| plain(line) && !line.starts_with(';')).is_some_and(parts);
    let is_row = |line: &str| plain(line) && (semicolons_part || !line.starts_with(';'));
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| is_row(line)).unwrap_or(lines.len());
    let above = lines[..first].iter().rposition(|line| !line.trim().is_empty());
    let commented = above.filter(|&above| {
        let [head, row] = [above, first].map(|at| lines.get(at).map_or(0, |line| words(line).len()));
        lines.get(first).is_some_and(|line| is_of_numbers(line)) && head == row
    });
    let head = commented.unwrap_or(first);
    let mut table = "\n".repeat(head);
    for (at, line) in lines.iter().enumerate().skip(head) {
        if at == head {
            table.push_str(line.trim_start().trim_start_matches(['#', '%', '!', '/']));
        } else if is_row(line) {
            table.push_str(line);
        }
        table.push('\n');
    }
    Layout { delimiter: delimiter_of(lines.get(head).unwrap_or(&"")) as u8, line: head + 1, text: table }
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

/// Finds how the numbers of each column become those of the case; `None` when a unit was refused.
fn convert(judge: &mut Judge, at: &Words, line: usize, chosen: &mut [Chosen]) -> Option<()> {
    for column in chosen {
        let Some(unit) = &column.unit else { continue };
        let (control, kind) = CONTROLS[column.control];
        let kind = if judge.is_line { Units::per_length(kind) } else { kind };
        match conversion(unit, kind, judge.units.as_ref()) {
            Ok(conversion) => column.conversion = conversion,
            Err(error) => {
                let message = format!("line {line}, column {:?}: {control} in {error}", column.name);
                let help = match error {
                    UnitError::CaseWithout(_) => {
                        "[units] length = \"mm\", force = \"N\" says what the case is in; without it units of SI without a prefix are taken"
                    }
                    _ => known_units(kind),
                };
                return at.refuse(judge, &message, help);
            }
        }
    }
    Some(())
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
fn chosen(
    judge: &mut Judge,
    file: &StageFile,
    names: &[String],
    at: &Words,
    line: usize,
) -> Option<Vec<Chosen>> {
    let controls = || CONTROLS.map(|(name, _)| name).join(", ");
    let control_of = |word: &str| CONTROLS.iter().position(|(control, _)| *control == word);
    let mut headings: Vec<Option<Heading>> = names.iter().map(|name| Heading::of(name)).collect();
    let mut found: Vec<(usize, usize)> = Vec::new();
    if let Some(given) = &file.columns {
        for (control, column) in given {
            let Some(known) = control_of(control.get_ref()) else {
                let message = format!("{}: no control is called {:?}", at.place, control.get_ref());
                return judge.refuse(control.span(), message, &format!("controls are: {}", controls()));
            };
            let wanted = column.get_ref();
            let whole = names.iter().position(|name| name == wanted);
            let without_unit =
                |heading: &Option<Heading>| heading.as_ref().is_some_and(|heading| heading.name == *wanted);
            let Some(index) = whole.or_else(|| headings.iter().position(without_unit)) else {
                let message = format!("{}: no column {wanted:?}; it has: {}", at.place, names.join(", "));
                return judge.refuse(column.span(), message, "");
            };
            found.push((known, index));
        }
    } else {
        for (index, name) in names.iter().enumerate() {
            let Some(heading) = &headings[index] else { return at.unclosed(judge, line, name) };
            let Some(known) = control_of(&heading.name) else {
                let message = format!("column {name:?} is no control");
                let help = format!(
                    "controls are: {}; columns of other names are chosen with columns = {{ shift_x = {name:?} }}",
                    controls()
                );
                return at.refuse(judge, &message, &help);
            };
            found.push((known, index));
        }
    }
    for rivals in RIVALS {
        let there: Vec<&str> = rivals
            .iter()
            .flat_map(|&rival| found.iter().filter(move |(known, _)| *known == rival))
            .map(|(known, _)| CONTROLS[*known].0)
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
    if found.is_empty() {
        return at.refuse(judge, "no column", &format!("controls are: {}", controls()));
    }
    let mut chosen = Vec::new();
    for (control, index) in found {
        let name = names[index].clone();
        let Some(heading) = headings[index].take() else { return at.unclosed(judge, line, &name) };
        chosen.push(Chosen { control, index, name, unit: heading.unit, conversion: Conversion::NONE });
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

    fn unclosed<T>(&self, judge: &mut Judge, line: usize, name: &str) -> Option<T> {
        let message = format!("line {line}, column {name:?}: a bracket that is not closed, or closed twice");
        self.refuse(judge, &message, "a name and its unit are written like normal_force [N]")
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
            (
                table,
                "shift_x\n1e-3\nnan\n",
                "line 3, column \"shift_x\": \"nan\" stands for a value that was not measured",
            ),
            (table, "shift_x\n1e-3\n1e999\n", "line 3, column \"shift_x\": \"1e999\" is no finite number"),
            (table, "# a\n\nshift_x\n% b\n1e-3\nx7\n", "line 6, column \"shift_x\": \"x7\" is not a number"),
            (table, "shift_x\nm\n1e-3\nmm\n", "line 4, column \"shift_x\": \"mm\" is not a number"),
            (table, "# shift_x\n1e-3\n1e-3x\n", "line 3, column \"shift_x\""),
            (table, "; rig\nshift_x\n; more\n1e-3\nx\n", "line 5, column \"shift_x\""),
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
            ("shift = [1.0, 0.0]\ncycles = 2", "the turns of this cycle need at least 4"),
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
