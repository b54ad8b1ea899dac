//! Cases drawn at random, far beyond what anybody would compute: contrasts of 1e-6 to 1e6, coatings of 1e-3 to 1e3 contact
//! sizes on one body or both, Poisson's ratios of -0.9 to 0.5, friction up to 2, cells up to 8:1, lengths and moduli over 24
//! decades, reversal and lift-off; some of them turn, wear, repeat, or rub differently from place to place.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};

use fret_core::case::{Attachments, Case, CaseError};
use fret_core::plan::Plan;
use fret_core::simulation::{RunError, Silent, Simulation};
use ndarray::Array2;

use crate::certifier::{Certificate, Ended, run_certified};
use crate::random::Random;

/// What a case has besides pressing and pulling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Nothing; with friction or without.
    Plain,
    /// It turns about z, by a moment or a rotation.
    Torsion,
    /// Coefficients of friction differ from place to place.
    Map,
    /// It wears.
    Wear,
    /// It is periodic.
    Periodic,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Plain, Self::Torsion, Self::Map, Self::Wear, Self::Periodic];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "pressed and pulled",
            Self::Torsion => "torsion",
            Self::Map => "friction map",
            Self::Wear => "wear",
            Self::Periodic => "periodic",
        }
    }
}

/// How a case ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// Every increment was solved and certified.
    Certified,
    /// There is no answer, for this reason; every increment before was certified.
    Refused(Refusal),
    /// An increment was not solved, although it may have an answer.
    Unsolved(String),
    /// A solved increment breaks a law, or a reason that was given is not true.
    Wrong(String),
}

/// Why there is no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refusal {
    /// A nearly incompressible film thinner than a fifth of a cell, on a stiff base.
    UnseenFilm,
    /// The contact reaches the edge of the grid.
    ContactAtEdge,
    /// More tangential force than friction carries.
    AboveSliding,
    /// More wear in a cycle than the grid can follow.
    WearTooFast,
}

impl Refusal {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::UnseenFilm => "an incompressible film thinner than the cells can see",
            Self::ContactAtEdge => "contact at the edge of the grid",
            Self::AboveSliding => "more tangential force than friction carries",
            Self::WearTooFast => "more wear in a cycle than the grid can follow",
        }
    }
}

