//! Declares, reads and describes decisions. All decisions share this code.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::Value as Json;
use toml::de::DeValue;

use crate::effects::Effects;
use crate::problem::{did_you_mean, quoted};
use crate::ray::RAY_EPSILON;
use crate::scene::raw::effect::EffectName;
use crate::scene::raw::numbers::finite;
use crate::scene::raw::read::{Notes, Read, Table, Value, json};

/// A decision on which courses differ, as one key of `course.toml`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The key in `course.toml`.
    pub key: &'static str,
    /// The subject of the decision, as a phrase.
    pub decides: &'static str,
    /// The rules of light that the decision belongs to.
    pub rules: &'static [u8],
    /// The number of the decision in `docs/shading-model.md` where no rule settles it: 25 for D25.
    pub number: Option<u8>,
    /// The legal values.
    pub legal: Legal,
}

/// The values that a course may choose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Legal {
    /// Listed values: each as written in the file, and its meaning. The lecture's comes first.
    OneOf(&'static [(&'static str, &'static str)]),
    /// Any set of effects. The lecture's is empty.
    Effects,
    /// Any number from `least` to `most`.
    Range {
        /// Least value.
        least: f64,
        /// Greatest value.
        most: f64,
        /// The lecture's value.
        lecture: f64,
    },
}

impl Legal {
    /// Returns the lecture's value in its written form.
    pub fn lecture(&self) -> String {
        match self {
            Self::OneOf(values) => {
                values.first().map_or_else(String::new, |(written, _)| (*written).to_owned())
            }
            Self::Range { lecture, .. } => format!("{lecture:e}"),
            Self::Effects => effects_as_written(Effects::NONE),
        }
    }
}

/// Returns a set of effects in its written form, such as `["shadows", "reflection"]`.
pub(super) fn effects_as_written(effects: Effects) -> String {
    let names: Vec<String> = effects.iter().map(|effect| format!("\"{effect}\"")).collect();
    format!("[{}]", names.join(", "))
}

/// A type whose values are the legal values of one key.
pub(super) trait Choice: Copy + Default + 'static {
    /// The key in the file.
    const KEY: &'static str;
    /// Every value with its written form and its meaning. The lecture's comes first.
    const VALUES: &'static [(Self, &'static str, &'static str)];
}

/// Returns the value that a file gives, or `None` after noting a problem.
pub(super) fn read<T: Choice>(value: &Value<'_>, notes: &mut Notes) -> Option<T> {
    let legal = T::VALUES.iter().map(|(_, written, _)| *written);
    let written = one_of(T::KEY, legal, value, notes)?;
    T::VALUES.iter().find(|(_, legal, _)| *legal == written).map(|(value, ..)| *value)
}

/// Returns a legal value of `decision` in the written form that [`Course::written`] uses, or `None`
/// after noting a problem.
///
/// [`Course::written`]: super::Course::written
pub(super) fn value_as_written(
    decision: &Decision,
    value: &Value<'_>,
    notes: &mut Notes,
) -> Option<String> {
    match decision.legal {
        Legal::OneOf(values) => {
            one_of(decision.key, values.iter().map(|(written, _)| *written), value, notes)
        }
        Legal::Range { .. } => {
            RawEpsilon::read(value, notes).map(|epsilon| format!("{:e}", epsilon.0))
        }
        Legal::Effects => {
            RawEffects::read(value, notes).map(|effects| effects_as_written(effects.0))
        }
    }
}

/// Returns the written form of `value` if it is one of the `legal` ones, or `None` after noting a
/// problem.
fn one_of<'a>(
    key: &str,
    legal: impl Iterator<Item = &'a str> + Clone,
    value: &Value<'_>,
    notes: &mut Notes,
) -> Option<String> {
    let written = match value.get_ref() {
        DeValue::String(text) => format!("\"{text}\""),
        DeValue::Integer(_) | DeValue::Float(_) => {
            format!("{:?}", finite(value, "a number", notes)?)
        }
        _ => {
            notes.wrong(value, &format!("one of {}", quoted(legal)));
            return None;
        }
    };
    if legal.clone().any(|legal| legal == written) {
        return Some(written);
    }
    let all = format!("legal values are {}; the first is the lecture's", quoted(legal.clone()));
    let problem =
        notes.add(value.span(), format!("`{key}` cannot be {written}"), "not a legal value");
    problem.help(match did_you_mean(&written, legal) {
        Some(meant) => format!("did you mean `{meant}`? {all}"),
        None => all,
    });
    None
}

