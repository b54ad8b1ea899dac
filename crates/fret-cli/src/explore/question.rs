//! The case with the numbers of the sliders, on a coarse grid: what is solved while a slider is dragged, and what the button writes.

use std::collections::BTreeMap;

use fret_core::model::Dimension;
use fret_core::plan::Plan;
use fret_core::units::Units;
use serde::Deserialize;
use toml::{Table, Value};

use super::sliders::{Slider, sliders};
use super::written::with_numbers;
use crate::failure::Failure;
use crate::report::Measured;
use crate::sweep::key::put;
use fret_results::CaseFile;

/// Cycles of a stage that are solved.
const MOST_CYCLES: i64 = 2;
/// Increments of a stage, and of a cycle.
const MOST_INCREMENTS: [i64; 2] = [8, 16];
/// Residual that is accepted at the least: what is drawn and told has four digits.
const TOLERANCE: f64 = 1e-6;
/// Cells of a line contact, over those along a side of another.
const LINE: i64 = 4;
/// Sizes of a grid of the contact's own size are steps of this factor, so that loads can change a little without another grid, whose
/// influence coefficients would have to be made.
const STEP: f64 = 1.12;

/// Values of keys, as the page sends them.
pub type Values = BTreeMap<String, f64>;

/// Which case the button writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Written {
    /// The grid, the cycles and the rest of the case that was opened, with the numbers of the sliders.
    Own,
    /// The case that the page shows.
    Shown,
}

/// A case to play with.
pub struct Question {
    /// The case that was opened, as it was written.
    opened: CaseFile,
    /// The same.
    own: Table,
    /// The same as it is solved here.
    coarse: Table,
    /// Its sliders.
    pub sliders: Vec<Slider>,
    /// What is solved in another way than the case says, in sentences.
    pub notes: Vec<String>,
    units: Option<Units>,
    dimension: Dimension,
    /// Sides of the grid that the numbers of the case ask for [length], where grids follow the contact.
    size: Option<[f64; 2]>,
}

impl Question {
    /// Opens a case; its grid has at most so many cells along a side.
    ///
    /// # Errors
    /// When the case is refused.
    pub fn new(file: &CaseFile, cells: u16) -> Result<Self, Failure> {
        let plan = file.planned()?;
        let own: Table = file.text.parse().map_err(|error| Failure::Defect(format!("{error}")))?;
        let mut notes = Vec::new();
        let mut coarse = own.clone();
        coarsen(&mut coarse, &plan, i64::from(cells), &mut notes);
        if plan.case.rolls() {
            return Err(Failure::call(
                format!("{}: a contact that rolls needs its many increments", file.name()),
                "fret run, and fret report of its folder",
            ));
        }
        shorten(&mut coarse, &plan, &mut notes);
        loosen(&mut coarse, &plan, &mut notes);
        for (part, note) in [
            ("wear", "no wear"),
            ("stress", "stress below the middle alone"),
            ("thermal", "no heat"),
            ("output", ""),
        ] {
            if coarse.remove(part).is_some() && !note.is_empty() {
                notes.push(note.to_owned());
            }
        }
        coarse.insert(
            "output".to_owned(),
            "every = 1\nfields = ['pressure', 'shear', 'zone']".parse::<Table>().unwrap_or_default().into(),
        );
        let (sliders, more) = sliders(&own);
        if more > 0 {
            notes.push(format!(
                "the first {} numbers that can be moved, of {}",
                sliders.len(),
                sliders.len() + more
            ));
        }
        let (units, dimension) = (plan.case.units.clone(), plan.grid.dimension());
        let mut question =
            Self { units, dimension, opened: file.clone(), own, coarse, sliders, notes, size: None };
        question.follow_the_contact(&plan);
        Ok(question)
    }

    /// Lets the grid follow the contact where the plan can find its size, and nothing of the case is given cell by cell or over a period.
    fn follow_the_contact(&mut self, plan: &Plan) {
        let is_given = !plan.case.profile.heights.is_empty()
            || plan.case.friction.is_map()
            || !plan.case.periodic.is_none();
        if is_given {
            return;
        }
        let mut automatic = self.coarse.clone();
        if put(&mut automatic, "grid.size", &Value::String("auto".to_owned())).is_err() {
            return;
        }
        if let Ok(plan) = self.file(&automatic).planned() {
            self.size = Some(plan.grid.size());
            self.coarse = automatic;
            self.notes.push("a grid that follows the contact".to_owned());
        }
    }

    /// Name of the case that was opened.
    pub fn name(&self) -> String {
        self.opened.stem().display().to_string()
    }

    /// Title of the case.
    pub fn title(&self) -> String {
        let title = self.own.get("title").and_then(Value::as_str).filter(|title| !title.is_empty());
        title.map_or_else(|| self.name(), str::to_owned)
    }

    /// The case that is solved for some values, as a file beside the one that was opened.
    ///
    /// # Errors
    /// When a key is none of the sliders, or the case with these values is refused.
    pub fn shown(&self, values: &Values) -> Result<(CaseFile, Plan), Failure> {
        let table = self.with(&self.coarse, values)?;
        let file = self.file(&table);
        let plan = file.planned()?;
        let Some(size) = self.size else { return Ok((file, plan)) };
        let mut sized = table;
        let side = |(now, side): (f64, f64)| {
            let steps = ((now / side).ln() / STEP.ln() - 1e-9).ceil();
            Value::Float(STEP.powf(steps) * side)
        };
        let sides: Vec<Value> = plan.grid.size().into_iter().zip(size).map(side).collect();
        let sides = match plan.grid.dimension() {
            Dimension::Plane => Value::Array(sides),
            Dimension::Line => sides[0].clone(),
        };
        put(&mut sized, "grid.size", &sides).map_err(Failure::Defect)?;
        let file = self.file(&sized);
        // where the step is too far for the shape of the body, the size is the plan's own
        match file.planned() {
            Ok(plan) => Ok((file, plan)),
            Err(_) => Ok((self.file(&self.with(&self.coarse, values)?), plan)),
        }
    }

