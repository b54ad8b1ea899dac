//! `study.json`: what a study answers. What is written is what the report reads back.

use std::collections::BTreeMap;

use fret_core::history::Work;
use fret_core::study::{
    Advice, ClosedForm, Convergence, Form, Judged, Kind, Level, Line, PerQuantity, Place, Quantity,
    Reference, RefinementStudy, Source, StageQuantities,
};
use fret_core::units::Units;
use serde::{Deserialize, Serialize};

/// Something of every quantity of interest, by its name in files.
pub type OfQuantities<T> = BTreeMap<String, T>;

/// All of it.
#[derive(Debug, Serialize, Deserialize)]
pub struct StudyRecord {
    /// One word.
    pub status: String,
    /// Title of the case, or the name of its file.
    pub title: String,
    /// Units that the case declares.
    #[serde(default)]
    pub units: Option<Units>,
    /// The closed form, where the case has one.
    pub closed_form: Option<String>,
    /// What the errors are measured by; nothing where nothing is known.
    pub measured_by: OfQuantities<Option<Source>>,
    /// Values at the end of every stage: a number, or two components.
    pub references: OfQuantities<Vec<Option<[f64; 2]>>>,
    /// How each quantity approaches its limit, where the study says something of it: a closed form or numbers from elsewhere do not ask.
    pub convergence: OfQuantities<Option<Convergence>>,
    /// What a study can refine.
    pub kinds: Vec<Kind>,
    /// The levels of each kind of refinement.
    pub lines: Vec<LineRecord>,
    /// Levels that were not solved.
    pub unsolved: Vec<UnsolvedRecord>,
    /// What to choose for each accuracy.
    pub advice: Vec<Advice>,
    /// The same in words.
    pub choice: String,
}

/// The levels of one kind of refinement, from coarse to fine.
#[derive(Debug, Serialize, Deserialize)]
pub struct LineRecord {
    /// What is refined.
    pub refined: Kind,
    /// Its levels.
    pub levels: Vec<LevelRecord>,
}

/// A level. Errors are relative; nothing where none is known.
#[derive(Debug, Serialize, Deserialize)]
pub struct LevelRecord {
    /// Cells along x and y.
    pub cells: [usize; 2],
    /// Increments of every stage.
    pub increments: Vec<usize>,
    /// Tolerance of the solver.
    pub tolerance: f64,
    /// Time of the run [s].
    pub wall_s: f64,
    /// Its work.
    pub work: Work,
    /// Quantities of interest at the end of every stage; no page shows them.
    #[serde(skip_deserializing)]
    pub ends: Vec<StageQuantities>,
    /// Errors, read between the cells.
    pub errors: OfQuantities<Option<f64>>,
    /// The same as the cells have the numbers.
    pub errors_plain: OfQuantities<Option<f64>>,
    /// The same with the next coarser grid.
    pub errors_extrapolated: OfQuantities<Option<f64>>,
    /// Orders against the level before.
    pub orders: OfQuantities<Option<f64>>,
    /// Of the pressure, in the mean square.
    pub error_of_pressure: Option<f64>,
    /// Of the shear.
    pub error_of_shear: Option<f64>,
    /// Of the pressure.
    pub order_of_pressure: Option<f64>,
    /// Of the shear.
    pub order_of_shear: Option<f64>,
    /// Whether no other level takes less work and is closer.
    pub is_efficient: bool,
    /// The same by the errors as the cells have the numbers, and by those with the next coarser grid; in the table alone.
    #[serde(skip)]
    pub is_efficient_otherwise: [bool; 2],
}

/// A level that was not solved.
#[derive(Debug, Serialize, Deserialize)]
pub struct UnsolvedRecord {
    /// Cells along x and y.
    pub cells: [usize; 2],
    /// Increments of every stage.
    pub increments: Vec<usize>,
    /// Why.
    pub message: String,
}

fn of_quantities<T>(of: impl Fn(Quantity) -> T) -> OfQuantities<T> {
    Quantity::ALL.into_iter().map(|quantity| (quantity.name().to_owned(), of(quantity))).collect()
}

impl StudyRecord {
    /// A judged study, what is to be chosen, and the levels that were not solved.
    pub fn new(
        (title, units): (&str, Option<&Units>),
        reference: &Reference,
        (study, lines): (&RefinementStudy, &[Line]),
        (advice, choice): (&[Advice], &str),
        unsolved: &[(Place, String)],
    ) -> Self {
        let line = |line: &Line| {
            let level = |judged: &Judged| Some(LevelRecord::new(study.level(judged.place)?, judged));
            LineRecord { refined: line.kind, levels: line.levels.iter().filter_map(level).collect() }
        };
        let left_out = |(place, why): &(Place, String)| {
            let variation = study.resolutions().at(*place);
            let (cells, increments) = (variation.cells, variation.increments);
            UnsolvedRecord { cells, increments, message: why.clone() }
        };
        Self {
            status: "studied".to_owned(),
            title: title.to_owned(),
            units: units.cloned(),
            closed_form: reference.form().map(|form: &ClosedForm| form.name().to_owned()),
            measured_by: of_quantities(|quantity| reference.source(quantity)),
            references: of_quantities(|quantity| reference.of(quantity).to_vec()),
            convergence: of_quantities(|quantity| {
                let convergence = reference.convergence(quantity);
                let is_told =
                    reference.source(quantity).is_some() || convergence == Some(Convergence::NoLimit);
                convergence.filter(|_| is_told)
            }),
            kinds: Kind::ALL.to_vec(),
            lines: lines.iter().map(line).collect(),
            unsolved: unsolved.iter().map(left_out).collect(),
            advice: advice.to_vec(),
            choice: choice.to_owned(),
        }
    }
}

impl LevelRecord {
    fn new(level: &Level, judged: &Judged) -> Self {
        let numbers = |values: &PerQuantity<Option<f64>>| of_quantities(|quantity| values[quantity as usize]);
        let errors = &judged.errors;
        Self {
            cells: level.variation.cells,
            increments: level.variation.increments.clone(),
            tolerance: level.variation.tolerance,
            wall_s: level.wall_s,
            work: level.work,
            ends: level.ends.clone(),
            errors: numbers(&errors.between),
            errors_plain: numbers(&errors.plain),
            errors_extrapolated: numbers(&errors.extrapolated),
            orders: numbers(&judged.orders),
            error_of_pressure: errors.pressure,
            error_of_shear: errors.shear,
            order_of_pressure: judged.field_orders[0],
            order_of_shear: judged.field_orders[1],
            is_efficient: judged.is_efficient[Form::Between as usize],
            is_efficient_otherwise: [Form::Plain, Form::Extrapolated]
                .map(|form| judged.is_efficient[form as usize]),
        }
    }
}
