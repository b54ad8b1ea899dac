//! What is left out changes the work, never the answer: every shortcut against the same run that computes everything.
//! `cargo test --release -p fret-validation leaving_out -- --nocapture` prints the table of `docs/leaving-out.md`.

use fret_core::case::Case;
use fret_core::history::History;
use fret_core::plan::{LeaveOut, Plan, Shortcut};
use fret_core::simulation::{Silent, Simulation};
use fret_validation::{Sphere, keeping};

const TOLERANCE: f64 = 1e-9;

fn solved(text: &str, leave_out: LeaveOut) -> History {
    let case = Case::from_toml(text, "case.toml").unwrap_or_else(|error| panic!("{error}"));
    let plan = Plan::leaving_out(case, leave_out).unwrap_or_else(|error| panic!("{error}"));
    let history =
        Simulation::new(&plan).run(&mut Silent).unwrap_or_else(|error| panic!("{leave_out:?}: {error}"));
    assert!(history.largest_residual() <= TOLERANCE);
    history
}

/// Largest difference of any traction of any increment: of pressure over the largest pressure, of shear over `friction` times it;
/// and of the approach and the dissipated energy over their largest.
fn difference(one: &History, other: &History, friction: f64) -> f64 {
    assert_eq!(one.steps.len(), other.steps.len());
    let mut worst = 0.0_f64;
    let energy = one.steps.iter().map(|step| step.dissipated_energy).fold(f64::MIN_POSITIVE, f64::max);
    for (a, b) in one.steps.iter().zip(&other.steps) {
        worst = worst.max((a.approach - b.approach).abs() / a.approach.abs().max(f64::MIN_POSITIVE));
        worst = worst.max((a.dissipated_energy - b.dissipated_energy).abs() / energy);
    }
    for ((a, b), step) in one.fields.iter().zip(&other.fields).zip(&one.steps) {
        let peak = step.max_pressure.max(f64::MIN_POSITIVE);
        let pairs = [(&a.pressure, &b.pressure)];
        for (a, b) in pairs.iter().flat_map(|(a, b)| a.as_ref().unwrap().iter().zip(b.as_ref().unwrap())) {
            worst = worst.max((a - b).abs() / peak);
        }
        let (a, b) = (a.shear.as_ref().unwrap(), b.shear.as_ref().unwrap());
        for (a, b) in (0..2).flat_map(|axis| a[axis].iter().zip(&b[axis])) {
            let scale = if friction > 0.0 { friction * peak } else { peak };
            worst = worst.max((a - b).abs() / scale);
        }
    }
    worst
}

struct Scene {
    name: &'static str,
    text: String,
    friction: f64,
    shortcut: Option<Shortcut>,
}

fn sphere() -> Sphere {
    Sphere { cells: 32, tolerance: TOLERANCE, friction: 0.3, ..Sphere::default() }
}

fn scenes() -> Vec<Scene> {
    let scene = |name, sphere: &Sphere, loads: String, shortcut| Scene {
        name,
        text: format!("{}{}", loads, keeping(1)),
        friction: sphere.friction,
        shortcut,
    };
    let rigid = sphere();
    let equal = Sphere { identical: true, ..sphere() };
    let coated = Sphere { coating: Some((4.0, 0.5)), identical: false, ..sphere() };
    let smooth = Sphere { friction: 0.0, ..coated.clone() };
    let wide = Sphere { size: 6.0, cells: 48, ..coated.clone() };
    let pull = |sphere: &Sphere, text: String| sphere.pulled(&text, 0.7, 4, None);
    vec![
        scene(
            "plain half-space",
            &rigid,
            pull(&rigid, rigid.pressed(1.0, 2, "linear")),
            Some(Shortcut::LayeredResponse),
        ),
        scene(
            "equal bodies",
            &equal,
            pull(&equal, equal.pressed(1.0, 2, "linear")),
            Some(Shortcut::Coupling),
        ),
        scene("no friction", &smooth, smooth.pressed(1.0, 3, "linear"), Some(Shortcut::Tangential)),
        scene(
            "equal bodies, pressed alone",
            &equal,
            equal.pressed(1.0, 4, "linear"),
            Some(Shortcut::Tangential),
        ),
        scene(
            "equal bodies, pulled alone",
            &equal,
            pull(&equal, equal.pressed(1.0, 1, "linear")),
            Some(Shortcut::Pressure),
        ),
        scene("wide grid", &wide, pull(&wide, wide.pressed(1.0, 2, "linear")), Some(Shortcut::Box)),
        scene(
            "all together",
            &Sphere { size: 6.0, cells: 48, ..equal.clone() },
            {
                let all = Sphere { size: 6.0, cells: 48, ..equal.clone() };
                pull(&all, all.pressed(1.0, 3, "linear"))
            },
            None,
        ),
    ]
}

#[test]
fn leaving_out_changes_the_work_and_not_the_answer() {
    println!(
        "| scene | shortcut | largest difference | convolutions without | with | of the whole grid without | with |"
    );
    println!("|---|---|---|---|---|---|---|");
    for Scene { name, text, friction, shortcut } in scenes() {
        let full = solved(&text, LeaveOut::NONE);
        let taken = shortcut.map_or(LeaveOut::ALL, LeaveOut::only);
        // Where coupling stays computed, what saves tangential and normal work needs the uncoupled way first.
        let short = solved(&text, taken);
        let off = difference(&full, &short, friction);
        let (without, with) = (full.work(), short.work());
        println!(
            "| {name} | {} | {off:.1e} | {} | {} | {:.1} | {:.1} |",
            shortcut.map_or("all".to_owned(), |shortcut| format!("{shortcut:?}")),
            without.convolutions,
            with.convolutions,
            without.full_grid_convolutions,
            with.full_grid_convolutions
        );
    }
}
