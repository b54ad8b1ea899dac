//! The elastic response by fast products in Fourier space.

use super::operator::{OperatorSet, SelfInfluence, SinglePrecisionOperator, SurfaceCompliance, along_one};
use super::product::{Product, SharedWorkspace};
use super::surface_response::{
    FULL_BLOCKS, SurfaceResponse, block, mirrors, own_in_period, own_of, signed_kernels, signed_symbols,
};
use fret_fft::{Block, Convolution, ConvolutionError, Kernel, PeriodicProduct, SingleProduct, Symbol};

/// The elastic response by fast products in Fourier space.
pub struct SpectralCompliance {
    shape: [usize; 2],
    self_influence: SelfInfluence,
    pub(super) normal: Option<Product>,
    pub(super) tangential: Option<Product>,
    pub(super) full: Option<Product>,
    normal_from_all: Option<Product>,
    /// The same in single precision, made when first asked for.
    single: Singles,
    /// Where all of them work.
    pub(super) workspace: SharedWorkspace,
    /// The one axis along which shear acts.
    pub(super) shear_axis: Option<usize>,
    /// What lies between the surfaces gives in each cell by so much under a unit of its own pressure [length/pressure]; empty where nothing does.
    give: Vec<f64>,
    /// Applications so far.
    pub applications: usize,
}

/// Adds to a normal displacement what gives under the pressure of each cell alone.
fn add_give(give: &[f64], pressure: &[f64], normal: &mut [f64]) {
    for ((normal, give), pressure) in normal.iter_mut().zip(give).zip(pressure) {
        *normal += give * pressure;
    }
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
) -> Option<&'a SingleProduct> {
    if single.is_none() && wanted {
        *single = product.and_then(Product::in_single_precision);
    }
    single.as_ref()
}

/// One input and one output.
pub(crate) const NORMAL_BLOCKS: [Block; 1] = [block(0, 0, 0, 1.0)];
/// Inputs and outputs x, y; kernels xx, yy, xy.
pub(crate) const TANGENTIAL_BLOCKS: [Block; 4] =
    [block(0, 0, 0, 1.0), block(1, 1, 1, 1.0), block(0, 1, 2, 1.0), block(1, 0, 2, 1.0)];
const NORMAL_FROM_ALL_BLOCKS: [Block; 3] = [block(0, 0, 0, 1.0), block(0, 1, 1, 1.0), block(0, 2, 2, 1.0)];

/// Kernels and blocks for shear along one axis: inputs and outputs z and that axis.
const TANGENTIAL_MEMBERS_ALONG: [[usize; 1]; 2] = [[1], [2]];
const FULL_MEMBERS_ALONG: [[usize; 3]; 2] = [[0, 1, 4], [0, 2, 5]];
const FULL_BLOCKS_ALONG: [Block; 4] =
    [block(0, 0, 0, 1.0), block(1, 1, 1, 1.0), block(0, 1, 2, 1.0), block(1, 0, 2, -1.0)];
