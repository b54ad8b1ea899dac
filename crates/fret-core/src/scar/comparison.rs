//! A measured scar beside a computed one.

use super::hollow::Hollow;
use super::levelled::levelled;
use super::line::{Line, Measured};
use crate::measured::{MeasuredError, refused};
use crate::units::{Units, conversion};

/// Wear depths below this share of the largest are no scar.
const WORN: f64 = 1e-3;

/// Depths that differ by more are perhaps in other units.
const FACTOR: f64 = 30.0;

/// Units that instruments write heights in.
const HEIGHTS: [&str; 4] = ["nm", "um", "mm", "m"];

/// A number of both scars.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Its name.
    pub name: &'static str,
    /// What its unit is one of.
    pub kind: &'static str,
    /// Of the computed scar.
    pub computed: f64,
    /// Of the measured one.
    pub measured: f64,
}

impl Pair {
    /// Computed less measured, over measured [-]; none where nothing was measured.
    pub fn difference(&self) -> Option<f64> {
        (self.measured != 0.0).then(|| self.computed / self.measured - 1.0)
    }
}

/// A measured scar beside a computed one, over the cells of the computed one that the line reaches.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Name of the measured line.
    pub name: String,
    /// Positions of the cells, of the computed scar [length].
    pub x: Vec<f64>,
    /// Computed wear depths [length].
    pub computed: Vec<f64>,
    /// Measured depths, in the mean over each cell [length].
    pub measured: Vec<f64>,
    /// Depth, width, area.
    pub numbers: Vec<Pair>,
    /// Root mean square of the difference over the cells of either scar [length].
    pub difference: f64,
    /// By how much the measured line was moved along x, so that the middles of both scars lie together [length].
    pub moved: f64,
    /// Slope and height at position 0 that were taken off the measured line.
    pub taken_off: [f64; 2],
    /// Root mean square of the measured line beside the scar [length].
    pub beside: f64,
    /// Of a rough line, that depths and widths of both are read from means over so much [length].
    pub means_over: Option<f64>,
    /// What was done and taken for granted.
    pub notes: Vec<String>,
}

/// Another unit of heights in which a scar that is so many times too deep would be nearest to right, if that one is known.
fn likelier(unit: Option<&str>, ratio: f64) -> Option<&'static str> {
    let metres = |unit: &str| Some(conversion(unit, "length", Some(&Units::new("m", "N"))).ok()?.factor());
    let own = metres(unit?)?;
    let off = |unit: &str| metres(unit).map_or(f64::INFINITY, |other| (other / own * ratio).ln().abs());
    let others = HEIGHTS.into_iter().filter(|other| metres(other) != Some(own));
    others.min_by(|one, other| off(one).total_cmp(&off(other)))
}

