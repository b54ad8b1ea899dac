//! The numbers of a point: the columns of `summary.csv`, and what the page of a sweep draws. Those of the last increment and the last cycle
//! every sweep has; those of stresses, fatigue, cracks, coatings and heat the sweeps whose cases ask for them.

use fret_core::history::{CYCLE_COLUMNS, Column, CycleRecord, Drive, STEP_COLUMNS, rolling_columns};
use fret_core::subsurface::Measure;
use fret_core::subsurface::fatigue::Parameter;
use serde_json::{Value, json};

use crate::heat::{HeatRecord, Resistance};
use crate::stress::kind_of_stress;
use crate::stress::{Bounded, CrackRecord, FilmRecord, ParameterRecord, StressRecord};
use crate::sweep::answer::{Answer, Numbers};

/// Columns of the last increment.
const END: [&str; 12] = [
    "normal_force",
    "approach",
    "max_pressure",
    "max_shear",
    "contact_area",
    "stick_area",
    "dissipated_energy",
    "regime",
    "tangential_force_x",
    "tangential_force_y",
    "shift_x",
    "shift_y",
];
/// Columns of the last cycle.
const CYCLE: [&str; 9] = [
    "dissipated_energy",
    "force_amplitude",
    "displacement_amplitude",
    "energy_ratio",
    "sliding_ratio",
    "stiffness",
    "regime",
    "closure",
    "max_worn_depth",
];
/// Factors of Ruiz, which are no parameters of a plane.
const RUIZ: [&str; 2] = ["ruiz_f1", "ruiz_f2"];

/// A name, the kind of its unit, and its value in a record; none where the record does not have it.
type Row<T> = (&'static str, &'static str, fn(&T) -> Option<Value>);

/// Of a fatigue parameter; the names follow that of the parameter.
const OF_PARAMETER: [Row<ParameterRecord>; 8] = [
    ("_x", "length", |of| Some(json!(of.x))),
    ("_y", "length", |of| Some(json!(of.y))),
    ("_depth", "length", |of| Some(json!(of.depth))),
    ("_cycles", "", |of| of.cycles.map(bounded)),
    ("_largest_cell_cycles", "", |of| of.largest_cell_cycles.map(bounded)),
    ("_point_cycles", "", |of| of.critical_distance.as_ref()?.point.cycles.map(bounded)),
    ("_line_cycles", "", |of| of.critical_distance.as_ref()?.line.cycles.map(bounded)),
    ("_factor_of_safety", "", |of| of.factor_of_safety.map(bounded)),
];

/// Of a short crack from the surface.
const OF_CRACK: [Row<CrackRecord>; 6] = [
    ("crack_fate", "", |crack| Some(json!(crack.fate))),
    ("crack_x", "length", |crack| Some(json!(crack.course.as_ref()?.x))),
    ("crack_y", "length", |crack| Some(json!(crack.course.as_ref()?.y))),
    ("crack_angle", "degrees", |crack| Some(json!(crack.course.as_ref()?.angle))),
    ("crack_length", "length", |crack| Some(json!(crack.course.as_ref()?.length))),
    ("crack_cycles", "", |crack| match crack.fate.as_str() {
        // a crack that does not grow, or stops, is followed without end
        "does_not_grow" | "stops" => Some(json!(INFINITE)),
        _ => crack.course.as_ref()?.cycles.map(|cycles| json!(cycles)),
    }),
];

/// Of the outermost coating: the worst of its states of tension and compression.
const OF_COATING: [Row<Vec<FilmRecord>>; 6] = [
    ("coating_tension", "pressure", |films| most(films.iter().map(|film| film.stress))),
    ("coating_compression", "pressure", |films| least(films.iter().map(|film| film.stress))),
    ("coating_channelling", "pressure x length", |films| {
        most(films.iter().filter_map(|film| film.channelling))
    }),
    ("coating_delamination", "pressure x length", |films| most(films.iter().map(|film| film.delamination))),
    ("channelling_factor_of_safety", "", |films| {
        least(films.iter().filter_map(|film| Some(film.channelling_factor_of_safety?.0)))
    }),
    ("delamination_factor_of_safety", "", |films| {
        least(films.iter().filter_map(|film| Some(film.delamination_factor_of_safety?.0)))
    }),
];

