//! What can be typed.

use std::path::PathBuf;

use clap::{Parser, Subcommand, ValueEnum};

pub(super) use super::cost_args::CostArgs;
use super::values::{CourseArg, STAGES, size, threshold};

/// Renders and explains scenes by the numbered rules of light, and writes the answers that
/// submissions are judged by.
#[derive(Debug, Parser)]
#[command(name = "reference", version, after_help = AFTER, propagate_version = true)]
pub(super) struct Args {
    /// Errors alone
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Also what is done on the way
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// When to colour; `auto` heeds NO_COLOR
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub color: Colour,
    #[command(subcommand)]
    pub command: Command,
}

const AFTER: &str = "\
A SCENE is a scene or case in TOML, a resolved scene in JSON, the id of a case such as
`02_shadows/two_lamps`, which is sought in ./cases/stages, or `-`: a scene on standard input.

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
  3    the machine failed: the disk is full, say
  130  interrupted; `cost` reports what it measured until then, `expect` and `vary`
       leave every file as it was";

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
    /// Prints a man page, or writes those of all commands into a folder
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

/// Answers the questions of the unit checks: JSON, a question a line in, an answer a line out
#[derive(Debug, Parser)]
#[command(after_help = "\
Example:
  echo '{\"id\":1,\"fn\":\"reflect\",\"direction\":[0,-1,0],\"normal\":[0,1,0]}' | reference probe

Exit codes: 0 every question is answered, 2 a question or course that cannot be understood")]
pub(super) struct ProbeArgs {
    #[command(flatten)]
    pub course: CourseArg,
}

/// Prints what a course decides where courses differ, as a page for its students
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference course > docs/course.md             the course of ./cases/course.toml
  reference course --course my_course.toml      another one

Exit codes: 0 printed, 2 a course that cannot be read")]
pub(super) struct CourseArgs {
    /// What the course decides
    #[arg(long, value_name = "FILE", default_value = "cases/course.toml")]
    pub course: PathBuf,
}

/// Renders a picture
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference render 02_shadows/two_lamps -o two_lamps.png
  reference render scene.json out.pfm                      as a submission is called
  reference render scene.toml -o big.exr --size 1280x960 --samples 4 --stats
  reference render scene.toml -o fast.png --max-depth 50 --threshold 1/256 --stats
  reference render scene.toml -o - --effects shadows,reflection > out.png
  reference render scene.toml -o - | grader compare - expected.png
  reference render - -o out.png < scene.toml               a scene on standard input

Exit codes: 0 rendered, 2 usage, a scene that cannot be read or a name that cannot be written, 3
the disk is full, say")]
pub(super) struct RenderArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    pub scene: String,
    /// Where the picture goes, as with -o
    #[arg(value_name = "OUT", conflicts_with = "output")]
    pub out: Option<PathBuf>,
    /// Where the picture goes: .png, .pfm or .exr (linear float); `-` and a pipe get a PNG
    #[arg(short, long, value_name = "OUT", required_unless_present = "out")]
    pub output: Option<PathBuf>,
    /// Bits a channel of a PNG
    #[arg(long, value_name = "BITS", default_value = "8")]
    pub bits: Bits,
    /// Pixels, such as 640x480, in the place of the scene's
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Depth at which rays spawn no more, in the place of the scene's
    #[arg(long, value_name = "N")]
    pub max_depth: Option<u32>,
    /// Weight below which rays spawn no more, such as 0.001 or 1/256, in the place of the scene's;
    /// 0 for never
    #[arg(long, value_name = "WEIGHT", value_parser = threshold)]
    pub threshold: Option<f64>,
    /// Light, such as 0.001 or 1/512: a lamp that cannot bring as much to a point casts no shadow
    /// ray from there and adds nothing; 0 for never
    #[arg(long, value_name = "LIGHT", default_value = "0", value_parser = threshold)]
    pub light_cutoff: f64,
    /// Numbers to compute with
    #[arg(long, default_value = "f64")]
    pub precision: Precision,
    /// Effects to simulate: `auto` (those the scene lists), `all`, `none`, or names such as
    /// `shadows,reflection`. What is not named is left out: without `transforms` objects stay in
    /// their own space, without `attenuation` lights are as strong at any distance
    #[arg(long, value_name = "EFFECTS", default_value = "auto")]
    pub effects: String,
    /// N x N rays a pixel, on a regular grid; the pixel is their mean
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = clap::value_parser!(u32).range(1..=256)
    )]
    pub samples: u32,
    /// Threads; the picture is the same with any number [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Says how many rays of each kind were cast, what work they made, which effects were simulated
    /// and why, how much it can matter what was left out for depth, threshold or light cutoff, and
    /// the time of each step; on the error stream where the picture goes to the output
    #[arg(long, value_name = "FORM", num_args = 0..=1, default_missing_value = "text")]
    pub stats: Option<Form>,
    #[command(flatten)]
    pub course: CourseArg,
}

