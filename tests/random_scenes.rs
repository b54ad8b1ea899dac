//! Scenes drawn at random, far beyond what anybody would compute: every increment that comes back holds its equations, and
//! what cannot be solved is refused with words. `FRET_SCENES=2000 cargo test --release -p fret-validation random -- --nocapture`
//! runs as many as one likes.

use std::fmt::Write;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use fret_core::case::Case;
use fret_core::history::{History, KeptFields, StepRecord};
use fret_core::model::ContactState;
use fret_core::plan::Plan;
use fret_core::simulation::{Iteration, Observer, RunError, Simulation};

/// `SplitMix64`: the same scenes on every machine.
struct Dice(u64);

impl Dice {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Ten to a power between two.
    fn decade(&mut self, low: f64, high: f64) -> f64 {
        10.0_f64.powf(self.between(low, high))
    }

    fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.unit() * (high - low + 1) as f64) as usize
    }
}

/// A scene in words, up to its load.
struct Scene {
    head: String,
    friction: f64,
    /// Approach that keeps the overlap of the undeformed bodies inside the grid.
    approach: f64,
    /// Radius of that overlap.
    radius: f64,
    /// The normal load is an approach throughout.
    by_approach: bool,
}

fn poisson(dice: &mut Dice) -> f64 {
    if dice.chance(0.05) { 0.5 } else { dice.between(-0.9, 0.5) }
}

fn body(dice: &mut Dice, young: f64, contact: f64) -> String {
    let coatings = if dice.chance(0.25) { 0 } else { dice.whole(1, 2) };
    let list: Vec<String> = (0..coatings)
        .map(|_| {
            let (contrast, thickness) = (dice.decade(-6.0, 6.0), contact * dice.decade(-3.0, 3.0));
            format!(
                "{{ thickness = {thickness:e}, young = {:e}, poisson = {} }}",
                young * contrast,
                poisson(dice)
            )
        })
        .collect();
    let coated = if list.is_empty() { String::new() } else { format!("coatings = [{}]\n", list.join(", ")) };
    if !list.is_empty() && dice.chance(0.1) {
        format!("{coated}base = \"rigid\"\n")
    } else {
        format!("{coated}substrate = {{ young = {young:e}, poisson = {} }}\n", poisson(dice))
    }
}

fn scene(dice: &mut Dice) -> Scene {
    let (length, young) = (dice.decade(-12.0, 12.0), dice.decade(-12.0, 12.0));
    let cells = [dice.whole(8, 20), dice.whole(8, 20)];
    let stretch = dice.decade(0.0, 8.0_f64.log10());
    let mut spacing = [length, length * stretch];
    if dice.chance(0.5) {
        spacing.reverse();
    }
    let size = [cells[0] as f64 * spacing[0], cells[1] as f64 * spacing[1]];
    // Half axes of the overlap: a share of each side.
    let half = [0.36 * size[0], 0.36 * size[1]];
    let approach = length * dice.decade(-6.0, -1.0);
    let radii = half.map(|half| half * half / (2.0 * approach));
    let radius = half[0].min(half[1]);
    let friction = if dice.chance(0.1) { 0.0 } else { dice.decade(-3.0, 2.0_f64.log10()) };
    let upper = if dice.chance(0.4) { "rigid = true\n".to_owned() } else { body(dice, young, radius) };
    let ratio = dice.decade(-2.0, 2.0);
    let lower = body(dice, young * ratio, radius);
    let tolerance = if dice.chance(0.5) { 1e-8 } else { 1e-6 };
    let head = format!(
        "[grid]\ncells = [{}, {}]\nsize = [{:e}, {:e}]\n[upper]\n{upper}[lower]\n{lower}[profile.ellipsoid]\nradius_x = {:e}\nradius_y = {:e}\n\
         [friction]\ncoefficient = {friction}\n[solver]\ntolerance = {tolerance:e}\n[output]\nfields = [\"pressure\", \"shear\"]\nevery = 1\n",
        cells[0], cells[1], size[0], size[1], radii[0], radii[1],
    );
    Scene { head, friction, approach, radius, by_approach: dice.chance(0.3) }
}

