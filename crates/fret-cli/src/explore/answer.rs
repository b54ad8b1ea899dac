//! A case solved for the numbers of the sliders, and answered: loop, section, zones, pressure; the stress below when it is asked for.

use std::time::Instant;

use fret_core::run::{InCommon, Simulation};
use rayon::ThreadPool;
use serde::Deserialize;
use serde_json::{Value, json};

use super::question::{Question, Values, Written};
use super::view::{Solved, View};
use crate::failure::Failure;
use crate::manner::Listener;

/// What the page asks.
#[derive(Debug, Clone, Deserialize)]
pub struct Asked {
    /// Values of the sliders that were moved.
    #[serde(default)]
    pub values: Values,
    /// Which increment of the loop is shown; without, that of the largest load.
    #[serde(default)]
    pub moment: Option<usize>,
    /// Which case is to be written.
    #[serde(default)]
    pub written: Option<Written>,
}

/// Solves a case again and again; what stays the same from one time to the next is made once.
pub struct Solver {
    question: Question,
    common: InCommon,
    pool: ThreadPool,
    last: Option<Solved>,
}

impl Solver {
    /// Nothing solved yet.
    pub fn new(question: Question, pool: ThreadPool) -> Self {
        Self { question, common: InCommon::default(), pool, last: None }
    }

    /// The case with its sliders.
    pub fn question(&self) -> &Question {
        &self.question
    }

    /// Loop, section, zones, pressure and the numbers that matter.
    ///
    /// # Errors
    /// When the case is refused or cannot be solved.
    pub fn answer(&mut self, asked: &Asked) -> Result<Value, Failure> {
        self.solve(&asked.values)?;
        let Some(solved) = &self.last else { return Err(Failure::Defect("nothing is solved".to_owned())) };
        let view = View::of(solved, asked.moment);
        let drawn = Instant::now();
        let figures = view.figures()?;
        Ok(json!({
            "status": "solved",
            "figures": figures,
            "numbers": view.numbers(),
            "moment": view.moment,
            "moments": view.path.points.len(),
            "raw": view.raw(),
            "solve_s": solved.seconds,
            "draw_s": drawn.elapsed().as_secs_f64(),
        }))
    }

    /// The stress below, and how far it is from yield.
    ///
    /// # Errors
    /// As [`Self::answer`].
    pub fn stress(&mut self, asked: &Asked) -> Result<Value, Failure> {
        self.solve(&asked.values)?;
        let Some(solved) = &self.last else { return Err(Failure::Defect("nothing is solved".to_owned())) };
        let started = Instant::now();
        let view = View::of(solved, asked.moment);
        let (figure, numbers, raw) = self.pool.install(|| view.stress())?;
        Ok(json!({
            "status": "solved",
            "figures": { "stress": figure },
            "numbers": numbers,
            "raw": raw,
            "solve_s": started.elapsed().as_secs_f64(),
        }))
    }

    /// The text of the case with the values, to be kept.
    ///
    /// # Errors
    /// When the case with these values is refused.
    pub fn text(&self, asked: &Asked) -> Result<String, Failure> {
        self.question.text(&asked.values, asked.written.unwrap_or(Written::Own))
    }

    fn solve(&mut self, values: &Values) -> Result<(), Failure> {
        if self.last.as_ref().is_some_and(|last| last.values == *values) {
            return Ok(());
        }
        let started = Instant::now();
        let (history, plan) = self.pool.install(|| {
            let (_, plan) = self.question.shown(values)?;
            let (history, outcome, _) =
                self.common.solve(0, Simulation::new(&plan), &mut Listener::keeping());
            outcome?;
            Ok::<_, Failure>((history, plan))
        })?;
        let seconds = started.elapsed().as_secs_f64();
        self.last = Some(Solved { values: values.clone(), plan, history, seconds });
        Ok(())
    }
}
