//! Pressure and shear that remove displacements together, in one product of three fields: wave by wave the inverse of the whole response of a
//! coupled pair, what pressure and shear do to each other included.

use ndarray::Array2;

use super::{
    CellWaves, Preconditioner, SlipWeights, Sum, Weighted, inverse, nearest_images, smallest_positive,
};
use crate::compliance::{FULL_BLOCKS, OperatorSet, SurfaceResponse, mirrors};
use crate::fields::{Number, each_cell};
use crate::solver::linear::inverse::Inverse;
use fret_fft::{ConvolutionError, Parity, PeriodicProduct, Symbol};

/// What is left of the response to a wave of pressure where shear removes its displacement along the surface is at least this share of it; else the
/// wave is taken for uncoupled. On a half-space it is 0.75 and more.
const LEAST_LEFT: f64 = 0.1;

/// The parities of the six parts of a response, and of its inverse: zz, xx, yy, xy, zx, zy.
const PARITIES: [Parity; 6] =
    [Parity::EvenEven, Parity::EvenEven, Parity::EvenEven, Parity::OddOdd, Parity::OddEven, Parity::EvenOdd];

impl Preconditioner {
    /// The same with an inverse of pressure and shear together, for [`all`](Self::all), made of what it was made of; as it is where pressure and shear
    /// are not unknown together, act along one axis, or meet a pair that is stiff at the surface.
    ///
    /// # Errors
    /// When a coefficient is missing or does not cover the region.
    pub fn together(
        mut self,
        response: &SurfaceResponse,
        waves: Option<CellWaves<'_>>,
        part: [usize; 2],
        operators: OperatorSet,
    ) -> Result<Self, ConvolutionError> {
        let OperatorSet { full, shear_axis, symmetry, single, .. } = operators;
        if !full || shear_axis.is_some() || self.stiff || self.follows_pressure {
            return Ok(self);
        }
        let shape = symmetry.whole_of(part);
        let [zz, xx, yy, xy, zx, zy] = response.parts();
        let symbol = |values: &Option<Array2<f64>>, number: usize| {
            let values = values.as_ref().ok_or(ConvolutionError::EmptyShape(0, 0))?;
            let is_symbol = response.is_periodic();
            Ok(if is_symbol { values.clone() } else { nearest_images(values, shape, PARITIES[number]) })
        };
        let normal = match (response, waves, zz) {
            (SurfaceResponse::FreeSpace(_), Some(waves), Some(zz)) => waves.of_pressure(zz, shape),
            _ => symbol(zz, 0)?,
        };
        let (xx, yy, xy) = (symbol(xx, 1)?, symbol(yy, 2)?, symbol(xy, 3)?);
        let softest = smallest_positive(&xx).min(smallest_positive(&yy));
        let shear = inverse(&xx, &yy, &xy, softest);
        let parts = joined((normal, shear), [&symbol(zx, 4)?, &symbol(zy, 5)?], shape);
        let symbols: Vec<Symbol<'_>> = parts
            .iter()
            .zip(PARITIES)
            .map(|(values, parity)| Symbol { values: values.view(), parity })
            .collect();
        let mirrors = mirrors(symmetry, &[0, 1, 2]);
        let product = PeriodicProduct::mirrored(part, &symbols, &FULL_BLOCKS, mirrors)?;
        self.together = Some(Inverse::new(product, single));
        Ok(self)
    }

    /// Pressures and shears that would remove displacements `right`, normal and along x and y, packed over the contact prepared last, before any
    /// restriction to what the active sets leave free: together where that inverse was made, else each by itself.
    pub fn all<N: Number>(
        &mut self,
        [normal, right_x, right_y]: [&[N]; 3],
        [pressure, x, y]: [&mut [N]; 3],
        weights: &mut SlipWeights<N>,
    ) {
        let Self { together: Some(inverse), fields, workspace, .. } = self else {
            self.pressure(normal, pressure, weights);
            return self.shear(([right_x, right_y], None), [x, y], weights);
        };
        let SlipWeights { elastic, slip, compliance, part: [part_x, part_y], .. } = weights;
        each_cell(&Weighted, [right_x, right_y, elastic], [&mut *x, &mut *y]);
        // One of pressure and one of shear.
        self.passes += 2;
        inverse.apply(&[normal, &*x, &*y], &mut [pressure, part_x, part_y], *compliance, (fields, workspace));
        each_cell(&Sum, [part_x, part_y, right_x, right_y, elastic, slip], [x, y]);
    }
}

