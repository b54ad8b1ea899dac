//! Shapes beside closed forms of indentation and of their limits.

use std::f64::consts::PI;

use fret_core::analytic::HertzEllipse;
use fret_validation::{observed_order, solved};

/// The last increment of a shape pressed onto a half-space with `E / (1 - nu^2) = 1`.
fn pressed(profile: &str, load: &str, cells: usize, size: f64) -> fret_core::history::StepRecord {
    let text = format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [{size:?}, {size:?}]\n[upper]\nrigid = true\n\
         [lower]\nsubstrate = {{ young = 1.0, poisson = 0.0 }}\n[profile.{profile}\n\
         [[load]]\n{load}\nincrements = 1\n[solver]\ntolerance = 1e-9\n"
    );
    solved(&text).steps.last().unwrap().clone()
}

/// Force and approach of a rigid body of revolution whose contact has the radius `a`, with `E* = 1`: Sneddon (1965),
/// `F = 2 int r^2 f' / sqrt(a^2 - r^2) dr`, `approach = a int f' / sqrt(a^2 - r^2) dr`. The slope is `r / R` between `inner` and `turn`,
/// and `slope` beyond; nothing within `inner`.
fn sneddon(a: f64, [radius, slope]: [f64; 2], [inner, turn]: [f64; 2]) -> [f64; 2] {
    let root = |r: f64| ((a - r) * (a + r)).max(0.0).sqrt();
    let turn = turn.min(a);
    // antiderivatives of r^3, r^2, r and 1 over the root
    let cubic = |r: f64| -a * a * root(r) + root(r).powi(3) / 3.0;
    let square = |r: f64| 0.5 * (a * a * (r / a).asin() - r * root(r));
    let force = 2.0 * ((cubic(turn) - cubic(inner)) / radius + slope * (square(a) - square(turn)));
    let approach = a * ((root(inner) - root(turn)) / radius + slope * ((PI / 2.0) - (turn / a).asin()));
    [force, approach]
}

/// A contact twice as wide as the sphere of the tip.
#[test]
fn a_sphero_cone_is_pressed_as_sneddon_says() {
    let (radius, slope) = (10.0, 0.05); // the tip ends at 0.5
    let [force, approach] = sneddon(1.0, [radius, slope], [0.0, radius * slope]);
    // limits of the closed form itself: a cone has F = a^2 slope pi / 2, a sphere 4 a^3 / 3 R
    assert!((sneddon(1.0, [1e-9, slope], [0.0, 0.0])[0] - PI / 2.0 * slope).abs() < 1e-12);
    assert!((sneddon(1.0, [radius, slope], [0.0, 9.0])[0] - 4.0 / 3.0 / radius).abs() < 1e-12);
    let shape = format!("sphero_cone]\nradius = {radius:?}\nslope = {slope:?}");
    let errors = [64, 128].map(|cells| {
        let found = pressed(&shape, &format!("normal_force = {force:e}"), cells, 2.4);
        let edge = (found.contact_area / PI).sqrt();
        [found.approach / approach - 1.0, edge - 1.0]
    });
    // the errors of a smooth contact: at 53 cells a radius approach 3e-5, radius 2e-4; the kink of the curvature adds no more
    assert!(errors[1][0].abs() < 2e-4 && errors[1][1].abs() < 1e-3, "{errors:?}");
    assert!(observed_order(errors[0][0], errors[1][0]) > 1.0, "{errors:?}");
}

#[test]
fn a_worn_sphere_is_pressed_as_maugis_and_barquins_say() {
    let (radius, flat) = (10.0, 0.6);
    let [force, approach] = sneddon(1.0, [radius, 0.0], [flat, 1.0]);
    let shape = format!("worn_sphere]\nradius = {radius:?}\nflat_radius = {flat:?}");
    let found = pressed(&shape, &format!("normal_force = {force:e}"), 128, 2.4);
    // cells of 0.019 at the rim of the flat, where the slope jumps: half a cell there moves the force by 2 b h / a^2 of a tenth
    assert!((found.approach / approach - 1.0).abs() < 3e-3, "{} against {approach}", found.approach);
    let edge = (found.contact_area / PI).sqrt();
    assert!((edge - 1.0).abs() < 5e-3, "{edge}");
    // nearly whole: Hertz
    let whole = "worn_sphere]\nradius = 10.0\nflat_radius = 1e-6";
    let sphere = "sphere]\nradius = 10.0";
    let load = "normal_force = 0.13";
    let [worn, hertz] = [whole, sphere].map(|shape| pressed(shape, load, 64, 2.4));
    assert!((worn.approach / hertz.approach - 1.0).abs() < 1e-9, "a flat below the cells changes nothing");
}

