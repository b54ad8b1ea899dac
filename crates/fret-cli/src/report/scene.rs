//! A run seen as a whole: which way it was pushed, which increments are worth showing, what theory has to say about it.

use fret_core::case::Units;

use super::closed_form::{NormalForm, TangentialForm, components};
use crate::results::Results;

/// Share of the largest force below which there is none.
const NOTHING: f64 = 1e-9;

/// A run with what the page needs to know about it.
#[derive(Debug)]
pub struct Scene<'a> {
    /// The results.
    pub results: &'a Results,
    /// Direction of the tangential load, when there is any.
    pub direction: Option<[f64; 2]>,
    /// Tangential force of every increment along the direction.
    pub tangential: Vec<f64>,
    /// Shift of every increment along the direction.
    pub shift: Vec<f64>,
    /// The frictionless contact in closed form.
    pub normal_form: Option<NormalForm>,
    /// Partial slip in closed form.
    pub tangential_form: Option<TangentialForm>,
    /// Whether torsion is what moves: its loop of moment and twist is larger than that of force and shift, force times motion.
    pub twists: bool,
    /// Increments of each stage: first, and one after the last.
    pub spans: Vec<[usize; 2]>,
}

/// A cycle of a stage.
#[derive(Debug, Clone, Copy)]
pub struct Cycle {
    /// Its increments: first, and one after the last.
    pub span: [usize; 2],
}

impl<'a> Scene<'a> {
    /// Looks at a run.
    pub fn of(results: &'a Results) -> Self {
        let table = &results.table;
        let direction = direction(results);
        let normal_form = NormalForm::of(results);
        let [tangential, _] = components(results, direction.unwrap_or([1.0, 0.0]));
        let [cosine, sine] = direction.unwrap_or([1.0, 0.0]);
        let shifts = table.column("shift_x").iter().zip(table.column("shift_y"));
        let tangential_form = normal_form
            .as_ref()
            .zip(direction)
            .and_then(|(normal, direction)| TangentialForm::of(results, normal, direction));
        Self {
            results,
            direction,
            tangential,
            shift: shifts.map(|(x, y)| cosine * x + sine * y).collect(),
            normal_form,
            tangential_form,
            twists: twists(results),
            spans: spans(table.column("stage"), results.stages().len()),
        }
    }

    /// The name of an axis with its unit, where the case declares units; `kind` as `force x length`.
    pub fn axis(&self, name: &str, kind: &str) -> String {
        let units: Option<Units> = self.results.planned("/case/units");
        units.map_or_else(|| name.to_owned(), |units| format!("{name} [{}]", units.of(kind)))
    }

    /// Name of a stage.
    pub fn stage_name(&self, stage: usize) -> String {
        self.results.stages().get(stage).cloned().unwrap_or_default()
    }

    /// The stage of an increment, and its number in it from 1.
    pub fn place(&self, increment: usize) -> (usize, usize) {
        let stage =
            self.spans.iter().position(|[first, end]| (*first..*end).contains(&increment)).unwrap_or(0);
        (stage, increment + 1 - self.spans.get(stage).map_or(0, |span| span[0]))
    }

    /// How an increment is called.
    pub fn called(&self, increment: usize) -> String {
        let (stage, number) = self.place(increment);
        format!("{}, {number}", self.stage_name(stage))
    }

    /// The cycles that are done.
    pub fn cycles(&self) -> Vec<Cycle> {
        let mut cycles = Vec::new();
        for (stage, [first, end]) in self.spans.iter().copied().enumerate() {
            let counts = |name: &str| {
                self.results
                    .planned::<usize>(&format!("/case/stages/{stage}/{name}"))
                    .filter(|&count| count > 0)
            };
            if let (Some(_), Some(length)) = (counts("course/cycles/most"), counts("increments")) {
                cycles.extend(
                    (1..=(end - first) / length).map(|number| Cycle {
                        span: [first + (number - 1) * length, first + number * length],
                    }),
                );
            }
        }
        cycles
    }

    /// Positions, among the kept increments, of at most so many that show the run: the ends of its stages, and others evenly.
    pub fn telling(&self, most: usize) -> Vec<usize> {
        let steps = &self.results.fields.steps;
        if steps.len() <= most {
            return (0..steps.len()).collect();
        }
        let is_end = |position: &usize| self.spans.iter().any(|[_, end]| steps[*position] + 1 == *end);
        let mut chosen: Vec<usize> = (0..steps.len()).filter(is_end).collect();
        if chosen.len() > most {
            let all = chosen.len();
            chosen = (0..most).map(|n| chosen[n * (all - 1) / (most - 1).max(1)]).collect();
        }
        // The largest hole is halved until there are enough; the last stage, where things happen, comes first among equals.
        while chosen.len() < most {
            let before = std::iter::once(None).chain(chosen.iter().map(|&position| Some(position)));
            let hole = before
                .zip(&chosen)
                .enumerate()
                .map(|(place, (from, to))| (to - from.map_or(0, |from| from + 1), place, *to))
                .max();
            match hole {
                Some((width, place, to)) if width > 0 => chosen.insert(place, to - width.div_ceil(2)),
                _ => break,
            }
        }
        chosen.dedup();
        chosen
    }
}

/// Whether moment times twist is more than force times shift along either axis, range by range.
fn twists(results: &Results) -> bool {
    let range = |name: &str| {
        let values = results.table.column(name).iter();
        let ends = values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(*value), high.max(*value)));
        ends.1 - ends.0
    };
    let work = |force: &str, motion: &str| range(force) * range(motion);
    let sideways = work("tangential_force_x", "shift_x").max(work("tangential_force_y", "shift_y"));
    work("twist_moment", "twist") > sideways
}

/// Direction of the largest tangential force, or else of the largest shift, with the sign of the first push.
fn direction(results: &Results) -> Option<[f64; 2]> {
    let table = &results.table;
    let along = |x: &str, y: &str, scale: f64| {
        let vectors = || table.column(x).iter().zip(table.column(y)).map(|(x, y)| [*x, *y]);
        let longest = vectors().map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
        let first = vectors().find(|[x, y]| x.hypot(*y) > 0.5 * longest)?;
        (longest > NOTHING * scale).then(|| first.map(|part| part / first[0].hypot(first[1])))
    };
    let largest = |name: &str| table.column(name).iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let found = along("tangential_force_x", "tangential_force_y", largest("normal_force"))
        .or_else(|| along("shift_x", "shift_y", largest("approach")))?;
    // What is a direction along an axis up to rounding is one.
    Some(found.map(|part| if part.abs() < 1e-6 { 0.0 } else { part }))
}

/// Increments of each stage that the run has reached.
fn spans(stage_of: &[f64], stages: usize) -> Vec<[usize; 2]> {
    let mut spans = Vec::new();
    for stage in 0..stages {
        let first = stage_of.partition_point(|&of| of < stage as f64);
        let end = stage_of.partition_point(|&of| of <= stage as f64);
        if end > first {
            spans.push([first, end]);
        }
    }
    spans
}
