//! Depth, width and area of a scar.

use super::line::Line;

/// Share of the depth at which the width is measured: above the roughness beside the scar, below most of its flanks.
pub const RIM: f64 = 0.1;

/// A scar in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hollow {
    /// Largest depth [length].
    pub depth: f64,
    /// Width at a tenth of the depth [length], between the first such places on both sides of the deepest one.
    pub width: f64,
    /// Area of the section [length^2]: that of depths below the level and of what stands above it, each with its sign.
    pub area: f64,
    /// Where the middle of that area lies [length].
    pub middle: f64,
}

impl Hollow {
    /// Of depths along a line, positive into the body; `None` where nothing is below the level.
    pub fn of(line: &Line) -> Option<Self> {
        let Line { x, z } = line;
        let depth = z.iter().copied().fold(0.0, f64::max);
        if depth <= 0.0 {
            return None;
        }
        let level = RIM * depth;
        let crossing = |deep: usize, shallow: usize| {
            x[deep] + (x[shallow] - x[deep]) * (z[deep] - level) / (z[deep] - z[shallow])
        };
        // Outward from the deepest place: a scratch far away is none of the scar.
        let deepest = z.iter().position(|z| *z == depth)?;
        let first = z[..deepest].iter().rposition(|z| *z <= level).map_or(0, |open| open + 1);
        let last = z[deepest..].iter().position(|z| *z <= level).map_or(z.len(), |open| deepest + open) - 1;
        let from = if first > 0 { crossing(first, first - 1) } else { x[first] };
        let to = if last + 1 < z.len() { crossing(last, last + 1) } else { x[last] };
        let pieces =
            || (1..x.len()).map(|k| (x[k] - x[k - 1], 0.5 * (z[k] + z[k - 1]), 0.5 * (x[k] + x[k - 1])));
        let area = pieces().map(|(width, depth, _)| width * depth).sum();
        // By the square, so that the roughness far away hardly counts.
        let weight: f64 = pieces().map(|(width, depth, _)| width * depth * depth).sum();
        let moment: f64 = pieces().map(|(width, depth, x)| width * depth * depth * x).sum();
        Some(Self { depth, width: to - from, area, middle: moment / weight })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola of depth `d` and half-width `a`: width `2 a sqrt(1 - 0.1)` at a tenth, area `4/3 a d`.
    #[test]
    fn a_parabola_has_its_depth_width_area_and_middle() {
        let (a, d, at) = (2.0, 0.5, 0.3);
        let x: Vec<f64> = (0..2001).map(|k| -5.0 + 0.005 * f64::from(k)).collect();
        let z: Vec<f64> = x.iter().map(|x| (d * (1.0 - ((x - at) / a).powi(2))).max(0.0)).collect();
        let found = Hollow::of(&Line { x: x.clone(), z: z.clone() }).unwrap();
        // of second order in the spacing of the points, 1e-5 of the width
        assert!((found.depth - d).abs() < 1e-5);
        assert!((found.width - 2.0 * a * 0.9_f64.sqrt()).abs() < 1e-4);
        assert!((found.area - 4.0 / 3.0 * a * d).abs() < 1e-4);
        assert!((found.middle - at).abs() < 1e-6);
        // a scratch far away
        let z: Vec<f64> =
            z.iter().zip(&x).map(|(z, x)| if (x - 4.0).abs() < 0.02 { 0.2 } else { *z }).collect();
        let scratched = Hollow::of(&Line { x, z }).unwrap();
        assert!((scratched.width - found.width).abs() < 1e-12);
        assert_eq!(Hollow::of(&Line { x: vec![0.0, 1.0], z: vec![0.0, -1.0] }), None);
    }
}
