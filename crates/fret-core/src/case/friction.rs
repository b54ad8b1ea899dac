//! The judgement of friction: one coefficient or a map, for the whole history or from a stage on.

use std::ops::Range;

use toml::Spanned;

use super::arrays;
use super::judge::Judge;
use super::stage_file::StageFile;
use super::surface_file::{CoefficientFile, FrictionFile, MapFile};
use crate::model::CoulombFriction;

/// The law the history starts with; `None` when something about it was refused.
pub(super) fn friction(
    judge: &mut Judge,
    given: Option<&FrictionFile>,
    cells: Option<[usize; 2]>,
) -> Option<CoulombFriction> {
    let Some(given) = given else { return Some(CoulombFriction::Uniform(0.0)) };
    match (&given.coefficient, &given.map) {
        (Some(_), Some(map)) => judge.refuse(
            map.span(),
            "friction: coefficient and map, both at once",
            "a map has a coefficient for every cell: leave out one of the two",
        ),
        (None, Some(given)) => map(judge, "friction.map", given.span(), given.get_ref(), cells),
        (Some(given), None) => uniform(judge, "friction.coefficient", given.span(), *given.get_ref()),
        (None, None) => Some(CoulombFriction::Uniform(0.0)),
    }
}

/// What each stage says about friction, if anything; `None` when something was refused.
pub(super) fn of_stages(
    judge: &mut Judge,
    stages: &[Spanned<StageFile>],
    cells: Option<[usize; 2]>,
) -> Option<Vec<Option<CoulombFriction>>> {
    let mut all = Vec::new();
    for (index, stage) in stages.iter().enumerate() {
        let place = format!("load[{index}].friction");
        all.push(match &stage.get_ref().friction {
            None => Some(None),
            Some(given) => match given.get_ref() {
                CoefficientFile::Uniform(value) => uniform(judge, &place, given.span(), *value),
                CoefficientFile::Map(file) => map(judge, &place, given.span(), file, cells),
            }
            .map(Some),
        });
    }
    all.into_iter().collect()
}

fn uniform(judge: &mut Judge, place: &str, span: Range<usize>, value: f64) -> Option<CoulombFriction> {
    match CoulombFriction::uniform(value) {
        Ok(friction) => Some(friction),
        Err(error) => judge.refuse(span, format!("{place}: {error}"), ""),
    }
}

fn map(
    judge: &mut Judge,
    place: &str,
    span: Range<usize>,
    given: &MapFile,
    cells: Option<[usize; 2]>,
) -> Option<CoulombFriction> {
    cells?;
    let array = match given {
        MapFile::File(name) => arrays::of_file(judge, place, span.clone(), name),
        MapFile::Array(array) => arrays::given(judge, place, span.clone(), array),
    }?;
    let array = arrays::fitting(judge, cells, place, span.clone(), array)?;
    match CoulombFriction::map(array) {
        Ok(friction) => Some(friction),
        Err(error) => judge.refuse(span, format!("{place}: {error}"), "0 where a patch has no friction"),
    }
}
