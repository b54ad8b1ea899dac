//! Radial kernels in quartets: what they are, and how they follow from the response.

use super::complex::Wavenumber;
use super::depth_response::Transfer;
use super::panels::Lanes;

/// Four kernels that are made together: what they are, and the Bessel order of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quartet {
    /// From pressure: `sigma_zz`, mean and difference of `sigma_xx` and `sigma_yy`, `sigma_rz`.
    PressureStress,
    /// From shear: `sigma_zz`, and the three parts of the stresses in the plane.
    ShearStress,
    /// From shear: mean and difference of `sigma_xz` and `sigma_yz`; two lanes are idle.
    ShearTraction,
    /// Displacement: `u_z` from pressure, mean and difference of `u_x` and `u_y` from shear, `u_r` from pressure.
    Displacement,
    /// Displacement `u_z` from shear; three lanes are idle.
    Rise,
}

impl Quartet {
    /// Bessel order of each kernel.
    pub(crate) const fn orders(self) -> [usize; 4] {
        match self {
            Self::PressureStress | Self::Displacement => [0, 0, 2, 1],
            Self::ShearStress => [1, 1, 1, 3],
            Self::ShearTraction => [0, 2, 0, 0],
            Self::Rise => [1, 0, 0, 0],
        }
    }

    /// What belongs to the order of each lane, `of_order` being given from 0 to 3; zero in idle lanes.
    #[inline(always)]
    pub(crate) const fn spread(self, of_order: [f64; 4]) -> Lanes {
        let [zero, one, two, three] = of_order;
        match self {
            Self::PressureStress | Self::Displacement => [zero, zero, two, one],
            Self::ShearStress => [one, one, one, three],
            Self::ShearTraction => [zero, two, 0.0, 0.0],
            Self::Rise => [one, 0.0, 0.0, 0.0],
        }
    }

    /// How many lanes are in use.
    pub(super) const fn lanes_in_use(self) -> usize {
        match self {
            Self::PressureStress | Self::ShearStress | Self::Displacement => 4,
            Self::ShearTraction => 2,
            Self::Rise => 1,
        }
    }

    /// Power of k with which D starts.
    pub(super) fn start(self) -> i32 {
        match self {
            Self::PressureStress | Self::ShearStress | Self::ShearTraction => 1,
            Self::Displacement | Self::Rise => 0,
        }
    }

    /// D of the four kernels at a wavenumber.
    #[inline(always)]
    pub(super) fn lanes<T: Wavenumber>(self, k: T, transfer: &Transfer<T>) -> [T; 4] {
        let t = transfer;
        let zero = T::zero();
        match self {
            Self::PressureStress => {
                let (along, across) = (t.along[1], t.across[1]);
                [k * t.normal[1], k * (along + across) * 0.5, k * (along - across) * 0.5, k * t.shear[1]]
            }
            Self::ShearStress => {
                let (along, across) = (t.along[0], t.across[0]);
                let twice = t.in_plane_shear * 2.0;
                [
                    k * t.normal[0],
                    k * (along + across) * 0.5,
                    k * (along - across - twice) * 0.25,
                    k * (along - across + twice) * 0.25,
                ]
            }
            Self::ShearTraction => {
                let (shear, twist) = (t.shear[0], t.twist_shear);
                [k * (shear + twist) * 0.5, k * (shear - twist) * 0.5, zero, zero]
            }
            Self::Displacement => {
                let (tangential, sideways) = (t.tangential[0], t.sideways);
                [
                    t.depthwise[1],
                    (tangential + sideways) * 0.5,
                    (tangential - sideways) * 0.5,
                    t.tangential[1],
                ]
            }
            Self::Rise => [t.depthwise[0], zero, zero, zero],
        }
    }
}

/// The quartets made together for one purpose.
pub(crate) trait Quartets<const N: usize>: Copy + Send + Sync {
    const LIST: [Quartet; N];
}

/// Stresses from pressure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StressFromPressure;

impl Quartets<1> for StressFromPressure {
    const LIST: [Quartet; 1] = [Quartet::PressureStress];
}

/// Stresses from pressure and shear.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StressFromAll;

impl Quartets<3> for StressFromAll {
    const LIST: [Quartet; 3] = [Quartet::PressureStress, Quartet::ShearStress, Quartet::ShearTraction];
}

/// Displacements from pressure and shear.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DisplacementFromAll;

impl Quartets<2> for DisplacementFromAll {
    const LIST: [Quartet; 2] = [Quartet::Displacement, Quartet::Rise];
}

/// Displacements of the surface, where pressure moves it along as shear does outward.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceDisplacement;

impl Quartets<1> for SurfaceDisplacement {
    const LIST: [Quartet; 1] = [Quartet::Displacement];
}