/// Wave by wave the inverse of `[[zz, -i zx, -i zy], [i zx, xx, -xy], [i zy, -xy, yy]]` from `zz` and the inverse for shear alone, by elimination; the
/// parts as symbols.
fn joined(
    (normal, shear): (Array2<f64>, [Array2<f64>; 3]),
    [zx, zy]: [&Array2<f64>; 2],
    shape: [usize; 2],
) -> [Array2<f64>; 6] {
    let least = smallest_positive(&normal);
    let [xx, yy, xy] = shear;
    let zero = Array2::zeros(normal.dim());
    let mut found = [normal, xx, yy, xy, zero.clone(), zero];
    // An odd symbol counts as zero there.
    let is_none = |axis: usize, index: usize| index == 0 || 2 * index == shape[axis];
    let [zz, xx, yy, xy, to_x, to_y] = &mut found;
    for ((a, b), zz) in zz.indexed_iter_mut() {
        if *zz == 0.0 {
            continue;
        }
        *zz = zz.max(least);
        let at = [a, b];
        let by = [if is_none(0, a) { 0.0 } else { zx[at] }, if is_none(1, b) { 0.0 } else { zy[at] }];
        let cross = if is_none(0, a) || is_none(1, b) { 0.0 } else { -xy[at] };
        let removed = [xx[at] * by[0] + cross * by[1], cross * by[0] + yy[at] * by[1]];
        let left = *zz - removed[0] * by[0] - removed[1] * by[1];
        if !(left > LEAST_LEFT * *zz) {
            *zz = 1.0 / *zz;
            continue;
        }
        *zz = 1.0 / left;
        xx[at] += removed[0] * removed[0] / left;
        yy[at] += removed[1] * removed[1] / left;
        xy[at] -= removed[0] * removed[1] / left;
        to_x[at] = -removed[0] / left;
        to_y[at] = -removed[1] / left;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliance::{SpectralCompliance, SurfaceCompliance};
    use crate::kernel::{Components, influence_coefficients, periodic_symbols};
    use crate::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace, Symmetry};
    use crate::random::Random;
    use crate::solver::ContactSet;

    const SPACING: [f64; 2] = [0.5, 0.7];

    /// A rigid body on one with a coating twice as stiff as what is below it.
    fn pair() -> ContactPair {
        let material = |young: f64| ElasticMaterial::new(young, 0.2).unwrap();
        let coating = Coating::new(material(2.0), 0.8).unwrap();
        let lower = HalfSpace::new(vec![coating], Base::Elastic(material(1.0))).unwrap();
        ContactPair::new(Body::Rigid, Body::Elastic(lower)).unwrap()
    }

    /// Displacements of random tractions whose sums are zero on a grid that repeats, all of it in contact, are removed by these very tractions, with
    /// mirrors and without; what each alone leaves over is more than a tenth. On a part of the cells, some of which slip, and in free space the
    /// inverse is symmetric up to the sign of what pressure and shear do to each other, as the response is: here it is its own transpose.
    #[test]
    fn what_pressure_and_shear_displace_is_removed_by_both() {
        let mut random = Random::seeded(9);
        let cells = [10, 12];
        for symmetry in [Symmetry::NONE, Symmetry { odd_shear: [Some(0), None] }] {
            let whole = symmetry.whole_of(cells);
            let symbols = periodic_symbols(&pair(), whole, SPACING, Components::ALL, 0);
            let coefficients = influence_coefficients(&pair(), whole, SPACING, Components::ALL);
            for response in [SurfaceResponse::Periodic(symbols), SurfaceResponse::FreeSpace(coefficients)] {
                let set = OperatorSet { full: true, symmetry, ..OperatorSet::default() };
                let mut compliance = SpectralCompliance::new(&response, cells, set).unwrap();
                let alone = || Preconditioner::new(&response, None, cells, set).unwrap();
                let mut both = alone().together(&response, None, cells, set).unwrap();
                assert!(both.together.is_some());
                let count = cells[0] * cells[1];
                let mut field = |count: usize| -> Vec<f64> {
                    let values: Vec<f64> = (0..count).map(|_| random.between(-1.0, 1.0)).collect();
                    let mean = values.iter().sum::<f64>() / count as f64;
                    values.iter().map(|value| value - mean).collect()
                };
                let given = [(); 3].map(|()| field(count));
                let mut moved = given.clone();
                let [normal, x, y] = &mut moved;
                compliance.full([&given[0], &given[1], &given[2]], [normal, x, y]);
                let remove = |tested: &mut Preconditioner,
                              contact: &ContactSet,
                              slip: &[f64],
                              right: &[Vec<f64>; 3]| {
                    let mut weights = SlipWeights::default();
                    tested.prepare(contact, slip, 1.0, &mut weights);
                    let mut found = right.clone();
                    let [pressure, x, y] = &mut found;
                    tested.all([&right[0], &right[1], &right[2]], [pressure, x, y], &mut weights);
                    found
                };
                let off = |found: &[Vec<f64>; 3]| {
                    let parts = found.iter().flatten().zip(given.iter().flatten());
                    parts.map(|(found, given)| (found - given).abs()).fold(0.0, f64::max)
                };
                let all = ContactSet::of(count, |_| true);
                if response.is_periodic() {
                    let found = remove(&mut both, &all, &vec![0.0; count], &moved);
                    assert!(off(&found) < 1e-11, "{}", off(&found));
                    assert!(off(&remove(&mut alone(), &all, &vec![0.0; count], &moved)) > 0.1);
                }
                let some = ContactSet::of(count, |cell| cell % 5 != 0 && cell > 20);
                let slip: Vec<f64> = (0..some.len()).map(|cell| (cell % 3) as f64).collect();
                let [one, other] = [(); 2].map(|()| [(); 3].map(|()| field(some.len())));
                let times = |a: &[Vec<f64>; 3], b: &[Vec<f64>; 3]| -> f64 {
                    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| a * b).sum()
                };
                let [forward, back] = [
                    times(&one, &remove(&mut both, &some, &slip, &other)),
                    times(&remove(&mut both, &some, &slip, &one), &other),
                ];
                assert!(
                    forward != 0.0 && (forward - back).abs() < 1e-12 * times(&one, &one).max(forward.abs()),
                    "{forward} {back}"
                );
            }
        }
    }
}
