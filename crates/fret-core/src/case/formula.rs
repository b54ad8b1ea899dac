//! The judgement of a profile by a formula.

use std::ops::Range;

use super::judge::Judge;
use super::surface_file::FormulaFile;
use crate::document::{At, is_free_name};
use crate::model::formula::VARIABLES;
use crate::model::{Formula, Shape, SurfaceGrid};
use crate::topography::Cells;

/// The shape; `None` when something about it was refused.
pub(super) fn formula(
    judge: &mut Judge,
    place: &str,
    given: &FormulaFile,
    cells: Option<Cells>,
    moves: bool,
) -> Option<Shape> {
    if !judge.places.are_whole_in(&format!("{place}.parameters")) {
        return None;
    }
    let text = &given.expression;
    let before = judge.mistakes.len();
    let mut parameters = Vec::new();
    for (name, value) in given.parameters.iter().flat_map(|named| &named.0) {
        if !is_free_name(name, &VARIABLES) {
            judge.refuse::<()>(
                name.span(),
                format!("{place}.parameters.{}: no name of a parameter", name.value),
                "letters, digits and _, a letter first; not x, y, pi or the name of a function",
            );
        } else if !value.is_finite() {
            judge.refuse::<()>(
                value.span(),
                format!("{place}.parameters.{} = {:?}: must be finite", name.value, value.value),
                "",
            );
        }
        parameters.push((name.value.clone(), value.value));
    }
    if judge.mistakes.len() > before {
        return None;
    }
    let formula = match Formula::new(text, parameters) {
        Ok(formula) => formula,
        Err(error) => {
            let message = format!("{place}.expression: {}", error.message);
            return judge.refuse(inside(text, error.at), message, &error.help);
        }
    };
    for (name, _) in given.parameters.iter().flat_map(|named| &named.0) {
        if !formula.names(&name.value) {
            judge.refuse::<()>(
                name.span(),
                format!("{place}.parameters.{}: the expression does not name it", name.value),
                "leave it out, or correct its name",
            );
        }
    }
    if judge.mistakes.len() > before {
        return None;
    }
    let over = cells.and_then(|cells| Some((cells.count, cells.size?)));
    if let Some([x, y]) = over.and_then(|(count, size)| undefined(&formula, count, size, moves)) {
        return judge.refuse(
            text.span(),
            format!("{place}.expression has no finite value at x = {x:?}, y = {y:?}"),
            "a finite number at every cell and in the middle of the grid; for surfaces that move, on a grid of twice the size around it",
        );
    }
    Some(Shape::Formula(formula))
}

/// Bytes of the case that stand for some of the bytes of a text in quotes: all of them where it is written with escapes.
fn inside(text: &At<String>, part: Range<usize>) -> Range<usize> {
    let span = text.span();
    if span.len() != text.len() + 2 {
        return span;
    }
    // At the end of the text its last letter is shown.
    let start = part.start.min(text.len().saturating_sub(1));
    span.start + 1 + start..span.start + 1 + part.end.clamp(start, text.len())
}

