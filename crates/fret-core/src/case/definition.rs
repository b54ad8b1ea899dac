//! A case: the whole question, checked.

use serde::{Deserialize, Serialize};

use super::output::Output;
use super::stress::StressRequest;
use crate::document::{Mistake, Refusal as CaseError};
use crate::kernel::uniform_response;
use crate::model::stage::Stage;
use crate::model::{
    Beyond, CellMap, Conduction, ContactPair, CoulombFriction, Dimension, FrictionEvolution, GridSize,
    Heights, HeightsSummary, Integration, Kinematics, LoadStep, MapSummary, Periodicity, Profile,
    ResidualStress, Rig, Scheme, WearRule,
};
use crate::subsurface::fatigue::LayerConstants;
use crate::units::Units;

/// A case that has passed every check; with its maps and heights, or as a record of a run has it ([`CaseRecord`]).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Case<M = CellMap, H = Heights> {
    /// Title, or an empty text.
    pub title: String,
    /// Units that the case declares.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub units: Option<Units>,
    /// Cells `[nx, ny]`; `[n, 1]` in a line contact.
    pub cells: [usize; 2],
    /// Side lengths of the grid.
    pub size: GridSize,
    /// Depth below the load that approach and shift are relative to \[length\], of a contact that is [endless](Case::endless_axis) along an
    /// axis; `None`: the size of the grid across it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub datum: Option<f64>,
    /// What lies beyond the edge of the grid.
    #[serde(default, skip_serializing_if = "Beyond::is_body")]
    pub beyond: Beyond,
    /// Along which axes the problem repeats.
    pub periodic: Periodicity,
    /// The two bodies.
    pub bodies: ContactPair,
    /// The pressure at which the softer surface yields \[pressure\]; `None`: neither does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness: Option<f64>,
    /// Residual stress of the lower and of the upper body.
    #[serde(default, skip_serializing_if = "are_none")]
    pub residual_stress: [ResidualStress; 2],
    /// Constants for fatigue and fracture of the layers of the lower and of the upper body.
    #[serde(default, skip_serializing_if = "have_no_constants")]
    pub fatigue: [LayerConstants; 2],
    /// What the bodies conduct, and how often they rub.
    #[serde(default, skip_serializing_if = "Conduction::is_none")]
    pub conduction: Conduction,
    /// Undeformed gap.
    pub profile: Profile<H>,
    /// How the surfaces move against each other.
    #[serde(default, skip_serializing_if = "Kinematics::is_default")]
    pub kinematics: Kinematics,
    /// Friction law at the start; stages may change it.
    pub friction: CoulombFriction<M>,
    /// How the friction coefficient evolves, where it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_evolution: Option<FrictionEvolution>,
    /// The machine between the upper body and what is driven, where it gives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rig: Option<Rig>,
    /// Columns of a log that was measured on the machine: what each holds (`displacement`, `force`, `cycle`, `normal_force`), its name.
    #[serde(skip)]
    pub log_columns: Vec<(&'static str, String)>,
    /// What is prescribed where the history starts; `None`: bodies that have not touched yet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<LoadStep>,
    /// Loading history.
    pub stages: Vec<Stage<M>>,
    /// How the surfaces wear, when they do.
    pub wear: Option<WearRule>,
    /// Bound on the residual of every increment.
    pub tolerance: f64,
    /// How coupled pressure and shear are solved.
    pub scheme: Scheme,
    /// How slip is integrated over an increment.
    pub integration: Integration,
    /// What is kept.
    pub output: Output,
    /// What is asked about stresses under the surface.
    pub stress: Option<StressRequest>,
    /// Where the case was written, for messages.
    #[serde(skip)]
    pub(crate) origin: Origin,
}

/// A case as a record of a run has it: with what tells its maps and heights apart.
pub type CaseRecord = Case<MapSummary, HeightsSummary>;

fn are_none(residual: &[ResidualStress; 2]) -> bool {
    residual.iter().all(ResidualStress::is_none)
}

fn have_no_constants(layers: &[LayerConstants; 2]) -> bool {
    layers.iter().all(LayerConstants::is_none)
}

/// The text a case was read from, and where in it things stand.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Origin {
    pub name: String,
    pub text: String,
    pub size: std::ops::Range<usize>,
}

