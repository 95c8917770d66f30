//! What the templates of flavours see. Numbers reach them as text that every language of theirs reads.

use std::collections::BTreeMap;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use half::f16;
use serde::Serialize;

use super::flavour::Flavour;
use crate::generator::emit::{
    self, CatalogueRow, Emitted, MARK, Naming, OUTPUT_LICENCE, comment_lines, library_functions,
    xml_comment,
};
use crate::generator::fit::rounded_up;
use crate::generator::lut::{Depth, SplitSum, SplitSumDesign, WHITE_MEAN_LOST};
use crate::generator::reference::FITTED_WITH_FOUR;
use crate::language::methods::{self, Class, Method};
use crate::language::targets::{self, Target};

/// What a template sees.
#[derive(Clone, Debug, Serialize)]
pub(super) struct AdapterView {
    /// The first line of each file, behind what begins a comment.
    pub(super) mark: String,
    /// The command that makes the file again.
    pub(super) command: String,
    /// The flavour's name.
    pub(super) flavour: &'static str,
    /// The host, with its version.
    pub(super) host: &'static str,
    /// The host's documentation.
    pub(super) source: &'static str,
    /// What was seen of the adapter.
    pub(super) proof: &'static str,
    /// The licence of the file.
    pub(super) licence: &'static str,
    /// What the reference is that coefficients were fitted to.
    pub(super) reference: String,
    /// The methods that materials may have: all of them, so that a file without materials of its own is the same in every run.
    pub(super) methods: Vec<MethodView>,
    /// The materials, by method and name.
    pub(super) materials: Vec<MaterialView>,
    /// The one material of a file that is written for each.
    pub(super) material: Option<MaterialView>,
    /// The text of each method's library functions, by target and method: F, and behind it the mean over the hemisphere.
    pub(super) library: BTreeMap<&'static str, BTreeMap<&'static str, String>>,
    /// The split-sum tables, by method.
    pub(super) tables: BTreeMap<&'static str, TableView>,
    /// What the mean albedo of a rough white surface lacks, as a polynomial of the roughness: `lut/bounces.rs`.
    pub(super) white_mean_lost: [String; 4],
}

/// A method that materials of an adapter have.
#[derive(Clone, Debug, Serialize)]
pub(super) struct MethodView {
    /// Its name.
    name: &'static str,
    /// Its library function.
    function: String,
    /// The mean of F over the hemisphere, of the same arguments without the cosine.
    average_function: String,
    /// Whether its materials have no diffuse light: metals and semiconductors.
    is_opaque: bool,
    /// Its formula, line by line.
    formula: &'static [&'static str],
    /// Where its form and its coefficients come from.
    source: String,
}

/// A material of an adapter.
#[derive(Clone, Debug, Serialize)]
pub(super) struct MaterialView {
    /// Its name.
    name: String,
    /// The same in capitals.
    constant: String,
    /// The same in words with capitals, without spaces: `SodaLimeGlass`.
    pascal: String,
    /// `metal`, `semiconductor` or `dielectric`.
    class: &'static str,
    /// Its method.
    method: &'static str,
    /// The name of the function with its coefficients.
    function: String,
    /// The library function of its method.
    library_function: String,
    /// c0 to c3, three channels each.
    coefficients: Vec<[String; 3]>,
    /// The mean of F over the hemisphere.
    average: [String; 3],
    /// F at normal incidence.
    f0: [String; 3],
    /// The largest error over angles and channels.
    max_error: String,
    /// Where it stands, in degrees.
    max_error_degrees: String,
}

/// A split-sum table of four channels in half precision, little endian: rows by roughness, 0 first, in each a texel by cosine, 0 first.
/// The ends of both axes are the centres of the outer texels.
#[derive(Clone, Debug, Serialize)]
pub(super) struct TableView {
    /// Texels of a side.
    size: usize,
    /// The name of the cosine's axis.
    cosine: &'static str,
    /// The name of the roughness's axis.
    roughness: &'static str,
    /// The texels in base 64.
    base64: String,
}

/// What the templates of a flavour see of these materials.
///
/// # Errors
/// The text of a function is refused by its language: a bug.
pub(super) fn view(
    flavour: &'static Flavour,
    rows: &[CatalogueRow],
    reference: &str,
    command: &str,
) -> Result<AdapterView, super::flavour::Error> {
    let methods = FITTED_WITH_FOUR.map(|name| methods::find(name).expect("a test finds it"));
    let naming = Naming::default();
    Ok(AdapterView {
        mark: mark(command),
        command: plain_command(command),
        flavour: flavour.name,
        host: flavour.host,
        source: flavour.source,
        proof: flavour.proof,
        licence: OUTPUT_LICENCE,
        reference: plain_reference(reference),
        methods: methods
            .iter()
            .map(|one| method_view(one, &naming))
            .collect(),
        materials: rows.iter().map(material_view).collect(),
        material: None,
        library: library(flavour, &methods, &naming)?,
        tables: tables(flavour, &methods)?,
        white_mean_lost: WHITE_MEAN_LOST.map(|value| format!("{value:?}")),
    })
}

impl AdapterView {
    /// The same for a file of one material: texts of functions and tables are those of all.
    pub(super) fn of_material(&self, row: &CatalogueRow, reference: &str, command: &str) -> Self {
        let material = material_view(row);
        AdapterView {
            mark: mark(command),
            command: plain_command(command),
            reference: plain_reference(reference),
            materials: vec![material.clone()],
            material: Some(material),
            ..self.clone()
        }
    }
}

