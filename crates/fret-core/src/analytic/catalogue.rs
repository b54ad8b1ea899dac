//! The closed forms that solve a contact from a few numbers. A new one is a file of its own with its row, and a line here.

use super::form::Form;
use super::{
    cattaneo_line, cattaneo_mindlin, cone, flat_punch, hertz, hertz_ellipse, hertz_line, moduli, no_slip,
    rounded_punch, sliding_cylinder, stretched_sphere, thick_layer, thin_layer, tilted_punch, torsion,
    westergaard,
};

/// All of them, those that others take in first.
pub static FORMS: &[&Form] = &[
    &moduli::FORM,
    &hertz::FORM,
    &hertz_ellipse::FORM,
    &hertz_line::FORM,
    &flat_punch::FORM,
    &rounded_punch::FORM,
    &tilted_punch::OF_DISC,
    &tilted_punch::OF_LINE,
    &cone::FORM,
    &westergaard::FORM,
    &thin_layer::FORM,
    &thick_layer::FORM,
    &cattaneo_mindlin::FORM,
    &torsion::FORM,
    &stretched_sphere::ALONG_X,
    &stretched_sphere::EQUIBIAXIAL,
    &cattaneo_line::PUSHED,
    &cattaneo_line::STRETCHED,
    &sliding_cylinder::FORM,
    &no_slip::PUNCH,
    &no_slip::SPHERE,
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::FORMS;
    use crate::analytic::{Hertz, Kind};

    fn count(kind: Kind) -> usize {
        match kind {
            Kind::Number | Kind::NumberOrZero => 1,
            Kind::Material | Kind::MaterialOrRigid => 2,
            Kind::Sphere | Kind::Cylinder | Kind::Layer => 3,
        }
    }

    #[test]
    fn every_form_solves_and_holds_what_it_says() {
        // Fits all: slopes, strains and couplings are small, forces of friction held, the layer thick and thin enough.
        let fitting = |name: &str| match name {
            "contact_radius" => vec![0.02],
            "friction_coefficient" | "poisson" => vec![0.3],
            "layer" => vec![1.0, 0.3, 0.1],
            "lower" | "upper" => vec![1.0, 0.3],
            "strain" | "tilt" | "moment" => vec![0.005],
            "slope" | "amplitude" | "mean_pressure" | "tangential_force" => vec![0.1],
            "sphere" | "cylinder" => vec![1.0; 3],
            _ => vec![1.0],
        };
        let coupled = |name: &str| if name == "coupling" { vec![0.3] } else { fitting(name) };
        for form in FORMS {
            let given: Vec<f64> = form.parameters.iter().flat_map(|asked| coupled(asked.name)).collect();
            assert_eq!(given.len(), form.parameters.iter().map(|asked| count(asked.kind)).sum::<usize>());
            let solved = form.solve(&given).unwrap_or_else(|refusal| panic!("{}: {refusal}", form.name));
            let found: BTreeSet<&str> = solved.numbers().keys().map(String::as_str).collect();
            let numbers = form.solution.functions.iter().filter(|function| function.at.is_empty());
            let said =
                form.solution.numbers.iter().map(|entry| entry.name).chain(numbers.map(|number| number.name));
            assert_eq!(found, said.collect(), "{}", form.name);
            for function in form.solution.functions.iter().filter(|function| !function.at.is_empty()) {
                let at = solved.function(function.name, function.at.len()).expect("a function by its name");
                assert!(at(&vec![1e-3; function.at.len()]).is_finite(), "{}", form.name);
            }
            assert!(form.solve(&[]).is_err() && form.solve(&vec![1.0; given.len() + 1]).is_err());
        }
    }

    #[test]
    fn a_row_says_what_the_solution_says() {
        let hertz = Hertz::sphere(2.0, 3.0, 5.0).unwrap();
        let form = FORMS.iter().find(|form| form.name == "hertz").unwrap();
        let solved = form.solve(&[2.0, 3.0, 5.0]).unwrap();
        assert_eq!(solved.numbers()["contact_radius"], hertz.contact_radius);
        let pressure = solved.function("pressure", 1).unwrap();
        assert_eq!(pressure(&[0.1]).to_bits(), hertz.pressure(0.1).to_bits());
        assert!(solved.function("pressure", 2).is_none() && solved.function("shear", 1).is_none());
        assert_eq!(
            form.solve(&[2.0, -3.0, 5.0]).map(drop).unwrap_err().to_string(),
            "force = -3: must be positive and finite"
        );
    }
}
