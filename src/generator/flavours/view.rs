//! The data of the flavours' templates. Numbers are passed as text that is valid in all their languages.

use std::collections::BTreeMap;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use half::f16;
use serde::Serialize;

use super::flavour::Flavour;
use super::texels;
use crate::generator::emit::{
    self, COAT, CatalogueRow, EmittedFunction, MARK, Naming, OUTPUT_LICENCE, comment_lines,
    library_functions, xml_comment,
};
use crate::generator::fit::rounded_up;
use crate::generator::lut::{Depth, Orthogonal, SplitSum, SplitSumDesign};
use crate::generator::reference::FITTED_IN_ENGINES;
use crate::language::effects::WHITE_MEAN_LOST;
use crate::language::methods::{self, Class, Method};
use crate::language::targets::{self, Target};
use crate::physics::materials::MaterialKind;

/// The data of a template.
#[derive(Clone, Debug, Serialize)]
pub(super) struct AdapterView {
    /// The mark for the first line of each file, after the start of a comment.
    pub(super) mark: String,
    /// The command that makes the file again.
    pub(super) command: String,
    /// The flavour's name.
    pub(super) flavour: &'static str,
    /// The host, with its version.
    pub(super) host: &'static str,
    /// The host's documentation.
    pub(super) source: &'static str,
    /// How the adapter was tested.
    pub(super) proof: &'static str,
    /// The licence of the file.
    pub(super) licence: &'static str,
    /// The reference that coefficients were fitted to, in words.
    pub(super) reference: String,
    /// The methods that materials may have. All of them where there are files by material, so that a file without materials of its
    /// own is the same in every run. Elsewhere that of films is here only with a material under films.
    pub(super) methods: Vec<MethodView>,
    /// The materials, by method and name.
    pub(super) materials: Vec<MaterialView>,
    /// The material of a file that is written for each.
    pub(super) material: Option<MaterialView>,
    /// The text of each method's library functions, by target and method: F, followed by the mean over the hemisphere.
    pub(super) library: BTreeMap<&'static str, BTreeMap<&'static str, String>>,
    /// The split-sum tables, by method.
    pub(super) tables: BTreeMap<&'static str, TableView>,
    /// The coefficients of 1 minus the mean albedo of a rough white surface, as a polynomial of the roughness:
    /// `lut/split_sum.rs`.
    pub(super) white_mean_lost: [String; 4],
}

/// A method that materials of an adapter have.
#[derive(Clone, Debug, Serialize)]
pub(super) struct MethodView {
    name: &'static str,
    function: String,
    /// The function for the mean of F over the hemisphere, with the same arguments without the cosine.
    average_function: String,
    /// Whether its materials have no diffuse light: metals and semiconductors. A material under films says so itself.
    is_opaque: bool,
    /// Whether it is of materials under films: each says itself whether it is opaque, and the table is two of orthogonal functions.
    is_of_films: bool,
    /// What F at normal incidence has of each coefficient.
    normal: Vec<String>,
    /// The names of its coefficients.
    coefficients: Vec<&'static str>,
    /// What the two tables are multiplied by: row i times the coefficients is the number of channel i. Empty where that is the coefficients.
    numbers: Vec<Vec<String>>,
    formula: &'static [&'static str],
    /// The source of its form and its coefficients.
    source: String,
}

