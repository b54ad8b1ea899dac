//! Exact sensitivities of surfaces that wear, one cycle by one and in jumps, against differences of whole runs, the first law, and what wear is.

use fret_core::run::{Silent, Simulation};
use fret_core::sensitivity::Direction;

use crate::sensitivities::{Written, by_numbers, found, planned};

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
/// Thickness of a film that wears through in some cells.
const FILM: f64 = 1.5e-4;
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
    let k = 0.3;
    assert!((volume.value / (k * energy.value) - 1.0).abs() < 1e-12);
    for (place, (name, value, path)) in WORN_NUMBERS.iter().enumerate() {
        let own = if *name == "k" { energy.value } else { 0.0 };
        let expected = k * energy.by[place] + own;
        let off = (volume.by[place] - expected).abs() * value / volume.value;
        assert!(off < 1e-8, "{path}: {:e} {expected:e} {off:.1e}", volume.by[place]);
    }
    dimensions(&volume.by, volume.value, &WORN_NUMBERS);
}

/// A film that wears through, what lies below it and the other body, each by its own coefficient: by these, and by the thickness of the film, with
/// which the place of the boundary moves. One cycle by one and in jumps; the film is gone in some cells, and in others it is not.
#[test]
fn wear_through_layers_is_differentiated_by_coefficients_and_thicknesses() {
    let layered = WORN
        .replace("poisson = 0.35 }", "poisson = 0.35, wear_coefficient = <k> }")
        .replace("poisson = 0.3 }", "poisson = 0.3, wear_coefficient = <ks> }")
        .replace("rigid = true", "rigid = true\nwear_coefficient = <ku>")
        .replace("coefficient = <k>\n[solver]", "[solver]");
    let mut numbers =
        [&WORN_NUMBERS[..], &[("ks", 0.1, ""), ("ku", 0.05, "upper.wear_coefficient")]].concat();
    (numbers[0].1, numbers[5].2) = (FILM, "lower.coatings[0].wear_coefficient");
    numbers[6].1 = 0.148; // differences to either side agree: no cell changes its state within a step
    numbers[9].2 = "lower.substrate.wear_coefficient";
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
    let jumps = "every = 2\nlargest_step = 1.0\n[solver]";
    for (law, cycles, jumps) in [("energy", 3, "[solver]"), ("archard", 4, jumps)] {
        let text = layered.replace("<law>", law).replace("cycles = 3", &format!("cycles = {cycles}"));
        let text = text.replace("[solver]", jumps);
        let written = Written { text: &text, numbers: &numbers };
        let history = Simulation::new(&written.plan(None)).run(&mut Silent).unwrap();
        // In some cells it has worn through, and what lies below it wears.
        let film = history.worn_by_layer.unwrap().lower;
        assert!(film.iter().all(|volume| *volume > 0.0), "{film:?}");
        let worst = written.worst(&columns);
        assert!(worst < 1e-5, "{law}: {worst:e}");
        let found = found(&written.plan(None), &["worn_volume"], &written.paths()).unwrap();
        dimensions(&found.gradients[0].by, found.gradients[0].value, &numbers);
    }
}

/// Layers of one coefficient are one body: the derivatives by it are the sum of those by each layer, and how thick the film is does not matter beyond
/// what it does to the response. To 1e-8 of the result: both are solved to 1e-11.
#[test]
fn layers_of_one_coefficient_are_differentiated_as_one_body() {
    let text = WORN.replace("<law>", "energy");
    let layered = text
        .replace("poisson = 0.35 }", "poisson = 0.35, wear_coefficient = <k> }")
        .replace("poisson = 0.3 }", "poisson = 0.3, wear_coefficient = <k> }")
        .replace("coefficient = <k>\n[solver]", "[solver]");
    let mut numbers = WORN_NUMBERS;
    numbers[0].1 = FILM;
    let paths: Vec<&str> = numbers.iter().map(|(_, _, path)| *path).collect();
    let of = ["worn_volume", "max_worn_depth", "max_pressure", "dissipated_energy"];
    let one = found(&Written { text: &text, numbers: &numbers }.plan(None), &of, &paths).unwrap();
    let mut layer_by_layer = paths.clone();
    layer_by_layer[5] = "lower.coatings[0].wear_coefficient";
    layer_by_layer.push("lower.substrate.wear_coefficient");
    let each =
        found(&Written { text: &layered, numbers: &numbers }.plan(None), &of, &layer_by_layer).unwrap();
    for (one, each) in one.gradients.iter().zip(&each.gradients) {
        assert!((one.value / each.value - 1.0).abs() < 1e-9, "{} {}", one.of, each.value);
        let substrate = each.by[paths.len()];
        for (place, (name, value, _)) in numbers.iter().enumerate() {
            let found = each.by[place] + if *name == "k" { substrate } else { 0.0 };
            let off = (found - one.by[place]).abs() * value / one.value.abs();
            assert!(off < 1e-8, "{} by {name}: {found:e} {:e}", one.of, one.by[place]);
        }
        let share = substrate / (each.by[5] + substrate);
        assert!(one.of == "max_pressure" || (0.05..0.95).contains(&share), "{}: {share}", one.of);
    }
}

