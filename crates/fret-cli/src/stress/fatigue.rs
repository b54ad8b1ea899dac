//! Fatigue over the last cycle, under all cells at all depths: parameters, cycles to initiation, factors of safety; fracture of the coating.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use fret_core::subsurface::coating_fracture::Film;
use fret_core::subsurface::fatigue::Parameter;
use fret_core::subsurface::film_stress::{FilmCrack, FilmStress};
use fret_core::subsurface::severity::{constants_of, material_of};
use fret_core::subsurface::{Judged, LoadedSurface, MostSevere, Severity, StressField};

use super::below::Below;
use super::crack::{CrackAnswer, followed};
use super::record::{AtDistance, Bounded, CriticalDistance, FatigueRecord, FilmRecord, ParameterRecord};

use crate::failure::Failure;

use crate::table::Columns;

/// Collects what fatigue is judged by, one depth at a time.
pub struct Fatigue<'a> {
    below: Below<'a>,
    /// Indices of the surfaces of the cycle; none where the history has no whole cycle.
    cycle: Vec<usize>,
    severity: Option<Severity<'a>>,
    film: Option<FilmStress>,
}

/// A name and its values `[point][i]`.
pub type Picture = (String, Vec<Vec<f64>>);

/// What is told at the end.
#[derive(Default)]
pub struct Finished {
    /// Fatigue, for `stress.json`.
    pub fatigue: Option<FatigueRecord>,
    /// Fracture of the coating, for `stress.json`.
    pub coating: Option<Vec<FilmRecord>>,
    /// For a person.
    pub table: String,
    /// To be drawn.
    pub pictures: Vec<Picture>,
    /// Files: name and content.
    pub files: Vec<(&'static str, String)>,
}

impl<'a> Fatigue<'a> {
    /// Nothing collected yet; `cycle` are the surfaces of the last cycle, three at least.
    pub fn new(below: Below<'a>, cycle: Vec<usize>, row: usize) -> Self {
        let Below { half_space, constants, points, surfaces, .. } = below;
        let severity = (cycle.len() > 2)
            .then(|| Severity::new(half_space, constants, points, (surfaces, cycle.clone()), Some(row)));
        let film = Film::outermost(half_space).map(FilmStress::new);
        Self { below, cycle, severity, film }
    }

    /// Takes the stress at one depth in one increment.
    pub fn look(&mut self, point: usize, surface: usize, field: &StressField) {
        if let Some(severity) = &mut self.severity {
            severity.look(point, surface, field);
        }
        if let Some(film) = &mut self.film {
            film.look(self.below.points[point], surface, field);
        }
    }

    /// The largest values and where, the crack, the coating; what was collected is used up.
    pub fn finished(&mut self) -> Result<Finished, Failure> {
        let mut finished = Finished::default();
        self.coating(&mut finished);
        if let Some(severity) = self.severity.take() {
            let judged = severity.judged();
            self.parameters(&judged, &mut finished)?;
        }
        Ok(finished)
    }

    fn parameters(&self, judged: &Judged, finished: &mut Finished) -> Result<(), Failure> {
        let surfaces = self.below.surfaces;
        let increments: Vec<usize> = self.cycle.iter().map(|&n| surfaces[n].increment).collect();
        let mut parameters = BTreeMap::new();
        let _ = writeln!(
            finished.table,
            "  fatigue over increments {} to {}, all cells",
            increments.first().copied().unwrap_or(0),
            increments.last().copied().unwrap_or(0)
        );
        let mut told = |name: &str, found: ParameterRecord| {
            let words = found.words(name, |value, kind| self.below.told(value, kind));
            let _ = writeln!(finished.table, "  {words}");
            parameters.insert(name.to_owned(), found);
        };
        for parameter in Parameter::ALL {
            let of: Vec<&MostSevere> =
                judged.found.iter().filter(|found| found.parameter == parameter).collect();
            let largest =
                of.iter().copied().reduce(|most, next| if next.value > most.value { next } else { most });
            let Some(largest) = largest else { continue };
            let mut entry = self.entry(largest);
            if of.len() > 1 {
                entry.layers = of.iter().map(|found| self.entry(found)).collect();
            }
            if let Some((_, at)) = judged.at_distance.iter().find(|(of, _)| *of == parameter) {
                let constants = constants_of(self.below.half_space, self.below.constants, 0);
                let material = material_of(self.below.half_space, 0);
                let at_distance = |(value, cell): (f64, [usize; 2])| {
                    let [x, y] = self.below.place(cell, [0.0; 2]);
                    let cycles = material.as_ref().and_then(|of| parameter.cycles(value, of, &constants));
                    AtDistance { value, x, y, cycles: cycles.map(Bounded) }
                };
                let (point, line) = (at_distance(at.point), at_distance(at.line));
                entry.critical_distance = Some(CriticalDistance { distance: at.distance, point, line });
            }
            told(parameter.name(), entry);
        }
        if let Some(ruiz) = &judged.ruiz {
            for (part, name) in ["ruiz_f1", "ruiz_f2"].into_iter().enumerate() {
                let first = (f64::NEG_INFINITY, [0, 0]);
                let (largest, cell) = ruiz.indexed_iter().fold(first, |best, ((i, j), ruiz)| {
                    let value = [ruiz.f1, ruiz.f2][part];
                    if value > best.0 { (value, [i, j]) } else { best }
                });
                let [x, y] = self.below.place(cell, [0.0; 2]);
                told(name, ParameterRecord { largest, x, y, ..ParameterRecord::default() });
            }
        }
        finished.files.push(("fatigue.csv", self.by_layer(judged)));
        let cycle: Vec<LoadedSurface> = self.cycle.iter().map(|&n| surfaces[n].clone()).collect();
        let mut fatigue = FatigueRecord { increments, parameters, crack: None };
        if let Some(CrackAnswer { record, table, csv }) = followed(&self.below, &judged.at_surface, &cycle)? {
            fatigue.crack = Some(record);
            finished.table += &table;
            finished.files.extend(csv.map(|csv| ("crack.csv", csv)));
        }
        finished.fatigue = Some(fatigue);
        let row =
            |values: &Option<ndarray::Array2<f64>>| values.as_ref().map(|values| values.column(0).to_vec());
        let whole = |(parameter, values): &(Parameter, Vec<Option<ndarray::Array2<f64>>>)| {
            let values: Option<Vec<Vec<f64>>> = values.iter().map(row).collect();
            Some((parameter.name().to_owned(), values?))
        };
        finished.pictures = judged.fields.iter().filter_map(whole).collect();
        Ok(())
    }

