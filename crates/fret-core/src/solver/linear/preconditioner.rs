//! An approximate inverse of the elastic response by unpadded transforms on the region, wavenumber by wavenumber (a circulant
//! preconditioner: Strang 1986, T. Chan 1988): of the frequency response of the pair where it is known, for shear where long waves meet a
//! softer body than short ones; else of the kernel made periodic with the nearest image of each offset only. In slipping cells the slip
//! compliance takes its part. Under a film shear removes what pressure displaces along the surface as well (a block Gauss-Seidel step).

use ndarray::{Array2, s};

use super::super::contact_set::ContactSet;
use super::super::region_fields::RegionFields;
use super::edge_correction::EdgeCorrection;
use super::inverse::{FieldsOfRegion, Inverse, Precision};
use crate::compliance::{
    NORMAL_BLOCKS, OperatorSet, SharedWorkspace, SurfaceResponse, TANGENTIAL_BLOCKS, mirrors,
};
use crate::fields::{CellRule, Number, Reals, convert, each_cell, reset};
use crate::kernel::{Components, PeriodicSymbols, ResponseTable};
use fret_fft::{Block, ConvolutionError, Kernel, Parity, PeriodicProduct, Symbol};

/// A pair is stiff at the surface when the longest waves of a region meet this many times the compliance times wavenumber that
/// the shortest ones meet: a thin coating more than about five times stiffer than what lies below.
const STIFF_ABOVE: f64 = 4.0;
/// A period of so many times as many cells along one axis as along the other is a strip.
const STRIP: usize = 8;
/// In a periodic problem, shear takes the displacement of the pressure into account where `zx^2 / (zz xx)` of a wave is more than this. On a
/// half-space it is 0.08 for a Poisson ratio of 0.3, and 0.25 for none; under films a hundred times stiffer up to 0.6: they bend.
const COUPLED_ABOVE: f64 = 0.3;

/// Shear along x and y from displacements along them, and from the pressure.
const SHEAR_BLOCKS: [Block; 6] = {
    let [xx, yy, xy, yx] = TANGENTIAL_BLOCKS;
    [xx, yy, xy, yx, from_pressure(0, 2, 3), from_pressure(1, 2, 4)]
};
/// The same along one axis.
const SHEAR_BLOCKS_ALONG: [Block; 2] = [NORMAL_BLOCKS[0], from_pressure(0, 1, 1)];

const fn from_pressure(output: usize, input: usize, kernel: usize) -> Block {
    Block { output, input, kernel, sign: 1.0 }
}

/// Approximate inverses for a region.
pub struct Preconditioner {
    normal: Inverse,
    /// Where the pair is stiff at the surface, and pressure and shear are solved together.
    edge: Option<EdgeCorrection>,
    shear: Option<Inverse>,
    /// Whether shear is found from the pressure, too.
    follows_pressure: bool,
    /// Smallest symbol of the tangential response [length/pressure].
    softest: f64,
    /// The one axis along which shear acts.
    shear_axis: Option<usize>,
    fields: FieldsOfRegion,
    workspace: SharedWorkspace,
    cells: usize,
    stiff: bool,
    in_period: bool,
    /// Passes so far.
    pub passes: usize,
}

/// Slip compliance as the preconditioner sees it: where little resists turning the inverse of the elastic response counts, where much
/// does a cell's own slip compliance.
#[derive(Debug, Default)]
pub struct SlipWeights<N> {
    /// Weights of the elastic inverse in the cells in contact, on both of its sides.
    elastic: Vec<N>,
    /// Inverses of slip compliance, each by its weight [pressure/length].
    slip: Vec<N>,
    /// Unit of displacements over that of tractions [length/pressure].
    compliance: f64,
    /// What the elastic inverse makes of a displacement.
    part: [Vec<N>; 2],
    /// Pressure as the elastic inverse takes it.
    pressure: Vec<N>,
}

/// The frequency response of a pair on the cells of a region: what the coefficients, cut off at its sides, no longer tell.
#[derive(Debug, Clone, Copy)]
pub struct CellWaves<'a> {
    /// The response.
    pub table: &'a ResponseTable,
    /// Sides of a cell [length].
    pub spacing: [f64; 2],
}

