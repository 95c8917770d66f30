//! Fits: the values of a method's inputs for a material, and the method's error with them.
//!
//! Inputs are derived (F0, F82, the artist's pair, λ of the corrected method) or fitted. Minimax fits give the coefficients of
//! fitted methods, in a chosen measure of error, and exact at the ends if asked for. The model error compares a method with the
//! exact law. Candidate shapes are tried, and one is chosen.

mod best_inputs;
mod candidates;
mod derive;
mod exact;
mod grey_tint;
mod material_params;
mod method_errors;
mod minimax;
mod model_error;
mod over;
mod perceived;
mod problem;
mod rounded;
mod survey;

pub use best_inputs::{best_inputs, values_at};
pub use candidates::{
    Candidate, ErrorQuantiles, LeaveOneOut, Measured, Tried, TriedShapes, candidates, search,
};
pub use derive::{
    coefficients_and_error, fitted_coefficients, known, values, values_for_material,
    values_for_material_in, values_of,
};
pub use exact::{Exact, thesis_error_in_floats};
pub use grey_tint::{Follows, GreyTint, LARGEST_SOLVED_F0, grey_tint};
pub use material_params::{
    CoatedRow, ColourErrorRow, ColourErrors, MaterialParams, MeasuredSpread, OtherMeasurement,
    Params, abbe_in, colour_errors, ior_in, material_params,
};
pub use method_errors::{InputChoice, MethodErrors};
pub use model_error::{
    ModelError, error_from, error_of, model_error, rounded_up, single_error, thesis_errors,
};
pub use over::model_error_over;
pub use perceived::{Perceived, perceived};
pub use problem::{Coefficients, Fit, FitCurve, FitObjective, FitProblem, Weight, basis};
pub use rounded::{arguments, table_of, texels};
pub use survey::{
    PageFacts, PageOutcome, SURVEYED_ANGLES, SurveyedPage, VisibleColours, survey_page,
};
