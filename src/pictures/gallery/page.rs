//! The gallery as one self-contained HTML page.

use tera::Context;

use crate::pictures::gallery::Gallery;
use crate::pictures::html;

static TEMPLATE: &str = include_str!("../../../templates/gallery.html.tera");
static SCRIPT: &str = include_str!("../../../templates/gallery.js");
static PLAYER: &str = include_str!("../../../templates/gallery.player.js");

/// The page, or why it cannot be made.
///
/// # Errors
/// The page's template cannot be filled.
pub fn gallery_page(gallery: &Gallery, command: &str) -> Result<String, String> {
    let mut context = Context::new();
    context.insert("data", &html::script_json(gallery)?);
    context.insert("player", PLAYER);
    context.insert("script", SCRIPT);
    context.insert("command", command);
    html::fill(TEMPLATE, &context)
}
