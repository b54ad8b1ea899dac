//! What an increment starts from (`first_tractions`): a pressure from coarser grids, extrapolated tractions, those of a contact that grows
//! self-similarly, or those of the cycle before; and the region it starts in. A start changes what a solution costs, never what it is.

mod active_subdomain;
mod extrapolation;
mod first_tractions;
mod self_similar;
