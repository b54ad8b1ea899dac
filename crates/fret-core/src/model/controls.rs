//! What can be prescribed: one row for each control, with its names, units and degrees of freedom. Cases, tables of loads and the
//! continuation of a history go through this table.

use std::ops::Range;

/// Degrees of freedom: normal, tangential along x and y, about z, tilt along x and y, bulk stress of the lower and of the upper body
/// along x and y, roll along x and y.
pub const FREEDOMS: usize = 12;

/// No load or motion is larger, in any unit: products of two of them, and sums of these, are finite.
pub const LARGEST: f64 = 1e100;

/// The normal degree of freedom.
pub const NORMAL: usize = 0;
/// The first of the tangential ones.
pub const TANGENTIAL: usize = 1;
/// Rotation about z.
pub const TWIST: usize = 3;
/// The first of the tilts.
pub const TILT: usize = 4;
/// The first of the bulk stresses of the lower body.
pub const BULK_STRESS: usize = 6;
/// The first of those of the upper body.
pub const UPPER_BULK_STRESS: usize = 8;
/// The first of the rolls.
pub const ROLL: usize = 10;

/// Which quantity of a degree of freedom is prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The resultant, a moment or a stress.
    Force,
    /// The motion of the body.
    Motion,
    /// The motion of the far end of the machine's spring.
    FarEnd,
    /// The mean gap between surfaces that repeat; less it is the motion, counted from the mean of the undeformed gap.
    MeanGap,
    /// The motion of the body by distance rolled.
    Rate,
}

/// What a case writes for a control.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A number.
    Number,
    /// Two, along x and y.
    Pair,
    /// Two, along x and y; a number in a line contact.
    PairOrNumber,
    /// The same, or the word "steady".
    PairNumberOrSteady,
}

/// One way to prescribe a control.
#[derive(Debug, Clone, Copy)]
pub struct Way {
    /// Which quantity it is.
    pub kind: Kind,
    /// Its key; in tables and in histories with `_x` and `_y` where it has two axes.
    pub name: &'static str,
    /// Kind of quantity in a point contact, for units.
    pub unit: &'static str,
    /// Description of the key.
    pub about: &'static str,
    /// Description of the key in `phase`.
    pub phase: &'static str,
}

/// A control: ways to prescribe one thing, of which a stage takes one along each axis.
#[derive(Debug)]
pub struct ControlRow {
    /// The first of its degrees of freedom, in the order of [`FREEDOMS`].
    pub freedom: usize,
    /// What a case writes.
    pub form: Form,
    /// Its ways, the force first where there is one.
    pub ways: &'static [Way],
}

impl ControlRow {
    /// Its degrees of freedom.
    pub fn freedoms(&self) -> Range<usize> {
        self.freedom..self.freedom + if self.form == Form::Number { 1 } else { 2 }
    }

    /// Its columns for one way: name and degree of freedom.
    pub fn columns(&self, way: &Way) -> impl Iterator<Item = (String, usize)> {
        let ends: &[&str] = if self.form == Form::Number { &[""] } else { &["_x", "_y"] };
        self.freedoms()
            .zip(ends)
            .map(move |(freedom, end)| (format!("{}{end}", way.name), freedom))
            .collect::<Vec<_>>()
            .into_iter()
    }
}

/// All ways to prescribe a control, each with its row.
pub fn ways() -> impl Iterator<Item = (&'static ControlRow, &'static Way)> {
    CONTROLS.iter().flat_map(|row| row.ways.iter().map(move |way| (row, way)))
}

/// A column that can hold a control, as those of `history.csv` are called.
#[derive(Debug, Clone)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The control.
    pub way: &'static Way,
    /// Its degree of freedom.
    pub freedom: usize,
}

/// All of them.
pub fn columns() -> Vec<Column> {
    let of_way = |(row, way): (&'static ControlRow, &'static Way)| {
        row.columns(way).map(move |(name, freedom)| Column { name, way, freedom })
    };
    ways().flat_map(of_way).collect()
}

use Kind::{FarEnd, Force, MeanGap, Motion, Rate};

