//! A cycle seen as a whole: what tribologists read from its loop of force and displacement.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::case::Case;
use crate::model::controls::{TANGENTIAL, TILT, TWIST};
use crate::model::stage::Stage;

/// Energy ratio `W / (4 Q* d*)` above which a sphere slides: Fouvry, Kapsa & Vincent (1995), Wear 185, 35. It is what Mindlin
/// and Deresiewicz's loop has at `Q* = mu P`.
pub const SLIDING_ENERGY_RATIO: f64 = 0.2;

/// What drives a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Drive {
    /// A tangential force and shift.
    Tangential,
    /// A moment and twist about z.
    Torsional,
}

impl Drive {
    /// What drives all cycles of a case, as far as its stages say; `None` where both do.
    pub fn of<M, H>(case: &Case<M, H>) -> Option<Self> {
        let moves = |freedoms: Range<usize>| {
            let cycles = case.stages.iter().filter(|stage| stage.cycles().is_some());
            cycles.map(Stage::by_freedom).any(|controls| {
                controls[freedoms.clone()].iter().flatten().any(|control| !control.path().is_zero())
            })
        };
        match [moves(TANGENTIAL..TWIST), moves(TWIST..TILT)] {
            [_, false] => Some(Self::Tangential),
            [false, true] => Some(Self::Torsional),
            [true, true] => None,
        }
    }

    /// What drives all of some cycles; `None` where they differ.
    pub fn of_all(cycles: impl IntoIterator<Item = Self>) -> Option<Self> {
        let mut cycles = cycles.into_iter();
        let first = cycles.next().unwrap_or(Self::Tangential);
        cycles.all(|other| other == first).then_some(first)
    }
}

/// What the contact does over a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CycleRegime {
    /// No cell slips.
    FullStick,
    /// Some cells slip; no increment slides as a whole, and the energy ratio is below its bound.
    PartialSlip,
    /// The two criteria of sliding disagree: the contact slides as a whole at times, but the energy ratio is below its bound;
    /// or the other way round.
    Mixed,
    /// The contact slides as a whole at times, and the energy ratio is above its bound.
    GrossSlip,
}

impl CycleRegime {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::FullStick => "full_stick",
            Self::PartialSlip => "partial_slip",
            Self::Mixed => "mixed",
            Self::GrossSlip => "gross_slip",
        }
    }
}

