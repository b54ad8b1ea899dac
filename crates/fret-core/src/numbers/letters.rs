//! Letters from the bytes of a file, as the programs of some decades wrote them.

use std::borrow::Cow;

/// Letters of Windows 1252 at the bytes 0x80 to 0x9f; elsewhere it is Latin-1.
const WINDOWS: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8d}Ž\u{8f}\u{90}‘’“”•–—˜™š›œ\u{9d}žŸ";

/// Bytes that are no text in any of the encodings that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("byte {at} is no letter of a text")]
pub struct NoText {
    /// The first byte that is no letter, from 0.
    pub at: usize,
}

/// The text of a file, every line ended by a line feed alone: UTF-8, UTF-16 in either order of bytes, and where it is neither,
/// Windows 1252, which has Latin-1 in it. Letters of other old encodings come out wrong, and never as digits.
///
/// # Errors
/// Where control characters show that the bytes are no text, or UTF-16 is damaged.
pub fn letters(bytes: &[u8]) -> Result<Cow<'_, str>, NoText> {
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => Cow::Owned(wide(rest, u16::from_le_bytes, 2)?),
        [0xfe, 0xff, rest @ ..] => Cow::Owned(wide(rest, u16::from_be_bytes, 2)?),
        // without a mark at its start: no text of single bytes has a zero there
        [first, 0, ..] if *first != 0 => Cow::Owned(wide(bytes, u16::from_le_bytes, 0)?),
        [0, first, ..] if *first != 0 => Cow::Owned(wide(bytes, u16::from_be_bytes, 0)?),
        _ => match std::str::from_utf8(bytes) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => Cow::Owned(bytes.iter().map(|&byte| windows(byte)).collect()),
        },
    };
    let text = match text {
        Cow::Borrowed(text) => Cow::Borrowed(without_marks(text)),
        Cow::Owned(text) => Cow::Owned(without_marks(&text).to_owned()),
    };
    if let Some((at, _)) = text.char_indices().find(|&(_, letter)| is_no_letter(letter)) {
        return Err(NoText { at });
    }
    if text.contains('\r') {
        return Ok(Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")));
    }
    Ok(text)
}

/// Without the mark of Unicode at the start, and the end of file of DOS.
fn without_marks(text: &str) -> &str {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    text.strip_suffix('\u{1a}').unwrap_or(text)
}

fn is_no_letter(letter: char) -> bool {
    letter < ' ' && !matches!(letter, '\t' | '\n' | '\r' | '\u{b}' | '\u{c}') || letter == '\u{7f}'
}

/// Letters of two bytes or four; `before` bytes stand before them.
fn wide(bytes: &[u8], unit: fn([u8; 2]) -> u16, before: usize) -> Result<String, NoText> {
    let pairs = bytes.chunks_exact(2);
    if let [_] = pairs.remainder() {
        return Err(NoText { at: before + bytes.len() - 1 });
    }
    let mut text = String::with_capacity(bytes.len() / 2);
    let mut at = before;
    for letter in char::decode_utf16(pairs.map(|pair| unit([pair[0], pair[1]]))) {
        let letter = letter.map_err(|_| NoText { at })?;
        at += 2 * letter.len_utf16();
        text.push(letter);
    }
    Ok(text)
}

fn windows(byte: u8) -> char {
    match byte {
        0x80..0xa0 => WINDOWS.chars().nth(usize::from(byte) - 0x80).unwrap_or(char::REPLACEMENT_CHARACTER),
        _ => char::from(byte),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes of `µ` are those of the tables of Unicode and of Windows 1252.
    #[test]
    fn one_text_is_read_from_every_encoding() {
        let utf16 =
            |order: fn(u16) -> [u8; 2]| -> Vec<u8> { "1 µ\n2".encode_utf16().flat_map(order).collect() };
        let (little, big) = (utf16(u16::to_le_bytes), utf16(u16::to_be_bytes));
        for bytes in [
            b"1 \xc2\xb5\n2".to_vec(),
            b"\xef\xbb\xbf1 \xc2\xb5\n2".to_vec(),
            b"1 \xb5\n2".to_vec(),
            b"1 \xb5\r\n2\x1a".to_vec(),
            b"1 \xb5\r2".to_vec(),
            [&[0xff, 0xfe][..], &little].concat(),
            [&[0xfe, 0xff][..], &big].concat(),
            little,
            big,
        ] {
            assert_eq!(letters(&bytes).unwrap(), "1 µ\n2", "{bytes:x?}");
        }
        assert_eq!(letters(b"\x80 \x96 \x9f \xff").unwrap(), "€ – Ÿ ÿ");
        assert_eq!(WINDOWS.chars().count(), 32);
    }

    #[test]
    fn bytes_that_are_no_text_are_told_by_the_first_that_is_no_letter() {
        for (bytes, at) in [
            (&b"1 2\x003"[..], 3),
            (b"12\x07", 2),
            (b"12\x7f", 2),
            (b"12\x1a3", 2),
            (&[0xff, 0xfe, b'1'], 2),
            (&[0xff, 0xfe, b'1', 0, 0x00, 0xd8], 4), // half of a letter of four bytes
        ] {
            assert_eq!(letters(bytes), Err(NoText { at }), "{bytes:x?}");
        }
        assert_eq!(letters(b"").unwrap(), "");
    }
}
