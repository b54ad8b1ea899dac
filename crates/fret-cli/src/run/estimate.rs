//! Error bars of a run: a companion at half the cells and increments is solved after it, and both are compared.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::Write;

use fret_core::case::Case;
use fret_core::model::Dimension;
use fret_core::plan::{Coupling, Plan};
use fret_core::run::Observer;
use fret_core::study::{Bar, Bars, Quantity, StageQuantities, error_bars, resolved, solved_ends};
use serde::{Deserialize, Serialize};

use crate::defect;
use crate::failure::Failure;
use crate::figures::{counted, duration, figure, shortened, side_by_side};
use crate::study::words::{first_after_steady, of_the_way};

/// Stages that stand side by side in the table.
const MOST_COLUMNS: usize = 3;
/// Width of a column.
const COLUMN: usize = 26;

/// Why there are no error bars.
#[derive(Debug)]
pub enum NoBars {
    /// Somebody stopped the companion.
    Interrupted,
    /// The reason.
    Because(String),
}

/// Error bars of the quantities of interest of a run.
#[derive(Debug)]
pub struct Estimate {
    /// As their file holds them.
    pub record: BarsRecord,
    /// The first stage after one that rolls on to a steady state.
    after_steady: Option<String>,
    /// Whether there is friction to speak of.
    rubs: bool,
}

/// A value and its bar; no bar: it has no limit.
pub type Cell = (f64, Option<f64>);

/// A number of the estimate, at the ends of some stages.
#[derive(Debug)]
pub struct BarRow {
    /// Its name.
    pub name: String,
    /// The kind of its unit.
    pub kind: &'static str,
    /// Its values with their bars; nothing at the end of a stage that has no such number.
    pub cells: Vec<Option<Cell>>,
}

/// `error_bars.json`. What is written is what the report reads back.
#[derive(Debug, Serialize, Deserialize)]
pub struct BarsRecord {
    auxiliary: Auxiliary,
    /// The ends of the stages that were read, in order.
    pub stages: Vec<StageBars>,
    #[serde(default)]
    without: Vec<WithoutBars>,
}

/// The companion.
#[derive(Debug, Serialize, Deserialize)]
struct Auxiliary {
    cells: [usize; 2],
    increments: usize,
    wall_s: f64,
}

/// The numbers at the end of a stage with their bars, by the names of their quantities.
#[derive(Debug, Serialize, Deserialize)]
pub struct StageBars {
    stage: usize,
    /// The name of the stage.
    pub name: String,
    #[serde(flatten)]
    numbers: BTreeMap<String, NumberWithBar>,
}

/// A stage without bars, and why: the cells do not show the contact well enough, or the coarse solution does not come so far.
#[derive(Debug, Serialize, Deserialize)]
struct WithoutBars {
    stage: usize,
    name: String,
    why: String,
}

/// A bar of null: the number has no limit.
#[derive(Debug, Serialize, Deserialize)]
struct NumberWithBar {
    value: Told,
    error_bar: Option<f64>,
}

/// A number, or one along x and y.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(untagged)]
enum Told {
    One(f64),
    Both([f64; 2]),
}

impl StageBars {
    fn new(bars: &Bars, name: String) -> Self {
        let number = |bar: &Bar| {
            let value =
                if bar.quantity.has_components() { Told::Both(bar.value) } else { Told::One(bar.value[0]) };
            (bar.quantity.name().to_owned(), NumberWithBar { value, error_bar: bar.bar })
        };
        Self { stage: bars.stage, name, numbers: bars.bars.iter().map(number).collect() }
    }

    /// A component of a quantity; a scalar is its only one.
    fn component(&self, quantity: Quantity, axis: usize) -> Option<Cell> {
        let number = self.numbers.get(quantity.name())?;
        let value = match number.value {
            Told::One(one) => one,
            Told::Both(both) => both[axis],
        };
        Some((value, number.error_bar))
    }

    /// The same, zero where it vanishes in the rounding of what it is beside: of a shift the approach, of a ratio one.
    fn above_rounding(&self, quantity: Quantity, axis: usize) -> Option<Cell> {
        let approach = self.component(Quantity::Approach, 0).filter(|_| quantity == Quantity::Shift);
        let beside = approach.map_or(1.0, |(approach, _)| approach.abs());
        let above = |value: f64| if value.abs() <= 1e-12 * beside { 0.0 } else { value };
        self.component(quantity, axis).map(|(value, bar)| (above(value), bar.map(above)))
    }
}

