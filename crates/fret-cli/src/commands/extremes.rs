//! `fret extremes`: the table of stiff and extreme scenes; the exit code says whether all hold.

use crate::arguments::ExtremesArguments;
use crate::extremes::{Row, families, json, page, row, table};
use crate::failure::{Failure, Told, Unwritten};
use crate::interrupt;
use crate::terminal;

/// Solves and judges the families.
pub fn extremes(arguments: &ExtremesArguments, as_json: bool) -> Result<(), Told> {
    let families = families(arguments.quick);
    let watched = terminal::is_watched() && !as_json;
    interrupt::listen();
    let rows: Option<Vec<Row>> = families
        .iter()
        .map(|family| {
            if watched {
                terminal::say(&format!("{} ...", family.name));
            }
            row(family)
        })
        .collect();
    let Some(rows) = rows else {
        let what = "the table is not finished; nothing of it is written";
        return Err(Failure::Interrupted(what.to_owned()).into());
    };
    let answer = if as_json { format!("{:#}", json(&rows)) } else { table(&rows) };
    terminal::answer(&answer)?;
    if let Some(path) = &arguments.page {
        std::fs::write(path, page(&rows)).map_err(Unwritten::at(path)).map_err(Failure::from)?;
    }
    let broken: usize = rows.iter().filter(|row| !row.holds()).count();
    if broken == 0 {
        return Ok(());
    }
    Err(Told { failure: Failure::Broken(broken), in_json: as_json })
}
