//! The onset of sliding under a coated contact. The paper says that the contact slides fully at a force significantly below
//! mu W. Equilibrium does not allow that: once every cell slips, the tractions carry nearly mu W. The last cell sticks
//! until T is close to mu W, and the shift can grow without bound only there.

use fret_core::history::History;
use fret_core::run::RunError;
use fret_validation::{Sphere, run};

/// Tangential force over mu W at which the last stick cell vanishes, and that at a shift far beyond.
fn onset(ratio: f64) -> [f64; 2] {
    let sphere =
        Sphere { cells: 40, size: 2.9, coating: Some((ratio, 1.0)), friction: 0.1, ..Sphere::default() };
    let full = 0.1 * sphere.force();
    let scale = 3.0 * full / (16.0 * sphere.effective_shear_modulus());
    let text = format!(
        "{}[[load]]\nname = \"slide\"\nshift = [{:e}, 0.0]\nincrements = 40\n[[load]]\nname = \"far\"\nshift = [{:e}, 0.0]\nincrements = 4\n",
        sphere.pressed(1.0, 8, "cubic"),
        2.0 * scale,
        40.0 * scale
    );
    let history = run(&text).unwrap_or_else(|error| panic!("E1/E2 = {ratio}: {error}"));
    let slid = history.steps.iter().skip(8).find(|step| step.stick_cells == 0).expect("it slides at last");
    let far = history.steps.last().unwrap();
    [slid.tangential_force[0] / full, far.tangential_force[0] / full]
}

#[test]
fn coated_contacts_slide_at_mu_w_and_not_below() {
    for ratio in [0.5, 1.0, 2.0] {
        let [last_stick, far] = onset(ratio);
        println!(
            "E1/E2 = {ratio}: last stick cell vanishes at T = {last_stick:.4} mu W, far beyond T = {far:.5} mu W"
        );
        assert!(last_stick > 0.97 && last_stick <= 1.0 + 1e-9, "E1/E2 = {ratio}: {last_stick}");
        assert!(far > 0.9999 && far <= 1.0 + 1e-9, "E1/E2 = {ratio}: {far}");
    }
}

/// A sphere at a prescribed approach under a tangential force, with the case's upper body, and what friction carries there:
/// Hertz's force of an approach d of a paraboloid of radius R, `4/3 E* sqrt(R) d^1.5`, times mu.
struct Pulled {
    upper: &'static str,
    carried: f64,
}

const RADIUS: f64 = 10e-3;
const APPROACH: f64 = 1e-6;
const FRICTION: f64 = 0.2;

/// Bodies that couple, and those that do not.
fn pulled() -> [Pulled; 2] {
    [
        ("rigid = true", 210e9 / (1.0 - 0.09)),
        ("substrate = { young = 210e9, poisson = 0.3 }", 210e9 / (2.0 * (1.0 - 0.09))),
    ]
    .map(|(upper, modulus)| Pulled {
        upper,
        carried: FRICTION * 4.0 / 3.0 * modulus * RADIUS.sqrt() * APPROACH.powf(1.5),
    })
}

impl Pulled {
    fn run(&self, approach: f64, force: f64) -> Result<History, RunError> {
        run(&format!(
            "grid = {{ cells = [24, 24], size = [300e-6, 300e-6] }}\nfriction.coefficient = {FRICTION}\n\
             profile.sphere.radius = {RADIUS:e}\n[upper]\n{}\n[lower]\nsubstrate = {{ young = 210e9, poisson = 0.3 }}\n\
             [[load]]\napproach = {approach:e}\nincrements = 1\n\
             [[load]]\ntangential_force = [{force:e}, 0.0]\nincrements = 2\n",
            self.upper
        ))
    }
}

#[test]
fn a_force_that_a_prescribed_approach_carries_is_carried_and_more_is_not_answered_by_sliding() {
    for pulled in pulled() {
        // On 24 cells the force is Hertz's within a few per cent.
        let history = pulled.run(APPROACH, 0.9 * pulled.carried).unwrap();
        let [found, _] = history.steps.last().unwrap().tangential_force;
        assert!((found / (0.9 * pulled.carried) - 1.0).abs() < 1e-8, "{found}");
        // Half of it is, in the first increment of the pull; the whole is not, in the last.
        let refusal = pulled.run(APPROACH, 1.1 * pulled.carried).unwrap_err();
        assert_eq!(refusal.increment(), 2, "{}: {refusal}", pulled.upper);
    }
}

#[test]
fn a_force_a_tenth_above_what_a_prescribed_approach_carries_is_called_so() {
    for pulled in pulled() {
        let refusal = pulled.run(APPROACH, 1.1 * pulled.carried).unwrap_err();
        assert!(matches!(refusal, RunError::AboveSliding { .. }), "{}: {refusal}", pulled.upper);
    }
}

#[test]
fn bodies_that_are_apart_carry_nothing_and_it_is_said() {
    for pulled in pulled() {
        // A thousandth of the approach lies between the cells' centres.
        for approach in [1e-3 * APPROACH, -APPROACH] {
            let refusal = pulled.run(approach, pulled.carried).unwrap_err();
            let RunError::AboveSliding { increment, asked, bound, .. } = refusal else {
                panic!("{}: {refusal}", pulled.upper)
            };
            assert_eq!((increment, bound), (1, 0.0), "{}", pulled.upper);
            // Half of the force, at the end of the first of two increments.
            assert!((asked / (0.5 * pulled.carried) - 1.0).abs() < 1e-12, "{}", pulled.upper);
        }
    }
}
