//! The judgement of friction that evolves.

use std::ops::Range;

use super::judge::Judge;
use super::loading::Loading;
use super::surface_file::{EvolutionFile, FrictionFile};
use crate::document::At;
use crate::model::stage::{Course, Stage};
use crate::model::{CellValues, CoulombFriction, EvolutionLaw, FrictionEvolution};

/// Change of the coefficient in a cycle jump when the case does not say.
const TOLERANCE: f64 = 0.01;

/// The evolution of the friction law that the history starts with; `None` when it does not evolve, or was refused.
pub(super) fn evolution(
    judge: &mut Judge,
    given: Option<&FrictionFile>,
    first: Option<&CoulombFriction>,
    loading: Loading<'_>,
) -> Option<FrictionEvolution> {
    let place = given?.evolution.as_ref()?;
    let file = &place.value;
    let before = judge.mistakes.len();
    if first.is_some_and(CoulombFriction::is_frictionless) {
        judge.refuse::<()>(
            place.span(),
            "friction.evolution of a contact without friction: there is no slip in this model that it could follow",
            "[friction] coefficient = ..., which is what it starts from",
        );
    }
    let law = law(judge, place, first);
    let every = file.every.unwrap_or(1);
    let tolerance = file.tolerance.unwrap_or(TOLERANCE);
    for (index, stage) in loading.files.iter().enumerate() {
        if let Some(change) = &stage.friction {
            judge.refuse::<()>(
                change.span(),
                format!("load[{index}].friction and friction.evolution, both at once"),
                "a table by \"cycles\" changes friction at given cycles",
            );
        }
    }
    let whose = ("friction.evolution", "whose friction evolves");
    changing_cycles(judge, place.span(), whose, every, loading.checked.unwrap_or_default());
    let law = law?;
    (judge.mistakes.len() == before).then_some(FrictionEvolution { by: file.by, law, every, tolerance })
}

/// Refuses cycles that have no place where every cycle changes the contact: `what` changes it, a contact `whose` it is.
pub(super) fn changing_cycles(
    judge: &mut Judge,
    span: Range<usize>,
    (what, whose): (&str, &str),
    every: usize,
    stages: &[Stage],
) {
    for (index, stage) in stages.iter().enumerate() {
        let Course::Cycles(cycles) = stage.course else { continue };
        let words = if cycles.until_steady.is_some() {
            format!("until_steady of a contact {whose}: it changes with every cycle")
        } else if every > 1 && cycles.envelope[0] != cycles.envelope[1] {
            "amplitudes that change from cycle to cycle: none of them can stand for others".to_owned()
        } else {
            continue;
        };
        let message = format!("{what} and load[{index}]: {words}");
        judge.refuse::<()>(span.clone(), message, &format!("cycles = ..., {what}.every = 1"));
    }
}

fn law(
    judge: &mut Judge,
    place: &At<EvolutionFile>,
    first: Option<&CoulombFriction>,
) -> Option<EvolutionLaw> {
    let file = &place.value;
    match (&file.last, &file.scale, &file.table) {
        (None, None, Some(given)) => table(judge, given, first),
        (Some(last), Some(scale), None) => Some(EvolutionLaw::Exponential { last: *last, scale: *scale }),
        (None | Some(_), None, None) | (None, Some(_), None) => judge.refuse(
            place.span(),
            "friction.evolution: without its law",
            "last = ... and scale = ..., or table = [[0, ...], ...]",
        ),
        _ => judge.refuse(
            place.span(),
            "friction.evolution: table and last or scale, both at once",
            "one of the two laws",
        ),
    }
}

