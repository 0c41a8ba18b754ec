//! Reads scene files. The result is the resolved scene, or all problems of the file.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::model::Scene;
use super::raw::read::{Notes, Read, Value};
use super::raw::{RawRender, RawScene, RawSceneFile};
use super::{json, resolve, validate};
use crate::course::Course;
use crate::files;
use crate::problem::{Problems, Source};

/// Largest size, in bytes, of a file of which all errors of syntax are reported. Of a larger file
/// only the first one is, because a few megabytes of rubbish have millions, at a kilobyte each.
const MAX_RECOVERED_BYTES: usize = 256 << 10;
/// Largest size of a scene or case file, in bytes.
pub const MAX_SCENE_BYTES: u64 = 16 << 20;

/// Returns the scene of the file at `path`, in TOML or in JSON, which belongs to no stage.
pub(crate) fn load(path: &Path, course: &Course) -> Result<Scene, Problems> {
    let (name, text) = (path.display().to_string(), read(path)?);
    if path.extension().is_some_and(|end| end.eq_ignore_ascii_case("json")) {
        return parse_json(&name, &text);
    }
    parse(&name, &text, path.parent().unwrap_or(Path::new("")), course)
}

/// Parses a scene in TOML, which messages call `name`. The scene gets the effects that it calls for
/// under `course`. Paths of meshes are relative to `base_dir`.
///
/// # Errors
/// All problems of the text.
pub fn parse(name: &str, text: &str, base_dir: &Path, course: &Course) -> Result<Scene, Problems> {
    let (raw, mut notes) = document::<RawSceneFile>(name, text);
    let scene = raw.and_then(|raw| body(&raw.render.0, &raw.scene.0, base_dir, course, &mut notes));
    notes.finish(scene)
}

/// Parses a resolved scene in JSON, which messages call `name`.
///
/// # Errors
/// The text does not have the form of a scene, or the scene breaks rules that hold for every scene.
pub fn parse_json(name: &str, text: &str) -> Result<Scene, Problems> {
    let source = Source::new(name, text);
    let mut notes = Notes::new(source);
    let scene = json::from_str(text).map_err(|why| {
        let at = offset(text, why.line(), why.column());
        notes
            .add(at..at + 1, "this is no resolved scene", why.to_string())
            .help("`reference schema` prints its JSON Schema");
    });
    for broken in scene.iter().flat_map(validate::broken) {
        notes.add(0..0, broken, "");
    }
    notes.finish(scene.ok())
}

/// Returns the byte at which serde's line and column (in bytes, from 1) point.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let mut at = (start + column.saturating_sub(1)).min(text.len().saturating_sub(1));
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Returns the text of the file at `path`.
pub(crate) fn read(path: &Path) -> Result<String, Problems> {
    files::read_text(path, MAX_SCENE_BYTES).map_err(|why| Problems::of_reading(path, &why))
}

/// Reads a document as the table `T`, as far as it can be read. Also returns the problems so far.
pub(crate) fn document<T: Read>(name: &str, text: &str) -> (Option<T>, Notes) {
    let source = Source::new(name, text);
    let (root, mut notes) = root(&source);
    (root.and_then(|root| T::read(&root, &mut notes)), notes)
}

/// Returns the outermost table of a document, or `None` after noting why it is not TOML.
pub(crate) fn root(source: &Arc<Source>) -> (Option<Value<'_>>, Notes) {
    let (text, mut notes) = (source.text.as_str(), Notes::new(Arc::clone(source)));
    if text.trim().is_empty() {
        notes.add(0..0, "the file is empty", "");
        return (None, notes);
    }
    let (table, errors) = match text.len() <= MAX_RECOVERED_BYTES {
        true => DeTable::parse_recoverable(text),
        false => match DeTable::parse(text) {
            Ok(table) => (table, vec![]),
            Err(first) => (Spanned::new(0..0, DeTable::new()), vec![first]),
        },
    };
    for error in &errors {
        let span = error.span().map_or(0..0, |span| widened(text, span));
        notes.add(span, format!("this is not TOML: {}", error.message()), "");
    }
    // A part that the parser could not read is a hole, which would be reported as a missing key.
    (errors.is_empty().then(|| Spanned::new(0..0, DeValue::Table(table.into_inner()))), notes)
}

/// Widens `span` to at least one character, so that there is something to underline: the character
/// after it, or else the one before it.
fn widened(text: &str, span: Range<usize>) -> Range<usize> {
    let Some((before, rest)) = text.split_at_checked(span.start) else { return 0..0 };
    match rest.chars().next() {
        _ if span.end > span.start && text.is_char_boundary(span.end) => span,
        Some(next) if next != '\n' => span.start..span.start + next.len_utf8(),
        _ => {
            before.chars().next_back().map_or(0..0, |last| span.start - last.len_utf8()..span.start)
        }
    }
}

/// Resolves settings and scene. The problems of one are noted even if the other is missing.
pub(crate) fn body(
    render: &Option<RawRender>,
    scene: &Option<RawScene>,
    base_dir: &Path,
    course: &Course,
    notes: &mut Notes,
) -> Option<Scene> {
    let render = render.as_ref().and_then(|raw| resolve::render(raw, notes));
    scene.as_ref().and_then(|raw| resolve::scene(raw, render, base_dir, course, notes))
}
