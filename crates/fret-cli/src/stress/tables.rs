//! Stresses as they are told: `stress.json`, `depths.csv`, sections as pictures, a table.

use std::fmt::Write as _;
use std::path::Path;

use fret_core::model::Base;
use fret_core::subsurface::largest::look;
use fret_core::subsurface::{DepthPoint, Largest, Measure, StressField};

use super::below::Below;
use super::fatigue::{Fatigue, Picture};
use super::kinds::{kind_of_stress, stress_called};
use super::record::{LargestRecord, StressRecord};
use super::section::Section;
use crate::failure::Failure;
use crate::figures::{counted, duration, indented};
use crate::manner::Manner;
use crate::table::Columns;
use fret_results::STRESS;

/// More sections than this are not drawn.
const MOST_SECTIONS: usize = 12;

/// An increment, a depth, and the largest value of each measure there.
type AtDepth = (usize, DepthPoint, [Option<f64>; Measure::ALL.len()]);

/// What is noted on the way, and written at the end.
pub struct StressTables<'a> {
    below: Below<'a>,
    interfaces: Vec<f64>,
    largest: Vec<Largest>,
    /// Rows of `depths.csv`.
    by_depth: Vec<AtDepth>,
    /// Row of cells nearest to y = 0.
    row: usize,
    /// Von Mises along that row, `[surface][point][i]`.
    sections: Vec<Vec<Vec<f64>>>,
    fatigue: Fatigue<'a>,
}

impl<'a> StressTables<'a> {
    pub fn new(below: Below<'a>) -> Self {
        let row = below.run.grid().cells()[1] / 2;
        let ([first, last], cyclic) = below.run.last_cycle();
        let stays = below.run.places_travel().is_none();
        let is_of_cycle =
            |index: &usize| cyclic && stays && (first..=last).contains(&below.surfaces[*index].increment);
        let cycle = (0..below.surfaces.len()).filter(is_of_cycle).collect();
        Self {
            below,
            interfaces: below.half_space.interfaces(),
            largest: Vec::new(),
            by_depth: Vec::new(),
            row,
            sections: vec![Vec::new(); below.surfaces.len()],
            fatigue: Fatigue::new(below, cycle, row),
        }
    }

    pub fn look(&mut self, point: usize, surface: usize, field: &StressField) {
        let place = self.below.points[point];
        let above = &self.below.surfaces[surface];
        let is_interface = self.interfaces.contains(&place.depth);
        let mut here = Vec::new();
        let pressure = (place.depth == 0.0).then_some(&above.pressure);
        look(&mut here, field, place, is_interface, above.increment, pressure);
        let value = |measure| here.iter().find(|found| found.measure == measure).map(|found| found.value);
        self.by_depth.push((above.increment, place, Measure::ALL.map(value)));
        for found in here {
            match self.largest.iter_mut().find(|known| known.measure == found.measure) {
                Some(known) if found.value > known.value => *known = found,
                Some(_) => {}
                None => self.largest.push(found),
            }
        }
        let nx = self.below.run.grid().cells()[0];
        self.sections[surface].push((0..nx).map(|i| field.at(i, self.row).von_mises()).collect());
        self.fatigue.look(point, surface, field);
    }

    pub fn written(
        mut self,
        (place, manner): (&Path, &Manner),
        wall_s: f64,
    ) -> Result<(StressRecord, String), Failure> {
        let Below { run, request, points, surfaces, .. } = self.below;
        let largest = self.largest.iter().map(|found| {
            let [x, y] = self.below.place(found.cell, found.off);
            LargestRecord {
                measure: found.measure.name().to_owned(),
                value: found.value,
                increment: found.increment,
                x,
                y,
                depth: found.point.depth,
                layer: self.layer_name(found.point.layer),
            }
        });
        let largest = largest.collect();
        let fatigue = self.fatigue.finished()?;
        let record = StressRecord {
            status: "computed".to_owned(),
            unfinished: run.unfinished(),
            stage_ends_alone: run.stage_ends_alone(),
            places_travel: run.places_travel(),
            body: request.body.name().to_owned(),
            units: run.units().cloned(),
            increments: surfaces.iter().map(|surface| surface.increment).collect(),
            depths: points.iter().map(|point| point.depth).collect(),
            layers: points.iter().map(|point| point.layer).collect(),
            largest,
            fatigue: fatigue.fatigue,
            coating: fatigue.coating,
            wall_s,
        };
        manner.write_json(&place.join(STRESS[1]), &record)?;
        let mut columns = Columns::<AtDepth>::new()
            .column("increment", "", |(increment, ..)| *increment)
            .column("depth", "length", |(_, point, _)| point.depth)
            .column("layer", "", |(_, point, _)| point.layer);
        for (place, measure) in Measure::ALL.into_iter().enumerate() {
            let kind = kind_of_stress(measure.name());
            columns = columns.column(measure.name(), kind, move |(_, _, values)| values[place]);
        }
        let by_depth = columns.csv(run.units(), &self.by_depth);
        manner.write(&place.join("depths.csv"), by_depth.as_bytes())?;
        for (name, content) in &fatigue.files {
            manner.write(&place.join(name), content.as_bytes())?;
        }
        self.draw((place, manner), &run.grid().centres(0).to_vec(), &fatigue.pictures)?;
        let table = self.table(&record, place, &fatigue.table);
        Ok((record, table))
    }

