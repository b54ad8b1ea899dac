//! `fret heat`: temperature rise by the friction of the last cycle, and the resistance of the contact to heat and current, from the kept
//! fields of a finished run; nothing is solved again.

use std::path::Path;

use serde_json::json;

use crate::arguments::HeatArguments;
use crate::failure::Failure;
use crate::heat::{CONDUCTORS, both, computed};
use crate::interrupt;
use crate::terminal::Answer;
use fret_results::{CaseFile, Results};

/// Computes temperatures and resistances for a result folder.
pub fn heat(arguments: &HeatArguments) -> Result<Answer, Failure> {
    interrupt::listen();
    let folder = &arguments.folder;
    let mut run = Results::read(folder)?;
    if let Some(path) = &arguments.case {
        let conducting = CaseFile::read(path)?.case(None)?;
        let own = run.case();
        let differs = [("units", own.units != conducting.units), ("bodies", own.bodies != conducting.bodies)];
        if let Some((what, _)) = differs.into_iter().find(|(_, differs)| *differs) {
            return Err(Failure::call(
                format!(
                    "{}: its {what} are not those of the results in {}",
                    path.display(),
                    folder.display()
                ),
                "the case of the results, with thermal_conductivity or electrical_resistivity in its layers",
            ));
        }
        run.record.plan.case.conduction = conducting.conduction;
    }
    if run.case().conduction.is_none() {
        let what = format!("{}: its case says nothing about conduction", folder.display());
        return Err(Failure::call(what, CONDUCTORS));
    }
    let pool = arguments.threads.pool()?;
    let every = arguments.every.map(|every| every as usize);
    let Some((record, text)) = pool.install(|| computed(folder, &run, every, &arguments.manner))? else {
        return Err(without_answer(folder, &run));
    };
    Ok(Answer::new(json!(record), text))
}

/// Why there is nothing to tell: no temperature is asked for, and no resistance is one of both bodies.
fn without_answer(folder: &Path, run: &Results) -> Failure {
    let conduction = &run.case().conduction;
    let no_pair = [&conduction.thermal, &conduction.electrical].iter().all(|pair| both(pair).is_none());
    let (why, help) = if no_pair && !run.case().periodic.is_none() {
        (
            "heat and current are conducted by one body at the most, so the contact has no resistance",
            "thermal_conductivity, or electrical_resistivity, in all layers of both bodies; give them with --case FILE",
        )
    } else if no_pair {
        (
            "heat and current are conducted by one body at the most, so the contact has no resistance, and without a frequency there is no temperature",
            "[thermal] frequency = ..., with pressure, shear and slip kept of every increment, for the temperature; thermal_conductivity, or \
             electrical_resistivity, in all layers of both bodies for the resistance; give them with --case FILE",
        )
    } else {
        (
            "pressure is kept of no increment, and without it nothing says where the bodies touch",
            "run the case again with pressure among the fields of [output]",
        )
    };
    Failure::call(format!("{}: {why}", folder.display()), help)
}
