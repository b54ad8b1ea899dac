//! What derivatives can be taken by: numbers of a case, named by their paths as a case writes them.

use super::case_number::{BodyNumber, LayerNumber, OF_WEAR, ResidualNumber, SHAPE_NUMBERS, What};
use super::error::SensitivityError;
use super::named_number::number_at;
use crate::case::Case;
use crate::model::controls::{Form, ways};
use crate::model::{Body, EvolutionLaw, WearLayers};

/// A number of a case by which derivatives are taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    path: String,
    value: f64,
    what: What,
}

/// Numbers of the surfaces.
const OF_SURFACES: [&str; 9] = [
    "friction.coefficient",
    "friction.max_shear",
    "friction.evolution.last",
    "friction.evolution.scale",
    "wear.coefficient",
    "wear.rim.width",
    "wear.rim.interior",
    "wear.debris.fraction",
    "wear.debris.outflow_length",
];

impl Parameter {
    /// The number of a case that stands at a path.
    ///
    /// # Errors
    /// When there is none, or it is not one that a history depends on smoothly.
    pub fn new(path: &str, case: &Case) -> Result<Self, SensitivityError> {
        let (what, value) = number_at(path, case)
            .map_err(|reason| SensitivityError::Parameter { path: path.to_owned(), reason })?;
        Ok(Self { path: path.to_owned(), value, what })
    }

    /// All numbers of a case by which derivatives can be taken.
    pub fn all_of(case: &Case) -> Vec<Self> {
        let mut paths: Vec<String> = OF_SURFACES.map(str::to_owned).to_vec();
        if let Some(EvolutionLaw::Table(rows)) = case.friction_evolution.as_ref().map(|rule| &rule.law) {
            let columns = (0..rows.len()).flat_map(|row| [(row, 0), (row, 1)]);
            paths.extend(columns.map(|(row, column)| format!("friction.evolution.table[{row}][{column}]")));
        }
        for (number, stage) in case.stages.iter().enumerate() {
            paths.push(format!("load[{number}].friction"));
            for (row, way) in ways() {
                for axis in row.freedoms().map(|freedom| freedom - row.freedom) {
                    let place = if row.form == Form::Number { String::new() } else { format!("[{axis}]") };
                    if !stage.by_freedom()[row.freedom + axis].is_some_and(|control| control.path().is_zero())
                    {
                        paths.push(format!("load[{number}].{}{place}", way.name));
                    }
                }
            }
        }
        for table in ["profile", "upper.profile", "lower.profile"] {
            for shape in &case.profile.shapes {
                paths.extend(SHAPE_NUMBERS.map(|number| format!("{table}.{}.{number}", shape.name())));
            }
        }
        for (name, body) in [("upper", case.bodies.upper()), ("lower", case.bodies.lower())] {
            let Body::Elastic(body) = body else { continue };
            for coating in 0..body.coatings().len() {
                let numbers = [
                    "young",
                    "poisson",
                    "thickness",
                    "interface.normal_stiffness",
                    "interface.shear_stiffness",
                ];
                paths.extend(numbers.map(|number| format!("{name}.coatings[{coating}].{number}")));
            }
            paths.extend(["young", "poisson"].map(|number| format!("{name}.substrate.{number}")));
        }
        if let Some(layers) = case.wear.as_ref().and_then(|wear| wear.layers.as_ref()) {
            for (name, layers) in ["lower", "upper"].iter().zip(layers.bodies()) {
                paths.extend(
                    (0..layers.len()).map(|index| format!("{name}.coatings[{index}].wear_coefficient")),
                );
                paths.extend(["substrate.", ""].map(|below| format!("{name}.{below}wear_coefficient")));
            }
        }
        for (name, residual) in ["lower", "upper"].iter().zip(&case.residual_stress) {
            for (index, layer) in residual.layers().iter().enumerate() {
                let is_one = layer.even().is_some_and(|[x, y]| x == y);
                let axes: &[&str] = if is_one { &[""] } else { &["[0]", "[1]"] };
                for layer in [format!("coatings[{index}]"), "substrate".to_owned()] {
                    paths.extend(axes.iter().map(|axis| format!("{name}.{layer}.residual_stress{axis}")));
                }
            }
        }
        paths.extend(["normal_stiffness", "tangential_stiffness"].map(|key| format!("rig.{key}")));
        let mut found: Vec<Self> = Vec::new();
        for path in paths {
            if let Ok(parameter) = Self::new(&path, case)
                && !found.iter().any(|known| known.what == parameter.what)
            {
                found.push(parameter);
            }
        }
        found
    }

    /// Its path.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Its value in the case.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Whether it is what a stage prescribes.
    pub(super) fn is_a_load(&self) -> bool {
        matches!(self.what, What::Control { .. })
    }

    /// Whether it is what a stage prescribes of a degree of freedom.
    pub(super) fn is_control(&self, stage: usize, freedom: usize) -> bool {
        self.what == What::Control { stage, freedom }
    }

    /// Derivatives of the coefficient and of the shear strength in force at a stage.
    pub(super) fn change_of_friction(&self, case: &Case, stage: usize) -> [f64; 2] {
        let latest = (0..=stage).rev().find(|&number| case.stages[number].friction.is_some());
        match self.what {
            What::Friction { stage } if stage == latest => [1.0, 0.0],
            What::Strength => [0.0, 1.0],
            _ => [0.0; 2],
        }
    }