/// More wear at the rim: by its width and by the part of the coefficient that is in force inside of it.
#[test]
fn wear_at_the_rim_is_differentiated() {
    let rim = "[wear.rim]\nwidth = <w>\ninterior = <i>\n[solver]";
    for law in ["energy", "archard"] {
        let text = WORN.replace("<law>", law).replace("[solver]", rim);
        let numbers =
            [&WORN_NUMBERS[..], &[("w", 0.3, "wear.rim.width"), ("i", 0.4, "wear.rim.interior")]].concat();
        let columns =
            ["worn_volume", "max_worn_depth", "max_pressure", "approach", "dissipated_energy", "wear_work"];
        let worst = Written { text: &text, numbers: &numbers }.worst(&columns);
        assert!(worst < 1e-5, "{law}: {worst:e}");
    }
}

/// Debris that stays and flows out with the slip, of one coefficient and of layers, in jumps: by its fraction and its outflow length, too.
#[test]
fn wear_with_debris_is_differentiated() {
    let debris = "[wear.debris]\nfraction = <f>\noutflow_length = <L>\n[solver]";
    let layered = WORN
        .replace("poisson = 0.35 }", "poisson = 0.35, wear_coefficient = <k> }")
        .replace("poisson = 0.3 }", "poisson = 0.3, wear_coefficient = 0.1 }")
        .replace("coefficient = <k>\n[solver]", "every = 2\nlargest_step = 1.0\n[solver]")
        .replace("cycles = 3", "cycles = 4");
    let mut numbers =
        [&WORN_NUMBERS[..], &[("f", 0.6, "wear.debris.fraction"), ("L", 0.05, "wear.debris.outflow_length")]]
            .concat();
    for (text, thickness, path) in
        [(WORN, 0.4, "wear.coefficient"), (&layered, FILM, "lower.coatings[0].wear_coefficient")]
    {
        (numbers[0].1, numbers[5].2) = (thickness, path);
        let text = text.replace("<law>", "energy").replace("[solver]", debris);
        let columns = [
            "worn_volume",
            "max_worn_depth",
            "max_pressure",
            "approach",
            "dissipated_energy",
            "external_work",
            "unresolved_energy",
            "wear_work",
        ];
        let worst = Written { text: &text, numbers: &numbers }.worst(&columns);
        assert!(worst < 1e-5, "{path}: {worst:e}");
    }
}

/// What has no derivative, or is not in the case, is refused by its name.
#[test]
fn numbers_that_the_surfaces_do_not_have_are_refused() {
    let text = Written { text: &WORN.replace("<law>", "energy"), numbers: &WORN_NUMBERS }.case(None);
    let layered = text
        .replace("poisson = 0.35 }", "poisson = 0.35, wear_coefficient = 0.0 }")
        .replace("poisson = 0.3 }", "poisson = 0.3, wear_coefficient = 0.1 }")
        .replace("coefficient = 3e-1\n[solver]", "[solver]");
    let evolves = text.replace(
        "coefficient = 3e-1\n[wear]",
        "coefficient = 0.3\nevolution = { by = \"cycles\", table = [[0, 0.3], [4, 0.5]] }\n[wear]",
    );
    for (text, by, word) in [
        (&text, "lower.coatings[0].wear_coefficient", "layers of the case have none"),
        (&text, "wear.rim.width", "no wear.rim"),
        (&text, "wear.debris.fraction", "no wear.debris"),
        (&text, "friction.evolution.last", "does not evolve"),
        (&layered, "wear.coefficient", "each layer has its own"),
        (&layered, "lower.coatings[0].wear_coefficient", "does not wear"),
        (&layered, "lower.coatings[1].wear_coefficient", "1 coatings"),
        (&layered, "lower.wear_coefficient", "paths are those of the case"),
        (&layered, "upper.wear_coefficient", "this body have none"),
        (&evolves, "friction.evolution.last", "table[1][1]"),
        (&evolves, "friction.evolution.table[0][1]", "friction.coefficient"),
        (&evolves, "friction.evolution.table[2][1]", "2 rows"),
        (&evolves, "friction.evolution.table[1]", "table[1][1]"),
        (&evolves, "friction.evolution.table[1][2]", "table[1][1]"),
        (&evolves, "friction.evolution.table[1][1", "paths"),
    ] {
        let message = found(&planned(text), &["max_pressure"], &[by]).unwrap_err().to_string();
        assert!(message.contains(word) && message.contains(by), "{message}");
    }
    let message = found(&planned(&evolves), &["friction_coefficient"], &[]).unwrap_err().to_string();
    assert!(message.contains("differs from cell to cell"), "{message}");
    let debris = text.replace("[solver]", "[wear.debris]\nfraction = 0.5\nstiffness = 1.0\n[solver]");
    let message = found(&planned(&debris), &["max_pressure"], &[]).unwrap_err().to_string();
    assert!(message.contains("wear.debris"), "{message}");
}

/// Dimensional analysis: a length does not change with all moduli, forces and, inversely, wear coefficients together.
fn dimensions(by: &[f64], value: f64, numbers: &[(&str, f64, &str)]) {
    let sum: f64 = by.iter().zip(numbers).map(|(by, (name, number, _))| power(name) * number * by).sum();
    // as solved, three cycles
    assert!((sum / value).abs() < 1e-7, "{sum:e} {value:e}");
}

/// The power of a pressure in a number.
fn power(name: &str) -> f64 {
    match name {
        "E" | "Es" | "P" | "Q" => 1.0,
        "k" | "ks" | "ku" => -1.0,
        _ => 0.0,
    }
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
