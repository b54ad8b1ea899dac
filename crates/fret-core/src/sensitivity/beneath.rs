//! The body below the surface of a history that was solved, and where numbers of the stress in it are largest.

use std::ops::RangeInclusive;

use super::error::SensitivityError;
use super::snapshot::Snapshot;
use crate::case::{Side, StressRequest};
use crate::machine::memory;
use crate::model::{Body, HalfSpace, MirroredState, Periodicity, SurfaceGrid};
use crate::plan::{Plan, memory_of_stress};
use crate::run::RunError;
use crate::subsurface::fatigue::{self, LayerConstants, Ruiz};
use crate::subsurface::largest::look;
use crate::subsurface::{
    AUTOMATIC, DepthPoint, EvenStress, Largest, LoadedSurface, Measure, Severity, Tractions,
    automatic_depths, depth_points, reach, survey,
};
use fret_fft::ConvolutionError;

/// A number of the stress.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Number {
    /// The largest value of a measure in an increment.
    Measure { measure: Measure, increment: usize },
    /// The largest value of a fatigue parameter over a cycle, whose increments are given.
    Fatigue { parameter: fatigue::Parameter, increments: RangeInclusive<usize> },
    /// The largest of Ruiz's parameters at the surface over a cycle, the second with the tension.
    Ruiz { with_tension: bool, increments: RangeInclusive<usize> },
}

/// The body whose stress is asked for, as for `fret stress`: what the case says, or else the lower one that is not rigid.
pub(super) fn side_of(plan: &Plan) -> Side {
    let case = &plan.case;
    match &case.stress {
        Some(request) => request.body,
        None if *case.bodies.lower() == Body::Rigid => Side::Upper,
        None => Side::Lower,
    }
}

/// Constants for fatigue of the layers of a body.
pub(super) fn constants_for_fatigue(plan: &Plan, side: Side) -> LayerConstants {
    let request = plan.case.stress.clone().unwrap_or_default();
    plan.case.fatigue[usize::from(side == Side::Upper)].clone().or(request.fatigue)
}

/// The body below the surface of a history.
pub(super) struct Beneath<'a> {
    pub plan: &'a Plan,
    pub side: Side,
    pub half_space: &'a HalfSpace,
    pub constants: LayerConstants,
    points: Vec<DepthPoint>,
    /// How deep depths were chosen down to; `None` where they are given.
    pub reach: Option<f64>,
    /// Increments that are asked for, rising, and what acts on the surface in them.
    pub surfaces: Vec<LoadedSurface>,
}

/// Where a number is largest.
pub(super) struct Found {
    pub value: f64,
    pub point: DepthPoint,
    pub cell: [usize; 2],
    /// Whether it may be the value at a rim of the contact beside the cell.
    pub at_rim: bool,
}

pub(super) fn failed(error: ConvolutionError) -> SensitivityError {
    SensitivityError::Operators(format!("stress kernels: {error}"))
}

impl Number {
    /// The increments that it is made of.
    pub fn increments(&self) -> RangeInclusive<usize> {
        match self {
            Self::Measure { increment, .. } => *increment..=*increment,
            Self::Fatigue { increments, .. } | Self::Ruiz { increments, .. } => increments.clone(),
        }
    }
}

impl<'a> Beneath<'a> {
    /// That of the increments that numbers are asked of; `None` where it is rigid.
    pub fn of(
        plan: &'a Plan,
        increments: &[&Snapshot],
        numbers: &[(String, Number)],
    ) -> Result<Option<Self>, SensitivityError> {
        let side = side_of(plan);
        let Body::Elastic(half_space) = side.of(&plan.case.bodies) else { return Ok(None) };
        let symmetry = plan.symmetry;
        let most =
            increments.iter().map(|step| step.pressed().count()).max().unwrap_or(0) * symmetry.copies();
        let deepest = reach(&plan.grid, plan.case.periodic, most);
        let request: Option<&StressRequest> = plan.case.stress.as_ref();
        let (points, reach) = match request.and_then(|request| request.depths.as_ref()) {
            Some(depths) => (depth_points(half_space, depths).unwrap_or_default(), None),
            None => (automatic_depths(half_space, deepest, AUTOMATIC), Some(deepest)),
        };
        let is_asked = |increment: usize| numbers.iter().any(|(_, of)| of.increments().contains(&increment));
        let asked = increments.iter().copied().enumerate().filter(|(increment, _)| is_asked(*increment));
        let bytes = memory_of_stress(plan.grid.len(), asked.clone().count());
        memory::check(bytes).map_err(|error| RunError::OutOfMemory { increment: 0, error })?;
        let sign = if side == Side::Lower { 1.0 } else { -1.0 };
        let body = usize::from(side == Side::Upper);
        let surface = |(increment, step): (usize, &Snapshot)| {
            let part = step.state();
            let whole = MirroredState { part: &part, symmetry }.whole();
            let shear = [0, 1].map(|axis| &whole.shear[axis] * sign);
            LoadedSurface {
                increment,
                pressure: whole.pressure.clone(),
                shear: (!plan.case.is_frictionless()).then_some(shear),
                slip: step.slip.is_some().then(|| whole.slip.clone()),
                even: EvenStress {
                    bulk: part.bulk_stress[body],
                    residual: plan.case.residual_stress[body].clone(),
                },
            }
        };
        let surfaces = asked.map(surface).collect();
        let constants = constants_for_fatigue(plan, side);
        Ok(Some(Self { plan, side, half_space, constants, points, reach, surfaces }))
    }

