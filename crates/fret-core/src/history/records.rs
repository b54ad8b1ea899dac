//! What a run leaves behind: one record per increment, the fields asked for, the last state.

use ndarray::Array2;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::cycle::CycleRecord;
use super::footprint::Footprint;
use super::warning::Warning;
use crate::model::{ContactPair, ContactState, Periodicity, SolvedState, SurfaceGrid, WearLayers, Zone};
use crate::solver::{Regime, Residual, SolverMemory, Work, worst};

/// Debris between the surfaces of the whole contact; nothing where none stays.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct DebrisRecord {
    /// What lies between them [length^3].
    pub volume: f64,
    /// What has flowed out over the rim of the contact since the start, by all cycles that computed ones stand for [length^3].
    pub outflow: f64,
    /// Largest thickness [length].
    pub max_thickness: f64,
}

/// What has yielded of the whole contact; nothing where no surface yields.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PlasticRecord {
    /// Area at the hardness now [length^2]: its cells, as the cells in contact are counted.
    pub area: f64,
    /// Plastic depth summed over the surface [length^3].
    pub volume: f64,
    /// Largest plastic depth [length].
    pub max_depth: f64,
    /// Work that yielding has taken since the start [force x length]: the hardness times the volume.
    pub work: f64,
}

/// One increment of the history. Units are those of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepRecord {
    /// Number of the increment in the whole history, from 0.
    pub increment: usize,
    /// Number of its stage, from 0.
    pub stage: usize,
    /// Parts it was solved in: more than 1 where the division is left to the program, or where it was not solved as a whole.
    pub parts: usize,
    /// Normal force [force], compression positive.
    pub normal_force: f64,
    /// Rigid approach [length].
    pub approach: f64,
    /// Mean gap between the surfaces [length], where they repeat.
    pub mean_gap: Option<f64>,
    /// Tangential force on the lower body along x and y [force].
    pub tangential_force: [f64; 2],
    /// Rigid tangential displacement of the upper body [length].
    pub shift: [f64; 2],
    /// Normal displacement of the actuator [length]: the approach, and what the machine gives.
    pub actuator_approach: f64,
    /// Tangential displacement of the actuator [length]: the shift, and what the machine gives.
    pub actuator: [f64; 2],
    /// Moment about z on the lower body [force x length].
    pub twist_moment: f64,
    /// Rotation of the upper body about z [rad].
    pub twist: f64,
    /// Slope of the upper body along x and y [-], deeper towards positive x and y.
    pub tilt: [f64; 2],
    /// First moments of the pressure along x and y [force x length].
    pub tilt_moment: [f64; 2],
    /// Bulk stress of the lower and of the upper substrate, each along x and y [pressure].
    pub bulk_stress: [[f64; 2]; 2],
    /// Work of the bulk stresses on the contact since the start [force x length], with cycle jumps.
    pub bulk_work: f64,
    /// Largest pressure of a cell [pressure].
    pub max_pressure: f64,
    /// Largest shear traction of a cell [pressure].
    pub max_shear: f64,
    /// Area of contact [length^2], from the zero line of the pressure between cells.
    pub contact_area: f64,
    /// Area that sticks [length^2]: the contact area times the share of its cells that stick.
    pub stick_area: f64,
    /// Cells in contact.
    pub contact_cells: usize,
    /// Cells in contact that stick.
    pub stick_cells: usize,
    /// The contact as the cells see it.
    pub footprint: Footprint,
    /// Energy dissipated by friction since the start [force x length]. Where a computed cycle stands for several, its last increment has the
    /// work of all of them.
    pub dissipated_energy: f64,
    /// Elastic energy that the tractions of the contact store in both bodies and the interface [force x length], of a line contact relative
    /// to the datum. What the springs of a rig store is not in it.
    pub elastic_energy: f64,
    /// Work of the forces, the moments and the bulk stresses on the contact since the start [force x length], with cycle jumps. Its change in an
    /// increment is that of `elastic_energy`, `dissipated_energy`, `wear_work`, `plastic.work` and `unresolved_energy` together, to rounding.
    pub external_work: f64,
    /// Energy that has gone with what wore off since the start [force x length].
    pub wear_work: f64,
    /// What increments of finite length leave unresolved of the balance of energy since the start [force x length], with cycle jumps: an
    /// error bar of `dissipated_energy`.
    pub unresolved_energy: f64,
    /// Volume worn off since the start, by all cycles that computed ones stand for [length^3].
    pub worn_volume: f64,
    /// Largest worn depth [length].
    pub max_worn_depth: f64,
    /// Debris between the surfaces.
    #[serde(default)]
    pub debris: DebrisRecord,
    /// What has yielded.
    #[serde(default)]
    pub plastic: PlasticRecord,
    /// Mean coefficient of friction over the contact, weighted with the pressure [-].
    pub friction_coefficient: f64,
    /// Distance that the contact has rolled along x and y [length].
    pub roll: [f64; 2],
    /// Rigid displacement of the upper body by distance rolled in the increment, along x and y [-]; `None` where it does not roll.
    pub creepage: Option<[f64; 2]>,
    /// Its rotation by distance rolled [rad/length], likewise.
    pub spin: Option<f64>,
    /// Energy that friction dissipates in the increment by distance rolled [force], likewise.
    pub rolling_friction: Option<f64>,
    /// What the contact does.
    pub regime: Regime,
    /// How well the equations hold.
    pub residual: Residual,
    /// Work spent on the increment.
    pub work: Work,
    /// Time spent on the increment [s].
    pub wall_s: f64,
}

