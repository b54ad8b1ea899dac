//! The lane engine: both products with SIMD lanes across lines, never inside one transform.
//!
//! Lines are transformed [`Lanes::WIDTH`](simd::Lanes::WIDTH) at a time, so that SIMD code is one vector operation per
//! scalar one. Frequencies stay in the order in which they come out; kernels are stored in that order. Per strip of
//! columns, forward transform, kernels and inverse transform are done in cache. From the ground: `simd`, `vectors`, `x86`,
//! `neon` and `butterfly` (arithmetic), `plan` (tables), `passes` (one line transform), `row_groups`, `rows`, `paired_rows`, `columns`,
//! `mirrored_kernels` and `mirrored_columns` (the stages of a product), `cross_columns` (cross spectra), `spectrum` (kernels in the order of the engine), `reflection` (what mirrors change), `product` (the whole).

#![expect(clippy::needless_range_loop, reason = "an index runs over several arrays of lanes at once")]

mod butterfly;
mod columns;
mod cross_columns;
mod instruction_set;
mod memory;
mod mirrored_columns;
mod mirrored_kernels;
#[cfg(target_arch = "aarch64")]
mod neon;
mod paired_rows;
mod passes;
mod plan;
mod product;
mod reflection;
mod row_groups;
mod rows;
mod simd;
mod spectrum;
mod threads;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod vectors;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(super) use instruction_set::InstructionSet;
pub(super) use memory::AlignedNumbers;
pub(super) use product::LaneProduct;
pub(super) use threads::pieces;
