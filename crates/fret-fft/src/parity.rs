//! How a kernel continues from its stored quadrant to offsets of either sign.

/// Parity of a kernel in `x`, then in `y`: under `x -> -x` an even kernel keeps its value, an odd one changes sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parity {
    /// Even in `x` and in `y`.
    EvenEven,
    /// Odd in `x`, even in `y`.
    OddEven,
    /// Even in `x`, odd in `y`.
    EvenOdd,
    /// Odd in `x` and in `y`.
    OddOdd,
}

impl Parity {
    /// Whether the kernel is odd along `[x, y]`.
    pub fn odd(self) -> [bool; 2] {
        match self {
            Self::EvenEven => [false, false],
            Self::OddEven => [true, false],
            Self::EvenOdd => [false, true],
            Self::OddOdd => [true, true],
        }
    }

    /// Whether the transform of a real kernel of this parity is purely imaginary (odd along exactly one axis).
    pub(super) fn is_imaginary(self) -> bool {
        matches!(self, Self::OddEven | Self::EvenOdd)
    }
}
