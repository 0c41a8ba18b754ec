//! The cost of accuracy: settings, their pictures, errors and times, and advice on which to pick.
//!
//! | file | holds |
//! |---|---|
//! | `setting.rs`, `sweep.rs` | the settings by which a picture can be computed, and which are measured |
//! | `bench.rs`, `measure.rs` | a scene prepared for all settings; pictures first, then times in interleaved rounds |
//! | `error.rs`, `error_picture.rs` | the error of a picture against a better one, as figures and as a picture |
//! | `times.rs` | the median and the spread of several times |
//! | `report.rs`, `summary.rs` | the report of a sweep: its data, and its construction |
//! | `advice.rs`, `answers.rs`, `facts.rs` | which setting to pick, and the sentences of a report |
//! | `functions.rs`, `functions_report.rs` | single functions: nanoseconds against errors and wrong decisions |
//! | `functions_summary.rs`, `functions_advice.rs` | construction of that report; which formula to pick for each function |
//! | `idle.rs` | a scene without each of its effects: pixels, rays and times |
//! | `view.rs`, `effects_document.rs` | the same in counts alone; the page `docs/effects.md` |
//! | `uncalled.rs` | the cost of an effect in a scene that does not call for it |
//! | `forms.rs`, `table.rs`, `csv.rs`, `plot.rs`, `page.rs` | reports as text, CSV table, SVG picture and HTML page |
//! | `figures.rs` | levels, and numbers with a sign, as reports print them |
//! | `scaled.rs`, `starts.rs` | a scene in another size; how new rays leave surfaces in every size |
//! | `threads.rs` | the time on one thread and on several |
//! | `document.rs` | the page `docs/accuracy.md` |
//!
//! Nothing here reads a clock. The caller passes a [`measure::Outside`].

mod advice;
mod answers;
pub mod bench;
pub mod csv;
pub mod document;
pub mod effects_document;
pub mod error;
pub mod error_picture;
pub mod facts;
pub mod figures;
pub mod forms;
pub mod functions;
mod functions_advice;
pub mod functions_report;
mod functions_summary;
pub mod idle;
mod labels;
pub mod measure;
pub mod need;
pub mod page;
pub mod plot;
pub mod report;
pub mod scaled;
pub mod setting;
pub mod starts;
mod summary;
pub mod sweep;
pub mod table;
pub mod threads;
pub mod times;
pub mod uncalled;
pub mod view;
