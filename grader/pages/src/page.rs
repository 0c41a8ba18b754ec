//! Templates of pages: self-contained HTML with a content security policy, and plain text.
//!
//! A template can use the filters `figure` and `percent` of [`figures`](crate::figures).

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use minijinja::syntax::SyntaxConfig;
use minijinja::{AutoEscape, Environment};
use sha2::{Digest, Sha256};

pub use minijinja::value::Serde;
pub use minijinja::{Value, context};

use crate::figures::{figure, percent};

/// The parts of an HTML page that are the same for all values.
#[derive(Clone, Copy, Debug)]
pub struct Layout<'a> {
    /// The template. It inlines `style` and `script` and states `policy`.
    pub template: &'a str,
    /// The style sheet.
    pub style: &'a str,
    /// The script. An empty one allows no script.
    pub script: &'a str,
}

/// Renders an HTML page with `values`, which the template escapes. Besides them, the template has
/// `style`, `script` and `policy`.
///
/// The policy allows the style sheet and the script by their hashes, and pictures as data URIs. It
/// allows nothing else, so a page opens no connection.
///
/// # Panics
/// Panics if the template is malformed. Templates are part of a program, and its tests render each
/// of them.
pub fn html(layout: Layout, values: &Value) -> String {
    let Layout { template, style, script } = layout;
    let script_source =
        if script.is_empty() { String::new() } else { format!("script-src '{}'; ", hash(script)) };
    let policy = format!(
        "default-src 'none'; img-src data:; style-src '{}'; {script_source}base-uri 'none'; \
            form-action 'none'",
        hash(style)
    );
    let mut engine = engine();
    engine.set_auto_escape_callback(|_| AutoEscape::Html);
    engine
        .render_str(template, context! { policy, style, script, ..values.clone() })
        .expect("the template is part of this program and the tests render it")
}

/// Renders a template of plain text or Markdown with `values`, which are not escaped.
///
/// # Panics
/// Panics if the template is malformed. Templates are part of a program, and its tests render each
/// of them.
pub fn text(template: &str, values: &Value) -> String {
    engine()
        .render_str(template, values)
        .expect("the template is part of this program and the tests render it")
}

fn engine() -> Environment<'static> {
    let syntax = SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build();
    let mut engine = Environment::new();
    engine.set_syntax(syntax.expect("the delimiters are the usual ones"));
    engine.set_auto_escape_callback(|_| AutoEscape::None);
    engine.add_filter("figure", figure);
    engine.add_filter("percent", percent);
    engine
}

fn hash(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(text.as_bytes())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn html_escapes_values_and_text_does_not() {
        let template = "{{ policy }}|{{ name }}|{{ share|percent }}";
        let values = context! { name => "<b>", share => 0.5 };
        let page = html(Layout { template, style: "", script: "" }, &values);
        assert!(page.ends_with("|&lt;b&gt;|50.0 %"), "{page}");
        assert_eq!(text(template, &values), "|<b>|50.0 %");
    }

    // The hash of the empty text is the one that RFC 6234 and FIPS 180-4 give.
    #[test]
    fn the_policy_allows_what_is_inline_and_nothing_else() {
        let empty = "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='";
        let policy = |script| {
            let template = "{{ policy|safe }}";
            html(Layout { template, style: "", script }, &context! {})
        };
        let without = format!(
            "default-src 'none'; img-src data:; style-src {empty}; base-uri 'none'; form-action \
                'none'"
        );
        assert_eq!(policy(""), without);
        assert!(policy("alert(1)").contains("; script-src 'sha256-"));
    }
}
