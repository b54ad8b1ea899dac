//! How surfaces move against each other: stay where they are, whatever the shift, or move with their bodies.

use std::f64::consts::FRAC_PI_2;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::dimension::Dimension;
use super::grid::SurfaceGrid;
use crate::document::Table;
use crate::fields::{InPlane, Outside};

/// How far the surfaces are taken to move.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "DisplacementFile")]
pub enum Displacement {
    /// Opposite points of the surfaces stay opposite: for a displacement that is small against the contact.
    #[default]
    Small,
    /// The surface of the upper body moves with it by its shift and its twist: profile, topography, wear. Each body wears in its own frame.
    Finite,
}

/// Where the grid is while a contact rolls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "FrameFile")]
pub enum Frame {
    /// Fixed to the bodies: the contact travels through it.
    #[default]
    Bodies,
    /// With the contact, by whole cells: the bodies travel through it.
    Contact,
}

/// What lies beyond the maps of heights and friction, which are as long as the grid, where a contact rolls off them with its grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "BeyondMapsFile")]
pub enum BeyondMaps {
    /// What is at their edges continues: for a dent in a flat.
    Edge,
    /// They begin anew: for maps that are periodic.
    Repeats,
    /// They begin anew, mirrored at their edges: for a measured surface.
    Mirrors,
}

impl BeyondMaps {
    /// The same of a field.
    pub fn outside(self) -> Outside {
        match self {
            Self::Edge => Outside::Edge,
            Self::Repeats => Outside::Repeats,
            Self::Mirrors => Outside::Mirrors,
        }
    }
}

/// How the surfaces of a case move.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Kinematics {
    /// How far they are taken to move.
    pub displacement: Displacement,
    /// Whether a friction map is the upper body's, and moves with it.
    pub friction_of_upper: bool,
    /// Where the grid is while the contact rolls.
    #[serde(default)]
    pub frame: Frame,
    /// What lies beyond maps that travel through the grid; `None` where none does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beyond_maps: Option<BeyondMaps>,
}

impl Kinematics {
    /// Whether the surfaces stay where they are.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Whether the upper body's surface moves with it.
    pub fn is_finite(&self) -> bool {
        self.displacement == Displacement::Finite
    }
}

/// Steps to which positions of surfaces are rounded, in a cell.
const STEPS: f64 = 100.0;
/// A position half between two steps goes outward, whatever rounding has made of its last digits.
const TIE: f64 = 1e-6;

/// Where the upper surface lies over the grid, which is fixed to the lower body.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Place {
    /// Cells along each axis from where it lies without a shift.
    pub cells: [f64; 2],
    /// Angle about its own middle, from x to y [rad].
    pub turned: f64,
}

impl Place {
    /// Shifted and not turned.
    pub fn shifted(cells: [f64; 2]) -> Self {
        Self { cells, turned: 0.0 }
    }
}

/// How the upper surface moves over the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    spacing: [f64; 2],
    /// Half of the diagonal of the grid, in the shorter side of a cell.
    rim: f64,
    dimension: Dimension,
}

impl Motion {
    /// On a grid.
    pub fn over(grid: &SurfaceGrid) -> Self {
        let ([width, depth], [dx, dy]) = (grid.size(), grid.spacing());
        Self {
            spacing: grid.spacing(),
            rim: 0.5 * width.hypot(depth) / dx.min(dy),
            dimension: grid.dimension(),
        }
    }

    /// Where the upper surface lies after a shift [length]: cells along each axis, rounded to a hundredth of a cell, and less than one is none.
    /// Along a line contact nothing moves.
    pub fn cells(&self, shift: [f64; 2]) -> [f64; 2] {
        let rounded = |axis: usize| {
            let steps = shift[axis] / self.spacing[axis] * STEPS;
            let steps = steps + TIE * steps.signum();
            if steps.abs() < 1.0 { 0.0 } else { steps.round() / STEPS }
        };
        self.dimension.along(rounded, 0.0)
    }

    /// A rotation; that which moves every cell by less than a hundredth of one is none, or one by right angles.
    fn angle(&self, twist: f64) -> f64 {
        let right = FRAC_PI_2 * (twist / FRAC_PI_2).round();
        if (twist - right).abs() * self.rim * STEPS < 1.0 { right } else { twist }
    }

