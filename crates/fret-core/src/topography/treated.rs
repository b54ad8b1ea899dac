//! Measured heights after all that a case asks for: filled, cut, levelled, filtered, and on the cells of the grid.

use ndarray::{Array2, s};

use super::cells::Cells;
use super::content::FILL;
use super::question::{Measured, Question, SPACING};
use super::wrong::{refuse, wrong};
use crate::document::{At, Mistake};
use crate::heights::points;
use crate::heights::resample::MeasuredSurface;
use crate::heights::{fill, gaussian, resample};
use crate::model::{Detrend, Dimension, Treatment};

/// Heights after all that is done to them.
pub enum Treated {
    /// One for every cell.
    Cells(Array2<f64>),
    /// A surface that any grid takes its heights from.
    Surface(MeasuredSurface),
}

impl Question<'_> {
    /// The heights after all that the case asks for, and the record of it.
    ///
    /// # Errors
    /// When something of it cannot be done to these heights, or they do not fit the grid.
    pub fn treated(&self, mut measured: Measured, detrend: Detrend) -> Result<(Treated, Treatment), Mistake> {
        let [nx, ny] = measured.points();
        let (read_by, size) = (measured.read_by.take(), measured.size);
        let mut record = Treatment { read_by, points: [nx, ny], size, ..Treatment::default() };
        if self.dimension() == Dimension::Line && ny > 1 {
            return refuse(
                format!("{nx} x {ny} points, in a line contact"),
                "a line contact takes a line scan; a surface needs two numbers of cells",
            );
        }
        self.check_uneven(&measured)?;
        self.filled(&mut measured, &mut record)?;
        if let Some(cut) = &self.keys.cut {
            kept(&mut measured, cut)?;
            record.cut = Some(cut.value.clone());
        }
        detrend.remove_from(&mut measured.heights);
        self.filtered(&mut measured, &mut record)?;
        if self.keys.resamples() {
            record.resample = Some("linear".to_owned());
            return Ok((Treated::Surface(self.surface(measured)?), record));
        }
        self.are_cells(&measured)?;
        Ok((Treated::Cells(measured.heights), record))
    }

    /// Refuses what needs even points, of points that are not.
    fn check_uneven(&self, measured: &Measured) -> Result<(), Mistake> {
        if measured.places.is_none() {
            return Ok(());
        }
        let why = |what: &str| format!("{what}: the points of this line scan are not evenly spaced");
        let has_holes = measured.heights.iter().any(|height| height.is_nan());
        if has_holes && self.keys.fills() {
            let help = "leave points without a measurement out of the file: resample = \"linear\" goes straight from one point to the next";
            return refuse(why("fill"), help);
        }
        let filters = self.keys.short_cutoff.is_some() || self.keys.long_cutoff.is_some();
        for (what, is_asked) in [("cut", self.keys.cut.is_some()), ("short_cutoff and long_cutoff", filters)]
        {
            if is_asked {
                return refuse(why(what), "resample = \"linear\" alone takes such points");
            }
        }
        Ok(())
    }

    fn filled(&self, measured: &mut Measured, record: &mut Treatment) -> Result<(), Mistake> {
        let [nx, ny] = measured.points();
        let heights = &mut measured.heights;
        let first = heights.indexed_iter().find(|(_, height)| height.is_nan()).map(|(at, _)| at);
        let Some((i, j)) = first else { return Ok(()) };
        let count = heights.iter().filter(|height| height.is_nan()).count();
        record.holes = count;
        if !self.keys.fills() {
            let all = heights.len();
            let why = format!("{count} of {all} points have no measurement, the first at [{i}, {j}]");
            return refuse(why, FILL);
        }
        record.fill = Some("harmonic".to_owned());
        // Points that are not resampled are the cells.
        let size = measured.size.or(self.cells.size.filter(|_| !self.keys.resamples()));
        let spacing = size.map_or([1.0; 2], |size| [size[0] / nx as f64, size[1] / ny as f64]);
        let ratio = if ny > 1 { (spacing[0] / spacing[1]).powi(2) } else { 1.0 };
        fill::fill(heights, [1.0, ratio])
            .map_err(|why| wrong(why, "measure again, or choose another channel"))
    }

    fn filtered(&self, measured: &mut Measured, record: &mut Treatment) -> Result<(), Mistake> {
        let (short, long) = (self.keys.short_cutoff.as_ref(), self.keys.long_cutoff.as_ref());
        if let (Some(short), Some(long)) = (short, long)
            && short.value >= long.value
        {
            let why = "short_cutoff is not below long_cutoff";
            return Err(wrong(why, "waves between the two are kept").at(short.span()));
        }
        for (cutoff, is_short) in [(short, true), (long, false)] {
            let Some(cutoff) = cutoff else { continue };
            let size = size_for("short_cutoff and long_cutoff", measured.size)?;
            let counts = measured.points();
            let repeats = self.is_period(size);
            let heights = &mut measured.heights;
            let points = [0, 1].map(|axis| cutoff.value * counts[axis] as f64 / size[axis]);
            let smooth = gaussian::smoothed(heights, points, repeats);
            if is_short {
                *heights = smooth;
                record.short_cutoff = Some(cutoff.value);
            } else {
                *heights -= &smooth;
                record.long_cutoff = Some(cutoff.value);
            }
        }
        Ok(())
    }

    /// The surface that the cells of the grid are taken from, which lies in the middle of the scan.
    fn surface(&self, measured: Measured) -> Result<MeasuredSurface, Mistake> {
        let size = size_for("resample", measured.size)?;
        let Some(grid) = self.cells.size else {
            return refuse("resample: grid.size must be given", "grid.size = [x, y]");
        };
        let axes = self.dimension().axes().len();
        if (0..axes).any(|axis| grid[axis] > size[axis] * (1.0 + SPACING)) {
            let why = format!("the scan is {}, and the grid {}", shown(size, axes), shown(grid, axes));
            return refuse(why, "a grid that lies inside the scan");
        }
        let counts = measured.points();
        let is_uneven = measured.places.is_some();
        let x = measured.places.unwrap_or_else(|| resample::even(counts[0], size[0] / counts[0] as f64));
        let y = resample::even(counts[1], size[1] / counts[1] as f64);
        let begin = if is_uneven { x.first().copied().unwrap_or_default() } else { 0.0 };
        let window = |axis: usize, begin: f64| {
            let side = if axis < axes { grid[axis].min(size[axis]) } else { size[axis] };
            let from = begin + 0.5 * (size[axis] - side);
            from..from + side
        };
        let window = [window(0, begin), window(1, 0.0)];
        let repeats = if is_uneven { [false; 2] } else { self.is_period(size) };
        Ok(MeasuredSurface { heights: measured.heights, places: [x, y], window, repeats })
    }

    /// Whether a scan of this size is one period of the scene along x and along y: it goes on at its other end then.
    fn is_period(&self, size: [f64; 2]) -> [bool; 2] {
        let fits = |axis: usize| {
            self.cells.size.is_some_and(|grid| (grid[axis] / size[axis] - 1.0).abs() <= SPACING)
        };
        [0, 1].map(|axis| self.cells.repeats[axis] && fits(axis))
    }

    /// Refuses points that are not the cells of the grid.
    fn are_cells(&self, measured: &Measured) -> Result<(), Mistake> {
        let Cells { count, size: grid, .. } = self.cells;
        let (points, size) = (measured.points(), measured.size);
        let axes = self.dimension().axes().len();
        let extent = size.map(|size| format!(" on {}", shown(size, axes))).unwrap_or_default();
        let counted = |counts: [usize; 2]| shown(counts.map(|count| count as f64), axes);
        let help = "resample = \"linear\" takes the grid from the middle of the scan, or give the grid the points of the scan";
        if points != count {
            let why =
                format!("{} points{extent}, but the grid has {} cells", counted(points), counted(count));
            return refuse(why, help);
        }
        if measured.places.is_some() {
            return refuse("the points of this line scan are not evenly spaced", help);
        }
        if let (Some(size), Some(grid)) = (size, grid)
            && (0..axes).any(|axis| (size[axis] / grid[axis] - 1.0).abs() > SPACING)
        {
            let why = format!("the scan is {}, and the grid {}", shown(size, axes), shown(grid, axes));
            return refuse(why, help);
        }
        Ok(())
    }
}

