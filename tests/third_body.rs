//! Debris between worn surfaces, and wear by the distance from the rim of the contact: nothing is lost, what fills the gap carries, and what has
//! no part in a case changes no bit of it.

use std::f64::consts::PI;

use fret_core::case::{Attachments, Case};
use fret_core::history::{History, Start, StepRecord};
use fret_core::plan::{LeaveOut, Plan, Simplification};
use fret_core::run::{Silent, Simulation};
use fret_validation::{off_first_law, solved};
use ndarray::Array2;

const FINITE: &str = "[kinematics]\ndisplacement = \"finite\"\n";
const RADIUS: f64 = 100.0;

/// Force by length of a Hertz half-width of 0.15 on E* = 1.
fn line_force() -> f64 {
    PI * 0.15 * 0.15 / (4.0 * RADIUS)
}

/// A rigid cylinder on a half-plane of E* = 1, both of which wear, in gross slip of a stroke; `wear` is the end of the table [wear], and what
/// follows it.
fn cylinder(kinematics: &str, [lower, upper]: [f64; 2], cycles: usize, wear: &str) -> String {
    let force = line_force();
    format!(
        "[grid]\ncells = 96\nsize = 2.4\n[upper]\nrigid = true\nwear_coefficient = {upper:e}\n[lower]\n\
         substrate = {{ young = 0.91, poisson = 0.3, wear_coefficient = {lower:e} }}\n[profile.cylinder]\nradius = {RADIUS}\naxis = \"y\"\n\
         [friction]\ncoefficient = 0.3\n{kinematics}[output]\nfields = [\"worn_depth\", \"debris\", \"pressure\"]\n\
         [[load]]\nnormal_force = {force:e}\nincrements = 2\n\
         [[load]]\nshift = [0.1, 0.0]\ncycles = {cycles}\nincrements = 16\n\
         [wear]\nevery = 1000000\nlargest_step = 0.05\n{wear}"
    )
}

/// Debris is a fraction of what wore off less what flowed out, increment by increment: sums of the same numbers, to their rounding.
fn assert_the_volume_is_kept(history: &History, fraction: f64) {
    for step in &history.steps {
        let kept = step.debris.volume + step.debris.outflow;
        let made = fraction * step.worn_volume;
        assert!((kept - made).abs() <= 1e-12 * made, "increment {}: {kept:e} {made:e}", step.increment);
    }
    let thickness = history.fields.last().unwrap().debris.as_ref().unwrap();
    let volume = thickness.sum() * history.grid.cell_area();
    let last = history.steps.last().unwrap();
    assert!((volume - last.debris.volume).abs() <= 1e-13 * volume && last.debris.outflow > 0.0);
    assert_eq!(thickness.iter().copied().fold(0.0, f64::max), last.debris.max_thickness);
    let cycle = history.cycles.last().unwrap();
    assert_eq!(
        (cycle.debris_volume, cycle.debris_outflow),
        (Some(last.debris.volume), Some(last.debris.outflow))
    );
}

#[test]
fn what_wears_off_is_there_or_has_flowed_out() {
    let debris = "[wear.debris]\nfraction = 0.6\noutflow_length = 40.0\n";
    for kinematics in ["", FINITE] {
        for wear in [
            debris.to_owned(),
            format!("tolerance = 0.05\n{debris}[wear.rim]\nwidth = 0.06\ninterior = 0.3\n"),
        ] {
            let history = solved(&cylinder(kinematics, [0.003, 0.0015], 3000, &wear));
            assert_the_volume_is_kept(&history, 0.6);
            let jumps = history.cycles.iter().map(|cycle| cycle.stands_for).max();
            println!("{} computed cycles, longest jump {jumps:?}", history.cycles.len());
            assert!(jumps > Some(3));
        }
    }
}

