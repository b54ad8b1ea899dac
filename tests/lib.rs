//! Cases and comparisons that several validation tests share.

pub mod certifier;
pub mod extreme_cases;
pub mod limit;
pub mod random;
pub mod random_histories;
pub mod shortcuts;
pub mod stiff_cases;

use std::fmt::Write;

use fret_core::case::{Attachments, Case};
use fret_core::history::{History, StepRecord};
use fret_core::plan::Plan;
use fret_core::run::{RunError, Silent, Simulation};
use ndarray::Array2;

/// A sphere of radius 100 pressed so that a Hertz contact on a half-space of modulus `E = 1`, `nu = poisson` under it has
/// radius 1: the numbers of most cases here.
#[derive(Debug, Clone)]
pub struct Sphere {
    /// Cells a side.
    pub cells: usize,
    /// Side length.
    pub size: f64,
    /// Poisson's ratio of all materials.
    pub poisson: f64,
    /// Young's modulus of the coating over that of the substrate, and its thickness; `None`: no coating.
    pub coating: Option<(f64, f64)>,
    /// Upper body of the same material instead of a rigid one.
    pub identical: bool,
    /// Coefficient of friction.
    pub friction: f64,
    /// Solver tolerance.
    pub tolerance: f64,
    /// Factor on every length.
    pub length: f64,
    /// Factor on every modulus.
    pub modulus: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Self {
            cells: 64,
            size: 2.4,
            poisson: 0.3,
            coating: None,
            identical: false,
            friction: 0.0,
            tolerance: 1e-8,
            length: 1.0,
            modulus: 1.0,
        }
    }
}

/// Sphere radius of these cases, in contact radii.
pub const RADIUS: f64 = 100.0;

impl Sphere {
    /// Effective modulus of the substrate pair.
    pub fn effective_modulus(&self) -> f64 {
        let one = self.modulus / (1.0 - self.poisson * self.poisson);
        if self.identical { one / 2.0 } else { one }
    }

    /// Effective shear modulus of the substrate pair: `1/G* = sum (2 - nu)/G`.
    pub fn effective_shear_modulus(&self) -> f64 {
        let one = self.modulus / (2.0 * (1.0 + self.poisson) * (2.0 - self.poisson));
        if self.identical { one / 2.0 } else { one }
    }

    /// Force that gives the substrate alone a contact radius of one length.
    pub fn force(&self) -> f64 {
        4.0 * self.effective_modulus() * self.length * self.length / (3.0 * RADIUS)
    }

    /// Hertz's largest pressure under that force, substrate alone.
    pub fn max_pressure(&self) -> f64 {
        1.5 * self.force() / (std::f64::consts::PI * self.length * self.length)
    }

    /// Hertz's approach under that force, substrate alone.
    pub fn approach(&self) -> f64 {
        self.length / RADIUS
    }

    /// The case text without its loads.
    pub fn head(&self) -> String {
        let Self { cells, poisson, modulus, .. } = self;
        let size = self.size * self.length;
        let substrate = format!("substrate = {{ young = {modulus:e}, poisson = {poisson} }}\n");
        let upper = if self.identical { substrate.clone() } else { "rigid = true\n".to_owned() };
        let coating = self.coating.map_or(String::new(), |(ratio, thickness)| {
            format!(
                "coatings = [{{ thickness = {:e}, young = {:e}, poisson = {poisson} }}]\n",
                thickness * self.length,
                ratio * modulus
            )
        });
        format!(
            "[grid]\ncells = [{cells}, {cells}]\nsize = [{size:e}, {size:e}]\n[upper]\n{upper}[lower]\n{coating}{substrate}\
             [profile.sphere]\nradius = {:e}\n[friction]\ncoefficient = {}\n[solver]\ntolerance = {:e}\n",
            RADIUS * self.length,
            self.friction,
            self.tolerance
        )
    }

    /// Pressed to a share of [`Sphere::force`] in `increments`.
    pub fn pressed(&self, share: f64, increments: usize, ramp: &str) -> String {
        let force = share * self.force();
        format!(
            "{}[[load]]\nname = \"press\"\nnormal_force = {force:e}\nincrements = {increments}\nramp = \"{ramp}\"\n",
            self.head()
        )
    }

