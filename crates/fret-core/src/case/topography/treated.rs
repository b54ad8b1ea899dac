//! Measured heights after all that a case asks for: filled, cut, levelled, filtered, and on the cells of the grid.

use std::ops::Range;

use ndarray::{Array2, s};

use super::content::FILL;
use super::question::{Measured, Question, SPACING};
use crate::case::arrays::Cells;
use crate::case::judge::Judge;
use crate::heights::points;
use crate::heights::resample::MeasuredSurface;
use crate::heights::{fill, gaussian, resample};
use crate::model::{Detrend, Treatment};

/// Heights after all that is done to them.
pub(in crate::case) enum Treated {
    /// One for every cell.
    Cells(Array2<f64>),
    /// A surface that any grid takes its heights from.
    Surface(MeasuredSurface),
}

impl Question<'_> {
    /// The heights after all that the case asks for, and the record of it.
    pub fn treated(
        &self,
        judge: &mut Judge,
        mut measured: Measured,
        detrend: Detrend,
    ) -> Option<(Treated, Treatment)> {
        let [nx, ny] = measured.points();
        let (read_by, size) = (measured.read_by.take(), measured.size);
        let mut record = Treatment { read_by, points: [nx, ny], size, ..Treatment::default() };
        if self.cells.count[1] == 1 && ny > 1 {
            return self.refuse(
                judge,
                &format!("{nx} x {ny} points, in a line contact"),
                "a line contact takes a line scan; a surface needs two numbers of cells",
            );
        }
        self.check_uneven(judge, &measured)?;
        self.filled(judge, &mut measured, &mut record)?;
        if let Some(cut) = &self.keys.cut {
            self.cut(judge, &mut measured, (&cut.value, cut.span()))?;
            record.cut = Some(cut.value.clone());
        }
        detrend.remove_from(&mut measured.heights);
        self.filtered(judge, &mut measured, &mut record)?;
        if self.keys.resamples() {
            record.resample = Some("linear".to_owned());
            return Some((Treated::Surface(self.surface(judge, measured)?), record));
        }
        self.are_cells(judge, &measured)?;
        Some((Treated::Cells(measured.heights), record))
    }

    /// Refuses what needs even points, of points that are not.
    fn check_uneven(&self, judge: &mut Judge, measured: &Measured) -> Option<()> {
        if measured.places.is_none() {
            return Some(());
        }
        let why = |what: &str| format!("{what}: the points of this line scan are not evenly spaced");
        let has_holes = measured.heights.iter().any(|height| height.is_nan());
        if has_holes && self.keys.fills() {
            let help = "leave points without a measurement out of the file: resample = \"linear\" goes straight from one point to the next";
            return self.refuse(judge, &why("fill"), help);
        }
        let filters = self.keys.short_cutoff.is_some() || self.keys.long_cutoff.is_some();
        for (what, is_asked) in [("cut", self.keys.cut.is_some()), ("short_cutoff and long_cutoff", filters)]
        {
            if is_asked {
                return self.refuse(judge, &why(what), "resample = \"linear\" alone takes such points");
            }
        }
        Some(())
    }

    fn filled(&self, judge: &mut Judge, measured: &mut Measured, record: &mut Treatment) -> Option<()> {
        let [nx, ny] = measured.points();
        let heights = &mut measured.heights;
        let first = heights.indexed_iter().find(|(_, height)| height.is_nan()).map(|(at, _)| at);
        let Some((i, j)) = first else { return Some(()) };
        let count = heights.iter().filter(|height| height.is_nan()).count();
        record.holes = count;
        if !self.keys.fills() {
            let all = heights.len();
            let why = format!("{count} of {all} points have no measurement, the first at [{i}, {j}]");
            return self.refuse(judge, &why, FILL);
        }
        record.fill = Some("harmonic".to_owned());
        // Points that are not resampled are the cells.
        let size = measured.size.or(self.cells.size.filter(|_| !self.keys.resamples()));
        let spacing = size.map_or([1.0; 2], |size| [size[0] / nx as f64, size[1] / ny as f64]);
        let ratio = if ny > 1 { (spacing[0] / spacing[1]).powi(2) } else { 1.0 };
        match fill::fill(heights, [1.0, ratio]) {
            Ok(()) => Some(()),
            Err(why) => self.refuse(judge, why, "measure again, or choose another channel"),
        }
    }

    /// The size, which something that is asked for needs.
    fn size_for(&self, judge: &mut Judge, what: &str, size: Option<[f64; 2]>) -> Option<[f64; 2]> {
        let why = || format!("{what}: nothing says how large the scan is");
        size.or_else(|| self.refuse(judge, &why(), "size = [x, y] [length], of a line scan one length"))
    }

    /// Keeps a part of the scan.
    fn cut(
        &self,
        judge: &mut Judge,
        measured: &mut Measured,
        (cut, span): (&[[f64; 2]], Range<usize>),
    ) -> Option<()> {
        let size = self.size_for(judge, "cut", measured.size)?;
        let counts = measured.points();
        let axes = if counts[1] == 1 { 1 } else { 2 };
        if cut.len() != axes {
            let message = format!("{}.cut: {} pairs of from and to, wanted {axes}", self.place, cut.len());
            return judge.refuse(
                span,
                message,
                "cut = [[x from, x to], [y from, y to]]; of a line scan [[from, to]]",
            );
        }
        let mut kept = [0..counts[0], 0..counts[1]];
        let mut sides = size;
        for (axis, &[from, to]) in cut.iter().enumerate() {
            let spacing = size[axis] / counts[axis] as f64;
            let index = |at: f64| (at / spacing).round();
            let [first, end] = [index(from), index(to)];
            if !(first >= 0.0 && end >= first + 2.0 && end <= counts[axis] as f64) {
                let message = format!(
                    "{}.cut: from {from} to {to} along {}, of a scan of 0 to {} with points {spacing} apart",
                    self.place,
                    ["x", "y"][axis],
                    size[axis]
                );
                return judge.refuse(span, message, "at least two points inside the scan");
            }
            kept[axis] = first as usize..end as usize;
            sides[axis] = spacing * (end - first);
        }
        let [x, y] = kept;
        measured.heights = measured.heights.slice(s![x, y]).to_owned();
        measured.size = Some(sides);
        Some(())
    }

    fn filtered(&self, judge: &mut Judge, measured: &mut Measured, record: &mut Treatment) -> Option<()> {
        let (short, long) = (self.keys.short_cutoff.as_ref(), self.keys.long_cutoff.as_ref());
        if let (Some(short), Some(long)) = (short, long)
            && short.value >= long.value
        {
            let message = format!("{}: short_cutoff is not below long_cutoff", self.place);
            return judge.refuse(short.span(), message, "waves between the two are kept");
        }
        for (cutoff, is_short) in [(short, true), (long, false)] {
            let Some(cutoff) = cutoff else { continue };
            let size = self.size_for(judge, "short_cutoff and long_cutoff", measured.size)?;
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
        Some(())
    }

    /// The surface that the cells of the grid are taken from, which lies in the middle of the scan.
    fn surface(&self, judge: &mut Judge, measured: Measured) -> Option<MeasuredSurface> {
        let size = self.size_for(judge, "resample", measured.size)?;
        let Some(grid) = self.cells.size else {
            return self.refuse(judge, "resample: grid.size must be given", "grid.size = [x, y]");
        };
        let axes = if self.cells.count[1] == 1 { 1 } else { 2 };
        if (0..axes).any(|axis| grid[axis] > size[axis] * (1.0 + SPACING)) {
            let why = format!("the scan is {}, and the grid {}", shown(size, axes), shown(grid, axes));
            return self.refuse(judge, &why, "a grid that lies inside the scan");
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
        Some(MeasuredSurface { heights: measured.heights, places: [x, y], window, repeats })
    }

    /// Whether a scan of this size is one period of the scene along x and along y: it goes on at its other end then.
    fn is_period(&self, size: [f64; 2]) -> [bool; 2] {
        let fits = |axis: usize| {
            self.cells.size.is_some_and(|grid| (grid[axis] / size[axis] - 1.0).abs() <= SPACING)
        };
        [0, 1].map(|axis| self.cells.repeats[axis] && fits(axis))
    }

    /// Refuses points that are not the cells of the grid.
    fn are_cells(&self, judge: &mut Judge, measured: &Measured) -> Option<()> {
        let Cells { count, size: grid, .. } = self.cells;
        let (points, size) = (measured.points(), measured.size);
        let axes = if count[1] == 1 { 1 } else { 2 };
        let extent = size.map(|size| format!(" on {}", shown(size, axes))).unwrap_or_default();
        let counted = |counts: [usize; 2]| shown(counts.map(|count| count as f64), axes);
        let help = "resample = \"linear\" takes the grid from the middle of the scan, or give the grid the points of the scan";
        if points != count {
            let why =
                format!("{} points{extent}, but the grid has {} cells", counted(points), counted(count));
            return self.refuse(judge, &why, help);
        }
        if measured.places.is_some() {
            return self.refuse(judge, "the points of this line scan are not evenly spaced", help);
        }
        if let (Some(size), Some(grid)) = (size, grid)
            && (0..axes).any(|axis| (size[axis] / grid[axis] - 1.0).abs() > SPACING)
        {
            let why = format!("the scan is {}, and the grid {}", shown(size, axes), shown(grid, axes));
            return self.refuse(judge, &why, help);
        }
        Some(())
    }
}

/// Numbers along the axes, as `a x b`.
fn shown(numbers: [f64; 2], axes: usize) -> String {
    let words: Vec<String> =
        numbers[..axes].iter().map(|&number| points::figures(number).to_string()).collect();
    words.join(" x ")
}
