//! The onset of sliding under a coated contact. The paper says that the contact slides fully at a force significantly below
//! mu W. Equilibrium does not allow that: once every cell slips, the tractions carry nearly mu W. The last cell sticks
//! until T is close to mu W, and the shift can grow without bound only there.

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

#[test]
fn a_force_that_a_prescribed_approach_cannot_carry_is_refused_and_not_answered_by_sliding() {
    // Hertz: an approach d of a paraboloid of radius R presses with 4/3 E* sqrt(R) d^1.5; friction carries mu times that.
    // Apart it carries nothing. Bodies that couple, and those that do not.
    let (radius, approach, friction) = (10e-3_f64, 1e-6_f64, 0.2);
    for (upper, modulus) in [
        ("rigid = true", 210e9 / (1.0 - 0.09)),
        ("substrate = { young = 210e9, poisson = 0.3 }", 210e9 / (2.0 * (1.0 - 0.09))),
    ] {
        let carried = friction * 4.0 / 3.0 * modulus * radius.sqrt() * approach.powf(1.5);
        let text = |approach: f64, force: f64| {
            format!(
                "grid = {{ cells = [24, 24], size = [300e-6, 300e-6] }}\nfriction.coefficient = {friction}\n\
                 profile.sphere.radius = {radius:e}\n[upper]\n{upper}\n[lower]\n\
                 substrate = {{ young = 210e9, poisson = 0.3 }}\n[[load]]\napproach = {approach:e}\nincrements = 1\n\
                 [[load]]\ntangential_force = [{force:e}, 0.0]\nincrements = 2\n"
            )
        };
        // On 24 cells the force is Hertz's within a few per cent.
        assert!(run(&text(approach, 0.9 * carried)).is_ok(), "{upper}");
        for (approach, force) in [(approach, 1.1 * carried), (1e-3 * approach, carried), (-approach, carried)]
        {
            let Err(refusal) = run(&text(approach, force)) else { panic!("{upper}: carried") };
            let refusal = refusal.to_string();
            assert!(refusal.contains("above mu W") || refusal.contains("not solved"), "{upper}: {refusal}");
        }
    }
}
