//! Cases that trigger what a run may leave out, each alone and all together, and how two runs of a case are compared.

use std::time::Instant;

use fret_core::case::Case;
use fret_core::history::{History, KeptFields, StepRecord};
use fret_core::plan::{LeaveOut, Plan, Simplification};
use fret_core::run::{Silent, Simulation};

use crate::{Sphere, keeping};

/// Solver tolerance of these cases.
pub const TOLERANCE: f64 = 1e-9;

/// A case and the shortcut it is there for; none: all of them.
#[derive(Debug, Clone)]
pub struct Example {
    /// What a reader calls it.
    pub name: &'static str,
    /// The case.
    pub text: String,
    /// The shortcut.
    pub shortcut: Option<Simplification>,
}

/// A run that left out what it was allowed to.
#[derive(Debug)]
pub struct Run {
    /// What happened.
    pub history: History,
    /// Time of the run, operators included [s].
    pub seconds: f64,
}

/// Solves a case with some shortcuts alone.
///
/// # Panics
/// When it is refused, not solved, or misses its residual.
pub fn solved(text: &str, leave_out: LeaveOut) -> Run {
    let case = Case::from_toml(text, "case.toml").unwrap_or_else(|error| panic!("{error}"));
    let started = Instant::now();
    let plan = Plan::leaving_out(case, leave_out).unwrap_or_else(|error| panic!("{error}"));
    let history =
        Simulation::new(&plan).run(&mut Silent).unwrap_or_else(|error| panic!("{leave_out:?}: {error}"));
    assert!(history.largest_residual() <= TOLERANCE);
    Run { history, seconds: started.elapsed().as_secs_f64() }
}

/// Largest difference of two runs: of pressure and shear in any cell of any increment over the largest pressure of the run, of
/// approach and shift over the largest approach, and of the dissipated energy over the largest force times that.
///
/// # Panics
/// When the runs did not keep the same fields.
pub fn difference(one: &History, other: &History) -> f64 {
    assert_eq!(one.steps.len(), other.steps.len());
    assert_eq!(one.fields.len(), other.fields.len());
    let largest =
        |value: fn(&StepRecord) -> f64| one.steps.iter().map(|step| value(step).abs()).fold(0.0, f64::max);
    let [pressure, approach, force] =
        [largest(|s| s.max_pressure), largest(|s| s.approach), largest(|s| s.normal_force)];
    let mut worst = 0.0_f64;
    for (a, b) in one.steps.iter().zip(&other.steps) {
        let motions = [a.approach - b.approach, a.shift[0] - b.shift[0], a.shift[1] - b.shift[1]];
        worst = motions.iter().fold(worst, |worst, off| worst.max(off.abs() / approach));
        worst = worst.max((a.dissipated_energy - b.dissipated_energy).abs() / (force * approach));
    }
    for (a, b) in one.fields.iter().zip(&other.fields) {
        let tractions = |kept: &'_ KeptFields| -> Vec<f64> {
            let all = kept.pressure.iter().chain(kept.shear.iter().flatten());
            all.flat_map(|field| field.iter().copied()).collect()
        };
        let (a, b) = (tractions(a), tractions(b));
        assert_eq!(a.len(), b.len());
        worst = a.iter().zip(&b).fold(worst, |worst, (a, b)| worst.max((a - b).abs() / pressure));
    }
    worst
}

/// The cases, with `cells` a side.
pub fn cases(cells: usize) -> Vec<Example> {
    use Simplification::{
        Coupling, LayeredResponse, Mirror, Precision, Pressure, Region, Tangential, Transverse,
    };
    let rigid = Sphere { cells, tolerance: TOLERANCE, friction: 0.3, ..Sphere::default() };
    let equal = Sphere { identical: true, ..rigid.clone() };
    let coated = Sphere { coating: Some((4.0, 0.5)), ..rigid.clone() };
    let smooth = Sphere { friction: 0.0, ..coated.clone() };
    let wide = Sphere { size: 6.0, ..coated.clone() };
    let straight = Sphere { poisson: 0.0, ..equal.clone() };
    let everything = Sphere { size: 6.0, ..straight.clone() };
    let pulled =
        |sphere: &Sphere, press, pull| sphere.pulled(&sphere.pressed(1.0, press, "linear"), 0.7, pull, None);
    let fine = Sphere { cells: 128, size: 5.0, ..coated.clone() };
    let fine_equal = Sphere { cells: 128, size: 5.0, ..equal.clone() };
    // The contact shrinks to less than half within one increment, by more cells than boxes keep free, and what slips does so from
    // the shear of the larger one.
    let unloaded = |sphere: &Sphere| {
        let force = sphere.force();
        format!(
            "{}[[load]]\nnormal_force = {:e}\ntangential_force = [{:e}, 0.0]\nincrements = 1\n[[load]]\ntangential_force = [{:e}, 0.0]\n\
             increments = 2\n",
            pulled(sphere, 2, 2),
            0.3 * force,
            0.05 * force,
            -0.05 * force
        )
    };
    let list = [
        ("rigid sphere on a plain half-space", pulled(&rigid, 2, 4), Some(LayeredResponse)),
        ("two equal bodies", pulled(&equal, 2, 4), Some(Coupling)),
        ("coated, no friction", smooth.pressed(1.0, 3, "linear"), Some(Tangential)),
        ("two equal bodies, pressed alone", equal.pressed(1.0, 4, "linear"), Some(Tangential)),
        ("two equal bodies, pulled at one load", pulled(&equal, 1, 8), Some(Pressure)),
        ("two equal bodies without lateral contraction", pulled(&straight, 1, 8), Some(Transverse)),
        ("endless cylinder, pulled across its axis", line(cells.max(64)), Some(Transverse)),
        ("coated, on a wide grid", pulled(&wide, 2, 4), Some(Region)),
        ("coated, pulled: half", pulled(&coated, 3, 5), Some(Mirror)),
        ("two equal bodies, pulled: a quarter", pulled(&equal, 2, 6), Some(Mirror)),
        ("coated, no friction: a quarter", smooth.pressed(1.0, 3, "cubic"), Some(Mirror)),
        ("endless cylinder, periodic: half", line(cells.max(64)), Some(Mirror)),
        ("two equal bodies, unloaded at once on a wide grid", unloaded(&fine_equal), Some(Region)),
        ("coated, unloaded at once on a wide grid", unloaded(&fine), Some(Region)),
        (
            "coated, pulled: digits",
            pulled(&Sphere { cells: cells.max(64), ..coated.clone() }, 3, 5),
            Some(Precision),
        ),
        (
            "two equal bodies, pulled: digits",
            pulled(&Sphere { cells: cells.max(64), ..equal.clone() }, 2, 6),
            Some(Precision),
        ),
        ("two equal bodies, wide grid, pressed and pulled", pulled(&everything, 3, 6), None),
    ];
    list.map(|(name, text, shortcut)| Example { name, text: format!("{text}{}", keeping(1)), shortcut })
        .into()
}

/// A cylinder on a body of another elasticity, pulled across its axis.
fn line(cells: usize) -> String {
    format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [8.0, 8.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
         substrate = {{ young = 1.0, poisson = 0.2 }}\n[profile.cylinder]\nradius = 100.0\naxis = \"y\"\n\
         [friction]\ncoefficient = 0.3\n[solver]\ntolerance = {TOLERANCE:e}\n\
         [[load]]\nnormal_force = 0.06\nincrements = 2\n[[load]]\ntangential_force = [0.012, 0.0]\nincrements = 4\n"
    )
}
