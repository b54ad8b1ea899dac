//! Influence coefficients in free space: the displacement of one cell by unit traction on another.

use ndarray::{Array2, Axis};

use super::cells::surface_coefficients;
use super::homogeneous;
use super::lattice_samples::{ResponseChange, WaveResponse};
use super::pair_response::PairResponse;
use crate::model::ContactPair;

/// Which components of a response are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Components {
    /// `zz`: normal displacement from pressure.
    pub normal: bool,
    /// `xx`, `yy`, `xy`: tangential displacement from shear.
    pub tangential: bool,
    /// `zx`, `zy`: normal displacement from shear, and with the opposite sign tangential displacement from pressure.
    pub coupling: bool,
}

impl Components {
    /// Pressure alone.
    pub const NORMAL: Self = Self { normal: true, tangential: false, coupling: false };
    /// Shear alone.
    pub const TANGENTIAL: Self = Self { normal: false, tangential: true, coupling: false };
    /// All six arrays.
    pub const ALL: Self = Self { normal: true, tangential: true, coupling: true };
}

/// Free-space influence coefficients of a pair: displacement of the centre of the cell at offset `(i, j)`, `i, j >= 0`, by
/// unit traction on the cell at the origin [length/pressure], lower body minus upper. Shape `(nx, ny)`; arrays that were not
/// wanted are absent.
///
/// Offsets of the other signs follow by symmetry: `zz`, `xx`, `yy` are even in both; `xy` is odd in both; `zx` is odd in x,
/// `zy` in y. The displacement `u_x` by pressure is minus `zx`.
#[derive(Clone, Debug)]
pub struct InfluenceCoefficients {
    /// `u_z` from pressure.
    pub zz: Option<Array2<f64>>,
    /// `u_x` from `q_x`.
    pub xx: Option<Array2<f64>>,
    /// `u_y` from `q_y`.
    pub yy: Option<Array2<f64>>,
    /// `u_x` from `q_y`, and `u_y` from `q_x`.
    pub xy: Option<Array2<f64>>,
    /// `u_z` from `q_x`.
    pub zx: Option<Array2<f64>>,
    /// `u_z` from `q_y`.
    pub zy: Option<Array2<f64>>,
}

/// Influence coefficients of a pair for offsets up to `cells - 1` on a grid of the given `spacing` \[length\].
///
/// The radial kernels of the whole stack (of homogeneous bodies in closed form) are tabulated once and integrated over cells by Gauss rules whose number of points
/// depends on distance over side alone, far square cells by five points; no step depends on the thickness or the stiffness of the coatings. Error about 1e-14
/// of `zz` at the same offset for contrasts 1e-1 to 1e6, 1e-12 for coatings 1e4 times softer, 1e-10 at 1e6 times. On a rigid
/// base the coefficients fall exponentially and keep 1e-15 of the own cell's value.
///
/// Fails in meaning, not in digits, where point collocation itself fails (a plan refuses such grids): see
/// [`cells_too_coarse_for_incompressible_film`](super::collocation::cells_too_coarse_for_incompressible_film).
/// The same bits for any number of threads. Cost about 0.07 microseconds per square cell, 0.13 per other cell; for pressure alone on
/// homogeneous bodies a tenth of that.
pub fn influence_coefficients(
    pair: &ContactPair,
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
) -> InfluenceCoefficients {
    let response = PairResponse::new(pair);
    if wanted == Components::NORMAL
        && homogeneous::serves(spacing)
        && let Some(times_k) = response.constant()
    {
        let zz = Some(homogeneous::normal_coefficients(times_k.zz, cells, spacing));
        return InfluenceCoefficients { zz, xx: None, yy: None, xy: None, zx: None, zy: None };
    }
    coefficients_of(&response, cells, spacing, wanted)
}

/// How they change with a parameter: the derivative of the response through the same quadrature, which is linear.
pub fn coefficients_by(
    change: &ResponseChange,
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
) -> InfluenceCoefficients {
    if wanted == Components::NORMAL
        && homogeneous::serves(spacing)
        && let Some(times_k) = change.constant()
    {
        let zz = Some(homogeneous::normal_coefficients(times_k.depthwise[1], cells, spacing));
        return InfluenceCoefficients { zz, xx: None, yy: None, xy: None, zx: None, zy: None };
    }
    coefficients_of_waves(change, cells, spacing, wanted)
}

