//! Closed-form solutions: their numbers as JSON text, their curves evaluated on arrays. `fretting.analytic` gives them names.

use fret_core::analytic::{
    Branch, CattaneoLine, CattaneoMindlin, Cone, EffectiveModuli, EquibiaxialSphere, FlatPunch, Hertz,
    HertzEllipse, HertzLine, LineHistory, MindlinDeresiewicz, NoSlipPunch, NoSlipSphere, RoundedPunch,
    SPENCE_TABLE, SlidingCylinder, StretchedLine, StretchedSphere, TangentialHistory, ThickLayer, ThinLayer,
    TiltedLinePunch, TiltedPunch, Torsion, Westergaard,
};
use fret_core::model::{Coating, ElasticMaterial};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::{Bound, PyResult, Python, pyclass, pyfunction, pymethods};
use serde_json::{Value, json};

use crate::error::bad_value;

/// A function of one coordinate.
type Curve = Box<dyn Fn(f64) -> f64 + Send + Sync>;
/// A function of a point of the surface.
type Surface = Box<dyn Fn(f64, f64) -> f64 + Send + Sync>;
/// `(sphere radius, force, effective modulus)`; of a cylinder, per length.
type HertzNumbers = (f64, f64, f64);

/// One closed-form solution.
#[pyclass(frozen, module = "fretting._core")]
pub struct Solution {
    numbers: Value,
    curves: Vec<(&'static str, Curve)>,
    /// Its only function of a point, where it has one.
    surface: Option<Surface>,
}

#[pymethods]
impl Solution {
    /// All numbers of the solution, JSON text.
    fn numbers(&self) -> String {
        self.numbers.to_string()
    }

    /// A curve of the solution at every coordinate of a contiguous array.
    fn curve<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        at: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let known = self.curves.iter().find(|(known, _)| *known == name);
        let (_, curve) = known.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        let values: Vec<f64> = at.as_slice()?.iter().map(|&at| curve(at)).collect();
        Ok(values.into_pyarray(py))
    }

    /// The solution's function of a point at every point of two contiguous arrays of one length.
    fn surface<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        y: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let surface = self.surface.as_ref().ok_or_else(|| PyKeyError::new_err("no function of a point"))?;
        let (x, y) = (x.as_slice()?, y.as_slice()?);
        if x.len() != y.len() {
            return Err(PyValueError::new_err(format!("x has {} points, y has {}", x.len(), y.len())));
        }
        let values: Vec<f64> = x.iter().zip(y).map(|(&x, &y)| surface(x, y)).collect();
        Ok(values.into_pyarray(py))
    }
}

