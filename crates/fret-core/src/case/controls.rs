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
use super::table::{ACTUATOR, ACTUATOR_APPROACH, CONTROLS, Columns};

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
    let normal = [
        ("normal_force", &file.normal_force, FORCE),
        ("approach", &file.approach, MOTION),
        ("actuator_approach", &file.actuator_approach, FAR_END),
    ];
    let twist = [("twist_moment", &file.twist_moment, FORCE), ("twist", &file.twist, MOTION)];
    let normal = scalar(judge, place, &normal, rigid[0], &path);
    let twist = scalar(judge, place, &twist, rigid[3], &path);
    let pair = |given: &Spanned<Pair<AxisFile>>| (given.get_ref().0, given.span());
    let [x, y] = along(
        judge,
        place,
        [
            ("tangential_force", FORCE, file.tangential_force.as_ref().map(pair)),
            ("shift", MOTION, file.shift.as_ref().map(pair)),
            ("actuator", FAR_END, file.actuator.as_ref().map(pair)),
        ],
        [rigid[1], rigid[2]],
        &path,
    );
    let pair = |given: &Spanned<AlongFile<AxisFile>>| (given.get_ref().values(AxisFile::Held), given.span());
    let tilt = along(
        judge,
        place,
        [
            ("tilt_moment", FORCE, file.tilt_moment.as_ref().map(pair)),
            ("tilt", MOTION, file.tilt.as_ref().map(pair)),
        ],
        tilt,
        &path,
    );
    let mut stretched = |key, given: &Option<Spanned<_>>, phases| {
        along(judge, place, [(key, FORCE, given.as_ref().map(pair))], phases, &path)
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
        file.actuator.as_ref().map(Spanned::span),
        file.actuator_approach.as_ref().map(Spanned::span),
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
    let column = |index: usize| columns.get(CONTROLS[index].0).map(|values| Path::Through(values.clone()));
    let pair = |force: usize, motion: usize| {
        column(force).map(StageControl::Force).or_else(|| column(motion).map(StageControl::Motion))
    };
    let stress = |index: usize| column(index).map(StageControl::Force);
    let driven = |force: usize, motion: usize, far_end: usize| {
        pair(force, motion).or_else(|| column(far_end).map(StageControl::FarEnd))
    };
    Controls {
        rigid: [
            driven(0, 1, ACTUATOR_APPROACH),
            driven(2, 4, ACTUATOR[0]),
            driven(3, 5, ACTUATOR[1]),
            pair(6, 7),
        ],
        tilt: [pair(8, 10), pair(9, 11)],
        bulk_stress: [[stress(12), stress(13)], [stress(14), stress(15)]],
    }
}

/// How a path becomes a control.
type Kind = fn(Path) -> StageControl;
const FORCE: Kind = StageControl::Force;
const MOTION: Kind = StageControl::Motion;
const FAR_END: Kind = StageControl::FarEnd;

/// A key with what stands there, and the kind of control that it is.
type Named<'a> = (&'a str, &'a Option<Spanned<f64>>, Kind);

/// One of several controls that is one number.
fn scalar(
    judge: &mut Judge,
    place: &str,
    keys: &[Named<'_>],
    phase: f64,
    path: ToPath<'_>,
) -> Option<StageControl> {
    let mut there =
        keys.iter().filter_map(|(key, given, kind)| given.as_ref().map(|given| (*key, given, kind)));
    let (key, given, kind) = there.next()?;
    if let Some((other, value, _)) = there.next() {
        return both(judge, place, key, other, value.span());
    }
    let value = *given.get_ref();
    if !value.is_finite() {
        return judge.refuse(given.span(), format!("{place}.{key} = {value}: must be finite"), "");
    }
    Some(kind(path(value, phase)))
}

/// A key, the kind of control that it is, and its values along x and y with their place.
type AlongAxes<'a> = (&'a str, Kind, Option<([AxisFile; 2], Range<usize>)>);

/// Forces or motions along x and y.
fn along<const N: usize>(
    judge: &mut Judge,
    place: &str,
    keys: [AlongAxes<'_>; N],
    phases: [f64; 2],
    path: ToPath<'_>,
) -> [Option<StageControl>; 2] {
    let mut found = [None, None];
    let mut by = [""; 2];
    for (key, kind, given) in keys {
        let Some((values, span)) = given else { continue };
        let parts = values.map(AxisFile::value);
        if parts.iter().flatten().any(|part| !part.is_finite()) {
            judge.refuse::<()>(span, format!("{place}.{key}: must be finite"), "");
            continue;
        }
        for (axis, part) in parts.into_iter().enumerate() {
            let Some(value) = part else { continue };
            if found[axis].is_some() {
                both::<()>(judge, place, by[axis], key, span.clone());
                continue;
            }
            found[axis] = Some(kind(path(value, phases[axis])));
            by[axis] = key;
        }
    }
    found
}

fn both<T>(judge: &mut Judge, place: &str, force: &str, motion: &str, span: Range<usize>) -> Option<T> {
    let help = match motion {
        "shift" => {
            "prescribe one of the two along each axis: tangential_force = [1.0, \"held\"], shift = [\"held\", 0.0]"
        }
        "actuator" => {
            "prescribe one of the two along each axis: tangential_force = [1.0, \"held\"], actuator = [\"held\", 0.0]"
        }
        "tilt" => {
            "prescribe one of the two along each axis: tilt_moment = [1.0, \"held\"], tilt = [\"held\", 0.0]"
        }
        _ => "prescribe one of the two; the other follows",
    };
    judge.refuse(span, format!("{place}: {force} and {motion}, both at once"), help)
}
