//! A request step by step, as a build script makes one.

use std::path::Path;

use super::source::read;
use super::{Materials, Methods, Request, Source};
use crate::generator::emit::HeaderForm;
use crate::generator::error::{Error, RequestFault};
use crate::generator::flavours::Flavour;
use crate::language::effects::Effect;
use crate::language::methods::Method;
use crate::language::targets::Target;
use crate::physics::materials::{ViewingConditions, film_of_word};
use crate::physics::num::Precision;
use crate::physics::spectra::Space;

impl Request {
    /// What the program does without flags.
    pub fn new() -> Request {
        Request::default()
    }

    /// Adds a target. Without any, the default ones are written.
    #[must_use]
    pub fn target(mut self, target: &'static Target) -> Request {
        self.targets.push(target);
        self
    }

    /// Adds a method. Without any, the library has all, and a material gets its four default ones.
    #[must_use]
    pub fn method(mut self, method: &'static Method) -> Request {
        match &mut self.methods {
            Methods::These(methods) => methods.push(method),
            other => *other = Methods::These(vec![method]),
        }
        self
    }

    /// Adds an effect.
    #[must_use]
    pub fn effect(mut self, effect: &'static Effect) -> Request {
        self.effects.push(effect);
        self
    }

    /// Adds an adapter for an engine.
    #[must_use]
    pub fn flavour(mut self, flavour: &'static Flavour) -> Request {
        self.flavours.push(flavour);
        self
    }

    /// Adds a material of the catalogue. Without any, gold, platinum, water and diamond are meant.
    #[must_use]
    pub fn material(self, name: &str) -> Request {
        self.material_from(Source::Named(name.to_owned()))
    }

    /// Adds a material from a file: TOML, a table of n and k, or a page of refractiveindex.info.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn material_file(self, path: impl AsRef<Path>) -> Result<Request, Error> {
        let file = path.as_ref().to_string_lossy().into_owned();
        let text = read(&file)?;
        Ok(self.material_from(Source::File { file, text }))
    }

    /// Adds a material of the catalogue under films, outermost first: `material_under_films("titanium", &["titanium_dioxide:60nm"])`.
    /// A film is a material of the catalogue or an index, and its thickness in nm or um.
    ///
    /// # Errors
    /// A word is no film.
    pub fn material_under_films(self, name: &str, films: &[&str]) -> Result<Request, Error> {
        let film = |word: &&str| match film_of_word(word) {
            Ok((name, thickness_nm)) => Ok((Source::Named(name.to_owned()), thickness_nm)),
            Err(fault) => Err(RequestFault::refused(fault.to_string())),
        };
        let films = films.iter().map(film).collect::<Result<_, _>>()?;
        Ok(self.material_from(Source::Named(name.to_owned()).under_films(films)))
    }

    fn material_from(mut self, source: Source) -> Request {
        match &mut self.materials {
            Materials::These(sources) => sources.push(source),
            other => *other = Materials::These(vec![source]),
        }
        self
    }

    /// The medium that the light comes from: a material of the catalogue, or an index from 1 to 10 such as `1.5`.
    #[must_use]
    pub fn medium(mut self, name: &str) -> Request {
        self.medium = Some(Source::Named(name.to_owned()));
        self
    }

    /// The linear space that colours are given in. Without it, that of sRGB.
    #[must_use]
    pub fn space(mut self, space: Space) -> Request {
        self.viewing.integration.space = space;
        self
    }

    /// The viewing conditions: observer, illuminant, space, gamut.
    #[must_use]
    pub fn viewing(mut self, viewing: ViewingConditions) -> Request {
        self.viewing = viewing;
        self
    }

    /// The precision of functions. Without it, single precision.
    #[must_use]
    pub fn precision(mut self, precision: Precision) -> Request {
        self.precision = precision;
        self
    }

    /// How much the comments of files say.
    #[must_use]
    pub fn header(mut self, header: HeaderForm) -> Request {
        self.header = header;
        self
    }

    /// Adds lookup tables of the materials and their atlas, in `lut/`: the files that `fresnel-gen bake` writes by default. The method
    /// `table` of a material is the function that reads them.
    #[must_use]
    pub fn tables(mut self) -> Request {
        self.tables = true;
        self
    }

    /// The catalogue of the materials in the order in which they were added, in place of a function for each: their coefficients as
    /// constants, as a buffer, as textures and as JSON, and the library functions that take them. With [`Precision::F16`] the
    /// coefficients are fitted as half floats.
    #[must_use]
    pub fn catalogue(mut self) -> Request {
        self.catalogue = true;
        self
    }

    /// The files that it was made from, for `cargo::rerun-if-changed`.
    pub fn inputs(&self) -> Vec<&str> {
        let materials = match &self.materials {
            Materials::These(sources) => sources.as_slice(),
            _ => &[],
        };
        let files = materials.iter().chain(&self.medium);
        files.flat_map(Source::files).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_files_are_added_one_by_one() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/data/materials/gold.toml");
        let request = Request::new().target(Target::WGSL).method(Method::FITTED);
        let request = request.material("water").material_file(file).unwrap();
        let request = request.space(Space::DisplayP3).medium("1.5");
        assert_eq!(request.targets[0].name, "wgsl");
        assert_eq!(request.methods.named().unwrap()[0].name, "fitted");
        assert_eq!(request.inputs(), [file]);
        assert_eq!(request.materials.sources().len(), 2);
        assert!(Request::new().material_file("none.toml").is_err());
    }

    #[test]
    fn a_wrong_name_is_told_the_nearest() {
        let fault = "wsgl".parse::<&Target>().unwrap_err();
        assert!(fault.to_string().contains("did you mean wgsl"), "{fault}");
    }
}
