//! Runs of every kind hold their laws as the certifier computes them; and what is not right does not pass it.

use fret_core::case::Case;
use fret_core::model::Zone;
use fret_core::plan::Plan;
use fret_validation::Sphere;
use fret_validation::certifier::{Ended, Kept, certify, run_certified};
use ndarray::Array2;

fn ended(text: &str, arrays: &[Array2<f64>]) -> Ended {
    let ended = run_certified(text, arrays).unwrap_or_else(|error| panic!("{error}"));
    assert!(ended.error.is_none(), "{:?}", ended.error);
    ended
}

fn sphere() -> Sphere {
    Sphere { cells: 24, friction: 0.3, ..Sphere::default() }
}

/// A coated sphere pressed and pulled, whose last increment has stick, slip and no contact.
fn partial_slip() -> Ended {
    let sphere = Sphere { coating: Some((4.0, 0.5)), ..sphere() };
    ended(&sphere.pulled(&sphere.pressed(1.0, 3, "cubic"), 0.7, 4, None), &[])
}

#[test]
fn runs_of_every_kind_hold_their_laws() {
    let rigid = sphere();
    let coated = Sphere { coating: Some((10.0, 0.2)), ..sphere() };
    let equal = Sphere { identical: true, ..sphere() };
    let pulled = |sphere: &Sphere| sphere.pulled(&sphere.pressed(1.0, 3, "cubic"), 0.8, 3, None);
    let both = pulled(&Sphere { size: 6.0, ..coated.clone() }).replace(
        "rigid = true",
        "coatings = [{ thickness = 0.1, young = 0.2, poisson = 0.1 }]\nsubstrate = { young = 3.0, poisson = 0.45 }",
    );
    let periodic = |sphere: &Sphere| pulled(sphere).replace("[upper]", "periodic = true\n[upper]");
    let in_a_row = |sphere: &Sphere, axis: &str| {
        let row = format!("periodic = \"{axis}\"\n[upper]");
        pulled(sphere).replace("[upper]", &row)
    };
    let scale = rigid.approach();
    let moved = |sphere: &Sphere, motion: &str| {
        format!("{}[[load]]\napproach = {scale:e}\nincrements = 2\n{motion}", sphere.head())
    };
    let there_and_back = format!(
        "[[load]]\nshift = [{:e}, {:e}]\nincrements = 3\n[[load]]\nshift = [{:e}, 0.0]\nincrements = 3\n",
        0.2 * scale,
        0.1 * scale,
        -0.1 * scale
    );
    let twisted = format!(
        "[[load]]\ntwist = {:e}\nincrements = 3\n[[load]]\ntwist = {:e}\nshift = [{:e}, 0.0]\nincrements = 3\n",
        0.3 * scale,
        -0.1 * scale,
        0.1 * scale
    );
    let force = rigid.force();
    let by_moment = format!(
        "{}[[load]]\ntwist_moment = {:e}\nincrements = 3\n[[load]]\ntangential_force = [{:e}, {:e}]\nincrements = 2\n",
        coated.pressed(1.0, 2, "cubic"),
        0.08 * force,
        0.05 * force,
        0.1 * force
    );
    let cycles = format!(
        "[[load]]\nshift = [{:e}, 0.0]\nincrements = 8\ncycles = 2\nwaveform = \"sine\"\n",
        0.15 * scale
    );
    let wear = |law: &str| {
        let law = format!("[wear]\nlaw = \"{law}\"\ncoefficient = 5.0\n[[load]]");
        moved(&equal, &cycles).replacen("[[load]]", &law, 1)
    };
    let let_go = format!(
        "{}[[load]]\nshift = [0.0, 0.0]\nincrements = 1\n[[load]]\napproach = {:e}\nincrements = 3\n\
         [[load]]\napproach = {scale:e}\nincrements = 1\n",
        moved(&rigid, &there_and_back),
        -0.1 * scale
    );
    let friction_falls =
        format!("{}[[load]]\nfriction = 0.25\nincrements = 1\n", moved(&coated, &there_and_back));
    let smooth = Sphere { friction: 0.0, ..coated.clone() };
    let map = Array2::from_shape_fn((24, 24), |(i, j)| if (i + j) % 7 < 3 { 0.1 } else { 0.02 * i as f64 });
    let mapped = moved(&rigid, &there_and_back).replace("coefficient = 0.3", "map = { array = 0 }");
    let automatic = pulled(&rigid).replace("increments = 3", "increments = \"auto\"");
    let cases: [(&str, String, &[Array2<f64>]); 20] = [
        ("plain", pulled(&rigid), &[]),
        ("coated", pulled(&coated), &[]),
        ("equal bodies", pulled(&equal), &[]),
        ("two coated bodies", both, &[]),
        ("frictionless", smooth.pressed(1.0, 3, "linear"), &[]),
        ("periodic, coupled", periodic(&coated), &[]),
        ("periodic, equal bodies", periodic(&equal), &[]),
        ("periodic in y, coupled", in_a_row(&coated, "y"), &[]),
        ("periodic in x, equal bodies", in_a_row(&equal, "x"), &[]),
        ("by approach and shift", moved(&coated, &there_and_back), &[]),
        ("by approach and shift, equal bodies", moved(&equal, &there_and_back), &[]),
        ("twisted", moved(&coated, &twisted), &[]),
        ("twisted, equal bodies", moved(&equal, &twisted), &[]),
        ("by moment", by_moment, &[]),
        ("worn, Archard", wear("archard"), &[]),
        ("worn, energy", wear("energy"), &[]),
        ("lifted off and pressed again", let_go, &[]),
        ("friction that falls", friction_falls, &[]),
        ("friction map", mapped, std::slice::from_ref(&map)),
        ("in as many parts as the history asks for", automatic, &[]),
    ];
    for (name, text, arrays) in cases {
        let ended = ended(&text, arrays);
        let worst = |value: fn(&fret_validation::certifier::Certificate) -> f64| {
            ended.certificates.iter().map(value).fold(0.0, f64::max)
        };
        println!(
            "{name}: {} increments, complementarity {:.1e}, Coulomb {:.1e}, slip {:.1e}, energy {:.1e}",
            ended.run.len(),
            worst(|found| found.complementarity),
            worst(|found| found.coulomb),
            worst(|found| found.slip),
            worst(|found| found.energy)
        );
        assert_eq!(ended.wrong(), None, "{name}");
    }
}

