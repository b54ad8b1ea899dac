//! The judgement of the loading history.

use std::fmt::Display;
use std::ops::Range;

use super::controls::controls;
use super::file::RigFile;
use super::judge::Judge;
use super::mean_gap::MEAN_GAP;
use super::rig::driven;
use super::rolling::direction;
use super::stage_file::{IncrementsFile, RampFile, StageFile, WaveformFile};
use super::table::table;
use crate::document::{At, apart};
use crate::model::controls::{TANGENTIAL, TWIST, ways};
use crate::model::stage::{Course, Cycles, Stage, StageControl};
use crate::model::waveform::Waveform;
use crate::model::{Control, CoulombFriction, walk};
use crate::solver::sliding_fraction;

/// Increments of a whole history, at the most.
const MOST_INCREMENTS: usize = 10_000_000;
/// Bound on the error of the history where it is left to the program.
const HISTORY_TOLERANCE: f64 = 0.03;
/// Increments of a stage from which on those in which bodies come to touch are solved in parts: of fewer they would be most of the work.
const FEWEST_TO_DIVIDE: usize = 8;
/// Fraction of a cycle for which a trapezoid holds each extreme, where the case does not say.
const DWELL: f64 = 0.25;
/// Cycles of a stage, at the most.
const MOST_CYCLES: usize = 1_000_000;

/// The stages; `None` when something about them was refused.
pub(super) fn stages(
    judge: &mut Judge,
    list: &At<Vec<At<StageFile>>>,
    (friction, rig): (Option<&[&CoulombFriction]>, Option<&RigFile>),
    history_tolerance: Option<&At<f64>>,
) -> Option<Vec<Stage>> {
    let tolerance = self::history_tolerance(judge, &list.value, history_tolerance)?;
    if list.value.is_empty() {
        return judge.refuse(
            list.span(),
            "load: no stage",
            "[[load]] with normal_force = ... and increments = ...",
        );
    }
    own_names(judge, &list.value);
    let mut checked = Vec::new();
    for (index, given) in list.value.iter().enumerate() {
        let frictionless = friction.is_some_and(|laws| laws[index].is_frictionless());
        checked.push(stage(judge, index, given, (frictionless, rig), tolerance));
    }
    let stages: Vec<Stage> = checked.into_iter().collect::<Option<_>>()?;
    let in_all = stages.iter().fold(0_usize, |sum, stage| {
        sum.saturating_add(stage.increments.saturating_mul(stage.cycles().map_or(1, |cycles| cycles.most)))
    });
    if in_all > MOST_INCREMENTS {
        return judge.refuse(
            list.span(),
            format!("load: {in_all} increments in all; at most {MOST_INCREMENTS}"),
            "",
        );
    }
    Some(stages)
}

/// Refuses a stage whose name an earlier one has: stages are called by their names, in results and in sweeps.
fn own_names(judge: &mut Judge, list: &[At<StageFile>]) {
    for (index, given) in list.iter().enumerate() {
        let Some(name) = &given.value.name else { continue };
        let has_it = |other: &At<StageFile>| other.value.name.as_ref() == Some(name);
        if let Some(first) = list[..index].iter().position(has_it) {
            judge.refuse::<()>(
                given.span(),
                format!("load[{index}].name = {name:?}: load[{first}] has that name, too"),
                "a name of its own for each stage: results and sweeps call stages by their names",
            );
        }
    }
}

/// The bound for increments whose division is left to the program.
fn history_tolerance(judge: &mut Judge, list: &[At<StageFile>], given: Option<&At<f64>>) -> Option<f64> {
    let Some(given) = given else { return Some(HISTORY_TOLERANCE) };
    let tolerance = given.value;
    if judge.places.are_whole()
        && !list.iter().any(|stage| matches!(stage.increments, IncrementsFile::Auto(_)))
    {
        return judge.refuse(
            given.span(),
            "solver.history_tolerance: every stage says its number of increments",
            "increments = \"auto\" in the stages that it is meant for",
        );
    }
    Some(tolerance)
}

/// A stage while it is judged.
struct Here<'a, 'j> {
    judge: &'a mut Judge<'j>,
    file: &'a StageFile,
    index: usize,
    /// As messages call it.
    place: String,
}

