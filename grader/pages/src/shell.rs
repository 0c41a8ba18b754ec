//! The arguments of a program, and the documents made from them: completions, man pages, the page
//! of the command line.

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Command, Parser};
use clap_complete::Shell;

use crate::say;

/// The width of the help texts in a document, in columns.
const COLUMNS: usize = 100;

/// Returns the arguments of this call of the program.
///
/// # Errors
/// Returns the exit code after printing: 0 for help, 2 for a message on an invalid call, 3 if help
/// cannot be printed.
pub fn arguments<A: Parser>() -> Result<A, ExitCode> {
    A::try_parse().map_err(|why| {
        let text = why.render().ansi().to_string();
        if why.use_stderr() {
            say::err(&text);
            return ExitCode::from(2);
        }
        match say::out(&text) {
            Ok(()) => ExitCode::SUCCESS,
            Err(why) => {
                say::err(&format!("cannot write to standard output: {why}"));
                ExitCode::from(3)
            }
        }
    })
}

/// Returns the completions of `program` for a shell.
pub fn completions(mut program: Command, shell: Shell) -> Vec<u8> {
    let name = program.get_name().to_owned();
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut program, name, &mut text);
    text
}

/// The result of [`man`].
#[derive(Debug, PartialEq, Eq)]
pub enum Man {
    /// One page to print.
    Page(Vec<u8>),
    /// Pages to write into a folder, each with its file name.
    Folder(PathBuf, Vec<(String, Vec<u8>)>),
}

/// Returns the man page of the command `what`, or that of the program if `what` is `None`.
///
/// If `what` is not a command, it is the folder for all pages, provided that the folder exists or
/// that `what` contains a `/`.
///
/// # Errors
/// Returns a message if `what` is neither, or if a page cannot be made.
pub fn man(mut program: Command, what: Option<&Path>) -> Result<Man, String> {
    program.build();
    let Some(what) = what else { return Ok(Man::Page(page(&program)?)) };
    if let Some(command) = what.to_str().and_then(|name| program.find_subcommand(name)) {
        return Ok(Man::Page(page(command)?));
    }
    let text = what.to_string_lossy();
    if !what.is_dir() && !text.contains('/') {
        let name = program.get_name();
        return Err(format!(
            "there is no command `{text}`, which `{name} --help` would list, and no folder \
                `{text}`; \
             to write the pages into a new folder, call it `./{text}`"
        ));
    }
    let named = |command: &Command| Ok((format!("{}.1", full_name(command)), page(command)?));
    let pages = all(&program).into_iter().map(named).collect::<Result<_, String>>()?;
    Ok(Man::Folder(what.to_owned(), pages))
}

/// Returns the help of `program` and of all its commands as Markdown sections.
fn markdown(mut program: Command) -> String {
    program = program.term_width(COLUMNS);
    program.build();
    let mut text = String::new();
    for command in all(&program) {
        let level = if command.get_name() == program.get_name() { "##" } else { "###" };
        let help = command.clone().render_long_help().to_string();
        let help: Vec<&str> = help.lines().map(str::trim_end).collect();
        let _ = writeln!(
            text,
            "{level} {}\n\n```text\n{}\n```\n",
            command.get_bin_name().unwrap_or(command.get_name()),
            help.join("\n").trim_end()
        );
    }
    text.trim_end().to_owned() + "\n"
}

/// Returns `page` with the help of `program` between its marks, `<!-- NAME -->` and
/// `<!-- end of NAME -->`. A page without the marks is returned unchanged.
pub fn in_page(page: &str, program: Command) -> String {
    let name = program.get_name().to_owned();
    let (start, end) = (format!("<!-- {name} -->\n"), format!("<!-- end of {name} -->"));
    match page
        .split_once(&start)
        .and_then(|(before, rest)| Some((before, rest.split_once(&end)?.1)))
    {
        Some((before, after)) => format!("{before}{start}\n{}\n{end}{after}", markdown(program)),
        None => page.to_owned(),
    }
}

/// Returns the program, its commands and their commands, without `help`.
fn all(program: &Command) -> Vec<&Command> {
    let commands = program.get_subcommands().filter(|command| command.get_name() != "help");
    std::iter::once(program).chain(commands.flat_map(all)).collect()
}

/// Returns the name of a command with that of its program, such as `grader-grade`.
fn full_name(command: &Command) -> String {
    command.get_display_name().unwrap_or(command.get_name()).replace(' ', "-")
}

fn page(command: &Command) -> Result<Vec<u8>, String> {
    let mut text = Vec::new();
    let made: io::Result<()> = clap_mangen::Man::new(command.clone()).render(&mut text);
    made.map(|()| text).map_err(|why| format!("the man page cannot be made: {why}"))
}

#[cfg(test)]
mod tests {
    use clap::Arg;

    use super::*;

    fn program() -> Command {
        let bake = Command::new("bake").about("Bake bread").arg(Arg::new("flour").help("Of wheat"));
        let clean = Command::new("clean").about("Clean").subcommand(Command::new("door"));
        Command::new("oven").version("1").about("An oven").subcommands([bake, clean])
    }

    /// Checks the page that is printed, the names of the pages to be written, or the error.
    fn check(what: Option<&str>, expected: Result<&str, &str>) {
        let said = man(program(), what.map(Path::new)).map(|man| match man {
            Man::Page(page) => String::from_utf8(page).unwrap(),
            Man::Folder(folder, pages) => {
                format!(
                    "{}: {}",
                    folder.display(),
                    pages.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(" ")
                )
            }
        });
        let (said, part) = match (&said, expected) {
            (Ok(said), Ok(part)) | (Err(said), Err(part)) => (said, part),
            _ => panic!("{what:?}: {said:?}"),
        };
        assert!(said.contains(part), "{what:?}: no {part:?} in {said}");
    }

    #[test]
    fn man_prints_a_page_or_writes_all_into_a_folder() {
        check(None, Ok("An oven"));
        check(Some("bake"), Ok("Bake bread"));
        check(Some("."), Ok(".: oven.1 oven-bake.1 oven-clean.1 oven-clean-door.1"));
        check(Some("new/"), Ok("new/: oven.1 oven-bake.1 oven-clean.1 oven-clean-door.1"));
        check(Some("./new"), Ok("./new: oven.1 oven-bake.1 oven-clean.1 oven-clean-door.1"));
        check(Some("back"), Err("there is no command `back`"));
    }

    #[test]
    fn the_page_of_the_command_line_holds_every_help() {
        let text = markdown(program());
        for part in [
            "## oven\n",
            "### oven bake\n",
            "### oven clean door\n",
            "An oven",
            "Of wheat",
            "Usage: oven bake",
        ] {
            assert!(text.contains(part), "no {part:?} in\n{text}");
        }
        assert!(
            !text.lines().any(|line| line.starts_with('#') && line.ends_with("help")),
            "{text}"
        );
        let page = in_page("a\n<!-- oven -->\nold\n<!-- end of oven -->\nb\n", program());
        assert_eq!(page, format!("a\n<!-- oven -->\n\n{text}\n<!-- end of oven -->\nb\n"));
        assert_eq!(in_page(&page, program()), page);
        assert_eq!(in_page("no marks", program()), "no marks");
    }

    #[test]
    fn completions_are_made_for_the_program() {
        let text = String::from_utf8(completions(program(), Shell::Bash)).unwrap();
        assert!(text.contains("_oven()"), "{text}");
    }
}
