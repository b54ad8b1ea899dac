//! The instruction sets that the engine is compiled for.

use super::simd::{Lanes, Number};

/// The instruction sets the engine is compiled for.
#[derive(Clone, Copy)]
pub enum InstructionSet {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
    #[cfg(target_arch = "aarch64")]
    Neon(pulp::aarch64::Neon),
}

/// Runs a task on an instruction set, on numbers `$number`.
macro_rules! enter {
    ($set:expr, $number:ty, $task:expr) => {
        match $set {
            InstructionSet::Portable => <$number as Number>::Portable::default().enter($task),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2(set) => <$number as Number>::Avx2::from(set).enter($task),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512(set) => <$number as Number>::Avx512::from(set).enter($task),
            #[cfg(target_arch = "aarch64")]
            InstructionSet::Neon(set) => <$number as Number>::Neon::from(set).enter($task),
        }
    };
}
pub(super) use enter;

impl InstructionSet {
    /// All that this machine has, fastest first.
    pub fn available() -> Vec<Self> {
        let mut available = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            available.extend(pulp::x86::V4::try_new().map(Self::Avx512));
            available.extend(pulp::x86::V3::try_new().map(Self::Avx2));
        }
        #[cfg(target_arch = "aarch64")]
        available.extend(pulp::aarch64::Neon::try_new().map(Self::Neon));
        available.push(Self::Portable);
        available
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable lanes",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => "AVX2 lanes",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => "AVX-512 lanes",
            #[cfg(target_arch = "aarch64")]
            Self::Neon(_) => "NEON lanes",
        }
    }

    /// Numbers in a register.
    pub fn width<N: Number>(self) -> usize {
        match self {
            Self::Portable => N::Portable::WIDTH,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => N::Avx2::WIDTH,
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => N::Avx512::WIDTH,
            #[cfg(target_arch = "aarch64")]
            Self::Neon(_) => N::Neon::WIDTH,
        }
    }
}
