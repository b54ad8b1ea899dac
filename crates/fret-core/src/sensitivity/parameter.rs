//! What derivatives can be taken by: numbers of a case, named by their paths as a case writes them.

use super::error::SensitivityError;
use crate::case::Case;
use crate::model::controls::{Form, Kind, ways};
use crate::model::stage::{Path, StageControl};
use crate::model::{Base, Body, Coating, CoulombFriction, ElasticMaterial, HalfSpace, Rig};

/// Which constant of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LayerNumber {
    Young,
    Poisson,
    Thickness,
    NormalStiffness,
    ShearStiffness,
}

/// A constant of a body: of a coating, or of the substrate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct BodyNumber {
    /// Whether it is one of the upper body.
    pub of_upper: bool,
    /// Which coating, from the surface down; `None`: the substrate.
    pub coating: Option<usize>,
    /// Which constant.
    pub number: LayerNumber,
}

/// The residual stress of a layer, the same in all its depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ResidualNumber {
    /// Whether it is one of the upper body.
    pub of_upper: bool,
    /// Which layer, as a case names them, from the surface down.
    pub named: usize,
    /// Whether it acts along x and along y.
    pub along: [bool; 2],
}

/// Which number of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
enum What {
    /// What a stage prescribes of a degree of freedom.
    Control { stage: usize, freedom: usize },
    /// The friction coefficient: at the start, or of a stage.
    Friction { stage: Option<usize> },
    /// The shear strength of the interface.
    Strength,
    /// A number of a shape of the gap.
    Shape { index: usize, number: &'static str },
    /// A stiffness of the machine: normal, along x, along y, or along both.
    Rig { normal: bool, along: [bool; 2] },
    /// The wear coefficient.
    Wear,
    /// A constant of a body.
    Body(BodyNumber),
    /// The residual stress of a layer.
    Residual(ResidualNumber),
}

/// A number of a case by which derivatives are taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    path: String,
    value: f64,
    what: What,
}

/// Numbers of shapes.
const SHAPE_NUMBERS: [&str; 7] =
    ["radius", "radius_x", "radius_y", "flat_radius", "edge_radius", "slope", "amplitude"];

/// A part of a path: a key, and a number in brackets where it has one.
type Step<'a> = (&'a str, Option<usize>);

impl Parameter {
    /// The number of a case that stands at a path.
    ///
    /// # Errors
    /// When there is none, or it is not one that a history depends on smoothly.
    pub fn new(path: &str, case: &Case) -> Result<Self, SensitivityError> {
        let refused = |reason: String| SensitivityError::Parameter { path: path.to_owned(), reason };
        let steps = steps(path).ok_or_else(|| refused(FORMS.to_owned()))?;
        let steps = with_numbers_of_stages(&steps, case);
        let found = match steps[..] {
            [("friction", None)] | [("friction", None), ("coefficient", None)] => {
                coefficient(&case.friction).map(|value| (What::Friction { stage: None }, value))
            }
            [("friction", None), ("max_shear", None)] => strength(case),
            [("wear", None), ("coefficient", None)] => wear(case),
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
        };
        let (what, value) = found.map_err(refused)?;
        Ok(Self { path: path.to_owned(), value, what })
    }

