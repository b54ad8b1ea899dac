//! The judgement of the loading history.

use toml::Spanned;

use super::controls::{Controls, controls};
use super::course::{Course, Cycles, Stage, StageControl, walk};
use super::file::RigFile;
use super::judge::Judge;
use super::rig::driven;
use super::stage_file::{IncrementsFile, RampFile, StageFile, WaveformFile};
use super::stage_names::own_names;
use super::table::table;
use super::waveform::Waveform;
use crate::model::{Control, CoulombFriction};
use crate::solver::sliding_fraction;

/// Increments of a whole history, at the most.
const MOST_INCREMENTS: usize = 10_000_000;
/// Bound on the error of the history where it is left to the program.
const HISTORY_TOLERANCE: f64 = 0.03;
/// Cycles of a stage, at the most.
const MOST_CYCLES: usize = 1_000_000;

/// The stages; `None` when something about them was refused.
pub(super) fn stages(
    judge: &mut Judge,
    list: &Spanned<Vec<Spanned<StageFile>>>,
    (friction, rig): (Option<&[&CoulombFriction]>, Option<&RigFile>),
    history_tolerance: Option<&Spanned<f64>>,
) -> Option<Vec<Stage>> {
    let tolerance = self::history_tolerance(judge, list.get_ref(), history_tolerance)?;
    if list.get_ref().is_empty() {
        return judge.refuse(
            list.span(),
            "load: no stage",
            "[[load]] with normal_force = ... and increments = ...",
        );
    }
    own_names(judge, list.get_ref());
    let mut checked = Vec::new();
    for (index, given) in list.get_ref().iter().enumerate() {
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

/// The bound for increments whose division is left to the program.
fn history_tolerance(
    judge: &mut Judge,
    list: &[Spanned<StageFile>],
    given: Option<&Spanned<f64>>,
) -> Option<f64> {
    let Some(given) = given else { return Some(HISTORY_TOLERANCE) };
    let tolerance = *given.get_ref();
    if !(1e-6..=0.5).contains(&tolerance) {
        return judge.refuse(
            given.span(),
            format!("solver.history_tolerance = {tolerance:?}: must lie between 1e-6 and 0.5"),
            "0.03 serves most purposes",
        );
    }
    if !list.iter().any(|stage| *stage.get_ref().increments.get_ref() == IncrementsFile::Auto) {
        return judge.refuse(
            given.span(),
            "solver.history_tolerance: every stage says its number of increments",
            "increments = \"auto\" in the stages that it is meant for",
        );
    }
    Some(tolerance)
}

fn stage(
    judge: &mut Judge,
    index: usize,
    given: &Spanned<StageFile>,
    (frictionless, rig): (bool, Option<&RigFile>),
    tolerance: f64,
) -> Option<Stage> {
    let before = judge.mistakes.len();
    let file = given.get_ref();
    let name = file.name.clone().unwrap_or_else(|| format!("stage {}", index + 1));
    let place = format!("load[{index}] ({name})");
    let auto = *file.increments.get_ref() == IncrementsFile::Auto;
    let mut increments = match *file.increments.get_ref() {
        IncrementsFile::Count(count) => count,
        IncrementsFile::Auto => automatic(file),
    };
    if !(1..=MOST_INCREMENTS).contains(&increments) {
        let message = format!("{place}.increments = {increments}: must lie between 1 and {MOST_INCREMENTS}");
        judge.refuse::<()>(file.increments.span(), message, "");
    }
    let columns = match &file.table {
        Some(name) => Some(table(judge, &place, file, name)?),
        None => None,
    };
    if let Some(columns) = &columns {
        let rows = columns.values().next().map_or(1, Vec::len);
        increments = increments.saturating_mul(rows);
    }
    let controls = controls(judge, &place, file, columns.as_ref());
    driven(judge, &place, file, columns.as_ref(), rig);
    let Controls { rigid: [normal, x, y, twist], tilt, bulk_stress } = controls;
    let starts_free = index == 0 && judge.attachments.start.is_none();
    if starts_free && normal.is_none() && judge.mistakes.len() == before {
        judge.refuse::<()>(
            given.span(),
            format!("{place}: the first stage says neither normal_force nor approach"),
            "bodies must be pressed together first: normal_force = ...; or start from a solved state, --from RESULTS",
        );
    }
    let course = course(judge, &place, file);
    let mut stage = Stage {
        name,
        normal,
        tangential: [x, y],
        twist,
        tilt,
        bulk_stress,
        increments,
        history_tolerance: auto.then_some(tolerance),
        course: course.unwrap_or(Course::Linear),
        friction: None,
    };
    let fewest = if file.table.is_none() { stage.fewest_increments() } else { 1 };
    if auto {
        stage.increments = stage.increments.max(fewest);
    } else if (1..fewest).contains(&increments) {
        judge.refuse::<()>(
            file.increments.span(),
            format!(
                "{place}.increments = {increments}: the reversal points of this cycle need at least {fewest}"
            ),
            "",
        );
    }
    if frictionless && stage.is_tangential_beyond_rest() {
        let spans = [
            file.tangential_force.as_ref().map(Spanned::span),
            file.shift.as_ref().map(Spanned::span),
            file.actuator.as_ref().map(Spanned::span),
            file.twist_moment.as_ref().map(Spanned::span),
            file.twist.as_ref().map(Spanned::span),
            file.table.as_ref().map(Spanned::span),
        ];
        judge.refuse::<()>(
            spans.into_iter().flatten().next().unwrap_or(given.span()),
            format!("{place}: a tangential load on a contact without friction"),
            "[friction] coefficient = ..., or leave the tangential load out",
        );
    }
    let says_nothing = stage.controls().next().is_none() && file.friction.is_none();
    if says_nothing && judge.mistakes.len() == before {
        judge.refuse::<()>(
            given.span(),
            format!("{place}: nothing is prescribed"),
            "normal_force, approach, tangential_force, shift, actuator, actuator_approach, twist_moment, twist, tilt_moment, tilt, bulk_stress, upper_bulk_stress or friction",
        );
    }
    (judge.mistakes.len() == before).then_some(stage)
}

/// Increments of a stage that leaves them to the program: enough to draw it by.
fn automatic(file: &StageFile) -> usize {
    let dwell = file.dwell.as_ref().map_or(0.25, |given| *given.get_ref());
    match (&file.table, file.cycles.is_some() || file.until_steady.is_some(), &file.waveform) {
        (Some(_), _, _) => 4,
        (None, false, _) => 16,
        (None, true, Some(form)) if *form.get_ref() == WaveformFile::Trapezoid => {
            // An increment for its shorter piece.
            let dwell = dwell.clamp(0.001, 0.499);
            ((1.0 / dwell.min(0.5 - dwell)).ceil() as usize).max(32)
        }
        (None, true, _) => 32,
    }
}

fn course(judge: &mut Judge, place: &str, file: &StageFile) -> Option<Course> {
    let (most, until_steady) = match (&file.cycles, &file.until_steady) {
        (Some(cycles), Some(_)) => {
            return judge.refuse(
                cycles.span(),
                format!("{place}: cycles and until_steady, both at once"),
                "until_steady counts its own cycles: most_cycles = ...",
            );
        }
        (None, None) => return ramp(judge, place, file),
        (Some(cycles), None) => (cycles, None),
        (None, Some(steady)) => {
            let steady = steady.get_ref();
            let tolerance = *steady.tolerance.get_ref();
            if !(tolerance > 0.0 && tolerance < 1.0) {
                let message = format!(
                    "{place}.until_steady.tolerance = {tolerance:?}: must lie between 0 and 1, relative"
                );
                return judge.refuse(steady.tolerance.span(), message, "1e-3 serves most purposes");
            }
            (&steady.most_cycles, Some(tolerance))
        }
    };
    if !(1..=MOST_CYCLES).contains(most.get_ref()) {
        let key = if until_steady.is_some() { "until_steady.most_cycles" } else { "cycles" };
        let message = format!("{place}.{key} = {}: must lie between 1 and {MOST_CYCLES}", most.get_ref());
        return judge.refuse(most.span(), message, "");
    }
    if let Some(ramp) = &file.ramp {
        return judge.refuse(
            ramp.span(),
            format!("{place}: ramp and cycles, both at once"),
            "a cycle has a waveform: leave out the ramp, or give the ramp a stage of its own",
        );
    }
    let waveform = waveform(judge, place, file)?;
    let envelope = match &file.envelope {
        None => [1.0; 2],
        Some(given) => {
            let words = if given.get_ref().iter().any(|share| !share.is_finite()) {
                "both shares must be finite"
            } else if until_steady.is_some() && given.get_ref()[0] != given.get_ref()[1] {
                "amplitudes that change never become steady"
            } else {
                ""
            };
            if !words.is_empty() {
                let message = format!("{place}.envelope = {:?}: {words}", given.get_ref());
                return judge.refuse(given.span(), message, "");
            }
            given.get_ref().0
        }
    };
    Some(Course::Cycles(Cycles { most: *most.get_ref(), waveform, envelope, until_steady }))
}

/// The course of a stage without cycles.
fn ramp(judge: &mut Judge, place: &str, file: &StageFile) -> Option<Course> {
    let only_cycles = [
        ("waveform", file.waveform.as_ref().map(Spanned::span)),
        ("dwell", file.dwell.as_ref().map(Spanned::span)),
        ("phase", file.phase.as_ref().map(Spanned::span)),
        ("envelope", file.envelope.as_ref().map(Spanned::span)),
    ];
    for (key, span) in only_cycles {
        if let Some(span) = span {
            return judge.refuse(
                span,
                format!("{place}.{key}: the stage has no cycles"),
                "cycles = ..., or until_steady = { tolerance = ..., most_cycles = ... }",
            );
        }
    }
    match (&file.ramp, &file.table) {
        (Some(ramp), Some(_)) => judge.refuse(
            ramp.span(),
            format!("{place}: ramp and table, both at once"),
            "a table is followed from row to row by straight lines",
        ),
        (Some(ramp), None) => Some(match ramp.get_ref() {
            RampFile::Linear => Course::Linear,
            RampFile::Square => Course::Square,
            RampFile::Cubic => Course::Cubic,
        }),
        (None, _) => Some(Course::Linear),
    }
}

fn waveform(judge: &mut Judge, place: &str, file: &StageFile) -> Option<Waveform> {
    if let Some(name) = &file.table {
        let keys = [
            ("waveform", file.waveform.as_ref().map(Spanned::span)),
            ("phase", file.phase.as_ref().map(Spanned::span)),
            ("envelope", file.envelope.as_ref().map(Spanned::span)),
        ];
        for (key, span) in keys {
            if let Some(span) = span {
                let message = format!("{place}.{key}: the cycle stands in the table {:?}", name.get_ref());
                return judge.refuse(span, message, "");
            }
        }
    }
    let word = file.waveform.as_ref().map_or(WaveformFile::Triangle, |given| *given.get_ref());
    if let (Some(dwell), false) = (&file.dwell, word == WaveformFile::Trapezoid) {
        return judge.refuse(
            dwell.span(),
            format!("{place}.dwell: only a trapezoid holds its extremes"),
            "waveform = \"trapezoid\"",
        );
    }
    Some(match word {
        WaveformFile::Triangle => Waveform::Triangle,
        WaveformFile::Sine => Waveform::Sine,
        WaveformFile::Trapezoid => {
            let dwell = file.dwell.as_ref().map_or(0.25, |given| *given.get_ref());
            if let (Some(given), false) = (&file.dwell, (1e-3..=0.499).contains(&dwell)) {
                let message =
                    format!("{place}.dwell = {dwell:?}: must lie between 0.001 and 0.499 of a cycle");
                return judge.refuse(given.span(), message, "");
            }
            Waveform::Trapezoid { dwell }
        }
    })
}

/// Forces without equilibrium are refused before anything is computed, as far as the case fixes them: tangential ones that
/// Coulomb's law, which is given for each stage, cannot carry, and normal ones that pull. Of friction that evolves nobody knows what it
/// carries in a stage, but that it is at most what the `strongest` law does.
pub(super) fn sliding(
    judge: &mut Judge,
    (laws, strongest): (&[&CoulombFriction], Option<&CoulombFriction>),
    list: &Spanned<Vec<Spanned<StageFile>>>,
    stages: &[Stage],
    (tolerance, way_out): (f64, &str),
) {
    let friction: Vec<&CoulombFriction> = laws.iter().map(|law| strongest.unwrap_or(law)).collect();
    let mut worst: Vec<(f64, f64)> = vec![(0.0, f64::INFINITY); stages.len()];
    let mut lowest = vec![f64::INFINITY; stages.len()];
    walk(judge.attachments.start.as_ref(), stages, |number, loads| {
        let [normal, x, y, _] = loads;
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
    for (index, (stage, file)) in stages.iter().zip(list.get_ref()).enumerate() {
        let file = file.get_ref();
        let name = &stage.name;
        let table = file.table.as_ref().map(Spanned::span);
        let unit = judge.force_unit.clone();
        if stage.normal.is_some() && lowest[index] < 0.0 {
            judge.refuse::<()>(
                file.normal_force.as_ref().map(Spanned::span).or(table.clone()).unwrap_or_default(),
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
            let span = file.tangential_force.as_ref().map(Spanned::span).or(table);
            let key = if span.is_some() { "tangential_force" } else { "normal_force" };
            let span = span.or(file.normal_force.as_ref().map(Spanned::span)).unwrap_or_default();
            let [asked, bound] = apart(asked, bound);
            judge.refuse::<()>(
                span,
                format!(
                    "load[{index}] ({name}).{key}: the tangential force reaches {asked}{unit}, where friction carries at most mu P = {bound}{unit}"
                ),
                &format!(
                    "a force above mu P has no equilibrium, and one of mu P slides no one knows how far; {way_out}"
                ),
            );
            return;
        }
    }
}

/// Two numbers in as few digits as tell them apart.
pub fn apart(one: f64, other: f64) -> [String; 2] {
    let rounded = [one, other].map(|value| {
        let short = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
        format!("{short:?}")
    });
    if rounded[0] == rounded[1] { [one, other].map(|value| format!("{value:?}")) } else { rounded }
}

impl Stage {
    /// Whether the stage prescribes any tangential force or motion, or a bulk stress, which moves the surfaces tangentially.
    pub fn is_tangential(&self) -> bool {
        self.tangential.iter().any(Option::is_some) || self.twist.is_some() || self.stretches()
    }

    /// Whether it prescribes more than forces that stay zero. A bulk stress of a contact without friction only adds to the stresses below.
    fn is_tangential_beyond_rest(&self) -> bool {
        let rests = |control: &StageControl| match control {
            StageControl::Motion(_) | StageControl::FarEnd(_) => false,
            StageControl::Force(path) => path.is_zero(),
        };
        self.tangential.iter().flatten().any(|control| !rests(control)) || self.twist.is_some()
    }
}

#[cfg(test)]
mod tests;
