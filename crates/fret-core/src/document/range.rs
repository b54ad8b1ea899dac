//! What a number may be.

/// What a number may be: bounds, the words for them, and a way out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    least: f64,
    most: f64,
    /// What the number must be, in words.
    pub words: &'static str,
    /// A way out; may be empty.
    pub help: &'static str,
}

impl Range {
    /// Above 0.
    pub const POSITIVE: Self = Self::between(f64::from_bits(1), f64::MAX, "must be positive and finite");
    /// Below 0.
    pub const NEGATIVE: Self = Self::between(f64::MIN, -f64::from_bits(1), "must be negative and finite");
    /// 0 or above.
    pub const NOT_NEGATIVE: Self = Self::between(0.0, f64::MAX, "must be zero or positive, and finite");
    /// A number to count with, from 1 on.
    pub const COUNT: Self = Self::between(1.0, f64::MAX, "must be at least 1");

    /// From `least` to `most`, both allowed.
    pub const fn between(least: f64, most: f64, words: &'static str) -> Self {
        Self { least, most, words, help: "" }
    }

    /// Above 0, up to `most`.
    pub const fn up_to(most: f64, words: &'static str) -> Self {
        Self::between(f64::from_bits(1), most, words)
    }

    /// The same in other words.
    #[must_use]
    pub const fn words(self, words: &'static str) -> Self {
        Self { words, ..self }
    }

    /// The same with a way out.
    #[must_use]
    pub const fn help(self, help: &'static str) -> Self {
        Self { help, ..self }
    }

    /// Whether a number lies in it.
    pub fn holds(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }
}
