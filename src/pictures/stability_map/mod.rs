//! Maps of where functions fail, over angle and index, and their page.

mod heat;
mod page;

pub use heat::heat_map;
pub use page::{percent, stability_page, worst};
