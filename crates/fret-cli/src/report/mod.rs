//! A run in one page: HTML with its style and its drawings inside, so that it needs neither network nor other files.
//!
//! From the ground: `scale` and `html`, `chart` and `map` (drawings), `closed_form` (what theory says), `chapters` (what the page
//! tells), and the page itself here.

mod chapters;
pub mod chart;
mod closed_form;
pub mod html;
mod literature;
mod map;
pub mod scale;
mod scene;

use crate::failure::Failure;
use crate::results::Results;
use html::escaped;
use scene::Scene;

/// The style of the page.
const STYLE: &str = include_str!("page.css");

/// The page of a run.
pub fn page(results: &Results) -> Result<String, Failure> {
    let scene = Scene::of(results);
    let title = escaped(&results.title());
    let chapters = [
        chapters::head(&scene),
        chapters::question(&scene),
        chapters::pressing(&scene),
        chapters::fretting_loop(&scene),
        chapters::sections(&scene)?,
        chapters::zones(&scene)?,
        chapters::energy(&scene),
        chapters::comparison(&scene),
        chapters::convergence(&scene),
        chapters::left_out(&scene),
        literature::chapter(&scene),
    ];
    Ok(whole_page(&title, &chapters.concat()))
}

/// A page with the style of all; title and chapters are HTML already.
pub fn whole_page(title: &str, chapters: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{chapters}</main>\n</body>\n</html>\n"
    )
}
