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
mod known_film;
mod material_params;
mod method_errors;
mod minimax;
mod model_error;
mod perceived;
mod problem;
mod rounded;
mod survey;
mod weight;

pub use best_inputs::values_at;
pub use candidates::{
    Candidate, ErrorQuantiles, LeaveOneOut, Measured, Tried, TriedShapes, candidates, search,
};
pub use derive::{known, values, values_for_material, values_for_material_in};
pub use exact::Exact;
pub use grey_tint::{Follows, GreyTint, grey_tint};
pub use known_film::{SEEN_DEGREES, known_film, thickness_error};
pub use material_params::{
    CoatedRow, ColourErrors, MaterialParams, MeasuredSpread, abbe_in, colour_errors, ior_in,
    material_params,
};
pub use method_errors::{InputChoice, MaterialTruth, MethodErrors};
pub use model_error::{
    ModelError, arguments, difference, error_from, error_of, model_error, rounded_up, single_error,
    table_of, texels,
};
pub use perceived::{Perceived, perceived};
pub use problem::{
    Coefficients, FitCurve, FitObjective, FitProblem, basis, coefficients_and_error,
    weighted_coefficients,
};
pub use survey::{
    PageFacts, PageOutcome, SURVEYED_ANGLES, SurveyedPage, VisibleColours, survey_page,
};
pub use weight::Weight;
