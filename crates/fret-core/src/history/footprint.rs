//! How the contact lies on the grid: how many cells show it, and how many are left around it.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use crate::model::{Periodicity, Symmetry, Zone};

/// The contact as the cells see it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Footprint {
    /// Radius of the contact in cells: that of a circle of as many cells, where the contact ends along both axes, or less where it is narrow:
    /// 1.1 times the radius of the disc whose chords are as long as its own are on the average along x, or along y. So it is the radius of a disc, 1.4
    /// half-widths of a strip or a line contact, and about the mean radius of the patches where there are many. `None` without contact, and for a
    /// contact without any edge.
    pub radius: Option<f64>,
    /// Open cells between the contact and the nearest edge of the grid, which a contact that repeats along one axis has across that axis alone.
    pub free: usize,
    /// Mean length along x and along y in cells, of all patches together; `None` without contact, and where it has no end.
    #[serde(default)]
    pub lengths: [Option<f64>; 2],
}

impl Footprint {
    /// Reads it off the zones in front of mirrors.
    pub fn of(zone: &Array2<Zone>, symmetry: Symmetry, periodic: Periodicity) -> Self {
        let (nx, ny) = zone.dim();
        let mirrored = symmetry.axes();
        let is_loaded = |zone: &Zone| *zone != Zone::Open;
        let mut cells = 0;
        let (mut least, mut most) = ([nx, ny], [0, 0]);
        for (i, row) in zone.rows().into_iter().enumerate() {
            let Some(first) = row.iter().position(is_loaded) else { continue };
            let last = row.iter().rposition(is_loaded).unwrap_or(first);
            cells += row.iter().filter(|zone| is_loaded(zone)).count();
            least = [least[0].min(i), least[1].min(first)];
            most = [i, most[1].max(last)];
        }
        let endless = if ny == 1 { Some(1) } else { periodic.one_axis() };
        let axes = (0..2).filter(|axis| Some(*axis) != endless);
        if cells == 0 {
            let cells = symmetry.whole_of([nx, ny]);
            let free = axes.map(|axis| cells[axis]).min().unwrap_or(0);
            return Self { radius: None, free, lengths: [None; 2] };
        }
        // The first cells of a mirrored axis lie at its mirror.
        let before = |axis: usize| if mirrored[axis] { usize::MAX } else { least[axis] };
        let free = axes.map(|axis| before(axis).min([nx, ny][axis] - 1 - most[axis])).min().unwrap_or(0);
        let faces = faces_between(zone, symmetry, is_loaded);
        let cells = cells * symmetry.copies();
        // Every chord has two ends; a disc's are pi/2 radii long in the mean.
        let by_chords = faces.map(|faces| 4.0 * cells as f64 / (std::f64::consts::PI * faces as f64));
        let narrow = by_chords[0].min(by_chords[1]);
        // A strip that has no ends is no disc of as many cells, however few of them the grid shows along it.
        let is_endless = by_chords.iter().any(|chord| chord.is_infinite());
        let circle = if is_endless { f64::INFINITY } else { (cells as f64 / std::f64::consts::PI).sqrt() };
        let lengths = faces.map(|faces| (faces > 0).then(|| 2.0 * cells as f64 / faces as f64));
        Self { radius: narrow.is_finite().then_some(circle.min(1.1 * narrow)), free, lengths }
    }
}

/// Faces along x and along y between a cell that lies within and one that does not, of the whole contact. At a mirror there is none: a cell
/// is as its image.
pub fn faces_between(
    zone: &Array2<Zone>,
    symmetry: Symmetry,
    is_within: impl Fn(&Zone) -> bool,
) -> [usize; 2] {
    let (nx, ny) = zone.dim();
    let within: Vec<u8> = zone.iter().map(|zone| u8::from(is_within(zone))).collect();
    let row = |i: usize| &within[i * ny..][..ny];
    let along_x: usize = (1..nx).map(|i| differing(row(i - 1), row(i))).sum();
    let along_y: usize = (0..nx).map(|i| differing(row(i), row(i).get(1..).unwrap_or_default())).sum();
    [along_x, along_y].map(|faces| faces * symmetry.copies())
}

/// How many of some marks, 0 or 1, differ from others; by runs that one byte can count.
fn differing(ones: &[u8], others: &[u8]) -> usize {
    const RUN: usize = 255;
    let runs = ones.chunks(RUN).zip(others.chunks(RUN));
    let in_run = |(ones, others): (&[u8], &[u8])| {
        ones.iter().zip(others).fold(0_u8, |count, (one, other)| count.wrapping_add(one ^ other))
    };
    runs.map(|run| usize::from(in_run(run))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zones(cells: [usize; 2], inside: impl Fn(f64, f64) -> bool) -> Array2<Zone> {
        let at = |index: usize, axis: usize| index as f64 - 0.5 * (cells[axis] as f64 - 1.0);
        Array2::from_shape_fn(
            cells,
            |(i, j)| {
                if inside(at(i, 0), at(j, 1)) { Zone::Slip } else { Zone::Open }
            },
        )
    }

    /// The footprint of a contact whose halves and quarters, where they are its mirror images, have the same one.
    fn footprint(zone: &Array2<Zone>) -> Footprint {
        let whole = Footprint::of(zone, Symmetry::NONE, Periodicity::NONE);
        for odd_shear in [[None, Some(1)], [Some(0), None], [Some(0), Some(1)]] {
            let symmetry = Symmetry { odd_shear };
            assert_eq!(
                Footprint::of(&symmetry.part(zone), symmetry, Periodicity::NONE),
                whole,
                "{symmetry:?}"
            );
        }
        whole
    }

    /// Discs, strips and patches whose sizes are known: pixels leave a third of a cell.
    #[test]
    fn the_radius_of_discs_strips_and_patches_is_found_in_cells() {
        for radius in [3.0, 6.0, 6.6, 20.0] {
            let found = footprint(&zones([64, 64], |x, y| x.hypot(y) < radius));
            assert!((found.radius.unwrap() - radius).abs() < 0.35, "{radius}: {found:?}");
            assert_eq!(found.free, 32 - (radius + 0.5).floor() as usize);
        }
        let strip = footprint(&zones([64, 64], |x, y| x.abs() < 5.0 && y.abs() < 28.0));
        assert!((strip.radius.unwrap() / 5.0 - 1.4).abs() < 0.01, "{strip:?}");
        let across = footprint(&zones([64, 64], |x, y| y.abs() < 5.0 && x.abs() < 28.0));
        assert_eq!(strip.radius, across.radius);
        // The same strip where it repeats along its length, shown by four cells of it.
        for (cells, axis) in [([128, 4], 0), ([4, 128], 1)] {
            let endless = footprint(&zones(cells, |x, y| [x, y][axis].abs() < 5.0));
            assert!((endless.radius.unwrap() / 5.0 - 1.4).abs() < 0.01, "{endless:?}");
        }
        // Sixteen discs of four cells' radius.
        let patches = |x: f64, y: f64| {
            let off = |u: f64| (u + 32.0).rem_euclid(16.0) - 8.0;
            off(x).hypot(off(y)) < 4.0
        };
        let found = footprint(&zones([64, 64], patches));
        assert!((found.radius.unwrap() / 4.0 - 1.0).abs() < 0.15, "{found:?}");
        assert_eq!(footprint(&zones([8, 8], |_, _| true)).radius, None);
        assert_eq!(footprint(&zones([8, 8], |_, _| false)).radius, None);
    }
}
