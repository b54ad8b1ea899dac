//! Fatigue of one body over a cycle: parameters under all cells, a short crack, cracks of the coating.

use fret_core::model::{HalfSpace, Periodicity, SurfaceGrid};
use fret_core::plan::memory_of_stress;
use fret_core::subsurface::coating_fracture::Film;
use fret_core::subsurface::crack::crack_course;
use fret_core::subsurface::crack_path::{CrackStart, NoCrack, crack_path};
use fret_core::subsurface::fatigue::{FatigueConstants, LayerConstants, Parameter};
use fret_core::subsurface::film_stress::{FilmCrack, FilmStress};
use fret_core::subsurface::severity::{constants_of, material_of};
use fret_core::subsurface::{DepthPoint, EvenStress, Judged, LoadedSurface, Severity, depth_points, survey};
use ndarray::{Array2, Array3, Axis};
use numpy::{IntoPyArray, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyfunction};
use pyo3::types::PyDict;
use serde::Deserialize;

use crate::error::bad_value;
use crate::repeats::Repeats;
use crate::subsurface::{half_space_of, residual_of};
use crate::threads::{Threads, check_memory, on_pool};

/// Two fields of a vector.
type VectorArrays<'py> = (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>);

/// Fields of an increment: pressure, shear, slip and the bulk stress of the body.
type IncrementArrays<'py> =
    (PyReadonlyArray2<'py, f64>, Option<VectorArrays<'py>>, Option<VectorArrays<'py>>, [f64; 2]);

/// A cycle on a body.
struct Cycle {
    half_space: HalfSpace,
    grid: SurfaceGrid,
    periodic: Periodicity,
    surfaces: Vec<LoadedSurface>,
    constants: LayerConstants,
}

/// Constants as the case has them, of both bodies and of `[stress]`, or as they are given.
#[derive(Deserialize)]
struct ConstantsOf {
    case: Option<[LayerConstants; 2]>,
    stress: Option<FatigueConstants>,
    given: Option<FatigueConstants>,
}

impl ConstantsOf {
    fn read(text: &str, upper: bool) -> PyResult<LayerConstants> {
        let constants: Self = serde_json::from_str(text).map_err(bad_value)?;
        if let Some(given) = constants.given {
            return match given.fault() {
                Some((_, what)) => Err(PyValueError::new_err(what)),
                None => Ok(LayerConstants::everywhere(given)),
            };
        }
        let of_body = constants.case.map(|[of_lower, of_upper]| if upper { of_upper } else { of_lower });
        Ok(of_body.unwrap_or_default().or(constants.stress.unwrap_or_default()))
    }
}

impl Cycle {
    fn read<'py>(
        bodies: (&str, bool),
        (spacing, Repeats(periodic)): ([f64; 2], Repeats),
        (increments, residual_stress): (Vec<IncrementArrays<'py>>, &str),
        constants: &str,
    ) -> PyResult<Self> {
        let residual = residual_of(residual_stress, bodies.1)?;
        let constants = ConstantsOf::read(constants, bodies.1)?;
        let (half_space, sign) = half_space_of(bodies)?;
        let Some(shape) = increments.first().map(|(pressure, ..)| pressure.as_array().dim()) else {
            return Err(PyValueError::new_err("no increment with kept fields"));
        };
        let cells = shape.0 * shape.1;
        check_memory(
            &format!("{} increments of {} x {} cells", increments.len(), shape.0, shape.1),
            memory_of_stress(cells, increments.len()),
        )?;
        let vector =
            |(x, y): &VectorArrays<'py>, sign: f64| [x, y].map(|part| part.as_array().to_owned() * sign);
        let surfaces: Vec<LoadedSurface> = increments
            .iter()
            .enumerate()
            .map(|(increment, (pressure, shear, slip, bulk))| LoadedSurface {
                increment,
                pressure: pressure.as_array().to_owned(),
                shear: shear.as_ref().map(|shear| vector(shear, sign)),
                slip: slip.as_ref().map(|slip| vector(slip, 1.0)),
                even: EvenStress { bulk: *bulk, residual: residual.clone() },
            })
            .collect();
        let is_odd = |field: &Array2<f64>| field.dim() != shape;
        if surfaces.iter().any(|surface| {
            is_odd(&surface.pressure) || surface.shear.iter().chain(&surface.slip).flatten().any(is_odd)
        }) {
            return Err(PyValueError::new_err(format!(
                "fields of other shapes than the first pressure, {shape:?}"
            )));
        }
        let grid = SurfaceGrid::new([shape.0, shape.1], spacing).map_err(bad_value)?;
        Ok(Self { half_space, grid, periodic, surfaces, constants })
    }

    fn judged(&self, points: &[DepthPoint]) -> Result<Judged, fret_fft::ConvolutionError> {
        let all = (0..self.surfaces.len()).collect();
        let mut severity =
            Severity::new(&self.half_space, &self.constants, points, (&self.surfaces, all), None);
        survey(
            &self.half_space,
            &self.grid,
            self.periodic,
            points,
            &self.surfaces,
            |point, surface, field| {
                severity.look(point, surface, field);
                true
            },
        )?;
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
                let constants = constants_of(&self.half_space, &self.constants, 0);
                let cycles = |value: f64| {
                    material_of(&self.half_space, 0)
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
        let material = material_of(&self.half_space, layer)?;
        let constants = constants_of(&self.half_space, &self.constants, layer);
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
    bodies: (&str, bool),
    setting: ([f64; 2], Repeats),
    loading: (Vec<IncrementArrays<'py>>, &str),
    depths: Vec<f64>,
    constants: &str,
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let cycle = Cycle::read(bodies, setting, loading, constants)?;
    let points = depth_points(&cycle.half_space, &depths).map_err(bad_value)?;
    let cells = cycle.grid.len().saturating_mul(points.len());
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
    items.set_item("depth", points.iter().map(|point| point.depth).collect::<Vec<_>>().into_pyarray(py))?;
    let layers: Vec<i64> = points.iter().map(|point| point.layer as i64).collect();
    items.set_item("layer", layers.into_pyarray(py))?;
    Ok(items)
}

/// A short crack from the most severe place of the surface over increments as in `fatigue`: JSON of its course, with its place in cells
/// from the first one, its angle [degrees] and horizontal direction; or of the reason why there is none.
#[pyfunction]
pub fn crack<'py>(
    py: Python<'py>,
    bodies: (&str, bool),
    setting: ([f64; 2], Repeats),
    loading: (Vec<IncrementArrays<'py>>, &str),
    constants: &str,
    threads: Threads,
) -> PyResult<String> {
    let cycle = Cycle::read(bodies, setting, loading, constants)?;
    let Some(law) = constants_of(&cycle.half_space, &cycle.constants, 0).crack else {
        let what = "no constants of cracks: \"crack\" of the outermost layer's fatigue constants";
        return Err(PyValueError::new_err(what));
    };
    let points = depth_points(&cycle.half_space, &[0.0]).map_err(bad_value)?;
    let found = on_pool(py, threads, || {
        let judged = cycle.judged(&points)?;
        let severe = judged.at_surface.iter().find(|found| found.parameter == Parameter::SmithWatsonTopper);
        let Some(severe) = severe else { return Err(NoCrack::NoTension) };
        let start = CrackStart::of(severe, cycle.grid.dimension())?;
        let setting = (&cycle.grid, cycle.periodic);
        let path =
            crack_path(&cycle.half_space, setting, &start, law.final_length, &cycle.surfaces, || true)?;
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
    bodies: (&str, bool),
    setting: ([f64; 2], Repeats),
    loading: (Vec<IncrementArrays<'py>>, &str),
    constants: &str,
    threads: Threads,
) -> PyResult<String> {
    let cycle = Cycle::read(bodies, setting, loading, constants)?;
    let Some(film) = Film::outermost(&cycle.half_space) else {
        return Err(PyValueError::new_err("no coating that is bonded to something that deforms"));
    };
    let depths: Vec<f64> =
        (0..=DEPTHS_OF_COATING).map(|n| film.thickness() * n as f64 / DEPTHS_OF_COATING as f64).collect();
    let points = depth_points(&cycle.half_space, &depths).map_err(bad_value)?;
    let constants = constants_of(&cycle.half_space, &cycle.constants, 0);
    let fractured = || -> Result<Vec<FilmCrack>, fret_fft::ConvolutionError> {
        let mut stress = FilmStress::new(film);
        survey(
            &cycle.half_space,
            &cycle.grid,
            cycle.periodic,
            &points,
            &cycle.surfaces,
            |point, surface, field| {
                stress.look(points[point], surface, field);
                true
            },
        )?;
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
