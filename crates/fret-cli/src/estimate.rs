//! Error bars of a run: a companion at half the cells and increments is solved after it, and both are compared.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::Write;

use fret_core::model::Dimension;
use fret_core::plan::{Coupling, Plan, PlanRecord};
use fret_core::run::Observer;
use fret_core::study::{Bar, Bars, Quantity, StageQuantities, error_bars, resolved, solved_ends};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::defect;
use crate::failure::Failure;
use crate::figures::{counted, duration, figure, shortened, side_by_side};
use crate::study::words::{first_after_steady, name, of_the_way};

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
    /// At the ends of the stages that were read, in order.
    pub bars: Vec<Bars>,
    /// Cells of the companion.
    cells: [usize; 2],
    /// Its increments.
    increments: usize,
    /// Its time [s].
    wall_s: f64,
    /// Stages without bars, and why: the cells do not show the contact well enough, or the coarse solution does not come so far.
    without: Vec<(usize, String)>,
    /// The first stage after one that rolls on to a steady state.
    after_steady: Option<usize>,
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

/// Error bars as their file holds them, see [`Estimate::to_json`].
#[derive(Debug, Deserialize)]
pub struct BarsRecord {
    auxiliary: Auxiliary,
    stages: Vec<StageBars>,
    #[serde(default)]
    without: Vec<WithoutBars>,
}

#[derive(Debug, Deserialize)]
struct Auxiliary {
    cells: [usize; 2],
    increments: usize,
    wall_s: f64,
}

#[derive(Debug, Deserialize)]
struct StageBars {
    stage: usize,
    #[serde(rename = "name")]
    _name: String,
    #[serde(flatten)]
    numbers: BTreeMap<String, NumberWithBar>,
}

/// A stage without bars, and why.
#[derive(Debug, Deserialize)]
struct WithoutBars {
    stage: usize,
    why: String,
}

#[derive(Debug, Deserialize)]
struct NumberWithBar {
    value: Told,
    error_bar: Option<f64>,
}

