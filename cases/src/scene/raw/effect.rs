//! The names of effects in files.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use super::read::{At, Notes, Read, Value};
use crate::effects::Effect;
use crate::problem::{did_you_mean, quoted};

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
            let problem = notes.add(
                name.span.clone(),
                format!("unknown effect `{}`", name.value),
                "there is no such effect",
            );
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
