//! Completions and manual pages, made from the arguments.

use clap::CommandFactory;
use clap_complete::Shell;

use super::args::Args;
use super::{Stop, print};

/// `reference completions SHELL`.
pub(super) fn completions(shell: Shell) -> Result<(), Stop> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Args::command(), "reference", &mut text);
    print(&text)
}

/// `reference man [COMMAND]`.
pub(super) fn man(about: Option<&str>) -> Result<(), Stop> {
    let mut program = Args::command();
    program.build();
    let page = match about {
        None => program,
        Some(name) => match program.find_subcommand(name) {
            Some(command) => command.clone(),
            None => return Err(Stop::Usage(format!("there is no command `{name}`; `reference --help` lists them"))),
        },
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page).render(&mut text).map_err(|why| Stop::Machine(why.to_string()))?;
    print(&text)
}
