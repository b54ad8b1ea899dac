//! What the normal problem costs: operator applications on the finest grid, on all levels weighted by cells, time, scene by
//! scene. `cargo bench -p fretting --bench normal_contact -- [CELLS,CELLS,...] [FILTER]`.
//!
//! With the argument `time` it prints CPU seconds of Hertz contacts, the gap given, influence coefficients included, in front of
//! their mirrors and on the whole grid, for `benches/normal_against_others.py`.

#![expect(clippy::print_stdout, reason = "a benchmark answers on the terminal")]

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::ops::ControlFlow;
use std::time::Instant;

use fretting::compliance::SurfaceResponse;
use fretting::history::Work;
use fretting::kernel::{Components, ResponseTable, influence_coefficients, periodic_symbols};
use fretting::model::{
    Base, Body, Coating, ContactPair, ContactState, Control, CoulombFriction, ElasticMaterial, HalfSpace,
    LoadStep, SurfaceGrid, Symmetry,
};
use fretting::solver::{ContactSolver, Coupling, SolveError, SolverSettings};
use ndarray::Array2;

type Answer<T> = Result<T, Box<dyn Error>>;

/// Poisson's ratio of most scenes.
const POISSON: f64 = 0.3;

/// Bodies, side length of the grid, undeformed gap, load.
struct Scene {
    name: String,
    pair: ContactPair,
    side: f64,
    gap: Box<dyn Fn(f64, f64) -> f64>,
    load: Control,
    periodic: bool,
}

/// What a scene cost.
struct Cost {
    work: Work,
    residual: f64,
    contact_cells: usize,
}

fn main() -> Answer<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    if arguments.first().is_some_and(|argument| argument == "time") {
        return times(&sizes(arguments.get(1), &[128, 256, 512, 1024])?);
    }
    let cells = sizes(arguments.first(), &[64, 128, 256, 512])?;
    println!(
        "operator applications: all levels, weighted by cells, final check included; residual below 1e-8\n"
    );
    print!("| scene |");
    for n in &cells {
        print!(" {n} |");
    }
    println!("\n|---|{}", "---|".repeat(cells.len()));
    for scene in scenes()? {
        if arguments.get(1).is_some_and(|filter| !scene.name.contains(filter.as_str())) {
            continue;
        }
        print!("| {} |", scene.name);
        for &n in &cells {
            match solve(&scene, gap_of(&scene, n)?, 1e-8, false) {
                Ok(cost) if cost.residual < 1e-8 => print!(" {:.1} |", cost.work.full_grid_convolutions),
                Ok(cost) => print!(" residual {:.0e} |", cost.residual),
                Err(error) => print!(" {error} |"),
            }
        }
        println!();
    }
    Ok(())
}

/// Cells a side from a list with commas.
fn sizes(list: Option<&String>, else_these: &[usize]) -> Answer<Vec<usize>> {
    Ok(match list {
        Some(list) => list.split(',').map(str::parse).collect::<Result<_, _>>()?,
        None => else_these.to_vec(),
    })
}

/// CPU seconds, one thread.
fn times(cells: &[usize]) -> Answer<()> {
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global()?;
    for &n in cells {
        let scene = hertz(4.0)?;
        let gap = gap_of(&scene, n)?;
        let mut line = format!("{n}");
        for mirrors in [true, false] {
            // The least of as many runs as the other solvers get: neighbours only add.
            let (mut least, begun, mut runs) = (f64::INFINITY, Instant::now(), 0);
            while runs < 3 || begun.elapsed().as_secs_f64() < 4.0 && runs < 20 {
                let started = cpu_seconds();
                solve(&scene, gap.clone(), 1e-8, mirrors)?;
                least = least.min(cpu_seconds() - started);
                runs += 1;
            }
            let _ = write!(line, " {least:.6}");
        }
        println!("{line}");
    }
    Ok(())
}

/// CPU time of this thread where the system tells, else time passed [s].
fn cpu_seconds() -> f64 {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
    }
    #[cfg(not(unix))]
    {
        static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
        START.get_or_init(Instant::now).elapsed().as_secs_f64()
    }
}

