//! The log of a fretting test: which columns it has, and whether they hold a loop.

use crate::measured::{Asked, Kind, MeasuredError, Role, Table, read as table, refused};

/// Displacement of the actuator, its place among the roles.
pub const DISPLACEMENT: usize = 0;
/// Tangential force.
pub const FORCE: usize = 1;
/// Number of the cycle.
pub const CYCLE: usize = 2;
/// Normal force.
pub const NORMAL_FORCE: usize = 3;

/// What the columns of a log can hold.
pub static ROLES: [Role; 4] = [
    Role {
        name: "displacement",
        known: &[
            "displacement",
            "actuator",
            "actuator_x",
            "delta",
            "stroke",
            "position",
            "weg",
            "hub",
            "verschiebung",
        ],
        is_needed: true,
        kind: Kind::Length,
        example: "stroke",
    },
    Role {
        name: "force",
        known: &[
            "force",
            "tangential_force",
            "tangential_force_x",
            "friction_force",
            "q",
            "ft",
            "fx",
            "kraft",
            "reibkraft",
            "tangentialkraft",
        ],
        is_needed: true,
        kind: Kind::Force,
        example: "load",
    },
    Role {
        name: "cycle",
        known: &["cycle", "cycles", "cycle_number", "zyklus"],
        is_needed: false,
        kind: Kind::Number,
        example: "cycle",
    },
    Role {
        name: "normal_force",
        known: &["normal_force", "p", "fn", "normal_load", "normalkraft"],
        is_needed: false,
        kind: Kind::Force,
        example: "normal",
    },
];

/// Rows of numbers, at the least.
pub const FEWEST_ROWS: usize = 12;

/// Reads a log.
///
/// # Errors
/// What is wrong with it, with the line.
pub fn read(name: &str, bytes: &[u8], asked: &Asked, strict: bool) -> Result<Table, MeasuredError> {
    let table = table((name, bytes), (&ROLES, "log"), asked, strict)?;
    enough(&table)?;
    Ok(table)
}

/// Whether there are rows for a loop, and something changes in them.
fn enough(table: &Table) -> Result<(), MeasuredError> {
    let rows = table.lines.len();
    if rows < FEWEST_ROWS {
        return Err(refused(
            &table.name,
            &format!(
                "{rows} row{} of numbers: a loop needs at least {FEWEST_ROWS} points",
                if rows == 1 { "" } else { "s" }
            ),
            "a hundred points a cycle serve well",
        ));
    }
    for column in table.columns.iter().take(2).flatten() {
        if column.values.iter().all(|value| *value == column.values[0]) {
            return Err(refused(
                &table.name,
                &format!(
                    "column {:?} is {:?} in all lines from {} to {}: nothing was measured there",
                    column.name,
                    column.values[0],
                    table.lines[0],
                    table.lines[rows - 1]
                ),
                "choose another column with --columns, or look at the sensor",
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(head: &str, row: impl Fn(usize) -> String) -> String {
        (0..20).fold(head.to_owned(), |text, k| text + &row(k) + "\n")
    }

    fn message(text: &str) -> String {
        match read("log.csv", text.as_bytes(), &Asked::default(), true) {
            Ok(_) => String::new(),
            Err(failure) => failure.to_string(),
        }
    }

    #[test]
    fn exports_of_rigs_are_read() {
        let plain = rows("displacement,force\n", |k| format!("{k}e-6,{k}"));
        let german =
            rows("Versuch 12\nDatum;3.4.2025\n\nZyklus;Weg;Kraft\n;µm;N\n", |k| format!("7;{k},5;{k},25"));
        let bracketed = rows("# rig\nt [s]\tdisplacement [um]\tforce [N]\n", |k| format!("0,1\t{k},5\t{k}"));
        for (text, first, unit) in
            [(plain, 1e-6, None), (german, 1.5, Some("µm")), (bracketed, 1.5, Some("um"))]
        {
            let table = read("log.csv", text.as_bytes(), &Asked::default(), false).unwrap();
            let column = table.columns[0].as_ref().unwrap();
            assert_eq!((column.values[1], column.unit.as_deref()), (first, unit));
            assert_eq!(column.values.len(), 20);
        }
    }

    #[test]
    fn bad_logs_are_told_where() {
        let with = |bad: &'static str| {
            rows("displacement,force\n", move |k| if k == 7 { bad.to_owned() } else { format!("{k}e-6,{k}") })
        };
        for (text, words) in [
            (with("1e-6,abc"), "line 9, column \"force\": \"abc\" is not a number"),
            (with("1e-6,"), "line 9: nothing stands in column \"force\""),
            (with("1e-6"), "line 9: nothing stands in column \"force\""),
            (with(","), "line 9: nothing stands in column \"displacement\""),
            (rows("time,force\n", |k| format!("{k},{k}")), "no line names the columns"),
            (
                rows("displacement,force\n", |k| format!("{k},3.5")),
                "column \"force\" is 3.5 in all lines from 2 to 21",
            ),
            ("displacement,force\n1,2\n".to_owned(), "1 row of numbers"),
            (String::new(), "there are no names"),
        ] {
            assert!(message(&text).contains(words), "{}: expected {words}", message(&text));
        }
    }

    /// Cells without anything are a row that lacks its numbers, where numbers stand above and below; not at the ends of a block.
    #[test]
    fn rows_of_empty_cells_are_named() {
        let plain = rows("displacement,force\n,\n", |k| format!("{k}e-6,{k}"));
        let ended = plain.clone() + ",\n,\n";
        assert_eq!((message(&plain), message(&ended)), (String::new(), String::new()));
        let holed = ended.replace("\n7e-6,7\n", "\n,\n\n7e-6,7\n");
        let table = read("log.csv", holed.as_bytes(), &Asked::default(), false).unwrap();
        let bad: Vec<&str> = table.bad.iter().map(|row| row.what.as_str()).collect();
        assert_eq!(bad, ["line 10: nothing stands in column \"displacement\""]);
        assert_eq!(table.lines.len(), 20);
    }
}
