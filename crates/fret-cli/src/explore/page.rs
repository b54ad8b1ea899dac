//! The page: sliders on one side, pictures and numbers on the other. The script asks for solutions and puts them in.

use maud::{PreEscaped, html};
use serde_json::{Value, json};

use super::question::Question;
use super::sliders::Slider;
use crate::report::{Measured, PageParts, called, json_in_page, page_with};

const STYLE: &str = include_str!("explore.css");
const SCRIPT: &str = include_str!("explore.js");
/// What the browser may do: show what the page holds, and ask the program that served it.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'";

/// Places of the pictures, with what stands below them.
const FIGURES: [[&str; 2]; 5] = [
    ["loop", "The last cycle; the dot is what the other pictures show."],
    ["section", "Pressure, and shear along the load, through the middle."],
    ["zones", "Stick and slip."],
    ["pressure", "Contact pressure."],
    ["stress", "Von Mises stress below the middle, drawn when the sliders rest."],
];

/// The page of a case.
pub fn page(question: &Question) -> String {
    let unit = |kind: Option<&str>| question.unit(kind?);
    let slider = |slider: &Slider| {
        let mut entry = json!(slider);
        entry["unit"] = json!(unit(slider.kind));
        entry
    };
    let sliders: Vec<Value> = question.sliders.iter().map(slider).collect();
    let setting = json!({ "sliders": sliders, "name": question.name() });
    let content = html! {
        header {
            h1 { (question.title()) }
            p class="lead" id="status" role="status" aria-live="off" { "solving …" }
        }
        div class="explore" {
            form class="sliders" id="sliders" autocomplete="off" {
                @for (place, slider) in question.sliders.iter().enumerate() {
                    div class="slide" {
                        label for=(format!("slider-{place}")) title=(slider.key) {
                            (called(&slider.key)) @if let Some(unit) = unit(slider.kind) { " [" (unit) "]" }
                        }
                        input type="number" id=(format!("number-{place}")) step="any" aria-label=(called(&slider.key));
                        input type="range" id=(format!("slider-{place}")) min="0" max="1000" step="1";
                    }
                }
                div class="buttons" {
                    button type="button" id="reset" { "As in the case" }
                    button type="button" id="write" { "Write the case" }
                    button type="button" id="write-shown" { "Write as shown" }
                }
                @if !question.notes.is_empty() { p class="small" { "Solved here with " (question.notes.join("; ")) "." } }
            }
            div class="seen" {
                p class="warning" id="trouble" role="alert" hidden {}
                dl class="cards" id="numbers" {}
                label class="moment-of" { "Where on the loop" input type="range" id="moment" min="0" max="0" value="0" step="1"; }
                div class="figures" {
                    @for [name, caption] in FIGURES {
                        figure id=(format!("figure-{name}")) hidden { div class="drawing" id=(name) {} figcaption { (caption) } }
                    }
                }
            }
        }
        noscript { p class="warning" { "The sliders need scripts." } }
        script type="application/json" id="setting" { (PreEscaped(json_in_page(&[setting]))) }
    };
    page_with(&question.title(), &content, &PageParts { policy: POLICY, style: STYLE, script: SCRIPT })
}
