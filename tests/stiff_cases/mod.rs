//! Stiff and extreme cases, family by family: each is solved and judged by what must hold whatever the numbers.

mod balance;
mod bodies;
mod families;
mod judgement;
mod operator;
mod page;
mod scene;
mod twin;

pub use families::families;
pub use judgement::{Row, row};
pub use page::page;
