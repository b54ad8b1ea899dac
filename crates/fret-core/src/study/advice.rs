//! What a study teaches: which levels are worth their time, and what to choose for an accuracy.

use serde::Serialize;

use super::errors::{Errors, Form};
use super::level::Level;
use super::quantities::Quantity;
use super::reference::Reference;
use super::resolutions::{Kind, Place, Resolutions};

/// Cells and increments for an accuracy of every quantity of interest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Advice {
    /// The accuracy, relative.
    pub accuracy: f64,
    /// Cells along x; `None`: no number of them was seen to lead there.
    pub cells: Option<usize>,
    /// Increments of a stage or a cycle; `None`: no number of them was seen to lead there.
    pub increments: Option<usize>,
    /// Whether one of them lies beyond the study and is concluded from its order.
    pub concluded: bool,
}

/// Beyond so many times the finest count nothing is concluded.
const FARTHEST: f64 = 8.0;

/// Numbers of cells and increments whose errors each take half of `accuracy`. Cells are judged by the reference, increments by
/// their own limit at the most cells, so that the error of the cells does not hide in it.
pub fn advice<'a>(
    resolutions: &Resolutions,
    level: &impl Fn(Place) -> Option<&'a Level>,
    judged: &impl Fn(Place) -> Option<Errors>,
    accuracy: f64,
) -> Advice {
    let cells_line = resolutions.line(Kind::Cells);
    let increments_line = resolutions.line(Kind::Increments);
    let worst = |place: Place| judged(place).and_then(|errors| errors.worst(Form::Between));
    let alone = limit_of_increments(resolutions, level);
    let by_increments =
        |place: Place| super::errors::errors(alone.as_ref()?, level(place)?, None).worst(Form::Between);
    let (cells, beyond_cells) = choose(
        &cells_line.iter().map(|[i, ..]| resolutions.cells[*i][0]).collect::<Vec<_>>(),
        &cells_line.iter().map(|place| worst(*place)).collect::<Vec<_>>(),
        accuracy / 2.0,
        judged(resolutions.finest()).is_some_and(|errors| areas(&errors) > accuracy / 2.0),
    );
    let (increments, beyond_increments) = choose(
        &increments_line.iter().map(|[_, j, _]| largest(&resolutions.increments[*j])).collect::<Vec<_>>(),
        &increments_line.iter().map(|place| by_increments(*place)).collect::<Vec<_>>(),
        accuracy / 2.0,
        false,
    );
    Advice { accuracy, cells, increments, concluded: beyond_cells || beyond_increments }
}

fn largest(counts: &[usize]) -> usize {
    counts.iter().copied().max().unwrap_or(1)
}

/// The limit along the increments alone, at the most cells.
fn limit_of_increments<'a>(
    resolutions: &Resolutions,
    level: &impl Fn(Place) -> Option<&'a Level>,
) -> Option<Reference> {
    let [i, _, k] = resolutions.finest();
    let alone = Resolutions {
        cells: vec![resolutions.cells[i]],
        increments: resolutions.increments.clone(),
        tolerances: vec![resolutions.tolerances[k]],
    };
    Reference::limit(&alone, &|[_, j, _]: Place| level([i, j, k]))
}

/// Largest error of the areas. Their error over the cells has no order: it depends on where the edge lies between cell centres.
fn areas(errors: &Errors) -> f64 {
    let of = |quantity: Quantity| errors.of(Form::Between)[quantity as usize].unwrap_or(0.0);
    of(Quantity::ContactArea).max(of(Quantity::StickArea))
}

/// The smallest count from which on the errors stay within a bound. Beyond the counts it is extrapolated from the order of the last
/// two, unless the errors are `without_order`.
fn choose(
    counts: &[usize],
    errors: &[Option<f64>],
    bound: f64,
    without_order: bool,
) -> (Option<usize>, bool) {
    let within = |error: &Option<f64>| error.is_some_and(|error| error <= bound);
    let good = errors.iter().rev().take_while(|error| within(error)).count();
    if good > 0 {
        return (Some(counts[counts.len() - good]), false);
    }
    if without_order {
        return (None, false);
    }
    let [.., (n0, Some(e0)), (n1, Some(e1))] =
        counts.iter().zip(errors.iter().copied()).collect::<Vec<_>>()[..]
    else {
        return (None, false);
    };
    let order = (e0 / e1).ln() / (*n1 as f64 / *n0 as f64).ln();
    if !(order.is_finite() && order > 0.2) {
        return (None, false);
    }
    let wanted = *n1 as f64 * (e1 / bound).powf(order.min(2.0).recip());
    let is_near = wanted <= FARTHEST * *n1 as f64;
    (is_near.then(|| (wanted / 8.0).ceil() as usize * 8), is_near)
}

/// Which of some levels are efficient: none is both quicker and closer. Points are time and error.
pub fn frontier(points: &[(f64, Option<f64>)]) -> Vec<bool> {
    let is_beaten = |(time, error): (f64, f64)| {
        points.iter().any(|(other_time, other)| {
            other.is_some_and(|other| {
                *other_time <= time && other <= error && (*other_time < time || other < error)
            })
        })
    };
    points.iter().map(|(time, error)| error.is_some_and(|error| !is_beaten((*time, error)))).collect()
}

#[cfg(test)]
mod tests {
    use super::{choose, frontier};

    #[test]
    fn the_frontier_holds_what_nothing_beats() {
        let points = [(1.0, Some(0.1)), (2.0, Some(0.2)), (3.0, Some(0.01)), (3.0, Some(0.02)), (4.0, None)];
        assert_eq!(frontier(&points), [true, false, true, false, false]);
    }

    #[test]
    fn counts_are_chosen_from_the_ladder_and_concluded_beyond_it() {
        let counts = [16, 32, 64];
        let errors = [Some(0.04), Some(0.01), Some(0.0025)];
        assert_eq!(choose(&counts, &errors, 0.01, false), (Some(32), false));
        assert_eq!(choose(&counts, &errors, 0.0025 / 4.0, false), (Some(128), true)); // second order
        assert_eq!(choose(&counts, &errors, 1e-7, false), (None, false)); // 10119 cells: too far from 64
        assert_eq!(choose(&counts, &errors, 0.01, true), (Some(32), false)); // seen, not extrapolated
        assert_eq!(choose(&counts, &errors, 0.0025 / 4.0, true), (None, false));
        assert_eq!(choose(&counts, &[Some(0.01), Some(0.001), Some(0.02)], 0.01, false), (None, false));
    }
}
