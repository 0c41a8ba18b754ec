//! What accuracy costs: settings, their pictures, errors and times, and what to pick.
//!
//! | file | holds |
//! |---|---|
//! | `setting.rs`, `sweep.rs` | the ways of computing a picture, and which of them are measured |
//! | `bench.rs`, `measure.rs` | a scene made ready for all of them; pictures first, then times in interleaved rounds |
//! | `error.rs`, `front.rs` | how far a picture is from a better one; which settings no other one beats |
//! | `report.rs`, `summary.rs`, `advice.rs` | what was found: data, its making, sentences |
//! | `functions.rs`, `functions_report.rs` | one function at a time: nanoseconds against errors and wrong decisions |
//! | `uncalled.rs` | what an effect costs a scene that does not call for it |
//! | `forms.rs`, `table.rs`, `csv.rs`, `plot.rs`, `page.rs` | reports as text, table, picture and page |
//! | `figures.rs` | numbers as reports print them |
//! | `scaled.rs`, `document.rs` | the same scene in another size; the page of the documentation |
//!
//! Nothing here reads a clock: [`measure::Outside`] is handed in.

mod advice;
pub mod bench;
pub mod csv;
pub mod document;
pub mod error;
pub mod figures;
pub mod forms;
pub mod front;
pub mod functions;
pub mod functions_report;
mod labels;
pub mod measure;
pub mod page;
pub mod plot;
pub mod report;
pub mod scaled;
pub mod setting;
mod summary;
pub mod sweep;
pub mod table;
pub mod uncalled;
