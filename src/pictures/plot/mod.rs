//! Pictures as self-contained SVG text: what all of them share, and line charts.
//!
//! A picture is a pure function of its data: equal data give equal bytes, with every coordinate at two decimals and nothing
//! that depends on the time, the machine or the fonts installed. Text width is therefore estimated, on the generous side, and
//! a plot gets whatever height the text leaves over.

mod axes;
mod layout;
mod line_chart;
mod palette;
mod text;

pub use axes::{Area, Axes, Scale, Tick, labelled, log_ticks, plain_label, power_label, ticks};
pub use layout::{Layout, PanelFrame};
pub use line_chart::{ChartAxis, LineChart, Series};
pub use palette::{
    BLUE, GREEN, INK, Look, PURPLE, SHADES, Style, VERMILION, hex_colour, shade, shade_bytes,
};
pub use text::{AXIS, FOOT, Font, HEADING, LEGEND, PANEL, SUBTITLE, TICK, TITLE, capital};
