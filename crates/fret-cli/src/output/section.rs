//! Pictures of sections: a field over x and depth in bands of colour, as SVG written by hand.

use std::fmt::Write;

/// A field over the x axis (columns) and depths (rows), to be drawn.
pub struct Section<'a> {
    /// Title.
    pub title: &'a str,
    /// What is shown, with its unit.
    pub quantity: &'a str,
    /// Cell centres along x.
    pub x: &'a [f64],
    /// Depths of the rows, rising; equal ones are the two sides of an interface.
    pub depths: &'a [f64],
    /// `values[row][column]`.
    pub values: &'a [Vec<f64>],
    /// Depths of interfaces.
    pub interfaces: &'a [f64],
    /// Values of the lowest and the highest colour; those of the section when not given.
    pub range: Option<[f64; 2]>,
}

/// Colours from low to high (viridis, sampled).
const COLOURS: [&str; 16] = [
    "#440154", "#481a6c", "#472f7d", "#414487", "#39568c", "#31688e", "#2a788e", "#23888e", "#1f988b",
    "#22a884", "#35b779", "#54c568", "#7ad151", "#a5db36", "#d2e21b", "#fde725",
];
const WIDTH: f64 = 640.0;
const LEFT: f64 = 78.0;
const TOP: f64 = 46.0;

impl Section<'_> {
    /// The picture; empty without data.
    pub fn svg(&self) -> String {
        let (Some(first), Some(last)) = (self.x.first(), self.x.last()) else { return String::new() };
        let (Some(top), Some(bottom)) = (self.depths.first(), self.depths.last()) else {
            return String::new();
        };
        let half = if self.x.len() > 1 { 0.5 * (self.x[1] - self.x[0]) } else { 0.5 };
        let span = last - first + 2.0 * half;
        let scale = WIDTH / span;
        let height = ((bottom - top) * scale).clamp(120.0, 900.0);
        let down = if bottom > top { height / (bottom - top) } else { 1.0 };
        let finite = || self.values.iter().flatten().copied().filter(|value| value.is_finite());
        let own = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
        let [low, high] = self.range.unwrap_or(own);
        let band = |value: f64| {
            let share = if high > low { (value - low) / (high - low) } else { 0.0 };
            ((share * COLOURS.len() as f64) as usize).min(COLOURS.len() - 1)
        };
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0}\" height=\"{:.0}\" font-family=\"sans-serif\" font-size=\"13\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
             <text x=\"{LEFT}\" y=\"20\" font-size=\"15\">{}</text>\n<text x=\"{LEFT}\" y=\"38\">{}</text>\n<g shape-rendering=\"crispEdges\">\n",
            WIDTH + LEFT + 130.0,
            height + TOP + 56.0,
            escaped(self.title),
            escaped(self.quantity)
        );
        // a row reaches halfway to its neighbours
        for (row, values) in self.values.iter().enumerate() {
            let here = self.depths[row];
            let above = if row > 0 { 0.5 * (self.depths[row - 1] + here) } else { here };
            let below = self.depths.get(row + 1).map_or(here, |next| 0.5 * (here + next));
            if below <= above {
                continue;
            }
            let (y, tall) = (TOP + (above - top) * down, (below - above) * down);
            let mut start = 0;
            while start < values.len() {
                let colour = band(values[start]);
                let end = (start..values.len()).find(|&n| band(values[n]) != colour).unwrap_or(values.len());
                let left = LEFT + start as f64 * 2.0 * half * scale;
                let wide = (end - start) as f64 * 2.0 * half * scale;
                let _ = writeln!(
                    svg,
                    "<rect x=\"{left:.2}\" y=\"{y:.2}\" width=\"{wide:.2}\" height=\"{tall:.2}\" fill=\"{}\"/>",
                    COLOURS[colour]
                );
                start = end;
            }
        }
        svg += "</g>\n";
        for face in self.interfaces.iter().filter(|face| *face > top && *face < bottom) {
            let y = TOP + (face - top) * down;
            let _ = writeln!(
                svg,
                "<line x1=\"{LEFT}\" y1=\"{y:.2}\" x2=\"{:.2}\" y2=\"{y:.2}\" stroke=\"white\" stroke-dasharray=\"6 4\"/>",
                LEFT + WIDTH
            );
        }
        axes(&mut svg, [first - half, last + half], [*top, *bottom], height);
        for (n, colour) in COLOURS.iter().enumerate() {
            let tall = height.min(320.0) / COLOURS.len() as f64;
            let y = TOP + tall * (COLOURS.len() - 1 - n) as f64;
            let _ = writeln!(
                svg,
                "<rect x=\"{:.1}\" y=\"{y:.2}\" width=\"18\" height=\"{:.2}\" fill=\"{colour}\"/>",
                LEFT + WIDTH + 16.0,
                tall + 0.3
            );
            if n % 4 == 0 || n == COLOURS.len() - 1 {
                let edge = if n == COLOURS.len() - 1 { n + 1 } else { n };
                let value = low + (high - low) * edge as f64 / COLOURS.len() as f64;
                let place = y + if edge > n { 4.0 } else { tall };
                let _ = writeln!(
                    svg,
                    "<text x=\"{:.1}\" y=\"{place:.1}\">{}</text>",
                    LEFT + WIDTH + 40.0,
                    short(value)
                );
            }
        }
        svg + "</svg>\n"
    }
}

fn axes(svg: &mut String, x: [f64; 2], z: [f64; 2], height: f64) {
    for n in 0..=4 {
        let share = f64::from(n) / 4.0;
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            LEFT + share * WIDTH,
            TOP + height + 18.0,
            short(x[0] + share * (x[1] - x[0])),
            LEFT - 6.0,
            TOP + share * height + 5.0,
            short(z[0] + share * (z[1] - z[0]))
        );
    }
    let _ = writeln!(
        svg,
        "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{WIDTH}\" height=\"{height:.1}\" fill=\"none\" stroke=\"black\"/>\n\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">x</text>\n<text x=\"14\" y=\"{:.1}\">z</text>",
        LEFT + 0.5 * WIDTH,
        TOP + height + 38.0,
        TOP - 8.0
    );
}

fn short(value: f64) -> String {
    if value == 0.0 || (0.01..1e4).contains(&value.abs()) {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{value:.2e}")
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_of_equal_colour_are_one_rectangle_and_titles_are_safe() {
        let values = vec![vec![0.0; 8], vec![1.0; 8]];
        let section = Section {
            title: "a < b & c",
            quantity: "q",
            x: &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0],
            depths: &[0.0, 2.0],
            values: &values,
            interfaces: &[1.0],
            range: None,
        };
        let svg = section.svg();
        assert!(svg.contains("a &lt; b &amp; c"));
        // paper, two bands, frame, sixteen colours
        assert_eq!(svg.matches("<rect").count(), 1 + 2 + 1 + 16);
        assert_eq!(svg.matches("<line").count(), 1);
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"));
    }
}
