//! The judgement of a case that has the right structure: ranges, contradictions, and words for what is not built yet.

use super::attachments::Attachments;
use super::beyond::beyond;
use super::bodies::bodies;
use super::bulk_and_tilt::bulk_and_tilt;
use super::conduction::conduction;
use super::declared_units::declared_units;
use super::definition::{Case, Origin};
use super::evolution::evolution;
use super::file::{CaseFile, CellsFile, OutputFile, SizeFile};
use super::friction::{friction, of_stages};
use super::hardness::hardness;
use super::interface::sliding_coatings;
use super::judge::Judge;
use super::kinematics::kinematics;
use super::known::Known;
use super::line::{datum, line, motion_without_datum};
use super::mean_gap::mean_plane;
use super::output::{FIELD_NAMES, Output};
use super::repeating::repeats;
use super::residual::residual;
use super::rig::{log_columns, rig};
use super::rolling::rolling;
use super::shape::profile;
use super::stages::{sliding, stages};
use super::stress::stress;
use super::wearing::wear;
use crate::document::{At, Mistake, Places};
use crate::model::stage::Stage;
use crate::model::{CoulombFriction, Dimension, Displacement, GridSize, Profile, Shape};
use crate::topography::Cells;
use crate::units::Units;

/// Cells along one side of the grid, at the least.
pub const FEWEST_CELLS: usize = 4;
/// Cells along one side of the grid, at the most.
pub const MOST_CELLS: usize = 1 << 14;
/// Cells of the whole grid, at the most.
pub const MOST_CELLS_IN_ALL: usize = 1 << 26;
/// Lengths above this, and below its inverse, have powers that are no numbers any more.
const HUGE: f64 = 1e100;
/// Length over width of a cell, at the most.
const LONGEST_CELL: f64 = 1e6;
/// Residual asked for when the case does not say.
const TOLERANCE: f64 = 1e-8;

/// The case of a file, or everything that is wrong with it.
pub(super) fn case(
    file: CaseFile,
    (name, text): (&str, &str),
    attachments: Attachments<'_>,
    places: &Places,
) -> Result<Case, Vec<Mistake>> {
    let mut judge = judge_of(&file, attachments, places);
    let (units, dimension) = (judge.units.clone(), judge.dimension);
    let cells = cells(&mut judge, &file.grid.cells);
    let size = size(&mut judge, &file.grid.size, cells);
    let along = file.grid.periodic.as_ref().map_or([false; 2], |periodic| periodic.value.axes());
    let over = cells.map(|count| Cells { count, size: size.and_then(GridSize::given), repeats: along });
    let bodies = bodies(&mut judge, &file.upper, &file.lower);
    let files = [("lower", &file.lower.value), ("upper", &file.upper.value)];
    let residual_stress = files.map(|body| residual(&mut judge, body));
    let fatigue = files.map(|body| super::fatigue::fatigue(&mut judge, body));
    let profile = profile(&mut judge, &file, over);
    judge.mean_plane = mean_plane(&file, (over, judge.moves), bodies.as_ref(), profile.as_ref());
    let friction = friction(&mut judge, file.friction.as_ref(), over);
    let changes = of_stages(&mut judge, &file.load.value, over, friction.as_ref());
    let laws = friction.as_ref().zip(changes.as_ref()).map(|(first, changes)| in_force(first, changes));
    let history_tolerance = file.solver.as_ref().and_then(|solver| solver.history_tolerance.as_ref());
    let rig_file = file.rig.as_ref();
    let rig = rig(rig_file);
    let log_columns = log_columns(&mut judge, rig_file);
    let stages = stages(&mut judge, &file.load, (laws.as_deref(), rig_file), history_tolerance);
    let stages = stages.zip(changes.as_ref()).map(|(stages, changes)| with_friction(stages, changes));
    let known = Known {
        file: &file,
        dimension,
        cells,
        size,
        bodies: bodies.as_ref(),
        profile: profile.as_ref(),
        laws: laws.as_deref(),
        stages: stages.as_deref(),
    };
    let periodic = known.periodic();
    let friction_evolution =
        evolution(&mut judge, file.friction.as_ref(), friction.as_ref(), known.loading());
    let datum = datum(&mut judge, &known);
    let beyond = beyond(&mut judge, &file.grid, size);
    if dimension == Dimension::Line {
        line(&mut judge, &known);
        motion_without_datum(&mut judge, &known);
    }
    repeats(&mut judge, &known);
    bulk_and_tilt(&mut judge, &known);
    let mapped = friction.iter().chain(changes.iter().flatten().flatten()).any(CoulombFriction::is_map);
    if periodic.is_none() {
        auto_of_what_is_given(&mut judge, &file.grid.size, mapped, profile.as_ref());
    }
    sliding_coatings(&mut judge, &known);
    let solver = file.solver.as_ref();
    let tolerance = tolerance(&mut judge, solver.and_then(|solver| solver.tolerance.as_ref()));
    if let (true, Some(laws), Some(stages)) = (places.are_whole(), &laws, &stages) {
        let strongest = friction_evolution.as_ref().zip(friction.as_ref());
        let strongest = strongest.map(|(evolution, first)| evolution.strongest(first));
        let friction = (laws.as_slice(), strongest.as_ref());
        sliding(&mut judge, friction, &file.load, stages, tolerance.unwrap_or(TOLERANCE));
    }
    let kinematics = kinematics(&mut judge, &known);
    rolling(&mut judge, &known, kinematics);
    let hardness = hardness(&mut judge, &known, kinematics);
    let wear = wear(&mut judge, &known, kinematics);
    let output = output(&mut judge, file.output.as_ref());
    let stress = stress(&mut judge, &known, output.as_ref());
    let conduction = conduction(&mut judge, &known, output.as_ref());
    if !judge.mistakes.is_empty() {
        return Err(judge.mistakes);
    }
    let start = judge.attachments.start;
    let case = move || {
        Some(Case {
            cells: cells?,
            size: size?,
            bodies: bodies?,
            profile: profile?,
            friction: friction?,
            kinematics,
            stages: stages?,
            tolerance: tolerance?,
            output: output?,
            title: file.title.unwrap_or_default(),
            scheme: solver.and_then(|solver| solver.scheme).unwrap_or_default(),
            integration: solver.and_then(|solver| solver.integration).unwrap_or_default(),
            origin: Origin { name: name.to_owned(), text: text.to_owned(), size: file.grid.size.span() },
            units,
            datum,
            beyond,
            periodic,
            hardness,
            residual_stress,
            fatigue,
            conduction,
            friction_evolution,
            rig,
            log_columns,
            start,
            wear,
            stress,
        })
    };
    case().ok_or_else(Vec::new)
}

