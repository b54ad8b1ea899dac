//! The bodies: isotropic materials, coatings, layered half-spaces, and the pair that touches.

use serde::{Deserialize, Serialize};

use super::interface::Interface;

/// Why a material or a coating was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MaterialError {
    /// Young's modulus out of range.
    #[error("Young's modulus {0:?}: must be a positive finite modulus, between 1e-100 and 1e100")]
    Young(f64),
    /// Poisson's ratio out of range.
    #[error("Poisson's ratio {0:?}: must lie above -1 and not above 0.5")]
    Poisson(f64),
    /// Thickness out of range.
    #[error("thickness {0:?}: must be a positive finite length, between 1e-100 and 1e100")]
    Thickness(f64),
    /// Two rigid bodies.
    #[error("both bodies are rigid: nothing can deform; give at least one of them a substrate or coatings")]
    BothRigid,
    /// A rigid base without anything on it.
    #[error("a rigid base without coatings is a rigid body: write rigid = true, or add coatings")]
    BareRigidBase,
}

/// Whether powers and quotients of a modulus or length are numbers still.
fn is_within_reach(value: f64) -> bool {
    (1e-100..=1e100).contains(&value)
}

/// A linear elastic isotropic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ElasticMaterial {
    young: f64,
    poisson: f64,
}

impl ElasticMaterial {
    /// Material from Young's modulus [pressure] and Poisson's ratio [-], `-1 < poisson <= 0.5`.
    ///
    /// # Errors
    /// When a value is out of its range; the modulus must lie between 1e-100 and 1e100.
    pub fn new(young: f64, poisson: f64) -> Result<Self, MaterialError> {
        if !is_within_reach(young) {
            return Err(MaterialError::Young(young));
        }
        if !(poisson > -1.0 && poisson <= 0.5) {
            return Err(MaterialError::Poisson(poisson));
        }
        Ok(Self { young, poisson })
    }

    /// Young's modulus E [pressure].
    pub fn young(&self) -> f64 {
        self.young
    }

    /// Poisson's ratio [-].
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Shear modulus `G = E / (2 (1 + nu))` [pressure].
    pub fn shear_modulus(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }
}

/// A layer of uniform thickness, and how it is bonded to what lies below it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Coating {
    material: ElasticMaterial,
    thickness: f64,
    #[serde(default)]
    interface: Interface,
    #[serde(default)]
    continues: bool,
}

impl Coating {
    /// Whether a coating can be so thick [length].
    pub fn can_be(thickness: f64) -> bool {
        is_within_reach(thickness)
    }

    /// Coating of a material with its thickness [length], bonded to what lies below it.
    ///
    /// # Errors
    /// When the thickness is not a positive length between 1e-100 and 1e100.
    pub fn new(material: ElasticMaterial, thickness: f64) -> Result<Self, MaterialError> {
        if !Self::can_be(thickness) {
            return Err(MaterialError::Thickness(thickness));
        }
        Ok(Self { material, thickness, interface: Interface::BONDED, continues: false })
    }

    /// The same coating on another interface.
    #[must_use]
    pub fn on(self, interface: Interface) -> Self {
        Self { interface, ..self }
    }

    /// The same coating as a sublayer of a graded one that goes on below it.
    #[must_use]
    pub fn continued(self) -> Self {
        Self { continues: true, ..self }
    }

    /// The same coating with another thickness [length].
    ///
    /// # Errors
    /// As [`Coating::new`].
    pub fn of_thickness(self, thickness: f64) -> Result<Self, MaterialError> {
        let Self { thickness, .. } = Self::new(self.material, thickness)?;
        Ok(Self { thickness, ..self })
    }

    /// The coating's material.
    pub fn material(&self) -> &ElasticMaterial {
        &self.material
    }

    /// Thickness [length].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// How it is bonded to what lies below it.
    pub fn interface(&self) -> &Interface {
        &self.interface
    }

    /// Whether it is a sublayer of a graded coating that goes on below it.
    pub fn continues(&self) -> bool {
        self.continues
    }
}

/// What the lowest coating lies on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Base {
    /// An elastic half-space.
    Elastic(ElasticMaterial),
    /// A rigid foundation.
    Rigid,
}

/// A half-space under any number of coatings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HalfSpace {
    coatings: Vec<Coating>,
    base: Base,
}

