//! Runs a case, keeps what the certifier reads, and has it judged: also as far as a run came that ended early.

use std::ops::ControlFlow;

use fret_core::case::{Attachments, Case, CaseError};
use fret_core::history::{KeptFields, StepRecord};
use fret_core::model::MirroredState;
use fret_core::plan::Plan;
use fret_core::run::{Iteration, Observer, Part, RunError, Simulation};
use ndarray::Array2;

use super::{Certificate, certify};

/// An increment: its record and its kept fields.
#[derive(Debug, Clone)]
pub struct Kept {
    /// The record.
    pub record: StepRecord,
    /// All fields.
    pub fields: KeptFields,
    /// The parts in which it was solved, where there are more than one.
    pub parts: Vec<KeptPart>,
}

/// A part of an increment: the share of the way at its end, its record and its kept fields.
#[derive(Debug, Clone)]
pub struct KeptPart {
    /// 1 in the last.
    pub share: f64,
    /// The record.
    pub record: StepRecord,
    /// All fields but the worn depth.
    pub fields: KeptFields,
}

/// How a run ended, and what was judged of it.
#[derive(Debug)]
pub struct Ended {
    /// The plan.
    pub plan: Plan,
    /// Every solved increment.
    pub run: Vec<Kept>,
    /// Its certificate.
    pub certificates: Vec<Certificate>,
    /// Why the run ended before its last increment.
    pub error: Option<RunError>,
    /// Iterations of all increments, also of one that was not solved.
    pub iterations: usize,
}

impl Ended {
    /// The worst of all certificates and their violations, in words; `None` when every solved increment holds.
    pub fn wrong(&self) -> Option<String> {
        let tolerance = self.plan.case.tolerance;
        self.certificates.iter().find_map(|certificate| {
            let violations = certificate.violations(tolerance);
            let words: Vec<String> = violations.iter().map(|(law, off)| format!("{law} {off:.1e}")).collect();
            (!words.is_empty()).then(|| format!("increment {}: {}", certificate.increment, words.join(", ")))
        })
    }
}

/// Runs a case whose text does not say what is kept, and certifies every increment. `arrays`: what the text names by number.
///
/// # Errors
/// When the case is refused, by the case itself or by its plan.
///
/// # Panics
/// When the program panics.
pub fn run_certified(text: &str, arrays: &[Array2<f64>]) -> Result<Ended, CaseError> {
    let fields = ["pressure", "shear", "slip", "gap", "zone"];
    let worn = if text.contains("[wear]") { ", \"worn_depth\"" } else { "" };
    let text = format!("{text}[output]\nfields = [\"{}\"{worn}]\nevery = 1\n", fields.join("\", \""));
    let case = Case::from_toml_with(&text, "case.toml", Attachments { arrays, ..Attachments::none() })?;
    let plan = Plan::new(case)?;
    let mut witness = Witness { run: Vec::new(), parts: Vec::new(), iterations: 0 };
    let error = Simulation::new(&plan).run(&mut witness).err();
    let Witness { run, iterations, .. } = witness;
    let certificates = certify(&plan, &run).unwrap_or_else(|missing| panic!("{missing}"));
    Ok(Ended { plan, run, certificates, error, iterations })
}

/// Keeps every increment.
struct Witness {
    run: Vec<Kept>,
    /// Of the increment that is being solved.
    parts: Vec<KeptPart>,
    iterations: usize,
}

impl Observer for Witness {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        self.iterations += 1;
        ControlFlow::Continue(())
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        _: MirroredState<'_>,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        let parts = std::mem::take(&mut self.parts);
        if let Some(fields) = kept {
            self.run.push(Kept { record: record.clone(), fields: fields.clone(), parts });
        }
        ControlFlow::Continue(())
    }

    fn hears_parts(&self) -> bool {
        true
    }

    fn passed(&mut self, part: &Part<'_>) {
        let Part { share, record, kept, .. } = *part;
        // Those of a way that was given up.
        if self.parts.last().is_some_and(|last| last.share >= share) {
            self.parts.clear();
        }
        if let Some(fields) = kept {
            self.parts.push(KeptPart { share, record: record.clone(), fields: fields.clone() });
        }
    }
}
