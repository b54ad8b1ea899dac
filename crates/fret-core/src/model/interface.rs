//! How a layer is bonded to what lies below it: perfectly, or by springs that let it move relative to it.

use serde::{Deserialize, Serialize};

/// Why springs were refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum InterfaceError {
    /// Stiffness of the normal spring out of range.
    #[error(
        "normal stiffness {0:?}: must be a positive finite pressure per length, between 1e-100 and 1e100; without it nothing carries the layer"
    )]
    Normal(f64),
    /// Stiffness of the shear spring out of range.
    #[error(
        "shear stiffness {0:?}: must be a positive finite pressure per length, between 1e-100 and 1e100, or 0 where no shear passes"
    )]
    Shear(f64),
}

/// The interface below a layer: normal and shear springs of no thickness.
///
/// Traction passes; displacement jumps by traction over stiffness: `u_z` above less `u_z` below is the pressure on the interface over the
/// normal stiffness, and likewise for both directions of shear. A direction without a spring is bonded. Linear: it neither opens under
/// tension nor slips at a limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interface {
    /// Stiffness [pressure/length]; `None`: bonded.
    normal: Option<f64>,
    /// Stiffness [pressure/length]; `None`: bonded; 0: no shear passes.
    shear: Option<f64>,
}

impl Default for Interface {
    fn default() -> Self {
        Self::BONDED
    }
}

impl Interface {
    /// No jump of displacement.
    pub const BONDED: Self = Self { normal: None, shear: None };

    /// No shear passes, and no normal jump of displacement.
    pub const FRICTIONLESS: Self = Self { normal: None, shear: Some(0.0) };

    /// Springs of a normal and a shear stiffness [pressure/length]; `None`: bonded in that direction, shear stiffness 0: frictionless.
    ///
    /// # Errors
    /// When a stiffness is negative or no number between 1e-100 and 1e100, or the normal one is zero: nothing would carry the layer.
    pub fn springs(normal: Option<f64>, shear: Option<f64>) -> Result<Self, InterfaceError> {
        let is_spring = |stiffness: f64| (1e-100..=1e100).contains(&stiffness);
        match (normal, shear) {
            (Some(stiffness), _) if !is_spring(stiffness) => Err(InterfaceError::Normal(stiffness)),
            (_, Some(stiffness)) if stiffness != 0.0 && !is_spring(stiffness) => {
                Err(InterfaceError::Shear(stiffness))
            }
            _ => Ok(Self { normal, shear: shear.map(f64::abs) }),
        }
    }

    /// Whether displacement does not jump.
    pub fn is_bonded(&self) -> bool {
        *self == Self::BONDED
    }

    /// Whether no shear passes.
    pub fn is_frictionless(&self) -> bool {
        self.shear == Some(0.0)
    }

    /// Stiffness of the normal spring [pressure/length]; `None` where there is none.
    pub fn normal_stiffness(&self) -> Option<f64> {
        self.normal
    }

    /// Stiffness of the shear spring [pressure/length]; `None` where there is none.
    pub fn shear_stiffness(&self) -> Option<f64> {
        self.shear
    }

    /// Jump of normal displacement per pressure [length/pressure].
    pub fn normal_compliance(&self) -> f64 {
        self.normal.map_or(0.0, |stiffness| 1.0 / stiffness)
    }

    /// Jump of tangential displacement per shear [length/pressure]; infinite where no shear passes.
    pub fn shear_compliance(&self) -> f64 {
        self.shear.map_or(0.0, |stiffness| 1.0 / stiffness)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn springs_that_carry_nothing_are_refused() {
        assert_eq!(Interface::springs(Some(0.0), None), Err(InterfaceError::Normal(0.0)));
        assert_eq!(Interface::springs(Some(-1.0), None), Err(InterfaceError::Normal(-1.0)));
        assert_eq!(Interface::springs(None, Some(-1.0)), Err(InterfaceError::Shear(-1.0)));
        assert!(Interface::springs(Some(f64::NAN), None).is_err());
        assert!(Interface::springs(None, Some(f64::INFINITY)).is_err());
        assert_eq!(Interface::springs(None, Some(0.0)), Ok(Interface::FRICTIONLESS));
        assert_eq!(Interface::springs(None, Some(-0.0)), Ok(Interface::FRICTIONLESS));
        assert_eq!(Interface::springs(None, None), Ok(Interface::BONDED));
    }

    #[test]
    fn compliances_are_the_inverse_stiffnesses() {
        let interface = Interface::springs(Some(4.0), Some(0.5)).unwrap();
        assert_eq!((interface.normal_compliance(), interface.shear_compliance()), (0.25, 2.0));
        assert_eq!(Interface::FRICTIONLESS.shear_compliance(), f64::INFINITY);
        assert_eq!(Interface::BONDED.shear_compliance(), 0.0);
        assert!(Interface::FRICTIONLESS.is_frictionless() && !Interface::FRICTIONLESS.is_bonded());
    }
}
