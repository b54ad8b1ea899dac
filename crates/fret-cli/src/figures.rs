//! How numbers, counts and names are shown to a person. Files and JSON carry numbers in full and do not pass here.

use fret_core::model::Dimension;
use fret_core::units::Units;

/// A number to five significant figures, in plain digits where that is short.
pub fn figure(value: f64) -> String {
    let rounded = format!("{value:.4e}");
    let exponent = rounded.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        _ if value == 0.0 => "0".to_owned(),
        Some(exponent @ -2..=4) => format!("{value:.*}", (4 - exponent) as usize),
        _ => rounded,
    }
}

/// A number as it was typed: as few digits as say it.
pub fn typed(value: f64) -> String {
    // what was typed in degrees or read from a file has digits of rounding
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    let is_plain = (1e-3..1e5).contains(&value.abs()) || value == 0.0;
    if is_plain { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// The word for a number beyond all bounds.
pub const UNLIMITED: &str = "unlimited";

/// The same of a number that may be beyond all bounds, or none.
pub fn bounded(value: f64) -> String {
    match value {
        f64::INFINITY => UNLIMITED.to_owned(),
        value if value.is_nan() => "-".to_owned(),
        value => figure(value),
    }
}

/// A number with its unit, where the case declares units; `kind` as in `force x length`.
pub fn figure_in(units: Option<&Units>, value: f64, kind: &str) -> String {
    figure(value) + &Units::after(units, kind, Dimension::Plane)
}

/// A number that only matters beside another: what vanishes in the rounding of `scale` is shown as zero.
pub fn figure_beside(value: f64, scale: f64) -> String {
    if value.abs() <= 1e-12 * scale.abs() { "0".to_owned() } else { figure(value) }
}

/// The largest magnitude.
pub fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.1} %", 100.0 * share) } else { "–".to_owned() }
}

/// A count with its noun.
pub fn counted(count: usize, noun: &str) -> String {
    let end = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{end}")
}

/// A sentence that begins with a capital letter.
pub fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// A block of lines, moved to the right.
pub fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}\n")).collect()
}

/// A span of time.
pub fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        _ if seconds < 9.95 => format!("{seconds:.1} s"),
        0..60 => format!("{whole} s"),
        60..3600 => format!("{} min {:02} s", whole / 60, whole % 60),
        _ => format!("{} h {:02} min", whole / 3600, whole % 3600 / 60),
    }
}

/// Width of the names on the left of numbers that stand side by side.
pub const NAMES: usize = 30;

/// Adds a row of numbers side by side, in columns of so many letters; the first gives way to a long name.
pub fn side_by_side(table: &mut String, name: &str, column: usize, values: impl Iterator<Item = String>) {
    *table += &format!("{name:<NAMES$}");
    let over = name.chars().count().saturating_sub(NAMES);
    for (place, value) in values.enumerate() {
        let width = if place == 0 { column.saturating_sub(over) } else { column };
        *table += &format!("{value:>width$}");
    }
    table.push('\n');
}

/// Letters of a title where it stands alone, at the most.
pub const LONGEST_TITLE: usize = 200;

/// A name, cut where it is longer than so many letters.
pub fn shortened(name: &str, letters: usize) -> String {
    if name.chars().count() <= letters {
        name.to_owned()
    } else {
        name.chars().take(letters - 1).chain(['…']).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_five_digits_whatever_their_size() {
        for (value, shown) in [
            (0.0, "0"),
            (12.0, "12.000"),
            (-0.9, "-0.90000"),
            (0.999_999_99, "1.0000"),
            (99999.4, "99999"),
            (123_456.0, "1.2346e5"),
            (0.012_345_67, "0.012346"),
            (1.5e-6, "1.5000e-6"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(figure(value), shown);
        }
    }

    #[test]
    fn rounding_noise_is_shown_as_zero_beside_what_it_is_noise_of() {
        assert_eq!(figure_beside(-1.1e-17, 1.0), "0");
        assert_eq!(figure_beside(-1.1e-17, 1e-16), "-1.1000e-17");
        assert_eq!(figure_beside(f64::NAN, 1.0), "NaN");
    }

    #[test]
    fn durations_are_told_in_the_unit_a_person_would_use() {
        for (seconds, shown) in
            [(0.04, "0.0 s"), (9.94, "9.9 s"), (59.2, "59 s"), (75.0, "1 min 15 s"), (7322.0, "2 h 02 min")]
        {
            assert_eq!(duration(seconds), shown);
        }
    }
}
