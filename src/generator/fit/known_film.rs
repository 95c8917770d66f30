//! What methods of one film know of a material: the film, the bare base, and both at a few wavelengths. These wavelengths and their
//! shares in red, green and blue follow the whole spectrum best, over all angles and all thicknesses from 0 to the film's.
//!
//! ```text
//! F_c(θ, d) = Σ_i w_ci R(λ_i, θ, d)      Σ_i w_ci = 1, so that a mirror stays white
//! ```
//!
//! For given wavelengths the shares are those of least squares. The wavelengths begin where those of a whole spectrum lie, and
//! each moves in ever smaller steps as long as the sum of squares falls.
//! Domain: one film. Of three wavelengths in place of a spectrum, each is a channel and the sum is exact.

use super::minimax::solve;
use crate::generator::reference::{MaterialInMedium, ReferenceCurve, effective};
use crate::language::methods::{BareBase, FilmSample, KnownFilm, Light};
use crate::physics::materials::Surface;
use crate::physics::num::each_channel;
use crate::physics::optics::{COS_82, Layer, cosine, under_films};

/// The angles in degrees at which the spectrum is followed; denser near grazing, where all films change most.
const DEGREES: [f64; 20] = [
    0.0, 10.0, 20.0, 28.0, 35.0, 42.0, 48.0, 54.0, 59.0, 64.0, 68.0, 72.0, 75.0, 78.0, 80.5, 83.0,
    85.0, 87.0, 88.5, 89.5,
];
/// The steps of thickness: one for so many nanometres of n times thickness, and not fewer nor more than these.
const STEP_NM: f64 = 60.0;
const STEPS: [usize; 2] = [8, 48];
/// Wavelengths lie among these, a step apart.
const FROM_NM: f64 = 390.0;
const TO_NM: f64 = 750.0;
const GRID_NM: f64 = 5.0;
/// Where the search begins.
const THREE_NM: [f64; 3] = [610.0, 530.0, 445.0];
const SIX_NM: [f64; 6] = [635.0, 590.0, 550.0, 510.0, 465.0, 430.0];
/// By how many places of the grid a wavelength moves.
const MOVES: [usize; 3] = [4, 2, 1];
/// The angles and the finer steps of thickness over which errors are sought.
const ANGLES: usize = 40;
const FINER: usize = 6;
/// The greatest of these angles, in degrees.
pub const SEEN_DEGREES: f64 = 85.0;
/// Two wavelengths that nearly say the same have no shares of their own: this much is added to each square.
const RIDGE: f64 = 1e-9;

/// A base with less k than this counts as clear: it changes a reflectance by less than 1e-6.
const CLEAR_K: f64 = 1e-5;
/// The wavelength of a film's index in the parameters of engines.
const IOR_NM: f64 = 550.0;

/// A material under one film, at this many wavelengths: none, three or six.
pub fn known_film(subject: &MaterialInMedium, count: usize) -> KnownFilm {
    let surface = &subject.reference.surface;
    let thickness_nm = subject.material.films[0].thickness_nm;
    let here = place(surface, IOR_NM);
    let at_550 = surface.films[here][0];
    let known = KnownFilm {
        thickness_nm,
        ior: at_550.n,
        outside: if thickness_nm > 0.0 {
            at_550.waves * surface.integrator.wavelengths[here] / thickness_nm
        } else {
            1.0
        },
        bare: bare(subject),
        samples: Vec::new(),
    };
    if count == 0 {
        return known;
    }
    if !surface.is_spectral() {
        let sample = |i: usize| sample(surface, i, thickness_nm, identity(i));
        return KnownFilm {
            samples: each_channel(sample).to_vec(),
            ..known
        };
    }
    let rows = reflected_rows(surface, &DEGREES, 1);
    let start: &[f64] = if count == 3 { &THREE_NM } else { &SIX_NM };
    let squares = Squares::new(&rows, surface);
    let found = squares.nearest(start.iter().map(|nm| place(surface, *nm)).collect());
    let shares = squares.shares(&found);
    let each = found.iter().zip(&shares);
    let samples = each.map(|(at, shares)| sample(surface, *at, thickness_nm, *shares));
    KnownFilm {
        samples: samples.collect(),
        ..known
    }
}

