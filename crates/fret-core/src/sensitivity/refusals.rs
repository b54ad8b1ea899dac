//! Histories of which no derivatives are taken, each refused by the key that makes it one: never a wrong derivative in silence.

use ndarray::s;

use super::error::SensitivityError;
use super::objective::Objective;
use super::parameter::Parameter;
use crate::case::{Stage, StageControl};
use crate::kernel::uniform_response;
use crate::model::{CoulombFriction, Integration, WearRule};
use crate::plan::{Coupling, Plan, Simplification};

/// Whether derivatives are taken of the history of a plan.
pub(super) fn check(plan: &Plan) -> Result<(), SensitivityError> {
    let case = &plan.case;
    let without = "take the derivatives without it";
    // Where a half-space repeats, nothing else moves along the normal.
    let repeats = case.periodic.is_both() && uniform_response(&case.bodies).is_none();
    let wears = |how: &dyn Fn(&WearRule) -> bool| case.wear.as_ref().is_some_and(how);
    let moves = |stage: &Stage| stage.normal.as_ref().is_some_and(StageControl::is_motion);
    let by_mean_gap = repeats && case.stages.iter().any(moves);
    let refusals = [
        (
            wears(&|wear| wear.thinning_tolerance.is_some()),
            "wear.thinning_tolerance",
            "leave it out: layers that wear without thinning have derivatives",
        ),
        (
            wears(&|wear| wear.debris.is_some_and(|debris| debris.stiffness.is_some())),
            "wear.debris.stiffness",
            "leave it out: debris that does not give has derivatives",
        ),
        (case.hardness.is_some(), "hardness", without),
        (plan.moves, "kinematics.displacement = \"finite\"", without),
        (case.stages.iter().any(Stage::rolls), "roll", without),
        (by_mean_gap, "mean_gap", "prescribe the normal force"),
        (plan.start.is_some(), "a start from another history", "give all stages in one case"),
        (
            !plan.leave_out.takes(Simplification::LayeredResponse),
            "all layers in their place",
            "take the derivatives with the simplifications of the plan",
        ),
    ];
    match refusals.into_iter().find(|(is, ..)| *is) {
        Some((_, key, advice)) => Err(SensitivityError::NotCovered { key: key.to_owned(), advice }),
        None => Ok(()),
    }
}

/// Whether the numbers and the results that are asked for have derivatives with the simplifications of a plan.
pub(super) fn check_request(
    plan: &Plan,
    parameters: &[Parameter],
    (objectives, fields): (&[Objective], bool),
) -> Result<(), SensitivityError> {
    let refused = |parameter: &Parameter, reason: &str| {
        Err(SensitivityError::Parameter { path: parameter.path().to_owned(), reason: reason.to_owned() })
    };
    let below = || objectives.iter().filter(|objective| objective.is_below());
    if let Some((objective, reason)) = below().find_map(|of| Some((of, of.missing_below(plan)?))) {
        return Err(SensitivityError::Objective { name: objective.column().to_owned(), reason });
    }
    let fields = fields || below().next().is_some();
    for parameter in parameters {
        if parameter.is_a_load() && parameter.value() == 0.0 && (plan.symmetry.any() || plan.along.is_some())
        {
            return refused(
                parameter,
                "it is 0, and the plan takes the contact for symmetric since it is: give it a small value",
            );
        }
        if parameter.of_body().is_some() && plan.coupling == Coupling::Uncoupled {
            if parameter.path().ends_with("poisson") && parameter.value() == 0.5 {
                return refused(parameter, "at 0.5 the results turn: take it at 0.499");
            }
            if !is_point_symmetric(plan) {
                return refused(
                    parameter,
                    "pressure and shear of these bodies do not act on each other, but with another value they would, and the scene is not \
                     symmetric: give one of the bodies a slightly different constant",
                );
            }
            if fields {
                return refused(
                    parameter,
                    "pressure and shear of these bodies do not act on each other, but with another value they would: fields, and stresses below the surface, \
                     have no derivative here: give one of the bodies a slightly different constant",
                );
            }
            if let Some(odd) = objectives.iter().find(|objective| ODD.contains(&objective.column())) {
                return refused(
                    parameter,
                    &format!(
                        "pressure and shear of these bodies do not act on each other, but with another value they would, and turn: {} has no \
                         derivative here: give one of the bodies a slightly different constant",
                        odd.column()
                    ),
                );
            }
        }
    }
    let of_wear = ["worn_volume", "max_worn_depth", "wear_work"];
    let stretches = plan.case.stages.iter().any(Stage::stretches);
    let (wears, refused) = (plan.case.wear.is_some(), |name: &str, reason: &str| {
        Err(SensitivityError::Objective { name: name.to_owned(), reason: reason.to_owned() })
    });
    for column in objectives.iter().map(Objective::column) {
        if of_wear.contains(&column) && !wears {
            return refused(column, "nothing wears in this case");
        }
        if column == "bulk_work" && !stretches {
            return refused(column, "no bulk stress acts in this case");
        }
    }
    let of_friction = |objective: &&Objective| objective.column() == "friction_coefficient";
    let mapped = plan.case.friction.is_map()
        || plan.case.friction_evolution.is_some()
        || plan.case.stages.iter().filter_map(|stage| stage.friction.as_ref()).any(CoulombFriction::is_map);
    if mapped && objectives.iter().any(|objective| of_friction(&objective)) {
        return Err(SensitivityError::Objective {
            name: "friction_coefficient".to_owned(),
            reason: "the mean of friction that differs from cell to cell, of which no derivative is taken"
                .to_owned(),
        });
    }
    Ok(())
}