    /// Derivative of the gap at a point, without where it is counted from.
    pub(super) fn change_of_gap(&self, case: &Case, x: f64, y: f64) -> f64 {
        let What::Shape { index, number } = self.what else { return 0.0 };
        case.profile.shapes[index].gap_change_at(number, x, y).unwrap_or(0.0)
    }

    /// Whether the gap depends on it.
    pub(super) fn is_of_shape(&self) -> bool {
        matches!(self.what, What::Shape { .. })
    }

    /// Derivatives of the compliances of the machine [length/force per unit]: normal, along x and y.
    pub(super) fn change_of_rig(&self, case: &Case) -> [f64; 3] {
        let What::Rig { normal, along } = self.what else { return [0.0; 3] };
        let springs = case.springs();
        // Compliance is the inverse of the stiffness that a case gives.
        let of = |is: bool, compliance: f64| if is { -compliance * compliance } else { 0.0 };
        [of(normal, springs.normal), of(along[0], springs.tangential[0]), of(along[1], springs.tangential[1])]
    }

    /// Derivatives of the numbers of the wear rule: coefficient, width and part inside of the rim, fraction and outflow length of debris.
    pub(super) fn change_of_wear(&self) -> [f64; OF_WEAR] {
        std::array::from_fn(|number| f64::from(u8::from(self.what == What::Wear(number))))
    }

    /// Derivatives of wear coefficient and thickness of each layer that wears, first those of the lower body.
    pub(super) fn change_of_layers(&self, case: &Case) -> Vec<[f64; 2]> {
        let layers = case.wear.as_ref().and_then(|wear| wear.layers.as_ref());
        let Some([lower, upper]) = layers.map(WearLayers::bodies) else { return Vec::new() };
        let mut change = vec![[0.0; 2]; lower.len() + upper.len()];
        let (number, which) = match self.what {
            What::LayerWear(number) => (number, 0),
            What::Body(BodyNumber { of_upper, coating: Some(index), number: LayerNumber::Thickness })
                if ![lower, upper][usize::from(of_upper)].is_empty() =>
            {
                (index + if of_upper { lower.len() } else { 0 }, 1)
            }
            _ => return change,
        };
        change[number][which] = 1.0;
        change
    }

    /// Derivatives of the numbers of the law by which friction evolves; none where it does not.
    pub(super) fn change_of_evolution(&self, case: &Case) -> Vec<f64> {
        let Some(law) = case.friction_evolution.as_ref().map(|rule| &rule.law) else { return Vec::new() };
        let mut change = vec![0.0; law.numbers()];
        match self.what {
            What::Evolution(number) => change[number] = 1.0,
            What::Friction { stage: None } => change[law.first()] = 1.0,
            _ => {}
        }
        change
    }

    /// The residual stress that it is.
    pub(super) fn of_residual(&self) -> Option<ResidualNumber> {
        if let What::Residual(number) = self.what { Some(number) } else { None }
    }

    /// The constant of a body that it is.
    pub(super) fn of_body(&self) -> Option<BodyNumber> {
        if let What::Body(number) = self.what { Some(number) } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both ways to write a path, and names of stages.
    #[test]
    fn paths_are_those_of_cases_and_of_sweeps() {
        let text = "[grid]\ncells = [8, 8]\nsize = [1.0, 1.0]\n[upper]\nrigid = true\n[lower]\ncoatings = [{ thickness = 0.1, young = 3.0, \
                    poisson = 0.2 }]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = 2.0\n[friction]\n\
                    coefficient = 0.3\n[[load]]\nnormal_force = 0.1\nincrements = 1\n[[load]]\nname = \"rub\"\n\
                    tangential_force = [0.01, 0.0]\nincrements = 2\n";
        let case = Case::from_toml(text, "case.toml").unwrap();
        let of = |path: &str| Parameter::new(path, &case).unwrap();
        for (one, other, value) in [
            ("lower.coatings[0].young", "lower.coatings.0.young", 3.0),
            ("load[1].tangential_force[0]", "load.rub.tangential_force.0", 0.01),
            ("load[0].normal_force", "load.0.normal_force", 0.1),
            ("friction", "friction.coefficient", 0.3),
        ] {
            assert_eq!((of(one).what, of(one).value()), (of(other).what, value), "{one}");
        }
        let all = Parameter::all_of(&case);
        let paths: Vec<&str> = all.iter().map(Parameter::path).collect();
        assert_eq!(
            paths,
            [
                "friction.coefficient",
                "load[0].normal_force",
                "load[1].tangential_force[0]",
                "profile.sphere.radius",
                "lower.coatings[0].young",
                "lower.coatings[0].poisson",
                "lower.coatings[0].thickness",
                "lower.substrate.young",
                "lower.substrate.poisson",
            ]
        );
        for wrong in ["lower..young", "[0]", "load.rubb.friction", "lower.coatings[0]", "upper.0"] {
            assert!(Parameter::new(wrong, &case).is_err(), "{wrong}");
        }
    }
}