impl Here<'_, '_> {
    /// Where the value of a key stands.
    fn at(&self, key: &str) -> Option<Range<usize>> {
        self.judge.places.of(&format!("load[{}].{key}", self.index))
    }

    /// Refuses what stands at a key; the message goes on where the place ends.
    fn refuse<T>(&mut self, key: &str, message: impl Display, help: &str) -> Option<T> {
        let span = self.at(key).unwrap_or_default();
        self.judge.refuse(span, format!("{}{message}", self.place), help)
    }

    /// Whether one of the keys is given; the first is refused, with its name in the message.
    fn refuses_any(&mut self, keys: &[&str], message: impl Display, help: &str) -> bool {
        let Some(key) = keys.iter().find(|key| self.at(key).is_some()) else { return false };
        self.refuse::<()>(key, format!(".{key}: {message}"), help);
        true
    }

    fn course(&mut self) -> Option<Course> {
        let file = self.file;
        let (key, most, until_steady) = match (&file.cycles, &file.until_steady) {
            (Some(_), Some(_)) => {
                let help = "until_steady counts its own cycles: most_cycles = ...";
                return self.refuse("cycles", ": cycles and until_steady, both at once", help);
            }
            (None, None) => return self.ramp(),
            (Some(cycles), None) => ("cycles", *cycles, None),
            (None, Some(steady)) => {
                let tolerance = steady.tolerance;
                if !(tolerance > 0.0 && tolerance < 1.0) {
                    let key = "until_steady.tolerance";
                    let message = format!(".{key} = {tolerance:?}: must lie between 0 and 1, relative");
                    return self.refuse(key, message, "1e-3 serves most purposes");
                }
                ("until_steady.most_cycles", steady.most_cycles, Some(tolerance))
            }
        };
        if !(1..=MOST_CYCLES).contains(&most) {
            let message = format!(".{key} = {most}: must lie between 1 and {MOST_CYCLES}");
            return self.refuse(key, message, "");
        }
        if file.ramp.is_some() {
            let help = "a cycle has a waveform: leave out the ramp, or give the ramp a stage of its own";
            return self.refuse("ramp", ": ramp and cycles, both at once", help);
        }
        let waveform = self.waveform()?;
        let envelope = file.envelope.unwrap_or([1.0; 2]);
        let words = if envelope.iter().any(|share| !share.is_finite()) {
            "both shares must be finite"
        } else if until_steady.is_some() && envelope[0] != envelope[1] {
            "amplitudes that change never become steady"
        } else {
            return Some(Course::Cycles(Cycles { most, waveform, envelope, until_steady }));
        };
        self.refuse("envelope", format!(".envelope = {envelope:?}: {words}"), "")
    }

    /// The course of a stage without cycles.
    fn ramp(&mut self) -> Option<Course> {
        let help = "cycles = ..., or until_steady = { tolerance = ..., most_cycles = ... }";
        let only_cycles = ["waveform", "dwell", "phase", "envelope"];
        if self.refuses_any(&only_cycles, "the stage has no cycles", help) {
            return None;
        }
        if self.file.ramp.is_some() && self.file.table.is_some() {
            let help = "a table is followed from row to row by straight lines";
            return self.refuse("ramp", ": ramp and table, both at once", help);
        }
        Some(match self.file.ramp {
            None | Some(RampFile::Linear) => Course::Linear,
            Some(RampFile::Square) => Course::Square,
            Some(RampFile::Cubic) => Course::Cubic,
        })
    }

    fn waveform(&mut self) -> Option<Waveform> {
        let file = self.file;
        if let Some(name) = &file.table {
            let message = format!("the cycle stands in the table {:?}", name.value);
            if self.refuses_any(&["waveform", "phase", "envelope"], message, "") {
                return None;
            }
        }
        let dwell = file.dwell.unwrap_or(DWELL);
        Some(match file.waveform.unwrap_or(WaveformFile::Triangle) {
            WaveformFile::Trapezoid if !(1e-3..=0.499).contains(&dwell) => {
                let message = format!(".dwell = {dwell:?}: must lie between 0.001 and 0.499 of a cycle");
                return self.refuse("dwell", message, "");
            }
            WaveformFile::Trapezoid => Waveform::Trapezoid { dwell },
            _ if file.dwell.is_some() => {
                let help = "waveform = \"trapezoid\"";
                return self.refuse("dwell", ".dwell: only a trapezoid holds its extremes", help);
            }
            WaveformFile::Triangle => Waveform::Triangle,
            WaveformFile::Sine => Waveform::Sine,
        })
    }
}

