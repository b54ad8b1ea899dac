//! How a control runs through the increments of a stage: ramps, waves of a cycle, tables.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::model::{Control, CoulombFriction, LoadStep};

/// One stage of the loading history.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stage {
    /// Name for messages and tables.
    pub name: String,
    /// What changes normally, if anything.
    pub normal: Option<StageControl>,
    /// What changes tangentially along x and y, if anything.
    pub tangential: [Option<StageControl>; 2],
    /// What changes about z, if anything.
    pub twist: Option<StageControl>,
    /// What changes of the tilt along x and y, if anything.
    #[serde(skip_serializing_if = "are_none")]
    pub tilt: [Option<StageControl>; 2],
    /// What changes of the bulk stresses of the lower and of the upper body along x and y, if anything; forces all.
    #[serde(skip_serializing_if = "are_all_none")]
    pub bulk_stress: [[Option<StageControl>; 2]; 2],
    /// Increments of the stage, or of one cycle, all rows of a table included.
    pub increments: usize,
    /// Each increment is solved in as many parts as this bound on the error of its history asks for (in shares of the way that the
    /// tractions go in it). Default: in one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub history_tolerance: Option<f64>,
    /// How the stage runs through its increments.
    pub course: Course,
    /// Friction from this stage on. Default: as before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<CoulombFriction>,
}

fn are_none(controls: &[Option<StageControl>; 2]) -> bool {
    controls.iter().all(Option::is_none)
}

fn are_all_none(controls: &[[Option<StageControl>; 2]; 2]) -> bool {
    controls.iter().all(are_none)
}

/// What a stage prescribes in one direction, and how it runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StageControl {
    /// A force [force] or moment [force x length].
    Force(Path),
    /// A motion [length] or rotation [rad].
    Motion(Path),
    /// The motion of the far end of the machine's spring [length].
    FarEnd(Path),
}

/// How a stage runs from where it starts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Course {
    /// Equal steps to the target, or from row to row of a table.
    Linear,
    /// Forces with the third power of the share done, approach with the second: a sphere's contact radius grows evenly.
    Cubic,
    /// The same again and again.
    Cycles(Cycles),
}

/// Cycles of a stage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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

/// Shape of a cycle: 0, +1, -1, 0 at the shares 0, 1/4, 3/4, 1 of its length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Waveform {
    /// Straight lines.
    Triangle,
    /// A sine.
    Sine,
    /// Straight lines with both extremes held for this share of the cycle.
    Trapezoid {
        /// Share of the cycle, below a half.
        dwell: f64,
    },
}

/// What a control runs through.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// Whether it is zero all along, when it starts there.
    pub fn is_zero(&self) -> bool {
        match self {
            Self::To(value) | Self::Wave { amplitude: value, .. } => *value == 0.0,
            Self::Through(values) => values.iter().all(|value| *value == 0.0),
        }
    }
}

impl Waveform {
    /// Turning points of a cycle: share of the cycle, and value.
    fn corners(self) -> Vec<(f64, f64)> {
        match self {
            Self::Triangle => vec![(0.25, 1.0), (0.75, -1.0)],
            Self::Sine => vec![(0.0, 0.0), (0.25, 1.0), (0.5, 0.0), (0.75, -1.0)],
            Self::Trapezoid { dwell } => {
                let half = 0.5 * dwell;
                vec![(0.25 - half, 1.0), (0.25 + half, 1.0), (0.75 - half, -1.0), (0.75 + half, -1.0)]
            }
        }
    }

    /// Fewest increments of a cycle that meet all turning points.
    pub fn fewest_increments(self) -> usize {
        match self {
            Self::Triangle | Self::Sine => 4,
            Self::Trapezoid { dwell } => (1.0 / dwell.min(0.5 - dwell)).ceil() as usize,
        }
    }