/// A case that was run.
#[derive(Debug)]
pub struct Extreme {
    /// Its seed.
    pub seed: u64,
    /// What it has.
    pub family: Family,
    /// Its text.
    pub text: String,
    /// Certified increments.
    pub increments: usize,
    /// Certified increments that were solved in parts: all but the law of slip.
    pub in_parts: usize,
    /// Every law by name, and the largest fraction of its bound that an increment took.
    pub laws: Vec<(&'static str, f64)>,
    /// How it ended.
    pub outcome: Outcome,
}

/// Draws the case of a seed, with `cells` per side between two numbers; runs and certifies it.
pub fn run(seed: u64, cells: [usize; 2]) -> Extreme {
    let mut random = Random::seeded(seed);
    let body = Body::drawn(&mut random, cells);
    let ended = catch_unwind(AssertUnwindSafe(|| body.run(seed, random)));
    ended.unwrap_or_else(|_| Extreme {
        seed,
        family: body.family,
        text: body.head(false, "coefficient = 0.0"),
        increments: 0,
        in_parts: 0,
        laws: fractions(&[], body.tolerance),
        outcome: Outcome::Wrong("the program panicked".to_owned()),
    })
}

/// Every law, and the largest fraction of its bound.
fn fractions(certificates: &[Certificate], tolerance: f64) -> Vec<(&'static str, f64)> {
    let mut largest = Certificate::default().laws(tolerance).map(|(name, _, _)| (name, 0.0_f64));
    for certificate in certificates {
        for ((_, most), (_, value, bound)) in largest.iter_mut().zip(certificate.laws(tolerance)) {
            *most = most.max(if value == 0.0 { 0.0 } else { value / bound });
        }
    }
    largest.to_vec()
}

/// Largest pull on a friction map, as a fraction of what the largest coefficient that can be drawn would carry.
const MOST_PULL_ON_MAP: f64 = 0.4;

/// How a run ended, and whether what it says is true.
fn judged(body: &Body, text: &str, maps: &[Array2<f64>], ended: &Result<Ended, CaseError>) -> Outcome {
    let ended = match ended {
        Ok(ended) => ended,
        Err(error) => {
            let words = error.to_string();
            return if words.contains("film") && body.has_unseen_film() {
                Outcome::Refused(Refusal::UnseenFilm)
            } else if words.contains("reaches the edge") {
                at_edge(body, text, maps)
            } else if words.contains("friction carries at most") && pulls_more_than_its_map(body, maps) {
                Outcome::Refused(Refusal::AboveSliding)
            } else {
                Outcome::Wrong(format!("refused: {}", words.lines().next().unwrap_or_default()))
            };
        }
    };
    if let Some(wrong) = ended.wrong() {
        return Outcome::Wrong(wrong);
    }
    match &ended.error {
        None if ended.run.is_empty() => Outcome::Wrong("no increment".to_owned()),
        None => Outcome::Certified,
        Some(RunError::ContactAtEdge { .. }) => at_edge(body, text, maps),
        Some(RunError::WearTooFast { share, .. }) if body.family == Family::Wear && *share > 0.4 => {
            Outcome::Refused(Refusal::WearTooFast)
        }
        Some(RunError::AboveSliding { asked, .. }) => match carried(ended) {
            Some(carried) if *asked < 0.999 * carried => {
                Outcome::Wrong(format!("asked {asked:e}, but friction carries {carried:e}"))
            }
            _ => Outcome::Refused(Refusal::AboveSliding),
        },
        Some(error @ RunError::NotConverged { .. }) => Outcome::Unsolved(error.to_string()),
        Some(error) => Outcome::Wrong(error.to_string()),
    }
}

/// Whether a pull that is drawn can be more than the best patch carries; one on a single coefficient never is.
fn pulls_more_than_its_map(body: &Body, maps: &[Array2<f64>]) -> bool {
    maps.first()
        .is_some_and(|map| map.iter().all(|coefficient| *coefficient < MOST_PULL_ON_MAP * body.friction))
}

/// A contact that is said to reach the edge has to do so where there is more room: on a grid of three times as many cells.
fn at_edge(body: &Body, text: &str, maps: &[Array2<f64>]) -> Outcome {
    let [nx, ny] = body.cells;
    let wide = text.replacen(&body.grid(1), &body.grid(3), 1);
    let kept = format!("{wide}[output]\nfields = [\"pressure\"]\nevery = 1\n");
    let inside = |place: usize, cells: usize| place.clamp(cells, 2 * cells - 1) - cells;
    let padded = |map: &Array2<f64>| {
        Array2::from_shape_fn([3 * nx, 3 * ny], |(i, j)| map[[inside(i, nx), inside(j, ny)]])
    };
    let maps: Vec<_> = maps.iter().map(padded).collect();
    let case = Case::from_toml_with(&kept, "wide.toml", Attachments { arrays: &maps, ..Attachments::none() });
    // What is still too wide, or not solved there, is wide enough.
    let Ok(plan) = case.and_then(Plan::new) else { return Outcome::Refused(Refusal::ContactAtEdge) };
    let Ok(history) = Simulation::new(&plan).run(&mut Silent) else {
        return Outcome::Refused(Refusal::ContactAtEdge);
    };
    let outside = |place: usize, cells: usize| place <= cells || place >= 2 * cells - 1;
    let reaches = history.fields.iter().filter_map(|kept| kept.pressure.as_ref()).any(|pressure| {
        pressure.indexed_iter().any(|((i, j), p)| *p > 0.0 && (outside(i, nx) || outside(j, ny)))
    });
    if reaches {
        Outcome::Refused(Refusal::ContactAtEdge)
    } else {
        Outcome::Wrong("contact at the edge, where a wider grid finds none".to_owned())
    }
}

/// What friction carried in the last solved increment, `sum mu p dA`, when the normal load and the friction stay in the next.
fn carried(ended: &Ended) -> Option<f64> {
    let last = ended.run.last()?;
    let case = &ended.plan.case;
    let number = ended.error.as_ref()?.increment();
    let mut first = 0;
    let stage = case.stages.iter().find(|stage| {
        first += stage.increments_in_all();
        number < first
    })?;
    let stays = stage.normal.is_none() && stage.friction.is_none();
    let pressure = last.fields.pressure.as_ref().filter(|_| stays)?;
    let sum: f64 = pressure.indexed_iter().map(|((i, j), p)| p * case.friction.at(i, j)).sum();
    Some(sum * ended.plan.grid.cell_area())
}

/// A layered body: coatings, and the substrate or a rigid base. Layers are (Young's modulus, Poisson's ratio, thickness).
struct Layers {
    coatings: Vec<(f64, f64, f64)>,
    substrate: Option<(f64, f64)>,
}

impl Layers {
    fn drawn(random: &mut Random, young: f64, contact: f64) -> Self {
        let count = if random.chance(0.25) { 0 } else { random.whole(1, 2) };
        let coatings: Vec<_> = (0..count)
            .map(|_| {
                let (contrast, thickness) = (random.log_uniform(1e-6, 1e6), random.log_uniform(1e-3, 1e3));
                (young * contrast, poisson(random), contact * thickness)
            })
            .collect();
        let rigid = count > 0 && random.chance(0.1);
        let substrate = (!rigid).then(|| (young, poisson(random)));
        Self { coatings, substrate }
    }