/// Returns the written form of a value.
pub(super) fn written<T: Choice + PartialEq>(value: &T) -> String {
    T::VALUES
        .iter()
        .find(|(known, ..)| known == value)
        .map_or_else(String::new, |(_, written, _)| (*written).to_owned())
}

/// Returns the schema of a choice: its values, the default, and the meaning of each value.
pub(super) fn schema<T: Choice>() -> Schema {
    let values: Vec<Json> = T::VALUES.iter().map(|(_, written, _)| json(written)).collect();
    let means: Vec<String> =
        T::VALUES.iter().map(|(_, written, means)| format!("`{written}`: {means}")).collect();
    json_schema!({
        "enum": values,
        "default": values.first(),
        "markdownDescription": means.join("; "),
    })
}

/// A set of effects as read from a course file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RawEffects(pub(super) Effects);

impl Read for RawEffects {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let names = Vec::<EffectName>::read(value, notes)?;
        Some(Self(names.into_iter().map(|name| name.0).collect()))
    }

    fn absent(_: &str, _: &Table<'_>, _: &mut Notes) -> Option<Self> {
        Some(Self(Effects::NONE))
    }
}

impl JsonSchema for RawEffects {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Effects".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let effect = EffectName::json_schema(generator);
        json_schema!({ "type": "array", "items": effect, "default": [] })
    }
}

/// RAY_EPSILON as read from a course file. [rule 21]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RawEpsilon(pub(super) f64);

impl RawEpsilon {
    /// The least value that courses teach. Lesser values leave acne in single precision.
    pub(super) const LEAST: f64 = RAY_EPSILON;
    /// The greatest value that courses teach. Greater values lose contact shadows.
    pub(super) const MOST: f64 = 1e-3;
}

impl Read for RawEpsilon {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let wanted = format!("a number from {:e} to {:e}", Self::LEAST, Self::MOST);
        let number = finite(value, &wanted, notes)?;
        if !(Self::LEAST..=Self::MOST).contains(&number) {
            notes.add(value.span(), format!("this is not {wanted}"), format!("expected {wanted}"));
            return None;
        }
        Some(Self(number))
    }

    fn absent(_: &str, _: &Table<'_>, _: &mut Notes) -> Option<Self> {
        Some(Self(RAY_EPSILON))
    }
}

impl JsonSchema for RawEpsilon {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Epsilon".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "number",
            "minimum": Self::LEAST,
            "maximum": Self::MOST,
            "default": RAY_EPSILON,
        })
    }
}

