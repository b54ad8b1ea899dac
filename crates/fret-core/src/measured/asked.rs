//! Which columns of a measured table are which.

/// Which columns hold what, and in which units, where the table does not say so itself.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// Columns by what they hold: by name, or by number from 1.
    pub columns: Vec<(String, String)>,
    /// Units by what they are of.
    pub units: Vec<(String, String)>,
}

impl Asked {
    /// The unit that is asked for.
    pub(crate) fn unit_of(&self, role: &str) -> Option<&str> {
        self.units.iter().find(|(of, _)| of == role).map(|(_, unit)| unit.as_str())
    }
}
