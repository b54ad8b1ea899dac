//! What the computer gives to this process: memory, threads and files, and the limits set on them.

pub mod control_group;
pub mod files;
pub mod memory;
mod process;
pub mod threads;
