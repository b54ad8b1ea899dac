//! The judgement of bulk stress and tilt: where they have a meaning.

use std::ops::Range;

use toml::Spanned;

use super::along::AlongFile;
use super::axis::AxisFile;
use super::course::Stage;
use super::definition::GridSize;
use super::file::GridFile;
use super::judge::Judge;
use super::stage_file::StageFile;

use crate::model::bulk::substrate;
use crate::model::{Body, ContactPair};

/// Refuses bulk stresses of bodies without a substrate, both of them in periodic cases, two values in a line contact and one elsewhere,
/// tilt on a grid whose size is left to the program.
pub(super) fn bulk_and_tilt(
    judge: &mut Judge,
    grid: &GridFile,
    (stages, checked): (&Spanned<Vec<Spanned<StageFile>>>, Option<&[Stage]>),
    bodies: Option<&ContactPair>,
    (is_line, size): (bool, Option<GridSize>),
) {
    let periodic = grid.periodic.as_ref().is_some_and(|periodic| *periodic.get_ref());
    for (index, file) in stages.get_ref().iter().enumerate() {
        let file = file.get_ref();
        let checked = checked.and_then(|checked| checked.get(index));
        let in_table = |does: &dyn Fn(&Stage) -> bool| {
            file.table.as_ref().filter(|_| checked.is_some_and(does)).map(Spanned::span)
        };
        let of_body =
            |body: usize| in_table(&move |stage: &Stage| stage.bulk_stress[body].iter().any(Option::is_some));
        let along_line = in_table(&|stage: &Stage| {
            stage.tilt[1].is_some() || stage.bulk_stress.iter().any(|stress| stress[1].is_some())
        });
        let place = format!("load[{index}]");
        let controls: [Control<'_>; 6] = [
            ("tilt_moment", None, file.tilt_moment.as_ref(), None),
            ("tilt", None, file.tilt.as_ref(), None),
            ("a tilt", None, None, in_table(&Stage::tilts)),
            ("bulk_stress", bodies.map(ContactPair::lower), file.bulk_stress.as_ref(), None),
            ("upper_bulk_stress", bodies.map(ContactPair::upper), file.upper_bulk_stress.as_ref(), None),
            ("bulk_stress", None, None, of_body(0).or(of_body(1))),
        ];
        for (key, body, given, table) in controls {
            let Some(span) = given.map(Spanned::span).or(table) else { continue };
            if periodic {
                judge.refuse::<()>(
                    span,
                    format!("{place}.{key} in a periodic case: neither a strain nor a tilt is periodic"),
                    "a single contact, on a grid around it: periodic = false",
                );
                continue;
            }
            if let Some(given) = given {
                one_or_two(judge, &place, key, given, is_line);
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
        if let (true, Some(span)) = (is_line, along_line) {
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

/// A key, the body that it stretches, what is given, where a table prescribes it.
type Control<'a> =
    (&'a str, Option<&'a Body>, Option<&'a Spanned<AlongFile<AxisFile>>>, Option<Range<usize>>);

fn one_or_two(
    judge: &mut Judge,
    place: &str,
    key: &str,
    given: &Spanned<AlongFile<AxisFile>>,
    is_line: bool,
) {
    match (given.get_ref(), is_line) {
        (AlongFile::Both(_), true) => judge.refuse::<()>(
            given.span(),
            format!("{place}.{key}: two values in a line contact, in which nothing changes along y"),
            &format!("{key} = one number"),
        ),
        (AlongFile::Line(_), false) => judge.refuse::<()>(
            given.span(),
            format!("{place}.{key}: one number, but the contact has two axes"),
            &format!("{key} = [along x, along y]"),
        ),
        _ => None,
    };
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