fn pair(coatings: &[(f64, f64, f64)], substrate: Option<f64>) -> Answer<ContactPair> {
    let coatings = coatings
        .iter()
        .map(|&(young, poisson, thickness)| Coating::new(ElasticMaterial::new(young, poisson)?, thickness))
        .collect::<Result<_, _>>()?;
    let base = match substrate {
        Some(young) => Base::Elastic(ElasticMaterial::new(young, POISSON)?),
        None => Base::Rigid,
    };
    Ok(ContactPair::new(Body::Rigid, Body::Elastic(HalfSpace::new(coatings, base)?))?)
}

/// Force that presses a unit sphere on the half-space `(1, 0.3)` to a contact radius of 1.
fn unit_force() -> f64 {
    4.0 / (3.0 * (1.0 - POISSON * POISSON))
}

fn hertz(side: f64) -> Answer<Scene> {
    Ok(Scene {
        name: format!("Hertz, side {side} a"),
        pair: pair(&[], Some(1.0))?,
        side,
        gap: Box::new(|x, y| 0.5 * (x * x + y * y)),
        load: Control::Force(unit_force()),
        periodic: false,
    })
}

/// A unit sphere on a coating; the side is three contact radii.
fn coated(name: String, pair: ContactPair, force: f64) -> Scene {
    let mut scene = Scene {
        name,
        pair,
        side: 5.0,
        gap: Box::new(|x, y| 0.5 * (x * x + y * y)),
        load: Control::Force(force),
        periodic: false,
    };
    for _ in 0..4 {
        match gap_of(&scene, 64).and_then(|gap| solve(&scene, gap, 1e-4, true)) {
            Ok(cost) => scene.side *= 3.0 * (cost.contact_cells as f64 / PI).sqrt() / 64.0,
            Err(_) => scene.side *= 2.0,
        }
    }
    scene
}

fn scenes() -> Answer<Vec<Scene>> {
    let mut list = vec![hertz(4.0)?, hertz(2.2)?];
    for ratio in [1e-3, 0.1, 0.5, 2.0, 10.0, 1e2, 1e3] {
        for thickness in [0.1, 1.0] {
            let name = format!("E1/E2 {ratio}, h {thickness} aH");
            let pair = pair(&[(ratio, POISSON, thickness)], Some(1.0))?;
            list.push(coated(name, pair, unit_force()));
        }
    }
    // the contact radius is ten times the thickness
    for (ratio, force) in [(1e2, 3.05461), (1e3, 5.94297)] {
        let pair = pair(&[(ratio, POISSON, 0.1)], Some(1.0))?;
        list.push(coated(format!("E1/E2 {ratio}, h 0.1 of the contact radius"), pair, force));
    }
    for thickness in [1.0, 0.1] {
        let pair = pair(&[(1.0, 0.49, thickness)], None)?;
        list.push(coated(format!("rigid base, nu .49, h {thickness}"), pair, unit_force()));
    }
    let free = |name: &str, side: f64, force: f64, gap: Box<dyn Fn(f64, f64) -> f64>| {
        let (pair, load) = (pair(&[], Some(1.0))?, Control::Force(force));
        Ok::<_, Box<dyn Error>>(Scene { name: name.into(), pair, side, gap, load, periodic: false })
    };
    let flat = |x: f64, y: f64| 5.0 * (x.hypot(y) - 0.8).max(0.0).powi(2);
    list.push(free("rounded flat punch", 3.0, unit_force(), Box::new(flat))?);
    list.push(free("needle, curvatures 30:1", 3.0, 0.05, Box::new(|x, y| 0.5 * (x * x + 30.0 * y * y)))?);
    let approach = Control::Motion(1.0);
    list.push(Scene { name: "Hertz, approach".into(), load: approach, ..hertz(4.0)? });
    let bumps = waves(4.0, 3..60, 0.03);
    let sphere = move |x: f64, y: f64| 1.0 + 0.5 * (x * x + y * y) + bumps(x, y);
    list.push(free("rough sphere", 4.0, unit_force(), Box::new(sphere))?);
    let rough = |name: &str, share: f64| {
        let slope = 0.1;
        let heights = waves(1.0, 4..32, slope);
        Ok::<_, Box<dyn Error>>(Scene {
            name: name.into(),
            pair: pair(&[], Some(1.0))?,
            side: 1.0,
            gap: Box::new(move |x, y| 1.0 + heights(x, y)),
            load: Control::Force(share * slope / (1.0 - POISSON * POISSON)),
            periodic: true,
        })
    };
    for (name, share) in
        [("periodic rough, light", 0.04), ("periodic rough, half", 0.3), ("periodic rough, 99 %", 1.3)]
    {
        list.push(rough(name, share)?);
    }
    Ok(list)
}

