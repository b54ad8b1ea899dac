//! Error against CPU time of a Hertz contact and of a coated sphere, by exact influence coefficients and by the sampled
//! frequency response that most of the literature uses. `cargo bench -p fretting --bench error_time -- [CELLS,...]`; for
//! `benches/error_against_others.py`.
//!
//! A line a run: method, scene, cells a side, CPU seconds with the coefficients, relative errors of the largest pressure (cell
//! and between the cells), approach, and of the pressure in the mean square (`nan` where no exact value is known).

#![expect(clippy::print_stdout, reason = "a benchmark answers on the terminal")]

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::time::Instant;

use fretting::analytic::Hertz;
use fretting::compliance::SurfaceResponse;
use fretting::kernel::{Components, influence_coefficients, sampled_coefficients};
use fretting::model::{
    Base, Body, Coating, ContactPair, ContactState, Control, CoulombFriction, ElasticMaterial, HalfSpace,
    LoadStep, SurfaceGrid, Symmetry,
};
use fretting::solver::{ContactSolver, Coupling, Increment, SolverSettings};
use fretting::study::peak_pressure;
use ndarray::Array2;

type Answer<T> = Result<T, Box<dyn Error>>;

const POISSON: f64 = 0.3;
/// Largest pressure and approach of the coated sphere over those of Hertz on its substrate.
const COATED_PEAK: f64 = 2.283_465_979_044_321;
const COATED_APPROACH: f64 = 0.682_063_997_791_493_6;
/// Points a side at which Hertz's pressure is taken in a cell.
const POINTS: usize = 8;
/// CPU seconds in which runs are counted.
const SECONDS: f64 = 0.4;

/// A unit sphere on a half-space; a contact radius of 1 without coating.
struct Scene {
    name: &'static str,
    pair: ContactPair,
    side: f64,
    /// Largest pressure and approach.
    exact: [f64; 2],
    hertz: Option<Hertz>,
}

fn main() -> Answer<()> {
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global()?;
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let cells: Vec<usize> = match arguments.first() {
        Some(list) => list.split(',').map(str::parse).collect::<Result<_, _>>()?,
        None => vec![16, 32, 64, 128, 256],
    };
    println!("method,scene,cells,seconds,peak_cell,peak_between,approach,pressure_l2");
    for scene in scenes()? {
        for n in &cells {
            for extension in [0, 1, 2, 4] {
                line(&scene, *n, extension)?;
            }
        }
    }
    Ok(())
}

fn modulus() -> f64 {
    1.0 / (1.0 - POISSON * POISSON)
}

fn force() -> f64 {
    4.0 * modulus() / 3.0
}

fn scenes() -> Answer<[Scene; 2]> {
    let steel = ElasticMaterial::new(1.0, POISSON)?;
    let half_space = |coatings| HalfSpace::new(coatings, Base::Elastic(steel));
    let bare = ContactPair::new(Body::Rigid, Body::Elastic(half_space(Vec::new())?))?;
    let coating = Coating::new(ElasticMaterial::new(4.0, POISSON)?, 1.0)?;
    let coated = ContactPair::new(Body::Rigid, Body::Elastic(half_space(vec![coating])?))?;
    let hertz = Hertz::sphere(1.0, force(), modulus())?;
    // E1/E2 = 4, h = a: the row of tests/golden/coated_sphere.json, in units of Hertz on the substrate.
    let of_row = [COATED_PEAK * hertz.max_pressure, COATED_APPROACH * hertz.approach];
    Ok([
        Scene {
            name: "Hertz",
            pair: bare,
            side: 4.0,
            exact: [hertz.max_pressure, hertz.approach],
            hertz: Some(hertz),
        },
        Scene { name: "coated, E1/E2 = 4, h = a", pair: coated, side: 4.0, exact: of_row, hertz: None },
    ])
}

