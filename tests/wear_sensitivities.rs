//! Exact sensitivities of surfaces that wear, one cycle by one and in jumps, against differences of whole runs, the first law, and what wear is.

use fret_core::run::{Silent, Simulation};
use fret_core::sensitivity::Direction;

use crate::sensitivities::{Written, by_numbers, found};

/// A loop of a coated body that wears, in cycles and in a stage of its own.
const WORN: &str = r#"
[grid]
cells = [24, 24]
size = [3.0, 3.0]
[upper]
rigid = true
[lower]
coatings = [{ thickness = <h>, young = <E>, poisson = 0.35 }]
substrate = { young = <Es>, poisson = 0.3 }
[profile.sphere]
radius = <R>
[friction]
coefficient = <mu>
[wear]
law = "<law>"
coefficient = <k>
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
shift = [0.0, 0.0]
increments = 2
"#;
const WORN_NUMBERS: [(&str, f64, &str); 9] = [
    ("h", 0.4, "lower.coatings[0].thickness"),
    ("E", 3.0, "lower.coatings[0].young"),
    ("Es", 1.0, "lower.substrate.young"),
    ("R", 5.0, "profile.sphere.radius"),
    ("mu", 0.3, "friction.coefficient"),
    ("k", 0.3, "wear.coefficient"),
    ("P", 0.15, "load[0].normal_force"),
    ("Q", 0.035, "load[1].tangential_force[0]"),
    ("dx", 0.05, "load[2].shift[0]"),
];

/// Worn volume and depth, and what later increments make of the worn surfaces, by both laws.
#[test]
fn wear_is_differentiated_through_cycles_and_stages() {
    for law in ["energy", "archard"] {
        let text = WORN.replace("<law>", law);
        let columns = [
            "worn_volume",
            "max_worn_depth",
            "max_pressure",
            "approach",
            "dissipated_energy",
            "external_work",
            "unresolved_energy",
            "wear_work",
            "tangential_force_x",
        ];
        let worst = Written { text: &text, numbers: &WORN_NUMBERS }.worst(&columns);
        assert!(worst < 1e-5, "{law}: {worst:e}");
    }
}

/// Cycles that stand for more than themselves, in jumps whose lengths the numbers do not change: 4, 4 and 2 of ten cycles. What a stage of its own
/// leaves of them counts once.
#[test]
fn wear_is_differentiated_through_jumps_over_cycles() {
    for (law, wave) in [("energy", "sine"), ("archard", "triangle")] {
        let text =
            WORN.replace("<law>", law).replace("cycles = 3", &format!("cycles = 10\nwaveform = \"{wave}\""));
        let text = text.replace("[solver]", "every = 4\nlargest_step = 1.0\n[solver]");
        let mut numbers = WORN_NUMBERS;
        numbers[5].1 = 0.03;
        let written = Written { text: &text, numbers: &numbers };
        let cycles = |moved| Simulation::new(&written.plan(moved)).run(&mut Silent).unwrap().cycles;
        let stands_for: Vec<usize> = cycles(None).iter().map(|cycle| cycle.stands_for).collect();
        assert_eq!(stands_for, [4, 4, 2]);
        let columns = [
            "worn_volume",
            "max_worn_depth",
            "max_pressure",
            "approach",
            "dissipated_energy",
            "external_work",
            "unresolved_energy",
            "wear_work",
            "shift_x",
        ];
        let worst = written.worst(&columns);
        assert!(worst < 1e-5, "{law}: {worst:e}");
        // The energy of one cycle is that of its record, whatever it stands for.
        let found = found(&written.plan(None), &["cycles[1].dissipated_energy"], &written.paths()).unwrap();
        let energy = |moved| vec![cycles(moved)[1].dissipated_energy];
        let value = found.gradients[0].value;
        // 1e-12: a difference of sums ten times as large.
        assert!((value / energy(None)[0] - 1.0).abs() < 1e-12, "{value}");
        let by = by_numbers(&found);
        let off = written.off(1e-5, [&by, &by], energy);
        assert!(off < 1e-5, "{law}: {off:e} of {value}");
    }
}