impl Origin {
    /// A refusal of the case.
    fn refuse(&self, mistakes: Vec<Mistake>) -> CaseError {
        CaseError::new(&self.name, &self.text, mistakes)
    }

    /// Where a table is named first; `None` of a case that no text was read for.
    fn place_of(&self, table: &str) -> Option<std::ops::Range<usize>> {
        let tables = toml::de::DeTable::parse(&self.text).ok()?.into_inner();
        tables.keys().find(|written| written.get_ref().as_ref() == table).map(toml::Spanned::span)
    }
}

/// A place in which a case differs from the setting of a state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Dotted key of the case.
    pub key: String,
    /// What the case has.
    pub case: String,
    /// What the state has.
    pub state: String,
}

impl<M, H> Case<M, H> {
    /// Whether its contact has two axes or is a line contact.
    pub fn dimension(&self) -> Dimension {
        Dimension::of(self.cells)
    }

    /// The head of a column: its name, with its unit in brackets where the case declares units; `kind` as in `force x length`.
    pub fn heading(&self, name: &str, kind: &str) -> String {
        Units::heading(self.units.as_ref(), name, kind, self.dimension())
    }

    /// Whether it is a line contact: plane strain across a line along y, all loads per unit length.
    pub fn is_line(&self) -> bool {
        self.dimension() == Dimension::Line
    }

    /// The axis (0: x, 1: y) along which the contact has no end, while it has one along the other: that of a line contact, or the only one along
    /// which the problem repeats. Approach and shift are relative to a datum then.
    pub fn endless_axis(&self) -> Option<usize> {
        match self.dimension() {
            Dimension::Line => Some(1),
            Dimension::Plane => self.periodic.one_axis(),
        }
    }

    /// Whether the bodies have a mean gap in place of an approach: periodic half-spaces, which a uniform pressure moves without bound.
    pub fn counts_mean_gap(&self) -> bool {
        self.periodic.is_both() && uniform_response(&self.bodies).is_none()
    }

    /// Springs between the upper body and what is driven.
    pub fn springs(&self) -> Rig {
        self.rig.unwrap_or(Rig::RIGID)
    }

    /// Whether the upper body is tilted along an axis (0: x, 1: y) by any stage, or where the history starts.
    pub fn tilts(&self, axis: usize) -> bool {
        let starts = self.start.is_some_and(|loads| loads.tilt[axis] != LoadStep::FREE.tilt[axis]);
        starts || self.stages.iter().any(|stage| stage.tilt[axis].is_some())
    }

    /// Whether the history may end before all its increments: a stage that stops when it is steady, cycle jumps, or wear up to a
    /// limit.
    pub fn is_open_ended(&self) -> bool {
        let steady = |stage: &Stage<M>| stage.cycles().is_some_and(|cycles| cycles.until_steady.is_some());
        self.stages.iter().any(steady)
            || self.friction_evolution.as_ref().is_some_and(|evolution| evolution.every > 1)
            || self.wear.as_ref().is_some_and(|wear| wear.every > 1 || wear.limit.is_some())
    }

    /// Increments of the whole history, at the most.
    pub fn increments(&self) -> usize {
        self.stages.iter().map(Stage::increments_in_all).sum()
    }
}

impl Case {
    /// Whether the contact rolls in any stage, or has rolled where the history starts.
    pub fn rolls(&self) -> bool {
        let starts = self.start.is_some_and(|loads| loads.roll != [0.0; 2]);
        starts || self.stages.iter().any(Stage::rolls)
    }

    /// Whether there is no friction anywhere in the whole history.
    pub fn is_frictionless(&self) -> bool {
        let changes = self.stages.iter().filter_map(|stage| stage.friction.as_ref());
        std::iter::once(&self.friction).chain(changes).all(CoulombFriction::is_frictionless)
    }

    /// The friction law of a stage, unless friction evolves.
    pub fn friction_of(&self, stage: usize) -> &CoulombFriction {
        let mut latest_first = self.stages.iter().take(stage + 1).rev();
        latest_first.find_map(|stage| stage.friction.as_ref()).unwrap_or(&self.friction)
    }

