//! The bodies of the scenes: a rigid one above, one under uniform coatings below.

use std::fmt::Write;

/// A material and, for a coating, its thickness; lengths in nominal contact radii, moduli in those of the plain substrate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Young's modulus.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Thickness.
    pub thickness: f64,
    /// Normal and shear stiffness of the springs below it; none: bonded.
    pub springs: Option<[f64; 2]>,
}

impl Layer {
    /// A bonded one.
    pub const fn bonded(young: f64, poisson: f64, thickness: f64) -> Self {
        Self { young, poisson, thickness, springs: None }
    }
}

/// The lower body.
#[derive(Debug, Clone, PartialEq)]
pub struct Stack {
    /// Coatings, outermost first.
    pub coatings: Vec<Layer>,
    /// Young's modulus and Poisson's ratio; none: a rigid base.
    pub substrate: Option<[f64; 2]>,
}

/// Modulus and Poisson's ratio of the plain substrate.
const PLAIN: [f64; 2] = [1.0, 0.3];

impl Stack {
    /// No coating.
    pub fn plain() -> Self {
        Self { coatings: Vec::new(), substrate: Some(PLAIN) }
    }

    /// One coating on the plain substrate.
    pub fn coated(young: f64, poisson: f64, thickness: f64) -> Self {
        Self { coatings: vec![Layer::bonded(young, poisson, thickness)], substrate: Some(PLAIN) }
    }

    /// The same, every length and every modulus times a number.
    pub fn scaled(&self, length: f64, modulus: f64) -> Self {
        let coatings = self
            .coatings
            .iter()
            .map(|layer| Layer {
                young: layer.young * modulus,
                poisson: layer.poisson,
                thickness: layer.thickness * length,
                springs: layer.springs.map(|springs| springs.map(|stiffness| stiffness * modulus / length)),
            })
            .collect();
        Self { coatings, substrate: self.substrate.map(|[young, poisson]| [young * modulus, poisson]) }
    }

    /// As the text of a case.
    pub fn text(&self) -> String {
        let mut text = "coatings = [".to_owned();
        for Layer { young, poisson, thickness, springs } in &self.coatings {
            let interface = springs.map_or(String::new(), |[normal, shear]| {
                format!(", interface = {{ normal_stiffness = {normal:e}, shear_stiffness = {shear:e} }}")
            });
            let _ = write!(
                text,
                "{{ thickness = {thickness:e}, young = {young:e}, poisson = {poisson:e}{interface} }}, "
            );
        }
        let base = self.substrate.map_or("base = \"rigid\"".to_owned(), |[young, poisson]| {
            format!("substrate = {{ young = {young:e}, poisson = {poisson:e} }}")
        });
        format!("{text}]\n{base}\n")
    }
}
