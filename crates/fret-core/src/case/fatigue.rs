//! The judgement of the constants of fatigue and fracture.

use super::judge::Judge;
use super::parts::{Layer, NamedBody, layers};
use crate::subsurface::fatigue::{FatigueConstants, LayerConstants};

/// Constants of the layers of a body; none of what is refused.
pub(super) fn fatigue(judge: &mut Judge, body: NamedBody<'_>) -> LayerConstants {
    LayerConstants::new(layers(body).iter().map(|layer| (layer.top, constants(judge, layer))).collect())
}

fn constants(judge: &mut Judge, layer: &Layer<'_>) -> FatigueConstants {
    let Some(given) = &layer.constants.fatigue else { return FatigueConstants::default() };
    let place = format!("{}.fatigue", layer.place);
    if !judge.places.are_whole_in(&place) {
        return FatigueConstants::default();
    }
    if let Some((_, what)) = given.contradiction() {
        judge.refuse::<()>(given.span(), format!("{place}: {what}"), "");
        return FatigueConstants::default();
    }
    let of_coatings = [
        ("fracture_energy", given.fracture_energy),
        ("interface_energy", given.interface_energy),
        ("channelling_factor", given.channelling_factor),
        ("interface_phase", given.interface_phase),
    ];
    if let (false, Some((key, _))) = (layer.is_coating, of_coatings.iter().find(|(_, value)| value.is_some()))
    {
        let place = format!("{place}.{key}");
        judge.refuse::<()>(
            judge.places.of(&place).unwrap_or(given.span()),
            format!("{place}: a constant of coatings"),
            "coatings = [{ ..., fatigue = { ... } }]",
        );
    }
    given.value
}

#[cfg(test)]
mod tests {
    use crate::case::Case;

    fn read(coating: &str, substrate: &str) -> Result<Case, String> {
        let text = format!(
            "[grid]\ncells = 64\nsize = 1.0\n[upper]\nrigid = true\n[lower]\n\
             coatings = [{{ thickness = 0.5, young = 2.0, poisson = 0.3, fatigue = {{ {coating} }} }}]\n\
             substrate = {{ young = 1.0, poisson = 0.3, fatigue = {{ {substrate} }} }}\n[profile.cylinder]\nradius = 100.0\naxis = \"y\"\n\
             [[load]]\nnormal_force = 1e-4\nincrements = 1\n"
        );
        Case::from_toml(&text, "case.toml").map_err(|error| error.to_string())
    }

    #[test]
    fn constants_are_read_layer_by_layer() {
        let life = "strain_life = { strength_coefficient = 9.0, strength_exponent = -0.1, ductility_coefficient = 0.3, ductility_exponent = -0.6 }";
        let case = read("fracture_energy = 4.0, channelling_factor = 2.0", life).unwrap();
        let [lower, upper] = &case.fatigue;
        assert_eq!(lower.at(0.2).channelling_factor, Some(2.0));
        assert!(lower.at(0.2).strain_life.is_none());
        assert_eq!(lower.at(f64::INFINITY).strain_life.unwrap().strength_exponent, -0.1);
        assert!(upper.is_none());
    }

    #[test]
    fn wrong_constants_are_refused_where_they_stand() {
        let crack = "threshold = 1.0, short_crack_length = 0.1, initial_length = 0.2";
        for (coating, substrate, words) in [
            (
                "yield_strength = -1.0",
                "",
                "lower.coatings[0].fatigue.yield_strength = -1.0: must be positive",
            ),
            ("torsion_limit = 1.0", "", "belong together"),
            ("", "fracture_energy = 1.0", "a constant of coatings"),
            ("", "yield = 1.0", "yield"),
            ("", &format!("crack = {{ {crack}, final_length = 0.1 }}"), "final_length must be greater"),
            (
                "",
                &format!("crack = {{ {crack}, final_length = 1.0, paris_exponent = 3.0 }}"),
                "belong together",
            ),
            (
                "",
                "strain_life = { strength_coefficient = 9.0, strength_exponent = 0.1, ductility_coefficient = 0.3, ductility_exponent = -0.6 }",
                "must be negative",
            ),
        ] {
            let error = read(coating, substrate).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