impl Estimate {
    /// Solves the companion of a solved plan, whose own quantities of interest are `stage_quantities`, and compares. The reason where that
    /// is not possible: the run itself is none the worse for it.
    pub fn new(
        plan: &Plan,
        companion: &Plan,
        stage_quantities: &[StageQuantities],
        observer: &mut dyn Observer,
    ) -> Result<Self, NoBars> {
        let of_coarse = |why: String| format!("the auxiliary coarse solution: {why}");
        let because = |why: String| NoBars::Because(of_coarse(why));
        let coarse = match defect::caught(|| Ok::<_, Failure>(solved_ends(companion, observer))) {
            Ok(coarse) => coarse,
            Err(failure) => return Err(because(failure.message())),
        };
        let missed = match coarse.missed.map(Failure::from) {
            Some(Failure::Interrupted(_)) => return Err(NoBars::Interrupted),
            missed => missed.map(|failure| failure.message()),
        };
        if let (true, Some(why)) = (coarse.ends.is_empty(), &missed) {
            return Err(because(why.clone()));
        }
        let why_not = |end: &StageQuantities| {
            let is_missed = coarse.ends.iter().all(|other| other.stage != end.stage);
            let missed = || missed.clone().filter(|_| is_missed).map(of_coarse);
            resolved(end).err().map(|error| error.to_string()).or_else(missed)
        };
        let named = |stage: usize| plan.case.stages[stage].name.clone();
        let without = |end: &StageQuantities| {
            Some(WithoutBars { stage: end.stage, name: named(end.stage), why: why_not(end)? })
        };
        let without: Vec<WithoutBars> = stage_quantities.iter().filter_map(without).collect();
        let bars = error_bars(plan, stage_quantities, &coarse.ends);
        if let (true, Some(first)) = (bars.is_empty(), without.first()) {
            return Err(NoBars::Because(first.why.clone()));
        }
        let auxiliary = Auxiliary {
            cells: companion.case.cells,
            increments: companion.increments,
            wall_s: coarse.wall_s,
        };
        let stages = bars.iter().map(|bars| StageBars::new(bars, named(bars.stage))).collect();
        Ok(Self::of(BarsRecord { auxiliary, stages, without }, plan))
    }

    /// The estimate of a run of this plan whose bars are known.
    pub fn of<M, H>(record: BarsRecord, plan: &Plan<Case<M, H>>) -> Self {
        let stages = &plan.case.stages;
        let after_steady = first_after_steady(stages).map(|stage| stages[stage].name.clone());
        Self { record, after_steady, rubs: plan.coupling != Coupling::Frictionless }
    }

    /// The numbers with their bars, a row a number, for the ends of some stages.
    pub fn rows(&self, shown: &[StageBars]) -> Vec<BarRow> {
        let dimension = Dimension::of(self.record.auxiliary.cells);
        let row = |name: String, kind, cell: &dyn Fn(&StageBars) -> Option<Cell>| BarRow {
            name,
            kind,
            cells: shown.iter().map(cell).collect(),
        };
        let has = |quantity: &Quantity| shown.iter().any(|bars| bars.component(*quantity, 0).is_some());
        let mut rows = Vec::new();
        for quantity in Quantity::ALL.into_iter().filter(has) {
            let scalar = |bars: &StageBars| bars.component(quantity, 0);
            let (name, kind) = (quantity.in_words(dimension), quantity.kind());
            match quantity {
                Quantity::StickArea | Quantity::Shift | Quantity::DissipatedEnergy if !self.rubs => {}
                Quantity::Shift | Quantity::Creepage => {
                    for (axis, direction) in ["x", "y"].into_iter().enumerate() {
                        let cell = |bars: &StageBars| bars.above_rounding(quantity, axis);
                        rows.push(row(format!("{name} {direction}"), kind, &cell));
                    }
                }
                Quantity::ContactArea if dimension == Dimension::Plane => {
                    rows.push(row(name, kind, &scalar));
                    let of_that_area = "radius of a circle of that area".to_owned();
                    rows.push(row(of_that_area, "length", &|bars| scalar(bars).map(radius)));
                }
                _ => rows.push(row(name, kind, &scalar)),
            }
        }
        rows
    }

    /// Where they come from.
    pub fn source(&self) -> String {
        let Auxiliary { cells, increments, .. } = self.record.auxiliary;
        let cells = Dimension::of(cells).written(cells);
        let increments = counted(increments, "increment");
        format!("from an auxiliary coarse solution on {cells} cells with {increments}")
    }

    /// The numbers with their bars, a column a stage.
    pub fn table(&self) -> String {
        let stages = &self.record.stages;
        let shown = &stages[stages.len().saturating_sub(MOST_COLUMNS)..];
        let mut table = String::new();
        let names = shown.iter().map(|bars| shortened(&bars.name, COLUMN - 2));
        side_by_side(&mut table, "error bars, at the end of", COLUMN, names);
        for BarRow { name, cells, .. } in self.rows(shown) {
            let told = cells
                .into_iter()
                .map(|cell| cell.map_or("-".to_owned(), |(value, bar)| with_bar(value, bar)));
            side_by_side(&mut table, &name, COLUMN, told);
        }
        let _ = write!(table, "{}, {}", self.source(), duration(self.record.auxiliary.wall_s));
        for line in self.lacking() {
            let _ = write!(table, "\n{line}");
        }
        table
    }

    /// Which stages have no bars, and which numbers, with the reasons: a line a reason.
    pub fn lacking(&self) -> Vec<String> {
        let line = |stages: &[WithoutBars]| {
            let names: Vec<&str> = stages.iter().map(|stage| stage.name.as_str()).collect();
            format!("no error bars at the end of {}: {}", names.join(", "), stages[0].why)
        };
        let after = self.after_steady.as_ref().map(|stage| of_the_way(stage, "have no error bars"));
        self.record.without.chunk_by(|one, other| one.why == other.why).map(line).chain(after).collect()
    }
}

/// The radius of a circle of an area, with the bar that follows from the area's.
fn radius((area, bar): Cell) -> Cell {
    let radius = (area / PI).sqrt();
    (radius, bar.filter(|_| radius > 0.0).map(|bar| bar / (2.0 * PI * radius)))
}

/// `value ± bar`.
fn with_bar(value: f64, bar: Option<f64>) -> String {
    match bar {
        Some(0.0) => figure(value),
        Some(bar) => format!("{} ± {bar:.1e}", figure(value)),
        None => "no limit".to_owned(),
    }
}
