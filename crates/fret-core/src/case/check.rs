//! The judgement of a case that has the right structure: ranges, contradictions, and words for what is not built yet.

use std::ops::Range;

use toml::Spanned;

use super::file::{BodyFile, CaseFile, FrictionFile, OutputFile, ProfileFile, RampFile, SizeFile, StageFile};
use super::refusal::Mistake;
use super::{Case, Course, FIELD_NAMES, GridSize, Origin, Output, Stage, StageControl, coating};
use crate::kernel::sublayers::{RESPONSE_BOUND, SublayerError, layered_half_space};
use crate::model::{
    Base, Body, ContactPair, CoulombFriction, ElasticMaterial, Layer, MaterialError, Profile, ProfileError,
};

/// Cells along one side of the grid, at the most.
const MOST_CELLS: usize = 1 << 14;
/// Cells of the whole grid, at the most.
const MOST_CELLS_IN_ALL: usize = 1 << 26;
/// Increments of a whole history, at the most.
const MOST_INCREMENTS: usize = 10_000_000;
/// Residual asked for when the case does not say.
const TOLERANCE: f64 = 1e-8;

/// Collects mistakes; `None` stands for a value that was refused.
pub(super) struct Judge {
    mistakes: Vec<Mistake>,
}

impl Judge {
    pub(super) fn refuse<T>(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: &str,
    ) -> Option<T> {
        let help = (!help.is_empty()).then(|| help.to_owned());
        self.mistakes.push(Mistake { message: message.into(), help, span: Some(span) });
        None
    }
}

pub(super) fn case(file: CaseFile, name: &str, text: &str) -> Result<Case, Vec<Mistake>> {
    let mut judge = Judge { mistakes: Vec::new() };
    let cells = cells(&mut judge, &file.grid.cells);
    let size = size(&mut judge, &file.grid.size);
    let periodic = file.grid.periodic.as_ref().is_some_and(|periodic| *periodic.get_ref());
    if let (true, Some(place)) = (periodic, &file.grid.periodic) {
        judge.refuse::<()>(
            place.span(),
            "grid.periodic = true: periodic scenes are not built yet",
            "leave it out: the scene then stands alone in free space",
        );
    }
    let bodies = bodies(&mut judge, &file.upper, &file.lower);
    let profile = profile(&mut judge, &file.profile);
    let friction = file
        .friction
        .as_ref()
        .map_or(Some(CoulombFriction::Uniform(0.0)), |friction| self::friction(&mut judge, friction));
    let frictionless = friction.as_ref().is_some_and(CoulombFriction::is_frictionless);
    let stages = stages(&mut judge, &file.load, frictionless);
    if let Some(friction) = &friction {
        sliding(&mut judge, friction, &file.load);
    }
    let tolerance = match file.solver.as_ref().and_then(|solver| solver.tolerance.as_ref()) {
        None => Some(TOLERANCE),
        Some(given) if (1e-13..=1e-2).contains(given.get_ref()) => Some(*given.get_ref()),
        Some(given) => judge.refuse(
            given.span(),
            format!("solver.tolerance = {:e}: must lie between 1e-13 and 1e-2", given.get_ref()),
            "1e-8 serves most purposes; below 1e-12 rounding takes over",
        ),
    };
    let output = output(&mut judge, file.output.as_ref());
    match (cells, size, bodies, profile, friction, stages, tolerance, output) {
        (
            Some(cells),
            Some(size),
            Some(bodies),
            Some(profile),
            Some(friction),
            Some(stages),
            Some(tolerance),
            Some(output),
        ) if judge.mistakes.is_empty() => Ok(Case {
            title: file.title.unwrap_or_default(),
            cells,
            size,
            periodic,
            bodies,
            profile,
            friction,
            stages,
            tolerance,
            output,
            origin: Origin { name: name.to_owned(), text: text.to_owned(), size: file.grid.size.span() },
        }),
        _ => Err(judge.mistakes),
    }
}

