//! What a call says about the columns of a measured table.

use crate::failure::Failure;

/// `role=name,role=name`, such as the `example`.
pub fn pairs(option: &str, given: &[String], example: &str) -> Result<Vec<(String, String)>, Failure> {
    given
        .iter()
        .map(|pair| {
            pair.split_once('=')
                .map(|(role, name)| (role.trim().to_owned(), name.trim().to_owned()))
                .ok_or_else(|| {
                    Failure::Call(
                        format!("{option} {pair:?}: no equals sign"),
                        format!("{option} \"{example}\""),
                    )
                })
        })
        .collect()
}