/// A ball that wears through a coating, on a quarter of its grid: the volume by layers that wear each by its own coefficient, and that of
/// the whole contact.
#[test]
fn debris_of_a_coating_that_is_worn_through_is_kept_with_symmetry() {
    let text = "[grid]\ncells = [32, 32]\nsize = [4.0, 4.0]\n[upper]\nrigid = true\n[lower]\n\
        coatings = [{ thickness = 5e-4, young = 2.0, poisson = 0.3, wear_coefficient = 0.02 }]\n\
        substrate = { young = 1.0, poisson = 0.3, wear_coefficient = 0.05 }\n[profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n\
        [wear]\nevery = 100\nlargest_step = 0.1\n[wear.debris]\nfraction = 0.5\noutflow_length = 2.0\n[wear.rim]\nwidth = 0.3\ninterior = 0.4\n\
        [output]\nfields = [\"worn_depth\", \"debris\", \"pressure\"]\n\
        [[load]]\nnormal_force = 1.2e-2\nincrements = 1\n[[load]]\nshift = [0.05, 0.0]\ncycles = 300\nincrements = 8\n";
    let run = |leave_out: LeaveOut| {
        let plan = Plan::leaving_out(Case::from_toml(text, "case.toml").unwrap(), leave_out).unwrap();
        let copies = plan.symmetry.copies();
        (copies, Simulation::new(&plan).run(&mut Silent).unwrap())
    };
    let (copies, part) = run(LeaveOut::ALL);
    let (alone, whole) = run(LeaveOut::all_but(Simplification::Mirror));
    assert!(copies == 2 && alone == 1);
    assert!(part.worn_by_layer.as_ref().unwrap().lower.iter().all(|volume| *volume > 0.0));
    for history in [&part, &whole] {
        assert_the_volume_is_kept(history, 0.5);
    }
    let [one, other] = [&part, &whole].map(|history| history.fields.last().unwrap().debris.clone().unwrap());
    let most = other.iter().copied().fold(0.0, f64::max);
    let off = (&one - &other).iter().fold(0.0_f64, |most, off| most.max(off.abs())) / most;
    println!("debris on a half and on the whole: {off:.1e} apart");
    // two solutions to 1e-8 of increments that follow each other
    assert!(off < 1e-5, "{off:e}");
}

/// Where bodies that touch have debris between them, `w_l + w_u = (a^2 - x^2)/(2 R) + b` but for what they give elastically,
/// `2 ln 2 P/(pi E*)` under an even pressure, and what the last cycles wore after the last pressure was found.
#[test]
fn debris_fills_the_gap_between_bodies_that_touch() {
    let elastic = 2.0 * 2.0_f64.ln() * line_force() / PI;
    for kinematics in ["", FINITE] {
        // What moves must not pile more on the lower body than that loses: high places would grow.
        let (fraction, limit) = if kinematics.is_empty() { (0.9, 8e-3) } else { (0.5, 2e-3) };
        let wear = format!("limit = {limit:e}\n[wear.debris]\nfraction = {fraction}\n");
        let history = solved(&cylinder(kinematics, [0.03, 0.015], 200_000, &wear));
        let fields = history.fields.last().unwrap();
        let (worn, debris) = (fields.worn_depth.as_ref().unwrap(), fields.debris.as_ref().unwrap());
        let open = worn - debris;
        let middle = open[[48, 0]];
        let touches = |i: &usize| fields.pressure.as_ref().unwrap()[[*i, 0]] > 0.0;
        let off = (0..96).filter(touches).map(|i| {
            let x = history.grid.centre(0, i);
            (open[[i, 0]] - (middle - x * x / (2.0 * RADIUS))).abs()
        });
        let off = off.fold(0.0, f64::max);
        let deepest = worn.iter().copied().fold(0.0, f64::max);
        println!("worn {deepest:.2e}, open {middle:.2e}, off by {off:.1e} (elastic {elastic:.1e})");
        // without debris the bodies would have lost what is open, and no more
        assert!(deepest > 1.5 * middle && off < elastic + 0.01 * deepest, "{off:e}");
    }
}

fn timeless(steps: &[StepRecord]) -> Vec<StepRecord> {
    steps.iter().map(|step| StepRecord { wall_s: 0.0, ..step.clone() }).collect()
}

/// A fraction of 0, and a rim inside of which the coefficient is the same.
#[test]
fn nothing_that_stays_changes_no_bit() {
    for kinematics in ["", FINITE] {
        let plain = solved(&cylinder(kinematics, [0.03, 0.015], 400, ""));
        let none = "[wear.debris]\nfraction = 0.0\noutflow_length = 3.0\n";
        let with = solved(&cylinder(kinematics, [0.03, 0.015], 400, none));
        assert_eq!(timeless(&plain.steps), timeless(&with.steps));
        let worn = |history: &History| {
            let last = history.fields.last().unwrap();
            (last.pressure.clone(), last.worn_depth.clone(), last.own_worn_depth.clone())
        };
        assert_eq!(worn(&plain), worn(&with));
        assert_eq!(with.steps.last().unwrap().debris.max_thickness, 0.0);
    }
}