/// What lies below the film.
fn bare(subject: &MaterialInMedium) -> BareBase {
    let surface = Surface {
        films: Vec::new(),
        ..subject.reference.surface.clone()
    };
    let reference = ReferenceCurve::new(surface, Light::Unpolarised);
    let channels = effective(&reference, subject.material.kind).channels;
    BareBase {
        f0: reference.at(1.0),
        f82: reference.at(COS_82),
        n: channels.n,
        k: channels.k,
    }
}

fn identity(channel: usize) -> [f64; 3] {
    each_channel(|i| f64::from(u8::from(i == channel)))
}

/// The place of a wavelength among those of the surface.
fn place(surface: &Surface, nm: f64) -> usize {
    let all = surface.integrator.wavelengths.iter();
    let apart = |(_, own): &(usize, &f64)| (**own - nm).abs();
    let nearest = all.enumerate().min_by(|a, b| apart(a).total_cmp(&apart(b)));
    nearest.map_or(0, |(place, _)| place)
}

fn sample(surface: &Surface, place: usize, thickness_nm: f64, weights: [f64; 3]) -> FilmSample {
    let (index, film) = (surface.indices[place], surface.films[place][0]);
    let outside = if thickness_nm > 0.0 {
        thickness_nm / film.waves
    } else {
        surface.integrator.wavelengths[place]
    };
    FilmSample {
        wavelength_nm: outside,
        vacuum_nm: surface.integrator.wavelengths[place],
        film_n: film.n,
        base: [index.n, if index.k < CLEAR_K { 0.0 } else { index.k }],
        weights,
    }
}

/// The reflectance at each wavelength, and its colour, for an angle and a thickness.
struct Row {
    spectrum: Vec<f64>,
    colour: [f64; 3],
}

/// At these angles, and so many times as many thicknesses as least squares want.
fn reflected_rows(surface: &Surface, degrees: &[f64], times: usize) -> Vec<Row> {
    let optical = |(films, nm): (&Vec<Layer>, &f64)| films[0].n * films[0].waves * nm;
    let both = surface.films.iter().zip(&surface.integrator.wavelengths);
    let most = both.map(optical).fold(0.0, f64::max);
    let steps = times * ((most / STEP_NM).ceil() as usize).clamp(STEPS[0], STEPS[1]);
    let shares = (0..=steps).map(|i| i as f64 / steps as f64);
    let row = |share: f64, degrees: f64| {
        let at = |place: usize| {
            let (index, film) = (surface.indices[place], surface.films[place][0]);
            under_films(&[film.of_share(share)], index.n, index.k, cosine(degrees)).unpolarised()
        };
        let spectrum: Vec<f64> = (0..surface.indices.len()).map(at).collect();
        Row {
            colour: surface.integrator.colour(&spectrum).to_array(),
            spectrum,
        }
    };
    shares
        .flat_map(|share| degrees.iter().map(move |degrees| (share, *degrees)))
        .map(|(share, degrees)| row(share, degrees))
        .collect()
}

/// The sums of products that least squares need, for the wavelengths of the grid.
struct Squares {
    /// The places of the grid among the surface's wavelengths.
    grid: Vec<usize>,
    /// Of two wavelengths.
    own: Vec<Vec<f64>>,
    /// Of a wavelength and each channel.
    with_colour: Vec<[f64; 3]>,
}

impl Squares {
    fn new(rows: &[Row], surface: &Surface) -> Squares {
        let steps = ((TO_NM - FROM_NM) / GRID_NM) as usize;
        let nm = |i: usize| FROM_NM + GRID_NM * i as f64;
        let grid: Vec<usize> = (0..=steps).map(|i| place(surface, nm(i))).collect();
        let sum = |of: &dyn Fn(&Row) -> f64| rows.iter().map(of).sum::<f64>();
        let product = |a: usize, b: usize| sum(&|row| row.spectrum[a] * row.spectrum[b]);
        let own = grid
            .iter()
            .map(|a| grid.iter().map(|b| product(*a, *b)).collect());
        let own: Vec<Vec<f64>> = own.collect();
        let of_colour = |a: &usize| each_channel(|i| sum(&|row| row.spectrum[*a] * row.colour[i]));
        Squares {
            own,
            with_colour: grid.iter().map(of_colour).collect(),
            grid,
        }
    }

    /// The place in the grid.
    fn inner(&self, place: usize) -> usize {
        self.grid.iter().position(|own| *own == place).unwrap_or(0)
    }

