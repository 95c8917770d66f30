//! Fits: what a method needs to know of a material, and how wrong it then is.
//!
//! Derived inputs (F0, F82, the artist's pair, λ of the corrected method), and the model error of a method against the
//! exact law. Minimax fits: the coefficients of fitted methods.

mod colours;
mod derive;
mod effective;
mod fitted;
mod lambda;
mod measured;
mod minimax;
mod model_error;
mod over;
mod params;
mod perceived;
mod rival;
mod rounded;
mod texels;

pub use colours::{Follows, LARGEST_SOLVED_F0};
pub use derive::{Derivation, Known, fitted_values, values, values_of};
pub use effective::{By, Effective, effective};
pub use fitted::{Curve, Fit, fit};
pub use lambda::{THESIS_MATCHING_COS, lambda};
pub use measured::Measured;
pub use minimax::{Minimax, minimax};
pub use model_error::{ModelError, Truth, error_from, error_of, model_error, seen, thesis_errors};
pub use over::model_error_over;
pub use params::{BOUNCES, Params, abbe, colour_errors, ior_d, params};
pub use perceived::{Perceived, perceived};
pub use rival::{best_inputs, values_at};
pub use texels::{arguments, table_of, texels};