/// A cycle as a whole. Units are those of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleRecord {
    /// Number of its stage, from 0.
    pub stage: usize,
    /// Number of the computed cycle in its stage, from 1.
    pub cycle: usize,
    /// Its first increment in the whole history.
    pub first_increment: usize,
    /// Its last increment.
    pub last_increment: usize,
    /// Cycles it stands for: 1, or more where wear is extrapolated.
    pub stands_for: usize,
    /// Number in its stage of the last cycle it stands for, from 1.
    pub last_cycle: usize,
    /// Energy dissipated by friction in this one computed cycle [force x length].
    pub dissipated_energy: f64,
    /// Energy dissipated by friction since the start of the history, over all cycles that computed ones stand for [force x length].
    pub total_dissipated_energy: f64,
    /// What drives it.
    pub drive: Drive,
    /// Direction of the tangential force's main axis, from x [rad], within a quarter turn.
    pub direction: f64,
    /// Half of the range of the force along that direction, or of the moment: `Q*`.
    pub force_amplitude: f64,
    /// Half of the range of the shift along that direction, or of the twist: `d*`.
    pub displacement_amplitude: f64,
    /// Half of the loop's width at the middle of the force's range: `d0`. Of a loop that slides as a whole both ways it does not depend on how
    /// well the increments resolve the way between.
    pub opening: f64,
    /// Dissipated energy over `4 Q* d*` [-]; `None` for a cycle without motion.
    pub energy_ratio: Option<f64>,
    /// Opening over displacement amplitude [-]; `None` for a cycle without motion.
    pub sliding_ratio: Option<f64>,
    /// Slope of the loop directly after reversal: over the first increment back from the largest force, or else from the smallest; of a
    /// loop that slides as a whole both ways that of the way between, which increments need not resolve. Tends to the stiffness of a contact
    /// that sticks as the increments become small. `None` where neither is left on a rising line.
    pub stiffness: Option<f64>,
    /// What the contact does; `None` without friction or contact.
    pub regime: Option<CycleRegime>,
    /// How far the end of the cycle is from its start: the largest change of pressure, shear and motions, relative to
    /// themselves, to `mu p` and to their range.
    pub closure: f64,
    /// Whether the stage ends here because the closure is within its tolerance.
    pub steady: bool,
    /// Volume worn off since the start of the history, by all cycles that computed ones stand for [length^3].
    pub worn_volume: f64,
    /// Largest worn depth after them [length].
    pub max_worn_depth: f64,
    /// Mean coefficient of friction over the contact at its end, weighted with the pressure [-]. It is constant within a cycle.
    pub friction_coefficient: f64,
    /// Largest change of the coefficient of a cell by this cycle and those that it stands for [-]; `None` where friction does not evolve.
    pub friction_change: Option<f64>,
    /// Estimated error of the coefficient of a cell by the cycle jump before this cycle, the largest [-].
    pub jump_error: Option<f64>,
    /// Largest depth off the lower body [length]; of cases whose layers have wear coefficients, as the next.
    pub lower_worn_depth: Option<f64>,
    /// Largest depth off the upper body [length].
    pub upper_worn_depth: Option<f64>,
    /// Normal compliance, at the scale of the contact radius, of the most worn place of the contact less that of the least worn, over that
    /// of the mean [-]: what one response for the whole contact leaves open. Of cases whose layers get thinner.
    pub compliance_spread: Option<f64>,
    /// Estimated error of the wear depth by the cycle jump before this cycle, relative to the depth of that jump [-]; with
    /// `wear.tolerance`.
    pub wear_jump_error: Option<f64>,
    /// Debris between the surfaces after the cycles it stands for [length^3]; of cases in which some stays, as the next.
    pub debris_volume: Option<f64>,
    /// Debris that has flowed out over the rim of the contact since the start of the history [length^3].
    pub debris_outflow: Option<f64>,
    /// Half of the range of the actuator's displacement along the direction of the force [length]; of a case with a machine that
    /// gives and a cycle driven tangentially, as what follows.
    pub actuator_amplitude: Option<f64>,
    /// Dissipated energy over `4 Q* d*` of the loop at the actuator [-]. The machine dissipates nothing.
    pub actuator_energy_ratio: Option<f64>,
    /// Opening over amplitude of the loop at the actuator [-]. Both loops are equally open.
    pub actuator_sliding_ratio: Option<f64>,
    /// Slope of the loop at the actuator over the first increment back from the largest force [force/length].
    pub actuator_stiffness: Option<f64>,
}

/// Zhou and Vincent's running condition of several cycles, which may change from one to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RunningCondition {
    /// All cycles stick, or slip in part.
    Partial,
    /// Some cycles slide and some do not, or one does both.
    Mixed,
    /// All cycles slide.
    Gross,
}

/// Running condition of some cycles; `None` when there are none with friction. Zhou & Vincent (1995), Wear 181-183, 531.
pub fn running_condition<'a>(cycles: impl IntoIterator<Item = &'a CycleRecord>) -> Option<RunningCondition> {
    let (mut all, mut gross, mut mixed) = (0, 0, 0);
    for regime in cycles.into_iter().filter_map(|cycle| cycle.regime) {
        all += 1;
        gross += usize::from(regime == CycleRegime::GrossSlip);
        mixed += usize::from(regime == CycleRegime::Mixed);
    }
    match (all, gross, mixed) {
        (0, _, _) => None,
        (_, 0, 0) => Some(RunningCondition::Partial),
        (all, gross, _) if all == gross => Some(RunningCondition::Gross),
        _ => Some(RunningCondition::Mixed),
    }
}
