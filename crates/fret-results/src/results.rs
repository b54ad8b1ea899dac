//! Results of a run, read back from their folder: finished ones, and what there is of others. Nothing is written here.

use std::path::{Path, PathBuf};

use fret_core::case::{CaseRecord, Side, StressRequest};
use fret_core::history::{CycleRecord, FIELDS, RunningCondition, running_condition};
use fret_core::machine::memory;
use fret_core::model::{Dimension, Frame, SurfaceGrid};
use fret_core::plan::{Coupling, PlanRecord};
use fret_core::subsurface::EvenStress;
use fret_core::subsurface::fatigue::LayerConstants;
use fret_core::units::Units;
use ndarray::Array2;

use crate::error::ResultsError;
use crate::fields::Fields;
use crate::history_table::cycles_of;
use crate::names;
use crate::record::read_record;
use crate::run_record::Record;
use crate::state_store::{lost_state, memory_below, state_below, states_below};
use crate::table::Table;

/// Bytes a cell of a field while it passes through.
const FIELD: usize = 4 * 8;

/// A result folder that could be read.
#[derive(Debug)]
pub struct Results {
    /// Where it lies.
    pub path: PathBuf,
    /// `run.json`.
    pub record: Record,
    /// `history.csv`: a row an increment.
    pub table: Table,
    /// `cycles.csv`: the cycles that are over.
    pub cycles: Vec<CycleRecord>,
    /// `fields.zarr`.
    pub fields: Fields,
}

impl Results {
    /// Reads a result folder: record and tables whole, fields when they are asked for.
    ///
    /// # Errors
    /// When it holds no results, or not those that were written.
    pub fn read(path: &Path) -> Result<Self, ResultsError> {
        let record = read_record(path)?;
        let table = Table::of(path, &record)?;
        let cycles = cycles_of(path, &record, table.rows())?;
        let fields = Fields::read(&path.join(names::FIELDS), &record, table.rows())?;
        // Fields are read one at a time: its bytes, its numbers, what is written of it.
        let [nx, ny] = fields.cells();
        memory::check(FIELD * nx * ny)?;
        Ok(Self { path: path.to_owned(), record, table, cycles, fields })
    }

    /// Reads everything that a solved run has kept in its folder.
    ///
    /// # Errors
    /// When a part of it is missing, or not as it was written.
    pub fn look_at_all(&self) -> Result<(), ResultsError> {
        let damaged = |why: String| ResultsError::Refused(why, "run the case again".to_owned());
        self.fields.look_at_all()?;
        if let Some(lost) = lost_state(&self.path, &self.record) {
            return Err(damaged(lost));
        }
        memory_below(&self.path, 0).map_err(damaged)?;
        states_below(&self.path)
            .into_iter()
            .try_for_each(|increment| state_below(&self.path, increment).map(drop).map_err(damaged))
    }

    /// The plan that was solved.
    pub fn plan(&self) -> &PlanRecord {
        &self.record.plan
    }

    /// The case, as it was understood.
    pub fn case(&self) -> &CaseRecord {
        &self.record.plan.case
    }

    /// The grid.
    pub fn grid(&self) -> &SurfaceGrid {
        &self.record.plan.grid
    }

    /// Units that the case declares.
    pub fn units(&self) -> Option<&Units> {
        self.case().units.as_ref()
    }

    /// Whether there is no friction, and so neither stick nor slip.
    pub fn is_frictionless(&self) -> bool {
        self.plan().coupling == Coupling::Frictionless
    }

    /// The title of the case, or the name of the folder.
    pub fn title(&self) -> String {
        let title = &self.case().title;
        if !title.is_empty() {
            return title.clone();
        }
        let name = self.path.file_name().map(|name| name.to_string_lossy().into_owned());
        name.unwrap_or_else(|| self.path.display().to_string())
    }

    /// Why the run is not finished, in a sentence; none of a finished one.
    pub fn unfinished(&self) -> Option<String> {
        self.record.unfinished(self.table.rows())
    }