fn stage(text: &mut String, controls: &str, increments: usize) {
    let _ = write!(text, "[[load]]\n{controls}increments = {increments}\n");
}

/// The loads of a scene whose approach needs `force`.
fn loads(dice: &mut Dice, scene: &Scene, force: f64) -> String {
    let mut text = String::new();
    let normal = |share: f64| {
        if scene.by_approach {
            format!("approach = {:e}\n", scene.approach * share)
        } else {
            format!("normal_force = {:e}\n", force * share)
        }
    };
    let mut pressed = dice.between(0.3, 1.0);
    let first = dice.whole(1, 4);
    stage(&mut text, &normal(pressed), first);
    if scene.friction == 0.0 {
        let next = dice.between(0.0, 1.0);
        let increments = dice.whole(1, 3);
        stage(&mut text, &normal(next), increments);
        return text;
    }
    let most = scene.friction * force;
    for _ in 0..dice.whole(1, 3) {
        let kind = dice.unit();
        if kind < 0.45 && !scene.by_approach {
            let share = if dice.chance(0.3) { 0.9999 } else { dice.between(0.05, 0.99) };
            let turn = dice.between(0.0, std::f64::consts::TAU);
            let pull = share * most * pressed;
            let controls = format!("tangential_force = [{:e}, {:e}]\n", pull * turn.cos(), pull * turn.sin());
            stage(&mut text, &controls, dice.whole(1, 4));
        } else if kind < 0.75 {
            let turn = dice.between(0.0, std::f64::consts::TAU);
            let shift = scene.friction * scene.approach * dice.decade(-1.0, 0.7);
            let controls = format!("shift = [{:e}, {:e}]\n", shift * turn.cos(), shift * turn.sin());
            stage(&mut text, &controls, dice.whole(1, 4));
            break;
        } else if kind < 0.87 {
            let twist = scene.friction * scene.approach / scene.radius * dice.decade(-1.0, 0.5);
            stage(&mut text, &format!("twist = {twist:e}\n"), dice.whole(1, 3));
        } else if !scene.by_approach {
            // The pull so far must stay below what the smaller force carries.
            stage(&mut text, "tangential_force = [0.0, 0.0]\n", 1);
            pressed *= dice.between(0.2, 1.0);
            stage(&mut text, &normal(pressed), dice.whole(1, 3));
        }
    }
    if dice.chance(0.15) {
        stage(&mut text, "shift = [0.0, 0.0]\n", 1);
        stage(&mut text, &normal(0.0), dice.whole(1, 3));
        stage(&mut text, &normal(0.5), 1);
    }
    text
}

/// Looks at everything that comes back.
struct Inspector {
    tolerance: f64,
    friction: f64,
    iterations: usize,
    worst: f64,
    wrong: Option<String>,
}

impl Observer for Inspector {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        self.iterations += 1;
        ControlFlow::Continue(())
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: &ContactState,
        _: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        let residual = record.residual.largest();
        self.worst = self.worst.max(residual / self.tolerance);
        let numbers = [
            record.normal_force,
            record.approach,
            record.tangential_force[0],
            record.shift[0],
            record.max_pressure,
            record.max_shear,
            record.contact_area,
            record.dissipated_energy,
            residual,
        ];
        let mut say = |what: String| {
            self.wrong.get_or_insert(format!("increment {}: {what}", record.increment));
        };
        if numbers.iter().any(|number| !number.is_finite()) {
            say(format!("not finite: {numbers:?}"));
        }
        if residual > self.tolerance {
            say(format!("residual {residual:e}"));
        }
        let peak = record.max_pressure;
        for ((&p, &qx), &qy) in state.pressure.iter().zip(&state.shear[0]).zip(&state.shear[1]) {
            if p < 0.0 {
                say(format!("tension {p:e}"));
            }
            // A shear on its circle is there to rounding of its length.
            if qx.hypot(qy) > self.friction * p + 1e-12 * self.friction * peak {
                say(format!("shear {:e} over mu p = {:e}", qx.hypot(qy), self.friction * p));
            }
        }
        ControlFlow::Continue(())
    }
}

