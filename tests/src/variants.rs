//! Variants of the solution: with one bug each, and correct but written differently. They are data,
//! `tests/mutants/README.md`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use tempfile::TempDir;

use crate::{files, workspace};

/// A submission made by changing another one.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The path below `tests/mutants`, such as `wrong/reflect/backwards`.
    pub name: String,
    /// The difference from the solution, in a sentence.
    pub does: String,
    /// The expected verdict.
    pub nature: Nature,
    /// The folder of the submission that is changed.
    pub base: PathBuf,
    /// The changes, which are made one after the other.
    pub edits: Vec<Edit>,
}

/// The expected verdict on a variant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Nature {
    /// The variant earns all points, and no misconception is named.
    Right,
    /// The variant loses points.
    Wrong {
        /// The first stage that loses points.
        stage: String,
        /// The id of the misconception that should be named first; `None` if none describes the
        /// bug.
        diagnosis: Option<String>,
    },
}

impl Variant {
    /// Returns whether the variant deserves all points.
    pub fn is_right(&self) -> bool {
        self.nature == Nature::Right
    }

    /// Writes the submission into a folder of its own.
    ///
    /// # Errors
    /// Returns an error if a text to search for does not occur in its file exactly once, or if a
    /// file cannot be read or written.
    pub fn make(&self) -> Result<TempDir, String> {
        let folder = tempfile::tempdir().map_err(|why| format!("a temporary folder: {why}"))?;
        copy(&self.base, folder.path()).map_err(|why| format!("{}: {why}", self.base.display()))?;
        for edit in &self.edits {
            edit.make(folder.path())
                .map_err(|why| format!("{}: {}: {why}", self.name, edit.file))?;
        }
        Ok(folder)
    }
}

/// A change of one file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// The path of the file, relative to the submission.
    pub file: String,
    /// The text to replace, which occurs exactly once; `None` for the whole file.
    pub search: Option<String>,
    /// The new text.
    pub replace: String,
}

impl Edit {
    /// Changes the file in the submission in `folder`.
    ///
    /// # Errors
    /// Returns an error if the text to search for does not occur exactly once, if nothing changes,
    /// or if the file cannot be read or written.
    pub fn make(&self, folder: &Path) -> Result<(), String> {
        let path = folder.join(&self.file);
        let text = fs::read_to_string(&path).map_err(|why| why.to_string())?;
        let changed = match &self.search {
            None => self.replace.clone(),
            Some(search) => match text.matches(search.as_str()).count() {
                1 => text.replacen(search.as_str(), &self.replace, 1),
                n => {
                    return Err(format!(
                        "the text to search for occurs {n} times, not once: {search}"
                    ));
                }
            },
        };
        if changed == text {
            return Err("nothing changes".to_owned());
        }
        fs::write(&path, changed).map_err(|why| why.to_string())
    }
}

/// The file `wrong/FUNCTION.toml`: bugs in one function. In `elsewhere/FILE.toml`, the bugs are in
/// a file of another program, outside of these functions.
#[derive(Deserialize)]
struct WrongFile {
    #[serde(default = "solution")]
    base: String,
    file: String,
    stage: String,
    #[serde(flatten)]
    bugs: BTreeMap<String, Bug>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Bug {
    does: String,
    search: String,
    replace: String,
    stage: Option<String>,
    diagnosis: Option<String>,
    #[serde(default)]
    more: Vec<Edit>,
}

/// The file `right/TOPIC.toml`: correct ways to write it.
#[derive(Deserialize)]
#[serde(transparent)]
struct RightFile {
    ways: BTreeMap<String, Way>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Way {
    does: String,
    #[serde(default = "solution")]
    base: String,
    /// Other correct ways, `TOPIC/NAME`, with edits that are made first.
    #[serde(default)]
    with: Vec<String>,
    #[serde(default)]
    edits: Vec<Edit>,
}

fn solution() -> String {
    "tests/solution".to_owned()
}

/// Returns all variants by name, the correct ones first.
///
/// # Errors
/// Returns the name of a wrong file, with the problem.
pub fn all() -> Result<Vec<Variant>, String> {
    let topics = tables::<RightFile>("right")?;
    let named = |(topic, file): (String, RightFile)| {
        file.ways
            .into_iter()
            .map(move |(name, way)| (format!("{topic}/{name}"), way))
            .collect::<Vec<_>>()
    };
    let ways: BTreeMap<String, Way> = topics.into_iter().flat_map(named).collect();
    let right = ways.iter().map(|(name, way)| {
        Ok(Variant {
            name: format!("right/{name}"),
            does: way.does.clone(),
            nature: Nature::Right,
            base: workspace().join(&way.base),
            edits: edits_of(&ways, name)?,
        })
    });
    let mut variants = right.collect::<Result<Vec<Variant>, String>>()?;
    for kind in ["wrong", "elsewhere"] {
        for (place, file) in tables::<WrongFile>(kind)? {
            variants.extend(file.variants(&format!("{kind}/{place}")));
        }
    }
    Ok(variants)
}

impl WrongFile {
    /// Returns the variants of the file `path`, a name without the ending.
    fn variants(self, path: &str) -> Vec<Variant> {
        let Self { base, file, stage, bugs } = self;
        let variant = |(name, bug): (String, Bug)| Variant {
            name: format!("{path}/{name}"),
            does: bug.does,
            nature: Nature::Wrong {
                stage: bug.stage.unwrap_or_else(|| stage.clone()),
                diagnosis: bug.diagnosis,
            },
            base: workspace().join(&base),
            edits: std::iter::once(Edit {
                file: file.clone(),
                search: Some(bug.search),
                replace: bug.replace,
            })
            .chain(bug.more)
            .collect(),
        };
        bugs.into_iter().map(variant).collect()
    }
}

/// Returns the edits of the ways that a correct way builds on, each once, followed by its own
/// edits.
fn edits_of(ways: &BTreeMap<String, Way>, name: &str) -> Result<Vec<Edit>, String> {
    fn collect<'a>(
        ways: &'a BTreeMap<String, Way>,
        name: &'a str,
        seen: &mut Vec<&'a str>,
    ) -> Result<Vec<Edit>, String> {
        let way = ways.get(name).ok_or_else(|| format!("tests/mutants/right has no {name}"))?;
        if seen.contains(&name) {
            return Ok(vec![]);
        }
        seen.push(name);
        let mut edits = vec![];
        for other in &way.with {
            edits.extend(collect(ways, other, seen)?);
        }
        edits.extend(way.edits.iter().cloned());
        Ok(edits)
    }
    collect(ways, name, &mut vec![])
}

fn tables<T: DeserializeOwned>(kind: &str) -> Result<Vec<(String, T)>, String> {
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).map_err(|why| format!("{}: {why}", path.display()))?;
        let table = toml::from_str(&text).map_err(|why| format!("{}: {why}", path.display()))?;
        Ok((path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), table))
    };
    files(&format!("tests/mutants/{kind}"), "toml").into_iter().map(read).collect()
}

/// Copies the files that a student hands in: sources, and the manifest of a submission in another
/// language.
fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            fs::create_dir(&target)?;
            copy(&path, &target)?;
        } else if !path.ends_with("Cargo.toml") && !path.ends_with("clippy.toml") {
            fs::copy(&path, &target)?;
        }
    }
    Ok(())
}
