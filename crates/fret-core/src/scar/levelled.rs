//! What the instrument adds to a line: tilt, offset, its sense of up. Found from what lies beside the scar, and so is how rough the line is.

use super::hollow::Hollow;
use super::line::Line;
use crate::measured::{MeasuredError, refused};

/// Share of the line at each of its ends that is first taken to lie beside the scar.
const END: f64 = 0.15;
/// How far from the middle of the scar its surroundings begin, over half of its width at a tenth of the depth.
const BESIDE: f64 = 1.25;
/// Points beside the scar on either side, at the least.
const FEWEST: usize = 3;
/// A root mean square beside the scar of more than this share of the depth is roughness: the deepest point of such a line is deeper than its scar, by
/// two or three times as much.
const ROUGH: f64 = 5e-3;
/// Means that are taken of a rough line, over the length of the scar by what counts in its square, which is 5/6 of the width of a parabola.
const MEANS: f64 = 0.12;
/// What is farther from the surroundings than so many times their root mean square is no roughness.
const BEYOND: f64 = 3.0;
/// Rounds in which scar and surroundings are told apart.
const ROUNDS: usize = 8;

/// A line of depths, positive into the body, and what was taken off.
#[derive(Debug, Clone)]
pub struct Levelled {
    /// Depths below the surroundings of the scar [length].
    pub line: Line,
    /// Slope of the surroundings that was taken off [-].
    pub slope: f64,
    /// Height of the surroundings at position 0 that was taken off [length].
    pub offset: f64,
    /// Whether the line counted depths, not heights.
    pub counts_depths: bool,
    /// Root mean square of what is left beside the scar [length]: the roughness there.
    pub beside: f64,
    /// Of a rough line, what depth and width are read from: means over so much [length], and their root mean square beside the scar [length].
    pub means: Option<[f64; 2]>,
}

impl Levelled {
    /// Another line, over as much as the means of this one are.
    pub fn as_rough(&self, line: &Line) -> Line {
        self.means.map_or(line.clone(), |[over, _]| line.means(over))
    }
}

/// Levels a line of heights, or of depths.
///
/// # Errors
/// When it shows no hollow, or does not run past it on both sides.
pub fn levelled(name: &str, heights: &Line) -> Result<Levelled, MeasuredError> {
    let [first, last] = [heights.x[0], heights.x[heights.x.len() - 1]];
    let ends = END * (last - first);
    let mut is_beside: Vec<bool> = heights.x.iter().map(|x| *x < first + ends || *x > last - ends).collect();
    let mut found = None;
    for _ in 0..ROUNDS {
        let [offset, slope] = straight(heights, &is_beside);
        let z = heights.x.iter().zip(&heights.z).map(|(x, z)| z - offset - slope * x).collect();
        let raised = Line { x: heights.x.clone(), z };
        let roughness = root_mean_square(&raised, &is_beside);
        let deepest = raised.z.iter().map(|z| z.abs()).fold(0.0, f64::max);
        let is_rough = roughness > ROUGH * deepest;
        let over = is_rough.then(|| MEANS * raised.length_beyond(BEYOND * roughness));
        let shape = over.map_or_else(|| raised.clone(), |over| raised.means(over));
        // What was worn lies on one side of its surroundings, farther from them than what was piled up.
        let most = |sign: f64| shape.z.iter().map(|z| sign * z).fold(0.0, f64::max);
        let counts_depths = most(1.0) > most(-1.0);
        let down = |line: &Line| Line {
            x: line.x.clone(),
            z: line.z.iter().map(|z| if counts_depths { *z } else { -z }).collect(),
        };
        let (line, shape) = (down(&raised), down(&shape));
        let Some(hollow) = Hollow::of(&shape) else { break };
        let reach = BESIDE * 0.5 * hollow.width;
        let now: Vec<bool> = line.x.iter().map(|x| (x - hollow.middle).abs() > reach).collect();
        let count = |left: bool| {
            line.x.iter().zip(&now).filter(|(x, beside)| **beside && (**x < hollow.middle) == left).count()
        };
        if count(true) < FEWEST || count(false) < FEWEST {
            let what = format!(
                "the scar is {:?} wide, and the line ends in it: its surroundings are what depths are counted from",
                hollow.width
            );
            return Err(refused(
                name,
                &what,
                "a line that runs past the scar on both sides, by half of its width",
            ));
        }
        let beside = root_mean_square(&line, &now);
        let means = over.map(|over| [over, root_mean_square(&shape, &now)]);
        let is_settled = now == is_beside;
        is_beside = now;
        found = Some(Levelled { line, slope, offset, counts_depths, beside, means });
        if is_settled {
            break;
        }
    }
    found.ok_or_else(|| refused(name, "no scar: the line has no hollow", "a line across the scar"))
}

/// Root mean square of the chosen points; 0 of none.
fn root_mean_square(line: &Line, chosen: &[bool]) -> f64 {
    let points = || line.z.iter().zip(chosen).filter(|(_, chosen)| **chosen).map(|(z, _)| z);
    (points().map(|z| z * z).sum::<f64>() / points().count().max(1) as f64).sqrt()
}

/// Offset and slope of the straight line nearest to the chosen points.
fn straight(line: &Line, chosen: &[bool]) -> [f64; 2] {
    let points =
        || line.x.iter().zip(&line.z).zip(chosen).filter(|(_, chosen)| **chosen).map(|(point, _)| point);
    let count = points().count().max(1) as f64;
    let [x, z] =
        [points().map(|(x, _)| x).sum::<f64>() / count, points().map(|(_, z)| z).sum::<f64>() / count];
    let square: f64 = points().map(|(at, _)| (at - x) * (at - x)).sum();
    let product: f64 = points().map(|(at, height)| (at - x) * (height - z)).sum();
    let slope = if square > 0.0 { product / square } else { 0.0 };
    [z - slope * x, slope]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola 2 deep and 8 wide in a surface that leans, as heights or as depths, measured from anywhere.
    fn scar(sign: f64) -> Line {
        let x: Vec<f64> = (0..400).map(|k| 30.0 + 0.05 * f64::from(k)).collect();
        let z = x
            .iter()
            .map(|x| sign * (-2.0 + ((x - 39.0) / 4.0).powi(2) * 2.0).min(0.0) + 7.0 + 0.3 * x)
            .collect();
        Line { x, z }
    }

    #[test]
    fn tilt_offset_and_sense_of_the_instrument_are_taken_off() {
        for (sign, counts_depths) in [(1.0, false), (-1.0, true)] {
            let found = levelled("line", &scar(sign)).unwrap();
            assert_eq!(found.counts_depths, counts_depths);
            // the surroundings are straight, so nothing but rounding is left of them
            assert!((found.slope - 0.3).abs() < 1e-12 && (found.offset - 7.0).abs() < 1e-10, "{found:?}");
            let hollow = Hollow::of(&found.line).unwrap();
            assert!((hollow.depth - 2.0).abs() < 1e-3 && (hollow.middle - 39.0).abs() < 1e-3);
            assert!(found.beside < 1e-10);
        }
    }

    #[test]
    fn a_line_that_ends_in_its_scar_is_refused() {
        let line = scar(1.0);
        let part = Line { x: line.x[110..300].to_vec(), z: line.z[110..300].to_vec() };
        assert!(levelled("line", &part).unwrap_err().what.contains("the line ends in it"));
        let flat = Line { x: line.x.clone(), z: vec![1.0; line.x.len()] };
        assert!(levelled("line", &flat).unwrap_err().what.contains("no hollow"));
    }
}
