//! Numbers of a case, found by their paths as a case and a sweep write them; or why a history does not depend on one smoothly.

use super::case_number::{BodyNumber, FRACTION, LayerNumber, ResidualNumber, SHAPE_NUMBERS, What};
use crate::case::Case;
use crate::model::controls::{Form, Kind, ways};
use crate::model::stage::{Path, StageControl};
use crate::model::{Base, Body, Coating, CoulombFriction, ElasticMaterial, EvolutionLaw, HalfSpace, Rig};

/// A part of a path: a key, and a number in brackets where it has one.
type Step<'a> = (&'a str, Option<usize>);

/// A number of a case with its value, or what is wrong with a path.
type Found = Result<(What, f64), String>;

/// The number that stands at a path, with its value, or what is wrong with the path.
pub(super) fn number_at(path: &str, case: &Case) -> Found {
    let steps = steps(path).ok_or(FORMS)?;
    let steps = with_numbers_of_stages(&steps, case);
    match steps[..] {
        [("friction", None)] | [("friction", None), ("coefficient", None)] => {
            coefficient(&case.friction).map(|value| (What::Friction { stage: None }, value))
        }
        [("friction", None), ("max_shear", None)] => strength(case),
        [("friction", None), ("evolution", None), (key, row), ref column @ ..] => {
            evolution(case, (key, row), column)
        }
        [("wear", None), ("coefficient", None)] => wear(case),
        [("wear", None), (table, None), (number, None)] => third_body(case, table, number),
        [(body @ ("upper" | "lower"), None), ref layer @ .., ("wear_coefficient", None)] => {
            layer_wear(case, body == "upper", layer)
        }
        [("load", Some(stage)), ("friction", None)] => stage_friction(case, stage),
        [("load", Some(stage)), (key, axis)] => control(case, stage, (key, axis)),
        [("rig", None), (key, axis)] => rig(case, (key, axis)),
        [("profile", None), (shape, None), (number, None)] => {
            shape_number(case, [true, false], shape, number)
        }
        [("upper", None), ("profile", None), (shape, None), (number, None)] => {
            shape_number(case, [true, true], shape, number)
        }
        [("lower", None), ("profile", None), (shape, None), (number, None)] => {
            shape_number(case, [false, false], shape, number)
        }
        [(body @ ("upper" | "lower"), None), layer, ("residual_stress", axis)] => {
            residual(case, body == "upper", layer, axis)
        }
        [(body @ ("upper" | "lower"), None), ref rest @ ..] => body_number(case, body == "upper", rest),
        _ => Err(FORMS.to_owned()),
    }
}

const FORMS: &str = "no such number; paths are those of the case, such as friction.coefficient, lower.coatings[0].young, \
                     lower.substrate.poisson, profile.sphere.radius, load[0].normal_force, load[1].tangential_force[0]";
const ONE_NUMBER: &str = "a map: derivatives are taken by one number, which this is not";

/// The parts of a path: keys with their numbers, in brackets or as parts of their own, as sweeps have them (`lower.coatings.0.young`).
fn steps(path: &str) -> Option<Vec<Step<'_>>> {
    let mut steps: Vec<Step<'_>> = Vec::new();
    for part in path.split('.') {
        let key = match part.split_once('[') {
            None => part,
            Some(("", _)) => return None,
            Some((key, index)) => {
                let (index, column) = match index.strip_suffix(']')?.split_once("][") {
                    Some((row, column)) => (row, Some(column)),
                    None => (index.strip_suffix(']')?, None),
                };
                steps.push((key, Some(index.parse().ok()?)));
                steps.extend(column.map(|column| (column, None)));
                continue;
            }
        };
        match (key.parse(), steps.last_mut()) {
            (Ok(number), Some((_, last @ None))) => *last = Some(number),
            _ if key.is_empty() => return None,
            _ => steps.push((key, None)),
        }
    }
    Some(steps)
}

