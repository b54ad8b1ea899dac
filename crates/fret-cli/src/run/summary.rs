//! What a run found, at its end: as a table for a person, as JSON for a program.

use std::fmt::Write;
use std::path::Path;

use fret_core::case::Stage;
use fret_core::history::{CycleRecord, StepRecord, Warning, WornByLayer, WornTo, rolling_columns};
use fret_core::model::Dimension;
use fret_core::plan::{Coupling, Plan};
use fret_core::study::pressure_is_unbounded;
use fret_core::units::Units;
use serde::Serialize;
use serde_json::{Value, json};

use super::estimate::Estimate;
use super::methods::paragraph;
use crate::failure::Failure;
use crate::figures::{
    LONGEST_TITLE, NAMES, counted, duration, figure, figure_beside, figure_in, percent, shortened,
    side_by_side,
};
use crate::loop_numbers::{loop_numbers, sliding_condition};
use crate::plan_words::warning_line;
use crate::study::words::GROWS;
use fret_results::{Tally, commit::COMMIT};

/// Stages that stand side by side in the table.
const MOST_COLUMNS: usize = 4;
/// Cycles that are listed one by one.
const MOST_CYCLES: usize = 6;
/// Width of a column of numbers.
const COLUMN: usize = 15;

/// How a run ended.
#[derive(Debug)]
pub struct Ended {
    /// What it came to.
    pub tally: Tally,
    /// What about its numbers may mislead.
    pub warnings: Vec<Warning>,
    /// Time of the whole run [s].
    pub wall_s: f64,
    /// Error bars, where they were asked for and could be had.
    pub estimate: Option<Estimate>,
    /// Why early, if it did.
    pub failure: Option<Failure>,
}

/// A run that is over.
#[derive(Debug)]
pub struct Summary<'a> {
    /// What was planned.
    pub plan: &'a Plan,
    /// Where the results are.
    pub folder: &'a Path,
    /// Threads computed with.
    pub threads: usize,
    /// How it ended.
    pub ended: &'a Ended,
}

/// A row of the table: its name, the kind of its unit, what it says of the end of a stage.
type Reading = (&'static str, &'static str, fn(&StepRecord) -> String);

