//! The judgement of what a stage prescribes: a force or a motion for each direction, by number or by a table's column.

use std::ops::Range;

use toml::Spanned;

use super::along::AlongFile;
use super::axis::AxisFile;
use super::course::{Path, StageControl};
use super::judge::Judge;
use super::pair::Pair;
use super::phases::{Phases, phases};
use super::stage_file::StageFile;
use super::table::{COLUMNS, Columns};

/// What a stage prescribes, if anything.
#[derive(Default)]
pub(super) struct Controls {
    /// Normal, along x, along y, about z.
    pub rigid: [Option<StageControl>; 4],
    /// Tilt along x and y.
    pub tilt: [Option<StageControl>; 2],
    /// Bulk stress of the lower and the upper body along x and y.
    pub bulk_stress: [[Option<StageControl>; 2]; 2],
}

/// How a value of a control becomes its path: by its phase [degrees].
type ToPath<'a> = &'a dyn Fn(f64, f64) -> Path;

/// The controls of a stage; what is refused is left out.
pub(super) fn controls(
    judge: &mut Judge,
    place: &str,
    file: &StageFile,
    columns: Option<&Columns>,
) -> Controls {
    if let Some(columns) = columns {
        if let Some(span) = named(file) {
            judge.refuse::<()>(
                span,
                format!("{place}: a table and a control, both at once"),
                "the table holds all controls of its stage",
            );
        }
        return from_table(columns);
    }
    if let Some(columns) = &file.columns
        && let Some(key) = columns.keys().next()
    {
        judge.refuse::<()>(
            key.span(),
            format!("{place}.columns: there is no table"),
            "table = \"history.csv\"",
        );
    }
    let phases = phases(judge, place, file);
    let cyclic = file.cycles.is_some() || file.until_steady.is_some();
    let path = |value: f64, phase: f64| {
        if cyclic { Path::Wave { amplitude: value, phase: phase / 360.0 } } else { Path::To(value) }
    };
    let Phases { rigid, tilt, bulk_stress } = phases;
    let normal = (("normal_force", &file.normal_force), ("approach", &file.approach));
    let twist = (("twist_moment", &file.twist_moment), ("twist", &file.twist));
    let normal = scalar(judge, place, normal, rigid[0], &path);
    let twist = scalar(judge, place, twist, rigid[3], &path);
    let pair = |given: &Spanned<Pair<AxisFile>>| (given.get_ref().0, given.span());
    let [x, y] = along(
        judge,
        place,
        [
            ("tangential_force", true, file.tangential_force.as_ref().map(pair)),
            ("shift", false, file.shift.as_ref().map(pair)),
        ],
        [rigid[1], rigid[2]],
        &path,
    );
    let pair = |given: &Spanned<AlongFile<AxisFile>>| (given.get_ref().values(AxisFile::Held), given.span());
    let tilt = along(
        judge,
        place,
        [
            ("tilt_moment", true, file.tilt_moment.as_ref().map(pair)),
            ("tilt", false, file.tilt.as_ref().map(pair)),
        ],
        tilt,
        &path,
    );
    let mut stretched = |key, given: &Option<Spanned<_>>, phases| {
        let none = ("", false, None);
        along(judge, place, [(key, true, given.as_ref().map(pair)), none], phases, &path)
    };
    let bulk_stress = [
        stretched("bulk_stress", &file.bulk_stress, bulk_stress[0]),
        stretched("upper_bulk_stress", &file.upper_bulk_stress, bulk_stress[1]),
    ];
    Controls { rigid: [normal, x, y, twist], tilt, bulk_stress }
}

