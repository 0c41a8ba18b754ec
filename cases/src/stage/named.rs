//! The scenes and materials of a file of unit checks, which its questions refer to by name.

use std::collections::BTreeMap;

use toml::Spanned;

use crate::problem::{did_you_mean, quoted};
use crate::scene::raw::read::{At, Notes, Table};
use crate::scene::{Material, Scene};

/// The definitions that questions may refer to; `None` is one that could not be read.
pub(super) struct Named {
    pub(super) scenes: BTreeMap<String, Option<Scene>>,
    pub(super) materials: BTreeMap<String, Option<Material>>,
}

/// Returns the entry of `of` that the key's value names. A name that is not defined is noted.
pub(super) fn by_name<'n, T>(
    of: &'n BTreeMap<String, Option<T>>,
    section: &str,
    name: &At<String>,
    notes: &mut Notes,
) -> Option<&'n T> {
    let Some(found) = of.get(name.as_str()) else {
        let problem = notes.add(
            name.span.clone(),
            format!("`{}` is not defined", name.value),
            format!("not in [{section}]"),
        );
        let defined = format!("defined here: {}", quoted(of.keys().map(String::as_str)));
        problem.help(match did_you_mean(name, of.keys().map(String::as_str)) {
            Some(meant) => format!("did you mean `{meant}`? {defined}"),
            None => defined,
        });
        return None;
    };
    found.as_ref()
}

/// Returns the scene that a question names, for the arguments that depend on it. Nothing is noted
/// if there is none.
pub(super) fn scene_of<'n>(table: &Table<'_>, named: &'n Named) -> Option<&'n Scene> {
    let name = table.entry("scene").map(Spanned::get_ref)?.as_str()?;
    named.scenes.get(name)?.as_ref()
}
