//! The elastic response of the pair: tractions in, relative surface displacements out.
//! The one place where kernels meet components and signs: z into the lower body, displacements lower minus upper.

mod cell_response;
#[cfg(test)]
mod conformance;
mod direct;
pub(crate) mod product;

use ndarray::Array2;

use crate::kernel::{InfluenceCoefficients, PeriodicSymbols};
use crate::model::{Symmetry, TangentialField};
use fret_fft::{
    Block, Convolution, ConvolutionError, Kernel, Mirrors, Parity, PeriodicProduct, SingleProduct, Symbol,
};
use product::Product;

pub use cell_response::CellResponse;
pub use direct::DirectCompliance;

/// Elastic response of a region. Tractions [pressure], displacements [length]; rows of cells, index `i * ny + j`.
pub trait SurfaceCompliance {
    /// Cells `[nx, ny]` of the region.
    fn shape(&self) -> [usize; 2];
    /// Influence of a cell's pressure on its own normal displacement, and of its shear on its own tangential one [length/pressure].
    fn self_influence(&self) -> SelfInfluence;
    /// `u_z` from pressure alone.
    fn normal(&mut self, pressure: &[f64], normal: &mut [f64]);
    /// `(u_x, u_y)` from shear alone.
    fn tangential(&mut self, shear: [&[f64]; 2], tangential: [&mut [f64]; 2]);
    /// All displacements `[normal, along x, along y]` from all tractions `[pressure, along x, along y]`.
    fn full(&mut self, tractions: [&[f64]; 3], displacements: [&mut [f64]; 3]);

    /// [`tangential`](Self::tangential) in single precision, for shear of a size near one; `None` where double precision is operators.
    fn tangential_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        None
    }

    /// [`full`](Self::full) in single precision, for tractions of a size near one; `None` where double precision is operators.
    fn full_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        None
    }
}

/// An elastic response in single precision.
pub struct SinglePrecisionOperator<'a> {
    product: &'a mut SingleProduct,
    shear_axis: Option<usize>,
    applications: &'a mut usize,
}

impl SinglePrecisionOperator<'_> {
    /// What the displacements are to be multiplied with [length/pressure], a power of two.
    pub fn unit(&self) -> f64 {
        self.product.unit()
    }

    /// The displacements, divided by [`unit`](Self::unit), of tractions.
    pub fn apply(&mut self, tractions: &[&[f32]], displacements: &mut [&mut [f32]]) {
        *self.applications += 1;
        along_one(self.shear_axis, tractions, displacements, |from, to| self.product.apply(from, to));
    }
}

/// Applies a product of which only one axis of shear takes part when that is so: across it there is no displacement. Components
/// along x and y come last.
fn along_one<T: Copy + Default>(
    along: Option<usize>,
    tractions: &[&[T]],
    displacements: &mut [&mut [T]],
    apply: impl FnOnce(&[&[T]], &mut [&mut [T]]),
) {
    let (Some(axis), Some((normal, [x, y]))) = (along, displacements.split_last_chunk_mut()) else {
        return apply(tractions, displacements);
    };
    let (along, across) = if axis == 0 { (x, y) } else { (y, x) };
    across.fill(T::default());
    match normal {
        [] => apply(&[tractions[axis]], &mut [along]),
        [normal, ..] => apply(&[tractions[0], tractions[1 + axis]], &mut [normal, along]),
    }
}

/// Influence of a cell on itself [length/pressure].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfInfluence {
    /// Normal.
    pub normal: f64,
    /// Tangential, the smaller of the two directions.
    pub tangential: f64,
}

/// Which operators a solver will ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OperatorSet {
    /// Normal from pressure.
    pub normal: bool,
    /// Tangential from shear.
    pub tangential: bool,
    /// All from all.
    pub full: bool,
    /// Normal from pressure and shear.
    pub normal_from_all: bool,
    /// The one axis (0: x, 1: y) along which shear acts, where it causes no displacement across it.
    pub shear_axis: Option<usize>,
    /// Mirrors of the problem: the region is what lies before them.
    pub symmetry: Symmetry,
    /// Single precision, where a solver can do with it.
    pub single: bool,
}

/// How the surface responds, as far as a grid needs to know it.
#[derive(Debug, Clone)]
pub enum SurfaceResponse {
    /// A non-periodic problem: coefficients over cell offsets.
    FreeSpace(InfluenceCoefficients),
    /// A periodic problem: the response at the grid's own wavenumbers.
    Periodic(PeriodicSymbols),
}