/// What the whole case is judged with: its units, and whether it is a line contact.
fn judge_of<'a>(file: &CaseFile, attachments: Attachments<'a>, places: &'a Places) -> Judge<'a> {
    let dimension = Dimension::from(matches!(&file.grid.cells.value, CellsFile::Line(_)));
    let displacement = file.kinematics.as_ref().and_then(|given| given.value.displacement.as_ref());
    let moves = displacement.is_some_and(|given| given.value == Displacement::Finite);
    let mut judge = Judge {
        mistakes: Vec::new(),
        attachments,
        places,
        force_unit: String::new(),
        units: None,
        dimension,
        moves,
        mean_plane: Ok(0.0),
        by_mean_gap: Vec::new(),
    };
    judge.units = file.units.as_ref().and_then(|file| declared_units(&mut judge, file));
    judge.force_unit = Units::after(judge.units.as_ref(), "force", dimension);
    judge
}

fn tolerance(judge: &mut Judge, given: Option<&At<f64>>) -> Option<f64> {
    match given {
        None => Some(TOLERANCE),
        Some(given) if (1e-13..=1e-2).contains(&given.value) => Some(given.value),
        Some(given) => judge.refuse(
            given.span(),
            format!("solver.tolerance = {:e}: must lie between 1e-13 and 1e-2", &given.value),
            "1e-8 serves most purposes; below 1e-12 rounding takes over",
        ),
    }
}

fn cells(judge: &mut Judge, given: &At<CellsFile>) -> Option<[usize; 2]> {
    // What stands in for them fits no array.
    if !judge.places.are_whole_in("grid.cells") {
        return None;
    }
    let cells = match given.value {
        CellsFile::Grid(cells) => cells,
        CellsFile::Line(count) if (FEWEST_CELLS..=MOST_CELLS).contains(&count) => return Some([count, 1]),
        CellsFile::Line(count) => {
            return judge.refuse(
                given.span(),
                format!(
                    "grid.cells = {count}: a line contact needs between {FEWEST_CELLS} and {MOST_CELLS} cells"
                ),
                "256 to 1024 cells serve most line contacts",
            );
        }
    };
    if cells.iter().any(|&side| !(FEWEST_CELLS..=MOST_CELLS).contains(&side)) {
        return judge.refuse(
            given.span(),
            format!("grid.cells = {cells:?}: each side needs between {FEWEST_CELLS} and {MOST_CELLS} cells"),
            "64 to 256 cells a side serve most contacts",
        );
    }
    if cells[0].saturating_mul(cells[1]) > MOST_CELLS_IN_ALL {
        return judge.refuse(
            given.span(),
            format!("grid.cells = {cells:?}: more than {MOST_CELLS_IN_ALL} cells in all"),
            "64 to 256 cells a side serve most contacts",
        );
    }
    Some(cells)
}

