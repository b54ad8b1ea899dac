//! What the levels of a study are measured by: a closed form where it speaks, numbers from elsewhere, the limit of the study, or
//! its finest level.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::closed_form::ClosedForm;
use super::level::Level;
use super::limit::{Heading, heading};
use super::means;
use super::quantities::{PerQuantity, Quantity};
use super::resolutions::{Kind, Place, Resolutions};
use crate::model::{Dimension, SurfaceGrid};

/// Quantities change by less than so many times the tolerance of the solver, relative, where refinement changes nothing.
const NOISE: f64 = 10.0;

/// Fraction below which a motion or an energy is none.
pub(super) const NOTHING: f64 = 1e-9;

/// Where a reference comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// A closed form.
    ClosedForm,
    /// Numbers from elsewhere.
    Given,
    /// What the study is heading for.
    Limit,
    /// The finest level.
    Finest,
}

/// What is known of the way a quantity approaches its limit in a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Convergence {
    /// With the order its levels show.
    Observed,
    /// Two levels show none: the whole change from one to the other counts as the error of the finer.
    TwoLevels,
    /// Its levels show no order that is plausible: they are not in the asymptotic range.
    NotAsymptotic,
    /// It has no limit: the largest pressure at a sharp edge, a tip or a crease grows with the number of cells without bound.
    NoLimit,
}

/// Reference values.
#[derive(Debug, Clone)]
pub struct Reference {
    /// For each quantity of interest its values at the end of each stage, and where they come from; `None` where nothing is known.
    numbers: PerQuantity<(Vec<Option<[f64; 2]>>, Source)>,
    /// How each quantity approaches its limit; `None` where its levels say nothing of that.
    convergence: PerQuantity<Option<Convergence>>,
    form: Option<ClosedForm>,
    finest: Option<Fields>,
}

#[derive(Debug, Clone)]
struct Fields {
    grid: SurfaceGrid,
    pressure: Array2<f64>,
    shear: [Array2<f64>; 2],
}

impl Reference {
    /// A closed form alone.
    pub fn closed(form: ClosedForm) -> Self {
        let of = |quantity: Quantity| {
            let values = form.ends().iter().map(|said| said.of(quantity)).collect();
            (values, Source::ClosedForm)
        };
        Self {
            numbers: Quantity::ALL.map(of),
            convergence: [Some(Convergence::Observed); Quantity::ALL.len()],
            form: Some(form),
            finest: None,
        }
    }

    /// The finest level of a solved study.
    pub fn finest(finest: &Level) -> Self {
        // The way there is nothing to judge a history by that rolls on steadily in the end: shift and energy are those of its last cell.
        let ends_with = |quantity| finest.ends.last().is_some_and(|end| end.between(quantity).is_some());
        let of = |quantity: Quantity| {
            let is_of_the_way = matches!(quantity, Quantity::Shift | Quantity::DissipatedEnergy);
            let is_told = !is_of_the_way || ends_with(quantity);
            let values = finest.ends.iter().map(|end| end.between(quantity).filter(|_| is_told));
            (values.collect(), Source::Finest)
        };
        let fields = Some(Fields::of(finest));
        Self {
            numbers: Quantity::ALL.map(of),
            convergence: [Some(Convergence::Observed); Quantity::ALL.len()],
            form: None,
            finest: fields,
        }
    }

