//! The entries of `catalogue.json`.

use serde::Serialize;

use super::array;
use super::row::{COEFFICIENTS, CatalogueRow, method_number, methods_of};

/// A method of the catalogue.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CatalogueMethod {
    number: u8,
    name: &'static str,
    formula: &'static [&'static str],
    source: String,
}

impl CatalogueMethod {
    /// The methods of these rows.
    pub fn all(rows: &[CatalogueRow]) -> Vec<CatalogueMethod> {
        let methods = methods_of(rows).into_iter();
        let about = methods.map(|method| CatalogueMethod {
            number: method_number(method),
            name: method.name,
            formula: method.formula,
            source: method.source_in_full(),
        });
        about.collect()
    }
}

/// The order of coefficients in `catalogue.json`, as the file states it.
pub const COEFFICIENT_ORDER: &str = "coefficients[i] is c_i: red, green, blue; the order of the arrays, of the buffer and of the textures";

/// A material of the catalogue: its coefficients in order, three channels each, the first of its rows in the array, and its byte
/// offset in the buffer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CatalogueMaterial<'a> {
    name: &'a str,
    row: usize,
    offset: usize,
    class: &'static str,
    method: &'static str,
    coefficients: Vec<[f64; 3]>,
    better: Option<CloserFitDetail>,
    max_abs: f64,
    worst_cos: f64,
    mean_rel: Option<f64>,
    average: [f64; 3],
    average_unlimited: [f64; 3],
    extrapolated: Option<&'a str>,
}

/// The method with a smaller error. The exact law has no coefficients.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct CloserFitDetail {
    method: &'static str,
    max_abs: f64,
    coefficients: Option<Vec<[f64; 3]>>,
}

impl CatalogueMaterial<'_> {
    /// The materials of these rows.
    pub fn all(rows: &[CatalogueRow]) -> Vec<CatalogueMaterial<'_>> {
        let material = |(place, row)| CatalogueMaterial::new(place, row);
        rows.iter().enumerate().map(material).collect()
    }

    fn new(place: usize, row: &CatalogueRow) -> CatalogueMaterial<'_> {
        CatalogueMaterial {
            name: &row.name,
            row: COEFFICIENTS * place,
            offset: array::offset(place),
            class: row.class.name(),
            method: row.method.name,
            coefficients: in_order(&row.coefficients),
            better: row.better.as_ref().map(|closer| CloserFitDetail {
                method: closer.method.name,
                max_abs: closer.max_abs,
                coefficients: Some(in_order(&closer.coefficients)).filter(|all| !all.is_empty()),
            }),
            max_abs: row.error.max_abs,
            worst_cos: row.error.worst_cos,
            mean_rel: row.error.mean_rel,
            average: row.average.given,
            average_unlimited: row.average.unlimited,
            extrapolated: row.held.as_deref(),
        }
    }
}

fn in_order(coefficients: &[[f64; 3]]) -> Vec<[f64; 3]> {
    coefficients.iter().map(|c| c.map(shortest)).collect()
}

/// The number with the fewest printed digits that is the same in f32.
fn shortest(value: f64) -> f64 {
    let digits = (value as f32).to_string();
    digits.parse().expect("what is printed of a number is one")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_give_the_same_f32_back() {
        for value in [1.041_579_5_f32, -0.112_050_526, 1e-9, 0.1] {
            let short = shortest(f64::from(value));
            assert_eq!(short as f32, value);
            assert_eq!(short.to_string(), value.to_string());
        }
    }
}