    /// That fields are kept of the ends of the stages alone, and how to keep more, in a sentence; none where more are, or were solved.
    pub fn stage_ends_alone(&self) -> Option<String> {
        let (kept, solved) = (self.fields.reached.len(), self.table.rows());
        let alone = self.case().output.every.is_none() && kept < solved;
        alone.then(|| {
            format!(
                "fields are kept at the ends of the stages alone ({kept} of {solved} increments): [output] every = 1 keeps all, and fatigue \
                 over a cycle needs more than its end"
            )
        })
    }

    /// That no fatigue is told of the last stage, since the places of the bodies travel through the grid in its cycles, in a sentence; none where
    /// they stay.
    pub fn places_travel(&self) -> Option<String> {
        let ([first, last], cyclic) = self.last_cycle();
        let rolls = |name: &str| {
            let way = self.table.column(name).get(first..=last).unwrap_or_default();
            way.iter().any(|roll| *roll != way[0])
        };
        let travel =
            cyclic && self.case().kinematics.frame == Frame::Contact && (rolls("roll_x") || rolls("roll_y"));
        travel.then(|| {
            "no fatigue is told of cycles of roll with kinematics.frame = \"contact\", in which the places of the bodies travel through the grid: frame = \
             \"bodies\", on a grid that holds all of the way, keeps them"
                .to_owned()
        })
    }

    /// The head of a column of a field, with its unit where the case declares units.
    pub fn field_heading(&self, name: &str) -> String {
        Units::heading(self.units(), name, kind_of_field(name), Dimension::Plane)
    }

    /// First and last increment of the last whole cycle, from 0, and whether it is one; of a last stage without cycles, or without a whole
    /// one, what there is of it. The first is the state the cycle starts from, where there is one.
    pub fn last_cycle(&self) -> ([usize; 2], bool) {
        let stage_of = self.table.column("stage");
        let Some(last) = stage_of.last() else { return ([0, 0], false) };
        let Some(stage) = self.case().stages.get(*last as usize) else { return ([0, 0], false) };
        let per_cycle = stage.increments;
        let before = stage_of.iter().filter(|stage| *stage != last).count();
        let done = stage_of.len() - before;
        let is_whole = stage.cycles().is_some() && done >= per_cycle;
        let end = if is_whole { before + done / per_cycle * per_cycle } else { stage_of.len() };
        ([end.saturating_sub(per_cycle + 1), end - 1], is_whole)
    }

    /// Running condition of each stage's cycles.
    pub fn running_conditions(&self) -> Vec<Option<RunningCondition>> {
        let of = |stage| running_condition(self.cycles.iter().filter(|cycle| cycle.stage == stage));
        (0..self.case().stages.len()).map(of).collect()
    }

    /// What adds to the stress of the tractions in a body, in an increment.
    pub fn even_stress(&self, body: Side, increment: usize) -> EvenStress {
        let (name, place) = match body {
            Side::Lower => ("bulk_stress", 0),
            Side::Upper => ("upper_bulk_stress", 1),
        };
        let at = |column: String| self.table.column(&column).get(increment).copied().unwrap_or(0.0);
        EvenStress {
            bulk: ["x", "y"].map(|axis| at(format!("{name}_{axis}"))),
            residual: self.case().residual_stress[place].clone(),
        }
    }

    /// Constants of the layers of the body that is asked about: their own, or else those of the request.
    pub fn fatigue_constants(&self, request: &StressRequest) -> LayerConstants {
        self.case().fatigue[usize::from(request.body == Side::Upper)].clone().or(request.fatigue)
    }

    /// A kept field of an increment; `None` when it was not to be kept.
    ///
    /// # Errors
    /// When its file is missing, or not as it was written.
    pub fn field(&self, name: &str, increment: usize) -> Result<Option<Array2<f64>>, ResultsError> {
        let Ok(position) = self.fields.reached.binary_search(&increment) else { return Ok(None) };
        if !self.fields.has(name) {
            return Ok(None);
        }
        self.fields.field(name, position).map(Some)
    }
}

/// The kind of a field, or of a coordinate, for its unit.
pub fn kind_of_field(name: &str) -> &'static str {
    FIELDS.iter().find(|field| field.name == name).map_or("length", |field| field.unit)
}
