//! The stresses of a run: a survey over its depths and surfaces, and what is written of it.
//!
//! Into `stress/` in the result folder: `stress.json` (all numbers), `depths.csv` (largest values at every depth), sections as SVG, a
//! volume for `ParaView` where one is asked for.

use std::path::Path;
use std::time::Instant;

use fret_core::case::{Side, StressRequest};
use fret_core::model::{Body, HalfSpace};
use fret_core::subsurface::{
    AUTOMATIC, DepthPoint, LoadedSurface, StressField, Tractions, automatic_depths, depth_points,
    displacements, survey,
};

use super::below::Below;
use super::record::StressRecord;
use super::surfaces::{loaded_surfaces, reach, stopped};
use super::tables::StressTables;
use crate::export::volume::{Field, Volume};
use crate::failure::{Failure, Unwritten};
use crate::interrupt;
use crate::manner::{Manner, place_of_answer};
use fret_results::{Results, STRESS};

/// A stress by its name in a volume.
type Stress = (&'static str, fn(&StressField, usize, usize) -> f64);

/// Fields of a volume: stresses.
const STRESSES: [Stress; 8] = [
    ("xx", |field, i, j| field.components[0][[i, j]]),
    ("yy", |field, i, j| field.components[1][[i, j]]),
    ("zz", |field, i, j| field.components[2][[i, j]]),
    ("xy", |field, i, j| field.components[3][[i, j]]),
    ("xz", |field, i, j| field.components[4][[i, j]]),
    ("yz", |field, i, j| field.components[5][[i, j]]),
    ("von_mises", |field, i, j| field.at(i, j).von_mises()),
    ("tension", |field, i, j| field.at(i, j).principal().values[0]),
];
/// And displacements, in point contacts.
const DISPLACEMENTS: [Field; 3] =
    [("displacement_x", "length"), ("displacement_y", "length"), ("displacement_z", "length")];

/// What is written, and what a person reads.
pub fn computed(
    folder: &Path,
    run: &Results,
    request: &StressRequest,
    manner: &Manner,
) -> Result<(StressRecord, String), Failure> {
    let started = Instant::now();
    let Body::Elastic(half_space) = request.body.of(&run.case().bodies) else {
        let other = if request.body == Side::Lower { "upper" } else { "lower" };
        return Err(Failure::call(
            format!("the {} body is rigid: there is no stress in it", request.body.name()),
            format!("--body {other}"),
        ));
    };
    let surfaces = loaded_surfaces(folder, run, request)?;
    let points = match &request.depths {
        Some(depths) => {
            depth_points(half_space, depths).map_err(|error| Failure::call(error.to_string(), "or --auto"))?
        }
        None => automatic_depths(half_space, reach(run, &surfaces), AUTOMATIC),
    };
    let place = place_of_answer(manner, folder, STRESS, "stresses of a run")?;
    let constants = run.fatigue_constants(request);
    let (constants, points, surfaces) = (&constants, &points[..], &surfaces[..]);
    let mut tables = StressTables::new(Below { run, request, half_space, constants, points, surfaces });
    // where one axis alone has no end, they need a datum
    let has_displacements = run.case().endless_axis().is_none();
    let mut volume = if request.volume {
        let depths: Vec<f64> = points.iter().map(|point| point.depth).collect();
        let name = format!("volume-{:05}.vtr", surfaces.last().map_or(0, |surface| surface.increment));
        let displacements: &[_] = if has_displacements { &DISPLACEMENTS } else { &[] };
        let fields = [&STRESSES.map(|(name, _)| (name, "pressure"))[..], displacements].concat();
        Some(Volume::create(&place.join(name), run.grid(), &depths, &fields, run.units())?)
    } else {
        None
    };
    let mut unwritten = None;
    survey(half_space, run.grid(), run.case().periodic, points, surfaces, |point, surface, field| {
        if interrupt::is_asked() {
            return false;
        }
        if surface == 0 {
            manner.step(|| format!("depth {} of {}", point + 1, points.len()));
        }
        tables.look(point, surface, field);
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
    if let Some(mut volume) = volume {
        if let (true, Some(surface)) = (has_displacements, surfaces.last()) {
            displace(&mut volume, (run, half_space), points, surface)?;
        }
        volume.close()?;
    }
    tables.written((&place, manner), started.elapsed().as_secs_f64())
}

/// Displacements under a surface by its tractions, into a volume.
fn displace(
    volume: &mut Volume,
    (run, half_space): (&Results, &HalfSpace),
    points: &[DepthPoint],
    surface: &LoadedSurface,
) -> Result<(), Failure> {
    let shear = surface.shear.as_ref().map(|[x, y]| [x.view(), y.view()]);
    let tractions = Tractions { pressure: surface.pressure.view(), shear };
    let mut unwritten = None;
    displacements(half_space, (run.grid(), run.case().periodic), points, &tractions, |point, moved| {
        for ((name, _), moved) in DISPLACEMENTS.iter().zip(&moved) {
            if let Err(error) = volume.plane(name, point, |i, j| moved[[i, j]]) {
                unwritten = Some(error);
            }
        }
    })
    .map_err(|error| Failure::Defect(format!("displacement kernels: {error}")))?;
    unwritten.map_or(Ok(()), |error| Err(error.into()))
}

fn fill(volume: &mut Volume, point: usize, field: &StressField) -> Result<(), Unwritten> {
    STRESSES.iter().try_for_each(|(name, of)| volume.plane(name, point, |i, j| of(field, i, j)))
}

/// Stresses of a run that has just ended, as its case asks; nothing where it does not.
pub fn answered(folder: &Path) -> Result<Option<(StressRecord, String)>, Failure> {
    let run = Results::read(folder)?;
    let Some(request) = run.case().stress.clone() else { return Ok(None) };
    computed(folder, &run, &request, &Manner::SILENT).map(Some)
}
