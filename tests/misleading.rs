//! Warnings: a case whose units went wrong is told of, before the run where the case alone tells and after it in any case; a case
//! of the tutorials is not.

use std::f64::consts::PI;

use fret_core::case::Case;
use fret_core::history::{Concern, History, Warning};
use fret_core::plan::Plan;
use fret_core::run::plausibility::{Gauge, of_plan};
use fret_validation::{Sphere, solved, solved_with};
use ndarray::Array2;

/// A rigid ball of 10 mm on steel in SI units, a coefficient of 0.2.
fn ball(young: &str, size: &str, loads: &str) -> String {
    format!(
        "[grid]\ncells = [48, 48]\nsize = {size}\n[upper]\nrigid = true\n[lower]\n\
         substrate = {{ young = {young}, poisson = 0.3 }}\n[profile.sphere]\nradius = 10e-3\n[friction]\ncoefficient = 0.2\n{loads}"
    )
}

const PRESS: &str = "[[load]]\nnormal_force = 12.0\nincrements = 40\nramp = \"cubic\"\n";

fn before(text: &str) -> Vec<Warning> {
    of_plan(&Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap())
}

fn names(warnings: &[Warning]) -> Vec<Concern> {
    warnings.iter().map(|warning| warning.name).collect()
}

fn value(warnings: &[Warning], name: Concern) -> f64 {
    warnings
        .iter()
        .find(|warning| warning.name == name)
        .unwrap_or_else(|| panic!("{name:?}: {warnings:?}"))
        .value
}

/// Millimetres and newtons make MPa of moduli; a modulus in Pa there is no material's. Without units nobody knows.
#[test]
fn a_modulus_in_pascals_beside_millimetres_is_told_of() {
    let case = |units: &str, young: &str| {
        format!("{units}{}", ball(young, "\"auto\"", PRESS).replace("radius = 10e-3", "radius = 10.0"))
    };
    let in_mm = "[units]\nlength = \"mm\"\nforce = \"N\"\n";
    let found = before(&case(in_mm, "210e9"));
    // 210e9 MPa over 1.25e12 Pa
    assert!((value(&found, Concern::StifferThanDiamond) / 1.68e5 - 1.0).abs() < 1e-12);
    for good in [
        case(in_mm, "210e3"),
        case("", "210e9"),
        case("[units]\nlength = \"in\"\nforce = \"lbf\"\n", "30.5e6"),
    ] {
        assert!(!names(&before(&good)).contains(&Concern::StifferThanDiamond));
    }
}

#[test]
fn a_modulus_without_its_gpa_is_told_of_before_the_run() {
    let found = before(&ball("210.0", "\"auto\"", PRESS));
    // Hertz: a = (3 W R (1 - nu^2) / 4 E)^(1/3) = 73 mm on a ball of 10 mm; the approach is a^2/R.
    let a = (0.75 * 12.0 * 0.01 * 0.91 / 210.0_f64).cbrt();
    for name in [Concern::ContactRadiusOverBodyRadius, Concern::ApproachOverContactRadius] {
        // A coarse grid knows the contact to a twentieth.
        assert!((value(&found, name) / (a / 0.01) - 1.0).abs() < 0.06, "{found:?}");
    }
    assert!(before(&ball("210e9", "\"auto\"", PRESS)).is_empty());
}

#[test]
fn a_grid_in_metres_for_a_contact_in_micrometres_is_told_of_before_and_after_the_run() {
    let text = ball("210e9", "[1.0, 1.0]", PRESS);
    let a = (0.75_f64 * 12.0 * 0.01 * 0.91 / 210e9).cbrt();
    assert!((value(&before(&text), Concern::FewCells) / (a * 48.0) - 1.0).abs() < 0.1);
    let history = solved(&text);
    // Four cells around the middle take the load, whatever the load is.
    assert!(value(&history.warnings, Concern::FewCells) < 1.5, "{:?}", history.warnings);
    let good = solved(&ball("210e9", "\"auto\"", PRESS)).warnings;
    assert!(good.is_empty(), "{good:?}");
}

