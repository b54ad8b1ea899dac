//! What the page tells, a file a chapter; nothing where a run has nothing to say.

mod comparison;
mod convergence;
mod cycles;
mod energy;
mod error_bars;
mod explorer;
mod head;
mod heat;
mod loading;
mod loop_table;
mod moment;
mod question;
mod rolling;
mod section_charts;
mod sections;
mod stress;
mod surfaces;
mod wear;
mod zones;

pub use explorer::json_in_page;
pub use zones::legend as legend_of_zones;

use maud::{Markup, html};

use super::literature;
use super::overview::Overview;
use crate::failure::Failure;

/// All chapters in their order.
pub fn all(view: &Overview<'_>) -> Result<Markup, Failure> {
    Ok(html! {
        (head::head(view))
        (explorer::explorer(view)?)
        (question::question(view))
        (loading::loading(view))
        (loading::fretting_loop(view))
        (rolling::rolling(view))
        (cycles::cycles(view))
        (sections::sections(view)?)
        (zones::zones(view)?)
        (energy::energy(view))
        (wear::wear(view)?)
        (stress::stress(view))
        (heat::heat(view))
        (comparison::comparison(view))
        (error_bars::error_bars(view)?)
        (convergence::convergence(view))
        (question::simplifications(view))
        (literature::chapter(view))
    })
}
