//! Energy, comparison with theory, and how well the equations were solved.

use super::{chapter, side_by_side};
use crate::report::chart::{Chart, Curve, Stroke};
use crate::report::html::{deviation, escaped, figure_of, number, pairs, table};
use crate::report::scene::Scene;

/// Cycles listed one by one.
const MOST_CYCLES: usize = 12;

/// Work of friction.
pub fn energy(scene: &Scene<'_>) -> String {
    let history = &scene.results.table;
    let energy = history.column("dissipated_energy");
    if (scene.direction.is_none() && !scene.twists) || energy.last().is_none_or(|energy| *energy == 0.0) {
        return String::new();
    }
    let points = |values: &[f64]| -> Vec<[f64; 2]> {
        history.column("increment").iter().zip(values).map(|(x, y)| [*x, *y]).collect()
    };
    let mut curves = vec![Curve {
        points: points(energy),
        name: Some("computed".to_owned()),
        colour: 0,
        stroke: Stroke::Line,
    }];
    let mut caption = "Work of friction since the start.".to_owned();
    if scene.results.cycles.iter().any(|cycle| cycle.stands_for > 1) {
        caption += " The end of a computed cycle has the work of all cycles that it stands for.";
    }
    if let Some(form) = &scene.tangential_form {
        let exact: Vec<f64> = (0..history.rows())
            .map(|row| {
                form.after(row).map_or(f64::NAN, fret_core::analytic::TangentialHistory::dissipated_energy)
            })
            .collect();
        curves.push(Curve {
            points: points(&exact),
            name: Some("closed form".to_owned()),
            colour: 1,
            stroke: Stroke::Dashed,
        });
        caption += " Dashed: the closed form.";
    }
    let chart = Chart {
        what: "dissipated energy over the increments".to_owned(),
        axes: ["increment".to_owned(), scene.axis("dissipated energy", "force x length")],
        curves,
        logarithmic: false,
        level: None,
    };
    let figure = figure_of(&chart.svg(), &caption);
    let account = cycles(scene);
    let right = if account.is_empty() { String::new() } else { format!("<div>{account}</div>") };
    chapter("Dissipated energy", &side_by_side(&(figure + &right)))
}