/// Results that change their sign in a mirror: of bodies whose pressure and shear begin to act on each other they do not stay to first order.
const ODD: [&str; 6] = ["twist", "twist_moment", "tilt_x", "tilt_y", "tilt_moment_x", "tilt_moment_y"];

/// Whether the gap, without a tilt, a twist, bulk stresses or a map, is the same after half a turn: what pressure and shear then do to each other
/// cancels to first order.
fn is_point_symmetric(plan: &Plan) -> bool {
    let case = &plan.case;
    let gap = case.profile.gap(&plan.grid);
    let largest = gap.iter().copied().filter(|gap| gap.is_finite()).fold(0.0, f64::max);
    let turned = gap.slice(s![..;-1, ..;-1]);
    let is_even =
        gap.iter().zip(turned).all(|(one, other)| one == other || (one - other).abs() <= 1e-12 * largest);
    let is_flat_on = |stage: &Stage| !stage.tilts() && stage.twist.is_none() && !stage.stretches();
    is_even && !case.friction.is_map() && case.stages.iter().all(is_flat_on)
}

/// Whether the history of a plan, of which the cells in contact are given increment by increment, has derivatives.
pub(super) fn check_history(
    plan: &Plan,
    contact: impl Iterator<Item = usize>,
) -> Result<(), SensitivityError> {
    let mut is_apart = false;
    let mut touches_again = false;
    for cells in contact {
        touches_again |= is_apart && cells > 0;
        is_apart |= cells == 0;
    }
    let case = &plan.case;
    let of_second_order =
        case.integration == Integration::SecondOrder && plan.coupling != Coupling::Frictionless;
    if touches_again && of_second_order {
        return Err(SensitivityError::NotCovered {
            key: "bodies that are apart before they touch".to_owned(),
            advice: "integration = \"end_point\" in [solver], or a first stage that presses them",
        });
    }
    if is_apart && case.wear.is_some() {
        return Err(SensitivityError::NotCovered {
            key: "bodies that are apart, and wear".to_owned(),
            advice: "keep them pressed",
        });
    }
    if is_apart && case.stages.iter().any(Stage::tilts) {
        return Err(SensitivityError::NotCovered {
            key: "bodies that are apart, and tilt".to_owned(),
            advice: "keep them pressed",
        });
    }
    Ok(())
}
