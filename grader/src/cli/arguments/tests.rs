//! Tests of `arguments.rs`.

use clap::CommandFactory;

use super::*;

#[test]
fn the_command_line_is_consistent() {
    Arguments::command().debug_assert();
}

#[test]
fn the_page_of_the_command_line_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/cli.md");
    let stored = || std::fs::read_to_string(path).expect("the page");
    let page = pages::shell::in_page(&stored(), Arguments::command());
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(path, &page).expect("a page that can be written");
    }
    assert!(
        page == stored() && page.contains("grader grade"),
        "docs/cli.md is not what `--help` prints: set BLESS=1"
    );
}
