//! A study solved and judged: errors, observed orders and the efficient levels of every line, and what they teach.

use serde::Serialize;

use super::advice::{Advice, advice, frontier};
use super::errors::{Errors, Form, between, errors, orders};
use super::level::Level;
use super::quantities::{PerQuantity, Quantity};
use super::reference::{Convergence, Reference, Source, has_order};
use super::resolutions::{Kind, Place, Resolutions};

/// A solved study. Levels that could not be solved are missing; without the finest one there is nothing to judge by.
#[derive(Debug, Clone)]
pub struct RefinementStudy {
    resolutions: Resolutions,
    levels: Vec<(Place, Level)>,
}

/// A level as a table shows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judged {
    /// Its place in the study.
    pub place: Place,
    /// Its errors.
    pub errors: Errors,
    /// Orders its quantities of interest, read between the cells, show against the level before it in the line; areas have none
    /// over the cells, nor has a quantity whose limit was not found from an observed order.
    pub orders: PerQuantity<Option<f64>>,
    /// The same of pressure and shear in the mean square.
    pub field_orders: [Option<f64>; 2],
    /// Whether no level of the study takes less work and is closer, by the worst quantity of interest in the order of [`Form::ALL`].
    pub is_efficient: [bool; 3],
}

/// The levels of one kind of refinement, from coarse to fine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// What is refined.
    pub kind: Kind,
    /// Its levels.
    pub levels: Vec<Judged>,
}

impl RefinementStudy {
    /// A study with the levels that were solved.
    pub fn new(resolutions: Resolutions, levels: Vec<(Place, Level)>) -> Self {
        Self { resolutions, levels }
    }

    /// The study.
    pub fn resolutions(&self) -> &Resolutions {
        &self.resolutions
    }

    /// The level at a place.
    pub fn level(&self, place: Place) -> Option<&Level> {
        self.levels.iter().find(|(at, _)| *at == place).map(|(_, level)| level)
    }

    /// The finest level.
    pub fn finest(&self) -> Option<&Level> {
        self.level(self.resolutions.finest())
    }

    /// What the study is heading for; `None` without its finest level.
    pub fn limit(&self) -> Option<Reference> {
        Reference::limit(&self.resolutions, &|place| self.level(place))
    }

    /// The level of the next fewer cells, which an extrapolation also needs.
    pub fn coarser(&self, [i, j, k]: Place) -> Option<&Level> {
        let i = i.checked_sub(1)?;
        self.level([i, j, k]).or_else(|| self.level([i, j.checked_sub(1)?, k]))
    }

    /// Time a form of a level takes [s]: an extrapolation pays for the coarser level too.
    pub fn seconds(&self, place: Place, form: Form) -> Option<f64> {
        self.spent(place, form, |level| level.wall_s)
    }

    /// The same as work, which is the same whenever it is done: operator applications by the size of their grids, `n log n` of the cells.
    pub fn work(&self, place: Place, form: Form) -> Option<f64> {
        self.spent(place, form, |level| {
            let cells = level.grid.len() as f64;
            level.work.full_grid_convolutions * cells * (4.0 * cells).log2()
        })
    }

    fn spent(&self, place: Place, form: Form, of: impl Fn(&Level) -> f64) -> Option<f64> {
        let own = of(self.level(place)?);
        match form {
            Form::Plain | Form::Between => Some(own),
            Form::Extrapolated => Some(own + of(self.coarser(place)?)),
        }
    }

    /// Errors of the level at a place.
    pub fn errors(&self, reference: &Reference, place: Place) -> Option<Errors> {
        Some(errors(reference, self.level(place)?, self.coarser(place)))
    }

    /// The lines of the study judged by `reference`.
    pub fn judged(&self, reference: &Reference) -> Vec<Line> {
        self.judged_while(reference, || true).unwrap_or_default()
    }

    /// The same, asked before each level whether to go on; `None` where not.
    pub fn judged_while(&self, reference: &Reference, goes_on: impl Fn() -> bool) -> Option<Vec<Line>> {
        let all: Vec<(Place, Errors)> = self
            .levels
            .iter()
            .map(|(place, level)| goes_on().then(|| (*place, errors(reference, level, self.coarser(*place)))))
            .collect::<Option<_>>()?;
        let efficient = Form::ALL.map(|form| {
            let point = |(place, errors): &(Place, Errors)| {
                (self.work(*place, form).unwrap_or(f64::INFINITY), errors.worst(form))
            };
            frontier(&all.iter().map(point).collect::<Vec<_>>())
        });
        let line = |kind: Kind| {
            let places: Vec<Place> = self.resolutions.line(kind);
            let solved: Vec<usize> =
                places.iter().filter_map(|place| all.iter().position(|(at, _)| at == place)).collect();
            let counts: Vec<f64> = solved.iter().map(|k| self.resolutions.count(kind, all[*k].0)).collect();
            let along = |error: &dyn Fn(&Errors) -> Option<f64>| {
                orders(&counts, &solved.iter().map(|k| error(&all[*k].1)).collect::<Vec<_>>())
            };
            let of_numbers = Quantity::ALL.map(|quantity| {
                let is_observed = reference.convergence(quantity) == Some(Convergence::Observed)
                    && has_order(quantity, kind);
                along(&|errors| errors.of_quantity(quantity).filter(|_| is_observed))
            });
            let of_fields = [along(&|errors| errors.pressure), along(&|errors| errors.shear)];
            let judged = |(row, k): (usize, &usize)| Judged {
                place: all[*k].0,
                errors: self.shown(reference, kind, &all[*k]),
                orders: std::array::from_fn(|number| of_numbers[number][row]),
                field_orders: [0, 1].map(|field| of_fields[field][row]),
                is_efficient: [0, 1, 2].map(|form| efficient[form][*k]),
            };
            Line { kind, levels: solved.iter().enumerate().map(judged).collect() }
        };
        Some(Kind::ALL.into_iter().map(line).filter(|line| line.levels.len() > 1).collect())
    }

    /// The errors of a level as its line shows them: without those of quantities that have no order in what the line refines and
    /// whose reference is therefore of the same resolution.
    fn shown(&self, reference: &Reference, kind: Kind, (place, errors): &(Place, Errors)) -> Errors {
        let is_finest =
            self.resolutions.cells[place[0]] == self.resolutions.cells[self.resolutions.finest()[0]];
        let mut shown = *errors;
        for quantity in Quantity::ALL {
            let is_from_study = matches!(reference.source(quantity), Some(Source::Limit | Source::Finest));
            if is_finest && is_from_study && !has_order(quantity, kind) {
                for form in [&mut shown.plain, &mut shown.between, &mut shown.extrapolated] {
                    form[quantity as usize] = None;
                }
            }
        }
        shown
    }

    /// What to choose for an accuracy of every quantity of interest.
    pub fn advice(&self, reference: &Reference, accuracy: f64) -> Advice {
        advice(
            &self.resolutions,
            &|place| self.level(place),
            &|place| Some(between(reference, self.level(place)?)),
            accuracy,
        )
    }
}