    fn layer_name(&self, layer: usize) -> String {
        let coatings = self.below.half_space.coatings().len();
        match (layer < coatings, self.below.half_space.base()) {
            (true, _) if coatings == 1 => "coating".to_owned(),
            (true, _) => format!("coating {}", layer + 1),
            (false, Base::Elastic(_)) => "substrate".to_owned(),
            (false, Base::Rigid) => "base".to_owned(),
        }
    }

    /// Sections of the increments (of many: of the last and of the one with the largest von Mises stress), and of what fatigue
    /// shows.
    fn draw(&self, (place, manner): (&Path, &Manner), x: &[f64], fatigue: &[Picture]) -> Result<(), Failure> {
        let Below { run, surfaces, .. } = self.below;
        let depths: Vec<f64> = self.below.points.iter().map(|point| point.depth).collect();
        if !depths.windows(2).all(|pair| pair[0] <= pair[1]) || depths.first() == depths.last() {
            return Ok(()); // no section without rising depths
        }
        let worst = self.largest.iter().find(|found| found.measure == Measure::VonMises);
        let last = surfaces.len() - 1;
        let is_shown = |index: usize| {
            let increment = surfaces[index].increment;
            last < MOST_SECTIONS || index == last || worst.is_some_and(|worst| worst.increment == increment)
        };
        let title = if run.case().title.is_empty() { "contact" } else { &run.case().title };
        let high = self.sections.iter().flatten().flatten().copied().fold(0.0, f64::max);
        let section = |subject: &str, quantity: (&str, &str), values: &[Vec<f64>], range| {
            let (units, interfaces) = (run.units(), &self.interfaces);
            Section { title, subject, quantity, units, x, depths: &depths, values, interfaces, range }.svg()
        };
        let body = self.below.request.body.name();
        for index in (0..=last).filter(|&index| is_shown(index)) {
            let increment = surfaces[index].increment;
            let subject = format!("section at y = 0, increment {increment}, {body} body");
            let quantity = ("von Mises stress", "pressure");
            let svg = section(&subject, quantity, &self.sections[index], Some([0.0, high]))?;
            manner.write(&place.join(format!("von_mises-{increment:05}.svg")), svg.as_bytes())?;
        }
        for (name, values) in fatigue {
            let subject = format!("section at y = 0, last cycle, {body} body");
            let svg = section(&subject, (&stress_called(name), kind_of_stress(name)), values, None)?;
            manner.write(&place.join(format!("{name}.svg")), svg.as_bytes())?;
        }
        Ok(())
    }

    fn table(&self, record: &StressRecord, place: &Path, fatigue: &str) -> String {
        let said =
            [&record.unfinished, &record.stage_ends_alone, &record.places_travel].into_iter().flatten();
        let unfinished: String = said.map(|why| format!("{why}\n")).collect();
        let mut text = unfinished
            + &format!(
                "stress in the {} body: {} at {}, counted from 0\n\n",
                record.body,
                counted(record.depths.len(), "depth"),
                counted(record.increments.len(), "increment"),
            );
        let largest = LargestRecord::columns(|measure| measure.replace('_', " "));
        text += &indented(&largest.text(&[18, 12, 10, 12, 12, 12], self.below.run.units(), &record.largest));
        if !fatigue.is_empty() {
            let _ = write!(text, "\n{fatigue}");
        }
        let _ = write!(text, "\nwritten to {} in {}", place.display(), duration(record.wall_s));
        text
    }
}
