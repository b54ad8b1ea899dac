//! The judgement of maps of heights and friction that travel through a grid which goes with a contact that rolls.

use super::judge::Judge;
use super::known::Known;
use super::loading::Prescribed;
use crate::model::Kinematics;

/// Refuses what lies beyond maps that are none.
pub(super) fn beyond_no_map(judge: &mut Judge, known: &Known<'_>) {
    let (Some(profile), Some(laws)) = (known.profile, known.laws) else { return };
    let has_maps = !profile.heights.is_empty() || laws.iter().any(|law| law.is_map());
    let beyond = known.file.kinematics.as_ref().and_then(|given| given.value.beyond_maps.as_ref());
    if let Some(given) = beyond.filter(|_| !has_maps) {
        judge.refuse::<()>(
            given.span(),
            "kinematics.beyond_maps without a map: the case has neither heights nor a friction map",
            "leave it out",
        );
    }
}

/// Refuses them where they leave no steady state, or nothing says what lies beyond them.
pub(super) fn maps_that_travel(judge: &mut Judge, known: &Known<'_>, kinematics: Kinematics) {
    let Known { file, profile, laws, .. } = *known;
    let friction = laws.is_some_and(|laws| laws.iter().any(|law| law.is_map()));
    let heights = profile.is_some_and(|profile| !profile.heights.is_empty());
    let maps = [(friction, "a friction map"), (heights, "topography")];
    let given = file.kinematics.as_ref();
    let steady = known.loading().stages().find(|stage| stage.file.controls.are_steady());
    let (span, why, help) = if let Some(steady) = steady.as_ref().map(Prescribed::roll) {
        (
            steady,
            "roll = \"steady\": places that differ pass by, and nothing becomes steady",
            "roll = a distance in place of \"steady\", and means over it; or leave it out",
        )
    } else {
        let frame = given.and_then(|given| given.value.frame.as_ref());
        let Some(frame) = frame.filter(|_| kinematics.beyond_maps.is_none()) else { return };
        (
            frame.span(),
            "kinematics.frame = \"contact\": it is as long as the grid, and the contact rolls off it",
            "beyond_maps = \"edge\", \"repeats\" or \"mirrors\" says what lies there; or frame = \"bodies\", on a grid that holds all of the way",
        )
    };
    for (_, map) in maps.into_iter().filter(|(is, _)| *is) {
        judge.refuse::<()>(span.clone(), format!("{map} with {why}"), help);
    }
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{ROLLER, read, refused};
    use crate::model::BeyondMaps;

    fn with(stage: &str) -> String {
        format!("increments = 1\n[[load]]\n{stage}\nincrements = 4\n")
    }

    /// A map is as long as the grid: beyond it lies what the case says, and nothing that travels is steady.
    #[test]
    fn what_lies_beyond_a_map_is_said() {
        let values = format!("map = {:?}", vec![0.3; 16]);
        let map = ("coefficient = 0.3", values.as_str());
        let kinematics = |keys: &str| format!("[kinematics]\n{keys}\n[friction]");
        let contact = kinematics("frame = \"contact\"");
        let [there, and_back] = ["roll = 1.5", "roll = 1.5\ncycles = 2"].map(with);
        let rolled = ("increments = 1\n", there.as_str());
        refused(ROLLER, &[map, ("[friction]", &contact), rolled], "rolls off it", "\"contact\"");
        let beyond = kinematics("frame = \"contact\"\nbeyond_maps = \"mirrors\"");
        let beyond = ("[friction]", beyond.as_str());
        let case = read(ROLLER, &[map, beyond, ("increments = 1\n", &and_back)]);
        assert_eq!(case.kinematics.beyond_maps, Some(BeyondMaps::Mirrors));
        refused(ROLLER, &[beyond, rolled], "without a map", "\"mirrors\"");
        let steady = with("roll = \"steady\"");
        refused(
            ROLLER,
            &[map, beyond, ("increments = 1\n", &steady)],
            "nothing becomes steady",
            "\"steady\"",
        );
        let fixed = kinematics("beyond_maps = \"edge\"");
        refused(ROLLER, &[map, ("[friction]", &fixed), rolled], "no map leaves it", "\"edge\"");
    }
}
