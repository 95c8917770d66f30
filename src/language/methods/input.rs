//! The inputs of methods, one vocabulary: their units, domains, the source of their values, and the values that tests try. They are
//! derived from a [`KnownSurface`]. An input of a single method stands in that method's file.

use crate::language::ir::{Builder, COSINE, Expr, Ty};
use crate::physics::materials::THESIS_NM;
use crate::physics::num::{Precision, each_channel};
use crate::physics::optics::{self, COS_82};

/// An argument that a method takes after `cos_theta`.
#[derive(Clone, Copy, Debug)]
pub struct Input {
    /// Its name in every language.
    pub name: &'static str,
    /// Scalar, a value per channel, or a texture.
    pub ty: Ty,
    /// What it is, and its unit.
    pub meaning: &'static str,
    /// Its range in single precision.
    pub range: Range,
    /// Where its value comes from.
    pub source: InputSource,
    /// Whether a result may exceed 1, up to this input's value: F0 of a colour outside the gamut. Other results end at 1.
    pub raises_limit: bool,
    /// Reasonable values that tests try, in all combinations with those of other inputs: a usual one first, then the
    /// extremes that people enter, and hard cases.
    pub tried: &'static [f64],
    /// Values inside and outside its range, ascending, that the scan for failures tries.
    pub scanned: &'static [f64],
}

/// Where the value of an input comes from.
#[derive(Clone, Copy, Debug)]
pub enum InputSource {
    /// The material: its index, or what it reflects.
    Material(fn(&KnownSurface) -> [f64; 3]),
    /// The material, in channels that have a value; 0 stands for none.
    MaterialOrNone(fn(&KnownSurface) -> [Option<f64>; 3]),
    /// The material, as a value that changes from pixel to pixel: a function of a material keeps it as an argument.
    Pixel(fn(&KnownSurface) -> f64),
    /// The artist. Functions of materials take this value.
    Artist(f64),
    /// A fit to the material's reflectance over all angles.
    Fit,
    /// The texture of a lookup table, which is not a number.
    Texture,
    /// The layout of that texture. This is what `bake` writes unless asked otherwise.
    TextureLayout(f64),
}

/// The range of an argument, both ends included. A function returns a number if all arguments lie in their ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least value.
    pub least: f64,
    /// The largest value.
    pub most: f64,
}

impl Range {
    pub(super) const fn new(least: f64, most: f64) -> Range {
        Range { least, most }
    }

    /// In words: `0.001 to 1e9`.
    pub fn words(self) -> String {
        format!("{} to {}", figure(self.least), figure(self.most))
    }
}