/// It stands in comments of Markdown too, which `>` could end.
fn mark(command: &str) -> String {
    let line = comment_lines(vec![format!("{MARK}: {command}")]).concat();
    line.replace(['<', '>'], "?")
}

fn plain_command(command: &str) -> String {
    let is_kept = |c: &char| is_plain(*c) || *c == '\'';
    command.chars().filter(is_kept).collect()
}

fn plain_reference(reference: &str) -> String {
    let plain: String = reference.chars().filter(|c| is_plain(*c)).collect();
    xml_comment(&plain)
}

/// Whether a character says the same in comments, in strings and in marked-up text: a user's own names stand in words.
fn is_plain(c: char) -> bool {
    c == ' ' || c.is_ascii_alphanumeric() || ".,;:-+=/()[]_%".contains(c)
}

fn method_view(method: &'static Method, naming: &Naming) -> MethodView {
    MethodView {
        name: method.name,
        function: format!("{}{}", naming.prefix, method.name),
        average_function: format!("{}{}_average", naming.prefix, method.name),
        is_opaque: method.class != Class::Dielectric,
        formula: method.formula,
        source: method.source.line(),
    }
}

fn material_view(row: &CatalogueRow) -> MaterialView {
    let prefix = Naming::default().prefix;
    MaterialView {
        name: row.name.clone(),
        constant: row.name.to_uppercase(),
        pascal: pascal(&row.name),
        class: row.class,
        method: row.method.name,
        function: format!("{prefix}{}_{}", row.name, row.method.name),
        library_function: format!("{prefix}{}", row.method.name),
        coefficients: row.coefficients.iter().map(numbers).collect(),
        average: numbers(&row.average.given),
        f0: numbers(&normal_incidence(row)),
        max_error: rounded_up(row.error.max_abs),
        max_error_degrees: format!(
            "{:.2}",
            row.error.worst_cos.clamp(0.0, 1.0).acos().to_degrees()
        ),
    }
}

/// F at normal incidence, from the form and its limit to [0, 1].
fn normal_incidence(row: &CatalogueRow) -> [f64; 3] {
    let shape = row
        .method
        .shape
        .expect("rows of the catalogue have fitted methods");
    let mut terms = vec![0.0; shape.terms()];
    shape.add(1.0, 1.0, &mut terms);
    let channel = |i: usize| {
        let products = row.coefficients.iter().zip(&terms);
        products
            .map(|(c, term)| c[i] * term)
            .sum::<f64>()
            .clamp(0.0, 1.0)
    };
    [channel(0), channel(1), channel(2)]
}

/// The shortest digits that give the same f32 back, with a point.
fn numbers(values: &[f64; 3]) -> [String; 3] {
    values.map(|value| format!("{:?}", value as f32))
}

/// A name without underscores, `gold_babar` as `GoldBabar`. So that two names stay two, one stays before a digit and where it is doubled.
fn pascal(name: &str) -> String {
    let part = |part: &str| match part.chars().next() {
        Some(first) if first.is_ascii_lowercase() => first.to_uppercase().to_string() + &part[1..],
        _ => format!("_{part}"),
    };
    name.split('_').map(part).collect()
}

type Library = BTreeMap<&'static str, BTreeMap<&'static str, String>>;

fn library(
    flavour: &Flavour,
    methods: &[&'static Method],
    naming: &Naming,
) -> Result<Library, emit::Error> {
    let of_target = |name: &&'static str| {
        let target = targets::find(name).expect("a test finds the languages of all flavours");
        let texts = methods.iter().map(|method| {
            let text = library_text(target, method, naming)?;
            Ok((method.name, text))
        });
        Ok((*name, texts.collect::<Result<_, emit::Error>>()?))
    };
    flavour.languages.iter().map(of_target).collect()
}

/// F of a method and its mean over the hemisphere, as their file in the library has them.
fn library_text(
    target: &'static Target,
    method: &'static Method,
    naming: &Naming,
) -> Result<String, emit::Error> {
    let mut functions: Vec<Emitted> = library_functions(method, naming)?;
    functions.extend(emit::companions(method, naming)?);
    functions.retain(|emitted| !emitted.form.is_scalar());
    emit::bare_text(target, &functions)
}

fn tables(
    flavour: &Flavour,
    methods: &[&'static Method],
) -> Result<BTreeMap<&'static str, TableView>, crate::generator::lut::Error> {
    let Some((size, axes)) = flavour.table else {
        return Ok(BTreeMap::new());
    };
    let of_method = |method: &&'static Method| {
        let basis = method
            .basis()
            .expect("fitted methods are affine in their coefficients");
        let design = SplitSumDesign::square(basis, size, axes);
        let table = SplitSum::new(&design, &mut |_, _| {})?.stored(Depth::Half);
        let halves = table
            .texels
            .iter()
            .flatten()
            .map(|value| f16::from_f32(*value));
        let bytes: Vec<u8> = halves.flat_map(f16::to_le_bytes).collect();
        let [cosine, roughness] = axes.map(|axis| axis.name());
        let view = TableView {
            size,
            cosine,
            roughness,
            base64: BASE64_STANDARD.encode(bytes),
        };
        Ok((method.name, view))
    };
    methods.iter().map(of_method).collect()
}

#[cfg(test)]
mod tests {
    use super::pascal;

    #[test]
    fn names_in_capitals_stay_apart() {
        for (name, capitals) in [
            ("gold", "Gold"),
            ("gold_babar", "GoldBabar"),
            ("a1", "A1"),
            ("a_1", "A_1"),
            ("a__b", "A_B"),
            ("ab", "Ab"),
            ("a_b", "AB"),
        ] {
            assert_eq!(pascal(name), capitals);
        }
    }
}
