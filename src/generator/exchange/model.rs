//! The model of reflectance that a node of a format computes, and its error for a material.

use serde::Serialize;

use super::coat::ClearCoat;
use super::cycles_film::CyclesFilm;
use super::engine_material::{Body, EngineFilm, EngineMaterial};
use crate::generator::fit::{error_of, rounded_up, values_at};
use crate::language::ir::{Checked, Column, Value};
use crate::language::methods::{self, Method, Values};
use crate::physics::num::each_channel;

/// What a node of a format computes.
#[derive(Clone, Debug)]
pub struct Model {
    /// What the format computes, in words.
    pub words: &'static str,
    /// Its formula, with the numbers that the format gives to it.
    formula: Formula,
}

#[derive(Clone, Debug)]
enum Formula {
    /// That of one of our methods: its graph, and the values of its inputs. A scalar input uses the first number.
    Method(&'static Method, Checked, Values),
    /// A film as Cycles has it.
    CyclesFilm(CyclesFilm),
}

/// The number of cosines over which the error below a coat is sought.
const ANGLES: usize = 1024;

/// The error of a node against the spectrum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NodeError {
    /// The node.
    pub node: &'static str,
    /// What it computes, in words.
    pub model: &'static str,
    /// The largest error of reflectance, over angles and channels.
    pub max_abs: f64,
    /// The angle of the largest error, in degrees.
    pub worst_degrees: f64,
    /// The same where the medium is a coat, which refracts all light towards the normal.
    pub in_coat: Option<CoatedError>,
    /// The clear coat above the node. The error is then that of what both reflect together.
    pub coat: Option<BelowCoat>,
}

/// The coat above a node.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BelowCoat {
    /// Its index.
    pub index: f64,
    /// The mean error of coat and base together over cosines from 0 to 1, of the channel where it is largest.
    pub mean_abs: f64,
}

/// The error of a node within a coat, over the angles that occur there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CoatedError {
    /// The largest angle from the normal that occurs in the coat, in degrees.
    pub steepest_degrees: f64,
    /// The largest error of reflectance.
    pub max_abs: f64,
    /// The angle of the largest error, in degrees.
    pub worst_degrees: f64,
}

impl Model {
    fn new(words: &'static str, method: &str, values: &[(&str, [f64; 3])]) -> Model {
        let values = values.iter().map(|(name, value)| ((*name).into(), *value));
        let method = methods::find(method).expect("a test finds every model");
        let function = method.function(false).expect("a test builds every method");
        Model {
            words,
            formula: Formula::Method(method, function, values.collect()),
        }
    }

    /// A film as Cycles has it.
    pub fn cycles_film(words: &'static str, film: CyclesFilm) -> Model {
        Model {
            words,
            formula: Formula::CyclesFilm(film),
        }
    }

    /// Schlick's approximation, 1 at 90 degrees.
    pub fn schlick(f0: [f64; 3]) -> Model {
        Model::new("Schlick's approximation", "schlick", &[("f0", f0)])
    }

    /// Schlick's approximation with F90 as Filament, Bevy and Godot have it: 50 * .33 times the sum of F0, at most 1.
    pub fn schlick_f90_of_sum(f0: [f64; 3]) -> Model {
        let words = "Schlick's approximation, F90 by min(16.5 (R + G + B) of F0, 1)";
        let f90 = (16.5 * f0.iter().sum::<f64>()).min(1.0);
        Model::schlick_f90(words, f0, f90)
    }

    /// Schlick's approximation, its power as a Gaussian.
    pub fn schlick_gaussian(f0: [f64; 3]) -> Model {
        let words = "Schlick's approximation, its power as a Gaussian";
        Model::new(words, "schlick_spherical_gaussian", &[("f0", f0)])
    }

    /// One of our fitted methods with these values of its inputs.
    pub fn fitted(method: &'static Method, values: Values) -> Model {
        Model {
            words: method.name,
            formula: Formula::Method(
                method,
                method.function(false).expect("a test builds every method"),
                values,
            ),
        }
    }

