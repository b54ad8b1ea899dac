//! What the points of a sweep have in common, solved once.

use std::sync::atomic::{AtomicUsize, Ordering};

use fret_core::history::History;
use fret_core::run::{self, Observer, RunError, Simulation};
use pyo3::prelude::{pyclass, pymethods};

/// What histories with numbers and the names of their beginnings have in common.
#[pyclass(frozen, module = "fretting._core")]
pub struct InCommon {
    common: run::InCommon,
    increments: AtomicUsize,
}

impl InCommon {
    /// Solves one of the histories.
    pub fn solve(
        &self,
        number: usize,
        simulation: Simulation<'_>,
        observer: &mut dyn Observer,
    ) -> (History, Result<(), RunError>) {
        let (history, outcome, increments) = self.common.solve(number, simulation, observer);
        self.increments.fetch_add(increments, Ordering::Relaxed);
        (history, outcome)
    }
}

#[pymethods]
impl InCommon {
    #[new]
    fn new(histories: Vec<(usize, Vec<String>)>) -> Self {
        Self { common: run::InCommon::of(&histories), increments: AtomicUsize::new(0) }
    }

    /// Increments that histories solved so far took from common beginnings.
    fn increments(&self) -> usize {
        self.increments.load(Ordering::Relaxed)
    }
}