fn table(
    judge: &mut Judge,
    given: &At<Vec<[f64; 2]>>,
    first: Option<&CoulombFriction>,
) -> Option<EvolutionLaw> {
    const KEY: &str = "friction.evolution.table";
    let rows = given.value.clone();
    let mut refuse =
        |message: String, help: &str| judge.refuse(given.span(), format!("{KEY}{message}"), help);
    let form = "rows of driver and coefficient, such as [[0, 0.2], [1000, 0.6]]";
    if rows.len() < 2 {
        return refuse(": needs two rows at the least".to_owned(), form);
    }
    for (index, [driver, coefficient]) in rows.iter().enumerate() {
        if !(coefficient.is_finite() && *coefficient > 0.0) {
            let message = format!("[{index}]: coefficient {coefficient:?} must be a positive finite number");
            return refuse(message, form);
        }
        let rises = match index.checked_sub(1) {
            None => *driver == 0.0,
            Some(before) => driver.is_finite() && *driver > rows[before][0],
        };
        if !rises {
            let message =
                format!("[{index}]: driver {driver:?}; the first must be 0, and each above the last");
            return refuse(message, form);
        }
    }
    match first?.coefficient() {
        CellValues::Map(_) => refuse(
            " of a map of coefficients: a table starts with one coefficient".to_owned(),
            "last = ... and scale = ...: each cell starts from its own coefficient",
        ),
        CellValues::Uniform(first) if *first != rows[0][1] => {
            let message = format!("[0]: starts with {:?}, friction.coefficient is {first:?}", rows[0][1]);
            refuse(message, "both say the coefficient at the start")
        }
        CellValues::Uniform(_) => Some(EvolutionLaw::Table(rows)),
    }
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::model::{EvolutionDriver, EvolutionLaw};

    fn text(friction: &str, load: &str) -> String {
        format!(
            "[grid]\ncells = [8, 8]\nsize = [1.0, 1.0]\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.sphere]\nradius = 10.0\n[friction]\n{friction}\n[[load]]\nnormal_force = 1e-3\nincrements = 1\n{load}"
        )
    }

    fn refused(friction: &str, load: &str) -> String {
        Case::from_toml(&text(friction, load), "case.toml").unwrap_err().to_string()
    }

    #[test]
    fn an_evolution_is_read_as_it_is_written() {
        let read = |evolution: &str| {
            let friction = format!("coefficient = 0.2\nevolution = {{ {evolution} }}");
            Case::from_toml(&text(&friction, ""), "case.toml").unwrap().friction_evolution.unwrap()
        };
        let one = read("by = \"energy\", last = 0.8, scale = 5");
        assert_eq!((one.by, one.every, one.tolerance), (EvolutionDriver::Energy, 1, 0.01));
        assert_eq!(one.law, EvolutionLaw::Exponential { last: 0.8, scale: 5.0 });
        let other = read("by = \"cycles\", table = [[0, 0.2], [10, 0.5]], every = 7, tolerance = 0.1");
        assert_eq!((other.by, other.every, other.tolerance), (EvolutionDriver::Cycles, 7, 0.1));
        assert_eq!(other.law, EvolutionLaw::Table(vec![[0.0, 0.2], [10.0, 0.5]]));
        assert_eq!(read("by = \"slip_distance\", last = 0.1, scale = 1.0").by, EvolutionDriver::SlipDistance);
    }

    #[test]
    fn what_cannot_be_meant_is_refused_with_words() {
        let law = |rest: &str| format!("coefficient = 0.2\nevolution = {{ by = \"energy\", {rest} }}");
        for (rest, words) in [
            ("last = 0.8", "without its law"),
            ("last = 0.8, scale = 1.0, table = [[0, 0.2], [1, 0.3]]", "both at once"),
            ("last = -0.8, scale = 1.0", "last = -0.8: must be a positive finite number"),
            ("last = 0.8, scale = 0.0", "scale = 0.0: must be a positive finite number"),
            ("table = [[0, 0.2]]", "two rows"),
            ("table = [[1, 0.2], [2, 0.3]]", "[0]: driver 1.0; the first must be 0"),
            ("table = [[0, 0.2], [2, 0.3], [2, 0.4]]", "[2]: driver 2.0"),
            ("table = [[0, 0.2], [2, 0.0]]", "[1]: coefficient 0.0"),
            ("table = [[0, 0.3], [2, 0.4]]", "starts with 0.3, friction.coefficient is 0.2"),
            ("last = 0.8, scale = 1.0, every = 0", "every = 0: must lie between 1"),
            ("last = 0.8, scale = 1.0, tolerance = 2.0", "tolerance = 2.0: must lie above 0"),
            ("last = 0.8, scale = 1.0, tolerance = 0.0", "tolerance = 0.0: must lie above 0"),
            ("last = inf, scale = 1.0", "last = inf: must be a positive finite number"),
            ("table = [[0, 0.2], [2, inf]]", "[1]: coefficient inf"),
            ("table = [[0, 0.2], [inf, 0.3]]", "[1]: driver inf"),
            ("table = [[0, 0.2], [2, 0.3], [1, 0.4]]", "[2]: driver 1.0"),
        ] {
            let found = refused(&law(rest), "");
            assert!(found.contains(words), "{rest}: {found}");
        }
        let good = "last = 0.8, scale = 1.0, every = 5";
        let found = refused(&format!("evolution = {{ by = \"cycles\", {good} }}"), "");
        assert!(found.contains("without friction"), "{found}");
        for (load, words) in [
            ("friction = 0.3\nincrements = 2\n", "load[1].friction and friction.evolution"),
            (
                "shift = [1e-3, 0.0]\nincrements = 4\nuntil_steady = { tolerance = 1e-3, most_cycles = 9 }\n",
                "until_steady",
            ),
        ] {
            let found = refused(&law(good), &format!("[[load]]\n{load}"));
            assert!(found.contains(words), "{found}");
        }
    }

    #[test]
    fn cycles_stand_for_others_where_these_are_alike() {
        let read = |every: &str, envelope: &str| {
            let friction = format!(
                "coefficient = 0.2\nevolution = {{ by = \"energy\", last = 0.8, scale = 1.0, tolerance = 1.0, every = {every} }}"
            );
            let load =
                format!("[[load]]\nshift = [1e-5, 0.0]\nincrements = 8\ncycles = 4\nenvelope = {envelope}\n");
            Case::from_toml(&text(&friction, &load), "case.toml").map_err(|error| error.to_string())
        };
        for (every, envelope) in [("1", "[1.0, 0.5]"), ("1", "[1.0, 1.0]"), ("2", "[0.5, 0.5]")] {
            let evolution = read(every, envelope).unwrap().friction_evolution.unwrap();
            assert_eq!((evolution.every.to_string().as_str(), evolution.tolerance), (every, 1.0));
        }
        let found = read("2", "[1.0, 0.5]").unwrap_err();
        assert!(found.contains("load[1]: amplitudes that change from cycle to cycle"), "{found}");
    }
}
