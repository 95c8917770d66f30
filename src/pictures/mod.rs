//! Scenes that show what functions do, and plans for a scene's materials.

// Rooms: plot, table, html, pixels, png < cost_page, figure_chart, frontier, headline, material_sheet, stability_map, scene < gallery, plan

pub mod cost_page;
pub mod figure_chart;
pub mod frontier;
pub mod gallery;
pub mod headline;
mod html;
pub mod material_sheet;
pub mod pixels;
pub mod plan;
pub mod plot;
pub mod png;
pub mod scene;
pub mod stability_map;
pub mod table;
