//! The request: what a run shall generate, with names resolved. It is the input of the pure library.

mod builder;
pub mod source;

use std::collections::BTreeMap;

use crate::generator::emit::{HeaderForm, Naming};
use crate::generator::error::{Error, RequestFault, unknown};
use crate::generator::flavours::Flavour;
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::generator::request::source::{Loaded, Subjects, load};
use crate::language::effects::{self, Effect};
use crate::language::methods::{self, Method};
use crate::language::targets::{self, Target};
use crate::physics::materials::{self, Material, MaterialKind, ViewingConditions};
use crate::physics::names::UnknownName;
use crate::physics::num::Precision;
use crate::physics::spectra::Illuminant;

/// What to generate. `Request::default()` is a run without flags.
#[derive(Clone, Debug)]
pub struct Request {
    /// Names of targets, or `all` for those written by default. Empty: the same as `all`.
    pub targets: Vec<String>,
    /// Names of methods, or `all`. Empty: all, and each material gets its four default ones.
    pub methods: Vec<String>,
    /// Names of effects, or `all`. If any are named, only files of effects are written, with R by the one method that is named,
    /// and specialised to the materials that are named. If none are named, all are written in their default form where neither
    /// methods nor materials are named, otherwise none.
    pub effects: Vec<String>,
    /// Names of flavours: adapters for hosts, written beside the named targets. Without named targets nothing else is written.
    pub flavours: Vec<String>,
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
    /// Whether to write methods in half precision that lose too much accuracy there.
    pub force: bool,
    /// The one method of each material, by the material's name, where a budget chose them; otherwise empty.
    #[doc(hidden)]
    pub chosen: BTreeMap<String, &'static str>,
    /// The viewing conditions of materials. Default: the whole spectrum in linear sRGB under D65.
    pub viewing: ViewingConditions,
    /// How much the comments of files say.
    pub header: HeaderForm,
    /// Whether lookup tables of the materials are written too.
    #[doc(hidden)]
    pub tables: bool,
}

impl Default for Request {
    fn default() -> Request {
        Request {
            targets: Vec::new(),
            methods: Vec::new(),
            effects: Vec::new(),
            flavours: Vec::new(),
            materials: Materials::Default,
            medium: None,
            prefix: Naming::default().prefix,
            matching_angle: None,
            precision: Precision::F32,
            force: false,
            chosen: BTreeMap::new(),
            viewing: ViewingConditions::default(),
            header: HeaderForm::default(),
            tables: false,
        }
    }
}

/// The choice of materials.
#[derive(Clone, Debug, PartialEq, Eq)]
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

/// The source of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A material of the catalogue. A medium can also be a refractive index from 1 to 10, such as `1.5`, without absorption and
    /// dispersion.
    Named(String),
    /// A material of the catalogue that `all` includes. It is left out where it is not known over the whole spectrum.
    BroughtAlong(String),
    /// A user's file, already read.
    File {
        /// Its name, for messages and for the command in headers.
        file: String,
        /// Its text.
        text: String,
    },
}

impl Source {
    /// The argument that names it again on the command line.
    ///
    /// # Errors
    /// As [`load`].
    #[doc(hidden)]
    pub fn argument(&self) -> Result<String, Error> {
        Ok(load(self)?.argument)
    }

    /// All materials of the catalogue.
    #[doc(hidden)]
    pub fn catalogue() -> impl Iterator<Item = Source> {
        materials::names()
            .into_iter()
            .map(|name| Source::BroughtAlong(name.to_owned()))
    }
}

/// The materials of a run without `--material`.
pub const DEFAULT_MATERIALS: [&str; 4] = ["diamond", "gold", "platinum", "water"];

