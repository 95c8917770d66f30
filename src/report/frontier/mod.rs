//! Error against cost: the chart as a picture, as a page, and as text. Its data stand in the room `chart`.

#[cfg(feature = "cli")]
mod html;
mod labels;
mod svg;
mod text;

#[cfg(feature = "cli")]
pub use html::chart_page;
pub use svg::chart_svg;
pub use text::chart_text;
