//! Arrays that a case names: heights and friction maps. Files are read by who reads the case.

use std::ops::Range;

use ndarray::Array2;

use super::judge::Judge;
use super::surface_file::{ArrayFile, Handed, Row};
use crate::numbers::{NumbersError, numbers};

/// Array of a file, in the order of its rows.
pub(super) fn of_file(judge: &mut Judge, place: &str, span: Range<usize>, name: &str) -> Option<Array2<f64>> {
    let bytes = judge.attached((place, span.clone()), name, NumbersError::A_FILE)?;
    match numbers(&bytes) {
        Ok(array) => Some(array),
        Err(error) => judge.refuse(span, format!("{place} = {name:?}: {error}"), error.way_out()),
    }
}

/// Array of rows, or one that was handed over.
pub(super) fn given(
    judge: &mut Judge,
    place: &str,
    span: Range<usize>,
    source: &ArrayFile,
) -> Option<Array2<f64>> {
    let taken = match source {
        ArrayFile::Handed(Handed { array: number }) => {
            let array = judge.attachments.arrays.get(*number).cloned();
            array.ok_or_else(|| format!("no array {number} was handed over"))
        }
        ArrayFile::Rows(rows) => {
            let rows: Vec<&[f64]> = rows.iter().map(Row::numbers).collect();
            let columns = rows.first().map_or(0, |row| row.len());
            let flat: Vec<f64> = rows.iter().copied().flatten().copied().collect();
            match rows.iter().position(|row| row.len() != columns) {
                Some(row) => Err(format!("row {row} has {} numbers, row 0 has {columns}", rows[row].len())),
                None => Array2::from_shape_vec((rows.len(), columns), flat).map_err(|e| e.to_string()),
            }
        }
    };
    match taken {
        Ok(array) => Some(array),
        Err(why) => judge.refuse(span, format!("{place}: {why}"), ""),
    }
}
