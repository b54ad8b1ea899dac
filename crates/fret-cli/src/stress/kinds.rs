//! The quantities that `fret stress` tells, by their names in its files: their units, and how they are called.

/// Name, kind of quantity for its unit (`-` for a ratio), and what a person calls it. Others are pressures, called by their names.
const QUANTITIES: [[&str; 3]; 8] = [
    ["von_mises", "pressure", "von Mises"],
    ["tresca", "pressure", "Tresca"],
    ["smith_watson_topper", "pressure", "Smith-Watson-Topper"],
    ["fatemi_socie", "-", "Fatemi-Socie"],
    ["crossland", "-", "Crossland"],
    ["dang_van", "-", "Dang Van"],
    ["ruiz_f1", "pressure x length", "Ruiz F1"],
    ["ruiz_f2", "pressure^2 x length", "Ruiz F2"],
];

fn known(name: &str) -> Option<&'static [&'static str; 3]> {
    QUANTITIES.iter().find(|[known, ..]| *known == name)
}

/// The kind of a measure of stress or of a fatigue parameter, for its unit; `-` for a ratio.
pub fn kind_of_stress(name: &str) -> &'static str {
    known(name).map_or("pressure", |[_, kind, _]| *kind)
}

/// What a person calls a measure of stress or a fatigue parameter.
pub fn stress_called(name: &str) -> String {
    known(name).map_or_else(|| name.replace('_', " "), |[.., called]| (*called).to_owned())
}
