//! Why bytes are no array of numbers, and what to do about it.

use super::comments::Skipped;
use super::letters::NoText;
use super::word::NoNumber;

/// Why bytes are no array of numbers.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NumbersError {
    /// A .npy file that ends before its header does.
    #[error("a .npy file cut off in its header, after {0} bytes")]
    CutHeader(usize),
    /// A header that is not one.
    #[error("a .npy file whose header cannot be understood: {0}")]
    Header(String),
    /// Numbers of a kind that is not read.
    #[error("a .npy file with numbers of type {0:?}: real numbers are read, f4 f8 i1 i2 i4 i8 u1 u2 u4 u8")]
    Kind(String),
    /// Neither one dimension nor two.
    #[error("a .npy file of shape {0:?}: one or two dimensions are wanted")]
    Dimensions(Vec<usize>),
    /// More or fewer bytes than the header says.
    #[error("a .npy file with {found} bytes of numbers: its header says {expected}")]
    Length {
        /// Bytes that follow the header.
        found: usize,
        /// Bytes that the header asks for.
        expected: usize,
    },
    /// Bytes that are no text.
    #[error("neither a .npy file nor a text: {0}")]
    Bytes(NoText),
    /// A text without a number.
    #[error("a text without a number{0}")]
    Empty(Skipped),
    /// A word that is no number.
    #[error("line {line}, column {column}: {word:?} {why}{skipped}")]
    Word {
        /// Line of the text, from 1.
        line: usize,
        /// Number of the line, from 1.
        column: usize,
        /// What stands there, or how it begins.
        word: String,
        /// What it is instead.
        why: NoNumber,
        /// Comments.
        skipped: Skipped,
    },
    /// Rows of different lengths.
    #[error("line {line}: a row of {found} numbers after rows of {expected}{skipped}")]
    Ragged {
        /// Line of the text, from 1.
        line: usize,
        /// Numbers in it.
        found: usize,
        /// Numbers in the rows before.
        expected: usize,
        /// Comments.
        skipped: Skipped,
    },
    /// More numbers than the largest grid has points.
    #[error("more than {most} numbers")]
    Many {
        /// How many are read.
        most: usize,
    },
    /// Commas that part numbers or are decimal commas.
    #[error("line {line}: a decimal comma, or a comma that parts two numbers? {why}")]
    DecimalComma {
        /// Line of the text, from 1.
        line: usize,
        /// What leaves it in doubt.
        why: &'static str,
    },
}

impl NumbersError {
    /// Whether the bytes may be those of a format that is not read here.
    pub fn may_be_another_format(&self) -> bool {
        matches!(
            self,
            Self::Bytes(_) | Self::Word { why: NoNumber::Other, .. } | Self::Ragged { .. } | Self::Empty(_)
        )
    }

    /// Whether a value was not measured.
    pub fn is_hole(&self) -> bool {
        matches!(self, Self::Word { why: NoNumber::Hole, .. })
    }

    /// What can be read.
    pub(crate) const A_FILE: &str =
        "a .npy file, or a text file with one row of numbers per line; relative paths start at the case file";

    /// What to do about it.
    pub fn way_out(&self) -> &'static str {
        match self {
            Self::Word { why: NoNumber::Hole, .. } => HOLES,
            Self::Word { why: NoNumber::Other, .. } => {
                "lines of words begin with #, %, !, ; or //; where the file is one of heights, those without a measurement are filled with fill = \"harmonic\" beside it"
            }
            Self::DecimalComma { .. } => {
                "write decimal points; or decimal commas, with semicolons or tabs between the numbers"
            }
            _ => Self::A_FILE,
        }
    }
}

/// What to do about cells without a measurement.
const HOLES: &str =
    "every cell needs a number; heights, and they alone, are filled with fill = \"harmonic\" beside the file";
