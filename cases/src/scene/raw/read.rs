//! Reads typed values from parsed TOML. A problem is noted and stops nothing: the rest is read as
//! well.

use std::collections::BTreeMap;
use std::ops::{Deref, Range};
use std::sync::Arc;

use schemars::JsonSchema;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::problem::{MAX_PROBLEMS, Problem, Problems, Source, did_you_mean, quoted};

/// A parsed value with its position in the file.
pub(crate) type Value<'i> = Spanned<DeValue<'i>>;

/// The problems of one file, in the order in which they are found.
#[derive(Debug)]
pub(crate) struct Notes {
    source: Arc<Source>,
    problems: Vec<Problem>,
    /// Number of problems added, of which at most [`MAX_PROBLEMS`] are kept.
    n_added: usize,
}

impl Notes {
    pub(crate) fn new(source: Arc<Source>) -> Self {
        Self { source, problems: vec![], n_added: 0 }
    }

    /// Notes a problem at `span` and returns it, so that the caller can add help. An empty span
    /// stands for the whole file.
    pub(crate) fn add(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        label: impl Into<String>,
    ) -> &mut Problem {
        let span = (!span.is_empty()).then_some(span);
        self.n_added += 1;
        // Beyond the limit each problem replaces the last one. Only text that nobody would read is
        // lost.
        self.problems.truncate(MAX_PROBLEMS - 1);
        let source = Arc::clone(&self.source);
        let at = self.problems.len();
        self.problems.push(Problem {
            source,
            span,
            message: abridged(message.into()),
            label: abridged(label.into()),
            help: None,
            os_error: None,
        });
        &mut self.problems[at]
    }

    /// Returns whether the limit is reached, so that a further problem replaces the last one.
    fn is_full(&self) -> bool {
        self.problems.len() >= MAX_PROBLEMS
    }

    /// Notes that `value` is not `wanted`, which is a phrase such as "a number".
    pub(crate) fn wrong(&mut self, value: &Value<'_>, wanted: &str) -> &mut Problem {
        let found = kind(value.get_ref());
        let message = format!("this is {found}, not {wanted}");
        self.add(value.span(), message, format!("expected {wanted}"))
    }

    /// Returns the number of problems so far, which never falls.
    pub(crate) fn len(&self) -> usize {
        self.n_added
    }

    /// Returns `value` if no problem was noted, or all problems.
    pub(crate) fn finish<T>(self, value: Option<T>) -> Result<T, Problems> {
        match (Problems::new(self.problems), value) {
            (Some(problems), _) => Err(problems),
            (None, Some(value)) => Ok(value),
            (None, None) => {
                Err(Problems::of_file(&self.source.name, "it cannot be understood", None))
            }
        }
    }
}

fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// A type that can be read from a TOML value.
pub(crate) trait Read: Sized {
    /// Returns the value, or `None` after noting the problem.
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self>;

    /// Returns the value for a missing key. By default the key is required: its absence is noted,
    /// and the result is `None`.
    fn absent(key: &str, table: &Table<'_>, notes: &mut Notes) -> Option<Self> {
        table.miss(key, notes);
        None
    }
}

/// A value with its byte range in the file.
#[derive(Clone, Debug)]
pub(crate) struct At<T> {
    pub(crate) value: T,
    pub(crate) span: Range<usize>,
}

impl<T> Deref for At<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T: Read> Read for At<T> {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        T::read(value, notes).map(|read| Self { value: read, span: value.span() })
    }
}

/// An optional key. A value that is wrong is noted and becomes `None`.
impl<T: Read> Read for Option<T> {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        Some(T::read(value, notes))
    }

    fn absent(_: &str, _: &Table<'_>, _: &mut Notes) -> Option<Self> {
        Some(None)
    }
}

/// A required key whose failure does not stop the reading of its table. A value that is wrong or
/// missing is noted and becomes `None`.
#[derive(Clone, Debug)]
pub(crate) struct Maybe<T>(pub(crate) Option<T>);

impl<T: Read> Read for Maybe<T> {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        Some(Self(T::read(value, notes)))
    }

    fn absent(key: &str, table: &Table<'_>, notes: &mut Notes) -> Option<Self> {
        table.miss(key, notes);
        Some(Self(None))
    }
}

/// A list, which is read only if all of its items can be read.
impl<T: Read> Read for Vec<T> {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let Some(items) = value.get_ref().as_array() else {
            notes.wrong(value, "a list");
            return None;
        };
        let read: Vec<Option<T>> = items.iter().map(|item| T::read(item, notes)).collect();
        read.into_iter().collect()
    }
}

/// A list in which wrong items are noted and become `None`, so that the others keep their indices.
#[derive(Clone, Debug)]
pub(crate) struct Each<T>(pub(crate) Vec<Option<T>>);

