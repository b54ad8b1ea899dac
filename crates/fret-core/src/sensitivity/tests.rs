//! Derivatives against central differences of whole runs, at a tolerance that leaves them their digits.

use super::*;
use crate::case::Case;
use crate::plan::Plan;
use crate::run::{Silent, Simulation};

/// A case with names in angle brackets for its numbers.
struct Written<'a> {
    text: &'a str,
    /// Name, value, path.
    numbers: &'a [(&'a str, f64, &'a str)],
}

impl Written<'_> {
    fn plan(&self, moved: Option<(usize, f64)>) -> Plan {
        let mut text = self.text.to_owned();
        for (number, (name, value, _)) in self.numbers.iter().enumerate() {
            let factor = moved.filter(|(which, _)| *which == number).map_or(1.0, |(_, by)| 1.0 + by);
            text = text.replace(&format!("<{name}>"), &format!("{:e}", value * factor));
        }
        Plan::new(Case::from_toml(&text, "case.toml").unwrap_or_else(|error| panic!("{error}"))).unwrap()
    }

    fn columns(&self, columns: &[&str], moved: Option<(usize, f64)>) -> Vec<Vec<f64>> {
        let plan = self.plan(moved);
        let history = Simulation::new(&plan).run(&mut Silent).unwrap();
        let of = |record| columns.iter().map(|column| objective::value_of(record, column)).collect();
        history.steps.iter().map(of).collect()
    }

    /// Largest difference of any derivative from the central difference, over the size of the column and of the derivative.
    fn worst(&self, columns: &[&str]) -> f64 {
        const STEP: f64 = 1e-5;
        let plan = self.plan(None);
        let steps = self.columns(columns, None);
        let mut request = Request::default();
        for increment in 0..steps.len() {
            request.of.extend(columns.iter().map(|column| format!("increments[{increment}].{column}")));
        }
        request.by = self.numbers.iter().map(|(_, _, path)| (*path).to_owned()).collect();
        let found = gradient(&plan, &request, &mut Silent).unwrap();
        let mut worst = 0.0_f64;
        for (number, (name, value, _)) in self.numbers.iter().enumerate() {
            let [up, down] = [STEP, -STEP].map(|step| self.columns(columns, Some((number, step))));
            for (place, column) in columns.iter().enumerate() {
                let size = steps.iter().fold(0.0_f64, |most, step| most.max(step[place].abs()));
                for increment in 0..steps.len() {
                    let expected = (up[increment][place] - down[increment][place]) / (2.0 * STEP);
                    let gradient = &found.gradients[increment * columns.len() + place];
                    let found = gradient.by[number] * value;
                    let off = (found - expected).abs() / (size + expected.abs()).max(f64::MIN_POSITIVE);
                    if off > 1e-5 {
                        eprintln!("increment {increment}, {column} by {name}: {found:e}, difference {expected:e}");
                    }
                    worst = worst.max(off);
                    assert_eq!(gradient.value, steps[increment][place]);
                }
            }
        }
        eprintln!("worst {worst:.1e}");
        worst
    }
}

const SIMILAR: &str = r#"
[grid]
cells = [32, 32]
size = [320e-6, 320e-6]
[upper]
rigid = true
[lower]
substrate = { young = 210e9, poisson = 0.5 }
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
"#;

const NUMBERS: [(&str, f64, &str); 4] = [
    ("R", 10e-3, "profile.sphere.radius"),
    ("mu", 0.3, "friction.coefficient"),
    ("P", 12.0, "load[0].normal_force"),
    ("Q", 2.5, "load[1].tangential_force[0]"),
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

/// 1e-5: the step of the differences moves edges by so many cells, and the runs leave 1e-11 over 1e-5 of noise.
#[test]
fn a_loop_of_similar_bodies_is_differentiated() {
    assert!(Written { text: SIMILAR, numbers: &NUMBERS }.worst(&COLUMNS) < 1e-5);
}

#[test]
fn a_loop_of_dissimilar_bodies_is_differentiated() {
    for integration in ["end_point", "second_order"] {
        let text = SIMILAR.replace("poisson = 0.5", "poisson = 0.2");
        let text = text.replace("tolerance = 1e-11", &format!("tolerance = 1e-11\nintegration = \"{integration}\""));
        assert!(Written { text: &text, numbers: &NUMBERS }.worst(&COLUMNS) < 1e-5, "{integration}");
    }
}
