//! The judgement of line contacts: what has no meaning in plane strain, and the depth that motions are relative to.

use std::ops::RangeInclusive;

use super::Stage;
use super::judge::Judge;
use super::known::Known;
use super::misfits::Misfit;
use crate::model::controls::TWIST;
use crate::model::stage::StageControl;
use crate::model::{Axis, ContactPair, Dimension, GridSize, Shape};

/// Depth of the datum in units of the size of the grid.
pub const DATUM: RangeInclusive<f64> = 1e-3..=1e12;

/// Rotations about z.
pub(super) const ROTATION: Misfit =
    Misfit { freedoms: TWIST..TWIST + 1, motions: false, in_table: "a twist" };

/// Refuses what a line contact has no place for: rotations, shapes that end or curve along the line, a second period.
pub(super) fn line(judge: &mut Judge, known: &Known<'_>) {
    let grid = &known.file.grid;
    if let Some(periodic) = grid.periodic.as_ref().filter(|periodic| !periodic.value.is_none()) {
        judge.refuse::<()>(
            periodic.span(),
            "grid.periodic in a line contact, which is not periodic",
            "cells = [n, 4] with periodic = true is a periodic line contact",
        );
    }
    let why = "in a line contact: its strips cannot turn about z";
    let help = "prescribe tangential_force or shift: [across the line, along it]";
    ROTATION.refuse(judge, known.loading(), why, help);
    let Some(profile) = known.profile else { return };
    let mut shapes = profile.shapes.iter();
    if let Some((name, help)) = shapes.find_map(of_a_surface) {
        judge.refuse::<()>(
            grid.cells.span(),
            format!("profile.{name} in a line contact: the bodies are the same all along y"),
            help,
        );
    } else if profile.is_straight_along(0) {
        judge.refuse::<()>(
            grid.cells.span(),
            "profile: without an end along x, in a line contact along y",
            "a cylinder with axis = \"y\" and a radius, a flat_punch, a rounded_punch, a cone (a wedge), a formula of x or heights",
        );
    }
}

/// The name of a shape that is not the same all along y, and what is.
fn of_a_surface(shape: &Shape) -> Option<(&'static str, &'static str)> {
    let cylinder = "[profile.cylinder] radius = ..., axis = \"y\", without a length";
    match shape {
        Shape::Sphere { .. } => Some(("sphere", cylinder)),
        Shape::Ellipsoid { .. } => Some(("ellipsoid", cylinder)),
        Shape::Cylinder { axis: Axis::X, .. } | Shape::Cylinder { length: Some(_), .. } => {
            Some(("cylinder, across y or with ends,", cylinder))
        }
        Shape::SpheroCone { .. } => {
            Some(("sphero_cone", "a cone, which is a wedge here, or a rounded_punch"))
        }
        Shape::WornSphere { .. } => Some(("worn_sphere", "a rounded_punch, flat within flat_radius along x")),
        Shape::Pyramid { .. } => Some(("pyramid", "a cone, which is a wedge here")),
        Shape::RectangularPunch { .. } => Some(("rectangular_punch", "a flat_punch or a rounded_punch")),
        Shape::CrownedRoller { .. } => Some(("crowned_roller", cylinder)),
        Shape::Formula(formula) if formula.depends_on(1) => {
            Some(("formula of y", "an expression of x alone"))
        }
        Shape::Wave { .. } => {
            Some(("wave", "a wave is periodic: cells = [n, 4], size = [x, y], periodic = true"))
        }
        _ => None,
    }
}

/// Refuses an approach, that is relative to a depth which follows from a size that follows from them.
pub(super) fn motion_without_datum(judge: &mut Judge, known: &Known<'_>) {
    let grid = &known.file.grid;
    let moves = |stage: &Stage| stage.normal.as_ref().is_some_and(StageControl::is_motion);
    let is_open = grid.datum.is_none() && known.size == Some(GridSize::Auto);
    let has_base = known.bodies.is_some_and(ContactPair::has_elastic_base);
    if is_open && has_base && known.stages.is_some_and(|stages| stages.iter().any(moves)) {
        judge.refuse::<()>(
            grid.size.span(),
            "grid.size = \"auto\" in a line contact with a prescribed approach and no datum: the approach is relative to a depth, which \
             would be the size",
            "datum = ..., or the size of the grid",
        );
    }
}

