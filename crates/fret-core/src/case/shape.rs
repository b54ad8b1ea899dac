//! The judgement of the profiles: of the gap, and of each body.

use std::ops::Range;

use super::arrays;
use super::file::CaseFile;
use super::formula::formula;
use super::judge::Judge;
use super::surface_file::{
    CrownedRollerFile, CylinderFile, EllipsoidFile, HeightsFile, IndenterFile, LENGTH, OfFile, ProfileFile,
    PyramidFile, RectangularPunchFile, RoundedPunchFile, SphereFile, SpheroConeFile, WaveFile,
    WornSphereFile,
};
use crate::document::{At, Mistake};
use crate::heights::marks::hole;
use crate::model::{Axis, Detrend, Heights, Profile, ProfileError, Shape};
use crate::numbers::{Head, NumbersError};
use crate::topography::{self, Cells, Content, FILL, Question, Treated, fitting};

/// The gap, as the sum of all profiles of a case; `None` when something about them was refused.
pub(super) fn profile(judge: &mut Judge, file: &CaseFile, cells: Option<Cells>) -> Option<Profile> {
    let places = [
        ("profile", &file.profile),
        ("upper.profile", &file.upper.value.profile),
        ("lower.profile", &file.lower.value.profile),
    ];
    let before = judge.mistakes.len();
    let mut sum = Profile::default();
    // A surface that repeats is asked for inside of its period alone.
    let moves = judge.moves && !file.grid.periodicity().is_both();
    for (place, given) in places {
        if let Some(given) = given {
            let before = sum.shapes.len();
            Part { judge, place, cells, moves, before, sum: &mut sum }.judge(given);
        }
        if place == "upper.profile" {
            sum.of_upper = [sum.shapes.len(), sum.heights.len()];
        }
    }
    let are_whole = places.iter().all(|(place, _)| judge.places.are_whole_in(place));
    if judge.mistakes.len() > before || cells.is_none() || !are_whole {
        return None;
    }
    let Some(first) = places.iter().find_map(|(_, given)| given.as_ref()) else {
        return judge.refuse(
            file.lower.span(),
            "profile: nothing says what shape the bodies have",
            "[profile.sphere] radius = ..., or a profile of one of the bodies: [upper.profile.sphere]",
        );
    };
    let [x, y] = sum.curvatures();
    let hollow = sum.shapes.iter().filter_map(Shape::curvatures).flatten().any(|curvature| curvature < 0.0);
    if hollow && !(x >= 0.0 && y >= 0.0 && x + y > 0.0) {
        return judge.refuse(
            first.span(),
            format!("profile: the gap curves by {x:e} along x and {y:e} along y: it must open away from the middle"),
            "a hollow must be wider than the body that lies in it",
        );
    }
    Some(sum)
}

/// Shapes whose numbers each say all, in the order of their keys.
fn whole_shapes(given: &ProfileFile) -> Vec<Shape> {
    let mut shapes = Vec::new();
    if let Some(punch) = &given.rounded_punch {
        let RoundedPunchFile { flat_radius, edge_radius } = punch.value;
        shapes.push(Shape::RoundedPunch { flat_radius, edge_radius });
    }
    shapes.extend(given.flat_punch.as_ref().map(|punch| Shape::FlatPunch { radius: punch.value.radius }));
    shapes.extend(given.cone.as_ref().map(|cone| Shape::Cone { slope: cone.value.slope }));
    if let Some(cone) = &given.sphero_cone {
        let SpheroConeFile { radius, slope } = cone.value;
        shapes.push(Shape::SpheroCone { radius, slope });
    }
    if let Some(sphere) = &given.worn_sphere {
        let WornSphereFile { radius, flat_radius } = sphere.value;
        shapes.push(Shape::WornSphere { radius, flat_radius });
    }
    shapes.extend(given.pyramid.as_ref().map(|pyramid| indenter(pyramid.value)));
    if let Some(punch) = &given.rectangular_punch {
        let RectangularPunchFile { length_x, length_y, edge_radius } = punch.value;
        shapes.push(Shape::RectangularPunch { lengths: [length_x, length_y], edge_radius });
    }
    if let Some(roller) = &given.crowned_roller {
        let CrownedRollerFile { radius, axis, length, crown_radius, flat_length } = roller.value;
        let flat_length = flat_length.unwrap_or(0.0);
        shapes.push(Shape::CrownedRoller { radius, axis, length, flat_length, crown_radius });
    }
    shapes
}

