//! Derivatives of stresses and fatigue parameters at their largest place, against differences of whole runs, dimensional analysis, the powers of
//! Hertz's contact.

use fret_core::plan::Plan;
use fret_core::sensitivity::Direction;

use crate::sensitivities::{Written, by_numbers, found, found_along, planned};

/// A coated body on a spring under an elastic ball, both forces growing, and a cycle; `<stress>`: what is asked about stresses.
const COATED: &str = r#"
[grid]
cells = [16, 16]
size = [3.0, 3.0]
[upper]
substrate = { young = <Eu>, poisson = 0.2 }
[lower]
coatings = [{ thickness = <h>, young = <E>, poisson = <nu>, interface = { shear_stiffness = <ks> } }]
substrate = { young = <Es>, poisson = 0.3 }
[profile.sphere]
radius = <R>
[friction]
coefficient = <mu>
[output]
fields = ["pressure", "shear"]
[stress]
<stress>
[solver]
tolerance = 1e-11
[[load]]
normal_force = <P>
increments = 3
[[load]]
tangential_force = [<Q>, 0.0]
cycles = 1
increments = 8
"#;
const NUMBERS: [(&str, f64, &str); 10] = [
    ("Eu", 5.0, "upper.substrate.young"),
    ("h", 0.4, "lower.coatings[0].thickness"),
    ("E", 3.0, "lower.coatings[0].young"),
    ("nu", 0.35, "lower.coatings[0].poisson"),
    ("ks", 6.0, "lower.coatings[0].interface.shear_stiffness"),
    ("Es", 1.0, "lower.substrate.young"),
    ("R", 5.0, "profile.sphere.radius"),
    ("mu", 0.3, "friction.coefficient"),
    ("P", 0.15, "load[0].normal_force"),
    ("Q", 0.03, "load[1].tangential_force[0]"),
];
const MEASURES: [&str; 6] = ["von_mises", "tresca", "tension", "hydrostatic", "interface_shear", "peel"];
const CONSTANTS: &str = "yield_strength = 0.3\ntorsion_limit = 0.1\ntension_limit = 0.15";

/// Largest difference of the derivatives of numbers by all of [`NUMBERS`] from central differences of whole runs in steps of a fraction, over the
/// value and the derivative. Both ways agree to 1e-9.
pub fn worst(text: &str, numbers: &[(&str, f64, &str)], of: &[String], step: f64) -> f64 {
    let written = Written { text, numbers };
    let plan = written.plan(None);
    let [back, forward] = [Direction::Backward, Direction::Forward]
        .map(|direction| found_along(&plan, of, &written.paths(), Some(direction)).unwrap());
    let results = |moved| -> Vec<f64> {
        let by = numbers[numbers.len() - 1].2;
        let found = found_along(&written.plan(moved), of, &[by], Some(Direction::Forward)).unwrap();
        found.gradients.iter().map(|gradient| gradient.value).collect()
    };
    written.off(step, [&by_numbers(&back), &by_numbers(&forward)], results)
}

/// All measures in the middle of the cycle and at its end, at depths that are chosen, the interface among them; of both bodies. Runs leave 1e-6
/// of noise.
#[test]
fn stresses_at_their_largest_place_are_differentiated() {
    for body in ["lower", "upper"] {
        let text = COATED.replace("<stress>", &format!("body = \"{body}\""));
        let measures =
            MEASURES.iter().filter(|of| body == "lower" || !["interface_shear", "peel"].contains(of));
        let of: Vec<String> = measures
            .flat_map(|measure| [format!("increments[4].stress.{measure}"), format!("stress.{measure}")])
            .collect();
        let worst = worst(&text, &NUMBERS, &of, 1e-5);
        assert!(worst < 1e-5, "{body}: {worst:e}");
    }
}