    /// All numbers of a case by which derivatives can be taken.
    pub fn all_of(case: &Case) -> Vec<Self> {
        let mut paths: Vec<String> =
            ["friction.coefficient", "friction.max_shear", "wear.coefficient"].map(str::to_owned).to_vec();
        for (number, stage) in case.stages.iter().enumerate() {
            paths.push(format!("load[{number}].friction"));
            for (row, way) in ways() {
                for axis in row.freedoms().map(|freedom| freedom - row.freedom) {
                    let place = if row.form == Form::Number { String::new() } else { format!("[{axis}]") };
                    if !stage.by_freedom()[row.freedom + axis].is_some_and(|control| control.path().is_zero())
                    {
                        paths.push(format!("load[{number}].{}{place}", way.name));
                    }
                }
            }
        }
        for table in ["profile", "upper.profile", "lower.profile"] {
            for shape in &case.profile.shapes {
                paths.extend(SHAPE_NUMBERS.map(|number| format!("{table}.{}.{number}", shape.name())));
            }
        }
        for (name, body) in [("upper", case.bodies.upper()), ("lower", case.bodies.lower())] {
            let Body::Elastic(body) = body else { continue };
            for coating in 0..body.coatings().len() {
                let numbers = [
                    "young",
                    "poisson",
                    "thickness",
                    "interface.normal_stiffness",
                    "interface.shear_stiffness",
                ];
                paths.extend(numbers.map(|number| format!("{name}.coatings[{coating}].{number}")));
            }
            paths.extend(["young", "poisson"].map(|number| format!("{name}.substrate.{number}")));
        }
        for (name, residual) in ["lower", "upper"].iter().zip(&case.residual_stress) {
            for (index, layer) in residual.layers().iter().enumerate() {
                let is_one = layer.even().is_some_and(|[x, y]| x == y);
                let axes: &[&str] = if is_one { &[""] } else { &["[0]", "[1]"] };
                for layer in [format!("coatings[{index}]"), "substrate".to_owned()] {
                    paths.extend(axes.iter().map(|axis| format!("{name}.{layer}.residual_stress{axis}")));
                }
            }
        }
        paths.extend(["normal_stiffness", "tangential_stiffness"].map(|key| format!("rig.{key}")));
        let mut found: Vec<Self> = Vec::new();
        for path in paths {
            if let Ok(parameter) = Self::new(&path, case)
                && !found.iter().any(|known| known.what == parameter.what)
            {
                found.push(parameter);
            }
        }
        found
    }

    /// Its path.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Its value in the case.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Whether it is what a stage prescribes.
    pub(super) fn is_a_load(&self) -> bool {
        matches!(self.what, What::Control { .. })
    }

    /// Whether it is what a stage prescribes of a degree of freedom.
    pub(super) fn is_control(&self, stage: usize, freedom: usize) -> bool {
        self.what == What::Control { stage, freedom }
    }

    /// Derivatives of the coefficient and of the shear strength in force at a stage.
    pub(super) fn change_of_friction(&self, case: &Case, stage: usize) -> [f64; 2] {
        let latest = (0..=stage).rev().find(|&number| case.stages[number].friction.is_some());
        match self.what {
            What::Friction { stage } if stage == latest => [1.0, 0.0],
            What::Strength => [0.0, 1.0],
            _ => [0.0; 2],
        }
    }

    /// Derivative of the gap at a point, without where it is counted from.
    pub(super) fn change_of_gap(&self, case: &Case, x: f64, y: f64) -> f64 {
        let What::Shape { index, number } = self.what else { return 0.0 };
        case.profile.shapes[index].gap_change_at(number, x, y).unwrap_or(0.0)
    }

    /// Whether the gap depends on it.
    pub(super) fn is_of_shape(&self) -> bool {
        matches!(self.what, What::Shape { .. })
    }

    /// Derivatives of the compliances of the machine [length/force per unit]: normal, along x and y.
    pub(super) fn change_of_rig(&self, case: &Case) -> [f64; 3] {
        let What::Rig { normal, along } = self.what else { return [0.0; 3] };
        let springs = case.springs();
        // Compliance is the inverse of the stiffness that a case gives.
        let of = |is: bool, compliance: f64| if is { -compliance * compliance } else { 0.0 };
        [of(normal, springs.normal), of(along[0], springs.tangential[0]), of(along[1], springs.tangential[1])]
    }

    /// Derivative of the wear coefficient.
    pub(super) fn change_of_wear(&self) -> f64 {
        f64::from(u8::from(self.what == What::Wear))
    }

    /// The residual stress that it is.
    pub(super) fn of_residual(&self) -> Option<ResidualNumber> {
        if let What::Residual(number) = self.what { Some(number) } else { None }
    }