    pub fn grid(&self) -> (&SurfaceGrid, Periodicity) {
        (&self.plan.grid, self.plan.case.periodic)
    }

    /// What acts on a surface.
    pub fn tractions(&self, surface: usize) -> Tractions<'_> {
        let LoadedSurface { pressure, shear, .. } = &self.surfaces[surface];
        Tractions {
            pressure: pressure.view(),
            shear: shear.as_ref().map(|shear| shear.each_ref().map(|component| component.view())),
        }
    }

    /// Indices of the surfaces of some increments.
    pub fn surfaces_of(&self, increments: &RangeInclusive<usize>) -> Vec<usize> {
        let is_in = |surface: &LoadedSurface| increments.contains(&surface.increment);
        (0..self.surfaces.len()).filter(|&index| is_in(&self.surfaces[index])).collect()
    }

    /// Where the numbers are largest; `None` of those of interfaces where there is none.
    pub fn largest(&self, numbers: &[(String, Number)]) -> Result<Vec<Option<Found>>, SensitivityError> {
        let interfaces = self.half_space.interfaces();
        let mut of_surfaces: Vec<Option<Vec<Largest>>> = self
            .surfaces
            .iter()
            .map(|surface| {
                let is_of = |(_, of): &(String, Number)| {
                    matches!(of, Number::Measure { increment, .. } if *increment == surface.increment)
                };
                numbers.iter().any(is_of).then(Vec::new)
            })
            .collect();
        let mut of_cycles: Vec<Option<Severity<'_>>> = numbers
            .iter()
            .map(|(_, number)| {
                let parameters = match number {
                    Number::Measure { .. } => return None,
                    Number::Fatigue { parameter, .. } => &[*parameter][..],
                    Number::Ruiz { .. } => &[],
                };
                let cycle = (&self.surfaces[..], self.surfaces_of(&number.increments()));
                let row = Some(self.plan.grid.cells()[1] / 2);
                let severity = Severity::new(self.half_space, &self.constants, &self.points, cycle, row);
                Some(severity.only(parameters))
            })
            .collect();
        let (grid, periodic) = self.grid();
        survey(self.half_space, grid, periodic, &self.points, &self.surfaces, |point, surface, field| {
            let place = self.points[point];
            let loaded = &self.surfaces[surface];
            if let Some(found) = &mut of_surfaces[surface] {
                let pressure = (place.depth == 0.0).then_some(&loaded.pressure);
                look(found, field, place, interfaces.contains(&place.depth), loaded.increment, pressure);
            }
            for severity in of_cycles.iter_mut().flatten() {
                severity.look(point, surface, field);
            }
            true
        })
        .map_err(failed)?;
        let of = |((_, number), severity): (&(String, Number), Option<Severity<'_>>)| match number {
            Number::Measure { measure, increment } => {
                let surface = self.surfaces.iter().position(|surface| surface.increment == *increment)?;
                let found = of_surfaces[surface].as_ref()?;
                let found = found.iter().find(|found| found.measure == *measure)?;
                let at_rim = *measure == Measure::Tension && found.point.depth == 0.0;
                Some(Found { value: found.value, point: found.point, cell: found.cell, at_rim })
            }
            Number::Fatigue { .. } => {
                let found = severity?.judged().found;
                let most = found
                    .into_iter()
                    .reduce(|most, next| if next.value > most.value { next } else { most })?;
                let at_rim = most.value != most.of_cells;
                Some(Found { value: most.value, point: most.point, cell: most.cell, at_rim })
            }
            Number::Ruiz { with_tension, .. } => {
                let of = |ruiz: &Ruiz| if *with_tension { ruiz.f2 } else { ruiz.f1 };
                let ruiz = severity?.judged().ruiz?;
                let (value, cell) = ruiz.indexed_iter().fold((0.0, [0, 0]), |most, ((i, j), ruiz)| {
                    if of(ruiz) > most.0 { (of(ruiz), [i, j]) } else { most }
                });
                let point = *self.points.iter().find(|point| point.depth == 0.0)?;
                Some(Found { value, point, cell, at_rim: false })
            }
        };
        Ok(numbers.iter().zip(of_cycles).map(of).collect())
    }
}