    fn text(&self) -> String {
        let list: Vec<String> = self
            .coatings
            .iter()
            .map(|(young, poisson, thickness)| {
                format!("{{ thickness = {thickness:e}, young = {young:e}, poisson = {poisson} }}")
            })
            .collect();
        let coatings =
            if list.is_empty() { String::new() } else { format!("coatings = [{}]\n", list.join(", ")) };
        match self.substrate {
            None => format!("{coatings}base = \"rigid\"\n"),
            Some((young, poisson)) => {
                format!("{coatings}substrate = {{ young = {young:e}, poisson = {poisson} }}\n")
            }
        }
    }

    /// Whether coatings above something a thousand times stiffer are thinner than a fifth of a cell and nearly incompressible.
    fn has_unseen_film(&self, cell: f64) -> bool {
        let shear = |(young, poisson): (f64, f64)| young / (2.0 * (1.0 + poisson));
        (1..=self.coatings.len()).any(|count| {
            let film = &self.coatings[..count];
            let below = match (self.coatings.get(count), self.substrate) {
                (Some(&(young, poisson, _)), _) => shear((young, poisson)),
                (None, Some(substrate)) => shear(substrate),
                (None, None) => f64::INFINITY,
            };
            let thickness: f64 = film.iter().map(|(_, _, thickness)| thickness).sum();
            film.iter().all(|&(young, poisson, _)| 999.0 * shear((young, poisson)) < below)
                && thickness < 0.2 * cell
                && film.iter().all(|(_, poisson, _)| *poisson > 0.3)
        })
    }
}

fn poisson(random: &mut Random) -> f64 {
    if random.chance(0.05) { 0.5 } else { random.between(-0.9, 0.5) }
}

/// All of a case but its loads.
struct Body {
    family: Family,
    cells: [usize; 2],
    spacing: [f64; 2],
    upper: Option<Layers>,
    lower: Layers,
    radii: [f64; 2],
    /// Amplitude of a wave that takes the place of the ellipsoid where the case is periodic.
    wave: Option<f64>,
    friction: f64,
    tolerance: f64,
    /// Approach under which the undeformed bodies overlap within the grid.
    approach: f64,
    /// Smaller half axis of that overlap.
    radius: f64,
    /// The normal load is an approach throughout.
    by_approach: bool,
}

impl Body {
    fn drawn(random: &mut Random, [fewest, most]: [usize; 2]) -> Self {
        let family = match random.uniform() {
            u if u < 0.5 => Family::Plain,
            u if u < 0.65 => Family::Torsion,
            u if u < 0.77 => Family::Map,
            u if u < 0.89 => Family::Wear,
            _ => Family::Periodic,
        };
        let (length, young) = (random.log_uniform(1e-12, 1e12), random.log_uniform(1e-12, 1e12));
        let cells = [random.whole(fewest, most), random.whole(fewest, most)];
        let mut spacing = [length, length * random.log_uniform(1.0, 8.0)];
        if random.chance(0.5) {
            spacing.reverse();
        }
        let half = [0, 1].map(|axis| 0.36 * cells[axis] as f64 * spacing[axis]);
        let radius = half[0].min(half[1]);
        let approach = length * random.log_uniform(1e-6, 1e-1);
        let frictionless = family == Family::Plain && random.chance(0.15);
        let friction = if frictionless { 0.0 } else { random.log_uniform(1e-3, 2.0) };
        let upper = if random.chance(0.4) { None } else { Some(Layers::drawn(random, young, radius)) };
        let lower_young = young * random.log_uniform(1e-2, 1e2);
        let wave = (family == Family::Periodic && random.chance(0.5)).then(|| approach * random.uniform());
        Self {
            family,
            cells,
            spacing,
            upper,
            lower: Layers::drawn(random, lower_young, radius),
            radii: half.map(|half| half * half / (2.0 * approach)),
            wave,
            friction,
            tolerance: if random.chance(0.5) { 1e-8 } else { 1e-6 },
            approach,
            radius,
            by_approach: random.chance(0.3) && family != Family::Periodic,
        }
    }