/// Compares a computed wear depth along a line of cells with a measured line: tilt and offset are those of the surroundings of the scar, and
/// the middles of both scars are laid together.
///
/// # Errors
/// When there is no scar on either side, or the line ends in it.
pub fn compare(computed: &Line, width: f64, measured: Measured) -> Result<Comparison, MeasuredError> {
    let Measured { name, line, unit, mut notes } = measured;
    let Some(own) = Hollow::of(computed) else {
        return Err(refused(&name, "the computed surfaces are not worn", "a run with [wear], to its end"));
    };
    let level = levelled(&name, &line)?;
    let scar = Hollow::of(&level.as_rough(&level.line))
        .ok_or_else(|| refused(&name, "no scar: the line has no hollow", ""))?;
    let moved = own.middle - scar.middle;
    let mut both = [Vec::new(), Vec::new(), Vec::new()];
    for (x, depth) in computed.x.iter().zip(&computed.z) {
        if let Some(mean) = level.line.mean_over(x - moved, width) {
            for (list, value) in both.iter_mut().zip([*x, *depth, mean]) {
                list.push(value);
            }
        }
    }
    let [x, depths, means] = both;
    let of = |z: &Vec<f64>| Hollow::of(&level.as_rough(&Line { x: x.clone(), z: z.clone() }));
    let (Some(one), Some(other)) = (of(&depths), of(&means)) else {
        return Err(refused(&name, "the line does not reach the computed scar", "a longer line"));
    };
    let is_worn = |k: &usize| depths[*k] > WORN * one.depth || means[*k] > WORN * other.depth;
    let worn: Vec<f64> = (0..x.len()).filter(is_worn).map(|k| depths[k] - means[k]).collect();
    let difference = (worn.iter().map(|off| off * off).sum::<f64>() / worn.len().max(1) as f64).sqrt();
    if let Some([over, left]) = level.means {
        notes.push(format!(
            "the surface beside the scar is rough by {:.2e}, {:.1} % of the depth: depth and width of both lines are those of their means over {over:.2e} around each point, \
             beside the scar {:.1} %",
            level.beside,
            100.0 * level.beside / other.depth,
            100.0 * left / other.depth
        ));
    }
    let ratio = other.depth / one.depth;
    if !(1.0 / FACTOR..FACTOR).contains(&ratio) {
        notes.push(format!(
            "the measured scar is {ratio:.1e} times as deep as the computed one: is the unit of the heights right?{}",
            likelier(unit.as_deref(), ratio).map_or_else(String::new, |unit| format!(" --units \"height={unit}\""))
        ));
    }
    if level.counts_depths {
        notes.push("the line rises in the scar: taken as depths".to_owned());
    }
    let reached = computed.x.len() - x.len();
    let outside = computed.x.iter().zip(&computed.z).filter(|(at, _)| !x.contains(at));
    if outside.clone().any(|(_, depth)| *depth > WORN * own.depth) {
        return Err(refused(
            &name,
            &format!("the line does not reach {reached} cells, and some of them are worn in the computation"),
            "a line that runs past the computed scar on both sides",
        ));
    }
    let pair =
        |name, kind, of: fn(&Hollow) -> f64| Pair { name, kind, computed: of(&one), measured: of(&other) };
    let numbers = vec![
        pair("depth", "length", |hollow| hollow.depth),
        pair("width", "length", |hollow| hollow.width),
        pair("area", "length^2", |hollow| hollow.area),
    ];
    Ok(Comparison {
        name,
        numbers,
        difference,
        moved,
        taken_off: [level.slope, level.offset],
        beside: level.beside,
        means_over: level.means.map(|[over, _]| over),
        notes,
        x,
        computed: depths,
        measured: means,
    })
}

#[cfg(test)]
mod tests {
    use rand_pcg::Pcg64Mcg;
    use rand_pcg::rand_core::Rng;

    use super::*;

    fn parabola(depth: f64, half: f64, x: f64) -> f64 {
        (depth * (1.0 - (x / half).powi(2))).max(0.0)
    }

    fn cells() -> Vec<f64> {
        (0..128).map(|k| 0.1 * (f64::from(k) - 63.5)).collect()
    }

    /// A line of 700 heights over a leaning surface, from another place and with ripples beside and in the scar.
    fn measured(depth: f64, half: f64) -> Measured {
        let x: Vec<f64> = (0..700).map(|k| 100.0 + 0.02 * f64::from(k)).collect();
        let z = x.iter().map(|x| 3.0 - 0.01 * x - parabola(depth, half, x - 107.0)).collect();
        Measured { name: "line".to_owned(), line: Line { x, z }, unit: None, notes: Vec::new() }
    }

    #[test]
    fn a_scar_of_two_thirds_of_the_depth_and_nine_tenths_of_the_width_is_told_so() {
        let x = cells();
        let z = x.iter().map(|x| parabola(0.2, 3.6, *x)).collect();
        let found = compare(&Line { x, z }, 0.1, measured(0.3, 4.0)).unwrap();
        let off: Vec<f64> = found.numbers.iter().filter_map(Pair::difference).collect();
        // cells of a fortieth of the width: their means are off by the curvature, 4e-4 of the depth at most
        for (off, right) in off.iter().zip([2.0 / 3.0 - 1.0, -0.1, 0.6 - 1.0]) {
            assert!((off - right).abs() < 2e-3, "{off} for {right}");
        }
        assert!((found.moved + 107.0).abs() < 1e-3, "{}", found.moved);
        assert!((found.taken_off[0] + 0.01).abs() < 1e-6, "{:?}", found.taken_off);
        // the difference of two parabolas over the wider one: its root mean square by the integral over |x| < 4
        let square = |x: f64| (parabola(0.2, 3.6, x) - parabola(0.3, 4.0, x)).powi(2);
        let right: f64 = (0..8000).map(|k| square((f64::from(k) + 0.5) * 5e-4)).sum::<f64>() / 8000.0;
        assert!(
            (found.difference / right.sqrt() - 1.0).abs() < 0.01,
            "{} for {}",
            found.difference,
            right.sqrt()
        );
    }

