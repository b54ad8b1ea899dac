//! A run seen as a whole: its units, which way it was loaded, which increments are worth showing, what theory has to say about it.

use fret_core::case::Case;
use fret_core::history::{CycleRecord, STEP_COLUMNS};
use fret_core::model::Dimension;
use fret_core::plan::Coupling;
use fret_core::study::{Loaded, NormalForm, TangentialForm};
use fret_core::units::Units;

use super::{Measured, Rolled};
use crate::figures::largest;
use crate::way::Way;
use fret_drawing::Label;
use fret_results::{Results, Table};

/// Share of the largest force below which there is none.
const NOTHING: f64 = 1e-9;

/// The same of a change of the load, or of a load across, that a closed form may neglect.
const STEADY: f64 = 1e-4;

/// With more cycles a chart over the increments is a block of colour.
const MANY_CYCLES: usize = 20;

/// A run with what the page needs to know about it.
#[derive(Debug)]
pub struct Overview<'a> {
    /// The results.
    pub results: &'a Results,
    /// Direction of the tangential load, when there is any.
    pub direction: Option<[f64; 2]>,
    /// Tangential force of every increment along the direction.
    pub tangential: Vec<f64>,
    /// Shift of every increment along the direction.
    pub shift: Vec<f64>,
    /// The frictionless contact in closed form.
    pub normal_form: Option<NormalForm>,
    /// Partial slip in closed form.
    pub tangential_form: Option<TangentialForm>,
    /// Whether torsion is what moves: its loop of moment and twist is larger than that of force and shift, force times motion.
    pub twists: bool,
    /// The way that it rolled, where it did.
    pub rolled: Option<Rolled>,
    /// Increments of each stage: first, and one after the last.
    pub spans: Vec<[usize; 2]>,
}

/// Points by their places and heights.
pub fn joined(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    x.iter().zip(y).map(|(x, y)| [*x, *y]).collect()
}

impl<'a> Overview<'a> {
    /// Looks at a run.
    pub fn of(results: &'a Results) -> Self {
        let table = &results.table;
        let way = Way::of(table);
        let direction = direction(table, &way);
        let [cosine, sine] = direction.unwrap_or([1.0, 0.0]);
        let history = history(results);
        // A state to start from may be worn, which a plan that was read back does not tell.
        let is_worn = table.column("max_worn_depth").iter().any(|depth| *depth > 0.0);
        let normal_form = NormalForm::of(results.plan()).filter(|_| !is_worn);
        let rolled = Rolled::of(results);
        // The closed forms of partial slip are those of bodies that stay opposite each other.
        let stays = normal_form.as_ref().filter(|_| rolled.is_none());
        let tangential_form = stays.zip(direction).and_then(|(normal, direction)| {
            TangentialForm::of(results.plan(), normal, (direction, &history), STEADY)
        });
        Self {
            results,
            direction,
            tangential: history.iter().map(|loaded| loaded.components([cosine, sine])[0]).collect(),
            shift: way.shifts.iter().map(|[x, y]| cosine * x + sine * y).collect(),
            normal_form,
            tangential_form,
            twists: way.twists(),
            rolled,
            spans: spans(table.column("stage"), results.case().stages.len()),
        }
    }

    /// Whether there is no friction, and so neither stick nor slip.
    pub fn is_frictionless(&self) -> bool {
        self.results.is_frictionless()
    }

    /// Whether the contact grows while pressure and shear act on each other: then each increment shows in the shear.
    pub fn grows_with_friction(&self) -> bool {
        self.results.plan().coupling == Coupling::Coupled
    }

    /// What bounds shear in an increment.
    pub fn friction_at(&self, increment: usize) -> Option<(f64, Option<f64>)> {
        friction_in(self.results.case(), self.place(increment).0)
    }

    /// The way that it rolled, where it does so in the last increment.
    pub fn rolls_to_the_end(&self) -> Option<&Rolled> {
        self.rolled.as_ref().filter(|rolled| rolled.rolls.last() == Some(&true))
    }

