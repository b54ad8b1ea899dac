//! Fatigue of one body over a cycle: parameters under all cells, a short crack, cracks of the coating.

use fret_core::plan::memory_of_stress;
use fret_core::subsurface::coating_fracture::Film;
use fret_core::subsurface::crack::crack_course;
use fret_core::subsurface::crack_path::{CrackStart, NoCrack, crack_path};
use fret_core::subsurface::fatigue::{LayerConstants, Parameter};
use fret_core::subsurface::film_stress::{FilmCrack, FilmStress};
use fret_core::subsurface::severity::{constants_of, material_of};
use fret_core::subsurface::{DepthPoint, Judged, LoadedSurface, Severity, StressField, depth_points, survey};
use fret_fft::ConvolutionError;
use ndarray::{Array2, Array3, Axis};
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyfunction};
use pyo3::types::PyDict;

use crate::error::bad_value;
use crate::ran::{Beneath, IncrementArrays, Ran, set_points};
use crate::threads::{Threads, check_memory, on_pool};

/// A cycle on a body.
struct Cycle {
    body: Beneath,
    surfaces: Vec<LoadedSurface>,
    constants: LayerConstants,
}

impl Cycle {
    fn read(
        (plan, upper): (&str, bool),
        increments: &[IncrementArrays<'_>],
        constants: Option<&str>,
    ) -> PyResult<Self> {
        let ran = Ran::read(plan)?;
        let constants = ran.constants(upper, constants)?;
        let body = Beneath::of(ran, upper)?;
        let grid = body.ran.grid();
        let [nx, ny] = grid.cells();
        check_memory(
            &format!("{} increments of {nx} x {ny} cells", increments.len()),
            memory_of_stress(grid.len(), increments.len()),
        )?;
        let surfaces = increments.iter().enumerate().map(|(number, given)| body.surface(number, given));
        Ok(Self { surfaces: surfaces.collect::<PyResult<_>>()?, body, constants })
    }

    /// Hands over the stresses of all surfaces at all points.
    fn survey(
        &self,
        points: &[DepthPoint],
        mut look: impl FnMut(usize, usize, &StressField),
    ) -> Result<(), ConvolutionError> {
        let Beneath { ran, half_space, .. } = &self.body;
        survey(half_space, ran.grid(), ran.periodic(), points, &self.surfaces, |point, surface, field| {
            look(point, surface, field);
            true
        })
    }

    fn judged(&self, points: &[DepthPoint]) -> Result<Judged, ConvolutionError> {
        let all = (0..self.surfaces.len()).collect();
        let surfaces = (self.surfaces.as_slice(), all);
        let mut severity = Severity::new(&self.body.half_space, &self.constants, points, surfaces, None);
        self.survey(points, |point, surface, field| severity.look(point, surface, field))?;
        Ok(severity.judged())
    }

    /// The largest value of every parameter over all depths as `fret stress` tells it: by its name value, cycles, both of the largest cell,
    /// place in cells from the first one, depth, normal of the critical plane, and values at the critical distance.
    fn most_severe<'py>(&self, py: Python<'py>, judged: &Judged) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for parameter in Parameter::ALL {
            let of = judged.found.iter().filter(|found| found.parameter == parameter);
            let Some(found) = of.reduce(|most, next| if next.value > most.value { next } else { most })
            else {
                continue;
            };
            let one = PyDict::new(py);
            one.set_item("largest", found.value)?;
            one.set_item("largest_cycles", found.cycles)?;
            one.set_item("largest_cell", found.of_cells)?;
            one.set_item("largest_cell_cycles", found.cycles_of_cells)?;
            one.set_item("place", [0, 1].map(|axis| found.cell[axis] as f64 + found.off[axis]))?;
            one.set_item("depth", found.point.depth)?;
            one.set_item("normal", found.normal)?;
            if let Some((_, at)) = judged.at_distance.iter().find(|(of, _)| *of == parameter) {
                let constants = constants_of(&self.body.half_space, &self.constants, 0);
                let cycles = |value: f64| {
                    material_of(&self.body.half_space, 0)
                        .and_then(|material| parameter.cycles(value, &material, &constants))
                };
                for (name, (value, _)) in [("point_method", at.point), ("line_method", at.line)] {
                    one.set_item(name, value)?;
                    one.set_item(format!("{name}_cycles"), cycles(value))?;
                }
            }
            all.set_item(parameter.name(), one)?;
        }
        Ok(all)
    }

    /// Cycles to initiation at the values of a depth; `None` without a law for its layer.
    fn cycles(&self, parameter: Parameter, values: &Array2<f64>, layer: usize) -> Option<Array2<f64>> {
        let material = material_of(&self.body.half_space, layer)?;
        let constants = constants_of(&self.body.half_space, &self.constants, layer);
        parameter.cycles(0.0, &material, &constants)?;
        Some(values.map(|&value| parameter.cycles(value, &material, &constants).unwrap_or(f64::INFINITY)))
    }
}

/// Planes of shape `(nx, ny)` as one array `(nz, nx, ny)`; `None` where one of them is missing.
fn stacked(planes: &[Option<Array2<f64>>]) -> Option<Array3<f64>> {
    let planes: Option<Vec<_>> =
        planes.iter().map(|plane| plane.as_ref().map(|plane| plane.view())).collect();
    ndarray::stack(Axis(0), &planes?).ok()
}

