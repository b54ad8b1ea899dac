//! How much memory a run takes: the one place of these numbers. `benches/expected_cost.py` sets them beside what runs took.

use crate::case::{Case, StageControl};
use crate::model::{DebrisRule, Frame, Heights, SurfaceGrid, Symmetry};
use crate::solver::{Coupling, NUMBERS_OF_CYCLE};

/// Bytes of the process itself.
const PROCESS: usize = 15 << 20;
/// Bytes a cell while a case is planned: the gap, a friction map, and copies of both for the mirrors.
pub const PLANNING: usize = 48;

/// Bytes a cell of the fields that wear collects.
const WEAR: usize = 50;
/// Bytes a cell of debris: its thickness in two states and as it was, what is collected of it, what the cycle before made.
const DEBRIS: usize = 72;
/// Bytes a cell of what has yielded: its depth in two states, the gap without it and with it.
const YIELDED: usize = 32;
/// Bytes a cell of what debris gives by: on the grid, in the region and for the check of the grid.
const GIVE: usize = 24;
/// Bytes a cell of what friction dissipates in each: of an increment, and of a part of it.
const FRICTION_WORK: usize = 16;
/// Bytes a cell of influence coefficients that are found while those before are in use.
const THINNING: usize = 48;
/// Bytes a cell of friction that evolves: what is accumulated in two states, collected in a cycle and kept of the last one, the law twice
/// and its part in front of the mirrors.
const EVOLVING: usize = 110;
/// Bytes a cell of a gap that is tilted; with a prescribed moment, of places and turned gaps too.
const TILTED: usize = 16;
const BY_MOMENT: usize = 100;
/// Bytes a cell of surfaces that move: the gap and the wear of each body, and with symmetry reduction the operator of the upper body.
const MOVING: [usize; 2] = [80, 260];
/// Bytes a cell of friction maps that move: the law as the body has it, and at both ends of an increment.
const MOVING_FRICTION: usize = 24;
/// Bytes a cell of maps that travel through a grid which goes with a contact: gap and friction at both ends of an increment.
const PASSING: usize = 40;
/// Bytes a cell of the tractions of their last cycle, in memory and in a checkpoint.
const CYCLE: usize = NUMBERS_OF_CYCLE * size_of::<f64>();
/// Bytes a cell of the tractions and slips of an increment whose stresses are looked at.
const TRACTIONS: usize = 5 * 8;
/// Bytes a cell of what fatigue and the fracture of a coating collect of an increment: the stress at the depth at work, sums over depths.
const COLLECTED: usize = 12 * 8;
/// Bytes a cell of the depth at work: kernels of all components, their transforms, the stress.
const DEPTH: usize = 620;
/// Bytes a cell of a checkpoint in front of the mirrors, and those of all that wait to be written at the most.
const CHECKPOINT: usize = 160;
const WAITING: usize = 32 << 20;
/// Arrays of so many bytes go back to the system as soon as they are free; smaller ones leave so many bytes a cell in the process.
const GOES_BACK: usize = 32 << 20;
const LEFT_BEHIND: usize = 37;
/// Bytes a cell of heights or of a friction map: as they are held, and in the gap.
const EACH_CELL: usize = 16;

/// Bytes a cell of `[the whole grid, what the solver holds in front of the mirrors, what it remembers there]`.
///
/// The whole: influence coefficients, and the fields that are handed out. In front of the mirrors: states and gaps, the transformed kernels
/// of each operator in double and single precision, their work space, and the fields of the iterations. In a case that repeats nothing is
/// padded, and the inverse is exact. Remembered: increments before the last, from the [third](REMEMBERING) one on.
fn bytes_per_cell(coupling: Coupling, unpadded: bool) -> [usize; 3] {
    match (coupling, unpadded) {
        (Coupling::Frictionless, false) => [28, 215, 10],
        (Coupling::Frictionless, true) => [10, 165, 55],
        (Coupling::Uncoupled, false) => [50, 376, 60],
        (Coupling::Uncoupled, true) => [0, 340, 60],
        (Coupling::Coupled, false) => [80, 565, 60],
        (Coupling::Coupled, true) => [20, 250, 60],
    }
}

/// Increments of a run that remembers more than the state it goes on from.
const REMEMBERING: usize = 3;

