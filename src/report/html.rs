//! Pages for a browser: a template of ours, filled.

use tera::{Context, Tera};

/// A page, or why it cannot be made. What is put in is escaped.
pub fn fill(template: &str, context: &Context) -> Result<String, String> {
    let mut tera = Tera::new();
    tera.autoescape_on(vec![".tera"]);
    let rendered = tera
        .add_raw_template("page.tera", template)
        .and_then(|()| tera.render("page.tera", context));
    rendered.map_err(|error| error.to_string())
}