impl HalfSpace {
    /// Half-space from its coatings, outermost first, and what they lie on.
    ///
    /// # Errors
    /// When the base is rigid and there is no coating.
    pub fn new(coatings: Vec<Coating>, base: Base) -> Result<Self, MaterialError> {
        if coatings.is_empty() && base == Base::Rigid {
            return Err(MaterialError::BareRigidBase);
        }
        Ok(Self { coatings, base })
    }

    /// A homogeneous half-space.
    pub fn homogeneous(material: ElasticMaterial) -> Self {
        Self { coatings: Vec::new(), base: Base::Elastic(material) }
    }

    /// Coatings, outermost first.
    pub fn coatings(&self) -> &[Coating] {
        &self.coatings
    }

    /// What the lowest coating lies on.
    pub fn base(&self) -> &Base {
        &self.base
    }

    /// Depths of the lower faces of its coatings [length], from the surface down.
    pub fn interfaces(&self) -> Vec<f64> {
        let mut depth = 0.0;
        let lower_face = |coating: &Coating| {
            depth += coating.thickness();
            depth
        };
        self.coatings.iter().map(lower_face).collect()
    }

    /// Sum of the coatings' thicknesses [length].
    pub fn coating_thickness(&self) -> f64 {
        self.coatings.iter().map(Coating::thickness).sum()
    }

    /// The material at the surface.
    pub fn surface_material(&self) -> &ElasticMaterial {
        match (self.coatings.first(), &self.base) {
            (Some(coating), _) => coating.material(),
            (None, Base::Elastic(material)) => material,
            (None, Base::Rigid) => unreachable!("a rigid base always carries a coating"),
        }
    }

    /// Whether a layer slides freely on what lies below it, so that it resists no tangential force.
    pub fn slides_freely(&self) -> bool {
        self.coatings.iter().any(|coating| coating.interface.is_frictionless())
    }

    /// The single material of a half-space that is homogeneous: without coatings, or with coatings of the base's own material, bonded.
    pub fn single_material(&self) -> Option<&ElasticMaterial> {
        match &self.base {
            Base::Elastic(material) => {
                let is_the_same =
                    |coating: &Coating| coating.material() == material && coating.interface.is_bonded();
                self.coatings.iter().all(is_the_same).then_some(material)
            }
            Base::Rigid => None,
        }
    }

    /// The same half-space without the layer work it does not need: neighbouring coatings of one material joined where they are bonded,
    /// coatings of the base's own material dropped.
    #[must_use]
    pub fn simplified(&self) -> Self {
        let mut coatings: Vec<Coating> = Vec::with_capacity(self.coatings.len());
        for coating in &self.coatings {
            match coatings.last_mut() {
                Some(last) if last.material == coating.material && last.interface.is_bonded() => {
                    last.thickness += coating.thickness;
                    last.interface = coating.interface;
                    last.continues = coating.continues;
                }
                _ => coatings.push(*coating),
            }
        }
        if let (Some(last), Base::Elastic(material)) = (coatings.last(), &self.base)
            && last.material == *material
            && last.interface.is_bonded()
        {
            coatings.pop();
        }
        Self { coatings, base: self.base }
    }
}

/// One of the two bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Body {
    /// Does not deform.
    Rigid,
    /// A layered half-space.
    Elastic(HalfSpace),
}

/// The two bodies that touch; at least one is elastic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactPair {
    upper: Body,
    lower: Body,
}

impl ContactPair {
    /// Pair of bodies.
    ///
    /// # Errors
    /// When both are rigid.
    pub fn new(upper: Body, lower: Body) -> Result<Self, MaterialError> {
        if upper == Body::Rigid && lower == Body::Rigid {
            return Err(MaterialError::BothRigid);
        }
        Ok(Self { upper, lower })
    }

    /// Whether any of the bodies rests on an elastic half-space, which under a line load has no zero of displacement.
    pub fn has_elastic_base(&self) -> bool {
        let elastic =
            |body: &Body| matches!(body, Body::Elastic(half_space) if half_space.base != Base::Rigid);
        elastic(&self.upper) || elastic(&self.lower)
    }

    /// The body that moves.
    pub fn upper(&self) -> &Body {
        &self.upper
    }

    /// The body below, into which z points.
    pub fn lower(&self) -> &Body {
        &self.lower
    }
}