/// Memory of a run at the most [bytes], without kept fields: of the process, of the fields of the whole grid, of the operators and
/// fields of the solver in front of the mirrors.
///
/// Within about a tenth of what runs of 512 to 4096 cells per side took whose contact fills the automatic grid; on fewer cells what the process
/// itself takes decides, and a contact that leaves more room takes less.
pub fn of_run(case: &Case, grid: &SurfaceGrid, coupling: Coupling, symmetry: Symmetry) -> usize {
    let [whole, in_front, remembered] = bytes_per_cell(coupling, case.periodic.is_both());
    let remembered = if case.increments() >= REMEMBERING { remembered } else { 0 };
    let worn = case.wear.as_ref().map_or(0, |wear| match wear.thinning_tolerance {
        None => WEAR,
        Some(_) => WEAR + THINNING,
    });
    let worn = worn + if case.hardness.is_some() { YIELDED } else { 0 };
    let of_debris = |debris: DebrisRule| DEBRIS + if debris.stiffness.is_some() { GIVE } else { 0 };
    let worn = worn + case.wear.as_ref().and_then(|wear| wear.debris).map_or(0, of_debris);
    let tells_work = case.output.fields.iter().any(|name| name == "friction_work");
    let worn = worn + if tells_work { FRICTION_WORK } else { 0 };
    let evolving = if case.friction_evolution.is_some() { EVOLVING } else { 0 };
    let frictions = case.stages.iter().filter_map(|stage| stage.friction.as_ref()).chain([&case.friction]);
    let maps = frictions.filter(|friction| friction.is_map()).count() + case.profile.heights.len();
    let passes = case.rolls() && case.kinematics.frame == Frame::Contact && maps > 0;
    let moving_maps = if passes { PASSING } else { 0 }
        + if case.kinematics.friction_of_upper { MOVING_FRICTION } else { 0 };
    let points: usize = case.profile.heights.iter().map(Heights::points).sum();
    let [moving, operator] = if case.kinematics.is_finite() { MOVING } else { [0; 2] };
    let cycle = if case.kinematics.is_finite() { CYCLE } else { 0 };
    let in_front = in_front + remembered + tilt(case) + operator + cycle;
    let left_behind = if grid.len() * size_of::<f64>() < GOES_BACK { LEFT_BEHIND } else { 0 };
    let whole = whole + left_behind + worn + evolving + EACH_CELL * maps + moving + moving_maps;
    let solving = grid.len() * (whole + in_front / symmetry.copies());
    let stressed = case.stress.as_ref().map_or(0, |stress| {
        of_stress(grid.len(), case.kept_increments().len().div_ceil(stress.every.max(1)))
    });
    let waiting = if case.increments() > 1 {
        (grid.len() / symmetry.copies() * (CHECKPOINT + cycle)).min(WAITING)
    } else {
        0
    };
    PROCESS + size_of::<f64>() * points + waiting + solving.max(stressed)
}

/// Bytes a cell of what tilts in front of the mirrors.
fn tilt(case: &Case) -> usize {
    let by_moment = |control: &StageControl| matches!(control, StageControl::Force(_));
    if case.stages.iter().any(|stage| stage.tilt.iter().flatten().any(by_moment)) {
        BY_MOMENT
    } else if case.tilts(0) || case.tilts(1) {
        TILTED
    } else {
        0
    }
}

/// Memory to compute stresses under the surface from the tractions of so many increments [bytes], one depth after the other.
pub fn of_stress(cells: usize, increments: usize) -> usize {
    cells.saturating_mul((TRACTIONS + COLLECTED).saturating_mul(increments).saturating_add(DEPTH))
}

/// Bytes of all fields that a case keeps: on disk, or in memory where the history holds them.
pub fn of_kept_fields(case: &Case, grid: &SurfaceGrid) -> usize {
    case.kept_increments().len()
        * grid.len()
        * case.output.fields.iter().map(|name| bytes_of(name, case)).sum::<usize>()
}

/// Bytes a cell of a field that can be kept.
fn bytes_of(name: &str, case: &Case) -> usize {
    match name {
        "worn_depth" if case.kinematics.is_finite() => 24,
        "shear" | "slip" => 16,
        "zone" => 1,
        _ => 8,
    }
}
