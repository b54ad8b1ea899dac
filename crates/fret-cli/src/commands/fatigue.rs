//! Fatigue over the last cycle, under all cells at all depths: parameters, cycles to initiation, factors of safety; fracture of the coating.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use fret_core::model::HalfSpace;
use fret_core::subsurface::coating_fracture::Film;
use fret_core::subsurface::fatigue::{LayerConstants, Parameter};
use fret_core::subsurface::film_stress::{FilmCrack, FilmStress};
use fret_core::subsurface::severity::{constants_of, material_of};
use fret_core::subsurface::{DepthPoint, Judged, LoadedSurface, MostSevere, Severity, StressField};

use super::crack::{Crack, CrackAnswer};
use super::stress_record::{
    AtDistance, Bounded, CriticalDistance, FatigueRecord, FilmRecord, ParameterRecord,
};
use crate::commands::stress_kinds::kind_of_stress;
use crate::failure::Failure;
use crate::figures::{bounded, figure_in};
use crate::table::Columns;
use fret_results::Results;

/// Collects what fatigue is judged by, one depth at a time.
pub struct Fatigue<'a> {
    run: &'a Results,
    half_space: &'a HalfSpace,
    constants: &'a LayerConstants,
    points: &'a [DepthPoint],
    surfaces: &'a [LoadedSurface],
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
    pub fn new(
        run: &'a Results,
        half_space: &'a HalfSpace,
        constants: &'a LayerConstants,
        (points, surfaces): (&'a [DepthPoint], &'a [LoadedSurface]),
        cycle: Vec<usize>,
        row: usize,
    ) -> Self {
        let severity = (cycle.len() > 2)
            .then(|| Severity::new(half_space, constants, points, (surfaces, cycle.clone()), Some(row)));
        let film = Film::outermost(half_space).map(FilmStress::new);
        Self { run, half_space, constants, points, surfaces, cycle, severity, film }
    }

    /// Takes the stress at one depth in one increment.
    pub fn look(&mut self, point: usize, surface: usize, field: &StressField) {
        if let Some(severity) = &mut self.severity {
            severity.look(point, surface, field);
        }
        if let Some(film) = &mut self.film {
            film.look(self.points[point], surface, field);
        }
    }

    /// The largest values and where, the crack, the coating.
    pub fn finished(mut self) -> Result<Finished, Failure> {
        let mut finished = Finished::default();
        self.coating(&mut finished);
        if let Some(severity) = self.severity.take() {
            let judged = severity.judged();
            self.parameters(&judged, &mut finished)?;
        }
        Ok(finished)
    }

    fn told(&self, value: f64, kind: &str) -> String {
        figure_in(self.run.units(), value, kind)
    }

    fn place(&self, cell: [usize; 2], off: [f64; 2]) -> [f64; 2] {
        let grid = self.run.grid();
        [0, 1].map(|axis| grid.centre(axis, cell[axis]) + off[axis] * grid.spacing()[axis])
    }

    fn parameters(&self, judged: &Judged, finished: &mut Finished) -> Result<(), Failure> {
        let increments: Vec<usize> = self.cycle.iter().map(|&n| self.surfaces[n].increment).collect();
        let mut parameters = BTreeMap::new();
        let _ = writeln!(
            finished.table,
            "  fatigue over increments {} to {}, all cells",
            increments.first().copied().unwrap_or(0),
            increments.last().copied().unwrap_or(0)
        );
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
            self.line(largest, &mut finished.table);
            if let Some((_, at)) = judged.at_distance.iter().find(|(of, _)| *of == parameter) {
                let constants = constants_of(self.half_space, self.constants, 0);
                let cycles =
                    |value: f64| parameter.cycles(value, &material_of(self.half_space, 0)?, &constants);
                let told = |(value, cell): (f64, [usize; 2])| {
                    let [x, y] = self.place(cell, [0.0; 2]);
                    AtDistance { value, x, y, cycles: cycles(value).map(Bounded) }
                };
                let in_words = |value: f64| {
                    let cycles = cycles(value)
                        .map_or(String::new(), |cycles| format!(" ({} cycles)", bounded(cycles)));
                    self.told(value, kind_of_stress(parameter.name())) + &cycles
                };
                let (point, line) = (told(at.point), told(at.line));
                entry.critical_distance = Some(CriticalDistance { distance: at.distance, point, line });
                let _ = writeln!(
                    finished.table,
                    "    at the critical distance {}: {} by the point method, {} by the line method",
                    self.told(at.distance, "length"),
                    in_words(at.point.0),
                    in_words(at.line.0)
                );
            }
            parameters.insert(parameter.name().to_owned(), entry);
        }
        if let Some(ruiz) = &judged.ruiz {
            for (part, name) in ["ruiz_f1", "ruiz_f2"].into_iter().enumerate() {
                let first = (f64::NEG_INFINITY, [0, 0]);
                let (value, cell) = ruiz.indexed_iter().fold(first, |best, ((i, j), ruiz)| {
                    let value = [ruiz.f1, ruiz.f2][part];
                    if value > best.0 { (value, [i, j]) } else { best }
                });
                let [x, y] = self.place(cell, [0.0; 2]);
                parameters.insert(
                    name.to_owned(),
                    ParameterRecord { largest: value, x, y, ..ParameterRecord::default() },
                );
                let _ = writeln!(
                    finished.table,
                    "  {:<20} {:<12} at x {:<12} surface",
                    name.replace('_', " "),
                    self.told(value, kind_of_stress(name)),
                    self.told(x, "length")
                );
            }
        }
        finished.files.push(("fatigue.csv", self.by_layer(judged)));
        let crack = Crack { run: self.run, half_space: self.half_space, constants: self.constants };
        let cycle: Vec<LoadedSurface> = self.cycle.iter().map(|&n| self.surfaces[n].clone()).collect();
        let mut fatigue = FatigueRecord { increments, parameters, crack: None };
        if let Some(CrackAnswer { record, table, csv }) = crack.followed(&judged.at_surface, &cycle)? {
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
        let [x, y] = self.place(found.cell, found.off);
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

    fn line(&self, found: &MostSevere, table: &mut String) {
        let [x, y] = self.place(found.cell, found.off);
        let _ = write!(
            table,
            "  {:<20} {:<12} at x {:<12} y {:<12} depth {:<12}",
            found.parameter.name().replace('_', " "),
            self.told(found.value, kind_of_stress(found.parameter.name())),
            self.told(x, "length"),
            self.told(y, "length"),
            self.told(found.point.depth, "length")
        );
        if let Some(cycles) = found.cycles {
            let _ = write!(table, " cycles to initiation {}", bounded(cycles));
        }
        if let Some(factor) = found.factor_of_safety {
            let _ = write!(table, " factor of safety {}", bounded(factor));
        }
        if found.off != [0.0; 2] {
            let cells = self.told(found.of_cells, kind_of_stress(found.parameter.name()));
            let cycles =
                found.cycles_of_cells.map_or(String::new(), |cycles| format!(", {} cycles", bounded(cycles)));
            let _ = write!(table, " (extrapolated to the rim; largest cell {cells}{cycles})");
        }
        table.truncate(table.trim_end().len());
        table.push('\n');
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
            .column("x", "length", |found| self.place(found.cell, found.off)[0])
            .column("y", "length", |found| self.place(found.cell, found.off)[1])
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
        columns.csv(self.run.units(), &judged.found)
    }

    /// Channelling and delamination of the outermost coating.
    fn coating(&mut self, finished: &mut Finished) {
        let Some(film) = self.film.take() else { return };
        let constants = constants_of(self.half_space, self.constants, 0);
        let cracks = film.most_severe(&constants);
        if cracks.is_empty() || material_of(self.half_space, 0).is_none() {
            return;
        }
        let mut records = Vec::new();
        for FilmCrack { stress, direction, surface, cell, released } in cracks {
            let [x, y] = self.place(cell, [0.0; 2]);
            let increment = self.surfaces[surface].increment;
            let factor = |(energy, toughness): (f64, f64)| Bounded((toughness / energy).sqrt());
            records.push(FilmRecord {
                stress,
                direction,
                increment,
                x,
                y,
                channelling: released.channelling,
                delamination: released.delamination,
                phase: released.phase,
                channelling_factor_of_safety: released.channelling.zip(constants.fracture_energy).map(factor),
                delamination_factor_of_safety: constants
                    .interface_energy
                    .map(|toughness| factor((released.delamination, toughness))),
            });
            let sense = if stress > 0.0 { "tension" } else { "compression" };
            let channelling = match released.channelling {
                Some(energy) => self.told(energy, "pressure x length"),
                None => "- (needs lower.coatings[..].fatigue.channelling_factor)".to_owned(),
            };
            let _ = writeln!(
                finished.table,
                "  coating, mean {sense:<11} {:<12} at x {:<12} y {:<12} energy released: channelling {channelling}, delamination {}",
                self.told(stress, "pressure"),
                self.told(x, "length"),
                self.told(y, "length"),
                self.told(released.delamination, "pressure x length")
            );
        }
        finished.coating = Some(records);
    }
}
