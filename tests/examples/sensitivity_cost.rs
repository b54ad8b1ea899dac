//! What derivatives cost beside the run: `cargo run --release -p fret-validation --example sensitivity_cost -- 64 128`, with cells per side.
//!
//! A coated sphere, 64 increments of pressing and a cycle of 32, on one thread. It prints counts of operator applications, which are the same on
//! every machine, and times over that of the run in the same process (processor time of the thread where the system tells it, the best of some).

#![expect(clippy::print_stdout, reason = "its output is the table")]

use std::error::Error;
use std::fs;
use std::sync::LazyLock;
use std::time::Instant;

use fret_core::case::Case;
use fret_core::plan::Plan;
use fret_core::run::{Silent, Simulation};
use fret_core::sensitivity::{Direction, Request, gradient};

/// A coated sphere: nine numbers, five of them constants of bodies.
fn case(cells: usize) -> String {
    format!(
        r#"
[grid]
cells = [{cells}, {cells}]
size = [400e-6, 400e-6]
[upper]
rigid = true
[lower]
coatings = [{{ thickness = 80e-6, young = 462e9, poisson = 0.2 }}]
substrate = {{ young = 210e9, poisson = 0.3 }}
[profile.sphere]
radius = 10e-3
[friction]
coefficient = 0.3
[[load]]
normal_force = 50.0
increments = 64
ramp = "cubic"
[[load]]
tangential_force = [9.0, 0.0]
cycles = 1
increments = 32
"#
    )
}

/// Processor time of this thread [s], where the system tells it; else the time that has passed.
fn time() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let spent = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let spent = spent.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    spent.map_or_else(|| START.elapsed().as_secs_f64(), |nanoseconds| 1e-9 * nanoseconds)
}

/// The most memory that the process has taken so far [MiB], where the system tells it.
fn peak() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = peak.and_then(|peak| peak.split_whitespace().next()?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) / 1024.0
}

/// The least time of some runs of a closure, and what it gives.
fn timed<T>(
    mut of: impl FnMut() -> Result<T, Box<dyn Error + Send + Sync>>,
) -> Result<(T, f64), Box<dyn Error + Send + Sync>> {
    let mut best = f64::INFINITY;
    let mut found = None;
    for _ in 0..5 {
        let start = time();
        found = Some(of()?);
        best = best.min(time() - start);
    }
    Ok((found.ok_or("nothing was timed")?, best))
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let sizes: Vec<usize> = std::env::args().skip(1).map(|word| word.parse()).collect::<Result<_, _>>()?;
    rayon::ThreadPoolBuilder::new().num_threads(1).build()?.install(|| {
        for cells in sizes {
            let plan = Plan::new(Case::from_toml(&case(cells), "case.toml")?)?;
            let (history, run) = timed(|| Ok(Simulation::new(&plan).run(&mut Silent)?))?;
            let steps = history.steps.len() as f64;
            let of_run: usize = history.steps.iter().map(|step| step.work.convolutions).sum();
            let in_full: f64 = history.steps.iter().map(|step| step.work.full_grid_convolutions).sum();
            let passes: usize = history.steps.iter().map(|step| step.work.preconditioner_passes).sum();
            println!("{cells} x {cells} cells, {steps} increments: {run:.4} s, {:.0} MiB", peak());
            println!(
                "{:44} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7}",
                "per increment", "linear", "others", "in full", "const.", "precon.", "time"
            );
            println!(
                "{:44} {:7.1} {:>7} {:7.2} {:>7} {:7.1} {:7.2}",
                "run",
                of_run as f64 / steps,
                "",
                in_full / steps,
                "",
                passes as f64 / steps,
                1.0
            );
            let two = ["load[1].tangential_force[0]", "friction.coefficient"];
            let asked: [(&str, &[&str], Direction); 5] = [
                ("dissipated_energy", &two[..1], Direction::Forward),
                ("dissipated_energy", &two, Direction::Backward),
                ("dissipated_energy", &[], Direction::Backward),
                ("max_pressure", &[], Direction::Backward),
                ("shift_x", &[], Direction::Backward),
            ];
            for (of, by, direction) in asked {
                let by = by.iter().map(|path| (*path).to_owned()).collect();
                let request = Request { of: vec![of.to_owned()], by, direction: Some(direction) };
                let (found, all) = timed(|| Ok(gradient(&plan, &request, &mut Silent)?))?;
                let work = found.work;
                let per = |count: usize| count as f64 / steps;
                println!(
                    "{:44} {:7.1} {:7.1} {:7.2} {:7.1} {:7.1} {:7.2}",
                    format!("{of} by {}, {direction:?}", found.parameters.len()),
                    per(work.of_linear_problems),
                    per(work.others),
                    work.full_grid_applications / steps,
                    per(work.of_constants),
                    per(work.preconditioner_passes),
                    (all - run) / run
                );
                println!(
                    "{:44} {:.1} MiB kept, peak {:.0} MiB",
                    "",
                    work.kept_bytes as f64 / 1_048_576.0,
                    peak()
                );
            }
        }
        Ok(())
    })
}
