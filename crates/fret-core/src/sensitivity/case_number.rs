//! Kinds of numbers of a case that a history depends on smoothly.

/// Which constant of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LayerNumber {
    Young,
    Poisson,
    Thickness,
    NormalStiffness,
    ShearStiffness,
}

/// A constant of a body: of a coating, or of the substrate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct BodyNumber {
    /// Whether it is one of the upper body.
    pub of_upper: bool,
    /// Which coating, from the surface down; `None`: the substrate.
    pub coating: Option<usize>,
    /// Which constant.
    pub number: LayerNumber,
}

/// The residual stress of a layer, the same in all its depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ResidualNumber {
    /// Whether it is one of the upper body.
    pub of_upper: bool,
    /// Which layer, as a case names them, from the surface down.
    pub named: usize,
    /// Whether it acts along x and along y.
    pub along: [bool; 2],
}

/// Which number of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum What {
    /// What a stage prescribes of a degree of freedom.
    Control { stage: usize, freedom: usize },
    /// The friction coefficient: at the start, or of a stage.
    Friction { stage: Option<usize> },
    /// The shear strength of the interface.
    Strength,
    /// A number of a shape of the gap.
    Shape { index: usize, number: &'static str },
    /// A stiffness of the machine: normal, along x, along y, or along both.
    Rig { normal: bool, along: [bool; 2] },
    /// The wear coefficient, a number of the rim or of debris, by their places among the numbers of a wear rule.
    Wear(usize),
    /// The wear coefficient of a layer, by its place among those that wear, first those of the lower body.
    LayerWear(usize),
    /// A number of the law by which friction evolves, by its place there.
    Evolution(usize),
    /// A constant of a body.
    Body(BodyNumber),
    /// The residual stress of a layer.
    Residual(ResidualNumber),
}

/// Numbers of shapes.
pub(super) const SHAPE_NUMBERS: [&str; 7] =
    ["radius", "radius_x", "radius_y", "flat_radius", "edge_radius", "slope", "amplitude"];

/// Numbers of a wear rule: the coefficient, width and part in force inside of the rim, fraction and outflow length of debris.
pub(super) const OF_WEAR: usize = 5;
/// The place of the fraction, beside which the outflow length stands.
pub(super) const FRACTION: usize = 3;
