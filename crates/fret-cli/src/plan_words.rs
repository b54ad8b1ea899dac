//! A plan in words, as `fret check`, `fret plan` and `fret run` tell it.

use fret_core::history::Warning;
use fret_core::model::{Body, Dimension};
use fret_core::plan::{LeftOut, Plan};
use fret_core::run::plausibility;
use fret_core::units::Units;

use crate::figures::{counted, figure_in, shortened};

/// Letters of a stage's name in the list of stages, at the most.
const STAGE_LETTERS: usize = 60;

/// Letters of a warning, at the most: the name of a stage may be long.
const LONGEST_LINE: usize = 1000;

/// A warning in a line: words and a way out.
pub fn warning_line(warning: &Warning) -> String {
    shortened(&format!("warning: {}; {}", warning.message, warning.help), LONGEST_LINE)
}

/// Warnings about the case, one per line, a line break before.
pub fn warnings(plan: &Plan) -> String {
    plausibility::of_plan(plan).iter().map(|warning| format!("\n{}", warning_line(warning))).collect()
}

/// The automatic simplifications, as a block of text.
pub fn left_out(plan: &Plan) -> String {
    if plan.left_out.is_empty() {
        return "automatic simplifications: none".to_owned();
    }
    let told =
        |item: &LeftOut| format!("\n  {}\n    because {}\n    saves {}", item.what, item.why, item.saves);
    let items: String = plan.left_out.iter().map(told).collect();
    format!("automatic simplifications (same result to the solver tolerance):{items}")
}

/// The same for the start of a run: a line an item.
pub fn left_out_in_short(plan: &Plan) -> String {
    let items = plan.left_out.iter().map(|item| format!("\n  {}", item.what));
    format!("automatic simplifications (`fret plan` gives the reasons):{}", items.collect::<String>())
}

/// The grid in a line.
pub fn cells(plan: &Plan) -> String {
    let figure = |value: f64| figure_in(plan.case.units.as_ref(), value, "length");
    let ([nx, ny], [dx, dy], [width, depth]) = (plan.grid.cells(), plan.grid.spacing(), plan.grid.size());
    let datum = plan.datum.map_or_else(String::new, |datum| {
        format!("; approach and shift are relative to {} below the load", figure(datum))
    });
    if plan.grid.dimension() == Dimension::Line {
        return format!("line contact of {nx} cells of {}, {} in all{datum}", figure(dx), figure(width));
    }
    let repeats = match plan.case.periodic.one_axis() {
        Some(_) => format!(", {}", plan.case.periodic.in_words()),
        None => String::new(),
    };
    format!(
        "{nx} x {ny} cells of {} x {}, {} x {} in all{repeats}{datum}",
        figure(dx),
        figure(dy),
        figure(width),
        figure(depth)
    )
}

/// Cells in the contact radius that is expected under the heaviest load: in the shorter one of an ellipse, in the half-width of a line
/// contact. `None` where only the run can tell.
pub fn cells_in_contact_radius(plan: &Plan) -> Option<f64> {
    let (half_widths, spacing) = (plan.expected?.half_widths, plan.grid.spacing());
    plan.grid.dimension().axes().map(|axis| half_widths[axis] / spacing[axis]).reduce(f64::min)
}

/// The expected contact in words.
pub fn expected_contact(plan: &Plan) -> Option<String> {
    let cells = cells_in_contact_radius(plan)?;
    let [x, y] = plan.expected?.half_widths;
    let unit = Units::after(plan.case.units.as_ref(), "length", Dimension::Plane);
    let is_round = (x - y).abs() <= 0.1 * x.max(y); // they are known to a twentieth
    let what = match (plan.grid.dimension(), is_round) {
        (Dimension::Line, _) => format!("half-width, about {}{unit}", two_digits(x)),
        (Dimension::Plane, true) => format!("contact radius, about {}{unit}", two_digits((x * y).sqrt())),
        (Dimension::Plane, false) => {
            format!("shorter half-axis of the contact, about {} x {}{unit}", two_digits(x), two_digits(y))
        }
    };
    Some(format!("{} cells in the expected {what}", two_digits(cells)))
}

/// A number that is known to a twentieth.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// How many uniform layers stand for the coatings: of a graded one as many as its gradient asks for.
pub fn layers(plan: &Plan) -> String {
    let bodies = [("upper", plan.case.bodies.upper()), ("lower", plan.case.bodies.lower())];
    let layers = |(name, body): (&str, &Body)| {
        let Body::Elastic(half_space) = body else { return None };
        let coatings = half_space.coatings();
        let springs = coatings.iter().filter(|coating| !coating.interface().is_bonded()).count();
        let springs = if springs > 0 { format!(", {springs} of them not bonded") } else { String::new() };
        let layers = counted(coatings.len(), "uniform layer");
        (!coatings.is_empty()).then(|| format!("{layers} on the {name} body{springs}"))
    };
    let layered: Vec<String> = bodies.into_iter().filter_map(layers).collect();
    if layered.is_empty() { "none".to_owned() } else { layered.join(", ") }
}

/// Measured surfaces and what is done to them, a line each.
pub fn heights(plan: &Plan) -> String {
    let unit = Units::after(plan.case.units.as_ref(), "length", Dimension::Plane);
    let treated = plan.case.profile.heights.iter().filter_map(|heights| {
        let words = heights.treatment()?.words(&unit).join(", ");
        Some(format!("heights    {}: {words}\n", shortened(heights.source(), STAGE_LETTERS)))
    });
    treated.collect()
}

/// The stages in a line.
pub fn stages(plan: &Plan) -> String {
    let stages = plan.case.stages.iter().map(|stage| match stage.cycles() {
        Some(cycles) => {
            let most = if cycles.until_steady.is_some() { "at most " } else { "" };
            format!(
                "{} ({most}{} of {})",
                shortened(&stage.name, STAGE_LETTERS),
                counted(cycles.most, "cycle"),
                stage.increments
            )
        }
        None => format!("{} ({})", shortened(&stage.name, STAGE_LETTERS), stage.increments),
    });
    stages.collect::<Vec<_>>().join(", ")
}