/// A number as a person writes it.
fn figure(value: f64) -> String {
    if value.abs() < 1e5 {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

impl Input {
    /// A value per channel.
    pub(super) const fn rgb(
        name: &'static str,
        meaning: &'static str,
        [least, most]: [f64; 2],
        source: InputSource,
    ) -> Input {
        Input {
            name,
            ty: Ty::Vec3,
            meaning,
            range: Range::new(least, most),
            source,
            raises_limit: false,
            tried: &[0.0, 1.0],
            scanned: &[0.0, 1.0],
        }
    }

    /// One value for all channels.
    pub(super) const fn scalar(
        name: &'static str,
        meaning: &'static str,
        range: [f64; 2],
        source: InputSource,
    ) -> Input {
        Input {
            ty: Ty::Scalar,
            ..Input::rgb(name, meaning, range, source)
        }
    }

    /// Its value for a surface; none where the surface alone does not give one.
    pub fn value(&self, surface: &KnownSurface) -> Option<[f64; 3]> {
        match self.source {
            InputSource::Material(derived) => Some(derived(surface)),
            InputSource::MaterialOrNone(derived) => {
                Some(derived(surface).map(|value| value.unwrap_or(0.0)))
            }
            InputSource::Pixel(derived) => Some([derived(surface); 3]),
            InputSource::Artist(value) | InputSource::TextureLayout(value) => Some([value; 3]),
            InputSource::Fit | InputSource::Texture => None,
        }
    }

    /// Whether a material has a value of its own for it.
    pub fn is_of_material(&self) -> bool {
        use InputSource::{Material, MaterialOrNone};
        matches!(self.source, Material(_) | MaterialOrNone(_))
    }

    /// Whether a function of a material keeps it as an argument.
    pub fn is_kept(&self) -> bool {
        matches!(self.source, InputSource::Pixel(_))
    }

    /// The value of a channel; none where the input may be missing and the value says so by being 0 or less.
    pub fn present(&self, value: f64) -> Option<f64> {
        let may_lack = matches!(self.source, InputSource::MaterialOrNone(_));
        (!may_lack || value > 0.0).then_some(value)
    }

    pub(super) const fn tried(self, tried: &'static [f64]) -> Input {
        Input { tried, ..self }
    }

    /// The same, tried and scanned with its usual value alone.
    pub(super) const fn tried_once(self) -> Input {
        Input {
            tried: self.tried.split_at(1).0,
            scanned: self.tried.split_at(1).0,
            ..self
        }
    }

    pub(super) const fn scanned(self, scanned: &'static [f64]) -> Input {
        Input { scanned, ..self }
    }
}

/// Relative indices: below 1, nearly matched, of glass, diamond and lead telluride, and beyond.
const INDICES: &[f64] = &[
    1.5,
    1e-3,
    0.05,
    0.7,
    0.999_999_9,
    1.0,
    1.000_000_1,
    1.0001,
    2.4,
    12.0,
    1e3,
];
/// Reflectances, and gold's red in sRGB, 1.06.
const REFLECTANCES: &[f64] = &[0.04, 0.0, 1e-6, 0.5, 0.98, 1.0, 1.06];
/// Reflectances, possible and impossible.
const REFLECTANCES_AND_BEYOND: &[f64] = &[
    -1.0, -0.1, -1e-9, 0.0, 1e-9, 1e-4, 0.02, 0.04, 0.1, 0.3, 0.5, 0.8, 0.95, 0.99, 0.9999, 1.0,
    1.0001, 1.06, 1.5, 4.0, 100.0,
];
/// Fractions, and values outside [0, 1].
pub(super) const SHARES_AND_BEYOND: &[f64] = &[
    -0.5, -1e-6, 0.0, 1e-6, 0.04, 0.3, 0.5, 0.9, 1.0, 1.0001, 1.5,
];
/// Exponents of 1 - c.
pub(super) const POWERS: &[f64] = &[5.0, 0.2, 1.0, 40.0];
/// Exponents, usual and absurd.
pub(super) const POWERS_AND_BEYOND: &[f64] =
    &[0.0, 0.2, 0.5, 1.0, 2.0, 4.0, 5.0, 8.0, 20.0, 100.0, 1000.0];
/// Fractions.
pub(super) const SHARES: &[f64] = &[1.0, 0.0, 0.3];

/// The inputs that several methods take. Those of a single method stand in its file.
#[allow(missing_docs)] // each says what it is
impl Input {
    pub const ETA: Input = Input::rgb(
        "eta",
        "relative index of refraction, transmitted over incident (n_t / n_i)",
        [0.001, 1e12],
        InputSource::Material(|known| known.n),
    )
    .tried(INDICES)
    .scanned(&[0.0, 1e-30, 1e4, 1e6]);

    pub const N: Input = Input::rgb(
        "n",
        "real part of the relative index of refraction",
        [0.001, 1e9],
        InputSource::Material(|known| known.n),
    )
    .tried(INDICES)
    .scanned(&[0.0, 1e-30, 1e4, 1e6]);

    pub const K: Input = Input::rgb(
        "k",
        "extinction coefficient, the imaginary part of the relative index",
        [0.0, 1e9],
        InputSource::Material(|known| known.k),
    )
    .tried(&[1.0, 0.0, 1e-41, 1e-20, 1e-3, 4.0, 13.0, 1e4])
    .scanned(&[0.0, 1e-41, 1.0, 1e4, 1e6]);

    pub const F0: Input = Input {
        raises_limit: true,
        ..Input::rgb(
            "f0",
            "reflectance at normal incidence, linear",
            [0.0, 1.0],
            InputSource::Material(|known| known.f0),
        )
        .tried(REFLECTANCES)
        .scanned(REFLECTANCES_AND_BEYOND)
    };

    pub const F82: Input = Input::rgb(
        "f82",
        "reflectance at cos_theta = 1/7 (81.79 degrees), linear",
        [0.0, 1.0],
        InputSource::Material(|known| known.f82),
    )
    .tried(REFLECTANCES)
    .scanned(REFLECTANCES_AND_BEYOND);

    pub const F90: Input = Input::scalar(
        "f90",
        "reflectance at 90 degrees",
        [0.0, 1.0],
        InputSource::Artist(1.0),
    )
    .tried(SHARES)
    .scanned(SHARES_AND_BEYOND);
}

/// These inputs as arguments of the function that `builder` builds.
fn declared<'b>(
    builder: &'b Builder,
    inputs: &[Input],
    scalar_form: bool,
) -> Vec<(&'static str, Expr<'b>)> {
    let ty = |input: &Input| match input.ty {
        Ty::Vec3 if scalar_form => Ty::Scalar,
        ty => ty,
    };
    let declared = |input: &Input| (input.name, builder.param(input.name, ty(input)));
    inputs.iter().map(declared).collect()
}

/// The arguments of a method while it is built.
#[derive(Debug)]
pub struct Inputs<'b> {
    cos_theta: Expr<'b>,
    given: Vec<(&'static str, Expr<'b>)>,
    precision: Precision,
}

