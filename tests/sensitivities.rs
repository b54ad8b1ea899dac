//! Exact sensitivities against what they were not computed by: differences of whole runs, dimensional analysis. Closed forms:
//! `sensitivity_limits.rs`.

use fret_core::case::Case;
use fret_core::history::{STEP_COLUMNS, StepRecord};
use fret_core::plan::Plan;
use fret_core::run::{Silent, Simulation};
use fret_core::sensitivity::{Direction, Request, Sensitivities, SensitivityError, gradient};
use fret_validation::random::Random;

/// A case with names in angle brackets for its numbers.
pub struct Written<'a> {
    pub text: &'a str,
    /// Name, value, path.
    pub numbers: &'a [(&'a str, f64, &'a str)],
}

pub fn planned(text: &str) -> Plan {
    Plan::new(Case::from_toml(text, "case.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))).unwrap()
}

/// Derivatives of each result by all numbers.
pub fn by_numbers(found: &Sensitivities) -> Vec<Vec<f64>> {
    found.gradients.iter().map(|gradient| gradient.by.clone()).collect()
}

pub fn found(plan: &Plan, of: &[&str], by: &[&str]) -> Result<Sensitivities, SensitivityError> {
    found_along(plan, of, by, None)
}

pub fn found_along(
    plan: &Plan,
    of: &[impl AsRef<str>],
    by: &[&str],
    direction: Option<Direction>,
) -> Result<Sensitivities, SensitivityError> {
    let of = of.iter().map(|name| name.as_ref().to_owned()).collect();
    let by = by.iter().map(|path| (*path).to_owned()).collect();
    gradient(plan, &Request { of, by, direction }, &mut Silent)
}

impl Written<'_> {
    /// The case with its numbers, one of which is `moved` by a fraction of itself.
    pub fn case(&self, moved: Option<(usize, f64)>) -> String {
        let mut text = self.text.to_owned();
        for (number, (name, value, _)) in self.numbers.iter().enumerate() {
            let factor = moved.filter(|(which, _)| *which == number).map_or(1.0, |(_, by)| 1.0 + by);
            text = text.replace(&format!("<{name}>"), &format!("{:e}", value * factor));
        }
        text
    }

    pub fn plan(&self, moved: Option<(usize, f64)>) -> Plan {
        planned(&self.case(moved))
    }

    fn columns(&self, columns: &[&str], moved: Option<(usize, f64)>) -> Vec<Vec<f64>> {
        let plan = self.plan(moved);
        let history = Simulation::new(&plan).run(&mut Silent).unwrap();
        let columns: Vec<_> = columns
            .iter()
            .map(|name| STEP_COLUMNS.iter().find(|column| column.name == *name).unwrap())
            .collect();
        let of = |record: &StepRecord| columns.iter().map(|column| column.number(record).unwrap()).collect();
        history.steps.iter().map(of).collect()
    }

    /// Paths of its numbers.
    pub fn paths(&self) -> Vec<&str> {
        self.numbers.iter().map(|(_, _, path)| *path).collect()
    }

    /// Largest difference of derivatives, each list those of a result by all numbers, from central differences of the results of whole runs in steps
    /// of a fraction, over result and derivative. Those found both ways agree to 1e-9, which leaves room for the condition of linear equations that
    /// are solved to 1e-12, increment after increment.
    pub fn off(
        &self,
        step: f64,
        [one, other]: [&[Vec<f64>]; 2],
        results: impl Fn(Option<(usize, f64)>) -> Vec<f64>,
    ) -> f64 {
        let values = results(None);
        let mut worst = 0.0_f64;
        for (number, (name, value, _)) in self.numbers.iter().enumerate() {
            let [up, down] = [step, -step].map(|step| results(Some((number, step))));
            for (result, size) in values.iter().map(|value| value.abs()).enumerate() {
                let expected = (up[result] - down[result]) / (2.0 * step);
                let [one, other] = [one, other].map(|by| by[result][number] * value);
                worst = worst.max((one - expected).abs() / (size + expected.abs()));
                let apart = (one - other).abs();
                assert!(apart < 1e-9 * (size + one.abs()), "result {result} by {name}: {one:e}, {other:e}");
            }
        }
        worst
    }

    /// Largest difference of any derivative in any increment from the central difference of runs, over the largest value of the column and
    /// the derivative.
    pub fn worst(&self, columns: &[&str]) -> f64 {
        self.worst_both_ways(columns, Direction::Backward)
    }

    /// The same of a history of which derivatives asked for backwards are taken this way.
    pub fn worst_both_ways(&self, columns: &[&str], backwards: Direction) -> f64 {
        // With a step so small hardly any cell changes its state; a tolerance of 1e-11 leaves 1e-6 of noise.
        const STEP: f64 = 1e-5;
        // Of linear equations solved to 1e-12, increment after increment, what is left of a derivative that is a millionth of the others.
        const OWN: f64 = 1e-6;
        let plan = self.plan(None);
        let steps = self.columns(columns, None);
        let names: Vec<String> = (0..steps.len())
            .flat_map(|increment| {
                columns.iter().map(move |column| format!("increments[{increment}].{column}"))
            })
            .collect();
        let of: Vec<&str> = names.iter().map(String::as_str).collect();
        let along = |direction| found_along(&plan, &of, &self.paths(), Some(direction)).unwrap();
        let (found, back) = (along(Direction::Forward), along(Direction::Backward));
        assert_eq!(back.direction, backwards);
        let mut worst = 0.0_f64;
        for (number, (name, value, _)) in self.numbers.iter().enumerate() {
            let [up, down] = [STEP, -STEP].map(|step| self.columns(columns, Some((number, step))));
            for (place, column) in columns.iter().enumerate() {
                let size = steps.iter().fold(0.0_f64, |most, step| most.max(step[place].abs()));
                // Both ways by the largest derivative of this column by this number, however small beside the column; 1e-11 of that
                // is what the linear equations leave of a derivative that is zero.
                let both: Vec<[f64; 2]> = (0..steps.len())
                    .map(|increment| increment * columns.len() + place)
                    .map(|at| [found.gradients[at].by[number], back.gradients[at].by[number]])
                    .collect();
                let largest = both.iter().fold(0.0_f64, |most, [forward, _]| most.max(forward.abs()));
                for (increment, [forward, backward]) in both.iter().enumerate() {
                    assert!(
                        (forward - backward).abs() * value <= OWN * largest * value + 1e-11 * size,
                        "increment {increment}, {column} by {name}: {forward:e}, backwards {backward:e}, largest {largest:e}"
                    );
                }
                for (increment, step) in steps.iter().enumerate() {
                    let expected = (up[increment][place] - down[increment][place]) / (2.0 * STEP);
                    let gradient = &found.gradients[increment * columns.len() + place];
                    let found = gradient.by[number] * value;
                    let off = (found - expected).abs() / (size + expected.abs()).max(f64::MIN_POSITIVE);
                    assert!(
                        off < 1e-5,
                        "increment {increment}, {column} by {name}: {found:e}, difference {expected:e}"
                    );
                    worst = worst.max(off);
                    assert_eq!(gradient.value, step[place]);
                    // Both ways solve the same equations to 1e-12; 1e-9 leaves room for their condition, increment after increment.
                    let back = back.gradients[increment * columns.len() + place].by[number] * value;
                    let off = (found - back).abs() / (size + found.abs()).max(f64::MIN_POSITIVE);
                    assert!(
                        off < 1e-9,
                        "increment {increment}, {column} by {name}: {found:e}, backwards {back:e}, off {off:.1e}"
                    );
                }
            }
        }
        worst
    }
}

pub const SIMILAR: &str = r"
[grid]
cells = [32, 32]
size = [320e-6, 320e-6]
[upper]
rigid = true
[lower]
substrate = { young = <E>, poisson = 0.5 }
[profile.sphere]
radius = <R>
[friction]
coefficient = <mu>
[solver]
tolerance = 1e-11
[[load]]
normal_force = <P>
increments = 3
[[load]]
tangential_force = [<Q>, 0.0]
cycles = 1
increments = 8
";

const NUMBERS: [(&str, f64, &str); 5] = [
    ("R", 10e-3, "profile.sphere.radius"),
    ("mu", 0.3, "friction.coefficient"),
    ("P", 12.0, "load[0].normal_force"),
    ("Q", 2.5, "load[1].tangential_force[0]"),
    ("E", 210e9, "lower.substrate.young"),
];

const COLUMNS: [&str; 10] = [
    "normal_force",
    "approach",
    "shift_x",
    "tangential_force_x",
    "max_pressure",
    "max_shear",
    "dissipated_energy",
    "elastic_energy",
    "external_work",
    "unresolved_energy",
];

// The tolerance of all comparisons with differences, 1e-5, is that of their noise and of what a rare change of a cell adds.

#[test]
fn a_loop_of_similar_bodies_is_differentiated() {
    assert!(Written { text: SIMILAR, numbers: &NUMBERS }.worst(&COLUMNS) < 1e-5);
}

/// What is told of cells near a change of their state does not depend on the way, nor on what the case does after the increment that is asked for.
#[test]
fn cells_near_a_change_of_state_are_the_same_both_ways() {
    // A force that turns back by a ten-millionth: the cells that slid stick, as near to their bound.
    let turned = "tangential_force = [<Q>, 0.0]\nincrements = 3\n[[load]]\ntangential_force = [2.49999975, 0.0]\nincrements = 1\n[[load]]\n\
                  tangential_force = [0.5, 0.0]\nincrements = 2";
    let text = SIMILAR.replace("tangential_force = [<Q>, 0.0]\ncycles = 1\nincrements = 8", turned);
    let plan = Written { text: &text, numbers: &NUMBERS }.plan(None);
    for column in ["shift_x", "max_pressure"] {
        for increment in [4, 6, 8] {
            let of = format!("increments[{increment}].{column}");
            let [forward, backward] = [Direction::Forward, Direction::Backward].map(|direction| {
                let by = ["profile.sphere.radius", "friction.coefficient"];
                let found = found_along(&plan, &[&of], &by, Some(direction)).unwrap();
                assert_eq!(found.direction, direction);
                found.near_events
            });
            assert_eq!(forward, backward, "{of}");
            assert_eq!(
                forward.map(|near| near.increment),
                (increment >= 6).then_some(6),
                "{of}: {forward:?}"
            );
        }
    }
}

/// At the place where cells that slid are about to stick, derivatives on the other side are those of a force that goes on by as little: with the
/// first difference in the shift by the force, of a loop that turns or not.
#[test]
fn derivatives_on_the_other_side_are_those_of_a_case_beyond() {
    let of_force = |last: f64| {
        let stages = format!(
            "tangential_force = [<Q>, 0.0]\nincrements = 3\n[[load]]\ntangential_force = [{last}, 0.0]\nincrements = 1\n"
        );
        let text = SIMILAR.replace("tangential_force = [<Q>, 0.0]\ncycles = 1\nincrements = 8\n", &stages);
        Written { text: &text, numbers: &NUMBERS }.plan(None)
    };
    let [turns, goes_on] = [of_force(2.499_999_75), of_force(2.500_000_25)];
    for direction in [Direction::Forward, Direction::Backward] {
        let by = ["load[2].tangential_force[0]"];
        let [turns, goes_on] =
            [&turns, &goes_on].map(|plan| found_along(plan, &["shift_x"], &by, Some(direction)).unwrap());
        assert!(turns.near_events.is_some());
        let (own, other) =
            (turns.gradients[0].by[0], turns.gradients[0].on_the_other_side.clone().unwrap()[0]);
        let beyond = goes_on.gradients[0].by[0];
        // Slip gives more than stick, by tenths.
        assert!(own < 0.9 * beyond, "{own:e} {beyond:e}");
        assert!((other / beyond - 1.0).abs() < 1e-3, "{direction:?}: {other:e} {beyond:e} {own:e}");
    }
}

/// Of a history that takes much memory some increments are kept, and those between found again: the same bits.
#[test]
fn derivatives_do_not_depend_on_the_increments_that_are_kept() {
    let text = SIMILAR.replace("poisson = 0.5", "poisson = 0.2").replace("increments = 8", "increments = 32");
    let mut plan = Written { text: &text, numbers: &NUMBERS }.plan(None);
    let by: Vec<&str> = NUMBERS.iter().map(|(_, _, path)| *path).collect();
    let of = ["dissipated_energy", "increments[4].shift_x"];
    let all = found_along(&plan, &of, &by, Some(Direction::Backward)).unwrap();
    plan.memory_bytes = 0;
    let some = found_along(&plan, &of, &by, Some(Direction::Backward)).unwrap();
    assert_eq!(all.gradients, some.gradients);
    assert!(some.work.kept_bytes < all.work.kept_bytes, "{:?} {:?}", some.work, all.work);
}

/// A loop of 64 + 32 increments on 128 x 128 cells: what derivatives keep is less than what the run takes, by the count of both; so together they
/// take less than twice as much.
#[test]
#[ignore = "long: 96 increments on 128 x 128 cells"]
fn derivatives_keep_less_than_the_run_takes() {
    let text = "[grid]\ncells = [128, 128]\nsize = [400e-6, 400e-6]\n[upper]\nrigid = true\n[lower]\ncoatings = [{ thickness = 80e-6, \
                young = 462e9, poisson = 0.2 }]\nsubstrate = { young = 210e9, poisson = 0.3 }\n[profile.sphere]\nradius = 10e-3\n[friction]\n\
                coefficient = 0.3\n[[load]]\nnormal_force = 50.0\nincrements = 64\nramp = \"cubic\"\n[[load]]\n\
                tangential_force = [9.0, 0.0]\ncycles = 1\nincrements = 32\n";
    let plan = planned(text);
    let found = found_along(&plan, &["dissipated_energy"], &[], Some(Direction::Backward)).unwrap();
    assert!(found.work.kept_bytes < plan.memory_bytes, "{:?} {}", found.work, plan.memory_bytes);
}

#[test]
fn a_loop_of_dissimilar_bodies_is_differentiated_by_both_rules() {
    for integration in ["end_point", "second_order"] {
        let rule = format!("tolerance = 1e-11\nintegration = \"{integration}\"");
        let text = SIMILAR.replace("poisson = 0.5", "poisson = 0.2").replace("tolerance = 1e-11", &rule);
        assert!(Written { text: &text, numbers: &NUMBERS }.worst(&COLUMNS) < 1e-5, "{integration}");
    }
}

const COATED: &str = r#"
[grid]
cells = [24, 24]
size = [3.0, 3.0]
[upper]
substrate = { young = <Eu>, poisson = <nu> }
[lower]
coatings = [
  { thickness = <h1>, young = <E1>, poisson = <n1> },
  { thickness = <h2>, young = <E2>, poisson = 0.25, interface = { shear_stiffness = <ks> } },
]
substrate = { young = <E3>, poisson = 0.3 }
[profile.ellipsoid]
radius_x = <Rx>
radius_y = <Ry>
[friction]
coefficient = <mu>
[solver]
tolerance = 1e-11
[[load]]
normal_force = <P>
tangential_force = [<Q>, 0.01]
increments = 5
ramp = "cubic"
[[load]]
shift = [<dx>, <dy>]
increments = 3
[[load]]
normal_force = <P2>
shift = [0.0, 0.0]
increments = 3
"#;

const COATED_NUMBERS: [(&str, f64, &str); 17] = [
    ("Eu", 5.0, "upper.substrate.young"),
    ("nu", 0.2, "upper.substrate.poisson"),
    ("h1", 0.3, "lower.coatings[0].thickness"),
    ("E1", 3.0, "lower.coatings[0].young"),
    ("n1", 0.35, "lower.coatings[0].poisson"),
    ("h2", 0.5, "lower.coatings[1].thickness"),
    ("E2", 0.7, "lower.coatings[1].young"),
    ("ks", 4.0, "lower.coatings[1].interface.shear_stiffness"),
    ("E3", 1.0, "lower.substrate.young"),
    ("Rx", 4.0, "profile.ellipsoid.radius_x"),
    ("Ry", 6.0, "profile.ellipsoid.radius_y"),
    ("mu", 0.25, "friction.coefficient"),
    ("P", 0.15, "load[0].normal_force"),
    ("Q", 0.02, "load[0].tangential_force[0]"),
    ("dx", 0.02, "load[1].shift[0]"),
    ("dy", 0.015, "load[1].shift[1]"),
    ("P2", 0.1, "load[2].normal_force"),
];

/// A history without any symmetry: two coatings on a spring, forces that grow together, slip that turns, a load that falls.
#[test]
fn a_history_of_coated_bodies_is_differentiated_by_all_its_numbers() {
    assert!(Written { text: COATED, numbers: &COATED_NUMBERS }.worst(&COLUMNS) < 1e-5);
}

/// Young's moduli, stiffnesses and forces together have no effect on lengths: the sum of their logarithmic derivatives is one of a pressure, a force
/// or an energy, none of a length. 1e-8: the linear equations and the run.
#[test]
fn moduli_and_forces_are_one_dimension() {
    let written = Written { text: COATED, numbers: &COATED_NUMBERS };
    let forces = [
        "upper.substrate.young",
        "lower.coatings[0].young",
        "lower.coatings[1].young",
        "lower.coatings[1].interface.shear_stiffness",
        "lower.substrate.young",
        "load[0].normal_force",
        "load[0].tangential_force[0]",
        "load[0].tangential_force[1]",
        "load[2].normal_force",
    ];
    let shear = "lower.coatings[1].interface.shear_stiffness";
    assert!(forces.contains(&shear)); // [pressure/length]: of the dimension of a force, too
    let found = found(&written.plan(None), &COLUMNS, &forces).unwrap();
    for gradient in &found.gradients {
        let parts = gradient.by.iter().zip(&found.parameters);
        let sum: f64 = parts.map(|(by, parameter)| by * parameter.value()).sum();
        let lengths = ["approach", "shift_x"];
        let power = if lengths.contains(&gradient.of.as_str()) { 0.0 } else { 1.0 };
        let size = gradient.value.abs().max(if gradient.of == "shift_x" { 0.02 } else { 0.0 });
        let off = (sum - power * gradient.value).abs() / size;
        assert!(off < 1e-7, "{}: {sum} {} {off:.1e}", gradient.of, gradient.value);
    }
}

/// A random history: one or two layers on a substrate under an elastic or rigid body, forces and motions in two stages; with the paths of all
/// its moduli and forces.
fn random_history(random: &mut Random, increments: &str) -> (String, Vec<String>) {
    let mut forces = vec!["load[0].normal_force".to_owned(), "lower.substrate.young".to_owned()];
    let mut coatings = Vec::new();
    for index in 0..random.whole(1, 2) {
        let [young, poisson] = [random.log_uniform(0.3, 5.0), random.between(0.0, 0.45)];
        coatings.push(format!(
            "{{ thickness = {:e}, young = {young:e}, poisson = {poisson:e} }}",
            random.log_uniform(0.1, 1.0)
        ));
        forces.push(format!("lower.coatings[{index}].young"));
    }
    let upper = if random.whole(0, 1) == 0 {
        "rigid = true".to_owned()
    } else {
        forces.push("upper.substrate.young".to_owned());
        format!("substrate = {{ young = {:e}, poisson = 0.25 }}", random.log_uniform(0.5, 5.0))
    };
    let friction = random.log_uniform(0.1, 0.6);
    let normal = 0.05;
    let [x, y] = [random.between(-0.5, 0.5), random.between(-0.5, 0.5)];
    let rub = if random.whole(0, 1) == 0 {
        forces.extend([0, 1].map(|axis| format!("load[1].tangential_force[{axis}]")));
        format!("tangential_force = [{:e}, {:e}]", friction * normal * x, friction * normal * y)
    } else {
        format!("shift = [{:e}, {:e}]", 0.03 * friction * x, 0.03 * friction * y)
    };
    let text = format!(
        "[grid]\ncells = [16, 16]\nsize = [2.4, 2.4]\n[upper]\n{upper}\n[lower]\ncoatings = [{}]\nsubstrate = {{ young = 1.0, \
         poisson = 0.3 }}\n[profile.sphere]\nradius = 4.0\n[friction]\ncoefficient = {friction:e}\n[solver]\ntolerance = 1e-10\n\
         [[load]]\nnormal_force = {normal:e}\nincrements = {increments}\n[[load]]\n{rub}\nincrements = {}\ncycles = 1\n",
        coatings.join(", "),
        4 * random.whole(1, 2)
    );
    (text, forces)
}

/// Euler's identity of pressures, energies and lengths in so many random histories, pressed in as many increments.
fn dimensions_of_random_histories((seed, count): (u64, usize), increments: &str) {
    let mut random = Random::seeded(seed);
    let columns = [("max_pressure", 1.0), ("approach", 0.0), ("max_shear", 1.0), ("dissipated_energy", 1.0)];
    for case in 0..count {
        let (text, forces) = random_history(&mut random, increments);
        let names: Vec<&str> = forces.iter().map(String::as_str).collect();
        let found = found(&planned(&text), &columns.map(|(column, _)| column), &names);
        let found = found.unwrap_or_else(|error| panic!("case {case}: {error}\n{text}"));
        let scale = found.gradients[3].value;
        for (gradient, (column, power)) in found.gradients.iter().zip(columns) {
            let parts = gradient.by.iter().zip(&found.parameters);
            let sum: f64 = parts.map(|(by, parameter)| by * parameter.value()).sum();
            // Energies so small that the run itself leaves no digits of them say nothing.
            let size = gradient.value.abs().max(if column == "dissipated_energy" { 1e-9 } else { 0.0 });
            let off = (sum - power * gradient.value).abs() / size;
            assert!(off < 1e-6, "case {case}, {column}: {sum} {} ({scale})\n{text}", gradient.value);
        }
    }
}

#[test]
fn moduli_and_forces_are_one_dimension_in_random_histories() {
    dimensions_of_random_histories((41, 25), "3");
}

/// Of increments that were solved in parts: of the first one, in which the bodies touch, and of those that the program divides.
#[test]
fn moduli_and_forces_are_one_dimension_through_increments_in_parts() {
    dimensions_of_random_histories((43, 8), "8");
    dimensions_of_random_histories((44, 4), "\"auto\"");
}

/// The first increment of pressing is solved in four parts, each of which derivatives go through: of a point contact that turns, with a machine that
/// gives, and of a line contact; slip of the increment is that of all parts.
#[test]
fn a_first_touch_in_parts_is_differentiated() {
    let point = "[grid]\ncells = [24, 24]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\ncoatings = [{ thickness = 0.4, young = <E>, \
                 poisson = 0.3 }]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = <R>\n[friction]\ncoefficient = <mu>\n\
                 [rig]\ntangential_stiffness = <k>\n[solver]\ntolerance = 1e-11\n[[load]]\nnormal_force = <P>\ntangential_force = [<T>, 0.0]\n\
                 increments = 8\n[[load]]\ntangential_force = [<Q>, 0.004]\nincrements = 3\n";
    let numbers = [
        ("E", 2.0, "lower.coatings[0].young"),
        ("R", 5.03, "profile.sphere.radius"),
        ("mu", 0.3, "friction.coefficient"),
        ("k", 0.7, "rig.tangential_stiffness"),
        ("P", 0.15, "load[0].normal_force"),
        ("T", 0.011, "load[0].tangential_force[0]"),
        ("Q", 0.031, "load[1].tangential_force[0]"),
    ];
    let columns = ["approach", "max_pressure", "shift_x", "max_shear", "external_work", "dissipated_energy"];
    let written = Written { text: point, numbers: &numbers };
    let history = Simulation::new(&written.plan(None)).run(&mut Silent).unwrap();
    let parts: Vec<usize> = history.steps.iter().map(|step| step.parts).collect();
    assert_eq!(parts, [4, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]);
    assert!(written.worst(&columns) < 1e-5);
    // A motion that begins between: its load goes from there on.
    let line = "[grid]\ncells = 64\nsize = 3.0\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = <E>, poisson = 0.2 }\n\
                [profile.cylinder]\nradius = 5.0\naxis = \"y\"\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n\
                [[load]]\nnormal_force = <P>\nincrements = 8\n[[load]]\nshift = [<d>, 0.0]\nincrements = 4\n";
    let numbers = [
        ("E", 1.02, "lower.substrate.young"),
        ("mu", 0.4, "friction.coefficient"),
        ("P", 0.2, "load[0].normal_force"),
        ("d", 0.03, "load[1].shift[0]"),
    ];
    let written = Written { text: line, numbers: &numbers };
    assert!(written.worst(&["approach", "max_pressure", "tangential_force_x", "dissipated_energy"]) < 1e-5);
}

#[test]
#[ignore = "long: five hundred random histories"]
fn moduli_and_forces_are_one_dimension_in_five_hundred_histories() {
    dimensions_of_random_histories((42, 500), "3");
}

/// Torsion beside a force, a body that tilts under a moment, a machine that gives, a shear strength, a stage with friction of its own, a
/// force that turns.
#[test]
fn controls_and_laws_of_every_kind_are_differentiated() {
    let body = |grid: &str, rest: &str| {
        format!(
            "[grid]\ncells = {grid}\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\ncoatings = [{{ thickness = 0.4, young = <E>, \
             poisson = 0.3 }}]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n[profile.sphere]\nradius = 5.0\n[solver]\n\
             tolerance = 1e-11\n[friction]\ncoefficient = <mu>\n{rest}"
        )
    };
    let common = [("E", 2.0, "lower.coatings[0].young"), ("mu", 0.3, "friction.coefficient")];
    let with = |more: &[(&'static str, f64, &'static str)]| [&common[..], more].concat();
    let cases = [
        (
            "max_shear = <tau>\n[[load]]\nnormal_force = 0.15\nincrements = 4\n[[load]]\ntwist_moment = <M>\n\
             tangential_force = [<Q>, 0.0]\nincrements = 4\n",
            with(&[
                ("tau", 0.04, "friction.max_shear"),
                ("M", 0.008, "load[1].twist_moment"),
                ("Q", 0.01, "load[1].tangential_force[0]"),
            ]),
            vec![
                "shift_x",
                "twist",
                "dissipated_energy",
                "max_shear",
                "external_work",
                "tangential_force_x",
                "twist_moment",
            ],
        ),
        (
            "[[load]]\nnormal_force = 0.15\ntilt_moment = [<M>, 0.0]\nincrements = 3\n[[load]]\nshift = [0.01, <dy>]\n\
             twist = <phi>\nincrements = 3\n",
            with(&[
                ("M", 0.004, "load[0].tilt_moment[0]"),
                ("dy", 0.012, "load[1].shift[1]"),
                ("phi", 0.004, "load[1].twist"),
            ]),
            vec![
                "approach",
                "tilt_x",
                "tilt_moment_x",
                "tangential_force_y",
                "twist_moment",
                "dissipated_energy",
                "external_work",
            ],
        ),
        (
            "[rig]\ntangential_stiffness = <k>\nnormal_stiffness = <kn>\n[[load]]\nactuator_approach = <a>\nincrements = 4\n[[load]]\n\
             actuator = [<d>, 0.0]\nincrements = 8\ncycles = 1\n[[load]]\nfriction = <mu2>\nactuator = [0.02, 0.0]\nincrements = 2\n",
            with(&[
                ("k", 1.5, "rig.tangential_stiffness"),
                ("kn", 2.0, "rig.normal_stiffness"),
                ("a", 0.16, "load[0].actuator_approach"),
                ("d", 0.03, "load[1].actuator[0]"),
                ("mu2", 0.4, "load[2].friction"),
            ]),
            vec![
                "approach",
                "normal_force",
                "actuator_approach",
                "shift_x",
                "actuator_x",
                "tangential_force_x",
                "dissipated_energy",
                "unresolved_energy",
            ],
        ),
        (
            "[[load]]\nnormal_force = 0.15\nincrements = 4\n[[load]]\ntangential_force = [<Q>, 0.0]\nincrements = 2\n[[load]]\n\
             tangential_force = [<Q2>, <Q3>]\nphase = { tangential_force = [90, 0] }\nwaveform = \"sine\"\nincrements = 16\ncycles = 1\n",
            with(&[
                ("Q", 0.03, "load[1].tangential_force[0]"),
                ("Q2", 0.03, "load[2].tangential_force[0]"),
                ("Q3", 0.03, "load[2].tangential_force[1]"),
            ]),
            vec!["shift_x", "shift_y", "dissipated_energy", "max_shear"],
        ),
    ];
    for (number, (rest, numbers, columns)) in cases.iter().enumerate() {
        let text = body("[24, 24]", rest);
        assert!(Written { text: &text, numbers }.worst(columns) < 1e-5, "case {number}");
    }
}

/// Line contacts, periodic waves, and normal force that falls and grows under a tangential one.
#[test]
fn lines_and_periods_are_differentiated() {
    let line = "[grid]\ncells = 64\nsize = 3.0\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.2 }\n\
                [profile.cylinder]\nradius = <R>\naxis = \"y\"\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n\
                [[load]]\nnormal_force = <P>\nincrements = 4\n[[load]]\ntangential_force = [<Q>, 0.0]\nnormal_force = 0.05\n\
                increments = 8\ncycles = 1\n";
    let numbers = [
        ("R", 5.0, "profile.cylinder.radius"),
        ("mu", 0.3, "friction.coefficient"),
        ("P", 0.2, "load[0].normal_force"),
        ("Q", 0.04, "load[1].tangential_force[0]"),
    ];
    let columns = ["approach", "max_pressure", "shift_x", "dissipated_energy"];
    assert!(Written { text: line, numbers: &numbers }.worst(&columns) < 1e-5);
    // layers of a line contact, whose datum moves with them; both bodies elastic
    let layered = "[grid]\ncells = 48\nsize = 3.0\ndatum = <datum>\n[upper]\nsubstrate = { young = <Eu>, poisson = 0.25 }\n[lower]\n\
                   coatings = [{ thickness = <h>, young = <E>, poisson = <nu> }]\nsubstrate = { young = <Es>, poisson = <ns> }\n\
                   [profile.cylinder]\nradius = 5.0\naxis = \"y\"\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n\
                   [[load]]\nnormal_force = <P>\nincrements = 4\n[[load]]\ntangential_force = [<Q>, 0.0]\nbulk_stress = 0.01\n\
                   increments = 8\ncycles = 1\n";
    let numbers = [
        ("Eu", 5.0, "upper.substrate.young"),
        ("h", 0.4, "lower.coatings[0].thickness"),
        ("E", 3.0, "lower.coatings[0].young"),
        ("nu", 0.35, "lower.coatings[0].poisson"),
        ("Es", 1.0, "lower.substrate.young"),
        ("ns", 0.3, "lower.substrate.poisson"),
        ("mu", 0.3, "friction.coefficient"),
        ("P", 0.2, "load[0].normal_force"),
        ("Q", 0.04, "load[1].tangential_force[0]"),
    ];
    for datum in ["0.2", "6.0"] {
        let text = layered.replace("<datum>", datum);
        assert!(Written { text: &text, numbers: &numbers }.worst(&columns) < 1e-5, "datum {datum}");
    }
    let period = "[grid]\ncells = [24, 24]\nsize = [2.0, 2.0]\nperiodic = true\n[upper]\nrigid = true\n[lower]\n\
                  coatings = [{ thickness = <h>, young = <E>, poisson = 0.3 }]\nbase = \"rigid\"\n[profile.wave]\namplitude = <a>\n\
                  wavelength_x = 2.0\nwavelength_y = 2.0\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n[[load]]\n\
                  normal_force = <P>\nincrements = 3\n[[load]]\nshift = [0.01, 0.0]\nincrements = 3\n";
    let numbers = [
        ("h", 0.7, "lower.coatings[0].thickness"),
        ("E", 2.0, "lower.coatings[0].young"),
        ("a", 0.05, "profile.wave.amplitude"),
        ("mu", 0.3, "friction.coefficient"),
        ("P", 0.1, "load[0].normal_force"),
    ];
    let columns = ["approach", "max_pressure", "tangential_force_x", "dissipated_energy"];
    assert!(Written { text: period, numbers: &numbers }.worst(&columns) < 1e-5);
    // half of a period by its mirrors, whose contact grows to them: the edge that comes sees images there, not the other end
    let mirrored = "[grid]\ncells = [32, 32]\nsize = [1.0, 1.0]\nperiodic = true\n[upper]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[lower]\n\
                    substrate = { young = 1.0, poisson = 0.3 }\n[profile.formula]\n\
                    expression = \"0.0005*(1 - cos(2*pi*x)) + 0.01*(1 - cos(2*pi*y))\"\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n\
                    [[load]]\nnormal_force = 0.006\nincrements = 3\nramp = \"square\"\n[[load]]\ntangential_force = [<Q>, 0.0]\n\
                    normal_force = 0.018\nincrements = 5\n";
    let numbers = [("mu", 0.3, "friction.coefficient"), ("Q", 0.0009, "load[1].tangential_force[0]")];
    let columns = ["shift_x", "max_shear", "dissipated_energy"];
    assert!(Written { text: mirrored, numbers: &numbers }.worst(&columns) < 1e-5);
}

/// What derivatives cost, in operator applications, which are the same on every machine: backwards, of one result by all nine numbers, fewer than the
/// run itself; and one product an increment for all five constants of bodies together.
#[test]
fn backwards_all_numbers_take_fewer_applications_than_the_run() {
    let plan = planned(
        "[grid]\ncells = [48, 48]\nsize = [2.4, 2.4]\n[upper]\nrigid = true\n[lower]\ncoatings = [{ thickness = 0.5, young = 2.2, \
         poisson = 0.2 }]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = 5.0\n[friction]\ncoefficient = 0.3\n\
         [[load]]\nnormal_force = 0.15\nincrements = 8\nramp = \"cubic\"\n[[load]]\ntangential_force = [0.03, 0.0]\ncycles = 1\n\
         increments = 16\n",
    );
    let history = Simulation::new(&plan).run(&mut Silent).unwrap();
    let of_run: usize = history.steps.iter().map(|step| step.work.convolutions).sum();
    let found = found_along(&plan, &["dissipated_energy"], &[], Some(Direction::Backward)).unwrap();
    assert_eq!(found.parameters.len(), 9);
    let work = found.work;
    println!("run {of_run}, derivatives {work:?}");
    assert!(work.of_linear_problems + work.others < of_run, "{of_run}: {work:?}");
    assert!((1..=history.steps.len()).contains(&work.of_constants), "{work:?}");
}