    /// The limit a solved study is heading for; for the fields, and for quantities that show no limit, its finest level. `level`
    /// gives the level at a place.
    pub fn limit<'a>(resolutions: &Resolutions, level: &impl Fn(Place) -> Option<&'a Level>) -> Option<Self> {
        let finest = level(resolutions.finest())?;
        let mut reference = Self::finest(finest);
        let lines = [Kind::Cells, Kind::Increments].map(|kind| {
            let places = resolutions.line(kind);
            // levels that could not be solved are missing
            let solved =
                places.iter().filter_map(|place| Some((resolutions.count(kind, *place), level(*place)?)));
            let (counts, levels): (Vec<f64>, Vec<&Level>) = solved.unzip();
            (kind, counts, levels)
        });
        for quantity in Quantity::ALL {
            let least = NOTHING * reference.beside(quantity).unwrap_or(0.0);
            let noise =
                least.max(NOISE * finest.variation.tolerance * reference.largest(quantity).unwrap_or(0.0));
            let (values, source) = &mut reference.numbers[quantity as usize];
            let own = values.clone();
            let mut shows_a_limit = false;
            let mut convergence = None;
            for (end, value) in values.iter_mut().enumerate() {
                let Some(value) = value else { continue };
                for (kind, counts, levels) in lines.iter().filter(|(kind, ..)| has_order(quantity, *kind)) {
                    let order =
                        known_order(quantity, *kind).filter(|_| finest.grid.dimension() == Dimension::Plane);
                    for (axis, part) in value.iter_mut().enumerate() {
                        let along: Vec<f64> = levels
                            .iter()
                            .filter_map(|level| Some(level.ends.get(end)?.between(quantity)?[axis]))
                            .collect();
                        let (missing, shown) = match heading(counts, &along, order, noise) {
                            Heading::Alone | Heading::TwoLevels(0.0) => continue,
                            Heading::Limit(missing) => (missing, Convergence::Observed),
                            Heading::TwoLevels(missing) => (missing, Convergence::TwoLevels),
                            Heading::NotAsymptotic => (0.0, Convergence::NotAsymptotic),
                        };
                        *part += missing;
                        shows_a_limit |= along.iter().any(|value| *value != 0.0);
                        // what shows less than others do counts
                        convergence = match (convergence, shown) {
                            (Some(known), Convergence::Observed)
                            | (Some(known @ Convergence::NotAsymptotic), _) => Some(known),
                            _ => Some(shown),
                        };
                    }
                }
            }
            reference.convergence[quantity as usize] = convergence;
            if convergence == Some(Convergence::NotAsymptotic) {
                *values = own;
            } else if shows_a_limit {
                *source = Source::Limit;
            }
        }
        Some(reference)
    }

    /// This reference where it says something, another one elsewhere.
    #[must_use]
    pub fn or(mut self, other: Self) -> Self {
        for (number, other_numbers) in other.numbers.into_iter().enumerate() {
            if self.numbers[number].0.iter().all(Option::is_none) {
                self.numbers[number] = other_numbers;
                self.convergence[number] = other.convergence[number];
            }
        }
        self.finest = self.finest.or(other.finest);
        self.form = self.form.or(other.form);
        self
    }

    /// This reference without a quantity that has no limit.
    #[must_use]
    pub fn without_limit(mut self, quantity: Quantity) -> Self {
        self.numbers[quantity as usize].0.fill(None);
        self.convergence[quantity as usize] = Some(Convergence::NoLimit);
        self
    }

    /// How a quantity approaches its limit in the study; `None` where its levels say nothing of that.
    pub fn convergence(&self, quantity: Quantity) -> Option<Convergence> {
        self.convergence[quantity as usize]
    }

    /// This reference with numbers from elsewhere for the end of the history.
    #[must_use]
    pub fn with(mut self, quantity: Quantity, value: [f64; 2]) -> Self {
        let (values, source) = &mut self.numbers[quantity as usize];
        values.fill(None);
        if let Some(last) = values.last_mut() {
            *last = Some(value);
        }
        *source = Source::Given;
        self
    }

    /// Nothing, for a history of so many stages.
    pub fn nothing(stages: usize) -> Self {
        Self {
            numbers: std::array::from_fn(|_| (vec![None; stages], Source::Given)),
            convergence: [Some(Convergence::Observed); Quantity::ALL.len()],
            form: None,
            finest: None,
        }
    }

    /// Values of a quantity of interest at the end of each stage, scalars first.
    pub fn of(&self, quantity: Quantity) -> &[Option<[f64; 2]>] {
        &self.numbers[quantity as usize].0
    }

    /// The largest value of a quantity of interest over the stages.
    pub(super) fn largest(&self, quantity: Quantity) -> Option<f64> {
        self.of(quantity).iter().flatten().map(|[x, y]| x.hypot(*y)).reduce(f64::max)
    }

    /// What a motion, an energy or wear is none beside, if it is as small as rounding leaves it in a symmetric case.
    pub(super) fn beside(&self, quantity: Quantity) -> Option<f64> {
        let approach = || self.largest(Quantity::Approach);
        let area = || self.largest(Quantity::ContactArea);
        let force = || Some(self.largest(Quantity::MaxPressure)? * area()?);
        match quantity {
            Quantity::Shift | Quantity::MaxWornDepth => approach(),
            Quantity::DissipatedEnergy => Some(approach()? * force()?),
            Quantity::Creepage => Some(1.0),
            Quantity::Spin => Some(area()?.sqrt().recip()), // none in a line contact, whose area is a width
            Quantity::RollingFriction => force(),
            Quantity::WornVolume => Some(approach()? * area()?),
            _ => None,
        }
    }

    /// Where a quantity of interest comes from; `None` where nothing is known of it.
    pub fn source(&self, quantity: Quantity) -> Option<Source> {
        let (values, source) = &self.numbers[quantity as usize];
        values.iter().any(Option::is_some).then_some(*source)
    }

    /// The closed form behind it.
    pub fn form(&self) -> Option<&ClosedForm> {
        self.form.as_ref()
    }

    /// Relative error of a level's pressure in the mean square, at the end of the history.
    pub fn error_of_pressure(&self, level: &Level) -> Option<f64> {
        let exact = if let Some(form) = &self.form {
            let pressure = form.pressure_everywhere();
            means::of_formula(&|x, y| pressure(x, y), &level.grid)
        } else {
            let fields =
                self.finest.as_ref().filter(|fields| fields.grid != level.grid || !self.is_own(level))?;
            means::of_field(&fields.pressure, &fields.grid, &level.grid)
        };
        relative([(&level.pressure, &exact)])
    }

    /// The same for the shear.
    pub fn error_of_shear(&self, level: &Level) -> Option<f64> {
        let exact: [Array2<f64>; 2] = match (&self.form, &self.finest) {
            (Some(form), _) if form.knows_shear() => {
                [0, 1].map(|axis| means::of_formula(&|x, y| form.shear(x, y)[axis], &level.grid))
            }
            (_, Some(fields)) if fields.grid != level.grid || !self.is_own(level) => {
                [0, 1].map(|axis| means::of_field(&fields.shear[axis], &fields.grid, &level.grid))
            }
            _ => return None,
        };
        relative([(&level.shear[0], &exact[0]), (&level.shear[1], &exact[1])])
    }

    /// Whether a quantity of a level is compared with itself.
    pub(super) fn is_itself(&self, quantity: Quantity, level: &Level) -> bool {
        self.numbers[quantity as usize].1 == Source::Finest && self.is_own(level)
    }

    /// Whether the fields are this level's own.
    fn is_own(&self, level: &Level) -> bool {
        self.finest
            .as_ref()
            .is_some_and(|fields| fields.pressure == level.pressure && fields.shear == level.shear)
    }
}

