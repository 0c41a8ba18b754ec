//! Tests that the documents agree with the files beside them, and with each other.

use tests::{tracked, workspace};

fn text(path: &str) -> String {
    std::fs::read_to_string(workspace().join(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
}

#[test]
fn links_between_documents_lead_somewhere() {
    for path in tracked().into_iter().filter(|path| path.ends_with(".md")) {
        let full = workspace().join(&path);
        for target in text(&path).split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = target.split('#').next().unwrap_or_default();
            if !file.is_empty() && !file.contains("://") {
                assert!(
                    full.with_file_name("").join(file).exists(),
                    "{path} links to {target}, which is not there"
                );
            }
        }
    }
}

/// Paths in backticks must name files of the workspace. Placeholders are in capitals.
#[test]
fn files_that_documents_name_exist() {
    let is_path = |word: &str| {
        let folder = word.split('/').next().unwrap_or_default();
        ["cases", "docs", "grader", "reference", "student_template", "tests"].contains(&folder)
            && word.contains('/')
            && word.rsplit('/').next().is_some_and(|name| name.contains('.'))
            && !word.contains(|c: char| c.is_uppercase() || " *{…".contains(c))
    };
    for path in tracked().into_iter().filter(|path| path.ends_with(".md") && path != "CHANGELOG.md")
    {
        for word in text(&path).split('`').skip(1).step_by(2).filter(|word| is_path(word)) {
            assert!(workspace().join(word).exists(), "{path} names `{word}`, which is not there");
        }
    }
}

/// Returns the digest of the code and cases that the figures in a document were measured on.
fn measured_on(path: &str) -> String {
    let text = text(path);
    let digest = if path.ends_with(".json") {
        cases::front::fronts_from_str(&text).expect("fronts").measured_on
    } else {
        cases::files::digest_in(&text).map(str::to_owned)
    };
    let digest = digest.unwrap_or_else(|| panic!("{path} has no digest; `.ci/measure` renews it"));
    let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
    assert!(digest.len() == 16 && digest.bytes().all(is_digit), "{path}: {digest}");
    digest
}

/// Times differ from run to run, so no test measures them again. `reference cost --check` reports
/// figures that are older than the code.
#[test]
fn measured_figures_name_the_code_they_were_measured_on() {
    let [page, points, _] =
        ["docs/accuracy.md", "cases/stages/fronts.json", "docs/performance.md"].map(measured_on);
    assert_eq!(page, points, "the page and the points of reports are of different measurements");
}

/// Returns the cells of each row of the tables in a document, without asterisks.
fn rows(path: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| {
        line.trim_matches('|').split('|').map(|cell| cell.trim().replace('*', "")).collect()
    };
    text(path).lines().filter(|line| line.starts_with('|')).map(cells).collect()
}

/// A command writes docs/judging.md. The front page repeats some of its figures.
#[test]
fn the_front_page_repeats_what_the_judge_found() {
    let found = rows("docs/judging.md");
    let of = |name: &str| {
        found
            .iter()
            .find(|row| row[0] == name)
            .unwrap_or_else(|| panic!("judging.md has no {name}"))
    };
    let page = text("docs/judging.md");
    assert!(
        page.contains("69 correct ones") && page.contains("the 273 bugs"),
        "the totals have changed"
    );
    let said = rows("README.md");
    let judges: Vec<_> =
        said.iter().filter(|row| row.len() == 3 && row[1].ends_with(" of 69")).collect();
    assert!(judges.len() > 4, "README.md has no table of judges");
    for row in judges {
        if row[0] == "this grader, pictures and unit checks" {
            let (failed, passed) =
                (of("correct programs that lose points"), of("bugs that lose no points"));
            assert_eq!([&row[1], &row[2]], [&failed[1], &passed[1]]);
            continue;
        }
        let n = |cell: &str| cell.split(' ').next().map(str::to_owned);
        assert!(row[2].ends_with(" of 273"), "{}", row[0]);
        assert_eq!(
            [n(&row[1]), n(&row[2])],
            [n(&of(&row[0])[1]), n(&of(&row[0])[2])],
            "{}",
            row[0]
        );
    }
}
