//! `fret compare-scar`: the computed wear depth of a run beside a line that a profilometer has measured.
//!
//! Written into `scar/` in the result folder: `scar.json` (numbers, and what was done to the line), `scar.csv` (both depths by cell),
//! `scar.svg`.

use std::fmt::Write as _;

use fret_core::measured::MeasuredError;
use fret_core::scar::{Comparison, Line, Pair, compare, read};
use ndarray::Array2;
use serde_json::{Value, json};

use crate::arguments::{CompareScarArguments, columns_asked};
use crate::failure::Failure;
use crate::figures::{figure, figure_in, indented};
use crate::log_file::{content, name_of};
use crate::manner::place_of_answer;
use crate::table::{Cell, Columns};
use crate::terminal::Answer;
use fret_drawing::{Chart, Curve, Label};
use fret_results::{Results, SCAR};

/// Fields that hold a wear depth: of each body where they move against each other, or of both together.
const OF_BOTH: &str = "worn_depth";

/// Compares the last kept wear depth of a run with a measured line.
pub fn compare_scar(arguments: &CompareScarArguments) -> Result<Answer, Failure> {
    let examples = ["position=x,height=z", "position=um,height=nm"];
    let asked = columns_asked(&arguments.columns, &arguments.units, examples)?;
    let run = Results::read(&arguments.folder)?;
    let name = name_of(&arguments.measured);
    let refused = |error: MeasuredError| Failure::call(error.what, error.help);
    let measured = read((&name, &content(&arguments.measured)?), &asked, run.units()).map_err(refused)?;
    let worn = Worn::of(&run, arguments.body.as_deref())?;
    let axis = usize::from(arguments.along == "y");
    if !run.grid().dimension().axes().contains(&axis) {
        let what = "a line contact has the same wear depth all along y";
        return Err(Failure::call(what, "--along x"));
    }
    let found = compare(&worn.section(&run, axis), run.grid().spacing()[axis], measured).map_err(refused)?;
    let manner = &arguments.manner;
    let place = place_of_answer(manner, &arguments.folder, SCAR, "a comparison of scars")?;
    let answer = BesideMeasured { run: &run, worn: &worn, along: &arguments.along, found: &found };
    let record = answer.record();
    manner.write_json(&place.join(SCAR[1]), &record)?;
    manner.write(&place.join("scar.csv"), answer.csv().as_bytes())?;
    manner.write(&place.join("scar.svg"), answer.picture().as_bytes())?;
    let text = format!("{}\nwritten to {}", answer.text(), place.display());
    Ok(Answer::new(record, text))
}

/// The last kept wear depth of a run.
struct Worn {
    /// Whose it is, in words.
    whose: &'static str,
    increment: usize,
    depth: Array2<f64>,
}

impl Worn {
    fn of(run: &Results, body: Option<&str>) -> Result<Self, Failure> {
        let (field, whose) = match body {
            Some("upper") => ("upper_worn_depth", "the upper body"),
            Some(_) => ("lower_worn_depth", "the lower body"),
            None if run.fields.has("lower_worn_depth") => ("lower_worn_depth", "the lower body"),
            None => (OF_BOTH, "both bodies together"),
        };
        let missing = |what: &str| {
            let way_out = if run.case().wear.is_some() {
                "run the case again with output.fields = [\"worn_depth\", ...]"
            } else {
                "nothing wears in its case: [wear] coefficient = ..., or wear_coefficient in the layers"
            };
            Failure::call(format!("{}: {what}", run.path.display()), way_out)
        };
        let Some(&increment) = run.fields.reached.last() else {
            return Err(missing("no fields were kept"));
        };
        let depth = run.field(field, increment)?.ok_or_else(|| match body {
            Some(body) if run.fields.has(OF_BOTH) => Failure::call(
                format!(
                    "{}: the wear depths of the {body} body by itself were not kept: only bodies that move have one each",
                    run.path.display()
                ),
                "without --body: the wear depth of both bodies together; or [kinematics] displacement = \"finite\"",
            ),
            _ => missing(&format!("the field {field} was not kept")),
        })?;
        Ok(Self { whose, increment, depth })
    }

