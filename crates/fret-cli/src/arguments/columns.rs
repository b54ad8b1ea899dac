//! What a call says about the columns of a measured table.

use fret_core::measured::Asked;

use crate::failure::Failure;

/// Columns and their units by the options of a call, such as the examples.
pub fn columns_asked(columns: &[String], units: &[String], examples: [&str; 2]) -> Result<Asked, Failure> {
    let columns = pairs("--columns", columns, examples[0])?;
    Ok(Asked { columns, units: pairs("--units", units, examples[1])? })
}

/// `role=name,role=name`, such as the `example`.
fn pairs(option: &str, given: &[String], example: &str) -> Result<Vec<(String, String)>, Failure> {
    let pair = |pair: &String| {
        let (role, name) = pair.split_once('=').ok_or_else(|| {
            let what = format!("{option} {pair:?}: no equals sign");
            Failure::call(what, format!("{option} \"{example}\""))
        })?;
        Ok((role.trim().to_owned(), name.trim().to_owned()))
    };
    given.iter().map(pair).collect()
}
