//! The commit that the program was built from.

/// Its hash, or "unknown".
pub const COMMIT: &str = env!("FRET_COMMIT");

/// Whether the sources were those of the commit; `None` where nobody knows.
pub fn is_clean() -> Option<bool> {
    match env!("FRET_TREE") {
        "clean" => Some(true),
        "changed" => Some(false),
        _ => None,
    }
}

/// Version and commit in a line.
pub const VERSION: &str = env!("FRET_VERSION");
