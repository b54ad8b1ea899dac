//! What a warning may be about: each concern is a row with its number, its bound, its words and its way out. Bounds and words stand here and
//! nowhere else.

use serde::{Deserialize, Serialize};

pub use crate::case::CELLS_PER_WAVE;

/// Fewest cells in the contact radius. Frictionless Hertz contacts of 2 to 5 cells err by up to 15, 2, 4, 1 % in the largest
/// pressure, and their error bars miss one time in three; from 6 cells on the error is below a percent and bars hold (measured on
/// a scan of radii in `tests/error_bars.rs`).
pub const CELLS_IN_RADIUS: f64 = 6.0;
/// Approach over contact radius, which for a sphere is contact radius over body radius: the slope of the surfaces at the rim, and
/// about their strain. At a fifth a parabola is 1 % off the sphere it stands for, and linear elasticity as far off as the strain.
pub const STRAIN: f64 = 0.2;
/// Relative tangential displacement over contact radius. The profile stays where it is: with a shift of a fifth of the radius the
/// points that face each other at the rim have moved by a tenth of the contact's width.
pub const SHIFT: f64 = 0.2;
/// Root mean square slope of topography. Half-spaces know small slopes: at 0.3 sine and tangent differ by 4 %.
pub const SLOPE: f64 = 0.3;
/// Coating thickness over the longer side of a cell. Tractions are uniform over a cell; half a cell deep, in the middle of such a
/// coating, stresses are within a percent of those of smooth tractions, nearer to the surface they show the cells.
pub const COATING_CELLS: f64 = 1.0;
/// Wear depth over coating thickness. The elastic response stays that of the unworn stack; what a fifth less coating would change
/// is a fifth of what the coating does.
pub const WORN: f64 = 0.2;
/// Open cells between contact and the edge of the grid: the edge of contact is read from two open cells beside it.
pub const FREE_CELLS: usize = 2;
/// Cells by which the contact radius may grow in one increment while pressure and shear act on each other. Each increment leaves a
/// ring in the shear. Rings of a cell and less are below what the grid shows; at 2.5 cells they are teeth of 4 % of the peak.
pub const RING_CELLS: f64 = 1.0;
/// The same as a fraction of the largest contact radius, on grids that show such rings. The energy of later cycles in partial slip is
/// off by up to 8 % after 4 increments of even growth, 4 % after 6, 1 % after 12, 0.6 % after 16 (examples of this project, and a rigid
/// sphere on a substrate half as stiff as its coating).
pub const RING_FRACTION: f64 = 1.0 / 16.0;
/// Largest shear over friction coefficient and largest pressure from which on such rings matter. Where pressing brings less, it slips at
/// the very rim alone: between 10 and 64 increments the energy of later cycles changes by at most 0.05 %.
pub const RING_SHEAR: f64 = 0.2;

/// Distance that a contact slides over a body in one increment, over its length along the way. Wear, and friction that evolves, see it at both ends
/// of the increment: after one cycle in gross slip the depth of a cell is off by up to 5 % of the largest at an eighth, 7 % at a sixth, 13 % at a
/// quarter, 36 % at a half, the largest depth by 2, 3, 6, 16 % (trapezoids of Hertz' pressure); later, when the surfaces have worn in, by about half
/// of it.
pub const STRIDE: f64 = 1.0 / 6.0;
/// Distance that it rolls in one increment, in the same way. Of a cylinder that rolls back and forth by six tenths of its contact under half the
/// friction that it can have, the wear depth of a cell is off by 4 % of the largest at 0.075, by 7 % here and 17 % at a fifth, the energy of a cycle
/// by 0.4, 1.4 and 6 %.
pub const ROLLED: f64 = 0.1;

/// Change of the friction coefficient of a cell in a single cycle over the mean one. Within a cycle it is constant; a tenth more friction
/// in the next one is a tenth more dissipated energy.
pub const FRICTION_CHANGE: f64 = 0.1;

/// Compliance of the most worn place of a contact less that of the least worn, over that of the mean. The response is one for the whole
/// contact; half of this is about its error at the ends.
pub const COMPLIANCE_SPREAD: f64 = 0.1;

