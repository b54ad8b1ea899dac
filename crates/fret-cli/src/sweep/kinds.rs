//! What kind of quantity a dotted key of a case is: those of the controls stand in their own table, all others here.

use fret_core::model::controls::ways;

use super::key::words_of;

/// Last words of keys that have a unit, and its kind.
const KINDS: [(&str, &str); 32] = [
    ("size", "length"),
    ("datum", "length"),
    ("thickness", "length"),
    ("radius", "length"),
    ("radius_x", "length"),
    ("radius_y", "length"),
    ("flat_radius", "length"),
    ("edge_radius", "length"),
    ("crown_radius", "length"),
    ("tip_radius", "length"),
    ("length", "length"),
    ("length_x", "length"),
    ("length_y", "length"),
    ("flat_length", "length"),
    ("amplitude", "length"),
    ("wavelength_x", "length"),
    ("wavelength_y", "length"),
    ("half_width", "length"),
    ("critical_distance", "length"),
    ("short_cutoff", "length"),
    ("long_cutoff", "length"),
    ("outflow_length", "length"),
    ("young", "pressure"),
    ("max_shear", "pressure"),
    ("yield_strength", "pressure"),
    ("hardness", "pressure"),
    ("residual_stress", "pressure"),
    ("wear_coefficient", "1/pressure"),
    // Of debris.
    ("stiffness", "pressure"),
    // Of an interface; of the machine below.
    ("normal_stiffness", "pressure/length"),
    ("shear_stiffness", "pressure/length"),
    ("tangential_stiffness", "force/length"),
];

/// The kind of a key's quantity, as in `force x length`; `None` where it has no unit, or its author's alone.
pub fn kind_of(key: &str) -> Option<&'static str> {
    let words = words_of(key);
    let last = *words.last()?;
    match words[..] {
        _ if words.contains(&"parameters") => None,
        ["rig", "normal_stiffness", ..] => Some("force/length"),
        ["wear", "coefficient"] => Some("1/pressure"),
        _ => {
            let control = ways().find(|(_, way)| way.name == last).map(|(_, way)| way.unit);
            control.or_else(|| KINDS.iter().find(|(word, _)| *word == last).map(|(_, kind)| *kind))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::kind_of;

    #[test]
    fn every_control_and_every_length_has_its_kind() {
        for (key, kind) in [
            ("load.rub.actuator.0", Some("length")),
            ("load.0.actuator_approach", Some("length")),
            ("load.0.mean_gap", Some("length")),
            ("load.1.tangential_force.1", Some("force")),
            ("load.1.tilt_moment", Some("force x length")),
            ("load.1.twist", Some("rad")),
            ("rig.normal_stiffness", Some("force/length")),
            ("rig.tangential_stiffness.0", Some("force/length")),
            ("lower.coatings.0.interface.normal_stiffness", Some("pressure/length")),
            ("lower.substrate.young", Some("pressure")),
            ("profile.wave.amplitude", Some("length")),
            ("profile.formula.parameters.radius", None),
            ("friction.coefficient", None),
            ("wear.coefficient", Some("1/pressure")),
            ("wear.debris.stiffness", Some("pressure")),
            ("lower.substrate.poisson", None),
        ] {
            assert_eq!(kind_of(key), kind, "{key}");
        }
    }
}
