//! `stage.toml` as it is written.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use crate::effects::Effect;
use crate::problem::{did_you_mean, quoted};
use crate::scene::raw::numbers::Points;
use crate::scene::raw::read::{At, Notes, Read, Value, table};

table! {
    /// What a stage is about, in `stages/NN_name/stage.toml`.
    "a stage" RawStage {
        /// One line for people.
        title: String,
        /// What the stage is about, in a few sentences.
        about: String,
        /// The effects its cases may show; a case renders what its scene calls for and this allows.
        allows: Vec<EffectName>,
        /// The stages that a student needs first, by the names of their folders.
        needs: Vec<At<String>> = "[]",
        /// What all unit checks together earn, with at most three decimals.
        unit_points: Points,
    }
}

/// The name of an effect.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EffectName(pub(crate) Effect);

fn names() -> impl Iterator<Item = &'static str> {
    Effect::ALL.into_iter().map(Effect::name)
}

impl Read for EffectName {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let name = At::<String>::read(value, notes)?;
        let effect = Effect::from_name(&name);
        if effect.is_none() {
            let problem =
                notes.add(name.span.clone(), format!("unknown effect `{}`", name.value), "there is no such effect");
            let all = format!("the effects are {}", quoted(names()));
            problem.help(match did_you_mean(&name, names()) {
                Some(meant) => format!("did you mean `{meant}`? {all}"),
                None => all,
            });
        }
        effect.map(Self)
    }
}

impl JsonSchema for EffectName {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Effect".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "enum": names().collect::<Vec<_>>() })
    }
}