    fn run(&self, seed: u64, mut random: Random) -> Extreme {
        // Without friction, pressed to the approach: what force that needs.
        let pressing = format!(
            "{}[[load]]\napproach = {:e}\nincrements = 1\n",
            self.head(false, "coefficient = 0.0"),
            self.approach
        );
        let extreme = |text: String, ended: &Result<Ended, CaseError>, outcome: Outcome| {
            let certificates = ended.as_ref().map_or(&[][..], |ended| &ended.certificates);
            Extreme {
                seed,
                family: self.family,
                text,
                increments: certificates.len(),
                in_parts: certificates.iter().filter(|certificate| !certificate.whole).count(),
                laws: fractions(certificates, self.tolerance),
                outcome,
            }
        };
        let pressed = run_certified(&pressing, &[]);
        let first = match (judged(self, &pressing, &[], &pressed), &pressed) {
            (Outcome::Certified, Ok(ended)) => ended.run[0].record.clone(),
            (other, _) => return extreme(pressing, &pressed, other),
        };
        let (text, maps) = self.loaded(&mut random, first.normal_force, first.max_pressure);
        let ended = run_certified(&text, &maps);
        let outcome = judged(self, &text, &maps, &ended);
        extreme(text, &ended, outcome)
    }

    fn has_unseen_film(&self) -> bool {
        let cell = self.spacing[0].min(self.spacing[1]);
        self.upper.iter().chain([&self.lower]).any(|layers| layers.has_unseen_film(cell))
    }

    /// Cells and side lengths of the grid, or of one so many times as wide.
    fn grid(&self, times: usize) -> String {
        let cells = self.cells.map(|cells| times * cells);
        let [x, y] = [0, 1].map(|axis| cells[axis] as f64 * self.spacing[axis]);
        format!("[grid]\ncells = {cells:?}\nsize = [{x:e}, {y:e}]\n")
    }