/// The same with the names of stages, which sweeps have, as their numbers.
fn with_numbers_of_stages<'a>(steps: &[Step<'a>], case: &Case) -> Vec<Step<'a>> {
    if let [("load", None), (name, None), rest @ ..] = steps
        && let Some(stage) = case.stages.iter().position(|stage| stage.name == *name)
    {
        return [&[("load", Some(stage))], rest].concat();
    }
    steps.to_vec()
}

fn coefficient(law: &CoulombFriction) -> Result<f64, String> {
    law.coefficient().uniform().ok_or_else(|| ONE_NUMBER.to_owned())
}

fn strength(case: &Case) -> Found {
    let strength = case.friction.max_shear().ok_or("the case has none")?;
    Ok((What::Strength, strength.uniform().ok_or(ONE_NUMBER)?))
}

fn wear(case: &Case) -> Found {
    let wear = case.wear.as_ref().ok_or("the case has none")?;
    if wear.layers.is_some() {
        return Err("each layer has its own: lower.coatings[0].wear_coefficient".to_owned());
    }
    Ok((What::Wear(0), wear.coefficient.ok_or("the case has none")?))
}

/// A number of the rim, or of the debris.
fn third_body(case: &Case, table: &str, number: &str) -> Found {
    let wear = case.wear.as_ref().ok_or("the case has none")?;
    let none = || format!("the case has no wear.{table}");
    match (table, number) {
        ("rim", "width") => Ok((What::Wear(1), wear.rim.ok_or_else(none)?.width)),
        ("rim", "interior") => Ok((What::Wear(2), wear.rim.ok_or_else(none)?.interior[0])),
        ("debris", "fraction") => Ok((What::Wear(FRACTION), wear.debris.ok_or_else(none)?.fraction)),
        ("debris", "outflow_length") => {
            let length = wear.debris.ok_or_else(none)?.outflow_length;
            Ok((What::Wear(FRACTION + 1), length.ok_or("no debris flows out")?))
        }
        _ => Err(FORMS.to_owned()),
    }
}

/// The wear coefficient of a coating, of the substrate, or of a body that is rigid or rests on what is.
fn layer_wear(case: &Case, of_upper: bool, layer: &[Step<'_>]) -> Found {
    let layers = case.wear.as_ref().and_then(|wear| wear.layers.as_ref());
    let [lower, upper] = layers.ok_or("the layers of the case have none")?.bodies();
    let (own, before) = if of_upper { (upper, lower.len()) } else { (lower, 0) };
    let last = own.len().checked_sub(1).ok_or("the layers of this body have none")?;
    let body = if of_upper { case.bodies.upper() } else { case.bodies.lower() };
    let has_substrate = matches!(body, Body::Elastic(body) if matches!(body.base(), Base::Elastic(_)));
    let index = match *layer {
        [("coatings", Some(index))] if index < last => index,
        [("coatings", Some(_))] => return Err(format!("this body has {last} coatings")),
        [("substrate", None)] if has_substrate => last,
        [] if !has_substrate => last,
        _ => return Err(FORMS.to_owned()),
    };
    if own[index].coefficient == 0.0 {
        return Err("this layer does not wear: with any other number it would".to_owned());
    }
    Ok((What::LayerWear(before + index), own[index].coefficient))
}

/// A number of the law by which friction evolves: its last coefficient, its scale, or one of its table.
fn evolution(case: &Case, (key, row): Step<'_>, column: &[Step<'_>]) -> Found {
    let rule = case.friction_evolution.as_ref().ok_or("friction does not evolve in this case")?;
    let place = match (&rule.law, key, row, column) {
        (EvolutionLaw::Exponential { last, .. }, "last", None, []) => (1, *last),
        (EvolutionLaw::Exponential { scale, .. }, "scale", None, []) => (2, *scale),
        (EvolutionLaw::Table(rows), "table", Some(row), [(column @ ("0" | "1"), None)]) => {
            let column = usize::from(*column == "1");
            let given = rows.get(row).ok_or_else(|| format!("its table has {} rows", rows.len()))?;
            if row == 0 {
                return Err("where it starts: friction.coefficient".to_owned());
            }
            (2 * row + column, given[column])
        }
        (EvolutionLaw::Table(_), ..) => {
            return Err("table[1][0] is the driver of its second row, table[1][1] the coefficient".to_owned());
        }
        (EvolutionLaw::Exponential { .. }, ..) => {
            return Err("friction.evolution.last, friction.evolution.scale".to_owned());
        }
    };
    let (number, value) = place;
    Ok((What::Evolution(number), value))
}

