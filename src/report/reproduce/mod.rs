//! The thesis beside ours: the report for a terminal, and the charts of its figures.

mod chart;
mod text;

pub use chart::figure_chart;
pub use text::reproduction_text;
