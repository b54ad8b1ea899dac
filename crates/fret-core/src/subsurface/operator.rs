//! From the tractions on the surface to stress and displacement at one depth: kernels of that depth, and products with them.

use ndarray::{Array2, ArrayView2, CowArray, Ix2};

use super::depths::DepthPoint;
use super::tensor::{StressField, StressTensor};
use crate::fields::Dual;
use crate::kernel::depth_cells::{
    displacement_coefficients, repeated_stress_coefficients, stress_coefficients,
};
use crate::kernel::depth_periodic::{displacement_symbols, stress_symbols};
use crate::kernel::depth_response::DepthResponse;
use crate::kernel::line_depth::line_stress_coefficients;
use crate::kernel::{BelowSurface, DepthChange, LayerChanges};
use crate::model::{HalfSpace, Periodicity, SurfaceGrid};
use fret_fft::{Block, Convolution, ConvolutionError, Kernel, Parity, PeriodicProduct, Symbol, Workspace};

/// Tractions on the body's surface [pressure], shape `(nx, ny)`, uniform over each cell.
#[derive(Debug, Clone, Copy)]
pub struct Tractions<'a> {
    /// Pressure, compression positive.
    pub pressure: ArrayView2<'a, f64>,
    /// Shear acting on the body, along x and y.
    pub shear: Option<[ArrayView2<'a, f64>; 2]>,
}

/// Stress and displacement at one depth of one body, under the centres of the cells.
///
/// Kernels of the whole stack at that depth, tabulated in the distance and integrated over cells, as for the
/// surface, or over the strips of a line contact (plane strain), or with all images where one axis is periodic or both are; at depth 0 they give
/// the stress in the surface itself. Stresses are exact for tractions that are uniform over each cell, to rounding: about 1e-13 of the largest
/// traction for contrasts up to 1e4; where both axes are periodic, to 1e-9 of the largest stress. Displacements of such problems are those of the grid's own waves, with
/// which their contact is solved.
///
/// It can be moved to another depth, and then works in the same memory.
pub struct DepthOperator {
    scene: Scene,
    planned: Planned,
    workspace: Workspace,
    /// Where kernels are made before they are transformed.
    kernels: Vec<f64>,
}

/// The products of one depth.
struct Planned {
    point: DepthPoint,
    /// xx, yy, zz and xy, xz, yz.
    stress: [DepthProduct; 2],
    displacement: Option<DepthProduct>,
}

/// A product whose workspace is elsewhere.
enum DepthProduct {
    FreeSpace(Convolution),
    Periodic(PeriodicProduct),
}

const fn block(output: usize, input: usize, kernel: usize) -> Block {
    Block { output, input, kernel, sign: 1.0 }
}

/// Parity of a component from pressure; shear turns the one along its own axis.
fn parity(component: usize, load: usize) -> Parity {
    let [mut x, mut y] =
        [[false, false], [false, false], [false, false], [true, true], [true, false], [false, true]]
            [component];
    if load == 1 {
        x = !x;
    }
    if load == 2 {
        y = !y;
    }
    match (x, y) {
        (false, false) => Parity::EvenEven,
        (true, false) => Parity::OddEven,
        (false, true) => Parity::EvenOdd,
        (true, true) => Parity::OddOdd,
    }
}

impl DepthOperator {
    /// Operator of one depth of a half-space; `with_shear` when shear will be given, `with_displacement` when displacement
    /// will be asked for.
    ///
    /// # Errors
    /// When a kernel is not finite: with moduli or lengths of extreme magnitude.
    pub fn new(
        half_space: &HalfSpace,
        point: DepthPoint,
        grid: &SurfaceGrid,
        periodic: Periodicity,
        with_shear: bool,
        with_displacement: bool,
    ) -> Result<Self, ConvolutionError> {
        let scene = Scene {
            half_space: half_space.clone(),
            shape: grid.cells(),
            spacing: grid.spacing(),
            periodic,
            with_shear,
            with_displacement,
        };
        let mut kernels = Vec::new();
        let planned = scene.plan(point, &mut kernels)?;
        let workspace = planned.stress[0].workspace();
        Ok(Self { scene, planned, workspace, kernels })
    }

    /// Moves to another depth of the same half-space.
    ///
    /// # Errors
    /// As [`new`](Self::new); the operator then stays where it was.
    pub fn move_to(&mut self, point: DepthPoint) -> Result<(), ConvolutionError> {
        self.planned = self.scene.plan(point, &mut self.kernels)?;
        Ok(())
    }

    /// The depth.
    pub fn point(&self) -> DepthPoint {
        self.planned.point
    }

