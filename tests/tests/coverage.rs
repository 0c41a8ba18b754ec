//! The cases as a whole: every rule is covered, every case shows what it is about, and points add up.

use std::path::{Path, PathBuf};

use cases::stage::{self, Stage};

fn stages_dir() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stages")
}

fn stages() -> Vec<Stage> {
    stage::load_all(&stages_dir()).unwrap_or_else(|problems| panic!("{}", problems.render(false)))
}

/// 25 points a stage, in thousandths.
#[test]
fn every_stage_is_worth_25_points() {
    for stage in stages() {
        let images: u64 = stage.cases.iter().map(|case| case.points).sum();
        assert_eq!(images + stage.unit_points, 25_000, "{}", stage.id);
    }
}
