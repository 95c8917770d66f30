//! A film as Cycles of Blender 5 computes it: Airy's series up to its third order, averaged over each channel's matching function.
//!
//! ```text
//! F = (F_s + F_p) / 2,  F_x = R12 + B + Σ 2 (B - T) (R12 R23)^(m/2) Re[conj(e^(imφ)) S_c(m D)],  m = 1, 2, 3
//! T = 1 - R12, B = T² R23 / (1 - R12 R23), D = 2 n₁ d c₂, φ the phase of -r12 r23
//! S_c(D) = <e^(-2πi D/λ)>          the mean over the matching function of a channel of Rec.709, light of equal energy, CIE 1931
//! ```
//!
//! A dielectric and a conductor have the exact r23. Of a metal by F82 the phase is that of an n and k which F0 and F82 stand for, by
//! Gulbrandsen's formulas, and R23 is the curve of F82-tint from the F0 below the film, the same for s and p.
//!
//! Source: L. Belcour, P. Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", ACM Transactions
//! on Graphics 36(4), 2017, <https://doi.org/10.1145/3072959.3073620>, in the form of Blender 5.0,
//! <https://docs.blender.org/manual/en/5.0/render/shader_nodes/shader/principled.html>: light is flat, the series ends, and S_c is read between
//! 512 lines. Domain: thickness_nm ≥ 0, ior ≥ 1. Error: beside pixels of Blender 5.0.1 below 1.1e-4 (the test `exchange::cycles`).

use std::f64::consts::PI;
use std::sync::LazyLock;

use glam::DVec3;

use crate::physics::num::{Complex, each_channel};
use crate::physics::spectra::{Observer, Space};

/// A film in air, on a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CyclesFilm {
    /// The film's index.
    pub ior: f64,
    /// Its thickness in nanometres.
    pub thickness_nm: f64,
    /// What lies below.
    pub base: CyclesBase,
}

/// What lies below a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CyclesBase {
    /// One index.
    Dielectric(f64),
    /// n and k of each channel.
    Conductor([f64; 3], [f64; 3]),
    /// F0, and what multiplies Schlick's value at 82 degrees.
    Tinted([f64; 3], [f64; 3]),
}

/// A film below this thickness is none, and the index of one below 1 nm goes smoothly to 1.
const NONE_NM: f64 = 0.1;
/// Orders of the series.
const ORDERS: i32 = 3;

impl CyclesFilm {
    /// F of each channel at a cosine.
    pub fn at(&self, cos_theta: f64) -> [f64; 3] {
        let c = cos_theta.clamp(0.0, 1.0);
        let blend = self.thickness_nm.min(1.0);
        let ior = match self.thickness_nm > NONE_NM {
            true => 1.0 + (self.ior - 1.0) * blend * blend * (3.0 - 2.0 * blend),
            false => 1.0,
        };
        let below2 = 1.0 - (1.0 - c * c) / (ior * ior);
        if below2 <= 0.0 {
            return [1.0; 3];
        }
        let inside = below2.sqrt();
        let path = 2.0 * ior * self.thickness_nm * inside;
        let outer = amplitudes([1.0, c], Complex::real(ior)).map(|r| r.re);
        each_channel(|channel| {
            let base = self.index(channel);
            if base.im == 0.0 && base.re * base.re <= 1.0 - c * c {
                return 1.0;
            }
            let inner = amplitudes([ior, inside], base);
            let reflected = self.tinted_below(channel, ior, base, inside);
            let polarised = |i: usize| {
                let r23 = reflected.unwrap_or(inner[i].norm_sqr());
                series(channel, path, outer[i], (r23, inner[i]))
            };
            (0.5 * (polarised(0) + polarised(1))).clamp(0.0, 1.0)
        })
    }

    /// The base's index, of a tinted metal the one that its colours stand for.
    fn index(&self, channel: usize) -> Complex<f64> {
        match self.base {
            CyclesBase::Dielectric(ior) => Complex::real(ior),
            CyclesBase::Conductor(n, k) => Complex::new(n[channel], k[channel]),
            CyclesBase::Tinted(f0, tint) => {
                let r = f0[channel].min(0.999);
                let g = f82(f0[channel], tint[channel]);
                let root = r.sqrt();
                let n = (1.0 - g) * (1.0 + root) / (1.0 - root) + g * (1.0 - r) / (1.0 + r);
                let k2 = (r * (n + 1.0).powi(2) - (n - 1.0).powi(2)) / (1.0 - r);
                Complex::new(n, k2.max(0.0).sqrt())
            }
        }
    }

