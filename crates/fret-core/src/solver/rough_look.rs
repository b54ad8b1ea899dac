//! Looks at the equations while their residual is still large: displacements follow the change of the tractions in six digits.

use super::patience::ETA;
use super::tractions::{Displacements, Tractions};
use super::units::Units;
use crate::compliance::SurfaceCompliance;
use crate::model::field::{added_converted, difference, largest};

/// Share of the residual at the last look with all digits below which the next look has all digits again, and share below which a look
/// with six is repeated with all. By trial: with these 680 looks in 170 increments of the paper's figure 3, with 0.03 and 1e-3 756,
/// with all digits everywhere 675.
const NEAR: f64 = 0.06;
const TOO_NEAR: f64 = 1e-4;

/// Which looks have six digits, and the memory for them.
#[derive(Debug, Default)]
pub struct RoughLook {
    /// Of the whole box: how tractions changed, and the answer to that.
    changes: [Vec<f32>; 3],
    answers: [Vec<f32>; 3],
    /// Residual at the last look with all digits; `None` before there was one.
    exact: Option<f64>,
    rough: bool,
}

impl RoughLook {
    /// Makes ready for an increment, whose first displacements have all digits.
    pub fn begin(&mut self) {
        (self.exact, self.rough) = (None, false);
    }

    /// Whether six digits are too few for a residual that was found with them.
    pub fn is_too_rough(&mut self, residual: f64, tolerance: f64) -> bool {
        if !self.rough {
            self.exact = Some(residual);
        }
        self.rough && (residual < tolerance || self.exact.is_none_or(|exact| residual < TOO_NEAR * exact))
    }

    /// Displacements were averaged with earlier ones, whose digits nobody knows.
    pub fn averaged(&mut self) {
        self.rough = true;
    }

    /// All displacements anew.
    pub fn with_all_digits(
        &mut self,
        tractions: &Tractions,
        displacements: &mut Displacements,
        compliance: &mut dyn SurfaceCompliance,
    ) {
        compliance.full(tractions.parts(), displacements.parts_mut());
        self.rough = false;
    }

    /// Displacements of tractions after a look that found `residual`, from those before: in six digits where the next look is still
    /// far from the solution.
    pub fn follow(
        &mut self,
        residual: f64,
        tolerance: f64,
        (tractions, displacements): (&Tractions, &mut Displacements),
        (tractions_before, before): (&Tractions, &Displacements),
        compliance: &mut dyn SurfaceCompliance,
    ) {
        let far =
            self.exact.is_some_and(|exact| residual > NEAR * exact) && ETA * residual > 10.0 * tolerance;
        let operator = if far { compliance.full_single() } else { None };
        let Some(mut operator) = operator else {
            return self.with_all_digits(tractions, displacements, compliance);
        };
        let units = Units::near_one(largest(&tractions.pressure), operator.unit());
        let Self { changes, answers, .. } = self;
        for field in changes.iter_mut().chain(&mut *answers) {
            field.resize(tractions.pressure.len(), 0.0);
        }
        for ((change, now), then) in changes.iter_mut().zip(tractions.parts()).zip(tractions_before.parts()) {
            difference(now, then, 1.0 / units.pressure, change);
        }
        operator
            .apply(&changes.each_ref().map(Vec::as_slice), &mut answers.each_mut().map(Vec::as_mut_slice));
        for ((to, before), answer) in displacements.parts_mut().into_iter().zip(before.parts()).zip(answers) {
            added_converted(before, units.length(), answer, to);
        }
        self.rough = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_certify_nothing() {
        let mut look = RoughLook::default();
        look.begin();
        assert!(!look.is_too_rough(0.5, 1e-8));
        look.averaged();
        assert!(!look.is_too_rough(0.1, 1e-8));
        assert!(look.is_too_rough(0.4 * TOO_NEAR, 1e-8));
        assert!(look.is_too_rough(0.1, 0.2));
    }
}
