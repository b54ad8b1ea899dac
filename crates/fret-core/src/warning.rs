//! What about a case or its answer may mislead: facts with a name, a number, the bound it has crossed, words and a way out.
//!
//! Nothing here refuses anything. [`of_plan`] says what follows from the case alone, before any work; [`Gauge`] follows a run and
//! says what its numbers tell. Bounds and words stand here and nowhere else.

use serde::{Deserialize, Serialize};

use crate::history::StepRecord;
use crate::model::{Base, Body, Control};
use crate::plan::{Coupling, Plan};

/// Fewest cells in the contact radius. Frictionless Hertz contacts of 2 to 5 cells err by up to 15, 2, 4, 1 % in the largest
/// pressure, and their error bars miss one time in three; from 6 cells on the error is below a percent and bars hold (measured on
/// a scan of radii in `tests/error_bars.rs`).
pub const CELLS_IN_RADIUS: f64 = 6.0;
/// Approach over contact radius, which for a sphere is contact radius over body radius: the slope of the surfaces at the rim, and
/// about their strain. At a fifth a parabola is 1 % off the sphere it stands for, and linear elasticity as far off as the strain.
pub const STRAIN: f64 = 0.2;
/// Relative tangential displacement over contact radius. The profile stays where it is: with a shift of a fifth of the radius the
/// points that face each other at the rim have moved by a tenth of the contact's width.
pub const SHIFT: f64 = 0.2;
/// Root mean square slope of topography. Half-spaces know small slopes: at 0.3 sine and tangent differ by 4 %.
pub const SLOPE: f64 = 0.3;
/// Coating thickness over the longer side of a cell. Tractions are uniform over a cell; half a cell deep, in the middle of such a
/// coating, stresses are within a percent of those of smooth tractions, nearer to the surface they show the cells.
pub const COATING_CELLS: f64 = 1.0;
/// Wear depth over coating thickness. The elastic response stays that of the unworn stack; what a fifth less coating would change
/// is a fifth of what the coating does.
pub const WORN: f64 = 0.2;
/// Open cells between contact and the edge of the grid: the edge of contact is read from two open cells beside it.
pub const FREE_CELLS: usize = 2;
/// Cells by which the contact radius may grow in one increment while pressure and shear act on each other. Each increment leaves a
/// ring in the shear. Rings of a cell and less are below what the grid shows; at 2.5 cells they are teeth of 4 % of the peak.
pub const RING_CELLS: f64 = 1.0;

/// What a warning is about; its name in files is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Concern {
    /// The contact radius is a few cells.
    FewCells,
    /// The contact radius is not small against the body's.
    ContactRadiusOverBodyRadius,
    /// The approach is not small against the contact.
    ApproachOverContactRadius,
    /// The approach is not small against the layers on a rigid base.
    ApproachOverLayerThickness,
    /// The shift is not small against the contact.
    ShiftOverContactRadius,
    /// Topography is steep.
    SteepTopography,
    /// A coating is thinner than a cell is long.
    CoatingThinnerThanCell,
    /// Wear has taken a good part of the coating.
    WearDepthOverCoatingThickness,
    /// The contact comes close to the edge of the grid.
    ContactNearEdge,
    /// Increments of pressing are too large for the cells.
    PressingInFewIncrements,
}