    /// R23 of a tinted metal: F82-tint from F0 below the film.
    fn tinted_below(&self, channel: usize, ior: f64, base: Complex<f64>, c: f64) -> Option<f64> {
        let CyclesBase::Tinted(f0, tint) = self.base else {
            return None;
        };
        let film = Complex::real(ior);
        let below = (film - base).norm_sqr() / (film + base).norm_sqr();
        let g = f82(f0[channel], tint[channel]);
        let (s, share) = (1.0 - c, STEEP.powi(5));
        let b = (below + (1.0 - below) * share - g) * 7.0 / STEEP.powi(6);
        Some((below + (1.0 - below) * s.powi(5) - b * c * s.powi(6)).clamp(0.0, 1.0))
    }
}

/// 1 - cos θ where F82 is.
const STEEP: f64 = 6.0 / 7.0;

fn f82(f0: f64, tint: f64) -> f64 {
    ((f0 + (1.0 - f0) * STEEP.powi(5)) * tint).clamp(0.0, 1.0)
}

/// The amplitudes of s and p from a clear medium with this index and cosine; that of p is -s at 0 degrees.
fn amplitudes([n, c]: [f64; 2], base: Complex<f64>) -> [Complex<f64>; 2] {
    let real = Complex::real;
    let squared = base * base;
    // The normal component in the base, times its index.
    let w = (squared - real(n * n * (1.0 - c * c))).sqrt();
    let s = quotient(real(n * c) - w, real(n * c) + w);
    let p = quotient(squared.scale(c) - w.scale(n), squared.scale(c) + w.scale(n));
    [s, p]
}

fn quotient(one: Complex<f64>, other: Complex<f64>) -> Complex<f64> {
    let conjugate = Complex::new(other.re, -other.im);
    (one * conjugate).scale(1.0 / other.norm_sqr().max(f64::MIN_POSITIVE))
}

/// Airy's series of a channel, for one polarisation: of a path, the outer amplitude, and the inner R with the amplitude that turns it.
fn series(channel: usize, path: f64, outer: f64, (r23, inner): (f64, Complex<f64>)) -> f64 {
    let r12 = outer * outer;
    let t = 1.0 - r12;
    let both = t * t * r23 / (1.0 - r12 * r23).max(f64::MIN_POSITIVE);
    let size = inner.modulus();
    let sign = if outer >= 0.0 { -1.0 } else { 1.0 };
    let turn = match size > 0.0 {
        true => inner.scale(sign / size),
        false => Complex::real(sign),
    };
    let (mut sum, mut share, mut turned) = (r12 + both, both - t, Complex::real(1.0));
    for order in 1..=ORDERS {
        share *= (r12 * r23).sqrt();
        turned = turned * turn;
        let [re, im] = mean_wave(channel, f64::from(order) * path);
        sum += 2.0 * share * (turned.re * re + turned.im * im);
    }
    sum
}

/// The lines of the table, and the path between two of them: the step of a Fourier transform of 1022 frequencies π / 60 per µm apart.
const LINES: usize = 512;
const FREQUENCIES: usize = 1022;
const STEP_NM: f64 = 60_000.0 / (FREQUENCIES as f64 * PI);

/// S_c at a path, real and imaginary part.
fn mean_wave(channel: usize, path: f64) -> [f64; 2] {
    let place = (path / STEP_NM).clamp(0.0, (LINES - 1) as f64);
    let line = (place as usize).min(LINES - 2);
    let share = place - line as f64;
    let [low, high] = [line, line + 1].map(|line| &MEAN_WAVES[line]);
    [0, 1].map(|part| low[part][channel] + share * (high[part][channel] - low[part][channel]))
}

/// S_c at each line: real and imaginary parts of the channels.
static MEAN_WAVES: LazyLock<Vec<[DVec3; 2]>> = LazyLock::new(|| {
    let to_rgb = Space::Srgb.rgb_to_xyz().inverse();
    let weight = |j: usize| {
        let per_um = j as f64 * PI / 60.0;
        to_rgb * Observer::Cie1931.at(1000.0 / per_um) / (per_um * per_um)
    };
    let weights: Vec<DVec3> = (1..FREQUENCIES).map(weight).collect();
    let whole: DVec3 = weights.iter().sum();
    let line = |line: usize| {
        let mut sum = [DVec3::ZERO; 2];
        for (j, weight) in weights
            .iter()
            .enumerate()
            .filter(|(_, w)| **w != DVec3::ZERO)
        {
            let turn = -2.0 * PI * (((j + 1) * line) % FREQUENCIES) as f64 / FREQUENCIES as f64;
            sum[0] += *weight * libm::cos(turn) / whole;
            sum[1] += *weight * libm::sin(turn) / whole;
        }
        sum
    };
    (0..LINES).map(line).collect()
});
