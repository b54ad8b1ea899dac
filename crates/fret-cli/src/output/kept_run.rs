//! A result folder read back: the bodies, the grid, and the kept fields of any increment; of a run that is not finished what
//! there is.

use std::path::Path;

use fret_core::case::{Side, StressRequest, Units};
use fret_core::history::CycleRecord;
use fret_core::model::{Conduction, ContactPair, ResidualStress, SurfaceGrid};
use fret_core::subsurface::EvenStress;
use fret_core::subsurface::fatigue::LayerConstants;
use ndarray::Array2;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::{FIELDS, RECORD, lost_state, state_below, states_below};
use crate::failure::Failure;
use crate::results::{Field, Fields, Table, cycles_of, read_record, unfinished};

/// A run on disk.
#[derive(Debug)]
pub struct KeptRun {
    fields: Fields,
    /// `run.json`.
    pub record: Value,
    /// Its title.
    pub title: String,
    /// Units that its case declares.
    pub units: Option<Units>,
    /// The two bodies.
    pub bodies: ContactPair,
    /// The grid.
    pub grid: SurfaceGrid,
    /// Whether the scene repeats.
    pub periodic: bool,
    /// Whether there is no friction, and so no shear.
    pub frictionless: bool,
    /// What its case asks about stresses.
    pub stress: Option<StressRequest>,
    /// First and last increment of the last whole cycle, from 0; of what there is of the last stage where it has no cycles. The
    /// first is the state the cycle starts from, where there is one.
    pub last_cycle: [usize; 2],
    /// Whether the last stage has come to the end of a cycle.
    pub cyclic: bool,
    /// Increments whose fields are kept.
    pub steps: Vec<usize>,
    /// Increments that are solved.
    pub solved: usize,
    /// What the bodies conduct.
    pub conduction: Conduction,
    /// The cycles that are over.
    pub cycles: Vec<CycleRecord>,
    /// Bulk stresses of the lower and of the upper body along x and y at the end of every increment.
    bulk_stress: [[Vec<f64>; 2]; 2],
    /// Residual stress of the lower and of the upper body.
    residual_stress: [ResidualStress; 2],
    /// Constants for fatigue and fracture of the lower and of the upper body.
    fatigue: [LayerConstants; 2],
    /// Why the run is not finished, in a sentence, when it is not.
    pub unfinished: Option<String>,
}

impl KeptRun {
    /// Reads a folder's record.
    ///
    /// # Errors
    /// When it is no result folder, or it keeps no field.
    pub fn open(folder: &Path) -> Result<Self, Failure> {
        let shown = folder.display();
        let record = read_record(folder)?;
        let table = Table::of(folder, &record)?;
        let solved = table.rows();
        let plan = &record["plan"];
        let broken = |what: &str| {
            Failure::Call(format!("{shown}: {RECORD} does not tell {what}"), "run the case again".to_owned())
        };
        let fields = Fields::read(&folder.join(FIELDS), &record, solved)?;
        let steps = fields.reached.clone();
        let (last_cycle, cyclic) = last_cycle(&plan["case"]["stages"], table.column("stage"))
            .ok_or_else(|| broken("the stages of the run"))?;
        Ok(Self {
            fields,
            title: plan["case"]["title"].as_str().unwrap_or_default().to_owned(),
            units: part(&plan["case"]["units"]),
            bodies: part(&plan["case"]["bodies"]).ok_or_else(|| broken("the bodies"))?,
            grid: part(&plan["grid"]).ok_or_else(|| broken("the grid"))?,
            periodic: plan["case"]["periodic"].as_bool().unwrap_or(false),
            frictionless: plan["coupling"] == "frictionless",
            stress: part(&plan["case"]["stress"]),
            last_cycle,
            cyclic,
            steps,
            solved,
            conduction: part(&plan["case"]["conduction"]).unwrap_or_default(),
            cycles: cycles_of(folder, &record)?,
            residual_stress: part(&plan["case"]["residual_stress"]).unwrap_or_default(),
            fatigue: part(&plan["case"]["fatigue"]).unwrap_or_default(),
            bulk_stress: ["bulk_stress", "upper_bulk_stress"]
                .map(|name| ["x", "y"].map(|axis| table.column(&format!("{name}_{axis}")).to_vec())),
            unfinished: unfinished(&record, solved),
            record,
        })
    }

    /// Reads everything that a solved run has kept in its folder.
    ///
    /// # Errors
    /// When a part of it is missing, or not as it was written.
    pub fn look_at_all(&self, folder: &Path) -> Result<(), Failure> {
        let damaged = |why: String| Failure::Call(why, "run the case again".to_owned());
        self.fields.look_at_all()?;
        if let Some(lost) = lost_state(folder, &self.record) {
            return Err(damaged(lost));
        }
        states_below(folder)
            .into_iter()
            .try_for_each(|increment| state_below(folder, increment).map(drop).map_err(damaged))
    }

    /// What adds to the stress of the tractions in a body, in an increment.
    pub fn even_stress(&self, body: Side, increment: usize) -> EvenStress {
        let place = usize::from(body == Side::Upper);
        let at = |column: &Vec<f64>| column.get(increment).copied().unwrap_or(0.0);
        let [x, y] = &self.bulk_stress[place];
        EvenStress { bulk: [at(x), at(y)], residual: self.residual_stress[place].clone() }
    }

    /// Constants of the layers of the body that is asked about: their own, or else those of the request.
    pub fn fatigue_constants(&self, request: &StressRequest) -> LayerConstants {
        self.fatigue[usize::from(request.body == Side::Upper)].clone().or(request.fatigue)
    }

    /// A kept field of an increment; `None` when it was not to be kept.
    ///
    /// # Errors
    /// When its file is missing, or not as it was written.
    pub fn field(&self, name: &str, increment: usize) -> Result<Option<Array2<f64>>, Failure> {
        let Ok(position) = self.steps.binary_search(&increment) else { return Ok(None) };
        if !self.fields.has(name) {
            return Ok(None);
        }
        let Field { cells: [nx, ny], values } = self.fields.field(name, position)?;
        Ok(Array2::from_shape_vec((nx, ny), values).ok())
    }
}

fn part<T: DeserializeOwned>(value: &Value) -> Option<T> {
    T::deserialize(value).ok()
}

/// Increments of the last whole cycle, and whether it is one, where the solved increments belong to these stages.
fn last_cycle(stages: &Value, stage_of: &[f64]) -> Option<([usize; 2], bool)> {
    let Some(last) = stage_of.last() else { return Some(([0, 0], false)) };
    let stage = stages.get(*last as usize)?;
    let per_cycle = stage["increments"].as_u64()? as usize;
    let before = stage_of.iter().filter(|stage| *stage != last).count();
    let done = stage_of.len() - before;
    let cyclic = !stage["course"]["cycles"].is_null() && done >= per_cycle;
    let end = if cyclic { before + done / per_cycle * per_cycle } else { stage_of.len() };
    Some(([end.saturating_sub(per_cycle + 1), end - 1], cyclic))
}
