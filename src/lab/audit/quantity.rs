//! The quantities that an argument of a user's function may stand for, and the names that engines and papers give them. A
//! quantity is an input of our methods, or follows from one.

use std::collections::BTreeSet;

use crate::generator::fit::values_for_material;
use crate::generator::reference::MaterialInMedium;
use crate::lab::verify::function_head::FunctionHead;
use crate::language::ir::Ty;
use crate::language::methods::{self, Class, Input, InputSource, Method, find_input};
use crate::physics::names::UnknownName;
use crate::physics::num::each_channel;

/// A quantity that a material has a value for.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    /// Its name, as `--arg` takes it.
    pub name: &'static str,
    /// The input that it follows from.
    pub input: &'static Input,
    /// Its value, computed from that of the input.
    derived: fn(f64) -> f64,
}

impl PartialEq for Quantity {
    fn eq(&self, other: &Quantity) -> bool {
        self.name == other.name
    }
}

/// A quantity's name, its input's name, and the function from one value to the other.
type Derived = (&'static str, &'static str, fn(f64) -> f64);

/// Quantities that users' functions take and ours do not.
const DERIVED: [Derived; 6] = [
    ("1/eta", "eta", |eta| 1.0 / eta),
    ("1/n", "n", |n| 1.0 / n),
    ("eta^2", "eta", |eta| eta * eta),
    ("n^2", "n", |n| n * n),
    ("k^2", "k", |k| k * k),
    ("f82_tint", "tint", |tint| tint),
];

/// Names in lower case without `_`, and the quantities that they may stand for. The first is bound, the others are tried.
#[derive(Clone, Copy)]
struct Alias {
    names: &'static [&'static str],
    quantities: &'static [&'static str],
}

const fn alias(names: &'static [&'static str], quantities: &'static [&'static str]) -> Alias {
    Alias { names, quantities }
}

const INDEX: &[&str] = &[
    "eta",
    "ior",
    "index",
    "indexofrefraction",
    "refractiveindex",
    "refindex",
    "refidx",
    "refractionindex",
    "relativeior",
    "relativeeta",
    "relativeindex",
    "relindex",
    "relior",
    "releta",
    "etatoveretai",
    "etatoetai",
    "etatetai",
    "etati",
    "etarel",
    "iorratio",
];
const INVERSE_INDEX: &[&str] = &[
    "inveta",
    "etainv",
    "inverseeta",
    "oneovereta",
    "rcpeta",
    "etaioveretat",
    "etaietat",
    "etait",
    "invior",
    "inverseior",
];
const REAL_INDEX: &[&str] = &["n", "etareal", "realeta", "iorreal", "realior", "iorn"];
const EXTINCTION: &[&str] = &[
    "k",
    "etak",
    "kappa",
    "extinction",
    "extinctioncoefficient",
    "extinctioncoeff",
    "etaimag",
    "iorimag",
    "iork",
];
const SQUARED_EXTINCTION: &[&str] = &["k2", "etak2", "kk", "ksquared"];
const EDGE: &[&str] = &["edgetint"];
const EDGE_COLOUR: &[&str] = &["edgecolor", "edgecolour"];
const REFLECTIVITY: &[&str] = &["reflectivity"];

/// Names whose meaning does not depend on the other arguments.
const ALIASES: [Alias; 10] = [
    alias(INVERSE_INDEX, &["1/eta", "eta"]),
    alias(REAL_INDEX, &["n"]),
    alias(EXTINCTION, &["k", "k^2"]),
    alias(SQUARED_EXTINCTION, &["k^2", "k"]),
    alias(
        &[
            "f0",
            "r0",
            "rf0",
            "fresnel0",
            "reflectance0",
            "specularcolor",
            "specularcolour",
            "specularf0",
            "color0",
            "colour0",
            "basereflectance",
            "basereflectivity",
            "normalreflectance",
            "reflectanceatnormal",
            "cspec",
        ],
        &["f0"],
    ),
    alias(
        &[
            "f90",
            "r90",
            "fresnel90",
            "reflectance90",
            "specularf90",
            "color90",
            "colour90",
            "grazingreflectance",
        ],
        &["f90"],
    ),
    alias(
        &["f82", "reflectance82", "color82", "colour82"],
        &["f82", "f82_tint"],
    ),
    alias(&["tint", "f82tint", "tint82"], &["f82_tint", "f82"]),
    alias(
        &[
            "thickness",
            "filmthickness",
            "thinfilmthickness",
            "iridescencethickness",
        ],
        &["thickness_nm"],
    ),
    alias(&["thinfilmior", "iridescenceior", "filmeta"], &["film_ior"]),
];