fn solution(numbers: Value, curves: Vec<(&'static str, Curve)>) -> Solution {
    Solution { numbers, curves, surface: None }
}

fn solution_of_points(numbers: Value, surface: Surface) -> Solution {
    Solution { numbers, curves: vec![], surface: Some(surface) }
}

fn hertz_line_of((radius, line_force, modulus): HertzNumbers) -> PyResult<HertzLine> {
    HertzLine::cylinder(radius, line_force, modulus).map_err(bad_value)
}

fn numbers(of: impl serde::Serialize) -> PyResult<Value> {
    serde_json::to_value(of).map_err(bad_value)
}

fn hertz_of((radius, force, modulus): HertzNumbers) -> PyResult<Hertz> {
    Hertz::sphere(radius, force, modulus).map_err(bad_value)
}

/// Effective moduli of two bodies `(young, poisson)`; a rigid upper body when `None`.
#[pyfunction]
pub fn effective_moduli(lower: (f64, f64), upper: Option<(f64, f64)>) -> PyResult<Solution> {
    let material = |(young, poisson)| ElasticMaterial::new(young, poisson).map_err(bad_value);
    let lower = material(lower)?;
    let moduli = match upper {
        Some(upper) => EffectiveModuli::of_pair(&material(upper)?, &lower),
        None => EffectiveModuli::rigid_on(&lower),
    };
    Ok(solution(numbers(moduli)?, vec![]))
}

/// Sphere without friction.
#[pyfunction]
pub fn hertz(sphere: HertzNumbers) -> PyResult<Solution> {
    let hertz = hertz_of(sphere)?;
    Ok(solution(numbers(hertz)?, vec![("pressure", Box::new(move |r| hertz.pressure(r)))]))
}

/// Ellipsoid without friction.
#[pyfunction]
pub fn hertz_ellipse(radii: [f64; 2], force: f64, modulus: f64) -> PyResult<Solution> {
    let ellipse = HertzEllipse::ellipsoid(radii, force, modulus).map_err(bad_value)?;
    Ok(solution(numbers(ellipse)?, vec![]))
}

/// Cylinder without friction.
#[pyfunction]
pub fn hertz_line(radius: f64, line_force: f64, modulus: f64) -> PyResult<Solution> {
    let line = hertz_line_of((radius, line_force, modulus))?;
    Ok(solution(numbers(line)?, vec![("pressure", Box::new(move |x| line.pressure(x)))]))
}

/// Flat circular punch without friction.
#[pyfunction]
pub fn flat_punch(radius: f64, force: f64, modulus: f64) -> PyResult<Solution> {
    let punch = FlatPunch::new(radius, force, modulus).map_err(bad_value)?;
    Ok(solution(numbers(punch)?, vec![("pressure", Box::new(move |r| punch.pressure(r)))]))
}

/// Cone without friction.
#[pyfunction]
pub fn cone(slope: f64, force: f64, modulus: f64) -> PyResult<Solution> {
    let cone = Cone::new(slope, force, modulus).map_err(bad_value)?;
    Ok(solution(numbers(cone)?, vec![("pressure", Box::new(move |r| cone.pressure(r)))]))
}

/// Sinusoidal surface without friction.
#[pyfunction]
pub fn westergaard(amplitude: f64, wavelength: f64, mean_pressure: f64, modulus: f64) -> PyResult<Solution> {
    let wave = Westergaard::new(amplitude, wavelength, mean_pressure, modulus).map_err(bad_value)?;
    Ok(solution(numbers(wave)?, vec![("pressure", Box::new(move |x| wave.pressure(x)))]))
}

fn partial_slip(contact: CattaneoMindlin) -> PyResult<Solution> {
    let mut numbers = numbers(contact)?;
    numbers["full_slip_shift"] = json!(contact.full_slip_shift());
    numbers["dissipated_energy"] = json!(contact.dissipated_energy());
    let curves: Vec<(_, Curve)> =
        vec![("shear", Box::new(move |r| contact.shear(r))), ("slip", Box::new(move |r| contact.slip(r)))];
    Ok(solution(numbers, curves))
}

/// Sphere pushed sideways for the first time.
#[pyfunction]
pub fn cattaneo_mindlin(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    tangential_force: f64,
) -> PyResult<Solution> {
    let contact = CattaneoMindlin::new(&hertz_of(sphere)?, friction, shear_modulus, tangential_force);
    partial_slip(contact.map_err(bad_value)?)
}

/// Sphere pushed to and fro: the numbers of the whole loop, and the contact at its first peak.
#[pyfunction]
pub fn mindlin_deresiewicz(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    amplitude: f64,
) -> PyResult<(Solution, Solution)> {
    let fretting_loop =
        MindlinDeresiewicz::new(&hertz_of(sphere)?, friction, shear_modulus, amplitude).map_err(bad_value)?;
    let numbers = json!({
        "dissipated_energy_per_cycle": fretting_loop.dissipated_energy_per_cycle(),
        "energy_ratio": fretting_loop.energy_ratio(),
    });
    Ok((solution(numbers, vec![]), partial_slip(*fretting_loop.peak())?))
}

/// Sphere pushed to and fro, at a tangential force on a branch of its loop.
#[pyfunction]
pub fn mindlin_deresiewicz_at(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    amplitude: f64,
    branch: &str,
    tangential_force: f64,
) -> PyResult<Solution> {
    let branch = match branch {
        "loading" => Branch::Loading,
        "unloading" => Branch::Unloading,
        "reloading" => Branch::Reloading,
        other => {
            return Err(PyValueError::new_err(format!(
                "branch = {other:?}: must be \"loading\", \"unloading\" or \"reloading\""
            )));
        }
    };
    let point = MindlinDeresiewicz::new(&hertz_of(sphere)?, friction, shear_modulus, amplitude)
        .and_then(|fretting_loop| fretting_loop.at(branch, tangential_force))
        .map_err(bad_value)?;
    let numbers = json!({
        "tangential_force": point.tangential_force(),
        "shift": point.shift(),
        "stick_radius": point.stick_radius(),
    });
    Ok(solution(numbers, vec![("shear", Box::new(move |r| point.shear(r)))]))
}

/// Sphere pushed through any sequence of tangential forces.
#[pyfunction]
pub fn tangential_history(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    forces: Vec<f64>,
) -> PyResult<Solution> {
    let mut history =
        TangentialHistory::new(&hertz_of(sphere)?, friction, shear_modulus).map_err(bad_value)?;
    let mut found: [Vec<f64>; 3] = Default::default();
    for force in &forces {
        history.push(*force).map_err(bad_value)?;
        found[0].push(history.shift());
        found[1].push(history.stick_radius());
        found[2].push(history.dissipated_energy());
    }
    let [shift, stick_radius, dissipated_energy] = found;
    let numbers = json!({
        "tangential_forces": forces,
        "shift": shift,
        "stick_radius": stick_radius,
        "dissipated_energy": dissipated_energy,
    });
    Ok(solution(numbers, vec![("shear", Box::new(move |r| history.shear(r)))]))
}

/// Cylinder pushed through any sequence of tangential forces per length; `datum` is its depth and what a unit force moves it by.
#[pyfunction]
pub fn line_history(
    cylinder: HertzNumbers,
    friction: f64,
    compliance: f64,
    forces: Vec<f64>,
    datum: Option<(f64, f64)>,
) -> PyResult<Solution> {
    let mut history = LineHistory::new(&hertz_line_of(cylinder)?, friction, compliance).map_err(bad_value)?;
    let mut found: [Vec<f64>; 3] = Default::default();
    for force in &forces {
        history.push(*force).map_err(bad_value)?;
        found[0].extend(datum.map(|(depth, at_datum)| history.shift(depth, at_datum)));
        found[1].push(history.stick_half_width());
        found[2].push(history.dissipated_energy());
    }
    let [shift, stick_half_width, dissipated_energy] = found;
    let numbers = json!({
        "tangential_forces": forces,
        "shift": datum.map(|_| shift),
        "stick_half_width": stick_half_width,
        "dissipated_energy": dissipated_energy,
    });
    Ok(solution(numbers, vec![("shear", Box::new(move |x| history.shear(x)))]))
}

/// Sphere twisted about the normal for the first time.
#[pyfunction]
pub fn torsion(sphere: HertzNumbers, friction: f64, shear_modulus: f64, moment: f64) -> PyResult<Solution> {
    let torsion =
        Torsion::under_moment(&hertz_of(sphere)?, friction, shear_modulus, moment).map_err(bad_value)?;
    Ok(solution(numbers(torsion)?, vec![("shear", Box::new(move |r| torsion.shear(r)))]))
}

/// Cylinder pushed across its axis, with a strain.
#[pyfunction]
pub fn cattaneo_line(
    cylinder: HertzNumbers,
    friction: f64,
    tangential_force: f64,
    strain: f64,
) -> PyResult<Solution> {
    let contact =
        CattaneoLine::new(&hertz_line_of(cylinder)?, friction, cylinder.2, tangential_force, strain)
            .map_err(bad_value)?;
    Ok(solution(numbers(contact)?, vec![("shear", Box::new(move |x| contact.shear(x)))]))
}

/// Cylinder on a body that is stretched.
#[pyfunction]
pub fn stretched_line(cylinder: HertzNumbers, friction: f64, strain: f64) -> PyResult<Solution> {
    let contact =
        StretchedLine::new(&hertz_line_of(cylinder)?, friction, cylinder.2, strain).map_err(bad_value)?;
    Ok(solution(numbers(contact)?, vec![]))
}

/// Sphere pushed sideways on a body that is stretched along the force, Poisson's ratio 0.
#[pyfunction]
pub fn stretched_sphere(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    tangential_force: f64,
    strain: f64,
) -> PyResult<Solution> {
    let contact = StretchedSphere::new(&hertz_of(sphere)?, friction, shear_modulus, tangential_force, strain)
        .map_err(bad_value)?;
    Ok(solution_of_points(numbers(contact)?, Box::new(move |x, y| contact.shear(x, y))))
}

/// Sphere on a body that is stretched alike in all directions.
#[pyfunction]
pub fn equibiaxial_sphere(sphere: HertzNumbers, friction: f64, strain: f64) -> PyResult<Solution> {
    let contact =
        EquibiaxialSphere::new(&hertz_of(sphere)?, friction, sphere.2, strain).map_err(bad_value)?;
    Ok(solution(numbers(contact)?, vec![]))
}

/// Cylinder that slides, with coupling.
#[pyfunction]
pub fn sliding_cylinder(
    radius: f64,
    line_force: f64,
    modulus: f64,
    coupling: f64,
    friction: f64,
) -> PyResult<Solution> {
    let contact = SlidingCylinder::new(radius, line_force, modulus, coupling, friction).map_err(bad_value)?;
    Ok(solution(numbers(contact)?, vec![("pressure", Box::new(move |x| contact.pressure(x)))]))
}

/// Flat circular punch under a force and a slope.
#[pyfunction]
pub fn tilted_punch(radius: f64, force: f64, modulus: f64, tilt: f64) -> PyResult<Solution> {
    let punch = TiltedPunch::new(radius, force, modulus, tilt).map_err(bad_value)?;
    Ok(solution_of_points(numbers(punch)?, Box::new(move |x, y| punch.pressure(x, y))))
}

/// Flat punch of infinite length under a force and a slope.
#[pyfunction]
pub fn tilted_line_punch(half_width: f64, line_force: f64, modulus: f64, tilt: f64) -> PyResult<Solution> {
    let punch = TiltedLinePunch::new(half_width, line_force, modulus, tilt).map_err(bad_value)?;
    Ok(solution(numbers(punch)?, vec![("pressure", Box::new(move |x| punch.pressure(x)))]))
}

/// Flat punch with a rounded edge, without friction.
#[pyfunction]
pub fn rounded_punch(flat_radius: f64, edge_radius: f64, force: f64, modulus: f64) -> PyResult<Solution> {
    let punch = RoundedPunch::new(flat_radius, edge_radius, force, modulus).map_err(bad_value)?;
    Ok(solution(numbers(punch)?, vec![("pressure", Box::new(move |r| punch.pressure(r)))]))
}

/// Flat circular punch that sticks completely.
#[pyfunction]
pub fn no_slip_punch(radius: f64, force: f64, modulus: f64, coupling: f64) -> PyResult<Solution> {
    let punch = NoSlipPunch::new(radius, force, modulus, coupling).map_err(bad_value)?;
    Ok(solution(numbers(punch)?, vec![]))
}

/// Sphere that sticks as it touches.
#[pyfunction]
pub fn no_slip_sphere(radius: f64, force: f64, modulus: f64, coupling: f64) -> PyResult<Solution> {
    let sphere = NoSlipSphere::new(radius, force, modulus, coupling).map_err(bad_value)?;
    Ok(solution(numbers(sphere)?, vec![]))
}

/// A layer `(young, poisson, thickness)` on a rigid base.
fn layer_of((young, poisson, thickness): (f64, f64, f64)) -> PyResult<Coating> {
    let material = ElasticMaterial::new(young, poisson).map_err(bad_value)?;
    Coating::new(material, thickness).map_err(bad_value)
}

/// Rigid sphere on a thin bonded layer.
#[pyfunction]
pub fn thin_layer(radius: f64, force: f64, layer: (f64, f64, f64)) -> PyResult<Solution> {
    let contact = ThinLayer::sphere(radius, force, &layer_of(layer)?).map_err(bad_value)?;
    Ok(solution(numbers(contact)?, vec![("pressure", Box::new(move |r| contact.pressure(r)))]))
}

/// Rigid sphere on a thick bonded layer, touching over a disc of a radius.
#[pyfunction]
pub fn thick_layer(radius: f64, contact_radius: f64, layer: (f64, f64, f64)) -> PyResult<Solution> {
    let contact = ThickLayer::sphere(radius, contact_radius, &layer_of(layer)?).map_err(bad_value)?;
    Ok(solution(numbers(contact)?, vec![]))
}

/// The table of Spence's problem, JSON text.
#[pyfunction]
pub fn spence_table() -> PyResult<String> {
    serde_json::to_string(SPENCE_TABLE).map_err(bad_value)
}