    /// The tangential load: force and motion of the loop, or moment and rotation where that is what moves; of a contact that rolls to the end, force
    /// and distance rolled.
    pub fn loop_points(&self) -> Vec<[f64; 2]> {
        let table = &self.results.table;
        if let Some(rolled) = self.rolls_to_the_end().filter(|_| self.direction.is_some()) {
            joined(&rolled.distance, &self.tangential)
        } else if self.twists {
            joined(table.column("twist"), table.column("twist_moment"))
        } else if self.direction.is_some() {
            joined(&self.shift, &self.tangential)
        } else {
            let (_, closeness) = self.closeness();
            joined(closeness, table.column("normal_force"))
        }
    }

    /// Names of the axes of [`Self::loop_points`].
    pub fn labels_of_loop(&self) -> [Label; 2] {
        if self.rolls_to_the_end().is_some() && self.direction.is_some() {
            [self.label("distance rolled", "length"), self.label("tangential force", "force")]
        } else if self.twists || self.direction.is_some() {
            self.loop_labels(self.twists)
        } else {
            [self.label(self.closeness().0, "length"), self.label("normal force", "force")]
        }
    }

    /// How near the bodies are to each other, by name and values: the mean gap of periodic half-spaces, else the approach.
    pub fn closeness(&self) -> (&'static str, &[f64]) {
        let table = &self.results.table;
        if self.results.case().counts_mean_gap() {
            ("mean gap", table.column("mean_gap"))
        } else {
            ("approach", table.column("approach"))
        }
    }

    /// Name of a stage.
    pub fn stage_name(&self, stage: usize) -> String {
        self.results.case().stages.get(stage).map_or_else(String::new, |stage| stage.name.clone())
    }

    /// The stage of an increment, and its number in it from 1.
    pub fn place(&self, increment: usize) -> (usize, usize) {
        let stage =
            self.spans.iter().position(|[first, end]| (*first..*end).contains(&increment)).unwrap_or(0);
        (stage, increment + 1 - self.spans.get(stage).map_or(0, |span| span[0]))
    }

    /// How an increment is called.
    pub fn called(&self, increment: usize) -> String {
        let (stage, number) = self.place(increment);
        format!("{}, {number}", self.stage_name(stage))
    }

    /// How an increment is called where cycles matter more than increments.
    pub fn after_cycle(&self, increment: usize) -> String {
        let of_it =
            |cycle: &&CycleRecord| (cycle.first_increment..=cycle.last_increment).contains(&increment);
        match self.results.cycles.iter().find(of_it) {
            Some(cycle) => format!("{}, cycle {}", self.stage_name(cycle.stage), cycle.last_cycle),
            None => self.called(increment),
        }
    }

    /// Increments that a chart over them shows: all, or of many cycles the last two; and how they are called.
    pub fn shown_increments(&self) -> ([usize; 2], String) {
        let cycles = self.cycles();
        match cycles.len().checked_sub(2) {
            Some(last) if cycles.len() > MANY_CYCLES => {
                let called = format!(" The last two of {} cycles.", cycles.len());
                ([cycles[last][0], cycles[last + 1][1]], called)
            }
            _ => ([0, self.results.table.rows()], String::new()),
        }
    }

    /// The cycles that are done, by their increments: first, and one after the last.
    pub fn cycles(&self) -> Vec<[usize; 2]> {
        let mut cycles = Vec::new();
        for (stage, [first, end]) in self.spans.iter().copied().enumerate() {
            let stage = self.results.case().stages.get(stage);
            if let Some(stage) = stage.filter(|stage| stage.cycles().is_some() && stage.increments > 0) {
                let starts = (first..end).step_by(stage.increments);
                let spans = starts.map(|start| [start, start + stage.increments]);
                cycles.extend(spans.filter(|[_, after]| *after <= end));
            }
        }
        cycles
    }

    /// A number of the history in an increment, with its unit.
    pub fn told(&self, column: &str, row: usize) -> String {
        self.number(self.results.table.at(column, row), unit_of(column))
    }

