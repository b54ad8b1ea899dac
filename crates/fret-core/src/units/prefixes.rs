//! Prefixes of units of SI.

/// Prefixes and their powers of ten.
const PREFIXES: [(&str, i32); 14] = [
    ("", 0),
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("da", 1),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("µ", -6),
    ("μ", -6),
    ("n", -9),
];

/// The power of ten of a prefix; 0 of none.
pub(super) fn power(prefix: &str) -> Option<i32> {
    PREFIXES.iter().find(|(known, _)| *known == prefix).map(|(_, power)| *power)
}

/// The prefix that stands for a power of ten that is one of a thousand.
pub(super) fn prefix(power: i32) -> Option<&'static str> {
    let known = PREFIXES.iter().find(|(_, known)| *known == power)?;
    (power % 3 == 0).then_some(known.0)
}
