//! Arrays that a case names: heights and friction maps. Files are read by who reads the case; what comes is judged here.

use std::ops::Range;

use ndarray::Array2;

use super::judge::Judge;
use super::numbers::numbers;
use super::surface_file::ArrayFile;

/// Array of a file, in the order of its rows.
pub(super) fn of_file(judge: &mut Judge, place: &str, span: Range<usize>, name: &str) -> Option<Array2<f64>> {
    match (judge.attachments.file)(name).and_then(|bytes| numbers(&bytes).map_err(|error| error.to_string()))
    {
        Ok(array) => Some(array),
        Err(why) => judge.refuse(
            span,
            format!("{place} = {name:?}: {why}"),
            "a .npy file, or a text file with one row of numbers per line; relative paths start at the case file",
        ),
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
        ArrayFile::Handed(number) => {
            let array = judge.attachments.arrays.get(*number).cloned();
            array.ok_or_else(|| format!("no array {number} was handed over"))
        }
        ArrayFile::Rows(rows) => {
            let columns = rows.first().map_or(0, Vec::len);
            let flat: Vec<f64> = rows.iter().flatten().copied().collect();
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

/// The array itself when it has a number for every cell; cells are `None` when they were refused, and no array can be judged.
pub(super) fn fitting(
    judge: &mut Judge,
    cells: Option<[usize; 2]>,
    place: &str,
    span: Range<usize>,
    array: Array2<f64>,
) -> Option<Array2<f64>> {
    let cells = cells?;
    let (nx, ny) = array.dim();
    if [nx, ny] == cells {
        return Some(array);
    }
    if cells[1] == 1 && [ny, nx] == cells {
        return Some(array.reversed_axes().as_standard_layout().into_owned()); // of a line contact, also written in one row
    }
    let turned = if [ny, nx] == cells { "; its rows seem to run along y: rows = \"y\"" } else { "" };
    judge.refuse(
        span,
        format!("{place}: {nx} x {ny} numbers, but the grid has {} x {} cells", cells[0], cells[1]),
        &format!("one number per cell, index [i, j] = [x, y]{turned}"),
    )
}