impl Summary<'_> {
    /// The table.
    pub fn table(&self) -> String {
        let dimension = self.plan.grid.dimension();
        let mut table = String::new();
        if !self.plan.case.title.is_empty() {
            let _ = writeln!(table, "{}\n", shortened(&self.plan.case.title, LONGEST_TITLE));
        }
        let ends = &self.ended.tally.stage_ends;
        let shown = &ends[ends.len().saturating_sub(MOST_COLUMNS)..];
        let names = shown.iter().map(|record| self.stage_name(record.stage));
        side_by_side(&mut table, "after stage", COLUMN, names.map(|name| shortened(name, COLUMN - 2)));
        for (name, kind, reading) in self.readings() {
            side_by_side(&mut table, &self.plan.case.heading(name, kind), COLUMN, shown.iter().map(reading));
        }
        if shown.iter().any(|record| record.creepage.is_some()) {
            for (column, of) in rolling_columns() {
                let heading = self.plan.case.heading(&column.in_words(), column.unit);
                let told = |record: &StepRecord| of(record).map_or("-".to_owned(), figure);
                side_by_side(&mut table, &heading, COLUMN, shown.iter().map(told));
            }
        }
        if self.plan.case.wear.is_some() || self.plan.case.friction_evolution.is_some() {
            let cycles = || shown.iter().map(|record| self.cycles_of(record.stage));
            let told = |number: Option<usize>| number.map_or("-".to_owned(), |number| number.to_string());
            side_by_side(&mut table, "cycles", COLUMN, cycles().map(|over| told(over.map(|[all, _]| all))));
            if cycles().flatten().any(|[all, solved]| all != solved) {
                side_by_side(
                    &mut table,
                    "cycles solved",
                    COLUMN,
                    cycles().map(|over| told(over.map(|[_, solved]| solved))),
                );
            }
        }
        if shown.len() < ends.len() {
            let _ = writeln!(table, "(the last {MOST_COLUMNS} of {} stages)", ends.len());
        }
        table.push('\n');
        self.cycles(&mut table);
        let line = |name: &str, value: &str| {
            format!(
                "{name:<NAMES$}{value}
"
            )
        };
        if let Some(worn) = &self.ended.tally.worn_through {
            let [x, y] = worn.place.map(|place| self.length(place));
            let after = counted(worn.cycles, "cycle");
            let what = match worn.to {
                WornTo::Coating => "coating worn through",
                WornTo::Limit => "worn to the limit",
            };
            let stage = self.stage_name(worn.stage);
            table += &line(what, &format!("after {after} of {stage}, at ({x}, {y})"));
        }
        let volume =
            |value: f64| figure(value) + &Units::after(self.plan.case.units.as_ref(), "length^3", dimension);
        for (name, volumes) in
            self.ended.tally.worn_by_layer.iter().flat_map(|worn| volumes_by_layer(worn, volume))
        {
            table += &line(&name, &volumes);
        }
        if let Some(estimate) = &self.ended.estimate {
            let _ = writeln!(table, "{}\n", estimate.table());
        }
        let residual =
            format!("{:.1e} (tolerance {:.1e})", self.ended.tally.largest_residual, self.plan.case.tolerance);
        if let Some(datum) = self.plan.datum {
            table += &line("approach, shift relative to", &format!("{} below the load", self.length(datum)));
        }
        if pressure_is_unbounded(&self.plan.case, self.plan.grid.cells()) {
            table += &line("limit of max pressure", &format!("none: {GROWS}"));
        }
        for (name, value) in [
            ("increments", self.ended.tally.solved.to_string()),
            ("max residual", residual),
            ("convolutions", self.ended.tally.work.convolutions.to_string()),
            ("wall time", format!("{} on {}", duration(self.ended.wall_s), counted(self.threads, "thread"))),
            ("results", self.folder.display().to_string()),
        ] {
            table += &line(name, &value);
        }
        for warning in &self.ended.warnings {
            let _ = writeln!(table, "{}", warning_line(warning));
        }
        table.truncate(table.trim_end().len());
        table
    }

    fn readings(&self) -> Vec<Reading> {
        let dimension = self.plan.grid.dimension();
        let mut readings: Vec<Reading> = vec![
            ("normal force", "force", |of| figure(of.normal_force)),
            ("approach", "length", |of| figure(of.approach)),
            ("max pressure", "pressure", |of| figure(of.max_pressure)),
        ];
        if self.plan.case.counts_mean_gap() {
            readings[1] = ("mean gap", "length", |of| of.mean_gap.map_or("-".to_owned(), figure));
        }
        match dimension {
            Dimension::Plane => readings.extend::<[Reading; 2]>([
                ("contact area", "length^2", |of| figure(of.contact_area)),
                ("radius of a circle of that area", "length", |of| {
                    figure(Dimension::Plane.radius(of.contact_area))
                }),
            ]),
            Dimension::Line => {
                readings[0].0 = "normal force per unit length";
                readings.push(("contact width", "length^2", |of| figure(of.contact_area)));
            }
        }
        if self.plan.coupling != Coupling::Frictionless {
            readings.extend::<[Reading; 7]>([
                ("tangential force x", "force", |of| figure_beside(of.tangential_force[0], of.normal_force)),
                ("tangential force y", "force", |of| figure_beside(of.tangential_force[1], of.normal_force)),
                ("shift x", "length", |of| figure_beside(of.shift[0], of.approach)),
                ("shift y", "length", |of| figure_beside(of.shift[1], of.approach)),
                ("max shear", "pressure", |of| figure(of.max_shear)),
                ("stick fraction of the contact", "", |of| stick_share(of).map_or("-".to_owned(), percent)),
                ("dissipated energy so far", "force x length", |of| figure(of.dissipated_energy)),
            ]);
        }
        if self.plan.case.friction_evolution.is_some() {
            readings.push(("mean friction coefficient", "", |of| figure(of.friction_coefficient)));
        }
        if self.plan.case.wear.is_some() {
            readings.push(("worn volume so far", "length^3", |of| figure(of.worn_volume)));
            readings.push(("max wear depth", "length", |of| figure(of.max_worn_depth)));
        }
        let stages = &self.plan.case.stages;
        if stages.iter().any(|stage| stage.twist.is_some()) {
            readings.push(("torsional moment", "force x length", |of| figure(of.twist_moment)));
            readings.push(("twist", "rad", |of| figure(of.twist)));
        }
        if stages.iter().any(Stage::tilts) {
            readings.extend::<[Reading; 4]>([
                ("tilt moment x", "force x length", |of| figure_beside(of.tilt_moment[0], of.normal_force)),
                ("tilt moment y", "force x length", |of| figure_beside(of.tilt_moment[1], of.normal_force)),
                ("tilt x", "rad", |of| figure(of.tilt[0])),
                ("tilt y", "rad", |of| figure(of.tilt[1])),
            ]);
        }
        if stages.iter().any(Stage::stretches) {
            readings.extend::<[Reading; 3]>([
                ("bulk stress x, lower", "pressure", |of| figure(of.bulk_stress[0][0])),
                ("bulk stress x, upper", "pressure", |of| figure(of.bulk_stress[1][0])),
                ("work of the bulk stress so far", "force x length", |of| figure(of.bulk_work)),
            ]);
        }
        readings
    }

    /// A length with its unit.
    fn length(&self, value: f64) -> String {
        figure_in(self.plan.case.units.as_ref(), value, "length")
    }

    /// Cycles of a stage that are over, with those that solved ones stand for, and those that were solved.
    fn cycles_of(&self, stage: usize) -> Option<[usize; 2]> {
        let last = self.ended.tally.cycles.iter().rfind(|cycle| cycle.stage == stage)?;
        Some([last.last_cycle, last.cycle])
    }

    fn cycles(&self, table: &mut String) {
        let energies = &self.ended.tally.cycles;
        let skipped = energies.len().saturating_sub(MOST_CYCLES);
        let mut line = |energy: &CycleRecord| {
            let name = match energy.stands_for {
                1 => format!("energy dissipated in cycle {}", energy.last_cycle),
                all => {
                    let first = (energy.last_cycle + 1).saturating_sub(all);
                    format!("in each of cycles {first} to {}", energy.last_cycle)
                }
            };
            let value = figure(energy.dissipated_energy);
            let name = self.plan.case.heading(&name, "force x length");
            side_by_side(table, &format!("{name} "), COLUMN, std::iter::once(value));
            table.truncate(table.len() - 1);
            let _ = writeln!(table, "  {}", self.stage_name(energy.stage));
        };
        energies.iter().take(1).for_each(&mut line);
        energies.iter().skip(1 + skipped).for_each(&mut line);
        if skipped > 0 {
            let _ =
                writeln!(table, "(the first cycle and the last {} of {})", MOST_CYCLES - 1, energies.len());
        }
        if let Some(last) = energies.last() {
            self.loop_of(last, table);
            table.push('\n');
        }
    }

    /// What the loop of a cycle tells.
    fn loop_of(&self, cycle: &CycleRecord, table: &mut String) {
        let stage = self.stage_name(cycle.stage);
        let _ = writeln!(table, "in cycle {} of {stage}:", cycle.last_cycle);
        let mut row = |name: &str, value: String| side_by_side(table, name, COLUMN, std::iter::once(value));
        row("sliding condition", sliding_condition(cycle));
        for (name, kind, value) in loop_numbers(cycle) {
            row(&self.plan.case.heading(name, kind), value.map_or("-".to_owned(), figure));
        }
    }

    /// The same for programs.
    pub fn to_json(&self) -> Value {
        let failure = self.ended.failure.as_ref();
        let dimension = self.plan.grid.dimension();
        let end = |record| StageAnswer {
            record,
            name: self.stage_name(record.stage),
            equivalent_radius: (dimension == Dimension::Plane).then(|| dimension.radius(record.contact_area)),
            stick_share: stick_share(record),
        };
        let stages: Vec<StageAnswer<'_>> = self.ended.tally.stage_ends.iter().map(end).collect();
        let named = |cycle| CycleAnswer { cycle, stage: self.stage_name(cycle.stage) };
        let cycles: Vec<CycleAnswer<'_>> = self.ended.tally.cycles.iter().map(named).collect();
        json!({
            "status": failure.map_or("solved", Failure::status),
            "message": failure.map(Failure::message),
            "title": self.plan.case.title,
            "units": self.plan.case.units,
            "line_contact": dimension,
            "datum": self.plan.datum,
            "stages": stages,
            "cycles": cycles,
            "worn_through": self.ended.tally.worn_through,
            "worn_by_layer": self.ended.tally.worn_by_layer,
            "warnings": self.ended.warnings,
            "increments": self.ended.tally.solved,
            "increments_planned": self.plan.increments,
            "largest_residual": self.ended.tally.largest_residual,
            "tolerance": self.plan.case.tolerance,
            "work": self.ended.tally.work,
            "wall_s": self.ended.wall_s,
            "threads": self.threads,
            "results": self.folder.display().to_string(),
            "methods": failure.is_none().then(|| self.methods()),
            "error_bars": self.ended.estimate.as_ref().map(|estimate| &estimate.record),
        })
    }

    /// A paragraph for the methods section of a paper.
    pub fn methods(&self) -> String {
        paragraph(self.plan, self.ended.tally.solved, (env!("CARGO_PKG_VERSION"), COMMIT))
    }

    fn stage_name(&self, stage: usize) -> &str {
        self.ended.tally.stages.get(stage).map_or("", |stage| stage.name.as_str())
    }
}

