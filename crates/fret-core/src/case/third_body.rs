//! The judgement of what lies between worn surfaces: debris that stays, and air that comes to the rim of the contact alone.

use super::judge::Judge;
use super::stage_file::WearFile;
use crate::document::At;
use crate::model::{DebrisRule, Kinematics, RimRule, WearLayers};

/// Debris and rim of a case that `repeats` or not, of layers that wear each by its own coefficient; what has no meaning is refused.
pub(super) fn third_body(
    judge: &mut Judge,
    file: &WearFile,
    (kinematics, repeats): (Kinematics, bool),
    layers: Option<&WearLayers>,
) -> (Option<DebrisRule>, Option<RimRule>) {
    let tables = [(file.debris.as_ref().map(At::span), "debris"), (file.rim.as_ref().map(At::span), "rim")];
    judge.refuse_given(tables.map(|(span, table)| {
        let message = format!("wear.{table} in a periodic case: a contact that repeats has no rim");
        (span.filter(|_| repeats), message, "grid.periodic = false")
    }));
    let debris = file.debris.as_ref().map(|given| DebrisRule {
        fraction: given.value.fraction,
        outflow_length: given.value.outflow_length,
        stiffness: given.value.stiffness,
    });
    let rim = file.rim.as_ref().map(|given| {
        let rim = &given.value;
        if let Some(upper) = rim.upper_interior.as_ref().filter(|_| !kinematics.is_finite()) {
            judge.refuse::<()>(
                upper.span(),
                "wear.rim.upper_interior: surfaces that stay where they are have one wear depth for both bodies",
                "[kinematics] displacement = \"finite\"; or interior, which then holds for both",
            );
        }
        let upper = rim.upper_interior.as_ref().map_or(rim.interior, |given| given.value);
        RimRule { width: rim.width, interior: [rim.interior, upper] }
    });
    let heaps = debris.zip(layers).is_some_and(|(debris, layers)| heaps_up(debris, rim, layers));
    if let (Some(given), true) = (&file.debris, heaps && kinematics.is_finite()) {
        judge.refuse::<()>(
            given.span(),
            "wear.debris with kinematics.displacement = \"finite\": more debris comes to rest on the lower body than that loses, so its \
             highest places grow and carry ever more",
            "fraction x (both coefficients) at most the lower one: a smaller fraction, or the body that wears more as the lower one; or \
             displacement = \"small\"",
        );
    }
    (debris, rim)
}

/// Whether debris of both bodies can come to rest on the lower one faster than that wears, in any of their layers, at the rim or inside. A
/// high place of it is pressed on more, and grows; it does not where it is worn as much as it receives.
fn heaps_up(debris: DebrisRule, rim: Option<RimRule>, layers: &WearLayers) -> bool {
    let [lower, upper] =
        layers.bodies().map(|body| body.iter().map(|layer| layer.coefficient).collect::<Vec<_>>());
    let least = lower.into_iter().reduce(f64::min).unwrap_or(0.0);
    let most = upper.into_iter().fold(0.0, f64::max);
    let inside = rim.map_or([1.0; 2], |rim| rim.interior);
    [[1.0; 2], inside].iter().any(|[of_lower, of_upper]| {
        let [least, most] = [least * of_lower, most * of_upper];
        debris.fraction * (least + most) > least * (1.0 + 1e-12)
    })
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{BALL, read, refused};
    use crate::model::{DebrisRule, RimRule};

    const FINITE: (&str, &str) = ("[friction]\n", "[kinematics]\ndisplacement = \"finite\"\n[friction]\n");

    fn with(tables: &str) -> String {
        format!("increments = 1\n[wear]\ncoefficient = 1e-3\n{tables}")
    }

    #[test]
    fn debris_and_rim_are_read() {
        let text = with(
            "[wear.debris]\nfraction = 0.25\noutflow_length = 3.0\nstiffness = 7.0\n[wear.rim]\nwidth = 0.1\ninterior = 0.2\n",
        );
        let rule = read(BALL, &[("increments = 1\n", &text)]).wear.unwrap();
        assert_eq!(
            rule.debris,
            Some(DebrisRule { fraction: 0.25, outflow_length: Some(3.0), stiffness: Some(7.0) })
        );
        assert_eq!(rule.rim, Some(RimRule { width: 0.1, interior: [0.2; 2] }));
        let stays = with("[wear.debris]\nfraction = 1.0\n");
        let rule = read(BALL, &[("increments = 1\n", &stays)]).wear.unwrap();
        assert_eq!((rule.debris.unwrap().outflow_length, rule.rim), (None, None));
    }

    #[test]
    fn each_body_has_a_number_inside_where_each_wears_by_itself() {
        let rim = "[wear]\n[wear.rim]\nwidth = 0.1\ninterior = 0.2\nupper_interior = 0.02\n";
        let text = format!("increments = 1\n{rim}");
        let worn = ("[upper]\nrigid = true\n", "[upper]\nrigid = true\nwear_coefficient = 1e-3\n");
        let case = read(BALL, &[worn, FINITE, ("increments = 1\n", &text)]);
        assert_eq!(case.wear.unwrap().rim, Some(RimRule { width: 0.1, interior: [0.2, 0.02] }));
        refused(BALL, &[worn, ("increments = 1\n", &text)], "one wear depth for both bodies", "0.02");
    }

    #[test]
    fn what_has_no_rim_is_refused() {
        let debris = "[wear.debris]\nfraction = 0.5\n";
        for (tables, message, place) in [
            ("[wear.debris]\nfraction = 1.5\n", "between 0 and 1", "1.5"),
            ("[wear.debris]\nfraction = 0.5\noutflow_length = 0.0\n", "positive", "0.0"),
            ("[wear.debris]\noutflow_length = 1.0\n", "fraction", "[wear.debris]"),
            ("[wear.debris]\nfraction = 0.5\nstiffness = 0.0\n", "positive", "0.0"),
            ("[wear.rim]\nwidth = 1.0\ninterior = -0.5\n", "zero or positive", "-0.5"),
        ] {
            refused(BALL, &[("increments = 1\n", &with(tables))], message, place);
        }
        let above = ("[upper]\nrigid = true\n", "[upper]\nrigid = true\nwear_coefficient = 1e-3\n");
        let below = ("poisson = 0.3 }", "poisson = 0.3, wear_coefficient = 1e-3 }");
        let half = |fraction: f64| format!("increments = 1\n[wear]\n[wear.debris]\nfraction = {fraction}\n");
        read(BALL, &[above, below, FINITE, ("increments = 1\n", &half(0.5))]);
        read(BALL, &[above, below, ("increments = 1\n", &half(0.9))]);
        let too_much = half(0.51);
        refused(BALL, &[above, below, FINITE, ("increments = 1\n", &too_much)], "grow", "[wear.debris]");
        refused(BALL, &[above, FINITE, ("increments = 1\n", &half(0.1))], "grow", "[wear.debris]");
        let periodic = ("[grid]\n", "[grid]\nperiodic = true\n");
        let text = with(debris);
        let message = crate::case::Case::from_toml(
            &BALL.replacen(periodic.0, periodic.1, 1).replacen("increments = 1\n", &text, 1),
            "case.toml",
        )
        .unwrap_err()
        .to_string();
        assert!(message.contains("a contact that repeats has no rim"), "{message}");
    }
}
