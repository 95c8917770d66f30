//! HTML pages from templates.

use serde::Serialize;
use tera::{Context, Tera};

use crate::physics::materials::is_hidden;

/// A page, or why it cannot be made. The inserted text is escaped, and holds no invisible characters.
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

/// Data as JSON inside a script, or why they cannot be written.
pub fn script_json(data: &impl Serialize) -> Result<String, String> {
    let json = serde_json::to_string(data).map_err(|why| why.to_string())?;
    // The JSON may hold `</script>` in a string. A JSON escape keeps that from ending the script.
    Ok(json.replace('<', "\\u003c"))
}
