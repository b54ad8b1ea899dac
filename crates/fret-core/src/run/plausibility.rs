//! Whether the numbers of a case, and of its answer, can be meant. [`of_plan`] says what follows from the case alone, before any work;
//! [`Gauge`] follows a run and says what its numbers tell. Nothing here refuses anything.

use serde::{Deserialize, Serialize};

use super::rings::Rings;
use super::strides::Strides;
use crate::case::Path;
use crate::history::{Concern, CycleRecord, STIFFEST, StepRecord, Warning};
use crate::model::{Base, Body, BulkCompliance, Coating, Control, ElasticMaterial, Shape};
use crate::plan::{Plan, over_body};
use crate::units::Units;

/// What follows from the case alone, with the contact that its plan expects.
pub fn of_plan(plan: &Plan) -> Vec<Warning> {
    let mut found = Vec::new();
    let mut look = |name: Concern, value: f64| found.extend(Warning::of(name, value, None));
    if let Some(pascals) = plan.case.units.as_ref().and_then(Units::pascals) {
        look(Concern::StifferThanDiamond, largest_modulus(plan) * pascals / STIFFEST);
    }
    if let Some(contact) = &plan.expected {
        let [dx, dy] = plan.grid.spacing();
        let [x, y] = contact.half_widths;
        // A coarse grid has found them: what it cannot tell from the bound is left to the run.
        look(Concern::FewCells, 1.05 * (x / dx).min(y / dy));
        let radius = (x * y).sqrt();
        look(Concern::ContactRadiusOverBodyRadius, over_body(&plan.case, [x, y]));
        look(Concern::ApproachOverContactRadius, contact.approach / x.min(y));
        look(Concern::ApproachOverLayerThickness, contact.approach / layers_on_rigid_base(plan));
        if !plan.case.kinematics.is_finite() && !plan.case.rolls() {
            look(Concern::ShiftOverContactRadius, largest_shift(plan) / radius);
        }
    }
    look(Concern::SteepTopography, steepest(plan));
    look(Concern::CoatingThinnerThanCell, coating_where_stresses_are_asked(plan) / longer_side(plan));
    look(Concern::FewCellsPerWave, cells_per_wave(plan));
    look(Concern::BulkStrain, largest_bulk_strain(plan));
    found
}

/// As [`thinnest_coating`], where the case asks for stresses below; infinite where it does not, as displacements and tractions are
/// accurate on coatings however thin.
fn coating_where_stresses_are_asked(plan: &Plan) -> f64 {
    if plan.case.stress.is_some() { thinnest_coating(plan) } else { f64::INFINITY }
}

/// The largest Young's modulus of coatings and substrates [pressure].
fn largest_modulus(plan: &Plan) -> f64 {
    let of_body = |body: &Body| match body {
        Body::Rigid => 0.0,
        Body::Elastic(stack) => {
            let layers = stack.coatings().iter().map(Coating::material);
            let base = match stack.base() {
                Base::Rigid => None,
                Base::Elastic(material) => Some(material),
            };
            layers.chain(base).map(ElasticMaterial::young).fold(0.0, f64::max)
        }
    };
    of_body(plan.case.bodies.upper()).max(of_body(plan.case.bodies.lower()))
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
    crate::case::walk(plan.case.start.as_ref(), &plan.case.stages, |_, [_, x, y, _]| {
        let part = |control: &Option<Control>| match control {
            Some(Control::Motion(shift)) => *shift,
            _ => 0.0,
        };
        largest = largest.max(part(x).hypot(part(y)));
    });
    largest
}

/// Cells per wave along an axis, of the wave that has fewest; infinite where there is none.
fn cells_per_wave(plan: &Plan) -> f64 {
    let spacing = plan.grid.spacing();
    let waves = plan.case.profile.shapes.iter().filter_map(|shape| match shape {
        Shape::Wave { wavelengths, .. } => Some(wavelengths),
        _ => None,
    });
    let cells = |lengths: &[Option<f64>; 2]| {
        let along = |axis: usize| lengths[axis].map_or(f64::INFINITY, |length| length / spacing[axis]);
        along(0).min(along(1))
    };
    // The length of a cell is rounded.
    waves.map(cells).fold(f64::INFINITY, f64::min) * (1.0 + 1e-12)
}

/// Largest strain of a body by its bulk stress along x or y, over the ends of stages, of half a wave and of all rows of a table.
fn largest_bulk_strain(plan: &Plan) -> f64 {
    let compliance = BulkCompliance::of(&plan.case.bodies, plan.case.dimension());
    let largest = |path: &Path| match path {
        Path::To(stress) | Path::Wave { amplitude: stress, .. } => stress.abs(),
        Path::Through(stresses) => stresses.iter().fold(0.0_f64, |most, stress| most.max(stress.abs())),
    };
    let mut most = 0.0_f64;
    for stage in &plan.case.stages {
        for body in 0..2 {
            let mut stress = [[0.0; 2]; 2];
            stress[body] = [0, 1].map(|axis| {
                stage.bulk_stress[body][axis].as_ref().map_or(0.0, |control| largest(control.path()))
            });
            most = compliance
                .relative_strain(stress)
                .into_iter()
                .fold(most, |most, strain| most.max(strain.abs()));
        }
    }
    most
}

