//! Maps: the error of a method over the angle and an index, or over the angle and the thickness of a film.

use super::failure::{Failure, ResultPoint};
use super::scan::{Scan, ScannedFunction};
use super::space::{ScanAxis, ScanPoint, ScanSpace, law, logarithmic};
use crate::generator::emit::{self, Bounds, specialised_graph};
use crate::generator::reference::{MaterialInMedium, reference_reflectance};
use crate::language::methods::{Class, Light, Method};
use crate::physics::materials::Surface;
use crate::physics::num::{Precision, in_parallel};
use crate::physics::optics::cosine;

/// Errors over angle and index.
#[derive(Clone, Debug)]
pub struct Map {
    /// The quantity that varies besides the angle, and its values in order.
    pub axis: ScanAxis,
    /// The precision that functions compute in.
    pub precision: Precision,
    /// The quantity that is held constant, in words.
    pub held: String,
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

fn map(method: &'static Method, precision: Precision, axes: Vec<ScanAxis>, held: &str) -> Map {
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
        held: held.to_owned(),
        degrees,
    }
}

/// The map of a method over the thickness of a material's one film, from 0 to its own: the worst of three channels, held against the
/// spectrum.
///
/// # Errors
/// The method cannot be specialised to the material.
pub fn film_map(
    method: &'static Method,
    subject: &MaterialInMedium,
    precision: Precision,
) -> Result<Map, emit::Error> {
    let thickest = subject.material.films[0].thickness_nm;
    let share = |row: u32| f64::from(row) / f64::from(ROWS - 1);
    let values = (0..ROWS).map(|row| precision.rounded(thickest * share(row)));
    let axis = ScanAxis {
        name: "thickness_nm",
        values: values.collect(),
    };
    let degrees: Vec<f64> = (0..=90).map(f64::from).collect();
    let function = |precision| {
        let made = specialised_graph(method, subject, precision, &Bounds::recorded())?;
        Ok::<_, emit::Error>(made.function)
    };
    let code = ScannedFunction {
        function: function(precision)?,
        meaning: function(Precision::F32)?,
        precision,
    };
    let cosines = ScanAxis {
        name: "cos_theta",
        values: degrees.iter().copied().map(cosine).collect(),
    };
    let cosines = cosines.each_rounded(precision);
    let surface = &subject.reference.surface;
    let row = |row: usize| -> Vec<Cell> {
        let thickness_nm = axis.values[row];
        let share = if thickest > 0.0 {
            thickness_nm / thickest
        } else {
            0.0
        };
        let films = surface.films.iter();
        let surface = Surface {
            films: films.map(|films| vec![films[0].of_share(share)]).collect(),
            ..surface.clone()
        };
        let space = ScanSpace {
            is_media: true,
            axes: Vec::new(),
            cosines: cosines.clone(),
        };
        let point = ScanPoint {
            arguments: vec![thickness_nm],
            medium: None,
            limit: 1.0,
        };
        let law =
            |channel: usize, c| reference_reflectance(&surface, Light::Unpolarised, c)[channel];
        let channel = |channel| {
            let scan = Scan {
                code: &code,
                channel,
                space: &space,
                point: &|_| point.clone(),
                law: &|_, c| Some(law(channel, c)),
            };
            scan.curve(0)
        };
        let [red, green, blue] = [0, 1, 2].map(channel);
        let worst = |at: usize| {
            let [red, green, blue] = [&red, &green, &blue].map(|points| cell(&points[at]));
            red.worse(green).worse(blue)
        };
        (0..degrees.len()).map(worst).collect()
    };
    Ok(Map {
        cells: in_parallel(axis.values.len(), &row, &mut |_, _| {}).concat(),
        held: subject.name.clone(),
        axis,
        precision,
        degrees,
    })
}

impl Map {
    /// The largest error of the formula: the angle in degrees, the value of the axis, and the error there.
    pub fn worst(&self) -> (f64, f64, f64) {
        let of = |(i, cell): (usize, &Cell)| {
            let (row, column) = (i / self.degrees.len(), i % self.degrees.len());
            (self.degrees[column], self.axis.values[row], cell.error)
        };
        let all = self.cells.iter().enumerate().map(of);
        all.fold(
            (0.0, 0.0, 0.0),
            |most, one| if one.2 > most.2 { one } else { most },
        )
    }
}

impl Cell {
    /// The worse of two in each respect.
    fn worse(self, other: Cell) -> Cell {
        Cell {
            error: self.error.max(other.error),
            digits: self.digits.max(other.digits),
            is_broken: self.is_broken || other.is_broken,
        }
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
