//! All of a case but its loads: bodies, grid, profile, friction, wear.

use ndarray::Array2;

use super::Family;
use crate::random::Random;

/// A layered body: coatings, and the substrate or a rigid base. Layers are (Young's modulus, Poisson's ratio, thickness).
pub(super) struct Layers {
    pub(super) coatings: Vec<(f64, f64, f64)>,
    pub(super) substrate: Option<(f64, f64)>,
}

impl Layers {
    pub(super) fn drawn(random: &mut Random, young: f64, contact: f64) -> Self {
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
    pub(super) fn has_unseen_film(&self, cell: f64) -> bool {
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

pub(super) fn poisson(random: &mut Random) -> f64 {
    if random.chance(0.05) { 0.5 } else { random.between(-0.9, 0.5) }
}

/// All of a case but its loads.
pub(super) struct Body {
    pub(super) family: Family,
    pub(super) cells: [usize; 2],
    pub(super) spacing: [f64; 2],
    pub(super) upper: Option<Layers>,
    pub(super) lower: Layers,
    pub(super) radii: [f64; 2],
    /// Amplitude of a wave that takes the place of the ellipsoid where the case is periodic.
    pub(super) wave: Option<f64>,
    pub(super) friction: f64,
    pub(super) tolerance: f64,
    /// Approach under which the undeformed bodies overlap within the grid.
    pub(super) approach: f64,
    /// Smaller half axis of that overlap.
    pub(super) radius: f64,
    /// The normal load is an approach throughout.
    pub(super) by_approach: bool,
}

impl Body {
    pub(super) fn drawn(random: &mut Random, [fewest, most]: [usize; 2]) -> Self {
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

    pub(super) fn has_unseen_film(&self) -> bool {
        let cell = self.spacing[0].min(self.spacing[1]);
        self.upper.iter().chain([&self.lower]).any(|layers| layers.has_unseen_film(cell))
    }

    /// Cells and side lengths of the grid, or of one so many times as wide.
    pub(super) fn grid(&self, times: usize) -> String {
        let cells = self.cells.map(|cells| times * cells);
        let [x, y] = [0, 1].map(|axis| cells[axis] as f64 * self.spacing[axis]);
        format!("[grid]\ncells = {cells:?}\nsize = [{x:e}, {y:e}]\n")
    }

    pub(super) fn head(&self, periodic: bool, friction: &str) -> String {
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

    /// Patches that each rub in their own way, some of them not at all.
    pub(super) fn map(&self, random: &mut Random) -> Array2<f64> {
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
