//! `fret stress`: stresses under the surface, from the kept tractions of a finished run; nothing is solved again.
//!
//! Written into `stress/` in the result folder: `stress.json` (all numbers), `depths.csv` (largest values at every depth),
//! sections as SVG, a volume for `ParaView` where one is asked for.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::Instant;

use fret_core::case::{Side, StressRequest};
use fret_core::machine::memory;
use fret_core::model::{Base, Body, HalfSpace};
use fret_core::plan::memory_of_stress;
use fret_core::subsurface::largest::look;
use fret_core::subsurface::{
    DepthPoint, Largest, LoadedSurface, Measure, StressField, automatic_depths, depth_points, survey,
};
use serde_json::{Value, json};

use super::fatigue::{Fatigue, Picture};
use crate::arguments::StressArguments;
use crate::failure::{Failure, Unwritten};
use crate::figures::{counted, duration, figure};
use crate::interrupt;
use crate::output::kept_run::KeptRun;
use crate::output::section::Section;
use crate::output::vtk::Volume;
use crate::output::write_whole;
use crate::terminal;
use crate::threads;

/// Depths chosen by `--auto`.
const AUTOMATIC: usize = 64;
/// More sections than this are not drawn.
const MOST_SECTIONS: usize = 12;
/// Names of the fields of a volume.
const VOLUME_FIELDS: [&str; 8] = ["xx", "yy", "zz", "xy", "xz", "yz", "von_mises", "tension"];

/// Computes stresses for a result folder.
pub fn stress(arguments: &StressArguments, as_json: bool) -> Result<(), Failure> {
    let record = stress_of(arguments, as_json)?;
    if as_json {
        terminal::answer(&format!("{record:#}"))?;
    }
    Ok(())
}

fn stress_of(arguments: &StressArguments, as_json: bool) -> Result<Value, Failure> {
    interrupt::listen();
    let run = KeptRun::open(&arguments.folder)?;
    let request = requested(arguments, &run);
    let pool = threads::pool(threads::asked(arguments.threads))?;
    let answer = pool.install(|| computed(&arguments.folder, &run, &request))?;
    if !arguments.quiet && !as_json {
        terminal::answer(&answer.table)?;
    }
    Ok(answer.record)
}

/// What the call asks for, or else the case.
fn requested(arguments: &StressArguments, run: &KeptRun) -> StressRequest {
    let mut request = run.stress.clone().unwrap_or_default();
    if !arguments.depths.is_empty() {
        request.depths = Some(arguments.depths.clone());
    }
    if arguments.auto {
        request.depths = None;
    }
    if let Some(every) = arguments.every {
        request.every = every as usize;
    }
    match arguments.body.as_deref() {
        Some("upper") => request.body = Side::Upper,
        Some(_) => request.body = Side::Lower,
        // without a word, a rigid lower body means the other one
        None if run.stress.is_none() && *run.bodies.lower() == Body::Rigid => request.body = Side::Upper,
        None => {}
    }
    request.volume |= arguments.volume;
    request
}

struct Answer {
    record: Value,
    table: String,
}

fn computed(folder: &Path, run: &KeptRun, request: &StressRequest) -> Result<Answer, Failure> {
    let started = Instant::now();
    let Body::Elastic(half_space) = request.body.of(&run.bodies) else {
        let other = if request.body == Side::Lower { "upper" } else { "lower" };
        return Err(Failure::Call(
            format!("the {} body is rigid: there is no stress in it", request.body.name()),
            format!("--body {other}"),
        ));
    };
    let surfaces = loaded_surfaces(folder, run, request)?;
    let points = match &request.depths {
        Some(depths) => depth_points(half_space, depths)
            .map_err(|error| Failure::Call(error.to_string(), "or --auto".to_owned()))?,
        None => automatic_depths(half_space, reach(run, &surfaces), AUTOMATIC),
    };
    let place = folder.join("stress");
    fs::create_dir_all(&place).map_err(Unwritten::at(&place))?;
    let mut sheet = Sheet::new(run, request, half_space, &points, &surfaces);
    let mut volume = if request.volume {
        let depths: Vec<f64> = points.iter().map(|point| point.depth).collect();
        let name = format!("volume-{:05}.vtr", surfaces.last().map_or(0, |surface| surface.increment));
        Some(Volume::create(&place.join(name), &run.grid, &depths, &VOLUME_FIELDS)?)
    } else {
        None
    };
    let mut unwritten = None;
    survey(half_space, &run.grid, run.periodic, &points, &surfaces, |point, surface, field| {
        if interrupt::is_asked() {
            return false;
        }
        sheet.look(point, surface, field);
        if let (Some(volume), true) = (&mut volume, surface + 1 == surfaces.len())
            && let Err(error) = fill(volume, point, field)
        {
            unwritten = Some(error);
            return false;
        }
        true
    })
    .map_err(|error| Failure::Defect(format!("stress kernels: {error}")))?;
    if let Some(unwritten) = unwritten {
        return Err(unwritten.into());
    }
    if interrupt::is_asked() {
        if let Some(volume) = volume {
            volume.abandon();
        }
        return Err(stopped(folder));
    }
    if let Some(volume) = volume {
        volume.close()?;
    }
    sheet.written(&place, started.elapsed().as_secs_f64())
}