impl CellWaves<'_> {
    /// Whether long waves meet a body much softer than short ones do.
    fn are_stiff(&self, shape: [usize; 2]) -> bool {
        let longest = (0..2).map(|axis| shape[axis] as f64 * self.spacing[axis]).fold(0.0, f64::max);
        let shortest = 2.0 * self.spacing[0].min(self.spacing[1]);
        let at = |length: f64| self.table.times_k(std::f64::consts::TAU / length).zz;
        at(longest) > STIFF_ABOVE * at(shortest)
    }

    /// Response of cells to waves of pressure, for uniform pressure on the region the sum of the nearest images.
    fn of_pressure(&self, zz: &Array2<f64>, shape: [usize; 2]) -> Array2<f64> {
        let mut symbol = self.table.cell_response(shape, self.spacing);
        symbol[[0, 0]] = sum_of_nearest_images(zz, shape);
        symbol
    }

    /// The same to waves of shear, with one alias, and of pressure along the surface.
    fn of_shear(&self, [xx, yy]: [&Array2<f64>; 2], shape: [usize; 2]) -> PeriodicSymbols {
        let mut symbols = self.table.symbols(shape, self.spacing, Components::ALL, 1);
        for (symbol, values) in [(&mut symbols.xx, xx), (&mut symbols.yy, yy)] {
            if let Some(symbol) = symbol {
                symbol[[0, 0]] = sum_of_nearest_images(values, shape);
            }
        }
        symbols
    }
}

/// The same of a periodic response `zz` on a `shape` of cells, along the axis that has more of them. In strips edges of contact are straight and
/// far apart, and what serves a stiff pair costs more than it saves.
fn is_stiff(zz: &Array2<f64>, shape: [usize; 2]) -> bool {
    let axis = usize::from(shape[1] > shape[0]);
    if shape[axis] >= STRIP * shape[1 - axis] {
        return false;
    }
    let times_k = |wave: usize| wave as f64 * zz[if axis == 0 { [wave, 0] } else { [0, wave] }];
    shape[axis] > 1 && times_k(1) > STIFF_ABOVE * times_k(shape[axis] / 2)
}

