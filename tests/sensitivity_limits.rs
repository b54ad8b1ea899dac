//! Exact sensitivities against closed forms, an axisymmetric integral equation; and what is refused.

use fret_core::plan::Plan;

use crate::sensitivities::{SIMILAR, found, planned};

/// Hertz: the pressure grows with the powers 1/3 of the force, 2/3 of the modulus and -2/3 of the radius; the approach with 2/3, -2/3, -1/3. On 64
/// cells, 25 in the radius, within 1e-3.
#[test]
fn hertz_has_its_powers() {
    let text = "[grid]\ncells = [64, 64]\nsize = [2.5, 2.5]\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n\
                [profile.sphere]\nradius = 20.0\n[solver]\ntolerance = 1e-10\n[[load]]\nnormal_force = 0.0733\nincrements = 1\n";
    let by = ["load[0].normal_force", "lower.substrate.young", "profile.sphere.radius"];
    let found = found(&planned(text), &["max_pressure", "approach"], &by).unwrap();
    let expected = [[1.0, 2.0, -2.0], [2.0, -2.0, -1.0]].map(|row| row.map(|third| third / 3.0));
    for (gradient, expected) in found.gradients.iter().zip(expected) {
        for ((by, parameter), expected) in gradient.by.iter().zip(&found.parameters).zip(expected) {
            let power = by * parameter.value() / gradient.value;
            assert!((power - expected).abs() < 1e-3, "{} by {}: {power}", gradient.of, parameter.path());
        }
    }
}

/// Coated sphere at a fixed force, thickness equal to the Hertz radius on the substrate, nu = 0.3: logarithmic derivatives by an axisymmetric integral
/// equation, of the maximum pressure and the approach, by the coating's modulus and thickness. 96 cells.
#[test]
fn coated_spheres_have_the_powers_of_the_integral_equation() {
    let golden: serde_json::Value = serde_json::from_str(include_str!("golden/sensitivities.json")).unwrap();
    for row in golden["coated_sphere"].as_array().unwrap() {
        let ratio = row["young_ratio"].as_f64().unwrap();
        let text = format!(
            "[grid]\ncells = [96, 96]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\n[lower]\ncoatings = [{{ thickness = 1.0, young = {ratio:e}, \
             poisson = 0.3 }}]\nsubstrate = {{ young = 0.91, poisson = 0.3 }}\n[profile.sphere]\nradius = 10.0\n[solver]\n\
             tolerance = 1e-10\n[[load]]\nnormal_force = {:e}\nincrements = 1\n",
            4.0 / 30.0
        );
        // E* = 0.91/(1 - 0.09) = 1: a^3 = 3 P R/(4 E*) = 1.
        let text = text.replace(&format!("young = {ratio:e}"), &format!("young = {:e}", 0.91 * ratio));
        let by = ["lower.coatings[0].young", "lower.coatings[0].thickness"];
        let found = found(&planned(&text), &["max_pressure", "approach"], &by).unwrap();
        for (index, parameter) in found.parameters.iter().enumerate() {
            for (gradient, key) in found.gradients.iter().zip(["pressure", "approach"]) {
                let power = gradient.by[index] * parameter.value() / gradient.value;
                let expected = row[["by_young", "by_thickness"][index]][key].as_f64().unwrap();
                // What the grid leaves of the functions themselves.
                assert!((power - expected).abs() < 1e-3, "{ratio}: {key} by {}: {power}", parameter.path());
            }
        }
    }
}

