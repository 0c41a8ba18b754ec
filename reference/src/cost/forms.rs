//! The formats in which a report is written.

use serde::Serialize;

use super::plot::Plot;
use super::report::Report;
use super::{csv, page, table};

/// A report that can be written in every format.
pub trait Forms: Serialize {
    /// Returns text for a terminal. It has escape codes, which the stream removes if it is not a
    /// terminal.
    fn text(&self) -> String;

    /// Returns the report as CSV, for other programs.
    ///
    /// # Errors
    /// Returns the errors of the writer. A writer into memory has none.
    fn csv(&self) -> Result<Vec<u8>, ::csv::Error>;

    /// Returns the pictures of the report.
    fn plots(&self) -> Vec<Plot>;

    /// Returns a self-contained HTML page.
    fn page(&self) -> String;
}

impl Forms for Report {
    fn text(&self) -> String {
        table::text(self)
    }

    fn csv(&self) -> Result<Vec<u8>, ::csv::Error> {
        csv::csv(self)
    }

    fn plots(&self) -> Vec<Plot> {
        page::plots(self)
    }

    fn page(&self) -> String {
        page::page(self)
    }
}
