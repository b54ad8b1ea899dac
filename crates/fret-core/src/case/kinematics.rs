//! The judgement of how the surfaces move, and of what moving surfaces cannot be combined with.

use super::judge::Judge;
use super::known::Known;
use super::surface_file::OfFile;
use crate::document::At;
use crate::model::{Displacement, Frame, Kinematics, Periodicity, Side};

/// The way out of most refusals.
const SMALL: &str = "displacement = \"small\", which leaves the surfaces where they are; or leave it out";
const FINITE: &str = "kinematics.displacement = \"finite\"";

/// How the surfaces move; refuses what they cannot be combined with.
pub(super) fn kinematics(judge: &mut Judge, known: &Known<'_>) -> Kinematics {
    let file = known.file;
    let given = file.kinematics.as_ref().and_then(|given| given.value.displacement.as_ref());
    let moves_with = file.friction.as_ref().and_then(|friction| friction.moves_with.as_ref());
    let displacement = given.map_or_else(Displacement::default, |given| given.value);
    let frame = file.kinematics.as_ref().and_then(|given| given.value.frame.as_ref());
    // A contact that rolls on and on stays where it is.
    let default = if known.loading().is_steady() { Frame::Contact } else { Frame::Bodies };
    let frame = frame.map_or(default, |given| given.value);
    let beyond_maps = file.kinematics.as_ref().and_then(|given| given.value.beyond_maps.as_ref());
    if let Some(given) = beyond_maps.filter(|_| frame == Frame::Bodies) {
        judge.refuse::<()>(
            given.span(),
            "kinematics.beyond_maps with frame = \"bodies\": the grid is fixed to the bodies, and no map leaves it",
            "leave it out, or frame = \"contact\"",
        );
    }
    let kinematics = Kinematics {
        displacement,
        friction_of_upper: moves_with.is_some_and(|given| given.value == Side::Upper),
        frame,
        beyond_maps: beyond_maps.map(|given| given.value),
    };
    if !kinematics.is_finite() {
        if let Some(given) = moves_with.filter(|_| kinematics.friction_of_upper) {
            judge.refuse::<()>(
                given.span(),
                "friction.moves_with = \"upper\": surfaces that stay where they are do not move with a body",
                "[kinematics] displacement = \"finite\"",
            );
        }
        return kinematics;
    }
    let one_axis = |periodic: &At<Periodicity>| periodic.value.one_axis().is_some();
    let periodic = file.grid.periodic.as_ref().filter(|periodic| one_axis(periodic));
    let beyond = file.grid.beyond.as_ref().filter(|beyond| !beyond.value.is_body());
    let heights = file.profile.as_ref().and_then(|profile| profile.value.heights.as_ref());
    let of = heights.and_then(|heights| heights.value.of.as_ref()).filter(|of| of.value == OfFile::Gap);
    let coefficient = file.wear.as_ref().and_then(|wear| wear.value.coefficient.as_ref());
    let body = file.stress.as_ref().and_then(|stress| stress.value.body.as_ref());
    judge.refuse_given([
        (
            periodic.map(At::span),
            format!("grid.periodic along one axis with {FINITE}: surfaces move where all of them repeats, or none"),
            SMALL,
        ),
        (
            beyond.map(At::span),
            format!("grid.beyond = \"no body\" with {FINITE}: nothing says which body ends there, and moves its edge"),
            "a flat_punch or a rounded_punch in [upper.profile] has an edge that moves",
        ),
        (
            of.map(At::span),
            format!("profile.heights.of = \"gap\" with {FINITE}: nothing says which body the heights are of"),
            "[upper.profile.heights] or [lower.profile.heights], of = \"surface\"",
        ),
        (
            coefficient.map(At::span),
            format!("wear.coefficient with {FINITE}: it is that of both bodies together, and each wears in its own frame"),
            "wear_coefficient = ... in the layers, substrates and rigid bodies that wear",
        ),
        (
            file.thermal.as_ref().map(At::span),
            format!("thermal with {FINITE}: the heat of a cycle is taken to enter both bodies in the same places"),
            SMALL,
        ),
        (
            body.filter(|body| body.value == Side::Upper).map(At::span),
            format!("stress.body = \"upper\" with {FINITE}: tractions are kept in the frame of the lower body"),
            "name the body whose stresses are asked for as the lower one",
        ),
    ]);
    kinematics
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{BALL, read, refused};

    const MOVES: (&str, &str) = ("[friction]\n", "[kinematics]\ndisplacement = \"finite\"\n[friction]\n");

    fn with(text: &str) -> (&str, &str) {
        ("increments = 1\n", text)
    }

    #[test]
    fn what_cannot_move_is_refused() {
        assert!(read(BALL, &[MOVES]).kinematics.is_finite() && read(BALL, &[]).kinematics.is_default());
        let wear = with("increments = 1\n[wear]\ncoefficient = 1e-3\n");
        refused(BALL, &[MOVES, wear], "each wears in its own frame", "1e-3");
        for turn in ["twist", "twist_moment"] {
            let turn = format!("increments = 1\n[[load]]\n{turn} = 1e-3\nincrements = 1\n");
            assert!(read(BALL, &[MOVES, with(&turn)]).kinematics.is_finite());
        }
        let ends = ("size = [3.0, 3.0]", "size = [3.0, 3.0]\nbeyond = \"no body\"");
        refused(BALL, &[MOVES, ends], "which body ends there", "\"no body\"");
        let map = ("coefficient = 0.3\n", "coefficient = 0.3\nmoves_with = \"upper\"\n");
        refused(BALL, &[map], "stay where they are", "\"upper\"");
        assert!(read(BALL, &[MOVES, map]).kinematics.friction_of_upper);
        let evolution = "{ by = \"energy\", last = 0.6, scale = 1e-4 }";
        let both = format!("coefficient = 0.3\nmoves_with = \"upper\"\nevolution = {evolution}\n");
        assert!(read(BALL, &[MOVES, ("coefficient = 0.3\n", &both)]).kinematics.friction_of_upper);
    }
}
