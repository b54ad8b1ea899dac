//! The judgement of conductivities, and of what is asked about friction heat.

use super::judge::{Judge, Reason, first};
use super::known::Known;
use super::output::Output;
use super::parts::{Constant, NamedBody};
use crate::model::stage::{Course, Stage};
use crate::model::{ConductingLayer, Conduction, Conductor, Dimension};

/// Conductors of the lower and the upper body; what was refused conducts nothing.
pub(super) fn conduction(judge: &mut Judge, known: &Known<'_>, output: Option<&Output>) -> Conduction {
    let (before, bodies) = (judge.mistakes.len(), known.written());
    let thermal = bodies.map(|body| conductor(judge, body, &Constant::THERMAL_CONDUCTIVITY, |own| own));
    let electrical =
        bodies.map(|body| conductor(judge, body, &Constant::ELECTRICAL_RESISTIVITY, |own| 1.0 / own));
    let table = known.file.thermal.as_ref();
    let frequency = table.map(|table| table.frequency);
    let conduction = Conduction { thermal, electrical, frequency };
    let Some(table) = table else { return conduction };
    if judge.mistakes.len() > before {
        return conduction;
    }
    if let Some((why, help)) = without_meaning(&conduction, known, output) {
        judge.refuse::<()>(table.span(), format!("thermal: {why}"), help);
    }
    conduction
}

/// Why no temperature can be told of this case, and what to do.
fn without_meaning(conduction: &Conduction, known: &Known<'_>, output: Option<&Output>) -> Option<Reason> {
    let periodic = known.periodic();
    let is_cyclic = |stage: &Stage| matches!(stage.course, Course::Cycles(_));
    let is_kept = output.is_none_or(|output| {
        output.every == Some(1) && ["pressure", "shear", "slip"].iter().all(|name| output.keeps(name))
    });
    first([
        (
            conduction.thermal.iter().all(Option::is_none),
            "neither body conducts heat",
            "thermal_conductivity = ... in every layer and substrate of a body",
        ),
        (known.is_frictionless(), "a contact without friction makes no heat", "[friction] coefficient = ..."),
        (
            known.laws.is_some_and(|laws| laws.iter().any(|law| law.max_shear().is_some())),
            "heat by friction under friction.max_shear, a shear strength, is not computed",
            "without max_shear, or without [thermal]: the contact resistance needs none",
        ),
        (
            known.dimension == Dimension::Line,
            "a line contact: along an infinite line no steady temperature is finite",
            "cells = [x, y], a contact of finite length",
        ),
        (
            periodic.one_axis().is_some(),
            "a case that is periodic along one axis: along an infinite line no steady temperature is finite",
            "a contact of finite length, on a grid around it: periodic = false",
        ),
        (
            periodic.is_both(),
            "a periodic case: heated all over, a half-space has no steady temperature",
            "a single contact, on a grid around it: periodic = false",
        ),
        (
            known.stages.is_some_and(|stages| !stages.last().is_some_and(is_cyclic)),
            "the last stage has no cycles, and only of a cycle is the mean power known",
            "cycles = ... in the last stage",
        ),
        (
            known.stages.is_some_and(|stages| stages.last().is_some_and(Stage::rolls)),
            "the contact rolls in the last stage, and the heat of a cycle is taken to enter both bodies in the same places",
            "a last stage that does not roll, or leave [thermal] out",
        ),
        (
            !is_kept,
            "the heat of a cycle is made of the tractions and the slip of all its increments, which are not kept",
            "[output] every = 1, and fields = [\"pressure\", \"shear\", \"slip\", ...] where fields are given",
        ),
    ])
}

/// The conductor that a body is by a constant, which says its `conductivity`; `None` where no layer has it, or it was refused.
fn conductor(
    judge: &mut Judge,
    body: NamedBody<'_>,
    constant: &Constant,
    conductivity: fn(f64) -> f64,
) -> Option<Conductor> {
    let mut parts = constant.values(judge, body, None, "of all layers and what they lie on, or of none")?;
    let (_, base) = parts.pop()?;
    let layer = |(thickness, own)| ConductingLayer { thickness, conductivity: conductivity(own) };
    // a thickness is refused where the bodies are judged
    Conductor::new(parts.into_iter().map(layer).collect(), conductivity(base)).ok()
}

#[cfg(test)]
mod tests {
    use crate::case::Case;

    const CASE: &str = "[grid]\ncells = [16, 16]\nsize = [3.0, 3.0]\n[upper]\nrigid = true\nUPPER\n[lower]\n\
        coatings = [{ thickness = 0.5, young = 2.0, poisson = 0.3COATING }]\n\
        substrate = { young = 1.0, poisson = 0.3SUBSTRATE }\n[profile.sphere]\nradius = 100.0\n\
        [friction]\ncoefficient = 0.3\n[output]\nevery = EVERY\n[[load]]\nnormal_force = 0.01\nincrements = 1\n\
        [[load]]\ntangential_force = [1e-3, 0.0]\nincrements = 8\ncycles = 1\n";

