//! The judgement of scenes that repeat in x and y.

use super::file::GridFile;
use super::judge::Judge;
use super::known::Known;
use super::line::ROTATION;
use super::misfits::Misfit;
use crate::kernel::uniform_response;
use crate::model::controls::{NORMAL, TANGENTIAL, TWIST};
use crate::model::{Dimension, GridSize, Profile, Shape};

/// Cells per wave from which on a wave is resolved; fewer are warned of.
pub const CELLS_PER_WAVE: f64 = 6.0;

/// Motions that a uniform traction does not make of layers, normal and tangential; half-spaces have no approach, but mean planes that shift
/// against each other.
const MOTIONS: [Misfit; 2] = [
    Misfit { freedoms: NORMAL..NORMAL + 1, motions: true, in_table: "an approach" },
    Misfit { freedoms: TANGENTIAL..TWIST, motions: true, in_table: "a shift" },
];

/// Refuses what has no meaning where a scene repeats, and what needs that it does.
pub(super) fn repeats(judge: &mut Judge, known: &Known<'_>) {
    let (grid, loading, periodic) = (&known.file.grid, known.loading(), known.periodic());
    if known.dimension == Dimension::Line {
        return;
    }
    if let Some(profile) = known.profile {
        endless(judge, grid, profile);
    }
    if periodic.is_none() {
        return;
    }
    match (known.size, known.profile) {
        (Some(GridSize::Auto), _) => {
            judge.refuse::<()>(
                grid.size.span(),
                "grid.size = \"auto\" in a periodic case: the period must be given",
                "size = [x, y]",
            );
        }
        (Some(GridSize::Given(sides)), Some(profile)) => {
            for shape in &profile.shapes {
                if let Shape::Wave { wavelengths, .. } = shape {
                    whole_waves(judge, (grid, known.cells), sides, wavelengths);
                }
            }
        }
        _ => {}
    }
    let forces = "prescribe normal_force and tangential_force, those of one period";
    ROTATION.refuse(judge, loading, "in a periodic case: a rotation is not periodic", forces);
    if !periodic.is_both() {
        return;
    }
    let uniform = known.bodies.map(uniform_response);
    for (axis, motions) in MOTIONS.iter().enumerate() {
        let why = match uniform {
            Some(None) if axis == 0 => "a half-space under a periodic load has no such rigid motion",
            Some(Some(response)) if response[axis] == 0.0 => {
                "layers that keep their volume do not give way to a uniform pressure"
            }
            _ => continue,
        };
        let why = format!("in a periodic case: {why}");
        let or = if uniform == Some(None) { "mean_gap; " } else { "" };
        motions.refuse(judge, loading, &why, &format!("{forces}; or {or}for layers, base = \"rigid\""));
    }
}

/// Refuses what has no end along an axis along which nothing repeats.
fn endless(judge: &mut Judge, grid: &GridFile, profile: &Profile) {
    let axes = grid.periodicity().axes();
    let waves_on = |shape: &Shape, axis: usize| match shape {
        Shape::Wave { wavelengths, .. } => !axes[axis] && (wavelengths[axis].is_some() || axes == [false; 2]),
        _ => false,
    };
    if (0..2).any(|axis| profile.shapes.iter().any(|shape| waves_on(shape, axis))) {
        judge.refuse::<()>(
            grid.cells.span(),
            "profile.wave: a wave is periodic, the case is not",
            "grid.periodic = true; a formula or heights where surfaces are wavy and do not repeat",
        );
        return;
    }
    for (axis, name) in ["x", "y"].into_iter().enumerate().filter(|(axis, _)| !axes[*axis]) {
        let ends = grid.beyond.as_ref().is_some_and(|beyond| !beyond.value.is_body());
        if profile.is_straight_along(axis) && !ends {
            judge.refuse::<()>(
                grid.cells.span(),
                format!("profile: infinite along {name}, in a non-periodic case"),
                &format!(
                    "a cylinder's length = ..., grid.beyond = \"no body\" where it ends at the edge of the grid, or grid.periodic = \"{name}\""
                ),
            );
        }
    }
}

