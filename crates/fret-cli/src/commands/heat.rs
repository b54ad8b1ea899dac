//! `fret heat`: temperature rise by the friction of the last cycle, and the resistance of the contact to heat and current, from the kept
//! fields of a finished run; nothing is solved again.
//!
//! Written into `heat/` in the result folder: `heat.json` (all numbers), `temperature.npz` (fields).

use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

use fret_core::conduction::{
    ConductionError, HeatedSurface, SurfaceTemperature, contact_resistance, friction_heat, slip_of_cycle,
    surface_temperature,
};
use fret_core::history::CycleRecord;
use fret_core::machine::memory;
use fret_core::model::Conductor;
use fret_core::plan::memory_of_stress;
use ndarray::Array2;
use serde_json::{Value, json};

use crate::arguments::HeatArguments;
use crate::case_file::CaseFile;
use crate::export::npz;
use crate::failure::Failure;
use crate::figures::{duration, figure, figure_in};
use crate::interrupt;
use crate::output::kept_run::KeptRun;
use crate::output::{folder_below, write_whole};
use crate::terminal;
use crate::threads;

/// Computes temperatures and resistances for a result folder.
pub fn heat(arguments: &HeatArguments, as_json: bool) -> Result<(), Failure> {
    interrupt::listen();
    let folder = &arguments.folder;
    let mut run = KeptRun::open(folder)?;
    if let Some(path) = &arguments.case {
        run.conduction = CaseFile::read(path)?.case(None)?.conduction;
    }
    if run.conduction.is_none() {
        return Err(Failure::Call(
            format!("{}: its case says nothing about conduction", folder.display()),
            "thermal_conductivity or electrical_resistivity in the layers of a case; give it with --case FILE"
                .to_owned(),
        ));
    }
    let pool = threads::pool(threads::asked(arguments.threads))?;
    let every = arguments.every.map(|every| every as usize);
    let (record, table) = pool.install(|| computed(folder, &run, every))?;
    if as_json {
        terminal::answer_in_json(&record)
    } else if arguments.quiet {
        Ok(())
    } else {
        terminal::answer(&table)
    }
}

/// Temperatures and resistances of a run that has just ended.
pub fn after_run(folder: &Path, quiet: bool) -> Result<(), Failure> {
    let run = KeptRun::open(folder)?;
    if run.grid.is_line() || run.steps.is_empty() {
        return Ok(());
    }
    let (_, table) = computed(folder, &run, None)?;
    if quiet { Ok(()) } else { terminal::answer(&table) }
}

fn of([lower, upper]: &[Option<Conductor>; 2]) -> [Option<&Conductor>; 2] {
    [lower.as_ref(), upper.as_ref()]
}

/// What is written, and what a person reads.
fn computed(folder: &Path, run: &KeptRun, every: Option<usize>) -> Result<(Value, String), Failure> {
    let started = Instant::now();
    let [first, last] = run.last_cycle;
    memory::check(memory_of_stress(run.grid.len(), last + 1 - first))?;
    let mut table = run.unfinished.as_ref().map_or(String::new(), |why| format!("{why}\n"));
    let rise = match run.conduction.frequency {
        Some(frequency) => Some(temperature(folder, run, frequency)?),
        None => None,
    };
    let place = folder_below(folder, Path::new("heat"))?;
    let rise = match rise {
        Some((found, cycle, accounted)) => {
            fields(&place.join("temperature.npz"), run, &found)?;
            Some(told(run, &found, (&cycle, accounted), &mut table))
        }
        None => None,
    };
    let resistances = resistances(folder, run, every, &mut table)?;
    let wall_s = started.elapsed().as_secs_f64();
    let record = json!({
        "status": "computed",
        "unfinished": run.unfinished,
        "temperature": rise,
        "resistance": resistances,
        "wall_s": wall_s,
    });
    write_whole(&place.join("heat.json"), format!("{record:#}\n").as_bytes())?;
    let _ = write!(table, "\nwritten to {} in {}", place.display(), duration(wall_s));
    Ok((record, table))
}

/// Temperature rise over the last cycle, the cycle, and the fraction of its energy that the kept fields account for.
fn temperature(
    folder: &Path,
    run: &KeptRun,
    frequency: f64,
) -> Result<(SurfaceTemperature, CycleRecord, f64), Failure> {
    let shown = folder.display();
    let refuse = |what: String| {
        let help =
            "run the case again with [output] every = 1, and pressure, shear and slip among its fields";
        Failure::Call(format!("{shown}: {what}"), help.to_owned())
    };
    let Some(cycle) = run.cycles.last() else {
        return Err(refuse("no cycle is over, and only of a cycle is the mean power known".to_owned()));
    };
    if !run.record["plan"]["case"]["friction"]["max_shear"].is_null() {
        return Err(Failure::Call(
            format!("{shown}: heat by friction under friction.max_shear, a shear strength, is not computed"),
            "leave [thermal] frequency out: the contact resistance does not need it".to_owned(),
        ));
    }
    let [nx, ny] = run.grid.cells();
    let none = || Array2::zeros((nx, ny));
    let mut increments = Vec::new();
    if cycle.first_increment == 0 {
        increments.push(HeatedSurface { pressure: none(), shear: [none(), none()], slip: [none(), none()] });
    }
    for increment in cycle.first_increment.saturating_sub(1)..=cycle.last_increment {
        let field = |name: &str| -> Result<Array2<f64>, Failure> {
            let kept = run.field(name, increment)?;
            kept.ok_or_else(|| {
                refuse(format!("{name} of increment {increment} of the last cycle is not kept"))
            })
        };
        increments.push(HeatedSurface {
            pressure: field("pressure")?,
            shear: [field("shear_x")?, field("shear_y")?],
            slip: [field("slip_x")?, field("slip_y")?],
        });
    }
    let slip = slip_of_cycle(increments, cycle.dissipated_energy, run.grid.cell_area()).ok_or_else(|| {
        refuse("the kept fields of the last cycle give another dissipated energy than the run".to_owned())
    })?;
    let found = surface_temperature(
        of(&run.conduction.thermal),
        &run.grid,
        run.periodic,
        &friction_heat(&slip, frequency),
        &slip.contact,
    );
    let found = found.map_err(|error| unanswered(folder, &error))?;
    Ok((found, cycle.clone(), slip.accounted))
}

