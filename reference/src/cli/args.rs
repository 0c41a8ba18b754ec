//! The command-line arguments of `reference`.

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum};

pub(super) use super::cost_args::CostArgs;
pub(super) use super::effects_args::EffectsArgs;
use super::values::{CourseArg, STAGES, formula, size, threshold};
use crate::rules::Formula;

/// Renders and explains scenes by the numbered rules of light, and writes the answers that
/// submissions are judged by.
#[derive(Debug, Parser)]
#[command(name = "reference", version, after_help = AFTER, propagate_version = true)]
pub(super) struct Args {
    /// Print only errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print each step
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// When to colour the output; `auto` heeds NO_COLOR
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub color: Colour,
    #[command(subcommand)]
    pub command: Command,
}

const AFTER: &str = "\
A SCENE is a scene or case in TOML, a resolved scene in JSON, the id of a case such as
`02_shadows/two_lamps`, which is looked up in ./cases/stages, or `-`: a scene on standard input.

Examples:
  reference render 02_shadows/two_lamps -o two_lamps.png
  reference explain 04_refraction/crystal_ball 80 60
  reference expect --check
  reference vary --seed 2026 --out hidden
  reference cost 04_refraction/crystal_ball --html cost.html

Exit codes:
  0    done; with `expect --check`: every stored answer is what the rules give
  1    done, but a stored answer differs, a check's answer on paper is wrong,
       or a case cannot be varied within its bounds
  2    usage, input that cannot be read, or a name that cannot be written
  3    the machine failed, such as a full disk
  130  interrupted; `cost` reports the rounds that it finished, `expect` and `vary`
       change no file";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    Render(RenderArgs),
    Effects(EffectsArgs),
    Cost(CostArgs),
    Explain(ExplainArgs),
    Probe(ProbeArgs),
    Expect(ExpectArgs),
    Vary(VaryArgs),
    Course(CourseArgs),
    Schema(SchemaArgs),
    /// Prints the completions for a shell
    #[command(after_help = "\
Example:
  reference completions bash > ~/.local/share/bash-completion/completions/reference

Exit codes: 0 done, 2 no such shell")]
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Prints a man page, or writes the man pages of all commands into a folder
    #[command(after_help = "\
Examples:
  reference man render | man -l -                the page of a command
  reference man ~/.local/share/man/man1          writes one page for each command

Exit codes: 0 done, 2 no such command or folder, or a folder that cannot be written")]
    Man {
        /// A command, or a folder for all pages [default: the page of reference itself]
        #[arg(value_name = "COMMAND|DIR")]
        what: Option<PathBuf>,
    },
}

/// Answers the questions of the unit checks: one JSON question per line in, one JSON answer per
/// line out
#[derive(Debug, Parser)]
#[command(after_help = "\
Example:
  echo '{\"id\":1,\"fn\":\"reflect\",\"direction\":[0,-1,0],\"normal\":[0,1,0]}' | reference probe

Exit codes: 0 every question is answered, 2 a question or course that cannot be read")]
pub(super) struct ProbeArgs {
    #[command(flatten)]
    pub course: CourseArg,
}

/// Prints the choices of a course where courses differ, as a page for its students
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference course > docs/course.md             the course of ./cases/course.toml
  reference course --course my_course.toml      another one

Exit codes: 0 printed, 2 a course that cannot be read")]
pub(super) struct CourseArgs {
    /// The choices of the course
    #[arg(long, value_name = "FILE", default_value = "cases/course.toml")]
    pub course: PathBuf,
}

/// Renders a picture
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference render 02_shadows/two_lamps -o two_lamps.png
  reference render scene.json out.pfm                      like the call of a submission
  reference render scene.toml -o big.exr --size 1280x960 --samples 4 --stats
  reference render scene.toml -o smooth.png --samples 4 --adaptive
  reference render scene.toml -o fast.png --max-depth 50 --threshold 1/256 --stats
  reference render scene.toml -o glass.png --max-depth 20 --max-rays 50000000
  reference render scene.toml -o - --effects shadows,reflection > out.png
  reference render scene.toml -o - | grader compare - expected.png
  reference render - -o out.png < scene.toml               a scene on standard input
  reference render 02_shadows/two_lamps -o a.png --mistakes no_ambient,shadow_beyond_light

Where some material both reflects and transmits, each level of depth may have many times as many
rays as the one before. From depth 8 on, such a scene is first rendered at up to 512 pixels, and a
warning states the expected number of rays if it is more than 100 for each eye ray. --quiet
suppresses it.

