//! A paragraph on methods, for the reader who writes a paper: what was solved, on which grid, how, to which residual.

use fret_core::case::Case;
use fret_core::model::{Axis, Body, Dimension, Integration, Periodicity};
use fret_core::plan::{Coupling, Plan};
use fret_core::units::Units;

use crate::figures::{counted, typed};

/// The paragraph, from the plan of a run that solved so many `increments`: one that was made, or that of a record; `version` and `commit` are
/// those of the program that ran it.
pub fn paragraph<M, H>(
    plan: &Plan<Case<M, H>>,
    increments: usize,
    (version, commit): (&str, &str),
) -> String {
    let Plan { case, grid, coupling, .. } = plan;
    let ([nx, ny], [width, depth]) = (grid.cells(), grid.size());
    let unit = Units::after(case.units.as_ref(), "length", Dimension::Plane);
    let commit = match commit {
        "" | "unknown" => String::new(),
        commit => format!(" (commit {})", commit.chars().take(12).collect::<String>()),
    };
    let mut sentences = vec![format!(
        "The {} was solved with fretting {version}{commit}, a boundary element program for elastic half-spaces.",
        match grid.dimension() {
            Dimension::Plane => "contact",
            Dimension::Line => "line contact (plane strain)",
        }
    )];
    let extent = |side: f64| format!("{}{unit}", short(side));
    sentences.push(match grid.dimension() {
        Dimension::Plane => format!(
            "The potential contact area of {} x {} had {nx} x {ny} cells of uniform traction{}.",
            extent(width),
            extent(depth),
            match case.periodic {
                Periodicity::Both(false) => "",
                Periodicity::Both(true) => ", repeated periodically along x and y",
                Periodicity::Along(Axis::X) => ", repeated periodically along x",
                Periodicity::Along(Axis::Y) => ", repeated periodically along y",
            }
        ),
        Dimension::Line => {
            format!("The potential contact area, {} long, had {nx} cells of uniform traction.", extent(width))
        }
    });
    let layers = |body: &Body| match body {
        Body::Elastic(half_space) => half_space.coatings().len(),
        Body::Rigid => 0,
    };
    let layers = layers(case.bodies.upper()) + layers(case.bodies.lower());
    if layers > 0 {
        sentences.push(format!(
            "The response of the layered half-space ({}) followed from its exact frequency response, integrated over the cells.",
            counted(layers, "uniform elastic layer")
        ));
    }
    if case.kinematics.is_finite() {
        sentences.push("The surface of the upper body moved with it (finite displacement).".to_owned());
    }
    if let Some(hardness) = case.hardness {
        let unit = Units::after(case.units.as_ref(), "pressure", case.dimension());
        sentences.push(format!(
            "The contact pressure was bounded by a hardness of {}{unit}: the softer surface was elastic and perfectly plastic.",
            short(hardness)
        ));
    }
    sentences.push(friction(case, *coupling));
    let order = if *coupling != Coupling::Frictionless && case.integration == Integration::SecondOrder {
        ", and slip was integrated to second order within each"
    } else {
        ""
    };
    sentences.push(format!(
        "The loading history had {}{order}; the residual of every increment (complementarity, friction law, equilibrium) was at most {:e}.",
        counted(increments, "increment"),
        case.tolerance
    ));
    if case.wear.is_some() {
        sentences.push("Wear changed the gap from cycle to cycle.".to_owned());
    }
    sentences.join(" ")
}

/// The sentence on the friction law, and how pressure and shear were solved.
fn friction<M, H>(case: &Case<M, H>, coupling: Coupling) -> String {
    if coupling == Coupling::Frictionless {
        return "There was no friction.".to_owned();
    }
    let changes =
        case.friction_evolution.is_some() || case.stages.iter().any(|stage| stage.friction.is_some());
    let coefficient = match case.friction.coefficient().uniform() {
        Some(coefficient) if !changes => format!("a friction coefficient of {}", short(coefficient)),
        _ if case.friction_evolution.is_some() => "a friction coefficient that evolved".to_owned(),
        _ => "the coefficients that were prescribed".to_owned(),
    };
    let strength = if case.friction.max_shear().is_some() { " up to a shear strength" } else { "" };
    let how = if coupling == Coupling::Coupled {
        "pressure and shear were solved together"
    } else {
        "without normal-tangential coupling, pressure and shear were solved one after the other"
    };
    format!(
        "Coulomb's law held in every cell with {coefficient}{strength}, its direction opposed to slip; {how}."
    )
}

/// A number in four figures.
fn short(value: f64) -> String {
    typed(format!("{value:.3e}").parse().unwrap_or(value))
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
            paragraph(&plane, 33, ("0.1.0", "0123456789abcdef")),
            "The contact was solved with fretting 0.1.0 (commit 0123456789ab), a boundary element program for elastic half-spaces. \
             The potential contact area of 0.4 mm x 0.2 mm had 64 x 32 cells of uniform traction. The response of the layered \
             half-space (2 uniform elastic layers) followed from its exact frequency response, integrated over the cells. Coulomb's law \
             held in every cell with a friction coefficient of 0.25, its direction opposed to slip; pressure and shear were solved \
             together. The loading history had 33 increments, and slip was integrated to second order within each; the residual of \
             every increment (complementarity, friction law, equilibrium) was at most 1e-8."
        );
        let line = plan(
            "grid = { cells = 128, size = 2e-4 }\nupper = { rigid = true }\nlower = { substrate = { young = 2e11, poisson = 0.3 } }\n\
             profile = { cylinder = { radius = 0.01, axis = \"y\" } }\nsolver = { tolerance = 1e-9 }\n[[load]]\nnormal_force = 1e3\nincrements = 1\n",
        );
        let words = paragraph(&line, 1, ("0.1.0", "unknown"));
        assert!(
            words.starts_with("The line contact (plane strain) was solved with fretting 0.1.0, a boundary")
        );
        assert!(
            words.contains("2e-4 long, had 128 cells") && words.contains("There was no friction."),
            "{words}"
        );
        assert!(words.ends_with("at most 1e-9."));
        // A coefficient that a stage changes is not named.
        let changing = plan(
            "grid = { cells = [64, 32], size = [0.4, 0.2] }\nupper = { rigid = true }\nlower = { substrate = { young = 2e5, poisson = 0.2 } }\n\
             profile = { sphere = { radius = 1.0 } }\nfriction = { coefficient = 0.25 }\n[[load]]\nnormal_force = 1.0\nincrements = 3\n\
             [[load]]\nfriction = 0.5\ntangential_force = [0.1, 0.0]\nincrements = 2\n",
        );
        let words = paragraph(&changing, 5, ("0.1.0", ""));
        assert!(
            words.contains("with the coefficients that were prescribed, its")
                && words.contains("had 5 increments"),
            "{words}"
        );
    }
}
