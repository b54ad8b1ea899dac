//! How the bodies conduct heat and electric current: conductivities of their layers.

use serde::{Deserialize, Serialize};

/// Whether powers and quotients of a conductivity or length are numbers still.
fn is_within_reach(value: f64) -> bool {
    (1e-100..=1e100).contains(&value)
}

/// Why a conductor was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ConductorError {
    /// A conductivity out of range.
    #[error("conductivity {0:?}: must be positive and finite, between 1e-100 and 1e100")]
    Conductivity(f64),
    /// A thickness out of range.
    #[error("thickness {0:?}: must be a positive finite length, between 1e-100 and 1e100")]
    Thickness(f64),
}

/// A layer that conducts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ConductingLayer {
    /// Thickness \[length\].
    pub thickness: f64,
    /// Conductivity, of heat [power/(length temperature)] or of current [1/(resistance length)].
    pub conductivity: f64,
}

/// A half-space that conducts under any number of layers in perfect contact with each other. Far below it is at its reference
/// temperature or potential, zero.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Conductor {
    layers: Vec<ConductingLayer>,
    base: f64,
}

impl Conductor {
    /// Half-space from its layers, outermost first, and the conductivity of what they lie on.
    ///
    /// # Errors
    /// When a number is not positive, or far from 1 beyond reason.
    pub fn new(layers: Vec<ConductingLayer>, base: f64) -> Result<Self, ConductorError> {
        let conductivities = layers.iter().map(|layer| layer.conductivity).chain([base]);
        if let Some(wrong) = conductivities.into_iter().find(|value| !is_within_reach(*value)) {
            return Err(ConductorError::Conductivity(wrong));
        }
        if let Some(wrong) = layers.iter().map(|layer| layer.thickness).find(|value| !is_within_reach(*value))
        {
            return Err(ConductorError::Thickness(wrong));
        }
        Ok(Self { layers, base })
    }

    /// A homogeneous half-space.
    ///
    /// # Errors
    /// As [`Conductor::new`].
    pub fn homogeneous(conductivity: f64) -> Result<Self, ConductorError> {
        Self::new(Vec::new(), conductivity)
    }

    /// Layers, outermost first, neighbours of one conductivity joined and those of the base's own left out.
    pub fn layers(&self) -> Vec<ConductingLayer> {
        let mut joined: Vec<ConductingLayer> = Vec::with_capacity(self.layers.len());
        for layer in &self.layers {
            match joined.last_mut() {
                Some(last) if last.conductivity == layer.conductivity => last.thickness += layer.thickness,
                _ => joined.push(*layer),
            }
        }
        if joined.last().is_some_and(|last| last.conductivity == self.base) {
            joined.pop();
        }
        joined
    }

    /// Conductivity of the half-space below the layers.
    pub fn base(&self) -> f64 {
        self.base
    }
}

/// What the two bodies conduct, each pair of the lower and of the upper body; `None`: a body that conducts nothing.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Conduction {
    /// Conductors of heat.
    pub thermal: [Option<Conductor>; 2],
    /// Conductors of electric current.
    pub electrical: [Option<Conductor>; 2],
    /// Cycles per unit of time; `None`: no friction heat is asked for.
    pub frequency: Option<f64>,
}

impl Conduction {
    /// Whether nothing is said about it.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}