fn stage(
    judge: &mut Judge,
    index: usize,
    given: &At<StageFile>,
    (frictionless, rig): (bool, Option<&RigFile>),
    tolerance: f64,
) -> Option<Stage> {
    let before = judge.mistakes.len();
    let file = &given.value;
    let name = file.name.clone().unwrap_or_else(|| format!("stage {}", index + 1));
    let place = format!("load[{index}] ({name})");
    let columns = match &file.table {
        Some(name) => Some(table(judge, &place, file, name)?),
        None => None,
    };
    if file.controls.of(MEAN_GAP).is_some()
        || columns.as_ref().is_some_and(|table| table.contains_key(MEAN_GAP))
    {
        judge.by_mean_gap.push(index);
    }
    let controls = controls(judge, &place, file, columns.as_ref());
    driven(judge, &place, file, columns.as_ref(), rig);
    let roll_direction = direction(judge, file);
    let are_good = judge.mistakes.len() == before;
    let mut here = Here { judge, file, index, place };
    let auto = matches!(file.increments, IncrementsFile::Auto(_));
    let mut increments = match file.increments {
        IncrementsFile::Count(count) => count,
        IncrementsFile::Auto(_) => automatic(file),
    };
    if !(1..=MOST_INCREMENTS).contains(&increments) {
        let message = format!(".increments = {increments}: must lie between 1 and {MOST_INCREMENTS}");
        here.refuse::<()>("increments", message, "");
    }
    if let Some(columns) = &columns {
        increments = increments.saturating_mul(columns.values().next().map_or(1, Vec::len));
    }
    let [normal, x, y, twist, tilt_x, tilt_y, lower_x, lower_y, upper_x, upper_y, roll_x, roll_y] = controls;
    let course = here.course().unwrap_or(Course::Linear);
    let mut stage = Stage {
        name,
        normal,
        tangential: [x, y],
        twist,
        tilt: [tilt_x, tilt_y],
        bulk_stress: [[lower_x, lower_y], [upper_x, upper_y]],
        roll: [roll_x, roll_y],
        steady: file.controls.are_steady(),
        roll_direction,
        increments,
        history_tolerance: auto.then_some(tolerance),
        divides_first_touch: course == Course::Linear && increments >= FEWEST_TO_DIVIDE && !auto,
        course,
        friction: None,
    };
    let fewest = if file.table.is_none() { stage.fewest_increments() } else { 1 };
    if auto {
        stage.increments = stage.increments.max(fewest);
    } else if (1..fewest).contains(&increments) {
        let message =
            format!(".increments = {increments}: the reversal points of this cycle need at least {fewest}");
        here.refuse::<()>("increments", message, "");
    }
    let Here { judge, place, .. } = here;
    let starts_free = index == 0 && judge.attachments.start.is_none();
    let says_nothing = stage.controls().next().is_none() && !stage.steady && file.friction.is_none();
    // Without friction a shift moves nothing but surfaces that move with their bodies.
    let by_motion = judge.moves && stage.tangential.iter().flatten().all(StageControl::is_motion);
    if frictionless && !by_motion && stage.is_tangential_beyond_rest() {
        let span = file.controls.place(TANGENTIAL..TWIST + 1).or(file.table.as_ref().map(At::span));
        judge.refuse::<()>(
            span.unwrap_or(given.span()),
            format!("{place}: a tangential load on a contact without friction"),
            "[friction] coefficient = ..., or leave the tangential load out",
        );
    }
    if starts_free && stage.normal.is_none() && are_good {
        judge.refuse::<()>(
            given.span(),
            format!("{place}: the first stage says neither normal_force nor approach"),
            "bodies must be pressed together first: normal_force = ...; or start from a solved state, --from RESULTS",
        );
    } else if says_nothing && judge.mistakes.len() == before {
        let names: Vec<&str> = ways().map(|(_, way)| way.name).collect();
        let help = format!("{} or friction", names.join(", "));
        judge.refuse::<()>(given.span(), format!("{place}: nothing is prescribed"), &help);
    }
    (judge.mistakes.len() == before).then_some(stage)
}

