//! Friction with a shear strength of the interface, `|q| <= min(mu p, tau)`: full sliding and its onset against closed forms, limits
//! against Coulomb's law, and the laws as the certifier computes them.

use fret_core::run::RunError;
use fret_validation::certifier::run_certified;
use fret_validation::{Sphere, run, solved};

/// Equal bodies: pressure is Hertz's whatever the shear.
fn equal(cells: usize) -> Sphere {
    Sphere { cells, identical: true, friction: 0.5, tolerance: 1e-8, ..Sphere::default() }
}

/// The case with a shear strength in units of mu times Hertz's largest pressure.
fn with_strength(sphere: &Sphere, strength: f64, loads: &str) -> String {
    let tau = strength * sphere.friction * sphere.max_pressure();
    let text = format!("{}{loads}", sphere.pressed(1.0, 1, "linear"));
    text.replacen("[friction]\n", &format!("[friction]\nmax_shear = {tau:e}\n"), 1)
}

/// Slides far beyond what partial slip bears. Cells stick in a small part of the first increment, across which their slip then turns: the
/// third is the first one that goes on from two that only slide.
fn slid(sphere: &Sphere) -> String {
    format!("[[load]]\nshift = [{:e}, 0.0]\nincrements = 4\n", 40.0 * sphere.friction * sphere.approach())
}

/// `sum min(mu p, tau)` over a Hertz contact, over mu P: the disc inside which tau bounds has the radius `a sqrt(1 - s^2)`, s the strength
/// over mu times the largest pressure.
fn full_sliding(strength: f64) -> f64 {
    if strength >= 1.0 {
        return 1.0;
    }
    let inside = 1.0 - strength * strength;
    1.5 * inside * strength + (1.0 - inside).powf(1.5)
}

#[test]
fn full_sliding_carries_the_integral_of_the_bounded_traction() {
    for strength in [0.2, 0.5, 0.8, 1.5] {
        let errors = [32, 64].map(|cells| {
            let sphere = equal(cells);
            let history = solved(&with_strength(&sphere, strength, &slid(&sphere)));
            let last = history.steps.last().unwrap();
            assert_eq!(last.stick_cells, 0);
            last.tangential_force[0] / (sphere.friction * sphere.force()) / full_sliding(strength) - 1.0
        });
        println!("strength {strength}: {errors:?}");
        // The cells at the edge hold up to a hundredth of the force at 64 cells under the smallest strength; half as many at the next.
        assert!(
            errors[1].abs() < 0.01 && errors[1].abs() <= 0.7 * errors[0].abs() + 1e-8,
            "{strength}: {errors:?}"
        );
    }
}

#[test]
fn a_strength_that_is_never_reached_changes_no_bit() {
    let sphere = Sphere { coating: Some((4.0, 0.5)), friction: 0.3, ..Sphere::default() };
    let pulled =
        format!("[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 4\n", 0.7 * 0.3 * sphere.force());
    let bounded = solved(&with_strength(&sphere, 1e3, &pulled));
    let free = solved(&format!("{}{pulled}", sphere.pressed(1.0, 1, "linear")));
    assert_eq!(bounded.state, free.state);
}

#[test]
fn more_than_the_bounded_traction_carries_is_refused() {
    let sphere = equal(32);
    let force = sphere.friction * sphere.force();
    for (fraction, carried) in [(0.97, true), (1.05, false)] {
        let pull = format!(
            "[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 2\n",
            fraction * full_sliding(0.5) * force
        );
        let outcome = run(&with_strength(&sphere, 0.5, &pull));
        match outcome {
            Ok(history) => assert!(carried && history.largest_residual() <= 1e-8),
            Err(error) => {
                assert!(!carried && matches!(error, RunError::AboveSliding { .. }), "{fraction}: {error}");
            }
        }
    }
}

/// Coupled, coated, loaded and unloaded obliquely, with wear of its energy: all laws hold with the bound of both.
#[test]
fn the_laws_hold_with_a_strength() {
    for (strength, wear) in [(0.3, ""), (0.7, "[wear]\ncoefficient = 1e-9\n")] {
        let sphere = Sphere { cells: 24, coating: Some((4.0, 0.5)), friction: 0.4, ..Sphere::default() };
        let force = 0.4 * sphere.force();
        let loads = format!(
            "[[load]]\ntangential_force = [{:e}, {:e}]\nincrements = 3\n[[load]]\ntangential_force = [{:e}, 0.0]\nincrements = 3\n\
             [[load]]\nnormal_force = {:e}\nincrements = 2\n{wear}",
            0.2 * force,
            0.1 * force,
            -0.2 * force,
            0.8 * sphere.force()
        );
        let ended = run_certified(&with_strength(&sphere, strength, &loads), &[]).unwrap();
        assert!(ended.error.is_none(), "{:?}", ended.error);
        assert_eq!(ended.wrong(), None);
        let slipped = ended.run.iter().any(|kept| kept.record.stick_cells < kept.record.contact_cells);
        assert!(slipped);
    }
}