/// The depth that approach and shift are relative to; `None` where it follows from the size of the grid or has no meaning.
pub(super) fn datum(judge: &mut Judge, known: &Known<'_>) -> Option<f64> {
    let grid = &known.file.grid;
    let given = grid.datum.as_ref()?;
    let depth = given.value;
    let across = match grid.periodicity().one_axis() {
        _ if judge.dimension == Dimension::Line => Some(0),
        along => along.map(|along| 1 - along),
    };
    let Some(across) = across else {
        return judge.refuse(
            given.span(),
            "grid.datum: only a line contact needs one, or a case that is periodic along one axis; here nothing is relative to a depth",
            "cells = 512 makes a line contact",
        );
    };
    if known.bodies.is_some_and(|bodies| !bodies.has_elastic_base()) {
        return judge.refuse(
            given.span(),
            "grid.datum: no body has an elastic base, so that displacements have a zero of their own",
            "leave it out",
        );
    }
    let usable = match known.size {
        Some(GridSize::Given(sides)) => {
            let length = sides[across];
            (DATUM.start() * length..=DATUM.end() * length).contains(&depth)
        }
        _ => depth.is_finite() && depth > 0.0,
    };
    if usable {
        return Some(depth);
    }
    judge.refuse(
        given.span(),
        format!("grid.datum = {depth:?}: must lie between a thousandth and 1e12 of the size of the grid"),
        "the size of the grid serves when nothing else is known",
    )
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{ROLLER, read, refused};

    #[test]
    fn only_what_is_the_same_all_along_y_makes_a_line_contact() {
        let cylinder = "cylinder]\nradius = 100.0\naxis = \"y\"";
        for shape in [
            "rounded_punch]\nflat_radius = 1.0\nedge_radius = 1.0",
            "flat_punch]\nradius = 1.0",
            "cone]\nslope = 0.1",
        ] {
            assert_eq!(read(ROLLER, &[(cylinder, shape)]).profile.shapes.len(), 1);
        }
        for (shape, words) in [
            ("sphere]\nradius = 100.0", "profile.sphere in a line contact"),
            ("ellipsoid]\nradius_x = 100.0\nradius_y = 10.0", "profile.ellipsoid in a line contact"),
            ("cylinder]\nradius = 100.0\naxis = \"x\"", "profile.cylinder, across y or with ends,"),
            (
                "cylinder]\nradius = 100.0\naxis = \"y\"\nlength = 1.0",
                "profile.cylinder, across y or with ends,",
            ),
            ("wave]\namplitude = 0.1\nwavelength_x = 1.0", "profile.wave in a line contact"),
        ] {
            refused(ROLLER, &[(cylinder, shape)], words, "16");
        }
        // two cylinders that leave a gap of the same height everywhere
        let flat = (
            "[profile.cylinder]\nradius = 100.0",
            "[lower.profile.cylinder]\nradius = -100.0\naxis = \"y\"\n[upper.profile.cylinder]\nradius = 100.0",
        );
        assert!(crate::case::Case::from_toml(&ROLLER.replacen(flat.0, flat.1, 1), "case.toml").is_err());
    }

    #[test]
    fn a_datum_lies_between_a_thousandth_and_a_million_million_sizes() {
        let datum = |depth: &str| format!("size = 4.0\ndatum = {depth}");
        for depth in [4e-3, 4.0, 4e12] {
            assert_eq!(read(ROLLER, &[("size = 3.0", &datum(&format!("{depth:e}")))]).datum, Some(depth));
        }
        assert_eq!(read(ROLLER, &[]).datum, None);
        for depth in ["3.9e-3", "4.1e12", "-4.0", "0.0", "nan", "inf"] {
            refused(ROLLER, &[("size = 3.0", &datum(depth))], "a thousandth and 1e12 of the size", depth);
        }
        // with a size left to the program any depth
        let auto = |depth: &str| format!("size = \"auto\"\ndatum = {depth}");
        assert_eq!(read(ROLLER, &[("size = 3.0", &auto("1e-9"))]).datum, Some(1e-9));
        for depth in ["0.0", "-1.0", "inf", "nan"] {
            refused(ROLLER, &[("size = 3.0", &auto(depth))], "grid.datum", depth);
        }
    }

    #[test]
    fn a_datum_has_a_meaning_only_where_the_bodies_have_no_other_zero() {
        let surface = "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\ndatum = 1.5";
        let ball = ROLLER.replacen("[grid]\ncells = 16\nsize = 3.0", surface, 1).replacen(
            "cylinder]\nradius = 100.0\naxis = \"y\"",
            "sphere]\nradius = 100.0",
            1,
        );
        refused(&ball, &[], "only a line contact needs one", "1.5");
        let rigid_base = "coatings = [{ thickness = 1.0, young = 1.0, poisson = 0.3 }]\nbase = \"rigid\"";
        let layer = ROLLER.replacen("substrate = { young = 1.0, poisson = 0.3 }", rigid_base, 1);
        refused(
            &layer,
            &[("size = 3.0", "size = 3.0\ndatum = 1.5")],
            "displacements have a zero of their own",
            "1.5",
        );
        // an approach needs the depth, which must not follow from the contact that it makes
        let pushed = ("normal_force = 0.01", "approach = 0.01");
        let words = "a prescribed approach and no datum";
        refused(ROLLER, &[pushed, ("size = 3.0", "size = \"auto\"")], words, "\"auto\"");
        read(ROLLER, &[pushed]);
        read(ROLLER, &[("size = 3.0", "size = \"auto\"")]);
        read(ROLLER, &[pushed, ("size = 3.0", "size = \"auto\"\ndatum = 1.5")]);
        read(&layer, &[pushed, ("size = 3.0", "size = \"auto\"")]);
    }

    #[test]
    fn strips_do_not_turn_and_do_not_repeat() {
        let stage = |words: &str| format!("increments = 1\n[[load]]\nincrements = 1\n{words}");
        refused(ROLLER, &[("increments = 1", &stage("twist = 0.125"))], "twist in a line contact", "0.125");
        refused(
            ROLLER,
            &[("increments = 1", &stage("twist_moment = 0.125"))],
            "twist_moment in a line contact",
            "0.125",
        );
        refused(ROLLER, &[("size = 3.0", "size = 3.0\nperiodic = true")], "which is not periodic", "true");
        refused(ROLLER, &[("size = 3.0", "size = 3.0\nperiodic = \"y\"")], "which is not periodic", "\"y\"");
        assert!(read(ROLLER, &[("size = 3.0", "size = 3.0\nperiodic = false")]).periodic.is_none());
    }
}