    /// Adds a stage of tangential force along x, in units of mu W: `pull`, and behind that `pull back`.
    pub fn pulled(&self, text: &str, share: f64, increments: usize, cycles: Option<usize>) -> String {
        let force = share * self.friction * self.force();
        let name = if text.contains("\"pull\"") { "pull back" } else { "pull" };
        let mut text = text.to_owned();
        let _ = write!(
            text,
            "[[load]]\nname = \"{name}\"\ntangential_force = [{force:e}, 0.0]\nincrements = {increments}\n"
        );
        if let Some(cycles) = cycles {
            let _ = writeln!(text, "cycles = {cycles}");
        }
        text
    }
}

/// Runs a case text that must be a good case.
///
/// # Errors
/// As [`Simulation::run`].
///
/// # Panics
/// When the case is refused.
pub fn run(text: &str) -> Result<History, RunError> {
    let case = Case::from_toml(text, "case.toml").unwrap_or_else(|error| panic!("{error}"));
    let plan = Plan::new(case).unwrap_or_else(|error| panic!("{error}"));
    Simulation::new(&plan).run(&mut Silent)
}

/// Runs a case text that must be solved.
///
/// # Panics
/// When it is refused or not solved, or an increment misses its residual.
pub fn solved(text: &str) -> History {
    let history = run(text).unwrap_or_else(|error| panic!("{error}"));
    assert!(history.largest_residual() <= 1e-8, "residual {:e}", history.largest_residual());
    history
}

/// The text with slip integrated by the end-point rule.
pub fn by_end_points(text: &str) -> String {
    text.replacen("[solver]\n", "[solver]\nintegration = \"end_point\"\n", 1)
}

/// How far the energies of any increment are from the first law: the change of the external work less those of what is stored, dissipated,
/// gone with wear or by yielding and unresolved, over the largest of these. What is stored counts by 1e-5: it is rounded to some 1e-14.
///
/// `start`: what was stored at the beginning of the history.
pub fn off_first_law(history: &History, start: f64) -> f64 {
    let energies = |step: &StepRecord| {
        [
            step.external_work,
            -step.elastic_energy,
            -step.dissipated_energy,
            -step.wear_work,
            -step.plastic.work,
            -step.unresolved_energy,
        ]
    };
    let mut before = [0.0, -start, 0.0, 0.0, 0.0, 0.0];
    let mut worst = 0.0_f64;
    for step in &history.steps {
        let now = energies(step);
        let changes: Vec<f64> = now.iter().zip(&before).map(|(now, before)| now - before).collect();
        let unit = changes.iter().fold(1e-5 * step.elastic_energy, |most, change| most.max(change.abs()));
        let off = changes.iter().sum::<f64>().abs();
        worst = worst.max(if off > 0.0 { off / unit } else { 0.0 });
        before = now;
    }
    worst
}

/// Output block that keeps all fields of every `every`-th increment.
pub fn keeping(every: usize) -> String {
    format!("[output]\nfields = [\"pressure\", \"shear\", \"slip\", \"gap\", \"zone\"]\nevery = {every}\n")
}

/// Observed order of convergence from errors on grids refined by two.
pub fn observed_order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).abs().log2()
}

/// Runs a case text whose arrays are handed over: `{ array = n }` in the text stands for the n-th.
///
/// # Panics
/// When it is refused or not solved, or an increment misses its residual.
pub fn solved_with(text: &str, arrays: &[Array2<f64>]) -> History {
    let attachments = Attachments { arrays, ..Attachments::none() };
    let case = Case::from_toml_with(text, "case.toml", attachments).unwrap_or_else(|error| panic!("{error}"));
    let plan = Plan::new(case).unwrap_or_else(|error| panic!("{error}"));
    let history = Simulation::new(&plan).run(&mut Silent).unwrap_or_else(|error| panic!("{error}"));
    assert!(history.largest_residual() <= 1e-8, "residual {:e}", history.largest_residual());
    history
}

/// A frictionless contact of a rigid body on a half-space of `E = 1`, `nu = 0.3`, pressed once; all fields are kept.
pub fn pressed_on_half_space(cells: [usize; 2], size: &str, profile: &str, load: &str) -> String {
    format!(
        "[grid]\ncells = {cells:?}\n{size}\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         {profile}\n[[load]]\n{load}\nincrements = 1\n{}",
        keeping(1)
    )
}