/// Of friction heat, and of the resistance of the contact after the last increment.
const OF_HEAT: [Row<HeatRecord>; 6] = [
    ("friction_power", "", |heat| Some(json!(heat.temperature.as_ref()?.power))),
    ("max_temperature_rise", "", |heat| Some(json!(heat.temperature.as_ref()?.max_rise.value))),
    ("mean_temperature_rise", "", |heat| Some(json!(heat.temperature.as_ref()?.mean_rise))),
    ("lower_fraction_of_heat", "", |heat| Some(json!(heat.temperature.as_ref()?.lower_fraction?))),
    ("thermal_resistance", "", |heat| resistance(heat.resistance.last()?.thermal)),
    ("electrical_resistance", "", |heat| resistance(heat.resistance.last()?.electrical)),
];

/// A column of the summary.
#[derive(Debug, Clone)]
pub struct SummaryColumn {
    /// Its name.
    pub name: String,
    /// The kind of its unit, such as `force x length`; empty where the units of a case say nothing of it.
    pub kind: String,
    /// Its values, one an answer; null where there is none.
    pub values: Vec<Value>,
}

impl SummaryColumn {
    /// Its values as numbers: not a number where there is none, infinite where there is no bound.
    pub fn numbers(&self) -> Vec<f64> {
        self.values.iter().map(number).collect()
    }
}

/// A value as a number: not a number where it is none, infinite where a life or a factor has no bound.
pub fn number(value: &Value) -> f64 {
    match value {
        Value::String(word) if word == INFINITE => f64::INFINITY,
        other => other.as_f64().unwrap_or(f64::NAN),
    }
}

/// What stands for a number beyond all bounds: what programs read as such.
const INFINITE: &str = "inf";

fn finite(value: f64) -> Value {
    if value == f64::INFINITY { json!(INFINITE) } else { json!(value) }
}

fn bounded(value: Bounded) -> Value {
    finite(value.0)
}

fn most(values: impl Iterator<Item = f64>) -> Option<Value> {
    values.reduce(f64::max).map(finite)
}

fn least(values: impl Iterator<Item = f64>) -> Option<Value> {
    values.reduce(f64::min).map(finite)
}

fn resistance(found: Option<Resistance>) -> Option<Value> {
    Some(match found? {
        Resistance::Found(value) => json!(value),
        Resistance::Apart => json!(INFINITE),
    })
}