impl Preconditioner {
    /// Inverses for a region of `shape` cells, of pressure and of what shear its `operators` know. `waves` serves in free space;
    /// with mirrors the region stands for a larger one.
    ///
    /// # Errors
    /// When a coefficient is missing or does not cover the region.
    pub fn new(
        response: &SurfaceResponse,
        waves: Option<CellWaves<'_>>,
        shape: [usize; 2],
        operators: OperatorSet,
    ) -> Result<Self, ConvolutionError> {
        let OperatorSet { tangential, full, shear_axis, symmetry, single, .. } = operators;
        let (part, shape) = (shape, symmetry.whole_of(shape));
        let [zz, xx, yy, xy, ..] = response.parts();
        let missing = ConvolutionError::EmptyShape(0, 0);
        let symbol = |values: &Option<Array2<f64>>, parity: Parity| {
            let values = values.as_ref().ok_or(missing)?;
            Ok(if response.is_periodic() { values.clone() } else { nearest_images(values, shape, parity) })
        };
        let product = |symbols: &[Symbol<'_>], fields: &[usize], blocks: &[Block]| {
            let product = PeriodicProduct::mirrored(part, symbols, blocks, mirrors(symmetry, fields))?;
            Ok::<_, ConvolutionError>(Inverse::new(product, single))
        };
        let mut normal = match (response, waves, zz) {
            (SurfaceResponse::FreeSpace(_), Some(waves), Some(zz)) => waves.of_pressure(zz, shape),
            _ => symbol(zz, Parity::EvenEven)?,
        };
        let least = smallest_positive(&normal);
        normal.mapv_inplace(|value| if value == 0.0 { 0.0 } else { value.max(least) });
        let stiff = if response.is_periodic() {
            full && is_stiff(&normal, shape)
        } else {
            waves.is_some_and(|waves| waves.are_stiff(shape))
        };
        let edge = if stiff && full {
            let forward = Symbol { values: normal.view(), parity: Parity::EvenEven };
            let kernel = kernel_of(forward, shape)?;
            let forward = product(&[forward], &[0], &NORMAL_BLOCKS)?;
            Some(EdgeCorrection::new(
                forward,
                kernel,
                [shape, part],
                (symmetry.axes(), response.is_periodic()),
            ))
        } else {
            None
        };
        normal.mapv_inplace(|value| if value == 0.0 { 0.0 } else { 1.0 / value });
        let normal = Symbol { values: normal.view(), parity: Parity::EvenEven };
        let (mut softest, mut follows_pressure) = (0.0, false);
        let shear = if tangential || full {
            let mut coupling = match response {
                SurfaceResponse::Periodic(symbols) if couples(symbols) => {
                    symbols.zx.clone().zip(symbols.zy.clone())
                }
                _ => None,
            };
            let [xx, yy, xy] = match (response, waves.filter(|_| stiff), xx, yy) {
                (SurfaceResponse::FreeSpace(_), Some(waves), Some(xx), Some(yy)) => {
                    let PeriodicSymbols { xx, yy, xy, zx, zy, .. } = waves.of_shear([xx, yy], shape);
                    coupling = zx.zip(zy);
                    [xx.ok_or(missing)?, yy.ok_or(missing)?, xy.ok_or(missing)?]
                }
                _ => [
                    symbol(xx, Parity::EvenEven)?,
                    symbol(yy, Parity::EvenEven)?,
                    symbol(xy, Parity::OddOdd)?,
                ],
            };
            softest = smallest_positive(&xx).min(smallest_positive(&yy));
            let [xx, yy, xy] = inverse(&xx, &yy, &xy, softest);
            let of_pressure =
                coupling.filter(|_| full).map(|(zx, zy)| [&xx * &zx - &xy * &zy, &yy * &zy - &xy * &zx]);
            follows_pressure = of_pressure.is_some();
            let parities =
                [Parity::EvenEven, Parity::EvenEven, Parity::OddOdd, Parity::OddEven, Parity::EvenOdd];
            let symbols: Vec<Symbol<'_>> = [&xx, &yy, &xy]
                .into_iter()
                .chain(of_pressure.iter().flatten())
                .zip(parities)
                .map(|(values, parity)| Symbol { values: values.view(), parity })
                .collect();
            let more = usize::from(follows_pressure);
            Some(match shear_axis {
                Some(axis) => {
                    let along: Vec<_> = symbols.into_iter().skip(axis).step_by(3).collect();
                    product(&along, &[1 + axis, 0][..=more], &SHEAR_BLOCKS_ALONG[..=more])?
                }
                None => product(&symbols, &[1, 2, 0][..2 + more], &SHEAR_BLOCKS[..4 + 2 * more])?,
            })
        } else {
            None
        };
        Ok(Self {
            normal: product(&[normal], &[0], &NORMAL_BLOCKS)?,
            edge,
            shear,
            follows_pressure,
            softest,
            shear_axis,
            stiff,
            in_period: response.is_periodic(),
            fields: FieldsOfRegion::default(),
            workspace: SharedWorkspace::default(),
            cells: part[0] * part[1],
            passes: 0,
        })
    }

    /// The same, at work in a given memory.
    #[must_use]
    pub fn working_in(self, workspace: &SharedWorkspace) -> Self {
        Self { workspace: workspace.clone(), ..self }
    }

    /// Whether the region is a period.
    pub fn is_in_period(&self) -> bool {
        self.in_period
    }

    /// Whether short waves on the region meet a response much stiffer than long ones do.
    pub fn is_stiff(&self) -> bool {
        self.stiff
    }

    /// Pressures that would remove normal displacements `right`, before any restriction to a set.
    pub fn normal(&mut self, right: &[f64], pressure: &mut [f64]) {
        self.passes += 1;
        self.normal.apply_to_region(right, pressure, (&mut self.fields, &self.workspace));
    }

