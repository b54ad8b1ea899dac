//! A paragraph on methods, for the reader who writes a paper: what was solved, on which grid, how, to which residual.

use fret_core::plan::{Coupling, Plan};
use serde::Serialize;
use serde_json::Value;

use crate::figures::counted;
use fret_results::commit::COMMIT;

/// The paragraph, from the plan of a run as its record has it; `version` and `commit` are those of the program that ran it.
pub fn paragraph<C: Serialize>(plan: &Plan<C>, version: &str, commit: Option<&str>) -> String {
    let case = &serde_json::to_value(&plan.case).unwrap_or_default(); // a case holds nothing that JSON has no form for
    let of = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let ([nx, ny], [width, depth]) = (plan.grid.cells(), plan.grid.size());
    let is_line = plan.grid.is_line();
    let unit = case["units"]["length"].as_str().map_or_else(String::new, |unit| format!(" {unit}"));
    let commit = commit.filter(|commit| *commit != "unknown").map_or_else(String::new, |commit| {
        format!(" (commit {})", commit.chars().take(12).collect::<String>())
    });
    let mut sentences = vec![format!(
        "The {} was solved with fretting {version}{commit}, a boundary element program for elastic half-spaces.",
        if is_line { "line contact (plane strain)" } else { "contact" }
    )];
    let extent = |side: f64| format!("{}{unit}", short(side));
    sentences.push(if is_line {
        format!("The potential contact area, {} long, had {nx} cells of uniform traction.", extent(width))
    } else {
        format!(
            "The potential contact area of {} x {} had {nx} x {ny} cells of uniform traction{}.",
            extent(width),
            extent(depth),
            if case["periodic"] == true { ", repeated periodically along x and y" } else { "" }
        )
    });
    let layers: usize = ["lower", "upper"]
        .iter()
        .filter_map(|body| case["bodies"][body]["elastic"]["coatings"].as_array())
        .map(Vec::len)
        .sum();
    if layers > 0 {
        sentences.push(format!(
            "The response of the layered half-space ({}) followed from its exact frequency response, integrated over the cells.",
            counted(layers, "elastic layer")
        ));
    }
    sentences.push(match plan.coupling {
        Coupling::Frictionless => "There was no friction.".to_owned(),
        coupling => {
            let friction = of(&case["friction"]["coefficient"]["uniform"]);
            let law = if friction.is_finite() {
                format!("Coulomb's law held in every cell with a friction coefficient of {}", short(friction))
            } else {
                "Coulomb's law held in every cell with the coefficients that were prescribed".to_owned()
            };
            let how = if coupling == Coupling::Coupled {
                "pressure and shear were solved together"
            } else {
                "pressure and shear do not act on each other here and were solved one after the other"
            };
            format!("{law}, its direction opposed to slip; {how}.")
        }
    });
    let order = if plan.coupling != Coupling::Frictionless && case["integration"] == "second_order" {
        ", and slip was integrated to second order within each"
    } else {
        ""
    };
    sentences.push(format!(
        "The loading history had {}{order}; the residual of every increment (complementarity, friction law, equilibrium) was at most {:e}.",
        counted(plan.increments, "increment"),
        of(&case["tolerance"])
    ));
    if !case["wear"].is_null() {
        sentences.push("Wear changed the gap from cycle to cycle.".to_owned());
    }
    sentences.join(" ")
}

/// The paragraph of a run of this very program.
pub fn of_plan(plan: &Plan) -> String {
    paragraph(plan, env!("CARGO_PKG_VERSION"), Some(COMMIT))
}

/// A number in four figures.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-3..1e5).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use fret_core::case::Case;

    use super::*;

    fn plan(text: &str) -> Plan {
        Plan::new(Case::from_toml(text, "case.toml").unwrap()).unwrap()
    }

    #[test]
    fn a_paragraph_says_grid_bodies_friction_and_residual() {
        let plane = plan(
            "units = { length = \"mm\", force = \"N\" }\ngrid = { cells = [64, 32], size = [0.4, 0.2] }\nupper = { rigid = true }\n\
             lower = { coatings = [{ thickness = 0.01, young = 2e5, poisson = 0.3 }, { thickness = 0.02, young = 1e5, poisson = 0.3 }],\
             substrate = { young = 2e5, poisson = 0.2 } }\nprofile = { sphere = { radius = 1.0 } }\nfriction = { coefficient = 0.25 }\n\
             [[load]]\nnormal_force = 1.0\nincrements = 33\n",
        );
        assert_eq!(
            paragraph(&plane, "0.1.0", Some("0123456789abcdef")),
            "The contact was solved with fretting 0.1.0 (commit 0123456789ab), a boundary element program for elastic half-spaces. \
             The potential contact area of 0.4 mm x 0.2 mm had 64 x 32 cells of uniform traction. The response of the layered \
             half-space (2 elastic layers) followed from its exact frequency response, integrated over the cells. Coulomb's law \
             held in every cell with a friction coefficient of 0.25, its direction opposed to slip; pressure and shear were solved \
             together. The loading history had 33 increments, and slip was integrated to second order within each; the residual of \
             every increment (complementarity, friction law, equilibrium) was at most 1e-8."
        );
        let line = plan(
            "grid = { cells = 128, size = 2e-4 }\nupper = { rigid = true }\nlower = { substrate = { young = 2e11, poisson = 0.3 } }\n\
             profile = { cylinder = { radius = 0.01, axis = \"y\" } }\nsolver = { tolerance = 1e-9 }\n[[load]]\nnormal_force = 1e3\nincrements = 1\n",
        );
        let words = paragraph(&line, "0.1.0", None);
        assert!(
            words.starts_with("The line contact (plane strain) was solved with fretting 0.1.0, a boundary")
        );
        assert!(
            words.contains("2e-4 long, had 128 cells") && words.contains("There was no friction."),
            "{words}"
        );
        assert!(words.ends_with("at most 1e-9."));
    }
}