/// What is done to an increment, and the laws of which at least one has to find it.
type Corruption = (&'static str, fn(&mut Kept), &'static [&'static str]);

/// The first cell of a zone that satisfies a condition on its place.
fn cell(kept: &Kept, wanted: Zone) -> [usize; 2] {
    let zones = kept.fields.zone.as_ref().unwrap();
    // Away from the middle, where a sphere has no direction.
    let found = zones.indexed_iter().find(|((i, j), zone)| **zone == wanted && (*i > 8 || *j > 8));
    found.map_or_else(|| panic!("no cell is {wanted:?}"), |((i, j), _)| [i, j])
}

fn scale_pressure(kept: &mut Kept, zone: Zone, factor: f64) {
    let at = cell(kept, zone);
    kept.fields.pressure.as_mut().unwrap()[at] *= factor;
}

fn scale_shear(kept: &mut Kept, zone: Zone, factor: f64) {
    let at = cell(kept, zone);
    kept.fields.shear.as_mut().unwrap().iter_mut().for_each(|part| part[at] *= factor);
}

fn rename(kept: &mut Kept, from: Zone, to: Zone) {
    let at = cell(kept, from);
    kept.fields.zone.as_mut().unwrap()[at] = to;
}

const CORRUPTIONS: [Corruption; 27] = [
    ("pressure of a cell", |kept| scale_pressure(kept, Zone::Stick, 1.0 + 1e-6), &["gap"]),
    ("shear of a sticking cell", |kept| scale_shear(kept, Zone::Stick, 1.0 + 1e-6), &["slip"]),
    ("shear of a slipping cell grows", |kept| scale_shear(kept, Zone::Slip, 1.0 + 1e-6), &["excess"]),
    ("shear of a slipping cell falls", |kept| scale_shear(kept, Zone::Slip, 1.0 - 1e-6), &["on_circle"]),
    ("shear of a slipping cell turns", |kept| turn(kept, 1e-5), &["direction"]),
    ("shear of a slipping cell points back", |kept| scale_shear(kept, Zone::Slip, -1.0), &["against"]),
    ("stick called slip", |kept| rename(kept, Zone::Stick, Zone::Slip), &["on_circle"]),
    ("slip called stick", |kept| rename(kept, Zone::Slip, Zone::Stick), &["slip"]),
    ("stick called open", |kept| rename(kept, Zone::Stick, Zone::Open), &["columns"]),
    ("a cell that is apart called slip", |kept| rename(kept, Zone::Open, Zone::Slip), &["columns"]),
    ("slip where a cell sticks", |kept| slide(kept, Zone::Stick, 1e-6), &["slip"]),
    ("slip where a cell is apart", |kept| slide(kept, Zone::Open, 1e-6), &["slip"]),
    ("more slip", |kept| slide(kept, Zone::Slip, 1e-6), &["slip"]),
    ("tension", |kept| scale_pressure(kept, Zone::Slip, -1e-9), &["tension"]),
    (
        "gap of a cell",
        |kept| {
            let at = cell(kept, Zone::Open);
            kept.fields.gap.as_mut().unwrap()[at] *= 1.0 + 1e-6;
        },
        &["gap"],
    ),
    (
        "shear outside the contact",
        |kept| {
            let at = cell(kept, Zone::Open);
            kept.fields.shear.as_mut().unwrap()[0][at] = 1e-6 * kept.record.max_shear;
        },
        &["excess"],
    ),
    (
        "all pressures, so that only the force is wrong",
        |kept| {
            *kept.fields.pressure.as_mut().unwrap() *= 1.0 + 1e-6;
        },
        &["equilibrium"],
    ),
    ("twice all tractions", double, &["equilibrium"]),
    ("approach", |kept| kept.record.approach *= 1.0 + 1e-6, &["gap"]),
    ("shift", |kept| kept.record.shift[0] *= 1.0 + 1e-6, &["slip"]),
    ("twist", |kept| kept.record.twist = 1e-6 * kept.record.shift[0], &["motion"]),
    ("normal force", |kept| kept.record.normal_force *= 1.0 + 1e-6, &["columns"]),
    (
        "tangential force",
        |kept| kept.record.tangential_force[1] = 1e-6 * kept.record.normal_force,
        &["columns"],
    ),
    ("maximum pressure", |kept| kept.record.max_pressure *= 1.0 + 1e-6, &["columns"]),
    ("dissipated energy", |kept| kept.record.dissipated_energy *= 1.0 + 1e-6, &["energy"]),
    ("number of sticking cells", |kept| kept.record.stick_cells -= 1, &["columns"]),
    ("not a number", |kept| kept.record.dissipated_energy = f64::NAN, &["energy"]),
];

fn turn(kept: &mut Kept, angle: f64) {
    let at = cell(kept, Zone::Slip);
    let [x, y] = kept.fields.shear.as_mut().unwrap();
    let (sin, cos) = angle.sin_cos();
    (x[at], y[at]) = (cos * x[at] - sin * y[at], sin * x[at] + cos * y[at]);
}

/// Moves a cell by a fraction of the bodies' shift.
fn slide(kept: &mut Kept, zone: Zone, fraction: f64) {
    let at = cell(kept, zone);
    kept.fields.slip.as_mut().unwrap()[0][at] += fraction * kept.record.shift[0];
}

/// Tractions of another load, and the columns that follow from them.
fn double(kept: &mut Kept) {
    let fields = &mut kept.fields;
    *fields.pressure.as_mut().unwrap() *= 2.0;
    fields.shear.as_mut().unwrap().iter_mut().for_each(|part| *part *= 2.0);
    kept.record.normal_force *= 2.0;
    kept.record.tangential_force = kept.record.tangential_force.map(|force| 2.0 * force);
    kept.record.max_pressure *= 2.0;
    kept.record.max_shear *= 2.0;
}

#[test]
fn what_is_wrong_in_the_seventh_digit_is_found() {
    let ended = partial_slip();
    assert_eq!(ended.wrong(), None);
    let tolerance = ended.plan.case.tolerance;
    for (name, corrupt, laws) in CORRUPTIONS {
        let mut run = ended.run.clone();
        let last = run.last_mut().unwrap();
        corrupt(last);
        let certificate = certify(&ended.plan, &run).unwrap().pop().unwrap();
        let found = certificate.violations(tolerance);
        println!("{name}: {found:?}");
        assert!(laws.iter().all(|law| found.iter().any(|(name, _)| name == law)), "{name}: {found:?}");
    }
}

#[test]
fn another_case_than_the_one_that_was_run_is_found() {
    let ended = partial_slip();
    let sphere = Sphere { coating: Some((4.0, 0.5)), ..sphere() };
    let text = sphere.pulled(&sphere.pressed(1.0, 3, "cubic"), 0.7, 4, None);
    let judged_as = |text: &str| {
        let plan = Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap();
        let certificates = certify(&plan, &ended.run).unwrap();
        let mut found: Vec<&str> =
            certificates.iter().flat_map(|found| found.violations(1e-8)).map(|(name, _)| name).collect();
        found.sort_unstable();
        found.dedup();
        found
    };
    assert_eq!(judged_as(&text), [""; 0]);
    let force = format!("normal_force = {:e}", sphere.force());
    let pull = format!("tangential_force = [{:e}", 0.7 * 0.3 * sphere.force());
    for (from, to, law) in [
        ("coefficient = 0.3", "coefficient = 0.3000003".to_owned(), "on_circle"),
        ("coefficient = 0.3", "coefficient = 0.2999997".to_owned(), "excess"),
        ("radius = 1e2", "radius = 1.000001e2".to_owned(), "gap"),
        ("young = 4e0", "young = 4.00001e0".to_owned(), "gap"),
        ("thickness = 5e-1", "thickness = 5.00001e-1".to_owned(), "slip"),
        (&force, format!("normal_force = {:e}", sphere.force() * (1.0 + 1e-6)), "equilibrium"),
        (
            &pull,
            format!("tangential_force = [{:e}", 0.7 * 0.3 * sphere.force() * (1.0 + 1e-6)),
            "equilibrium",
        ),
    ] {
        assert!(text.contains(from), "{from} in {text}");
        let found = judged_as(&text.replace(from, &to));
        println!("{to}: {found:?}");
        assert!(found.contains(&law), "{to}: {found:?}");
    }
}

#[test]
fn wear_that_the_gap_does_not_show_is_found() {
    let sphere = Sphere { identical: true, poisson: 0.0, ..sphere() };
    let text = format!(
        "{}[wear]\ncoefficient = 5.0\n[[load]]\napproach = {:e}\nincrements = 1\n[[load]]\nshift = [{:e}, 0.0]\n\
         increments = 8\ncycles = 2\n",
        sphere.head(),
        sphere.approach(),
        0.15 * sphere.approach()
    );
    let ended = ended(&text, &[]);
    assert_eq!(ended.wrong(), None);
    let mut run = ended.run.clone();
    // The first cycle ends with increment 8; its wear opens the gap of the next one.
    let worn = run[8].fields.worn_depth.as_mut().unwrap();
    assert!(worn.iter().any(|depth| *depth > 0.0));
    *worn *= 1.0 + 1e-4;
    let certificates = certify(&ended.plan, &run).unwrap();
    assert!(certificates[9].violations(1e-8).iter().any(|(law, _)| *law == "gap"), "{:?}", certificates[9]);
}

#[test]
fn the_moment_that_holds_the_bodies_from_turning_is_reported() {
    // Friction on one half only: a shift along x pulls off the middle, and the bodies do not turn.
    let map = Array2::from_shape_fn((24, 24), |(_, j)| if j < 12 { 0.0 } else { 0.3 });
    let sphere = sphere();
    let text = format!(
        "{}[[load]]\napproach = {:e}\nincrements = 1\n[[load]]\nshift = [{:e}, 0.0]\nincrements = 2\n",
        sphere.head().replace("coefficient = 0.3", "map = { array = 0 }"),
        sphere.approach(),
        0.1 * sphere.approach()
    );
    for certificate in ended(&text, &[map]).certificates {
        assert!(certificate.moment < 1e-9, "{certificate:?}");
    }
}
