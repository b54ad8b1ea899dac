//! One product of fields with kernels, in free space or periodic, with the memory it works in.

use fret_fft::{Convolution, PeriodicProduct, SingleProduct, Workspace};

/// A planned product and its workspace.
pub(crate) enum Product {
    /// Zero padded: the scene stands alone.
    FreeSpace(Convolution, Workspace),
    /// The scene repeats.
    Periodic(PeriodicProduct, Workspace),
}

impl Product {
    pub fn free_space(convolution: Convolution) -> Self {
        let workspace = convolution.workspace();
        Self::FreeSpace(convolution, workspace)
    }

    pub fn periodic(product: PeriodicProduct) -> Self {
        let workspace = product.workspace();
        Self::Periodic(product, workspace)
    }

    pub fn apply(&mut self, input: &[&[f64]], output: &mut [&mut [f64]]) {
        match self {
            Self::FreeSpace(convolution, workspace) => convolution.apply(workspace, input, output),
            Self::Periodic(product, workspace) => product.apply(workspace, input, output),
        }
    }

    /// The same product in single precision, where there is one.
    pub fn in_single_precision(&self) -> Option<SingleProduct> {
        match self {
            Self::FreeSpace(convolution, _) => convolution.in_single_precision(),
            Self::Periodic(product, _) => product.in_single_precision(),
        }
    }

    pub fn memory_bytes(&self) -> usize {
        match self {
            Self::FreeSpace(convolution, workspace) => convolution.memory_bytes() + workspace.memory_bytes(),
            Self::Periodic(product, workspace) => product.memory_bytes() + workspace.memory_bytes(),
        }
    }
}
