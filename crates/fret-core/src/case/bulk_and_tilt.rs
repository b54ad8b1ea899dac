//! The judgement of bulk stress and tilt: where they have a meaning.

use std::ops::Range;

use super::control_keys::Given;
use super::file::CaseFile;
use super::judge::Judge;
use super::known::Known;
use crate::model::bulk::substrate;
use crate::model::stage::Stage;
use crate::model::{Body, ContactPair, Dimension, GridSize};

/// Refuses bulk stresses of bodies without a substrate, both of them in periodic cases, two values in a line contact and one elsewhere,
/// tilt on a grid whose size is left to the program.
pub(super) fn bulk_and_tilt(judge: &mut Judge, known: &Known<'_>) {
    let Known { file: CaseFile { grid, .. }, bodies, size, .. } = *known;
    let periodic = !grid.periodicity().is_none();
    for stage in known.loading().stages() {
        let of_body =
            |body: usize| stage.by_table(|stage| stage.bulk_stress[body].iter().any(Option::is_some));
        let by_key = |key: &'static str, body: Option<fn(&ContactPair) -> &Body>| {
            let given = stage.file.controls.of(key);
            (key, bodies.zip(body).map(|(bodies, body)| body(bodies)), given, given.map(Given::span))
        };
        let place = format!("load[{}]", stage.index);
        let controls = [
            by_key("tilt_moment", None),
            by_key("tilt", None),
            ("a tilt", None, None, stage.by_table(Stage::tilts)),
            by_key("bulk_stress", Some(ContactPair::lower)),
            by_key("upper_bulk_stress", Some(ContactPair::upper)),
            ("bulk_stress", None, None, of_body(0).or(of_body(1))),
        ];
        for (key, body, given, span) in controls {
            let Some(span) = span else { continue };
            if periodic {
                judge.refuse::<()>(
                    span,
                    format!("{place}.{key} in a periodic case: neither a strain nor a tilt is periodic"),
                    "a single contact, on a grid around it: periodic = false",
                );
                continue;
            }
            if let Some(given) = given {
                one_or_two(judge, &place, key, given);
            }
            if let Some(body) = body
                && substrate(body).is_none()
            {
                without_substrate(judge, &place, key, body, span.clone());
            }
            if size == Some(GridSize::Auto) && key.contains("tilt") {
                judge.refuse::<()>(
                    grid.size.span(),
                    format!("grid.size = \"auto\" with {place}.{key}: the contact moves sideways as far as it tilts"),
                    "give the size of the grid",
                );
            }
        }
        let along_line = stage.by_table(|stage| {
            stage.tilt[1].is_some() || stage.bulk_stress.iter().any(|stress| stress[1].is_some())
        });
        if let (Dimension::Line, Some(span)) = (judge.dimension, along_line) {
            judge.refuse::<()>(
                span,
                format!("{place}.table: a tilt or a bulk stress along y in a line contact along y"),
                "bulk_stress_x, upper_bulk_stress_x, tilt_x or tilt_moment_x",
            );
        }
        for (body, key) in ["bulk_stress_x or _y", "upper_bulk_stress_x or _y"].into_iter().enumerate() {
            if let (Some(span), Some(pair)) = (of_body(body), bodies) {
                let stretched = [pair.lower(), pair.upper()][body];
                if substrate(stretched).is_none() {
                    without_substrate(judge, &place, key, stretched, span);
                }
            }
        }
    }
}

fn one_or_two(judge: &mut Judge, place: &str, key: &str, given: &Given) {
    let (message, help) = match (given.values.len(), judge.dimension) {
        (2, Dimension::Line) => {
            ("two values in a line contact, in which nothing changes along y", "one number")
        }
        (1, Dimension::Plane) => ("one number, but the contact has two axes", "[along x, along y]"),
        _ => return,
    };
    judge.refuse::<()>(given.span(), format!("{place}.{key}: {message}"), &format!("{key} = {help}"));
}

