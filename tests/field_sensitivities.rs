//! Derivatives of weighted sums of tractions, slip and wear depths against equilibrium and differences of whole runs.

use fret_core::run::{Silent, Simulation};
use fret_core::sensitivity::{SensitivityError, Weights, pulled_back};
use fret_validation::random::Random;
use ndarray::Array2;

use crate::sensitivities::{Written, planned};

/// A coated body under a rigid ball, both forces growing, and a cycle; half of it is solved for.
const COATED: &str = r"
[grid]
cells = [24, 24]
size = [3.0, 3.0]
[upper]
rigid = true
[lower]
coatings = [{ thickness = <h>, young = 3.0, poisson = 0.35 }]
substrate = { young = 1.0, poisson = 0.3 }
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
    ("h", 0.4, "lower.coatings[0].thickness"),
    ("R", 5.0, "profile.sphere.radius"),
    ("mu", 0.3, "friction.coefficient"),
    ("P", 0.15, "load[0].normal_force"),
    ("Q", 0.03, "load[1].tangential_force[0]"),
];

fn text(moved: Option<(usize, f64)>) -> String {
    Written { text: COATED, numbers: &NUMBERS }.case(moved)
}

fn both_ways(weights: &Weights) -> [Vec<f64>; 2] {
    of_case(&Written { text: COATED, numbers: &NUMBERS }, weights)
}

/// Derivatives by all numbers, backwards, and by each alone, forward.
fn of_case(written: &Written<'_>, weights: &Weights) -> [Vec<f64>; 2] {
    let plan = planned(&written.case(None));
    let by: Vec<String> = written.numbers.iter().map(|(_, _, path)| (*path).to_owned()).collect();
    let along = |by: &[String]| pulled_back(&plan, weights, by, &mut Silent).unwrap().gradients[0].by.clone();
    [along(&by), by.chunks(1).flat_map(along).collect()]
}

/// Largest difference of derivatives of a weighted sum from differences of runs, see [`Written::off`].
fn off(written: &Written<'_>, weights: &Weights, sum: impl Fn(Option<(usize, f64)>) -> Vec<f64>) -> f64 {
    let [backward, forward] = of_case(written, weights).map(|by| [by]);
    written.off(1e-5, [&backward, &forward], sum)
}