    /// The text of a case with some values, to be kept.
    ///
    /// # Errors
    /// As [`Self::shown`].
    pub fn text(&self, values: &Values, which: Written) -> Result<String, Failure> {
        let text = match which {
            Written::Shown => self.shown(values)?.0.text,
            Written::Own => {
                let file = self.file(&self.with(&self.own, values)?);
                file.planned()?;
                with_numbers(&self.opened.text, values).unwrap_or(file.text)
            }
        };
        let about = match which {
            Written::Own => "with the grid and the cycles of the case that was opened".to_owned(),
            Written::Shown if self.notes.is_empty() => "as it was shown".to_owned(),
            Written::Shown => format!("as it was shown: {}", self.notes.join("; ")),
        };
        Ok(format!("# Written by fret explore {}, {about}.\n{text}", self.name()))
    }

    fn with(&self, table: &Table, values: &Values) -> Result<Table, Failure> {
        let mut table = table.clone();
        for (key, value) in values {
            if !self.sliders.iter().any(|slider| slider.key == *key) || !value.is_finite() {
                return Err(Failure::call(format!("{key}: is no slider of this case"), ""));
            }
            put(&mut table, key, &Value::Float(*value)).map_err(Failure::Defect)?;
        }
        Ok(table)
    }

    fn file(&self, table: &Table) -> CaseFile {
        CaseFile { text: toml::to_string(table).unwrap_or_default(), ..self.opened.clone() }
    }
}

impl Measured for Question {
    fn units(&self) -> Option<&Units> {
        self.units.as_ref()
    }

    fn dimension(&self) -> Dimension {
        self.dimension
    }
}

/// Fewer cells: the longer side has at most so many, a line contact four times as many.
fn coarsen(case: &mut Table, plan: &Plan, most: i64, notes: &mut Vec<String>) {
    let Some(grid) = case.get_mut("grid").and_then(Value::as_table_mut) else { return };
    let [nx, ny] = plan.grid.cells().map(|cells| cells as i64);
    let is_given = !plan.case.profile.heights.is_empty() || plan.case.friction.is_map();
    let cells = if plan.grid.dimension() == Dimension::Line {
        let cells = nx.min(LINE * most);
        if cells == nx {
            return;
        }
        let fewer = Value::Integer(cells);
        let as_pair = grid.get("cells").is_some_and(Value::is_array);
        if as_pair { Value::Array(vec![fewer, Value::Integer(1)]) } else { fewer }
    } else {
        let longest = nx.max(ny);
        if longest <= most || is_given {
            return;
        }
        Value::Array([nx, ny].map(|cells| Value::Integer((cells * most / longest).max(4))).to_vec())
    };
    let shown = cells.to_string().replace(", ", " x ");
    notes.push(format!("{} cells in place of {nx} x {ny}", shown.trim_matches(['[', ']'])));
    grid.insert("cells".to_owned(), cells);
}

/// No more digits than are drawn: each further one takes another application or two of the operators.
fn loosen(case: &mut Table, plan: &Plan, notes: &mut Vec<String>) {
    if plan.case.tolerance >= TOLERANCE {
        return;
    }
    let solver = case.entry("solver").or_insert_with(|| Table::new().into());
    if let Some(solver) = solver.as_table_mut() {
        solver.insert("tolerance".to_owned(), Value::Float(TOLERANCE));
        notes.push(format!("residuals up to {TOLERANCE:e}"));
    }
}

/// No more cycles and increments than show a steady loop.
fn shorten(case: &mut Table, plan: &Plan, notes: &mut Vec<String>) {
    let Some(stages) = case.get_mut("load").and_then(Value::as_array_mut) else { return };
    let number = |stage: &Table, key: &str| stage.get(key).and_then(Value::as_integer).unwrap_or(0);
    let mut fewer = false;
    for (stage, planned) in stages.iter_mut().filter_map(Value::as_table_mut).zip(&plan.case.stages) {
        let cycles = number(stage, "cycles");
        if cycles > MOST_CYCLES {
            notes.push(format!("{MOST_CYCLES} of {cycles} cycles"));
            stage.insert("cycles".to_owned(), Value::Integer(MOST_CYCLES));
        }
        let most = MOST_INCREMENTS[usize::from(cycles > 0)];
        // By the plan: those of a table are counted by row, and those of "auto" are the program's.
        let increments = planned.increments as i64;
        let rows =
            if stage.contains_key("table") { increments / number(stage, "increments").max(1) } else { 1 };
        if increments > most {
            stage.insert("increments".to_owned(), Value::Integer((most / rows).max(1)));
            fewer |= rows == 1;
        }
        if rows > most {
            notes.push(format!("{rows} rows of a table, each in one increment"));
        }
    }
    if fewer {
        let [stage, cycle] = MOST_INCREMENTS;
        notes.push(format!("at most {stage} increments a stage and {cycle} a cycle"));
    }
}
