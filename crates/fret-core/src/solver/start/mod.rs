//! What an increment starts from, apart from coarse grids: extrapolated tractions, or those of a contact that grows self-similarly; and the
//! region it starts in. A start changes what a solution costs, never what it is.

mod active_subdomain;
mod extrapolation;
mod self_similar;