fn fields(list: impl IntoIterator<Item = (&'static str, Array2<f64>)>) -> Weights {
    let fields = list.into_iter().map(|(name, weights)| (name.to_owned(), weights)).collect();
    Weights { results: Vec::new(), fields }
}

/// The sum of the tractions times the area of a cell is the force: its derivative by the force is one, by all else none. The tangential force of
/// increment 4 is the amplitude of the cycle. A result and a field are summed. 1e-9: the run.
#[test]
fn sums_of_tractions_are_the_forces() {
    let area = |factor: f64| Array2::from_elem((24, 24), factor * (3.0_f64 / 24.0).powi(2));
    let mut weights = fields([("pressure", area(2.0)), ("increments[4].shear_x", area(1.0))]);
    weights.results.push(("normal_force".to_owned(), 0.5));
    let sizes = NUMBERS.map(|(_, value, _)| value);
    for found in both_ways(&weights) {
        for ((by, expected), size) in found.iter().zip([0.0, 0.0, 0.0, 2.5, 1.0]).zip(sizes) {
            assert!((by - expected).abs() * size < 1e-9, "{found:?}");
        }
    }
}

/// Fields of random weights, without any symmetry, against differences of runs: steps so small that hardly any cell changes its state, runs that
/// leave 1e-6 of noise; and forward as backwards.
#[test]
fn weights_of_cells_are_differentiated() {
    let mut random = Random::seeded(12);
    let mut field = || Array2::from_shape_simple_fn((24, 24), || random.between(0.0, 1.0));
    let [pressure, shear_x, shear_y] = [field(), field(), field()];
    let weights =
        fields([("pressure", pressure.clone()), ("shear_x", shear_x.clone()), ("shear_y", shear_y.clone())]);
    let sum = |moved| {
        let state = Simulation::new(&planned(&text(moved))).run(&mut Silent).unwrap().state;
        vec![
            (&pressure * &state.pressure).sum()
                + (&shear_x * &state.shear[0]).sum()
                + (&shear_y * &state.shear[1]).sum(),
        ]
    };
    let off = off(&Written { text: COATED, numbers: &NUMBERS }, &weights, sum);
    assert!(off < 1e-5, "{off:e}");
}

/// Accumulated slip and the wear depth of surfaces that wear in jumps over cycles, as above; and the sum of the depth is the worn volume.
#[test]
fn weights_of_slip_and_wear_are_differentiated() {
    let worn =
        COATED.replace("[solver]", "[wear]\ncoefficient = <k>\nevery = 2\nlargest_step = 1.0\n[solver]");
    let worn = worn.replace("cycles = 1", "cycles = 4");
    let numbers = [&NUMBERS[..], &[("k", 0.03, "wear.coefficient")]].concat();
    let written = Written { text: &worn, numbers: &numbers };
    let mut random = Random::seeded(13);
    let mut field = || Array2::from_shape_simple_fn((24, 24), || random.between(0.0, 1.0));
    let [x, y, depth] = [field(), field(), field()];
    let cases = [
        (fields([("slip_x", x.clone()), ("slip_y", y.clone())]), [1.0, 0.0]),
        (fields([("worn_depth", depth.clone())]), [0.0, 1.0]),
    ];
    for (weights, [of_slip, of_depth]) in cases {
        let sum = |moved| {
            let state = Simulation::new(&planned(&written.case(moved))).run(&mut Silent).unwrap().state;
            let slip = (&x * &state.slip[0]).sum() + (&y * &state.slip[1]).sum();
            vec![of_slip * slip + of_depth * (&depth * state.worn_depth.as_ref().unwrap()).sum()]
        };
        let off = off(&written, &weights, sum);
        assert!(off < 1e-5, "{off:e}");
    }
    let area = Array2::from_elem((24, 24), (3.0_f64 / 24.0).powi(2));
    let volume = Weights { results: vec![("worn_volume".to_owned(), 1.0)], fields: Vec::new() };
    let [of_depth, of_volume] = [fields([("worn_depth", area)]), volume].map(|of| of_case(&written, &of));
    for (one, other) in of_depth[0].iter().zip(&of_volume[0]) {
        // Rounding of sums of some hundred cells.
        assert!((one - other).abs() <= 1e-12 * other.abs(), "{one} {other}");
    }
}

#[test]
fn fields_without_derivatives_are_refused() {
    let plan = planned(&text(None));
    let refused = |name: &'static str, weights: Array2<f64>| match pulled_back(
        &plan,
        &fields([(name, weights)]),
        &[],
        &mut Silent,
    ) {
        Err(SensitivityError::Objective { name: of, reason }) => {
            assert_eq!(of, name);
            reason
        }
        other => panic!("{other:?}"),
    };
    let ones = || Array2::ones((24, 24));
    assert!(refused("gap", ones()).contains("pressure, shear_x, shear_y"));
    assert!(refused("worn_depth", ones()).contains("nothing wears"));
    assert!(refused("increments[x].pressure", ones()).contains("increments[7].pressure"));
    assert!(refused("increments[99].pressure", ones()).contains("11 increments"));
    assert!(refused("pressure", Array2::ones((24, 12))).contains("24 x 12 weights"));
    assert!(refused("pressure", ones() * f64::NAN).contains("finite"));
    // Pressure and shear of elastically similar bodies are coupled as soon as one has another constant.
    let like = planned(
        &text(None)
            .replace("coatings = [{ thickness = 4e-1, young = 3.0, poisson = 0.35 }]\n", "")
            .replace("poisson = 0.3 ", "poisson = 0.5 "),
    );
    let by = ["lower.substrate.young".to_owned()];
    let found = pulled_back(&like, &fields([("pressure", ones())]), &by, &mut Silent);
    assert!(found.unwrap_err().to_string().contains("slightly different constant"));
}
