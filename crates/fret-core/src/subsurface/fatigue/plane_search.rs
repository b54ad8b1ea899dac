//! The search for the plane on which a parameter is largest.

use std::sync::LazyLock;

use pulp::{Simd, WithSimd};

use crate::subsurface::tensor::StressTensor;

/// The search over planes for the largest value of a parameter. The parameter may return minus infinity for planes none of which exceeds
/// its second argument.
pub(super) struct OverPlanes<'a, F>(
    /// Normals that are looked at besides those of the grid, where hills narrower than it may hide.
    pub &'a [[f64; 3]],
    /// The parameter on some planes.
    pub F,
);

impl<F: FnMut(&Planes, f64) -> [f64; LANES]> WithSimd for OverPlanes<'_, F> {
    type Output = Seen;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Seen {
        largest_over_planes(self.1, self.0)
    }
}

/// Planes that are looked at together.
pub(super) const LANES: usize = 8;

#[inline(always)]
pub(super) fn larger(one: f64, other: f64) -> f64 {
    if other > one { other } else { one }
}

#[inline(always)]
pub(super) fn smaller(one: f64, other: f64) -> f64 {
    if other < one { other } else { one }
}

/// Unit normals of some planes: their parts along x, y, z.
#[derive(Clone, Copy)]
pub(super) struct Planes([[f64; LANES]; 3]);

impl Planes {
    fn of(normals: &[[f64; 3]]) -> Self {
        let last = normals.len().saturating_sub(1);
        Self(std::array::from_fn(|axis| std::array::from_fn(|lane| normals[lane.min(last)][axis])))
    }

    #[inline(always)]
    fn normal(&self, lane: usize) -> [f64; 3] {
        self.0.map(|part| part[lane])
    }

    /// Normal stress on each plane [pressure].
    #[inline(always)]
    pub(super) fn normal_stress(&self, stress: &StressTensor) -> [f64; LANES] {
        let ([xx, yy, zz, xy, xz, yz], [nx, ny, nz]) = (stress.0, &self.0);
        let mut across = [0.0; LANES];
        for l in 0..LANES {
            across[l] = nx[l] * (xx * nx[l] + 2.0 * (xy * ny[l] + xz * nz[l]))
                + ny[l] * (yy * ny[l] + 2.0 * yz * nz[l])
                + zz * nz[l] * nz[l];
        }
        across
    }

    /// Normal stress on each plane, and shear traction along x, y, z [pressure].
    #[inline(always)]
    pub(super) fn traction(&self, stress: &StressTensor) -> ([f64; LANES], [[f64; LANES]; 3]) {
        let (mut across, mut shear) = ([0.0; LANES], [[0.0; LANES]; 3]);
        let ([xx, yy, zz, xy, xz, yz], [nx, ny, nz]) = (stress.0, &self.0);
        for l in 0..LANES {
            let x = xx * nx[l] + xy * ny[l] + xz * nz[l];
            let y = xy * nx[l] + yy * ny[l] + yz * nz[l];
            let z = xz * nx[l] + yz * ny[l] + zz * nz[l];
            across[l] = x * nx[l] + y * ny[l] + z * nz[l];
            shear[0][l] = x - across[l] * nx[l];
            shear[1][l] = y - across[l] * ny[l];
            shear[2][l] = z - across[l] * nz[l];
        }
        (across, shear)
    }
}

/// Normals over half the sphere, every ten degrees.
static COARSE: LazyLock<Vec<Planes>> = LazyLock::new(|| {
    let mut normals = Vec::new();
    for ring in 0..=9 {
        let polar = (f64::from(ring) * STEP).to_radians();
        let turns = (360.0 / STEP * polar.sin()).ceil().max(1.0) as i32;
        let (turns, span) = if ring == 9 { (turns / 2, 180.0_f64) } else { (turns, 360.0) };
        for turn in 0..turns {
            let turn = (span * f64::from(turn) / f64::from(turns)).to_radians();
            normals.push([polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos()]);
        }
    }
    normals.chunks(LANES).map(Planes::of).collect()
});

/// Planes that are looked at first lie so far apart [degrees].
const STEP: f64 = 10.0;
/// A plane whose value is less than this fraction below the largest one known may have a larger one beside it, nearer than the planes that
/// are looked at first; a quarter of it where they lie half as far apart. Along a great circle from a largest value at `n` shear goes as
/// `cos 2t`, normal stress as `cos^2 t`: their product falls by some `5 t^2`, at most `t = 7` degrees from the nearest plane.
const BELOW: f64 = 0.08;
/// How often the planes are taken half as far apart where a larger value may hide.
const HALVINGS: usize = 3;
/// Most planes around which closer ones are looked at.
const MOST: usize = 20;
/// Most places that are climbed from.
const CLIMBS: usize = 3;
/// Cosine of the angle between a place that is climbed from and the tops that are known: two degrees.
const APART: f64 = 0.999_39;
/// Where a climb is fine enough to tell whether its top is larger than another [degrees]: it is off by 1e-6 at most.
const NEAR: f64 = 0.02;
/// Where a climb ends [degrees].
const FINE: f64 = 1e-3;
/// Fraction of the largest value that the value on the axis of a narrow cone of tension has to reach for the cone to be searched.
const WORTH: f64 = 0.3;
/// By so much of itself another top has to be larger to take the place of the first: more than rounding.
const MORE: f64 = 1e-9;

