//! Where functions fail, as maps over angle and index, and as a page.

mod heat;
mod page;

pub use heat::heat_map;
pub use page::{percent, stability_page, worst};
