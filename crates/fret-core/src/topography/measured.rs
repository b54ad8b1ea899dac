//! Heights as they were measured, brought to the units of the case: those of a scan, of a matrix, of a list of points.

use ndarray::Array2;

use super::cells::{Layout, laid_out, turned};
use super::keys::ScanSizeFile;
use super::question::{Measured, Question, SPACING};
use super::scan::Scan;
use super::wrong::{refuse, wrong};
use crate::document::Mistake;
use crate::heights::marks::without_marks;
use crate::heights::points;
use crate::model::{Axis, Dimension};
use crate::numbers::Head;
use crate::units::{Conversion, Heading, conversion, is_unit, known_units};

impl Question<'_> {
    /// Heights of a scan; `unit` and `rows` were given for them.
    ///
    /// # Errors
    /// When its unit or its size is not known, or is said twice.
    pub fn of_scan(&self, scan: Scan, unit: Option<f64>, rows: bool) -> Result<Measured, Mistake> {
        if rows {
            return refuse("rows: the file says itself how its points lie", "leave rows out");
        }
        let factor = match (&scan.unit, unit) {
            (Some(_), Some(_)) => return refuse("unit: the file says it itself", "leave unit out"),
            (Some(unit), None) => {
                let help = format!("units.length says that of the case; {}", known_units("length"));
                self.length_of(unit, "the file is in", &help)?
            }
            (None, Some(unit)) => unit,
            (None, None) => {
                return refuse(
                    "the file does not say in which unit its lengths are",
                    "unit = length of one unit of the file, in the case's unit of length",
                );
            }
        };
        let stated = scan.size.map(|size| size.map(|side| side * factor));
        if let (Some(_), Some(given)) = (stated, &self.keys.size) {
            let message = ".size: the file states the size itself";
            return Err(Mistake::new(message, "leave size out").at(given.span()));
        }
        Ok(Measured {
            size: stated.or(self.given_size()?),
            heights: scan.heights.mapv(|height| height * factor),
            places: scan.places.map(|places| places.into_iter().map(|place| place * factor).collect()),
            read_by: Some(scan.read_by),
        })
    }

    /// An array of heights and its layout: the length of one unit of it is given, or that of the lines above the numbers, or that of the case.
    /// Coordinates whose units these lines name come back in that of the case; others are in it or in that of the heights.
    ///
    /// # Errors
    /// When these lines name a unit that is not known, or that of one coordinate alone.
    pub fn with_unit(
        &self,
        mut array: Array2<f64>,
        (rows, given, head): (Axis, Option<f64>, &Head),
    ) -> Result<(Array2<f64>, Layout), Mistake> {
        let units = if head.names.len() == array.ncols() { units_in(&head.names) } else { vec![None] };
        let (of_heights, of_places) = units.split_last().unwrap_or((&None, &[]));
        let unit = match (given, head.unit.as_ref().or(of_heights.as_ref())) {
            (None, Some(unit)) => self.in_head(unit)?,
            _ => given.unwrap_or(1.0),
        };
        let named: Vec<&String> = of_places.iter().flatten().collect();
        let all = named.len() == of_places.len();
        if named.is_empty() || !all && of_heights.is_none() {
            return Ok((array, Layout { rows, unit, unit_of_places: unit }));
        }
        if !all {
            let why = "the lines above the numbers name the unit of one coordinate and not that of the other";
            return refuse(why, "units of both in these lines, or of none");
        }
        for (column, place) in named.into_iter().enumerate() {
            let factor = self.in_head(place)?;
            array.column_mut(column).mapv_inplace(|place| place * factor);
        }
        Ok((array, Layout { rows, unit, unit_of_places: 1.0 }))
    }

    /// Length of a unit that the lines above the numbers name.
    fn in_head(&self, unit: &str) -> Result<f64, Mistake> {
        let help = "unit = length of one unit of the heights, in the case's unit of length";
        self.length_of(unit, "the lines above the numbers say they are in", help)
    }

    /// Length of a unit that somebody `says`.
    fn length_of(&self, unit: &str, says: &str, help: &str) -> Result<f64, Mistake> {
        let conversion = conversion(unit, "length", self.units);
        conversion.map(Conversion::factor).map_err(|error| wrong(format!("{says} {error}"), help))
    }

    /// Side lengths by the lines above the numbers, where these are of use.
    fn size_of_head(&self, head: &Head, rows: Axis) -> Option<[f64; 2]> {
        let side = |stated: &Option<(f64, String)>| {
            let (number, unit) = stated.as_ref()?;
            let factor = conversion(unit, "length", self.units).ok()?;
            Some(factor.of(*number))
        };
        let [width, height] = [side(&head.width)?, side(&head.height)?];
        Some(if rows == Axis::Y { [width, height] } else { [height, width] })
    }

    /// Heights of an array, laid out as a matrix, or as a list of points that fill a grid of their own.
    ///
    /// # Errors
    /// When the points fill no grid, or contradict the size that is given.
    pub fn of_array(&self, (array, head): (Array2<f64>, &Head), layout: Layout) -> Result<Measured, Mistake> {
        if let Some(channel) = &self.keys.channel {
            let message = ".channel: the file has numbers and no channels";
            return Err(Mistake::new(message, "leave channel out").at(channel.span()));
        }
        let dimension = self.dimension();
        let places = if array.ncols() == 3 {
            2
        } else {
            usize::from(dimension == Dimension::Line && array.ncols() == 2)
        };
        if array.columns().into_iter().take(places).flatten().any(|place| !place.is_finite())
            && array.nrows() > 3
        {
            return refuse("a point at a place that is no number", "leave such points out of the file");
        }
        let given = self.given_size()?.or(self.size_of_head(head, layout.rows));
        if (dimension, array.ncols()) == (Dimension::Line, 2)
            && array.nrows() > 3
            && points::own_cells(&array.view()).is_none()
        {
            return uneven(&array, given, layout);
        }
        if (dimension, array.ncols()) == (Dimension::Line, 3) {
            return refuse(
                "three columns, in a line contact",
                "a line scan has x and height, or heights alone",
            );
        }
        let states_size = head.width.is_some() && head.height.is_some();
        if points::is_list(&array, self.cells.count) && array.nrows() > 3 && !states_size {
            return self.listed(&array, given, layout);
        }
        let mut heights = laid_out(array, layout.rows);
        if (dimension, heights.nrows()) == (Dimension::Line, 1) {
            heights = turned(heights);
        }
        let heights = without_marks(heights).mapv(|height| height * layout.unit);
        Ok(Measured { heights, size: given, places: None, read_by: None })
    }

    /// Heights of points that fill a grid of their own.
    fn listed(
        &self,
        array: &Array2<f64>,
        given: Option<[f64; 2]>,
        layout: Layout,
    ) -> Result<Measured, Mistake> {
        let Some(own) = points::own_cells(&array.view()) else {
            return refuse(
                "points that fill no rectangular grid",
                "one point x, y, height for every place of the grid, in any order",
            );
        };
        let (heights, spacing) = points::on_cells(&array.view(), own)
            .map_err(|why| wrong(why, "each point within a tenth of the spacing"))?;
        let size = [0, 1].map(|axis| spacing[axis].or(spacing[0]).unwrap_or_default() * own[axis] as f64);
        let lie_on = (&size[self.dimension().axes()], format!("{size:?}"));
        let help = "size = side lengths of the scan says which";
        let unit = unit_of_places(lie_on, given, layout.unit_of_places, given.is_none().then_some(help))?;
        let heights = without_marks(heights).mapv(|height| height * layout.unit);
        Ok(Measured { heights, size: Some(size.map(|side| side * unit)), places: None, read_by: None })
    }

    /// The size that the case gives.
    fn given_size(&self) -> Result<Option<[f64; 2]>, Mistake> {
        let Some(given) = &self.keys.size else { return Ok(None) };
        let wrong =
            |message: &str, help: &str| Err(Mistake::new(format!(".size{message}"), help).at(given.span()));
        let size = match (given.value, self.dimension()) {
            (ScanSizeFile::Sides(sides), Dimension::Plane) => sides,
            (ScanSizeFile::Line(length), Dimension::Line) => [length; 2],
            (_, dimension) => {
                let help = match dimension {
                    Dimension::Plane => "size = [x, y]",
                    Dimension::Line => "size = length of the line scan",
                };
                return wrong(": of a surface two lengths, of a line scan one", help);
            }
        };
        if size.iter().all(|side| side.is_finite() && *side > 0.0) {
            return Ok(Some(size));
        }
        wrong(&format!(" = {size:?}: lengths must be positive and finite"), "")
    }
}

