//! What about a case or its answer may mislead: facts with a name, a number, the bound it has crossed, words and a way out. Bounds and
//! words stand here and nowhere else; who finds the numbers is `plausibility`.

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
}

impl Concern {
    /// All of them, in the order of the manual.
    pub const ALL: [Self; 15] = [
        Self::FewCells,
        Self::StifferThanDiamond,
        Self::ContactRadiusOverBodyRadius,
        Self::ApproachOverContactRadius,
        Self::ApproachOverLayerThickness,
        Self::ShiftOverContactRadius,
        Self::SteepTopography,
        Self::CoatingThinnerThanCell,
        Self::WearDepthOverCoatingThickness,
        Self::ComplianceSpread,
        Self::FrictionChangesInOneCycle,
        Self::ContactNearEdge,
        Self::PressingInFewIncrements,
        Self::FewCellsPerWave,
        Self::BulkStrain,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::FewCells => "few_cells",
            Self::StifferThanDiamond => "stiffer_than_diamond",
            Self::ContactRadiusOverBodyRadius => "contact_radius_over_body_radius",
            Self::ApproachOverContactRadius => "approach_over_contact_radius",
            Self::ApproachOverLayerThickness => "approach_over_layer_thickness",
            Self::ShiftOverContactRadius => "shift_over_contact_radius",
            Self::SteepTopography => "steep_topography",
            Self::CoatingThinnerThanCell => "coating_thinner_than_cell",
            Self::WearDepthOverCoatingThickness => "wear_depth_over_coating_thickness",
            Self::ComplianceSpread => "compliance_spread",
            Self::FrictionChangesInOneCycle => "friction_changes_in_one_cycle",
            Self::ContactNearEdge => "contact_near_edge",
            Self::PressingInFewIncrements => "pressing_in_few_increments",
            Self::FewCellsPerWave => "few_cells_per_wave",
            Self::BulkStrain => "bulk_strain",
        }
    }

    /// What the number is.
    pub fn quantity(self) -> &'static str {
        match self {
            Self::FewCells => "cells in the contact radius",
            Self::StifferThanDiamond => {
                "largest Young's modulus, in the declared units, over that of diamond"
            }
            Self::ContactRadiusOverBodyRadius => "contact radius over body radius",
            Self::ApproachOverContactRadius => "approach over contact radius",
            Self::ApproachOverLayerThickness => {
                "approach over the thickness of the layers on their rigid base"
            }
            Self::ShiftOverContactRadius => "shift over contact radius",
            Self::SteepTopography => "root mean square slope of the topography",
            Self::CoatingThinnerThanCell => "coating thickness over the longer side of a cell",
            Self::WearDepthOverCoatingThickness => "wear depth over coating thickness",
            Self::ComplianceSpread => {
                "compliance of the most worn place less that of the least worn, relative"
            }
            Self::FrictionChangesInOneCycle => {
                "change of the friction coefficient of a cell in one cycle over the mean one"
            }
            Self::ContactNearEdge => "open cells between the contact and the edge of the grid",
            Self::PressingInFewIncrements => "cells by which the contact radius grows in an increment",
            Self::FewCellsPerWave => "cells per wave of the profile",
            Self::BulkStrain => "strain of a body by its bulk stress",
        }
    }

    /// Whether small numbers are what is warned of.
    pub fn warns_below(self) -> bool {
        matches!(
            self,
            Self::FewCells | Self::CoatingThinnerThanCell | Self::ContactNearEdge | Self::FewCellsPerWave
        )
    }

    /// Where the bound lies.
    pub fn bound(self) -> f64 {
        match self {
            Self::FewCells => CELLS_IN_RADIUS,
            Self::StifferThanDiamond => 1.0,
            Self::ContactRadiusOverBodyRadius
            | Self::ApproachOverContactRadius
            | Self::ApproachOverLayerThickness
            | Self::BulkStrain => STRAIN,
            Self::ShiftOverContactRadius => SHIFT,
            Self::SteepTopography => SLOPE,
            Self::CoatingThinnerThanCell => COATING_CELLS,
            Self::WearDepthOverCoatingThickness => WORN,
            Self::ComplianceSpread => COMPLIANCE_SPREAD,
            Self::FrictionChangesInOneCycle => FRICTION_CHANGE,
            Self::ContactNearEdge => FREE_CELLS as f64,
            Self::PressingInFewIncrements => RING_CELLS,
            Self::FewCellsPerWave => CELLS_PER_WAVE,
        }
    }

    /// What it means for the numbers.
    pub fn consequence(self) -> &'static str {
        match self {
            Self::FewCells => "the contact is under-resolved; errors may be large",
            Self::StifferThanDiamond => "moduli are in the unit that follows from [units]: MPa for mm and N",
            Self::ContactRadiusOverBodyRadius => {
                "the contact must be small against the bodies; a wrong unit is a common cause"
            }
            Self::ApproachOverContactRadius => {
                "strains must be small; a wrong unit, of a modulus for example, is a common cause"
            }
            Self::ApproachOverLayerThickness => "strains of the layers must be small",
            Self::ShiftOverContactRadius => {
                "opposite surface points are assumed not to move along the surface"
            }
            Self::SteepTopography => "slopes must be small; a wrong unit of the heights is a common cause",
            Self::CoatingThinnerThanCell => "stresses inside the coating will be inaccurate",
            Self::WearDepthOverCoatingThickness => "the elastic response stays that of the unworn coating",
            Self::ComplianceSpread => {
                "the elastic response is that of the mean thickness all over the contact"
            }
            Self::FrictionChangesInOneCycle => "the coefficient is constant within each cycle",
            Self::ContactNearEdge => "the contact edge and area cannot be evaluated there",
            Self::PressingInFewIncrements => "each increment leaves a ring in the shear traction",
            Self::FewCellsPerWave => "the wave is under-resolved: the cells show one of another height",
            Self::BulkStrain => {
                "strains must be small; a wrong unit, of a stress or a modulus, is a common cause"
            }
        }
    }

    /// What to do.
    pub fn help(self) -> &'static str {
        match self {
            Self::FewCells => {
                "more cells or a smaller grid (size = \"auto\" finds it); on a rough surface finer sampling"
            }
            Self::StifferThanDiamond => "check the units of moduli, and [units]",
            Self::ContactRadiusOverBodyRadius
            | Self::ApproachOverContactRadius
            | Self::ApproachOverLayerThickness => {
                "check the units of moduli, lengths and loads; or reduce the load"
            }
            Self::ShiftOverContactRadius => {
                "[kinematics] displacement = \"finite\" moves the surfaces; or check the unit of the shift"
            }
            Self::SteepTopography => "check the unit of the heights and the size of the grid",
            Self::CoatingThinnerThanCell => "more cells or a smaller grid, where such stresses matter",
            Self::WearDepthOverCoatingThickness => "wear.limit = ... ends the run sooner",
            Self::ComplianceSpread => "take it as an error bar on the compliance, or end the run sooner",
            Self::FrictionChangesInOneCycle => {
                "check the unit of friction.evolution.scale or of its table, which are energy by area, a length or cycles"
            }
            Self::ContactNearEdge => "a larger grid",
            Self::PressingInFewIncrements => "more increments, or increments = \"auto\"",
            Self::FewCellsPerWave => "more cells, or a smaller grid with fewer waves",
            Self::BulkStrain => "check the units of bulk stresses and moduli; or reduce the bulk stress",
        }
    }
}

