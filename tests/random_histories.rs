//! Histories of loads drawn at random, each as a case for any number of increments: point and line contacts, bare and coated, similar and dissimilar
//! bodies; loops, rotating forces, torsion, changing normal force in and out of phase, rays, tilt, bulk stress, pauses, coarse pressing.

use std::f64::consts::PI;
use std::fmt::Write;

use fret_core::history::History;
use serde::{Deserialize, Serialize};

use crate::random::Random;

/// Radius of the sphere or cylinder in contact radii.
const RADIUS: f64 = 100.0;

/// What the loads do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A tangential force to and fro under a constant normal force.
    Loop,
    /// A tangential force whose direction turns; of a line contact, two loops of unlike amplitude.
    Turning,
    /// Normal and tangential force swing together.
    InPhase,
    /// Normal and tangential force swing at a phase.
    OutOfPhase,
    /// Both forces grow together from nothing.
    Ray,
    /// A twisting moment with a force; of a line contact, a tangential force beside a constant one.
    Torsion,
    /// The bulk stress of the lower body swings with the tangential force.
    Bulk,
    /// A slope of the upper body swings with the tangential force.
    Tilt,
    /// Stages along the surface with pauses between them.
    Pauses,
    /// Displacements instead of forces, up to sliding and back.
    Sliding,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Loop,
        Self::Turning,
        Self::InPhase,
        Self::OutOfPhase,
        Self::Ray,
        Self::Torsion,
        Self::Bulk,
        Self::Tilt,
        Self::Pauses,
        Self::Sliding,
    ];
}

/// A history that was drawn.
#[derive(Debug, Clone)]
pub struct RandomHistory {
    /// The number that it was drawn by.
    pub seed: u64,
    /// What its loads do.
    pub kind: Kind,
    /// Whether it is a line contact.
    pub is_line: bool,
    /// Increments of pressing over those of a cycle.
    pub pressing: f64,
    head: String,
    force: f64,
    friction: f64,
    /// Loads of the stages after pressing, each followed by its number of increments over that of a cycle.
    stages: Vec<(String, f64)>,
    ramp: &'static str,
}

impl RandomHistory {
    /// The history of a seed.
    pub fn drawn(seed: u64) -> Self {
        let random = &mut Random::seeded(seed);
        let kind = Kind::ALL[seed as usize % Kind::ALL.len()];
        let is_line = random.chance(0.5);
        let poisson = if random.chance(0.15) { 0.0 } else { random.between(0.0, 0.45) };
        let friction = random.log_uniform(0.1, 0.6);
        let coating =
            random.chance(0.5).then(|| (random.log_uniform(0.3, 4.0), random.log_uniform(0.2, 2.0)));
        let upper = random.uniform();
        let mut head = String::new();
        let elastic = 1.0 / (1.0 - poisson * poisson);
        let (upper, modulus) = if upper < 0.4 {
            ("[upper]\nrigid = true\n".to_owned(), elastic)
        } else if upper < 0.7 {
            (format!("[upper]\nsubstrate = {{ young = 1.0, poisson = {poisson} }}\n"), 0.5 * elastic)
        } else {
            let young = random.log_uniform(0.5, 4.0);
            let other = random.between(0.2, 0.4);
            let modulus = 1.0 / (1.0 / elastic + (1.0 - other * other) / young);
            (format!("[upper]\nsubstrate = {{ young = {young}, poisson = {other} }}\n"), modulus)
        };
        let softer = coating.map_or(1.0, |(ratio, _)| f64::max(1.0, 1.0 / ratio));
        let size = if is_line { 2.9 * softer.sqrt() } else { 2.7 * softer.cbrt() };
        let force = if is_line { PI * modulus / (4.0 * RADIUS) } else { 4.0 * modulus / (3.0 * RADIUS) };
        let (cells, size, profile) = if is_line {
            ("96".to_owned(), format!("{size}"), "cylinder")
        } else {
            ("[32, 32]".to_owned(), format!("[{size}, {size}]"), "sphere")
        };
        let axis = if is_line { "axis = \"y\"\n" } else { "" };
        let layer = coating.map_or(String::new(), |(ratio, thickness)| {
            format!("coatings = [{{ thickness = {thickness}, young = {ratio}, poisson = {poisson} }}]\n")
        });
        let _ = write!(
            head,
            "[grid]\ncells = {cells}\nsize = {size}\n{upper}[lower]\nsubstrate = {{ young = 1.0, poisson = {poisson} }}\n{layer}\
             [profile.{profile}]\nradius = {RADIUS}\n{axis}[friction]\ncoefficient = {friction}\n[solver]\ntolerance = 1e-9\n\
             [output]\nfields = []\n"
        );
        let mut history = Self {
            seed,
            kind,
            is_line,
            pressing: if random.chance(0.5) { 4.0 } else { 1.0 },
            head,
            force,
            friction,
            stages: Vec::new(),
            ramp: if random.chance(0.7) { "cubic" } else { "linear" },
        };
        history.draw_stages(random);
        history
    }