/// Runs one way and prints its line; extension 0: exact coefficients.
fn line(scene: &Scene, n: usize, extension: usize) -> Answer<()> {
    let grid = SurfaceGrid::new([n, n], [scene.side / n as f64; 2])?;
    // The mean of many runs: the system counts CPU time in ticks longer than a small run.
    let started = cpu_seconds();
    let mut solved = solve(scene, &grid, extension)?;
    let mut runs = 1;
    while cpu_seconds() - started < SECONDS {
        solved = solve(scene, &grid, extension)?;
        runs += 1;
    }
    let seconds = (cpu_seconds() - started) / f64::from(runs);
    let pressure = &solved.state.pressure;
    let error = |value: f64, exact: f64| (value / exact - 1.0).abs();
    let largest = pressure.iter().copied().fold(0.0, f64::max);
    let method =
        if extension == 0 { "exact coefficients".to_owned() } else { format!("sampled x{extension}") };
    println!(
        "{method},\"{}\",{n},{seconds:e},{:e},{:e},{:e},{:e}",
        scene.name,
        error(largest, scene.exact[0]),
        error(peak_pressure(pressure), scene.exact[0]),
        error(solved.state.approach, scene.exact[1]),
        scene.hertz.as_ref().map_or(f64::NAN, |hertz| mean_square(pressure, hertz, &grid)),
    );
    Ok(())
}

fn solve(scene: &Scene, grid: &SurfaceGrid, extension: usize) -> Answer<Increment> {
    let (cells, spacing) = (grid.cells(), grid.spacing());
    let mut gap =
        Array2::from_shape_fn(cells, |(i, j)| 0.5 * (grid.centre(0, i).powi(2) + grid.centre(1, j).powi(2)));
    let lowest = gap.iter().copied().fold(f64::INFINITY, f64::min);
    gap -= lowest;
    let coefficients = if extension == 0 {
        influence_coefficients(&scene.pair, cells, spacing, Components::NORMAL)
    } else {
        sampled_coefficients(&scene.pair, cells, spacing, Components::NORMAL, extension)
    };
    let friction = CoulombFriction::NONE;
    let mut solver = ContactSolver::new(
        *grid,
        gap,
        &friction,
        Coupling::Frictionless,
        SurfaceResponse::FreeSpace(coefficients),
        SolverSettings::new(1e-8),
        true,
    )
    // A sphere pressed alone is its own image in both directions.
    .with_symmetry(Symmetry { odd_shear: [Some(0), Some(1)] });
    let none = Control::Force(0.0);
    let load = LoadStep { normal: Control::Force(force()), tangential: [none; 2], ..LoadStep::FREE };
    let mut solved = solver
        .step(&ContactState::untouched(cells), &load, &mut |_, _| ControlFlow::Continue(()))
        .map_err(|error| format!("{} cells, {extension}: {error:?}", cells[0]))?;
    solved.state.approach += lowest; // counted from the apex, not from the lowest cell
    Ok(solved)
}

fn mean_square(pressure: &Array2<f64>, hertz: &Hertz, grid: &SurfaceGrid) -> f64 {
    let [dx, dy] = grid.spacing();
    let place = |k: usize| (k as f64 + 0.5) / POINTS as f64 - 0.5;
    let (mut apart, mut size) = (0.0, 0.0);
    for ((i, j), value) in pressure.indexed_iter() {
        let mut exact = 0.0;
        for a in 0..POINTS {
            for b in 0..POINTS {
                let (x, y) = (grid.centre(0, i) + place(a) * dx, grid.centre(1, j) + place(b) * dy);
                exact += hertz.pressure(x.hypot(y)) / (POINTS * POINTS) as f64;
            }
        }
        apart += (value - exact).powi(2);
        size += exact * exact;
    }
    (apart / size).sqrt()
}

/// CPU time of this thread where the system tells (Linux), else time passed [s].
fn cpu_seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let passed = || START.get_or_init(Instant::now).elapsed().as_secs_f64();
    let scheduled = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds =
        scheduled.and_then(|text| text.split_whitespace().next().and_then(|first| first.parse::<f64>().ok()));
    nanoseconds.map_or_else(passed, |nanoseconds| 1e-9 * nanoseconds)
}