    /// A column of the history as the name of an axis.
    pub fn label_of(&self, column: &str) -> Label {
        self.label(&column.replace('_', " "), unit_of(column))
    }

    /// Positions, among the kept increments, of at most so many that show the run: the ends of its stages, and others evenly.
    pub fn telling(&self, most: usize) -> Vec<usize> {
        let steps = &self.results.fields.steps;
        if steps.len() <= most {
            return (0..steps.len()).collect();
        }
        let is_end = |position: &usize| self.spans.iter().any(|[_, end]| steps[*position] + 1 == *end);
        let mut chosen: Vec<usize> = (0..steps.len()).filter(is_end).collect();
        if chosen.len() > most {
            let all = chosen.len();
            chosen = (0..most).map(|n| chosen[n * (all - 1) / (most - 1).max(1)]).collect();
        }
        // The largest hole is halved until there are enough; the last stage, where things happen, comes first among equals.
        while chosen.len() < most {
            let before = std::iter::once(None).chain(chosen.iter().map(|&position| Some(position)));
            let hole = before
                .zip(&chosen)
                .enumerate()
                .map(|(place, (from, to))| (to - from.map_or(0, |from| from + 1), place, *to))
                .max();
            match hole {
                Some((width, place, to)) if width > 0 => chosen.insert(place, to - width.div_ceil(2)),
                _ => break,
            }
        }
        chosen.dedup();
        chosen
    }
}

impl Measured for Overview<'_> {
    fn units(&self) -> Option<&Units> {
        self.results.units()
    }

    fn dimension(&self) -> Dimension {
        self.results.grid().dimension()
    }
}

/// The kind of the unit of a column of the history.
fn unit_of(column: &str) -> &'static str {
    STEP_COLUMNS.iter().find(|known| known.name == column).map_or("", |known| known.unit)
}

/// What acts at the end of every increment.
fn history(results: &Results) -> Vec<Loaded> {
    let table = &results.table;
    let at = |name: &str, row: usize| table.column(name).get(row).copied().unwrap_or(0.0);
    let along = |name: &str, row: usize| ["x", "y"].map(|axis| at(&format!("{name}_{axis}"), row));
    let loaded = |row: usize| Loaded {
        normal: at("normal_force", row),
        tangential: along("tangential_force", row),
        twists: at("twist", row) != 0.0,
        bulk_stress: ["bulk_stress", "upper_bulk_stress"].map(|name| along(name, row)),
        slides: table.regimes().get(row).is_some_and(|regime| regime == "gross_slip"),
    };
    (0..table.rows()).map(loaded).collect()
}

/// Direction of the tangential load of a run, when there is any.
fn direction(table: &Table, way: &Way) -> Option<[f64; 2]> {
    let least = ["normal_force", "approach"].map(|beside| NOTHING * largest(table.column(beside)));
    // What is a direction along an axis up to rounding is one.
    Some(way.direction(least)?.map(|part| if part.abs() < 1e-6 { 0.0 } else { part }))
}

/// What bounds shear in a stage: friction coefficient and shear strength, where they are the same everywhere and all along.
pub fn friction_in<M, H>(case: &Case<M, H>, stage: usize) -> Option<(f64, Option<f64>)> {
    let rule = case.stages.get(stage).filter(|_| case.friction_evolution.is_none())?;
    let rule = rule.friction.as_ref().unwrap_or(&case.friction);
    let coefficient = rule.coefficient().uniform().filter(|coefficient| *coefficient > 0.0)?;
    match rule.max_shear() {
        None => Some((coefficient, None)),
        Some(strength) => Some((coefficient, Some(strength.uniform()?))),
    }
}

/// Increments of each stage that the run has reached.
fn spans(stage_of: &[f64], stages: usize) -> Vec<[usize; 2]> {
    let mut spans = Vec::new();
    for stage in 0..stages {
        let first = stage_of.partition_point(|&of| of < stage as f64);
        let end = stage_of.partition_point(|&of| of <= stage as f64);
        if end > first {
            spans.push([first, end]);
        }
    }
    spans
}
