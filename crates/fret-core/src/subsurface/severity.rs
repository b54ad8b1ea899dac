//! How severe a cycle is at every cell and depth: parameters of fatigue, their largest values with places, means over the critical
//! distance.

use std::cell::RefCell;

use ndarray::Array2;
use serde::Serialize;

use super::at_depth::{AtDepth, bounds_of, cycle_at};
use super::critical_distance::{AtDistance, Distances};
use super::depths::DepthPoint;
use super::fatigue::{FatigueConstants, LayerConstants, Parameter, Ruiz, SurfacePoint, ruiz};
use super::largest::along_lines;
use super::survey::LoadedSurface;
use super::tensor::StressField;
use crate::model::{Base, Coating, ElasticMaterial, HalfSpace};

/// The largest value of a parameter in one layer, and where.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MostSevere {
    /// Which parameter.
    pub parameter: Parameter,
    /// Its value.
    pub value: f64,
    /// Unit normal of the critical plane, where it has one; of a rim that of the cell beside it.
    pub normal: Option<[f64; 3]>,
    /// Cell `[i, j]`.
    pub cell: [usize; 2],
    /// Place relative to its centre [cells]: zero but at a rim.
    pub off: [f64; 2],
    /// Depth and layer.
    pub point: DepthPoint,
    /// Cycles to initiation, where the layer's constants tell them; infinite above 1e18.
    pub cycles: Option<f64>,
    /// Factor of safety, where the layer's constants tell it.
    pub factor_of_safety: Option<f64>,
    /// Its largest value under the centres of cells at that depth: the value itself but at a rim, to which that is extrapolated.
    pub of_cells: f64,
    /// Cycles to initiation at that value.
    pub cycles_of_cells: Option<f64>,
}

/// Values of a parameter at the points of a body; `None` where its constants are not given.
pub type Values<T> = Vec<(Parameter, Vec<Option<T>>)>;

/// Collects the stresses of a cycle depth by depth, and judges them.
pub struct Severity<'a> {
    half_space: &'a HalfSpace,
    points: &'a [DepthPoint],
    surfaces: &'a [LoadedSurface],
    constants: &'a LayerConstants,
    /// Indices of the surfaces of the cycle.
    cycle: Vec<usize>,
    /// Row of cells along x whose values are kept at all depths; all rows where `None`.
    row: Option<usize>,
    /// Stresses of the depth at hand, one field an increment of the cycle.
    here: Vec<StressField>,
    found: Vec<MostSevere>,
    /// The same at the surface alone.
    at_surface: Vec<MostSevere>,
    fields: Values<Array2<f64>>,
    distances: Option<Distances>,
    ruiz: Option<Array2<Ruiz>>,
}

/// What is known at the end.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The largest values, one for each parameter and layer.
    pub found: Vec<MostSevere>,
    /// The largest values at the surface, one for each parameter.
    pub at_surface: Vec<MostSevere>,
    /// Values at the points, of one row of cells `(nx, 1)` or of all `(nx, ny)`.
    pub fields: Values<Array2<f64>>,
    /// Values by the theory of critical distances, of the parameters of the outermost layer.
    pub at_distance: Vec<(Parameter, AtDistance)>,
    /// Ruiz's parameters at the surface, shape `(nx, ny)`, where it was among the depths and its slip is known.
    pub ruiz: Option<Array2<Ruiz>>,
}

