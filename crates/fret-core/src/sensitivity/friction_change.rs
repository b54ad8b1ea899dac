//! How friction changes: everywhere at once, and where it evolves from cell to cell.

/// Changes of the friction coefficient [-] and of the shear strength of the interface [pressure]; or how an objective changes with them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct FrictionChange {
    /// Of coefficient and strength everywhere; of the strength alone where there are cells.
    pub everywhere: [f64; 2],
    /// Of the coefficient in each cell of the region, where friction evolves; else none.
    pub cells: Vec<f64>,
}

impl FrictionChange {
    /// None, of friction that evolves in so many cells.
    pub fn none(cells: usize) -> Self {
        Self { everywhere: [0.0; 2], cells: vec![0.0; cells] }
    }

    /// Of coefficient and strength in a cell.
    pub fn at(&self, cell: usize) -> [f64; 2] {
        let [coefficient, strength] = self.everywhere;
        [self.cells.get(cell).copied().unwrap_or(coefficient), strength]
    }

    /// Backwards: adds what those of a cell count.
    pub fn add(&mut self, cell: usize, [coefficient, strength]: [f64; 2]) {
        *self.cells.get_mut(cell).unwrap_or(&mut self.everywhere[0]) += coefficient;
        self.everywhere[1] += strength;
    }

    /// Whether nothing changes.
    pub fn is_none(&self) -> bool {
        self.everywhere.iter().chain(&self.cells).all(|change| *change == 0.0)
    }
}
