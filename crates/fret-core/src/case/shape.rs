//! The judgement of the profiles: of the gap, and of each body.

use std::ops::Range;

use toml::Spanned;

use super::arrays::{self, Cells, Layout};
use super::file::CaseFile;
use super::holes::hole;
use super::judge::Judge;
use super::numbers;
use super::surface_file::{AxisFile, DetrendFile, HeightsFile, OfFile, ProfileFile, WaveFile};
use crate::model::{Axis, Detrend, Heights, Profile, Shape};

/// The gap, as the sum of all profiles of a case; `None` when something about them was refused.
pub(super) fn profile(judge: &mut Judge, file: &CaseFile, cells: Option<Cells>) -> Option<Profile> {
    let places = [
        ("profile", &file.profile),
        ("upper.profile", &file.upper.get_ref().profile),
        ("lower.profile", &file.lower.get_ref().profile),
    ];
    let before = judge.mistakes.len();
    let mut sum = Profile::default();
    for (place, given) in places {
        if let Some(given) = given {
            Part { judge, place, cells, sum: &mut sum }.judge(given);
        }
    }
    if judge.mistakes.len() > before || cells.is_none() {
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

/// One profile table while it is judged.
struct Part<'a, 'b> {
    judge: &'a mut Judge<'b>,
    place: &'static str,
    cells: Option<Cells>,
    sum: &'a mut Profile,
}

impl Part<'_, '_> {
    fn judge(&mut self, given: &Spanned<ProfileFile>) {
        let ProfileFile { sphere, ellipsoid, cylinder, rounded_punch, flat_punch, cone, wave, heights } =
            given.get_ref();
        let number = |value: &Spanned<f64>| *value.get_ref();
        let mut count = 0;
        if let Some(sphere) = sphere.as_ref().map(Spanned::get_ref) {
            count += 1;
            let shape = Shape::Sphere { radius: number(&sphere.radius) };
            self.curved("sphere", shape, &[("radius", &sphere.radius)]);
        }
        if let Some(ellipsoid) = ellipsoid.as_ref().map(Spanned::get_ref) {
            count += 1;
            let (radius_x, radius_y) = (&ellipsoid.radius_x, &ellipsoid.radius_y);
            let shape = Shape::Ellipsoid { radius_x: number(radius_x), radius_y: number(radius_y) };
            self.curved("ellipsoid", shape, &[("radius_x", radius_x), ("radius_y", radius_y)]);
        }
        if let Some(cylinder) = cylinder.as_ref().map(Spanned::get_ref) {
            count += 1;
            let axis = match cylinder.axis {
                AxisFile::X => Axis::X,
                AxisFile::Y => Axis::Y,
            };
            let length = cylinder.length.as_ref();
            let shape =
                Shape::Cylinder { radius: number(&cylinder.radius), axis, length: length.map(number) };
            let lengths: Vec<_> = length.map(|length| ("length", length)).into_iter().collect();
            if self.positive("cylinder", &lengths) {
                if length.is_some() {
                    self.add("cylinder", shape, &[("radius", &cylinder.radius)]);
                } else {
                    self.curved("cylinder", shape, &[("radius", &cylinder.radius)]);
                }
            }
        }
        if let Some(punch) = rounded_punch.as_ref().map(Spanned::get_ref) {
            count += 1;
            let (flat, edge) = (&punch.flat_radius, &punch.edge_radius);
            let shape = Shape::RoundedPunch { flat_radius: number(flat), edge_radius: number(edge) };
            self.add("rounded_punch", shape, &[("flat_radius", flat), ("edge_radius", edge)]);
        }
        if let Some(punch) = flat_punch.as_ref().map(Spanned::get_ref) {
            count += 1;
            let shape = Shape::FlatPunch { radius: number(&punch.radius) };
            self.add("flat_punch", shape, &[("radius", &punch.radius)]);
        }
        if let Some(cone) = cone.as_ref().map(Spanned::get_ref) {
            count += 1;
            let shape = Shape::Cone { slope: number(&cone.slope) };
            self.add("cone", shape, &[("slope", &cone.slope)]);
        }
        if let Some(wave) = wave {
            count += 1;
            self.wave(wave.span(), wave.get_ref());
        }
        if let Some(heights) = heights {
            count += 1;
            let judged = self.heights(heights.span(), heights.get_ref());
            self.sum.heights.extend(judged);
        }
        if count == 0 {
            self.judge.refuse::<()>(
                given.span(),
                format!("{}: empty", self.place),
                "shapes are: sphere, ellipsoid, cylinder, rounded_punch, flat_punch, cone, wave, heights",
            );
        }
    }

    /// Adds a shape whose lengths are all positive.
    fn add(&mut self, name: &str, shape: Shape, lengths: &[(&str, &Spanned<f64>)]) {
        if self.positive(name, lengths) {
            self.sum.shapes.push(shape);
        }
    }

    /// Adds a paraboloid: in a body's own profile it may be a hollow.
    fn curved(&mut self, name: &str, shape: Shape, radii: &[(&str, &Spanned<f64>)]) {
        if self.place == "profile" {
            self.add(name, shape, radii);
        } else if let Err(error) = shape.checked() {
            let span = radii[0].1.span();
            self.judge.refuse::<()>(
                span,
                format!("{}.{name}: {error}", self.place),
                "positive for a body that bulges, negative for a hollow",
            );
        } else {
            self.sum.shapes.push(shape);
        }
    }

    /// Refuses every length that is not positive and finite.
    fn positive(&mut self, shape: &str, lengths: &[(&str, &Spanned<f64>)]) -> bool {
        let mut good = true;
        for (name, given) in lengths {
            let value = *given.get_ref();
            if !(value.is_finite() && value > 0.0) {
                good = false;
                let kind = if *name == "slope" { "number" } else { "length" };
                let message =
                    format!("{}.{shape}.{name} = {value:?}: must be a positive finite {kind}", self.place);
                self.judge.refuse::<()>(given.span(), message, "");
            }
        }
        good
    }

    fn wave(&mut self, span: Range<usize>, wave: &WaveFile) {
        let mut lengths = vec![("amplitude", &wave.amplitude)];
        lengths.extend(wave.wavelength_x.as_ref().map(|length| ("wavelength_x", length)));
        lengths.extend(wave.wavelength_y.as_ref().map(|length| ("wavelength_y", length)));
        if lengths.len() == 1 {
            self.judge.refuse::<()>(
                span,
                format!("{}.wave: neither wavelength_x nor wavelength_y", self.place),
                "a wave needs a length along at least one axis",
            );
            return;
        }
        let length = |value: &Option<Spanned<f64>>| value.as_ref().map(|value| *value.get_ref());
        let shape = Shape::Wave {
            amplitude: *wave.amplitude.get_ref(),
            wavelengths: [length(&wave.wavelength_x), length(&wave.wavelength_y)],
        };
        self.add("wave", shape, &lengths);
    }

    fn heights(&mut self, span: Range<usize>, given: &HeightsFile) -> Option<Heights> {
        let place = format!("{}.heights", self.place);
        let of_gap = given.of.as_ref().filter(|of| *of.get_ref() == OfFile::Gap);
        if let Some(of) = of_gap.filter(|_| self.place != "profile") {
            return self.judge.refuse(
                of.span(),
                format!("{place}.of = \"gap\": a body has a surface, a gap lies between two"),
                "of = \"surface\", or [profile.heights]",
            );
        }
        let unit = match &given.unit {
            None => 1.0,
            Some(unit) => {
                if !self.positive("heights", &[("unit", unit)]) {
                    return None;
                }
                *unit.get_ref()
            }
        };
        self.cells?;
        let (source, at, array) = match (&given.file, &given.values) {
            (Some(file), None) => {
                let key = format!("{place}.file");
                (
                    file.get_ref().as_str(),
                    file.span(),
                    arrays::of_file(self.judge, &key, file.span(), file.get_ref())?,
                )
            }
            (None, Some(values)) => {
                let key = format!("{place}.values");
                ("values", values.span(), arrays::given(self.judge, &key, values.span(), values.get_ref())?)
            }
            (Some(_), Some(values)) => {
                return self.judge.refuse(
                    values.span(),
                    format!("{place}: file and values, both at once"),
                    "leave out one of the two",
                );
            }
            (None, None) => {
                return self.judge.refuse(
                    span,
                    format!("{place}: no heights"),
                    "file = \"surface.npy\", or values = rows of numbers",
                );
            }
        };
        let layout = Layout { rows: given.rows.unwrap_or(AxisFile::X), unit };
        let mut array = arrays::fitting(self.judge, self.cells, (&place, at.clone()), array, layout)?;
        if let Some((cell, mark, [low, high])) = hole(&array) {
            return self.judge.refuse(
                at,
                format!(
                    "{place}: height {cell:?} is {mark:?}, and all others lie between {low:?} and {high:?}: a cell without a measurement"
                ),
                numbers::HOLES,
            );
        }
        let sign = if of_gap.is_some() { -1.0 } else { 1.0 };
        array.mapv_inplace(|height| sign * unit * height);
        let detrend = match given.detrend {
            None | Some(DetrendFile::None) => Detrend::None,
            Some(DetrendFile::Mean) => Detrend::Mean,
            Some(DetrendFile::Plane) => Detrend::Plane,
        };
        match Heights::new(source, array, detrend) {
            Ok(heights) => Some(heights),
            Err(error) => self.judge.refuse(at, format!("{place}: {error}"), numbers::HOLES),
        }
    }
}

#[cfg(test)]
mod tests;
