//! A contact to play with: a page on this machine whose sliders solve the case again while they are dragged.
//!
//! From the ground: `sliders` (which numbers of a case can be dragged, and how far), `written` (its text with other numbers), `question` (the case with the numbers of the sliders,
//! on a coarse grid), `stress` (the section below the contact), `view` (what is drawn and told of a solution), `answer` (who solves it again and again), `page` (the page itself),
//! `server` (who is answered, and the newest question first).

mod answer;
mod page;
mod question;
mod server;
mod sliders;
mod stress;
mod view;
mod written;

pub use answer::Solver;
pub use question::Question;
pub use server::Server;
