//! The answer of a run, as arrays.

use std::path::PathBuf;

use fret_cli::embedded::{self, CaseText, Solved};
use fret_core::history::{self, KeptFields, Regime, StepRecord, running_condition};
use fret_core::plan::Plan;
use fret_core::study::StageQuantities;
use ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, ToPyArray};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::{Bound, PyAny, PyDictMethods, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyDict;

use crate::case::earlier;
use crate::error::{bad_value, stopped};

/// A public name and the entry of a step it stands for.
type Entry<T> = (&'static str, fn(&StepRecord) -> T);

/// The real numbers of a step.
const REALS: [Entry<f64>; 18] = [
    ("normal_force", |step| step.normal_force),
    ("approach", |step| step.approach),
    ("tangential_force_x", |step| step.tangential_force[0]),
    ("tangential_force_y", |step| step.tangential_force[1]),
    ("shift_x", |step| step.shift[0]),
    ("shift_y", |step| step.shift[1]),
    ("twist_moment", |step| step.twist_moment),
    ("twist", |step| step.twist),
    ("max_pressure", |step| step.max_pressure),
    ("max_shear", |step| step.max_shear),
    ("contact_area", |step| step.contact_area),
    ("stick_area", |step| step.stick_area),
    ("dissipated_energy", |step| step.dissipated_energy),
    ("worn_volume", |step| step.worn_volume),
    ("max_worn_depth", |step| step.max_worn_depth),
    ("residual", |step| step.residual.largest()),
    ("wall_s", |step| step.wall_s),
    ("full_grid_convolutions", |step| step.work.full_grid_convolutions),
];

/// The counts of a step.
const COUNTS: [Entry<usize>; 8] = [
    ("increment", |step| step.increment),
    ("stage", |step| step.stage),
    ("parts", |step| step.parts),
    ("contact_cells", |step| step.contact_cells),
    ("stick_cells", |step| step.stick_cells),
    ("convolutions", |step| step.work.convolutions),
    ("preconditioner_passes", |step| step.work.preconditioner_passes),
    ("outer_iterations", |step| step.work.outer_iterations),
];

fn regime_name(regime: Regime) -> &'static str {
    match regime {
        Regime::Apart => "apart",
        Regime::FullStick => "full_stick",
        Regime::PartialSlip => "partial_slip",
        Regime::GrossSlip => "gross_slip",
        Regime::Frictionless => "frictionless",
    }
}

/// One step as a dict of numbers.
pub fn step_items<'py>(py: Python<'py>, step: &StepRecord) -> PyResult<Bound<'py, PyDict>> {
    let items = PyDict::new(py);
    for (name, value) in COUNTS {
        items.set_item(name, value(step))?;
    }
    for (name, value) in REALS {
        items.set_item(name, value(step))?;
    }
    items.set_item("regime", regime_name(step.regime))?;
    Ok(items)
}

/// All of a run.
#[pyclass(frozen, module = "fretting._core")]
pub struct History {
    /// Numbers and fields.
    pub solved: history::History,
    /// What was solved.
    pub plan: Plan,
    /// The case as it was read.
    pub case: CaseText,
    /// Quantities of interest at the ends of the stages.
    pub quantities: Vec<StageQuantities>,
    /// JSON text of its error bars, where they were asked for.
    pub error_bars: Option<String>,
}

