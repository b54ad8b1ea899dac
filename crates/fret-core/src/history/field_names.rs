//! The vocabulary of fields: what can be kept of an increment, a number a cell. Files, the Python package and the reference page are
//! made from it.

use ndarray::Array2;

use super::records::KeptFields;
use crate::model::Zone;
use FieldValues::{Reals, Zones};

/// A field as it is stored and shown.
#[derive(Debug)]
pub struct Field {
    /// Name in files and in Python.
    pub name: &'static str,
    /// The name in `[output] fields` that asks for it.
    pub asked_as: &'static str,
    /// What it means, in a line.
    pub meaning: &'static str,
    /// Its unit in those of the case; empty for a zone.
    pub unit: &'static str,
    /// Its values, where they are kept.
    pub values: fn(&KeptFields) -> Option<FieldValues<'_>>,
}

/// Values of a field, shape `(nx, ny)`.
#[derive(Debug, Clone, Copy)]
pub enum FieldValues<'a> {
    /// Real numbers.
    Reals(&'a Array2<f64>),
    /// Zones.
    Zones(&'a Array2<Zone>),
}

/// All fields, in the order in which they are listed.
pub static FIELDS: &[Field] = &[
    Field {
        name: "pressure",
        asked_as: "pressure",
        meaning: "contact pressure, compression positive",
        unit: "pressure",
        values: |kept| kept.pressure.as_ref().map(Reals),
    },
    Field {
        name: "shear_x",
        asked_as: "shear",
        meaning: "shear traction on the lower body along x",
        unit: "pressure",
        values: |kept| kept.shear.as_ref().map(|[x, _]| Reals(x)),
    },
    Field {
        name: "shear_y",
        asked_as: "shear",
        meaning: "shear traction on the lower body along y",
        unit: "pressure",
        values: |kept| kept.shear.as_ref().map(|[_, y]| Reals(y)),
    },
    Field {
        name: "slip_x",
        asked_as: "slip",
        meaning: "relative slip along x since the start, upper body relative to lower, signed",
        unit: "length",
        values: |kept| kept.slip.as_ref().map(|[x, _]| Reals(x)),
    },
    Field {
        name: "slip_y",
        asked_as: "slip",
        meaning: "relative slip along y since the start, upper body relative to lower, signed",
        unit: "length",
        values: |kept| kept.slip.as_ref().map(|[_, y]| Reals(y)),
    },
    Field {
        name: "gap",
        asked_as: "gap",
        meaning: "gap between the surfaces",
        unit: "length",
        values: |kept| kept.gap.as_ref().map(Reals),
    },
    Field {
        name: "zone",
        asked_as: "zone",
        meaning: "zone: 0 open, 1 stick, 2 slip",
        unit: "",
        values: |kept| kept.zone.as_ref().map(Zones),
    },
    Field {
        name: "worn_depth",
        asked_as: "worn_depth",
        meaning: "wear depth of both bodies together",
        unit: "length",
        values: |kept| kept.worn_depth.as_ref().map(Reals),
    },
    Field {
        name: "lower_worn_depth",
        asked_as: "worn_depth",
        meaning: "wear depth of the lower body, where bodies move against each other",
        unit: "length",
        values: |kept| kept.own_worn_depth.as_ref().map(|[lower, _]| Reals(lower)),
    },
    Field {
        name: "upper_worn_depth",
        asked_as: "worn_depth",
        meaning: "wear depth of the upper body in its own frame, where bodies move against each other",
        unit: "length",
        values: |kept| kept.own_worn_depth.as_ref().map(|[_, upper]| Reals(upper)),
    },
    Field {
        name: "debris",
        asked_as: "debris",
        meaning: "thickness of the debris between the surfaces, in the frame of the lower body",
        unit: "length",
        values: |kept| kept.debris.as_ref().map(Reals),
    },
    Field {
        name: "plastic_depth",
        asked_as: "plastic_depth",
        meaning: "depth by which both surfaces together have yielded",
        unit: "length",
        values: |kept| kept.plastic_depth.as_ref().map(Reals),
    },
    Field {
        name: "friction_work",
        asked_as: "friction_work",
        meaning: "energy that friction dissipates in the increment by area: friction bound times slip distance",
        unit: "pressure x length",
        values: |kept| kept.friction_work.as_ref().map(Reals),
    },
    Field {
        name: "friction",
        asked_as: "friction",
        meaning: "coefficient of friction",
        unit: "-",
        values: |kept| kept.friction.as_ref().map(Reals),
    },
];

/// Words of the zones 0, 1, 2.
pub const ZONE_WORDS: [&str; 3] = ["open", "stick", "slip"];

impl KeptFields {
    /// A field of real numbers by its name, where it is kept.
    pub fn field(&self, name: &str) -> Option<&Array2<f64>> {
        let field = FIELDS.iter().find(|field| field.name == name)?;
        match (field.values)(self) {
            Some(FieldValues::Reals(values)) => Some(values),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::FIELD_NAMES;

    #[test]
    fn a_case_can_ask_for_every_field_and_for_nothing_else() {
        let mut asked: Vec<&str> = FIELDS.iter().map(|field| field.asked_as).collect();
        asked.dedup();
        assert_eq!(asked, FIELD_NAMES);
    }

    #[test]
    fn words_of_zones_stand_at_their_numbers() {
        // The numbers are those of the files.
        let numbers = [Zone::Open, Zone::Stick, Zone::Slip].map(|zone| zone as usize);
        assert_eq!(numbers.map(|number| ZONE_WORDS[number]), ["open", "stick", "slip"]);
    }
}
