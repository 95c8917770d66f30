//! The rows of the catalogue: each material with its coefficients, and with the method that follows it more closely.
//!
//! The rows for the default viewing conditions are read from a record, `data/records/catalogue.json`: deriving them takes a hundred
//! times as long as the rest of a run. The record holds for material files and fitted shapes with the recorded hashes, and a test
//! derives it again.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::coated::Coated;
use crate::generator::emit::average::Average;
use crate::generator::emit::code_bound::{Bounds, fingerprint};
use crate::generator::emit::error::Error;
use crate::generator::emit::function::{EmittedFunction, Naming, specialised_function};
use crate::generator::fit::{
    FitCurve, FitObjective, ModelError, coefficients_and_error, model_error,
};
use crate::generator::reference::MaterialInMedium;
use crate::language::methods::{self, Method};
use crate::physics::digest::sha256;
use crate::physics::materials::{self, MaterialKind, ViewingConditions};
use crate::physics::num::in_parallel;
use crate::physics::spectra::Gamut;

/// The name of the files and of the array.
pub const CATALOGUE: &str = "catalogue";
/// Colours per material: its coefficients c0 to c3, which are rows of the array.
pub const COEFFICIENTS: usize = 4;

/// A material of the catalogue.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CatalogueRow {
    /// Its name, with the medium's.
    pub name: String,
    /// The material argument on the command line that gives it again. In the record it is the name.
    #[serde(skip)]
    pub argument: String,
    /// Its class.
    pub class: MaterialKind,
    /// The fitted method of its class.
    #[serde(serialize_with = "name_of", deserialize_with = "method_named")]
    pub method: &'static Method,
    /// Its coefficients in order, three channels each, in f32.
    pub coefficients: Vec<[f64; 3]>,
    /// The model error of the function with these coefficients.
    pub error: ModelError,
    /// The mean of that function over the hemisphere.
    pub average: Average,
    /// A method with a smaller error, for a semiconductor, or where the fit misses its class.
    pub better: Option<CloserFit>,
    /// In words, beyond which wavelengths its index was held constant; none if nowhere.
    pub held: Option<String>,
    /// The base of a clear coat, in the rows of adapters.
    #[serde(skip)]
    pub coated: Option<Coated>,
}

/// A method with a smaller error for a material of the catalogue than its four coefficients have.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CloserFit {
    /// The method.
    #[serde(serialize_with = "name_of", deserialize_with = "method_named")]
    pub method: &'static Method,
    /// Its coefficients in order, three channels each; empty for the exact law.
    pub coefficients: Vec<[f64; 3]>,
    /// The largest error.
    pub max_abs: f64,
}

fn name_of<S: Serializer>(method: &&'static Method, to: S) -> Result<S::Ok, S::Error> {
    method.name.serialize(to)
}

fn method_named<'de, D: Deserializer<'de>>(from: D) -> Result<&'static Method, D::Error> {
    let name = String::deserialize(from)?;
    methods::find(&name).ok_or_else(|| de::Error::custom("no such method"))
}

/// The rows of the materials for which there is a fitted method: first those of `fitted`, then those of `fitted_dielectric`, each
/// by name.
///
/// # Errors
/// As [`specialised_function`].
pub fn catalogue_rows(
    subjects: &[MaterialInMedium],
    naming: &Naming,
) -> Result<Vec<CatalogueRow>, Error> {
    rows_by_method(subjects, naming, MaterialInMedium::fitted_with_four, false)
}

/// The row of each material, in this order; the index of the first one without a fitted method of four coefficients is the error within.
///
/// # Errors
/// As [`specialised_function`].
pub fn rows_in_order(
    subjects: &[MaterialInMedium],
    naming: &Naming,
) -> Result<Result<Vec<CatalogueRow>, usize>, Error> {
    let four = |subject: &MaterialInMedium| {
        let fits = !subject.has_films();
        subject.fitted_with_four().filter(|_| fits)
    };
    if let Some(place) = subjects.iter().position(|subject| four(subject).is_none()) {
        return Ok(Err(place));
    }
    rows_of(subjects, naming, four, false).map(Ok)
}

/// The same rows for adapters, in which a material under films has the method that follows films, and metals have their base of a clear
/// coat too.
///
/// # Errors
/// As [`specialised_function`].
pub fn adapter_rows(
    subjects: &[MaterialInMedium],
    naming: &Naming,
) -> Result<Vec<CatalogueRow>, Error> {
    rows_by_method(subjects, naming, MaterialInMedium::fitted_in_engines, true)
}

/// The rows of the materials for which this finds a method, by method and name.
fn rows_by_method(
    subjects: &[MaterialInMedium],
    naming: &Naming,
    method_of: fn(&MaterialInMedium) -> Option<&'static str>,
    with_coats: bool,
) -> Result<Vec<CatalogueRow>, Error> {
    let mut rows = rows_of(subjects, naming, method_of, with_coats)?;
    rows.sort_by(|a, b| (a.method.name, &a.name).cmp(&(b.method.name, &b.name)));
    Ok(rows)
}

fn rows_of(
    subjects: &[MaterialInMedium],
    naming: &Naming,
    method_of: fn(&MaterialInMedium) -> Option<&'static str>,
    with_coats: bool,
) -> Result<Vec<CatalogueRow>, Error> {
    let bounds = Bounds::recorded();
    let row = |i: usize| {
        let subject = &subjects[i];
        let method = methods::find(method_of(subject)?)?;
        let mut row = catalogue_row(subject, method, naming, &bounds);
        if let (Ok(row), true) = (&mut row, with_coats) {
            row.coated = Coated::of(subject, method);
        }
        Some(row)
    };
    let found = in_parallel(subjects.len(), &row, &mut |_, _| {});
    found.into_iter().flatten().collect()
}

