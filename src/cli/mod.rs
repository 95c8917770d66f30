//! The program: one file a command.

pub mod args;
pub mod command;
pub mod audit_text;
pub mod budget_text;
pub mod chart_text;
pub mod coated_text;
pub mod cost_text;
pub mod error;
pub mod fits_text;
pub mod junit;
pub mod legible;
pub mod params_text;
pub mod plan_file;
pub mod plan_input;
pub mod render_text;
pub mod reproduce_text;
pub mod scene_error_text;
pub mod search_text;
pub mod stability_text;
pub mod survey_text;
pub mod time_text;
pub mod verify_text;

pub use error::Error;