#[test]
fn motions_and_heights_of_another_unit_are_told_of() {
    let far = before(&ball("210e9", "\"auto\"", "[[load]]\napproach = 1.0\nincrements = 1\n"));
    // a = sqrt(R d) = 0.1 m, ten times the ball.
    assert!((value(&far, Concern::ContactRadiusOverBodyRadius) / 10.0 - 1.0).abs() < 0.06, "{far:?}");
    let shifted = format!("{PRESS}[[load]]\nshift = [1.0, 0.0]\nincrements = 4\n");
    let found = before(&ball("210e9", "\"auto\"", &shifted));
    assert_eq!(names(&found), [Concern::ShiftOverContactRadius]);
    let run = solved(&ball("210e9", "\"auto\"", &shifted)).warnings;
    assert!(names(&run).contains(&Concern::ShiftOverContactRadius), "{run:?}");
    // A checkerboard of +-1 on cells of 1e-5: slopes of 2e5 along both axes.
    let heights = Array2::from_shape_fn((16, 16), |(i, j)| if (i + j) % 2 == 0 { 1.0 } else { -1.0 });
    let rough = "[grid]\ncells = [16, 16]\nsize = [1.6e-4, 1.6e-4]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
                 substrate = { young = 210e9, poisson = 0.3 }\n[profile.heights]\nvalues = { array = 0 }\n\
                 [[load]]\nnormal_force = 1.0\nincrements = 1\n";
    let history = solved_with(rough, &[heights]);
    let slope = value(&history.warnings, Concern::SteepTopography);
    assert!((slope / (2.0e5 * 2.0_f64.sqrt()) - 1.0).abs() < 1e-12, "{slope}");
}

/// Increments and ramp that the warning of rings calls enough.
fn enough(warnings: &[Warning]) -> (usize, Option<String>) {
    let help =
        &warnings.iter().find(|warning| warning.name == Concern::PressingInFewIncrements).unwrap().help;
    let count = help.strip_prefix("use at least ").unwrap().split(' ').next().unwrap().parse().unwrap();
    (count, help.split('"').nth(1).filter(|word| *word != "auto").map(str::to_owned))
}

#[test]
fn few_increments_of_coupled_pressing_are_told_of_and_many_are_not() {
    let pressed = |increments: usize, identical: bool| {
        let sphere = Sphere { cells: 96, size: 2.2, friction: 0.2, identical, ..Sphere::default() };
        solved(&sphere.pressed(1.0, increments, "cubic")).warnings
    };
    // 44 cells in the radius: 5.5 cells an increment of 8. Of 20 it grows by less than a sixteenth.
    let ring = value(&pressed(8, false), Concern::PressingInFewIncrements);
    assert!((ring / 5.5 - 1.0).abs() < 0.1, "{ring}");
    assert!(names(&pressed(20, false)).is_empty() && names(&pressed(8, true)).is_empty());
    // One increment makes the whole contact.
    assert!(value(&pressed(1, false), Concern::PressingInFewIncrements) > 40.0);
}

#[test]
fn the_increments_that_a_warning_of_pressing_asks_for_are_enough() {
    for (cells, ramp, increments) in [
        (96, "cubic", 4),
        (96, "square", 6),
        (96, "linear", 10),
        (32, "cubic", 6),
        (32, "linear", 1),
        (48, "square", 2),
    ] {
        let pressed = |increments: usize, ramp: &str| {
            let sphere = Sphere { cells, size: 2.4, friction: 0.3, ..Sphere::default() };
            solved(&sphere.pressed(1.0, increments, ramp)).warnings
        };
        let (count, other) = enough(&pressed(increments, ramp));
        assert!(count > increments && count < 60, "{cells} {ramp} {increments}: {count}");
        let left = pressed(count, other.as_deref().unwrap_or(ramp));
        assert!(left.is_empty(), "{cells} {ramp} {increments} to {count}: {left:?}");
    }
}

#[test]
fn a_flat_touches_at_once() {
    let punch = |cells: &str, size: &str, lower: &str, increments: usize| {
        solved(&format!(
            "grid = {{ cells = {cells}, size = {size} }}\nupper = {{ rigid = true }}\nlower = {{ {lower} }}\n             profile = {{ flat_punch = {{ radius = 1.0 }} }}\nfriction = {{ coefficient = 0.5 }}\n             [[load]]\nnormal_force = 0.001\nincrements = {increments}\n"
        ))
    };
    let steel = "substrate = { young = 1.0, poisson = 0.3 }";
    for increments in [1, 4, 64] {
        let history = punch("[48, 48]", "[2.5, 2.5]", steel, increments);
        assert!(history.warnings.is_empty(), "{increments}: {:?}", history.warnings);
        let line = punch("256", "3.0", steel, increments);
        assert!(line.warnings.is_empty(), "line, {increments}: {:?}", line.warnings);
    }
}