    /// The constant of a body that it is.
    pub(super) fn of_body(&self) -> Option<BodyNumber> {
        if let What::Body(number) = self.what { Some(number) } else { None }
    }
}

const FORMS: &str = "no such number; paths are those of the case, such as friction.coefficient, lower.coatings[0].young, \
                     lower.substrate.poisson, profile.sphere.radius, load[0].normal_force, load[1].tangential_force[0]";
const ONE_NUMBER: &str = "a map: derivatives are taken by one number, which this is not";

/// The parts of a path: keys with their numbers, in brackets or as parts of their own, as sweeps have them (`lower.coatings.0.young`).
fn steps(path: &str) -> Option<Vec<Step<'_>>> {
    let mut steps: Vec<Step<'_>> = Vec::new();
    for part in path.split('.') {
        let (key, index) = match part.split_once('[') {
            None => (part, None),
            Some((key, index)) => (key, Some(index.strip_suffix(']')?.parse().ok()?)),
        };
        match (key.parse(), steps.last_mut()) {
            (Ok(number), Some((_, last @ None))) if index.is_none() => *last = Some(number),
            _ if key.is_empty() => return None,
            _ => steps.push((key, index)),
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

/// A number of a case with its value, or what is wrong with a path.
type Found = Result<(What, f64), String>;

fn coefficient(law: &CoulombFriction) -> Result<f64, String> {
    law.coefficient().uniform().ok_or_else(|| ONE_NUMBER.to_owned())
}

fn strength(case: &Case) -> Found {
    let strength = case.friction.max_shear().ok_or("the case has none")?;
    Ok((What::Strength, strength.uniform().ok_or(ONE_NUMBER)?))
}

fn wear(case: &Case) -> Found {
    let coefficient = case.wear.as_ref().and_then(|wear| wear.coefficient);
    Ok((What::Wear, coefficient.ok_or("the case has none")?))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Both ways to write a path, and names of stages.
    #[test]
    fn paths_are_those_of_cases_and_of_sweeps() {
        let text = "[grid]\ncells = [8, 8]\nsize = [1.0, 1.0]\n[upper]\nrigid = true\n[lower]\ncoatings = [{ thickness = 0.1, young = 3.0, \
                    poisson = 0.2 }]\nsubstrate = { young = 1.0, poisson = 0.3 }\n[profile.sphere]\nradius = 2.0\n[friction]\n\
                    coefficient = 0.3\n[[load]]\nnormal_force = 0.1\nincrements = 1\n[[load]]\nname = \"rub\"\n\
                    tangential_force = [0.01, 0.0]\nincrements = 2\n";
        let case = Case::from_toml(text, "case.toml").unwrap();
        let of = |path: &str| Parameter::new(path, &case).unwrap();
        for (one, other, value) in [
            ("lower.coatings[0].young", "lower.coatings.0.young", 3.0),
            ("load[1].tangential_force[0]", "load.rub.tangential_force.0", 0.01),
            ("load[0].normal_force", "load.0.normal_force", 0.1),
            ("friction", "friction.coefficient", 0.3),
        ] {
            assert_eq!((of(one).what, of(one).value()), (of(other).what, value), "{one}");
        }
        let all = Parameter::all_of(&case);
        let paths: Vec<&str> = all.iter().map(Parameter::path).collect();
        assert_eq!(
            paths,
            [
                "friction.coefficient",
                "load[0].normal_force",
                "load[1].tangential_force[0]",
                "profile.sphere.radius",
                "lower.coatings[0].young",
                "lower.coatings[0].poisson",
                "lower.coatings[0].thickness",
                "lower.substrate.young",
                "lower.substrate.poisson",
            ]
        );
        for wrong in ["lower..young", "[0]", "load.rubb.friction", "lower.coatings[0]", "upper.0"] {
            assert!(Parameter::new(wrong, &case).is_err(), "{wrong}");
        }
    }
}
