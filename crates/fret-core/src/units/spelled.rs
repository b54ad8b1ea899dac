//! Units of SI whose names are written out, as in "millimetre": their symbols, which alone are known as units.

/// Prefixes by their names.
const PREFIXES: [(&str, &str); 10] = [
    ("", ""),
    ("tera", "T"),
    ("giga", "G"),
    ("mega", "M"),
    ("kilo", "k"),
    ("deci", "d"),
    ("centi", "c"),
    ("milli", "m"),
    ("micro", "u"),
    ("nano", "n"),
];
/// Names, and symbols.
const NAMES: [(&str, &str); 4] = [("metre", "m"), ("meter", "m"), ("newton", "N"), ("pascal", "Pa")];

/// The symbol of a unit of SI that is called by its name, in any case of letters, one or many of them.
pub fn symbol_of(name: &str) -> Option<String> {
    let small = name.to_lowercase();
    let one = small.strip_suffix('s').unwrap_or(&small);
    if one == "micron" {
        return Some("um".to_owned());
    }
    NAMES.iter().find_map(|(written, symbol)| {
        let prefix = one.strip_suffix(written)?;
        let (_, known) = PREFIXES.iter().find(|(known, _)| *known == prefix)?;
        Some(format!("{known}{symbol}"))
    })
}

#[cfg(test)]
mod tests {
    use super::symbol_of;

    #[test]
    fn names_have_their_symbols_and_symbols_are_no_names() {
        for (name, symbol) in [
            ("millimeter", "mm"),
            ("Millimetres", "mm"),
            ("micrometer", "um"),
            ("microns", "um"),
            ("metre", "m"),
            ("newton", "N"),
            ("kiloNewtons", "kN"),
            ("megapascal", "MPa"),
        ] {
            assert_eq!(symbol_of(name).as_deref(), Some(symbol), "{name}");
        }
        for symbol in ["mm", "um", "N", "in", "diameter", "parameter", "furlong", "s", ""] {
            assert_eq!(symbol_of(symbol), None, "{symbol}");
        }
    }
}