    fn read(words: [&str; 4], more: &str) -> Result<Case, String> {
        read_from(CASE, words, more)
    }

    fn read_from(case: &str, words: [&str; 4], more: &str) -> Result<Case, String> {
        let [upper, coating, substrate, every] = words;
        let text = case.replace("UPPER", upper).replace("COATING", coating);
        let text = text.replace("SUBSTRATE", substrate).replace("EVERY", every);
        Case::from_toml(&format!("{text}{more}"), "case.toml").map_err(|error| error.to_string())
    }

    const CONDUCTS: [&str; 4] =
        ["thermal_conductivity = 7.0", ", thermal_conductivity = 2.0", ", thermal_conductivity = 5.0", "1"];

    #[test]
    fn conductivities_of_layers_and_of_what_is_rigid_are_read() {
        let case = read(CONDUCTS, "[thermal]\nfrequency = 20.0\n").unwrap();
        let [lower, upper] = case.conduction.thermal.map(Option::unwrap);
        assert_eq!(
            (lower.base(), lower.layers()[0].conductivity, lower.layers()[0].thickness),
            (5.0, 2.0, 0.5)
        );
        assert_eq!((upper.base(), upper.layers().len()), (7.0, 0));
        assert_eq!(case.conduction.frequency, Some(20.0));
        assert!(case.conduction.electrical.iter().all(Option::is_none));
        let current = ["", ", electrical_resistivity = 4.0", ", electrical_resistivity = 0.5", "5"];
        let case = read(current, "").unwrap();
        assert_eq!(case.conduction.electrical[0].as_ref().unwrap().layers()[0].conductivity, 0.25);
        assert!(
            case.conduction.electrical[1].is_none()
                && read(["", "", "", "5"], "").unwrap().conduction.is_none()
        );
    }

    #[test]
    fn what_is_missing_or_has_no_meaning_is_refused_in_words() {
        let [upper, coating, substrate, every] = CONDUCTS;
        let heat = "[thermal]\nfrequency = 20.0\n";
        for (words, more, message) in [
            ([upper, "", substrate, every], heat, "lower.coatings[0]: no thermal_conductivity"),
            ([upper, coating, "", every], "", "lower.substrate: no thermal_conductivity"),
            // that no other part conducts is not told beside it
            (["", "", substrate, every], heat, "lower.coatings[0]: no thermal_conductivity"),
            ([upper, coating, ", thermal_conductivity = -5.0", every], "", "must be positive"),
            (["thermal_conductivity = inf", coating, substrate, every], "", "must be positive"),
            ([upper, coating, substrate, every], "[thermal]\nfrequency = 0.0\n", "thermal.frequency"),
            ([upper, coating, substrate, every], "[thermal]\nfrequency = inf\n", "thermal.frequency"),
            (
                ["", ", electrical_resistivity = 1.1e100", ", electrical_resistivity = 1.0", every],
                "",
                "between 1e-100",
            ),
            (["", "", "", every], heat, "neither body conducts heat"),
            ([upper, coating, substrate, "2"], heat, "which are not kept"),
            (
                [upper, coating, substrate, every],
                "[[load]]\nshift = [0.0, 0.0]\nincrements = 1\n[thermal]\nfrequency = 1.0\n",
                "no cycles",
            ),
        ] {
            let error = read(words, more).unwrap_err();
            assert!(error.contains(message), "{words:?} {more}: {error}");
            assert_eq!(error.matches("error: ").count(), 1, "{error}");
        }
    }

    /// The bound before an increment does not follow from pressure and shear after it.
    #[test]
    fn no_heat_is_told_of_an_interface_with_a_shear_strength() {
        let with_strength = |heat: &str| {
            let text = CASE.replace("coefficient = 0.3", "coefficient = 0.3\nmax_shear = 1e-3");
            read_from(&text, CONDUCTS, heat)
        };
        assert!(with_strength("").unwrap().conduction.thermal[0].is_some());
        let error = with_strength("[thermal]\nfrequency = 20.0\n").unwrap_err();
        assert!(error.contains("friction.max_shear"), "{error}");
    }

    #[test]
    fn the_heat_of_a_cycle_needs_its_tractions_and_its_slip() {
        let fields = |names: &str| {
            let [upper, coating, substrate, _] = CONDUCTS;
            let every = format!("1\nfields = {names}");
            read([upper, coating, substrate, &every], "[thermal]\nfrequency = 20.0\n")
        };
        fields("[\"slip\", \"gap\", \"shear\", \"pressure\"]").unwrap();
        for names in ["[\"shear\", \"slip\"]", "[\"pressure\", \"slip\"]", "[\"pressure\", \"shear\"]"] {
            assert!(fields(names).unwrap_err().contains("which are not kept"), "{names}");
        }
    }
}
