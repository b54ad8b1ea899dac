//! Numbers of the stress below the surface as results: how the largest value changes with the tractions of the increments, and with the constants of
//! the body beside these. The place counts for nothing: about the largest value a number does not change with it.

use ndarray::Array2;

use super::beneath::{Beneath, Found, Number, failed};
use super::bodies::changes_of;
use super::case_number::{BodyNumber, ResidualNumber};
use super::error::SensitivityError;
use super::field_weights::FieldWeights;
use super::parameter::Parameter;
use super::row::{Column, Composed};
use super::scene::Scene;
use crate::case::{Side, Stage};
use crate::fields::dot;
use crate::model::controls::{BULK_STRESS, UPPER_BULK_STRESS};
use crate::model::{bulk_stress_in_layer, slopes_of_bulk_stress_in_layer};
use crate::subsurface::rim::{RimSlopes, of_rim};
use crate::subsurface::severity::{constants_of, material_of};
use crate::subsurface::{DepthOperator, StressField, StressTensor, Tractions, change_of_stress, deeper};

/// The largest value of a number, with the stresses that make it.
pub(super) struct Largest<'a> {
    pub beneath: &'a Beneath<'a>,
    pub found: Found,
    operator: DepthOperator,
    /// Surfaces of the increments that it is made of.
    pub surfaces: Vec<usize>,
    /// Cells whose stresses it is made of: its derivatives by each, increment by increment.
    pub cells: Vec<([usize; 2], Vec<StressTensor>)>,
    /// Cells whose pressures it is made of: number of the surface, cell, derivative.
    pressures: Vec<(usize, [usize; 2], f64)>,
    /// Derivatives by Young's modulus and Poisson's ratio of the layer.
    by_material: [f64; 2],
}

impl<'a> Largest<'a> {
    /// The place, with the stresses at its depth increment by increment; nothing counts yet.
    pub fn at(
        beneath: &'a Beneath<'a>,
        number: &Number,
        found: Found,
    ) -> Result<(Self, Vec<StressField>), SensitivityError> {
        let (half_space, (grid, periodic)) = (beneath.half_space, beneath.grid());
        let surfaces = beneath.surfaces_of(&number.increments());
        let with_shear = !beneath.plan.case.is_frictionless();
        let operator = DepthOperator::new(half_space, found.point, grid, periodic, with_shear, false);
        let mut operator = operator.map_err(failed)?;
        let fields = surfaces
            .iter()
            .map(|&surface| {
                let mut field = operator.stress(&beneath.tractions(surface));
                field.add(beneath.surfaces[surface].even.at(half_space, found.point, grid.dimension()));
                field
            })
            .collect();
        let (cells, pressures, by_material) = (Vec::new(), Vec::new(), [0.0; 2]);
        Ok((Self { beneath, found, operator, surfaces, cells, pressures, by_material }, fields))
    }

    pub fn of(beneath: &'a Beneath<'a>, number: &Number, found: Found) -> Result<Self, SensitivityError> {
        let (largest, fields) = Self::at(beneath, number, found)?;
        let (half_space, Self { found, surfaces, .. }) = (beneath.half_space, &largest);
        let at =
            |[i, j]: [usize; 2]| -> Vec<StressTensor> { fields.iter().map(|field| field.at(i, j)).collect() };
        let material = material_of(half_space, found.point.layer);
        let constants = constants_of(half_space, &beneath.constants, found.point.layer);
        let value = |cell: [usize; 2]| match number {
            Number::Measure { measure, .. } => measure.of(&at(cell)[0]),
            Number::Fatigue { parameter, .. } => {
                let found = material.and_then(|material| parameter.of(&at(cell), &material, &constants));
                found.map_or(0.0, |found| found.value)
            }
            Number::Ruiz { .. } => 0.0,
        };
        let beside = |surface: &usize| {
            let pressure = &beneath.surfaces[*surface].pressure;
            Some((*surface, of_rim(value, pressure, (found.cell, found.value))?))
        };
        let rim = if found.at_rim { surfaces.iter().find_map(beside) } else { None };
        let (made_of, pressures) = match rim {
            None => (vec![(found.cell, 1.0)], Vec::new()),
            Some((surface, RimSlopes { by_values, by_pressures })) => {
                let by = by_pressures.into_iter().map(|(cell, by)| (surface, cell, by));
                (by_values, by.collect())
            }
        };
        let mut by_material = [0.0; 2];
        let mut slopes = |(cell, factor): ([usize; 2], f64)| {
            let cycle = at(cell);
            let by_stress = match number {
                Number::Measure { measure, .. } => vec![measure.slopes(&cycle[0])],
                Number::Fatigue { parameter, .. } => {
                    let slopes = material.and_then(|material| {
                        let here = parameter.of(&cycle, &material, &constants)?;
                        parameter.slopes(&cycle, (&material, &constants), &here)
                    });
                    let Some(slopes) = slopes else {
                        return (cell, vec![StressTensor::default(); cycle.len()]);
                    };
                    for (sum, by) in by_material.iter_mut().zip(slopes.by_material) {
                        *sum += factor * by;
                    }
                    slopes.by_stress
                }
                Number::Ruiz { .. } => vec![StressTensor::default(); cycle.len()],
            };
            (cell, by_stress.into_iter().map(|by| StressTensor(by.0.map(|part| factor * part))).collect())
        };
        let cells = made_of.into_iter().map(&mut slopes).collect();
        Ok(Self { cells, pressures, by_material, ..largest })
    }