impl Concern {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::FewCells => "few_cells",
            Self::ContactRadiusOverBodyRadius => "contact_radius_over_body_radius",
            Self::ApproachOverContactRadius => "approach_over_contact_radius",
            Self::ApproachOverLayerThickness => "approach_over_layer_thickness",
            Self::ShiftOverContactRadius => "shift_over_contact_radius",
            Self::SteepTopography => "steep_topography",
            Self::CoatingThinnerThanCell => "coating_thinner_than_cell",
            Self::WearDepthOverCoatingThickness => "wear_depth_over_coating_thickness",
            Self::ContactNearEdge => "contact_near_edge",
            Self::PressingInFewIncrements => "pressing_in_few_increments",
        }
    }

    /// What the number is.
    fn quantity(self) -> &'static str {
        match self {
            Self::FewCells => "cells in the contact radius",
            Self::ContactRadiusOverBodyRadius => "contact radius over body radius",
            Self::ApproachOverContactRadius => "approach over contact radius",
            Self::ApproachOverLayerThickness => {
                "approach over the thickness of the layers on their rigid base"
            }
            Self::ShiftOverContactRadius => "shift over contact radius",
            Self::SteepTopography => "root mean square slope of the topography",
            Self::CoatingThinnerThanCell => "coating thickness over the side of a cell",
            Self::WearDepthOverCoatingThickness => "wear depth over coating thickness",
            Self::ContactNearEdge => "open cells between the contact and the edge of the grid",
            Self::PressingInFewIncrements => "cells by which the contact radius grows in an increment",
        }
    }

    /// Whether small numbers are what is warned of.
    fn warns_below(self) -> bool {
        matches!(self, Self::FewCells | Self::CoatingThinnerThanCell | Self::ContactNearEdge)
    }

    /// Where the bound lies.
    fn bound(self) -> f64 {
        match self {
            Self::FewCells => CELLS_IN_RADIUS,
            Self::ContactRadiusOverBodyRadius
            | Self::ApproachOverContactRadius
            | Self::ApproachOverLayerThickness => STRAIN,
            Self::ShiftOverContactRadius => SHIFT,
            Self::SteepTopography => SLOPE,
            Self::CoatingThinnerThanCell => COATING_CELLS,
            Self::WearDepthOverCoatingThickness => WORN,
            Self::ContactNearEdge => FREE_CELLS as f64,
            Self::PressingInFewIncrements => RING_CELLS,
        }
    }

    /// What it means for the numbers.
    fn consequence(self) -> &'static str {
        match self {
            Self::FewCells => "the cells hardly show the contact, and its numbers may be off by much",
            Self::ContactRadiusOverBodyRadius => {
                "the contact must be small against the bodies; a forgotten factor of a unit does this"
            }
            Self::ApproachOverContactRadius => {
                "strains must be small; a forgotten factor of a unit, in a modulus say, does this"
            }
            Self::ApproachOverLayerThickness => "strains of the layers must be small",
            Self::ShiftOverContactRadius => "surfaces are taken to face each other as they do without shift",
            Self::SteepTopography => "slopes must be small; a forgotten unit of the heights does this",
            Self::CoatingThinnerThanCell => {
                "displacements are right, but stresses inside the coating show the cells of the tractions"
            }
            Self::WearDepthOverCoatingThickness => "the elastic response stays that of the unworn coating",
            Self::ContactNearEdge => "the edge of contact and its area cannot be read there",
            Self::PressingInFewIncrements => {
                "each increment leaves a ring in the shear, and the slip is that of large steps"
            }
        }
    }

    /// What to do.
    fn help(self) -> &'static str {
        match self {
            Self::FewCells => {
                "more cells or a smaller grid (size = \"auto\" finds it); on a rough surface finer pixels"
            }
            Self::ContactRadiusOverBodyRadius
            | Self::ApproachOverContactRadius
            | Self::ApproachOverLayerThickness => "look at the units of moduli, lengths and loads; or press less",
            Self::ShiftOverContactRadius => "look at the unit of the shift; or shift less",
            Self::SteepTopography => "look at the unit of the heights, and at the size of the grid",
            Self::CoatingThinnerThanCell => "more cells or a smaller grid, where such stresses matter",
            Self::WearDepthOverCoatingThickness => "wear.limit = ... ends the run sooner",
            Self::ContactNearEdge => "a larger grid",
            Self::PressingInFewIncrements => "more increments of that stage, or increments = \"auto\"",
        }
    }
}

/// A fact that may mislead.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// What it is about.
    pub name: Concern,
    /// The number [-].
    pub value: f64,
    /// The bound it has crossed [-].
    pub bound: f64,
    /// Name of the stage at whose end, or in which, it was met; `None` where it follows from the case alone.
    pub stage: Option<String>,
    /// In words.
    pub message: String,
    /// A way out.
    pub help: String,
}

impl Warning {
    /// The warning of a number, where it has crossed its bound.
    fn of(name: Concern, value: f64, stage: Option<String>) -> Option<Self> {
        let bound = name.bound();
        let crossed = if name.warns_below() { value < bound } else { value > bound };
        if !(crossed && value.is_finite()) {
            return None;
        }
        let place = stage.as_ref().map_or(String::new(), |stage| format!(", stage \"{stage}\""));
        let side = if name.warns_below() { "at least" } else { "at most" };
        let message = format!(
            "{}: {}{place} (should be {side} {}); {}",
            name.quantity(),
            rounded(value),
            rounded(bound),
            name.consequence()
        );
        Some(Self { name, value, bound, stage, message, help: name.help().to_owned() })
    }
}