Exit codes: 0 rendered, 1 the picture takes more rays than --max-rays, so that nothing is written,
2 usage, a scene that cannot be read or a name that cannot be written, 3 the machine failed, such
as a full disk")]
pub(super) struct RenderArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    pub scene: String,
    /// File of the picture, as with -o
    #[arg(value_name = "OUT", conflicts_with = "output")]
    pub out: Option<PathBuf>,
    /// File of the picture: .png, .pfm or .exr (linear float); `-` and a pipe get a PNG
    #[arg(short, long, value_name = "OUT", required_unless_present = "out")]
    pub output: Option<PathBuf>,
    /// Bits per channel of a PNG
    #[arg(long, value_name = "BITS", default_value = "8")]
    pub bits: Bits,
    /// Pixels, such as 640x480, instead of the scene's
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Depth at which rays spawn no more, instead of the scene's
    #[arg(long, value_name = "N")]
    pub max_depth: Option<u32>,
    /// Weight below which rays spawn no more, such as 0.001 or 1/256, instead of the scene's; 0 for
    /// never
    #[arg(long, value_name = "WEIGHT", value_parser = threshold)]
    pub threshold: Option<f64>,
    /// Light, such as 0.001 or 1/512; the direct light of a source that cannot add as much to a
    /// point is skipped there, with its shadow ray; 0 for never
    #[arg(long, value_name = "LIGHT", default_value = "0", value_parser = threshold)]
    pub light_cutoff: f64,
    /// Number of rays of all kinds, shadow rays included, beyond which the picture is given up and
    /// nothing is written [default: no limit]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub max_rays: Option<u64>,
    /// Floating-point numbers to compute with
    #[arg(long, default_value = "f64")]
    pub precision: Precision,
    /// Formulas to compute with: `plain` is what most tracers use, `stable` does not cancel,
    /// `robust` is the reference's own
    #[arg(long, value_name = "FORMULAS", default_value = "robust", value_parser = formula)]
    pub formulas: Formula,
    /// Known mistakes to make, such as `no_shadows,flat_shading`: the picture of a student's
    /// program with all of them, by plain formulas and without a search tree
    #[arg(
        long,
        value_name = "IDS",
        value_delimiter = ',',
        conflicts_with_all = [
            "precision", "formulas", "samples", "adaptive", "light_cutoff", "max_rays", "stats",
        ]
    )]
    pub mistakes: Vec<String>,
    /// Effects to simulate: `auto` (those the scene lists), `all`, `none`, or names such as
    /// `shadows,reflection`. Effects that are not named are left out: without `transforms` objects
    /// stay in their own space, without `attenuation` lights are as strong at any distance
    #[arg(long, value_name = "EFFECTS", default_value = "auto")]
    pub effects: String,
    /// N for N x N rays per pixel, on a regular grid; the colour of the pixel is their mean
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = clap::value_parser!(u32).range(1..=256)
    )]
    pub samples: u32,
    /// Cast the N x N rays of --samples only through pixels that differ from a neighbour by more
    /// than 9 of 255 levels in some channel; one ray through the others
    #[arg(long, requires = "samples")]
    pub adaptive: bool,
    /// Number of threads; the picture is the same with any number [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print statistics: rays by kind, the work that they caused, the simulated effects with their
    /// reasons, the most by which depth, threshold and light cutoff can darken a pixel, and the
    /// time of each step; to the error stream if the picture goes to the output stream
    #[arg(long, value_name = "FORM", num_args = 0..=1, default_missing_value = "text")]
    pub stats: Option<StatsForm>,
    #[command(flatten)]
    pub course: CourseArg,
}

/// Prints the tree of rays behind a pixel
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference explain 04_refraction/crystal_ball 80 60
  reference explain 04_refraction/crystal_ball 80 60 --max-rays 1000

Exit codes: 0 printed, 1 the pixel takes more rays than --max-rays, 2 a scene that cannot be read,
or a pixel outside its picture")]
pub(super) struct ExplainArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    pub scene: String,
    /// Column from the left, from 0
    pub x: u32,
    /// Row of the picture from the top, from 0
    pub y: u32,
    /// Number of rays of all kinds, shadow rays included, beyond which no tree is printed [default:
    /// no limit]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub max_rays: Option<u64>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub course: CourseArg,
}

/// Writes the answers that submissions are judged by, beside the cases: all of them, or none
///
/// An answer carries a digest of what it was made from: the scene, its meshes, the choices of the
/// course, the version of the rules. The grader refuses an answer whose digest differs.
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference expect                            every stage of ./cases/stages
  reference expect 02_shadows                 one stage
  reference expect 02_shadows/two_lamps       one case
  reference expect --course phong.toml        course.toml, answers and docs/course.md of a course
  reference expect --check                    writes nothing, fails if anything differs

