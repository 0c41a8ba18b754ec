//! The parts that all pages share: the template engine and the content policy.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment, context};
use serde::Serialize;
use sha2::{Digest, Sha256};

/// Renders `template` with the values of `view`, and inlines `style` and `script`. The content
/// policy allows only their hashes.
pub(in crate::report) fn render(
    template: &str,
    style: &str,
    script: &str,
    view: &impl Serialize,
) -> String {
    let syntax = SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build();
    let mut engine = Environment::new();
    engine.set_auto_escape_callback(|_| AutoEscape::Html);
    engine.set_syntax(syntax.expect("the delimiters are the usual ones"));
    let policy = format!(
        "default-src 'none'; img-src data:; style-src '{}'; script-src '{}'; base-uri 'none'; \
            form-action 'none'",
        hash(style),
        hash(script)
    );
    let view = minijinja::Value::from(Serde(view));
    engine
        .render_str(template, context! { policy, style, script, view })
        .expect("the template is part of this program and every page of the tests goes through it")
}

fn hash(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(text.as_bytes())))
}
