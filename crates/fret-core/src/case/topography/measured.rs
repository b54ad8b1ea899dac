//! Heights as they were measured, brought to the units of the case: those of a scan, of a matrix, of a list of points.

use ndarray::Array2;

use super::keys::ScanSizeFile;
use super::question::{Measured, Question, SPACING};
use super::scan::Scan;
use crate::case::arrays::Layout;
use crate::case::judge::Judge;
use crate::heights::marks::without_marks;
use crate::heights::points;
use crate::model::{Axis, Dimension};
use crate::numbers::Head;
use crate::units::{Heading, conversion, is_unit, known_units};

impl Question<'_> {
    /// Heights of a scan; `unit` and `rows` were given for them.
    pub fn of_scan(&self, judge: &mut Judge, scan: Scan, unit: Option<f64>, rows: bool) -> Option<Measured> {
        if rows {
            return self.refuse(judge, "rows: the file says itself how its points lie", "leave rows out");
        }
        let factor = match (&scan.unit, unit) {
            (Some(_), Some(_)) => {
                return self.refuse(judge, "unit: the file says it itself", "leave unit out");
            }
            (Some(unit), None) => match conversion(unit, "length", judge.units.as_ref()) {
                Ok(conversion) => conversion.factor(),
                Err(error) => {
                    let why = format!("the file is in {error}");
                    let help = format!("units.length says that of the case; {}", known_units("length"));
                    return self.refuse(judge, &why, &help);
                }
            },
            (None, Some(unit)) => unit,
            (None, None) => {
                return self.refuse(
                    judge,
                    "the file does not say in which unit its lengths are",
                    "unit = length of one unit of the file, in the case's unit of length",
                );
            }
        };
        let stated = scan.size.map(|size| size.map(|side| side * factor));
        if let (Some(_), Some(given)) = (stated, &self.keys.size) {
            return judge.refuse(
                given.span(),
                format!("{}.size: the file states the size itself", self.place),
                "leave size out",
            );
        }
        Some(Measured {
            size: stated.or(self.given_size(judge)?),
            heights: scan.heights.mapv(|height| height * factor),
            places: scan.places.map(|places| places.into_iter().map(|place| place * factor).collect()),
            read_by: Some(scan.read_by),
        })
    }

    /// An array of heights and its layout: the length of one unit of it is given, or that of the lines above the numbers, or that of the case.
    /// Coordinates whose units these lines name come back in that of the case; others are in it or in that of the heights.
    pub fn with_unit(
        &self,
        judge: &mut Judge,
        mut array: Array2<f64>,
        (rows, given, head): (Axis, Option<f64>, &Head),
    ) -> Option<(Array2<f64>, Layout)> {
        let units = if head.names.len() == array.ncols() { units_in(&head.names) } else { vec![None] };
        let (of_heights, of_places) = units.split_last()?;
        let unit = match (given, head.unit.as_ref().or(of_heights.as_ref())) {
            (None, Some(unit)) => self.in_head(judge, unit)?,
            _ => given.unwrap_or(1.0),
        };
        let named: Vec<&String> = of_places.iter().flatten().collect();
        let all = named.len() == of_places.len();
        if named.is_empty() || !all && of_heights.is_none() {
            return Some((array, Layout { rows, unit, unit_of_places: unit }));
        }
        if !all {
            let why = "the lines above the numbers name the unit of one coordinate and not that of the other";
            return self.refuse(judge, why, "units of both in these lines, or of none");
        }
        for (column, place) in named.into_iter().enumerate() {
            let factor = self.in_head(judge, place)?;
            array.column_mut(column).mapv_inplace(|place| place * factor);
        }
        Some((array, Layout { rows, unit, unit_of_places: 1.0 }))
    }

    /// Length of a unit that the lines above the numbers name.
    fn in_head(&self, judge: &mut Judge, unit: &str) -> Option<f64> {
        match conversion(unit, "length", judge.units.as_ref()) {
            Ok(conversion) => Some(conversion.factor()),
            Err(error) => {
                let why = format!("the lines above the numbers say they are in {error}");
                self.refuse(
                    judge,
                    &why,
                    "unit = length of one unit of the heights, in the case's unit of length",
                )
            }
        }
    }

    /// Side lengths by the lines above the numbers, where these are of use.
    fn size_of_head(judge: &Judge, head: &Head, rows: Axis) -> Option<[f64; 2]> {
        let side = |stated: &Option<(f64, String)>| {
            let (number, unit) = stated.as_ref()?;
            let factor = conversion(unit, "length", judge.units.as_ref()).ok()?;
            Some(factor.of(*number))
        };
        let [width, height] = [side(&head.width)?, side(&head.height)?];
        Some(if rows == Axis::Y { [width, height] } else { [height, width] })
    }

    /// Heights of an array, laid out as a matrix, or as a list of points that fill a grid of their own.
    pub fn of_array(
        &self,
        judge: &mut Judge,
        (array, head): (Array2<f64>, &Head),
        layout: Layout,
    ) -> Option<Measured> {
        if let Some(channel) = &self.keys.channel {
            return judge.refuse(
                channel.span(),
                format!("{}.channel: the file has numbers and no channels", self.place),
                "leave channel out",
            );
        }
        let dimension = Dimension::of(self.cells.count);
        let places = if array.ncols() == 3 {
            2
        } else {
            usize::from(dimension == Dimension::Line && array.ncols() == 2)
        };
        if array.columns().into_iter().take(places).flatten().any(|place| !place.is_finite())
            && array.nrows() > 3
        {
            return self.refuse(
                judge,
                "a point at a place that is no number",
                "leave such points out of the file",
            );
        }
        let given = self.given_size(judge)?.or(Self::size_of_head(judge, head, layout.rows));
        if (dimension, array.ncols()) == (Dimension::Line, 2)
            && array.nrows() > 3
            && points::own_cells(&array.view()).is_none()
        {
            return self.uneven(judge, &array, given, layout);
        }
        if (dimension, array.ncols()) == (Dimension::Line, 3) {
            return self.refuse(
                judge,
                "three columns, in a line contact",
                "a line scan has x and height, or heights alone",
            );
        }
        let states_size = head.width.is_some() && head.height.is_some();
        if points::is_list(&array, self.cells.count) && array.nrows() > 3 && !states_size {
            let Some(own) = points::own_cells(&array.view()) else {
                return self.refuse(
                    judge,
                    "points that fill no rectangular grid",
                    "one point x, y, height for every place of the grid, in any order",
                );
            };
            let (heights, spacing) = match points::on_cells(&array.view(), own) {
                Ok(found) => found,
                Err(why) => return self.refuse(judge, &why, "each point within a tenth of the spacing"),
            };
            let own_size =
                [0, 1].map(|axis| spacing[axis].or(spacing[0]).unwrap_or_default() * own[axis] as f64);
            let fits = |unit: f64| {
                given.is_none_or(|given| {
                    dimension.axes().all(|axis| (own_size[axis] * unit / given[axis] - 1.0).abs() < SPACING)
                })
            };
            let unit = match (fits(1.0), fits(layout.unit_of_places)) {
                (true, true) if layout.unit_of_places != 1.0 && given.is_none() => {
                    return self.refuse(
                        judge,
                        "the coordinates of the points may be in the unit of the heights or in that of the case",
                        "size = side lengths of the scan says which",
                    );
                }
                (true, _) => 1.0,
                (false, true) => layout.unit_of_places,
                (false, false) => {
                    let why = format!("size: the points lie on {own_size:?}, in their own unit");
                    return self.refuse(judge, &why, "leave size out, or correct it");
                }
            };
            let size = own_size.map(|side| side * unit);
            let heights = without_marks(heights).mapv(|height| height * layout.unit);
            return Some(Measured { heights, size: Some(size), places: None, read_by: None });
        }
        let mut heights = match layout.rows {
            Axis::X => array.as_standard_layout().into_owned(),
            Axis::Y => array.reversed_axes().as_standard_layout().into_owned(),
        };
        if (dimension, heights.nrows()) == (Dimension::Line, 1) {
            heights = heights.reversed_axes().as_standard_layout().into_owned();
        }
        let heights = without_marks(heights).mapv(|height| height * layout.unit);
        Some(Measured { heights, size: given, places: None, read_by: None })
    }

    /// A line scan of points x, height that are not evenly spaced.
    fn uneven(
        &self,
        judge: &mut Judge,
        array: &Array2<f64>,
        given: Option<[f64; 2]>,
        layout: Layout,
    ) -> Option<Measured> {
        let mut points: Vec<[f64; 2]> = array.rows().into_iter().map(|row| [row[0], row[1]]).collect();
        points.sort_by(|one, other| one[0].total_cmp(&other[0]));
        let first = points[0][0];
        let range = points[points.len() - 1][0] - first;
        if points.windows(2).any(|pair| !(pair[1][0] > pair[0][0])) {
            return self.refuse(
                judge,
                "two points of the line scan lie at the same place",
                "one height for each x",
            );
        }
        let fits = |unit: f64| given.is_none_or(|given| (range * unit / given[0] - 1.0).abs() < SPACING);
        let factor = match (fits(1.0), fits(layout.unit_of_places)) {
            (true, true) if layout.unit_of_places != 1.0 => {
                return self.refuse(
                    judge,
                    "the coordinates of the points may be in the unit of the heights or in that of the case",
                    "size = length of the line scan says which",
                );
            }
            (true, _) => 1.0,
            (false, true) => layout.unit_of_places,
            (false, false) => {
                let why = format!("size: the points lie on {range}, in their own unit");
                return self.refuse(judge, &why, "leave size out, or correct it");
            }
        };
        let heights = Array2::from_shape_fn((points.len(), 1), |(point, _)| points[point][1]);
        Some(Measured {
            heights: without_marks(heights).mapv(|height| height * layout.unit),
            size: Some([range * factor; 2]),
            places: Some(points.iter().map(|point| (point[0] - first) * factor).collect()),
            read_by: None,
        })
    }

    /// The size that the case gives; the inner `None`: it gives none.
    #[expect(clippy::option_option, reason = "the outer `None` is a refusal, as everywhere here")]
    fn given_size(&self, judge: &mut Judge) -> Option<Option<[f64; 2]>> {
        let Some(given) = &self.keys.size else { return Some(None) };
        let dimension = Dimension::of(self.cells.count);
        let size = match (given.value, dimension) {
            (ScanSizeFile::Sides(sides), Dimension::Plane) => sides,
            (ScanSizeFile::Line(length), Dimension::Line) => [length; 2],
            (_, dimension) => {
                let help = match dimension {
                    Dimension::Plane => "size = [x, y]",
                    Dimension::Line => "size = length of the line scan",
                };
                let message = format!("{}.size: of a surface two lengths, of a line scan one", self.place);
                return judge.refuse(given.span(), message, help);
            }
        };
        if size.iter().all(|side| side.is_finite() && *side > 0.0) {
            return Some(Some(size));
        }
        judge.refuse(
            given.span(),
            format!("{}.size = {size:?}: lengths must be positive and finite", self.place),
            "",
        )
    }
}

/// Units beside the names of columns, or those of a line of units.
fn units_in(names: &[String]) -> Vec<Option<String>> {
    let plain = |name: &String| name.trim_matches(['[', ']', '(', ')']).to_owned();
    if names.iter().all(|name| is_unit(&plain(name))) {
        return names.iter().map(|name| Some(plain(name))).collect();
    }
    names.iter().map(|name| Heading::of(name)?.unit.filter(|unit| !unit.is_empty())).collect()
}
