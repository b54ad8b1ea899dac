//! What a study says in words: what it was compared with, and what to choose.

use fret_core::model::Dimension;
use fret_core::model::stage::Stage;
use fret_core::study::{Advice, Convergence, Place, Quantity, Reference, Resolutions, Source};

use crate::figures::counted;

/// Why a study shows no errors; with the levels that have no answer.
pub fn no_errors(unsolved: &[(Place, String)]) -> String {
    let skipped = unsolved.iter().map(|(_, why)| format!("; a level was left out: {why}"));
    std::iter::once(NO_ERRORS.to_owned()).chain(skipped).collect()
}

const NO_ERRORS: &str = "no errors: no closed form is available for this case, and a single level cannot be compared \
                             with a finer one; give more levels, as in --cells 32,64,128, or numbers with --against FILE";

/// Why a largest pressure has no limit.
pub const GROWS: &str = "it grows with the number of cells at a sharp edge, a tip or a crease";

/// The names of the quantities that are so.
fn names(dimension: Dimension, is_so: impl Fn(Quantity) -> bool) -> String {
    let all = Quantity::ALL.into_iter().filter(|quantity| is_so(*quantity));
    all.map(|quantity| quantity.in_words(dimension)).collect::<Vec<_>>().join(", ")
}

/// The first stage after one that rolls on to a steady state, where it does not do so itself.
pub fn first_after_steady<M>(stages: &[Stage<M>]) -> Option<usize> {
    let steady = stages.iter().position(|stage| stage.steady)?;
    (steady..stages.len()).find(|stage| !stages[*stage].steady)
}

/// What shift and dissipated energy lack, as in `are not compared`, from a stage on that follows a steady state, and why.
pub fn of_the_way(stage: &str, lack: &str) -> String {
    format!(
        "shift and dissipated energy from {stage:?} on {lack}: they go on from a steady state, which counts by the roll of one cell; \
         make that the last stage where they matter"
    )
}

/// What the quantities are compared with, one sentence per source; those whose errors are shown.
pub fn measured_by(reference: &Reference, shown: &dyn Fn(Quantity) -> bool, dimension: Dimension) -> String {
    let form = reference.form().map_or("", |form| form.name());
    let sources = [
        (Source::ClosedForm, format!("the closed form ({form})")),
        (Source::Given, "the numbers given".to_owned()),
        (Source::Limit, "the Richardson extrapolation of this study".to_owned()),
        (Source::Finest, "the finest level, whose own error is then unknown".to_owned()),
    ];
    let said = sources.into_iter().filter_map(|(source, words)| {
        let numbers = names(dimension, |quantity| {
            let two_levels = reference.convergence(quantity) == Some(Convergence::TwoLevels);
            reference.source(quantity) == Some(source)
                && shown(quantity)
                && !(source == Source::Limit && two_levels)
        });
        (!numbers.is_empty()).then(|| format!("{numbers} compared with {words}"))
    });
    said.collect::<Vec<_>>().join("\n")
}

/// Which quantities, of those whose errors are shown, have no observed order, and why; a sentence each, none where all have one.
pub fn without_order(
    reference: &Reference,
    shown: &dyn Fn(Quantity) -> bool,
    dimension: Dimension,
) -> String {
    let of = |convergence: Convergence| {
        names(dimension, |quantity| {
            let is_told = convergence == Convergence::NoLimit || shown(quantity);
            reference.convergence(quantity) == Some(convergence) && is_told
        })
    };
    let no_limit = format!("no limit, {GROWS}; no error is told");
    let said = [
        (Convergence::NoLimit, no_limit.as_str()),
        (
            Convergence::NotAsymptotic,
            "not in the asymptotic range (no order between half and twice the expected one), not extrapolated",
        ),
        (
            Convergence::TwoLevels,
            "two levels cannot show convergence; the whole difference between them is taken for the error of the finer one, twice that for the coarser",
        ),
    ];
    let said = said.map(|(convergence, why)| (of(convergence), why)).into_iter();
    let said = said.filter(|(names, _)| !names.is_empty()).map(|(names, why)| format!("{names}: {why}"));
    said.collect::<Vec<_>>().join("\n")
}

/// Whether a number is ever anything but zero.
fn happens(reference: &Reference, quantity: Quantity) -> bool {
    reference.of(quantity).iter().flatten().any(|value| *value != [0.0; 2])
}

/// One sentence: what to choose for each accuracy, and why another study may choose otherwise; `ny_over_nx` is the shape of its grids.
pub fn choice(
    advice: &[Advice],
    reference: &Reference,
    resolutions: &Resolutions,
    (dimension, ny_over_nx): (Dimension, f64),
) -> String {
    let [cells, increments] = [resolutions.cells.len() > 1, resolutions.increments.len() > 1];
    let each = advice.iter().map(|advice| {
        let percent = format!("for {} % ", 100.0 * advice.accuracy);
        let grid = advice.cells.map(|nx| {
            let ny = (nx as f64 * ny_over_nx).round().max(1.0) as usize;
            format!("{} cells", dimension.written([nx, ny]))
        });
        let steps = advice.increments.map(|count| counted(count, "increment") + " per stage or cycle");
        let chosen: Vec<String> = [(cells, grid, "cells"), (increments, steps, "increments")]
            .into_iter()
            .filter(|(varied, ..)| *varied)
            .map(|(_, choice, what)| choice.unwrap_or_else(|| format!("{what} not determined by this study")))
            .collect();
        let beyond = if advice.concluded { " (extrapolated, not computed)" } else { "" };
        format!("{percent}{}{beyond}", chosen.join(" and "))
    });
    if cells || increments {
        let open = advice.iter().any(|advice| cells && advice.cells.is_none());
        let more = if open { " Finer grids determine the cells: --cells with larger numbers." } else { "" };
        let of = |wanted: Convergence| {
            names(dimension, |quantity| {
                reference.convergence(quantity) == Some(wanted)
                    && (wanted == Convergence::NoLimit || happens(reference, quantity))
            })
        };
        let mut why = String::new();
        let [unbounded, outside] = [Convergence::NoLimit, Convergence::NotAsymptotic].map(of);
        if !unbounded.is_empty() {
            why += &format!(" The {unbounded} is left out: it has no limit.");
        }
        if !outside.is_empty() {
            why += &format!(
                " For {outside} the finest level stands in for the limit, since the levels are not in the asymptotic range: a study \
                 with finer levels may choose otherwise."
            );
        }
        format!("Choose {}.{more}{why}", each.collect::<Vec<_>>().join("; "))
    } else {
        "Nothing to choose: the study has neither two grids nor two numbers of increments.".to_owned()
    }
}
