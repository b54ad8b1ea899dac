//! One product of fields with kernels, in free space or periodic; and the memory that products work in, one after the other.

use std::sync::{Arc, Mutex, PoisonError};

use fret_fft::{Convolution, PeriodicProduct, SingleProduct, Workspace};

/// A planned product.
pub(crate) enum Product {
    /// Zero padded: the scene stands alone.
    FreeSpace(Convolution),
    /// The scene repeats.
    Periodic(PeriodicProduct),
}

/// Memory that the products of a solver work in, one at a time.
#[derive(Clone, Default)]
pub struct SharedWorkspace(Arc<Mutex<Workspace>>);

impl SharedWorkspace {
    /// Lends the memory to a product. What it held before is nobody's, so that it may be left in any state.
    pub fn lend<T>(&self, to: impl FnOnce(&mut Workspace) -> T) -> T {
        to(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Memory held [bytes].
    pub fn memory_bytes(&self) -> usize {
        self.lend(|workspace| workspace.memory_bytes())
    }
}

impl Product {
    pub fn apply(&self, workspace: &SharedWorkspace, input: &[&[f64]], output: &mut [&mut [f64]]) {
        workspace.lend(|workspace| match self {
            Self::FreeSpace(convolution) => convolution.apply(workspace, input, output),
            Self::Periodic(product) => product.apply(workspace, input, output),
        });
    }

    /// The same product in single precision, where there is one.
    pub fn in_single_precision(&self) -> Option<SingleProduct> {
        match self {
            Self::FreeSpace(convolution) => convolution.in_single_precision(),
            Self::Periodic(product) => product.in_single_precision(),
        }
    }

    pub fn memory_bytes(&self) -> usize {
        match self {
            Self::FreeSpace(convolution) => convolution.memory_bytes(),
            Self::Periodic(product) => product.memory_bytes(),
        }
    }
}