    /// Schlick's approximation with a smaller reflectance at 90 degrees where F0 is small.
    pub fn schlick_f90(words: &'static str, f0: [f64; 3], f90: f64) -> Model {
        Model::new(words, "schlick_f90", &[("f0", f0), ("f90", [f90; 3])])
    }

    /// F82-tint.
    pub fn f82_tint(f0: [f64; 3], tint: [f64; 3]) -> Model {
        Model::new("F82-tint", "f82_tint", &[("f0", f0), ("tint", tint)])
    }

    /// What OpenPBR, MaterialX and Blender have: F82-tint, its tint at most 1, and of dielectrics without films the exact law for one index.
    pub fn f82_tint_or_law(material: &EngineMaterial) -> Model {
        match material.body {
            Body::Dielectric { ior, .. } if !material.subject.has_films() => Model::dielectric(ior),
            _ => Model::f82_tint(material.f0, material.tint.map(|tint| tint.clamp(0.0, 1.0))),
        }
    }

    /// The exact law for one index.
    pub fn dielectric(ior: f64) -> Model {
        let words = "Fresnel's equations with one index";
        Model::new(words, "dielectric_exact", &[("eta", [ior; 3])])
    }

    /// The exact law for one complex index per channel.
    pub fn conductor(n: [f64; 3], k: [f64; 3]) -> Model {
        let words = "Fresnel's equations with n and k of each channel";
        Model::new(words, "conductor_exact", &[("n", n), ("k", k)])
    }

    /// A film as KHR_materials_iridescence has it.
    pub fn iridescence(film: &EngineFilm, f0: [f64; 3]) -> Model {
        let words = "a film as KHR_materials_iridescence has it";
        let (ior, nm) = ([film.ior; 3], [film.thickness_nm; 3]);
        let values = [("thickness_nm", nm), ("film_ior", ior), ("base_f0", f0)];
        Model::new(words, "iridescence_khr", &values)
    }

    /// Airy's series of a film on a base with this index per channel.
    pub fn airy(words: &'static str, film: &EngineFilm, n: [f64; 3], k: [f64; 3]) -> Model {
        let (ior, nm) = ([film.ior; 3], [film.thickness_nm; 3]);
        let base = [("channel_n", n), ("channel_k", k)];
        let values = [&[("thickness_nm", nm), ("film_ior", ior)], &base[..]].concat();
        Model::new(words, "airy_materialx", &values)
    }

    /// The reflectance at each of these cosines.
    pub fn reflectances(&self, cosines: &[f64]) -> Vec<[f64; 3]> {
        let all = self.at(cosines);
        (0..cosines.len()).map(|place| all.at(place)).collect()
    }

    /// Its largest error for a material, and the angle in degrees.
    pub fn error(&self, material: &EngineMaterial) -> (f64, f64) {
        let error = error_of(&material.subject.reference, &|cosines| self.at(cosines));
        (error.max_abs, libm::acos(error.worst_cos).to_degrees())
    }

    /// The largest error of what the node and the host's coat above it reflect together, the angle in degrees, and the mean over cosines of
    /// the largest channel.
    fn error_with_coat(
        &self,
        material: &EngineMaterial,
        coat: &ClearCoat,
        index: f64,
    ) -> (f64, f64, f64) {
        let points: Vec<f64> = (0..=ANGLES).map(|i| i as f64 / ANGLES as f64).collect();
        let given = self.at(&points);
        let off = |place: usize| {
            let cos = points[place];
            let own = coat.law.reflectance(index, cos);
            let (base, want) = (given.at(place), material.truth(cos));
            let apart = each_channel(|i| (own + (1.0 - own) * base[i] - want[i]).abs());
            (apart.into_iter().fold(0.0, f64::max), cos)
        };
        let all: Vec<(f64, f64)> = (0..points.len()).map(off).collect();
        let mean = all.iter().map(|one| one.0).sum::<f64>() / all.len() as f64;
        let (most, cos) = all.into_iter().fold(
            (0.0, 1.0),
            |most, one| if one.0 > most.0 { one } else { most },
        );
        (most, libm::acos(cos).to_degrees(), mean)
    }

