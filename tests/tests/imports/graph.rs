//! The graph of imports between the source files of a crate.
//!
//! File A imports file B if the code of A names an item that B defines. A re-export is followed to
//! the file that defines the item. A `mod.rs` that only re-exports the items of its folder
//! therefore imports nothing. Test modules do not count.

use std::collections::{BTreeMap, BTreeSet};

use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemMod, ItemUse, UseTree};
use tests::{files, name};

/// A path within a crate: the names of modules and of an item, from the root.
type Names = Vec<String>;

/// One import: the file that needs another, the other one, and the name that it uses.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Import {
    pub(super) from: String,
    pub(super) to: String,
    pub(super) item: String,
}

/// A module: a file, or a module within one.
#[derive(Default)]
struct Module {
    /// The file, below the folder of sources.
    file: String,
    /// The names of the items and of the modules that it defines.
    defined: BTreeSet<String>,
    /// True if macros define further items, with names that cannot be seen.
    has_macros: bool,
    /// The path behind each name that a `use` declares, as it is written.
    used: BTreeMap<String, Names>,
    /// The modules of which all names are used.
    globs: Vec<Names>,
    /// The paths that its code names, as they are written.
    named: BTreeSet<Names>,
    /// The names of private `use` declarations.
    imported: BTreeSet<String>,
}

/// The modules of a crate.
#[derive(Default)]
pub(super) struct Graph(BTreeMap<Names, Module>);

impl Graph {
    /// Reads the sources in `folder` of the workspace. Programs in `bin` and `main.rs` are crates
    /// of their own and are left out.
    ///
    /// # Panics
    /// Panics if a file cannot be read or parsed.
    pub(super) fn of(folder: &str) -> Self {
        let texts = files(folder, "rs").into_iter().filter_map(|path| {
            let file = name(&path).strip_prefix(folder)?.trim_start_matches('/').to_owned();
            let is_other =
                file == "main.rs" || file.starts_with("bin/") || file.ends_with("tests.rs");
            (!is_other).then(|| (file, std::fs::read_to_string(&path).expect("a source file")))
        });
        Self::read(texts)
    }

    /// Reads sources, each with its name below the folder of sources.
    ///
    /// # Panics
    /// Panics if a text cannot be parsed.
    pub(super) fn read(texts: impl Iterator<Item = (String, String)>) -> Self {
        let mut graph = Self::default();
        for (file, text) in texts {
            let parsed = syn::parse_file(&text).unwrap_or_else(|why| panic!("{file}: {why}"));
            graph.add(module_of(&file), &file, &parsed.items);
        }
        graph
    }

    /// Adds the module at `place`, and those within it.
    fn add(&mut self, place: Names, file: &str, items: &[Item]) {
        let mut module = Module { file: file.to_owned(), ..Module::default() };
        for item in items.iter().filter(|item| !is_test(attributes(item))) {
            match item {
                Item::Mod(ItemMod { ident, content: Some((_, items)), .. }) => {
                    module.defined.insert(ident.to_string());
                    self.add([place.as_slice(), &[ident.to_string()]].concat(), file, items);
                }
                Item::Use(one) => module.add_use(one),
                _ => {
                    module.defined.extend(defined(item));
                    module.has_macros |= matches!(item, Item::Macro(one) if one.ident.is_none());
                    Paths(&mut module.named).visit_item(item);
                }
            }
        }
        self.0.insert(place, module);
    }

    /// Returns all imports between different files.
    pub(super) fn imports(&self) -> BTreeSet<Import> {
        let mut imports = BTreeSet::new();
        for (place, module) in &self.0 {
            let private = module.used.iter().filter(|(name, _)| module.imported.contains(*name));
            for path in private.map(|(_, path)| path).chain(&module.named) {
                let Some(full) = self.full(place, path, &mut BTreeSet::new()) else { continue };
                let Some(to) = self.file_of(&full, &mut BTreeSet::new()) else { continue };
                if to != module.file {
                    imports.insert(Import { from: module.file.clone(), to, item: path.join("::") });
                }
            }
        }
        imports
    }

    /// Returns the groups of files that need each other, each with the imports that tie it.
    pub(super) fn cycles(&self) -> Vec<Vec<Import>> {
        let imports = self.imports();
        let mut next: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for import in &imports {
            next.entry(&import.from).or_default().insert(&import.to);
        }
        let reach: BTreeMap<&str, BTreeSet<&str>> =
            next.keys().map(|file| (*file, reached(file, &next))).collect();
        let reaches = |from: &str, to: &str| reach.get(from).is_some_and(|all| all.contains(to));
        let mut groups: BTreeMap<BTreeSet<&str>, Vec<Import>> = BTreeMap::new();
        for import in imports.iter().filter(|import| reaches(&import.to, &import.from)) {
            let all = reach[import.from.as_str()].iter().filter(|file| reaches(file, &import.from));
            groups.entry(all.copied().collect()).or_default().push(import.clone());
        }
        groups.into_values().collect()
    }