    /// Stress from tractions [pressure]. Shear must be given exactly when the operator was made for it.
    ///
    /// # Panics
    /// When the tractions are not those the operator was made for.
    pub fn stress(&mut self, tractions: &Tractions<'_>) -> StressField {
        let mut field = StressField::zeros(self.scene.shape);
        self.stress_into(tractions, &mut field);
        field
    }

    /// As [`stress`](Self::stress), in a field that is there; what it held is lost.
    ///
    /// # Panics
    /// When the tractions or the field are not those the operator was made for.
    pub fn stress_into(&mut self, tractions: &Tractions<'_>, field: &mut StressField) {
        let input = self.standard(tractions);
        let (normal, shear) = field.components.split_at_mut(3);
        apply(&self.planned.stress[0], &mut self.workspace, &input, normal);
        apply(&self.planned.stress[1], &mut self.workspace, &input, shear);
    }

    /// Displacement `u_x, u_y, u_z` of the body [length]; `None` when the operator was not made for it, in line contacts, and where one axis alone is periodic. In periodic problems
    /// without the mean, which a half-space does not determine.
    ///
    /// # Panics
    /// As [`stress`](Self::stress).
    pub fn displacement(&mut self, tractions: &Tractions<'_>) -> Option<[Array2<f64>; 3]> {
        let input = self.standard(tractions);
        let [nx, ny] = self.scene.shape;
        let product = self.planned.displacement.as_ref()?;
        let mut fields: [Array2<f64>; 3] = std::array::from_fn(|_| Array2::zeros((nx, ny)));
        apply(product, &mut self.workspace, &input, &mut fields);
        Some(fields)
    }

    /// How a number of the stress under a cell, with derivatives `by` the components of that, changes with the tractions on all cells: with
    /// pressure, and with shear along x and y where the operator was made for it. What a traction on one cell does under another is what the
    /// same traction there does here, but for the sign of what is odd.
    pub fn by_tractions(&mut self, cell: [usize; 2], by: &StressTensor) -> Vec<Array2<f64>> {
        let [nx, ny] = self.scene.shape;
        let none = Array2::zeros((nx, ny));
        let mut unit = none.clone();
        unit[cell] = 1.0;
        let mut field = StressField::zeros([nx, ny]);
        let loads = self.scene.loads();
        let of_load = |load: usize| {
            let here = |number: usize| if load == number { unit.view() } else { none.view() };
            let shear = self.scene.with_shear.then(|| [here(1), here(2)]);
            self.stress_into(&Tractions { pressure: here(0), shear }, &mut field);
            let mut sum = Array2::zeros((nx, ny));
            for (component, (stress, by)) in field.components.iter().zip(by.0).enumerate() {
                let turns = matches!(parity(component, load), Parity::OddEven | Parity::EvenOdd);
                sum.scaled_add(if turns { -by } else { by }, stress);
            }
            sum
        };
        (0..loads).map(of_load).collect()
    }

    /// The tractions row by row.
    fn standard<'a>(&self, tractions: &'a Tractions<'_>) -> Vec<CowArray<'a, f64, Ix2>> {
        assert_eq!(self.scene.with_shear, tractions.shear.is_some(), "shear given or asked for, not both");
        let shear = tractions.shear.iter().flatten();
        std::iter::once(&tractions.pressure).chain(shear).map(|field| field.as_standard_layout()).collect()
    }
}

