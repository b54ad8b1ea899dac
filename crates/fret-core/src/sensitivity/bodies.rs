//! How the response of a pair changes with a constant of a layer.

use super::error::SensitivityError;
use super::parameter::BodyNumber;
use crate::compliance::SurfaceResponse;
use crate::plan::Plan;

/// Derivative of the response on the cells of a plan's grid by a constant of one of its bodies.
pub(super) fn change_of_response(
    _: &Plan,
    _: BodyNumber,
    path: &str,
) -> Result<SurfaceResponse, SensitivityError> {
    Err(SensitivityError::Parameter { path: path.to_owned(), reason: "not yet".to_owned() })
}
