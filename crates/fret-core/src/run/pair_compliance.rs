//! How a pair of bodies answers tractions on a grid: what histories of the same bodies on the same grid have in common.

use std::f64::consts::{PI, TAU};

use serde_json::json;

use crate::compliance::SurfaceResponse;
use crate::kernel::{
    Components, PairResponse, ResponseTable, coefficients_of, influence_coefficients, line_coefficients_of,
    periodic_symbols, repeated_coefficients, symbols_of,
};
use crate::model::{ContactPair, Dimension};
use crate::plan::{Coupling, Plan, Simplification};

/// How a pair answers tractions on the grid of a plan.
#[derive(Debug, Clone)]
pub struct PairCompliance {
    /// Over cells.
    pub response: SurfaceResponse,
    /// Over wavenumbers; none of a periodic case.
    pub table: Option<ResponseTable>,
}

impl PairCompliance {
    /// That of a plan.
    pub fn of(plan: &Plan) -> Self {
        Self::of_bodies(plan, &plan.case.bodies)
    }

    /// That of other bodies on the grid of a plan.
    pub fn of_bodies(plan: &Plan, bodies: &ContactPair) -> Self {
        let wanted = match plan.coupling {
            Coupling::Frictionless => Components::NORMAL,
            Coupling::Uncoupled => Components { normal: true, tangential: true, coupling: false },
            Coupling::Coupled => Components::ALL,
        };
        Self { response: response(plan, bodies, wanted), table: table(plan, bodies) }
    }

    /// The response of other bodies on the cells of a plan's grid, with all components.
    pub fn all_components(plan: &Plan, bodies: &ContactPair) -> SurfaceResponse {
        response(plan, bodies, Components::ALL)
    }

    /// All that it depends on.
    pub fn depends_on(plan: &Plan) -> String {
        let case = &plan.case;
        let plain = plan.leave_out.takes(Simplification::LayeredResponse);
        json!([case.bodies, plan.grid, case.periodic, plan.datum, plan.coupling, plain]).to_string()
    }

    /// The memory it takes [bytes]: at most six numbers a cell, or a quarter as many of a period.
    pub fn bytes(plan: &Plan) -> usize {
        6 * size_of::<f64>() * plan.case.cells.iter().product::<usize>()
    }
}

fn response(plan: &Plan, bodies: &ContactPair, wanted: Components) -> SurfaceResponse {
    let case = &plan.case;
    let spacing = plan.grid.spacing();
    let plain = plan.leave_out.takes(Simplification::LayeredResponse);
    let [width, depth] = plan.grid.size();
    let layered = || PairResponse::all_layers(bodies, width.max(depth));
    if plan.grid.dimension() == Dimension::Line {
        let datum = plan.datum.unwrap_or(width);
        let response = if plain { PairResponse::new(bodies) } else { layered() };
        let strips = case.cells[0];
        return SurfaceResponse::FreeSpace(line_coefficients_of(
            &response, bodies, strips, spacing[0], datum, wanted,
        ));
    }
    if let Some(along) = case.periodic.one_axis() {
        let datum = plan.datum.unwrap_or(plan.grid.size()[1 - along]);
        let response = if plain { PairResponse::new(bodies) } else { layered() };
        let coefficients =
            repeated_coefficients((bodies, &response), (case.cells, spacing), along, datum, wanted);
        return SurfaceResponse::FreeSpace(coefficients);
    }
    match (case.periodic.is_both(), plain) {
        (true, true) => SurfaceResponse::Periodic(periodic_symbols(bodies, case.cells, spacing, wanted, 0)),
        (true, false) => {
            SurfaceResponse::Periodic(symbols_of(layered(), case.cells, spacing, wanted).with_uniform(bodies))
        }
        (false, true) => {
            SurfaceResponse::FreeSpace(influence_coefficients(bodies, case.cells, spacing, wanted))
        }
        (false, false) => {
            SurfaceResponse::FreeSpace(coefficients_of(&layered(), case.cells, spacing, wanted))
        }
    }
}

fn table(plan: &Plan, bodies: &ContactPair) -> Option<ResponseTable> {
    let [width, depth] = plan.grid.size();
    let [dx, dy] = plan.grid.spacing();
    let [least, greatest] = [TAU / width.max(depth), 5.0 * PI / dx.min(dy)];
    (!plan.case.periodic.is_both()).then(|| ResponseTable::new(bodies, least, greatest))
}
