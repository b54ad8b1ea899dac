//! Numbers of a case that can be dragged: moduli, thicknesses, friction, radii, loads; and how far.

use fret_core::model::controls::{Kind, NORMAL, ways};
use serde::Serialize;
use toml::{Table, Value};

use crate::sweep::key::words_of;
use crate::sweep::kinds::kind_of;

/// How far a number can be dragged.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Reach {
    /// Up and down by this factor; equal ways are equal factors.
    Factor(f64),
    /// From nothing to so many times the value.
    Times(f64),
    /// Between two values.
    Between(f64, f64),
}

/// Last word of a key, how far.
type Row = (&'static str, Reach);

/// What can be dragged in a body, a profile, the friction; of a stage all controls can.
const ROWS: [Row; 11] = [
    ("young", Reach::Factor(5.0)),
    ("poisson", Reach::Between(0.0, 0.5)),
    ("thickness", Reach::Factor(8.0)),
    ("coefficient", Reach::Between(0.01, 1.5)),
    ("max_shear", Reach::Factor(8.0)),
    ("radius", Reach::Factor(4.0)),
    ("radius_x", Reach::Factor(4.0)),
    ("radius_y", Reach::Factor(4.0)),
    ("half_angle", Reach::Between(20.0, 88.0)),
    ("normal_stiffness", Reach::Factor(10.0)),
    ("shear_stiffness", Reach::Factor(10.0)),
];

/// Parts of a case that are looked through.
const PARTS: [&str; 5] = ["upper", "lower", "profile", "friction", "load"];
/// Sliders, at the most.
const MOST: usize = 24;

/// A number that can be dragged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Slider {
    /// Its dotted key.
    pub key: String,
    /// Kind of its unit, where it has one.
    #[serde(skip)]
    pub kind: Option<&'static str>,
    /// What the case has.
    pub value: f64,
    /// Where the slider ends on the left.
    pub low: f64,
    /// Where it ends on the right.
    pub high: f64,
    /// Whether equal ways are equal factors.
    pub logarithmic: bool,
}

/// The sliders of a case, and how many more there would be.
pub fn sliders(case: &Table) -> (Vec<Slider>, usize) {
    let mut found = Vec::new();
    for part in PARTS {
        if let Some(value) = case.get(part) {
            look(value, part, &mut found);
        }
    }
    // What is asked first stands first: loads and friction, then layers, Poisson's ratios last.
    let rank = |slider: &Slider| match slider.key.split('.').next() {
        Some("load") => 0,
        Some("friction") => 1,
        _ if slider.key.ends_with("poisson") => 4,
        Some("profile") => 3,
        _ => 2,
    };
    found.sort_by_key(rank);
    let more = found.len().saturating_sub(MOST);
    found.truncate(MOST);
    (found, more)
}

/// Looks through a value; `key` leads there.
fn look(value: &Value, key: &str, found: &mut Vec<Slider>) {
    match value {
        Value::Table(table) => {
            // constants of fatigue and of conduction move no contact, and phases are angles
            let is_other = |name: &str| ["fatigue", "phase"].contains(&name);
            for (name, inner) in table.iter().filter(|(name, _)| !is_other(name)) {
                look(inner, &format!("{key}.{name}"), found);
            }
        }
        Value::Array(items) => {
            // A component that is nothing reaches as far as the largest beside it.
            let size =
                |item: &Value| item.as_float().or_else(|| item.as_integer().map(|number| number as f64));
            let largest = items.iter().filter_map(size).fold(0.0, |most: f64, value| most.max(value.abs()));
            for (place, item) in items.iter().enumerate() {
                let key_of_item = format!("{key}.{place}");
                if size(item) == Some(0.0) {
                    found.extend(slider(&key_of_item, largest).map(|slider| Slider {
                        value: 0.0,
                        low: -slider.high,
                        logarithmic: false,
                        ..slider
                    }));
                    continue;
                }
                let name = item.get("name").and_then(Value::as_str);
                // a stage goes by its name, where it has one of its own
                let is_one = |name: &&str| {
                    let has = |item: &&Value| item.get("name").and_then(Value::as_str) == Some(name);
                    !name.contains('.') && items.iter().filter(has).count() == 1
                };
                let word = name.filter(is_one).map_or_else(|| place.to_string(), str::to_owned);
                look(item, &format!("{key}.{word}"), found);
            }
        }
        Value::Integer(number) => found.extend(slider(key, *number as f64)),
        Value::Float(number) => found.extend(slider(key, *number)),
        _ => {}
    }
}

fn slider(key: &str, value: f64) -> Option<Slider> {
    let word = *words_of(key).last()?;
    let known = ROWS.into_iter().find(|(name, _)| *name == word).map(|(_, reach)| reach);
    let reach = known.or_else(|| {
        ways().find(|(_, way)| way.name == word).map(|(row, way)| match (row.freedom, way.kind) {
            (NORMAL, _) => Reach::Factor(3.0),
            (_, Kind::Force) => Reach::Times(2.5),
            _ => Reach::Times(3.0),
        })
    })?;
    let [low, high] = match reach {
        _ if !value.is_finite() => return None,
        Reach::Factor(factor) if value > 0.0 => [value / factor, value * factor],
        Reach::Times(times) if value != 0.0 => [f64::min(0.0, times * value), f64::max(0.0, times * value)],
        Reach::Between(low, high) => [f64::min(low, value), f64::max(high, value)],
        // nothing to start from, and no way to know how much would be much
        Reach::Factor(_) | Reach::Times(_) => return None,
    };
    let logarithmic = matches!(reach, Reach::Factor(_));
    Some(Slider { key: key.to_owned(), kind: kind_of(key), value, low, high, logarithmic })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moduli_thickness_friction_and_loads_of_a_case_can_be_dragged() {
        let case = "[lower]\ncoatings = [{ thickness = 2e-6, young = 400e9, poisson = 0.2 }]\n\
                    substrate = { young = 210e9, poisson = 0.3 }\n[friction]\ncoefficient = 0.2\n\
                    [profile.sphere]\nradius = 10e-3\n\
                    [[load]]\nname = 'press'\nnormal_force = 12\nincrements = 12\n\
                    [[load]]\ntangential_force = [-1.0, 0.0]\ncycles = 1\n";
        let (found, more) = sliders(&case.parse().unwrap());
        assert_eq!(more, 0);
        let keys: Vec<&str> = found.iter().map(|slider| slider.key.as_str()).collect();
        assert_eq!(
            keys,
            [
                "load.press.normal_force",
                "load.1.tangential_force.0",
                "load.1.tangential_force.1",
                "friction.coefficient",
                "lower.coatings.0.thickness",
                "lower.coatings.0.young",
                "lower.substrate.young",
                "profile.sphere.radius",
                "lower.coatings.0.poisson",
                "lower.substrate.poisson",
            ]
        );
        // what pushes along x can push along y as far
        let across = &found[2];
        assert_eq!([across.low, across.value, across.high], [-2.5, 0.0, 2.5]);
        for slider in found {
            assert!(
                (slider.low..=slider.high).contains(&slider.value) && slider.low < slider.high,
                "{slider:?}"
            );
            assert!(!slider.logarithmic || slider.low > 0.0, "{slider:?}");
        }
    }
}