impl Fields {
    fn of(level: &Level) -> Self {
        Self { grid: level.grid, pressure: level.pressure.clone(), shear: level.shear.clone() }
    }
}

/// Order that is known beforehand: pressure and approach fall with the cell squared, but those of line contacts. The order of increments
/// is read off the levels: that of the second-order rule too lies between 1 and 2 where a contact grows.
fn known_order(quantity: Quantity, kind: Kind) -> Option<f64> {
    match (quantity, kind) {
        (Quantity::MaxPressure | Quantity::Approach, Kind::Cells) => Some(2.0),
        _ => None,
    }
}

/// Whether a quantity has an order in what is refined. Areas have none over the cells: it depends on where the edge lies between the
/// centres of cells, and scatters; so does the steady state of a contact that rolls by whole cells.
pub(super) fn has_order(quantity: Quantity, kind: Kind) -> bool {
    let scatters = matches!(
        quantity,
        Quantity::ContactArea
            | Quantity::StickArea
            | Quantity::Creepage
            | Quantity::Spin
            | Quantity::RollingFriction
    );
    !(scatters && matches!(kind, Kind::Cells | Kind::Together))
}

/// `|a - b| / |b|` over the cells of all pairs; `None` where there is nothing to compare with.
fn relative<const N: usize>(pairs: [(&Array2<f64>, &Array2<f64>); N]) -> Option<f64> {
    let (mut apart, mut size) = (0.0, 0.0);
    for (a, b) in pairs {
        for (a, b) in a.iter().zip(b) {
            apart += (a - b).powi(2);
            size += b * b;
        }
    }
    (size > 0.0).then(|| f64::sqrt(apart / size))
}
