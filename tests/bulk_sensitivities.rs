//! Exact sensitivities of contacts under bulk stresses, against differences of whole runs, and the first law.

use crate::sensitivities::{Written, found};
use crate::stress_sensitivities::worst;

/// A coated body under an elastic ball, both under bulk stresses that go on beside a force, turn, and end.
const STRETCHED: &str = r#"
[grid]
cells = [24, 24]
size = [3.0, 3.0]
[upper]
substrate = { young = <Eu>, poisson = <nu> }
[lower]
coatings = [{ thickness = <h>, young = <E>, poisson = 0.35 }]
substrate = { young = <Es>, poisson = <ns> }
[profile.sphere]
radius = <R>
[friction]
coefficient = <mu>
[solver]
tolerance = 1e-11
integration = "<rule>"
[[load]]
normal_force = <P>
increments = 3
[[load]]
tangential_force = [<Q>, 0.0]
bulk_stress = [<bx>, <by>]
upper_bulk_stress = [<ux>, 0.0]
cycles = 1
increments = 8
[[load]]
bulk_stress = [<bx2>, 0.0]
shift = [0.004, 0.01]
increments = 3
"#;
const NUMBERS: [(&str, f64, &str); 13] = [
    ("Eu", 5.0, "upper.substrate.young"),
    ("nu", 0.2, "upper.substrate.poisson"),
    ("h", 0.4, "lower.coatings[0].thickness"),
    ("E", 3.0, "lower.coatings[0].young"),
    ("Es", 1.0, "lower.substrate.young"),
    ("ns", 0.3, "lower.substrate.poisson"),
    ("R", 5.0, "profile.sphere.radius"),
    ("mu", 0.3, "friction.coefficient"),
    ("Q", 0.02, "load[1].tangential_force[0]"),
    ("bx", 0.015, "load[1].bulk_stress[0]"),
    ("by", 0.006, "load[1].bulk_stress[1]"),
    ("ux", 0.01, "load[1].upper_bulk_stress[0]"),
    ("bx2", 0.008, "load[2].bulk_stress[0]"),
];
const FORCE: (&str, f64, &str) = ("P", 0.15, "load[0].normal_force");

fn numbers() -> Vec<(&'static str, f64, &'static str)> {
    NUMBERS.into_iter().chain([FORCE]).collect()
}

#[test]
fn contacts_under_bulk_stresses_are_differentiated_by_both_rules() {
    let columns = [
        "shift_x",
        "shift_y",
        "max_shear",
        "dissipated_energy",
        "elastic_energy",
        "external_work",
        "bulk_work",
        "unresolved_energy",
        "tangential_force_y",
        "approach",
    ];
    for rule in ["second_order", "end_point"] {
        let text = STRETCHED.replace("<rule>", rule);
        let worst = Written { text: &text, numbers: &numbers() }.worst(&columns);
        assert!(worst < 1e-5, "{rule}: {worst:e}");
    }
}

/// Like bodies on a quarter of the grid, and surfaces that wear in jumps over cycles, whose bulk stress works in each.
#[test]
fn cycles_of_bulk_stress_are_differentiated_in_jumps() {
    let text = "[grid]\ncells = [24, 24]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.5 }\n\
                [profile.sphere]\nradius = <R>\n[friction]\ncoefficient = <mu>\n[wear]\ncoefficient = <k>\nevery = 3\nlargest_step = 1.0\n\
                [solver]\ntolerance = 1e-11\n[[load]]\nnormal_force = <P>\nincrements = 3\n[[load]]\ntangential_force = [<Q>, 0.0]\n\
                bulk_stress = [<b>, 0.0]\ncycles = 6\nincrements = 8\n";
    let numbers = [
        ("R", 5.0, "profile.sphere.radius"),
        ("mu", 0.3, "friction.coefficient"),
        ("k", 0.02, "wear.coefficient"),
        ("P", 0.15, "load[0].normal_force"),
        ("Q", 0.02, "load[1].tangential_force[0]"),
        ("b", 0.015, "load[1].bulk_stress[0]"),
    ];
    let columns = [
        "shift_x",
        "max_pressure",
        "worn_volume",
        "dissipated_energy",
        "external_work",
        "bulk_work",
        "unresolved_energy",
        "wear_work",
    ];
    let worst = Written { text, numbers: &numbers }.worst(&columns);
    assert!(worst < 1e-5, "{worst:e}");
}

/// A line contact, in plane strain.
#[test]
fn lines_under_bulk_stress_are_differentiated() {
    let text = "[grid]\ncells = 64\nsize = 3.0\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n\
                [profile.cylinder]\nradius = <R>\naxis = \"y\"\n[friction]\ncoefficient = <mu>\n[solver]\ntolerance = 1e-11\n\
                [[load]]\nnormal_force = 0.2\nincrements = 3\n[[load]]\ntangential_force = [<Q>, 0.0]\nbulk_stress = <b>\n\
                phase = { bulk_stress = 45 }\ncycles = 1\nincrements = 12\n";
    let numbers = [
        ("R", 4.0, "profile.cylinder.radius"),
        ("mu", 0.3, "friction.coefficient"),
        ("Q", 0.03, "load[1].tangential_force[0]"),
        ("b", 0.02, "load[1].bulk_stress"),
    ];
    let worst = Written { text, numbers: &numbers }.worst(&[
        "shift_x",
        "max_shear",
        "dissipated_energy",
        "bulk_work",
    ]);
    assert!(worst < 1e-5, "{worst:e}");
}

/// Stresses and a fatigue parameter at their largest place have the bulk stress in them, of either body: as by differences of runs.
#[test]
fn stresses_under_bulk_stress_are_differentiated() {
    for body in ["lower", "upper"] {
        let asked = format!(
            "[output]\nfields = [\"pressure\", \"shear\"]\n[stress]\nbody = \"{body}\"\ndepths = [0.0, 0.2, 0.35]\ntorsion_limit = 0.1\ntension_limit = 0.15\n"
        );
        let text =
            STRETCHED.replace("<rule>", "second_order").replace("[solver]", &format!("{asked}[solver]"));
        let of = ["increments[5].stress.von_mises", "stress.tension", "cycles[0].fatigue.crossland"]
            .map(str::to_owned);
        let worst = worst(&text, &numbers(), &of, 1e-5);
        assert!(worst < 1e-5, "{body}: {worst:e}");
    }
}

/// Moduli and forces, bulk stresses among them, are one dimension: their logarithmic derivatives sum to 1 for energies, to 0 for lengths. 1e-7, as
/// for the others.
#[test]
fn bulk_stresses_are_of_the_dimension_of_moduli() {
    let text = STRETCHED.replace("<rule>", "second_order");
    let by: Vec<&str> = numbers()
        .iter()
        .map(|(.., path)| *path)
        .filter(|path| {
            !["poisson", "thickness", "radius", "coefficient"].iter().any(|other| path.ends_with(other))
        })
        .collect();
    let plan = Written { text: &text, numbers: &numbers() }.plan(None);
    for (gradient, power) in found(&plan, &["bulk_work", "dissipated_energy", "shift_x"], &by)
        .unwrap()
        .gradients
        .iter()
        .zip([1.0, 1.0, 0.0])
    {
        let value = |path: &str| numbers().iter().find(|(.., known)| *known == path).unwrap().1;
        let sum: f64 = gradient.by.iter().zip(&by).map(|(by, path)| by * value(path)).sum();
        assert!(
            (sum - power * gradient.value).abs() < 1e-7 * gradient.value.abs(),
            "{}: {sum:e} {:e}",
            gradient.of,
            gradient.value
        );
    }
}