/// Says which effects a scene calls for under its course, and why
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference effects 04_refraction/crystal_ball
  reference effects scene.toml --course my_course.toml

Exit codes: 0 printed, 2 a scene that cannot be read")]
pub(super) struct EffectsArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    pub scene: String,
    /// As JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub course: CourseArg,
}

/// Prints the tree of rays behind a pixel
#[derive(Debug, Parser)]
#[command(after_help = "\
Example:
  reference explain 04_refraction/crystal_ball 80 60

Exit codes: 0 printed, 2 a scene that cannot be read, or a pixel outside of its picture")]
pub(super) struct ExplainArgs {
    /// Scene, case, id of a case, or - for a scene on standard input
    pub scene: String,
    /// Column from the left, from 0
    pub x: u32,
    /// Row of the picture from the top, from 0
    pub y: u32,
    /// As JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub course: CourseArg,
}

/// Writes the answers that submissions are judged by, beside the cases: all of them, or none
///
/// An answer carries a digest of what it was made from: the scene, its meshes, what the course
/// decides, the version of the rules. The grader refuses answers that belong to something else.
#[derive(Debug, Parser)]
#[command(after_help = "\
Examples:
  reference expect                            every stage of ./cases/stages
  reference expect 02_shadows                 one stage
  reference expect 02_shadows/two_lamps       one case
  reference expect --course phong.toml        course.toml, answers and docs/course.md of a course
  reference expect --check                    writes nothing, fails where anything differs

Exit codes: 0 all is as the rules give it, 1 a stored answer differs or an answer on paper is
wrong, 2 no such case, one that cannot be read, or a name that cannot be written, 3 the disk is
full, say, 130 interrupted")]
pub(super) struct ExpectArgs {
    #[command(flatten)]
    pub course: CourseArg,
    /// Ids of cases or stages, case files, stage folders, or folders of stages
    #[arg(value_name = "CASE|STAGE|DIR")]
    pub what: Vec<PathBuf>,
    /// Compare with what is stored, byte for byte, and write nothing
    #[arg(long)]
    pub check: bool,
}

/// Makes a hidden set with its answers: the same cases with their numbers moved within the bounds
/// of each case's `[vary]`
#[derive(Debug, Parser)]
#[command(after_help = "\
The same seed gives the same files on every machine. A draw counts only where the case stays
valid, still shows what its stage adds and every rule it names, and is fair to right programs;
else it is drawn again. A case without `[vary]` is copied as it is, with a warning. The set
appears whole or not at all.

Examples:
  reference vary --seed 2026                      varies ./cases/stages into ./varied-2026
  reference vary --seed 2026 --out hidden
  grader grade tests/solution --cases hidden      a right program earns all of it
  reference vary --check --seeds 100              writes nothing, says how well the bounds hold

What --check prints of each case: the share of seeds whose first draw does, the draws it took at
most, the share of pixels that show what the stage adds (in the first stage, anything but
background) and the least of it, and the largest share of contested pixels.

Exit codes: 0 done, 1 a case that cannot be varied within its bounds, 2 usage or a case that
cannot be read, 3 a folder that cannot be written")]
pub(super) struct VaryArgs {
    /// Folder of stages
    #[arg(default_value = STAGES)]
    pub stages: PathBuf,
    /// Which set; with --check the first one
    #[arg(long, value_name = "N", required_unless_present = "check")]
    pub seed: Option<u64>,
    /// Folder to write, which must not exist or be empty [default: varied-N]
    #[arg(short, long, value_name = "DIR", conflicts_with = "check")]
    pub out: Option<PathBuf>,
    /// Draws sets and writes nothing: a table of how often the first draw does, and how much it
    /// shows at least
    #[arg(long)]
    pub check: bool,
    /// Sets that --check draws
    #[arg(
        long,
        value_name = "COUNT",
        default_value = "20",
        requires = "check",
        value_parser = clap::value_parser!(u64).range(1..=1_000_000)
    )]
    pub seeds: u64,
    /// Of these sets, how many are also rendered in all legal ways, for the share of contested
    /// pixels: that takes ten times as long
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
    /// What to describe
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
    /// A scene in TOML, outside of any stage
    SceneFile,
    /// The `stage.toml` of a stage
    Stage,
    /// What a course decides, `course.toml`
    Course,
    /// A resolved scene in JSON, as submissions get it
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
pub(super) enum Form {
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
