//! What a study says in words: what it was compared with, and what to choose.

use fret_core::model::Dimension;
use fret_core::model::stage::Stage;
use fret_core::study::{Advice, Convergence, Quantity, Reference, Source};

use crate::figures::counted;

/// Why a study shows no errors.
pub const NO_ERRORS: &str = "no errors: no closed form is available for this case, and a single level cannot be compared \
                             with a finer one; give more levels, as in --cells 32,64,128, or numbers with --against FILE";

/// Why a largest pressure has no limit.
pub const GROWS: &str = "it grows with the number of cells at a sharp edge, a tip or a crease";

/// A quantity of interest in words.
pub fn name(quantity: Quantity, dimension: Dimension) -> &'static str {
    match (quantity, dimension) {
        (Quantity::MaxPressure, _) => "max pressure",
        (Quantity::Approach, _) => "approach",
        (Quantity::ContactArea, Dimension::Plane) => "contact area",
        (Quantity::ContactArea, Dimension::Line) => "contact width",
        (Quantity::StickArea, Dimension::Plane) => "stick area",
        (Quantity::StickArea, Dimension::Line) => "stick width",
        (Quantity::Shift, _) => "shift",
        (Quantity::DissipatedEnergy, _) => "dissipated energy",
        (Quantity::Creepage, _) => "creepage",
        (Quantity::Spin, _) => "spin",
        (Quantity::RollingFriction, _) => "rolling friction",
        (Quantity::MaxWornDepth, _) => "max worn depth",
        (Quantity::WornVolume, _) => "worn volume",
    }
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
        let numbers: Vec<&str> = Quantity::ALL
            .into_iter()
            .filter(|quantity| reference.source(*quantity) == Some(source) && shown(*quantity))
            .filter(|quantity| {
                source != Source::Limit || reference.convergence(*quantity) != Some(Convergence::TwoLevels)
            })
            .map(|quantity| name(quantity, dimension))
            .collect();
        (!numbers.is_empty()).then(|| format!("{} compared with {words}", numbers.join(", ")))
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
        let is_one = |quantity: &Quantity| {
            let is_told = convergence == Convergence::NoLimit || shown(*quantity);
            reference.convergence(*quantity) == Some(convergence) && is_told
        };
        let names: Vec<&str> =
            Quantity::ALL.into_iter().filter(is_one).map(|quantity| name(quantity, dimension)).collect();
        (!names.is_empty()).then(|| names.join(", "))
    };
    let mut said = Vec::new();
    if let Some(names) = of(Convergence::NoLimit) {
        said.push(format!("{names}: no limit, {GROWS}; no error is told"));
    }
    if let Some(names) = of(Convergence::NotAsymptotic) {
        said.push(format!("{names}: not in the asymptotic range (no order between half and twice the expected one), not extrapolated"));
    }
    if let Some(names) = of(Convergence::TwoLevels) {
        said.push(format!(
            "{names}: two levels cannot show convergence; the whole difference between them is taken for the error of the finer one, twice that for the coarser"
        ));
    }
    said.join("\n")
}

/// Whether a number is ever anything but zero.
fn happens(reference: &Reference, quantity: Quantity) -> bool {
    reference.of(quantity).iter().flatten().any(|value| *value != [0.0; 2])
}

/// One sentence: what to choose for each accuracy, and why another study may choose otherwise. `cells` and `increments` tell which of them the study has several of, and
/// `ny_over_nx` the shape of its grids.
pub fn choice(
    advice: &[Advice],
    reference: &Reference,
    cells: bool,
    increments: bool,
    (dimension, ny_over_nx): (Dimension, f64),
) -> String {
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
        let is_one = |wanted: Convergence| {
            move |quantity: &Quantity| {
                reference.convergence(*quantity) == Some(wanted)
                    && (wanted == Convergence::NoLimit || happens(reference, *quantity))
            }
        };
        let names = |wanted| {
            let all = Quantity::ALL.into_iter().filter(is_one(wanted));
            all.map(|quantity| name(quantity, dimension)).collect::<Vec<_>>().join(", ")
        };
        let mut why = String::new();
        let [unbounded, outside] = [Convergence::NoLimit, Convergence::NotAsymptotic].map(names);
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