#[pymethods]
impl History {
    /// The numbers of all steps: one array a name, one entry an increment; `regime` is a list of words.
    fn increments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let steps = &self.solved.steps;
        let items = PyDict::new(py);
        for (name, value) in COUNTS {
            let column: Vec<i64> = steps.iter().map(|step| value(step) as i64).collect();
            items.set_item(name, column.into_pyarray(py))?;
        }
        for (name, value) in REALS {
            items.set_item(name, PyArray1::from_iter(py, steps.iter().map(value)))?;
        }
        let regimes: Vec<_> = steps.iter().map(|step| regime_name(step.regime)).collect();
        items.set_item("regime", regimes)?;
        Ok(items)
    }

    /// The records of the cycles, as JSON text.
    fn cycles(&self) -> PyResult<String> {
        serde_json::to_string(&self.solved.cycles).map_err(bad_value)
    }

    /// Where and when the surfaces were worn to the limit, as JSON text.
    fn worn_through(&self) -> PyResult<String> {
        serde_json::to_string(&self.solved.worn_through).map_err(bad_value)
    }

    /// What about the numbers may mislead, as JSON text.
    fn warnings(&self) -> PyResult<String> {
        serde_json::to_string(&self.solved.warnings).map_err(bad_value)
    }

    /// Running condition of each stage's cycles, as JSON text.
    fn running_conditions(&self) -> PyResult<String> {
        let of = |stage| running_condition(self.solved.cycles.iter().filter(|cycle| cycle.stage == stage));
        let conditions: Vec<_> = (0..self.solved.stages.len()).map(of).collect();
        serde_json::to_string(&conditions).map_err(bad_value)
    }

    /// The plan, as JSON text.
    fn plan(&self) -> String {
        self.solved.plan.to_string()
    }

    /// Error bars, as JSON text, where they were asked for.
    fn error_bars(&self) -> Option<&str> {
        self.error_bars.as_deref()
    }

    /// Writes all of it into a folder, as the run itself would have done; `early` is the status and reason of one that ended early.
    fn save(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        replace: bool,
        early: Option<(String, String)>,
    ) -> PyResult<()> {
        let solved = Solved {
            plan: &self.plan,
            history: &self.solved,
            quantities: &self.quantities,
            early: early.as_ref().map(|(status, why)| (status.as_str(), why.as_str())),
            error_bars: self.error_bars.as_deref(),
        };
        let case = self.case.clone();
        py.detach(|| embedded::save(solved, case, &folder, earlier(false, replace))).map_err(stopped)
    }

    /// Names of the stages.
    fn stages(&self) -> Vec<String> {
        self.solved.stages.clone()
    }

    /// The two bodies as JSON.
    fn bodies(&self) -> PyResult<String> {
        serde_json::to_string(&self.solved.bodies).map_err(crate::error::bad_value)
    }

    /// Sides of a cell [length].
    fn spacing(&self) -> [f64; 2] {
        self.solved.grid.spacing()
    }

    /// Whether the scene repeats in x and y.
    fn periodic(&self) -> bool {
        self.solved.periodic
    }

    /// Coordinates of the cell centres along axis 0 or 1 [length].
    fn centres<'py>(&self, py: Python<'py>, axis: usize) -> PyResult<Bound<'py, PyArray1<f64>>> {
        if axis > 1 {
            return Err(PyValueError::new_err(format!("axis = {axis}: must be 0 or 1")));
        }
        Ok(self.solved.grid.centres(axis).into_pyarray(py))
    }

    /// Increments whose fields are kept.
    fn kept_increments(&self) -> Vec<usize> {
        self.solved.fields.iter().map(|kept| kept.increment).collect()
    }

    /// Names of the fields kept of an increment; none when nothing of it is kept.
    fn kept_fields(&self, increment: usize) -> Vec<&'static str> {
        self.solved.fields_of(increment).map_or_else(Vec::new, |kept| {
            let groups: [(bool, &[&str]); 6] = [
                (kept.pressure.is_some(), &["pressure"]),
                (kept.shear.is_some(), &["shear_x", "shear_y"]),
                (kept.slip.is_some(), &["slip_x", "slip_y"]),
                (kept.gap.is_some(), &["gap"]),
                (kept.zone.is_some(), &["zone"]),
                (kept.worn_depth.is_some(), &["worn_depth"]),
            ];
            groups.iter().filter(|(kept, _)| *kept).flat_map(|(_, names)| names.iter().copied()).collect()
        })
    }

    /// A kept field, shape `(nx, ny)`: a copy, the caller's own.
    fn field<'py>(&self, py: Python<'py>, name: &str, increment: usize) -> PyResult<Bound<'py, PyAny>> {
        let kept = self
            .solved
            .fields_of(increment)
            .ok_or_else(|| PyKeyError::new_err((name.to_owned(), increment)))?;
        if let ("zone", Some(zones)) = (name, &kept.zone) {
            return Ok(zones.mapv(|zone| zone as u8).into_pyarray(py).into_any());
        }
        let field =
            real_field(kept, name).ok_or_else(|| PyKeyError::new_err((name.to_owned(), increment)))?;
        Ok(field.to_pyarray(py).into_any())
    }
}

fn real_field<'a>(kept: &'a KeptFields, name: &str) -> Option<&'a Array2<f64>> {
    match name {
        "pressure" => kept.pressure.as_ref(),
        "shear_x" => kept.shear.as_ref().map(|shear| &shear[0]),
        "shear_y" => kept.shear.as_ref().map(|shear| &shear[1]),
        "slip_x" => kept.slip.as_ref().map(|slip| &slip[0]),
        "slip_y" => kept.slip.as_ref().map(|slip| &slip[1]),
        "gap" => kept.gap.as_ref(),
        "worn_depth" => kept.worn_depth.as_ref(),
        _ => None,
    }
}
