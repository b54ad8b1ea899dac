//! A ladder solved and judged: errors, observed orders and the efficient rungs of every line, and what they teach.

use serde::Serialize;

use super::advice::{Advice, advice, frontier};
use super::errors::{Errors, Form, errors, orders};
use super::ladder::{Kind, Ladder, Place};
use super::rung::Rung;
use super::truth::Truth;

/// A solved ladder. Rungs that could not be solved are missing; without the finest one there is nothing to judge by.
#[derive(Debug, Clone)]
pub struct Climb {
    ladder: Ladder,
    rungs: Vec<(Place, Rung)>,
}

/// A rung as a table shows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judged {
    /// Its place in the ladder.
    pub place: Place,
    /// Its errors.
    pub errors: Errors,
    /// Orders its headline numbers, read between the cells, show against the rung before it in the line.
    pub orders: [Option<f64>; 6],
    /// The same of pressure and shear in the mean square.
    pub field_orders: [Option<f64>; 2],
    /// Whether no rung of the ladder is both quicker and closer, by the worst headline number in the order of [`Form::ALL`].
    pub is_efficient: [bool; 3],
}

/// The rungs of one kind of refinement, from coarse to fine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// What is refined.
    pub kind: Kind,
    /// Its rungs.
    pub rungs: Vec<Judged>,
}

impl Climb {
    /// A ladder with the rungs that were solved.
    pub fn new(ladder: Ladder, rungs: Vec<(Place, Rung)>) -> Self {
        Self { ladder, rungs }
    }

    /// The ladder.
    pub fn ladder(&self) -> &Ladder {
        &self.ladder
    }

    /// The rung at a place.
    pub fn rung(&self, place: Place) -> Option<&Rung> {
        self.rungs.iter().find(|(at, _)| *at == place).map(|(_, rung)| rung)
    }

    /// The finest rung.
    pub fn finest(&self) -> Option<&Rung> {
        self.rung(self.ladder.finest())
    }

    /// What the ladder is heading for; `None` without its finest rung.
    pub fn limit(&self) -> Option<Truth> {
        Truth::limit(&self.ladder, &|place| self.rung(place))
    }

    /// The rung of the next fewer cells, which an extrapolation also needs.
    pub fn coarser(&self, [i, j, k]: Place) -> Option<&Rung> {
        let i = i.checked_sub(1)?;
        self.rung([i, j, k]).or_else(|| self.rung([i, j.checked_sub(1)?, k]))
    }

    /// Time a form of a rung takes [s]: an extrapolation pays for the coarser rung too.
    pub fn seconds(&self, place: Place, form: Form) -> Option<f64> {
        let own = self.rung(place)?.wall_s;
        match form {
            Form::Plain | Form::Between => Some(own),
            Form::Extrapolated => Some(own + self.coarser(place)?.wall_s),
        }
    }

    /// Errors of the rung at a place.
    pub fn errors(&self, truth: &Truth, place: Place) -> Option<Errors> {
        Some(errors(truth, self.rung(place)?, self.coarser(place)))
    }

    /// The lines of the ladder judged by `truth`.
    pub fn judged(&self, truth: &Truth) -> Vec<Line> {
        let all: Vec<(Place, Errors)> = self
            .rungs
            .iter()
            .map(|(place, rung)| (*place, errors(truth, rung, self.coarser(*place))))
            .collect();
        let efficient = Form::ALL.map(|form| {
            let point = |(place, errors): &(Place, Errors)| {
                (self.seconds(*place, form).unwrap_or(f64::INFINITY), errors.worst(form))
            };
            frontier(&all.iter().map(point).collect::<Vec<_>>())
        });
        let line = |kind: Kind| {
            let places: Vec<Place> = self.ladder.line(kind);
            let solved: Vec<usize> =
                places.iter().filter_map(|place| all.iter().position(|(at, _)| at == place)).collect();
            let counts: Vec<f64> = solved.iter().map(|k| self.count(kind, all[*k].0)).collect();
            let along = |error: &dyn Fn(&Errors) -> Option<f64>| {
                orders(&counts, &solved.iter().map(|k| error(&all[*k].1)).collect::<Vec<_>>())
            };
            let of_numbers: [_; 6] = std::array::from_fn(|number| along(&|errors| errors.between[number]));
            let of_fields = [along(&|errors| errors.pressure), along(&|errors| errors.shear)];
            let judged = |(row, k): (usize, &usize)| Judged {
                place: all[*k].0,
                errors: all[*k].1,
                orders: std::array::from_fn(|number| of_numbers[number][row]),
                field_orders: [0, 1].map(|field| of_fields[field][row]),
                is_efficient: [0, 1, 2].map(|form| efficient[form][*k]),
            };
            Line { kind, rungs: solved.iter().enumerate().map(judged).collect() }
        };
        Kind::ALL.into_iter().map(line).filter(|line| line.rungs.len() > 1).collect()
    }

    /// What to choose for an accuracy of every headline number.
    pub fn advice(&self, truth: &Truth, accuracy: f64) -> Advice {
        advice(&self.ladder, &|place| self.rung(place), &|place| self.errors(truth, place), accuracy)
    }

    /// What an order is counted in: cells along x, increments of all stages, the inverse of the tolerance.
    fn count(&self, kind: Kind, [i, j, k]: Place) -> f64 {
        match kind {
            Kind::Cells | Kind::Together => self.ladder.cells[i][0] as f64,
            Kind::Increments => self.ladder.increments[j].iter().sum::<usize>() as f64,
            Kind::Tolerance => self.ladder.tolerances[k].recip(),
        }
    }
}