impl SurfaceResponse {
    /// Normal displacement of a cell by unit pressure on itself [length/pressure]; `cells` of the grid.
    pub fn own_normal(&self, cells: [usize; 2]) -> f64 {
        match self {
            Self::FreeSpace(coefficients) => own_of(coefficients).normal,
            Self::Periodic(symbols) => own_in_period(symbols, cells).normal,
        }
    }

    /// Whether the problem is periodic.
    pub fn is_periodic(&self) -> bool {
        matches!(self, Self::Periodic(_))
    }
}

/// The elastic response by fast products in Fourier space.
pub struct SpectralCompliance {
    shape: [usize; 2],
    self_influence: SelfInfluence,
    normal: Option<Product>,
    tangential: Option<Product>,
    full: Option<Product>,
    normal_from_all: Option<Product>,
    /// The same in single precision, made when first asked for.
    single: Singles,
    /// The one axis along which shear acts.
    shear_axis: Option<usize>,
    /// Applications so far.
    pub applications: usize,
}

/// Products in single precision: whether they are wanted, and those made so far.
#[derive(Default)]
struct Singles {
    wanted: bool,
    tangential: Option<SingleProduct>,
    full: Option<SingleProduct>,
}

/// The product in single precision, made when there is none yet.
fn made<'a>(
    single: &'a mut Option<SingleProduct>,
    product: Option<&Product>,
    wanted: bool,
) -> Option<&'a mut SingleProduct> {
    if single.is_none() && wanted {
        *single = product.and_then(Product::in_single_precision);
    }
    single.as_mut()
}

const NORMAL_BLOCKS: [Block; 1] = [block(0, 0, 0, 1.0)];
const TANGENTIAL_BLOCKS: [Block; 4] =
    [block(0, 0, 0, 1.0), block(1, 1, 1, 1.0), block(0, 1, 2, 1.0), block(1, 0, 2, 1.0)];
/// Inputs and outputs z, x, y; kernels zz, xx, yy, xy, zx, zy. `u_x` from pressure is minus `u_z` from `q_x` (reciprocity of odd kernels).
const FULL_BLOCKS: [Block; 9] = [
    block(0, 0, 0, 1.0),
    block(1, 1, 1, 1.0),
    block(2, 2, 2, 1.0),
    block(1, 2, 3, 1.0),
    block(2, 1, 3, 1.0),
    block(0, 1, 4, 1.0),
    block(1, 0, 4, -1.0),
    block(0, 2, 5, 1.0),
    block(2, 0, 5, -1.0),
];

const NORMAL_FROM_ALL_BLOCKS: [Block; 3] = [block(0, 0, 0, 1.0), block(0, 1, 1, 1.0), block(0, 2, 2, 1.0)];

/// Kernels and blocks for shear along one axis: inputs and outputs z and that axis.
const TANGENTIAL_MEMBERS_ALONG: [[usize; 1]; 2] = [[1], [2]];
const FULL_MEMBERS_ALONG: [[usize; 3]; 2] = [[0, 1, 4], [0, 2, 5]];
const FULL_BLOCKS_ALONG: [Block; 4] =
    [block(0, 0, 0, 1.0), block(1, 1, 1, 1.0), block(0, 1, 2, 1.0), block(1, 0, 2, -1.0)];
const NORMAL_FROM_ALL_MEMBERS_ALONG: [[usize; 2]; 2] = [[0, 4], [0, 5]];
const NORMAL_FROM_ALL_BLOCKS_ALONG: [Block; 2] = [block(0, 0, 0, 1.0), block(0, 1, 1, 1.0)];

const fn block(output: usize, input: usize, kernel: usize, sign: f64) -> Block {
    Block { output, input, kernel, sign }
}

/// The kernels that the blocks of [`FULL_BLOCKS`] name, each with its parity.
fn signed_kernels(c: &InfluenceCoefficients) -> [(&Option<Array2<f64>>, Parity); 6] {
    [
        (&c.zz, Parity::EvenEven),
        (&c.xx, Parity::EvenEven),
        (&c.yy, Parity::EvenEven),
        (&c.xy, Parity::OddOdd),
        (&c.zx, Parity::OddEven),
        (&c.zy, Parity::EvenOdd),
    ]
}

/// Influence of a cell on itself; zero where the coefficient is absent.
fn own_of(c: &InfluenceCoefficients) -> SelfInfluence {
    let own = |values: &Option<Array2<f64>>| values.as_ref().map_or(0.0, |values| values[[0, 0]]);
    SelfInfluence { normal: own(&c.zz), tangential: own(&c.xx).min(own(&c.yy)) }
}