#[test]
fn thin_coatings_deep_scars_and_narrow_grids_are_told_of() {
    let coated = |thickness: f64, size: f64| {
        let coating = Some((2.0, thickness));
        Sphere { cells: 32, size, coating, ..Sphere::default() }.pressed(1.0, 1, "linear")
    };
    // Cells of 0.075.
    let asked = |text: String| before(&format!("{text}[stress]\ndepths = [0.01]\n"));
    let thin = asked(coated(0.03, 2.4));
    assert!((value(&thin, Concern::CoatingThinnerThanCell) - 0.4).abs() < 1e-12);
    assert!(asked(coated(0.1, 2.4)).is_empty() && before(&coated(0.03, 2.4)).is_empty());
    let narrow =
        solved(&Sphere { cells: 32, size: 2.1, ..Sphere::default() }.pressed(1.0, 1, "linear")).warnings;
    assert_eq!(value(&narrow, Concern::ContactNearEdge), 1.0, "{narrow:?}");
}

#[test]
fn a_gauge_says_the_same_in_pieces_and_in_one() {
    let sphere = Sphere { cells: 48, size: 2.4, friction: 0.3, ..Sphere::default() };
    let text = sphere.pulled(&sphere.pressed(1.0, 6, "cubic"), 0.5, 4, None);
    let plan = Plan::new(Case::from_toml(&text, "case.toml").unwrap()).unwrap();
    let history = solved(&text);
    let mut gauge = Gauge::of(&plan);
    for step in &history.steps {
        gauge.add(step);
        // As a checkpoint keeps it.
        gauge = serde_json::from_str(&serde_json::to_string(&gauge).unwrap()).unwrap();
    }
    assert_eq!(gauge.warnings(&plan), history.warnings);
    assert!(!history.warnings.is_empty());
}

/// Three cells per wave show crests of another height: cosines of 0, 120 and 240 degrees reach 1 and -1/2. Seven cells are enough.
#[test]
fn a_wave_of_few_cells_is_told_of_before_and_after_the_run() {
    let text = |waves: f64| {
        format!(
            "[grid]\ncells = [21, 21]\nsize = [1e-3, 1e-3]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
             substrate = {{ young = 21e9, poisson = 0.3 }}\n[profile.wave]\namplitude = 1e-7\nwavelength_x = {:?}\n[friction]\n\
             coefficient = 0.2\n[[load]]\nnormal_force = 10.0\nincrements = 1\n",
            1e-3 / waves
        )
    };
    for found in [before(&text(7.0)), solved(&text(7.0)).warnings] {
        assert!((value(&found, Concern::FewCellsPerWave) - 3.0).abs() < 1e-9, "{found:?}");
    }
    assert!(before(&text(3.0)).is_empty(), "{:?}", before(&text(3.0)));
}

/// 50 times E is no stress of an elastic body: strains of 50 along it and of 15 across.
#[test]
fn a_bulk_stress_above_the_modulus_is_told_of() {
    let text = |stress: &str| {
        ball(
            "210e9",
            "\"auto\"",
            &format!("{PRESS}[[load]]\nbulk_stress = [{stress}, 0.0]\nincrements = 4\n"),
        )
    };
    assert!((value(&before(&text("1.05e13")), Concern::BulkStrain) - 50.0).abs() < 1e-9);
    assert!(!names(&before(&text("1e9"))).contains(&Concern::BulkStrain));
}

