//! The response of cells at the wavenumbers of a grid: the operator of a scene that repeats, and the preconditioner of one
//! that does not.

use std::f64::consts::{PI, TAU};

use ndarray::Array2;
use rayon::prelude::*;

use super::axis_waves::{AxisWaves, axis_waves};
use super::influence::Components;
use super::lattice_samples::ResponseChange;
use super::pair_response::PairResponse;
use super::response_table::ResponseTable;
use super::stack_layer::LayerChanges;
use crate::fields::{Dual, Scalar};
use crate::model::{Base, Body, ContactPair};

/// Response of a grid's cells to unit traction waves [length/pressure], at wavenumbers `2 pi a/(nx dx)`, `2 pi b/(ny dy)`,
/// `a = 0..=nx/2`, `b = 0..=ny/2`; shape `(nx/2 + 1, ny/2 + 1)`. Arrays that were not wanted are absent.
///
/// The transfer function (for waves `exp(+i k x)`) is the value times `-i` for every axis along which the kernel is odd:
/// `zz`, `xx`, `yy` as they stand; `zx` and `zy` times `-i`; `xy` times `(-i)^2`. With the direction `(c, s)` of the wave:
///
/// ```text
/// zz: C_zz      xx: c^2 C_rr + s^2 C_tt      yy: s^2 C_rr + c^2 C_tt      xy: -c s (C_rr - C_tt)      zx: c C_rz      zy: s C_rz
/// ```
///
/// The value at `k = 0` is that of a uniform traction, see [`uniform_response`]; 0 where a half-space has none. At the last wavenumber of an even count a
/// wave and its mirror image are the same on the grid, so kernels that are odd along that axis vanish there.
#[derive(Clone, Debug)]
pub struct PeriodicSymbols {
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

/// Symbols of a pair on one grid, see [`ResponseTable::symbols`]. Where many grids are asked for, keep a [`ResponseTable`].
pub fn periodic_symbols(
    pair: &ContactPair,
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
    aliases: usize,
) -> PeriodicSymbols {
    let [least, greatest] = wavenumbers(cells, spacing, aliases);
    ResponseTable::new(pair, least, greatest).symbols(cells, spacing, wanted, aliases).with_uniform(pair)
}

/// Displacement by a uniform unit traction [length/pressure], normal and tangential: `sum h/E_oed` with
/// `E_oed = E (1 - nu) / ((1 + nu) (1 - 2 nu))`, and `sum h/G`, over the layers of both bodies, each with the jump at the springs below
/// it. `None` where a body is a half-space: a uniform traction moves it without bound; tangentially infinite where a layer slides freely.
pub fn uniform_response(pair: &ContactPair) -> Option<[f64; 2]> {
    uniform(pair, [&[]; 2]).map(|sum| sum.map(|dual| dual.value))
}

/// The same with the derivatives of the constants of the layers of the lower and of the upper body by a parameter.
fn uniform(pair: &ContactPair, changes: [&[LayerChanges]; 2]) -> Option<[Dual; 2]> {
    let mut sum = [Dual::of(0.0); 2];
    let none = LayerChanges::default();
    for (body, changes) in [(pair.upper(), changes[1]), (pair.lower(), changes[0])] {
        let Body::Elastic(stack) = body else { continue };
        if *stack.base() != Base::Rigid {
            return None;
        }
        for (index, layer) in stack.coatings().iter().enumerate() {
            let by = changes.get(index).unwrap_or(&none);
            let one = Dual::of(1.0);
            let thickness = Dual::new(layer.thickness(), by.thickness);
            let [young, nu] =
                [(layer.material().young(), by.young), (layer.material().poisson(), by.poisson)]
                    .map(|(value, change)| Dual::new(value, change));
            let interface = layer.interface();
            sum[0] = sum[0] + thickness * (nu + 1.0) * (one - nu * 2.0) / (young * (one - nu));
            sum[1] = sum[1] + thickness / (young / ((nu + 1.0) * 2.0));
            sum[0] = sum[0] + Dual::new(interface.normal_compliance(), by.normal);
            sum[1] = sum[1] + Dual::new(interface.shear_compliance(), by.shear);
        }
    }
    Some(sum)
}

impl PeriodicSymbols {
    /// The same symbols with what a uniform traction does at `k = 0`.
    #[must_use]
    pub fn with_uniform(mut self, pair: &ContactPair) -> Self {
        if let Some([normal, tangential]) = uniform_response(pair) {
            for (symbol, value) in
                [(&mut self.zz, normal), (&mut self.xx, tangential), (&mut self.yy, tangential)]
            {
                if let Some(symbol) = symbol.as_mut().filter(|_| value.is_finite()) {
                    symbol[[0, 0]] = value;
                }
            }
        }
        self
    }
}

/// How [`periodic_symbols`] change with a parameter, by which the constants of the layers of the lower and of the upper body have these derivatives.
pub fn symbols_by(
    pair: &ContactPair,
    changes: [&[LayerChanges]; 2],
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
) -> PeriodicSymbols {
    let [least, greatest] = wavenumbers(cells, spacing, 0);
    let table = ResponseTable::of_change(ResponseChange::new(pair, changes), least, greatest);
    let mut symbols = table.symbols(cells, spacing, wanted, 0);
    if let Some([normal, tangential]) = uniform(pair, changes) {
        let uniform =
            [(&mut symbols.zz, normal), (&mut symbols.xx, tangential), (&mut symbols.yy, tangential)];
        for (symbol, Dual { value, change }) in uniform {
            if let Some(symbol) = symbol.as_mut().filter(|_| value.is_finite()) {
                symbol[[0, 0]] = change;
            }
        }
    }
    symbols
}

/// The same symbols of any pair response, without what a uniform traction does.
pub fn symbols_of(
    response: PairResponse,
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
) -> PeriodicSymbols {
    let [least, greatest] = wavenumbers(cells, spacing, 0);
    ResponseTable::of(response, least, greatest).symbols(cells, spacing, wanted, 0)
}

/// Least wavenumber but zero, and a bound on the greatest one.
fn wavenumbers(cells: [usize; 2], spacing: [f64; 2], aliases: usize) -> [f64; 2] {
    let longest = (cells[0] as f64 * spacing[0]).max(cells[1] as f64 * spacing[1]);
    let per_side = spacing.map(|side| PI * (2 * aliases + 1) as f64 / side);
    [TAU / longest, (per_side[0] * per_side[0] + per_side[1] * per_side[1]).sqrt()]
}

impl ResponseTable {
    /// Response of the cells of a grid at the grid's own wavenumbers.
    ///
    /// With `aliases = 0` the response times the cell's factors `sin(k d/2)/(k d/2)`: the operator of a periodic scene whose
    /// displacement is taken in the same waves. With `aliases = m` the sum over the wavenumbers `k + 2 pi (a, b)/d`,
    /// `|a|, |b| <= m`, that the grid cannot tell from `k`: the response at the cells' centres, all periodic images included.
    /// Cost about 20 ns per wavenumber and alias.
    pub fn symbols(
        &self,
        cells: [usize; 2],
        spacing: [f64; 2],
        wanted: Components,
        aliases: usize,
    ) -> PeriodicSymbols {
        let along_x = axis_waves(cells[0], spacing[0], aliases);
        let along_y = axis_waves(cells[1], spacing[1], aliases);
        let shape = [along_x.len(), along_y.len()];
        let mut symbols = vec![Symbol::default(); shape[0] * shape[1]];
        symbols.par_chunks_mut(shape[1]).zip(&along_x).for_each(|(row, x)| {
            for (symbol, y) in row.iter_mut().zip(&along_y) {
                *symbol = self.symbol(x, y);
            }
        });
        let array = |wanted: bool, component: fn(&Symbol) -> f64| {
            wanted.then(|| Array2::from_shape_fn(shape, |(a, b)| component(&symbols[a * shape[1] + b])))
        };
        PeriodicSymbols {
            zz: array(wanted.normal, |symbol| symbol.zz),
            xx: array(wanted.tangential, |symbol| symbol.xx),
            yy: array(wanted.tangential, |symbol| symbol.yy),
            xy: array(wanted.tangential, |symbol| symbol.xy),
            zx: array(wanted.coupling, |symbol| symbol.zx),
            zy: array(wanted.coupling, |symbol| symbol.zy),
        }
    }

