//! What a study teaches: which levels are worth their time, and what to choose for an accuracy.

use serde::{Deserialize, Serialize};

use super::errors::between;
use super::level::Level;
use super::quantities::{PerQuantity, Quantity};
use super::reference::{Reference, has_order};
use super::resolutions::{Kind, Place, Resolutions};
use crate::case::check::MOST_CELLS;

/// Cells and increments for an accuracy of every quantity of interest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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
/// Least order that is extrapolated.
const LEAST_ORDER: f64 = 0.2;
/// Scatter of an area over the cells in its radius: an oval laid on a lattice covers a number of its points that differs from its
/// area by the root of its radius in the mean square, relative to the area by this power (D. G. Kendall 1948, On the number of
/// lattice points inside a random oval).
const SCATTER: f64 = 1.5;

/// Numbers of cells and increments whose errors each take half of `accuracy`. Cells are judged by the reference, increments by
/// their own limit at the most cells, so that the error of the cells does not hide in it.
pub fn advice<'a>(
    resolutions: &Resolutions,
    level: &impl Fn(Place) -> Option<&'a Level>,
    judged: &impl Fn(Place) -> Option<PerQuantity<Option<f64>>>,
    accuracy: f64,
) -> Advice {
    let cells_line = resolutions.line(Kind::Cells);
    let increments_line = resolutions.line(Kind::Increments);
    let alone = limit_of_increments(resolutions, level);
    let by_increments = |place: &Place| Some(between(alone.as_ref()?, level(*place)?));
    let cells = choose(
        &cells_line.iter().map(|[i, ..]| resolutions.cells[*i][0]).collect::<Vec<_>>(),
        &cells_line.iter().map(|place| judged(*place).unwrap_or_default()).collect::<Vec<_>>(),
        Kind::Cells,
        accuracy / 2.0,
    );
    let increments = choose(
        &increments_line
            .iter()
            .map(|[_, j, _]| resolutions.refined(*j).max().unwrap_or(1))
            .collect::<Vec<_>>(),
        &increments_line.iter().map(|place| by_increments(place).unwrap_or_default()).collect::<Vec<_>>(),
        Kind::Increments,
        accuracy / 2.0,
    );
    Advice {
        accuracy,
        cells: cells.map(|choice| choice.count),
        increments: increments.map(|choice| choice.count),
        concluded: cells.iter().chain(&increments).any(|choice| choice.is_beyond),
    }
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

/// A count, and whether it lies beyond those of the study.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Choice {
    count: usize,
    is_beyond: bool,
}

/// The smallest count from which on the errors of every quantity stay within a bound; `None` when one of them is not seen to get
/// there. `errors` of the counts from coarse to fine.
fn choose(counts: &[usize], errors: &[PerQuantity<Option<f64>>], kind: Kind, bound: f64) -> Option<Choice> {
    let known = |quantity: &Quantity| errors.iter().any(|errors| errors[*quantity as usize].is_some());
    let of = |quantity: Quantity| {
        let errors: Vec<Option<f64>> = errors.iter().map(|errors| errors[quantity as usize]).collect();
        let converges = has_order(quantity, kind) && errors.last().is_some_and(Option::is_some);
        if converges { by_order(counts, &errors, kind, bound) } else { by_scatter(counts, &errors, bound) }
    };
    let choices: Option<Vec<Choice>> = Quantity::ALL.into_iter().filter(known).map(of).collect();
    choices?.into_iter().max_by_key(|choice| choice.count)
}

/// The choice for errors that converge: within the counts as it was seen, beyond them from the order of the last two, at most the second.
/// Cells are rounded up to eights; increments to what divides all counts, since the rows of tables must.
fn by_order(counts: &[usize], errors: &[Option<f64>], kind: Kind, bound: f64) -> Option<Choice> {
    if let Some(count) = within(counts, errors, bound) {
        return Some(Choice { count, is_beyond: false });
    }
    let [.., (n0, Some(e0)), (n1, Some(e1))] =
        counts.iter().zip(errors.iter().copied()).collect::<Vec<_>>()[..]
    else {
        return None;
    };
    let order = (e0 / e1).ln() / (*n1 as f64 / *n0 as f64).ln();
    if !(order.is_finite() && order > LEAST_ORDER) {
        return None;
    }
    let wanted = *n1 as f64 * (e1 / bound).powf(order.min(2.0).recip());
    if wanted > FARTHEST * *n1 as f64 {
        return None;
    }
    let (step, most) = match kind {
        Kind::Increments => (counts.iter().copied().fold(0, divisor), usize::MAX),
        _ => (8, MOST_CELLS),
    };
    let count = (wanted / step as f64).ceil() as usize * step;
    (count <= most).then_some(Choice { count, is_beyond: true })
}

/// The greatest common divisor.
fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// The choice for errors that scatter, and for those of a quantity whose finest level is its own reference: a count may be right by
/// chance, so it also answers for the error of the one before, less what finer cells take off its scatter. Nothing is extrapolated.
fn by_scatter(counts: &[usize], errors: &[Option<f64>], bound: f64) -> Option<Choice> {
    let answered: Vec<Option<f64>> = (0..counts.len())
        .map(|k| {
            let before = k.checked_sub(1).and_then(|before| {
                Some(errors[before]? * (counts[before] as f64 / counts[k] as f64).powf(SCATTER))
            });
            [errors[k], before].into_iter().flatten().reduce(f64::max)
        })
        .collect();
    within(counts, &answered, bound).map(|count| Choice { count, is_beyond: false })
}

