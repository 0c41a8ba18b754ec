//! The forms in which a report is written.

use serde::Serialize;

use super::plot::Plot;
use super::report::Report;
use super::{csv, page, table};

/// A report that can be written in every form.
pub trait Forms: Serialize {
    /// For a terminal; escape codes are for a stream that takes them out where there is none.
    fn text(&self) -> String;

    /// A table for other programs.
    ///
    /// # Errors
    /// None that can happen while memory takes it all; the writer's are handed on.
    fn csv(&self) -> Result<Vec<u8>, ::csv::Error>;

    /// Its pictures.
    fn plots(&self) -> Vec<Plot>;

    /// A page that needs nothing else.
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
        page::plots(self).into()
    }

    fn page(&self) -> String {
        page::page(self)
    }
}
