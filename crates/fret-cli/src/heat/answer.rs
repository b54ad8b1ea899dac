//! Temperature rise by the friction of the last cycle, and the resistance of the contact to heat and current, from the kept fields of a run.
//!
//! Written into `heat/` in the result folder: `heat.json` (all numbers), `temperature.npz` (fields).

use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

use fret_core::conduction::{
    ConductionError, HeatedSurface, SurfaceTemperature, contact_resistance, friction_heat, slip_of_cycle,
    surface_temperature,
};
use fret_core::machine::memory;
use fret_core::model::{Conductor, Dimension};
use fret_core::plan::memory_of_stress;
use ndarray::Array2;

use super::record::{AtPlace, HeatRecord, Increments, Resistance, ResistanceRecord, RiseRecord};
use crate::export::npz;
use crate::failure::Failure;
use crate::figures::{duration, figure_in};
use crate::interrupt;
use crate::manner::{Manner, place_of_answer};
use fret_results::{HEAT, Results};

/// What brings conductors.
pub const CONDUCTORS: &str =
    "thermal_conductivity or electrical_resistivity in the layers of a case; give it with --case FILE";

/// Temperatures and resistances of a run that has just ended; nothing of what has none: a line contact, a run without kept fields.
pub fn answered(folder: &Path) -> Result<Option<(HeatRecord, String)>, Failure> {
    let run = Results::read(folder)?;
    let has_none = run.case().conduction.is_none()
        || run.grid().dimension() == Dimension::Line
        || run.fields.reached.is_empty();
    if has_none { Ok(None) } else { computed(folder, &run, None, &Manner::SILENT) }
}

/// The conductors of both bodies; nothing where one does not conduct.
pub fn both(pair: &[Option<Conductor>; 2]) -> Option<[Option<&Conductor>; 2]> {
    pair.iter().all(Option::is_some).then(|| pair.each_ref().map(Option::as_ref))
}

/// What is written, and what a person reads; nothing where there is nothing to tell.
pub fn computed(
    folder: &Path,
    run: &Results,
    every: Option<usize>,
    manner: &Manner,
) -> Result<Option<(HeatRecord, String)>, Failure> {
    let started = Instant::now();
    let place = || place_of_answer(manner, folder, HEAT, "temperatures of a run");
    // What is asked for is refused before the work; the folder below the results is made for an answer alone.
    let asked = manner.out.is_some().then(place).transpose()?;
    let ([first, last], _) = run.last_cycle();
    memory::check(memory_of_stress(run.grid().len(), last + 1 - first))?;
    let frequency = run.case().conduction.frequency;
    let rise = frequency.map(|frequency| temperature(folder, run, frequency, manner)).transpose()?;
    let resistance = resistances(folder, run, every, manner)?;
    if rise.is_none() && resistance.is_empty() {
        return Ok(None);
    }
    let place = asked.map_or_else(place, Ok)?;
    if let Some((_, found)) = &rise {
        let path = place.join("temperature.npz");
        fields(&path, run, found)?;
        manner.wrote(&path);
    }
    let record = HeatRecord {
        status: "computed".to_owned(),
        unfinished: run.unfinished(),
        units: run.units().cloned(),
        temperature: rise.map(|(record, _)| record),
        resistance,
        wall_s: started.elapsed().as_secs_f64(),
    };
    manner.write_json(&place.join(HEAT[1]), &record)?;
    let mut table = record.unfinished.as_ref().map_or(String::new(), |why| format!("{why}\n"));
    for [name, value, of] in record.lines(|value, kind| figure_in(run.units(), value, kind)) {
        let _ = if of.is_empty() {
            writeln!(table, "{name:<30}{value}")
        } else {
            writeln!(table, "{name:<30}{value:<14} {of}")
        };
    }
    let _ = write!(table, "\nwritten to {} in {}", place.display(), duration(record.wall_s));
    Ok(Some((record, table)))
}