/// A flat pad that ends with its grid, slid until it wears evenly.
fn pad(cycles: usize, rest: &str) -> History {
    // identical bodies: the pressure does not depend on the direction of sliding
    let film = "coatings = [{ thickness = 0.25, young = 1.0, poisson = 0.2 }]\nbase = \"rigid\"\n";
    solved(&format!(
        "[grid]\ncells = 40\nsize = 2.0\nbeyond = \"no body\"\n[upper]\n{film}[lower]\n{film}[profile.cylinder]\nradius = 1e6\naxis = \"y\"\n\
         [friction]\ncoefficient = 0.3\n[output]\nfields = [\"worn_depth\", \"pressure\", \"debris\"]\n\
         [wear]\nlaw = \"archard\"\ncoefficient = 0.01\nevery = 1000\nlargest_step = 0.5\n{rest}\
         [[load]]\nnormal_force = 2e-4\nincrements = 2\n[[load]]\nshift = [0.4, 0.0]\ncycles = {cycles}\nincrements = 8\n"
    ))
}

/// In the first cycle the pressure is that of the unworn pad: the wear depth is the fraction of that without a rim, cell by cell, which a rim of 0.33
/// leaves in 6.6 cells from each end.
#[test]
fn a_pad_wears_by_the_distance_from_its_rim() {
    let rim = "[wear.rim]\nwidth = 0.33\ninterior = 0.2\n";
    let depth = |history: &History| history.fields.last().unwrap().worn_depth.clone().unwrap();
    let (even, by_rim) = (depth(&pad(1, "")), depth(&pad(1, rim)));
    let part = |i: usize| match i.min(39 - i) {
        0..=5 => 1.0,
        6 => 0.6 + 0.4 * 0.2,
        _ => 0.2,
    };
    for i in 0..40 {
        let found = by_rim[[i, 0]] / even[[i, 0]];
        assert!((found - part(i)).abs() < 1e-12, "{i}: {found}"); // rounding
    }
    // Worn in, all of the pad wears alike, so pressure times coefficient is the same everywhere.
    let last = pad(4000, rim);
    let pressure = last.fields.last().unwrap().pressure.clone().unwrap();
    let rate: Vec<f64> = (0..40).map(|i| pressure[[i, 0]] * part(i)).collect();
    let [least, most] = [f64::min, f64::max].map(|of| rate.iter().copied().reduce(of).unwrap());
    println!("pad worn in: pressure times coefficient within {:.1e}", most / least - 1.0);
    // Ways of slip differ by what shear displaces: four times 0.3 x 3e-4 x 0.45 where the pressure is highest, of 1.6.
    assert!(most / least - 1.0 < 2e-4, "{least} {most}");
}

/// Worn in, as much debris comes as flows out: `b = fraction x outflow length x k p`.
#[test]
fn debris_becomes_as_thick_as_what_comes_lets_it() {
    let history = pad(1000, "[wear.debris]\nfraction = 0.5\noutflow_length = 3.0\n");
    let fields = history.fields.last().unwrap();
    let pressure = fields.pressure.as_ref().unwrap();
    let exact = pressure.mapv(|p| 0.5 * 3.0 * 0.01 * p);
    let debris: &Array2<f64> = fields.debris.as_ref().unwrap();
    let off = debris.iter().zip(&exact).map(|(b, exact)| (b / exact - 1.0).abs()).fold(0.0, f64::max);
    println!("debris off by {off:.1e} of what stays when it comes as it goes");
    // what is left of wearing in, and of the pressure that changes over a cycle
    assert!(off < 2e-3, "{off:e}");
    assert_the_volume_is_kept(&history, 0.5);
}

