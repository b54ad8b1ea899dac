//! How a control runs through the increments of a stage: ramps, waves of a cycle (whose heights are in `waveform`), tables.

use serde::{Deserialize, Serialize};

use super::controls::{FREEDOMS, Kind};
use super::friction::{CellMap, CoulombFriction};
use super::load::{Control, LoadStep};
use super::waveform::{CycleTimes, Waveform};

/// One stage of the loading history.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stage<M = CellMap> {
    /// Name for messages and tables.
    pub name: String,
    /// What changes normally, if anything.
    pub normal: Option<StageControl>,
    /// What changes tangentially along x and y, if anything.
    pub tangential: [Option<StageControl>; 2],
    /// What changes about z, if anything.
    pub twist: Option<StageControl>,
    /// What changes of the tilt along x and y, if anything.
    #[serde(default, skip_serializing_if = "are_none")]
    pub tilt: [Option<StageControl>; 2],
    /// What changes of the bulk stresses of the lower and of the upper body along x and y, if anything; forces all.
    #[serde(default, skip_serializing_if = "are_all_none")]
    pub bulk_stress: [[Option<StageControl>; 2]; 2],
    /// What changes of the distance rolled along x and y, if anything.
    #[serde(default, skip_serializing_if = "are_none")]
    pub roll: [Option<StageControl>; 2],
    /// Whether each increment ends where nothing changes any more as the contact rolls on.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub steady: bool,
    /// The way it then rolls, along x and y: a direction of any length.
    #[serde(default = "along_x", skip_serializing_if = "is_along_x")]
    pub roll_direction: [f64; 2],
    /// Increments of the stage, or of one cycle, all rows of a table included.
    pub increments: usize,
    /// Each increment is solved in as many parts as this bound on the error of its history asks for (in shares of the way that the
    /// tractions go in it). Default: in one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub history_tolerance: Option<f64>,
    /// Whether an increment in which bodies that were apart come to touch is solved in parts. A study of other numbers of increments keeps to it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub divides_first_touch: bool,
    /// How the stage runs through its increments.
    pub course: Course,
    /// Friction from this stage on. Default: as before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<CoulombFriction<M>>,
}

fn are_none(controls: &[Option<StageControl>; 2]) -> bool {
    controls.iter().all(Option::is_none)
}

/// The way that a contact rolls on where nothing is said of it.
pub const fn along_x() -> [f64; 2] {
    [1.0, 0.0]
}

fn is_along_x(direction: &[f64; 2]) -> bool {
    *direction == along_x()
}

fn are_all_none(controls: &[[Option<StageControl>; 2]; 2]) -> bool {
    controls.iter().all(are_none)
}

/// What a stage prescribes in one direction, and how it runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StageControl {
    /// A force [force] or moment [force x length].
    Force(Path),
    /// A motion [length] or rotation [rad].
    Motion(Path),
    /// The motion of the far end of the machine's spring [length].
    FarEnd(Path),
    /// A motion by distance rolled [-], or [rad/length], the same all along the stage.
    Rate(Path),
}

/// How a stage runs from where it starts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Course {
    /// Equal steps to the target, or from row to row of a table.
    Linear,
    /// Forces with the second power of the share done, motions with the power 4/3: a sphere goes through the same contacts by either.
    Square,
    /// Forces with the third power of the share done, motions with the second: a sphere's contact radius grows evenly.
    Cubic,
    /// The same again and again.
    Cycles(Cycles),
}

/// Cycles of a stage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cycles {
    /// How many; at the most, where the stage ends when it is steady or worn.
    pub most: usize,
    /// Shape of a cycle of amplitudes.
    pub waveform: Waveform,
    /// Share of the amplitudes at the start of the stage and at its end; linear between them.
    pub envelope: [f64; 2],
    /// The stage ends when a cycle ends where it began, up to this.
    pub until_steady: Option<f64>,
}

/// What a control runs through.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Path {
    /// To a value, at the end of the stage.
    To(f64),
    /// A wave of this amplitude. It goes on from where the control is: its middle is the start less the wave's first value.
    Wave {
        /// Amplitude, in the control's unit.
        amplitude: f64,
        /// Share of a cycle by which it is ahead.
        phase: f64,
    },
    /// Through values in turn, one after so many increments.
    Through(Vec<f64>),
}

impl Path {
    /// Its target, amplitude or last value.
    pub fn last(&self) -> f64 {
        match self {
            Self::To(value) | Self::Wave { amplitude: value, .. } => *value,
            Self::Through(values) => values.last().copied().unwrap_or(0.0),
        }
    }