/// The smallest count from which on errors stay within a bound.
fn within(counts: &[usize], errors: &[Option<f64>], bound: f64) -> Option<usize> {
    let good = errors.iter().rev().take_while(|error| error.is_some_and(|error| error <= bound)).count();
    (good > 0).then(|| counts[counts.len() - good])
}

/// Which of some levels are efficient: none takes less and is closer. Points are what a level takes, as work or time, and its error.
pub fn frontier(points: &[(f64, Option<f64>)]) -> Vec<bool> {
    let is_beaten = |(takes, error): (f64, f64)| {
        points.iter().any(|(other_takes, other)| {
            other.is_some_and(|other| {
                *other_takes <= takes && other <= error && (*other_takes < takes || other < error)
            })
        })
    };
    points.iter().map(|(takes, error)| error.is_some_and(|error| !is_beaten((*takes, error)))).collect()
}

#[cfg(test)]
mod tests {
    use super::{Choice, by_order, choose, frontier};
    use crate::study::quantities::Quantity;
    use crate::study::resolutions::Kind;

    #[test]
    fn the_frontier_holds_what_nothing_beats() {
        let points = [(1.0, Some(0.1)), (2.0, Some(0.2)), (3.0, Some(0.01)), (3.0, Some(0.02)), (4.0, None)];
        assert_eq!(frontier(&points), [true, false, true, false, false]);
    }

    #[test]
    fn counts_are_chosen_from_those_of_the_study_and_concluded_beyond_them() {
        let counts = [16, 32, 64];
        let errors = [Some(0.04), Some(0.01), Some(0.0025)];
        let seen = |count| Some(Choice { count, is_beyond: false });
        assert_eq!(by_order(&counts, &errors, Kind::Cells, 0.01), seen(32));
        let beyond = Some(Choice { count: 128, is_beyond: true });
        assert_eq!(by_order(&counts, &errors, Kind::Cells, 0.0025 / 4.0), beyond); // second order
        assert_eq!(by_order(&counts, &errors, Kind::Cells, 1e-7), None); // 10119 cells: too far from 64
        assert_eq!(by_order(&counts, &[Some(0.01), Some(0.001), Some(0.02)], Kind::Cells, 0.01), None);
        assert_eq!(by_order(&counts, &[Some(0.01), Some(0.01), Some(0.01)], Kind::Cells, 0.005), None); // no order
        // a table of five rows takes 5, 10, 15 ... increments; 4096 times three cells is still a grid, times five not
        let rows = by_order(&[5, 10, 20], &errors, Kind::Increments, 0.0025 / 1.5);
        assert_eq!(rows, Some(Choice { count: 25, is_beyond: true }));
        let large = [1024, 2048, 4096];
        let count = |bound: f64| by_order(&large, &errors, Kind::Cells, bound).map(|choice| choice.count);
        assert_eq!(count(0.0025 / 9.0), Some(3 * 4096));
        assert_eq!(count(0.0025 / 25.0), None);
    }

    /// The area of 32 cells is right by chance (as that of a coated sphere is: 5e-7 between 1e-3 and 1e-4): no order of 11, and no
    /// count for what its neighbours miss.
    #[test]
    fn an_area_that_is_right_by_chance_is_neither_trusted_nor_extrapolated() {
        let counts = [16, 32, 64];
        let area = Quantity::ContactArea as usize;
        let of = |areas: [f64; 3]| {
            areas.map(|error| {
                let mut errors = [None; Quantity::ALL.len()];
                errors[Quantity::MaxPressure as usize] = Some(1e-9);
                errors[area] = Some(error);
                errors
            })
        };
        let chance = of([1e-3, 1.1e-3, 5e-7]);
        assert_eq!(choose(&counts, &chance, Kind::Cells, 5e-5), None); // 1.1e-3 / 2^1.5 is not within it
        assert_eq!(choose(&counts, &chance, Kind::Cells, 5e-4), Some(Choice { count: 64, is_beyond: false }));
        assert_eq!(choose(&counts, &of([4e-2, 1e-2, 2.5e-3]), Kind::Cells, 1e-3), None);
        // What increments change on one grid has an order.
        let beyond = Some(Choice { count: 128, is_beyond: true });
        assert_eq!(choose(&counts, &of([4e-2, 1e-2, 2.5e-3]), Kind::Increments, 2.5e-3 / 4.0), beyond);
    }

    /// A quantity whose finest level is its own reference: the error of that level is not zero but unknown.
    #[test]
    fn a_level_that_is_its_own_reference_answers_for_the_one_before() {
        let counts = [16, 32, 64];
        let mut errors = [[None; Quantity::ALL.len()]; 3];
        for (errors, shift) in errors.iter_mut().zip([Some(1e-3), Some(1e-3), None]) {
            errors[Quantity::Shift as usize] = shift;
        }
        assert_eq!(choose(&counts, &errors, Kind::Cells, 1e-4), None);
        assert_eq!(choose(&counts, &errors, Kind::Cells, 4e-4), Some(Choice { count: 64, is_beyond: false }));
    }
}