    /// Where the upper surface lies after a shift [length] and a twist [rad].
    pub fn place(&self, shift: [f64; 2], twist: f64) -> Place {
        Place { cells: self.cells(shift), turned: self.angle(twist) }
    }

    /// How far what is on the grid lies apart in two places, in cells, at the most: along an axis by the shift, and by the turn.
    pub fn apart(&self, [one, other]: [Place; 2]) -> [f64; 2] {
        let off = [0, 1].map(|axis| (other.cells[axis] - one.cells[axis]).abs());
        [off[0].max(off[1]), (other.turned - one.turned).abs() * self.rim]
    }

    /// What brings the upper surface from one place to another.
    pub fn between(&self, from: Place, to: Place) -> InPlane {
        InPlane {
            turned: to.turned - from.turned,
            pole: from.cells,
            by: [0, 1].map(|axis| to.cells[axis] - from.cells[axis]),
            aspect: self.spacing[1] / self.spacing[0],
        }
    }

    /// What brings it to a place from where it lies without a shift.
    pub fn over_grid(&self, place: Place) -> InPlane {
        self.between(Place::default(), place)
    }

    /// What brings it back there.
    pub fn back_from(&self, place: Place) -> InPlane {
        self.between(place, Place::default())
    }

    /// Whether a motion is less than a hundredth of a cell.
    pub fn is_none(&self, shift: [f64; 2]) -> bool {
        self.cells(shift) == [0.0; 2]
    }
}

/// Cells along an axis that a step in a direction goes at the most.
pub const MOST_CELLS: usize = 3;
/// So much of a cell is rounding of lengths.
const ROUNDING: f64 = 1e-6;

/// Cells along each axis of the shortest step that goes by whole ones in a direction, on cells of a spacing; `None` where none is short.
pub fn step_towards(direction: [f64; 2], spacing: [f64; 2]) -> Option<[isize; 2]> {
    let cells = [0, 1].map(|axis| direction[axis] / spacing[axis]);
    let most = cells[0].abs().max(cells[1].abs());
    let is_whole = |step: &[f64; 2]| step.iter().all(|cells| (cells - cells.round()).abs() < ROUNDING);
    let step = (1..=MOST_CELLS).map(|all| cells.map(|cells| cells / most * all as f64)).find(is_whole)?;
    Some(step.map(|cells| cells.round() as isize))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_go_by_whole_cells() {
        for (direction, spacing, step) in [
            ([1.0, 0.0], [0.1, 0.3], Some([1, 0])),
            ([0.0, -7.0], [0.1, 0.3], Some([0, -1])),
            ([-1.0, 1.0], [0.1, 0.1], Some([-1, 1])),
            ([1.0, 1.0], [0.1, 0.3], Some([3, 1])),
            ([0.2, 0.3], [0.1, 0.1], Some([2, 3])),
            ([1.0, 0.25], [0.1, 0.1], None),
            ([1.0, 1e-3], [0.1, 0.1], None),
        ] {
            assert_eq!(step_towards(direction, spacing), step, "{direction:?} {spacing:?}");
        }
    }

    #[test]
    fn positions_are_hundredths_of_a_cell() {
        let motion = Motion::over(&SurfaceGrid::new([8, 8], [0.1, 0.3]).unwrap());
        assert_eq!(motion.cells([0.3, -0.6]), [3.0, -2.0]);
        assert_eq!(motion.cells([0.0346, 0.001]), [0.35, 0.0]);
        // An eighth of a cell, however it came about.
        for eighth in [0.0125, 0.0125 + 2e-18, 0.0125 - 2e-18, (0.3 + 0.0125) - 0.3] {
            assert_eq!(motion.cells([eighth, -3.0 * eighth]), [0.13, -0.13]);
        }
        assert!(motion.is_none([9.9e-4, -2.9e-3]) && !motion.is_none([1e-3, 0.0]));
        assert_eq!(motion.cells([1.4e-3, -1.6e-3 * 3.0]), [0.01, -0.02]);
        let line = Motion::over(&SurfaceGrid::line(8, 0.1).unwrap());
        assert_eq!(line.cells([0.1, 0.1]), [1.0, 0.0]);
    }
}
