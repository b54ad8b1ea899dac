//! A run, a sweep or a study in one page: HTML with its style, its drawings and its script inside, so that it needs neither network nor other files, and
//! tells the browser to refuse both.
//!
//! From the ground: `html` (numbers and parts), `measured` (numbers with their units), `rolled` (how far it rolled), `overview` (the run as a whole, and the closed forms that speak about it), `window` (what of
//! the grid is shown), `section` (the line through it), `chapters` (what the page tells), and the page itself here; `sweep` and `study` are pages of their own.

mod answers;
mod chapters;
mod html;
mod literature;
mod measured;
mod overview;
mod rolled;
mod section;
pub mod study;
pub mod sweep;
mod window;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::failure::Failure;
pub use answers::{answer_beside, read_answer};
pub use chapters::{json_in_page, legend_of_zones};
use fret_drawing::Drawing;
use fret_results::Results;
pub use html::{chapter, deviation, given, grid, number, pairs, short, side_by_side, table};
pub use measured::Measured;
pub use overview::{Overview, friction_in, joined};
pub use rolled::Rolled;
pub use section::Section;
pub use sweep::called;
pub use window::{Part, Window};

/// The style of the page.
const STYLE: &str = include_str!("page.css");
/// What moves the slider, and reads charts below a pointer.
const SCRIPT: &str = include_str!("page.js");
/// What the browser may do: show what the page holds, and nothing else.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// The page of a run.
pub fn page(results: &Results) -> Result<String, Failure> {
    let view = Overview::of(results);
    Ok(whole_page(&results.title(), &chapters::all(&view)?))
}

/// A page with the style, the script and the limits of all.
pub fn whole_page(title: &str, content: &Markup) -> String {
    page_with(title, content, &PageParts { policy: POLICY, style: "", script: SCRIPT })
}

/// What a page has of its own.
pub struct PageParts<'a> {
    /// What the browser may do.
    pub policy: &'a str,
    /// Style beside that of all pages.
    pub style: &'a str,
    /// Its script.
    pub script: &'a str,
}

/// A page with the style of all, and what it has of its own.
pub fn page_with(title: &str, content: &Markup, parts: &PageParts<'_>) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(parts.policy);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(Drawing::STYLE)) (PreEscaped(STYLE)) (PreEscaped(parts.style)) }
            }
            body { main { (content) } script { (PreEscaped(parts.script)) } }
        }
    };
    page.into_string() + "\n"
}
