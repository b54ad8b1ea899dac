//! Arrays that a case names: heights and friction maps. Files are read by who reads the case; what comes is judged here.

use std::ops::Range;

use ndarray::Array2;

use super::judge::Judge;
use super::surface_file::{ArrayFile, Handed, Row};
use crate::heights::points;
use crate::model::Axis;
use crate::numbers::{NumbersError, numbers};

/// Array of a file, in the order of its rows.
pub(super) fn of_file(judge: &mut Judge, place: &str, span: Range<usize>, name: &str) -> Option<Array2<f64>> {
    let (why, way_out) = match (judge.attachments.file)(name).map(|bytes| numbers(&bytes)) {
        Ok(Ok(array)) => return Some(array),
        Ok(Err(error)) => (error.to_string(), error.way_out()),
        Err(why) => (why, NumbersError::A_FILE),
    };
    judge.refuse(span, format!("{place} = {name:?}: {why}"), way_out)
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

/// The cells that an array has its numbers for.
#[derive(Clone, Copy)]
pub(super) struct Cells {
    /// How many along x and y.
    pub count: [usize; 2],
    /// Side lengths of the grid, where they are given.
    pub size: Option<[f64; 2]>,
    /// Whether the scene repeats along x and y.
    pub repeats: [bool; 2],
}

/// How the numbers of an array are laid out.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    /// The axis along which rows follow one another.
    pub rows: Axis,
    /// Length of one unit of the numbers.
    pub unit: f64,
    /// Length of one unit of the coordinates of points, if they are not in that of the case.
    pub unit_of_places: f64,
}

impl Layout {
    /// Index `[i, j] = [x, y]`.
    pub const XY: Self = Self { rows: Axis::X, unit: 1.0, unit_of_places: 1.0 };
}

/// A number for every cell, index `[i, j] = [x, y]`, from a matrix, a list of points, or in a line contact a row, a column or pairs;
/// cells are `None` when they were refused, and no array can be judged.
pub(super) fn fitting(
    judge: &mut Judge,
    cells: Option<Cells>,
    (place, span): (&str, Range<usize>),
    array: Array2<f64>,
    layout: Layout,
) -> Option<Array2<f64>> {
    let Cells { count, size, .. } = cells?;
    let turned = |array: Array2<f64>| array.reversed_axes().as_standard_layout().into_owned();
    let is_list = points::is_list(&array, count);
    if is_list && (count[1] == 1 || array.nrows() >= count[0].max(count[1])) {
        return listed(judge, (count, size), (place, span), &array, layout.unit_of_places);
    }
    let (array, other) = match layout.rows {
        Axis::X if array.is_standard_layout() => (array, "y"),
        Axis::X => (array.as_standard_layout().into_owned(), "y"),
        Axis::Y => (turned(array), "x"),
    };
    let (nx, ny) = array.dim();
    if [nx, ny] == count {
        return Some(array);
    }
    if count[1] == 1 && [ny, nx] == count {
        return Some(turned(array)); // of a line contact, also written in one row
    }
    let hint = if [ny, nx] == count {
        format!("; its rows seem to run along {other}: rows = \"{other}\"")
    } else if [nx, ny] == [count[0], 2 * count[1]] || [nx, ny] == [2 * count[0], count[1]] {
        "; twice as many numbers as cells: are there decimal commas in the file?".to_owned()
    } else {
        String::new()
    };
    judge.refuse(
        span,
        format!("{place}: {nx} x {ny} numbers, but the grid has {} x {} cells", count[0], count[1]),
        &format!("one number per cell, index [i, j] = [x, y]{hint}; or a list of points x, y, value"),
    )
}

/// Values of a list of points on the cells.
fn listed(
    judge: &mut Judge,
    (count, size): ([usize; 2], Option<[f64; 2]>),
    (place, span): (&str, Range<usize>),
    array: &Array2<f64>,
    unit: f64,
) -> Option<Array2<f64>> {
    let (values, spacing) = match points::on_cells(&array.view(), count) {
        Ok(found) => found,
        Err(why) => {
            return judge.refuse(
                span,
                format!("{place}: {why}"),
                "points x, y, value (in a line contact x, value) fill the cells of the grid, one per cell, in any order; each within a tenth \
                 of the spacing",
            );
        }
    };
    let cell = size.map(|size| [0, 1].map(|axis| size[axis] / count[axis] as f64));
    if let Some(why) = cell.and_then(|cell| points::spacing_refused(spacing, cell, unit)) {
        let sides: Vec<String> = spacing
            .iter()
            .zip(count)
            .filter_map(|(spacing, count)| {
                spacing.map(|spacing| format!("{:?}", points::figures(spacing * count as f64)))
            })
            .collect();
        let sides = if let [one] = &sides[..] { one.clone() } else { format!("[{}]", sides.join(", ")) };
        return judge.refuse(
            span,
            format!("{place}: {why}"),
            &format!(
                "coordinates are in the unit of the values or in the case's unit of length: in those of the file size = {sides}, as many \
                 spacings as cells"
            ),
        );
    }
    Some(values)
}