fn cells(judge: &mut Judge, given: &Spanned<[usize; 2]>) -> Option<[usize; 2]> {
    let cells = *given.get_ref();
    if cells.iter().any(|&side| !(4..=MOST_CELLS).contains(&side)) {
        return judge.refuse(
            given.span(),
            format!("grid.cells = {cells:?}: each side needs between 4 and {MOST_CELLS} cells"),
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

fn size(judge: &mut Judge, given: &Spanned<SizeFile>) -> Option<GridSize> {
    match *given.get_ref() {
        SizeFile::Auto => Some(GridSize::Auto),
        SizeFile::Given(sides) if sides.iter().all(|side| side.is_finite() && *side > 0.0) => {
            Some(GridSize::Given(sides))
        }
        SizeFile::Given(sides) => judge.refuse(
            given.span(),
            format!("grid.size = {sides:?}: both must be positive finite lengths"),
            "or size = \"auto\"",
        ),
    }
}

fn bodies(judge: &mut Judge, upper: &Spanned<BodyFile>, lower: &Spanned<BodyFile>) -> Option<ContactPair> {
    let (first, second) = (body(judge, "upper", upper), body(judge, "lower", lower));
    match ContactPair::new(first?, second?) {
        Ok(pair) => Some(pair),
        Err(error) => judge.refuse(lower.span(), error.to_string(), ""),
    }
}

fn body(judge: &mut Judge, which: &str, given: &Spanned<BodyFile>) -> Option<Body> {
    let body = given.get_ref();
    if body.rigid.as_ref().is_some_and(|rigid| *rigid.get_ref()) {
        let extra = [
            body.coatings.as_ref().map(Spanned::span),
            body.substrate.as_ref().map(Spanned::span),
            body.base.as_ref().map(Spanned::span),
        ];
        return match extra.into_iter().flatten().next() {
            Some(span) => judge.refuse(
                span,
                format!("{which}: rigid = true and an elastic part, both at once"),
                "leave out one of the two",
            ),
            None => Some(Body::Rigid),
        };
    }
    let base = match (&body.substrate, &body.base) {
        (Some(substrate), None) => {
            let place = format!("{which}.substrate");
            material(judge, &place, &substrate.get_ref().young, &substrate.get_ref().poisson)
                .map(Base::Elastic)
        }
        (None, Some(_)) => Some(Base::Rigid),
        (Some(_), Some(base)) => judge.refuse(
            base.span(),
            format!("{which}: a substrate and base = \"rigid\", both at once"),
            "leave out one of the two",
        ),
        (None, None) => judge.refuse(
            given.span(),
            format!("{which}: nothing says what it is made of"),
            "rigid = true, or substrate = { young = ..., poisson = ... }, or base = \"rigid\" under coatings",
        ),
    };
    let layers: Option<Vec<Layer>> = match &body.coatings {
        None => Some(Vec::new()),
        Some(list) => {
            let checked: Vec<Option<Layer>> = list
                .get_ref()
                .iter()
                .enumerate()
                .map(|(index, entry)| coating::layer(judge, &format!("{which}.coatings[{index}]"), entry))
                .collect();
            checked.into_iter().collect()
        }
    };
    match layered_half_space(&layers?, base?, RESPONSE_BOUND) {
        Ok(half_space) => Some(Body::Elastic(half_space)),
        Err(error @ SublayerError::TooSteep { .. }) => {
            let span = body.coatings.as_ref().map_or(given.span(), Spanned::span);
            judge.refuse(
                span,
                format!("{which}.coatings: {error}"),
                "a modulus that changes less, or gradient.layers = ... to be content with so many",
            )
        }
        Err(SublayerError::Material(error)) => judge.refuse(given.span(), format!("{which}: {error}"), ""),
    }
}

pub(super) fn material(
    judge: &mut Judge,
    place: &str,
    young: &Spanned<f64>,
    poisson: &Spanned<f64>,
) -> Option<ElasticMaterial> {
    let mut good = true;
    for (value, error) in [
        (young, ElasticMaterial::new(*young.get_ref(), 0.0).err()),
        (poisson, ElasticMaterial::new(1.0, *poisson.get_ref()).err()),
    ] {
        if let Some(error) = error {
            good = false;
            let key = if matches!(error, MaterialError::Young(_)) { "young" } else { "poisson" };
            judge.refuse::<()>(value.span(), format!("{place}.{key}: {error}"), "");
        }
    }
    if good { ElasticMaterial::new(*young.get_ref(), *poisson.get_ref()).ok() } else { None }
}

fn profile(judge: &mut Judge, given: &Spanned<ProfileFile>) -> Option<Profile> {
    let (profile, radii) = match given.get_ref() {
        ProfileFile::Sphere(sphere) => {
            (Profile::Sphere { radius: *sphere.radius.get_ref() }, vec![("sphere", "radius", &sphere.radius)])
        }
        ProfileFile::Ellipsoid(ellipsoid) => (
            Profile::Ellipsoid {
                radius_x: *ellipsoid.radius_x.get_ref(),
                radius_y: *ellipsoid.radius_y.get_ref(),
            },
            vec![
                ("ellipsoid", "radius_x", &ellipsoid.radius_x),
                ("ellipsoid", "radius_y", &ellipsoid.radius_y),
            ],
        ),
        ProfileFile::Cylinder(_) => return unbuilt_profile(judge, given, "cylinder"),
        ProfileFile::RoundedPunch(_) => return unbuilt_profile(judge, given, "rounded_punch"),
        ProfileFile::FlatPunch(_) => return unbuilt_profile(judge, given, "flat_punch"),
        ProfileFile::Cone(_) => return unbuilt_profile(judge, given, "cone"),
        ProfileFile::Wave(_) => return unbuilt_profile(judge, given, "wave"),
        ProfileFile::Heights(_) => return unbuilt_profile(judge, given, "heights"),
    };
    match profile.checked() {
        Ok(profile) => Some(profile),
        Err(ProfileError::Radius { .. }) => {
            for (shape, name, value) in radii {
                let radius = *value.get_ref();
                if !(radius.is_finite() && radius > 0.0) {
                    let message =
                        format!("profile.{shape}.{name} = {radius:?}: must be a positive finite length");
                    judge.refuse::<()>(value.span(), message, "");
                }
            }
            None
        }
    }
}

fn unbuilt_profile(judge: &mut Judge, given: &Spanned<ProfileFile>, shape: &str) -> Option<Profile> {
    judge.refuse(
        given.span(),
        format!("profile.{shape} is not built yet"),
        "built are: profile.sphere, profile.ellipsoid",
    )
}

fn friction(judge: &mut Judge, given: &FrictionFile) -> Option<CoulombFriction> {
    match (&given.coefficient, &given.map) {
        (_, Some(map)) => judge.refuse(
            map.span(),
            "friction.map: a friction map is not built yet",
            "one coefficient for the whole surface: friction.coefficient = ...",
        ),
        (Some(coefficient), None) => match CoulombFriction::uniform(*coefficient.get_ref()) {
            Ok(friction) => Some(friction),
            Err(error) => judge.refuse(coefficient.span(), format!("friction.coefficient: {error}"), ""),
        },
        (None, None) => Some(CoulombFriction::Uniform(0.0)),
    }
}

fn stages(
    judge: &mut Judge,
    list: &Spanned<Vec<Spanned<StageFile>>>,
    frictionless: bool,
) -> Option<Vec<Stage>> {
    if list.get_ref().is_empty() {
        return judge.refuse(
            list.span(),
            "load: no stage",
            "[[load]] with normal_force = ... and increments = ...",
        );
    }
    let mut checked = Vec::new();
    for (index, given) in list.get_ref().iter().enumerate() {
        checked.push(stage(judge, index, given, frictionless));
    }
    let stages: Vec<Stage> = checked.into_iter().collect::<Option<_>>()?;
    let in_all = stages.iter().fold(0_usize, |sum, stage| {
        sum.saturating_add(match stage.course {
            Course::Cycles(cycles) => stage.increments.saturating_mul(cycles),
            Course::Linear | Course::Cubic => stage.increments,
        })
    });
    if in_all > MOST_INCREMENTS {
        return judge.refuse(
            list.span(),
            format!("load: {in_all} increments in all; at most {MOST_INCREMENTS}"),
            "",
        );
    }
    Some(stages)
}

fn stage(judge: &mut Judge, index: usize, given: &Spanned<StageFile>, frictionless: bool) -> Option<Stage> {
    let before = judge.mistakes.len();
    let file = given.get_ref();
    let name = file.name.clone().unwrap_or_else(|| format!("stage {}", index + 1));
    let place = format!("load[{index}] ({name})");
    let increments = *file.increments.get_ref();
    if !(1..=MOST_INCREMENTS).contains(&increments) {
        let message = format!("{place}.increments = {increments}: must lie between 1 and {MOST_INCREMENTS}");
        judge.refuse::<()>(file.increments.span(), message, "");
    }
    let normal = one_control(
        judge,
        &place,
        ("normal_force", file.normal_force.as_ref()),
        ("approach", file.approach.as_ref()),
    );
    let twist = one_control(
        judge,
        &place,
        ("twist_moment", file.twist_moment.as_ref()),
        ("twist", file.twist.as_ref()),
    );
    let tangential = tangential_control(judge, &place, file);
    if index == 0 && file.normal_force.is_none() && file.approach.is_none() {
        judge.refuse::<()>(
            given.span(),
            format!("{place}: the first stage says neither normal_force nor approach"),
            "bodies must be pressed together first: normal_force = ...",
        );
    }
    if let (Some(StageControl::Force(force)), Some(value)) = (normal, &file.normal_force)
        && force < 0.0
    {
        judge.refuse::<()>(
            value.span(),
            format!(
                "{place}.normal_force = {force:?}: compression is positive, and the surfaces do not adhere"
            ),
            "",
        );
    }
    let course = course(judge, &place, file, increments);
    if frictionless
        && let Some(span) = [
            file.tangential_force.as_ref().filter(|force| force.get_ref() != &[0.0; 2]).map(Spanned::span),
            file.shift.as_ref().map(Spanned::span),
            file.twist_moment.as_ref().map(Spanned::span),
            file.twist.as_ref().map(Spanned::span),
        ]
        .into_iter()
        .flatten()
        .next()
    {
        judge.refuse::<()>(
            span,
            format!("{place}: a tangential load on a contact without friction"),
            "[friction] coefficient = ..., or leave the tangential load out",
        );
    }
    if normal.is_none() && tangential.is_none() && twist.is_none() && judge.mistakes.len() == before {
        judge.refuse::<()>(
            given.span(),
            format!("{place}: nothing is prescribed"),
            "normal_force, approach, tangential_force, shift, twist_moment or twist",
        );
    }
    (judge.mistakes.len() == before).then(|| Stage {
        name,
        normal,
        tangential,
        twist,
        increments,
        course: course.unwrap_or(Course::Linear),
    })
}

fn course(judge: &mut Judge, place: &str, file: &StageFile, increments: usize) -> Option<Course> {
    match (&file.cycles, &file.ramp) {
        (Some(cycles), Some(_)) => judge.refuse(
            cycles.span(),
            format!("{place}: ramp and cycles, both at once"),
            "cycles run linearly: leave out the ramp, or give the ramp a stage of its own",
        ),
        (Some(cycles), None) => {
            let count = *cycles.get_ref();
            if !(1..=1_000_000).contains(&count) {
                return judge.refuse(
                    cycles.span(),
                    format!("{place}.cycles = {count}: must lie between 1 and 1000000"),
                    "",
                );
            }
            if increments < 4 {
                return judge.refuse(
                    file.increments.span(),
                    format!("{place}.increments = {increments}: a cycle turns twice and needs at least 4"),
                    "",
                );
            }
            let normal = file.normal_force.as_ref().or(file.approach.as_ref());
            if let Some(normal) = normal {
                return judge.refuse(
                    normal.span(),
                    format!("{place}: a normal load that runs in cycles is not built yet"),
                    "cycles of tangential_force, shift, twist_moment or twist are built",
                );
            }
            Some(Course::Cycles(count))
        }
        (None, Some(ramp)) => Some(match ramp.get_ref() {
            RampFile::Linear => Course::Linear,
            RampFile::Cubic => Course::Cubic,
        }),
        (None, None) => Some(Course::Linear),
    }
}

type Given<'a, T> = (&'a str, Option<&'a Spanned<T>>);

fn one_control(
    judge: &mut Judge,
    place: &str,
    force: Given<'_, f64>,
    motion: Given<'_, f64>,
) -> Option<StageControl> {
    let (key, value, control): (&str, &Spanned<f64>, fn(f64) -> StageControl) = match (force.1, motion.1) {
        (None, None) => return None,
        (Some(value), None) => (force.0, value, StageControl::Force),
        (None, Some(value)) => (motion.0, value, StageControl::Motion),
        (Some(_), Some(value)) => {
            return judge.refuse(
                value.span(),
                format!("{place}: {} and {}, both at once", force.0, motion.0),
                "prescribe one of the two; the other follows",
            );
        }
    };
    if !value.get_ref().is_finite() {
        return judge.refuse(
            value.span(),
            format!("{place}.{key} = {}: must be finite", value.get_ref()),
            "",
        );
    }
    Some(control(*value.get_ref()))
}

fn tangential_control(judge: &mut Judge, place: &str, file: &StageFile) -> Option<[StageControl; 2]> {
    type Kind = fn(f64) -> StageControl;
    let (key, value, control): (&str, &Spanned<[f64; 2]>, Kind) = match (&file.tangential_force, &file.shift)
    {
        (None, None) => return None,
        (Some(value), None) => ("tangential_force", value, StageControl::Force),
        (None, Some(value)) => ("shift", value, StageControl::Motion),
        (Some(_), Some(value)) => {
            return judge.refuse(
                value.span(),
                format!("{place}: tangential_force and shift, both at once"),
                "prescribe one of the two; the other follows",
            );
        }
    };
    if value.get_ref().iter().any(|part| !part.is_finite()) {
        return judge.refuse(
            value.span(),
            format!("{place}.{key} = {:?}: must be finite", value.get_ref()),
            "",
        );
    }
    Some(value.get_ref().map(control))
}

/// Forces that Coulomb's law cannot carry are refused before anything is computed, as far as the forces are given.
fn sliding(judge: &mut Judge, friction: &CoulombFriction, list: &Spanned<Vec<Spanned<StageFile>>>) {
    let mut normal = None;
    let mut held = [0.0; 2];
    for (index, stage) in list.get_ref().iter().enumerate() {
        let stage = stage.get_ref();
        let start = normal;
        if let Some(force) = &stage.normal_force {
            normal = Some(*force.get_ref());
        } else if stage.approach.is_some() {
            normal = None;
        }
        let Some(tangential) = &stage.tangential_force else {
            if stage.shift.is_some() {
                return;
            }
            continue;
        };
        let Some(force) = normal else { continue };
        let force = if stage.cycles.is_some() { start.unwrap_or(force) } else { force };
        let reached = if stage.cycles.is_some() {
            let given = tangential.get_ref();
            let [plus, minus] =
                [1.0, -1.0].map(|sign| (held[0] + sign * given[0]).hypot(held[1] + sign * given[1]));
            plus.max(minus)
        } else {
            held = *tangential.get_ref();
            held[0].hypot(held[1])
        };
        let bound = friction.largest() * force;
        if reached > bound * (1.0 + 1e-12) && friction.largest() > 0.0 {
            judge.refuse::<()>(
                tangential.span(),
                format!("load[{index}].tangential_force reaches {reached:e}: friction carries at most mu W = {bound:e}"),
                "a force above mu W has no equilibrium; prescribe the shift to slide",
            );
        }
    }
}

fn output(judge: &mut Judge, given: Option<&OutputFile>) -> Option<Output> {
    let mut fields: Vec<String> = Vec::new();
    let mut good = true;
    match given.and_then(|output| output.fields.as_ref()) {
        None => fields.extend(["pressure", "shear", "slip", "zone"].map(str::to_owned)),
        Some(names) => {
            for name in names {
                let word = name.get_ref();
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
    let every = match given.and_then(|output| output.every.as_ref()) {
        None => None,
        Some(every) if *every.get_ref() >= 1 => Some(*every.get_ref()),
        Some(every) => {
            return judge.refuse(
                every.span(),
                "output.every = 0: must be at least 1",
                "every = 1 keeps all increments",
            );
        }
    };
    good.then_some(Output { fields, every })
}