    fn symbol(&self, x: &AxisWaves, y: &AxisWaves) -> Symbol {
        let mut sum = Symbol::default();
        for &(kx, factor_x) in &x.waves {
            for &(ky, factor_y) in &y.waves {
                let square = kx * kx + ky * ky;
                if square == 0.0 {
                    continue;
                }
                let [zz, rr, rz, tt] = self.at_square(square);
                let per_k = 1.0 / square.sqrt();
                let (c, s) = (kx * per_k, ky * per_k);
                let weight = factor_x * factor_y * per_k;
                sum.zz += weight * zz;
                sum.xx += weight * (c * c * rr + s * s * tt);
                sum.yy += weight * (s * s * rr + c * c * tt);
                sum.xy -= weight * (c * s * (rr - tt));
                sum.zx += weight * (c * rz);
                sum.zy += weight * (s * rz);
            }
        }
        if x.is_own_mirror {
            (sum.xy, sum.zx) = (0.0, 0.0);
        }
        if y.is_own_mirror {
            (sum.xy, sum.zy) = (0.0, 0.0);
        }
        sum
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Symbol {
    zz: f64,
    xx: f64,
    yy: f64,
    xy: f64,
    zx: f64,
    zy: f64,
}

#[cfg(test)]
mod tests {
    use super::super::influence::{InfluenceCoefficients, influence_coefficients};
    use super::super::samples::{material, pair, stack};
    use super::*;
    use crate::model::{Body, HalfSpace};

    /// Layers that cannot widen, one on another: oedometric moduli 2.6 x 0.7/(1.3 x 0.4) = 3.5 and 8 at nu = 0, shear moduli 1 and 4,
    /// springs of compliance 1/5 and 1/10.
    #[test]
    fn a_uniform_traction_moves_layers_on_a_rigid_base_as_they_are_thick() {
        use super::super::samples::on_springs;
        let lower = stack(&[(2.6, 0.3, 0.7), (8.0, 0.0, 0.4)], None);
        let lower = on_springs(&lower, &[None, Some((Some(5.0), Some(10.0)))]);
        let upper = stack(&[(2.6, 0.3, 1.4)], None);
        let pair = |upper: &Body, lower: &Body| ContactPair::new(upper.clone(), lower.clone()).unwrap();
        let [upper, lower] = [upper, lower].map(Body::Elastic);
        let [normal, tangential] = uniform_response(&pair(&upper, &lower)).unwrap();
        assert!((normal - (0.7 / 3.5 + 0.4 / 8.0 + 0.2 + 1.4 / 3.5)).abs() < 1e-15, "{normal}");
        assert!((tangential - (0.7 + 0.1 + 0.1 + 1.4)).abs() < 1e-15, "{tangential}");
        let deep = Body::Elastic(stack(&[(2.6, 0.3, 0.7)], Some((1.0, 0.3))));
        assert_eq!(uniform_response(&pair(&upper, &deep)), None);
        assert_eq!(uniform_response(&pair(&deep, &upper)), None);
    }

    /// A period of 12 by 10 of cells 2 by 5: waves from one that fills the longer side to the shortest of each axis at once.
    #[test]
    fn wavenumbers_reach_from_the_longest_wave_to_the_corner() {
        for (cells, spacing) in [([6, 2], [2.0, 5.0]), ([2, 6], [5.0, 2.0])] {
            for aliases in [0, 3] {
                let [least, greatest] = wavenumbers(cells, spacing, aliases);
                let times = (2 * aliases + 1) as f64;
                assert!((least - TAU / 12.0).abs() < 1e-15);
                assert!((greatest / (times * PI * (0.25_f64 + 0.04).sqrt()) - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn waves_along_an_axis_meet_one_response_each() {
        let pair = pair(&[(2.0, 0.3, 1.0)], Some((1.0, 0.4)));
        let symbols = periodic_symbols(&pair, [8, 6], [0.5, 0.25], Components::ALL, 0);
        let k = TAU * 3.0 / 4.0;
        let factor = libm::sin(0.25 * k) / (0.25 * k);
        let exact = PairResponse::new(&pair).at(k);
        let at = |array: &Option<Array2<f64>>| array.as_ref().unwrap()[[3, 0]] / factor;
        let expected = [
            (at(&symbols.zz), exact.zz),
            (at(&symbols.xx), exact.rr),
            (at(&symbols.yy), exact.tt),
            (at(&symbols.zx), exact.rz),
        ];
        for (found, exact) in expected {
            assert!((found - exact).abs() < 1e-13 * exact); // interpolation
        }
        assert_eq!([at(&symbols.xy), at(&symbols.zy)], [0.0, 0.0]);
    }

    /// Transform of the free-space coefficients over all images of a periodic grid: `sum K(i, j) trig(k_x i) trig(k_y j)`, sines
    /// along odd axes, which is the stated convention.
    fn lattice_sum(array: &Array2<f64>, turns: [f64; 2], odd: [bool; 2]) -> f64 {
        let wave = |odd: bool, phase: f64| if odd { libm::sin(phase) } else { libm::cos(phase) };
        let twice = |index: usize| if index == 0 { 1.0 } else { 2.0 };
        array
            .indexed_iter()
            .map(|((i, j), value)| {
                let [along_x, along_y] =
                    [wave(odd[0], TAU * turns[0] * i as f64), wave(odd[1], TAU * turns[1] * j as f64)];
                twice(i) * twice(j) * value * along_x * along_y
            })
            .sum()
    }

    #[test]
    fn many_aliases_give_the_transform_of_the_influence_coefficients() {
        // on a rigid base the coefficients die off, so that the sum over all images is at hand
        for spacing in [[1.0, 1.0], [1.0, 1.5]] {
            let pair = pair(&[(2.0, 0.2, 0.6), (1.0, 0.4, 0.5)], None);
            let coefficients = influence_coefficients(&pair, [40, 40], spacing, Components::ALL);
            let cells = [8, 7];
            let by = |aliases| periodic_symbols(&pair, cells, spacing, Components::ALL, aliases);
            let (even, odd) = (by(60), by(61));
            let arrays = |symbols: &PeriodicSymbols| {
                let PeriodicSymbols { zz, xx, yy, xy, zx, zy } = symbols.clone();
                [zz, xx, yy, xy, zx, zy].map(Option::unwrap)
            };
            let (even, odd) = (arrays(&even), arrays(&odd));
            let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = coefficients;
            let kernels = [zz, xx, yy, xy, zx, zy].map(Option::unwrap);
            let is_odd = [[false; 2], [false; 2], [false; 2], [true; 2], [true, false], [false, true]];
            for a in 0..=4 {
                for b in 0..=3 {
                    if (a, b) == (0, 0) {
                        continue;
                    }
                    let turns = [a as f64 / 8.0, b as f64 / 7.0];
                    let scale = lattice_sum(&kernels[0], turns, [false; 2]);
                    for component in 0..6 {
                        let exact = lattice_sum(&kernels[component], turns, is_odd[component]);
                        // the alias sum alternates: the mean of two successive ones is nearer
                        let found = 0.5 * (even[component][[a, b]] + odd[component][[a, b]]);
                        let error = (found - exact).abs() / scale;
                        assert!(
                            error < 1e-4,
                            "component {component} at ({a}, {b}): {error:.1e} {found} {exact}"
                        ); // (1/aliases)^2 and a bit
                    }
                }
            }
        }
    }

    #[test]
    fn uniform_traction_and_mirrored_waves_are_left_out() {
        let steel = HalfSpace::homogeneous(material((1.0, 0.3)));
        let coated = stack(&[(3.0, 0.2, 1.0)], Some((1.0, 0.3)));
        let pair = ContactPair::new(Body::Elastic(steel), Body::Elastic(coated)).unwrap();
        for aliases in [0, 3] {
            let symbols = periodic_symbols(&pair, [6, 5], [1.0, 2.0], Components::ALL, aliases);
            let PeriodicSymbols { zz, xx, yy, xy, zx, zy } = symbols;
            let [zz, xx, yy, xy, zx, zy] = [zz, xx, yy, xy, zx, zy].map(Option::unwrap);
            assert_eq!(zz.dim(), (4, 3));
            assert!([&zz, &xx, &yy, &xy, &zx, &zy].iter().all(|array| array[[0, 0]] == 0.0));
            // the count along x is even, along y odd
            assert!((0..3).all(|b| zx[[3, b]] == 0.0 && xy[[3, b]] == 0.0));
            assert!(zy[[3, 1]] != 0.0 && zy[[1, 2]] != 0.0 && xy[[2, 2]] != 0.0);
            let positive = |array: &Array2<f64>| array.iter().skip(1).all(|value| *value > 0.0);
            assert!(positive(&zz) && positive(&xx) && positive(&yy));
        }
    }

    #[test]
    fn one_row_of_cells_is_a_plane_problem() {
        let pair = pair(&[], Some((1.0, 0.3)));
        let symbols = periodic_symbols(&pair, [64, 1], [1.0, 1.0], Components::NORMAL, 0);
        let zz = symbols.zz.unwrap();
        assert_eq!(zz.dim(), (33, 1));
        let k = TAU / 64.0;
        let factor = libm::sin(0.5 * k) / (0.5 * k);
        let exact = 2.0 * (1.0 - 0.09) / k * factor; // 2/(E* k)
        assert!((zz[[1, 0]] - exact).abs() < 1e-14 * exact);
        assert!(symbols.xx.is_none());
    }
}