    fn entry(&self, found: &MostSevere) -> ParameterRecord {
        let [x, y] = self.below.place(found.cell, found.off);
        ParameterRecord {
            largest: found.value,
            x,
            y,
            depth: found.point.depth,
            layer: Some(found.point.layer),
            normal: found.normal,
            largest_cell: Some(found.of_cells),
            cycles: found.cycles.map(Bounded),
            largest_cell_cycles: found.cycles_of_cells.map(Bounded),
            factor_of_safety: found.factor_of_safety.map(Bounded),
            ..ParameterRecord::default()
        }
    }

    /// Lines of `fatigue.csv`: the largest value of every parameter in every layer.
    fn by_layer(&self, judged: &Judged) -> String {
        let at = |found: &MostSevere| {
            let mut known = judged.at_distance.iter().filter(|_| found.point.layer == 0);
            known.find(|(of, _)| *of == found.parameter).map(|(_, at)| at)
        };
        let normal = |found: &MostSevere, axis: usize| found.normal.map(|normal| normal[axis]);
        let columns = Columns::<MostSevere>::new()
            .column("parameter", "", |found| found.parameter.name())
            .column("layer", "", |found| found.point.layer)
            .column("largest", "", |found| found.value)
            .column("x", "length", |found| self.below.place(found.cell, found.off)[0])
            .column("y", "length", |found| self.below.place(found.cell, found.off)[1])
            .column("depth", "length", |found| found.point.depth)
            .column("cycles", "", |found| found.cycles)
            .column("factor_of_safety", "", |found| found.factor_of_safety)
            .column("largest_cell", "", |found| found.of_cells)
            .column("largest_cell_cycles", "", |found| found.cycles_of_cells)
            .column("normal_x", "", |found| normal(found, 0))
            .column("normal_y", "", |found| normal(found, 1))
            .column("normal_z", "", |found| normal(found, 2))
            .column("point_method", "", |found| at(found).map(|at| at.point.0))
            .column("line_method", "", |found| at(found).map(|at| at.line.0));
        columns.csv(self.below.run.units(), &judged.found)
    }

    /// Channelling and delamination of the outermost coating.
    fn coating(&mut self, finished: &mut Finished) {
        let Some(film) = self.film.take() else { return };
        let constants = constants_of(self.below.half_space, self.below.constants, 0);
        let cracks = film.most_severe(&constants);
        if cracks.is_empty() || material_of(self.below.half_space, 0).is_none() {
            return;
        }
        let record = |FilmCrack { stress, direction, surface, cell, released }: FilmCrack| {
            let [x, y] = self.below.place(cell, [0.0; 2]);
            let factor = |(energy, toughness): (f64, f64)| Bounded((toughness / energy).sqrt());
            FilmRecord {
                stress,
                direction,
                increment: self.below.surfaces[surface].increment,
                x,
                y,
                channelling: released.channelling,
                delamination: released.delamination,
                phase: released.phase,
                channelling_factor_of_safety: released.channelling.zip(constants.fracture_energy).map(factor),
                delamination_factor_of_safety: constants
                    .interface_energy
                    .map(|toughness| factor((released.delamination, toughness))),
            }
        };
        let records: Vec<FilmRecord> = cracks.into_iter().map(record).collect();
        for film in &records {
            let words = film.words(|value, kind| self.below.told(value, kind));
            let _ = writeln!(finished.table, "  {words}");
        }
        finished.coating = Some(records);
    }
}