    /// Returns the path from the root that `path` means in the module at `place`. `None` if it
    /// leaves the crate or names something local.
    fn full(&self, place: &[String], path: &[String], seen: &mut BTreeSet<Names>) -> Option<Names> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => Some(rest.to_vec()),
            "self" => Some([place, rest].concat()),
            "super" => {
                let (_, around) = place.split_last()?;
                match rest.first().map(String::as_str) {
                    Some("super") => self.full(around, rest, seen),
                    _ => Some([around, rest].concat()),
                }
            }
            name => {
                let module = self.0.get(place)?;
                let inner = [place, std::slice::from_ref(first)].concat();
                if self.0.contains_key(&inner) || (rest.is_empty() && module.defined.contains(name))
                {
                    return Some([inner.as_slice(), rest].concat());
                }
                let target = module.used.get(name)?;
                let is_new = seen.insert([place, std::slice::from_ref(first)].concat());
                let target = if is_new { self.full(place, target, seen)? } else { return None };
                Some([target.as_slice(), rest].concat())
            }
        }
    }

    /// Returns the file that defines the item at `full`. `None` for a module and for an item of
    /// another crate.
    fn file_of(&self, full: &[String], seen: &mut BTreeSet<Names>) -> Option<String> {
        let n = (0..=full.len()).rev().find(|n| self.0.contains_key(&full[..*n]))?;
        let (place, module) = (&full[..n], &self.0[&full[..n]]);
        let (name, rest) = full[n..].split_first()?;
        if !seen.insert(full[..=n].to_vec()) {
            return None;
        }
        if module.defined.contains(name) {
            return Some(module.file.clone());
        }
        if let Some(target) = module.used.get(name) {
            let target = self.full(place, target, &mut BTreeSet::new())?;
            return self.file_of(&[target.as_slice(), rest].concat(), seen);
        }
        let globs: Vec<Names> = module
            .globs
            .iter()
            .filter_map(|glob| self.full(place, glob, &mut BTreeSet::new()))
            .collect();
        let through = |glob: &Names| self.file_of(&[glob.as_slice(), &full[n..]].concat(), seen);
        if let Some(file) = globs.iter().find_map(through) {
            return Some(file);
        }
        module.has_macros.then(|| module.file.clone())
    }
}

impl Module {
    fn add_use(&mut self, one: &ItemUse) {
        let is_private = matches!(one.vis, syn::Visibility::Inherited);
        self.add_tree(&one.tree, vec![], is_private);
    }

    fn add_tree(&mut self, tree: &UseTree, mut before: Names, is_private: bool) {
        match tree {
            UseTree::Path(path) => {
                before.push(path.ident.to_string());
                self.add_tree(&path.tree, before, is_private);
            }
            UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.add_tree(tree, before.clone(), is_private));
            }
            UseTree::Glob(_) => self.globs.push(before),
            UseTree::Name(one) if one.ident == "self" => {
                let name = before.last().cloned().unwrap_or_default();
                self.add_name(name, before, is_private);
            }
            UseTree::Name(one) => {
                before.push(one.ident.to_string());
                self.add_name(one.ident.to_string(), before, is_private);
            }
            UseTree::Rename(one) => {
                if one.ident != "self" {
                    before.push(one.ident.to_string());
                }
                self.add_name(one.rename.to_string(), before, is_private);
            }
        }
    }

    fn add_name(&mut self, name: String, path: Names, is_private: bool) {
        if is_private {
            self.imported.insert(name.clone());
        }
        self.used.insert(name, path);
    }
}

/// A visitor that collects the paths of more than one name, and those of one name that may be
/// imported.
struct Paths<'a>(&'a mut BTreeSet<Names>);

impl Paths<'_> {
    /// Collects the paths in a text that is not parsed.
    fn scan(&mut self, text: &str) {
        let text = text.replace(" :: ", "::");
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        for word in text.split(|c| !is_part(c)).filter(|word| word.contains("::")) {
            self.0.insert(word.trim_matches(':').split("::").map(str::to_owned).collect());
        }
    }
}

impl<'ast> Visit<'ast> for Paths<'_> {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.0.insert(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, one: &'ast syn::Macro) {
        self.scan(&one.tokens.to_string());
        visit::visit_macro(self, one);
    }

    /// Collects the items that attributes such as `#[serde(with = "super::affine")]` name in
    /// strings.
    fn visit_meta_list(&mut self, one: &'ast syn::MetaList) {
        self.scan(&one.tokens.to_string());
    }

    /// Collects a `use` within a function.
    fn visit_item_use(&mut self, one: &'ast ItemUse) {
        let mut module = Module::default();
        module.add_use(one);
        self.0.extend(module.used.into_values());
    }

    fn visit_item_mod(&mut self, _: &'ast ItemMod) {}
}

/// Returns the place of the module in `file`.
fn module_of(file: &str) -> Names {
    let mut place: Names = file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if matches!(place.last().map(String::as_str), Some("mod" | "lib")) {
        place.pop();
    }
    place
}

/// Returns the files that `file` needs, directly or through others.
fn reached<'a>(file: &'a str, next: &BTreeMap<&'a str, BTreeSet<&'a str>>) -> BTreeSet<&'a str> {
    let (mut found, mut open) = (BTreeSet::new(), vec![file]);
    while let Some(file) = open.pop() {
        open.extend(
            next.get(file).into_iter().flatten().copied().filter(|file| found.insert(*file)),
        );
    }
    found
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|one| {
        one.path().is_ident("cfg")
            && one.parse_args::<syn::Path>().is_ok_and(|what| what.is_ident("test"))
    })
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(one) => &one.attrs,
        Item::Enum(one) => &one.attrs,
        Item::Fn(one) => &one.attrs,
        Item::Impl(one) => &one.attrs,
        Item::Mod(one) => &one.attrs,
        Item::Static(one) => &one.attrs,
        Item::Struct(one) => &one.attrs,
        Item::Use(one) => &one.attrs,
        _ => &[],
    }
}

/// Returns the name that an item defines.
fn defined(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(one) => &one.ident,
        Item::Enum(one) => &one.ident,
        Item::Fn(one) => &one.sig.ident,
        Item::Macro(one) => one.ident.as_ref()?,
        Item::Static(one) => &one.ident,
        Item::Struct(one) => &one.ident,
        Item::Trait(one) => &one.ident,
        Item::Type(one) => &one.ident,
        _ => return None,
    };
    Some(ident.to_string())
}
