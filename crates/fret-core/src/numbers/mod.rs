//! An array of numbers from the bytes of a file: `NumPy`'s .npy (`npy`), or a text with a row a line (`rows`). Below them: the
//! letters of old and new encodings (`letters`), what commas are (`commas`), what is no row (`comments`), the cells of a line of words (`cells`),
//! what the lines above the numbers say (`head`), one number from one word (`word`). Reading the file is somebody else's.

mod cells;
mod commas;
mod comments;
mod error;
mod head;
mod letters;
mod npy;
mod rows;
mod word;

use ndarray::Array2;

pub use cells::{DELIMITERS, cells, delimiter};
pub use comments::{Skipped, is_comment};
pub use error::NumbersError;
pub use head::Head;
pub use letters::{NoText, letters};
pub use word::{NoNumber, number};

/// Array `[row, column]` of the bytes of a .npy file or of a text. Numbers of a text stand between blanks, semicolons or commas; what
/// commas are between semicolons or tabs, decimal commas, is found out. What follows a `#` is a comment, and a line that begins
/// with `#`, `%`, `!`, `;` or `//`. Numbers of one dimension become a column.
///
/// # Errors
/// When the bytes are neither, are cut off, or hold anything but finite numbers in rows of one length (in a .npy file, real numbers).
pub fn numbers(bytes: &[u8]) -> Result<Array2<f64>, NumbersError> {
    read(bytes, false)
}

/// The same with NaN where a word or an empty cell stands for a value that was not measured.
///
/// # Errors
/// As [`numbers`].
pub fn numbers_with_holes(bytes: &[u8]) -> Result<Array2<f64>, NumbersError> {
    read(bytes, true)
}

/// What the lines above the numbers of a text say; of anything else nothing.
pub fn head(bytes: &[u8]) -> Head {
    if bytes.starts_with(npy::MAGIC) {
        return Head::default();
    }
    letters(bytes).map_or_else(|_| Head::default(), |text| head::head(&text))
}

fn read(bytes: &[u8], takes_holes: bool) -> Result<Array2<f64>, NumbersError> {
    if bytes.starts_with(npy::MAGIC) {
        npy::npy(bytes)
    } else {
        rows::rows(&letters(bytes).map_err(NumbersError::Bytes)?, takes_holes)
    }
}

#[cfg(test)]
mod tests {
    use ndarray::array;

    use super::*;

    fn words(text: &str) -> String {
        numbers(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn a_text_has_a_row_a_line() {
        let right = array![[1.0, 2.5, 3.0], [4.0, 5.0, 0.6]];
        for text in [
            "# um\n1 2.5\t3\n\n4;5 6e-1 # last\n",
            "% um\r\n! rig 3\r\n// x\r\n; y\r\n1, 2.5, 3\r\n4,5,6e-1\r\n",
            "1,2.5,3,\r4,5,0.6,\r",
            "1;2,5;3\n4;5;0,6\n",
            "1\t2,5\t3\n4\t5\t,6\n",
            "; Breite; 10 um\n1;2,5;3\n4;5;6e-1",
            "1\u{a0}2.5 3\n4 5 6E-1\u{c}\n",
        ] {
            assert_eq!(numbers(text.as_bytes()).unwrap(), right, "{text:?}");
        }
    }

    #[test]
    fn what_is_no_row_of_numbers_is_told_by_its_place() {
        for (text, message) in [
            ("1 2\n3\n", "line 2: a row of 1 numbers after rows of 2"),
            ("1 2\n3 four\n", "line 2, column 2: \"four\" is not a number"),
            ("# nothing\n", "a text without a number (line 1 was read as a comment)"),
            ("1 h=650\n1 2\n", "line 1, column 2: \"h=650\" is not a number"),
            ("h=650 w=650\n", "line 1, column 1: \"h=650\" is not a number"),
            ("1 2\nh=650\n3 4\n", "line 2, column 1: \"h=650\" is not a number"),
            (
                "% a\n# b\n1 x\n",
                "line 3, column 2: \"x\" is not a number (lines 1 to 2 were read as comments)",
            ),
            ("# a\n1 2\n# b\n1 x\n", "\"x\" is not a number (2 lines from 1 to 3 were read as comments)"),
            ("1 2\n3 1.#QNAN\n", "line 2, column 2: \"1.#QNAN\" stands for a value that was not measured"),
            ("1 2\n3 0.0123#\n", "line 2, column 2: \"0.0123#\" is not a number"),
            ("1 2\n3 7#bad\n", "line 2, column 2: \"7#bad\" is not a number"),
            ("1 2\n3 1.#INF\n", "line 2, column 2: \"1.#INF\" is no finite number"),
            ("1 2\n3 #N/A\n", "line 2, column 2: \"#N/A\" stands for"),
            ("#N/A 2\n3 4\n", "line 1, column 1: \"#N/A\" stands for"),
            ("1,,3\n4,5,6\n", "line 1, column 2: \"\" stands for"),
            ("1\t2\t3\n4\t\t6\n", "line 2, column 2: \"\" stands for"),
            ("1,2,3\n4,5,\n", "line 2, column 3: \"\" stands for"),
            (";2\n3;4\n", "line 1, column 1: \"\" stands for"),
            ("0,5 0,25\n", "line 1: a decimal comma, or a comma that parts two numbers?"),
        ] {
            assert!(words(text).contains(message), "{text:?}: {}", words(text));
        }
        assert!(words(&format!("1 {}", "y".repeat(1000))).len() < 100);
    }

    /// A million numbers are read in portions of the text, not by going over it again for each: time grows with their number alone.
    #[test]
    fn a_million_numbers_are_read() {
        let row = "-1.234567e-8;".repeat(1000);
        let text = format!("{row}\n").repeat(1000);
        let array = numbers(text.as_bytes()).unwrap();
        assert_eq!(array.dim(), (1000, 1000));
        assert!(array.iter().all(|&value| value == -1.234_567e-8));
    }
}
