//! Fits: what a method needs to know of a material, and how wrong it then is.
//!
//! Derived inputs (F0, F82, the artist's pair, λ of the corrected method), and the model error of a method against the
//! exact law. Minimax fits: the coefficients of fitted methods, for a measure of error, and exact where that is asked for;
//! the shapes among which one is chosen.

mod best_inputs;
mod candidates;
mod coated;
mod coefficients;
mod colours;
mod derive;
mod exact;
mod grey_tint;
mod material_params;
mod measured;
mod method_errors;
mod minimax;
mod model_error;
mod over;
mod params;
mod perceived;
mod problem;
mod rounded;
mod search;
mod shape_choice;
mod survey;
mod texels;
mod thesis_in_floats;
mod weight;

pub use best_inputs::{best_inputs, values_at};
pub use candidates::{Candidate, candidates};
pub use coated::CoatedRow;
pub use coefficients::Coefficients;
pub use colours::{Follows, LARGEST_SOLVED_F0};
pub use derive::{
    coefficients_and_error, fitted_coefficients, known, values, values_for_material,
    values_for_material_in, values_of,
};
pub use exact::Exact;
pub use grey_tint::{GreyTint, grey_tint};
pub use material_params::{
    ColourErrorRow, ColourErrors, MaterialParams, MeasuredSpread, OtherMeasurement, material_params,
};
pub use measured::Measured;
pub use method_errors::{InputChoice, MethodErrors};
pub use model_error::{
    ModelError, error_from, error_of, model_error, rounded_up, single_error, thesis_errors,
};
pub use over::model_error_over;
pub use params::{Params, abbe_in, colour_errors, ior_in};
pub use perceived::{Perceived, perceived};
pub use problem::{Fit, FitCurve, FitObjective, FitProblem, basis};
pub use search::{Tried, search};
pub use shape_choice::{ErrorQuantiles, LeaveOneOut, TriedShapes};
pub use survey::{
    PageFacts, PageOutcome, SURVEYED_ANGLES, SurveyedPage, VisibleColours, survey_page,
};
pub use texels::{arguments, table_of, texels};
pub use thesis_in_floats::thesis_error_in_floats;
pub use weight::Weight;
