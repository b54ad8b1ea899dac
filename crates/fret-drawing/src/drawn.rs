//! A picture, not yet put anywhere: in a page, or a file of its own.

use maud::{Markup, html};

/// A picture, not yet put anywhere.
#[derive(Debug)]
pub struct Drawing {
    /// What it shows, for those who cannot see it.
    pub what: String,
    /// Width and height in its own units.
    pub size: [f64; 2],
    /// What a pointer over it reads: the places and the ranges of its axes.
    pub reading: Option<String>,
    /// Its elements.
    pub content: Markup,
}

impl Drawing {
    /// The style of pictures: the palette by day, and what is drawn in which colour.
    pub const STYLE: &str = concat!(include_str!("palette.css"), include_str!("drawing.css"));

    /// A figure of a page, with its caption.
    pub fn captioned(content: &Markup, caption: &str) -> Markup {
        html! { figure { (content) figcaption { (caption) } } }
    }

    /// The picture as part of a page that has [`Self::STYLE`].
    pub fn in_page(&self) -> Markup {
        let [width, height] = self.size;
        html! {
            svg viewBox=(format!("0 0 {width} {height:.0}")) role="img" aria-label=(self.what) data-axes=[&self.reading] {
                (self.content)
            }
        }
    }

    /// The picture as a file of its own, under a heading.
    pub fn alone(&self, heading: &[&str]) -> String {
        let [width, height] = self.size;
        let above = 12.0 + 18.0 * heading.len() as f64;
        let all = height + above;
        let svg = html! {
            svg xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {width} {all:.0}"))
                width=(format!("{:.0}", 1.6 * width)) height=(format!("{:.0}", 1.6 * all)) role="img" aria-label=(self.what) {
                style { (maud::PreEscaped(Self::STYLE)) }
                rect class="paper" width="100%" height="100%" {}
                @for (number, line) in heading.iter().enumerate() {
                    text class=(if number == 0 { "title" } else { "axis" }) x="12" y=(22 + 18 * number) { (line) }
                }
                g transform=(format!("translate(0 {above})")) { (self.content) }
            }
        };
        svg.into_string() + "\n"
    }
}
