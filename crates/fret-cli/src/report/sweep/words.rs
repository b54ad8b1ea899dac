//! Keys and columns of a sweep in words.

use crate::stress::stress_called;
use crate::sweep::key::words_of;

/// Words of keys that are called otherwise.
const SPOKEN: [(&str, &str); 3] =
    [("young", "Young's modulus"), ("poisson", "Poisson's ratio"), ("max_shear", "shear strength")];

/// A key in words: `load.rub.tangential_force.0` is `tangential force, rub`.
pub fn called(key: &str) -> String {
    let words = words_of(key);
    let Some((end, before)) = words.split_last() else { return key.to_owned() };
    let spoken = SPOKEN.iter().find(|(word, _)| word == end).map_or(*end, |(_, words)| words);
    let axis = if key.ends_with(".1") { " y" } else { "" };
    let spoken = spoken.replace('_', " ") + axis;
    let number = |list: &str| {
        let rest = key.split_once(list)?.1.trim_start_matches('.');
        rest.split('.').next()?.parse::<usize>().ok()
    };
    let place = |words: &[&str]| -> String {
        let one = |word: &&str| match number(word) {
            Some(place) if *word == "coatings" => format!("coating {}", place + 1),
            _ => word.replace('_', " "),
        };
        words.iter().map(one).collect::<Vec<_>>().join(" ")
    };
    match before {
        ["profile", shape] => format!("{spoken} of the {}", shape.replace('_', " ")),
        ["friction" | "wear"] if before[0] != *end => format!("{} {spoken}", before[0]),
        ["load"] => match number("load") {
            Some(stage) => format!("{spoken}, stage {}", stage + 1),
            None => spoken,
        },
        [] | ["grid"] => spoken,
        ["load", rest @ ..] => format!("{spoken}, {}", place(rest)),
        before => format!("{spoken}, {}", place(before)),
    }
}

/// What is said of a number of a cycle.
pub const OF_CYCLE: &str = " of the last cycle";

/// Names that begin with that of a fatigue parameter, which is called after a person.
const CALLED: [&str; 5] = ["smith_watson_topper", "fatemi_socie", "crossland", "dang_van", "von_mises"];

/// A column in words: `cycle_dissipated_energy` is `dissipated energy of the last cycle`.
pub fn spoken(name: &str) -> String {
    for known in CALLED {
        if let Some((before, after)) = name.split_once(known) {
            return [before, &stress_called(known), after].concat().replace('_', " ");
        }
    }
    match name.strip_prefix("cycle_") {
        Some("energy_ratio") => "energy ratio A".to_owned(),
        Some("sliding_ratio") => "sliding ratio D".to_owned(),
        Some(rest) => rest.replace('_', " ") + OF_CYCLE,
        None => name.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::{called, spoken};

    #[test]
    fn keys_and_columns_are_told_in_words() {
        for (key, words) in [
            ("friction.coefficient", "friction coefficient"),
            ("load.rub.tangential_force.0", "tangential force, rub"),
            ("load.0.normal_force", "normal force, stage 1"),
            ("load.1.normal_force", "normal force, stage 2"),
            ("lower.coatings.1.young", "Young's modulus, lower coating 2"),
            ("load.rub.shift.1", "shift y, rub"),
            ("profile.sphere.radius", "radius of the sphere"),
            ("grid.cells", "cells"),
        ] {
            assert_eq!(called(key), words);
        }
        assert_eq!(spoken("cycle_dissipated_energy"), "dissipated energy of the last cycle");
        assert_eq!(spoken("smith_watson_topper_cycles"), "Smith-Watson-Topper cycles");
    }
}
