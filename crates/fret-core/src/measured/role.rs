//! What the columns of a measured table can hold.

use crate::model::Dimension;

/// What the unit of a column is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Numbers without a unit.
    Number,
    /// Lengths.
    Length,
    /// Forces, of a line contact those of a unit of its length; or masses, whose weights they are.
    Force,
}

impl Kind {
    /// What it is called, in the words of [`crate::units::Units::of`], and the unit of a case that declares none; `None` of numbers.
    pub fn unit(self, dimension: Dimension) -> Option<(&'static str, &'static str)> {
        match (self, dimension) {
            (Self::Number, _) => None,
            (Self::Length, _) => Some(("length", "m")),
            (Self::Force, Dimension::Plane) => Some(("force", "N")),
            (Self::Force, Dimension::Line) => Some(("force/length", "N/m")),
        }
    }
}

/// What a column can hold. The roles of a table stand in one list, those that it needs first.
#[derive(Debug)]
pub struct Role {
    /// Its name, by which columns are chosen.
    pub name: &'static str,
    /// Names by which a column is known when none is given, in small letters.
    pub known: &'static [&'static str],
    /// Whether there has to be one.
    pub is_needed: bool,
    /// What its unit is one of.
    pub kind: Kind,
    /// What such a column may be called, for messages.
    pub example: &'static str,
}

/// How many roles of a list have to be there.
pub(super) fn needed(roles: &[Role]) -> usize {
    roles.iter().filter(|role| role.is_needed).count()
}

/// The names of roles in a sentence: `a, b and c`.
pub(super) fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