fn stage_friction(case: &Case, stage: usize) -> Found {
    let law = case.stages.get(stage).and_then(|stage| stage.friction.as_ref());
    let value = coefficient(law.ok_or("this stage has no friction of its own")?)?;
    Ok((What::Friction { stage: Some(stage) }, value))
}

fn control(case: &Case, stage: usize, (key, axis): Step<'_>) -> Found {
    let (row, way) = ways().find(|(_, way)| way.name == key).ok_or(FORMS)?;
    let stages = case.stages.len();
    let given = case.stages.get(stage).ok_or_else(|| format!("the case has {stages} stages"))?;
    let freedom = match (row.form, axis) {
        (Form::Number, None) => row.freedom,
        (Form::Pair | Form::PairOrNumber, Some(axis @ 0..2)) => row.freedom + axis,
        (Form::PairOrNumber, None) if case.is_line() => row.freedom,
        (Form::Number, Some(_)) => return Err("it is one number, without an index".to_owned()),
        _ => return Err(format!("{key}[0] is that along x, {key}[1] that along y")),
    };
    let kind = |control: &StageControl| match control {
        StageControl::Force(_) => Kind::Force,
        StageControl::Motion(_) => Kind::Motion,
        StageControl::FarEnd(_) => Kind::FarEnd,
        StageControl::Rate(_) => Kind::Rate,
    };
    let control = given.by_freedom()[freedom].filter(|control| kind(control) == way.kind);
    match control.ok_or_else(|| format!("stage {stage} does not prescribe it"))?.path() {
        Path::To(value) | Path::Wave { amplitude: value, .. } => {
            Ok((What::Control { stage, freedom }, *value))
        }
        Path::Through(_) => Err("a table of loads, which is no one number".to_owned()),
    }
}

fn rig(case: &Case, (key, axis): Step<'_>) -> Found {
    let Rig { normal: spring, tangential: springs } = case.springs();
    let (normal, along) = match (key, axis) {
        ("normal_stiffness", None) => (true, [false; 2]),
        ("tangential_stiffness", None) => (false, [true; 2]),
        ("tangential_stiffness", Some(axis @ 0..2)) => (false, [axis == 0, axis == 1]),
        _ => return Err(FORMS.to_owned()),
    };
    let all = [(normal, spring), (along[0], springs[0]), (along[1], springs[1])];
    let mut given = all.into_iter().filter(|(is, _)| *is).map(|(_, compliance)| compliance);
    let first = given.next().unwrap_or(0.0);
    if first <= 0.0 {
        return Err("the case has no such spring".to_owned());
    }
    if given.any(|other| other != first) {
        return Err(
            "the springs along x and y differ: tangential_stiffness[0], tangential_stiffness[1]".to_owned()
        );
    }
    Ok((What::Rig { normal, along }, 1.0 / first))
}

/// A number of a shape: `[first, second]`, whether it is one of the first shapes, which are the gap's and the upper body's, and whether of two
/// such ones it is the last, which is the upper body's.
fn shape_number(case: &Case, [first, second]: [bool; 2], shape: &str, number: &str) -> Found {
    let of_upper = case.profile.of_upper[0];
    let shapes = &case.profile.shapes;
    let mut candidates =
        (0..shapes.len()).filter(|&index| (index < of_upper) == first && shapes[index].name() == shape);
    let index = if second { candidates.next_back() } else { candidates.next() };
    let index = index.ok_or("the case has no such shape there")?;
    let given = &shapes[index];
    let known = SHAPE_NUMBERS.into_iter().find(|name| *name == number);
    let known = known.zip(given.number(number));
    let known = known.filter(|_| given.gap_change_at(number, 0.0, 0.0).is_some());
    let reason = || format!("no number of a {shape} that the gap depends on smoothly");
    known.map(|(number, value)| (What::Shape { index, number }, value)).ok_or_else(reason)
}