fn size(judge: &mut Judge, given: &At<SizeFile>, cells: Option<[usize; 2]>) -> Option<GridSize> {
    if !judge.places.are_whole_in("grid.size") {
        return None;
    }
    let dimension = cells.map_or(Dimension::Plane, Dimension::of);
    match given.value {
        SizeFile::Auto(_) => Some(GridSize::Auto),
        SizeFile::Given(_) if dimension == Dimension::Line => judge.refuse(
            given.span(),
            "grid.size: two side lengths, but a single number of cells, which makes a line contact",
            "size = length, or cells = [x, y]",
        ),
        SizeFile::Line(_) if dimension == Dimension::Plane => {
            cells?;
            judge.refuse(
                given.span(),
                "grid.size: one length, but two numbers of cells; one length is that of a line contact",
                "size = [x, y], or cells = n",
            )
        }
        SizeFile::Line(length) if !(1.0 / HUGE..=HUGE).contains(&length) => judge.refuse(
            given.span(),
            format!("grid.size = {length:?}: must be a length between {:e} and {HUGE:e}", 1.0 / HUGE),
            "or size = \"auto\"",
        ),
        SizeFile::Line(length) => {
            let [strips, _] = cells?;
            Some(GridSize::Given([length, length / strips as f64]))
        }
        SizeFile::Given(sides) if !sides.iter().all(|side| side.is_finite() && *side > 0.0) => judge.refuse(
            given.span(),
            format!("grid.size = {sides:?}: both must be positive finite lengths"),
            "or size = \"auto\"",
        ),
        SizeFile::Given(sides) if cells.is_some_and(|cells| are_needles(sides, cells)) => judge.refuse(
            given.span(),
            format!("grid.size = {sides:?}: the cells are more than {LONGEST_CELL:e} times as long as wide"),
            "cells that are about square serve best",
        ),
        SizeFile::Given(sides) if sides.iter().all(|side| (1.0 / HUGE..=HUGE).contains(side)) => {
            Some(GridSize::Given(sides))
        }
        SizeFile::Given(sides) => judge.refuse(
            given.span(),
            format!("grid.size = {sides:?}: each side must lie between {:e} and {HUGE:e}", 1.0 / HUGE),
            "choose units in which the numbers are nearer to 1: their squares must be numbers too",
        ),
    }
}

/// Refuses a size left to the program where there are arrays over cells, or a formula, of which no contact size is known beforehand.
fn auto_of_what_is_given(judge: &mut Judge, size: &At<SizeFile>, is_mapped: bool, profile: Option<&Profile>) {
    let SizeFile::Auto(_) = &size.value else { return };
    let has_formula =
        |profile: &Profile| profile.shapes.iter().any(|shape| matches!(shape, Shape::Formula(_)));
    let why = if is_mapped || profile.is_some_and(|profile| !profile.heights.is_empty()) {
        "heights or a friction map: the size of their cells must be given"
    } else if profile.is_some_and(has_formula) {
        "a formula: the size of its contact is not known beforehand"
    } else {
        return;
    };
    judge.refuse::<()>(size.span(), format!("grid.size = \"auto\" with {why}"), "size = [x, y]");
}

/// Whether cells are too long to compute with.
fn are_needles(sides: [f64; 2], cells: [usize; 2]) -> bool {
    let [dx, dy] = [sides[0] / cells[0] as f64, sides[1] / cells[1] as f64];
    dx.max(dy) > LONGEST_CELL * dx.min(dy)
}

/// The law of friction in force in each stage.
fn in_force<'a>(
    first: &'a CoulombFriction,
    changes: &'a [Option<CoulombFriction>],
) -> Vec<&'a CoulombFriction> {
    let mut now = first;
    changes
        .iter()
        .map(|change| {
            now = change.as_ref().unwrap_or(now);
            now
        })
        .collect()
}

fn with_friction(stages: Vec<Stage>, changes: &[Option<CoulombFriction>]) -> Vec<Stage> {
    let with = |(stage, friction): (Stage, &Option<_>)| Stage { friction: friction.clone(), ..stage };
    stages.into_iter().zip(changes).map(with).collect()
}

fn output(judge: &mut Judge, given: Option<&OutputFile>) -> Option<Output> {
    let mut fields: Vec<String> = Vec::new();
    let mut good = true;
    match given.and_then(|output| output.fields.as_ref()) {
        None => fields.extend(["pressure", "shear", "slip", "zone"].map(str::to_owned)),
        Some(names) => {
            for name in names {
                let word = &name.value;
                if !FIELD_NAMES.contains(&word.as_str()) {
                    good = false;
                    judge.refuse::<()>(
                        name.span(),
                        format!("output.fields: no field is called {word:?}"),
                        &format!("fields are: {}", FIELD_NAMES.join(", ")),
                    );
                } else if !fields.contains(word) {
                    fields.push(word.clone());
                }
            }
        }
    }
    let every = given.and_then(|output| output.every);
    good.then_some(Output { fields, every })
}

#[cfg(test)]
pub(super) mod tests;