/// The same coefficients by the general way for any pair response, whatever simpler form it has.
pub fn coefficients_of(
    response: &PairResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
) -> InfluenceCoefficients {
    coefficients_of_waves(response, cells, spacing, wanted)
}

fn coefficients_of_waves(
    response: &impl WaveResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
) -> InfluenceCoefficients {
    let found = surface_coefficients(response, cells, spacing);
    // the parts that are odd across an axis vanish on it
    let array = |wanted: bool, component: usize, odd: [bool; 2]| {
        wanted.then(|| {
            let mut array = found.kernel(0, component).to_owned();
            for axis in (0..2).filter(|&axis| odd[axis] && cells[axis] > 0) {
                array.index_axis_mut(Axis(axis), 0).fill(0.0);
            }
            array
        })
    };
    InfluenceCoefficients {
        zz: array(wanted.normal, 0, [false; 2]),
        xx: array(wanted.tangential, 1, [false; 2]),
        yy: array(wanted.tangential, 2, [false; 2]),
        xy: array(wanted.tangential, 3, [true; 2]),
        zx: array(wanted.coupling, 4, [true, false]),
        zy: array(wanted.coupling, 5, [false, true]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{golden, pair};
    use super::*;
    use serde::Deserialize;

    #[derive(Deserialize)]
    struct Row {
        layers: Vec<(f64, f64, f64)>,
        substrate: (f64, f64),
        i: usize,
        j: usize,
        zz: f64,
        xx: f64,
        yy: f64,
        xy: f64,
        zx: f64,
        zy: f64,
    }

    fn all(coefficients: &InfluenceCoefficients) -> [&Array2<f64>; 6] {
        let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = coefficients;
        [zz, xx, yy, xy, zx, zy].map(|array| array.as_ref().unwrap())
    }

    fn coefficients(
        layers: &[(f64, f64, f64)],
        substrate: Option<(f64, f64)>,
        spacing: [f64; 2],
    ) -> InfluenceCoefficients {
        influence_coefficients(&pair(layers, substrate), [24, 17], spacing, Components::ALL)
    }

    /// Largest difference of any component at any offset, over zz at the offset.
    fn difference(found: &InfluenceCoefficients, exact: &InfluenceCoefficients) -> f64 {
        let zz = exact.zz.as_ref().unwrap();
        let mut worst = 0.0_f64;
        for (found, exact) in all(found).iter().zip(all(exact)) {
            for ((found, exact), zz) in found.iter().zip(exact).zip(zz) {
                worst = worst.max((found - exact).abs() / zz.abs());
            }
        }
        worst
    }

    #[test]
    fn golden_rows_are_met() {
        let rows = golden::<Row>("influence_coefficients.json");
        for body in rows.chunk_by(|one, next| one.layers == next.layers) {
            let pair = pair(&body[0].layers, Some(body[0].substrate));
            let coefficients = influence_coefficients(&pair, [121, 91], [1.0, 1.0], Components::ALL);
            for row in body {
                let found = all(&coefficients).map(|array| array[[row.i, row.j]]);
                let exact = [row.zz, row.xx, row.yy, row.xy, row.zx, row.zy];
                for (found, exact) in found.iter().zip(exact) {
                    // the table promises 1e-11 of zz; both agree to 5e-15
                    let error = (found - exact).abs() / row.zz;
                    assert!(error < 3e-14, "{:?} ({}, {}): {error:.1e}", row.layers, row.i, row.j);
                }
            }
        }
    }

    #[test]
    fn a_coating_of_the_substrates_material_is_not_there() {
        // nearly: moduli 1e-13 apart, so that layers are not joined and the whole transform is taken
        let found = coefficients(&[(1.0 + 1e-13, 0.3, 2.0)], Some((1.0, 0.3)), [1.0, 1.0]);
        let exact = coefficients(&[], Some((1.0, 0.3)), [1.0, 1.0]);
        assert!(difference(&found, &exact) < 3e-13); // the difference of the moduli, and 1e-14
    }

    #[test]
    fn thin_coatings_vanish_and_thick_ones_are_all_there_is() {
        let substrate = coefficients(&[], Some((1.0, 0.3)), [1.0, 2.0]);
        let coating = coefficients(&[], Some((4.0, 0.2)), [1.0, 2.0]);
        let with = |thickness| coefficients(&[(4.0, 0.2, thickness)], Some((1.0, 0.3)), [1.0, 2.0]);
        // the first-order effect is a spring, h/G per cell area, and a plate: proportional to h
        let (thin, thinner) = (difference(&with(1e-6), &substrate), difference(&with(1e-7), &substrate));
        assert!(thin < 1e-5 && (thin / thinner - 10.0).abs() < 0.01, "{thin:.1e} {thinner:.1e}");
        // the substrate shifts the coating's cells by a constant of order 1/(G h): at 30 cells, 100 cells/h of zz
        let (thick, thicker) = (difference(&with(1e6), &coating), difference(&with(1e7), &coating));
        assert!(thick < 1e-3 && (thick / thicker - 10.0).abs() < 0.01, "{thick:.1e} {thicker:.1e}");
    }

    #[test]
    fn scaling_lengths_and_moduli_by_powers_of_two_changes_no_bit() {
        let (length, modulus) = (2.0_f64.powi(-17), 2.0_f64.powi(38));
        let layers = [(3.0, 0.25, 0.7), (0.2, 0.5, 1.3)];
        let scaled = layers.map(|(e, nu, h)| (e * modulus, nu, h * length));
        // square cells, too, of which the far ones go another way
        for sides in [[0.5, 0.75], [0.5, 0.5]] {
            let before = coefficients(&layers, Some((1.0, 0.3)), sides);
            let after = coefficients(&scaled, Some((modulus, 0.3)), sides.map(|side| side * length));
            for (before, after) in all(&before).iter().zip(all(&after)) {
                assert!(before.iter().zip(after).all(|(before, after)| *before == after * modulus / length));
            }
        }
    }

    #[test]
    fn the_same_bits_for_any_number_of_threads() {
        let by = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| coefficients(&[(3.0, 0.25, 0.7)], None, [1.0, 1.0]))
        };
        assert!(all(&by(1)).iter().zip(all(&by(3))).all(|(one, three)| *one == three));
    }

    #[test]
    fn exchanging_the_axes_exchanges_the_components() {
        let pair = pair(&[(3.0, 0.25, 0.7)], Some((1.0, 0.3)));
        let one = influence_coefficients(&pair, [9, 14], [1.0, 3.0], Components::ALL);
        let other = influence_coefficients(&pair, [14, 9], [3.0, 1.0], Components::ALL);
        let [zz, xx, yy, xy, zx, zy] = all(&one);
        let [other_zz, other_xx, other_yy, other_xy, other_zx, other_zy] = all(&other);
        for (one, other) in
            [(zz, other_zz), (xx, other_yy), (yy, other_xx), (xy, other_xy), (zx, other_zy), (zy, other_zx)]
        {
            for ((i, j), value) in one.indexed_iter() {
                let error = (value - other[[j, i]]).abs();
                assert!(error < 1e-14 * zz[[i, j]], "({i}, {j})"); // sums in another order
            }
        }
        assert!((0..9).all(|i| xy[[i, 0]] == 0.0 && zy[[i, 0]] == 0.0));
        assert!((0..14).all(|j| xy[[0, j]] == 0.0 && zx[[0, j]] == 0.0));
    }

    #[test]
    fn only_what_is_wanted_is_there() {
        let pair = pair(&[], Some((1.0, 0.3)));
        let normal = influence_coefficients(&pair, [3, 2], [1.0, 1.0], Components::NORMAL);
        assert!(normal.zz.is_some() && normal.xx.is_none() && normal.xy.is_none() && normal.zx.is_none());
        let shear = influence_coefficients(&pair, [3, 2], [1.0, 1.0], Components::TANGENTIAL);
        assert!(shear.zz.is_none() && shear.xx.is_some() && shear.yy.is_some() && shear.zy.is_none());
        assert_eq!(shear.xy.unwrap().dim(), (3, 2));
    }

    #[test]
    fn coatings_from_a_thousandth_to_ten_thousand_cells_and_any_contrast_are_finite() {
        for thickness in [1e-3, 1.0, 1e4] {
            for young in [1e-6, 1e6] {
                for spacing in [[1.0, 1.0], [1.0, 10.0]] {
                    let pair = pair(&[(young, 0.3, thickness)], Some((1.0, 0.4)));
                    let found = influence_coefficients(&pair, [64, 64], spacing, Components::ALL);
                    for array in all(&found) {
                        // no cell answers more than the loaded one
                        let [own, own_zz] = [array[[0, 0]], all(&found)[0][[0, 0]]];
                        assert!(
                            array.iter().all(|value| value.is_finite() && value.abs() <= own.max(own_zz))
                        );
                    }
                }
            }
        }
    }
}