/// A material of an adapter.
#[derive(Clone, Debug, Serialize)]
pub(super) struct MaterialView {
    name: String,
    /// The name as a constant of a script.
    identifier: String,
    /// The name in capitals.
    constant: String,
    /// The name in Pascal case: `SodaLimeGlass`.
    pascal: String,
    /// `metal`, `semiconductor` or `dielectric`.
    class: &'static str,
    method: &'static str,
    /// The name of the function with its coefficients.
    function: String,
    library_function: String,
    /// Whether films lie on it.
    is_of_films: bool,
    /// Whether it has no diffuse light: it, or what lies under its films, is a metal or a semiconductor.
    is_opaque: bool,
    /// c0 to c3, of films to c5, three channels each.
    coefficients: Vec<[String; 3]>,
    /// What the channels of its split-sum table are multiplied by: the coefficients, or under films other numbers.
    numbers: Vec<[String; 3]>,
    /// The mean of F over the hemisphere.
    average: [String; 3],
    /// F at normal incidence.
    f0: [String; 3],
    /// The base of a clear coat, of metals and semiconductors in air.
    coated: Option<CoatedView>,
    /// What a file of one material holds: the material, and the base of a clear coat where it has one.
    forms: Vec<FormView>,
    /// The largest error over angles and channels.
    max_error: String,
    /// The angle of the largest error, in degrees.
    max_error_degrees: String,
}

/// A material in air, or as the base of a clear coat: names, and numbers.
#[derive(Clone, Debug, Serialize)]
struct FormView {
    /// What it is, where that is not the material itself; empty there.
    about: Vec<String>,
    function: String,
    constant: String,
    pascal: String,
    coefficients: Vec<[String; 3]>,
    numbers: Vec<[String; 3]>,
    average: [String; 3],
}

/// The base of a clear coat of index 1.5.
#[derive(Clone, Debug, Serialize)]
struct CoatedView {
    index: f64,
    coefficients: Vec<[String; 3]>,
    numbers: Vec<[String; 3]>,
    average: [String; 3],
    /// The largest error of coat and base together.
    max_error: String,
}

/// A split-sum table of four channels in half precision, little endian: rows by roughness, 0 first, each with texels by cosine, 0
/// first. The ends of both axes are the centres of the outer texels. Of films, the rows of a second table follow.
#[derive(Clone, Debug, Serialize)]
pub(super) struct TableView {
    /// Texels per side of one table.
    size: usize,
    cosine: &'static str,
    roughness: &'static str,
    /// The texels in base 64.
    base64: String,
    /// How many steps of the text there are from 0 to 1.
    steps: u32,
    /// The channels as a text of a script: `flavours/texels.rs`.
    text: String,
}

/// The data of a flavour's templates for these materials.
///
/// # Errors
/// The text of a function is refused by its language: a bug.
pub(super) fn view(
    flavour: &'static Flavour,
    rows: &[CatalogueRow],
    reference: &str,
    command: &str,
) -> Result<AdapterView, super::flavour::Error> {
    let all = FITTED_IN_ENGINES.map(|name| methods::find(name).expect("a test finds it"));
    let is_needed = |method: &&'static Method| {
        let mut used = rows.iter().map(|row| row.method.name);
        !method.class.is_of_films()
            || flavour.is_by_material()
            || used.any(|name| name == method.name)
    };
    let methods: Vec<&'static Method> = all.into_iter().filter(is_needed).collect();
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
    /// The same for the host of another flavour.
    pub(super) fn of_host(&self, flavour: &Flavour) -> Self {
        AdapterView {
            flavour: flavour.name,
            host: flavour.host,
            source: flavour.source,
            proof: flavour.proof,
            ..self.clone()
        }
    }

    /// The same for a file of one material. Texts of functions and tables are those of all materials.
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

/// The mark. It stands in comments of Markdown too, which `>` could end.
fn mark(command: &str) -> String {
    let line = comment_lines(vec![format!("{MARK}: {command}")]).concat();
    line.replace(['<', '>'], "?")
}

/// The command where all of it may stand in a script, in JSON and in marked-up text. Of another only the start is shown: a command
/// without some of its letters does something else.
fn plain_command(command: &str) -> String {
    let is_safe = |c: char| is_plain(c) || c == '\'';
    if command.chars().all(is_safe) {
        return command.to_owned();
    }
    // The program, --flavour and its name.
    let start: Vec<&str> = command.split(' ').take(3).collect();
    format!("{} # and what manifest.json says", start.join(" "))
}

fn plain_reference(reference: &str) -> String {
    let plain: String = reference.chars().filter(|c| is_plain(*c)).collect();
    xml_comment(&plain)
}