/// A line scan of points x, height that are not evenly spaced.
fn uneven(array: &Array2<f64>, given: Option<[f64; 2]>, layout: Layout) -> Result<Measured, Mistake> {
    let mut points: Vec<[f64; 2]> = array.rows().into_iter().map(|row| [row[0], row[1]]).collect();
    points.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let first = points[0][0];
    let range = points[points.len() - 1][0] - first;
    if points.windows(2).any(|pair| !(pair[1][0] > pair[0][0])) {
        return refuse("two points of the line scan lie at the same place", "one height for each x");
    }
    let help = "size = length of the line scan says which";
    let lie_on = (&[range][..], range.to_string());
    let factor = unit_of_places(lie_on, given, layout.unit_of_places, Some(help))?;
    let heights = Array2::from_shape_fn((points.len(), 1), |(point, _)| points[point][1]);
    Ok(Measured {
        heights: without_marks(heights).mapv(|height| height * layout.unit),
        size: Some([range * factor; 2]),
        places: Some(points.iter().map(|point| (point[0] - first) * factor).collect()),
        read_by: None,
    })
}

/// Length of one unit of coordinates that lie on these lengths: that of the case, or the `other` one, that of the heights, by the size that is
/// given; `either`: what helps where both will do.
fn unit_of_places(
    (own, shown): (&[f64], String),
    given: Option<[f64; 2]>,
    other: f64,
    either: Option<&str>,
) -> Result<f64, Mistake> {
    let fits = |unit: f64| {
        let is_side = |(own, given): (&f64, f64)| (own * unit / given - 1.0).abs() < SPACING;
        given.is_none_or(|given| own.iter().zip(given).all(is_side))
    };
    match (fits(1.0), fits(other), either) {
        (true, true, Some(help)) if other != 1.0 => refuse(
            "the coordinates of the points may be in the unit of the heights or in that of the case",
            help,
        ),
        (true, ..) => Ok(1.0),
        (false, true, _) => Ok(other),
        (false, false, _) => {
            let why = format!("size: the points lie on {shown}, in their own unit");
            refuse(why, "leave size out, or correct it")
        }
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