/// A self-affine surface (Hurst exponent 0.8) of plane waves with fixed directions and phases, of the given rms slope.
fn waves(side: f64, numbers: std::ops::Range<u32>, slope: f64) -> impl Fn(f64, f64) -> f64 {
    let mut state = 12_345_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut list = Vec::new();
    for number in numbers {
        // as many waves as fit on the circle of that wavenumber, at most 24
        for _ in 0..(3 * number).min(24) {
            let angle = TAU * random();
            let k = [angle.cos(), angle.sin()].map(|c| TAU * (f64::from(number) * c).round() / side);
            let size = k[0].hypot(k[1]);
            list.push((
                k,
                TAU * random(),
                size.powf(-1.8) * (f64::from(number) / f64::from((3 * number).min(24))).sqrt(),
            ));
        }
    }
    let mean_square: f64 = list.iter().map(|(k, _, height)| 0.5 * (height * k[0].hypot(k[1])).powi(2)).sum();
    let factor = slope / mean_square.sqrt();
    move |x, y| factor * list.iter().map(|(k, phase, a)| a * (k[0] * x + k[1] * y + phase).cos()).sum::<f64>()
}

/// Gap of a scene on `n` cells a side.
fn gap_of(scene: &Scene, n: usize) -> Answer<Array2<f64>> {
    let grid = SurfaceGrid::new([n, n], [scene.side / n as f64; 2])?;
    let mut gap = Array2::from_shape_fn((n, n), |(i, j)| (scene.gap)(grid.centre(0, i), grid.centre(1, j)));
    let lowest = gap.iter().copied().fold(f64::INFINITY, f64::min);
    gap -= lowest;
    Ok(gap)
}

/// Solves a scene with its gap; in front of its mirrors, where it has any and that is wanted.
fn solve(scene: &Scene, gap: Array2<f64>, tolerance: f64, mirrors: bool) -> Answer<Cost> {
    let n = gap.nrows();
    let side = scene.side / n as f64;
    let grid = SurfaceGrid::new([n, n], [side; 2])?;
    let response = if scene.periodic {
        SurfaceResponse::Periodic(periodic_symbols(&scene.pair, [n, n], [side; 2], Components::NORMAL, 0))
    } else {
        SurfaceResponse::FreeSpace(influence_coefficients(&scene.pair, [n, n], [side; 2], Components::NORMAL))
    };
    let friction = CoulombFriction::NONE;
    let settings = SolverSettings::new(tolerance);
    let odd = |axis: usize| {
        let mut odd_shear = [None; 2];
        odd_shear[axis] = Some(axis);
        Some(axis).filter(|_| mirrors && Symmetry { odd_shear }.is_kept_by(&gap.view()))
    };
    let symmetry = Symmetry { odd_shear: [odd(0), odd(1)] };
    let mut solver =
        ContactSolver::new(grid, gap, &friction, Coupling::Frictionless, response, settings, true)
            .with_symmetry(symmetry);
    if !scene.periodic {
        solver =
            solver.with_response_table(ResponseTable::new(&scene.pair, TAU / scene.side, 5.0 * PI / side));
    }
    let load = LoadStep { normal: scene.load, tangential: [Control::Force(0.0); 2], ..LoadStep::FREE };
    let state = ContactState::untouched([n, n]);
    let solved =
        solver.step(&state, &load, &mut |_, _| ControlFlow::Continue(())).map_err(|error| match error {
            SolveError::ContactAtEdge => "at the edge".to_owned(),
            SolveError::NotConverged { reached, .. } => format!("stays at {reached:.0e}"),
            other => format!("{other:?}"),
        })?;
    Ok(Cost {
        work: solved.work,
        residual: solved.outcome.residual.largest(),
        contact_cells: solved.outcome.contact_cells,
    })
}
