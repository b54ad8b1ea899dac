//! What the page tells, a chapter a function; an empty text where a run has nothing to say.

mod accounts;
mod pictures;
mod question;

pub use accounts::{comparison, convergence, energy};
pub use pictures::{fretting_loop, pressing, sections, zones};
pub use question::{head, left_out, question};

/// A chapter with its heading.
fn chapter(heading: &str, body: &str) -> String {
    format!("<section><h2>{heading}</h2>\n{body}</section>\n")
}

/// Two or more figures side by side where there is room.
fn side_by_side(figures: &str) -> String {
    format!("<div class=\"figures\">{figures}</div>\n")
}
