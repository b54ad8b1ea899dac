//! A sweep in one page: fretting map, curves over an axis, uncertainty, and every point with its loop. Links choose the point that is
//! shown; no script is needed for it.
//!
//! From the ground: `words` (what keys and columns are called), `view` (what a folder holds), `fretting_map`, `curves`, `points`, `spread`, and the page itself here.

mod curves;
mod fretting_map;
mod points;
mod spread;
mod view;
mod words;

use std::path::Path;

use maud::{Markup, html};

use super::whole_page;
use crate::failure::Failure;
use crate::figures::counted;
use crate::sweep::Counts;
use view::View;
pub use words::called;

/// The page of a sweep, and how many points it has.
///
/// # Errors
/// When the folder is none of a sweep.
pub fn page(folder: &Path) -> Result<(String, usize), Failure> {
    let view = View::read(folder)?;
    let content = html! {
        (head(&view))
        (map_and_point(&view))
        (curves::curves(&view))
        (spread::spread(&view))
        (points::table(&view))
    };
    Ok((whole_page(&view.title(), &content), view.record.points.len()))
}

fn head(view: &View) -> Markup {
    let Counts { solved, refused, failed } = Counts::of(&view.answers);
    let open = view.answers.iter().filter(|answer| answer.is_none()).count();
    let counts = [(solved, "solved"), (refused, "refused"), (failed, "failed"), (open, "not solved yet")];
    let told = counts.iter().filter(|(count, _)| *count > 0);
    let told: Vec<String> = told.map(|(count, word)| format!("{count} {word}")).collect();
    let points = counted(view.record.points.len(), "point");
    html! {
        header {
            h1 { (view.title()) }
            p class="lead" { "fretting " (env!("CARGO_PKG_VERSION")) " · " (points) ": " (told.join(", ")) }
        }
    }
}

fn map_and_point(view: &View) -> Markup {
    let maps = fretting_map::maps(view).filter(|_| view.record.drawn.is_empty());
    let heading = if maps.is_some() { "Fretting map" } else { "Point by point" };
    html! {
        section {
            h2 { (heading) }
            div class="beside" {
                @if let Some(maps) = &maps { div { (maps) } }
                div class="chosen" {
                    p class="hint" { "Choose a point " @if maps.is_some() { "of the map or " } "of the table below: its loop and its numbers appear here." }
                    (points::one_by_one(view))
                }
            }
        }
    }
}
