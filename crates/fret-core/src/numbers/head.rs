//! What the lines above the numbers of a text say of them: unit, width and height, as Gwyddion and its kin write it, and names of columns.

use super::cells::{cells, delimiter};
use super::comments::is_comment;

/// Lines that are looked at.
const LINES: usize = 60;
/// Words for the unit of the values, in small letters: English, German, French.
const UNIT: [&str; 5] =
    ["value units", "units of values", "werteeinheiten", "einheiten der werte", "unités des valeurs"];
/// Words for the length of a row.
const WIDTH: [&str; 3] = ["width", "breite", "largeur"];
/// Words for the length of a column.
const HEIGHT: [&str; 3] = ["height", "höhe", "hauteur"];

/// What the head of a text says.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Head {
    /// Unit of the values.
    pub unit: Option<String>,
    /// Length of a row, number and unit.
    pub width: Option<(f64, String)>,
    /// Length of a column, number and unit.
    pub height: Option<(f64, String)>,
    /// Cells of the last line of words.
    pub names: Vec<String>,
}

/// The head of a text: lines `# Width: 10.0 µm`, `# Height: 8 µm`, `# Value units: m` above its numbers, with or without their mark; and a
/// line `x [mm]; z [um]`.
pub fn head(text: &str) -> Head {
    let mut head = Head::default();
    for line in text.lines().take(LINES) {
        let line = line.trim().trim_start_matches(['#', '%', '!', ';', '/']).trim();
        let Some((name, value)) = line.split_once(':') else {
            if line.starts_with(|letter: char| letter.is_alphabetic() || "\"[(".contains(letter)) {
                head.names = cells(line, delimiter(line));
            } else if !line.is_empty() && !is_comment(line) {
                break;
            }
            continue;
        };
        let (name, value) = (name.trim().to_lowercase(), value.trim());
        if UNIT.contains(&name.as_str()) && !value.is_empty() {
            head.unit = Some(value.to_owned());
        } else if WIDTH.contains(&name.as_str()) {
            head.width = length(value);
        } else if HEIGHT.contains(&name.as_str()) {
            head.height = length(value);
        }
    }
    head
}

/// A number and its unit; the decimal point may be a comma.
fn length(value: &str) -> Option<(f64, String)> {
    let (number, unit) = value.split_once(char::is_whitespace)?;
    let number =
        number.replace(',', ".").parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0)?;
    Some((number, unit.trim().to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_of_gwyddion_say_unit_width_and_height() {
        let size = |number: f64, unit: &str| Some((number, unit.to_owned()));
        let english = "# Channel: Z\n# Width: 12.5 µm\n# Height: 8 µm\n# Value units: m\n1e-6 2e-6\n";
        let german = "# Kanal: Z\n# Breite: 12,5 µm\n# Höhe: 8 µm\n# Value units: m\n1 2\n";
        for text in [english, german, &german.replace("# ", "")] {
            let found = head(text);
            assert_eq!(found.unit.as_deref(), Some("m"), "{text}");
            assert_eq!([found.width, found.height], [size(12.5, "µm"), size(8.0, "µm")], "{text}");
        }
        for text in ["1 2\n# Width: 3 um\n", "# Width: large\n1 2\n", "", "# Width: -3 um\n1"] {
            assert_eq!(head(text), Head::default(), "{text:?}");
        }
    }

    #[test]
    fn a_line_of_words_names_columns() {
        for (text, names) in [
            ("x y z\n0 0 1\n", ["x", "y", "z"]),
            ("# probe 3\n# X [mm]; Y [mm]; Z (um)\n0;0;1\n", ["X [mm]", "Y [mm]", "Z (um)"]),
            ("\"x_mm\",\"y_mm\",\"z_um\"\n0,0,1\n", ["x_mm", "y_mm", "z_um"]),
            ("x\ty\tz\n[mm]\t[mm]\t[um]\n0\t0\t1\n", ["[mm]", "[mm]", "[um]"]),
        ] {
            assert_eq!(head(text).names, names, "{text}");
        }
    }
}