fn unanswered(folder: &Path, error: &ConductionError) -> Failure {
    let shown = folder.display();
    match error {
        ConductionError::Kernel(_) => Failure::Defect(format!("conduction kernels: {error}")),
        ConductionError::Unsolved(_) => Failure::Defect(format!("conduction: {error}")),
        _ => Failure::Call(format!("{shown}: {error}"), String::new()),
    }
}

fn told(
    run: &KeptRun,
    found: &SurfaceTemperature,
    (cycle, accounted): (&CycleRecord, f64),
    table: &mut String,
) -> Value {
    let (largest, cell) = found.largest();
    let [x, y] = [0, 1].map(|axis| run.grid.centre(axis, cell[axis]));
    let power = found.heat.sum() * run.grid.cell_area();
    let mean = mean_where_heated(found);
    let length = |value: f64| figure_in(run.units.as_ref(), value, "length");
    for (name, value) in [
        ("friction power", figure(power)),
        ("max temperature rise", format!("{} at x {}, y {}", figure(largest), length(x), length(y))),
        ("mean temperature rise", format!("{} where heat is made", figure(mean))),
        ("heat into the lower body", found.lower_fraction().map_or("-".to_owned(), figure)),
    ] {
        let _ = writeln!(table, "{name:<30}{value}");
    }
    json!({
        "frequency": run.conduction.frequency,
        "cycle": { "first_increment": cycle.first_increment, "last_increment": cycle.last_increment },
        "dissipated_energy": cycle.dissipated_energy,
        "kept_fields_account_for": accounted,
        "power": power,
        "lower_fraction": found.lower_fraction(),
        "max_rise": { "value": largest, "x": x, "y": y },
        "mean_rise": mean,
    })
}

/// Mean of the temperature rise, weighted by the heat that is made: that of the power that goes in.
fn mean_where_heated(found: &SurfaceTemperature) -> f64 {
    let Some(rise) = found.rise.iter().flatten().next() else { return 0.0 };
    let all = found.heat.sum();
    if all > 0.0 { (&found.heat * rise).sum() / all } else { 0.0 }
}

fn fields(path: &Path, run: &KeptRun, found: &SurfaceTemperature) -> Result<(), Failure> {
    let [x, y] = [0, 1].map(|axis| run.grid.centres(axis).to_vec());
    let cells = run.grid.cells();
    let flat = |field: &Array2<f64>| field.iter().copied().collect::<Vec<f64>>();
    let [heat, into_lower] = [&found.heat, &found.into_lower].map(flat);
    let rise = found.rise.each_ref().map(|rise| rise.as_ref().map(flat));
    let mut arrays: Vec<(&str, &[usize], &[f64])> = vec![
        ("x", &cells[..1], &x),
        ("y", &cells[1..], &y),
        ("heat", &cells, &heat),
        ("heat_into_lower", &cells, &into_lower),
    ];
    for (name, rise) in ["rise_lower", "rise_upper"].into_iter().zip(&rise) {
        if let Some(rise) = rise {
            arrays.push((name, &cells, rise));
        }
    }
    npz::arrays(path, &arrays)
}

/// Resistances of the kept increments that are asked for; none where a body does not conduct.
fn resistances(
    folder: &Path,
    run: &KeptRun,
    every: Option<usize>,
    table: &mut String,
) -> Result<Vec<Value>, Failure> {
    let kinds: Vec<(&str, [Option<&Conductor>; 2])> =
        [("thermal", of(&run.conduction.thermal)), ("electrical", of(&run.conduction.electrical))]
            .into_iter()
            .filter(|(_, conductors)| conductors.iter().all(Option::is_some))
            .collect();
    let last = run.steps.len().saturating_sub(1);
    let mut rows = Vec::new();
    for (place, &increment) in run.steps.iter().enumerate() {
        let chosen = every.map_or(place == last, |every| (last - place).is_multiple_of(every));
        if !chosen || kinds.is_empty() {
            continue;
        }
        if interrupt::is_asked() {
            let help =
                format!("the resistances are not finished; run `fret heat {}` again", folder.display());
            return Err(Failure::Interrupted(help));
        }
        let Some(pressure) = run.field("pressure", increment)? else { continue };
        let contact = pressure.mapv(|pressure| pressure > 0.0);
        let mut row = json!({ "increment": increment });
        for (name, conductors) in &kinds {
            let found = match contact_resistance(*conductors, &run.grid, run.periodic, &contact) {
                Err(ConductionError::Apart) => None,
                other => Some(other.map_err(|error| unanswered(folder, &error))?),
            };
            row[*name] = json!(found);
            let words = found.map_or("none: the bodies are apart".to_owned(), figure);
            let name = format!("{name} contact resistance");
            let _ = writeln!(table, "{name:<30}{words:<14} increment {increment}");
        }
        rows.push(row);
    }
    Ok(rows)
}
