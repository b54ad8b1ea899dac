//! Axes: round ticks, and the power of ten that stands beside an axis' name so that its numbers stay short.

/// What an axis shows, and in which unit where the case declares units.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// The quantity.
    pub name: String,
    /// Its unit.
    pub unit: Option<String>,
}

impl Label {
    /// A name without unit.
    pub fn plain(name: &str) -> Self {
        Self::with(name, None)
    }

    /// A name with its unit, where it has one.
    pub fn with(name: &str, unit: Option<String>) -> Self {
        Self { name: name.to_owned(), unit }
    }
}

/// One axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Least and largest value shown.
    pub range: [f64; 2],
    /// Where ticks stand, with their words.
    pub ticks: Vec<(f64, String)>,
    /// The power of ten that the words leave out.
    pub exponent: i32,
    /// Whether equal lengths are equal factors.
    pub logarithmic: bool,
}

/// Exponents of the numbers that need no power of ten beside the axis.
const PLAIN: std::ops::RangeInclusive<i32> = -1..=3;

impl Axis {
    /// Least and largest finite value; the other way round, and infinite, when there is none.
    pub fn ends(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
        let finite = values.into_iter().filter(|value| value.is_finite());
        finite
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    }

    /// A power of ten, its exponent in raised digits.
    pub fn power_of_ten(exponent: i32) -> String {
        format!("10{}", superscript(exponent))
    }

    /// An axis over values, a little wider than they are, with about so many ticks.
    pub fn linear(values: impl Iterator<Item = f64>, ticks: usize) -> Self {
        let [mut low, mut high] = extent(values);
        if low == high {
            let around = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
            (low, high) = (low - around, high + around);
        }
        let step = round_step((high - low) / ticks.max(1) as f64);
        let margin = 0.02 * (high - low);
        // A curve that starts or ends at zero shall touch the frame there.
        Self::with_step(
            [if low == 0.0 { 0.0 } else { low - margin }, if high == 0.0 { 0.0 } else { high + margin }],
            step,
        )
    }

    /// An axis over a range and no more, with about so many ticks.
    pub fn over([low, high]: [f64; 2], ticks: usize) -> Self {
        if low < high {
            Self::with_step([low, high], round_step((high - low) / ticks.max(1) as f64))
        } else {
            Self::linear([low, high].into_iter(), ticks)
        }
    }

    fn with_step(range: [f64; 2], step: f64) -> Self {
        let largest = range[0].abs().max(range[1].abs());
        let magnitude = largest.log10().floor() as i32;
        let exponent = if PLAIN.contains(&magnitude) { 0 } else { magnitude.div_euclid(3) * 3 };
        let unit = 10_f64.powi(exponent);
        let decimals = (-((step / unit).log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
        let first = (range[0] / step).ceil() as i64;
        let last = (range[1] / step).floor() as i64;
        let ticks = (first..=last)
            .map(|k| (k as f64 * step, format!("{:.decimals$}", k as f64 * step / unit).replace('-', "−")))
            .collect();
        Self { range, ticks, exponent, logarithmic: false }
    }

    /// An axis over the positive ones of some values, from a power of ten to a power of ten.
    pub fn logarithmic(values: impl Iterator<Item = f64>, most_ticks: i32) -> Self {
        let [low, high] = extent(values.filter(|value| *value > 0.0).map(f64::log10));
        let [low, high] = [low.floor() as i32, (high.ceil() as i32).max(low.floor() as i32 + 1)];
        let every = ((high - low) / most_ticks.max(1) + 1).max(1);
        let ticks = (low..=high)
            .filter(|power| power.rem_euclid(every) == 0)
            .map(|power| (10_f64.powi(power), Self::power_of_ten(power)))
            .collect();
        Self { range: [10_f64.powi(low), 10_f64.powi(high)], ticks, exponent: 0, logarithmic: true }
    }

    /// Place of a value, 0 at the least and 1 at the largest one shown.
    pub fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        if self.logarithmic {
            (value.log10() - low.log10()) / (high.log10() - low.log10())
        } else {
            (value - low) / (high - low)
        }
    }

    /// The name of the axis with the power of ten its ticks leave out.
    pub fn named(&self, label: &Label) -> String {
        let power = Self::power_of_ten(self.exponent);
        match (&label.unit, self.exponent) {
            (None, 0) => label.name.clone(),
            (None, _) => format!("{} / {power}", label.name),
            (Some(unit), 0) => format!("{} [{unit}]", label.name),
            (Some(unit), _) => format!("{} [{power} {unit}]", label.name),
        }
    }
}

/// The ends of values; 0 and 1 when there is none.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = Axis::ends(values);
    if low <= high { [low, high] } else { [0.0, 1.0] }
}

/// The nearest of 1, 2, 5 and 10 times a power of ten.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let digit = step / power;
    let round = [(1.5, 1.0), (3.5, 2.0), (7.5, 5.0)].into_iter().find(|(end, _)| digit < *end);
    power * round.map_or(10.0, |(_, round)| round)
}

/// A whole number in raised digits.
fn superscript(number: i32) -> String {
    let raised = |letter| match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32(0x2070 + u32::from(digit) - u32::from('0')).unwrap_or(digit),
    };
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, word)| word.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_short_whatever_the_size_of_the_values() {
        let axis = Axis::linear([-2.1e-7, 2.1e-7].into_iter(), 4);
        assert_eq!((words(&axis), axis.exponent), (vec!["−200", "−100", "0", "100", "200"], -9));
        let axis = Axis::linear([0.0, 2.74e9].into_iter(), 5);
        assert_eq!((words(&axis), axis.exponent), (vec!["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"], 9));
        assert_eq!(axis.named(&Label::plain("pressure")), "pressure / 10⁹");
        let in_pascals = Label { unit: Some("Pa".to_owned()), ..Label::plain("pressure") };
        assert_eq!(axis.named(&in_pascals), "pressure [10⁹ Pa]");
        let axis = Axis::linear([0.0, 0.31].into_iter(), 3);
        assert_eq!(words(&axis), ["0.0", "0.1", "0.2", "0.3"]);
    }

    #[test]
    fn values_that_do_not_change_have_an_axis_too() {
        for value in [0.0, 12.0, -1e-30, 1e300] {
            let axis = Axis::linear(std::iter::repeat_n(value, 3), 4);
            assert!(axis.range[0] < value && value < axis.range[1], "{value}");
            assert!((2..12).contains(&axis.ticks.len()), "{value}: {:?}", axis.ticks);
        }
        assert!(!Axis::linear(std::iter::once(f64::NAN), 4).ticks.is_empty());
    }

    #[test]
    fn a_logarithmic_axis_runs_from_power_to_power() {
        let axis = Axis::logarithmic([3e-12, 0.0, 2e-9].into_iter(), 6);
        assert_eq!(words(&axis), ["10⁻¹²", "10⁻¹¹", "10⁻¹⁰", "10⁻⁹", "10⁻⁸"]);
        assert!((axis.place(1e-10) - 0.5).abs() < 1e-12);
    }
}
