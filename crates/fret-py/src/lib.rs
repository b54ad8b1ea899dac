//! The private Python module `fretting._core`: conversion between Python and `fret-core`, and nothing else.
//!
//! Names, defaults, documentation and everything that can be written in Python stand in `python/fretting`.

#![expect(clippy::needless_pass_by_value, reason = "what Python passes is converted, and arrives by value")]

mod analytic;
mod case;
mod command;
mod conduction;
mod error;
mod fatigue;
mod gradient;
mod history;
mod identify;
mod in_common;
mod instruments;
mod kernels;
mod plan;
mod ran;
mod simulation;
mod start;
mod stored;
mod study;
mod subsurface;
mod threads;
mod uncertainty;

/// Conversion between Python and fret-core; use the names of `fretting`.
#[pyo3::pymodule]
mod _core {
    use pyo3::prelude::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_export]
    use crate::analytic::{
        Solution, closed_form, closed_forms, line_history, mindlin_deresiewicz, mindlin_deresiewicz_at,
        spence_table, tangential_history,
    };
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::command::command_line;
    #[pymodule_export]
    use crate::conduction::{contact_resistance, surface_temperature};
    #[pymodule_export]
    use crate::fatigue::{coating_fracture, crack, fatigue};
    #[pymodule_export]
    use crate::gradient::{check_derivatives, check_results, gradient, pulled_back};
    #[pymodule_export]
    use crate::history::{History, clear_results, kind_of_key, vocabulary};
    #[pymodule_export]
    use crate::identify::{identify, identify_indentation};
    #[pymodule_export]
    use crate::in_common::InCommon;
    #[pymodule_export]
    use crate::kernels::{Convolution, frequency_response, influence_coefficients};
    #[pymodule_export]
    use crate::plan::{expected, memory_needed, plan};
    #[pymodule_export]
    use crate::simulation::{run, run_into};
    #[pymodule_export]
    use crate::start::Start;
    #[pymodule_export]
    use crate::stored::StoredRun;
    #[pymodule_export]
    use crate::study::study;
    #[pymodule_export]
    use crate::subsurface::{subsurface_displacement, subsurface_stress};
    #[pymodule_export]
    use crate::threads::{check_memory, check_threads};
    #[pymodule_export]
    use crate::uncertainty::{
        first_order, moments, quantile_fractions, sample_rows, sobol_indices, statistics,
    };

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        fret_cli::embedded::read_instruments_by(crate::instruments::read);
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
