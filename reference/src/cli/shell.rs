//! The commands `reference completions` and `reference man`, generated from the arguments.

use std::path::Path;

use cases::files;
use clap::CommandFactory;
use clap_complete::Shell;
use pages::shell::{self, Man};

use super::args::Args;
use super::output::print;
use super::stop::Stop;

/// Runs `reference completions SHELL`.
pub(super) fn completions(shell: Shell) -> Result<(), Stop> {
    print(&shell::completions(Args::command(), shell))
}

/// Runs `reference man [COMMAND|DIR]`.
pub(super) fn man(what: Option<&Path>) -> Result<(), Stop> {
    match shell::man(Args::command(), what).map_err(Stop::Usage)? {
        Man::Page(page) => print(&page),
        Man::Folder(folder, pages) => {
            std::fs::create_dir_all(&folder)
                .map_err(|why| files::WriteError::untouched(&folder, why))?;
            Ok(pages.iter().try_for_each(|(name, page)| files::write(&folder.join(name), page))?)
        }
    }
}