    pub fn differentiated(
        mut self,
        scene: &Scene<'_>,
        parameters: &[Parameter],
    ) -> Result<Composed, SensitivityError> {
        let mut columns = Vec::new();
        for (place, surface) in self.surfaces.clone().into_iter().enumerate() {
            let increment = self.beneath.surfaces[surface].increment;
            for (field, weights) in self.by_tractions(place, surface).iter().enumerate() {
                let weights = FieldWeights::of(field, weights, scene.plan).in_region(scene);
                columns.push((increment, Column::Field(weights), 1.0));
            }
            if scene.plan.case.stages.iter().any(Stage::stretches) {
                columns.push((increment, Column::Bulk(self.first_stress(), self.by_bulk(place)), 1.0));
            }
        }
        let of_upper = self.beneath.side == Side::Upper;
        let by = parameters.iter().map(|parameter| match (parameter.of_body(), parameter.of_residual()) {
            (Some(number), _) if number.of_upper == of_upper => self.by_constant(number),
            (_, Some(number)) if number.of_upper == of_upper => Ok(self.by_residual(number)),
            _ => Ok(0.0),
        });
        Ok(Composed { value: self.found.value, columns, by: by.collect::<Result<_, _>>()? })
    }

    /// Derivatives by pressure and shear on all cells in one of the increments.
    fn by_tractions(&mut self, place: usize, surface: usize) -> Vec<Array2<f64>> {
        let Self { beneath, operator, cells, pressures, .. } = self;
        let [rows, columns] = beneath.plan.grid.cells();
        let fields = if beneath.plan.case.is_frictionless() { 1 } else { 3 };
        let mut sums = vec![Array2::zeros((rows, columns)); fields];
        for (cell, by) in cells.iter().filter(|(_, by)| by[place] != StressTensor::default()) {
            for (sum, by) in sums.iter_mut().zip(operator.by_tractions(*cell, &by[place])) {
                *sum += &by;
            }
        }
        for (_, cell, by) in pressures.iter().filter(|(of, ..)| *of == surface) {
            sums[0][*cell] += by;
        }
        if beneath.side == Side::Upper {
            sums[1..].iter_mut().for_each(|sum| sum.mapv_inplace(|by| -by));
        }
        sums
    }

    /// The degree of freedom of the bulk stress of the body along x.
    fn first_stress(&self) -> usize {
        if self.beneath.side == Side::Upper { UPPER_BULK_STRESS } else { BULK_STRESS }
    }

    /// Derivatives by the bulk stress of the body along x and y in one of the increments, beside what it does to the tractions.
    fn by_bulk(&self, place: usize) -> [f64; 2] {
        let Self { beneath, found, .. } = self;
        let (grid, _) = beneath.grid();
        [[1.0, 0.0], [0.0, 1.0]].map(|unit| {
            let stress = bulk_stress_in_layer(beneath.half_space, found.point.layer, unit, grid.dimension());
            self.by_even_stress(place, stress)
        })
    }

    /// What a stress along x and y in all cells alike changes of the number, in one of the increments.
    fn by_even_stress(&self, place: usize, [xx, yy]: [f64; 2]) -> f64 {
        let even = StressTensor([xx, yy, 0.0, 0.0, 0.0, 0.0]);
        self.cells.iter().map(|(_, by)| by[place].times(&even)).sum()
    }

    /// The derivative by a residual stress, which moves no surface.
    fn by_residual(&self, number: ResidualNumber) -> f64 {
        let Self { beneath, found, surfaces, .. } = self;
        let residual = &beneath.surfaces[surfaces[0]].even.residual;
        if residual.named(beneath.half_space, found.point.layer) != Some(number.named) {
            return 0.0;
        }
        let along = number.along.map(|acts| f64::from(u8::from(acts)));
        (0..surfaces.len()).map(|place| self.by_even_stress(place, along)).sum()
    }

    /// The derivative by a constant of the body while the tractions stay.
    fn by_constant(&self, number: BodyNumber) -> Result<f64, SensitivityError> {
        let Self { beneath, found, cells, surfaces, .. } = self;
        let (half_space, point) = (beneath.half_space, found.point);
        let changes = changes_of(half_space, number);
        let coatings = half_space.coatings().len();
        let thicker: Vec<f64> = changes[..coatings].iter().map(|layer| layer.thickness).collect();
        let lower = deeper(half_space, point, beneath.reach, &thicker);
        let tractions: Vec<Tractions<'_>> =
            surfaces.iter().map(|&surface| beneath.tractions(surface)).collect();
        let of_layer = changes[point.layer.min(coatings)];
        let mut sum = self.by_material[0] * of_layer.young + self.by_material[1] * of_layer.poisson;
        let in_layer = lower - thicker[..point.layer.min(coatings)].iter().sum::<f64>();
        let residual = &beneath.surfaces[surfaces[0]].even.residual;
        let [xx, yy] = residual.slope(half_space, point.layer, point.depth).map(|slope| slope * in_layer);
        let even = StressTensor([xx, yy, 0.0, 0.0, 0.0, 0.0]);
        let scene = beneath.grid();
        let base = changes[coatings];
        let inputs = [base.young, base.poisson, of_layer.young, of_layer.poisson];
        for (place, &surface) in surfaces.iter().enumerate() {
            let bulk = beneath.surfaces[surface].even.bulk;
            let slopes = slopes_of_bulk_stress_in_layer(half_space, point.layer, bulk, scene.0.dimension());
            sum += self.by_even_stress(place, slopes.map(|by| dot(&by, &inputs)));
        }
        change_of_stress((half_space, &changes), (point, lower), scene, &tractions, |place, field| {
            for ([i, j], by) in cells {
                sum += by[place].times(&field.at(*i, *j)) + by[place].times(&even);
            }
        })
        .map_err(failed)?;
        Ok(sum)
    }
}
