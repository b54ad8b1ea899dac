//! How far the contact of a run has rolled, and what it does by distance rolled.

use fret_core::history::{Column, StepRecord, rolling_columns};

use crate::figures::largest;
use fret_results::Results;

/// Share of the largest number of a unit below which another one is rounding.
const ROUNDING: f64 = 1e-9;

/// The way of a contact that rolls, increment by increment.
#[derive(Debug)]
pub struct Rolled {
    /// Distance along the way [length], positive towards where it rolls first.
    pub distance: Vec<f64>,
    /// Whether it rolls in the increment.
    pub rolls: Vec<bool>,
    /// Columns of rolling that are more than rounding.
    pub columns: Vec<&'static Column<StepRecord>>,
}

impl Rolled {
    /// The way of a run; `None` where nothing rolls.
    pub fn of(results: &Results) -> Option<Self> {
        let table = &results.table;
        let places = table.vectors("roll");
        let start = results.case().start.map_or([0.0; 2], |loads| loads.roll);
        let before = std::iter::once(&start).chain(&places);
        let steps: Vec<[f64; 2]> =
            places.iter().zip(before).map(|(to, from)| [to[0] - from[0], to[1] - from[1]]).collect();
        let rolls: Vec<bool> = steps.iter().map(|step| *step != [0.0; 2]).collect();
        let first = steps.iter().find(|step| **step != [0.0; 2])?;
        let length = first[0].hypot(first[1]);
        let along = |[x, y]: [f64; 2]| (x * first[0] + y * first[1]) / length;
        let largest = |name: &str| largest(table.column(name));
        let of_unit = |unit: &str| {
            let alike = rolling_columns().filter(|(column, _)| column.unit == unit);
            alike.map(|(column, _)| largest(column.name)).fold(0.0, f64::max)
        };
        let is_told = |column: &&Column<StepRecord>| largest(column.name) > ROUNDING * of_unit(column.unit);
        Some(Self {
            distance: places.into_iter().map(along).collect(),
            rolls,
            columns: rolling_columns().map(|(column, _)| column).filter(is_told).collect(),
        })
    }

    /// Values where it rolls; not numbers, which are not drawn, elsewhere.
    pub fn where_it_rolls(&self, values: &[f64]) -> Vec<f64> {
        values.iter().zip(&self.rolls).map(|(value, rolls)| if *rolls { *value } else { f64::NAN }).collect()
    }
}
