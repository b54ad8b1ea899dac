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