/// A point at which a formula has no finite value: a cell centre, the middle of the grid, or where cells pass when the surface `moves`.
fn undefined(formula: &Formula, count: [usize; 2], size: [f64; 2], moves: bool) -> Option<[f64; 2]> {
    let times = if moves { 2 } else { 1 };
    let spacing = [0, 1].map(|axis| size[axis] / count[axis] as f64);
    // As far as a grid of that many cells can be.
    let grid = SurfaceGrid::new(count.map(|cells| times * cells), spacing).ok()?;
    formula.undefined_on(&grid)
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{BALL, ROLLER, read, refused};

    const SPHERE: &str = "[profile.sphere]\nradius = 100.0";
    const CYLINDER: &str = "[profile.cylinder]\nradius = 100.0\naxis = \"y\"";

    fn formula(expression: &str) -> String {
        format!("[profile.formula]\nexpression = {expression}")
    }

    fn with(expression: &str, parameters: &str) -> String {
        format!("{}\nparameters = {{ {parameters} }}", formula(expression))
    }

    #[test]
    fn a_formula_that_is_none_is_refused_at_its_place() {
        for (expression, words, place) in [
            ("\"(x^2 + y^2)/(2*R)\"", "unknown name \"R\", at character 16", "R"),
            ("\"x^2 + \"", "it ends where a number, a name or ( is expected, at character 7", " "),
            ("'x^2 + 2y'", "found \"y\", expected an operator or the end, at character 8", "y"),
            ("\"(x^2\"", "( that is not closed", "("),
            // with an escape the whole text is shown
            ("\"x^2 \\u002b z\"", "unknown name \"z\", at character 7", "\"x^2 \\u002b z\""),
            ("\"\"", "it ends where a number", ""),
        ] {
            refused(BALL, &[(SPHERE, &formula(expression))], words, place);
        }
        refused(BALL, &[(SPHERE, &formula("3"))], "expected a text in quotes", "3");
        refused(
            BALL,
            &[(SPHERE, "[profile.formula]\nparameters = { R = 1.0 }")],
            "expression",
            "[profile.formula]",
        );
    }

    #[test]
    fn parameters_have_names_and_values() {
        let unused = with("\"x^2/R + y^2\"", "R = 1.0, Q = 1.0");
        refused(BALL, &[(SPHERE, &unused)], "parameters.Q: the expression does not name it", "Q");
        refused(BALL, &[(SPHERE, &with("\"x^2\"", "x = 1.0"))], "parameters.x: no name of a parameter", "x");
        refused(BALL, &[(SPHERE, &with("\"x^2\"", "\"a b\" = 1.0"))], "no name of a parameter", "\"a b\"");
        refused(
            BALL,
            &[(SPHERE, &with("\"x^2/R + y^2\"", "R = nan"))],
            "parameters.R = NaN: must be finite",
            "nan",
        );
        // the expression names it: one mistake, not two
        refused(BALL, &[(SPHERE, &with("\"x^2/R\"", "R = \"1\""))], "expected a number", "\"1\"");
    }

    #[test]
    fn a_value_that_is_none_is_refused_with_its_point() {
        // 16 x 32 cells on 3 x 3: no centre in the middle, which counts, too
        refused(
            BALL,
            &[(SPHERE, &formula("\"x^2 + y^2 + 1/x\""))],
            "no finite value at x = 0.0, y = 0.0",
            "\"x^2 + y^2 + 1/x\"",
        );
        refused(
            BALL,
            &[(SPHERE, &formula("\"sqrt(x + 1) + y^2\""))],
            "no finite value at x = -1.40625, y = -1.453125",
            "\"sqrt(x + 1) + y^2\"",
        );
    }

    #[test]
    fn a_formula_belongs_to_its_kind_of_contact() {
        read(ROLLER, &[(CYLINDER, &formula("\"x^2\""))]);
        refused(
            ROLLER,
            &[(CYLINDER, &formula("\"x^2 + y\""))],
            "profile.formula of y in a line contact",
            "16",
        );
        refused(ROLLER, &[(CYLINDER, &formula("\"1.0\""))], "without an end along x", "16");
        refused(BALL, &[(SPHERE, &formula("\"x^2\""))], "infinite along y", "[16, 32]");
        read(BALL, &[(SPHERE, &formula("\"x^2\"")), ("[3.0, 3.0]", "[3.0, 3.0]\nperiodic = true")]);
        refused(
            BALL,
            &[(SPHERE, &formula("\"x^2 + y^2\"")), ("[3.0, 3.0]", "\"auto\"")],
            "grid.size = \"auto\" with a formula",
            "\"auto\"",
        );
        let roll = "increments = 1\n[[load]]\nroll = [1.0, 0.0]\nincrements = 2";
        refused(
            BALL,
            &[(SPHERE, &formula("\"x^2 + y^2\"")), ("increments = 1", roll)],
            "of a profile that does not roll",
            "[1.0, 0.0]",
        );
    }
}
