//! How a run is followed on standard error: a live bar for a person, plain lines for a log, nothing when nobody wants it.
//! An increment is called by its number in the whole history, from 0, as in all files.

use std::time::{Duration, Instant};

use fret_core::case::printable;
use fret_core::history::{CycleRecord, StepRecord};
use fret_core::run::Iteration;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::figures::{duration, shortened};
use crate::manner::{Manner, increment_line};
use crate::terminal;
use fret_results::Tally;

/// The bar's second line is not written anew more often than this.
const LIVE_PAUSE: Duration = Duration::from_millis(60);
/// Plain lines come no more often than this, except at the end of a stage and at every tenth of the run.
const PLAIN_PAUSE: Duration = Duration::from_secs(2);
/// Later the pauses grow with the run: this share of the time it has taken.
const PLAIN_PAUSE_SHARE: f64 = 0.05;
/// Letters of the title that stand before the bar.
const TITLE_LETTERS: usize = 24;

/// A face for the run.
#[derive(Debug)]
pub struct Progress {
    /// For a person at a terminal; otherwise it is hidden.
    bar: ProgressBar,
    is_live: bool,
    /// Whether there are lines in its place.
    is_plain: bool,
    /// Planned increments.
    increments: usize,
    /// Planned increments that were behind the run before it went on.
    passed_before: usize,
    started: Instant,
    last_shown: Instant,
    tenths: usize,
    /// Whether every increment has its line.
    tells_all: bool,
}

impl Progress {
    /// The face that fits: quiet when asked for, live for a terminal, plain otherwise.
    pub fn new(manner: &Manner, title: &str, tally: &Tally) -> Self {
        let (increments, passed_before) = (tally.advance.planned(), tally.advance.passed());
        let (is_live, now) = (!manner.quiet && terminal::is_watched(), Instant::now());
        Self {
            bar: if is_live { live_bar(title, increments, passed_before) } else { ProgressBar::hidden() },
            is_live,
            is_plain: !manner.quiet && !is_live,
            increments,
            passed_before,
            started: now,
            last_shown: now,
            tenths: passed_before * 10 / increments.max(1),
            tells_all: manner.verbose,
        }
    }

    /// An iteration was done.
    pub fn iterated(&mut self, iteration: &Iteration, tally: &Tally) {
        let pause = if self.is_live { LIVE_PAUSE } else { self.plain_pause() };
        if !(self.is_live || self.is_plain) || self.last_shown.elapsed() < pause {
            return;
        }
        self.last_shown = Instant::now();
        let stage = tally.stages.get(iteration.stage).map_or("", |stage| stage.name.as_str());
        let stage = shortened(stage, TITLE_LETTERS);
        let standing = format!(
            "{stage}  iteration {}  residual {:.1e} (goal {:.1e})",
            iteration.iteration, iteration.residual, iteration.tolerance
        );
        if self.is_live {
            self.bar.set_message(printable(&standing).into_owned());
        } else {
            self.line(&format!("increment {:>1$}  {standing}", iteration.increment, self.width()));
        }
    }

    /// An increment is solved and counted.
    pub fn solved(&mut self, record: &StepRecord, tally: &Tally) {
        let passed = tally.advance.passed();
        self.bar.set_position(passed as u64);
        let stage = tally.stages.get(record.stage);
        let ends_stage = stage.is_some_and(|stage| stage.last == record.increment);
        let tenths = passed * 10 / self.increments.max(1);
        let due = tenths > self.tenths || self.last_shown.elapsed() >= self.plain_pause();
        if !(ends_stage || self.tells_all || (self.is_plain && due)) {
            return;
        }
        self.tenths = tenths;
        self.last_shown = Instant::now();
        let name = shortened(stage.map_or("", |stage| stage.name.as_str()), TITLE_LETTERS);
        let place = format!("  {name}{}", if ends_stage { " done" } else { "" });
        let line = increment_line(record, self.width(), &place);
        self.line(&format!("{line}  {}, {}", self.counts(tally), self.time(passed)));
    }

    /// A cycle is over, and counted, with those it stands for.
    pub fn cycled(&mut self, record: &CycleRecord, tally: &Tally) {
        let passed = tally.advance.passed();
        self.bar.set_position(passed as u64);
        let tenths = passed * 10 / self.increments.max(1);
        if tenths > self.tenths && (record.stands_for > 1 || record.steady) {
            self.tenths = tenths;
            let name = tally.stages.get(record.stage).map_or("", |stage| stage.name.as_str());
            self.line(&format!(
                "cycle {}  {}  {}, {}",
                record.cycle,
                shortened(name, TITLE_LETTERS),
                self.counts(tally),
                self.time(passed)
            ));
        }
    }

    /// How many increments are solved, and of how many.
    fn counts(&self, tally: &Tally) -> String {
        let passed = tally.advance.passed();
        if passed == tally.solved {
            format!("{passed} of {} solved", self.increments)
        } else {
            format!("{} solved for {passed} of {}", tally.solved, self.increments)
        }
    }

    /// The run is over, in whatever way: the terminal belongs to others again.
    pub fn end(&self) {
        self.bar.finish_and_clear();
    }

    fn line(&self, text: &str) {
        if self.is_plain {
            terminal::say(text);
        } else {
            self.bar.println(printable(text)); // which a hidden one does not
        }
    }

    /// Digits of an increment's number.
    fn width(&self) -> usize {
        self.increments.saturating_sub(1).to_string().len()
    }

    /// Time gone, and left by the planned increments that went in it.
    fn time(&self, passed: usize) -> String {
        let elapsed = self.started.elapsed().as_secs_f64();
        let done = passed.saturating_sub(self.passed_before).max(1);
        let left = elapsed * self.increments.saturating_sub(passed) as f64 / done as f64;
        if passed < self.increments {
            format!("{}, about {} left", duration(elapsed), duration(left))
        } else {
            duration(elapsed)
        }
    }

    fn plain_pause(&self) -> Duration {
        PLAIN_PAUSE.max(self.started.elapsed().mul_f64(PLAIN_PAUSE_SHARE))
    }
}

fn live_bar(title: &str, increments: usize, passed: usize) -> ProgressBar {
    let colour = if terminal::errors_in_colour() { ":.cyan/dim" } else { "" };
    let template = format!(
        "{{prefix}}  {{wide_bar{colour}}} {{pos}}/{{len}}  {{elapsed_precise}} < {{eta_precise}}\n  {{spinner}} {{msg}}"
    );

    // The template is ours; if it were ever wrong, indicatif's own style serves as well.
    let style = ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::with_draw_target(Some(increments as u64), ProgressDrawTarget::stderr())
        .with_style(style.progress_chars("━╸─"))
        .with_prefix(shortened(&printable(title), TITLE_LETTERS));
    bar.set_position(passed as u64);
    bar.reset_eta();
    bar.set_message("preparing the operators");
    bar.enable_steady_tick(Duration::from_millis(120));
    bar
}
