//! Error against cost: the chart as a picture, as a page, and as text. Its data stand in the room `chart`.

mod html;
mod svg;
pub use html::chart_page;
pub use svg::chart_svg;