/// The energy of each cycle, with the closed form where there is one.
fn cycles(scene: &Scene<'_>) -> String {
    let cycles = &scene.results.cycles;
    let skipped = cycles.len().saturating_sub(MOST_CYCLES);
    let mut head = vec!["cycle", "dissipated in one"];
    if scene.tangential_form.is_some() {
        head.extend(["closed form", "difference"]);
    }
    let shown = cycles.iter().take(1).chain(cycles.iter().skip(1 + skipped));
    let rows: Vec<Vec<String>> = shown
        .map(|cycle| {
            let (before, last) = (cycle.first_increment.checked_sub(1), cycle.last_increment);
            let computed = cycle.dissipated_energy;
            let which = match cycle.stands_for {
                1 => cycle.last_cycle.to_string(),
                all => format!("{} to {}", (cycle.last_cycle + 1).saturating_sub(all), cycle.last_cycle),
            };
            let name = escaped(&scene.stage_name(cycle.stage));
            let mut row = vec![format!("{name}, {which}"), number(computed)];
            if let Some(form) = &scene.tangential_form {
                let at = |row: usize| {
                    form.after(row)
                        .map_or(f64::NAN, fret_core::analytic::TangentialHistory::dissipated_energy)
                };
                // Before its first increment the closed form has dissipated nothing.
                let started = before.map_or(0.0, |before| form.after(before).map_or(0.0, |_| at(before)));
                let exact = at(last) - started;
                row.extend(if exact.is_finite() {
                    [number(exact), deviation(computed, exact)]
                } else {
                    ["–".to_owned(), "–".to_owned()]
                });
            }
            row
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let note = if skipped > 0 {
        format!(
            "<p class=\"small\">The first cycle and the last {} of {}.</p>",
            MOST_CYCLES - 1,
            cycles.len()
        )
    } else {
        String::new()
    };
    format!("<div class=\"scroll\">{}</div>{note}", table(&head, &rows))
}

/// Numbers against the closed form at the end of each stage.
pub fn comparison(scene: &Scene<'_>) -> String {
    let Some(form) = &scene.normal_form else { return String::new() };
    let history = &scene.results.table;
    let mut rows = Vec::new();
    for (stage, [_, end]) in scene.spans.iter().enumerate() {
        let row = end - 1;
        let mut add = |what: &str, computed: f64, exact: f64| {
            let name = escaped(&scene.stage_name(stage));
            rows.push(vec![
                name,
                what.to_owned(),
                number(computed),
                number(exact),
                deviation(computed, exact),
            ]);
        };
        if let Some(pressed) = form.under(history.at("normal_force", row)) {
            add("max pressure", history.at("max_pressure", row), pressed.peak());
            add("contact area", history.at("contact_area", row), pressed.area());
            add("approach", history.at("approach", row), pressed.approach());
        }
    }
    if let Some(form) = &scene.tangential_form {
        let farthest = (0..history.rows())
            .filter(|row| form.after(*row).is_some())
            .max_by(|a, b| scene.tangential[*a].abs().total_cmp(&scene.tangential[*b].abs()));
        if let Some((row, after)) = farthest.and_then(|row| form.after(row).map(|after| (row, after))) {
            let name = escaped(&scene.called(row));
            let mut add = |what: &str, computed: f64, exact: f64| {
                rows.push(vec![
                    name.clone(),
                    what.to_owned(),
                    number(computed),
                    number(exact),
                    deviation(computed, exact),
                ]);
            };
            add("shift", scene.shift[row], after.shift());
            let stuck = (history.at("stick_area", row) / std::f64::consts::PI).sqrt();
            add("radius of stick", stuck, after.stick_radius());
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let coupled = scene.results.record["plan"]["coupling"] == "coupled";
    let words = if coupled {
        format!(
            "<p>The closed forms are frictionless ones: they neglect that pressure and shear act on each other (Dundurs' \
             |<i>β</i>| = {:.3}), which changes pressure and approach by some percent. There is none of partial slip here.</p>",
            form.moduli.coupling.abs()
        )
    } else {
        let [dx, _] = scene.results.fields.spacing();
        let last = history.rows().saturating_sub(1);
        let cells = 2.0 * (history.at("contact_area", last) / std::f64::consts::PI).sqrt() / dx;
        format!(
            "<p>The contact is {cells:.0} cells wide at the end; its edge is known to about half a cell. The closed form of \
             partial slip neglects the slip across the force.</p>"
        )
    };
    let head = ["at the end of", "", "computed", "closed form", "difference"];
    chapter("Against the closed form", &format!("{words}<div class=\"scroll\">{}</div>", table(&head, &rows)))
}

/// Residuals and work.
pub fn convergence(scene: &Scene<'_>) -> String {
    let history = &scene.results.table;
    let increments = history.column("increment");
    let points = |name: &str| increments.iter().zip(history.column(name)).map(|(x, y)| [*x, *y]).collect();
    let curve = |name: &str| Curve { points: points(name), name: None, colour: 0, stroke: Stroke::Line };
    let tolerance = scene.results.record["tolerance"].as_f64();
    let residual = Chart {
        what: "residual of every increment".to_owned(),
        axes: ["increment".to_owned(), "residual".to_owned()],
        curves: vec![Curve { stroke: Stroke::Dots, ..curve("residual") }],
        logarithmic: true,
        level: tolerance.map(|tolerance| (tolerance, "tolerance".to_owned())),
    };
    let work = Chart {
        what: "convolutions of every increment".to_owned(),
        axes: ["increment".to_owned(), "convolutions".to_owned()],
        curves: vec![curve("convolutions")],
        logarithmic: false,
        level: None,
    };
    let sum = |name: &str| history.column(name).iter().sum::<f64>();
    let rows = [
        ("convolutions in all".to_owned(), format!("{}", sum("convolutions"))),
        ("preconditioner passes".to_owned(), format!("{}", sum("preconditioner_passes"))),
        ("outer iterations".to_owned(), format!("{}", sum("outer_iterations"))),
        ("time in increments".to_owned(), crate::figures::duration(sum("wall_s"))),
    ];
    let figures = figure_of(
        &residual.svg(),
        "How well every increment satisfies its equations, relative and dimensionless.",
    ) + &figure_of(
        &work.svg(),
        "Applications of the elastic operator: the work, independent of the machine.",
    );
    chapter("Convergence", &(side_by_side(&figures) + &pairs(&rows)))
}
