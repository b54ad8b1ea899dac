//! What the computer gives to this process: memory and threads, and the limits set on both.

pub mod control_group;
pub mod memory;
mod process;
pub mod threads;