/// All columns of some answers.
pub fn columns(answers: &[Option<Answer>]) -> Vec<SummaryColumn> {
    let numbers: Vec<Option<&Numbers>> =
        answers.iter().map(|answer| answer.as_ref()?.numbers.as_ref()).collect();
    let of_records = |name: String, kind: &str, value: &dyn Fn(usize) -> Option<Value>| {
        let values = (0..numbers.len()).map(|place| value(place).unwrap_or(Value::Null)).collect();
        SummaryColumn { name, kind: kind.to_owned(), values }
    };
    let mut columns = Vec::new();
    let at_end = |name: &&str| {
        let column = STEP_COLUMNS.iter().find(|column| column.name == *name)?;
        let value = |place: usize| Some(column.json(numbers[place]?.end.as_ref()?));
        Some(of_records(column.name.to_owned(), column.unit, &value))
    };
    columns.extend(END.iter().filter_map(at_end));
    let cycles = numbers.iter().filter_map(|numbers| (*numbers)?.cycle.as_ref());
    let drive = Drive::of_all(cycles.map(|cycle| cycle.drive));
    for column in of_cycle() {
        let value = |place: usize| Some(column.json(numbers[place]?.cycle.as_ref()?));
        columns.push(of_records(format!("cycle_{}", column.name), column.unit_driven(drive), &value));
    }
    let mut asked = Vec::new();
    for (column, of) in rolling_columns() {
        let value = |place: usize| Some(json!(of(numbers[place]?.end.as_ref()?)?));
        asked.push(of_records(column.name.to_owned(), column.unit, &value));
    }
    let stress = |place: usize| -> Option<&StressRecord> { numbers[place]?.stress.as_ref() };
    for measure in Measure::ALL {
        let name = measure.name();
        let largest = |place: usize| stress(place)?.largest.iter().find(|found| found.measure == name);
        let value = |place: usize| Some(json!(largest(place)?.value));
        let depth = |place: usize| Some(json!(largest(place)?.depth));
        asked.push(of_records(format!("max_{name}"), "pressure", &value));
        asked.push(of_records(format!("max_{name}_depth"), "length", &depth));
    }
    let fatigue = |place: usize| stress(place)?.fatigue.as_ref();
    for name in Parameter::ALL.map(Parameter::name).into_iter().chain(RUIZ) {
        let parameter = |place: usize| fatigue(place)?.parameters.get(name);
        let largest = |place: usize| Some(json!(parameter(place)?.largest));
        asked.push(of_records(name.to_owned(), kind_of_stress(name), &largest));
        for (end, kind, of) in OF_PARAMETER {
            asked.push(of_records(format!("{name}{end}"), kind, &|place| of(parameter(place)?)));
        }
    }
    for (name, kind, of) in OF_CRACK {
        asked.push(of_records(name.to_owned(), kind, &|place| of(fatigue(place)?.crack.as_ref()?)));
    }
    for (name, kind, of) in OF_COATING {
        asked.push(of_records(name.to_owned(), kind, &|place| of(stress(place)?.coating.as_ref()?)));
    }
    for (name, kind, of) in OF_HEAT {
        asked.push(of_records(name.to_owned(), kind, &|place| of(numbers[place]?.heat.as_ref()?)));
    }
    asked.retain(|column| column.values.iter().any(|value| !value.is_null()));
    columns.extend(asked);
    columns
}

/// Columns of the last cycle.
fn of_cycle() -> impl Iterator<Item = &'static Column<CycleRecord>> {
    CYCLE.iter().filter_map(|name| CYCLE_COLUMNS.iter().find(|column| column.name == *name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::record::CrackFollowed;

    #[test]
    fn the_summary_has_columns_of_the_tables() {
        for name in END {
            assert!(STEP_COLUMNS.iter().any(|column| column.name == name), "{name}");
        }
        for name in CYCLE {
            assert!(CYCLE_COLUMNS.iter().any(|column| column.name == name), "{name}");
        }
    }

    /// Also where no Paris law is given: whether it ends is known without.
    #[test]
    fn a_crack_that_stops_has_an_endless_life() {
        let (_, _, cycles) = OF_CRACK[5];
        let crack = |fate: &str, cycles: Option<f64>| CrackRecord {
            fate: fate.to_owned(),
            reason: None,
            course: Some(CrackFollowed {
                x: 0.0,
                y: 0.0,
                angle: 0.0,
                towards: [1.0, 0.0],
                length: 1.0,
                cycles,
            }),
        };
        for fate in ["does_not_grow", "stops"] {
            assert_eq!(cycles(&crack(fate, None)), Some(json!("inf")));
        }
        assert_eq!(cycles(&crack("grows", Some(2e5))), Some(json!(2e5)));
        assert_eq!(cycles(&crack("grows", None)), None);
    }

    /// What pandas and spreadsheets read as infinite is more than every limit; what is missing is no number.
    #[test]
    fn a_life_without_bound_is_infinite_and_one_that_was_not_asked_for_is_missing() {
        assert_eq!(number(&bounded(Bounded(f64::INFINITY))), f64::INFINITY);
        assert_eq!(number(&bounded(Bounded(2.5e6))), 2.5e6);
        assert!(number(&Value::Null).is_nan());
    }
}
