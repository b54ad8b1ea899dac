//! What a file of heights holds: numbers, read by the program's own reader, or the scan of an instrument.

use ndarray::Array2;

use super::keys::TreatmentFile;
use super::scan::{ReadScan, Scan};
use crate::document::Mistake;
use crate::numbers::{Head, NumbersError, head, numbers, numbers_with_holes};

/// What to do about points without a measurement.
pub const FILL: &str = "fill = \"harmonic\" fills points without a measurement from those around them; or fill them in the program of the instrument";
/// What to do about a file that only a library can read.
const INSTRUMENTS: &str = "files of instruments (sur, x3p, plu, opd, al3d and some 40 more) are read in Python and by its command `fret`: \
                           pip install 'fretting[instruments]'; a .npy file or a text of numbers is read everywhere";

/// Endings of names that instruments give: such files are never taken for plain numbers, also where they are texts, as they state units.
const ENDINGS: [&str; 49] = [
    "al3d", "bcr", "bcrf", "datx", "di", "dzi", "ezd", "frt", "gwy", "h5", "hfm", "ibw", "jpk", "lext",
    "mat", "mdt", "mi", "mnt", "nc", "nid", "nmm", "nms", "oir", "opd", "opdx", "os3d", "plu", "plux",
    "poir", "pro", "qep", "sdf", "spm", "stp", "sur", "tmd", "top", "vk", "vk3", "vk4", "vk6", "vk7", "x3p",
    "xlsx", "zag", "zmg", "zon", "zip", "dat3d",
];

fn is_of_an_instrument(name: &str) -> bool {
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_lowercase());
    ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

/// What a file of heights has.
pub enum Content {
    /// Numbers, NaN where nothing was measured, if holes are to be filled; and what the lines above them say.
    Numbers(Array2<f64>, Head),
    /// What an instrument wrote.
    Scan(Scan),
}

/// Heights of a file of this name: numbers by the program's own reader, whatever else by that of instruments, where there is one.
///
/// # Errors
/// When it holds no heights, or a point without a measurement that is not to be filled.
pub fn content(
    (name, bytes): (&str, &[u8]),
    keys: &TreatmentFile,
    scan: Option<&ReadScan<'_>>,
) -> Result<Content, Mistake> {
    let read = if keys.fills() { numbers_with_holes(bytes) } else { numbers(bytes) };
    let is_instruments = is_of_an_instrument(name);
    let error = match read {
        Ok(array) if !is_instruments => return Ok(Content::Numbers(array, head(bytes))),
        Ok(_) => None,
        Err(error) => Some(error),
    };
    let channel = keys.channel.as_ref().map(|channel| channel.value.as_str());
    let is_text = !is_instruments && !matches!(error, Some(NumbersError::Bytes(_)));
    let may_be_one = is_instruments || error.as_ref().is_some_and(NumbersError::may_be_another_format);
    match (scan.filter(|_| may_be_one).map(|scan| scan(name, channel)), error) {
        (Some(Ok(scan)), _) => Ok(Content::Scan(scan)),
        (Some(Err(why)), _) if !is_text => Err(Mistake::new(why, "")),
        (_, Some(error)) if is_text => {
            let way_out = if error.is_hole() { FILL } else { error.way_out() };
            Err(Mistake::new(error.to_string(), way_out))
        }
        (_, error) => {
            let why = error.map_or_else(
                || "its name is that of an instrument's file".to_owned(),
                |error| error.to_string(),
            );
            let message = format!("no file of numbers, perhaps one of an instrument: {why}");
            Err(Mistake::new(message, INSTRUMENTS))
        }
    }
}