    fn head(&self, periodic: bool, friction: &str) -> String {
        let Self { cells, spacing, radii: [rx, ry], .. } = self;
        let upper = self.upper.as_ref().map_or("rigid = true\n".to_owned(), Layers::text);
        let period = if periodic { "periodic = true\n" } else { "" };
        let [x, y] = [0, 1].map(|axis| cells[axis] as f64 * spacing[axis]);
        let profile = match self.wave.filter(|_| periodic) {
            Some(amplitude) => {
                format!(
                    "[profile.wave]\namplitude = {amplitude:e}\nwavelength_x = {x:e}\nwavelength_y = {y:e}\n"
                )
            }
            None => format!("[profile.ellipsoid]\nradius_x = {rx:e}\nradius_y = {ry:e}\n"),
        };
        let lower = self.lower.text();
        format!(
            "{}{period}[upper]\n{upper}[lower]\n{lower}{profile}[friction]\n{friction}\n[solver]\ntolerance = {:e}\n",
            self.grid(1),
            self.tolerance
        )
    }

    /// The whole case, of whose approach the force and the maximum pressure are known; and its friction map.
    fn loaded(&self, random: &mut Random, force: f64, peak: f64) -> (String, Vec<Array2<f64>>) {
        let maps = if self.family == Family::Map { vec![self.map(random)] } else { Vec::new() };
        let friction = if maps.is_empty() {
            format!("coefficient = {:e}", self.friction)
        } else {
            "map = { array = 0 }".to_owned()
        };
        let mut text = self.head(self.family == Family::Periodic, &friction);
        if self.family == Family::Wear {
            // In fractions of what would take a cell's whole pressure off over a slip of the sliding distance.
            let cells = self.cells[0].min(self.cells[1]) as f64;
            let (law, more) = if random.chance(0.5) { ("archard", 1.0) } else { ("energy", self.friction) };
            let coefficient = random.log_uniform(1e-3, 1.0) / (peak * cells * self.friction * more);
            let every = random.whole(1, 3);
            let _ = write!(text, "[wear]\nlaw = \"{law}\"\ncoefficient = {coefficient:e}\nevery = {every}\n");
        }
        let mut loads = Loads { body: self, random, force, text, pressed: 0.0 };
        loads.write();
        (loads.text, maps)
    }

    /// Patches that each rub in their own way, some of them not at all.
    fn map(&self, random: &mut Random) -> Array2<f64> {
        let patches = [random.whole(1, 4), random.whole(2, 4)];
        let bare = if random.chance(0.5) { 0.2 } else { 0.0 };
        let coefficients = Array2::from_shape_fn(patches, |_| {
            if random.chance(bare) { 0.0 } else { self.friction * random.between(0.2, 1.0) }
        });
        Array2::from_shape_fn(self.cells, |(i, j)| {
            coefficients[[i * patches[0] / self.cells[0], j * patches[1] / self.cells[1]]]
        })
    }
}

/// The history of loads as it is drawn.
struct Loads<'a> {
    body: &'a Body,
    random: &'a mut Random,
    force: f64,
    text: String,
    /// Normal load so far, as a fraction.
    pressed: f64,
}

