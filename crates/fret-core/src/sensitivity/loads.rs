//! What a history prescribes, increment by increment, with its derivatives by one parameter.

use std::mem::discriminant;

use super::parameter::Parameter;
use super::scene::Scene;
use crate::case::{Stage, StageControl};
use crate::fields::Dual;
use crate::model::controls::FREEDOMS;
use crate::model::stage::Path;
use crate::model::{ContactState, Control, LoadStep};

/// A load with its derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Load {
    pub step: LoadStep,
    pub change: [f64; FREEDOMS],
}

/// Where a degree of freedom is.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Reached {
    /// Resultant of the whole contact.
    pub force: Dual,
    /// Rigid motion.
    pub motion: Dual,
    /// Motion of the far end of the spring.
    pub far_end: Dual,
}

impl Reached {
    /// The number of the same kind as a control's.
    fn like(&self, control: Control) -> (Control, f64) {
        match control {
            Control::Force(_) => (Control::Force(self.force.value), self.force.change),
            Control::Motion(_) => (Control::Motion(self.motion.value), self.motion.change),
            Control::FarEnd(_) => (Control::FarEnd(self.far_end.value), self.far_end.change),
        }
    }
}

/// Normal, tangential along x and y, about z, tilts.
pub(super) type AllReached = [Reached; 6];

impl Load {
    /// Nothing prescribed yet.
    pub const FREE: Self = Self { step: LoadStep::FREE, change: [0.0; FREEDOMS] };

    /// Its numbers with their derivatives.
    pub fn duals(&self) -> [Dual; FREEDOMS] {
        let controls = self.step.controls();
        std::array::from_fn(|freedom| Dual::new(controls[freedom].value(), self.change[freedom]))
    }

    /// Change to another load of the same kinds.
    pub fn change_to(&self, other: &Self) -> Option<[Dual; FREEDOMS]> {
        self.step.change_to(&other.step)?;
        let (from, to) = (self.duals(), other.duals());
        Some(std::array::from_fn(|freedom| to[freedom] - from[freedom]))
    }

    /// The same with controls of the kinds of another load: what they would have prescribed to reach the same state.
    #[must_use]
    pub fn of_kinds(&self, kinds: &LoadStep, freedoms: std::ops::Range<usize>, reached: &AllReached) -> Self {
        let mut controls = self.step.controls();
        let mut change = self.change;
        for freedom in freedoms {
            let wanted = kinds.controls()[freedom];
            if discriminant(&controls[freedom]) != discriminant(&wanted) {
                (controls[freedom], change[freedom]) = reached[freedom].like(wanted);
            }
        }
        Self { step: LoadStep::of(controls), change }
    }

    /// Where a stage starts after these loads are held.
    #[must_use]
    pub fn at_start_of(&self, stage: &Stage, reached: &AllReached) -> Self {
        let mut kinds = self.step.controls();
        for (kind, control) in kinds.iter_mut().zip(stage.by_freedom()) {
            if let Some(control) = control {
                *kind = control.prescribing(0.0);
            }
        }
        self.of_kinds(&LoadStep::of(kinds), 0..reached.len(), reached)
    }

    /// At the end of increment `k` of a stage that starts here; `parameter`: that by which derivatives are taken, where it is one of a stage of
    /// this number.
    #[must_use]
    pub fn after(&self, (stage, number): (&Stage, usize), k: usize, parameter: &Parameter) -> Self {
        let times = stage.times();
        let mut change = self.change;
        for (freedom, control) in stage.by_freedom().into_iter().enumerate() {
            let Some(control) = control else { continue };
            let part = control_by(control, parameter.is_control(number, freedom));
            // What is prescribed is linear in where the stage starts and in the numbers of the control.
            change[freedom] = stage.value(&part, change[freedom], k, times.as_ref());
        }
        Self { step: stage.load(&self.step, k), change }
    }

    /// The share that the part in front of the mirrors carries, from the state before.
    #[must_use]
    pub fn of_part(&self, scene: &Scene<'_>, before: &ContactState) -> Self {
        let symmetry = scene.plan.symmetry;
        if !symmetry.any() {
            return *self;
        }
        let step = symmetry.part_of_load(&self.step, before);
        let share = 1.0 / symmetry.copies() as f64;
        let (whole, part) = (self.step.controls(), step.controls());
        let mut change = self.change;
        for freedom in 0..FREEDOMS {
            change[freedom] = match (whole[freedom], part[freedom]) {
                // Bulk stresses are no forces of a part.
                (Control::Force(_), Control::Force(_)) if freedom < 6 => share * change[freedom],
                (whole, part) if discriminant(&whole) == discriminant(&part) => change[freedom],
                _ => 0.0, // the symmetry forbids it
            };
        }
        Self { step, change }
    }
}

/// The derivative of a control by its number, where that is the parameter.
fn control_by(control: &StageControl, is_parameter: bool) -> StageControl {
    let change = f64::from(u8::from(is_parameter));
    let path = match control.path() {
        Path::To(_) => Path::To(change),
        Path::Wave { phase, .. } => Path::Wave { amplitude: change, phase: *phase },
        Path::Through(values) => Path::Through(vec![0.0; values.len()]),
    };
    match control {
        StageControl::Force(_) => StageControl::Force(path),
        StageControl::Motion(_) => StageControl::Motion(path),
        StageControl::FarEnd(_) => StageControl::FarEnd(path),
        StageControl::Rate(_) => StageControl::Rate(path),
    }
}