fn stopped(folder: &Path) -> Failure {
    let shown = folder.display();
    Failure::Interrupted(format!(
        "the stresses are not finished and nothing is written; run `fret stress {shown}` again"
    ))
}

fn fill(volume: &mut Volume, point: usize, field: &StressField) -> Result<(), Unwritten> {
    for (component, name) in VOLUME_FIELDS[..6].iter().enumerate() {
        volume.plane(name, point, |i, j| field.components[component][[i, j]])?;
    }
    volume.plane("von_mises", point, |i, j| field.at(i, j).von_mises())?;
    volume.plane("tension", point, |i, j| field.at(i, j).principal().values[0])
}

/// The tractions on the body in the increments that are looked at.
fn loaded_surfaces(
    folder: &Path,
    run: &KeptRun,
    request: &StressRequest,
) -> Result<Vec<LoadedSurface>, Failure> {
    let kept = &run.steps;
    let last = kept.len().saturating_sub(1);
    let chosen = kept.iter().enumerate().filter(|(n, _)| (last - n).is_multiple_of(request.every));
    memory::check(memory_of_stress(run.grid.len(), chosen.clone().count()))?;
    let sign = if request.body == Side::Lower { 1.0 } else { -1.0 };
    let mut surfaces = Vec::new();
    for (_, &increment) in chosen {
        if interrupt::is_asked() {
            return Err(stopped(folder));
        }
        let pair = |name: [&str; 2]| -> Result<Option<[ndarray::Array2<f64>; 2]>, Failure> {
            Ok(run.field(name[0], increment)?.zip(run.field(name[1], increment)?).map(<[_; 2]>::from))
        };
        let Some(pressure) = run.field("pressure", increment)? else { continue };
        let shear = if run.frictionless { None } else { pair(["shear_x", "shear_y"])? };
        let shear = shear.map(|shear| shear.map(|component| component * sign));
        let slip = pair(["slip_x", "slip_y"])?;
        let bulk_stress = run.bulk_stress(request.body, increment);
        surfaces.push(LoadedSurface { increment, pressure, shear, slip, bulk_stress });
    }
    let shown = folder.display();
    if surfaces.is_empty() {
        return Err(Failure::Call(
            format!("{shown}: holds no tractions: the pressure of no increment was kept"),
            "run the case again with output.fields = [\"pressure\", \"shear\", ...]".to_owned(),
        ));
    }
    if !run.frictionless && surfaces.iter().any(|surface| surface.shear.is_none()) {
        return Err(Failure::Call(
            format!("{shown}: holds no shear, but the contact has friction"),
            "run the case again with output.fields = [\"pressure\", \"shear\", ...]".to_owned(),
        ));
    }
    Ok(surfaces)
}

/// How deep to look: three times the largest radius, or half-width, of the loaded area, about its centre.
fn reach(run: &KeptRun, surfaces: &[LoadedSurface]) -> f64 {
    let most = surfaces
        .iter()
        .map(|surface| surface.pressure.iter().filter(|pressure| **pressure > 0.0).count())
        .max()
        .unwrap_or(0);
    let [width, length] = run.grid.size();
    if run.periodic {
        return 0.5 * width.max(length);
    }
    if run.grid.is_line() {
        let half_width = 0.5 * most as f64 * run.grid.spacing()[0];
        return if half_width > 0.0 { 3.0 * half_width } else { width };
    }
    let radius = (most as f64 * run.grid.cell_area() / std::f64::consts::PI).sqrt();
    if radius > 0.0 { 3.0 * radius } else { width.min(length) }
}

