//! What a case asks for along the surface.

use crate::case::Case;
use crate::model::{ContactState, Control};

/// Whether the start or any stage asks for a tangential force or motion along an axis (0: x, 1: y) other than none.
pub fn is_loaded(case: &Case, axis: usize, start: Option<&ContactState>) -> bool {
    let held = case.start.map(|loads| loads.tangential[axis]);
    if held.is_some_and(asks_for_something) || start.is_some_and(|state| state.shift[axis] != 0.0) {
        return true;
    }
    let mut controls = case.stages.iter().filter_map(|stage| stage.tangential[axis].as_ref());
    controls.any(|control| !control.path().is_zero())
}

/// Whether a control is other than none.
pub fn asks_for_something(control: Control) -> bool {
    control.value() != 0.0
}

/// Whether the start is twisted or any stage names a twist.
pub fn is_twisted(case: &Case, start: Option<&ContactState>) -> bool {
    case.stages.iter().any(|stage| stage.twist.is_some())
        || case.start.is_some_and(|loads| asks_for_something(loads.twist))
        || start.is_some_and(|state| state.twist != 0.0)
}