/// Refuses waves that do not fit into the period, and those of which the cells show another one: of two cells a wave and less.
fn whole_waves(
    judge: &mut Judge,
    (grid, cells): (&GridFile, Option<[usize; 2]>),
    sides: [f64; 2],
    wavelengths: &[Option<f64>; 2],
) {
    for (axis, (side, wavelength)) in sides.into_iter().zip(wavelengths).enumerate() {
        let Some(wavelength) = wavelength else { continue };
        let waves = side / wavelength;
        if (waves - waves.round()).abs() > 1e-9 * waves || waves.round() < 1.0 {
            judge.refuse::<()>(
                grid.size.span(),
                format!("grid.size: {side:?} holds {waves:.6} waves of length {wavelength:?}"),
                "a periodic case must contain whole wavelengths",
            );
            continue;
        }
        let Some(cells) = cells.map(|cells| cells[axis]) else { continue };
        if cells as f64 <= 2.0 * waves.round() {
            let along = ["x", "y"][axis];
            judge.refuse::<()>(
                grid.cells.span(),
                format!(
                    "grid.cells: {cells} along {along} for {} waves of profile.wave, {} per wave: the cells show another surface",
                    waves.round(),
                    cells as f64 / waves.round()
                ),
                &format!(
                    "more than two cells per wave; from {CELLS_PER_WAVE} on, {} cells along {along} here, the wave is resolved",
                    CELLS_PER_WAVE * waves.round()
                ),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{BALL, read, refused};

    const WAVE: (&str, &str) = (
        "[profile.sphere]\nradius = 100.0",
        "[profile.wave]\namplitude = 0.01\nwavelength_x = 1.5\nwavelength_y = 3.0",
    );
    const PERIODIC: (&str, &str) = ("size = [3.0, 3.0]", "size = [3.0, 3.0]\nperiodic = true");

    #[test]
    fn a_period_holds_whole_waves() {
        assert!(read(BALL, &[PERIODIC, WAVE]).periodic.is_both());
        assert!(read(BALL, &[]).periodic.is_none());
        // lengths along x and y that are not in 3 a whole number of times
        for (length, other, waves) in [
            ("1.5", "1.4999977500033748", "2.000003"),
            ("3.0", "2.0", "1.500000"),
            ("3.0", "2.4", "1.250000"),
        ] {
            let wrong = WAVE.1.replacen(length, other, 1);
            refused(BALL, &[PERIODIC, (WAVE.0, &wrong)], &format!("holds {waves} waves"), "[3.0, 3.0]");
        }
        // not even one
        refused(
            BALL,
            &[PERIODIC, (WAVE.0, &WAVE.1.replacen("3.0", "1e12", 1))],
            "holds 0.000000 waves",
            "[3.0, 3.0]",
        );
        // to rounding: a tenth has no last digit
        let tenth = WAVE.1.replacen("1.5", "0.1", 1);
        let fine = ("[16, 32]", "[16384, 4]");
        let coarse_y = |wave: &str| wave.replacen("wavelength_y = 3.0", "", 1);
        read(BALL, &[PERIODIC, fine, (WAVE.0, &coarse_y(&tenth))]);
        // to 1e-9 of all of them: 3000 waves, of which 6e-7 and 6e-6 are missing
        let many = |length: &str| coarse_y(&WAVE.1.replacen("1.5", length, 1));
        read(BALL, &[PERIODIC, fine, (WAVE.0, &many("0.0010000000002"))]);
        refused(
            BALL,
            &[PERIODIC, fine, (WAVE.0, &many("0.001000000002"))],
            "holds 2999.999994 waves",
            "[3.0, 3.0]",
        );
        refused(BALL, &[PERIODIC, ("[3.0, 3.0]", "\"auto\"")], "the period must be given", "\"auto\"");
    }

    /// What repeats along one axis has no end there alone, may end along the other, has an approach, and a datum.
    #[test]
    fn one_axis_alone_may_repeat() {
        let along = |axis: &str| format!("size = [3.0, 3.0]\nperiodic = \"{axis}\"");
        let (x, y) = (along("x"), along("y"));
        let [x, y] = [("size = [3.0, 3.0]", &x[..]), ("size = [3.0, 3.0]", &y[..])];
        assert_eq!(read(BALL, &[x]).periodic.axes(), [true, false]);
        let case = read(BALL, &[y]);
        assert_eq!((case.periodic.one_axis(), case.endless_axis()), (Some(1), Some(1)));
        assert!(!case.counts_mean_gap());
        refused(BALL, &[("size = [3.0, 3.0]", &along("z"))], "true, false, \"x\" or \"y\"", "\"z\"");
        // waves along it, and not across it
        let waves = WAVE.1.replacen("wavelength_x = 1.5\n", "", 1);
        read(BALL, &[y, ("radius = 100.0", &format!("radius = 100.0\n{waves}"))]);
        refused(
            BALL,
            &[y, ("radius = 100.0", &format!("radius = 100.0\n{}", WAVE.1))],
            "a wave is periodic",
            "[16, 32]",
        );
        let cylinder = |axis: &str| format!("[profile.cylinder]\naxis = \"{axis}\"\nradius = 100.0");
        let sphere = "[profile.sphere]\nradius = 100.0";
        read(BALL, &[y, (sphere, &cylinder("y"))]);
        refused(BALL, &[y, (sphere, &cylinder("x"))], "infinite along x", "[16, 32]");
        let ends = format!("{}\nbeyond = \"no body\"", y.1);
        read(BALL, &[(y.0, &ends), (sphere, &cylinder("x"))]);
        let datum = format!("{}\ndatum = 9.0", x.1);
        assert_eq!(read(BALL, &[(x.0, &datum)]).datum, Some(9.0));
        refused(BALL, &[(x.0, &format!("{}\ndatum = 1e-9", x.1))], "between a thousandth and 1e12", "1e-9");
        let stage = |words: &str| format!("increments = 1\n[[load]]\n{words}\nincrements = 1");
        read(BALL, &[y, ("increments = 1", &stage("approach = 0.1\nshift = [0.1, 0.0]"))]);
        for (words, why, place) in [
            ("twist = 0.125", "a rotation is not periodic", "0.125"),
            ("mean_gap = 0.125", "do not repeat", "0.125"),
            ("tilt = [0.125, 0.0]", "neither a strain nor a tilt", "[0.125, 0.0]"),
        ] {
            refused(BALL, &[y, ("increments = 1", &stage(words))], why, place);
        }
        refused(
            BALL,
            &[("size = [3.0, 3.0]", "size = \"auto\"\nperiodic = \"y\"")],
            "the period must be given",
            "\"auto\"",
        );
        let finite = ("[friction]\n", "[kinematics]\ndisplacement = \"finite\"\n[friction]\n");
        refused(BALL, &[y, finite], "grid.periodic along one axis", "\"y\"");
    }

    /// 16 cells along x, 32 along y: of two cells per wave and less the centres show a longer wave, or none.
    #[test]
    fn a_wave_needs_more_than_two_cells() {
        let wave = |length: f64| WAVE.1.replacen("1.5", &format!("{length:?}"), 1);
        for waves in [8.0, 16.0, 15.0, 17.0] {
            let words = format!("16 along x for {waves} waves of profile.wave, {} per wave", 16.0 / waves);
            refused(BALL, &[PERIODIC, (WAVE.0, &wave(3.0 / waves))], &words, "[16, 32]");
        }
        read(BALL, &[PERIODIC, (WAVE.0, &wave(3.0 / 7.0))]);
        let across = WAVE.1.replacen("wavelength_y = 3.0", "wavelength_y = 0.1875", 1);
        refused(BALL, &[PERIODIC, (WAVE.0, &across)], "32 along y for 16 waves", "[16, 32]");
    }

    #[test]
    fn what_has_no_end_needs_a_period() {
        refused(BALL, &[WAVE], "profile.wave: a wave is periodic", "[16, 32]");
        for (axis, name) in [("x", "infinite along x"), ("y", "infinite along y")] {
            let cylinder = format!("[profile.cylinder]\naxis = \"{axis}\"\nradius = 100.0");
            refused(BALL, &[(WAVE.0, &cylinder)], name, "[16, 32]");
            read(BALL, &[PERIODIC, (WAVE.0, &cylinder)]);
            read(BALL, &[(WAVE.0, &format!("{cylinder}\nlength = 1.0"))]);
        }
    }

    #[test]
    fn a_half_space_under_a_periodic_load_has_no_approach() {
        let stage = |words: &str| format!("increments = 1\n[[load]]\nincrements = 1\n{words}");
        let layer = |poisson: f64| {
            let layer = format!(
                "coatings = [{{ thickness = 1.0, young = 1.0, poisson = {poisson} }}]\nbase = \"rigid\""
            );
            BALL.replacen("substrate = { young = 1.0, poisson = 0.3 }", &layer, 1)
        };
        let approach = stage("approach = 0.125");
        let approach = ("increments = 1", approach.as_str());
        refused(BALL, &[PERIODIC, approach], "has no such rigid motion", "0.125");
        read(BALL, &[approach]);
        // layers on a rigid base give way, unless they keep their volume
        read(&layer(0.3), &[PERIODIC, approach]);
        refused(&layer(0.5), &[PERIODIC, approach], "layers that keep their volume", "0.125");
        // the mean planes of the surfaces shift against each other, also those of half-spaces
        let shift = stage("shift = [0.125, 0.0]");
        let shift = ("increments = 1", shift.as_str());
        read(BALL, &[PERIODIC, shift]);
        read(&layer(0.5), &[PERIODIC, shift]);
        refused(
            BALL,
            &[PERIODIC, ("increments = 1", &stage("twist = 0.125"))],
            "a rotation is not periodic",
            "0.125",
        );
        let turned = stage("twist_moment = 0.125");
        refused(&layer(0.3), &[PERIODIC, ("increments = 1", &turned)], "a rotation is not periodic", "0.125");
        read(BALL, &[PERIODIC, ("increments = 1", &stage("tangential_force = [1e-3, 0.0]"))]);
    }
}
