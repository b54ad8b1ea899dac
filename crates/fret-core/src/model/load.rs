//! What is prescribed in one increment: a force or a motion, for each rigid degree of freedom.

use std::mem::discriminant;

use serde::{Deserialize, Serialize};

use super::controls::FREEDOMS;

/// What is prescribed for one rigid degree of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Control {
    /// The resultant [force], or [force x length] for twist and tilt; the motion follows.
    Force(f64),
    /// The rigid motion [length], or [rad] for twist, slope for tilt; the resultant follows.
    Motion(f64),
    /// The motion of the far end of the machine's spring [length]: the body's own plus what the spring gives; both motion and
    /// resultant follow. Not for twist and tilt.
    FarEnd(f64),
}

impl Control {
    /// The number that is prescribed.
    pub fn value(self) -> f64 {
        let (Self::Force(value) | Self::Motion(value) | Self::FarEnd(value)) = self;
        value
    }

    /// The resultant, where that is prescribed.
    pub fn force(self) -> Option<f64> {
        if let Self::Force(force) = self { Some(force) } else { None }
    }

    /// The motion, of the body or of the far end, where that is prescribed.
    pub fn motion(self) -> Option<f64> {
        if let Self::Motion(motion) | Self::FarEnd(motion) = self { Some(motion) } else { None }
    }
}

/// Loads and motions at the end of one increment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LoadStep {
    /// Normal force (compression positive) or approach, of the body or of the actuator.
    pub normal: Control,
    /// Tangential force on the lower body, or shift of the upper body or of the actuator, along x and y.
    pub tangential: [Control; 2],
    /// Moment about z on the lower body, or rotation of the upper body.
    pub twist: Control,
    /// First moment of the pressure along x and y, or slope of the upper body: it goes deeper towards positive x and y.
    pub tilt: [Control; 2],
    /// Bulk stress of the substrates of the lower and the upper body, each along x and y [pressure], tension positive.
    pub bulk_stress: [[f64; 2]; 2],
    /// Distance rolled along x and y [length].
    #[serde(default)]
    pub roll: [f64; 2],
}

/// Where one rigid degree of freedom is: what each kind of control would have prescribed to bring it there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Resultant [force].
    pub force: f64,
    /// Rigid motion [length].
    pub motion: f64,
    /// Motion of the far end of the spring [length].
    pub far_end: f64,
}

impl Reached {
    /// The number of the same kind as a control's, as a control.
    pub fn like(&self, control: Control) -> Control {
        match control {
            Control::Force(_) => Control::Force(self.force),
            Control::Motion(_) => Control::Motion(self.motion),
            Control::FarEnd(_) => Control::FarEnd(self.far_end),
        }
    }
}

impl LoadStep {
    /// Bodies that nothing holds or moves.
    pub const FREE: Self = Self {
        normal: Control::Force(0.0),
        tangential: [Control::Force(0.0); 2],
        twist: Control::Motion(0.0),
        tilt: [Control::Motion(0.0); 2],
        bulk_stress: [[0.0; 2]; 2],
        roll: [0.0; 2],
    };

    /// What is prescribed for each degree of freedom (`controls.rs`); stresses as forces.
    pub fn controls(&self) -> [Control; FREEDOMS] {
        let Self { normal, tangential: [x, y], twist, tilt: [tilt_x, tilt_y], bulk_stress, roll } = *self;
        let [roll_x, roll_y] = roll.map(Control::Motion);
        let [lower, upper] = bulk_stress.map(|stress| stress.map(Control::Force));
        [normal, x, y, twist, tilt_x, tilt_y, lower[0], lower[1], upper[0], upper[1], roll_x, roll_y]
    }

    /// The load that prescribes these.
    pub fn of(controls: [Control; FREEDOMS]) -> Self {
        let [normal, x, y, twist, tilt_x, tilt_y, bulk @ ..] = controls;
        let [lower_x, lower_y, upper_x, upper_y, roll_x, roll_y] = bulk.map(Control::value);
        Self {
            normal,
            tangential: [x, y],
            twist,
            tilt: [tilt_x, tilt_y],
            bulk_stress: [[lower_x, lower_y], [upper_x, upper_y]],
            roll: [roll_x, roll_y],
        }
    }

    /// Change of what is prescribed to another step that prescribes the same kinds, each in its own unit, for each degree of freedom.
    /// `None` where the kinds differ; no force and no motion are the same.
    pub fn change_to(&self, other: &Self) -> Option<[f64; FREEDOMS]> {
        let (from, to) = (self.controls(), other.controls());
        let are_nothing = |from: &Control, to: &Control| from.value() == 0.0 && to.value() == 0.0;
        let are_alike = |(from, to)| discriminant(from) == discriminant(to) || are_nothing(from, to);
        let are_alike = from.iter().zip(&to).all(are_alike);
        are_alike.then(|| std::array::from_fn(|freedom| to[freedom].value() - from[freedom].value()))
    }

    /// What is prescribed at a share of the straight way from one step to another that prescribes the same kinds.
    pub fn between(from: &Self, to: &Self, share: f64) -> Self {
        let one = |from: Control, to: Control| match (from, to) {
            (Control::Force(a), Control::Force(b)) if share < 1.0 => Control::Force(a + (b - a) * share),
            (Control::Motion(a), Control::Motion(b)) if share < 1.0 => Control::Motion(a + (b - a) * share),
            (Control::FarEnd(a), Control::FarEnd(b)) if share < 1.0 => Control::FarEnd(a + (b - a) * share),
            (_, to) => to,
        };
        let (from, to) = (from.controls(), to.controls());
        Self::of(std::array::from_fn(|freedom| one(from[freedom], to[freedom])))
    }
}
