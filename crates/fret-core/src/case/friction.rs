//! The judgement of friction: one coefficient or a map, for the whole history or from a stage on.

use std::ops::Range;

use super::arrays;
use super::judge::Judge;
use super::stage_file::StageFile;
use super::surface_file::{CoefficientFile, FrictionFile, MapFile};
use crate::document::At;
use crate::model::{CellMap, CellValues, CoulombFriction, FrictionError};
use crate::topography::{Cells, Layout, fitting};

/// The law the history starts with; `None` when something about it was refused.
pub(super) fn friction(
    judge: &mut Judge,
    given: Option<&FrictionFile>,
    cells: Option<Cells>,
) -> Option<CoulombFriction> {
    let Some(given) = given else { return Some(CoulombFriction::NONE) };
    let law = match (&given.coefficient, &given.map) {
        (Some(_), Some(map)) => {
            let help = "a map has a coefficient for every cell: leave out one of the two";
            judge.both_or(map.span(), "friction: coefficient and map", help)
        }
        (None, Some(given)) => {
            let place = "friction.map";
            map(judge, place, given.span(), &given.value, cells)
                .and_then(|values| accepted(judge, place, given.span(), CoulombFriction::new(values)))
        }
        (Some(given), None) => {
            accepted(judge, "friction.coefficient", given.span(), CoulombFriction::uniform(given.value))
        }
        (None, None) => match &given.max_shear {
            Some(max_shear) => judge.refuse(
                max_shear.span(),
                "friction.max_shear without a coefficient: the shear strength bounds what friction carries",
                "[friction] coefficient = ...",
            ),
            None => Some(CoulombFriction::NONE),
        },
    };
    let max_shear = given.max_shear.as_ref().map(|given| {
        let place = "friction.max_shear";
        values(judge, place, given.span(), &given.value, cells).map(|values| (place, given.span(), values))
    });
    match max_shear {
        None => law,
        Some(max_shear) => {
            let (law, (place, span, values)) = law.zip(max_shear)?;
            accepted(judge, place, span, law.with_max_shear(values))
        }
    }
}

/// What each stage says about friction, if anything: another coefficient; the shear strength of the interface stays that of the `first` law.
/// `None` when something was refused.
pub(super) fn of_stages(
    judge: &mut Judge,
    stages: &[At<StageFile>],
    cells: Option<Cells>,
    first: Option<&CoulombFriction>,
) -> Option<Vec<Option<CoulombFriction>>> {
    let mut all = Vec::new();
    for (index, stage) in stages.iter().enumerate() {
        let place = format!("load[{index}].friction");
        all.push(match &stage.value.friction {
            None => Some(None),
            Some(given) => values(judge, &place, given.span(), &given.value, cells)
                .and_then(|values| accepted(judge, &place, given.span(), CoulombFriction::new(values)))
                .map(Some),
        });
    }
    let (all, first) = (all.into_iter().collect::<Option<Vec<_>>>()?, first?);
    Some(all.into_iter().map(|change| change.map(|law| law.with_max_shear_of(first))).collect())
}

/// One number, or one for every cell.
fn values(
    judge: &mut Judge,
    place: &str,
    span: Range<usize>,
    given: &CoefficientFile,
    cells: Option<Cells>,
) -> Option<CellValues> {
    match given {
        CoefficientFile::Uniform(value) => Some(CellValues::Uniform(*value)),
        CoefficientFile::Map(file) => map(judge, place, span, file, cells),
    }
}

fn map(
    judge: &mut Judge,
    place: &str,
    span: Range<usize>,
    given: &MapFile,
    cells: Option<Cells>,
) -> Option<CellValues> {
    let cells = cells?;
    let array = match given {
        MapFile::File(name) => arrays::of_file(judge, place, span.clone(), name),
        MapFile::Array(array) => arrays::given(judge, place, span.clone(), array),
    }?;
    let map = judge.take(place, span, fitting(cells, array, Layout::XY))?;
    Some(CellValues::Map(CellMap(map)))
}

fn accepted(
    judge: &mut Judge,
    place: &str,
    span: Range<usize>,
    law: Result<CoulombFriction, FrictionError>,
) -> Option<CoulombFriction> {
    match law {
        Ok(law) => Some(law),
        Err(error @ FrictionError::Entry { .. }) => {
            judge.refuse(span, format!("{place}: {error}"), "0 where a patch has no friction")
        }
        Err(error) => judge.refuse(span, format!("{place} = {error}"), ""),
    }
}