/// What another history starts from has its debris: pressed again, unworn bodies and debris are where they were.
#[test]
fn debris_lasts_into_a_history_that_starts_from_it() {
    let wear = "[wear.debris]\nfraction = 0.5\noutflow_length = 40.0\n";
    let worn = solved(&cylinder("", [0.003, 0.0015], 500, wear));
    let last = worn.steps.last().unwrap().increment;
    let start = std::sync::Arc::new(Start::of(&worn, last).unwrap());
    let text = cylinder("", [0.003, 0.0015], 1, wear);
    let (bodies, _) = text.split_once("[[load]]").unwrap();
    let bodies = bodies.replace(", wear_coefficient = 3e-3", "").replace("wear_coefficient = 1.5e-3\n", "");
    let later = bodies + &format!("[[load]]\nnormal_force = {:e}\nincrements = 1\n", 1.5 * line_force());
    let attachments = Attachments { start: Some(start.solved.loads), ..Attachments::none() };
    let case = Case::from_toml_with(&later, "case.toml", attachments).unwrap();
    let plan = Plan::starting_from(Some(start), case, LeaveOut::ALL).unwrap();
    let pressed = Simulation::new(&plan).run(&mut Silent).unwrap();
    let [thickness, outflow] = [&pressed, &worn].map(|history| history.state.debris.clone());
    assert!(thickness.is_some() && thickness == outflow);
    let end = pressed.steps.last().unwrap();
    assert_eq!(end.debris, worn.steps.last().unwrap().debris);
    // Nothing wears any more, and nothing is asked of what is kept of it.
    assert!(end.contact_cells >= worn.steps.last().unwrap().contact_cells);
}

/// Normal displacement of a half-plane of E* = 1, up to a constant, by an even pressure of 1 over `half` to both sides, `away` from its middle (Johnson,
/// Contact Mechanics, 1985, eq. 2.30a).
fn displacement_by_a_strip(away: f64, half: f64) -> f64 {
    let part = |to: f64| if to == 0.0 { 0.0 } else { to * (to / half).abs().ln() };
    -2.0 / PI * (part(away + half) - part(away - half))
}

/// Where bodies touch, profile, wear, debris, what that gives by and the elastic displacement are one sum in every cell: how many cells touch, how far
/// their sums are off that of the middle, and the least and the largest that debris of a stiffness gives by [length].
fn one_sum(history: &History, stiffness: f64) -> (usize, f64, [f64; 2]) {
    let fields = history.fields.last().unwrap();
    let [worn, debris, pressure] =
        [&fields.worn_depth, &fields.debris, &fields.pressure].map(|field| field.as_ref().unwrap());
    let spacing = history.grid.spacing()[0];
    let x = |i: usize| history.grid.centre(0, i);
    let gives = |i: usize| pressure[[i, 0]] * debris[[i, 0]] / stiffness;
    let elastic = |i: usize| {
        let by = |k: usize| pressure[[k, 0]] * displacement_by_a_strip(x(i) - x(k), 0.5 * spacing);
        (0..96).map(by).sum::<f64>()
    };
    let sum = |i: usize| x(i) * x(i) / (2.0 * RADIUS) + worn[[i, 0]] - debris[[i, 0]] + gives(i) + elastic(i);
    let touching: Vec<usize> = (0..96).filter(|i| pressure[[*i, 0]] > 0.0).collect();
    let middle = sum(48);
    let off = touching.iter().map(|i| (sum(*i) - middle).abs()).fold(0.0, f64::max);
    let ends = [f64::min, f64::max].map(|of| touching.iter().map(|i| gives(*i)).reduce(of).unwrap());
    (touching.len(), off, ends)
}

/// Debris that gives by p b/E: where bodies touch, profile, wear, debris, what that gives and the elastic displacement, which is in closed form here, are
/// the same sum in every cell. Under a stiffness beyond all others nothing is changed but roundings.
#[test]
fn debris_gives_by_its_thickness_and_the_pressure() {
    // Pressed further once more without friction, so that nothing wears after the last pressure is found.
    let further =
        format!("[[load]]\nnormal_force = {:e}\nfriction = 0.0\nincrements = 1\n", 1.2 * line_force());
    let case = |stiffness: &str| {
        let wear = format!("[wear.debris]\nfraction = 0.9\n{stiffness}{further}");
        cylinder("", [0.003, 0.0015], 400, &wear)
    };
    let stiffness = 2e-3;
    let history = solved(&case(&format!("stiffness = {stiffness:e}\n")));
    let (touching, off, [least, most]) = one_sum(&history, stiffness);
    println!("debris gives by {least:.2e} to {most:.2e} in {touching} cells; sums differ by {off:.1e}");
    // residuals of 1e-8 of an approach of some 1e-3
    assert!(touching > 10 && most - least > 1e-5 && off < 1e-9, "{off:e}");
    let [stiff, without] = ["stiffness = 1e30\n", ""].map(|text| solved(&case(text)));
    let [one, other] = [&stiff, &without].map(|history| history.steps.last().unwrap().clone());
    assert!((one.approach / other.approach - 1.0).abs() < 1e-9);
    assert!((one.worn_volume / other.worn_volume - 1.0).abs() < 1e-9);
    assert!(history.steps.last().unwrap().approach > 1.01 * other.approach);
}