/// What is noted on the way, and written at the end.
struct Sheet<'a> {
    run: &'a KeptRun,
    request: &'a StressRequest,
    half_space: &'a HalfSpace,
    points: &'a [DepthPoint],
    surfaces: &'a [LoadedSurface],
    interfaces: Vec<f64>,
    largest: Vec<Largest>,
    /// Lines of `depths.csv`.
    by_depth: String,
    /// Row of cells nearest to y = 0.
    row: usize,
    /// Von Mises along that row, `[surface][point][i]`.
    sections: Vec<Vec<Vec<f64>>>,
    fatigue: Option<Fatigue<'a>>,
}

impl<'a> Sheet<'a> {
    fn new(
        run: &'a KeptRun,
        request: &'a StressRequest,
        half_space: &'a HalfSpace,
        points: &'a [DepthPoint],
        surfaces: &'a [LoadedSurface],
    ) -> Self {
        let mut depth = 0.0;
        let interfaces = half_space
            .coatings()
            .iter()
            .map(|coating| {
                depth += coating.thickness();
                depth
            })
            .collect();
        let row = run.grid.cells()[1] / 2;
        let [first, last] = run.last_cycle;
        let cycle: Vec<usize> = surfaces
            .iter()
            .enumerate()
            .filter(|(_, surface)| (first..=last).contains(&surface.increment))
            .map(|(index, _)| index)
            .collect();
        let fatigue = (run.cyclic && cycle.len() > 2)
            .then(|| Fatigue::new(request.fatigue, half_space, points, surfaces, cycle, row));
        Self {
            run,
            request,
            half_space,
            points,
            surfaces,
            interfaces,
            largest: Vec::new(),
            by_depth: format!("increment,depth,layer,{}\n", Measure::ALL.map(Measure::name).join(",")),
            row,
            sections: vec![Vec::new(); surfaces.len()],
            fatigue,
        }
    }

    fn look(&mut self, point: usize, surface: usize, field: &StressField) {
        let place = self.points[point];
        let increment = self.surfaces[surface].increment;
        let is_interface = self.interfaces.contains(&place.depth);
        let mut here = Vec::new();
        let pressure = (place.depth == 0.0).then_some(&self.surfaces[surface].pressure);
        look(&mut here, field, place, is_interface, increment, pressure);
        let value = |measure: Measure| {
            here.iter()
                .find(|found: &&Largest| found.measure == measure)
                .map_or(String::new(), |found| format!("{:e}", found.value))
        };
        let values = Measure::ALL.map(value).join(",");
        let _ = writeln!(self.by_depth, "{increment},{:e},{},{values}", place.depth, place.layer);
        for found in here {
            match self.largest.iter_mut().find(|known| known.measure == found.measure) {
                Some(known) if found.value > known.value => *known = found,
                Some(_) => {}
                None => self.largest.push(found),
            }
        }
        let nx = self.run.grid.cells()[0];
        self.sections[surface].push((0..nx).map(|i| field.at(i, self.row).von_mises()).collect());
        if let Some(fatigue) = &mut self.fatigue {
            fatigue.look(point, surface, field);
        }
    }

    /// Where along x or y a largest value was found [length].
    fn place_of(&self, found: &Largest, axis: usize) -> f64 {
        let grid = &self.run.grid;
        grid.centre(axis, found.cell[axis]) + found.off[axis] * grid.spacing()[axis]
    }

    fn written(mut self, place: &Path, wall_s: f64) -> Result<Answer, Failure> {
        let centres = [self.run.grid.centres(0), self.run.grid.centres(1)];
        let largest: Vec<Value> = self
            .largest
            .iter()
            .map(|found| {
                json!({
                    "measure": found.measure.name(),
                    "value": found.value,
                    "increment": found.increment,
                    "x": self.place_of(found, 0),
                    "y": self.place_of(found, 1),
                    "depth": found.point.depth,
                    "layer": self.layer_name(found.point.layer),
                })
            })
            .collect();
        let fatigue =
            self.fatigue.take().map(|fatigue| fatigue.finished(&centres[0].to_vec(), &self.interfaces));
        let record = json!({
            "status": "computed",
            "unfinished": self.run.unfinished,
            "body": self.request.body.name(),
            "increments": self.surfaces.iter().map(|surface| surface.increment).collect::<Vec<_>>(),
            "depths": self.points.iter().map(|point| point.depth).collect::<Vec<_>>(),
            "layers": self.points.iter().map(|point| point.layer).collect::<Vec<_>>(),
            "largest": largest,
            "fatigue": fatigue.as_ref().map(|fatigue| fatigue.record.clone()),
            "wall_s": wall_s,
        });
        write_whole(&place.join("stress.json"), format!("{record:#}\n").as_bytes())?;
        write_whole(&place.join("depths.csv"), self.by_depth.as_bytes())?;
        self.draw(place, &centres[0].to_vec(), fatigue.as_ref().map(|fatigue| &fatigue.pictures[..]))?;
        let table = self.table(place, fatigue.as_ref().map(|fatigue| fatigue.table.as_str()), wall_s);
        Ok(Answer { record, table })
    }