/// A number, or one along x and y.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(untagged)]
enum Told {
    One(f64),
    Both([f64; 2]),
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
        let without: Vec<(usize, String)> =
            stage_quantities.iter().filter_map(|end| Some((end.stage, why_not(end)?))).collect();
        let bars = error_bars(plan, stage_quantities, &coarse.ends);
        if let (true, Some((_, why))) = (bars.is_empty(), without.first()) {
            return Err(NoBars::Because(why.clone()));
        }
        Ok(Self {
            bars,
            without,
            after_steady: first_after_steady(&plan.case.stages),
            cells: companion.case.cells,
            increments: companion.increments,
            wall_s: coarse.wall_s,
            rubs: plan.coupling != Coupling::Frictionless,
        })
    }

    /// An estimate of a file, of a run of this plan.
    pub fn read_back(record: &BarsRecord, plan: &PlanRecord) -> Self {
        let bar = |stage: &StageBars, quantity: Quantity| {
            let number = stage.numbers.get(quantity.name())?;
            let value = match number.value {
                Told::Both(both) => both,
                Told::One(one) => [one, 0.0],
            };
            Some(Bar { quantity, value, bar: number.error_bar })
        };
        let bars = |stage: &StageBars| Bars {
            stage: stage.stage,
            bars: Quantity::ALL.into_iter().filter_map(|quantity| bar(stage, quantity)).collect(),
        };
        Self {
            bars: record.stages.iter().map(bars).collect(),
            cells: record.auxiliary.cells,
            increments: record.auxiliary.increments,
            wall_s: record.auxiliary.wall_s,
            without: record.without.iter().map(|of| (of.stage, of.why.clone())).collect(),
            after_steady: first_after_steady(&plan.case.stages),
            rubs: plan.coupling != Coupling::Frictionless,
        }
    }

    /// The numbers with their bars, a row a number, for the ends of some stages.
    pub fn rows(&self, shown: &[Bars]) -> Vec<BarRow> {
        let dimension = Dimension::of(self.cells);
        let row = |name: &str, kind, cell: &dyn Fn(&Bars) -> Option<Cell>| BarRow {
            name: name.to_owned(),
            kind,
            cells: shown.iter().map(cell).collect(),
        };
        let has = |quantity: Quantity| shown.iter().any(|bars| bars.of(quantity).is_some());
        let mut rows = Vec::new();
        for quantity in Quantity::ALL.into_iter().filter(|quantity| has(*quantity)) {
            let scalar = |bars: &Bars| bars.of(quantity).map(|bar| (bar.value[0], bar.bar));
            let (name, kind) = (name(quantity, dimension), kind(quantity));
            match quantity {
                Quantity::StickArea | Quantity::Shift | Quantity::DissipatedEnergy if !self.rubs => {}
                Quantity::Shift | Quantity::Creepage => {
                    for (axis, direction) in ["x", "y"].into_iter().enumerate() {
                        rows.push(row(&format!("{name} {direction}"), kind, &|bars| {
                            bars.of(quantity).map(|bar| component(&bar, axis, beside(bars, quantity)))
                        }));
                    }
                }
                Quantity::ContactArea if dimension == Dimension::Plane => {
                    rows.push(row(name, kind, &scalar));
                    let radius = |bars: &Bars| bars.of(quantity).as_ref().map(radius);
                    rows.push(row("radius of a circle of that area", "length", &radius));
                }
                _ => rows.push(row(name, kind, &scalar)),
            }
        }
        rows
    }

    /// Where they come from.
    pub fn source(&self) -> String {
        let cells = Dimension::of(self.cells).written(self.cells);
        let increments = counted(self.increments, "increment");
        format!("from an auxiliary coarse solution on {cells} cells with {increments}")
    }

    /// The numbers with their bars, a column a stage.
    pub fn table(&self, stage_name: impl Fn(usize) -> String) -> String {
        let shown = &self.bars[self.bars.len().saturating_sub(MOST_COLUMNS)..];
        let mut table = String::new();
        let names = shown.iter().map(|bars| shortened(&stage_name(bars.stage), COLUMN - 2));
        side_by_side(&mut table, "error bars, at the end of", COLUMN, names);
        for BarRow { name, cells, .. } in self.rows(shown) {
            let told = cells
                .into_iter()
                .map(|cell| cell.map_or("-".to_owned(), |(value, bar)| with_bar(value, bar)));
            side_by_side(&mut table, &name, COLUMN, told);
        }
        let _ = write!(table, "{}, {}", self.source(), duration(self.wall_s));
        for line in self.lacking(stage_name) {
            let _ = write!(table, "\n{line}");
        }
        table
    }

    /// Which stages have no bars, and which numbers, with the reasons: a line a reason.
    pub fn lacking(&self, stage_name: impl Fn(usize) -> String) -> Vec<String> {
        let alike = self.without.chunk_by(|(_, one), (_, other)| one == other);
        let line = |stages: &[(usize, String)]| {
            let names: Vec<String> = stages.iter().map(|(stage, _)| stage_name(*stage)).collect();
            format!("no error bars at the end of {}: {}", names.join(", "), stages[0].1)
        };
        let after = self.after_steady.map(|stage| of_the_way(&stage_name(stage), "have no error bars"));
        alike.map(line).chain(after).collect()
    }

    /// The same for programs. A bar of null: the number has no limit.
    pub fn to_json(&self, stage_name: impl Fn(usize) -> String) -> Value {
        let stage = |bars: &Bars| {
            let mut value = json!({ "stage": bars.stage, "name": stage_name(bars.stage) });
            for Bar { quantity, value: number, bar } in &bars.bars {
                let number = if quantity.has_components() { json!(number) } else { json!(number[0]) };
                value[quantity.name()] = json!({ "value": number, "error_bar": bar });
            }
            value
        };
        json!({
            "auxiliary": { "cells": self.cells, "increments": self.increments, "wall_s": self.wall_s },
            "stages": self.bars.iter().map(stage).collect::<Vec<_>>(),
            "without": self.without.iter().map(|(stage, why)| json!({ "stage": stage, "name": stage_name(*stage), "why": why })).collect::<Vec<_>>(),
        })
    }
}

/// The kind of the unit of a quantity.
fn kind(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::MaxPressure => "pressure",
        Quantity::Approach | Quantity::Shift | Quantity::MaxWornDepth => "length",
        Quantity::ContactArea | Quantity::StickArea => "length^2",
        Quantity::DissipatedEnergy => "force x length",
        Quantity::Creepage => "",
        Quantity::Spin => "1/length",
        Quantity::RollingFriction => "force",
        Quantity::WornVolume => "length^3",
    }
}

/// What a component of a motion vanishes beside: the approach; of a creepage, which is a ratio, one.
fn beside(bars: &Bars, quantity: Quantity) -> f64 {
    match bars.of(Quantity::Approach) {
        Some(approach) if quantity == Quantity::Shift => approach.value[0].abs(),
        _ => 1.0,
    }
}

/// A component with its bar, both zero where they vanish in the rounding of what they are beside.
fn component(bar: &Bar, axis: usize, beside: f64) -> Cell {
    let above_rounding = |value: f64| if value.abs() <= 1e-12 * beside { 0.0 } else { value };
    (above_rounding(bar.value[axis]), bar.bar.map(above_rounding))
}

/// The radius of a circle of an area, with the bar that follows from the area's.
fn radius(area: &Bar) -> Cell {
    let radius = (area.value[0] / PI).sqrt();
    (radius, area.bar.filter(|_| radius > 0.0).map(|bar| bar / (2.0 * PI * radius)))
}

/// `value ± bar`.
fn with_bar(value: f64, bar: Option<f64>) -> String {
    match bar {
        Some(0.0) => figure(value),
        Some(bar) => format!("{} ± {bar:.1e}", figure(value)),
        None => "no limit".to_owned(),
    }
}