    /// The shares of these wavelengths in each channel: least squares, with a sum of 1.
    fn shares(&self, places: &[usize]) -> Vec<[f64; 3]> {
        let inner: Vec<usize> = places.iter().map(|place| self.inner(*place)).collect();
        self.solved(&inner)
    }

    fn solved(&self, inner: &[usize]) -> Vec<[f64; 3]> {
        let count = inner.len();
        let mut rows: Vec<Vec<f64>> = inner
            .iter()
            .map(|a| {
                let squares = inner.iter().map(|b| {
                    let ridge = if a == b { 1.0 + RIDGE } else { 1.0 };
                    self.own[*a][*b] * ridge
                });
                squares.chain([1.0]).collect()
            })
            .collect();
        rows.push([vec![1.0; count], vec![0.0]].concat());
        let of = |channel: usize| {
            let values = inner.iter().map(|a| self.with_colour[*a][channel]);
            let found = solve(rows.clone(), values.chain([1.0]).collect());
            // Where nothing is reflected at any thickness, all shares are as good: to each channel its own wavelengths.
            let own = (0..=count).map(|i| i * 3 / count == channel);
            found.unwrap_or_else(|| {
                own.map(|is| f64::from(u8::from(is)) * 3.0 / count as f64)
                    .collect()
            })
        };
        let channels = each_channel(of);
        (0..count)
            .map(|i| each_channel(|c| channels[c][i]))
            .collect()
    }

    /// The sum of squares of what these wavelengths miss, less a part that is the same for all.
    fn missed(&self, inner: &[usize]) -> f64 {
        let shares = self.solved(inner);
        let each = inner.iter().zip(&shares);
        let of = |(a, share): (&usize, &[f64; 3])| {
            let own = |c: usize| {
                let sum = inner
                    .iter()
                    .zip(&shares)
                    .map(|(b, other)| self.own[*a][*b] * other[c]);
                share[c] * (sum.sum::<f64>() - 2.0 * self.with_colour[*a][c])
            };
            (0..3).map(own).sum::<f64>()
        };
        each.map(of).sum()
    }

    /// The best wavelengths that are found from here.
    fn nearest(&self, start: Vec<usize>) -> Vec<usize> {
        let mut inner: Vec<usize> = start.iter().map(|place| self.inner(*place)).collect();
        let mut least = self.missed(&inner);
        for by in MOVES {
            let mut has_moved = true;
            while has_moved {
                has_moved = false;
                for i in 0..inner.len() {
                    let here = inner[i];
                    for to in [here.checked_sub(by), Some(here + by)]
                        .into_iter()
                        .flatten()
                    {
                        if to >= self.grid.len() || inner.contains(&to) {
                            continue;
                        }
                        let mut tried = inner.clone();
                        tried[i] = to;
                        let missed = self.missed(&tried);
                        if missed < least - 1e-9 * least.abs() {
                            (inner, least, has_moved) = (tried, missed, true);
                        }
                    }
                }
            }
        }
        inner.iter().map(|place| self.grid[*place]).collect()
    }
}

/// The largest error of a method of a few wavelengths over thicknesses from 0 to that of the film, angles up to [`SEEN_DEGREES`] and
/// channels. Nearer to grazing fringes get as narrow as the cosine, and may fall between the wavelengths.
pub fn thickness_error(subject: &MaterialInMedium, film: &KnownFilm) -> f64 {
    let surface = &subject.reference.surface;
    if !surface.is_spectral() {
        return 0.0;
    }
    let places: Vec<usize> = (film.samples.iter())
        .map(|sample| place(surface, sample.vacuum_nm))
        .collect();
    let degrees: Vec<f64> = (0..=ANGLES)
        .map(|i| SEEN_DEGREES * i as f64 / ANGLES as f64)
        .collect();
    let rows = reflected_rows(surface, &degrees, FINER);
    let off = |row: &Row| {
        let each = each_channel(|channel| {
            let parts = places.iter().zip(&film.samples);
            let sum = parts.map(|(at, sample)| row.spectrum[*at] * sample.weights[channel]);
            let truth = row.colour[channel].clamp(0.0, 1.0);
            (sum.sum::<f64>().clamp(0.0, 1.0) - truth).abs()
        });
        each.into_iter().fold(0.0, f64::max)
    };
    rows.iter().map(off).fold(0.0, f64::max)
}