/// Young's modulus of diamond in its stiffest direction, 1.21e12 Pa by the elastic constants of `McSkimin` and Andreatch (1972), J. Appl.
/// Phys. 43, 2944, rounded up: no coating and no body is stiffer.
pub const STIFFEST: f64 = 1.25e12;

/// What a warning is about; its name in files is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Concern {
    /// The contact radius is a few cells.
    FewCells,
    /// A body is stiffer than anything in the declared units.
    StifferThanDiamond,
    /// The contact radius is not small against the body's.
    ContactRadiusOverBodyRadius,
    /// The approach is not small against the contact.
    ApproachOverContactRadius,
    /// The approach is not small against the layers on a rigid base.
    ApproachOverLayerThickness,
    /// The shift is not small against the contact.
    ShiftOverContactRadius,
    /// Topography is steep.
    SteepTopography,
    /// A coating is thinner than a cell is long.
    CoatingThinnerThanCell,
    /// Wear has taken a good part of the coating.
    WearDepthOverCoatingThickness,
    /// Thickness of layers differs over the contact.
    ComplianceSpread,
    /// Friction changes much from one cycle to the next.
    FrictionChangesInOneCycle,
    /// The contact comes close to the edge of the grid.
    ContactNearEdge,
    /// Increments of pressing are too large for the cells.
    PressingInFewIncrements,
    /// A wave of the profile is a few cells long.
    FewCellsPerWave,
    /// Bulk stresses strain a body much.
    BulkStrain,
    /// A contact slides far in an increment.
    MovingInFewIncrements,
    /// A contact rolls far in an increment.
    RollingInFewIncrements,
}

/// All that is said of a concern.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Row {
    /// What it is about.
    #[serde(skip)]
    pub concern: Concern,
    /// Its name in files.
    pub name: &'static str,
    /// What the number is.
    pub quantity: &'static str,
    /// Where the bound lies.
    pub bound: f64,
    /// Whether small numbers are what is warned of.
    pub warns_below: bool,
    /// What it means for the numbers.
    pub consequence: &'static str,
    /// What to do.
    pub help: &'static str,
}

impl Row {
    /// The words that its message begins with, after the stage where that is named first.
    pub fn begins(&self) -> &'static str {
        match self.concern {
            Concern::CoatingThinnerThanCell => "the coating is thinner than a cell",
            Concern::PressingInFewIncrements => "the contact radius grows by",
            _ => self.quantity,
        }
    }
}

