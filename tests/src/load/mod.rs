//! Measures what grading costs a machine: processor time per submission, beside the scripts that
//! courses use, and the memory of a large batch.

pub mod batch;
mod copies;
pub mod page;
pub mod script;
pub mod usage;

/// What was measured, for the page.
#[derive(Clone, Debug)]
pub struct Load {
    /// The processor and the number of its cores.
    pub machine: String,
    /// Number of submissions whose processor time was measured.
    pub n_graded: usize,
    /// Number of image cases.
    pub n_cases: usize,
    /// A batch of edited copies of the solution.
    pub graded: batch::Cost,
    /// A fresh clone, a build, all pictures and a comparison for each submission.
    pub fresh: script::Cost,
    /// A clone, a build in a shared and warm target folder, all pictures and a comparison.
    pub warm: script::Cost,
    /// The peak memory of the grader by the size of the class.
    pub memory: Vec<(usize, u64)>,
}
