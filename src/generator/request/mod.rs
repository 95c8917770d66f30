//! The request: what a run shall generate, with names resolved. It is the input of the pure library.

mod builder;
pub mod source;

use std::collections::BTreeMap;

use crate::generator::emit::{HeaderForm, Naming};
use crate::generator::error::{Error, RequestFault};
use crate::generator::flavours::Flavour;
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::generator::request::source::{Loaded, Subjects, check_is_bare, load};
use crate::language::effects::Effect;
use crate::language::methods::{self, Gpu, Method};
use crate::language::targets::{self, Target};
use crate::physics::materials::{Material, MaterialKind, ViewingConditions};
use crate::physics::num::Precision;
use crate::physics::spectra::Illuminant;

pub use source::Source;

/// What to generate. `Request::default()` is a run without flags.
#[derive(Clone, Debug)]
pub struct Request {
    /// The targets. If none are named: those written by default, or none beside flavours.
    pub targets: Vec<&'static Target>,
    /// The methods.
    pub methods: Methods,
    /// The effects. If any are named, only files of effects are written, with R by the one method that is named, and specialised
    /// to the materials that are named. If none are named, all are written in their default form where neither methods nor
    /// materials are named, otherwise none.
    pub effects: Vec<&'static Effect>,
    /// Flavours: adapters for hosts, written beside the named targets. Without named targets nothing else is written.
    pub flavours: Vec<&'static Flavour>,
    /// The materials that functions are specialised to.
    pub materials: Materials,
    /// The medium that the light comes from; none for air.
    pub medium: Option<Source>,
    /// The prefix of every function's name.
    pub prefix: String,
    /// The angle in degrees, between 0 and 90, at which λ of the corrected method is matched. None: the thesis's 81.37.
    pub matching_angle: Option<f64>,
    /// The functions' precision.
    pub precision: Precision,
    /// The GPU that functions are written for. None: that of each target.
    pub gpu: Option<Gpu>,
    /// Whether to write methods in half precision that lose too much accuracy there.
    pub force: bool,
    /// The one method of each material, by the material's name, where a budget chose them; otherwise empty.
    #[doc(hidden)]
    pub chosen: BTreeMap<String, &'static Method>,
    /// The viewing conditions of materials. Default: the whole spectrum in linear sRGB under D65.
    pub viewing: ViewingConditions,
    /// How much the comments of files say.
    pub header: HeaderForm,
    /// Whether lookup tables of the materials are written too.
    #[doc(hidden)]
    pub tables: bool,
    /// Whether the catalogue of the request's materials, in their order, is written in place of a function for each.
    #[doc(hidden)]
    pub catalogue: bool,
}

impl Default for Request {
    fn default() -> Request {
        Request {
            targets: Vec::new(),
            methods: Methods::Default,
            effects: Vec::new(),
            flavours: Vec::new(),
            materials: Materials::Default,
            medium: None,
            prefix: Naming::default().prefix,
            matching_angle: None,
            precision: Precision::F32,
            gpu: None,
            force: false,
            chosen: BTreeMap::new(),
            viewing: ViewingConditions::default(),
            header: HeaderForm::default(),
            tables: false,
            catalogue: false,
        }
    }
}

/// The choice of methods.
#[derive(Clone, Debug, Default)]
pub enum Methods {
    /// All in the library, and four for each material.
    #[default]
    Default,
    /// The same, and neither effects nor the catalogue beside them.
    All,
    /// The listed methods.
    These(Vec<&'static Method>),
}

impl Methods {
    /// The listed methods, sorted, each once; none where all are meant.
    #[doc(hidden)]
    pub fn named(&self) -> Option<Vec<&'static Method>> {
        match self {
            Methods::Default | Methods::All => None,
            Methods::These(methods) => Some(each_once(methods.clone(), |method| method.name)),
        }
    }
}

/// These items, sorted by name, each once.
pub(in crate::generator) fn each_once<T>(
    mut items: Vec<&'static T>,
    name: fn(&T) -> &'static str,
) -> Vec<&'static T> {
    items.sort_by_key(|item| name(item));
    items.dedup_by_key(|item| name(item));
    items
}

/// The choice of materials.
#[derive(Clone, Debug, PartialEq)]
pub enum Materials {
    /// Gold, platinum, water and diamond.
    Default,
    /// None: the library only.
    None,
    /// The whole catalogue.
    All,
    /// The listed materials.
    These(Vec<Source>),
}

impl Materials {
    /// The source of each material.
    pub fn sources(&self) -> Vec<Source> {
        match self {
            Materials::Default => DEFAULT_MATERIALS
                .map(|name| Source::Named(name.to_owned()))
                .to_vec(),
            Materials::None => Vec::new(),
            Materials::All => Source::catalogue().collect(),
            Materials::These(sources) => sources.clone(),
        }
    }
}

/// The materials of a run without `--material`.
pub const DEFAULT_MATERIALS: [&str; 4] = ["diamond", "gold", "platinum", "water"];

