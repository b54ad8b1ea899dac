//! The parts of a body as they are written, from the surface down: coatings, the substrate, and what is rigid.

use std::ops::Range;

use super::body_file::{BodyFile, LayerConstantsFile, ResidualFile, RigidConstantsFile};
use super::judge::Judge;
use crate::document::At;

/// A body and what it is called.
pub(super) type NamedBody<'a> = (&'a str, &'a BodyFile);

/// A coating or a substrate.
pub(super) struct Layer<'a> {
    pub place: String,
    pub span: Range<usize>,
    /// Depth of its upper face, and its thickness [length].
    pub top: f64,
    pub thickness: f64,
    pub is_coating: bool,
    pub residual_stress: Option<&'a At<ResidualFile>>,
    pub constants: &'a LayerConstantsFile,
}

/// Coatings and substrate, from the surface down.
pub(super) fn layers((which, body): NamedBody<'_>) -> Vec<Layer<'_>> {
    let mut layers = Vec::new();
    let mut top = 0.0;
    for (index, coating) in body.coatings.iter().flat_map(|list| list.iter().enumerate()) {
        layers.push(Layer {
            place: format!("{which}.coatings[{index}]"),
            span: coating.span(),
            top,
            thickness: coating.thickness.value,
            is_coating: true,
            residual_stress: coating.residual_stress.as_ref(),
            constants: &coating.constants,
        });
        top += coating.thickness.value;
    }
    layers.extend(body.substrate.as_ref().map(|substrate| Layer {
        place: format!("{which}.substrate"),
        span: substrate.span(),
        top,
        thickness: f64::INFINITY,
        is_coating: false,
        residual_stress: substrate.residual_stress.as_ref(),
        constants: &substrate.constants,
    }));
    layers
}

/// A constant that every part of a body has, or none.
pub(super) struct Constant {
    key: &'static str,
    of_layer: fn(&LayerConstantsFile) -> Option<&At<f64>>,
    of_rigid: fn(&RigidConstantsFile) -> Option<&At<f64>>,
}

impl Constant {
    pub const THERMAL_CONDUCTIVITY: Self = Self {
        key: "thermal_conductivity",
        of_layer: |layer| layer.thermal_conductivity.as_ref(),
        of_rigid: |rigid| rigid.thermal_conductivity.as_ref(),
    };
    pub const ELECTRICAL_RESISTIVITY: Self = Self {
        key: "electrical_resistivity",
        of_layer: |layer| layer.electrical_resistivity.as_ref(),
        of_rigid: |rigid| rigid.electrical_resistivity.as_ref(),
    };
    pub const WEAR_COEFFICIENT: Self = Self {
        key: "wear_coefficient",
        of_layer: |layer| layer.wear_coefficient.as_ref(),
        of_rigid: |rigid| rigid.wear_coefficient.as_ref(),
    };

    /// The first of a body that is given.
    pub fn first(&self, body: NamedBody<'_>) -> Option<Range<usize>> {
        let layers = layers(body);
        let own = layers.iter().find_map(|layer| (self.of_layer)(layer.constants));
        own.or((self.of_rigid)(&body.1.constants)).map(At::span)
    }

    /// Thickness and value of every part, from the surface down; `None` where no part has it, or it was refused. What is rigid has
    /// `rigid` where it does not say.
    pub fn values(
        &self,
        judge: &mut Judge,
        body: NamedBody<'_>,
        rigid: Option<f64>,
        help: &str,
    ) -> Option<Vec<(f64, f64)>> {
        let ((which, file), key) = (body, self.key);
        let layers = layers(body);
        let own = (self.of_rigid)(&file.constants);
        self.first(body)?;
        if let (Some(own), true) = (own, file.substrate.is_some()) {
            return judge.refuse(
                own.span(),
                format!("{which}.{key}: beside a substrate it belongs into the substrate"),
                &format!("substrate = {{ ..., {key} = ... }}"),
            );
        }
        let mut values = Vec::new();
        let mut part = |place: &str, span: Range<usize>, thickness, value: Option<f64>| match value {
            Some(value) => values.push(Some((thickness, value))),
            None => values.push(judge.refuse(
                span,
                format!("{place}: no {key}, but another part of this body has one"),
                help,
            )),
        };
        for layer in &layers {
            let value = (self.of_layer)(layer.constants).map(|given| given.value);
            part(&layer.place, layer.span.clone(), layer.thickness, value);
        }
        if file.substrate.is_none() {
            let place = layers.first().map_or(0..0, |layer| layer.span.clone());
            part(which, place, f64::INFINITY, own.map(|given| given.value).or(rigid));
        }
        values.into_iter().collect()
    }
}
