//! Runs the command `fret` itself: what it answers, where it writes, how it refuses.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod answered;
mod bench;
mod broken_off;
#[cfg(all(target_arch = "x86_64", target_os = "linux", not(debug_assertions)))]
mod compiled;
mod damaged;
mod explored;
mod heated;
mod hostile;
mod interrupted;
mod leave_out;
mod loops;
mod manners;
mod memory;
mod misleading;
mod moving;
mod options;
mod places;
mod refused;
mod rolled;
mod scars;
mod shown;
mod solved;
mod started;
mod stressed;
mod studied;
mod surfaces;
mod swept;
mod swept_pages;
mod swept_stresses;
mod told;
mod units;
mod unwritten;