    /// Whether friction is another in a stage than in the one before.
    pub fn friction_changes_at(&self, stage: usize) -> bool {
        stage > 0 && self.friction_of(stage) != self.friction_of(stage - 1)
    }

    /// Refuses the case for its grid's side lengths.
    pub(crate) fn refuse_size(&self, message: String, help: &str) -> CaseError {
        let help = (!help.is_empty()).then(|| help.to_owned());
        self.origin.refuse(vec![Mistake { message, help, span: Some(self.origin.size.clone()) }])
    }

    /// Refuses the case for what one of its tables says.
    pub(crate) fn refuse_table(&self, table: &str, message: String, help: String) -> CaseError {
        self.origin.refuse(vec![Mistake { message, help: Some(help), span: self.origin.place_of(table) }])
    }

    /// Refuses the case for the state that its history would start from, which is one of another setting.
    pub(crate) fn refuse_start(&self, differences: &[Difference]) -> CaseError {
        let mistakes = differences.iter().map(|Difference { key, case, state }| {
            let table = key.split(['.', '[']).next().unwrap_or_default();
            Mistake {
                message: format!("{key} = {case}: the state to start from has {state}"),
                help: Some(
                    "grid, bodies and profile are those of the state; loads, friction and wear may differ"
                        .to_owned(),
                ),
                span: self.origin.place_of(table),
            }
        });
        self.origin.refuse(mistakes.collect())
    }

    /// Whether fields are kept of increment `k` (from 1) of a stage: of every `output.every`-th, and of the last.
    pub fn keeps(&self, stage: usize, k: usize) -> bool {
        self.output.every.is_some_and(|every| k.is_multiple_of(every))
            || k == self.stages[stage].increments_in_all()
    }