/// An indenter by its sides and their angle with its axis (ISO 14577-2).
fn indenter(given: PyramidFile) -> Shape {
    let (sides, angle) = match given.indenter {
        IndenterFile::Berkovich => (3, 65.27),
        IndenterFile::Vickers => (4, 68.0),
        IndenterFile::CubeCorner => (3, 35.264),
    };
    Shape::Pyramid { sides, slope: given.half_angle.unwrap_or(angle).to_radians().tan().recip() }
}

/// One profile table while it is judged.
struct Part<'a, 'b> {
    judge: &'a mut Judge<'b>,
    place: &'static str,
    cells: Option<Cells>,
    /// Whether the upper body may come to lie anywhere around the grid.
    moves: bool,
    /// Shapes of other profiles in the sum.
    before: usize,
    sum: &'a mut Profile,
}

impl Part<'_, '_> {
    fn judge(&mut self, given: &At<ProfileFile>) {
        let ProfileFile { sphere, ellipsoid, cylinder, wave, formula: by_formula, heights, .. } =
            &given.value;
        if let Some(SphereFile { radius }) = sphere.as_deref() {
            let shape = Shape::Sphere { radius: radius.value };
            self.curved("sphere", shape, &[("radius", radius)]);
        }
        if let Some(EllipsoidFile { radius_x, radius_y }) = ellipsoid.as_deref() {
            let shape = Shape::Ellipsoid { radius_x: radius_x.value, radius_y: radius_y.value };
            self.curved("ellipsoid", shape, &[("radius_x", radius_x), ("radius_y", radius_y)]);
        }
        if let Some(CylinderFile { radius, axis, length }) = cylinder.as_deref() {
            let shape = Shape::Cylinder { radius: radius.value, axis: *axis, length: *length };
            self.curved("cylinder", shape, &[("radius", radius)]);
        }
        self.sum.shapes.extend(whole_shapes(&given.value));
        if let Some(wave) = wave {
            let WaveFile { amplitude, wavelength_x, wavelength_y } = wave.value;
            self.sum.shapes.push(Shape::Wave { amplitude, wavelengths: [wavelength_x, wavelength_y] });
            if wavelength_x.or(wavelength_y).is_none() {
                self.judge.refuse::<()>(
                    wave.span(),
                    format!("{}.wave: neither wavelength_x nor wavelength_y", self.place),
                    "a wave needs a length along at least one axis",
                );
            }
        }
        if let Some(given) = by_formula {
            let place = format!("{}.formula", self.place);
            let moves = self.moves && self.place != "lower.profile";
            let judged = formula(self.judge, &place, given, self.cells, moves);
            self.sum.shapes.extend(judged);
        }
        if let Some(heights) = heights {
            let judged = self.heights(heights.span(), heights);
            self.sum.heights.extend(judged);
        } else if self.sum.shapes.len() == self.before && by_formula.is_none() {
            self.judge.refuse::<()>(
                given.span(),
                format!("{}: empty", self.place),
                "shapes are: sphere, ellipsoid, cylinder, rounded_punch, flat_punch, cone, sphero_cone, worn_sphere, pyramid, rectangular_punch, crowned_roller, wave, formula, heights",
            );
        }
    }

    /// Adds a paraboloid, whose radii are positive; in a body's own profile it may be a hollow.
    fn curved(&mut self, name: &str, shape: Shape, radii: &[(&str, &At<f64>)]) {
        let is_gap = self.place == "profile";
        self.sum.shapes.push(shape.clone());
        if matches!(shape, Shape::Cylinder { length: Some(_), .. }) || is_gap {
            for (key, radius) in radii.iter().filter(|(_, radius)| !LENGTH.holds(radius.value)) {
                let message = format!("{}.{name}.{key} = {:?}: {}", self.place, radius.value, LENGTH.words);
                self.judge.refuse::<()>(radius.span(), message, "");
            }
        } else if let Err(error) = shape.checked() {
            self.judge.refuse::<()>(
                radii[0].1.span(),
                format!("{}.{name}: {error}", self.place),
                "positive for a body that bulges, negative for a hollow",
            );
        }
    }

