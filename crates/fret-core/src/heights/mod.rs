//! Heights of a surface as arrays of numbers: those of points in any order on a grid (`points`), numbers that instruments write where they
//! measured nothing (`marks`), holes filled (`fill`), waves removed (`gaussian`), from one set of points to another (`resample`).

pub mod fill;
pub mod gaussian;
pub mod marks;
pub mod points;
pub mod resample;