/// Parameters of the cycle. Critical planes are found to 2e-5, which is left of the derivatives; values on them to 3e-10, so that their
/// differences take longer steps.
#[test]
fn fatigue_parameters_at_their_largest_place_are_differentiated() {
    let text = COATED.replace("<stress>", &format!("depths = [0.0, 0.2, 0.35]\n{CONSTANTS}"));
    for (parameters, step, bound) in [
        (&["crossland", "dang_van", "shakedown_strength"][..], 1e-5, 1e-5),
        (&["smith_watson_topper", "fatemi_socie"][..], 1e-4, 1e-4),
    ] {
        let of: Vec<String> = parameters.iter().map(|of| format!("cycles[0].fatigue.{of}")).collect();
        let worst = worst(&text, &NUMBERS, &of, step);
        assert!(worst < bound, "{worst:e}");
    }
}

/// Ruiz's parameters of both bodies, and of a line contact whose slip grows until it slides and whose edge opens as the force falls.
#[test]
fn ruiz_parameters_at_their_largest_place_are_differentiated() {
    let of = ["cycles[0].fatigue.ruiz_f1", "fatigue.ruiz_f2"].map(str::to_owned);
    for body in ["lower", "upper"] {
        let text = COATED.replace("<stress>", &format!("body = \"{body}\"\ndepths = [0.0]"));
        let worst = worst(&text, &NUMBERS, &of, 1e-5);
        assert!(worst < 1e-5, "{body}: {worst:e}");
    }
    let line = "[grid]\ncells = 64\nsize = 3.0\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n\
                [profile.cylinder]\nradius = <R>\naxis = \"y\"\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n\
                [[load]]\nnormal_force = <P>\nincrements = 2\n[[load]]\nshift = [<d>, 0.0]\nnormal_force = 0.1\ncycles = 1\nincrements = 8\n";
    let numbers = [
        ("R", 4.0, "profile.cylinder.radius"),
        ("mu", 0.3, "friction.coefficient"),
        ("d", 0.2, "load[1].shift[0]"),
        ("P", 0.2, "load[0].normal_force"),
    ];
    let worst = worst(line, &numbers, &of, 1e-5);
    assert!(worst < 1e-5, "line: {worst:e}");
}

/// Given depths, tension at the rim of a contact that slides, in a line contact and in a period, where friction and loads are numbers.
#[test]
fn stresses_below_lines_and_periods_are_differentiated() {
    let line = "[grid]\ncells = 64\nsize = 3.0\n[upper]\nrigid = true\n[lower]\n\
                coatings = [{ thickness = <h>, young = <E>, poisson = 0.25 }]\nsubstrate = { young = <Es>, poisson = <ns> }\n\
                [profile.cylinder]\nradius = <R>\naxis = \"y\"\n[friction]\ncoefficient = <mu>\n[output]\nfields = [\"pressure\", \"shear\"]\n\
                [stress]\ndepths = [0.0, 0.2, 0.5]\n[solver]\ntolerance = 1e-11\n[[load]]\nnormal_force = <P>\nincrements = 2\n[[load]]\n\
                tangential_force = [<Q>, 0.0]\nbulk_stress = <b>\nincrements = 3\n";
    let numbers = [
        ("h", 0.35, "lower.coatings[0].thickness"),
        ("E", 2.0, "lower.coatings[0].young"),
        ("Es", 1.0, "lower.substrate.young"),
        ("ns", 0.3, "lower.substrate.poisson"),
        ("b", 0.02, "load[1].bulk_stress"),
        ("R", 4.0, "profile.cylinder.radius"),
        ("mu", 0.3, "friction.coefficient"),
        ("Q", 0.05, "load[1].tangential_force[0]"),
        ("P", 0.2, "load[0].normal_force"),
    ];
    let of = ["stress.von_mises", "stress.tension"].map(str::to_owned);
    assert!(worst(line, &numbers, &of, 1e-5) < 1e-5);
    let period = "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\ncoatings = [{ thickness = <h>, \
                  young = <E>, poisson = <nu> }]\nbase = \"rigid\"\n[profile.wave]\namplitude = <A>\n\
                  wavelength_x = 3.0\nwavelength_y = 3.0\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n[[load]]\nnormal_force = <P>\n\
                  increments = 2\n[[load]]\ntangential_force = [<Q>, 0.0]\nincrements = 3\n";
    let numbers = [
        ("h", 0.5, "lower.coatings[0].thickness"),
        ("E", 3.0, "lower.coatings[0].young"),
        ("nu", 0.25, "lower.coatings[0].poisson"),
        ("A", 0.1, "profile.wave.amplitude"),
        ("mu", 0.3, "friction.coefficient"),
        ("P", 0.3, "load[0].normal_force"),
        ("Q", 0.05, "load[1].tangential_force[0]"),
    ];
    let of = ["stress.von_mises", "stress.tension", "stress.interface_shear"].map(str::to_owned);
    assert!(worst(period, &numbers, &of, 1e-5) < 1e-5);
}

