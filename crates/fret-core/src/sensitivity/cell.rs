//! What a cell in contact can do in a linearised increment, and how rigid motions move it.

/// Rigid motions: approach, tilt along x and y, shift along x and y, twist; rotations times the length of the positions.
pub(super) const MOTIONS: usize = 6;

/// What the shear of a cell in contact can do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shear {
    /// Both components are unknown: it sticks.
    Held,
    /// That along one axis is unknown: it sticks, and shear acts along that axis alone.
    HeldAlong(usize),
    /// It follows the pressure along its direction, and turns.
    Turns {
        /// Row r, whose product with a change of slip is that of the slip at the end across the shear.
        row: [f64; 2],
        /// Slip compliance D [length/pressure].
        compliance: f64,
    },
    /// It follows the pressure along its direction.
    Follows,
}

/// What a cell in contact does.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub shear: Shear,
    /// Direction of the shear of a cell that slips.
    pub along: [f64; 2],
    /// Derivative of the friction bound by the pressure [-]; 0 of a cell that sticks.
    pub slope: f64,
    /// Place along x and y over the length of the positions.
    pub place: [f64; 2],
}

impl Cell {
    /// Direction across the shear.
    pub fn across(&self) -> [f64; 2] {
        [-self.along[1], self.along[0]]
    }

    /// The row of a cell whose shear turns.
    pub fn row(&self) -> Option<[f64; 2]> {
        if let Shear::Turns { row, .. } = self.shear { Some(row) } else { None }
    }
}

/// What is prescribed of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Prescribed {
    /// The motion, or there is none.
    Motion,
    /// Its resultant.
    Resultant,
    /// The far end of a spring, which gives so much by a unit of the summed traction [length/pressure].
    FarEnd(f64),
}