    /// The case with so many increments in a cycle.
    pub fn text(&self, increments: usize) -> String {
        let count = |times: f64| (times * increments as f64).round() as usize;
        self.with_increments(&self.head, &|times| count(times).max(1).to_string())
    }

    /// The case with increments that the program chooses, to a tolerance.
    pub fn with_chosen_increments(&self, history_tolerance: f64) -> String {
        let solver = format!("[solver]\nhistory_tolerance = {history_tolerance}\n");
        self.with_increments(&self.head.replace("[solver]\n", &solver), &|_| "\"auto\"".to_owned())
    }

    /// The case with the increments of each stage by their number over that of a cycle.
    fn with_increments(&self, head: &str, increments: &dyn Fn(f64) -> String) -> String {
        let mut text = head.to_owned();
        if self.kind != Kind::Ray {
            let pressing = increments(self.pressing);
            let _ = write!(
                text,
                "[[load]]\nnormal_force = {:e}\nincrements = {pressing}\nramp = \"{}\"\n",
                self.force, self.ramp
            );
        }
        for (controls, times) in &self.stages {
            let _ = write!(text, "[[load]]\n{controls}increments = {}\n", increments(*times));
        }
        text
    }

    fn draw_stages(&mut self, random: &mut Random) {
        let full = self.friction * self.force;
        let (force, is_line) = (self.force, self.is_line);
        let wave = if random.chance(0.5) { "sine" } else { "triangle" };
        let part = random.between(0.3, 0.9);
        let pull = part * full;
        let angle = if is_line { 0.0 } else { random.between(0.0, 0.5 * PI) };
        let [x, y] = [pull * angle.cos(), pull * angle.sin()];
        let swing = random.between(0.1, 0.4);
        let (phase, other) = (30.0 * random.whole(1, 5) as f64, random.between(0.2, 0.8));
        let cycle = |controls: String, cycles: usize| {
            (format!("{controls}cycles = {cycles}\nwaveform = \"{wave}\"\n"), 1.0)
        };
        let to = |x: f64, y: f64| format!("tangential_force = [{x:e}, {y:e}]\n");
        // What a force may be where the normal force is least.
        let least = 1.0 - swing;
        self.stages = match self.kind {
            Kind::Loop => vec![cycle(to(x, y), 2)],
            Kind::Turning if is_line => vec![cycle(to(x, 0.0), 1), cycle(to(other * x, 0.0), 1)],
            Kind::Turning => vec![cycle(
                format!("{}phase = {{ tangential_force = [0, 90] }}\n", to(0.7 * pull, 0.7 * other * pull)),
                2,
            )],
            Kind::InPhase => {
                vec![cycle(format!("{}normal_force = {:e}\n", to(least * x, least * y), swing * force), 2)]
            }
            Kind::OutOfPhase => vec![cycle(
                format!(
                    "{}normal_force = {:e}\nphase = {{ normal_force = {phase} }}\n",
                    to(0.7 * least * x, 0.7 * least * y),
                    swing * force
                ),
                2,
            )],
            Kind::Ray => {
                let ramp = self.ramp;
                let ray = format!("normal_force = {force:e}\n{}ramp = \"{ramp}\"\n", to(x, y));
                vec![(ray, 1.0), (to(-0.5 * x, -0.5 * y), 0.5)]
            }
            Kind::Torsion if is_line => vec![(to(0.4 * x, 0.0), 0.25), cycle(to(0.5 * x, 0.0), 2)],
            // The moment of a Hertz contact that slides about z is 3 pi/16 mu P a.
            Kind::Torsion => vec![cycle(
                format!(
                    "{}twist_moment = {:e}\nphase = {{ twist_moment = {phase} }}\n",
                    to(0.5 * x, 0.5 * y),
                    0.25 * other * full
                ),
                2,
            )],
            Kind::Bulk => {
                // Up to a third of what makes the edge slip all over.
                let stress = 0.3 * other * full / if is_line { 1.0 } else { PI };
                let bulk = if is_line { format!("{stress:e}") } else { format!("[{stress:e}, 0.0]") };
                vec![cycle(format!("{}bulk_stress = {bulk}\n", to(0.7 * x, 0.7 * y)), 2)]
            }
            Kind::Tilt => {
                let slope = 0.3 * other / RADIUS;
                let tilt = if is_line { format!("{slope:e}") } else { format!("[{slope:e}, 0.0]") };
                vec![cycle(
                    format!(
                        "{}tilt = {tilt}\nphase = {{ tilt = {} }}\n",
                        to(0.8 * x, 0.8 * y),
                        if is_line { format!("{phase}") } else { format!("[{phase}, 0]") }
                    ),
                    2,
                )]
            }
            Kind::Pauses => {
                let mut stages = Vec::new();
                for times in [0.5, 1.0, other, -0.3] {
                    stages.push((to(times * x, times * y), 0.25));
                    stages.push((to(times * x, times * y), 0.1));
                }
                stages
            }
            Kind::Sliding => {
                // Cattaneo and Mindlin's displacement at which elastically similar spheres slide is about 1.5 mu times the approach.
                let reach = self.friction * random.between(0.5, 2.0) / RADIUS;
                let shift = |x: f64| format!("shift = [{x:e}, 0.0]\n");
                vec![(shift(reach), 0.5), (shift(-other * reach), 0.75), (shift(reach), 0.75)]
            }
        };
    }
}