/// A history that starts from a worn state presses on debris that is as stiff as its own case says, not as it was.
#[test]
fn debris_of_a_worn_start_gives_by_the_stiffness_of_the_case_that_starts() {
    let wear = |stiffness: f64| format!("[wear.debris]\nfraction = 0.9\nstiffness = {stiffness:e}\n");
    let worn = solved(&cylinder("", [0.003, 0.0015], 400, &wear(2e-3)));
    let start = std::sync::Arc::new(Start::of(&worn, worn.steps.last().unwrap().increment).unwrap());
    // Nothing wears any more, and without friction the displacement is that by pressure.
    let further = format!(
        "[[load]]\nnormal_force = {:e}\nincrements = 1\n[[load]]\nnormal_force = {:e}\nfriction = 0.0\nincrements = 1\n",
        line_force(),
        1.2 * line_force()
    );
    let pressed = |stiffness: f64| {
        let text = cylinder("", [0.0, 0.0], 1, &wear(stiffness));
        let (head, rest) = text.split_once("[[load]]").unwrap();
        let (_, wear) = rest.split_once("[wear]").unwrap();
        let text = format!("{head}[wear]{wear}{further}");
        let attachments = Attachments { start: Some(start.solved.loads), ..Attachments::none() };
        let case = Case::from_toml_with(&text, "case.toml", attachments).unwrap();
        let plan = Plan::starting_from(Some(start.clone()), case, LeaveOut::ALL).unwrap();
        Simulation::new(&plan).run(&mut Silent).unwrap()
    };
    let mut approach = 0.0;
    for stiffness in [1e-2, 2e-3, 5e-4] {
        let history = pressed(stiffness);
        assert_eq!(history.state.debris, worn.state.debris);
        let (touching, off, [least, most]) = one_sum(&history, stiffness);
        println!(
            "started on debris of {stiffness:e}: gives by {least:.2e} to {most:.2e}; sums differ by {off:.1e}"
        );
        // residuals of 1e-8 of an approach of some 1e-3
        assert!(touching > 10 && most - least > 2e-6 && off < 1e-9, "{off:e}");
        // the softer, the farther
        let last = history.steps.last().unwrap().approach;
        assert!(last > approach, "{last:e} {approach:e}");
        approach = last;
    }
}

/// A ball whose shear moves the surfaces normally, on debris that gives: what carries by itself is a diagonal in every operator, so that energy is
/// neither made nor lost; on a half of its grid and on the whole.
#[test]
fn coupled_contacts_know_debris_that_gives() {
    let text = "[grid]\ncells = [32, 32]\nsize = [4.0, 4.0]\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 1.0, poisson = 0.2 }\n\
        [profile.sphere]\nradius = 100.0\n[friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-9\n[wear]\ncoefficient = 0.05\nevery = 10\nlargest_step = 0.1\n\
        [wear.debris]\nfraction = 0.8\nstiffness = 0.005\n[output]\nfields = [\"pressure\", \"debris\"]\n\
        [[load]]\nnormal_force = 1.2e-2\nincrements = 2\n[[load]]\nshift = [0.05, 0.0]\ncycles = 20\nincrements = 8\n\
        [[load]]\nnormal_force = 1.5e-2\nshift = [0.02, 0.0]\nincrements = 4\n";
    let run = |text: &str, leave_out: LeaveOut| {
        let plan = Plan::leaving_out(Case::from_toml(text, "case.toml").unwrap(), leave_out).unwrap();
        (plan.symmetry.copies(), Simulation::new(&plan).run(&mut Silent).unwrap())
    };
    let (copies, part) = run(text, LeaveOut::ALL);
    let (alone, whole) = run(text, LeaveOut::all_but(Simplification::Mirror));
    assert!(copies == 2 && alone == 1);
    for history in [&part, &whole] {
        let off = off_first_law(history, 0.0);
        assert!(off < 1e-9, "{off:e}");
    }
    let (_, rigid) = run(&text.replace("\nstiffness = 0.005", ""), LeaveOut::ALL);
    let [one, other, stiff] = [&part, &whole, &rigid].map(|history| history.steps.last().unwrap().approach);
    println!(
        "approach {one:.8e} on a half, {other:.8e} on the whole; {stiff:.8e} on debris that does not give"
    );
    assert!((one / other - 1.0).abs() < 1e-7 && one > 1.005 * stiff);
}
