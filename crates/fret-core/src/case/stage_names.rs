//! Stages are called by their names, in results and in sweeps: each has one of its own.

use super::judge::Judge;
use super::stage_file::StageFile;
use crate::document::At;

/// Refuses a stage whose name an earlier one has.
pub(super) fn own_names(judge: &mut Judge, list: &[At<StageFile>]) {
    for (index, given) in list.iter().enumerate() {
        let Some(name) = &given.value.name else { continue };
        let has_it = |other: &At<StageFile>| other.value.name.as_ref() == Some(name);
        if let Some(first) = list[..index].iter().position(has_it) {
            judge.refuse::<()>(
                given.span(),
                format!("load[{index}].name = {name:?}: load[{first}] has that name, too"),
                "a name of its own for each stage: results and sweeps call stages by their names",
            );
        }
    }
}
