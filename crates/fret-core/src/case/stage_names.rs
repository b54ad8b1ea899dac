//! Stages are called by their names, in results and in sweeps: each has one of its own.

use toml::Spanned;

use super::judge::Judge;
use super::stage_file::StageFile;

/// Refuses a stage whose name an earlier one has.
pub(super) fn own_names(judge: &mut Judge, list: &[Spanned<StageFile>]) {
    for (index, given) in list.iter().enumerate() {
        let Some(name) = &given.get_ref().name else { continue };
        let has_it = |other: &Spanned<StageFile>| other.get_ref().name.as_ref() == Some(name);
        if let Some(first) = list[..index].iter().position(has_it) {
            judge.refuse::<()>(
                given.span(),
                format!("load[{index}].name = {name:?}: load[{first}] has that name, too"),
                "a name of its own for each stage: results and sweeps call stages by their names",
            );
        }
    }
}