impl<'b> Inputs<'b> {
    /// Declares `cos_theta` and these inputs as arguments. In the scalar form every input is a scalar.
    pub fn declare(
        builder: &'b Builder,
        inputs: &[Input],
        scalar_form: bool,
        precision: Precision,
    ) -> Inputs<'b> {
        Inputs {
            cos_theta: builder.param(COSINE, Ty::Scalar),
            given: declared(builder, inputs, scalar_form),
            precision,
        }
    }

    /// Declares these inputs only, for functions without a cosine. In the scalar form every input is a scalar.
    pub fn without_cosine(
        builder: &'b Builder,
        inputs: &[Input],
        scalar_form: bool,
        precision: Precision,
    ) -> Inputs<'b> {
        Inputs {
            given: declared(builder, inputs, scalar_form),
            cos_theta: builder.number(1.0),
            precision,
        }
    }

    /// These expressions as `cos_theta` and these inputs, in their order: the formula becomes part of another function.
    pub fn given(
        cos_theta: Expr<'b>,
        inputs: &[Input],
        values: &[Expr<'b>],
        precision: Precision,
    ) -> Inputs<'b> {
        let names = inputs.iter().map(|input| input.name);
        Inputs {
            cos_theta,
            given: names.zip(values.iter().copied()).collect(),
            precision,
        }
    }

    /// The precision of the formula. One that overflows or cancels in half precision is built differently there.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Whether the formula is computed in half precision.
    pub fn is_half(&self) -> bool {
        self.precision.is_half()
    }

    /// `cos_theta` without a clamp. Only methods that are exempt from the contract use it.
    pub fn raw_cosine(&self) -> Expr<'b> {
        self.cos_theta
    }

    /// `cos_theta` clamped to [0, 1]: a rounded dot product may be 1 + 1 ulp, and a power of 1 - c would be NaN.
    pub fn cosine(&self) -> Expr<'b> {
        self.cos_theta
            .saturate()
            .named("c", "clamp: a rounded dot product may exceed 1")
    }

    /// An input that the method declared.
    pub fn get(&self, input: Input) -> Expr<'b> {
        let found = self.given.iter().find(|(name, _)| *name == input.name);
        found
            .expect("a method asks only for inputs that it declares; its first test would fail")
            .1
    }
}

/// The index of a film that is not there: that of glass.
const NO_FILM: f64 = 1.5;

/// cos θ at which the empirical term meets the exact law: 60 degrees.
pub const COS_60: f64 = 0.5;

/// The cosines of the two angles at which Belcour's decomposition is exact: the maxima of b2 and of -b3 in a table of 1000 cosines.
pub const BELCOUR_COSINES: [f64; 2] = [128.0 / 999.0, 432.0 / 999.0];