/// Three digits.
fn rounded(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let digits = (2 - value.abs().max(1e-3).log10().floor() as i32).clamp(0, 5) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// What follows from the case alone, with the contact that its plan expects.
pub fn of_plan(plan: &Plan) -> Vec<Warning> {
    let mut found = Vec::new();
    let mut look = |name: Concern, value: f64| found.extend(Warning::of(name, value, None));
    if let Some(contact) = &plan.expected {
        let [dx, dy] = plan.grid.spacing();
        let [x, y] = contact.half_widths;
        // A coarse grid has found them: what it cannot tell from the bound is left to the run.
        look(Concern::FewCells, 1.05 * (x / dx).min(y / dy));
        let radius = (x * y).sqrt();
        look(Concern::ContactRadiusOverBodyRadius, over_body(plan, [x, y]));
        look(Concern::ApproachOverContactRadius, contact.approach / x.min(y));
        look(Concern::ApproachOverLayerThickness, contact.approach / layers_on_rigid_base(plan));
        look(Concern::ShiftOverContactRadius, largest_shift(plan) / radius);
    }
    look(Concern::SteepTopography, steepest(plan));
    look(Concern::CoatingThinnerThanCell, thinnest_coating(plan) / longer_side(plan));
    found
}

/// Half-widths over the radii of curvature of the profile, the larger; 0 where it has none.
fn over_body(plan: &Plan, half_widths: [f64; 2]) -> f64 {
    let [x, y] = plan.case.profile.curvatures();
    (half_widths[0] * x).max(half_widths[1] * y)
}

/// Layers on a rigid base [length], the thinner stack; infinite where there is none.
fn layers_on_rigid_base(plan: &Plan) -> f64 {
    stacks(plan)
        .filter(|(_, base)| *base == Base::Rigid)
        .map(|(thickness, _)| thickness)
        .fold(f64::INFINITY, f64::min)
}

/// All coatings of a body together [length], of the body with the thinner ones; infinite where there are none.
fn thinnest_coating(plan: &Plan) -> f64 {
    stacks(plan)
        .map(|(thickness, _)| thickness)
        .filter(|thickness| *thickness > 0.0)
        .fold(f64::INFINITY, f64::min)
}

/// Thickness of the coatings of each elastic body, and what they lie on.
fn stacks(plan: &Plan) -> impl Iterator<Item = (f64, Base)> {
    [plan.case.bodies.upper(), plan.case.bodies.lower()].into_iter().filter_map(|body| match body {
        Body::Rigid => None,
        Body::Elastic(stack) => Some((stack.coating_thickness(), *stack.base())),
    })
}

fn longer_side(plan: &Plan) -> f64 {
    let [dx, dy] = plan.grid.spacing();
    dx.max(dy)
}

/// The largest prescribed shift [length].
fn largest_shift(plan: &Plan) -> f64 {
    let mut largest = 0.0_f64;
    crate::case::walk(&plan.case.stages, |_, [_, x, y, _]| {
        let part = |control: &Option<Control>| match control {
            Some(Control::Motion(shift)) => *shift,
            _ => 0.0,
        };
        largest = largest.max(part(x).hypot(part(y)));
    });
    largest
}

/// Root mean square slope of the steepest topography; 0 without any.
fn steepest(plan: &Plan) -> f64 {
    let [dx, dy] = plan.grid.spacing();
    let slope = |heights: &crate::model::Heights| {
        let depths = heights.depths();
        let (nx, ny) = depths.dim();
        let (mut sum, mut count) = (0.0, 0_usize);
        for i in 0..nx.saturating_sub(1) {
            for j in 0..ny.saturating_sub(1) {
                let [x, y] = [depths[[i + 1, j]] - depths[[i, j]], depths[[i, j + 1]] - depths[[i, j]]];
                sum += (x / dx).powi(2) + (y / dy).powi(2);
                count += 1;
            }
        }
        (sum / count.max(1) as f64).sqrt()
    };
    plan.case.profile.heights.iter().map(slope).fold(0.0, f64::max)
}

/// Follows a run and keeps of it what warnings are made of; the same from one piece or from several.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Gauge {
    ends: Vec<End>,
    /// Largest shift over contact radius, and its stage.
    shift: Option<(f64, usize)>,
    /// Largest growth of the contact radius in an increment [cells], and its stage.
    ring: Option<(f64, usize)>,
    /// Contact radius of the first increment with contact [cells], and its stage.
    first: Option<(f64, usize)>,
    /// Contact radius of the increment before, and the largest so far [cells].
    radius: Option<f64>,
    largest_radius: f64,
    worn_depth: f64,
}