/// Keeps a part of the scan.
fn kept(measured: &mut Measured, cut: &At<Vec<[f64; 2]>>) -> Result<(), Mistake> {
    let refuse = |why: String, help| Err(Mistake::new(format!(".cut: {why}"), help).at(cut.span()));
    let size = size_for("cut", measured.size)?;
    let counts = measured.points();
    let axes = Dimension::of(counts).axes().len();
    if cut.len() != axes {
        let why = format!("{} pairs of from and to, wanted {axes}", cut.len());
        return refuse(why, "cut = [[x from, x to], [y from, y to]]; of a line scan [[from, to]]");
    }
    let mut kept = [0..counts[0], 0..counts[1]];
    let mut sides = size;
    for (axis, &[from, to]) in cut.iter().enumerate() {
        let spacing = size[axis] / counts[axis] as f64;
        let index = |at: f64| (at / spacing).round();
        let [first, end] = [index(from), index(to)];
        if !(first >= 0.0 && end >= first + 2.0 && end <= counts[axis] as f64) {
            let why = format!(
                "from {from} to {to} along {}, of a scan of 0 to {} with points {spacing} apart",
                ["x", "y"][axis],
                size[axis]
            );
            return refuse(why, "at least two points inside the scan");
        }
        kept[axis] = first as usize..end as usize;
        sides[axis] = spacing * (end - first);
    }
    let [x, y] = kept;
    measured.heights = measured.heights.slice(s![x, y]).to_owned();
    measured.size = Some(sides);
    Ok(())
}

/// The size, which something that is asked for needs.
fn size_for(what: &str, size: Option<[f64; 2]>) -> Result<[f64; 2], Mistake> {
    let why = format!("{what}: nothing says how large the scan is");
    size.ok_or_else(|| wrong(why, "size = [x, y] [length], of a line scan one length"))
}

/// Numbers along the axes, as `a x b`.
fn shown(numbers: [f64; 2], axes: usize) -> String {
    let words: Vec<String> =
        numbers[..axes].iter().map(|&number| points::figures(number).to_string()).collect();
    words.join(" x ")
}