    /// Height after `k` of `increments` steps a cycle, ahead by a share `phase` of a cycle. The turning points are met, each
    /// at the increment nearest to it.
    pub fn at(self, k: usize, increments: usize, phase: f64) -> f64 {
        let n = increments as f64;
        let k = (k % increments) as f64;
        let corners = self.corners();
        // The corners in increments, one cycle before and two after: those on both sides of k are among them.
        let mut before = (f64::NEG_INFINITY, 0.0, 0.0);
        let mut after = (f64::INFINITY, 0.0, 0.0);
        for turn in -2..=2 {
            for &(share, value) in &corners {
                let share = share + f64::from(turn);
                let place = nearest((share - phase) * n);
                if place <= k && place >= before.0 {
                    before = (place, share, value);
                }
                if place > k && place < after.0 {
                    after = (place, share, value);
                }
            }
        }
        if before.0 == k {
            return before.2;
        }
        let done = (k - before.0) / (after.0 - before.0);
        match self {
            Self::Sine => (TAU * (before.1 + (after.1 - before.1) * done)).sin(),
            // A line through zero is taken from there, so that a cycle ends exactly where it began.
            _ if before.2 == -after.2 => before.2 * (after.0 + before.0 - 2.0 * k) / (after.0 - before.0),
            _ => before.2 + (after.2 - before.2) * done,
        }
    }
}

/// The nearest whole number; halves go to the even one, also when rounding has moved them a little.
fn nearest(place: f64) -> f64 {
    const FINE: f64 = (1_u64 << 20) as f64;
    ((place * FINE).round() / FINE).round_ties_even()
}

impl Stage {
    /// Increments of the whole stage, at the most.
    pub fn increments_in_all(&self) -> usize {
        match self.course {
            Course::Cycles(cycles) => self.increments * cycles.most,
            Course::Linear | Course::Cubic => self.increments,
        }
    }

    /// Cycles of the stage, when it has any.
    pub fn cycles(&self) -> Option<&Cycles> {
        match &self.course {
            Course::Cycles(cycles) => Some(cycles),
            Course::Linear | Course::Cubic => None,
        }
    }

    /// Whether increment `k` (from 1) is the last of a cycle.
    pub fn ends_cycle(&self, k: usize) -> bool {
        self.cycles().is_some() && k.is_multiple_of(self.increments)
    }