/// A name in the form of aliases. A single letter keeps its case, since N may be the normal.
pub fn plain(name: &str) -> String {
    match name.len() {
        1 => name.to_owned(),
        _ => name.to_lowercase().replace('_', ""),
    }
}

/// The quantities that an argument of a function may stand for by its name. The first is bound, the others are tried.
pub fn meanings(name: &str, function: &FunctionHead) -> Vec<Quantity> {
    let plain_name = plain(name);
    let is_among = |names: &[&str]| names.contains(&plain_name.as_str());
    let takes = |names: &[&str]| {
        let mut params = function.params.iter();
        params.any(|param| names.contains(&plain(&param.name).as_str()))
    };
    let known: &[&str] = if is_among(INDEX) && (takes(EXTINCTION) || takes(SQUARED_EXTINCTION)) {
        &["n"]
    } else if is_among(INDEX) {
        &["eta", "1/eta"]
    } else if is_among(EDGE) && takes(REFLECTIVITY) {
        &["edge_tint", "f82_tint", "f82"]
    } else if is_among(EDGE) || is_among(EDGE_COLOUR) {
        &["f82_tint", "f82", "edge_tint"]
    } else {
        let found = ALIASES.iter().find(|alias| is_among(alias.names));
        found.map_or(&[], |alias| alias.quantities)
    };
    if known.is_empty() {
        return own_input(&plain_name).into_iter().collect();
    }
    known.iter().filter_map(|name| find(name)).collect()
}

/// An input of ours by its plain name.
fn own_input(plain_name: &str) -> Option<Quantity> {
    let mut inputs = number_inputs();
    let found = inputs.find(|input| plain(input.name) == plain_name)?;
    find(found.name)
}

/// All inputs that are numbers.
fn number_inputs() -> impl Iterator<Item = &'static Input> {
    let inputs = methods::ALL.iter().flat_map(|method| method.inputs);
    inputs.filter(|input| {
        !matches!(
            input.source,
            InputSource::Texture | InputSource::TextureLayout(_)
        )
    })
}

/// The quantity of this name.
pub fn find(name: &str) -> Option<Quantity> {
    let derived = DERIVED.iter().find(|(own, ..)| *own == name);
    match derived {
        Some((name, input, derived)) => Some(Quantity {
            name,
            input: find_input(input)?,
            derived: *derived,
        }),
        None => {
            let input = number_inputs().find(|input| input.name == name)?;
            Some(Quantity {
                name: input.name,
                input,
                derived: |value| value,
            })
        }
    }
}

/// The names of all quantities.
pub fn names() -> Vec<&'static str> {
    let inputs = number_inputs().map(|input| input.name);
    let derived = DERIVED.iter().map(|(name, ..)| *name);
    let all: BTreeSet<&'static str> = inputs.chain(derived).collect();
    all.into_iter().collect()
}

/// The error for a name that no quantity has.
pub fn unknown(name: &str) -> UnknownName {
    UnknownName::new("quantity", name, &names())
}

impl Quantity {
    /// The material's value, which is the one that our methods take.
    pub fn value(&self, subject: &MaterialInMedium) -> Option<[f64; 3]> {
        let value = input_value(subject, self.input.name)?;
        Some(each_channel(|i| (self.derived)(value[i])))
    }

    /// How many numbers of a material it takes.
    pub fn numbers(&self) -> usize {
        match self.input.ty {
            Ty::Vec3 => 3,
            _ => 1,
        }
    }
}

