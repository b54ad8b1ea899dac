//! What the whole promises, judged by what this code did not compute: closed forms, independent tables, symmetry,
//! conservation, limits. Each tolerance says where it comes from.

mod analytic_limits;
mod coated_limits;
mod coupled_friction;
mod fretting_cycles;
mod invariants;
mod sliding;