/// A cycle that ends while its load stands takes its wear off then.
#[test]
fn wear_is_differentiated_where_a_cycle_ends_while_its_load_stands() {
    let text = WORN.replace("<law>", "energy").replace(
        "cycles = 3",
        "cycles = 6\nwaveform = \"trapezoid\"\nphase = { tangential_force = [90, 0] }",
    );
    let text = text.replace("[solver]", "every = 2\nlargest_step = 1.0\n[solver]");
    let mut numbers = WORN_NUMBERS;
    (numbers[5].1, numbers[7].1) = (0.03, 0.02);
    let columns = [
        "worn_volume",
        "max_worn_depth",
        "max_pressure",
        "dissipated_energy",
        "external_work",
        "unresolved_energy",
        "wear_work",
    ];
    let worst = Written { text: &text, numbers: &numbers }.worst_both_ways(&columns, Direction::Forward);
    assert!(worst < 1e-5, "{worst:e}");
}

/// By the law of energy the worn volume is the coefficient times the dissipated energy, whatever the numbers; and it is a length cubed: moduli and
/// forces have no effect on it together with the coefficient, which is one over a pressure.
#[test]
fn the_worn_volume_is_the_coefficient_times_the_energy() {
    let text = WORN.replace("<law>", "energy");
    let by: Vec<&str> = WORN_NUMBERS.iter().map(|(_, _, path)| *path).collect();
    let plan = Written { text: &text, numbers: &WORN_NUMBERS }.plan(None);
    let found = found(&plan, &["worn_volume", "dissipated_energy"], &by).unwrap();
    let [volume, energy] = [0, 1].map(|of| &found.gradients[of]);
    let (k, mut scale) = (0.3, 0.0);
    assert!((volume.value / (k * energy.value) - 1.0).abs() < 1e-12);
    for (place, (name, value, path)) in WORN_NUMBERS.iter().enumerate() {
        let own = if *name == "k" { energy.value } else { 0.0 };
        let expected = k * energy.by[place] + own;
        let off = (volume.by[place] - expected).abs() * value / volume.value;
        assert!(off < 1e-8, "{path}: {:e} {expected:e} {off:.1e}", volume.by[place]);
        let power = match *name {
            "E" | "Es" | "P" | "Q" => 1.0,
            "k" => -1.0,
            _ => 0.0,
        };
        scale += power * value * volume.by[place];
    }
    assert!((scale / volume.value).abs() < 1e-7, "{scale:e} {:e}", volume.value);
}

/// The first law, differentiated: by every number the external work changes by what the other energies do together, in jumps over cycles as well. To
/// 1e-9 of the work: both are sums of the same solutions, which are solved to 1e-12, increment after increment.
#[test]
fn energies_of_surfaces_that_wear_change_together() {
    let text = WORN.replace("<law>", "energy").replace("cycles = 3", "cycles = 10");
    let text = text.replace("[solver]", "every = 4\nlargest_step = 1.0\n[solver]");
    let mut numbers = WORN_NUMBERS;
    numbers[5].1 = 0.03;
    let by: Vec<&str> = numbers.iter().map(|(_, _, path)| *path).collect();
    let plan = Written { text: &text, numbers: &numbers }.plan(None);
    let of = ["external_work", "elastic_energy", "dissipated_energy", "wear_work", "unresolved_energy"];
    let found = found(&plan, &of, &by).unwrap();
    for (place, (name, value, _)) in numbers.iter().enumerate() {
        let [work, others @ ..] = [0, 1, 2, 3, 4].map(|of| found.gradients[of].by[place] * value);
        let sum: f64 = others.iter().sum();
        assert!((work - sum).abs() < 1e-9 * found.gradients[0].value, "{name}: {work:e} {sum:e}");
        assert!(others[2] != 0.0, "{name}");
    }
}