/// Declares all decisions. Each has a type, a key in the file and in [`Course`](super::Course), and
/// texts. `table!` has to be in scope.
macro_rules! decisions {
    ($(#[doc = $decides:tt] $key:ident : $name:ident [$($rule:literal),*] $(D $number:literal)? {
        #[doc = $first_means:tt]
        $first:ident = $first_written:literal,
        $( #[doc = $means:tt] $variant:ident = $written:literal, )*
    })*) => {
        $(
            #[doc = concat!($decides, ".")]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
            pub enum $name {
                #[doc = concat!("The lecture's:", $first_means, ".")]
                #[default]
                $first,
                $( #[doc = concat!($means, ".")] $variant, )*
            }

            impl $crate::course::choice::Choice for $name {
                const KEY: &'static str = stringify!($key);
                const VALUES: &'static [(Self, &'static str, &'static str)] = &[
                    (Self::$first, stringify!($first_written), $first_means.trim_ascii()),
                    $( (Self::$variant, stringify!($written), $means.trim_ascii()), )*
                ];
            }

            impl $crate::scene::raw::read::Read for $name {
                fn read(
                    value: &$crate::scene::raw::read::Value<'_>,
                    notes: &mut $crate::scene::raw::read::Notes,
                ) -> Option<Self> {
                    $crate::course::choice::read(value, notes)
                }

                fn absent(
                    _: &str,
                    _: &$crate::scene::raw::read::Table<'_>,
                    _: &mut $crate::scene::raw::read::Notes,
                ) -> Option<Self> {
                    Some(Self::default())
                }
            }

            impl schemars::JsonSchema for $name {
                fn inline_schema() -> bool {
                    true
                }

                fn schema_name() -> std::borrow::Cow<'static, str> {
                    stringify!($name).into()
                }

                fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                    $crate::course::choice::schema::<Self>()
                }
            }
        )*

        table! {
            /// The choices of a course where courses differ. A key that is left out has the
            /// lecture's value.
            "a course" RawCourse {
                $( #[doc = $decides] $key: $name, )*
                /// RAY_EPSILON: a hit at t ≤ RAY_EPSILON does not count.
                epsilon: $crate::course::choice::RawEpsilon,
                /// The effects that the programs of this course simulate in every stage.
                always_simulated: $crate::course::choice::RawEffects,
            }
        }

        /// The choices of a course: one legal value of every key. The default is the lecture's
        /// course.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Course {
            $(
                #[doc = concat!($decides, ".")]
                pub $key: $name,
            )*
            /// RAY_EPSILON, from 1e-6 to 1e-3. [rule 21]
            pub epsilon: f64,
            /// The effects that the programs of this course simulate in every stage.
            pub always_simulated: $crate::effects::Effects,
        }

        impl Default for Course {
            fn default() -> Self {
                let always_simulated = $crate::effects::Effects::NONE;
                Self {
                    $( $key: $name::default(), )*
                    epsilon: $crate::RAY_EPSILON,
                    always_simulated,
                }
            }
        }

        impl From<RawCourse> for Course {
            fn from(raw: RawCourse) -> Self {
                let always_simulated = raw.always_simulated.0;
                Self { $( $key: raw.$key, )* epsilon: raw.epsilon.0, always_simulated }
            }
        }

        impl Course {
            /// Returns the written form of every key's value, in the order of [`DECISIONS`].
            pub fn written(&self) -> Vec<String> {
                vec![
                    $( $crate::course::choice::written(&self.$key), )*
                    format!("{:e}", self.epsilon),
                    $crate::course::choice::effects_as_written(self.always_simulated),
                ]
            }
        }

        /// All decisions of a course, in the order of the rules.
        pub const DECISIONS: &[$crate::course::Decision] = &[
            $( $crate::course::Decision {
                key: stringify!($key),
                decides: $decides.trim_ascii(),
                rules: &[$($rule),*],
                number: decisions!(@number $($number)?),
                legal: $crate::course::Legal::OneOf(&[
                    (stringify!($first_written), $first_means.trim_ascii()),
                    $( (stringify!($written), $means.trim_ascii()), )*
                ]),
            }, )*
            $crate::course::Decision {
                key: "epsilon",
                decides: "RAY_EPSILON: a hit at t ≤ RAY_EPSILON does not count",
                rules: &[21],
                number: Some(24),
                legal: $crate::course::Legal::Range {
                    least: $crate::course::choice::RawEpsilon::LEAST,
                    most: $crate::course::choice::RawEpsilon::MOST,
                    lecture: $crate::RAY_EPSILON,
                },
            },
            $crate::course::Decision {
                key: "always_simulated",
                decides: "The effects that every program of this course simulates in every stage, \
                    even before the stage of the effect",
                rules: &[],
                number: None,
                legal: $crate::course::Legal::Effects,
            },
        ];
    };
    (@number $number:literal) => { Some($number) };
    (@number) => { None };
}

pub(super) use decisions;
