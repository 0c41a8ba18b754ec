//! The command `reference schema`.

use cases::schema;

use super::args::{SchemaArgs, SchemaKind};
use super::output::{print, print_json};
use super::stop::Stop;

/// Runs the command.
pub(super) fn run(args: &SchemaArgs) -> Result<(), Stop> {
    if args.markdown {
        return print(schema::scene_format_markdown().as_bytes());
    }
    print_json(&match args.kind {
        SchemaKind::Case => schema::case_schema(),
        SchemaKind::SceneFile => schema::scene_file_schema(),
        SchemaKind::Stage => schema::stage_schema(),
        SchemaKind::Course => schema::course_schema(),
        SchemaKind::Scene => schema::scene_schema(),
        SchemaKind::Probe => schema::probe_schema(),
    })
}