const NORMAL_FROM_ALL_MEMBERS_ALONG: [[usize; 2]; 2] = [[0, 4], [0, 5]];
const NORMAL_FROM_ALL_BLOCKS_ALONG: [Block; 2] = [block(0, 0, 0, 1.0), block(0, 1, 1, 1.0)];

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
                    Product::FreeSpace(Convolution::mirrored(
                        shape,
                        &kernels,
                        blocks,
                        mirrors(symmetry, fields),
                    )?)
                }
                SurfaceResponse::Periodic(_) => {
                    let symbols: Vec<Symbol<'_>> =
                        there.map(|(values, parity)| Symbol { values: values.view(), parity }).collect();
                    Product::Periodic(PeriodicProduct::mirrored(
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
            workspace: SharedWorkspace::default(),
            shear_axis: operators.shear_axis,
            give: Vec::new(),
            applications: 0,
        })
    }

    /// The same operators, at work in a given memory.
    #[must_use]
    pub fn working_in(self, workspace: &SharedWorkspace) -> Self {
        Self { workspace: workspace.clone(), ..self }
    }

    /// From now on what lies between the surfaces gives in each cell by so much under a unit of its own pressure [length/pressure]: a diagonal beside the
    /// elastic response of the bodies. Empty: nothing does.
    pub fn set_give(&mut self, give: Vec<f64>) {
        self.give = give;
    }

    /// Whether something lies between the surfaces that gives.
    pub fn gives(&self) -> bool {
        !self.give.is_empty()
    }

    /// `u_z` from pressure and shear; needs the operator of that name.
    pub fn normal_from_all(&mut self, pressure: &[f64], shear: [&[f64]; 2], normal: &mut [f64]) {
        if let Some(product) = &self.normal_from_all {
            self.applications += 1;
            match self.shear_axis {
                Some(axis) => {
                    product.apply(&self.workspace, &[pressure, shear[axis]], &mut [normal]);
                }
                None => product.apply(&self.workspace, &[pressure, shear[0], shear[1]], &mut [normal]),
            }
            add_give(&self.give, pressure, normal);
        }
    }

    /// Memory of the operators and of the work space [bytes].
    pub fn memory_bytes(&self) -> usize {
        let products = [&self.normal, &self.tangential, &self.full, &self.normal_from_all];
        let singles = [&self.single.tangential, &self.single.full];
        products.into_iter().flatten().map(Product::memory_bytes).sum::<usize>()
            + singles.into_iter().flatten().map(SingleProduct::memory_bytes).sum::<usize>()
            + self.workspace.memory_bytes()
    }
}

impl SurfaceCompliance for SpectralCompliance {
    fn shape(&self) -> [usize; 2] {
        self.shape
    }

    fn self_influence(&self) -> SelfInfluence {
        self.self_influence
    }

    fn normal(&mut self, pressure: &[f64], normal: &mut [f64]) {
        if let Some(product) = &self.normal {
            self.applications += 1;
            product.apply(&self.workspace, &[pressure], &mut [normal]);
            add_give(&self.give, pressure, normal);
        } else {
            let zero = vec![0.0; pressure.len()];
            let [mut x, mut y] = [zero.clone(), zero.clone()];
            self.full([pressure, &zero, &zero], [normal, &mut x, &mut y]);
        }
    }

    fn tangential(&mut self, shear: [&[f64]; 2], mut tangential: [&mut [f64]; 2]) {
        if let Some(product) = &self.tangential {
            self.applications += 1;
            let workspace = &self.workspace;
            along_one(self.shear_axis, &shear, &mut tangential, |from, to| {
                product.apply(workspace, from, to);
            });
        } else {
            let zero = vec![0.0; shear[0].len()];
            let mut aside = zero.clone();
            let ([from_x, from_y], [to_x, to_y]) = (shear, tangential);
            self.full([&zero, from_x, from_y], [&mut aside, to_x, to_y]);
        }
    }

    fn full(&mut self, tractions: [&[f64]; 3], mut displacements: [&mut [f64]; 3]) {
        if let Some(product) = &self.full {
            self.applications += 1;
            let workspace = &self.workspace;
            along_one(self.shear_axis, &tractions, &mut displacements, |from, to| {
                product.apply(workspace, from, to);
            });
            add_give(&self.give, tractions[0], displacements[0]);
        } else {
            debug_assert!(self.normal.is_some() && self.tangential.is_some(), "no operator was asked for");
            let ([pressure, from_x, from_y], [normal, to_x, to_y]) = (tractions, displacements);
            self.normal(pressure, normal);
            self.tangential([from_x, from_y], [to_x, to_y]);
        }
    }

    fn tangential_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        let Self { single: Singles { wanted, tangential, .. }, workspace, shear_axis, applications, .. } =
            self;
        let product = made(tangential, self.tangential.as_ref(), *wanted)?;
        Some(SinglePrecisionOperator { product, workspace, shear_axis: *shear_axis, give: &[], applications })
    }

    fn full_single(&mut self) -> Option<SinglePrecisionOperator<'_>> {
        let Self { single: Singles { wanted, full, .. }, workspace, shear_axis, give, applications, .. } =
            self;
        let product = made(full, self.full.as_ref(), *wanted)?;
        Some(SinglePrecisionOperator { product, workspace, shear_axis: *shear_axis, give, applications })
    }
}
