//! Which argument of a user's function is the cosine.

use super::quantity::plain;
use super::scan::{FoundFunction, NumberShape};

/// Names that mean the cosine, in small letters without `_`.
const COSINES: [&str; 36] = [
    "costheta",
    "costhetai",
    "cosine",
    "cosi",
    "cos",
    "costh",
    "ct",
    "c",
    "mu",
    "ndotv",
    "ndotl",
    "ndoth",
    "vdoth",
    "ldoth",
    "hdotv",
    "hdotl",
    "vdotn",
    "ldotn",
    "nov",
    "nol",
    "voh",
    "loh",
    "vdoth01",
    "dotnv",
    "dotvh",
    "dotlh",
    "dotnl",
    "dotnh",
    "ndv",
    "ndl",
    "vdh",
    "ldh",
    "hov",
    "hol",
    "costhetad",
    "u",
];

/// The place of the cosine among the arguments that have no value: by its name, or what alone is left.
pub fn cosine(function: &FoundFunction, has_value: &[bool]) -> Option<usize> {
    let plain = |name: &str| plain(name).to_lowercase();
    let is_open =
        |place: &usize| !has_value[*place] && function.params[*place].shape == NumberShape::Scalar;
    let is_named = |place: &usize| COSINES.contains(&plain(&function.params[*place].name).as_str());
    let open: Vec<usize> = (0..has_value.len()).filter(is_open).collect();
    let named: Vec<usize> = open.iter().copied().filter(is_named).collect();
    match (named.as_slice(), open.as_slice()) {
        ([one], _) | ([], [one]) => Some(*one),
        _ => None,
    }
}