/// The energy that a loop of similar spheres dissipates at a constant force (Mindlin & Deresiewicz 1953) has the logarithmic derivative -2.311 by
/// the friction coefficient at Q/(mu P) = 0.754.
#[test]
fn the_energy_of_a_loop_falls_with_friction_as_mindlin_and_deresiewicz_say() {
    // W = mu^2 (1 - (1 - r)^(5/3) - 5 r/6 (1 + (1 - r)^(2/3))), r = Q/(mu P), up to a constant.
    let of = |mu: f64| {
        let left = 1.0 - 0.754 / mu;
        mu * mu * (1.0 - left.powf(5.0 / 3.0) - 5.0 * (1.0 - left) / 6.0 * (1.0 + left.powf(2.0 / 3.0)))
    };
    let closed =
        (of(1.0 + 1e-5).ln() - of(1.0 - 1e-5).ln()) / ((1.0_f64 + 1e-5).ln() - (1.0_f64 - 1e-5).ln());
    assert!((closed + 2.311).abs() < 1e-4, "{closed}");
    // On one grid the stick zone grows cell by cell, and the derivative scatters with it (-2.69, -2.20, -2.25 on 32, 64, 128 cells): the mean over
    // coefficients that move its edge by a few cells, against the same mean of the closed form. A scatter of a tenth in seventeen values.
    let slope = |mu: f64| (of(mu * (1.0 + 1e-5)).ln() - of(mu * (1.0 - 1e-5)).ln()) / 2e-5;
    let (mut mean, mut exact) = (0.0, 0.0);
    for step in -8..=8 {
        let factor = 1.0 + 0.01 * f64::from(step);
        let text = format!(
            "[grid]\ncells = [64, 64]\nsize = [2.4, 2.4]\n[upper]\nsubstrate = {{ young = 2.0, poisson = 0.0 }}\n[lower]\n\
             substrate = {{ young = 2.0, poisson = 0.0 }}\n[profile.sphere]\nradius = 20.0\n[friction]\ncoefficient = {:e}\n\
             [solver]\ntolerance = 1e-10\n[[load]]\nnormal_force = {:e}\nincrements = 1\n[[load]]\n\
             tangential_force = [{:e}, 0.0]\nincrements = 8\ncycles = 1\n",
            0.1 * factor,
            2.0 / 30.0,
            0.0754 * 2.0 / 30.0
        );
        let found =
            found(&planned(&text), &["cycles[0].dissipated_energy"], &["friction.coefficient"]).unwrap();
        mean += found.gradients[0].by[0] * 0.1 * factor / found.gradients[0].value / 17.0;
        exact += slope(factor) / 17.0;
    }
    assert!((mean / exact - 1.0).abs() < 0.03, "{mean} {exact}");
}

/// What is not differentiated is refused, by the key that it is about.
#[test]
fn what_is_not_covered_is_refused() {
    let text = SIMILAR
        .replace("<E>", "210e9")
        .replace("<R>", "10e-3")
        .replace("<mu>", "0.3")
        .replace("<P>", "12.0")
        .replace("<Q>", "2.5");
    let plan = planned(&text);
    let message = |of: &str, by: &str, plan: &Plan| found(plan, &[of], &[by]).unwrap_err().to_string();
    for (by, word) in [
        ("friction.max_shear", "none"),
        ("lower.coatings[0].young", "0 coatings"),
        ("upper.substrate.young", "rigid"),
        ("load[1].shift[0]", "does not prescribe"),
        ("load[7].normal_force", "2 stages"),
        ("load[1].tangential_force", "[0]"),
        ("grid.size", "paths are those of the case"),
        ("profile.sphere.slope", "smoothly"),
        ("profile.cone.slope", "no such shape"),
        ("rig.normal_stiffness", "no such spring"),
        ("friction[", "paths"),
    ] {
        let found = message("max_pressure", by, &plan);
        assert!(found.contains(word) && found.contains(by), "{found}");
    }
    for (of, word) in [
        ("pressure", "max_pressure"),
        ("contact_area", "between the cells"),
        ("increments[99].shift_x", "11 increments"),
        ("cycles[1].dissipated_energy", "1 cycles"),
        ("cycles[0].closure", "dissipated_energy"),
        ("increments[x].shift_x", "increments[7]"),
        ("worn_volume", "nothing wears"),
        ("wear_work", "nothing wears"),
        ("bulk_work", "no bulk stress"),
    ] {
        let found = message(of, "friction.coefficient", &plan);
        assert!(found.contains(word) && found.contains(of), "{found}");
    }
    for (more, key) in [
        (
            "[wear]\ncoefficient = 1e-13\n[wear.debris]\nfraction = 0.5\nstiffness = 1e12\n",
            "wear.debris.stiffness",
        ),
        ("[kinematics]\ndisplacement = \"finite\"\n", "kinematics"),
    ] {
        let found = message("max_pressure", "friction.coefficient", &planned(&format!("{text}{more}")));
        assert!(found.contains(key), "{found}");
    }
}