/// The symbols that the blocks of [`FULL_BLOCKS`] name, each with its parity.
fn signed_symbols(symbols: &PeriodicSymbols) -> [(&Option<Array2<f64>>, Parity); 6] {
    [
        (&symbols.zz, Parity::EvenEven),
        (&symbols.xx, Parity::EvenEven),
        (&symbols.yy, Parity::EvenEven),
        (&symbols.xy, Parity::OddOdd),
        (&symbols.zx, Parity::OddEven),
        (&symbols.zy, Parity::EvenOdd),
    ]
}

/// Influence of a cell and of its periodic images on itself: the mean of the symbol over all wavenumbers.
fn own_in_period(symbols: &PeriodicSymbols, shape: [usize; 2]) -> SelfInfluence {
    let times = |index: usize, count: usize| if index == 0 || 2 * index == count { 1.0 } else { 2.0 };
    let own = |values: &Option<Array2<f64>>| {
        values.as_ref().map_or(0.0, |values| {
            let sum: f64 = values
                .indexed_iter()
                .map(|((a, b), value)| times(a, shape[0]) * times(b, shape[1]) * value)
                .sum();
            sum / (shape[0] * shape[1]) as f64
        })
    };
    SelfInfluence { normal: own(&symbols.zz), tangential: own(&symbols.xx).min(own(&symbols.yy)) }
}

impl SpectralCompliance {
    /// Operators of a region of `shape` cells, which stands for a larger one with mirrors; in free space the coefficients must cover at
    /// least the offsets of the whole, periodic symbols must be of its very shape.
    ///
    /// # Errors
    /// When a coefficient is missing or does not cover the region.
    pub fn new(
        response: &SurfaceResponse,
        shape: [usize; 2],
        operators: OperatorSet,
    ) -> Result<Self, ConvolutionError> {
        let list = match response {
            SurfaceResponse::FreeSpace(coefficients) => signed_kernels(coefficients),
            SurfaceResponse::Periodic(symbols) => signed_symbols(symbols),
        };
        let symmetry = operators.symmetry;
        let build = |wanted: bool, members: &[usize], fields: &[usize], blocks: &[Block]| {
            if !wanted {
                return Ok(None);
            }
            let there = members.iter().filter_map(|&m| list[m].0.as_ref().map(|values| (values, list[m].1)));
            let product = match response {
                SurfaceResponse::FreeSpace(_) => {
                    let kernels: Vec<Kernel<'_>> =
                        there.map(|(values, parity)| Kernel { values: values.view(), parity }).collect();
                    Product::free_space(Convolution::mirrored(
                        shape,
                        &kernels,
                        blocks,
                        mirrors(symmetry, fields),
                    )?)
                }
                SurfaceResponse::Periodic(_) => {
                    let symbols: Vec<Symbol<'_>> =
                        there.map(|(values, parity)| Symbol { values: values.view(), parity }).collect();
                    Product::periodic(PeriodicProduct::mirrored(
                        shape,
                        &symbols,
                        blocks,
                        mirrors(symmetry, fields),
                    )?)
                }
            };
            Ok(Some(product))
        };
        let self_influence = match response {
            SurfaceResponse::FreeSpace(coefficients) => own_of(coefficients),
            SurfaceResponse::Periodic(symbols) => own_in_period(symbols, symmetry.whole_of(shape)),
        };
        let [tangential, full, normal_from_all]: [(&[usize], &[Block]); 3] = match operators.shear_axis {
            Some(axis) => [
                (&TANGENTIAL_MEMBERS_ALONG[axis], &NORMAL_BLOCKS),
                (&FULL_MEMBERS_ALONG[axis], &FULL_BLOCKS_ALONG),
                (&NORMAL_FROM_ALL_MEMBERS_ALONG[axis], &NORMAL_FROM_ALL_BLOCKS_ALONG),
            ],
            None => [
                (&[1, 2, 3], &TANGENTIAL_BLOCKS),
                (&[0, 1, 2, 3, 4, 5], &FULL_BLOCKS),
                (&[0, 4, 5], &NORMAL_FROM_ALL_BLOCKS),
            ],
        };
        let (sheared, all): (&[usize], &[usize]) = match operators.shear_axis {
            Some(axis) => (&[[1], [2]][axis], &[[0, 1], [0, 2]][axis]),
            None => (&[1, 2], &[0, 1, 2]),
        };
        Ok(Self {
            shape,
            self_influence,
            normal: build(operators.normal, &[0], &[0], &NORMAL_BLOCKS)?,
            tangential: build(operators.tangential, tangential.0, sheared, tangential.1)?,
            full: build(operators.full, full.0, all, full.1)?,
            normal_from_all: build(operators.normal_from_all, normal_from_all.0, all, normal_from_all.1)?,
            single: Singles { wanted: operators.single, ..Singles::default() },
            shear_axis: operators.shear_axis,
            applications: 0,
        })
    }

