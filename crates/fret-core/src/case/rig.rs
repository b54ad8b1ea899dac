//! The judgement of the machine: how stiff it is, that a stage which drives its far end has one, and what its logs look like.

use super::control_keys::BothOrOne;
use super::file::{LogColumnsFile, RigFile};
use super::judge::Judge;
use super::stage_file::StageFile;
use crate::document::At;
use crate::measured::Loads;
use crate::model::Rig;
use crate::model::controls::{CONTROLS, Kind, NORMAL};

/// The machine of a case; `None` where there is none.
pub(super) fn rig(file: Option<&RigFile>) -> Option<Rig> {
    let file = file?;
    let compliance = |stiffness: f64| 1.0 / stiffness;
    let tangential = file.tangential_stiffness.as_ref().map_or([0.0; 2], |given| match given.value {
        BothOrOne::Both(both) => both.map(compliance),
        BothOrOne::Line(one) => [compliance(one); 2],
    });
    let normal = file.normal_stiffness.as_ref().map_or(0.0, |given| compliance(given.value));
    Some(Rig { normal, tangential })
}

/// What the columns of a measured log are called: what each holds, and its name.
pub(super) fn log_columns(judge: &mut Judge, file: Option<&RigFile>) -> Vec<(&'static str, String)> {
    let Some(LogColumnsFile { displacement, force, cycle, normal_force }) =
        file.and_then(|rig| rig.columns.as_ref())
    else {
        return Vec::new();
    };
    let given =
        [("displacement", displacement), ("force", force), ("cycle", cycle), ("normal_force", normal_force)];
    let mut columns = Vec::new();
    for (what, name) in given.into_iter().filter_map(|(what, name)| Some((what, name.as_ref()?))) {
        if name.value.trim().is_empty() {
            let message = format!("rig.columns.{what}: must be the name of a column");
            judge.refuse::<()>(name.span(), message, "as it stands in the head of the log, without its unit");
        }
        columns.push((what, name.value.trim().to_owned()));
    }
    columns
}

/// Refuses an actuator that nothing connects with the body.
pub(super) fn driven(
    judge: &mut Judge,
    place: &str,
    file: &StageFile,
    columns: Option<&Loads>,
    rig: Option<&RigFile>,
) {
    for row in &CONTROLS {
        let Some(way) = row.ways.iter().find(|way| way.kind == Kind::FarEnd) else { continue };
        let (stiffness, is_given) = if row.freedom == NORMAL {
            ("normal_stiffness", rig.is_some_and(|rig| rig.normal_stiffness.is_some()))
        } else {
            ("tangential_stiffness", rig.is_some_and(|rig| rig.tangential_stiffness.is_some()))
        };
        let in_table =
            row.columns(way).any(|(name, _)| columns.is_some_and(|columns| columns.contains_key(&name)));
        let table = || file.table.as_ref().filter(|_| in_table).map(At::span);
        if let Some(span) = file.controls.span_of(way.name).or_else(table).filter(|_| !is_given) {
            judge.refuse::<()>(
                span,
                format!("{place}.{}: the case does not say how stiff the machine is", way.name),
                &format!("[rig] {stiffness} = ...; or prescribe the {} of the body itself", row.ways[1].name),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{BALL, ROLLER, read, refused};

    fn with_rig(words: &str) -> String {
        format!("[rig]\n{words}\n[friction]")
    }

    #[test]
    fn a_machine_gives_as_much_as_its_stiffness_says() {
        let rig = |text: &str, words: &str| read(text, &[("[friction]", &with_rig(words))]).rig.unwrap();
        let both = rig(BALL, "tangential_stiffness = [4.0, 8.0]\nnormal_stiffness = 16.0");
        assert_eq!((both.normal, both.tangential), (0.0625, [0.25, 0.125]));
        assert_eq!(rig(ROLLER, "tangential_stiffness = 4.0").tangential, [0.25; 2]);
        assert_eq!(rig(BALL, "normal_stiffness = 4.0").tangential, [0.0; 2]);
        assert_eq!(read(BALL, &[]).rig, None);
        for stiffness in ["0.0", "-4.0", "nan", "inf", "1e-310"] {
            for key in ["normal_stiffness", "tangential_stiffness"] {
                let rig = with_rig(&format!("{key} = {stiffness}"));
                refused(
                    if key.starts_with('n') { BALL } else { ROLLER },
                    &[("[friction]", &rig)],
                    &format!("rig.{key}"),
                    stiffness,
                );
            }
        }
    }

    #[test]
    fn an_actuator_pulls_by_a_stiffness() {
        let stage = |words: &str| format!("increments = 1\n[[load]]\nincrements = 1\n{words}");
        for (own, other, driven, place) in [
            (
                "tangential_stiffness = [4.0, 8.0]",
                "normal_stiffness = 4.0",
                "actuator = [0.125, 0.0]",
                "[0.125, 0.0]",
            ),
            (
                "normal_stiffness = 4.0",
                "tangential_stiffness = [4.0, 8.0]",
                "actuator_approach = 0.125",
                "0.125",
            ),
        ] {
            let stage = stage(driven);
            let stage = ("increments = 1", stage.as_str());
            read(BALL, &[("[friction]", &with_rig(own)), stage]);
            let words = "the case does not say how stiff the machine is";
            refused(BALL, &[("[friction]", &with_rig(other)), stage], words, place);
            refused(BALL, &[stage], words, place);
        }
    }

    #[test]
    fn columns_of_a_log_have_names() {
        let columns = |words: &str| with_rig(&format!("normal_stiffness = 4.0\ncolumns = {{ {words} }}"));
        let read = |words: &str| read(BALL, &[("[friction]", &columns(words))]).log_columns;
        assert_eq!(
            read("force = \" Q \", displacement = \"delta\""),
            [("displacement", "delta".to_owned()), ("force", "Q".to_owned())]
        );
        assert_eq!(
            read("cycle = \"N\", normal_force = \"P\""),
            [("cycle", "N".to_owned()), ("normal_force", "P".to_owned())]
        );
        refused(
            BALL,
            &[("[friction]", &columns("force = \" \""))],
            "rig.columns.force: must be the name",
            "\" \"",
        );
    }
}