/// Derivatives that would be wrong in silence, each refused with its reason.
#[test]
fn derivatives_that_would_be_wrong_are_refused() {
    let ball = |lower: &str, upper: &str, loads: &str| {
        format!(
            "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\n{upper}\n[lower]\nsubstrate = {{ young = 1.0, poisson = {lower} }}\n\
             [profile.sphere]\nradius = 10.0\n[friction]\ncoefficient = 0.4\n{loads}"
        )
    };
    let (rigid, like) = ("rigid = true", "substrate = { young = 1.0, poisson = 0.3 }");
    let pressed = "[[load]]\nnormal_force = 0.1\nincrements = 2\n";
    let stage = |words: &str| format!("{pressed}[[load]]\n{words}\n");
    for (case, by, word) in [
        // only the law of friction changes: the tractions do, and no load does
        (
            ball(
                "0.3",
                rigid,
                &stage("shift = [0.05, 0.0]\nincrements = 2\n[[load]]\nfriction = 0.2\nincrements = 1"),
            ),
            "load[2].friction",
            "no load changes",
        ),
        // a value that is said again: nothing changes, and everything by the number that says it
        (
            ball("0.3", rigid, &stage("normal_force = 0.1\nincrements = 1")),
            "load[1].normal_force",
            "no load changes",
        ),
        // a component that is 0, in a plan of half the grid since it is
        (
            ball("0.3", rigid, &stage("tangential_force = [0.01, 0.0]\nincrements = 2")),
            "load[1].tangential_force[1]",
            "it is 0",
        ),
        // elastically similar bodies, coupled with other constants: with torsion that is of first order even under a sphere
        (
            ball(
                "0.3",
                like,
                &stage("tangential_force = [0.01, 0.02]\ntwist_moment = 0.004\nincrements = 3"),
            ),
            "upper.substrate.young",
            "not symmetric",
        ),
        (
            ball("0.3", like, "[[load]]\nnormal_force = 0.1\ntilt = [0.02, 0.01]\nincrements = 2\n"),
            "upper.substrate.young",
            "not symmetric",
        ),
        (
            ball(
                "0.3",
                like,
                &stage("tangential_force = [0.01, 0.0]\nbulk_stress = [0.02, 0.0]\nincrements = 2"),
            ),
            "lower.substrate.young",
            "not symmetric",
        ),
        (ball("0.5", rigid, pressed), "lower.substrate.poisson", "0.499"),
        // bodies that are apart first: when a cell touches is known to the run in another way
        (
            ball(
                "0.3",
                rigid,
                "[[load]]\napproach = -0.05\nincrements = 1\n[[load]]\napproach = 0.06\nshift = [0.02, 0.0]\nincrements = 6\n",
            ),
            "load[1].approach",
            "apart before they touch",
        ),
    ] {
        let refused = found(&planned(&case), &["max_pressure"], &[by]).unwrap_err().to_string();
        assert!(refused.contains(word), "{by}: {refused}");
    }
    // odd in a mirror: their derivative would be 0
    let slid = ball("0.3", like, &stage("tangential_force = [0.01, 0.0]\nincrements = 2"));
    let refused = found(&planned(&slid), &["tilt_moment_x"], &["upper.substrate.young"]);
    assert!(refused.unwrap_err().to_string().contains("tilt_moment_x has no derivative"));
    assert!(found(&planned(&slid), &["shift_x"], &["upper.substrate.young"]).is_ok());
    let wave = "[grid]\ncells = [64, 4]\nsize = [1.0, 0.1]\nperiodic = true\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.3 }\n\
                [profile.wave]\namplitude = 0.01\nwavelength_x = 1.0\n[friction]\ncoefficient = 0.4\n[[load]]\nmean_gap = 6e-3\nincrements = 2\n";
    let refused =
        found(&planned(wave), &["normal_force"], &["profile.wave.amplitude"]).unwrap_err().to_string();
    assert!(refused.contains("mean_gap"), "{refused}");
}
