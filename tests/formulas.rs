//! Profiles by a formula: the same as the shapes that the program knows, and waves with closed forms.

use fret_core::analytic::Westergaard;
use fret_core::case::Case;
use fret_core::history::History;
use fret_core::plan::Plan;
use fret_validation::{keeping, run, solved};

const MODULUS: f64 = 1.0 / 0.91;

/// A rigid body on a half-space, pressed and pulled.
fn case(grid: &str, profile: &str, rest: &str) -> String {
    format!(
        "[grid]\n{grid}\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n{profile}\n\
         [friction]\ncoefficient = 0.3\n{rest}{}",
        keeping(1)
    )
}

fn formula(table: &str, expression: &str, parameters: &str) -> String {
    format!("[{table}.formula]\nexpression = \"{expression}\"\nparameters = {{ {parameters} }}")
}

/// To the last bit: records, but for the time they took, and fields.
fn assert_same(one: &History, other: &History) {
    for (one, other) in one.steps.iter().zip(&other.steps) {
        assert_eq!(one.normal_force, other.normal_force);
        assert_eq!(one.approach, other.approach);
        assert_eq!(one.tangential_force, other.tangential_force);
        assert_eq!(one.shift, other.shift);
        assert_eq!(one.dissipated_energy, other.dissipated_energy);
    }
    assert_eq!((one.steps.len(), one.fields.len()), (other.steps.len(), other.fields.len()));
    for (one, other) in one.fields.iter().zip(&other.fields) {
        assert_eq!((&one.pressure, &one.shear), (&other.pressure, &other.shear));
    }
}

const PULLED: &str = "[[load]]\nnormal_force = 0.01\nincrements = 2\n[[load]]\ntangential_force = [1e-3, 5e-4]\nincrements = 2\n";
const PLANE: &str = "cells = [24, 20]\nsize = [3.0, 2.5]";

#[test]
fn a_sphere_by_a_formula_is_the_sphere_to_the_last_bit() {
    for table in ["profile", "upper.profile", "lower.profile"] {
        let of = |profile: &str| solved(&case(PLANE, profile, PULLED));
        let known = of(&format!("[{table}.sphere]\nradius = 100.0"));
        assert_same(&of(&formula(table, "(x^2 + y^2)/(2*R)", "R = 100.0")), &known);
        // lowest elsewhere, and the other way to write a square
        let lifted = of(&formula(table, "7 + (x**2 + y*y)/(2*R)", "R = 100.0"));
        let off = lifted.steps[3].approach / known.steps[3].approach - 1.0;
        // The rounding of 7 beside an approach of 6e-3.
        assert!(off.abs() < 1e-11, "{off:e}");
    }
}

#[test]
fn a_cylinder_by_a_formula_is_the_cylinder_of_a_line_contact() {
    let of = |profile: &str| solved(&case("cells = 64\nsize = 3.0\ndatum = 10.0", profile, PULLED));
    let known = of("[profile.cylinder]\nradius = 100.0\naxis = \"y\"");
    assert_same(&of(&formula("profile", "x^2/(2*R)", "R = 100.0")), &known);
}

#[test]
fn a_half_sphere_and_a_half_formula_make_a_sphere() {
    let known = solved(&case(PLANE, "[profile.sphere]\nradius = 100.0", PULLED));
    let half = "[upper.profile.sphere]\nradius = 200.0";
    let other = formula("lower.profile", "(x^2 + y^2)/(2*R)", "R = 200.0");
    let both = solved(&case(PLANE, &format!("{half}\n{other}"), PULLED));
    for (one, other) in both.steps.iter().zip(&known.steps) {
        assert!((one.approach / other.approach - 1.0).abs() < 1e-12);
        assert!((one.shift[0] - other.shift[0]).abs() <= 1e-9 * other.approach);
    }
}

