//! A number for every cell of a grid, from an array of numbers: heights, or a map of friction.

use ndarray::Array2;

use super::wrong::refuse;
use crate::document::Mistake;
use crate::heights::points;
use crate::model::Axis;

/// The cells that an array has its numbers for.
#[derive(Clone, Copy)]
pub struct Cells {
    /// How many along x and y.
    pub count: [usize; 2],
    /// Side lengths of the grid, where they are given.
    pub size: Option<[f64; 2]>,
    /// Whether the scene repeats along x and y.
    pub repeats: [bool; 2],
}

/// How the numbers of an array are laid out.
#[derive(Clone, Copy)]
pub struct Layout {
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

/// A number for every cell, index `[i, j] = [x, y]`, from a matrix, a list of points, or in a line contact a row, a column or pairs.
///
/// # Errors
/// When the array has not the numbers of the cells.
pub fn fitting(
    Cells { count, size, .. }: Cells,
    array: Array2<f64>,
    layout: Layout,
) -> Result<Array2<f64>, Mistake> {
    let is_list = points::is_list(&array, count);
    if is_list && (count[1] == 1 || array.nrows() >= count[0].max(count[1])) {
        return listed((count, size), &array, layout.unit_of_places);
    }
    let array = laid_out(array, layout.rows);
    let (nx, ny) = array.dim();
    if [nx, ny] == count {
        return Ok(array);
    }
    if count[1] == 1 && [ny, nx] == count {
        return Ok(turned(array)); // of a line contact, also written in one row
    }
    let hint = if [ny, nx] == count {
        let other = if layout.rows == Axis::X { "y" } else { "x" };
        format!("; its rows seem to run along {other}: rows = \"{other}\"")
    } else if [nx, ny] == [count[0], 2 * count[1]] || [nx, ny] == [2 * count[0], count[1]] {
        "; twice as many numbers as cells: are there decimal commas in the file?".to_owned()
    } else {
        String::new()
    };
    refuse(
        format!("{nx} x {ny} numbers, but the grid has {} x {} cells", count[0], count[1]),
        &format!("one number per cell, index [i, j] = [x, y]{hint}; or a list of points x, y, value"),
    )
}

/// Values of a list of points on the cells.
fn listed(
    (count, size): ([usize; 2], Option<[f64; 2]>),
    array: &Array2<f64>,
    unit: f64,
) -> Result<Array2<f64>, Mistake> {
    let (values, spacing) = match points::on_cells(&array.view(), count) {
        Ok(found) => found,
        Err(why) => {
            return refuse(
                why,
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
        return refuse(
            why,
            &format!(
                "coordinates are in the unit of the values or in the case's unit of length: in those of the file size = {sides}, as many \
                 spacings as cells"
            ),
        );
    }
    Ok(values)
}

/// An array with its first index along x.
pub fn laid_out(array: Array2<f64>, rows: Axis) -> Array2<f64> {
    match rows {
        Axis::X if array.is_standard_layout() => array,
        Axis::X => array.as_standard_layout().into_owned(),
        Axis::Y => turned(array),
    }
}

/// An array with its rows as columns.
pub fn turned(array: Array2<f64>) -> Array2<f64> {
    array.reversed_axes().as_standard_layout().into_owned()
}