fn without_substrate(judge: &mut Judge, place: &str, key: &str, body: &Body, span: Range<usize>) {
    let why = if *body == Body::Rigid {
        "this body is rigid"
    } else {
        "the layers of this body lie on a rigid base"
    };
    judge.refuse::<()>(
        span,
        format!("{place}.{key}: {why}: there is no substrate to be stretched"),
        "bulk stress is the remote stress of a substrate",
    );
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{BALL, ROLLER, read, refused};

    const SUBSTRATE: &str = "substrate = { young = 1.0, poisson = 0.3 }";
    const ON_RIGID: &str = "coatings = [{ thickness = 1.0, young = 1.0, poisson = 0.3 }]\nbase = \"rigid\"";

    #[test]
    fn tilt_and_bulk_stress_have_a_value_for_each_axis() {
        let stage = |words: &str| format!("increments = 1\n{words}");
        for key in ["tilt", "tilt_moment", "bulk_stress"] {
            let [one, two] = ["1e-3", "[1e-3, 0.0]"];
            read(BALL, &[("increments = 1", &stage(&format!("{key} = {two}")))]);
            read(ROLLER, &[("increments = 1", &stage(&format!("{key} = {one}")))]);
            let words = "one number, but the contact has two axes";
            refused(BALL, &[("increments = 1", &stage(&format!("{key} = {one}")))], words, one);
            let words = "two values in a line contact";
            refused(ROLLER, &[("increments = 1", &stage(&format!("{key} = {two}")))], words, two);
        }
    }

    #[test]
    fn only_a_substrate_is_stretched() {
        let stage = |key: &str| format!("increments = 1\n{key} = [1e-3, 0.0]");
        let place = "[1e-3, 0.0]";
        refused(BALL, &[("increments = 1", &stage("upper_bulk_stress"))], "this body is rigid", place);
        let layer = (SUBSTRATE, ON_RIGID);
        refused(BALL, &[layer, ("increments = 1", &stage("bulk_stress"))], "lie on a rigid base", place);
        read(BALL, &[("rigid = true", SUBSTRATE), ("increments = 1", &stage("upper_bulk_stress"))]);
    }

    #[test]
    fn neither_a_strain_nor_a_tilt_is_periodic_or_on_a_grid_of_no_size() {
        let periodic = ("[3.0, 3.0]", "[3.0, 3.0]\nperiodic = true");
        let auto = ("[3.0, 3.0]", "\"auto\"");
        for key in ["tilt", "bulk_stress"] {
            let stage = format!("increments = 1\n{key} = [1e-3, 0.0]");
            let words = format!("load[0].{key} in a periodic case");
            refused(BALL, &[periodic, ("increments = 1", &stage)], &words, "[1e-3, 0.0]");
        }
        let tilted = ("increments = 1", "increments = 1\ntilt = [1e-3, 0.0]");
        refused(BALL, &[auto, tilted], "the contact moves sideways", "\"auto\"");
        read(BALL, &[auto, ("increments = 1", "increments = 1\nbulk_stress = [1e-3, 0.0]")]);
    }

    /// Tables prescribe the same as numbers do.
    #[test]
    fn a_table_stretches_and_tilts_no_more_than_a_stage_may() {
        use crate::case::{Attachments, Case};
        let found = |text: &str, head: &str| {
            let text =
                text.replacen("normal_force = 0.01\nincrements = 1", "table = \"a.csv\"\nincrements = 1", 1);
            let table = format!("normal_force,{head}\n0.01,1e-3\n");
            let file = |_: &str| Ok(table.clone().into_bytes());
            let error = Case::from_toml_with(&text, "case.toml", Attachments::files(&file)).err();
            error.map(|error| {
                error.mistakes().iter().map(|one| one.message.clone()).collect::<Vec<_>>().join("; ")
            })
        };
        for (text, head) in [
            (BALL, "tilt_x"),
            (BALL, "tilt_moment_y"),
            (BALL, "bulk_stress_y"),
            (ROLLER, "bulk_stress_x"),
            (ROLLER, "tilt_x"),
        ] {
            assert_eq!(found(text, head), None, "{head}");
        }
        for head in ["tilt_y", "tilt_moment_y", "bulk_stress_y"] {
            let message = found(ROLLER, head).unwrap();
            assert!(message.contains("along y in a line contact along y"), "{head}: {message}");
        }
        let message = found(BALL, "upper_bulk_stress_x").unwrap();
        assert!(message.contains("upper_bulk_stress_x or _y: this body is rigid"), "{message}");
        let periodic = BALL.replacen("[3.0, 3.0]", "[3.0, 3.0]\nperiodic = true", 1);
        for (head, key) in [("tilt_x", "a tilt"), ("bulk_stress_x", "bulk_stress")] {
            let message = found(&periodic, head).unwrap();
            assert!(message.contains(&format!("load[0].{key} in a periodic case")), "{head}: {message}");
        }
    }
}