/// Whether a character has the same meaning in comments, in strings and in marked-up text: a user's own names appear in these.
fn is_plain(c: char) -> bool {
    c == ' ' || c.is_ascii_alphanumeric() || ".,;:-+=/()[]_%".contains(c)
}

fn method_view(method: &'static Method, naming: &Naming) -> MethodView {
    MethodView {
        name: method.name,
        function: format!("{}{}", naming.prefix, method.name),
        average_function: format!("{}{}_average", naming.prefix, method.name),
        is_opaque: method.class != Class::Dielectric,
        is_of_films: method.class.is_of_films(),
        normal: normal_terms(method)
            .iter()
            .map(|value| format!("{value:?}"))
            .collect(),
        coefficients: method.inputs.iter().map(|input| input.name).collect(),
        numbers: orthogonal(method).map_or(Vec::new(), |functions| {
            let number = |value: &f64| format!("{value:?}");
            let rows = functions.rows.iter();
            rows.map(|row| row.iter().map(number).collect()).collect()
        }),
        formula: method.formula,
        source: method.source.line(),
    }
}

/// The functions of a method's split-sum table, where they stand in place of its terms.
fn orthogonal(method: &Method) -> Option<Orthogonal> {
    Orthogonal::of(&method.basis()?)
}

fn material_view(row: &CatalogueRow) -> MaterialView {
    let prefix = Naming::default().prefix;
    let is_of_films = row.method.class.is_of_films();
    let of_table = |coefficients: &[[f64; 3]]| -> Vec<[String; 3]> {
        let own = orthogonal(row.method).map(|functions| functions.numbers(coefficients));
        own.as_deref()
            .unwrap_or(coefficients)
            .iter()
            .map(numbers)
            .collect()
    };
    let mut view = MaterialView {
        name: row.name.clone(),
        identifier: identifier(&row.name),
        constant: row.name.to_uppercase(),
        pascal: pascal(&row.name),
        class: row.class.name(),
        method: row.method.name,
        function: format!("{prefix}{}_{}", row.name, row.method.name),
        library_function: format!("{prefix}{}", row.method.name),
        is_of_films,
        is_opaque: row.class != MaterialKind::Dielectric,
        coefficients: row.coefficients.iter().map(numbers).collect(),
        numbers: of_table(&row.coefficients),
        average: numbers(&row.average.given),
        f0: numbers(&normal_incidence(row)),
        coated: row.coated.as_ref().map(|coated| CoatedView {
            index: COAT,
            coefficients: coated.coefficients.iter().map(numbers).collect(),
            numbers: of_table(&coated.coefficients),
            average: numbers(&coated.average),
            max_error: rounded_up(coated.max_abs),
        }),
        max_error: rounded_up(row.error.max_abs),
        max_error_degrees: format!(
            "{:.2}",
            row.error.worst_cos.clamp(0.0, 1.0).acos().to_degrees()
        ),
        forms: Vec::new(),
    };
    view.forms = view.both_forms();
    view
}

impl MaterialView {
    fn both_forms(&self) -> Vec<FormView> {
        let plain = FormView {
            about: Vec::new(),
            function: self.function.clone(),
            constant: self.constant.clone(),
            pascal: self.pascal.clone(),
            coefficients: self.coefficients.clone(),
            numbers: self.numbers.clone(),
            average: self.average.clone(),
        };
        let coated = self.coated.as_ref().map(|coated| FormView {
            about: vec![
                format!(
                    "Below a clear coat of index {}, which the host draws itself: coat and {} together reflect F of the coat + (1 - F of the coat) times this.",
                    coated.index, self.name
                ),
                format!("cos_theta is that outside. Together they err by at most {}.", coated.max_error),
            ],
            function: format!("{}_under_coat", self.function),
            constant: format!("{}_UNDER_COAT", self.constant),
            pascal: format!("{}UnderCoat", self.pascal),
            coefficients: coated.coefficients.clone(),
            numbers: coated.numbers.clone(),
            average: coated.average.clone(),
        });
        [plain].into_iter().chain(coated).collect()
    }
}

