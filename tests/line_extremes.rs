//! Line contacts with stiffness, thickness, friction and loads far beyond use, stretched and tilted: every increment holds every law, or
//! the run says why not.

use std::fmt::Write as _;

use fret_core::case::Case;
use fret_core::history::History;
use fret_core::plan::Plan;
use fret_core::run::{RunError, Silent, Simulation};
use fret_validation::certifier::run_certified;
use fret_validation::keeping;
use fret_validation::random::Random;

/// Cases. All are solved, or refused for a reason that is true.
const CASES: u64 = 500;

#[test]
fn extreme_line_contacts_are_certified_or_refused() {
    let (mut certified, mut refused, mut at_edge) = (0, 0, 0);
    for seed in 0..CASES {
        let text = case(&mut Random::seeded(seed));
        let Ok(ended) = run_certified(&text, &[]) else {
            refused += 1;
            continue;
        };
        if let Some(wrong) = ended.wrong() {
            panic!("seed {seed}: {wrong}\n{text}");
        }
        match &ended.error {
            None => certified += 1,
            Some(error @ RunError::ContactAtEdge { .. }) => {
                println!("seed {seed}: {error}");
                assert!(
                    passes_the_edge(&text),
                    "seed {seed}: {error}, but on a wider grid it does not\n{text}"
                );
                at_edge += 1;
            }
            Some(error) => panic!("seed {seed}: {error}\n{text}"),
        }
    }
    println!(
        "{certified} certified, {refused} refused before the run, {at_edge} refused: contact at the edge of the grid"
    );
    assert!(certified > 400, "{certified} {refused} {at_edge}");
}

/// Whether the contact of a case comes within a cell of its edge, or passes it, on a grid three times as wide of the same cells.
fn passes_the_edge(text: &str) -> bool {
    let number = |key: &str| -> f64 {
        let line = text.lines().find_map(|line| line.strip_prefix(key)).unwrap();
        line.parse().unwrap()
    };
    let [cells, size] = ["cells = ", "size = "].map(number);
    let wide = text
        .replacen(&format!("cells = {cells}\n"), &format!("cells = {}\n", 3.0 * cells), 1)
        .replacen(&format!("size = {size:e}\n"), &format!("size = {:e}\n", 3.0 * size), 1);
    assert!(
        wide.contains(&format!("cells = {}\n", 3.0 * cells)) && !wide.contains(&format!("size = {size:e}\n"))
    );
    match ended(&(wide + &keeping(1))) {
        Some(Err(RunError::ContactAtEdge { .. })) => true,
        None | Some(Err(_)) => false,
        Some(Ok(history)) => history.fields.iter().any(|fields| {
            let pressure = fields.pressure.as_ref().unwrap();
            let edge = cells as usize + 1..2 * cells as usize - 1;
            pressure.indexed_iter().any(|((i, _), &pressure)| pressure > 0.0 && !edge.contains(&i))
        }),
    }
}

/// A tilt far beyond what keeps the contact in the middle has a moment; prescribed, that moment has to find the tilt again.
#[test]
fn the_tilt_of_any_moment_that_one_has_is_found() {
    let (mut found, mut at_edge) = (0, 0);
    for seed in 0..300 {
        let random = &mut Random::seeded(90_000 + seed);
        let Scene { length, radius, force, head, .. } = scene(random);
        let tilt = length / radius * random.between(-2.5, 2.5);
        let increments = random.whole(1, 2);
        let text = |control: &str| {
            format!("{head}[[load]]\nnormal_force = {force:e}\n{control}\nincrements = {increments}\n")
        };
        let Some(Ok(there)) = ended(&text(&format!("tilt = {tilt:e}"))) else {
            at_edge += 1;
            continue;
        };
        let step = there.steps.last().unwrap();
        let moment = step.tilt_moment[0];
        let by_moment = text(&format!("tilt_moment = {moment:e}"));
        let again = ended(&by_moment).unwrap();
        let again = again.unwrap_or_else(|error| panic!("seed {seed}, tilt {tilt:e}: {error}\n{by_moment}"));
        let step = again.steps.last().unwrap();
        // to the tolerance of 1e-8 times the radius of gyration, which is less than the grid
        assert!((step.tilt_moment[0] - moment).abs() <= 1e-8 * force * 20.0 * length, "seed {seed}");
        found += 1;
    }
    println!("{found} tilts found by their moments, {at_edge} without a contact on the grid");
    assert!(found > 150, "{found} {at_edge}");
}