fn body_number(case: &Case, of_upper: bool, steps: &[Step<'_>]) -> Found {
    let body = if of_upper { case.bodies.upper() } else { case.bodies.lower() };
    let Body::Elastic(body) = body else { return Err("this body is rigid".to_owned()) };
    if case.periodic.one_axis().is_some() {
        return Err(
            "derivatives by constants of layers are not taken where one axis alone is periodic".to_owned()
        );
    }
    let (coating, (number, value)) = match *steps {
        [("substrate", None), (number, None)] => match body.base() {
            Base::Elastic(material) => (None, of_material(number, material)?),
            Base::Rigid => return Err("this body rests on a rigid base".to_owned()),
        },
        [("coatings", Some(index)), ref rest @ ..] => {
            let coating = whole_coating(body, index)?;
            let interface = coating.interface();
            let none = "its interface has no such spring";
            let found = match *rest {
                [("thickness", None)] => (LayerNumber::Thickness, coating.thickness()),
                [("interface", None), ("normal_stiffness", None)] => {
                    (LayerNumber::NormalStiffness, interface.normal_stiffness().ok_or(none)?)
                }
                [("interface", None), ("shear_stiffness", None)] => {
                    let stiffness = interface.shear_stiffness().filter(|stiffness| *stiffness > 0.0);
                    (LayerNumber::ShearStiffness, stiffness.ok_or(none)?)
                }
                [(number, None)] => of_material(number, coating.material())?,
                _ => return Err(FORMS.to_owned()),
            };
            (Some(index), found)
        }
        _ => return Err(FORMS.to_owned()),
    };
    Ok((What::Body(BodyNumber { of_upper, coating, number }), value))
}

/// A residual stress: `residual_stress`, which acts along x and y, or that along one of them.
fn residual(case: &Case, of_upper: bool, (layer, index): Step<'_>, axis: Option<usize>) -> Found {
    let layers = case.residual_stress[usize::from(of_upper)].layers();
    let body = if of_upper { case.bodies.upper() } else { case.bodies.lower() };
    let Body::Elastic(body) = body else { return Err("this body is rigid".to_owned()) };
    let has_substrate = matches!(body.base(), Base::Elastic(_));
    let coatings = layers.len() - usize::from(has_substrate && !layers.is_empty());
    let named = match (layer, index) {
        ("coatings", Some(index)) if index < coatings => index,
        ("substrate", None) if has_substrate && !layers.is_empty() => coatings,
        ("coatings", Some(_)) | ("substrate", None) => {
            return Err("this layer has no residual stress".to_owned());
        }
        _ => return Err(FORMS.to_owned()),
    };
    let given = &layers[named];
    if given.rows.is_empty() {
        return Err("this layer has no residual stress".to_owned());
    }
    let stress = given.even().ok_or("a table over the depth, which is no one number")?;
    let (along, value) = match axis {
        Some(axis @ 0..2) => ([axis == 0, axis == 1], stress[axis]),
        None if stress[0] == stress[1] => ([true; 2], stress[0]),
        None => return Err("those along x and y differ: residual_stress[0], residual_stress[1]".to_owned()),
        Some(_) => {
            return Err("residual_stress[0] is that along x, residual_stress[1] that along y".to_owned());
        }
    };
    Ok((What::Residual(ResidualNumber { of_upper, named, along }), value))
}

fn of_material(number: &str, material: &ElasticMaterial) -> Result<(LayerNumber, f64), String> {
    match number {
        "young" => Ok((LayerNumber::Young, material.young())),
        "poisson" => Ok((LayerNumber::Poisson, material.poisson())),
        _ => Err(FORMS.to_owned()),
    }
}

/// A coating of a body without graded ones, whose sublayers have no numbers of their own.
fn whole_coating(body: &HalfSpace, index: usize) -> Result<&Coating, String> {
    if body.coatings().iter().any(Coating::continues) {
        return Err("a body with a graded coating: derivatives by its layers are not taken".to_owned());
    }
    body.coatings().get(index).ok_or_else(|| format!("this body has {} coatings", body.coatings().len()))
}
