//! Pages for a browser: a template of ours, filled.

use tera::{Context, Tera};

use crate::physics::materials::is_hidden;

/// A page, or why it cannot be made. What is put in is escaped, and holds no character that a reader does not see.
pub fn fill(template: &str, context: &Context) -> Result<String, String> {
    let mut tera = Tera::new();
    tera.autoescape_on(vec![".tera"]);
    let rendered = tera
        .add_raw_template("page.tera", template)
        .and_then(|()| tera.render("page.tera", context));
    let is_kept = |c: &char| ['\n', '\t'].contains(c) || !is_hidden(*c);
    let seen = |page: String| page.chars().filter(is_kept).collect();
    rendered.map(seen).map_err(|error| error.to_string())
}
