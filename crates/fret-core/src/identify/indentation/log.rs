//! A measured indentation: which columns it has, and which of its rows are fitted.

use super::super::error::{IdentifyError, refused};
use super::super::turns::range;
use super::request::{IndentationRequest, Part};
use crate::measured::{BadRow, Kind, Role, Table, read, scales};
use crate::model::Dimension;
use crate::units::Units;

/// Depth of the indenter, and load, among the roles.
const DEPTH: usize = 0;
const LOAD: usize = 1;

/// What the columns of an indentation can hold.
static ROLES: [Role; 2] = [
    Role {
        name: "depth",
        known: &[
            "depth",
            "displacement",
            "displacement_into_surface",
            "indentation",
            "indentation_depth",
            "penetration",
            "penetration_depth",
            "pd",
            "h",
            "hc",
            "tiefe",
            "eindringtiefe",
            "weg",
        ],
        is_needed: true,
        kind: Kind::Length,
        example: "depth",
    },
    Role {
        name: "force",
        known: &[
            "force",
            "load",
            "load_on_sample",
            "normal_force",
            "p",
            "f",
            "fn",
            "kraft",
            "last",
            "normalkraft",
            "prüfkraft",
        ],
        is_needed: true,
        kind: Kind::Force,
        example: "load",
    },
];

/// Rows, at the least.
const FEWEST_ROWS: usize = 12;
/// Rows without a number are skipped up to so many in a sequence, and this part of all rows.
const SKIPPED: (usize, f64) = (3, 0.1);
/// Load over the largest one from which on an indenter holds.
const HOLDS: f64 = 0.99;

/// Depth and load as measured, in the units of the case, pressing positive.
pub struct Curves {
    pub name: String,
    pub depths: Vec<f64>,
    pub loads: Vec<f64>,
    /// Line of every row.
    pub lines: Vec<usize>,
    /// The row of the largest load: what comes before is loading.
    pub top: usize,
    pub has_units: bool,
    /// Of the depths here over those of the log: -1 where the log counts them the other way.
    pub sign: f64,
    pub bad_rows: Vec<String>,
    pub notes: Vec<String>,
}

impl Curves {
    /// Reads a file, and takes the part that is asked for.
    ///
    /// # Errors
    /// What is wrong with it, with the line.
    pub fn read(
        (name, bytes): (&str, &[u8]),
        units: Option<&Units>,
        request: &IndentationRequest,
    ) -> Result<Self, IdentifyError> {
        let table = read((name, bytes), (&ROLES, "measured indentation"), &request.asked, request.strict)?;
        let mut notes = Vec::new();
        let scale = scales(&table, (&ROLES, &request.asked), (units, Dimension::Plane), &mut notes)?;
        let of =
            |role: usize| -> Vec<f64> { table.of(role).iter().map(|value| value * scale[role]).collect() };
        let (mut depths, mut loads) = (of(DEPTH), of(LOAD));
        few_skipped(&table)?;
        enough(&table)?;
        let [low, high] = range(&loads);
        if low.abs() > high.abs() {
            loads = loads.iter().map(|load| -load).collect();
            notes.push("the load is largest below zero: its sign was turned".to_owned());
        }
        let deepens = deepens(&depths, &loads);
        if !deepens {
            depths = depths.iter().map(|depth| -depth).collect();
            notes.push("the depth falls where the load grows: its sign was turned for the fit; the depth at first touch is told as the log counts it".to_owned());
        }
        let has_units = table.columns.iter().flatten().any(|column| column.unit.is_some());
        let bad_rows = table.bad.into_iter().map(|row| row.what).collect();
        let whole = Self {
            name: name.to_owned(),
            depths,
            loads,
            lines: table.lines,
            top: 0,
            has_units,
            sign: if deepens { 1.0 } else { -1.0 },
            bad_rows,
            notes,
        };
        whole.part(request.part)
    }

    /// A part of it.
    fn part(mut self, part: Part) -> Result<Self, IdentifyError> {
        let [_, most] = range(&self.loads);
        let holds = |load: &f64| *load >= HOLDS * most;
        let first = self.loads.iter().position(holds).unwrap_or(0);
        let last = self.loads.iter().rposition(holds).unwrap_or(0);
        let rows = match part {
            Part::Whole => 0..self.loads.len(),
            Part::Loading => 0..first + 1,
            Part::Unloading => last..self.loads.len(),
        };
        if rows.len() < FEWEST_ROWS {
            let what = format!(
                "{} has {} rows (lines {} to {}): a fit needs at least {FEWEST_ROWS}",
                part.name(),
                rows.len(),
                self.lines[rows.start],
                self.lines[rows.end - 1]
            );
            return Err(refused(&self.name, &what, "fit the whole test, or the other part"));
        }
        for values in [&mut self.depths, &mut self.loads] {
            *values = values[rows.clone()].to_vec();
        }
        self.lines = self.lines[rows.clone()].to_vec();
        self.top = usize::midpoint(first, last).saturating_sub(rows.start).min(rows.len());
        Ok(self)
    }
}

/// Whether rows without a number are so few that skipping them leaves the curve.
fn few_skipped(table: &Table) -> Result<(), IdentifyError> {
    let bad = &table.bad;
    let (longest, part) = SKIPPED;
    let follows = |rows: &[BadRow]| rows.windows(2).all(|two| two[1].line == two[0].line + 1);
    let sequence = bad.windows(longest + 1).find(|rows| follows(rows)).map(|rows| &rows[0]);
    let many = bad.first().filter(|_| bad.len() as f64 > part * (bad.len() + table.lines.len()) as f64);
    let Some(first) = sequence.or(many) else { return Ok(()) };
    let what = format!(
        "{} of {} rows have no number, too many to skip; the first of them: {}",
        bad.len(),
        bad.len() + table.lines.len(),
        first.what
    );
    Err(refused(&table.name, &what, &format!("{}, without separators of thousands", first.help)))
}

/// Whether there are rows for a curve, and something changes in them.
fn enough(table: &Table) -> Result<(), IdentifyError> {
    let rows = table.lines.len();
    if rows < FEWEST_ROWS {
        let what = format!(
            "{rows} row{} of numbers: an indentation needs at least {FEWEST_ROWS} points",
            if rows == 1 { "" } else { "s" }
        );
        return Err(refused(&table.name, &what, "a hundred points serve well"));
    }
    for column in table.columns.iter().flatten() {
        if column.values.iter().all(|value| *value == column.values[0]) {
            let what = format!(
                "column {:?} is {:?} in all lines from {} to {}: nothing was measured there",
                column.name,
                column.values[0],
                table.lines[0],
                table.lines[rows - 1]
            );
            return Err(refused(&table.name, &what, "choose another column with --columns"));
        }
    }
    Ok(())
}

/// Whether depth and load grow together: the sign of their covariance.
fn deepens(depths: &[f64], loads: &[f64]) -> bool {
    let count = depths.len() as f64;
    let [depth, load] = [depths, loads].map(|values| values.iter().sum::<f64>() / count);
    depths.iter().zip(loads).map(|(d, p)| (d - depth) * (p - load)).sum::<f64>() >= 0.0
}