impl<T> Each<T> {
    /// Returns whether an item is missing because it could not be read.
    pub(crate) fn has_hole(&self) -> bool {
        self.0.iter().any(Option::is_none)
    }
}

impl<T: Read> Read for Each<T> {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        Vec::<Maybe<T>>::read(value, notes)
            .map(|items| Self(items.into_iter().map(|item| item.0).collect()))
    }
}

/// A table whose keys are names that the author chooses. An item that cannot be read is left out.
impl<T: Read> Read for BTreeMap<String, T> {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let Some(entries) = value.get_ref().as_table() else {
            notes.wrong(value, "a table");
            return None;
        };
        Some(
            entries
                .iter()
                .filter_map(|(name, item)| {
                    Some((name.get_ref().to_string(), T::read(item, notes)?))
                })
                .collect(),
        )
    }
}

impl<T: Read, const N: usize> Read for [T; N] {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        match value.get_ref().as_array() {
            Some(items) if items.len() == N => Vec::read(value, notes)?.try_into().ok(),
            Some(items) => {
                let label = format!("{} here", items.len());
                notes.add(value.span(), format!("this is not a list of {N}"), label);
                None
            }
            None => {
                notes.wrong(value, &format!("a list of {N}"));
                None
            }
        }
    }
}

impl Read for bool {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let read = value.get_ref().as_bool();
        if read.is_none() {
            notes.wrong(value, "true or false");
        }
        read
    }
}

impl Read for String {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let read = value.get_ref().as_str().map(str::to_owned);
        if read.is_none() {
            notes.wrong(value, "a text in quotes");
        }
        read
    }
}

/// A table that is being read by a type with known keys.
pub(crate) struct Table<'a> {
    what: &'static str,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
    excused: Vec<&'a str>,
}