    /// Whether it is zero all along, when it starts there.
    pub fn is_zero(&self) -> bool {
        match self {
            Self::To(value) | Self::Wave { amplitude: value, .. } => *value == 0.0,
            Self::Through(values) => values.iter().all(|value| *value == 0.0),
        }
    }

    /// How far below a plane it runs: a mean gap is the mean plane of the undeformed gap less the approach, and the other way round.
    #[must_use]
    pub fn below(self, plane: f64) -> Self {
        match self {
            Self::To(value) => Self::To(plane - value),
            Self::Wave { amplitude, phase } => Self::Wave { amplitude: -amplitude, phase },
            Self::Through(values) => Self::Through(values.into_iter().map(|value| plane - value).collect()),
        }
    }
}

impl<M> Stage<M> {
    /// Increments of the whole stage, at the most.
    pub fn increments_in_all(&self) -> usize {
        match self.course {
            Course::Cycles(cycles) => self.increments * cycles.most,
            Course::Linear | Course::Square | Course::Cubic => self.increments,
        }
    }

    /// Cycles of the stage, when it has any.
    pub fn cycles(&self) -> Option<&Cycles> {
        match &self.course {
            Course::Cycles(cycles) => Some(cycles),
            Course::Linear | Course::Square | Course::Cubic => None,
        }
    }

    /// Whether increment `k` (from 1) is the last of a cycle.
    pub fn ends_cycle(&self, k: usize) -> bool {
        self.cycles().is_some() && k.is_multiple_of(self.increments)
    }

    /// Phases of the waves of its cycle, as fractions of a cycle; those of waves without amplitude are nobody's.
    fn phases(&self) -> Vec<f64> {
        let of = |control: &StageControl| match *control.path() {
            Path::Wave { amplitude, phase } if amplitude != 0.0 => Some(phase),
            _ => None,
        };
        self.controls().filter_map(of).collect()
    }

    /// When in its cycle each increment ends, when it has cycles.
    pub fn times(&self) -> Option<CycleTimes> {
        let cycles = self.cycles()?;
        Some(CycleTimes::new(cycles.waveform, &self.phases(), self.increments))
    }

    /// Fewest increments that meet all reversal points of the cycle's waves; 1 without cycles.
    pub fn fewest_increments(&self) -> usize {
        self.cycles().map_or(1, |cycles| cycles.waveform.fewest_increments(&self.phases()))
    }

    /// Value of a control at the end of increment `k` (from 1), when the stage found it at `start`; `times` are those of the stage.
    pub fn value(&self, control: &StageControl, start: f64, k: usize, times: Option<&CycleTimes>) -> f64 {
        let path = control.path();
        match (path, &self.course) {
            (Path::To(target), _) if k == self.increments => *target,
            (Path::To(target), course) => {
                let done = k as f64 / self.increments as f64;
                let share = match (course, control) {
                    (Course::Cubic, StageControl::Force(_)) => done.powi(3),
                    (
                        Course::Cubic,
                        StageControl::Motion(_) | StageControl::FarEnd(_) | StageControl::Rate(_),
                    )
                    | (Course::Square, StageControl::Force(_)) => done.powi(2),
                    (
                        Course::Square,
                        StageControl::Motion(_) | StageControl::FarEnd(_) | StageControl::Rate(_),
                    ) => done * done.cbrt(),
                    (Course::Linear | Course::Cycles(_), _) => done,
                };
                start + (target - start) * share
            }
            (Path::Wave { amplitude, phase }, Course::Cycles(cycles)) => {
                let Some(times) = times else { return start };
                let [first, last] = cycles.envelope;
                let done = if times.are_even() || k.is_multiple_of(self.increments) {
                    (last - first) * k as f64 / self.increments_in_all() as f64
                } else {
                    (last - first) * ((k / self.increments) as f64 + times.at(k)) / cycles.most as f64
                };
                start
                    + amplitude * ((first + done) * times.height(*phase, k) - first * times.height(*phase, 0))
            }
            (Path::Wave { .. }, _) => start,
            (Path::Through(values), _) => {
                let per_row = (self.increments / values.len().max(1)).max(1);
                let row = (k - 1) / per_row;
                let done = (k - 1) % per_row + 1;
                let to = values[row % values.len()];
                if done == per_row {
                    return to;
                }
                let from = if row == 0 { start } else { values[(row - 1) % values.len()] };
                from + (to - from) * done as f64 / per_row as f64
            }
        }
    }

    /// What is prescribed at the end of increment `k`, from the controls `start` that the stage found.
    pub fn load(&self, start: &LoadStep, k: usize) -> LoadStep {
        let times = self.times();
        let mut controls = start.controls();
        for (control, now) in self.by_freedom().into_iter().zip(&mut controls) {
            let Some(control) = control else { continue };
            if let StageControl::Rate(rate) = control {
                *now = Control::Motion(now.value() + rate.last() * self.rolled(start, k));
                continue;
            }
            *now = control.prescribing(self.value(control, now.value(), k, times.as_ref()));
        }
        LoadStep::of(controls)
    }