/// Temperature rise over the last cycle, as it is told and as it is.
fn temperature(
    folder: &Path,
    run: &Results,
    frequency: f64,
    manner: &Manner,
) -> Result<(RiseRecord, SurfaceTemperature), Failure> {
    let shown = folder.display();
    let refuse = |what: &str| {
        let help =
            "run the case again with [output] every = 1, and pressure, shear and slip among its fields";
        Failure::call(format!("{shown}: {what}"), help)
    };
    let Some(cycle) = run.cycles.last() else {
        return Err(refuse("no cycle is over, and only of a cycle is the mean power known"));
    };
    if run.case().friction.max_shear().is_some() {
        return Err(Failure::call(
            format!("{shown}: heat by friction under friction.max_shear, a shear strength, is not computed"),
            "leave [thermal] frequency out: the contact resistance does not need it",
        ));
    }
    let [nx, ny] = run.grid().cells();
    let none = || Array2::zeros((nx, ny));
    let mut increments = Vec::new();
    if cycle.first_increment == 0 {
        increments.push(HeatedSurface { pressure: none(), shear: [none(), none()], slip: [none(), none()] });
    }
    for increment in cycle.first_increment.saturating_sub(1)..=cycle.last_increment {
        let field = |name: &str| -> Result<Array2<f64>, Failure> {
            let kept = run.field(name, increment)?;
            kept.ok_or_else(|| {
                refuse(&format!("{name} of increment {increment} of the last cycle is not kept"))
            })
        };
        increments.push(HeatedSurface {
            pressure: field("pressure")?,
            shear: [field("shear_x")?, field("shear_y")?],
            slip: [field("slip_x")?, field("slip_y")?],
        });
    }
    let slip =
        slip_of_cycle(increments, cycle.dissipated_energy, run.grid().cell_area()).ok_or_else(|| {
            refuse("the kept fields of the last cycle give another dissipated energy than the run")
        })?;
    manner.step(|| {
        format!("temperature over increments {} to {}", cycle.first_increment, cycle.last_increment)
    });
    let found = surface_temperature(
        run.case().conduction.thermal.each_ref().map(Option::as_ref),
        run.grid(),
        run.case().periodic,
        &friction_heat(&slip, frequency),
        &slip.contact,
    );
    let found = found.map_err(|error| unanswered(folder, &error))?;
    let (value, cell) = found.largest();
    let [x, y] = [0, 1].map(|axis| run.grid().centre(axis, cell[axis]));
    let record = RiseRecord {
        frequency,
        cycle: Increments { first_increment: cycle.first_increment, last_increment: cycle.last_increment },
        dissipated_energy: cycle.dissipated_energy,
        kept_fields_account_for: slip.accounted,
        power: found.heat.sum() * run.grid().cell_area(),
        lower_fraction: found.lower_fraction(),
        max_rise: AtPlace { value, x, y },
        mean_rise: mean_where_heated(&found),
    };
    Ok((record, found))
}

fn unanswered(folder: &Path, error: &ConductionError) -> Failure {
    let help = match error {
        ConductionError::Kernel(_) => return Failure::Defect(format!("conduction kernels: {error}")),
        ConductionError::Unsolved(_) => return Failure::Defect(format!("conduction: {error}")),
        ConductionError::Line => "run a contact of finite length: cells = [x, y], and no period or two",
        ConductionError::Beyond => {
            "look at [thermal] frequency and at the conductivities, in one set of units"
        }
        ConductionError::Periodic => {
            "leave [thermal] frequency out: the contact resistance of a period does not need it"
        }
        _ => CONDUCTORS,
    };
    Failure::call(format!("{}: {error}", folder.display()), help)
}

/// Mean of the temperature rise, weighted by the heat that is made: that of the power that goes in.
fn mean_where_heated(found: &SurfaceTemperature) -> f64 {
    let Some(rise) = found.rise.iter().flatten().next() else { return 0.0 };
    let all = found.heat.sum();
    if all > 0.0 { found.heat.iter().zip(rise).map(|(heat, rise)| heat / all * rise).sum() } else { 0.0 }
}

fn fields(path: &Path, run: &Results, found: &SurfaceTemperature) -> Result<(), Failure> {
    let [x, y] = [0, 1].map(|axis| run.grid().centres(axis).to_vec());
    let cells = run.grid().cells();
    let field = |name, field: &Array2<f64>| (name, &cells[..], field.iter().copied().collect());
    let mut arrays = vec![("x", &cells[..1], x), ("y", &cells[1..], y), field("heat", &found.heat)];
    arrays.push(field("heat_into_lower", &found.into_lower));
    let rises = ["rise_lower", "rise_upper"].into_iter().zip(&found.rise);
    arrays.extend(rises.filter_map(|(name, rise)| Some(field(name, rise.as_ref()?))));
    npz::arrays(path, &arrays)
}

/// Resistances of the kept increments that are asked for; none where a body does not conduct.
fn resistances(
    folder: &Path,
    run: &Results,
    every: Option<usize>,
    manner: &Manner,
) -> Result<Vec<ResistanceRecord>, Failure> {
    let conduction = &run.case().conduction;
    let [thermal, electrical] = [&conduction.thermal, &conduction.electrical].map(both);
    let kept = &run.fields.reached;
    let last = kept.len().saturating_sub(1);
    let mut rows = Vec::new();
    for (place, &increment) in kept.iter().enumerate() {
        let chosen = every.map_or(place == last, |every| (last - place).is_multiple_of(every));
        if !chosen || thermal.is_none() && electrical.is_none() {
            continue;
        }
        if interrupt::is_asked() {
            let help =
                format!("the resistances are not finished; run `fret heat {}` again", folder.display());
            return Err(Failure::Interrupted(help));
        }
        let Some(pressure) = run.field("pressure", increment)? else { continue };
        manner.step(|| format!("contact resistance of increment {increment}"));
        let contact = pressure.mapv(|pressure| pressure > 0.0);
        let found = |conductors: [Option<&Conductor>; 2]| match contact_resistance(
            conductors,
            run.grid(),
            run.case().periodic,
            &contact,
        ) {
            Err(ConductionError::Apart) => Ok(Resistance::Apart),
            other => other.map(Resistance::Found).map_err(|error| unanswered(folder, &error)),
        };
        let [thermal, electrical] = [thermal.map(found).transpose()?, electrical.map(found).transpose()?];
        rows.push(ResistanceRecord { increment, thermal, electrical });
    }
    Ok(rows)
}