/// Inputs that follow from an index, even in a method that replaces colours by those of an index.
const OF_INDEX: [&str; 2] = ["reflectivity", "edge_tint"];

fn input_value(subject: &MaterialInMedium, name: &str) -> Option<[f64; 3]> {
    let takes = |method: &&&Method| method.inputs.iter().any(|input| input.name == name);
    let fits = |method: &&&Method| {
        let is_given = is_given(method) || OF_INDEX.contains(&name);
        let is_usual = !method.is_fitted() || subject.default_methods().contains(&method.name);
        is_usual && is_given && !method.is_textured() && subject.is_described_by(method)
    };
    let exact = methods::find(subject.main_method()).into_iter();
    let exact: Vec<&'static Method> = exact.collect();
    let exact = exact.iter().filter(takes);
    let method = exact
        .chain(methods::ALL.iter().filter(takes).filter(fits))
        .next()?;
    values_for_material(subject, method).get(name).copied()
}

/// Whether a method takes a material's own value of an input. Others replace colours by those of an index.
fn is_given(method: &Method) -> bool {
    method.replacement.is_none() || method.class == Class::Dielectric
}

#[cfg(test)]
mod tests {
    use super::super::language::Language;
    use super::super::parts::functions;
    use super::*;

    #[track_caller]
    fn check(head: &str, argument: &str, expected: &[&str]) {
        let text = format!("vec3 f({head}) {{ }}");
        let found = functions(&text, Language::Gles).remove(0);
        let all: Vec<&str> = meanings(argument, &found).iter().map(|q| q.name).collect();
        assert_eq!(all, expected, "{head}: {argument}");
    }

    #[test]
    fn names_of_engines_are_known() {
        check("float u, vec3 SpecularColor", "SpecularColor", &["f0"]);
        check("float u, vec3 reflectance0", "reflectance0", &["f0"]);
        check("float u, float ior", "ior", &["eta", "1/eta"]);
        check(
            "float u, float eta_t_over_eta_i",
            "eta_t_over_eta_i",
            &["eta", "1/eta"],
        );
        check("float u, vec3 eta, vec3 k", "eta", &["n"]);
        check("float u, vec3 ior, vec3 extinction", "ior", &["n"]);
        check(
            "float u, vec3 ior, vec3 extinction",
            "extinction",
            &["k", "k^2"],
        );
        check("float u, vec3 eta, vec3 etak2", "etak2", &["k^2", "k"]);
        check("float u, vec3 F0, vec3 F82", "F82", &["f82", "f82_tint"]);
    }

    /// Beside a reflectivity `edge_tint` is Gulbrandsen's. Otherwise it is a tint at 82 degrees.
    #[test]
    fn the_other_arguments_tell_what_an_edge_tint_is() {
        let head = "float u, vec3 reflectivity, vec3 edge_tint";
        check(head, "edge_tint", &["edge_tint", "f82_tint", "f82"]);
        let head = "float u, vec3 f0, vec3 edgeTint";
        check(head, "edgeTint", &["f82_tint", "f82", "edge_tint"]);
    }

    #[test]
    fn what_is_no_quantity_has_no_meaning() {
        check("float u, vec3 N, vec3 V", "N", &[]);
        check("float roughness, vec3 f0", "roughness", &[]);
        assert!(find("1/et").is_none());
    }

    #[test]
    fn every_alias_names_a_quantity_and_stands_once() {
        let mut all: Vec<&str> = ALIASES
            .iter()
            .flat_map(|alias| alias.names)
            .copied()
            .collect();
        all.extend(INDEX.iter().chain(EDGE).chain(EDGE_COLOUR));
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count);
        for name in all {
            assert_eq!(plain(name), name);
        }
        let quantities = ALIASES.iter().flat_map(|alias| alias.quantities);
        assert!(quantities.copied().all(|name| find(name).is_some()));
        assert!(DERIVED.iter().all(|(name, ..)| find(name).is_some()));
    }
}
