//! Radial kernels of the surfaces of homogeneous bodies: D does not depend on the wavenumber, and the kernels are powers of the
//! radius.
//!
//! ```text
//! 1/(2 pi) Int_0^inf k^2m J_n(k r) dk = c_m / (2 pi r^(2m+1))        c_m = 4^m Gamma(a + m)/Gamma(a - m), a = (n + 1)/2
//! ```
//!
//! (Watson, A Treatise on the Theory of Bessel Functions, 13.24, continued in the power), `c_0 = 1`; the powers m > 0 are those of
//! the filter of far cells.

use std::f64::consts::TAU;

use super::far_cells::FILTER;
use super::panels::{Lanes, Panels};
use super::quartets::Quartets;
use super::radial::{KernelSource, RadialKernels};

/// Kernels whose D is the same at all wavenumbers.
pub(super) struct ConstantKernels<const N: usize> {
    /// D over 2 pi.
    scale: [Lanes; N],
    /// Least radius of any table \[length\].
    radius: f64,
}

impl<const N: usize> ConstantKernels<N> {
    /// Of the quartets' D, for tables from a least radius.
    pub(super) fn new(d: [Lanes; N], radius: f64) -> Self {
        Self { scale: d.map(|lanes| lanes.map(|d| d / TAU)), radius }
    }

    /// The kernels over `r^n`, times a factor of the order and the square of the radius.
    fn panels<Q: Quartets<N>>(
        &self,
        [least, greatest]: [f64; 2],
        factor: impl Fn(usize, f64) -> f64 + Sync,
    ) -> Panels<N> {
        Panels::new(least * least, greatest * greatest, |square| {
            let r = square.sqrt();
            let powers = [r, square, r * square, square * square].map(|power| 1.0 / power);
            let of_order: Lanes = std::array::from_fn(|order| powers[order] * factor(order, square));
            std::array::from_fn(|quartet| {
                let of_lane = Q::LIST[quartet].spread(of_order);
                std::array::from_fn(|lane| self.scale[quartet][lane] * of_lane[lane])
            })
        })
    }
}

impl<Q: Quartets<N>, const N: usize> KernelSource<Q, N> for ConstantKernels<N> {
    fn points(&self, greatest: f64) -> RadialKernels<N> {
        let panels = self.panels::<Q>([self.radius, greatest], |_, _| 1.0);
        // Int_0^radius 1/r 2 pi r dr
        let disc = Q::LIST.map(|quartet| quartet.spread([TAU * self.radius, 0.0, 0.0, 0.0]));
        let over_disc =
            |quartet: usize| std::array::from_fn(|lane| self.scale[quartet][lane] * disc[quartet][lane]);
        RadialKernels::new(panels, std::array::from_fn(over_disc))
    }

    fn filtered(&self, least: f64, greatest: f64, side: f64) -> RadialKernels<N> {
        let filters = [0, 1, 2, 3].map(filter_of_order);
        let panels = self.panels::<Q>([least, greatest], |order, square| {
            let ratio = side * side / square;
            filters[order].iter().rev().fold(0.0, |sum, coefficient| sum * ratio + coefficient)
        });
        RadialKernels::new(panels, [[0.0; 4]; N]) // at the surface no far cell has the load under its centre
    }
}

/// What the filter of far cells makes of a kernel of a Bessel order, in powers of `(side/r)^2`.
fn filter_of_order(order: usize) -> [f64; FILTER.len()] {
    let a = 0.5 * (order + 1) as f64;
    let mut power = 1.0;
    std::array::from_fn(|m| {
        if m > 0 {
            power *= 4.0 * (a + m as f64 - 1.0) * (a - m as f64);
        }
        FILTER[m] * power
    })
}

#[cfg(test)]
mod tests {
    use super::super::pair_response::PairResponse;
    use super::super::quartets::{Quartet, SurfaceDisplacement};
    use super::super::radial::KernelLattice;
    use super::super::samples::pair;
    use super::*;
    use pulp::Scalar;

    /// The lattice's digital filter knows nothing of the closed form: 5e-15 of the kernels is what it keeps of homogeneous bodies.
    #[test]
    fn powers_of_the_radius_are_what_the_lattice_finds() {
        let response = PairResponse::new(&pair(&[], Some((2.6, 0.3))));
        let d = Quartet::Displacement
            .lanes(1.0, &super::super::lattice_samples::WaveResponse::transfer(&response, 1.0));
        let (least, greatest, side) = (0.5, 300.0, 1.0);
        let lattice = KernelLattice::new::<SurfaceDisplacement, 1>(&response, least, greatest);
        let constant = ConstantKernels::new([d], least);
        let sources: [&dyn KernelSource<SurfaceDisplacement, 1>; 2] = [&lattice, &constant];
        let points = sources.map(|source| source.points(greatest));
        let filtered = sources.map(|source| source.filtered(20.0, greatest, side));
        for ([by_lattice, found], from) in [(&points, 0.6), (&filtered, 21.0)] {
            for n in 0..200 {
                let r = from + 1.3 * f64::from(n);
                let [exact, found] = [by_lattice, found].map(|kernels| kernels.at_square::<Scalar>(r * r)[0]);
                for (lane, order) in [0, 0, 2, 1].into_iter().enumerate() {
                    let error = (found[lane] - exact[lane]).abs() * r.powi(order) / exact[0];
                    assert!(error < 5e-15, "lane {lane} at {r}: {error:.1e}");
                }
            }
        }
        for lane in 0..4 {
            let [exact, found] = [0, 1].map(|source| points[source].innermost()[0][lane]);
            assert!((found - exact).abs() <= 5e-15 * exact.abs(), "{lane}: {found:e} {exact:e}");
        }
    }
}