/// A run; `None` of a case that is refused.
fn ended(text: &str) -> Option<Result<History, RunError>> {
    let plan = Plan::new(Case::from_toml(text, "case.toml").ok()?).ok()?;
    Some(Simulation::new(&plan).run(&mut Silent))
}

/// The bodies and grid of a case.
struct Scene {
    length: f64,
    radius: f64,
    friction: f64,
    force: f64,
    /// Whether the upper body is.
    rigid: bool,
    /// Grid, bodies, profile.
    head: String,
}

fn scene(random: &mut Random) -> Scene {
    let length = random.log_uniform(1e-9, 1e3);
    let modulus = random.log_uniform(1e-3, 1e12);
    let cells = random.whole(16, 72);
    let radius = 20.0 * length;
    let body = |random: &mut Random| {
        let poisson = if random.chance(0.1) { 0.5 } else { random.between(-0.3, 0.49) };
        let mut text = String::new();
        if random.chance(0.5) {
            let layers: Vec<String> = (0..random.whole(1, 2))
                .map(|_| {
                    let thickness = length * random.log_uniform(1e-3, 1e2);
                    let young = modulus * random.log_uniform(1e-3, 1e3);
                    format!(
                        "{{ thickness = {thickness:e}, young = {young:e}, poisson = {:e} }}",
                        random.between(0.0, 0.45)
                    )
                })
                .collect();
            let _ = writeln!(text, "coatings = [{}]", layers.join(", "));
        }
        text + &format!("substrate = {{ young = {modulus:e}, poisson = {poisson:e} }}\n")
    };
    let rigid = random.chance(0.3);
    let upper = if rigid { "rigid = true\n".to_owned() } else { body(random) };
    let lower = body(random);
    let friction = random.log_uniform(1e-3, 1.5);
    // About the force of a half-width of `length` without coatings.
    let force = 0.4 * modulus * length * length / radius * random.between(0.2, 1.0);
    let head = format!(
        "[grid]\ncells = {cells}\nsize = {:e}\n[upper]\n{upper}[lower]\n{lower}[profile.cylinder]\nradius = {radius:e}\naxis = \"y\"\n",
        length * random.between(6.0, 20.0)
    );
    Scene { length, radius, friction, force, rigid, head }
}

fn case(random: &mut Random) -> String {
    let Scene { length, radius, friction, force, rigid, head } = scene(random);
    let stress = friction * force / length;
    let mut text = format!(
        "{head}[friction]\ncoefficient = {friction:e}\n[solver]\nintegration = \"end_point\"\n[[load]]\nnormal_force = {force:e}\n\
         increments = 2\n"
    );
    for _ in 0..random.whole(1, 2) {
        let mut stage = "[[load]]\nincrements = 3\n".to_owned();
        let _ = writeln!(stage, "bulk_stress = {:e}", stress * random.between(-3.0, 3.0));
        if !rigid && random.chance(0.3) {
            let _ = writeln!(stage, "upper_bulk_stress = {:e}", stress * random.between(-3.0, 3.0));
        }
        if random.chance(0.6) {
            let pull = friction * force * random.between(-0.9, 0.9);
            let _ = writeln!(stage, "tangential_force = [{pull:e}, {:e}]", 0.3 * pull * random.uniform());
        }
        if random.chance(0.3) {
            let _ = writeln!(stage, "tilt = {:e}", length / radius * random.between(-0.5, 0.5));
        } else if random.chance(0.2) {
            let _ = writeln!(stage, "tilt_moment = {:e}", force * length * random.between(-0.5, 0.5));
        }
        text += &stage;
    }
    text
}
