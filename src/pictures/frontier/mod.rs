//! Error against cost, as a picture, as a page, and as text. The data stand in the room `chart` of the lab.

mod html;
mod svg;
pub use html::{chart_page, four_digits};
pub use svg::chart_svg;