/// Where the first control is named.
fn named(file: &StageFile) -> Option<Range<usize>> {
    [
        file.normal_force.as_ref().map(Spanned::span),
        file.approach.as_ref().map(Spanned::span),
        file.tangential_force.as_ref().map(Spanned::span),
        file.shift.as_ref().map(Spanned::span),
        file.twist_moment.as_ref().map(Spanned::span),
        file.twist.as_ref().map(Spanned::span),
        file.tilt_moment.as_ref().map(Spanned::span),
        file.tilt.as_ref().map(Spanned::span),
        file.bulk_stress.as_ref().map(Spanned::span),
        file.upper_bulk_stress.as_ref().map(Spanned::span),
    ]
    .into_iter()
    .flatten()
    .next()
}

fn from_table(columns: &Columns) -> Controls {
    let column = |index: usize| columns.get(COLUMNS[index]).map(|values| Path::Through(values.clone()));
    let pair = |force: usize, motion: usize| {
        column(force).map(StageControl::Force).or_else(|| column(motion).map(StageControl::Motion))
    };
    let stress = |index: usize| column(index).map(StageControl::Force);
    Controls {
        rigid: [pair(0, 1), pair(2, 4), pair(3, 5), pair(6, 7)],
        tilt: [pair(8, 10), pair(9, 11)],
        bulk_stress: [[stress(12), stress(13)], [stress(14), stress(15)]],
    }
}

/// A key with what stands there.
type Named<'a> = (&'a str, &'a Option<Spanned<f64>>);

/// A force or a motion that is one number.
fn scalar(
    judge: &mut Judge,
    place: &str,
    (force, motion): (Named<'_>, Named<'_>),
    phase: f64,
    path: ToPath<'_>,
) -> Option<StageControl> {
    let (key, given, kind): (_, _, fn(Path) -> StageControl) = match (force.1, motion.1) {
        (None, None) => return None,
        (Some(value), None) => (force.0, value, StageControl::Force),
        (None, Some(value)) => (motion.0, value, StageControl::Motion),
        (Some(_), Some(value)) => return both(judge, place, force.0, motion.0, value.span()),
    };
    let value = *given.get_ref();
    if !value.is_finite() {
        return judge.refuse(given.span(), format!("{place}.{key} = {value}: must be finite"), "");
    }
    Some(kind(path(value, phase)))
}

/// A key, whether it prescribes a force, and its values along x and y with their place.
type AlongAxes<'a> = (&'a str, bool, Option<([AxisFile; 2], Range<usize>)>);

/// Forces or motions along x and y.
fn along(
    judge: &mut Judge,
    place: &str,
    keys: [AlongAxes<'_>; 2],
    phases: [f64; 2],
    path: ToPath<'_>,
) -> [Option<StageControl>; 2] {
    let [force, motion] = [keys[0].0, keys[1].0];
    let mut found = [None, None];
    for (key, by_force, given) in keys {
        let Some((values, span)) = given else { continue };
        let parts = values.map(AxisFile::value);
        if parts.iter().flatten().any(|part| !part.is_finite()) {
            judge.refuse::<()>(span, format!("{place}.{key}: must be finite"), "");
            continue;
        }
        for (axis, part) in parts.into_iter().enumerate() {
            let Some(value) = part else { continue };
            if found[axis].is_some() {
                both::<()>(judge, place, force, motion, span.clone());
                continue;
            }
            let path = path(value, phases[axis]);
            found[axis] = Some(if by_force { StageControl::Force(path) } else { StageControl::Motion(path) });
        }
    }
    found
}

fn both<T>(judge: &mut Judge, place: &str, force: &str, motion: &str, span: Range<usize>) -> Option<T> {
    let help = match motion {
        "shift" => {
            "prescribe one of the two along each axis: tangential_force = [1.0, \"held\"], shift = [\"held\", 0.0]"
        }
        "tilt" => {
            "prescribe one of the two along each axis: tilt_moment = [1.0, \"held\"], tilt = [\"held\", 0.0]"
        }
        _ => "prescribe one of the two; the other follows",
    };
    judge.refuse(span, format!("{place}: {force} and {motion}, both at once"), help)
}