    /// Along an axis, through the deepest cell.
    fn section(&self, run: &Results, axis: usize) -> Line {
        let mut deepest = ([0, 0], 0.0);
        for ((i, j), depth) in self.depth.indexed_iter() {
            if *depth > deepest.1 {
                deepest = ([i, j], *depth);
            }
        }
        let [i, j] = deepest.0;
        let z = if axis == 0 { self.depth.column(j).to_vec() } else { self.depth.row(i).to_vec() };
        Line { x: run.grid().centres(axis).to_vec(), z }
    }
}

/// What is told.
struct BesideMeasured<'a> {
    run: &'a Results,
    worn: &'a Worn,
    along: &'a str,
    found: &'a Comparison,
}

impl BesideMeasured<'_> {
    fn record(&self) -> Value {
        let found = self.found;
        let number = |pair: &Pair| {
            let of = json!({ "computed": pair.computed, "measured": pair.measured, "difference": pair.difference() });
            (pair.name.to_owned(), of)
        };
        let numbers: serde_json::Map<String, Value> = found.numbers.iter().map(number).collect();
        json!({
            "measured": found.name,
            "along": self.along,
            "body": self.worn.whose,
            "increment": self.worn.increment,
            "units": self.run.units(),
            "numbers": numbers,
            "worn_volume": self.volume(),
            "root_mean_square_difference": found.difference,
            "moved": found.moved,
            "slope_taken_off": found.taken_off[0],
            "offset_taken_off": found.taken_off[1],
            "root_mean_square_beside_the_scar": found.beside,
            "means_over": found.means_over,
            "unfinished": self.run.unfinished(),
            "notes": found.notes,
        })
    }

    /// Wear volume of the scar.
    fn volume(&self) -> f64 {
        self.worn.depth.sum() * self.run.grid().cell_area()
    }

    fn csv(&self) -> String {
        let Comparison { x, computed, measured, .. } = self.found;
        let rows =
            x.iter().zip(computed).zip(measured).map(|((x, computed), measured)| [*x, *computed, *measured]);
        let columns = Columns::<[f64; 3]>::new()
            .column(self.along, "length", |row| row[0])
            .column("computed_depth", "length", |row| row[1])
            .column("measured_depth", "length", |row| row[2]);
        columns.csv(self.run.units(), rows)
    }

    fn picture(&self) -> String {
        let unit = self.run.units().map(|units| units.length.clone());
        let axes = [self.along, "height"].map(|name| Label::with(name, unit.clone()));
        let curve = |z: &[f64], name: &str, colour: usize| {
            let points = self.found.x.iter().zip(z).map(|(x, z)| [*x, -z]).collect();
            Curve::line(points, name, colour)
        };
        let curves =
            vec![curve(&self.found.measured, "measured", 1), curve(&self.found.computed, "computed", 0)];
        Chart::new("wear scar, computed and measured", axes, curves)
            .drawing()
            .alone(&[&self.run.title(), &format!("wear scar of {}, {}", self.worn.whose, self.found.name)])
    }

    fn text(&self) -> String {
        let found = self.found;
        let units = self.run.units();
        let mut text = self.run.unfinished().map_or(String::new(), |why| format!("{why}\n"));
        let _ = writeln!(
            text,
            "wear scar of {} after increment {}, along {}, beside {}\n",
            self.worn.whose, self.worn.increment, self.along, found.name
        );
        let columns = Columns::<Pair>::new()
            .column("", "", |pair| pair.name)
            .column("computed", "", |pair| Cell::Of(pair.computed, pair.kind))
            .column("measured", "", |pair| Cell::Of(pair.measured, pair.kind))
            .column("difference", "", |pair| {
                pair.difference().map_or_else(|| "-".to_owned(), |part| format!("{:+.1} %", 100.0 * part))
            });
        text += &indented(&columns.text(&[8, 18, 18], units, &found.numbers));
        let length = |value: f64| figure_in(units, value, "length");
        let kind_of_volume = self.run.grid().dimension().kind("length^3");
        let _ = writeln!(text, "  volume   {}", figure_in(units, self.volume(), kind_of_volume));
        let _ = writeln!(text, "  root mean square of the difference: {}", length(found.difference));
        let _ = writeln!(
            text,
            "\nwidths at a tenth of the depth; the measured line was levelled by what lies beside the scar (slope {}, root mean square there \
             {}) and moved by {}, so that the middles of both scars lie together",
            figure(found.taken_off[0]),
            length(found.beside),
            length(found.moved)
        );
        for note in &found.notes {
            let _ = writeln!(text, "note: {note}");
        }
        text
    }
}