/// An index per channel, and reflectances at a few angles. Where a channel is one wavelength, these follow from the index by the
/// exact law. Where it is a whole spectrum, they are the spectrum's, and the index represents it.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownSurface {
    /// The real part of the index per channel.
    pub n: [f64; 3],
    /// The extinction coefficient per channel.
    pub k: [f64; 3],
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees.
    pub f82: [f64; 3],
    /// Reflectance at 60 degrees.
    pub f60: [f64; 3],
    /// cos θ at which λ of the corrected method is matched.
    pub matching_cos: f64,
    /// Reflectance there.
    pub matching: [f64; 3],
    /// Reflectance at the two angles that determine Belcour's weights.
    pub belcour: [[f64; 3]; 2],
    /// Its film, for a method of one film.
    pub film: KnownFilm,
}

/// What methods of one film know of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownFilm {
    /// The film's thickness in nanometres.
    pub thickness_nm: f64,
    /// Its index at 550 nm, relative to the medium outside.
    pub ior: f64,
    /// The index of the medium outside at 550 nm.
    pub outside: f64,
    /// What lies below it.
    pub bare: BareBase,
    /// Both at a few wavelengths, whose weighted sum gives the channels; empty for a method that takes none.
    pub samples: Vec<FilmSample>,
}

/// A surface without its film: reflectances, and the index of each channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BareBase {
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees.
    pub f82: [f64; 3],
    /// The real part of the index per channel.
    pub n: [f64; 3],
    /// The extinction coefficient per channel.
    pub k: [f64; 3],
}

/// A wavelength of [`KnownFilm`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSample {
    /// The wavelength in nanometres, in the medium outside.
    pub wavelength_nm: f64,
    /// The same in a vacuum.
    pub vacuum_nm: f64,
    /// The film's index, relative to the medium outside.
    pub film_n: f64,
    /// The base's index, relative to the same: n and k.
    pub base: [f64; 2],
    /// Its share in red, green and blue.
    pub weights: [f64; 3],
}

impl KnownFilm {
    /// A surface without a film: each channel is one wavelength, and the film has no thickness.
    fn of_index(n: [f64; 3], k: [f64; 3]) -> KnownFilm {
        let sample = |i: usize| FilmSample {
            wavelength_nm: THESIS_NM[i],
            vacuum_nm: THESIS_NM[i],
            film_n: NO_FILM,
            base: [n[i], k[i]],
            weights: each_channel(|channel| f64::from(u8::from(channel == i))),
        };
        KnownFilm {
            thickness_nm: 0.0,
            ior: NO_FILM,
            outside: 1.0,
            bare: BareBase {
                f0: each_channel(|i| optics::normal_incidence(n[i], k[i])),
                f82: each_channel(|i| optics::conductor(n[i], k[i], COS_82).unpolarised()),
                n,
                k,
            },
            samples: each_channel(sample).to_vec(),
        }
    }

    /// A number of each of the three wavelengths from `first` on. Where there are fewer, those that are lack have no weight.
    pub(super) fn three(&self, first: usize, of: fn(&FilmSample) -> f64) -> [f64; 3] {
        each_channel(|i| match self.samples.get(first + i) {
            Some(sample) => of(sample),
            None => of(&FilmSample {
                weights: [0.0; 3],
                ..self.samples[i]
            }),
        })
    }
}

impl KnownSurface {
    /// The surface with this index.
    pub fn of_index(n: [f64; 3], k: [f64; 3], matching_cos: f64) -> KnownSurface {
        let law = |c: f64| each_channel(|i| optics::conductor(n[i], k[i], c).unpolarised());
        KnownSurface {
            f0: each_channel(|i| optics::normal_incidence(n[i], k[i])),
            ..KnownSurface::with(n, k, law, matching_cos)
        }
    }

    /// The surface that this index represents, with its reflectance as a function of the cosine.
    pub fn with(
        n: [f64; 3],
        k: [f64; 3],
        seen: impl Fn(f64) -> [f64; 3],
        matching_cos: f64,
    ) -> KnownSurface {
        KnownSurface {
            n,
            k,
            f0: seen(1.0),
            f82: seen(COS_82),
            f60: seen(COS_60),
            matching_cos,
            matching: seen(matching_cos),
            belcour: BELCOUR_COSINES.map(&seen),
            film: KnownFilm::of_index(n, k),
        }
    }
}

/// The mean of the channels.
pub fn mean(channels: [f64; 3]) -> f64 {
    channels.iter().sum::<f64>() / 3.0
}
