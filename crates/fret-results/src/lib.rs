//! Folders of results: written while a run goes, resumed, read back; and the case files that are asked about.
//!
//! One reader judges whether a folder holds results and whether they are those that were written ([`read_record`], [`Table`], [`Fields`]); the
//! command, its report and the Python package ask it: through [`Results`] what was computed, through [`ResultFolder`] a run that is
//! written or resumed, through [`Origin`] a state to start from. Nothing is written through symbolic links ([`own_file`]).

mod case_file;
mod checkpoint_folder;
mod checksums;
pub mod commit;
mod error;
mod field_store;
mod fields;
mod framed_file;
mod history_table;
mod instruments;
mod names;
mod origin;
mod packed_file;
mod place;
mod record;
mod result_folder;
mod results;
mod run_record;
mod state_store;
mod table;
mod tally;
mod turn_writer;
mod whole_file;
mod zarr;

pub use case_file::{Beside, CaseFile};
pub use checkpoint_folder::{Head, Stored};
pub use error::{ResultsError, Unwritten};
pub use fields::Fields;
pub use instruments::{ReadInstrument, read_instruments_by};
pub use names::{ERROR_BARS, HEAT, SCAR, STRESS, is_named};
pub use origin::{Origin, planned_from};
pub use packed_file::{read_packed, write_packed};
pub use place::{folder_below, folder_for_answers, new_file, own_file, refuse_link, resolved_path, stem};
pub use record::read_record;
pub use result_folder::{ResultFolder, Standing, Taken, Wish};
pub use results::{Results, kind_of_field};
pub use run_record::{End, Ending, Record, RunRecord, StartedFrom, Totals, question};
pub use table::Table;
pub use tally::{StageSpan, Tally, stage_spans};
pub use whole_file::{part_of, write_whole};