    /// Distance [length] that the stage has rolled by the end of increment `k`, on its straight way.
    fn rolled(&self, start: &LoadStep, k: usize) -> f64 {
        let along = |axis: usize| {
            let from = start.roll[axis];
            self.roll[axis].as_ref().map_or(0.0, |control| self.value(control, from, k, None) - from)
        };
        along(0).hypot(along(1))
    }

    /// What it prescribes for each degree of freedom (`model/controls.rs`).
    pub fn by_freedom(&self) -> [Option<&StageControl>; FREEDOMS] {
        let [lower, upper] = &self.bulk_stress;
        let [[x, y], tilt] = [&self.tangential, &self.tilt];
        let roll = &self.roll;
        [
            &self.normal,
            x,
            y,
            &self.twist,
            &tilt[0],
            &tilt[1],
            &lower[0],
            &lower[1],
            &upper[0],
            &upper[1],
            &roll[0],
            &roll[1],
        ]
        .map(Option::as_ref)
    }

    /// All that the stage prescribes.
    pub fn controls(&self) -> impl Iterator<Item = &StageControl> {
        self.by_freedom().into_iter().flatten()
    }

    /// Increments as the key of the stage counts them: those between two rows, where a table has its course.
    pub fn increments_by_key(&self) -> usize {
        let rows = self.controls().map(|control| match control.path() {
            Path::Through(values) => values.len(),
            _ => 1,
        });
        self.increments / rows.fold(1, usize::max)
    }

    /// Whether the stage prescribes a bulk stress.
    pub fn stretches(&self) -> bool {
        self.bulk_stress.iter().flatten().any(Option::is_some)
    }

    /// Whether the stage rolls.
    pub fn rolls(&self) -> bool {
        self.steady || self.roll.iter().any(Option::is_some)
    }

    /// What the upper body moves by distance rolled, along x, y and about z, where that is prescribed.
    pub fn rates(&self) -> [Option<f64>; 3] {
        let of = |control: &Option<StageControl>| match control {
            Some(StageControl::Rate(rate)) => Some(rate.last()),
            _ => None,
        };
        [of(&self.tangential[0]), of(&self.tangential[1]), of(&self.twist)]
    }

    /// Whether the stage prescribes a tilt or its moment.
    pub fn tilts(&self) -> bool {
        self.tilt.iter().any(Option::is_some)
    }

    /// Whether the stage prescribes any tangential force or motion, or a bulk stress, which moves the surfaces tangentially.
    pub fn is_tangential(&self) -> bool {
        self.tangential.iter().any(Option::is_some) || self.twist.is_some() || self.stretches()
    }

    /// Whether it prescribes more than forces that stay zero. A bulk stress of a contact without friction only adds to the stresses below.
    pub fn is_tangential_beyond_rest(&self) -> bool {
        let rests = |control: &StageControl| match control {
            StageControl::Motion(_) | StageControl::FarEnd(_) | StageControl::Rate(_) => false,
            StageControl::Force(path) => path.is_zero(),
        };
        self.tangential.iter().flatten().any(|control| !rests(control)) || self.twist.is_some()
    }
}

impl StageControl {
    /// A control of a kind; `mean_plane`: the mean of the undeformed gap [length], from which a mean gap counts.
    pub fn new(kind: Kind, path: Path, mean_plane: f64) -> Self {
        match kind {
            Kind::Force => Self::Force(path),
            Kind::Motion => Self::Motion(path),
            Kind::FarEnd => Self::FarEnd(path),
            Kind::MeanGap => Self::Motion(path.below(mean_plane)),
            Kind::Rate => Self::Rate(path),
        }
    }

    /// What it runs through.
    pub fn path(&self) -> &Path {
        let (Self::Force(path) | Self::Motion(path) | Self::FarEnd(path) | Self::Rate(path)) = self;
        path
    }

    /// A value of this control's kind.
    pub fn prescribing(&self, value: f64) -> Control {
        match self {
            Self::Force(_) => Control::Force(value),
            Self::Motion(_) | Self::Rate(_) => Control::Motion(value),
            Self::FarEnd(_) => Control::FarEnd(value),
        }
    }

    /// Whether it prescribes a motion, of the body or of the actuator.
    pub fn is_motion(&self) -> bool {
        matches!(self, Self::Motion(_) | Self::FarEnd(_) | Self::Rate(_))
    }
}