/// The end of a stage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct End {
    stage: usize,
    /// Cells in the radius, and between the contact and the edge of the grid.
    radius: Option<f64>,
    free: usize,
    contact_area: f64,
    approach: f64,
}

impl Gauge {
    /// Reads an increment.
    pub fn add(&mut self, record: &StepRecord) {
        let end = End {
            stage: record.stage,
            radius: record.footprint.radius,
            free: record.footprint.free,
            contact_area: record.contact_area,
            approach: record.approach,
        };
        match self.ends.last_mut() {
            Some(last) if last.stage == end.stage => *last = end,
            _ => self.ends.push(end),
        }
        self.worn_depth = record.max_worn_depth;
        let larger = |most: &mut Option<(f64, usize)>, value: f64| {
            if value.is_finite() && most.is_none_or(|(known, _)| value > known) {
                *most = Some((value, record.stage));
            }
        };
        if record.contact_cells == 0 {
            self.radius = None;
            return;
        }
        let [x, y] = record.shift;
        larger(&mut self.shift, x.hypot(y) / equivalent_radius(record.contact_area));
        let radius = equivalent_radius(record.contact_cells as f64);
        if let Some(before) = self.radius {
            larger(&mut self.ring, (radius - before) / record.parts.max(1) as f64);
        }
        if self.first.is_none() {
            self.first = Some((radius / record.parts.max(1) as f64, record.stage));
        }
        self.radius = Some(radius);
        self.largest_radius = self.largest_radius.max(radius);
    }

    /// What the run's numbers tell: a concern once, with its worst number.
    pub fn warnings(&self, plan: &Plan) -> Vec<Warning> {
        let stage = |number: usize| plan.case.stages.get(number).map(|stage| stage.name.clone());
        let touching = || self.ends.iter().filter(|end| end.contact_area > 0.0);
        let rough = !plan.case.profile.heights.is_empty();
        let mut found = Vec::new();
        let mut look = |name: Concern, values: &mut dyn Iterator<Item = (f64, usize)>| {
            let worse = |a: f64, b: f64| if name.warns_below() { a < b } else { a > b };
            let worst = values.reduce(|most, next| if worse(next.0, most.0) { next } else { most });
            found.extend(worst.and_then(|(value, at)| Warning::of(name, value, stage(at))));
        };
        look(Concern::FewCells, &mut touching().filter_map(|end| Some((end.radius?, end.stage))));
        let radius = |end: &End| equivalent_radius(end.contact_area);
        look(
            Concern::ContactRadiusOverBodyRadius,
            &mut touching()
                .filter(|_| is_round(plan))
                .map(|end| (over_body(plan, [radius(end); 2]), end.stage)),
        );
        // On a rough surface the approach counts from the highest peak, and on a periodic half-space it has no zero.
        let strained = || touching().filter(|_| !rough && !plan.case.periodic);
        look(
            Concern::ApproachOverContactRadius,
            &mut strained().map(|end| (end.approach / radius(end), end.stage)),
        );
        look(
            Concern::ApproachOverLayerThickness,
            &mut strained().map(|end| (end.approach / layers_on_rigid_base(plan), end.stage)),
        );
        look(Concern::ShiftOverContactRadius, &mut self.shift.into_iter());
        look(Concern::SteepTopography, &mut std::iter::once((steepest(plan), usize::MAX)));
        let coating = thinnest_coating(plan);
        look(
            Concern::CoatingThinnerThanCell,
            &mut std::iter::once((coating / longer_side(plan), usize::MAX)),
        );
        let last = self.ends.last().map_or(usize::MAX, |end| end.stage);
        look(Concern::WearDepthOverCoatingThickness, &mut std::iter::once((self.worn_depth / coating, last)));
        if !plan.case.periodic {
            look(Concern::ContactNearEdge, &mut touching().map(|end| (end.free as f64, end.stage)));
        }
        if plan.coupling == Coupling::Coupled && !rough {
            // A first increment that makes half the contact is a ring like any other.
            let first = self.first.filter(|(radius, _)| *radius > 0.5 * self.largest_radius);
            look(Concern::PressingInFewIncrements, &mut self.ring.into_iter().chain(first));
        }
        found
    }
}

/// Radius of a circle of an area.
fn equivalent_radius(area: f64) -> f64 {
    (area / std::f64::consts::PI).sqrt()
}

/// Whether the profile is as curved along x as along y, so that the contact is about a circle.
fn is_round(plan: &Plan) -> bool {
    let [x, y] = plan.case.profile.curvatures();
    x > 0.0 && (x - y).abs() <= 0.5 * x.max(y)
}