impl<'a> Table<'a> {
    /// Opens `value` as `what`, which is a phrase such as "a camera". Notes the keys that are not
    /// among `known`.
    pub(crate) fn open(
        what: &'static str,
        known: &[&'a str],
        value: &'a Value<'a>,
        notes: &mut Notes,
    ) -> Option<Self> {
        let Some(entries) = value.get_ref().as_table() else {
            notes.wrong(value, &format!("{what}: a table of keys"));
            return None;
        };
        let mut table = Self { what, span: value.span(), entries, excused: vec![] };
        for (key, _) in entries {
            if !known.contains(&key.get_ref().as_ref()) {
                table.refuse(key.get_ref(), key.span(), known, notes);
            }
        }
        Some(table)
    }

    fn refuse(&mut self, key: &str, span: Range<usize>, known: &[&'a str], notes: &mut Notes) {
        if notes.is_full() {
            // No suggestion is searched for: a file may have a million unknown keys, and nobody
            // would read a million suggestions.
            notes.add(span, format!("unknown key `{key}`"), "");
            return;
        }
        let unused = known.iter().copied().filter(|known| !self.has(known));
        let meant = did_you_mean(key, unused);
        let problem = notes.add(
            span,
            format!("unknown key `{key}`"),
            format!("{} has no such key", self.what),
        );
        problem.help(match meant {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("its keys are {}", quoted(known.iter().copied())),
        });
        // One mistake must not be reported twice, as an unknown key and as a missing one.
        self.excused.extend(meant);
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    pub(crate) fn entry(&self, key: &str) -> Option<&'a Value<'a>> {
        self.entries.get(key)
    }

    pub(crate) fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// Reads the value of `key`. A missing key has the value that its type gives.
    pub(crate) fn field<T: Read>(&self, key: &str, notes: &mut Notes) -> Option<T> {
        match self.entry(key) {
            Some(value) => T::read(value, notes),
            None => T::absent(key, self, notes),
        }
    }

    /// Reads the value of `key`, or of `default`, which is TOML text, if the key is missing.
    pub(crate) fn field_or<T: Read>(
        &self,
        key: &str,
        default: &str,
        notes: &mut Notes,
    ) -> Option<T> {
        match (self.entry(key), DeValue::parse(default)) {
            (Some(value), _) => T::read(value, notes),
            (None, Ok(value)) => T::read(&Spanned::new(self.span(), value.into_inner()), notes),
            (None, Err(_)) => T::absent(key, self, notes),
        }
    }

    fn miss(&self, key: &str, notes: &mut Notes) {
        if !self.excused.contains(&key) {
            let label = format!("{} needs this key", self.what);
            notes.add(self.span(), format!("missing key `{key}`"), label);
        }
    }
}

/// Returns a key as it is written in a file: `r#box` becomes `box`.
pub(crate) fn plain(key: &'static str) -> &'static str {
    key.strip_prefix("r#").unwrap_or(key)
}

/// Returns the JSON form of a default that is TOML text, for the schema; `null` for other text.
pub(crate) fn json(default: &str) -> serde_json::Value {
    toml::from_str::<BTreeMap<String, serde_json::Value>>(&format!("it = {default}"))
        .ok()
        .and_then(|mut table| table.remove("it"))
        .unwrap_or_default()
}

/// Declares a table of a file once: its type, its reader and its schema. A field is `key: Type`, or
/// `key: Type = "default as in a file"`; an optional key without a default is an `Option`. With
/// `exactly one of`, exactly one of the listed keys has to be present.
macro_rules! table {
    ($(#[$meta:meta])* $what:literal $name:ident {
        $( $(#[$field_meta:meta])* $field:ident : $type:ty $(= $default:literal)? ),* $(,)?
    } $(exactly one of $choice:expr)?) => {
        #[derive(Clone, Debug, schemars::JsonSchema)]
        #[schemars(deny_unknown_fields)]
        $(#[$meta])*
        pub(crate) struct $name {
            $(
                $(#[$field_meta])*
                $(#[schemars(extend("default" = $crate::scene::raw::read::json($default)))])?
                pub(crate) $field: $type,
            )*
        }

        impl $crate::scene::raw::read::Read for $name {
            fn read(
                value: &$crate::scene::raw::read::Value<'_>,
                notes: &mut $crate::scene::raw::read::Notes,
            ) -> Option<Self> {
                use $crate::scene::raw::read::Table;
                let keys = &[$($crate::scene::raw::read::plain(stringify!($field))),*];
                let _table = Table::open($what, keys, value, notes)?;
                $( _table.only_one_of(&$choice, notes); )?
                $( let $field = table!(@read _table notes $field $($default)?); )*
                Some(Self { $($field: $field?),* })
            }
        }
    };
    (@read $table:ident $notes:ident $field:ident $default:literal) => {
        $table.field_or($crate::scene::raw::read::plain(stringify!($field)), $default, $notes)
    };
    (@read $table:ident $notes:ident $field:ident) => {
        $table.field($crate::scene::raw::read::plain(stringify!($field)), $notes)
    };
}

/// Declares a table with exactly one of several keys: an enum, its reader and its schema.
macro_rules! choice {
    ($(#[$meta:meta])* $what:literal $name:ident {
        $( $(#[$variant_meta:meta])* $key:literal $variant:ident ( $type:ty ) ),* $(,)?
    }) => {
        $(#[$meta])*
        #[derive(Clone, Debug, schemars::JsonSchema)]
        pub(crate) enum $name {
            $( $(#[$variant_meta])* #[schemars(rename = $key)] $variant($type), )*
        }

        impl $crate::scene::raw::read::Read for $name {
            fn read(
                value: &$crate::scene::raw::read::Value<'_>,
                notes: &mut $crate::scene::raw::read::Notes,
            ) -> Option<Self> {
                use $crate::scene::raw::read::Table;
                let known = [$($key),*];
                let table = Table::open($what, &known, value, notes)?;
                match table.only_one_of(&known, notes)? {
                    $( $key => table.field($key, notes).map(Self::$variant), )*
                    _ => None,
                }
            }
        }
    };
}

pub(crate) use {choice, table};

impl Table<'_> {
    /// Returns the one of `keys` that is present. None or several are noted.
    pub(crate) fn only_one_of(
        &self,
        keys: &[&'static str],
        notes: &mut Notes,
    ) -> Option<&'static str> {
        let there: Vec<&'static str> = keys.iter().copied().filter(|key| self.has(key)).collect();
        match there[..] {
            [one] => return Some(one),
            [] if self.excused.is_empty() => {
                let message =
                    format!("{} needs one of {}", self.what, quoted(keys.iter().copied()));
                notes.add(self.span(), message, "none of them is here");
            }
            [] => {}
            [_, second, ..] => {
                let message =
                    format!("{} has only one of {}", self.what, quoted(keys.iter().copied()));
                let span = self.entry(second).map_or(self.span(), Spanned::span);
                notes.add(span, message, format!("{} are here", quoted(there.iter().copied())));
            }
        }
        None
    }
}

/// Gives wrappers the schema of the wrapped type.
macro_rules! transparent_schema {
    ($($wrapper:ident => $inner:ty),*) => {$(
        impl<T: JsonSchema> JsonSchema for $wrapper<T> {
            fn inline_schema() -> bool {
                <$inner>::inline_schema()
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                <$inner>::schema_name()
            }

            fn schema_id() -> std::borrow::Cow<'static, str> {
                <$inner>::schema_id()
            }

            fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                <$inner>::json_schema(generator)
            }
        }
    )*};
}

transparent_schema!(At => T, Maybe => T, Each => Vec<T>);

/// Largest number of characters of a message, which may quote a word of any length.
const MAX_MESSAGE: usize = 1000;

/// Shortens a message to [`MAX_MESSAGE`] characters. A shortened message ends in `…`.
fn abridged(message: String) -> String {
    match message.char_indices().nth(MAX_MESSAGE) {
        Some((end, _)) => format!("{}…", &message[..end]),
        None => message,
    }
}
