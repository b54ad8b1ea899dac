//! What lies beyond the first and the last cell of an axis.

/// What lies beyond the first and the last cell of an axis, for what is read off several cells in a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Nothing that is known.
    Open,
    /// Images of the first cells; beyond the last one nothing that is known.
    Mirror,
    /// Images at both ends: half of a period.
    Mirrors,
    /// The cells of the other end: a period.
    Period,
}

impl Ends {
    /// Those of an axis whose first cell lies at a mirror, and which repeats.
    pub fn of(mirrored: bool, repeats: bool) -> Self {
        match (mirrored, repeats) {
            (false, false) => Self::Open,
            (true, false) => Self::Mirror,
            (true, true) => Self::Mirrors,
            (false, true) => Self::Period,
        }
    }

    /// Whether the first cell lies at a mirror, and whether the last one does.
    pub fn mirrored(self) -> [bool; 2] {
        [matches!(self, Self::Mirror | Self::Mirrors), self == Self::Mirrors]
    }

    /// A cell and its neighbours before and after; where nothing is known, and at a mirror, an outermost cell is its own neighbour.
    pub fn around(self, cell: usize, cells: usize) -> [usize; 3] {
        let last = cells - 1;
        let (before, after) = if self == Self::Period { (last, 0) } else { (0, last) };
        [cell.checked_sub(1).unwrap_or(before), cell, if cell < last { cell + 1 } else { after }]
    }

    /// Four neighbours each that reach over an end. Together with those inside they are all of a period, and half of those of a whole that is
    /// mirrored (apart from the ones that are their own images).
    pub fn fours(self, cells: usize) -> Vec<[usize; 4]> {
        let Some(third_last) = cells.checked_sub(3) else { return Vec::new() };
        let (a, b, c) = (third_last, third_last + 1, third_last + 2);
        match self {
            Self::Open => Vec::new(),
            Self::Mirror => vec![[0, 0, 1, 2]],
            Self::Mirrors => vec![[0, 0, 1, 2], [a, b, c, c]],
            Self::Period => vec![[a, b, c, 0], [b, c, 0, 1], [c, 0, 1, 2]],
        }
    }
}
