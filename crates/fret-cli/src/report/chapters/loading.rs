//! Loads through the history, and the loop of force and displacement.

use fret_core::model::Control;
use fret_core::study::{PartialSlip, TangentialForm};
use maud::{Markup, html};

use super::loop_table::loop_table;
use crate::report::{Measured, Overview, chapter, joined, side_by_side};
use fret_drawing::{Chart, Curve, Label, Stroke};

/// Earlier cycles that are drawn behind the last one.
const MOST_BEHIND: usize = 8;

/// Normal force over approach or mean gap, and the loads over the increments.
pub fn loading(view: &Overview<'_>) -> Markup {
    let table = &view.results.table;
    let ((closeness, values), force) = (view.closeness(), table.column("normal_force"));
    let mut curves = vec![Curve::line(joined(values, force), "computed", 0)];
    let mut caption = format!("Normal force over {closeness}.");
    if let Some(form) = &view.normal_form {
        let most = force.iter().copied().fold(0.0, f64::max);
        let curve = (1..=100).filter_map(|part| {
            let force = most * (f64::from(part) / 100.0).powi(3);
            form.under(Control::Force(force)).and_then(|pressed| Some([pressed.approach()?, force]))
        });
        let name = form.name();
        curves.insert(0, Curve::dashed(std::iter::once([0.0; 2]).chain(curve).collect(), name, 1));
        caption += &format!(" Dashed: {name}, without friction.");
    }
    let axes = [view.label(closeness, "length"), view.label_of("normal_force")];
    let mut figures =
        vec![Chart::new(&format!("normal force over {closeness}"), axes, curves).figure(&caption)];
    if table.rows() > 1 {
        let ([from, to], called) = view.shown_increments();
        let over_number = |values: &[f64]| joined(&table.column("increment")[from..to], &values[from..to]);
        let mut loads = vec![Curve::line(over_number(force), "normal force", 0)];
        if view.direction.is_some() {
            loads.push(Curve::line(over_number(&view.tangential), "tangential force", 1));
        }
        let chart = Chart::over_increments("forces", view.label("force", "force"), loads);
        figures.push(chart.figure(&format!("Forces through the history, prescribed or found.{called}")));
    }
    if view.twists {
        let points = joined(table.column("increment"), table.column("twist_moment"));
        let (name, label) = ("torsional moment", view.label("torsional moment", "force x length"));
        let chart = Chart::over_increments("moment", label, vec![Curve::line(points, name, 0)]);
        figures.push(chart.figure("Torsional moment through the history."));
    }
    chapter("Loading", &side_by_side(&figures))
}

/// Tangential force over displacement, or moment over rotation where that is what moves; nothing of a contact that rolls to the end.
pub fn fretting_loop(view: &Overview<'_>) -> Markup {
    if view.rolls_to_the_end().is_some() || (view.direction.is_none() && !view.twists) {
        return html! {};
    }
    let axes = view.labels_of_loop();
    let what = format!("{} over {}", axes[1].name, axes[0].name);
    let mut caption = if view.twists {
        "Moment over rotation.".to_owned()
    } else {
        "Tangential force over relative displacement, both along the load.".to_owned()
    };
    let mut curves = loop_curves(view);
    let knows_shift = |form: &&TangentialForm| form.any(|slip| slip.shift().is_some());
    if let (Some(form), false) = (view.tangential_form.as_ref().filter(knows_shift), view.twists) {
        let points = (0..view.results.table.rows()).map(|row| {
            let slip = form.after(row);
            slip.and_then(|slip| Some([slip.shift()?, slip.tangential_force()])).unwrap_or([f64::NAN; 2])
        });
        curves.push(Curve::dashed(points.collect(), "closed form", 1));
        caption += if form.any(PartialSlip::neglects_slip_across) {
            " Dashed: the closed form for the same forces (Cattaneo, Mindlin and Deresiewicz). It neglects the slip \
             across the force, and so gives a displacement that is some percent off."
        } else {
            " Dashed: the closed form for the same forces (Cattaneo), relative to the datum."
        };
    }
    let figures = [Chart::new(&what, axes, curves).figure(&caption), stick_fraction(view)];
    chapter("Fretting loop", &html! { (side_by_side(&figures)) (loop_table(view)) })
}

/// The loop: of several cycles the last one, over what came before.
pub fn loop_curves(view: &Overview<'_>) -> Vec<Curve> {
    let all = view.loop_points();
    let cycles = view.cycles();
    let (Some(last), true) = (cycles.last(), cycles.len() > 1) else {
        return vec![Curve::line(all, "computed", 0)];
    };
    // From the increment before: so the loop is closed.
    let of = |[first, after]: &[usize; 2]| all[first.saturating_sub(1)..*after].to_vec();
    let behind = if cycles.len() <= MOST_BEHIND {
        Curve { stroke: Stroke::Faint, ..Curve::line(all.clone(), "all of the history", 0) }
    } else {
        let mut points = all[..cycles[0][1]].to_vec();
        for part in 1..MOST_BEHIND {
            points.push([f64::NAN; 2]);
            points.extend(of(&cycles[part * (cycles.len() - 1) / MOST_BEHIND]));
        }
        Curve { stroke: Stroke::Faint, ..Curve::line(points, "some cycles before", 0) }
    };
    vec![behind, Curve::line(of(last), "last cycle", 0)]
}

/// How much of the contact sticks.
pub fn stick_fraction(view: &Overview<'_>) -> Markup {
    let table = &view.results.table;
    let fractions: Vec<f64> =
        table.column("stick_area").iter().zip(table.column("contact_area")).map(|(s, c)| s / c).collect();
    let ([from, to], called) = view.shown_increments();
    let over_number = |values: &[f64]| joined(&table.column("increment")[from..to], &values[from..to]);
    let mut curves = vec![Curve::line(over_number(&fractions), "computed", 0)];
    let mut caption = format!("Fraction of the contact area that sticks.{called}");
    if let Some(form) = &view.tangential_form {
        let exact: Vec<f64> = (0..table.rows())
            .map(|row| {
                let (after, force) = (form.after(row), table.at("normal_force", row));
                let pressed = view.normal_form.and_then(|form| form.under(Control::Force(force)));
                after.zip(pressed).map_or(f64::NAN, |(after, pressed)| after.stick_area() / pressed.area())
            })
            .collect();
        curves.push(Curve::dashed(over_number(&exact), "closed form", 1));
        caption +=
            " Dashed: the closed form. The computed area counts whole cells, and slip within an increment.";
    }
    let label = Label::plain("stick fraction");
    Chart::over_increments("stick fraction of the contact", label, curves).figure(&caption)
}
