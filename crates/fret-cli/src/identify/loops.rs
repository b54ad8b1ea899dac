//! Measured fretting loops, and what is told of them.

use fret_core::identify::{self, Key};

use super::identified::Identified;
use super::keys::{case_with, value_of};
use super::{page, record, repeated, summary, table};
use crate::failure::Failure;
use fret_results::CaseFile;

/// What is asked of a log, and the key of the case that is fitted too, such as `lower.substrate.young`.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Of the log.
    pub log: identify::Request,
    /// The key.
    pub key: Option<String>,
}

/// Identifies the loops of a log by a case.
///
/// # Errors
/// When the log cannot be read as fretting loops of such a case, or the case cannot be solved.
pub fn loops(log: (&str, &[u8]), case_file: &CaseFile, request: &Request) -> Result<Identified, Failure> {
    let case = case_file.case(None)?;
    let found = match &request.key {
        None => identify::identify(log, case, None, &request.log)?,
        Some(name) => {
            let case_with = |value| case_with(case_file, &[(name, value)]);
            let key = Key { name, value: value_of(case_file, name)?, case_with: &case_with };
            identify::identify(log, case, Some(key), &request.log)?
        }
    };
    let mut tables = vec![("cycles.csv", table::table(&found))];
    if !found.repeated.is_empty() {
        tables.push(("fits.csv", repeated::table(&found)));
    }
    Ok(Identified {
        record: record::record(&found),
        text: summary::summary(&found),
        page: page::page(&found),
        tables,
    })
}
