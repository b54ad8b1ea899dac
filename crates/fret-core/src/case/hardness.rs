//! The hardness of the surfaces, and what surfaces that yield cannot be combined with.

use super::body_file::BodyFile;
use super::file::CaseFile;
use super::judge::Judge;
use super::known::Known;
use super::misfits::Misfit;
use crate::document::At;
use crate::model::Kinematics;
use crate::model::controls::{BULK_STRESS, ROLL, TILT};

/// Its key.
pub(super) const HARDNESS: &str = "hardness";

/// The hardness of the softer surface, as it is written.
pub(super) fn of_softer(file: &CaseFile) -> Option<&At<f64>> {
    let given = |body: &'_ BodyFile| body.hardness.as_ref().map(|given| given.value);
    let bodies = [&file.lower.value, &file.upper.value];
    let softer = bodies.into_iter().filter(|body| given(body).is_some());
    softer
        .min_by(|one, other| given(one).unwrap_or_default().total_cmp(&given(other).unwrap_or_default()))?
        .hardness
        .as_ref()
}

/// The pressure at which the softer surface yields [pressure]; `None` where neither does, or it was refused.
pub(super) fn hardness(judge: &mut Judge, known: &Known<'_>, kinematics: Kinematics) -> Option<f64> {
    let (file, loading) = (known.file, known.loading());
    for (which, body) in known.written() {
        let is_rigid = body.rigid.as_ref().is_some_and(|rigid| rigid.value);
        if let Some(given) = body.hardness.as_ref().filter(|_| is_rigid) {
            judge.refuse::<()>(
                given.span(),
                format!("{which}.{HARDNESS}: a body that is rigid does not yield"),
                "the hardness of the other body",
            );
        }
    }
    let given = of_softer(file)?;
    for (freedoms, what) in [(TILT..BULK_STRESS, "a tilt"), (ROLL..ROLL + 2, "a roll")] {
        let misfit = Misfit { freedoms, motions: false, in_table: what };
        let help = format!("no {HARDNESS}, or a contact that keeps its direction and its place");
        misfit.refuse(judge, loading, &format!("with a {HARDNESS}"), &help);
    }
    let moves = file.kinematics.as_ref().filter(|_| kinematics.is_finite());
    judge.refuse_given([
        (
            moves.map(At::span),
            format!("kinematics.displacement = \"finite\" with a {HARDNESS}: nothing says which body carries what has yielded along"),
            "displacement = \"small\", which leaves the surfaces where they are; or leave it out",
        ),
        (
            file.wear.as_ref().map(At::span),
            format!("wear with a {HARDNESS}: nothing says how much of a yielded surface wears"),
            "leave out one of the two",
        ),
    ]);
    Some(given.value)
}