/// A cylinder slides to and fro by half of its contact, which hardly wears: every cell loses `k` times the integral of Hertz' pressure over the way,
/// a closed form. From the ends of 24, 12 and 8 increments (a twelfth, a sixth, a quarter of the contact) it is off by 2.5, 7.1 and 13 % of the
/// largest (trapezoids of that pressure); the last is told of, and the number of increments that the warning names is enough.
#[test]
fn strides_that_show_in_the_scar_are_told_of() {
    const HALF: f64 = 0.5;
    let wears = "wear_coefficient = 1e-9";
    let force = PI * HALF * HALF / 400.0; // E* = 1, R = 100
    let text = |increments: usize, wears: &str| {
        let young = "young = 1.82, poisson = 0.3";
        let wear = if wears.is_empty() { "" } else { "[wear]\nlaw = \"archard\"\n" };
        format!(
            "[grid]\ncells = 96\nsize = 2.4\n[upper]\nsubstrate = {{ {young} }}\n[lower]\nsubstrate = {{ {young} }}\n{wears}\n\
             [profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n[kinematics]\ndisplacement = \"finite\"\n{wear}\
             [output]\nfields = [\"worn_depth\"]\n[[load]]\nnormal_force = {force:e}\nincrements = 2\n\
             [[load]]\nname = \"rub\"\nshift = [{HALF}, 0.0]\ncycles = 1\nincrements = {increments}\n"
        )
        .replace("poisson = 0.3 }\nwear_coefficient = 1e-9", "poisson = 0.3, wear_coefficient = 1e-9 }")
    };
    // Hertz' pressure to the left of a place.
    let carried = |x: f64| {
        let u = (x / HALF).clamp(-1.0, 1.0);
        force * (u * (1.0 - u * u).sqrt() + u.asin() + 0.5 * PI) / PI
    };
    let off = |history: &History| {
        let [scar, _] = history.fields.last().unwrap().own_worn_depth.as_ref().unwrap();
        let right = |x: f64| 2e-9 * (carried(x + HALF) - carried(x - HALF));
        let cells = scar.iter().enumerate();
        let off = cells.map(|(i, depth)| (depth - right(history.grid.centre(0, i))).abs());
        off.fold(0.0, f64::max) / right(0.0)
    };
    let told = |history: &History| {
        let concern = Concern::MovingInFewIncrements;
        history.warnings.iter().find(|warning| warning.name == concern).cloned()
    };
    // What sticks after a turn, and cells of a twentieth of the half-width: 1 %.
    for (increments, right) in [(24, 0.025), (8, 0.130)] {
        let history = solved(&text(increments, wears));
        println!("{increments} increments: off by {:.3}", off(&history));
        assert!((off(&history) - right).abs() < 0.01, "{increments}: {}", off(&history));
        assert_eq!(told(&history).is_some(), increments == 8, "{:?}", history.warnings);
    }
    let warning = told(&solved(&text(8, wears))).unwrap();
    assert!((warning.value / 0.25 - 1.0).abs() < 0.03, "{warning:?}"); // a contact of whole cells
    // A cycle has four quarters of whole increments: 9 and 10 go as far in one as 8 do.
    for increments in [4, 6, 8, 9, 10] {
        let warning = told(&solved(&text(increments, wears))).unwrap();
        let enough = named(&warning).unwrap();
        let more = solved(&text(enough, wears));
        assert!(enough <= 16 && told(&more).is_none() && off(&more) < 0.08, "{enough}: {:?}", more.warnings);
    }
    // Nothing wears: nothing remembers.
    assert_eq!(told(&solved(&text(8, ""))), None);
}

/// The number of increments that a warning names.
fn named(warning: &Warning) -> Option<usize> {
    warning.help.split(' ').find_map(|word| word.parse().ok())
}

/// A contact rolls by a fifth of itself in an increment, or by a twentieth; on a grid that goes with it, by whole cells.
#[test]
fn rolling_far_in_an_increment_is_told_of() {
    let rolled = |increments: usize, roll: f64, more: &str| {
        let young = "young = 1.82, poisson = 0.3";
        let text = format!(
            "[grid]\ncells = 96\nsize = 2.4\n[upper]\nsubstrate = {{ {young} }}\n[lower]\nsubstrate = {{ {young} }}\n\
             [profile.cylinder]\nradius = 100.0\naxis = \"y\"\n[friction]\ncoefficient = 0.3\n{more}[[load]]\nnormal_force = {:e}\nincrements = 2\n\
             [[load]]\nroll = {roll}\ncreepage = [1e-3, 0.0]\nincrements = {increments}\n",
            PI * 0.25 / 400.0
        );
        solved(&text).warnings.into_iter().find(|warning| warning.name == Concern::RollingInFewIncrements)
    };
    let warning = rolled(2, 0.4, "").unwrap();
    assert!((warning.value / 0.2 - 1.0).abs() < 0.03 && named(&warning) == Some(4), "{warning:?}");
    assert_eq!((rolled(4, 0.4, ""), rolled(8, 0.4, "")), (None, None));
    // 18 cells in two increments: five would be enough, and go by no whole cells.
    let with_contact = "[kinematics]\nframe = \"contact\"\n";
    assert_eq!(named(&rolled(2, 0.45, with_contact).unwrap()), Some(6));
    assert_eq!(rolled(6, 0.45, with_contact), None);
}