/// What is said of each, in the order of the manual.
pub const ROWS: [Row; 17] = [
    Row {
        concern: Concern::FewCells,
        name: "few_cells",
        quantity: "cells in the contact radius",
        bound: CELLS_IN_RADIUS,
        warns_below: true,
        consequence: "the contact is under-resolved; errors may be large",
        help: "more cells or a smaller grid (size = \"auto\" finds it); on a rough surface finer sampling",
    },
    Row {
        concern: Concern::StifferThanDiamond,
        name: "stiffer_than_diamond",
        quantity: "largest Young's modulus, in the declared units, over that of diamond",
        bound: 1.0,
        warns_below: false,
        consequence: "moduli are in the unit that follows from [units]: MPa for mm and N",
        help: "check the units of moduli, and [units]",
    },
    Row {
        concern: Concern::ContactRadiusOverBodyRadius,
        name: "contact_radius_over_body_radius",
        quantity: "contact radius over body radius",
        bound: STRAIN,
        warns_below: false,
        consequence: "the contact must be small against the bodies; a wrong unit is a common cause",
        help: "check the units of moduli, lengths and loads; or reduce the load",
    },
    Row {
        concern: Concern::ApproachOverContactRadius,
        name: "approach_over_contact_radius",
        quantity: "approach over contact radius",
        bound: STRAIN,
        warns_below: false,
        consequence: "strains must be small; a wrong unit, of a modulus for example, is a common cause",
        help: "check the units of moduli, lengths and loads; or reduce the load",
    },
    Row {
        concern: Concern::ApproachOverLayerThickness,
        name: "approach_over_layer_thickness",
        quantity: "approach over the thickness of the layers on their rigid base",
        bound: STRAIN,
        warns_below: false,
        consequence: "strains of the layers must be small",
        help: "check the units of moduli, lengths and loads; or reduce the load",
    },
    Row {
        concern: Concern::ShiftOverContactRadius,
        name: "shift_over_contact_radius",
        quantity: "shift over contact radius",
        bound: SHIFT,
        warns_below: false,
        consequence: "opposite surface points are assumed not to move along the surface",
        help: "[kinematics] displacement = \"finite\" moves the surfaces; or check the unit of the shift",
    },
    Row {
        concern: Concern::SteepTopography,
        name: "steep_topography",
        quantity: "root mean square slope of the topography",
        bound: SLOPE,
        warns_below: false,
        consequence: "slopes must be small; a wrong unit of the heights is a common cause",
        help: "check the unit of the heights and the size of the grid",
    },
    Row {
        concern: Concern::CoatingThinnerThanCell,
        name: "coating_thinner_than_cell",
        quantity: "coating thickness over the longer side of a cell",
        bound: COATING_CELLS,
        warns_below: true,
        consequence: "stresses inside the coating will be inaccurate",
        help: "more cells or a smaller grid, where such stresses matter",
    },
    Row {
        concern: Concern::WearDepthOverCoatingThickness,
        name: "wear_depth_over_coating_thickness",
        quantity: "wear depth over coating thickness",
        bound: WORN,
        warns_below: false,
        consequence: "the elastic response stays that of the unworn coating",
        help: "wear.limit = ... ends the run sooner",
    },
    Row {
        concern: Concern::ComplianceSpread,
        name: "compliance_spread",
        quantity: "compliance of the most worn place less that of the least worn, relative",
        bound: COMPLIANCE_SPREAD,
        warns_below: false,
        consequence: "the elastic response is that of the mean thickness all over the contact",
        help: "take it as an error bar on the compliance, or end the run sooner",
    },
    Row {
        concern: Concern::FrictionChangesInOneCycle,
        name: "friction_changes_in_one_cycle",
        quantity: "change of the friction coefficient of a cell in one cycle over the mean one",
        bound: FRICTION_CHANGE,
        warns_below: false,
        consequence: "the coefficient is constant within each cycle",
        help: "check the unit of friction.evolution.scale or of its table, which are energy by area, a length or cycles",
    },
    Row {
        concern: Concern::ContactNearEdge,
        name: "contact_near_edge",
        quantity: "open cells between the contact and the edge of the grid",
        bound: FREE_CELLS as f64,
        warns_below: true,
        consequence: "the contact edge and area cannot be evaluated there",
        help: "a larger grid",
    },
    Row {
        concern: Concern::PressingInFewIncrements,
        name: "pressing_in_few_increments",
        quantity: "cells by which the contact radius grows in an increment, or sixteenths of the radius where these are longer",
        bound: RING_CELLS,
        warns_below: false,
        consequence: "each increment leaves a ring in the shear traction",
        help: "more increments, or increments = \"auto\"",
    },
    Row {
        concern: Concern::FewCellsPerWave,
        name: "few_cells_per_wave",
        quantity: "cells per wave of the profile",
        bound: CELLS_PER_WAVE,
        warns_below: true,
        consequence: "the wave is under-resolved: the cells show one of another height",
        help: "more cells, or a smaller grid with fewer waves",
    },
    Row {
        concern: Concern::BulkStrain,
        name: "bulk_strain",
        quantity: "strain of a body by its bulk stress",
        bound: STRAIN,
        warns_below: false,
        consequence: "strains must be small; a wrong unit, of a stress or a modulus, is a common cause",
        help: "check the units of bulk stresses and moduli; or reduce the bulk stress",
    },
    Row {
        concern: Concern::MovingInFewIncrements,
        name: "moving_in_few_increments",
        quantity: "distance that the contact slides in an increment over its length along the way",
        bound: STRIDE,
        warns_below: false,
        consequence: "what slip leaves behind, wear for example, shows the increments",
        help: "more increments",
    },
    Row {
        concern: Concern::RollingInFewIncrements,
        name: "rolling_in_few_increments",
        quantity: "distance that the contact rolls in an increment over its length along the way",
        bound: ROLLED,
        warns_below: false,
        consequence: "slip and dissipated energy are off",
        help: "more increments",
    },
];

impl Concern {
    /// What is said of it.
    pub fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }
}