/// The upper surface goes with its body, between cells, too; the lower one stays.
#[test]
fn a_formula_moves_with_its_body() {
    let loads = "[kinematics]\ndisplacement = \"finite\"\n[[load]]\nnormal_force = 2e-3\nincrements = 1\n\
                 [[load]]\nshift = [0.27, -0.11]\nincrements = 3\n";
    for table in ["upper.profile", "lower.profile"] {
        let of = |profile: &str| solved(&case(PLANE, profile, loads));
        let known = of(&format!("[{table}.sphere]\nradius = 100.0"));
        assert_same(&of(&formula(table, "(x^2 + y^2)/(2*R)", "R = 100.0")), &known);
    }
}

/// A wave from its valley to its valley, and from its middle on, which is lowest a quarter further.
#[test]
fn a_wave_by_a_formula_carries_the_pressure_of_westergaard() {
    const AMPLITUDE: f64 = 1e-3;
    let full = std::f64::consts::PI * MODULUS * AMPLITUDE;
    let grid = "cells = [256, 8]\nsize = [1.0, 0.03125]\nperiodic = true";
    for (expression, crest) in [("A*(1 - cos(2*pi*x/L))", 0.0), ("A*sin(2*pi*x/L)", -0.25)] {
        for share in [0.1, 0.5, 0.9] {
            let mean = share * full;
            let load = format!("[[load]]\nnormal_force = {:e}\nincrements = 1\n", mean * 0.03125);
            let profile = formula("profile", expression, &format!("A = {AMPLITUDE:e}, L = 1.0"));
            let text = case(grid, &profile, &load).replace("coefficient = 0.3", "coefficient = 0.0");
            let history = run(&text).unwrap();
            let exact = Westergaard::new(AMPLITUDE, 1.0, mean, MODULUS).unwrap();
            let pressure = history.fields[0].pressure.as_ref().unwrap();
            let square: f64 = pressure
                .indexed_iter()
                .map(|((i, _), p)| (p - exact.pressure(history.grid.centre(0, i) - crest)).powi(2))
                .sum();
            let rms = (square / pressure.len() as f64).sqrt() / full;
            // As the wave that the program knows: at 256 cells a wave the root at the edge is smeared over a cell.
            assert!(rms < 2e-3, "{expression}, {share}: {rms}");
        }
    }
}

/// Refined, the formula is taken at the new cells: where it has no value there, that is said, and nothing is guessed.
#[test]
fn on_other_cells_a_formula_is_judged_again() {
    let text = case(PLANE, &formula("profile", "x^2/R + y^2 + 1e-9/abs(x - 0.125)", "R = 1.0"), PULLED);
    let mut case = Case::from_toml(&text, "case.toml").unwrap();
    assert!(Plan::new(case.clone()).is_ok());
    // of 0.25, whose centres lie at 0.125 and so on; those of 0.125 lie at 0.0625 and so on
    case.cells = [12, 20];
    let error = Plan::new(case).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("no finite value at x = "), "{error}");
}

/// Two cylinders crossed at 45 degrees to the way of the upper one: their sum is its own mirror image, neither of them is. Moved by s they touch
/// at (s/2, s/2), as before: approach and pressure stay what they are.
#[test]
fn bodies_that_move_are_mirrored_each_by_itself() {
    let text = "grid = { cells = [48, 48], size = [3.1e-3, 3.1e-3] }\nkinematics = { displacement = \"finite\" }\n\
                upper.substrate = { young = 210e9, poisson = 0.3 }\nlower.substrate = { young = 210e9, poisson = 0.3 }\n\
                upper.profile.formula = { expression = \"(x + y)^2/(4*R)\", parameters = { R = 37e-3 } }\n\
                lower.profile.formula = { expression = \"(x - y)^2/(4*R)\", parameters = { R = 37e-3 } }\n\
                friction.coefficient = 0.3\n[[load]]\nnormal_force = 4000.0\nincrements = 1\n[[load]]\nshift = [0.6e-3, 0.0]\nincrements = 4\n";
    let history = run(text).unwrap();
    let [first, last] = [0, history.steps.len() - 1].map(|step| &history.steps[step]);
    assert!((last.approach / first.approach - 1.0).abs() < 1e-3, "{} {}", first.approach, last.approach);
    // the middle lies elsewhere among the cells of a seventeenth of the contact
    assert!((last.max_pressure / first.max_pressure - 1.0).abs() < 5e-3);
}