/// Fields kept of one increment, shape `(nx, ny)`; `None` where nobody asked.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptFields {
    /// Number of the increment in the whole history.
    pub increment: usize,
    /// Pressure [pressure].
    pub pressure: Option<Array2<f64>>,
    /// Shear on the lower body, x and y [pressure].
    pub shear: Option<[Array2<f64>; 2]>,
    /// Accumulated slip, x and y [length].
    pub slip: Option<[Array2<f64>; 2]>,
    /// Gap [length].
    pub gap: Option<Array2<f64>>,
    /// Zone of each cell.
    pub zone: Option<Array2<Zone>>,
    /// What friction dissipated in the increment by area [pressure x length].
    pub friction_work: Option<Array2<f64>>,
    /// Worn depth, of both bodies together [length].
    pub worn_depth: Option<Array2<f64>>,
    /// That of the lower and of the upper body, each in its own frame, where they move against each other [length].
    pub own_worn_depth: Option<[Array2<f64>; 2]>,
    /// Thickness of the debris between the surfaces [length], in the frame of the lower body.
    pub debris: Option<Array2<f64>>,
    /// Depth by which both surfaces together have yielded [length].
    pub plastic_depth: Option<Array2<f64>>,
    /// Coefficient of friction in force [-].
    pub friction: Option<Array2<f64>>,
    /// What another history needs besides these fields to start here; of every last increment of a stage, and where the fields
    /// are enough.
    pub rest: Option<Box<SolvedState>>,
    /// What the solver remembers at the end of a history of second order: one that starts here goes on as if it were the same.
    pub memory: Option<Box<SolverMemory>>,
}

/// All of a run.
#[derive(Debug, Clone)]
pub struct History {
    /// The grid the fields live on.
    pub grid: SurfaceGrid,
    /// The two bodies.
    pub bodies: ContactPair,
    /// Along which axes the scene repeats.
    pub periodic: Periodicity,
    /// Names of the stages.
    pub stages: Vec<String>,
    /// One record an increment.
    pub steps: Vec<StepRecord>,
    /// One record a cycle of the stages that have cycles.
    pub cycles: Vec<CycleRecord>,
    /// Where and when the surfaces were first worn through a coating, or to the limit. The history ends at the limit.
    pub worn_through: Option<WornThrough>,
    /// Volumes lost by the layers of both bodies; of cases whose layers have wear coefficients.
    pub worn_by_layer: Option<WornByLayer>,
    /// Kept fields, in the order of the increments.
    pub fields: Vec<KeptFields>,
    /// The last state reached.
    pub state: ContactState,
    /// What another history needs besides the last state to start from it.
    pub end: SolvedState,
    /// The plan it was solved by, as JSON.
    pub plan: Value,
    /// What about these numbers may mislead; of a run that was resumed, of the increments solved since.
    pub warnings: Vec<Warning>,
}

impl History {
    /// Work of all increments.
    pub fn work(&self) -> Work {
        let mut sum = Work::default();
        for step in &self.steps {
            sum += step.work;
        }
        sum
    }

    /// Largest residual of all increments.
    pub fn largest_residual(&self) -> f64 {
        worst(self.steps.iter().map(|step| step.residual.largest()))
    }

    /// Kept fields of an increment.
    pub fn fields_of(&self, increment: usize) -> Option<&KeptFields> {
        let position = self.fields.binary_search_by_key(&increment, |kept| kept.increment).ok()?;
        self.fields.get(position)
    }
}

/// What is worn through.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WornTo {
    /// A coating, outermost of its body.
    Coating,
    /// The depth at which the run ends.
    #[default]
    Limit,
}

/// The first place at which the surfaces are worn through a coating, or to the limit where that comes first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WornThrough {
    /// What is worn through. Earlier builds knew the limit alone, and did not say it.
    #[serde(default)]
    pub to: WornTo,
    /// Increment after which it happened, from 0.
    pub increment: usize,
    /// Stage, from 0.
    pub stage: usize,
    /// Cycles of that stage until then, those that a computed one stands for included.
    pub cycles: usize,
    /// Cell.
    pub cell: [usize; 2],
    /// Its centre [length].
    pub place: [f64; 2],
}

/// Volumes lost by each layer of the bodies [length^3], from the surface down, the substrate last. Of a body that does not wear none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WornByLayer {
    /// Of the lower body.
    pub lower: Vec<f64>,
    /// Of the upper body.
    pub upper: Vec<f64>,
}

impl WornByLayer {
    /// By layers, from the depth off both bodies together [length], in cells of an area [length^2].
    pub fn new(layers: &WearLayers, depth: &Array2<f64>, cell_area: f64) -> Self {
        let [mut lower, mut upper] = layers.bodies().map(|body| vec![0.0; body.len()]);
        for depth in depth {
            let lost = layers.by_layer(layers.at_depth(*depth).depths);
            for (sum, lost) in [&mut lower, &mut upper].into_iter().zip(lost) {
                sum.iter_mut().zip(lost).for_each(|(sum, depth)| *sum += depth);
            }
        }
        lower.iter_mut().chain(&mut upper).for_each(|volume| *volume *= cell_area);
        Self { lower, upper }
    }

    /// By layers, from the depths off the lower and the upper body [length], each in its own frame.
    pub fn of_bodies(layers: &WearLayers, depths: [&Array2<f64>; 2], cell_area: f64) -> Self {
        let [lower, upper] = [0, 1].map(|body| Self::new(&layers.of_body(body), depths[body], cell_area));
        Self { lower: lower.lower, upper: upper.upper }
    }
}