    /// Numbers in the whole history, from 0, of the increments whose fields are kept.
    pub fn kept_increments(&self) -> Vec<usize> {
        let mut kept = Vec::new();
        let mut before = 0;
        for (number, stage) in self.stages.iter().enumerate() {
            let all = stage.increments_in_all();
            kept.extend((1..=all).filter(|&k| self.keeps(number, k)).map(|k| before + k - 1));
            before += all;
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{BALL, ROLLER, read};

    const MORE: &str = "increments = 5\n[[load]]\ntangential_force = [1e-3, 0.0]\ncycles = 2\nincrements = 4";

    #[test]
    fn kept_are_every_so_many_increments_and_the_last_of_a_stage() {
        let kept = |output: &str| {
            let case =
                read(BALL, &[("increments = 1", MORE), ("[friction]", &format!("{output}[friction]"))]);
            assert_eq!(case.increments(), 13);
            case.kept_increments()
        };
        assert_eq!(kept(""), [4, 12]);
        // of five increments the second, the fourth and the last; of eight every second
        assert_eq!(kept("[output]\nevery = 2\n"), [1, 3, 4, 6, 8, 10, 12]);
        assert_eq!(kept("[output]\nevery = 3\n"), [2, 4, 7, 10, 12]);
    }

    #[test]
    fn a_history_is_open_ended_when_something_may_end_it() {
        let open = |changes: &[(&str, &str)]| read(BALL, changes).is_open_ended();
        let wear = |words: &str| format!("[wear]\ncoefficient = 1e-3\n{words}\n[friction]");
        let steady = "increments = 1\n[[load]]\ntangential_force = [1e-3, 0.0]\nincrements = 4\n\
                      until_steady = { tolerance = 1e-3, most_cycles = 3 }";
        assert!(!open(&[]) && !open(&[("increments = 1", MORE)]));
        assert!(open(&[("increments = 1", steady)]));
        assert!(!open(&[("increments = 1", MORE), ("[friction]", &wear(""))]));
        assert!(!open(&[("increments = 1", MORE), ("[friction]", &wear("every = 1"))]));
        assert!(open(&[("increments = 1", MORE), ("[friction]", &wear("every = 2"))]));
        assert!(open(&[("increments = 1", MORE), ("[friction]", &wear("limit = 0.5"))]));
        let evolving = |every: usize| {
            let law = format!(
                "coefficient = 0.3\nevolution = {{ by = \"energy\", last = 0.4, scale = 1.0, every = {every} }}"
            );
            open(&[("increments = 1", MORE), ("coefficient = 0.3", &law)])
        };
        assert_eq!([1, 2].map(evolving), [false, true]);
    }

    #[test]
    fn tilts_and_lines_are_known() {
        let tilted = |words: &str| {
            let stage = format!("increments = 1\n[[load]]\nincrements = 1\n{words}");
            let case = read(BALL, &[("increments = 1", &stage)]);
            [case.tilts(0), case.tilts(1)]
        };
        assert_eq!(tilted("shift = [1e-3, 0.0]"), [false, false]);
        assert_eq!(tilted("tilt = [1e-3, \"held\"]"), [true, false]);
        assert_eq!(tilted("tilt_moment = [\"held\", 1e-6]"), [false, true]);
        assert!(read(ROLLER, &[]).is_line() && !read(BALL, &[]).is_line());
    }

    /// A case from a state that was reached with a tilt along y.
    #[test]
    fn a_case_that_starts_from_a_state_knows_its_tilt() {
        use crate::case::{Attachments, Case};
        use crate::model::{Control, LoadStep};
        let start = LoadStep { tilt: [LoadStep::FREE.tilt[0], Control::Motion(1e-3)], ..LoadStep::FREE };
        let attachments = Attachments::none().starting_from(Some(start));
        let case = Case::from_toml_with(BALL, "case.toml", attachments).unwrap();
        assert_eq!((case.start, [case.tilts(0), case.tilts(1)]), (Some(start), [false, true]));
        let case = Case::from_toml_with(BALL, "case.toml", Attachments::none()).unwrap();
        assert_eq!((case.start, [case.tilts(0), case.tilts(1)]), (None, [false, false]));
    }

    #[test]
    fn a_history_is_frictionless_when_no_stage_has_friction() {
        let none = ("coefficient = 0.3", "coefficient = 0.0");
        let later = |value: &str| format!("increments = 1\n[[load]]\nfriction = {value}\nincrements = 1");
        assert!(read(BALL, &[none]).is_frictionless() && !read(BALL, &[]).is_frictionless());
        assert!(read(BALL, &[none, ("increments = 1", &later("0.0"))]).is_frictionless());
        assert!(!read(BALL, &[none, ("increments = 1", &later("0.1"))]).is_frictionless());
    }

    #[test]
    fn a_machine_without_springs_is_rigid() {
        let rig = "[rig]\nnormal_stiffness = 2.0\ntangential_stiffness = 3.0\n[friction]";
        assert_eq!(read(BALL, &[]).springs(), crate::model::Rig::RIGID);
        let case = read(BALL, &[("[friction]", rig)]);
        assert_eq!(Some(case.springs()), case.rig);
        assert_ne!(case.springs(), crate::model::Rig::RIGID);
    }

    /// What bodies do not have does not stand in what a run keeps of its case.
    #[test]
    fn a_case_is_written_without_what_it_does_not_have() {
        let keys = |changes: &[(&str, &str)]| {
            let value = serde_json::to_value(read(BALL, changes)).unwrap();
            ["residual_stress", "fatigue", "conduction"].map(|key| value.get(key).is_some())
        };
        let substrate = "poisson = 0.3 }";
        assert_eq!(keys(&[]), [false; 3]);
        assert_eq!(keys(&[(substrate, "poisson = 0.3, residual_stress = -1.0 }")]), [true, false, false]);
        let constants = "poisson = 0.3, fatigue = { yield_strength = 1.0 } }";
        assert_eq!(keys(&[(substrate, constants)]), [false, true, false]);
    }

    #[test]
    fn a_state_of_another_setting_is_refused_at_the_table_that_differs() {
        use crate::case::Difference;
        let case = read(BALL, &[]);
        let difference =
            |key: &str| Difference { key: key.to_owned(), case: "1".to_owned(), state: "2".to_owned() };
        let error =
            case.refuse_start(&["profile.sphere.radius", "grid.cells", "lower[0].young"].map(difference));
        let places: Vec<_> =
            error.mistakes().iter().map(|one| BALL[one.span.clone().unwrap()].to_owned()).collect();
        assert_eq!(places, ["grid", "lower", "profile"]);
        assert_eq!(error.mistakes()[0].message, "grid.cells = 1: the state to start from has 2");
    }
}