impl Request {
    /// The targets, sorted, each once. Those written by default if neither targets nor flavours are named.
    ///
    /// # Errors
    /// A name is no target.
    #[doc(hidden)]
    pub fn resolved_targets(&self) -> Result<Vec<&'static Target>, Error> {
        let by_default = || {
            targets::ALL
                .iter()
                .filter(|target| target.by_default)
                .copied()
        };
        let all: Vec<&str> = targets::ALL
            .iter()
            .map(|target| target.name)
            .chain(["all"])
            .collect();
        let mut chosen: Vec<&Target> = Vec::new();
        for name in &self.targets {
            match targets::find(name) {
                Some(target) => chosen.push(target),
                None if name == "all" => chosen.extend(by_default()),
                None => return Err(unknown("target", name, &all)),
            }
        }
        if self.targets.is_empty() && self.flavours.is_empty() {
            chosen.extend(by_default());
        }
        chosen.sort_by_key(|target| target.name);
        chosen.dedup_by_key(|target| target.name);
        Ok(chosen)
    }

    /// The methods asked for by name, sorted, each once; none where all are meant.
    ///
    /// # Errors
    /// A name is no method.
    #[doc(hidden)]
    pub fn resolved_methods(&self) -> Result<Option<Vec<&'static Method>>, Error> {
        let all: Vec<&str> = methods::ALL
            .iter()
            .map(|method| method.name)
            .chain(["all"])
            .collect();
        let mut chosen: Vec<&Method> = Vec::new();
        for name in self.methods.iter().filter(|name| *name != "all") {
            chosen.push(methods::find(name).ok_or_else(|| unknown("method", name, &all))?);
        }
        chosen.sort_by_key(|method| method.name);
        chosen.dedup_by_key(|method| method.name);
        Ok(
            (!self.methods.is_empty() && !self.methods.iter().any(|name| name == "all"))
                .then_some(chosen),
        )
    }

    /// The effects asked for by name, sorted, each once.
    ///
    /// # Errors
    /// A name is no effect.
    #[doc(hidden)]
    pub fn resolved_effects(&self) -> Result<Vec<&'static Effect>, Error> {
        let names = effects::ALL.iter().map(|effect| effect.name);
        let all: Vec<&str> = names.chain(["all"]).collect();
        let mut chosen: Vec<&Effect> = Vec::new();
        for name in &self.effects {
            match effects::find(name) {
                Some(effect) => chosen.push(effect),
                None if name == "all" => chosen.extend(effects::ALL),
                None => return Err(unknown("effect", name, &all)),
            }
        }
        chosen.sort_by_key(|effect| effect.name);
        chosen.dedup_by_key(|effect| effect.name);
        Ok(chosen)
    }

    /// The flavours, sorted, each once.
    ///
    /// # Errors
    /// A name is no flavour.
    #[doc(hidden)]
    pub fn resolved_flavours(&self) -> Result<Vec<&'static Flavour>, Error> {
        let parsed = self.flavours.iter().map(|name| name.parse());
        let mut chosen: Vec<&'static Flavour> = parsed.collect::<Result<_, UnknownName>>()?;
        chosen.sort_by_key(|flavour| flavour.name);
        chosen.dedup_by_key(|flavour| flavour.name);
        Ok(chosen)
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
            match (self.subject(loaded, medium.as_ref()), source) {
                (Ok(subject), _) => subjects.ready.push((subject, text)),
                (Err(Error::Unseen(fault)), Source::BroughtAlong(_)) => {
                    subjects.left_out.push(fault);
                }
                (Err(error), _) => return Err(error),
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
        }
    }

    /// Whether it names neither methods nor effects nor materials, in single precision. Such a run also writes effects and the
    /// catalogue, and if it names no targets either (a whole tree), tables.
    #[doc(hidden)]
    pub fn names_nothing(&self) -> bool {
        self.methods.is_empty()
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
    if name.ends_with(Precision::F16.suffix()) {
        let meaning = "a function in half precision";
        return Err(RequestFault::NameTaken {
            name: name.to_owned(),
            meaning,
        }
        .into());
    }
    if methods::find(stem).is_none() {
        return Ok(());
    }
    let meaning = "a method's function";
    Err(RequestFault::NameTaken {
        name: name.to_owned(),
        meaning,
    }
    .into())
}

/// Refuses a medium that absorbs: no light comes through a metal or a semiconductor.
///
/// # Errors
/// The medium is a metal or a semiconductor.
pub fn check_transparent(medium: &Material) -> Result<(), Error> {
    if medium.kind == MaterialKind::Dielectric {
        return Ok(());
    }
    Err(RequestFault::OpaqueMedium {
        name: medium.name.clone(),
        class: medium.kind.name(),
    }
    .into())
}
