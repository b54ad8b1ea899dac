//! Cases to begin with: what `fret init` writes.

/// A case to begin with.
#[derive(Debug)]
pub struct Template {
    /// Its name, and that of the file without its ending.
    pub name: &'static str,
    /// What it is for, in a line.
    pub about: &'static str,
    /// The case.
    pub case: &'static str,
    /// Files that the case names, with their contents.
    pub beside: &'static [(&'static str, &'static str)],
}

/// A template whose case is the file of its name.
macro_rules! template {
    ($name:literal, $about:literal, [$($beside:literal),*]) => {
        Template {
            name: $name,
            about: $about,
            case: include_str!(concat!($name, ".toml")),
            beside: &[$(($beside, include_str!($beside))),*],
        }
    };
}

/// All of them, in the order of a first acquaintance.
pub const TEMPLATES: [Template; 8] = [
    template!("ball-on-flat", "steel ball on steel, one fretting loop in partial slip", []),
    template!("coated", "ball on a hard coating, one loop, stresses below", []),
    template!("cylinder", "fretting-fatigue test: cylinder on a flat with bulk stress, lives", []),
    template!("rig-log", "ball on flat behind a compliant rig, for `fret identify`", []),
    template!("wear", "wear of 2,000 cycles in gross slip", []),
    template!("rolling", "a ball that rolls on a coating and pulls: its creepage", []),
    template!("rough", "a measured surface, filtered and resampled", ["rough-heights.txt"]),
    template!("indentation", "load and depth of a sphere on a film", []),
];