/// `F = c E* approach^2 / slope`, for a cone `c = 2 / pi` = 0.6366; for a four-sided pyramid 0.7453 by Bilodeau (J. Appl. Mech. 59 (1992) 519),
/// whose estimate by a polygon of contact is good to some percent. A pyramid has no length: all contacts of it are alike.
#[test]
fn a_vickers_pyramid_is_stiffer_than_its_cone_and_has_no_length() {
    let slope = 68.0_f64.to_radians().tan().recip();
    let factor = |approach: f64, size: f64| {
        let found =
            pressed("pyramid]\nindenter = \"vickers\"", &format!("approach = {approach:e}"), 128, size);
        found.normal_force * slope / (approach * approach)
    };
    let found = factor(0.4, 2.4);
    assert!((found / 0.7453 - 1.0).abs() < 0.03, "{found}");
    // twice as deep on twice the grid: the same cells
    assert!((factor(0.8, 4.8) / found - 1.0).abs() < 1e-9);
    // twice as deep on the same grid: the contact has twice as many cells
    assert!((factor(0.2, 2.4) / found - 1.0).abs() < 0.02, "{found}");
    // a pyramid lies between the cone of its slope and that through its edges, and so does its force
    let cone = 2.0 / PI;
    assert!((cone..cone / (PI / 4.0).cos()).contains(&found), "{found}");
    // three sides: 0.8872 by the same estimate
    let slope = 65.27_f64.to_radians().tan().recip();
    let berkovich = pressed("pyramid]\nindenter = \"berkovich\"", "approach = 0.4", 128, 3.2).normal_force;
    let found = berkovich * slope / 0.16;
    assert!((found / 0.8872 - 1.0).abs() < 0.03, "{found}");
    assert!((cone..cone / (PI / 3.0).cos()).contains(&found), "{found}");
}

/// A rigid punch without friction is a charged plate: `F / approach = pi c L E*`, where `c` = 0.3667896 is the capacitance of a square plate of
/// side L in `4 pi eps_0 L` (F. H. Read, J. Comput. Phys. 133 (1997) 1); of a disc `c L` is `2 a / pi`, and the stiffness `2 E* a`.
#[test]
fn a_square_punch_has_the_stiffness_of_a_charged_plate() {
    let stiffness = |cells: usize| {
        // edges of the punch are edges of cells
        let found =
            pressed("rectangular_punch]\nlength_x = 2.0\nlength_y = 2.0", "approach = 1e-3", cells, 4.0);
        found.normal_force / 1e-3
    };
    let [coarse, fine] = [32, 64].map(stiffness);
    // pressure at the edge is an inverse root: the error falls with the cell; what is left beside is of the order of its square, 1 / 32^2
    let limit = 2.0 * fine - coarse;
    let exact = PI * 0.366_789_6 * 2.0;
    assert!((limit / exact - 1.0).abs() < 1e-3, "{limit} against {exact}");
    assert!((fine / limit - 1.0).abs() < 0.02);
    // turned by a quarter the same, and wider than its rounding a little stiffer
    let [x, y] = ["length_x = 2.0\nlength_y = 1.0", "length_x = 1.0\nlength_y = 2.0"].map(|sides| {
        pressed(&format!("rectangular_punch]\n{sides}"), "approach = 1e-3", 32, 4.0).normal_force
    });
    assert!((x / y - 1.0).abs() < 1e-9);
    let rounded = "rectangular_punch]\nlength_x = 2.0\nlength_y = 2.0\nedge_radius = 1e-3";
    let round = pressed(rounded, "approach = 1e-3", 64, 4.0).normal_force / 1e-3;
    assert!(round > fine && round / fine < 1.05, "{round} against {fine}");
}

/// Crowned all along and longer than its contact: an ellipsoid, Hertz.
#[test]
fn a_crowned_roller_is_hertz_and_its_straight_middle_spreads_the_load() {
    let force = 2e-3;
    let roller = |flat: &str| {
        let shape =
            format!("crowned_roller]\nradius = 20.0\naxis = \"y\"\nlength = 2.2\ncrown_radius = 60.0{flat}");
        pressed(&shape, &format!("normal_force = {force:e}"), 96, 2.4)
    };
    let crowned = roller("");
    let exact = HertzEllipse::ellipsoid([20.0, 60.0], force, 1.0).unwrap();
    assert!(
        (crowned.approach / exact.approach - 1.0).abs() < 1e-3,
        "{} against {}",
        crowned.approach,
        exact.approach
    );
    assert!((crowned.max_pressure / exact.max_pressure - 1.0).abs() < 3e-3);
    let straight = roller("\nflat_length = 1.0");
    assert!(straight.max_pressure < crowned.max_pressure && straight.contact_area > crowned.contact_area);
}
