//! What kind of quantity a dotted key of a case is: its description says so in brackets, as in "Thickness [length], positive".

use std::sync::OnceLock;

use serde_json::Value;

use super::key::words_of;

/// Words of kinds of quantities whose units follow from those of a case.
const WORDS: [&str; 6] = ["length", "force", "pressure", "rad", "x", "sqrt"];

/// The kind of a key's quantity, as in `force x length`; `None` where it has no unit, or its author's alone.
pub fn kind_of(key: &str) -> Option<&'static str> {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    let schema = SCHEMA.get_or_init(fret_core::case::schema);
    let words = words_of(key);
    if words.contains(&"parameters") {
        return None;
    }
    let mut here = vec![schema];
    for (place, word) in words.iter().enumerate() {
        let mut found = Vec::new();
        for node in &here {
            entries(schema, node, word, &mut found);
        }
        // the name of an entry of a list is none of its keys
        if !found.is_empty() || place + 1 == words.len() {
            here = found;
        }
    }
    here.iter().find_map(|node| in_brackets(node.get("description")?.as_str()?))
}

/// The entries of a name in a node of the schema: in what it refers to, in its alternatives, in the items of its list.
fn entries<'a>(schema: &'a Value, node: &'a Value, name: &str, found: &mut Vec<&'a Value>) {
    found.extend(node.get("properties").and_then(|properties| properties.get(name)));
    let target = node.get("$ref").and_then(Value::as_str).and_then(|path| path.rsplit('/').next());
    let referred = target.and_then(|target| schema.get("$defs")?.get(target));
    let alternatives = ["anyOf", "oneOf", "allOf"].into_iter().filter_map(|word| node.get(word)?.as_array());
    for inner in alternatives.flatten().chain(node.get("items")).chain(referred) {
        entries(schema, inner, name, found);
    }
}

/// The first kind that a description has in brackets, and that the units of a case say something of.
fn in_brackets(description: &str) -> Option<&str> {
    let bracketed = description.split('[').skip(1).filter_map(|part| part.split_once(']'));
    let has_unit = |kind: &&str| {
        let mut words =
            kind.split(|letter: char| !letter.is_alphabetic()).filter(|word| !word.is_empty()).peekable();
        words.peek().is_some() && words.all(|word| WORDS.contains(&word))
    };
    bracketed.map(|(kind, _)| kind).find(has_unit)
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
            ("lower.substrate.residual_stress", Some("pressure")),
            ("lower.substrate.fatigue.crack.initial_length", Some("length")),
            ("profile.wave.amplitude", Some("length")),
            ("profile.formula.parameters.radius", None),
            ("grid.size.0", Some("length")),
            ("grid.cells", None),
            ("friction.coefficient", None),
            ("wear.coefficient", Some("1/pressure")),
            ("wear.debris.stiffness", Some("pressure")),
            ("wear.limit", Some("length")),
            ("lower.substrate.poisson", None),
        ] {
            assert_eq!(kind_of(key), kind, "{key}");
        }
    }
}