/// A fact that may mislead.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// What it is about.
    pub name: Concern,
    /// The number [-].
    pub value: f64,
    /// The bound it has crossed [-].
    pub bound: f64,
    /// Name of the stage at whose end, or in which, it was met; `None` where it follows from the case alone.
    pub stage: Option<String>,
    /// In words.
    pub message: String,
    /// A way out.
    pub help: String,
}

impl Warning {
    /// The warning of a number, where it has crossed its bound.
    pub fn of(name: Concern, value: f64, stage: Option<String>) -> Option<Self> {
        let bound = name.bound();
        let crossed = if name.warns_below() { value < bound } else { value > bound };
        if !(crossed && value.is_finite()) {
            return None;
        }
        let place = stage.as_ref().map_or(String::new(), |stage| format!(", stage \"{stage}\""));
        let side = if name.warns_below() { "at least" } else { "at most" };
        let message = if name == Concern::CoatingThinnerThanCell {
            format!("the coating is thinner than a cell ({} cells); {}", rounded(value), name.consequence())
        } else {
            format!(
                "{}: {}{place} (should be {side} {}); {}",
                name.quantity(),
                rounded(value),
                rounded(bound),
                name.consequence()
            )
        };
        Some(Self { name, value, bound, stage, message, help: name.help().to_owned() })
    }
}

impl Warning {
    /// The warning of a stage in which the contact radius grows by `growth` cells per increment, more than `limit`; enough
    /// increments, and the ramp that they are meant for, where it is another one.
    pub fn of_pressing(
        [growth, limit]: [f64; 2],
        stage: String,
        (enough, ramp): (usize, Option<&str>),
    ) -> Self {
        let message = format!(
            "stage \"{stage}\": the contact radius grows by {} cells per increment (limit {}), which leaves rings in the shear traction",
            rounded(growth),
            rounded(limit)
        );
        let with = ramp.map_or(String::new(), |ramp| format!(" with ramp = \"{ramp}\""));
        Self {
            name: Concern::PressingInFewIncrements,
            value: growth,
            bound: limit,
            stage: Some(stage),
            message,
            help: format!("use at least {enough} increments{with}, or increments = \"auto\""),
        }
    }
}

