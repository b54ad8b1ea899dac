//! Wear: the depth that slip takes off the surfaces, so that the gap opens.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::wear_layers::WearLayers;
use crate::document::Table;

/// What the worn depth follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "WearLawFile", description = "Wear law.")]
pub enum WearLaw {
    /// `k p |ds|`: mean pressure of the increment times slip. Archard (1953), J. Appl. Phys. 24, 981.
    #[schemars(description = "Pressure times slip.")]
    Archard,
    /// `k q . ds`: the energy that friction dissipates. Fouvry, Kapsa & Vincent (1996), Wear 200, 186.
    #[schemars(description = "Energy dissipated by friction.")]
    Energy,
}

/// Depths of one body alone, of bodies that move against each other [length].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct OwnDepths {
    /// At which the run ends.
    pub limit: Option<f64>,
    /// At which its outermost coating is gone.
    pub coating: Option<f64>,
}

/// Debris between the surfaces: what wears off stays in part, fills the gap, and flows out over the rim of the contact by sliding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DebrisRule {
    /// Fraction of what both bodies lose that stays between them [-].
    pub fraction: f64,
    /// Slip distance over which all but 1/e of the debris of a cell flows out [length]; `None`: nothing does.
    pub outflow_length: Option<f64>,
    /// Pressure that would press it to nothing if it went on as it begins [pressure]: a layer of thickness b gives by p b over this. `None`: it does
    /// not give.
    pub stiffness: Option<f64>,
}

/// Wear by the distance from the open rim of the contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RimRule {
    /// Distance from the rim [length] within which the wear coefficient is that of the case.
    pub width: f64,
    /// Wear coefficient farther inside over that of the case [-], of the lower and the upper body.
    pub interior: [f64; 2],
}

/// How surfaces wear, and how many cycles a computed one stands for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WearRule {
    /// What the depth follows.
    pub law: WearLaw,
    /// Depth off both bodies together for pressure times slip, or for dissipated energy by area [1/pressure]; `None` where each layer has
    /// its own.
    pub coefficient: Option<f64>,
    /// Layers that wear, each by its own coefficient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<WearLayers>,
    /// Cycles that a computed one stands for, at the most.
    pub every: usize,
    /// Depth of such a block of cycles relative to the approach, at the most.
    pub largest_step: f64,
    /// Depth at which the run ends [length].
    pub limit: Option<f64>,
    /// Depth at which the first coating is gone [length]; the run tells of it, and goes on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coating: Option<f64>,
    /// Error of the depth of such a block relative to that depth, at the most; `None`: not looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Change of the thickness of the layer at the surface, relative to it, from which on the elastic response is found anew; `None`: it
    /// stays that of the unworn bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thinning_tolerance: Option<f64>,
    /// Depths of the lower and of the upper body alone, where they move against each other: each wears in its own frame, by its own layers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<[OwnDepths; 2]>,
    /// Debris that stays between the surfaces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub debris: Option<DebrisRule>,
    /// Another coefficient far from the open rim of the contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rim: Option<RimRule>,
}

impl WearRule {
    /// The rule of one body alone (0: lower, 1: upper), of bodies that move against each other.
    #[must_use]
    pub fn of_body(&self, body: usize) -> Self {
        let OwnDepths { limit, coating } = self.own.unwrap_or_default()[body];
        let layers = self.layers.as_ref().map(|layers| layers.of_body(body));
        let rim = self.rim.map(|rim| RimRule { interior: [rim.interior[body]; 2], ..rim });
        Self { layers, limit, coating, rim, ..self.clone() }
    }

    /// The largest coefficient that can be in force, of both bodies together [1/pressure].
    pub fn largest_rate(&self) -> f64 {
        let of_layers = || self.layers.as_ref().map_or(0.0, WearLayers::largest_rate);
        let inside = self.rim.map_or(0.0, |rim| rim.interior[0].max(rim.interior[1]));
        self.coefficient.unwrap_or_else(of_layers) * inside.max(1.0)
    }
}
