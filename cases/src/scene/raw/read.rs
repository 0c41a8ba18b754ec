//! Reading typed values out of parsed TOML, where no problem stops the reading: it is noted, and
//! the rest is read as well.

use std::collections::BTreeMap;
use std::ops::{Deref, Range};
use std::sync::Arc;

use schemars::JsonSchema;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::problem::{MAX_PROBLEMS, Problem, Problems, Source, did_you_mean, quoted};

/// A value as the parser gives it, with its place.
pub(crate) type Value<'i> = Spanned<DeValue<'i>>;

/// The problems of one file, as they are found.
#[derive(Debug)]
pub(crate) struct Notes {
    source: Arc<Source>,
    problems: Vec<Problem>,
    /// Problems that were added, of which at most [`MAX_PROBLEMS`] are kept.
    n_added: usize,
}

impl Notes {
    pub(crate) fn new(source: Arc<Source>) -> Self {
        Self { source, problems: vec![], n_added: 0 }
    }

    /// Notes a problem at `span` (an empty one is the file as a whole); the result takes the help.
    pub(crate) fn add(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        label: impl Into<String>,
    ) -> &mut Problem {
        let span = (!span.is_empty()).then_some(span);
        self.n_added += 1;
        // Beyond the limit each problem replaces the last one: what is lost is only text that
        // nobody would read.
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

    /// Whether so many problems are known that no other one is kept.
    fn is_full(&self) -> bool {
        self.problems.len() >= MAX_PROBLEMS
    }

    /// Notes that `value` is not `wanted`, such as "a number".
    pub(crate) fn wrong(&mut self, value: &Value<'_>, wanted: &str) -> &mut Problem {
        let found = kind(value.get_ref());
        self.add(
            value.span(),
            format!("this is {found}, not {wanted}"),
            format!("{wanted} is due here"),
        )
    }

    /// Returns the number of problems so far, which never falls.
    pub(crate) fn len(&self) -> usize {
        self.n_added
    }

    /// `value`, if nothing was noted.
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

/// What can be read from a value.
pub(crate) trait Read: Sized {
    /// The value, or `None` once what is wrong has been noted.
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self>;

    /// What stands for a missing key; by default the key is required, and its absence noted.
    fn absent(key: &str, table: &Table<'_>, notes: &mut Notes) -> Option<Self> {
        table.miss(key, notes);
        None
    }
}

/// A value with its place in the file.
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

/// An optional key. What is there but wrong is noted, and left out.
impl<T: Read> Read for Option<T> {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        Some(T::read(value, notes))
    }

    fn absent(_: &str, _: &Table<'_>, _: &mut Notes) -> Option<Self> {
        Some(None)
    }
}

/// A required key whose failure, once noted, does not keep its neighbours from being looked at.
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

/// A list, whole or not at all.
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

/// A list of which wrong items are noted and stand as `None`, so that the others keep their places.
#[derive(Clone, Debug)]
pub(crate) struct Each<T>(pub(crate) Vec<Option<T>>);

impl<T> Each<T> {
    /// Whether an item is missing because it could not be read.
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

/// A table whose keys are names that the author chooses.
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
                notes.add(value.span(), format!("a list of {N} is due here"), label);
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

/// A table that is being read, for the keys that its type knows.
pub(crate) struct Table<'a> {
    what: &'static str,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
    excused: Vec<&'a str>,
}

impl<'a> Table<'a> {
    /// Opens `value`, which is to be `what` (as "a camera"), and notes the keys that are not among
    /// `known`.
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
            // A file of a million unknown keys is not searched for a million suggestions that
            // nobody reads.
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
        // The one mistake is not to be reported twice, as an unknown key and as a missing one.
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

    /// The value of `key`, or what stands for it where it is missing.
    pub(crate) fn field<T: Read>(&self, key: &str, notes: &mut Notes) -> Option<T> {
        match self.entry(key) {
            Some(value) => T::read(value, notes),
            None => T::absent(key, self, notes),
        }
    }

    /// The value of `key`, or `default`, which is written as in a file.
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

/// Keys as they stand in a file: `r#box` is written `box`.
pub(crate) fn plain(key: &'static str) -> &'static str {
    key.strip_prefix("r#").unwrap_or(key)
}

/// The JSON form of a default that is written as in a file, for the schema.
pub(crate) fn json(default: &str) -> serde_json::Value {
    toml::from_str::<BTreeMap<String, serde_json::Value>>(&format!("it = {default}"))
        .ok()
        .and_then(|mut table| table.remove("it"))
        .unwrap_or_default()
}

/// Declares a table of a file once: its type, how it is read, and its schema. A field is
/// `key: Type`, or `key: Type = "default as in a file"`; an optional key without a default is an
/// `Option`. `exactly one of` a list of its keys has to be there.
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

/// Declares a table with exactly one key out of several: an enum, how it is read, and its schema.
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
    /// The one of `keys` that is there; none or several are noted.
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

/// Wrappers of reading leave the schema as it is.
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

/// Characters of a message, which may quote a word of any length.
const MAX_MESSAGE: usize = 1000;

/// Returns a message that people can read. A longer one ends in `…`.
fn abridged(message: String) -> String {
    match message.char_indices().nth(MAX_MESSAGE) {
        Some((end, _)) => format!("{}…", &message[..end]),
        None => message,
    }
}