/// Increments of a stage that leaves them to the program: enough to draw it by.
fn automatic(file: &StageFile) -> usize {
    match (&file.table, file.cycles.is_some() || file.until_steady.is_some(), file.waveform) {
        (Some(_), _, _) => 4,
        (None, false, _) => 16,
        (None, true, Some(WaveformFile::Trapezoid)) => {
            // An increment for its shorter piece.
            let dwell = file.dwell.unwrap_or(DWELL).clamp(0.001, 0.499);
            ((1.0 / dwell.min(0.5 - dwell)).ceil() as usize).max(32)
        }
        (None, true, _) => 32,
    }
}

/// What helps where friction does not carry the tangential force.
pub const WAY_TO_SLIDE: &str = "prescribe the shift to slide";

/// Forces without equilibrium are refused before anything is computed, as far as the case fixes them: tangential ones that
/// Coulomb's law, which is given for each stage, cannot carry, and normal ones that pull. Of friction that evolves nobody knows what it
/// carries in a stage, but that it is at most what the `strongest` law does.
pub(super) fn sliding(
    judge: &mut Judge,
    (laws, strongest): (&[&CoulombFriction], Option<&CoulombFriction>),
    list: &At<Vec<At<StageFile>>>,
    stages: &[Stage],
    tolerance: f64,
) {
    let friction: Vec<&CoulombFriction> = laws.iter().map(|law| strongest.unwrap_or(law)).collect();
    let mut worst: Vec<(f64, f64)> = vec![(0.0, f64::INFINITY); stages.len()];
    let mut lowest = vec![f64::INFINITY; stages.len()];
    walk(judge.attachments.start.as_ref(), stages, |number, loads| {
        let [normal, x, y, ..] = loads;
        let Some(Control::Force(normal)) = normal else { return };
        lowest[number] = lowest[number].min(*normal);
        let part = |control: &Option<Control>| match control {
            Some(Control::Force(force)) => *force,
            _ => 0.0,
        };
        let (asked, bound) = (part(x).hypot(part(y)), friction[number].largest() * normal.max(0.0));
        if asked > bound * sliding_fraction(tolerance) && asked > worst[number].0 {
            worst[number] = (asked, bound);
        }
    });
    for (index, (stage, file)) in stages.iter().zip(&list.value).enumerate() {
        let file = &file.value;
        let name = &stage.name;
        let table = file.table.as_ref().map(At::span);
        let unit = judge.force_unit.clone();
        if stage.normal.is_some() && lowest[index] < 0.0 {
            judge.refuse::<()>(
                file.controls.span_of("normal_force").or(table.clone()).unwrap_or_default(),
                format!(
                    "load[{index}] ({name}).normal_force reaches {:?}{unit}: compression is positive, and the surfaces do not adhere",
                    lowest[index]
                ),
                "",
            );
            return;
        }
        let (asked, bound) = worst[index];
        if asked > 0.0 && friction[index].largest() > 0.0 {
            let span = file.controls.span_of("tangential_force").or(table);
            let key = if span.is_some() { "tangential_force" } else { "normal_force" };
            let span = span.or(file.controls.span_of("normal_force")).unwrap_or_default();
            let [asked, bound] = apart(asked, bound);
            judge.refuse::<()>(
                span,
                format!(
                    "load[{index}] ({name}).{key}: the tangential force reaches {asked}{unit}, where friction carries at most mu P = {bound}{unit}"
                ),
                &format!(
                    "a force above mu P has no equilibrium, and one of mu P slides no one knows how far; {WAY_TO_SLIDE}"
                ),
            );
            return;
        }
    }
}

#[cfg(test)]
mod tests;
