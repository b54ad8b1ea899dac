//! Kinds of the quantities that `fret stress` tells, by their names in its files.

/// The kind of a measure of stress or of a fatigue parameter, for its unit; `-` for a ratio.
pub fn kind_of_stress(name: &str) -> &'static str {
    match name {
        "fatemi_socie" | "crossland" | "dang_van" => "-",
        "ruiz_f1" => "pressure x length",
        "ruiz_f2" => "pressure^2 x length",
        _ => "pressure",
    }
}
