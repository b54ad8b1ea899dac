//! The quantities that `fret stress` tells, by their names in its files: their units, and how they are called.

/// The kind of a measure of stress or of a fatigue parameter, for its unit; `-` for a ratio.
pub fn kind_of_stress(name: &str) -> &'static str {
    match name {
        "fatemi_socie" | "crossland" | "dang_van" => "-",
        "ruiz_f1" => "pressure x length",
        "ruiz_f2" => "pressure^2 x length",
        _ => "pressure",
    }
}

/// What a person calls a measure of stress or a fatigue parameter.
pub fn stress_called(name: &str) -> String {
    match name {
        "von_mises" => "von Mises".to_owned(),
        "tresca" => "Tresca".to_owned(),
        "smith_watson_topper" => "Smith-Watson-Topper".to_owned(),
        "fatemi_socie" => "Fatemi-Socie".to_owned(),
        "crossland" => "Crossland".to_owned(),
        "dang_van" => "Dang Van".to_owned(),
        "ruiz_f1" => "Ruiz F1".to_owned(),
        "ruiz_f2" => "Ruiz F2".to_owned(),
        other => other.replace('_', " "),
    }
}
