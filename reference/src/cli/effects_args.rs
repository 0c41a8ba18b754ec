//! The command-line arguments of `reference effects`.

use std::path::PathBuf;

use clap::Parser;

use super::values::CourseArg;

/// Prints the effects that a scene calls for under its course, and why
#[derive(Debug, Parser)]
#[command(after_help = "\
The picture is rendered with its effects, and without each of them in turn. An effect that is
called for but changes no pixel is idle in this picture: nothing in view needs it. An effect that is
not called for is not simulated. --measure renders several times and prints times as well. They are
processor times on one thread; `~0` says that the ranges of the rounds overlap, or that there was
only one round.

Examples:
  reference effects 04_refraction/crystal_ball
  reference effects docs/effects/glass_off_screen.toml
  reference effects --page docs/effects.md        the page of the documentation
  reference effects scene.toml --course my_course.toml
  reference effects 02_shadows/stained_glass --measure

Exit codes: 0 printed, 2 usage or a scene that cannot be read, 3 the machine failed, 130
interrupted")]
pub(super) struct EffectsArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    #[arg(required_unless_present = "page")]
    pub scene: Option<String>,
    /// Print the milliseconds that each effect takes, and the rays with and without it
    #[arg(long)]
    pub measure: bool,
    /// Number of rays of all kinds beyond which idle effects are not searched for [default:
    /// 20000000]
    #[arg(
        long,
        value_name = "N",
        conflicts_with = "measure",
        value_parser = clap::value_parser!(u64).range(1..)
    )]
    pub max_rays: Option<u64>,
    /// Write the page docs/effects.md. It shows scenes of the folder that contains `docs` and
    /// `cases`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "measure", "json"])]
    pub page: Option<PathBuf>,
    /// Number of rounds for --measure; each renders every picture once
    #[arg(
        long,
        value_name = "N",
        default_value = "5",
        requires = "measure",
        value_parser = clap::value_parser!(u16).range(1..)
    )]
    pub rounds: u16,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub course: CourseArg,
}
