//! Closed forms of line contacts: cylinders on homogeneous bodies, displacements relative to the datum.

use std::f64::consts::FRAC_1_PI;

use crate::analytic::{HertzLine, LineHistory};
use crate::model::{Body, Control, ElasticMaterial};
use crate::plan::Plan;

/// A cylinder pressed without friction.
#[derive(Debug, Clone, Copy)]
pub struct LinePressed {
    /// Pressure and half-width.
    pub hertz: HertzLine,
    /// Approach relative to the datum [length]; `None` where there is none.
    pub approach: Option<f64>,
}

impl LinePressed {
    /// The contact of a plan of homogeneous bodies under a normal force per length, where it is one of cylinders.
    pub fn by(plan: &Plan, control: Control, modulus: f64) -> Option<Self> {
        let profile = &plan.case.profile;
        let is_round =
            profile.heights.is_empty() && profile.shapes.iter().all(|shape| shape.curvatures().is_some());
        let ([curvature, _], Control::Force(force), true) = (profile.curvatures(), control, is_round) else {
            return None;
        };
        if !(curvature > 0.0) {
            return None;
        }
        let hertz = HertzLine::cylinder(curvature.recip(), force, modulus).ok()?;
        let approach = plan.datum.map(|depth| hertz.approach(depth, modulus, shear_compliance(plan)));
        Some(Self { hertz, approach })
    }

    /// The contact before any tangential force, of a coefficient of friction; `None` unless the force acts along one axis.
    pub fn at_rest(
        &self,
        plan: &Plan,
        friction: f64,
        modulus: f64,
        direction: [f64; 2],
    ) -> Option<LineHistory> {
        let compliance = match direction {
            [_, 0.0] => 2.0 / modulus,
            [0.0, _] => shear_compliance(plan),
            _ => return None,
        };
        LineHistory::new(&self.hertz, friction, compliance).ok()
    }
}

/// What a unit tangential force per length moves its datum by, backwards: `-sum 1/(2 pi G)` across the axis, nothing along it.
pub fn at_datum(plan: &Plan, direction: [f64; 2]) -> f64 {
    if direction[1] == 0.0 { -FRAC_1_PI * shear_compliance(plan) / 2.0 } else { 0.0 }
}

/// Sum of `1/G` of the bodies that deform.
fn shear_compliance(plan: &Plan) -> f64 {
    let bodies = &plan.case.bodies;
    let of = |body: &Body| match body {
        Body::Rigid => None,
        Body::Elastic(half_space) => half_space.single_material().map(ElasticMaterial::shear_modulus),
    };
    [bodies.upper(), bodies.lower()].into_iter().filter_map(of).map(f64::recip).sum()
}