    /// Prepares [`Preconditioner::shear`] and [`Preconditioner::pressure`] for a contact with its `slip_compliance`, in units of
    /// `compliance`, that of displacements over that of tractions [length/pressure].
    pub fn prepare<N: Number>(
        &mut self,
        contact: &ContactSet,
        slip_compliance: &[N],
        compliance: f64,
        weights: &mut SlipWeights<N>,
    ) {
        let SlipWeights { elastic, slip, part: [part_x, part_y], .. } = weights;
        for field in [&mut *elastic, &mut *slip, part_x, part_y] {
            reset(field, slip_compliance.len()); // where shear acts along one axis nobody writes the other part: it stays zero
        }
        each_cell(&Weights { softest: self.softest / compliance }, [slip_compliance], [elastic, slip]);
        weights.compliance = compliance;
        self.fields.begin(contact, self.cells);
        if let Some(edge) = &mut self.edge {
            edge.prepare(contact);
        }
    }

    /// Fields of the region for an operator, ready for the contact prepared last.
    pub fn fields<N: Precision>(&mut self) -> &mut RegionFields<N> {
        N::fields(&mut self.fields)
    }

    /// Pressures that would remove normal displacements `right`, packed over the contact prepared last.
    pub fn pressure<N: Number>(&mut self, right: &[N], pressure: &mut [N], weights: &SlipWeights<N>) {
        let Self { normal, edge, fields, workspace, .. } = self;
        self.passes += 1;
        normal.apply(&[right], &mut [&mut *pressure], weights.compliance, (fields, workspace));
        if let Some(edge) = edge {
            self.passes += 1;
            edge.add(right, pressure, weights.compliance, (fields, workspace));
        }
    }

    /// Shears that would remove tangential displacements `right`, under films with those of a `pressure`, where one is given; before any restriction
    /// to what the active sets leave free; packed over the contact prepared last.
    pub fn shear<N: Number>(
        &mut self,
        (right, pressure): ([&[N]; 2], Option<&[N]>),
        shear: [&mut [N]; 2],
        weights: &mut SlipWeights<N>,
    ) {
        let Self { shear: Some(inverse), follows_pressure, shear_axis, fields, workspace, .. } = self else {
            return;
        };
        let SlipWeights { elastic, slip, compliance, part, pressure: pressed } = weights;
        let [x, y] = shear;
        each_cell(&Weighted, [right[0], right[1], elastic], [&mut *x, &mut *y]);
        self.passes += 1;
        // Where shear acts along one axis the other component stays zero.
        let axes = shear_axis.map_or(0..2, |axis| axis..axis + 1);
        let mut from = [&*x, &*y][axes.clone()].to_vec();
        if *follows_pressure {
            reset(pressed, right[0].len());
            if let Some(pressure) = pressure {
                convert(pressure, 1.0 / *compliance, pressed);
            }
            from.push(pressed);
        }
        let mut to = part.each_mut().map(Vec::as_mut_slice);
        inverse.apply(&from, &mut to[axes], *compliance, (fields, workspace));
        let [part_x, part_y] = part;
        each_cell(&Sum, [part_x, part_y, right[0], right[1], elastic, slip], [x, y]);
    }
}

/// Weights of the elastic response and of the slip compliance D of a cell in the inverse of both: the latter's is
/// `s = (r - 1) / (r + 2)` with `r = sqrt(1 + D / softest)`, found by trial.
struct Weights {
    softest: f64,
}

impl CellRule<1, 2, 0> for Weights {
    #[inline(always)]
    fn at<R: Reals>(&self, [slip_compliance]: [R; 1], [elastic, slip]: &mut [R; 2]) -> [R; 0] {
        let one = slip_compliance.all(1.0);
        let both = slip_compliance / self.softest + 1.0;
        let root = both.sqrt();
        let weight = (root - one) / (root + 2.0);
        *elastic = ((one - weight) / both).sqrt();
        *slip = weight / (slip_compliance + self.softest);
        []
    }
}

struct Weighted;

impl CellRule<3, 2, 0> for Weighted {
    #[inline(always)]
    fn at<R: Reals>(&self, [from_x, from_y, weight]: [R; 3], [x, y]: &mut [R; 2]) -> [R; 0] {
        *x = from_x * weight;
        *y = from_y * weight;
        []
    }
}

/// The elastic part times its weight and the slip part.
struct Sum;