impl Request {
    /// The targets, sorted, each once. Those written by default if neither targets nor flavours are named.
    #[doc(hidden)]
    pub fn targets_or_default(&self) -> Vec<&'static Target> {
        if self.targets.is_empty() && self.flavours.is_empty() {
            let by_default = targets::ALL.iter().copied();
            return by_default.filter(|target| target.by_default).collect();
        }
        each_once(self.targets.clone(), |target| target.name)
    }

    /// The materials, each read and set in the medium, with the text of both files.
    ///
    /// # Errors
    /// A material cannot be read or is not measured over the spectrum, the medium absorbs, or two materials have one name.
    #[doc(hidden)]
    pub fn subjects(&self) -> Result<Subjects, Error> {
        let medium = self.medium.as_ref().map(load).transpose()?;
        let sources = self.materials.sources();
        let mut subjects = Subjects::default();
        for source in &sources {
            let loaded = load(source)?;
            let around = medium.as_ref().map_or("", |medium| &medium.text);
            let text = format!("{}{around}{}", loaded.text, self.light());
            match self.subject(loaded, medium.as_ref()) {
                Ok(subject) => subjects.ready.push((subject, text)),
                Err(Error::Unseen(fault)) if source.is_brought_along() => {
                    subjects.left_out.push(fault);
                }
                Err(error) => return Err(error),
            }
        }
        subjects.sorted()
    }

    /// A user's light as text. It is an input, since its name does not determine its numbers.
    fn light(&self) -> String {
        match &self.viewing.integration.illuminant {
            Illuminant::Table { power, .. } => format!("{:?}", power.points()),
            _ => String::new(),
        }
    }

    /// How functions are named.
    #[doc(hidden)]
    pub fn naming(&self) -> Naming {
        Naming {
            prefix: self.prefix.clone(),
            precision: self.precision,
            gpu: self.gpu,
        }
    }

    /// Whether it selects neither methods nor effects nor materials, in single precision. Such a run also writes effects and the
    /// catalogue, and if it names no targets either (a whole tree), tables.
    #[doc(hidden)]
    pub fn selects_nothing(&self) -> bool {
        matches!(self.methods, Methods::Default)
            && self.effects.is_empty()
            && self.materials == Materials::Default
            && !self.precision.is_half()
    }

    /// Why this method's library function, or any function of it, is not written in the request's precision; none if it is.
    #[doc(hidden)]
    pub fn refusal(&self, method: &Method, library: bool) -> Option<&'static str> {
        let refused = if library {
            method.half.library_refusal()
        } else {
            method.half.refusal()
        };
        refused.filter(|_| self.precision.is_half() && !self.force)
    }

    /// How inputs are derived from a material.
    ///
    /// # Errors
    /// The matching angle does not lie between 0 and 90 degrees.
    #[doc(hidden)]
    pub fn derivation(&self) -> Result<Derivation, Error> {
        match self.matching_angle {
            None => Ok(Derivation::default()),
            Some(degrees) if degrees > 0.0 && degrees < 90.0 => Ok(Derivation {
                matching_cos: libm::cos(degrees.to_radians()),
            }),
            Some(degrees) => Err(RequestFault::OutOfRange {
                flag: "matching-angle",
                value: degrees.to_string(),
                allowed: "must lie between 0 and 90 degrees".to_owned(),
            }
            .into()),
        }
    }

    fn subject(&self, loaded: Loaded, medium: Option<&Loaded>) -> Result<MaterialInMedium, Error> {
        if let Some(medium) = medium {
            check_transparent(&medium.material)?;
        }
        let typed = |loaded: &Loaded| (loaded.argument.clone(), loaded.material.clone());
        let subject = MaterialInMedium::new(
            typed(&loaded),
            medium.map(typed),
            &self.viewing,
            self.derivation()?,
        )?;
        check_not_a_method(&subject.name)?;
        Ok(subject)
    }
}

/// Refuses the name of a method: the exact function of a material has the material's name alone, where a method's function has
/// the method's.
fn check_not_a_method(name: &str) -> Result<(), Error> {
    let stem = name.strip_suffix("_scalar").unwrap_or(name);
    let meaning = if name.ends_with(Precision::F16.suffix()) {
        "a function in half precision"
    } else if methods::find(stem).is_some() {
        "a method's function"
    } else {
        return Ok(());
    };
    let name = name.to_owned();
    Err(RequestFault::NameTaken { name, meaning }.into())
}

/// Refuses a medium that absorbs: no light comes through a metal or a semiconductor.
///
/// # Errors
/// The medium is a metal or a semiconductor.
pub fn check_transparent(medium: &Material) -> Result<(), Error> {
    check_is_bare(medium, "medium")?;
    if medium.kind == MaterialKind::Dielectric {
        return Ok(());
    }
    Err(RequestFault::OpaqueMedium {
        name: medium.name.clone(),
        class: medium.kind.name(),
    }
    .into())
}
