//! The judgement of what is asked about stresses under the surface.

use serde::{Deserialize, Serialize};

use super::file::DepthsFile;
use super::judge::Judge;
use super::known::Known;
use super::output::Output;
use crate::document::At;
use crate::model::{Body, Side};
use crate::subsurface::depth_points;
use crate::subsurface::fatigue::FatigueConstants;

/// What is asked about stresses under the surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressRequest {
    /// Depths under the surface of the body [length]; `None`: chosen.
    pub depths: Option<Vec<f64>>,
    /// The body.
    pub body: Side,
    /// Every so many kept increments are looked at, and the last.
    pub every: usize,
    /// Whether volumes are written.
    pub volume: bool,
    /// Constants for fatigue of the layers that have none of their own.
    pub fatigue: FatigueConstants,
}

impl Default for StressRequest {
    fn default() -> Self {
        Self {
            depths: None,
            body: Side::Lower,
            every: 1,
            volume: false,
            fatigue: FatigueConstants::default(),
        }
    }
}

/// The request of a case; `None` when there is none, or when it was refused.
pub(super) fn stress(judge: &mut Judge, known: &Known<'_>, output: Option<&Output>) -> Option<StressRequest> {
    let table = known.file.stress.as_ref()?;
    let file = &table.value;
    if file.torsion_limit.is_some() != file.tension_limit.is_some() {
        judge.refuse::<()>(
            table.span(),
            "stress: torsion_limit and tension_limit belong together",
            "Crossland's and Dang Van's criteria need both fatigue limits",
        );
    }
    let body = file.body.as_ref().map_or(Side::Lower, |side| side.value);
    let place = file.body.as_ref().map_or_else(|| table.span(), At::span);
    let half_space = match known.bodies.map(|pair| body.of(pair)) {
        Some(Body::Rigid) => {
            let other = if body == Side::Lower { "upper" } else { "lower" };
            judge.refuse::<()>(
                place,
                format!("stress: the {} body is rigid: there is no stress in it", body.name()),
                &format!("body = \"{other}\""),
            );
            None
        }
        Some(Body::Elastic(half_space)) => Some(half_space),
        None => None,
    };
    let depths = match &file.depths {
        None => None,
        Some(depths) => match &depths.value {
            DepthsFile::Auto(_) => None,
            DepthsFile::Given(list) => {
                if let Some(half_space) = half_space
                    && let Err(error) = depth_points(half_space, list)
                {
                    judge.refuse::<()>(
                        depths.span(),
                        format!("stress.depths: {error}"),
                        "or depths = \"auto\"",
                    );
                }
                Some(list.clone())
            }
        },
    };
    if output.is_some_and(|output| {
        !output.keeps("pressure") || !(known.is_frictionless() || output.keeps("shear"))
    }) {
        judge.refuse::<()>(
            table.span(),
            "stress: the tractions are not kept, from which stresses are made",
            "output.fields = [\"pressure\", \"shear\", ...]",
        );
    }
    let fatigue = FatigueConstants {
        yield_strength: file.yield_strength,
        normal_stress_sensitivity: file.normal_stress_sensitivity,
        torsion_limit: file.torsion_limit,
        tension_limit: file.tension_limit,
        critical_distance: file.critical_distance,
        ..FatigueConstants::default()
    };
    let every = file.every.unwrap_or(1);
    Some(StressRequest { depths, body, every, volume: file.volume.unwrap_or(false), fatigue })
}

#[cfg(test)]
mod tests {
    use super::Side;
    use crate::case::check::tests::{BALL, read, refused};

    const BODIES: (&str, &str) = ("rigid = true", "substrate = { young = 2.0, poisson = 0.3 }");

    fn with_stress(words: &str) -> String {
        format!("[stress]\n{words}\n[friction]")
    }

    #[test]
    fn a_request_is_read_as_it_is_written() {
        let request =
            |words: &str| read(BALL, &[BODIES, ("[friction]", &with_stress(words))]).stress.unwrap();
        let plain = request("");
        assert_eq!((plain.depths, plain.body, plain.every, plain.volume), (None, Side::Lower, 1, false));
        let all = request(
            "depths = [0.0, 0.5]\nbody = \"upper\"\nevery = 3\nvolume = true\nyield_strength = 1.5\n\
             normal_stress_sensitivity = 0.0\ntorsion_limit = 2.5\ntension_limit = 3.5\ncritical_distance = 0.25",
        );
        assert_eq!(
            (all.depths, all.body, all.every, all.volume),
            (Some(vec![0.0, 0.5]), Side::Upper, 3, true)
        );
        let constants = all.fatigue;
        assert_eq!((constants.yield_strength, constants.normal_stress_sensitivity), (Some(1.5), Some(0.0)));
        assert_eq!((constants.torsion_limit, constants.tension_limit), (Some(2.5), Some(3.5)));
        assert_eq!(constants.critical_distance, Some(0.25));
        assert_eq!([Side::Lower, Side::Upper].map(Side::name), ["lower", "upper"]);
    }

    #[test]
    fn what_a_request_cannot_mean_is_refused() {
        let refused = |words: &str, message: &str, place: &str| {
            refused(BALL, &[("[friction]", &with_stress(words))], message, place);
        };
        for value in ["0.0", "-1.5", "inf", "nan"] {
            for key in ["yield_strength", "critical_distance"] {
                refused(&format!("{key} = {value}"), "must be a positive finite", value);
            }
        }
        for value in ["-0.5", "inf", "nan"] {
            refused(&format!("normal_stress_sensitivity = {value}"), "must be zero or positive", value);
        }
        refused("every = 0", "stress.every = 0", "0");
        refused("depths = \"deep\"", "found the text \"deep\"", "\"deep\"");
        refused("depths = [-1.0]", "stress.depths", "[-1.0]");
        refused("body = \"upper\"", "the upper body is rigid", "\"upper\"");
    }

    #[test]
    fn limits_belong_together_and_stresses_need_their_tractions() {
        let message = |changes: &[(&str, &str)]| {
            let text = changes.iter().fold(BALL.to_owned(), |text, (from, to)| text.replacen(from, to, 1));
            crate::case::Case::from_toml(&text, "case.toml").err().map(|error| error.to_string())
        };
        for limit in ["torsion_limit = 1.0", "tension_limit = 1.0"] {
            let found = message(&[("[friction]", &with_stress(limit))]).unwrap_or_default();
            assert!(found.contains("belong together"), "{found}");
        }
        let kept = |fields: &str| format!("[output]\nfields = {fields}\n{}", with_stress(""));
        let without_friction = ("coefficient = 0.3", "coefficient = 0.0");
        for fields in ["[\"shear\"]", "[\"pressure\"]", "[\"slip\"]"] {
            let found = message(&[("[friction]", &kept(fields))]).unwrap_or_default();
            assert!(found.contains("the tractions are not kept"), "{fields}: {found}");
        }
        assert_eq!(message(&[("[friction]", &kept("[\"pressure\", \"shear\"]"))]), None);
        assert_eq!(message(&[without_friction, ("[friction]", &kept("[\"pressure\"]"))]), None);
        let found = message(&[without_friction, ("[friction]", &kept("[\"shear\"]"))]).unwrap_or_default();
        assert!(found.contains("the tractions are not kept"), "{found}");
    }
}
