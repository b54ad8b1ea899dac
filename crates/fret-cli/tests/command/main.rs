//! Runs the command `fret` itself: what it answers, where it writes, how it refuses.

mod answered;
mod bench;
mod refused;
mod solved;
mod unwritten;