impl Loads<'_> {
    fn stage(&mut self, controls: &str, increments: usize) {
        let _ = write!(self.text, "[[load]]\n{controls}increments = {increments}\n");
    }

    fn press(&mut self, fraction: f64, most: usize) {
        self.pressed = fraction;
        let controls = if self.body.by_approach {
            format!("approach = {:e}\n", self.body.approach * fraction)
        } else {
            format!("normal_force = {:e}\n", self.force * fraction)
        };
        let increments = self.random.whole(1, most);
        self.stage(&controls, increments);
    }

    fn write(&mut self) {
        let first = self.random.between(0.3, 1.0);
        self.press(first, 4);
        if self.body.friction == 0.0 {
            let next = self.random.uniform();
            self.press(next, 3);
        } else {
            self.rub();
        }
        if self.random.chance(0.2) {
            // Nothing that apart bodies cannot carry.
            match self.body.family {
                _ if self.body.friction == 0.0 => {}
                Family::Periodic => self.stage("tangential_force = [0.0, 0.0]\n", 1),
                Family::Torsion => self.stage("shift = [0.0, 0.0]\ntwist = 0.0\n", 1),
                _ => self.stage("shift = [0.0, 0.0]\n", 1),
            }
            self.press(0.0, 3);
            self.press(0.5, 1);
        }
    }

    /// A few stages along the surface.
    fn rub(&mut self) {
        let body = self.body;
        let slides = body.friction * body.approach;
        let mut by_force = !body.by_approach;
        for number in 0..self.random.whole(1, 3) {
            let turns = body.family == Family::Torsion && (number == 0 || self.random.chance(0.3));
            let kind = self.random.uniform();
            if turns {
                if by_force && self.random.chance(0.5) {
                    // The moment of a Hertz contact that slides about z is 3 pi/16 mu P a; less is shared with a pull.
                    let fraction = self.random.between(-0.25, 0.25);
                    let moment = fraction * body.friction * self.force * self.pressed * body.radius;
                    let increments = self.random.whole(1, 3);
                    self.stage(&format!("twist_moment = {moment:e}\n"), increments);
                } else {
                    let twist = slides / body.radius * self.random.log_uniform(0.1, 3.0);
                    let increments = self.random.whole(1, 3);
                    self.stage(&format!("twist = {twist:e}\n"), increments);
                }
            } else if by_force && (kind < 0.45 || body.family == Family::Periodic) {
                self.pull();
            } else if kind < 0.75 && body.family != Family::Periodic {
                by_force = false;
                let [x, y] = self.direction().map(|part| part * slides);
                let shift = self.random.log_uniform(0.1, 5.0);
                let increments = self.random.whole(1, 4);
                self.stage(&format!("shift = [{:e}, {:e}]\n", x * shift, y * shift), increments);
                if self.random.chance(0.5) {
                    // And back.
                    let back = self.random.between(-1.0, 1.0) * shift;
                    let increments = self.random.whole(1, 4);
                    self.stage(&format!("shift = [{:e}, {:e}]\n", x * back, y * back), increments);
                } else if self.random.chance(0.3) || body.family == Family::Wear {
                    let cycles = self.random.whole(1, 3);
                    let controls = format!("shift = [{:e}, {:e}]\ncycles = {cycles}\n", x * shift, y * shift);
                    self.stage(&controls, 8);
                }
            } else if by_force {
                // The pull so far must stay below what the smaller force carries.
                self.stage("tangential_force = [0.0, 0.0]\n", 1);
                let fraction = self.pressed * self.random.between(0.2, 1.0);
                self.press(fraction, 3);
            } else if body.by_approach && self.random.chance(0.7) {
                let fraction = self.random.between(0.2, 1.0);
                self.press(fraction, 3);
            } else if body.family == Family::Plain {
                // The motions stay, friction changes.
                let other = body.friction * self.random.between(0.0, 1.5);
                self.stage(&format!("friction = {other:e}\n"), 1);
            }
        }
    }

    /// A tangential force that friction carries, and perhaps the opposite one.
    fn pull(&mut self) {
        let body = self.body;
        // Of a map nobody knows yet what it carries; a moment takes its share.
        let most = match body.family {
            Family::Map => MOST_PULL_ON_MAP,
            Family::Torsion => 0.5,
            _ => 0.99,
        };
        let near = most == 0.99 && self.random.chance(0.3);
        let fraction = if near { 0.9999 } else { self.random.between(0.05, most) };
        let pull = fraction * body.friction * self.force * self.pressed;
        let [x, y] = self.direction().map(|part| part * pull);
        let increments = self.random.whole(1, 4);
        self.stage(&format!("tangential_force = [{x:e}, {y:e}]\n"), increments);
        if self.random.chance(0.3) {
            let back = -self.random.uniform();
            let increments = self.random.whole(1, 4);
            self.stage(&format!("tangential_force = [{:e}, {:e}]\n", x * back, y * back), increments);
        }
    }

    /// A unit vector: any, or along an axis, where mirrors help.
    fn direction(&mut self) -> [f64; 2] {
        if self.random.chance(0.25) {
            return if self.random.chance(0.5) { [1.0, 0.0] } else { [0.0, 1.0] };
        }
        let angle = self.random.between(0.0, TAU);
        [angle.cos(), angle.sin()]
    }
}