    fn layer_name(&self, layer: usize) -> String {
        let coatings = self.half_space.coatings().len();
        match (layer < coatings, self.half_space.base()) {
            (true, _) if coatings == 1 => "coating".to_owned(),
            (true, _) => format!("coating {}", layer + 1),
            (false, Base::Elastic(_)) => "substrate".to_owned(),
            (false, Base::Rigid) => "base".to_owned(),
        }
    }

    /// Sections of the increments (of many: of the last and of the one with the largest von Mises stress), and of what fatigue
    /// shows.
    fn draw(&self, place: &Path, x: &[f64], fatigue: Option<&[Picture]>) -> Result<(), Failure> {
        let depths: Vec<f64> = self.points.iter().map(|point| point.depth).collect();
        if !depths.windows(2).all(|pair| pair[0] <= pair[1]) || depths.first() == depths.last() {
            return Ok(()); // no section without rising depths
        }
        let worst = self.largest.iter().find(|found| found.measure == Measure::VonMises);
        let last = self.surfaces.len() - 1;
        let is_shown = |index: usize| {
            let increment = self.surfaces[index].increment;
            last < MOST_SECTIONS || index == last || worst.is_some_and(|worst| worst.increment == increment)
        };
        let title = if self.run.title.is_empty() { "contact" } else { &self.run.title };
        let high = self.sections.iter().flatten().flatten().copied().fold(0.0, f64::max);
        for index in (0..=last).filter(|&index| is_shown(index)) {
            let increment = self.surfaces[index].increment;
            let quantity =
                format!("von Mises stress, increment {increment}, {} body", self.request.body.name());
            let section = Section {
                title,
                quantity: &quantity,
                x,
                depths: &depths,
                values: &self.sections[index],
                interfaces: &self.interfaces,
                range: Some([0.0, high]),
            };
            let name = format!("von_mises-{increment:05}.svg");
            write_whole(&place.join(name), section.svg().as_bytes())?;
        }
        for (name, values) in fatigue.unwrap_or_default() {
            let quantity =
                format!("{}, last cycle, {} body", name.replace('_', " "), self.request.body.name());
            let section = Section {
                title,
                quantity: &quantity,
                x,
                depths: &depths,
                values,
                interfaces: &self.interfaces,
                range: None,
            };
            write_whole(&place.join(format!("{name}.svg")), section.svg().as_bytes())?;
        }
        Ok(())
    }

    fn table(&self, place: &Path, fatigue: Option<&str>, wall_s: f64) -> String {
        let unfinished = self.run.unfinished.as_ref().map_or(String::new(), |why| format!("{why}\n"));
        let mut text = unfinished
            + &format!(
                "stress in the {} body: {} at {}, counted from 0\n\n  maximum            value        increment  x            y            depth        in\n",
                self.request.body.name(),
                counted(self.points.len(), "depth"),
                counted(self.surfaces.len(), "increment"),
            );
        for found in &self.largest {
            if found.value <= 0.0 && names_tension(found.measure) {
                let name = found.measure.name().replace('_', " ");
                let _ = writeln!(text, "  {name:<18} none: compression everywhere");
                continue;
            }
            let _ = writeln!(
                text,
                "  {:<18} {:<12} {:<10} {:<12} {:<12} {:<12} {}",
                found.measure.name().replace('_', " "),
                figure(found.value),
                found.increment,
                figure(self.place_of(found, 0)),
                figure(self.place_of(found, 1)),
                figure(found.point.depth),
                self.layer_name(found.point.layer)
            );
        }
        if let Some(fatigue) = fatigue {
            let _ = write!(text, "\n{fatigue}");
        }
        let _ = write!(text, "\nwritten to {} in {}", place.display(), duration(wall_s));
        text
    }
}

/// Whether a number that is not above zero is no tension at all.
fn names_tension(measure: Measure) -> bool {
    matches!(measure, Measure::Tension | Measure::Hydrostatic | Measure::Peel)
}

/// Stresses of a run that has just ended, as its case asks.
pub fn after_run(folder: &Path, quiet: bool) -> Result<(), Failure> {
    let run = KeptRun::open(folder)?;
    let Some(request) = run.stress.clone() else { return Ok(()) };
    let answer = computed(folder, &run, &request)?;
    if !quiet {
        terminal::answer(&answer.table)?;
    }
    Ok(())
}