Exit codes: 0 every answer is written or correct, 1 a stored answer differs or an answer on paper
is wrong, 2 no such case, a case that cannot be read, or a name that cannot be written, 3 the
machine failed, such as a full disk, 130 interrupted")]
pub(super) struct ExpectArgs {
    #[command(flatten)]
    pub course: CourseArg,
    /// Ids of cases or stages, case files, stage folders, or folders of stages
    #[arg(value_name = "CASE|STAGE|DIR")]
    pub what: Vec<PathBuf>,
    /// Compare with the stored files, byte for byte, and write nothing
    #[arg(long)]
    pub check: bool,
}

/// Makes a hidden set with its answers: the same cases with their numbers changed within the bounds
/// of each case's `[vary]`
#[derive(Debug, Parser)]
#[command(after_help = "\
The same seed gives the same files on every machine. A draw is accepted only if the case stays
valid, still shows what its stage adds and every rule that it names, and is fair to correct
programs; otherwise it is drawn again. A case without `[vary]` is copied unchanged, with a
warning. The set is written as a whole or not at all.

Examples:
  reference vary --seed 2026                      varies ./cases/stages into ./varied-2026
  reference vary --seed 2026 --out hidden
  grader grade tests/solution --cases hidden      a correct program earns all points
  reference vary --check --seeds 100              writes nothing, shows how well the bounds hold

For each case, --check prints the share of seeds whose first draw is accepted, the largest number
of draws, the share of pixels that show what the stage adds (in the first stage, that differ from
the background), the least such share of all draws, and the largest share of contested pixels.

Exit codes: 0 done, 1 a case that cannot be varied within its bounds, 2 usage or a case that
cannot be read, 3 a folder that cannot be written")]
pub(super) struct VaryArgs {
    /// Folder of stages
    #[arg(default_value = STAGES)]
    pub stages: PathBuf,
    /// Seed of the set; with --check of the first set
    #[arg(long, value_name = "N", required_unless_present = "check")]
    pub seed: Option<u64>,
    /// Folder to write, which must not exist or be empty [default: varied-N]
    #[arg(short, long, value_name = "DIR", conflicts_with = "check")]
    pub out: Option<PathBuf>,
    /// Draw sets and write no files; print how often the first draw is accepted, and how much the
    /// draws show at least
    #[arg(long)]
    pub check: bool,
    /// Number of sets that --check draws
    #[arg(
        long,
        value_name = "COUNT",
        default_value = "20",
        requires = "check",
        value_parser = clap::value_parser!(u64).range(1..=1_000_000)
    )]
    pub seeds: u64,
    /// Number of these sets whose share of contested pixels is measured, by rendering all legal
    /// variations: that takes ten times as long
    #[arg(long, value_name = "COUNT", default_value = "2", requires = "check")]
    pub contested: u64,
}

/// Prints the JSON Schema of case files, courses, resolved scenes or the probe protocol
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference schema case > case.schema.json
  reference schema --markdown > docs/scene-format.md

Exit codes: 0 printed, 2 no such schema")]
pub(super) struct SchemaArgs {
    /// Format to describe
    #[arg(default_value = "case")]
    pub kind: SchemaKind,
    /// The format of scene files as a page for people
    #[arg(long, conflicts_with = "kind")]
    pub markdown: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum SchemaKind {
    /// A case: a TOML file in the folder of a stage
    Case,
    /// A scene in TOML that belongs to no stage
    SceneFile,
    /// The `stage.toml` of a stage
    Stage,
    /// The choices of a course, `course.toml`
    Course,
    /// A resolved scene in JSON, as submissions receive it
    Scene,
    /// The lines of the probe protocol
    Probe,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Colour {
    Auto,
    Always,
    Never,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Precision {
    F32,
    F64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Bits {
    #[value(name = "8")]
    Eight,
    #[value(name = "16")]
    Sixteen,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum StatsForm {
    Text,
    Json,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_page_of_the_command_line_is_current() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/cli.md");
        let stored = || std::fs::read_to_string(path).expect("the page");
        let page = pages::shell::in_page(&stored(), Args::command());
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(path, &page).expect("a page that can be written");
        }
        let is_there = page.contains("reference render");
        assert!(
            page == stored() && is_there,
            "docs/cli.md is not what `--help` prints: set BLESS=1"
        );
    }
}