/// The end of a stage, for programs.
#[derive(Serialize)]
struct StageAnswer<'a> {
    #[serde(flatten)]
    record: &'a StepRecord,
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    equivalent_radius: Option<f64>,
    stick_share: Option<f64>,
}

/// A cycle, for programs: its stage is told by its name.
#[derive(Serialize)]
struct CycleAnswer<'a> {
    #[serde(flatten)]
    cycle: &'a CycleRecord,
    stage: &'a str,
}

/// Volumes that the layers of each body have lost, from the surface down.
pub fn volumes_by_layer(worn: &WornByLayer, volume: impl Fn(f64) -> String) -> Vec<(String, String)> {
    let of = |(body, lost): (&str, &Vec<f64>)| {
        let lost = lost.iter().map(|lost| volume(*lost)).collect::<Vec<_>>();
        (!lost.is_empty()).then(|| (format!("worn off layers, {body} body"), lost.join(", ")))
    };
    [("lower", &worn.lower), ("upper", &worn.upper)].into_iter().filter_map(of).collect()
}

/// Share of the cells in contact that stick; none when nothing touches.
fn stick_share(record: &StepRecord) -> Option<f64> {
    (record.contact_cells > 0).then(|| record.stick_cells as f64 / record.contact_cells as f64)
}