    /// Value of a control at the end of increment `k` (from 1), when the stage found it at `start`.
    pub fn value(&self, control: &StageControl, start: f64, k: usize) -> f64 {
        let path = control.path();
        match (path, &self.course) {
            (Path::To(target), _) if k == self.increments => *target,
            (Path::To(target), course) => {
                let power = match (course, control) {
                    (Course::Cubic, StageControl::Force(_)) => 3,
                    (Course::Cubic, StageControl::Motion(_) | StageControl::FarEnd(_)) => 2,
                    _ => 1,
                };
                start + (target - start) * (k as f64 / self.increments as f64).powi(power)
            }
            (Path::Wave { amplitude, phase }, Course::Cycles(cycles)) => {
                let [first, last] = cycles.envelope;
                let share = first + (last - first) * k as f64 / self.increments_in_all() as f64;
                let wave = |k| cycles.waveform.at(k, self.increments, *phase);
                start + amplitude * (share * wave(k) - first * wave(0))
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
        let one = |control: &Option<StageControl>, start: Control| match (control, start) {
            (None, start) => start,
            (Some(control), start) => control.prescribing(self.value(control, start.value(), k)),
        };
        LoadStep {
            normal: one(&self.normal, start.normal),
            tangential: [0, 1].map(|axis| one(&self.tangential[axis], start.tangential[axis])),
            twist: one(&self.twist, start.twist),
            tilt: [0, 1].map(|axis| one(&self.tilt[axis], start.tilt[axis])),
            bulk_stress: [0, 1].map(|body| {
                [0, 1].map(|axis| {
                    let from = start.bulk_stress[body][axis];
                    let control = self.bulk_stress[body][axis].as_ref();
                    control.map_or(from, |control| self.value(control, from, k))
                })
            }),
        }
    }

    /// All that the stage prescribes.
    pub fn controls(&self) -> impl Iterator<Item = &StageControl> {
        let rigid = [&self.normal, &self.tangential[0], &self.tangential[1], &self.twist];
        let bulk = self.bulk_stress.iter().flatten();
        rigid.into_iter().chain(&self.tilt).chain(bulk).flatten()
    }

    /// Whether the stage prescribes a bulk stress.
    pub fn stretches(&self) -> bool {
        self.bulk_stress.iter().flatten().any(Option::is_some)
    }

    /// Whether the stage prescribes a tilt or its moment.
    pub fn tilts(&self) -> bool {
        self.tilt.iter().any(Option::is_some)
    }
}

impl StageControl {
    /// What it runs through.
    pub fn path(&self) -> &Path {
        let (Self::Force(path) | Self::Motion(path) | Self::FarEnd(path)) = self;
        path
    }

    /// A value of this control's kind.
    pub fn prescribing(&self, value: f64) -> Control {
        match self {
            Self::Force(_) => Control::Force(value),
            Self::Motion(_) => Control::Motion(value),
            Self::FarEnd(_) => Control::FarEnd(value),
        }
    }

    /// Whether it prescribes a motion, of the body or of the actuator.
    pub fn is_motion(&self) -> bool {
        matches!(self, Self::Motion(_) | Self::FarEnd(_))
    }
}

/// Controls as far as they follow from the case alone: a control that changes its kind starts from what the run reaches.
pub type KnownLoads = [Option<Control>; 4];

/// Visits the loads of a history that starts from `start`, or from free bodies, as far as the case fixes them: number of the stage, and the loads at the end of an increment.
/// Of a stage with cycles the first and the last are visited: its envelope is linear.
pub fn walk(start: Option<&LoadStep>, stages: &[Stage], mut visit: impl FnMut(usize, &KnownLoads)) {
    let LoadStep { normal, tangential: [x, y], twist, .. } = start.unwrap_or(&LoadStep::FREE);
    let mut held: KnownLoads = [normal, x, y, twist].map(|control| Some(*control));
    for (number, stage) in stages.iter().enumerate() {
        let controls = [&stage.normal, &stage.tangential[0], &stage.tangential[1], &stage.twist];
        let start = held;
        let all = stage.increments_in_all();
        let first = 1..=stage.increments;
        for k in first.chain((all - stage.increments + 1).max(stage.increments + 1)..=all) {
            for (index, control) in controls.iter().enumerate() {
                let Some(control) = control else { continue };
                held[index] = known(stage, control, start[index], k);
            }
            visit(number, &held);
        }
    }
}

fn known(stage: &Stage, control: &StageControl, start: Option<Control>, k: usize) -> Option<Control> {
    let path = control.path();
    match (control, start) {
        (StageControl::Force(_), Some(Control::Force(from)))
        | (StageControl::Motion(_), Some(Control::Motion(from)))
        | (StageControl::FarEnd(_), Some(Control::FarEnd(from))) => {
            Some(control.prescribing(stage.value(control, from, k)))
        }
        _ => match path {
            Path::To(_) if k < stage.increments => None,
            Path::Through(values) if k < stage.increments / values.len().max(1) => None,
            Path::Wave { .. } => None,
            Path::To(_) | Path::Through(_) => Some(control.prescribing(stage.value(control, 0.0, k))),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::{KnownLoads, Path, Stage, Waveform, walk};
    use crate::case::{Attachments, Case};
    use crate::model::Control::{self, FarEnd, Force, Motion};
    use crate::model::LoadStep;

    const WAVES: [Waveform; 3] = [Waveform::Triangle, Waveform::Sine, Waveform::Trapezoid { dwell: 0.2 }];

    #[test]
    fn a_wave_meets_its_turns_for_any_number_of_increments_and_any_phase() {
        for wave in WAVES {
            for increments in wave.fewest_increments()..40 {
                for phase in [0.0, 0.25, 0.1, -0.4, 0.75] {
                    let values: Vec<f64> = (1..=increments).map(|k| wave.at(k, increments, phase)).collect();
                    assert!(
                        values.contains(&1.0) && values.contains(&-1.0),
                        "{wave:?} {increments} {phase}: {values:?}"
                    );
                    assert!(values.iter().all(|value| value.abs() <= 1.0));
                    assert_eq!(wave.at(increments, increments, phase), wave.at(0, increments, phase));
                }
            }
        }
    }

    #[test]
    fn a_wave_without_phase_ends_at_zero() {
        for wave in WAVES {
            for increments in wave.fewest_increments()..40 {
                assert_eq!(wave.at(increments, increments, 0.0), 0.0, "{wave:?} {increments}");
            }
        }
    }

    #[test]
    fn waves_are_what_their_names_say() {
        for k in 0..48 {
            let share = k as f64 / 48.0;
            let sine = (std::f64::consts::TAU * (share + 0.125)).sin();
            // Rounding of the sine's argument.
            assert!((Waveform::Sine.at(k, 48, 0.125) - sine).abs() < 1e-14);
            let triangle = (std::f64::consts::TAU * share).sin().asin() / std::f64::consts::FRAC_PI_2;
            // The inverse sine loses half of the digits at the turns.
            assert!((Waveform::Triangle.at(k, 48, 0.0) - triangle).abs() < 1e-7);
            let trapezoid = (triangle / (1.0 - 4.0 * 0.125)).clamp(-1.0, 1.0);
            assert!((Waveform::Trapezoid { dwell: 0.25 }.at(k, 48, 0.0) - trapezoid).abs() < 1e-7);
        }
    }

    #[test]
    fn a_trapezoid_needs_an_increment_for_its_shorter_piece() {
        for (dwell, fewest) in [(0.25, 4), (0.2, 5), (0.3, 5), (0.1, 10), (0.375, 8)] {
            assert_eq!(Waveform::Trapezoid { dwell }.fewest_increments(), fewest, "{dwell}");
        }
        assert_eq!([Waveform::Triangle, Waveform::Sine].map(Waveform::fewest_increments), [4, 4]);
    }

    #[test]
    fn turns_halfway_between_increments_are_met_at_the_even_one() {
        // a quarter of six increments is 1.5, three quarters 4.5
        let values: Vec<f64> = (0..6).map(|k| Waveform::Triangle.at(k, 6, 0.0)).collect();
        assert_eq!(values, [0.0, 0.5, 1.0, 0.0, -1.0, -0.5]);
        // a sine between its turns at 0, 2, 3, 4 and 6
        let half = (std::f64::consts::FRAC_PI_4).sin();
        let values = [1, 5].map(|k| Waveform::Sine.at(k, 6, 0.0));
        assert!((values[0] - half).abs() < 1e-15 && (values[1] + half).abs() < 1e-15, "{values:?}");
        // phases that rounding has moved off a half: 1.5 +- 1e-9 increments are 1.5
        for small in [1e-10, -1e-10] {
            assert_eq!(Waveform::Triangle.at(2, 6, small), 1.0);
        }
    }

    /// The stages of a case with these tables [[load]] behind its first.
    fn stages(loads: &str, table: &str) -> Vec<Stage> {
        let text = format!(
            "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n[lower]\n\
             substrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.sphere]\nradius = 100.0\n\
             [friction]\ncoefficient = 0.5\n[rig]\nnormal_stiffness = 1.0\ntangential_stiffness = 1.0\n\
             [[load]]\nnormal_force = 64.0\nincrements = 4\nramp = \"cubic\"\n{loads}"
        );
        let files = |_: &str| Ok(table.as_bytes().to_vec());
        Case::from_toml_with(&text, "case.toml", Attachments::files(&files)).unwrap().stages
    }

    fn normal(stage: &Stage, start: f64) -> Vec<f64> {
        let control = stage.normal.as_ref().unwrap();
        (1..=stage.increments_in_all()).map(|k| stage.value(control, start, k)).collect()
    }

    #[test]
    fn ramps_go_from_where_the_stage_starts_to_their_end() {
        let stages = stages(
            "[[load]]\napproach = 32.0\nincrements = 4\nramp = \"cubic\"\n[[load]]\nnormal_force = 5.0\nincrements = 4\n\
             [[load]]\nactuator_approach = 16.0\nincrements = 4\nramp = \"cubic\"\n",
            "",
        );
        // forces with the third power, motions with the second, straight lines with the first
        assert_eq!(normal(&stages[0], 0.0), [1.0, 8.0, 27.0, 64.0]);
        assert_eq!(normal(&stages[1], 16.0), [17.0, 20.0, 25.0, 32.0]);
        assert_eq!(normal(&stages[2], 3.0), [3.5, 4.0, 4.5, 5.0]);
        assert_eq!(normal(&stages[3], 0.0), [1.0, 4.0, 9.0, 16.0]);
        for stage in &stages {
            assert_eq!((stage.increments_in_all(), stage.cycles()), (4, None));
            assert!((1..=4).all(|k| !stage.ends_cycle(k)));
        }
    }

    #[test]
    fn waves_grow_with_their_envelope_and_start_where_the_control_is() {
        let stages = stages(
            "[[load]]\nnormal_force = 8.0\nincrements = 4\ncycles = 2\nenvelope = [0.5, 1.5]\n\
             [[load]]\nnormal_force = 8.0\nincrements = 4\ncycles = 2\nenvelope = [0.5, 1.5]\nphase = { normal_force = 90.0 }\n",
            "",
        );
        // shares of 5/8, 6/8, ... of a wave of 8
        assert_eq!(normal(&stages[1], 40.0), [45.0, 40.0, 33.0, 40.0, 49.0, 40.0, 29.0, 40.0]);
        // a quarter ahead: from the top, 0.5 * 8 above the middle
        assert_eq!(normal(&stages[2], 40.0), [36.0, 30.0, 36.0, 44.0, 36.0, 26.0, 36.0, 48.0]);
        assert_eq!(stages[1].increments_in_all(), 8);
        let ends: Vec<usize> = (1..=8).filter(|&k| stages[1].ends_cycle(k)).collect();
        assert_eq!(ends, [4, 8]);
        assert_eq!(stages[1].cycles().unwrap().most, 2);
    }

    #[test]
    fn tables_are_followed_from_row_to_row_and_again() {
        let stages = stages(
            "[[load]]\ntable = \"path.csv\"\nincrements = 2\n[[load]]\ntable = \"path.csv\"\nincrements = 2\ncycles = 2\n",
            "normal_force,twist\n10,1\n4,0\n6,3\n",
        );
        assert_eq!(stages[1].increments, 6);
        assert_eq!(normal(&stages[1], 2.0), [6.0, 10.0, 7.0, 4.0, 5.0, 6.0]);
        // the second cycle starts from the last row
        let twice = [6.0, 10.0, 7.0, 4.0, 5.0, 6.0, 8.0, 10.0, 7.0, 4.0, 5.0, 6.0];
        assert_eq!(normal(&stages[2], 2.0), twice);
    }

    #[test]
    fn a_stage_prescribes_its_controls_and_leaves_the_others() {
        let stages = stages(
            "[[load]]\ntangential_force = [4.0, \"held\"]\nshift = [\"held\", 8.0]\ntwist_moment = 2.0\ntilt = [\"held\", 6.0]\n\
             bulk_stress = [10.0, \"held\"]\nupper_bulk_stress = [\"held\", 20.0]\nincrements = 2\n\
             [[load]]\nactuator = [2.0, 4.0]\nincrements = 2\n",
            "",
        );
        let before = LoadStep {
            normal: Motion(7.0),
            tangential: [Force(2.0), Motion(4.0)],
            twist: Force(0.0),
            tilt: [Force(1.0), Motion(2.0)],
            bulk_stress: [[2.0, 3.0], [4.0, 5.0]],
        };
        let half = LoadStep {
            normal: Motion(7.0),
            tangential: [Force(3.0), Motion(6.0)],
            twist: Force(1.0),
            tilt: [Force(1.0), Motion(4.0)],
            bulk_stress: [[6.0, 3.0], [4.0, 12.5]],
        };
        assert_eq!(stages[1].load(&before, 1), half);
        assert_eq!(stages[2].load(&before, 2).tangential, [FarEnd(2.0), FarEnd(4.0)]);
        let counts: Vec<usize> = stages.iter().map(|stage| stage.controls().count()).collect();
        assert_eq!(counts, [1, 6, 2]);
        let motions: Vec<bool> =
            stages[1..].iter().flat_map(Stage::controls).map(super::StageControl::is_motion).collect();
        assert_eq!(motions, [false, true, false, true, false, false, true, true]);
        let words = |stage: &Stage| (stage.is_tangential(), stage.tilts(), stage.stretches());
        assert_eq!(words(&stages[0]), (false, false, false));
        assert_eq!(words(&stages[1]), (true, true, true));
        assert_eq!(words(&stages[2]), (true, false, false));
        // what a stage leaves is not written
        let written = |stage: &Stage| serde_json::to_string(stage).unwrap();
        for key in ["\"tilt\"", "\"bulk_stress\""] {
            assert!(written(&stages[1]).contains(key) && !written(&stages[0]).contains(key));
        }
    }

    #[test]
    fn paths_of_zeros_are_zero() {
        assert!(Path::To(0.0).is_zero() && !Path::To(1.0).is_zero());
        for (amplitude, zero) in [(0.0, true), (0.5, false)] {
            assert_eq!(Path::Wave { amplitude, phase: 0.5 }.is_zero(), zero);
            assert_eq!(Path::Through(vec![0.0, amplitude, 0.0]).is_zero(), zero);
        }
    }

    /// What a walk sees of one control.
    fn seen(start: Option<&LoadStep>, stages: &[Stage], index: usize) -> Vec<(usize, Option<Control>)> {
        let mut all = Vec::new();
        walk(start, stages, |number, loads: &KnownLoads| all.push((number, loads[index])));
        all
    }

    #[test]
    fn a_walk_knows_what_follows_from_the_case() {
        let stages = stages(
            "[[load]]\napproach = 2.0\nincrements = 2\n[[load]]\napproach = 3.0\nincrements = 4\ncycles = 5\n\
             [[load]]\ntable = \"path.csv\"\nincrements = 2\n[[load]]\nnormal_force = 4.0\nincrements = 4\ncycles = 1\n",
            "normal_force\n10\n4\n",
        );
        let force = |value: f64| Some(Force(value));
        let motion = |value: f64| Some(Motion(value));
        let first = [1.0, 8.0, 27.0, 64.0].map(|value| (0, force(value)));
        // where the approach begins nobody knows; where it ends, the case says
        let second = [(1, None), (1, motion(2.0))];
        // of five cycles the first and the last
        let third = [5.0, 2.0, -1.0, 2.0].map(|value| (2, motion(value)));
        // a force by rows, from a motion: from the first row on
        let fourth = [None, force(10.0), force(7.0), force(4.0)].map(|value| (3, value));
        let fifth = [8.0, 4.0, 0.0, 4.0].map(|value| (4, force(value)));
        let all = [&first[..], &second, &third, &third, &fourth, &fifth].concat();
        assert_eq!(seen(None, &stages, 0), all);
        // from a solved state: forces of 10 in x
        let start = LoadStep { tangential: [Force(10.0), Force(0.0)], ..LoadStep::FREE };
        assert!(seen(Some(&start), &stages, 1).iter().all(|(_, x)| *x == force(10.0)));
        // a wave of another kind than what was held has no known middle
        let moved = LoadStep { normal: Motion(1.0), ..LoadStep::FREE };
        assert_eq!(seen(Some(&moved), &stages[4..], 0), [(0, None); 4]);
    }
}