/// All controls.
pub static CONTROLS: [ControlRow; 7] = [
    ControlRow {
        freedom: NORMAL,
        form: Form::Number,
        ways: &[
            Way {
                kind: Force,
                name: "normal_force",
                unit: "force",
                about: "Normal force [force], compression positive: at the end of the stage, or the amplitude of its cycles.",
                phase: "Of the normal force.",
            },
            Way {
                kind: Motion,
                name: "approach",
                unit: "length",
                about: "Rigid approach [length]: at the end of the stage, or the amplitude.",
                phase: "Of the approach.",
            },
            Way {
                kind: FarEnd,
                name: "actuator_approach",
                unit: "length",
                about: "Normal displacement of the actuator [length]: approach + normal force / stiffness; at the end, or the amplitude.",
                phase: "Of the actuator along z.",
            },
            Way {
                kind: MeanGap,
                name: "mean_gap",
                unit: "length",
                about: "Mean gap between the surfaces [length], of periodic half-spaces, which have no approach: at the end of the stage, or the\namplitude.",
                phase: "Of the mean gap.",
            },
        ],
    },
    ControlRow {
        freedom: TANGENTIAL,
        form: Form::Pair,
        ways: &[
            Way {
                kind: Force,
                name: "tangential_force",
                unit: "force",
                about: "Tangential force along x and y [force]: at the end, or the amplitude; \"held\" where this stage does not prescribe it.",
                phase: "Of the tangential force along x and y.",
            },
            Way {
                kind: Motion,
                name: "shift",
                unit: "length",
                about: "Rigid tangential displacement of the upper body along x and y [length]: at the end, or the amplitude; or \"held\".",
                phase: "Of the shift along x and y.",
            },
            Way {
                kind: FarEnd,
                name: "actuator",
                unit: "length",
                about: "Displacement of the actuator along x and y [length], the far end of the machine's spring ([rig]): shift + tangential force /\nstiffness; at the end, or the amplitude; or \"held\".",
                phase: "Of the actuator along x and y.",
            },
            Way {
                kind: Rate,
                name: "creepage",
                unit: "-",
                about: "Creepage along x and y [-]: rigid displacement of the upper body by distance rolled, the same all along the stage, which has\na `roll`; or \"held\".",
                phase: "Not available: creepage is the same all along a stage.",
            },
        ],
    },
    ControlRow {
        freedom: TWIST,
        form: Form::Number,
        ways: &[
            Way {
                kind: Force,
                name: "twist_moment",
                unit: "force x length",
                about: "Moment about z [force x length]: at the end, or the amplitude.",
                phase: "Of the moment about z.",
            },
            Way {
                kind: Motion,
                name: "twist",
                unit: "rad",
                about: "Rotation of the upper body about z [rad]: at the end, or the amplitude.",
                phase: "Of the rotation about z.",
            },
            Way {
                kind: Rate,
                name: "spin",
                unit: "rad/length",
                about: "Spin [rad/length]: rotation of the upper body about the middle of the contact by distance rolled, the same all along the stage,\nwhich has a `roll`.",
                phase: "Not available: spin is the same all along a stage.",
            },
        ],
    },
    ControlRow {
        freedom: TILT,
        form: Form::PairOrNumber,
        ways: &[
            Way {
                kind: Force,
                name: "tilt_moment",
                unit: "force x length",
                about: "First moment of the pressure along x and y, `sum p x dA` [force x length]: at the end, or the amplitude; or \"held\". A number\nin a line contact.",
                phase: "Of the moments of the pressure.",
            },
            Way {
                kind: Motion,
                name: "tilt",
                unit: "-",
                about: "Slope of the upper body along x and y [-], deeper towards positive x and y: at the end, or the amplitude; or \"held\". A\nnumber in a line contact. Default: 0, fixed.",
                phase: "Of the slopes.",
            },
        ],
    },
    ControlRow {
        freedom: BULK_STRESS,
        form: Form::PairOrNumber,
        ways: &[Way {
            kind: Force,
            name: "bulk_stress",
            unit: "pressure",
            about: "Bulk stress of the lower body along x and y [pressure], remote stress of its substrate, tension positive: at the end, or the\namplitude; or \"held\". A number in a line contact.",
            phase: "Of the bulk stress of the lower body.",
        }],
    },
    ControlRow {
        freedom: UPPER_BULK_STRESS,
        form: Form::PairOrNumber,
        ways: &[Way {
            kind: Force,
            name: "upper_bulk_stress",
            unit: "pressure",
            about: "The same of the upper body.",
            phase: "Of that of the upper body.",
        }],
    },
    ControlRow {
        freedom: ROLL,
        form: Form::PairNumberOrSteady,
        ways: &[Way {
            kind: Motion,
            name: "roll",
            unit: "length",
            about: "Distance that the contact has rolled along both surfaces, along x and y [length]: at the end, or the amplitude; or \"held\". A\nnumber in a line contact. \"steady\": along `roll_direction`, in each increment until nothing changes any more.",
            phase: "Of the distance rolled.",
        }],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_degree_of_freedom_belongs_to_one_control() {
        let all: Vec<usize> = CONTROLS.iter().flat_map(ControlRow::freedoms).collect();
        assert_eq!(all, (0..FREEDOMS).collect::<Vec<_>>());
        // the first way is the force but of what only moves, and no way is there twice
        for row in &CONTROLS {
            let kinds: Vec<Kind> = row.ways.iter().map(|way| way.kind).filter(|kind| *kind != Rate).collect();
            let first = usize::from(row.freedom == ROLL);
            assert_eq!(kinds, [Force, Motion, FarEnd, MeanGap][first..first + kinds.len()]);
        }
    }
}