    /// A parabola of known depth and width in a rough surface: the deepest point is deeper by two or three times the roughness, means over n points
    /// are off by it over the root of n. 12 % too deep was told of 5 % of roughness.
    #[test]
    fn depth_and_width_of_a_rough_scar_are_those_of_the_scar() {
        let x = cells();
        let computed = Line { z: x.iter().map(|x| parabola(0.3, 4.0, *x)).collect(), x };
        for (roughness, seed) in [(0.01, 1), (0.02, 2), (0.05, 3), (0.05, 4), (0.1, 5), (0.1, 6)] {
            let mut rough = measured(0.3, 4.0);
            let mut random = Pcg64Mcg::new(seed);
            for z in &mut rough.line.z {
                // twelve uniform numbers less six have a variance of one
                let sum: f64 = (0..12).map(|_| f64::from(random.next_u32()) / f64::from(u32::MAX)).sum();
                *z += 0.3 * roughness * (sum - 6.0);
            }
            let found = compare(&computed, 0.1, rough).unwrap();
            let points = found.means_over.unwrap() / 0.02;
            assert!(found.notes.iter().any(|note| note.contains("means over")), "{:?}", found.notes);
            // four standard deviations of a mean over so many points: the deepest of some of them is what counts
            let tolerance = 4.0 * roughness / points.sqrt();
            for pair in &found.numbers {
                let off = pair.difference().unwrap();
                assert!(off.abs() < tolerance, "{} of {roughness}: {off} of {tolerance}", pair.name);
            }
        }
        assert_eq!(compare(&computed, 0.1, measured(0.3, 4.0)).unwrap().means_over, None);
    }

    /// Micrometres read as nanometres, millimetres or metres, and the other way about; no unit is proposed that the heights have already.
    #[test]
    fn a_scar_that_is_a_thousand_times_too_deep_is_perhaps_in_another_unit() {
        let x = cells();
        let computed = Line { z: x.iter().map(|x| parabola(0.3, 4.0, *x)).collect(), x };
        for (unit, depth, proposed) in
            [("um", 300.0, "nm"), ("um", 3e-4, "mm"), ("mm", 250.0, "um"), ("µm", 12.0, "nm")]
        {
            let deep = Measured { unit: Some(unit.to_owned()), ..measured(depth, 4.0) };
            let found = compare(&computed, 0.1, deep).unwrap();
            let proposed = format!("right? --units \"height={proposed}\"");
            assert!(found.notes.iter().any(|note| note.ends_with(&proposed)), "{unit}: {:?}", found.notes);
        }
        let unknown = compare(&computed, 0.1, measured(300.0, 4.0)).unwrap();
        assert!(unknown.notes.iter().any(|note| note.ends_with("right?")), "{:?}", unknown.notes);
    }

    #[test]
    fn what_cannot_be_compared_is_refused() {
        let flat = Line { x: cells(), z: vec![0.0; 128] };
        assert!(compare(&flat, 0.1, measured(0.3, 4.0)).unwrap_err().what.contains("not worn"));
        let x = cells();
        let wide = Line { z: x.iter().map(|x| parabola(0.2, 6.3, *x)).collect(), x };
        let Measured { line, .. } = measured(0.3, 2.0);
        let short = Line { x: line.x[150..550].to_vec(), z: line.z[150..550].to_vec() };
        let short = Measured { name: "line".to_owned(), line: short, unit: None, notes: Vec::new() };
        assert!(compare(&wide, 0.1, short).unwrap_err().what.contains("does not reach"));
    }
}
