//! What people look at: scenes, plots, pages, and the plan of a scene.
//!
//! [`scene`] draws effects with the functions that users import, beside a ray tracer that shares nothing with them.
//! [`plan`] chooses for each material of a scene the cheapest function whose error is not visible.
//! All else draws rows of the lab or spectra of physics, and computes nothing of its own.
//! It imports all wings but the command line, and is left out without the feature `pictures`.
//! Start with [`plot`], which every curve goes through, or with [`plan`].

// Rooms: plot, table, html, png < captioned < cost_page, figure_chart, frontier, material_sheet, stability_map, scene < gallery, plan, sphere

pub mod captioned;
pub mod cost_page;
pub mod figure_chart;
pub mod frontier;
pub mod gallery;
mod html;
pub mod material_sheet;
pub mod plan;
pub mod plot;
pub mod png;
pub mod scene;
pub mod sphere;
pub mod stability_map;
pub mod table;