/// How a scene ended.
enum End {
    Solved(Box<(History, Inspector)>),
    /// A physical bound or a numerical one, in words.
    Refused(String),
    Wrong(String),
}

fn run(text: &str, friction: f64) -> End {
    let case = match Case::from_toml(text, "random") {
        Ok(case) => case,
        Err(error) => return End::Refused(format!("case: {error}")),
    };
    let tolerance = case.tolerance;
    let plan = match Plan::new(case) {
        Ok(plan) => plan,
        Err(error) => return End::Refused(format!("plan: {error}")),
    };
    let mut inspector = Inspector { tolerance, friction, iterations: 0, worst: 0.0, wrong: None };
    let ended = catch_unwind(AssertUnwindSafe(|| Simulation::new(&plan).run(&mut inspector)));
    match ended {
        Err(_) => End::Wrong("panic".to_owned()),
        Ok(_) if inspector.wrong.is_some() => End::Wrong(inspector.wrong.unwrap_or_default()),
        Ok(Ok(history)) => End::Solved(Box::new((history, inspector))),
        Ok(Err(error @ (RunError::ContactAtEdge { .. } | RunError::AboveSliding { .. }))) => {
            End::Refused(format!("physics: {error}"))
        }
        Ok(Err(error)) => End::Refused(format!("numerics: {error}")),
    }
}

#[test]
fn random_scenes_are_certified_or_refused_with_words() {
    let count: u64 = std::env::var("FRET_SCENES").ok().and_then(|text| text.parse().ok()).unwrap_or(200);
    let mut solved = 0;
    let (mut increments, mut iterations, mut most) = (0, 0, 0);
    let mut refused = Vec::new();
    let mut wrong = Vec::new();
    for seed in 0..count {
        let mut dice = Dice(seed);
        let scene = scene(&mut dice);
        let pressing = format!("{}[[load]]\napproach = {:e}\nincrements = 1\n", scene.head, scene.approach);
        let (text, end) = match run(&pressing, scene.friction) {
            End::Solved(ended) => {
                let (history, _) = *ended;
                let force = history.steps.last().map_or(0.0, |step| step.normal_force);
                let text = scene.head.clone() + &loads(&mut dice, &scene, force);
                let end = run(&text, scene.friction);
                (text, end)
            }
            other => (pressing, other),
        };
        match end {
            End::Solved(ended) => {
                let (history, inspector) = *ended;
                solved += 1;
                increments += history.steps.len();
                iterations += inspector.iterations;
                most = most.max(inspector.iterations / history.steps.len().max(1));
            }
            End::Refused(why) => refused.push((seed, why, text)),
            End::Wrong(why) => wrong.push((seed, why, text)),
        }
    }
    println!(
        "{count} random scenes: {solved} solved ({increments} increments, {iterations} iterations, at most {most} an increment), {} refused, {} wrong",
        refused.len(),
        wrong.len()
    );
    for (seed, why, text) in refused.iter().chain(&wrong).take(40) {
        println!("scene {seed}: {why}");
        if std::env::var_os("FRET_SCENES_TEXT").is_some() {
            println!("{text}");
        }
    }
    assert!(wrong.is_empty(), "{} scenes with a wrong answer", wrong.len());
    assert!(refused.iter().all(|(_, why, _)| why.len() > 20), "a refusal without words");
    assert!(f64::from(solved) >= 0.99 * count as f64, "{solved} of {count} solved");
}
