//! Maps: the error of a method over the angle and an index.

use super::failure::{Failure, ResultPoint};
use super::scan::{Scan, ScannedFunction};
use super::space::{ScanAxis, ScanSpace, law, logarithmic};
use crate::language::methods::{Class, Method};
use crate::physics::num::Precision;
use crate::physics::optics::cosine;

/// Errors over angle and index.
#[derive(Clone, Debug)]
pub struct Map {
    /// The quantity that varies besides the angle, and its values in order.
    pub axis: ScanAxis,
    /// The precision that functions compute in.
    pub precision: Precision,
    /// The quantity that is held constant, in words.
    pub held: &'static str,
    /// The angles, in degrees.
    pub degrees: Vec<f64>,
    /// A cell for each angle, for each value of the axis.
    pub cells: Vec<Cell>,
}

/// The result at an angle and an index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// The absolute difference between formula and law.
    pub error: f64,
    /// The distance in ulp between result and formula.
    pub digits: f64,
    /// Whether the result is not a reflectance: NaN, infinite, below 0 or above 1.
    pub is_broken: bool,
}

/// The number of values of an axis.
const ROWS: u32 = 96;
/// The n of maps over k, which run from glass to metal.
const N: f64 = 1.5;

/// The maps of a method: over eta where it describes dielectrics, and over k where it describes absorbing media.
pub fn maps(method: &'static Method, precision: Precision) -> Vec<Map> {
    let eta = ScanAxis {
        name: "eta",
        values: logarithmic(0.3, 10.0, ROWS).collect(),
    };
    let mut all = Vec::new();
    if method.class != Class::Metal {
        all.push(map(method, precision, vec![eta], "k = 0"));
    }
    if method.class != Class::Dielectric {
        let n = ScanAxis {
            name: "n",
            values: vec![N],
        };
        let k = ScanAxis {
            name: "k",
            values: logarithmic(1e-6, 100.0, ROWS).collect(),
        };
        all.push(map(method, precision, vec![n, k], "n = 1.5"));
    }
    all
}

fn map(
    method: &'static Method,
    precision: Precision,
    axes: Vec<ScanAxis>,
    held: &'static str,
) -> Map {
    let rounded = |axis: ScanAxis| axis.each_rounded(precision);
    let code = ScannedFunction::library(method, precision);
    let degrees: Vec<f64> = (0..=90).map(f64::from).collect();
    let space = ScanSpace {
        is_media: true,
        axes: axes.into_iter().map(rounded).collect(),
        cosines: rounded(ScanAxis {
            name: "cos_theta",
            values: degrees.iter().copied().map(cosine).collect(),
        }),
    };
    let scan = Scan {
        code: &code,
        channel: 0,
        space: &space,
        point: &|index| space.point(method, index, precision),
        law: &|given, c| Some(law(method, given.medium?, c)),
    };
    // Cosines are in the order of angles, from 0 degrees on.
    let row = |index| scan.curve(index).into_iter().map(|point| cell(&point));
    Map {
        cells: (0..space.count()).flat_map(row).collect(),
        axis: space.axes.last().expect("a map has an axis").clone(),
        precision,
        held,
        degrees,
    }
}

fn cell(point: &ResultPoint) -> Cell {
    let broken = [
        Failure::NotANumber,
        Failure::Infinite,
        Failure::Negative,
        Failure::AboveOne,
    ];
    Cell {
        error: point.error(),
        digits: point.digits(),
        is_broken: broken.iter().any(|failure| point.amount(*failure) > 0.0),
    }
}