/// How the stress at a depth changes with a parameter while the tractions stay, for each of some: by the derivatives of the constants of the
/// layers of the half-space, from the surface down, those of the substrate last, and by that of the depth. `visit(number, field)`.
///
/// # Errors
/// When a kernel is not finite: with moduli or lengths of extreme magnitude.
///
/// # Panics
/// As [`DepthOperator::stress`].
pub fn change_of_stress(
    (half_space, changes): (&HalfSpace, &[LayerChanges]),
    (point, deeper): (DepthPoint, f64),
    (grid, periodic): (&SurfaceGrid, Periodicity),
    tractions: &[Tractions<'_>],
    mut visit: impl FnMut(usize, &StressField),
) -> Result<(), ConvolutionError> {
    let scene = Scene {
        half_space: half_space.clone(),
        shape: grid.cells(),
        spacing: grid.spacing(),
        periodic,
        with_shear: tractions.iter().any(|tractions| tractions.shear.is_some()),
        with_displacement: false,
    };
    let response = DepthChange::new(half_space, changes, (point.layer, Dual::new(point.depth, deeper)));
    let mut kernels = Vec::new();
    let stress = scene.stress(&response, &mut kernels)?;
    let workspace = stress[0].workspace();
    let planned = Planned { point, stress, displacement: None };
    let mut operator = DepthOperator { scene, planned, workspace, kernels };
    for (number, tractions) in tractions.iter().enumerate() {
        visit(number, &operator.stress(tractions));
    }
    Ok(())
}

/// What stays the same from depth to depth.
struct Scene {
    half_space: HalfSpace,
    shape: [usize; 2],
    spacing: [f64; 2],
    periodic: Periodicity,
    with_shear: bool,
    with_displacement: bool,
}

impl Scene {
    /// Products of a depth; their kernels are made in `memory`.
    fn plan(&self, point: DepthPoint, memory: &mut Vec<f64>) -> Result<Planned, ConvolutionError> {
        let Self { shape, spacing, periodic, .. } = *self;
        let response = DepthResponse::new(&self.half_space, point.layer, point.depth);
        let stress = self.stress(&response, memory)?;
        let loads = self.loads();
        let is_endless = shape[1] == 1 || periodic.one_axis().is_some();
        let displacement = if self.with_displacement && !is_endless {
            let coefficients = if periodic.is_both() {
                displacement_symbols(&response, shape, spacing)
            } else {
                displacement_coefficients(&response, shape, spacing, std::mem::take(memory))
            };
            // u_x, u_y, u_z have the parities of sigma_xz, sigma_yz, sigma_zz
            let product = self.product(loads, |load, output| {
                (coefficients.kernel(load, output), parity([4, 5, 2][output], load))
            });
            *memory = coefficients.into_memory();
            Some(product?)
        } else {
            None
        };
        Ok(Planned { point, stress, displacement })
    }

    /// Pressure, and shear along x and y where there is any.
    fn loads(&self) -> usize {
        if self.with_shear { 3 } else { 1 }
    }

    /// Products of what stands below the surface; their kernels are made in `memory`.
    fn stress(
        &self,
        response: &impl BelowSurface,
        memory: &mut Vec<f64>,
    ) -> Result<[DepthProduct; 2], ConvolutionError> {
        let Self { shape, spacing, periodic, with_shear, .. } = *self;
        let coefficients = if periodic.is_both() {
            stress_symbols(response, shape, spacing, with_shear)
        } else if shape[1] == 1 {
            line_stress_coefficients(response, shape[0], spacing[0], with_shear)
        } else if let Some(axis) = periodic.one_axis() {
            repeated_stress_coefficients(response, (shape, spacing), axis, with_shear)
        } else {
            stress_coefficients(response, shape, spacing, with_shear, std::mem::take(memory))
        };
        let stress = [[0, 1, 2], [3, 4, 5]].map(|components| {
            self.product(self.loads(), |load, output| {
                (coefficients.kernel(load, components[output]), parity(components[output], load))
            })
        });
        *memory = coefficients.into_memory();
        let [normal, shear] = stress;
        Ok([normal?, shear?])
    }

    /// Product of three outputs from all loads.
    fn product<'k>(
        &self,
        loads: usize,
        kernel: impl Fn(usize, usize) -> (ArrayView2<'k, f64>, Parity),
    ) -> Result<DepthProduct, ConvolutionError> {
        let pairs = || (0..loads).flat_map(|load| (0..3).map(move |output| (load, output)));
        let blocks: Vec<Block> =
            pairs().enumerate().map(|(number, (load, output))| block(output, load, number)).collect();
        let kernels = pairs().map(|(load, output)| kernel(load, output));
        Ok(if self.periodic.is_both() {
            let symbols: Vec<Symbol<'_>> =
                kernels.map(|(values, parity)| Symbol { values, parity }).collect();
            DepthProduct::Periodic(PeriodicProduct::new(self.shape, &symbols, &blocks)?)
        } else {
            let kernels: Vec<Kernel<'_>> =
                kernels.map(|(values, parity)| Kernel { values, parity }).collect();
            DepthProduct::FreeSpace(Convolution::new(self.shape, &kernels, &blocks)?)
        })
    }
}

impl DepthProduct {
    fn workspace(&self) -> Workspace {
        match self {
            Self::FreeSpace(convolution) => convolution.workspace(),
            Self::Periodic(product) => product.workspace(),
        }
    }
}

fn apply(
    product: &DepthProduct,
    workspace: &mut Workspace,
    input: &[CowArray<'_, f64, Ix2>],
    output: &mut [Array2<f64>],
) {
    // arrays in standard layout and fields made by `zeros` are contiguous
    let input: Vec<&[f64]> = input.iter().map(|field| field.as_slice().unwrap_or_default()).collect();
    let mut output: Vec<&mut [f64]> =
        output.iter_mut().map(|field| field.as_slice_mut().unwrap_or_default()).collect();
    match product {
        DepthProduct::FreeSpace(convolution) => convolution.apply(workspace, &input, &mut output),
        DepthProduct::Periodic(product) => product.apply(workspace, &input, &mut output),
    }
}