/// Moduli, stiffnesses and forces together scale all stresses alike, whatever the place: the sum of their logarithmic derivatives is one of all
/// that is of the first degree in the stress. 1e-7: linear equations and run; 2e-5 on critical planes.
#[test]
fn moduli_and_forces_are_one_dimension_of_stresses() {
    let text = COATED.replace("<stress>", CONSTANTS);
    let plan = planned(&Written { text: &text, numbers: &NUMBERS }.case(None));
    let forces = [
        "upper.substrate.young",
        "lower.coatings[0].young",
        "lower.coatings[0].interface.shear_stiffness",
        "lower.substrate.young",
        "load[0].normal_force",
        "load[1].tangential_force[0]",
    ];
    let measures = MEASURES.map(|measure| format!("stress.{measure}"));
    let fatigue = ["crossland", "dang_van", "shakedown_strength", "smith_watson_topper"];
    let fatigue = fatigue.map(|of| format!("fatigue.{of}"));
    let of: Vec<String> = measures.into_iter().chain(fatigue).collect();
    for gradient in found_along(&plan, &of, &forces, Some(Direction::Backward)).unwrap().gradients {
        let parts = gradient.by.iter().zip(forces.iter().map(|path| value(path)));
        let sum: f64 = parts.map(|(by, value)| by * value).sum();
        let off = (sum / gradient.value - 1.0).abs();
        assert!(off < if gradient.of.ends_with("topper") { 2e-5 } else { 1e-7 }, "{}: {off:e}", gradient.of);
    }
}

fn value(path: &str) -> f64 {
    NUMBERS.iter().find(|(_, _, known)| *known == path).unwrap().1
}

/// Hertz: all stresses go with the pressure, whose powers are 1/3 of the force, 2/3 of the modulus, -2/3 of the radius; von Mises' stress is largest
/// at a depth of 0.48 radii, where depths a hundredth of one apart leave 1e-3 of a power, and 64 cells as much.
#[test]
fn stresses_have_the_powers_of_hertz() {
    let text = "[grid]\ncells = [64, 64]\nsize = [2.5, 2.5]\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n\
                [profile.sphere]\nradius = 20.0\n[output]\nfields = [\"pressure\"]\n[stress]\ndepths = [<depths>]\n[solver]\n\
                tolerance = 1e-10\n[[load]]\nnormal_force = 0.0733\nincrements = 1\n";
    // E* = 1/0.91: a^3 = 3 P R / (4 E*) = 1.0005.
    let depths: Vec<String> = (42..55).map(|n| format!("{:.2}", 0.01 * f64::from(n))).collect();
    let plan = planned(&text.replace("<depths>", &depths.join(", ")));
    let by = ["load[0].normal_force", "lower.substrate.young", "profile.sphere.radius"];
    let found = found(&plan, &["stress.von_mises", "max_pressure"], &by).unwrap();
    let (stress, pressure) = (&found.gradients[0], &found.gradients[1]);
    assert!((stress.value / pressure.value - 0.62).abs() < 0.005, "{}", stress.value / pressure.value);
    for ((by, parameter), expected) in stress.by.iter().zip(&found.parameters).zip([1.0, 2.0, -2.0]) {
        let power = by * parameter.value() / stress.value;
        assert!((power - expected / 3.0).abs() < 2e-3, "by {}: {power}", parameter.path());
    }
}