    /// `u_z` from pressure and shear; needs the operator of that name.
    pub fn normal_from_all(&mut self, pressure: &[f64], shear: &TangentialField, normal: &mut [f64]) {
        if let Some(product) = &mut self.normal_from_all {
            self.applications += 1;
            match self.shear_axis {
                Some(axis) => product.apply(&[pressure, shear.parts()[axis]], &mut [normal]),
                None => product.apply(&[pressure, &shear.x, &shear.y], &mut [normal]),
            }
        }
    }

    /// Memory of the operators [bytes].
    pub fn memory_bytes(&self) -> usize {
        let products = [&self.normal, &self.tangential, &self.full, &self.normal_from_all];
        let singles = [&self.single.tangential, &self.single.full];
        products.into_iter().flatten().map(Product::memory_bytes).sum::<usize>()
            + singles.into_iter().flatten().map(SingleProduct::memory_bytes).sum::<usize>()
    }
}

/// How fields (0: normal, 1 and 2: along x and y) go on behind the mirrors.
pub(crate) fn mirrors(symmetry: Symmetry, fields: &[usize]) -> Mirrors {
    if !symmetry.any() {
        return Mirrors::NONE;
    }
    let parity = |field: &usize| match field.checked_sub(1).map(|component| symmetry.shear_is_odd(component))
    {
        None | Some([false, false]) => Parity::EvenEven,
        Some([true, false]) => Parity::OddEven,
        Some([false, true]) => Parity::EvenOdd,
        Some([true, true]) => Parity::OddOdd,
    };
    Mirrors { axes: symmetry.axes(), inputs: fields.iter().map(parity).collect() }
}

impl SurfaceCompliance for SpectralCompliance {
    fn shape(&self) -> [usize; 2] {
        self.shape
    }

    fn self_influence(&self) -> SelfInfluence {
        self.self_influence
    }

    fn normal(&mut self, pressure: &[f64], normal: &mut [f64]) {
        if let Some(product) = &mut self.normal {
            self.applications += 1;
            product.apply(&[pressure], &mut [normal]);
        } else {
            let zero = vec![0.0; pressure.len()];
            let [mut x, mut y] = [zero.clone(), zero.clone()];
            self.full([pressure, &zero, &zero], [normal, &mut x, &mut y]);
        }
    }

    fn tangential(&mut self, shear: [&[f64]; 2], mut tangential: [&mut [f64]; 2]) {
        if let Some(product) = &mut self.tangential {
            self.applications += 1;
            along_one(self.shear_axis, &shear, &mut tangential, |from, to| product.apply(from, to));
        } else {
            let zero = vec![0.0; shear[0].len()];
            let mut aside = zero.clone();
            let ([from_x, from_y], [to_x, to_y]) = (shear, tangential);
            self.full([&zero, from_x, from_y], [&mut aside, to_x, to_y]);
        }
    }

    fn full(&mut self, tractions: [&[f64]; 3], mut displacements: [&mut [f64]; 3]) {
        if let Some(product) = &mut self.full {
            self.applications += 1;
            along_one(self.shear_axis, &tractions, &mut displacements, |from, to| product.apply(from, to));
        } else {
            debug_assert!(self.normal.is_some() && self.tangential.is_some(), "no operator was asked for");
            let ([pressure, from_x, from_y], [normal, to_x, to_y]) = (tractions, displacements);
            self.normal(pressure, normal);
            self.tangential([from_x, from_y], [to_x, to_y]);
        }
    }

    fn tangential_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        let Self { single: Singles { wanted, tangential, .. }, shear_axis, applications, .. } = self;
        let product = made(tangential, self.tangential.as_ref(), *wanted)?;
        Some(SinglePrecisionOperator { product, shear_axis: *shear_axis, applications })
    }

    fn full_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        let Self { single: Singles { wanted, full, .. }, shear_axis, applications, .. } = self;
        let product = made(full, self.full.as_ref(), *wanted)?;
        Some(SinglePrecisionOperator { product, shear_axis: *shear_axis, applications })
    }
}