/// F at normal incidence, from the form and its clamp to [0, 1].
fn normal_incidence(row: &CatalogueRow) -> [f64; 3] {
    let terms = normal_terms(row.method);
    let channel = |i: usize| {
        let products = row.coefficients.iter().zip(&terms);
        products
            .map(|(c, term)| c[i] * term)
            .sum::<f64>()
            .clamp(0.0, 1.0)
    };
    [channel(0), channel(1), channel(2)]
}

/// What F at normal incidence has of each coefficient.
fn normal_terms(method: &Method) -> Vec<f64> {
    let shape = method
        .shape
        .expect("rows of the catalogue have fitted methods");
    let mut terms = vec![0.0; shape.terms()];
    shape.add(1.0, 1.0, &mut terms);
    terms
}

/// A text between the quotes of JavaScript.
fn in_a_script(text: &str) -> String {
    text.replace('\\', r"\\").replace('"', r#"\""#)
}

/// Names that a module cannot give to a constant of its own: words of JavaScript, and names of `materials.js`.
const TAKEN: &str = "arguments await break case catch class const continue debugger default delete do else enum eval export extends false \
    finally for function if implements import in instanceof interface let new null package private protected public return static super \
    switch this throw true try typeof undefined var void while with yield \
    checked coated distance fitted fitted_dielectric fitted_film fresnel known materials methods named patch texels";

/// The name of a material as a constant of a script: with a `$` where the name is taken.
fn identifier(name: &str) -> String {
    let is_taken = TAKEN.split(' ').any(|word| word == name);
    format!("{name}{}", if is_taken { "$" } else { "" })
}

/// The shortest digits that give the same f32, with a decimal point.
fn numbers(values: &[f64; 3]) -> [String; 3] {
    values.map(|value| format!("{:?}", value as f32))
}

/// A name in Pascal case, `gold_babar` as `GoldBabar`. An underscore stays before a digit and where it is doubled, so that
/// different names stay different.
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

/// F of a method and its mean over the hemisphere, as in the method's library file.
fn library_text(
    target: &'static Target,
    method: &'static Method,
    naming: &Naming,
) -> Result<String, emit::Error> {
    let mut functions: Vec<EmittedFunction> = library_functions(method, naming)?;
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
        let exact = SplitSum::new(&design, &mut |_, _| {})?;
        let stored = exact.stored(Depth::Half);
        let firsts = (0..design.channels()).step_by(4);
        let channels = firsts.flat_map(|first| {
            let own = move |texel: &[f32; 8]| [0, 1, 2, 3].map(|i| texel[first + i]);
            stored.texels.iter().flat_map(own)
        });
        let halves = channels.map(f16::from_f32);
        let bytes: Vec<u8> = halves.flat_map(f16::to_le_bytes).collect();
        let [cosine, roughness] = axes.map(|axis| axis.name());
        let planes = (0..design.channels()).map(|channel| {
            let own = exact.texels.iter().map(|texel| texel[channel]);
            own.collect()
        });
        let planes: Vec<Vec<f64>> = planes.collect();
        let steps = texels::steps_of_one(design.functions.is_some());
        let view = TableView {
            size,
            steps,
            text: in_a_script(&texels::table_text(&planes, size, steps)),
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
    use super::{pascal, plain_command};

    #[test]
    fn a_command_is_whole_or_its_start_alone() {
        let plain = "fresnel-gen --flavour npm --material gold,'my metal.csv' --medium 1.5";
        assert_eq!(plain_command(plain), plain);
        for rest in [
            r"--material 'a'\'';touch x;'\''.toml'",
            r"--medium 'a\b.toml' --material gold",
            "--illuminant 'Gl\u{e4}ser.csv'",
        ] {
            let shown = plain_command(&format!("fresnel-gen --flavour npm {rest}"));
            assert_eq!(
                shown,
                "fresnel-gen --flavour npm # and what manifest.json says"
            );
        }
    }

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