    fn heights(&mut self, span: Range<usize>, given: &HeightsFile) -> Option<Heights> {
        let place = format!("{}.heights", self.place);
        let of_gap = given.of.as_ref().filter(|of| of.value == OfFile::Gap);
        if let Some(of) = of_gap.filter(|_| self.place != "profile") {
            return self.judge.refuse(
                of.span(),
                format!("{place}.of = \"gap\": a body has a surface, a gap lies between two"),
                "of = \"surface\", or [profile.heights]",
            );
        }
        let cells = self.cells.filter(|_| self.judge.places.are_whole_in(&place))?;
        let keys = &given.treatment;
        let (source, at, content) = match (&given.file, &given.values) {
            (Some(file), None) => {
                let (key, name) = (format!("{place}.file"), file.value.as_str());
                let bytes = self.judge.attached((&key, file.span()), name, NumbersError::A_FILE)?;
                let content = topography::content((name, &bytes), keys, self.judge.attachments.scan);
                let content = self.judge.take(&format!("{key} = {name:?}: "), file.span(), content)?;
                (name, file.span(), content)
            }
            (None, Some(values)) => {
                let key = format!("{place}.values");
                let array = arrays::given(self.judge, &key, values.span(), &values.value)?;
                ("values", values.span(), Content::Numbers(array, Head::default()))
            }
            (Some(_), Some(values)) => {
                return self.judge.both(values.span(), &format!("{place}: file and values"));
            }
            (None, None) => {
                return self.judge.refuse(
                    span,
                    format!("{place}: no heights"),
                    "file = \"surface.npy\", or values = rows of numbers",
                );
            }
        };
        let units = self.judge.units.clone();
        let question = Question { keys, cells, units: units.as_ref() };
        let heights = judged(&question, given, content, (source, of_gap.is_some()));
        self.judge.take(&place, at, heights)
    }
}

/// Heights for the cells, from what a file or the case holds; those of a gap with the opposite sign.
fn judged(
    question: &Question<'_>,
    given: &HeightsFile,
    content: Content,
    (source, is_gap): (&str, bool),
) -> Result<Heights, Mistake> {
    let sign = if is_gap { -1.0 } else { 1.0 };
    let detrend = given.detrend.unwrap_or(Detrend::None);
    let measured = match content {
        Content::Numbers(array, head) => {
            let rows = given.rows.unwrap_or(Axis::X);
            let (array, layout) = question.with_unit(array, (rows, given.unit, &head))?;
            if !question.keys.is_asked() {
                let mut array = fitting(question.cells, array, layout)?;
                if let Some((cell, mark, [low, high])) = hole(&array) {
                    let message = format!(
                        ": height {cell:?} is {mark:?}, and all others lie between {low:?} and {high:?}: a cell without a measurement"
                    );
                    return Err(Mistake::new(message, FILL));
                }
                array.mapv_inplace(|height| sign * layout.unit * height);
                return accepted(Heights::new(source, array, detrend));
            }
            question.of_array((array, &head), layout)?
        }
        Content::Scan(scan) => question.of_scan(scan, given.unit, given.rows.is_some())?,
    };
    let (treated, record) = question.treated(measured, detrend)?;
    let heights = match treated {
        Treated::Cells(heights) => Heights::new(source, sign * heights, Detrend::None),
        Treated::Surface(mut surface) => {
            surface.heights *= sign;
            Heights::resampled(source, surface, question.cells.count)
        }
    };
    Ok(accepted(heights)?.treated(record))
}

fn accepted(heights: Result<Heights, ProfileError>) -> Result<Heights, Mistake> {
    heights.map_err(|error| Mistake::new(format!(": {error}"), FILL))
}

#[cfg(test)]
mod tests;