impl<'a> Severity<'a> {
    /// Nothing collected yet. Values are kept of one row of cells, of all where `row` is `None`.
    pub fn new(
        half_space: &'a HalfSpace,
        constants: &'a LayerConstants,
        points: &'a [DepthPoint],
        (surfaces, cycle): (&'a [LoadedSurface], Vec<usize>),
        row: Option<usize>,
    ) -> Self {
        let from_surface = points.first().is_some_and(|point| point.depth == 0.0)
            && points.windows(2).all(|pair| pair[0].depth <= pair[1].depth);
        let outermost = constants_of(half_space, constants, 0);
        let distances = outermost.critical_distance.filter(|_| from_surface).map(Distances::new);
        Self {
            half_space,
            points,
            surfaces,
            constants,
            cycle,
            row,
            here: Vec::new(),
            found: Vec::new(),
            at_surface: Vec::new(),
            fields: Parameter::ALL.map(|parameter| (parameter, Vec::new())).to_vec(),
            distances,
            ruiz: None,
        }
    }

    /// The same by some of the parameters alone.
    #[must_use]
    pub fn only(mut self, parameters: &[Parameter]) -> Self {
        self.fields.retain(|(parameter, _)| parameters.contains(parameter));
        self
    }

    /// Takes the stress at one depth in one increment: at each depth all increments of the cycle, in its order, before the next depth.
    pub fn look(&mut self, point: usize, surface: usize, field: &StressField) {
        let Some(place) = self.cycle.iter().position(|&index| index == surface) else { return };
        match self.here.get_mut(place) {
            Some(kept) => kept.copy_from(field),
            None => self.here.push(field.clone()),
        }
        if place + 1 == self.cycle.len() {
            self.judge(point);
        }
    }

    fn judge(&mut self, point: usize) {
        let place = self.points[point];
        let material = material_of(self.half_space, place.layer);
        let constants = constants_of(self.half_space, self.constants, place.layer);
        let is_surface = place.depth == 0.0;
        let bounds = material.map_or_else(Vec::new, |material| bounds_of(&self.here, &material));
        let beside_rims = if is_surface { self.beside_rims() } else { Vec::new() };
        for index in 0..self.fields.len() {
            let parameter = self.fields[index].0;
            let (Some(material), true) = (material, parameter.is_given(&constants)) else {
                self.fields[index].1.push(None);
                continue;
            };
            let wanted = |distances: &Distances| distances.want(parameter, place.depth);
            let exactly = self.row.is_none() || self.distances.as_ref().is_some_and(wanted);
            let known = self.known(parameter, place.layer).map_or(f64::NEG_INFINITY, |found| found.value);
            let look = AtDepth { parameter, material, constants, bounds: &bounds };
            let values;
            if exactly || is_surface {
                let all = look.everywhere(&self.here, |cell| exactly || beside_rims[cell]);
                if let Some(distances) = &mut self.distances {
                    distances.take(parameter, place.depth, &all);
                }
                self.note_largest(&look, &all, place);
                values = match self.row {
                    Some(row) => look.in_row(&self.here, row),
                    None => all,
                };
            } else {
                let row = self.row.unwrap_or(0);
                values = look.in_row(&self.here, row);
                let in_row = values.iter().copied().fold(known, f64::max);
                if let Some((cell, value)) = look.largest(&self.here, in_row) {
                    self.note(&look, [value; 2], (cell, [0.0; 2]), place);
                } else if in_row > known
                    && let Some(i) = values.iter().position(|value| *value == in_row)
                {
                    self.note(&look, [in_row; 2], ([i, row], [0.0; 2]), place);
                }
            }
            self.fields[index].1.push(Some(values));
        }
        if is_surface {
            self.ruiz = self.ruiz_of_surface();
        }
    }

    /// Which cells the values at rims are found from, in any increment of the cycle; row by row.
    fn beside_rims(&self) -> Vec<bool> {
        let (nx, ny) = self.here.first().map_or((0, 0), |field| field.components[0].dim());
        let cells = RefCell::new(vec![false; nx * ny]);
        for &surface in &self.cycle {
            let note = |[i, j]: [usize; 2]| {
                cells.borrow_mut()[i * ny + j] = true;
                0.0
            };
            along_lines(note, &self.surfaces[surface].pressure);
        }
        cells.into_inner()
    }

    fn known(&self, parameter: Parameter, layer: usize) -> Option<&MostSevere> {
        self.found.iter().find(|found| found.parameter == parameter && found.point.layer == layer)
    }

    /// Notes the largest of a whole field, at the surface also that of the rims which the contact has in the cycle.
    fn note_largest(&mut self, look: &AtDepth, values: &Array2<f64>, place: DepthPoint) {
        let mut best: Option<(f64, [usize; 2], [f64; 2])> = None;
        for ((i, j), &value) in values.indexed_iter() {
            if best.is_none_or(|(most, ..)| value > most) {
                best = Some((value, [i, j], [0.0; 2]));
            }
        }
        let of_cells = best.map_or(0.0, |(value, ..)| value);
        if place.depth == 0.0 {
            for &surface in &self.cycle {
                for rim in along_lines(|cell| values[cell], &self.surfaces[surface].pressure) {
                    if best.is_none_or(|(most, ..)| rim.0 > most) {
                        best = Some(rim);
                    }
                }
            }
        }
        if let Some((value, cell, off)) = best {
            self.note(look, [value, of_cells], (cell, off), place);
        }
    }

    /// Notes a value, and the largest one of the cells.
    fn note(
        &mut self,
        look: &AtDepth,
        [value, of_cells]: [f64; 2],
        (cell, off): ([usize; 2], [f64; 2]),
        point: DepthPoint,
    ) {
        let cycle = cycle_at(&self.here, cell);
        let normal =
            look.parameter.of(&cycle, &look.material, &look.constants).and_then(|found| found.normal);
        let found = MostSevere {
            parameter: look.parameter,
            value,
            normal,
            cell,
            off,
            point,
            cycles: look.parameter.cycles(value, &look.material, &look.constants),
            of_cells,
            cycles_of_cells: look.parameter.cycles(of_cells, &look.material, &look.constants),
            factor_of_safety: look.parameter.factor_of_safety(value, &look.constants),
        };
        if point.depth == 0.0 {
            self.at_surface.push(found);
        }
        let same =
            |known: &&mut MostSevere| known.parameter == look.parameter && known.point.layer == point.layer;
        match self.found.iter_mut().find(same) {
            Some(known) if value > known.value => *known = found,
            Some(_) => {}
            None => self.found.push(found),
        }
    }

    fn ruiz_of_surface(&self) -> Option<Array2<Ruiz>> {
        let surfaces: Vec<&LoadedSurface> = self.cycle.iter().map(|&index| &self.surfaces[index]).collect();
        if surfaces.iter().any(|surface| surface.shear.is_none() || surface.slip.is_none()) {
            return None;
        }
        let shape = self.here.first()?.components[0].dim();
        Some(Array2::from_shape_fn(shape, |(i, j)| {
            let at = |(surface, field): (&&LoadedSurface, &StressField)| {
                let of = |pair: &Option<[Array2<f64>; 2]>| {
                    pair.as_ref().map_or([0.0; 2], |[x, y]| [x[[i, j]], y[[i, j]]])
                };
                SurfacePoint { shear: of(&surface.shear), slip: of(&surface.slip), stress: field.at(i, j) }
            };
            ruiz(&surfaces.iter().zip(&self.here).map(at).collect::<Vec<_>>())
        }))
    }

    /// All that is known.
    pub fn judged(self) -> Judged {
        Judged {
            found: self.found,
            at_surface: self.at_surface,
            fields: self.fields,
            at_distance: self.distances.map_or_else(Vec::new, Distances::found),
            ruiz: self.ruiz,
        }
    }
}

/// The material of a layer; `None` in a rigid base.
pub fn material_of(half_space: &HalfSpace, layer: usize) -> Option<ElasticMaterial> {
    let coating = half_space.coatings().get(layer).map(|coating| *coating.material());
    coating.or(match half_space.base() {
        Base::Elastic(material) => Some(*material),
        Base::Rigid => None,
    })
}

/// Constants of a layer of the half-space.
pub fn constants_of(half_space: &HalfSpace, constants: &LayerConstants, layer: usize) -> FatigueConstants {
    let above: f64 = half_space.coatings().iter().take(layer).map(Coating::thickness).sum();
    let middle = half_space.coatings().get(layer).map_or(f64::INFINITY, |own| above + 0.5 * own.thickness());
    constants.at(middle)
}