impl CellRule<6, 2, 0> for Sum {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [part_x, part_y, right_x, right_y, elastic, slip]: [R; 6],
        [x, y]: &mut [R; 2],
    ) -> [R; 0] {
        *x = part_x * elastic + right_x * slip;
        *y = part_y * elastic + right_y * slip;
        []
    }
}

/// The circulant response of a symbol, at every offset by the cells of a whole region [length/pressure].
fn kernel_of(symbol: Symbol<'_>, shape: [usize; 2]) -> Result<Vec<f64>, ConvolutionError> {
    let product = PeriodicProduct::new(shape, &[symbol], &NORMAL_BLOCKS)?;
    let mut unit = vec![0.0; shape[0] * shape[1]];
    unit[0] = 1.0;
    let mut kernel = vec![0.0; unit.len()];
    product.apply(&mut product.workspace(), &[&unit], &mut [&mut kernel]);
    Ok(kernel)
}

/// Whether waves of pressure move the surface of a periodic problem along itself so much that shear has to take them into account.
fn couples(symbols: &PeriodicSymbols) -> bool {
    let PeriodicSymbols { zz: Some(zz), xx: Some(xx), zx: Some(zx), .. } = symbols else { return false };
    // along x alone nothing turns
    let waves = zx.column(0).into_iter().zip(zz.column(0)).zip(xx.column(0)).skip(1);
    waves.map(|((zx, zz), xx)| zx * zx / (zz * xx)).any(|share| share > COUPLED_ABOVE)
}

/// What a uniform traction on a region displaces, by the nearest image of each offset only.
fn sum_of_nearest_images(values: &Array2<f64>, shape: [usize; 2]) -> f64 {
    let times = |index: usize, count: usize| if index == 0 || 2 * index == count { 1.0 } else { 2.0 };
    let [half_x, half_y] = [0, 1].map(|axis| (shape[axis] / 2 + 1).min(values.shape()[axis]));
    let near = values.slice(s![..half_x, ..half_y]);
    near.indexed_iter().map(|((i, j), value)| times(i, shape[0]) * times(j, shape[1]) * value).sum()
}

/// Symbol of a kernel made periodic with the nearest image of each offset only.
fn nearest_images(values: &Array2<f64>, shape: [usize; 2], parity: Parity) -> Array2<f64> {
    let half = [shape[0] / 2 + 1, shape[1] / 2 + 1];
    let mut near = values.slice(s![..half[0].min(values.nrows()), ..half[1].min(values.ncols())]).to_owned();
    // An odd kernel has no nearest image half a period away.
    for (axis, odd) in parity.odd().into_iter().enumerate() {
        if odd && shape[axis].is_multiple_of(2) && near.shape()[axis] == half[axis] {
            near.index_axis_mut(ndarray::Axis(axis), half[axis] - 1).fill(0.0);
        }
    }
    PeriodicProduct::symbol_of(shape, &Kernel { values: near.view(), parity })
}

/// Smallest positive value of a symbol: what any that is not positive is raised to.
fn smallest_positive(symbol: &Array2<f64>) -> f64 {
    symbol.iter().copied().filter(|value| *value > 0.0).fold(f64::INFINITY, f64::min)
}

/// Wave by wave inverse of `[[xx, t], [t, yy]]`, with the transfer function `t = -xy` of an odd-odd kernel.
fn inverse(xx: &Array2<f64>, yy: &Array2<f64>, xy: &Array2<f64>, softest: f64) -> [Array2<f64>; 3] {
    let mut result = [xx.clone(), yy.clone(), xy.clone()];
    for (index, &cross) in xy.indexed_iter() {
        if xx[index] == 0.0 && yy[index] == 0.0 {
            // A uniform traction on a periodic half-space: its displacement is a rigid motion, found elsewhere.
            for part in &mut result {
                part[index] = 0.0;
            }
            continue;
        }
        let (a, d) = (xx[index].max(softest), yy[index].max(softest));
        let det = a * d - cross * cross;
        // Not positive: as if uncoupled.
        let (det, cross) = if det > 1e-3 * a * d { (det, cross) } else { (a * d, 0.0) };
        result[0][index] = d / det;
        result[1][index] = a / det;
        result[2][index] = -cross / det;
    }
    result
}

#[cfg(test)]
mod tests;
