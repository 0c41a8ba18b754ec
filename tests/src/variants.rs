//! Variants of the solution: with one bug each, and right but written differently. They are data,
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
    /// Its path below `tests/mutants`, such as `wrong/reflect/backwards`.
    pub name: String,
    /// What it does differently, in a sentence.
    pub does: String,
    /// What a judge should say of it.
    pub nature: Nature,
    /// The folder of the submission that is changed.
    pub base: PathBuf,
    /// The changes, made one after the other.
    pub edits: Vec<Edit>,
}

/// What a judge should say of a variant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Nature {
    /// All points, and no misconception is named.
    Right,
    /// Points are lost.
    Wrong {
        /// The first stage that loses points.
        stage: String,
        /// Id of the misconception that is to be named first; `None` where none describes the bug.
        diagnosis: Option<String>,
    },
}

impl Variant {
    /// Whether it deserves all points.
    pub fn is_right(&self) -> bool {
        self.nature == Nature::Right
    }

    /// Makes the submission in a folder of its own.
    ///
    /// # Errors
    /// A text to search for that does not stand in its file exactly once; a file that cannot be
    /// read or written.
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
    /// Which, relative to the submission.
    pub file: String,
    /// Text that stands there exactly once; `None`: the whole file.
    pub search: Option<String>,
    /// What comes in its place.
    pub replace: String,
}

impl Edit {
    /// Makes it in the submission in `folder`.
    ///
    /// # Errors
    /// A text to search for that does not stand there exactly once, a change that changes nothing,
    /// a file that cannot be read or written.
    pub fn make(&self, folder: &Path) -> Result<(), String> {
        let path = folder.join(&self.file);
        let text = fs::read_to_string(&path).map_err(|why| why.to_string())?;
        let changed = match &self.search {
            None => self.replace.clone(),
            Some(search) => match text.matches(search.as_str()).count() {
                1 => text.replacen(search.as_str(), &self.replace, 1),
                n => {
                    return Err(format!(
                        "the text to search for stands there {n} times, not once: {search}"
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

/// `wrong/FUNCTION.toml`: bugs in one function.
#[derive(Deserialize)]
struct WrongFile {
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

/// `right/TOPIC.toml`: right ways to write it.
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
    /// Other right ways, `TOPIC/NAME`, whose edits are made first.
    #[serde(default)]
    with: Vec<String>,
    #[serde(default)]
    edits: Vec<Edit>,
}

fn solution() -> String {
    "tests/solution".to_owned()
}

/// All of them by name, the right ones first.
///
/// # Errors
/// What in the files is wrong, and in which.
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
    for (function, WrongFile { file, stage, bugs }) in tables::<WrongFile>("wrong")? {
        variants.extend(bugs.into_iter().map(|(name, bug)| {
            Variant {
                name: format!("wrong/{function}/{name}"),
                does: bug.does,
                nature: Nature::Wrong {
                    stage: bug.stage.unwrap_or_else(|| stage.clone()),
                    diagnosis: bug.diagnosis,
                },
                base: workspace().join(solution()),
                edits: std::iter::once(Edit {
                    file: file.clone(),
                    search: Some(bug.search),
                    replace: bug.replace,
                })
                .chain(bug.more)
                .collect(),
            }
        }));
    }
    Ok(variants)
}

/// The edits of a right way and, before them, of those it builds on, each once.
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

/// Copies what a student hands in: the manifest of a submission in another language, and sources.
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
