//! Exact sensitivities of friction that evolves, through what slip has done to each cell, against differences of whole runs and dimensional analysis.

use fret_core::run::{Silent, Simulation};

use crate::sensitivities::{Written, found};

/// A loop of a coated body whose friction evolves, in cycles and in a stage of its own.
const EVOLVES: &str = r"
[grid]
cells = [24, 24]
size = [3.0, 3.0]
[upper]
rigid = true
[lower]
coatings = [{ thickness = 0.4, young = <E>, poisson = 0.35 }]
substrate = { young = <Es>, poisson = 0.3 }
[profile.sphere]
radius = <R>
[friction]
coefficient = <mu>
evolution = { <law> }
[solver]
tolerance = 1e-11
[[load]]
normal_force = <P>
increments = 3
[[load]]
tangential_force = [<Q>, 0.0]
cycles = 3
increments = 8
[[load]]
shift = [<dx>, 0.0]
increments = 2
[[load]]
shift = [0.0, 0.01]
increments = 2
";
const NUMBERS: [(&str, f64, &str); 7] = [
    ("E", 3.0, "lower.coatings[0].young"),
    ("Es", 1.0, "lower.substrate.young"),
    ("R", 5.0, "profile.sphere.radius"),
    ("mu", 0.3, "friction.coefficient"),
    ("P", 0.15, "load[0].normal_force"),
    ("Q", 0.035, "load[1].tangential_force[0]"),
    ("dx", 0.03, "load[2].shift[0]"),
];
const COLUMNS: [&str; 8] = [
    "max_pressure",
    "max_shear",
    "approach",
    "shift_x",
    "tangential_force_x",
    "dissipated_energy",
    "external_work",
    "unresolved_energy",
];

/// The numbers of the case with those of a law.
fn with<'a>(more: &[(&'a str, f64, &'a str)]) -> Vec<(&'a str, f64, &'a str)> {
    [&NUMBERS[..], more].concat()
}

/// By what a cell has dissipated, by how far it has slid, and by the cycles; exponential laws and tables.
#[test]
fn friction_that_evolves_is_differentiated_through_its_memory() {
    let exponential = |scale: f64| {
        with(&[("last", 0.5, "friction.evolution.last"), ("scale", scale, "friction.evolution.scale")])
    };
    let laws = [
        ("by = \"energy\", last = <last>, scale = <scale>", exponential(2e-3)),
        ("by = \"slip_distance\", last = <last>, scale = <scale>", exponential(0.02)),
        ("by = \"cycles\", last = <last>, scale = <scale>", exponential(2.0)),
        (
            "by = \"energy\", table = [[0.0, <mu>], [<x1>, <y1>], [<x2>, <y2>]]",
            with(&[
                ("x1", 1e-3, "friction.evolution.table[1][0]"),
                ("y1", 0.4, "friction.evolution.table[1][1]"),
                ("x2", 1e-2, "friction.evolution.table.2.0"),
                ("y2", 0.5, "friction.evolution.table.2.1"),
            ]),
        ),
    ];
    for (law, numbers) in laws {
        let text = EVOLVES.replace("<law>", law);
        let written = Written { text: &text, numbers: &numbers };
        let worst = written.worst(&COLUMNS);
        assert!(worst < 1e-5, "{law}: {worst:e}");
        // What the last stages dissipate and carry depends on all of the law.
        let found =
            found(&written.plan(None), &["tangential_force_x", "dissipated_energy"], &written.paths());
        let found = found.unwrap();
        assert!(found.gradients.iter().all(|of| of.by[NUMBERS.len()..].iter().any(|by| by.abs() > 1e-9)));
        // A force changes by one per cent with all moduli, forces and the energies by area of the law.
        let by_energy = law.contains("energy");
        for gradient in &found.gradients {
            let parts = gradient.by.iter().zip(&numbers);
            let power = |name: &str| match name {
                "E" | "Es" | "P" | "Q" => 1.0,
                "scale" | "x1" | "x2" if by_energy => 1.0,
                _ => 0.0,
            };
            let sum: f64 = parts.map(|(by, (name, value, _))| power(name) * value * by).sum();
            assert!((sum / gradient.value - 1.0).abs() < 1e-7, "{law}, {}: {sum:e}", gradient.of);
        }
    }
}

/// In jumps over cycles whose lengths the numbers do not change, of surfaces that wear by that energy as well; and of similar bodies, by end points.
#[test]
fn friction_that_evolves_is_differentiated_through_jumps_and_wear() {
    let law = "by = \"energy\", last = <last>, scale = <scale>, every = 4, tolerance = 1.0";
    let mut numbers =
        with(&[("last", 0.5, "friction.evolution.last"), ("scale", 8e-3, "friction.evolution.scale")]);
    numbers.push(("k", 0.03, "wear.coefficient"));
    numbers[0].1 = 3.1; // no cell changes its state within a step
    let wears = "[wear]\ncoefficient = <k>\nevery = 4\nlargest_step = 1.0\n[solver]";
    let text = EVOLVES.replace("<law>", law).replace("cycles = 3", "cycles = 10").replace("[solver]", wears);
    let written = Written { text: &text, numbers: &numbers };
    let cycles = Simulation::new(&written.plan(None)).run(&mut Silent).unwrap().cycles;
    assert_eq!(cycles.iter().map(|cycle| cycle.stands_for).collect::<Vec<_>>(), [4, 4, 2]);
    let columns = [&COLUMNS[..], &["worn_volume", "max_worn_depth", "wear_work"]].concat();
    let worst = written.worst(&columns);
    assert!(worst < 1e-5, "{worst:e}");
    let similar = EVOLVES
        .replace("<law>", law)
        .replace("coatings = [{ thickness = 0.4, young = <E>, poisson = 0.35 }]\n", "")
        .replace("poisson = 0.3 }", "poisson = 0.5 }")
        .replace("[solver]", "[solver]\nintegration = \"end_point\"");
    let mut numbers = numbers[1..].to_vec();
    numbers.pop();
    let worst = Written { text: &similar, numbers: &numbers }.worst(&COLUMNS);
    assert!(worst < 1e-5, "{worst:e}");
}

/// A law that leads nowhere is friction that does not evolve: it does not depend on the scale, and on both coefficients together as on the one.
#[test]
fn a_law_that_leads_nowhere_is_one_coefficient() {
    let law = "by = \"energy\", last = <mu>, scale = 2e-3";
    let text = EVOLVES.replace("<law>", law);
    let plain = EVOLVES.replace("evolution = { <law> }\n", "");
    let [evolves, plain] = [&text, &plain].map(|text| Written { text, numbers: &NUMBERS }.plan(None));
    let of = ["dissipated_energy", "tangential_force_x", "max_shear"];
    let path = "friction.coefficient";
    let plain = found(&plain, &of, &[path]).unwrap();
    let both = ["friction.evolution.last", "friction.evolution.scale"];
    let evolves = found(&evolves, &of, &[path, both[0], both[1]]).unwrap();
    for (one, other) in plain.gradients.iter().zip(&evolves.gradients) {
        assert_eq!(one.value, other.value, "{}", one.of);
        let [first, last, scale] = [0, 1, 2].map(|number| other.by[number]);
        // Of linear equations solved to 1e-12, increment after increment.
        let off = (one.by[0] - first - last).abs() / one.by[0].abs();
        assert!(off < 1e-9 && scale == 0.0, "{}: {first:e} {last:e} {scale:e}", one.of);
        assert!(last != 0.0, "{}", one.of);
    }
}