/// Fatigue parameters over increments `(pressure, shear, slip, bulk stress)`: arrays of shape (nz, nx, ny), and with `_cycles` behind their
/// names cycles to initiation; `ruiz_f1` and `ruiz_f2` of shape (nx, ny); depth and layer of shape (nz,); `most_severe` by parameter.
#[pyfunction]
pub fn fatigue<'py>(
    py: Python<'py>,
    run: (&str, bool),
    increments: Vec<IncrementArrays<'py>>,
    depths: Vec<f64>,
    constants: Option<&str>,
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let cycle = Cycle::read(run, &increments, constants)?;
    let points = depth_points(&cycle.body.half_space, &depths).map_err(bad_value)?;
    let cells = cycle.body.ran.grid().len().saturating_mul(points.len());
    check_memory(&format!("{} depths", points.len()), cells.saturating_mul(8 * 2 * Parameter::ALL.len()))?;
    let judged = on_pool(py, threads, || cycle.judged(&points))?.map_err(bad_value)?;
    let items = PyDict::new(py);
    for (parameter, values) in &judged.fields {
        let Some(all) = stacked(values) else { continue };
        items.set_item(parameter.name(), all.into_pyarray(py))?;
        let cycles: Vec<Option<Array2<f64>>> = values
            .iter()
            .zip(&points)
            .map(|(values, point)| cycle.cycles(*parameter, values.as_ref()?, point.layer))
            .collect();
        if let Some(cycles) = stacked(&cycles) {
            items.set_item(format!("{}_cycles", parameter.name()), cycles.into_pyarray(py))?;
        }
    }
    items.set_item("most_severe", cycle.most_severe(py, &judged)?)?;
    if let Some(ruiz) = judged.ruiz {
        items.set_item("ruiz_f1", ruiz.map(|ruiz| ruiz.f1).into_pyarray(py))?;
        items.set_item("ruiz_f2", ruiz.map(|ruiz| ruiz.f2).into_pyarray(py))?;
    }
    set_points(py, &items, &points)?;
    Ok(items)
}

/// A short crack from the most severe place of the surface over increments as in `fatigue`: JSON of its course, with its place in cells
/// from the first one, its angle [degrees] and horizontal direction; or of the reason why there is none.
#[pyfunction]
pub fn crack<'py>(
    py: Python<'py>,
    run: (&str, bool),
    increments: Vec<IncrementArrays<'py>>,
    constants: Option<&str>,
    threads: Threads,
) -> PyResult<String> {
    let cycle = Cycle::read(run, &increments, constants)?;
    let Some(law) = constants_of(&cycle.body.half_space, &cycle.constants, 0).crack else {
        let what = "no constants of cracks: \"crack\" of the outermost layer's fatigue constants";
        return Err(PyValueError::new_err(what));
    };
    let points = depth_points(&cycle.body.half_space, &[0.0]).map_err(bad_value)?;
    let grid = cycle.body.ran.grid();
    let setting = (grid, cycle.body.ran.periodic());
    let found = on_pool(py, threads, || {
        let judged = cycle.judged(&points)?;
        let severe = judged.at_surface.iter().find(|found| found.parameter == Parameter::SmithWatsonTopper);
        let Some(severe) = severe else { return Err(NoCrack::NoTension) };
        let start = CrackStart::of(severe, grid.dimension())?;
        let Beneath { half_space, .. } = &cycle.body;
        let path = crack_path(half_space, setting, &start, law.final_length, &cycle.surfaces, || true)?;
        let course = crack_course(&path, &law);
        Ok((start, course.ok_or(NoCrack::TooInclined(start.angle.to_degrees()))?))
    })?;
    let (start, course) = match found {
        Ok(found) => found,
        Err(NoCrack::Kernel(error)) => return Err(bad_value(error)),
        Err(why) => return Ok(serde_json::json!({ "reason": why.to_string() }).to_string()),
    };
    let told = serde_json::json!({
        "place": start.place, "angle": start.angle.to_degrees(), "towards": start.horizontal, "course": course,
    });
    Ok(told.to_string())
}

/// Depths through a coating at which its mean stress is taken: the trapezoidal rule is off by a thousandth of its bending.
const DEPTHS_OF_COATING: usize = 32;

/// Cracks of the outermost coating over increments as in `fatigue`: JSON of the largest mean tension and compression of its thickness with
/// the energies they release, and the constants they are held against.
#[pyfunction]
pub fn coating_fracture<'py>(
    py: Python<'py>,
    run: (&str, bool),
    increments: Vec<IncrementArrays<'py>>,
    constants: Option<&str>,
    threads: Threads,
) -> PyResult<String> {
    let cycle = Cycle::read(run, &increments, constants)?;
    let Some(film) = Film::outermost(&cycle.body.half_space) else {
        return Err(PyValueError::new_err("no coating that is bonded to something that deforms"));
    };
    let depths: Vec<f64> =
        (0..=DEPTHS_OF_COATING).map(|n| film.thickness() * n as f64 / DEPTHS_OF_COATING as f64).collect();
    let points = depth_points(&cycle.body.half_space, &depths).map_err(bad_value)?;
    let constants = constants_of(&cycle.body.half_space, &cycle.constants, 0);
    let fractured = || -> Result<Vec<FilmCrack>, ConvolutionError> {
        let mut stress = FilmStress::new(film);
        cycle.survey(&points, |point, surface, field| stress.look(points[point], surface, field))?;
        Ok(stress.most_severe(&constants))
    };
    let cracks = on_pool(py, threads, fractured)?.map_err(bad_value)?;
    let told = serde_json::json!({
        "cracks": cracks,
        "fracture_energy": constants.fracture_energy,
        "interface_energy": constants.interface_energy,
    });
    Ok(told.to_string())
}
