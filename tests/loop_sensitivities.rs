//! Exact sensitivities of what is read from the loop of a cycle, against differences of whole runs and closed forms.

use fret_core::history::CYCLE_COLUMNS;
use fret_core::run::{Silent, Simulation};
use fret_core::sensitivity::{Direction, SensitivityError};

use crate::sensitivities::{Written, by_numbers, found, found_along};

/// Largest difference of derivatives of columns of a cycle from central differences of runs, over value and derivative; both ways agree to 1e-9.
fn worst(written: &Written<'_>, cycle: usize, columns: &[&str]) -> f64 {
    let results = |moved| {
        let history = Simulation::new(&written.plan(moved)).run(&mut Silent).unwrap();
        let of = |name: &&str| {
            let column = CYCLE_COLUMNS.iter().find(|column| column.name == *name).unwrap();
            column.number(&history.cycles[cycle]).unwrap()
        };
        columns.iter().map(of).collect()
    };
    let of: Vec<String> = columns.iter().map(|column| format!("cycles[{cycle}].{column}")).collect();
    let [forward, back] = [Direction::Forward, Direction::Backward]
        .map(|direction| found_along(&written.plan(None), &of, &written.paths(), Some(direction)).unwrap());
    assert_eq!(back.direction, Direction::Backward);
    written.off(1e-5, [&by_numbers(&forward), &by_numbers(&back)], results)
}

fn body(rest: &str) -> String {
    format!(
        "[grid]\ncells = [24, 24]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\ncoatings = [{{ thickness = 0.4, young = <E>, poisson = 0.3 }}]\n\
         substrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.sphere]\nradius = 5.0\n[solver]\ntolerance = 1e-11\n[friction]\n\
         coefficient = <mu>\n{rest}"
    )
}

const COMMON: [(&str, f64, &str); 2] =
    [("E", 2.0, "lower.coatings[0].young"), ("mu", 0.3, "friction.coefficient")];
const PLAIN: [&str; 6] =
    ["force_amplitude", "displacement_amplitude", "opening", "energy_ratio", "sliding_ratio", "stiffness"];
const AT_ACTUATOR: [&str; 4] =
    ["actuator_amplitude", "actuator_energy_ratio", "actuator_sliding_ratio", "actuator_stiffness"];

/// Partial slip: width and slope by chords. By force, by an ellipse of two forces (whose main axis turns), by twist.
#[test]
fn loops_in_partial_slip_are_differentiated() {
    for (rule, rest, more, columns) in [
        (
            "second_order",
            "tangential_force = [<Q>, 0.0]\ncycles = 2\nincrements = 16\n",
            vec![("Q", 0.03, "load[1].tangential_force[0]")],
            &PLAIN[..],
        ),
        // In the ellipse the rule of second order steps here, by 3e-8 of the amplitude: differences have that in them.
        (
            "end_point",
            "tangential_force = [<Q>, <Q2>]\nphase = { tangential_force = [0, 30] }\nwaveform = \"sine\"\ncycles = 2\nincrements = 16\n",
            vec![("Q", 0.025, "load[1].tangential_force[0]"), ("Q2", 0.012, "load[1].tangential_force[1]")],
            &["direction", "force_amplitude", "displacement_amplitude", "opening", "energy_ratio"],
        ),
        (
            "second_order",
            "twist = <phi>\ncycles = 2\nincrements = 16\n",
            vec![("phi", 0.02, "load[1].twist")],
            &["force_amplitude", "displacement_amplitude", "opening", "energy_ratio", "stiffness"],
        ),
    ] {
        let text = body(&format!("[[load]]\nnormal_force = <P>\nincrements = 3\n[[load]]\n{rest}"));
        let text = text.replace("tolerance = 1e-11", &format!("tolerance = 1e-11\nintegration = \"{rule}\""));
        let numbers = [&COMMON[..], &[("P", 0.15, "load[0].normal_force")], &more].concat();
        let worst = worst(&Written { text: &text, numbers: &numbers }, 1, columns);
        assert!(worst < 1e-5, "{rest}: {worst:e}");
    }
}

/// Gross slip: width and slope by the flanks of a loop that slides, with and without a machine that gives.
#[test]
fn loops_that_slide_are_differentiated() {
    for (rig, drive, more, columns) in [
        ("", "shift = [<d>, 0.0]", vec![("d", 0.12, "load[1].shift[0]")], PLAIN.to_vec()),
        (
            "[rig]\ntangential_stiffness = <k>\n",
            "actuator = [<d>, 0.0]",
            vec![("d", 0.2, "load[1].actuator[0]"), ("k", 1.5, "rig.tangential_stiffness")],
            [&PLAIN[..], &AT_ACTUATOR].concat(),
        ),
    ] {
        let text = body(&format!(
            "{rig}[[load]]\nnormal_force = <P>\nincrements = 3\n[[load]]\n{drive}\ncycles = 2\nincrements = 24\n"
        ));
        let numbers = [&COMMON[..], &[("P", 0.15, "load[0].normal_force")], &more].concat();
        let written = Written { text: &text, numbers: &numbers };
        let worst = worst(&written, 1, &columns);
        assert!(worst < 1e-5, "{drive}: {worst:e}");
        // The force that slides is that of friction: its logarithmic derivatives by both are 1. 1e-4: the plateau is level to that.
        let found = found(
            &written.plan(None),
            &["cycles[1].force_amplitude"],
            &["friction.coefficient", "load[0].normal_force"],
        );
        let found = &found.unwrap().gradients[0];
        for (by, value) in found.by.iter().zip([0.3, 0.15]) {
            assert!((by * value / found.value - 1.0).abs() < 1e-4, "{} {}", by * value, found.value);
        }
    }
}

/// Cycles that stand for more than themselves, of surfaces that wear: energy and worn volume of one are those of its record.
#[test]
fn loops_of_cycles_in_jumps_are_differentiated() {
    let text = body(
        "[wear]\ncoefficient = <k>\nevery = 3\nlargest_step = 1.0\n[[load]]\nnormal_force = <P>\nincrements = 3\n[[load]]\nshift = [<d>, 0.0]\n\
         cycles = 6\nincrements = 24\n",
    );
    let more = [
        ("P", 0.15, "load[0].normal_force"),
        ("d", 0.12, "load[1].shift[0]"),
        ("k", 0.02, "wear.coefficient"),
    ];
    let numbers = [&COMMON[..], &more].concat();
    let columns =
        [&PLAIN[..], &["dissipated_energy", "total_dissipated_energy", "worn_volume", "max_worn_depth"]]
            .concat();
    let worst = worst(&Written { text: &text, numbers: &numbers }, 1, &columns);
    assert!(worst < 1e-5, "{worst:e}");
}

/// What a cycle does not have is refused in its words.
#[test]
fn numbers_that_a_loop_lacks_are_refused() {
    let text = body(
        "[[load]]\nnormal_force = 0.15\nincrements = 2\n[[load]]\ntangential_force = [0.02, 0.0]\ncycles = 1\nincrements = 4\n",
    );
    let plan = Written { text: &text, numbers: &COMMON }.plan(None);
    for (of, words) in [("actuator_stiffness", "has none"), ("closure", "stiffness")] {
        let refused = found(&plan, &[&format!("cycles[0].{of}")], &["friction.coefficient"]).unwrap_err();
        assert!(matches!(refused, SensitivityError::Objective { .. }), "{refused}");
        assert!(refused.to_string().contains(words), "{refused}");
    }
}