/// Root mean square slope of the steepest topography; 0 without any.
fn steepest(plan: &Plan) -> f64 {
    let [dx, dy] = plan.grid.spacing();
    let slope = |heights: &crate::model::Heights| {
        let depths = heights.depths();
        let (mut sum, mut count) = (0.0, 0_usize);
        for (row, next) in depths.rows().into_iter().zip(depths.rows().into_iter().skip(1)) {
            for ((here, along_x), along_y) in row.iter().zip(next).zip(row.iter().skip(1)) {
                sum += ((along_x - here) / dx).powi(2) + ((along_y - here) / dy).powi(2);
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
    /// Whether surfaces stay where they are, whatever the shift.
    stays: bool,
    /// Largest shift over contact radius, and its stage.
    shift: Option<(f64, usize)>,
    /// How the contact grows.
    rings: Rings,
    /// How far it goes.
    #[serde(default)]
    strides: Strides,
    worn_depth: f64,
    /// Largest relative change of friction in a single cycle, and its stage.
    friction_change: Option<(f64, usize)>,
    /// Largest spread of compliance over a contact that wears, and its stage.
    spread: Option<(f64, usize)>,
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
    /// Of a run that has yet to begin.
    pub fn of(plan: &Plan) -> Self {
        Self {
            rings: Rings::of(plan),
            strides: Strides::of(plan),
            stays: !plan.case.kinematics.is_finite() && !plan.case.rolls(),
            ..Self::default()
        }
    }

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
        self.rings.add(record);
        self.strides.add(record);
        if record.contact_cells > 0 && self.stays {
            let [x, y] = record.shift;
            larger(&mut self.shift, x.hypot(y) / equivalent_radius(record.contact_area));
        }
    }

    /// Reads a cycle.
    pub fn add_cycle(&mut self, record: &CycleRecord) {
        if let Some(spread) = record.compliance_spread
            && self.spread.is_none_or(|(most, _)| spread > most)
        {
            self.spread = Some((spread, record.stage));
        }
        let Some(change) = record.friction_change.filter(|_| record.stands_for == 1) else { return };
        let change = change / record.friction_coefficient;
        if change.is_finite() && self.friction_change.is_none_or(|(most, _)| change > most) {
            self.friction_change = Some((change, record.stage));
        }
    }

    /// What the run's numbers tell: a concern once, with its worst number.
    pub fn warnings(&self, plan: &Plan) -> Vec<Warning> {
        let stage = |number: usize| plan.case.stages.get(number).map(|stage| stage.name.clone());
        let touching = || self.ends.iter().filter(|end| end.contact_area > 0.0);
        let rough = !plan.case.profile.heights.is_empty();
        let mut found = Vec::new();
        let mut look = |name: Concern, values: &mut dyn Iterator<Item = (f64, usize)>| {
            let worse = |a: f64, b: f64| if name.row().warns_below { a < b } else { a > b };
            let worst = values.reduce(|most, next| if worse(next.0, most.0) { next } else { most });
            found.extend(worst.and_then(|(value, at)| Warning::of(name, value, stage(at))));
        };
        look(Concern::FewCells, &mut touching().filter_map(|end| Some((end.radius?, end.stage))));
        let radius = |end: &End| equivalent_radius(end.contact_area);
        look(
            Concern::ContactRadiusOverBodyRadius,
            &mut touching()
                .filter(|_| is_round(plan))
                .map(|end| (over_body(&plan.case, [radius(end); 2]), end.stage)),
        );
        // On a rough surface the approach counts from the highest peak, and on a periodic half-space it has no zero.
        let strained = || touching().filter(|_| !rough && plan.case.periodic.is_none());
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
        look(Concern::FewCellsPerWave, &mut std::iter::once((cells_per_wave(plan), usize::MAX)));
        look(Concern::BulkStrain, &mut std::iter::once((largest_bulk_strain(plan), usize::MAX)));
        let coating = thinnest_coating(plan);
        look(
            Concern::CoatingThinnerThanCell,
            &mut std::iter::once((coating_where_stresses_are_asked(plan) / longer_side(plan), usize::MAX)),
        );
        let last = self.ends.last().map_or(usize::MAX, |end| end.stage);
        if plan.case.wear.as_ref().is_none_or(|wear| wear.thinning_tolerance.is_none()) {
            let worn = self.worn_depth / coating;
            look(Concern::WearDepthOverCoatingThickness, &mut std::iter::once((worn, last)));
        }
        look(Concern::ComplianceSpread, &mut self.spread.into_iter());
        look(Concern::FrictionChangesInOneCycle, &mut self.friction_change.into_iter());
        if !plan.case.periodic.is_both() && plan.case.beyond.is_body() {
            look(Concern::ContactNearEdge, &mut touching().map(|end| (end.free as f64, end.stage)));
        }
        found.extend(self.rings.warning(plan));
        found.extend(self.strides.warning(plan));
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

#[cfg(test)]
mod tests;