/// Three digits.
fn rounded(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let digits = (2 - value.abs().max(1e-3).log10().floor() as i32).clamp(0, 5) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each with its bound, as the pages name them, and whether small numbers are what is warned of.
    const CONCERNS: [(Concern, f64, bool); 15] = [
        (Concern::FewCells, 6.0, true),
        (Concern::StifferThanDiamond, 1.0, false),
        (Concern::ContactRadiusOverBodyRadius, 0.2, false),
        (Concern::ApproachOverContactRadius, 0.2, false),
        (Concern::ApproachOverLayerThickness, 0.2, false),
        (Concern::ShiftOverContactRadius, 0.2, false),
        (Concern::SteepTopography, 0.3, false),
        (Concern::CoatingThinnerThanCell, 1.0, true),
        (Concern::WearDepthOverCoatingThickness, 0.2, false),
        (Concern::ComplianceSpread, 0.1, false),
        (Concern::FrictionChangesInOneCycle, 0.1, false),
        (Concern::ContactNearEdge, 2.0, true),
        (Concern::PressingInFewIncrements, 1.0, false),
        (Concern::FewCellsPerWave, 6.0, true),
        (Concern::BulkStrain, 0.2, false),
    ];

    #[test]
    fn a_warning_is_of_a_number_that_has_crossed_its_bound() {
        for (name, bound, below) in CONCERNS {
            let at = |value: f64| Warning::of(name, value, Some("rub".to_owned()));
            let (within, beyond) = if below { (1.001, 0.999) } else { (0.999, 1.001) };
            assert!(at(bound).is_none() && at(within * bound).is_none(), "{name:?}");
            for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert!(at(none).is_none(), "{name:?} {none}");
            }
            let warning = at(beyond * bound).unwrap();
            assert_eq!((warning.name, warning.value, warning.bound), (name, beyond * bound, bound));
            assert_eq!(warning.stage.as_deref(), Some("rub"));
            let side = if below { "at least" } else { "at most" };
            let own_words = name == Concern::CoatingThinnerThanCell;
            let words = if own_words {
                "thinner than a cell".to_owned()
            } else {
                format!(", stage \"rub\" (should be {side} ")
            };
            assert!(warning.message.contains(&words), "{warning:?}");
            assert!(!Warning::of(name, beyond * bound, None).unwrap().message.contains("stage \""));
            // The name in tables is that of the files.
            assert_eq!(serde_json::to_string(&name).unwrap(), format!("\"{}\"", name.name()));
        }
        assert_eq!(CONCERNS.map(|(name, ..)| name), Concern::ALL);
        let words: std::collections::HashSet<_> =
            CONCERNS.iter().flat_map(|(name, ..)| [name.quantity(), name.consequence()]).collect();
        assert_eq!(words.len(), 30, "every concern has its own words");
        assert!(CONCERNS.iter().all(|(name, ..)| !name.help().is_empty()));
    }

    #[test]
    fn the_words_of_a_warning_are_a_sentence() {
        let warning = Warning::of(Concern::FewCells, 4.567, None).unwrap();
        assert_eq!(
            warning.message,
            "cells in the contact radius: 4.57 (should be at least 6); the contact is under-resolved; errors may be large"
        );
    }

    #[test]
    fn pressing_in_few_increments_is_told_with_enough_of_them() {
        let of = |ramp| Warning::of_pressing([1.642, 1.0], "press".to_owned(), (33, ramp));
        let warning = of(None);
        assert_eq!(
            warning.message,
            "stage \"press\": the contact radius grows by 1.64 cells per increment (limit 1), which leaves rings in the shear traction"
        );
        assert_eq!(warning.help, "use at least 33 increments, or increments = \"auto\"");
        assert_eq!((warning.value, warning.bound), (1.642, 1.0));
        assert_eq!(
            of(Some("cubic")).help,
            "use at least 33 increments with ramp = \"cubic\", or increments = \"auto\""
        );
    }

    #[test]
    fn numbers_have_three_digits() {
        for (value, text) in [
            (0.0, "0"),
            (5.25, "5.25"),
            (-2.5, "-2.5"),
            (0.123_456, "0.123"),
            (0.1, "0.1"),
            (12.3456, "12.3"),
            (123.6, "124"),
            (120.0, "120"),
            (1000.0, "1000"),
            (0.001, "0.001"),
            (0.001_234, "0.00123"),
            (9.99e-4, "9.99e-4"),
            (99_999.0, "99999"),
            (1e5, "1.00e5"),
            (-1.5e7, "-1.50e7"),
        ] {
            assert_eq!(rounded(value), text);
        }
    }
}