fn catalogue_row(
    subject: &MaterialInMedium,
    method: &'static Method,
    naming: &Naming,
    bounds: &Bounds,
) -> Result<CatalogueRow, Error> {
    let function = specialised_function(method, subject, naming, bounds)?;
    let better = closer_fit(subject, &function, naming, bounds)?;
    let emitted = within_gamut(subject, function);
    let value = |input: &methods::Input| emitted.constants[input.name];
    Ok(CatalogueRow {
        name: subject.name.clone(),
        argument: subject.argument.clone(),
        class: subject.material.kind,
        method,
        coefficients: method.inputs.iter().map(value).collect(),
        error: emitted
            .model_error
            .expect("a specialised function has its model error"),
        average: Average::of(&emitted).expect("a fitted method has a mean"),
        better,
        held: subject.reference.surface.extrapolation(),
        coated: None,
    })
}

/// The function of a material with coefficients whose form keeps to [0, 1] by itself, where colours are clipped. A function that
/// is not fitted is returned unchanged.
fn within_gamut(subject: &MaterialInMedium, emitted: EmittedFunction) -> EmittedFunction {
    let gamut = subject.reference.surface.gamut;
    if gamut == Gamut::Keep || !emitted.method.is_fitted() {
        return emitted;
    }
    let aim = FitObjective {
        gamut,
        precision: emitted.precision,
        ..FitObjective::default()
    };
    let found = coefficients_and_error(emitted.method, &FitCurve::of(subject), aim);
    let (constants, _) = found.expect("terms tell angles apart; a test fits them all");
    let function = emitted.method.specialise(&constants);
    let function = function.expect("a test specialises every method");
    let error = model_error(&function, &subject.truth_for(emitted.method));
    EmittedFunction {
        function,
        constants,
        model_error: Some(error),
        ..emitted
    }
}

/// The method with a smaller error for a material than its four coefficients have: the one of its class, or the one that serves
/// where the fit misses its class.
fn closer_fit(
    subject: &MaterialInMedium,
    emitted: &EmittedFunction,
    naming: &Naming,
    bounds: &Bounds,
) -> Result<Option<CloserFit>, Error> {
    let own = subject.fitted_method().and_then(methods::find);
    let own = own.filter(|own| own.name != emitted.method.name);
    let serves = emitted.missed.as_ref();
    let serves = serves.and_then(|missed| methods::find(missed.serves));
    let Some(method) = own.or(serves) else {
        return Ok(None);
    };
    let closer = within_gamut(
        subject,
        specialised_function(method, subject, naming, bounds)?,
    );
    let fitted = method.inputs.iter().filter(|_| method.is_fitted());
    Ok(Some(CloserFit {
        method,
        coefficients: fitted.map(|input| closer.constants[input.name]).collect(),
        max_abs: closer
            .model_error
            .expect("a specialised function has its model error")
            .max_abs,
    }))
}

/// The number of a row's method, which the fourth number of its c0 holds in the buffer and the textures: 1 for `fitted`, 2 for
/// `fitted_dielectric`.
pub fn method_number(method: &Method) -> u8 {
    1 + u8::from(method.name != Method::FITTED.name)
}

/// The first row of the array that takes `fitted_dielectric`; the one after the last where all take the same method.
pub fn first_dielectric(rows: &[CatalogueRow]) -> usize {
    let first = |row: &CatalogueRow| row.method.name == rows[0].method.name;
    COEFFICIENTS * rows.partition_point(first)
}

/// The methods of the rows, each once, by number.
pub(super) fn methods_of(rows: &[CatalogueRow]) -> Vec<&'static Method> {
    let mut methods: Vec<&'static Method> = rows.iter().map(|row| row.method).collect();
    methods.sort_by_key(|method| method_number(method));
    methods.dedup_by_key(|method| method.name);
    methods
}

static RECORD: &str = include_str!("../../../../data/records/catalogue.json");

#[derive(Deserialize)]
struct Record {
    /// The fingerprint of each fitted method.
    methods: BTreeMap<String, String>,
    /// The first half of the SHA-256 digits of each material's file.
    files: BTreeMap<String, String>,
    /// The materials for which there is a fitted method, in the order of the catalogue.
    rows: Vec<CatalogueRow>,
}

/// The recorded rows in air. None for other viewing conditions, or where a material's file or a fitted method has changed since.
pub fn recorded_catalogue(viewing: &ViewingConditions) -> Option<Vec<CatalogueRow>> {
    if *viewing != ViewingConditions::default() {
        return None;
    }
    let mut record: Record = serde_json::from_str(RECORD).ok()?;
    if record.files != files() || record.methods != fitted_methods() {
        return None;
    }
    for row in &mut record.rows {
        row.argument = row.name.clone();
    }
    Some(record.rows)
}

fn fitted_methods() -> BTreeMap<String, String> {
    let fitted = methods::ALL.iter().filter(|method| method.is_fitted());
    let mark = |method: &&Method| {
        let function = method.function(false).expect("a test builds all");
        (method.name.to_owned(), fingerprint(&function))
    };
    fitted.map(mark).collect()
}

fn files() -> BTreeMap<String, String> {
    let hash = |name: &str| {
        let text = materials::source(name).unwrap_or_default();
        (name.to_owned(), sha256(text.as_bytes())[..32].to_owned())
    };
    materials::names().into_iter().map(hash).collect()
}