    /// The same where its medium is a coat of this index, in air.
    fn error_in_coat(&self, material: &EngineMaterial, index: f64) -> CoatedError {
        const PARTS: usize = 1024;
        let steepest = libm::asin(1.0 / index);
        let angles: Vec<f64> = (0..=PARTS)
            .map(|part| steepest * part as f64 / PARTS as f64)
            .collect();
        let cosines: Vec<f64> = angles.iter().map(|angle| libm::cos(*angle)).collect();
        let given = self.at(&cosines);
        let off = |part: usize| {
            let (given, want) = (given.at(part), material.subject.reference.at(cosines[part]));
            (0..3)
                .map(|channel| (given[channel] - want[channel]).abs())
                .fold(0.0, f64::max)
        };
        let all = (0..=PARTS).map(|part| (off(part), angles[part]));
        let (max_abs, worst) = all.fold(
            (0.0, 0.0),
            |most, one| if one.0 > most.0 { one } else { most },
        );
        CoatedError {
            steepest_degrees: steepest.to_degrees(),
            max_abs,
            worst_degrees: worst.to_degrees(),
        }
    }

    /// What it computes at cosines.
    fn at(&self, cosines: &[f64]) -> Value<f64> {
        match &self.formula {
            Formula::Method(method, function, values) => {
                values_at(function, method.inputs, values, cosines)
            }
            Formula::CyclesFilm(film) => {
                let all: Vec<[f64; 3]> = cosines.iter().map(|c| film.at(*c)).collect();
                let channel = |i: usize| Column::Each(all.iter().map(|rgb| rgb[i]).collect());
                Value::Rgb(each_channel(channel))
            }
        }
    }
}

impl NodeError {
    /// The error of a node for a material.
    pub fn of(
        node: &'static str,
        model: &Model,
        material: &EngineMaterial,
        coat: Option<&ClearCoat>,
    ) -> NodeError {
        let ((max_abs, worst_degrees), coat) = match material.coat.zip(coat) {
            Some((index, coat)) => {
                let (most, degrees, mean_abs) = model.error_with_coat(material, coat, index);
                ((most, degrees), Some(BelowCoat { index, mean_abs }))
            }
            None => (model.error(material), None),
        };
        NodeError {
            node,
            model: model.words,
            max_abs,
            worst_degrees,
            in_coat: material
                .medium_index
                .map(|index| model.error_in_coat(material, index)),
            coat,
        }
    }

    /// The error in one line of text.
    pub fn line(&self) -> String {
        let NodeError {
            node,
            model,
            max_abs,
            worst_degrees,
            in_coat,
            coat,
        } = self;
        let most = rounded_up(*max_abs);
        let coated = in_coat.map_or_else(String::new, |coat| coat.words());
        match coat {
            Some(BelowCoat { index, mean_abs }) => format!(
                "{node} computes {model} below its clear coat: error of both together {} on average over cosines, at most {most} (at {worst_degrees:.2} degrees outside; light in a coat of {index} is at most {:.2} degrees from the normal)",
                rounded_up(*mean_abs),
                libm::asin(1.0 / index).to_degrees()
            ),
            None => format!(
                "{node} computes {model}: error at most {most} (at {worst_degrees:.2} degrees){coated}"
            ),
        }
    }
}

impl CoatedError {
    fn words(&self) -> String {
        let most = rounded_up(self.max_abs);
        format!(
            "; where the medium is a coat of a host that bends light, light in it is at most {:.2} degrees from the normal, and the error at most {most} (at {:.2} \
             degrees)",
            self.steepest_degrees, self.worst_degrees
        )
    }
}