#[test]
fn stresses_that_a_case_does_not_have_are_refused() {
    let text = COATED.replace("<stress>", "body = \"lower\"");
    let plan = planned(&Written { text: &text, numbers: &NUMBERS }.case(None));
    let message =
        |plan: &Plan, of: &str| found(plan, &[of], &["load[0].normal_force"]).unwrap_err().to_string();
    for (of, word) in [
        ("stress.mises", "von_mises, tresca, tension"),
        ("increments[99].stress.tension", "11 increments"),
        ("fatigue.crossland", "fatigue limits"),
        ("cycles[3].fatigue.shakedown_strength", "1 cycles"),
        ("fatigue.ruiz", "shakedown_strength, ruiz_f1, ruiz_f2"),
    ] {
        let found = message(&plan, of);
        assert!(found.contains(word), "{of}: {found}");
    }
    let deep = planned(
        &Written { text: &text.replace("[stress]", "[stress]\ndepths = [0.1]"), numbers: &NUMBERS }
            .case(None),
    );
    assert!(message(&deep, "fatigue.ruiz_f1").contains("the surface is not among"));
    let bare = text.replace(", interface = { shear_stiffness = <ks> } }]", " }]");
    let bare = bare.replace("coatings = [{ thickness = <h>, young = <E>, poisson = <nu> }]\n", "");
    let plan = planned(&Written { text: &bare, numbers: &NUMBERS }.case(None));
    assert!(message(&plan, "stress.interface_shear").contains("no coating"));
}

/// Residual stress moves no surface and adds to the stress: of hydrostatic tension it counts a third along each axis, of what lies in another layer
/// nothing, exactly; of all else against differences of whole runs, with the noise of these.
#[test]
fn residual_stress_is_a_number_of_stresses_alone() {
    let text = COATED
        .replace("shear_stiffness = <ks> } }]", "shear_stiffness = <ks> }, residual_stress = [<sx>, <sy>] }]")
        .replace("poisson = 0.3 }", "poisson = 0.3, residual_stress = <sb> }")
        .replace("<stress>", &format!("depths = [0.0, 0.1, 0.2]\n{CONSTANTS}"));
    let mut numbers = NUMBERS.to_vec();
    numbers.extend([
        ("sx", -0.05, "lower.coatings[0].residual_stress[0]"),
        ("sy", 0.02, "lower.coatings[0].residual_stress[1]"),
        ("sb", 0.03, "lower.substrate.residual_stress"),
    ]);
    let of: Vec<String> =
        ["stress.von_mises", "stress.tension", "stress.hydrostatic", "cycles[0].fatigue.crossland"]
            .map(str::to_owned)
            .to_vec();
    let off = worst(&text, &numbers, &of, 1e-5);
    assert!(off < 1e-5, "{off:e}");
    let by: Vec<&str> = numbers[10..].iter().map(|(_, _, path)| *path).collect();
    let of = ["stress.hydrostatic", "max_pressure", "stress.tension"].map(str::to_owned);
    let plan_at = |depths: &str| {
        let text = text.replace("[0.0, 0.1, 0.2]", depths);
        planned(&Written { text: &text, numbers: &numbers }.case(None))
    };
    for (depths, thirds) in [("[0.0, 0.1, 0.2]", [1.0, 1.0, 0.0]), ("[0.5, 0.6]", [0.0, 0.0, 2.0])] {
        let found = found_along(&plan_at(depths), &of, &by, Some(Direction::Backward)).unwrap();
        for (by, thirds) in found.gradients[0].by.iter().zip(thirds) {
            assert!((by - thirds / 3.0).abs() < 1e-14, "{depths}: {by}");
        }
        assert_eq!(found.gradients[1].by, [0.0; 3]);
        let counts = found.gradients[2].by.iter().map(|by| *by != 0.0);
        assert!(counts.eq(thirds.map(|thirds| thirds != 0.0)), "{:?}", found.gradients[2].by);
    }
    // The table of all numbers has them.
    let all = found_along(&plan_at("[0.0]"), &of, &[], None).unwrap();
    for path in by {
        assert_eq!(all.parameters.iter().filter(|known| known.path() == path).count(), 1, "{path}");
    }
}