/// What a history ends with.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct End {
    /// Dissipated energy [force x length].
    pub energy: f64,
    /// Shift [length].
    pub shift: [f64; 2],
    /// Largest shift on the way [length].
    pub reach: f64,
    /// Shear of all cells, x then y [pressure]; may be empty where it is kept.
    pub shear: Vec<f64>,
}

impl End {
    /// That of a history.
    ///
    /// # Panics
    /// When it has no increment.
    pub fn of(history: &History) -> Self {
        let Some(last) = history.steps.last() else { panic!("a history of no increment") };
        let reach = history.steps.iter().map(|step| step.shift[0].hypot(step.shift[1])).fold(0.0, f64::max);
        let shear = history.state.shear.iter().flat_map(|part| part.iter().copied()).collect();
        Self { energy: last.dissipated_energy, shift: last.shift, reach, shear }
    }

    /// How far it is from the right one: energy, relative; shift over the largest of the way; shear, root of the mean square over the cells in
    /// contact, over the largest shear.
    pub fn off(&self, right: &Self) -> [f64; 3] {
        let shift = (self.shift[0] - right.shift[0]).hypot(self.shift[1] - right.shift[1]);
        let most = right.shear.iter().fold(0.0_f64, |most, q| most.max(q.abs()));
        let squares: f64 = self.shear.iter().zip(&right.shear).map(|(a, b)| (a - b) * (a - b)).sum();
        let touched = right.shear.iter().filter(|q| **q != 0.0).count().max(1);
        let shear = if most > 0.0 { (squares / touched as f64).sqrt() / most } else { 0.0 };
        [self.energy / right.energy - 1.0, shift / right.reach, shear]
    }
}