/// Largest value over the half sphere of normals: every ten degrees, then closer and closer around the best to a thousandth of
/// a degree. Where another place may hold a larger value it is looked at every 1.25 degrees, and the best of those planes, and of
/// `starts`, are climbed from alike.
#[inline(always)]
fn largest_over_planes(mut parameter: impl FnMut(&Planes, f64) -> [f64; LANES], starts: &[[f64; 3]]) -> Seen {
    let mut best = (f64::NEG_INFINITY, [0.0, 0.0, 1.0]);
    let mut seen: Vec<Seen> = Vec::with_capacity(COARSE.len() * LANES);
    for planes in COARSE.iter() {
        look(&mut parameter, planes, best.0 * (1.0 - BELOW), (&mut best, &mut seen));
    }
    climb(&mut parameter, [0.5 * STEP, FINE], &mut best);
    let (mut step, mut below) = (STEP, BELOW);
    for _ in 0..HALVINGS {
        promising(&mut seen, best.0 * (1.0 - below), MOST);
        let around = std::mem::take(&mut seen);
        (step, below) = (0.5 * step, 0.25 * below);
        for parents in around.chunks(LANES / 4) {
            let planes = beside(parents, 0.5 * step);
            look(&mut parameter, &planes, best.0 * (1.0 - below), (&mut (f64::INFINITY, best.1), &mut seen));
        }
    }
    for some in starts.chunks(LANES) {
        look(&mut parameter, &Planes::of(some), f64::NEG_INFINITY, (&mut (f64::INFINITY, best.1), &mut seen));
    }
    let floor = if starts.is_empty() { 1.0 - below } else { WORTH };
    promising(&mut seen, floor * best.0, usize::MAX);
    let mut tops = vec![best.1];
    for (_, normal) in seen {
        let is_known = |top: &[f64; 3]| dot(top, &normal).abs() > APART;
        if tops.iter().any(is_known) {
            continue;
        }
        if tops.len() > 2 * CLIMBS {
            break;
        }
        let mut other = (f64::NEG_INFINITY, normal);
        climb(&mut parameter, [0.5 * step, NEAR], &mut other);
        tops.extend([normal, other.1]);
        if other.0 > best.0 * (1.0 + MORE) {
            climb(&mut parameter, [NEAR, FINE], &mut other);
            best = other;
        }
    }
    best
}

/// A value and the normal of its plane.
pub(super) type Seen = (f64, [f64; 3]);

/// Keeps the planes above a value, the largest first, at most so many.
fn promising(seen: &mut Vec<Seen>, floor: f64, most: usize) {
    seen.retain(|(value, _)| *value > floor);
    seen.sort_by(|one, other| other.0.total_cmp(&one.0));
    seen.truncate(most);
}

/// Normals four beside each of some, at so many degrees along and across its meridian.
fn beside(parents: &[Seen], step: f64) -> Planes {
    let step = step.to_radians();
    let mut normals = [[0.0; 3]; LANES];
    for (place, normal) in normals.iter_mut().enumerate() {
        let centre = parents[(place / 4).min(parents.len() - 1)].1;
        let [one, other] = tangents(centre);
        let [a, b] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]][place % 4];
        let moved: [f64; 3] =
            std::array::from_fn(|axis| centre[axis] + step * (a * one[axis] + b * other[axis]));
        let length = dot(&moved, &moved).sqrt();
        *normal = moved.map(|part| part / length);
    }
    Planes::of(&normals)
}

fn dot(one: &[f64; 3], other: &[f64; 3]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// Goes uphill from a normal, in steps of so many degrees at first and at last.
#[inline(always)]
fn climb(parameter: &mut impl FnMut(&Planes, f64) -> [f64; LANES], [first, last]: [f64; 2], best: &mut Seen) {
    let mut step = first.to_radians();
    while step > last.to_radians() {
        let (centre, before) = (best.1, best.0);
        let [one, other] = tangents(centre);
        let [a, b] = DIRECTIONS;
        let mut moved = Planes([[0.0; LANES]; 3]);
        for axis in 0..3 {
            for lane in 0..LANES {
                moved.0[axis][lane] = centre[axis] + step * (a[lane] * one[axis] + b[lane] * other[axis]);
            }
        }
        for lane in 0..LANES {
            let [x, y, z] = moved.normal(lane);
            let length = (x * x + y * y + z * z).sqrt();
            moved.0.iter_mut().for_each(|part| part[lane] /= length);
        }
        for (lane, value) in parameter(&moved, best.0).into_iter().enumerate() {
            if value > best.0 {
                *best = (value, moved.normal(lane));
            }
        }
        if best.0 == before {
            step *= 0.5;
        }
    }
}

/// Notes the planes that exceed a floor, and the best of them where it is better than the best so far.
#[inline(always)]
fn look(
    parameter: &mut impl FnMut(&Planes, f64) -> [f64; LANES],
    planes: &Planes,
    floor: f64,
    (best, seen): (&mut Seen, &mut Vec<Seen>),
) {
    for (lane, value) in parameter(planes, floor).into_iter().enumerate() {
        if value > floor || value > best.0 {
            seen.push((value, planes.normal(lane)));
        }
        if value > best.0 {
            *best = (value, planes.normal(lane));
        }
    }
}

/// Where a better normal is looked for around the best.
const DIRECTIONS: [[f64; LANES]; 2] =
    [[1.0, -1.0, 0.0, 0.0, 0.7, 0.7, -0.7, -0.7], [0.0, 0.0, 1.0, -1.0, 0.7, -0.7, 0.7, -0.7]];

/// Two unit vectors at right angles to a normal and to each other; those along and across its meridian.
fn tangents([x, y, z]: [f64; 3]) -> [[f64; 3]; 2] {
    let flat = x.hypot(y);
    let [c, s] = if flat > 1e-9 { [x / flat, y / flat] } else { [1.0, 0.0] };
    [[z * c, z * s, -flat], [-s, c, 0.0]]
}
