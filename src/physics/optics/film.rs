//! Reflectance of a surface under films: layers so thin that what their faces reflect interferes.
//!
//! From the base outwards, each layer turns the admittance Y of what lies below it into that of both:
//!
//! ```text
//! w  = √(m² − sin²θ)                          of each medium, as in `conductor`; sin θ in the medium outside
//! y  = w for s, w/m² for p                    the admittance of s, the impedance of p; at the base, Y = y
//! δ  = 2π t w                                 the layer's phase; t = thickness × n_outside / λ
//! Y' = (Y C − i y S) / (C − i Y S/y)          C = e^(iδ) cos δ, S = e^(iδ) sin δ
//! r  = (cos θ − Y) / (cos θ + Y)              R = |r|²
//! ```
//!
//! Source: the characteristic matrix of F. Abelès, *Recherches sur la propagation des ondes électromagnétiques sinusoïdales dans les
//! milieux stratifiés*, Annales de Physique 12(5), 1950, <https://doi.org/10.1051/anphys/195012050596>, as a recursion (H. A. Macleod,
//! *Thin-Film Optical Filters*, 4th edition, CRC Press, 2010, section 2.4, <https://doi.org/10.1201/9781420073034>). Here numerator
//! and denominator are multiplied by e^(iδ), whose modulus is at most 1, so that a thick absorbing layer overflows nothing.
//! S/y and y S have limits where w = 0, so that no angle is special.
//!
//! Domain: that of `conductor` for each medium; t ≥ 0, and 0 is no layer. Error: within 1e-12 of the package `tmm`
//! 0.2.0 for 1000 random stacks (the test `physics::films`).

use super::interface::{normal_component, power_ratio, root};
use super::{Reflectance, conductor};
use crate::physics::num::Complex;

/// A layer of a stack of films.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Refractive index relative to the medium outside.
    pub n: f64,
    /// Extinction coefficient, relative to the same.
    pub k: f64,
    /// Thickness in wavelengths of the medium outside.
    pub waves: f64,
}

impl Layer {
    /// The layer with this share of its thickness.
    pub fn of_share(self, share: f64) -> Layer {
        let waves = share * self.waves;
        Layer { waves, ..self }
    }

    /// The same layer in another medium, of this index relative to the one outside.
    pub fn within(self, medium: f64) -> Layer {
        Layer {
            n: self.n / medium,
            k: self.k / medium,
            waves: self.waves * medium,
        }
    }
}

/// Reflectance of layers, outermost first, on the surface of m = n + ik.
///
/// ```
/// use fresnel_gen::physics::optics::{Layer, under_films};
///
/// // A quarter of a wave of magnesium fluoride makes glass reflect less.
/// let coat = Layer { n: 1.38, k: 0.0, waves: 0.25 / 1.38 };
/// let coated = under_films(&[coat], 1.52, 0.0, 1.0).unpolarised();
/// assert!((coated - 0.0126).abs() < 1e-4);
/// ```
pub fn under_films(layers: &[Layer], n: f64, k: f64, cos_theta: f64) -> Reflectance<f64> {
    let present = || layers.iter().filter(|layer| layer.waves > 0.0);
    if present().next().is_none() {
        return conductor(n, k, cos_theta);
    }
    let mut below = Wave::new(n, k, cos_theta).alone();
    for layer in present().rev() {
        let wave = Wave::new(layer.n, layer.k, cos_theta);
        below = below.through(&wave, &phases(wave.w, layer.waves));
    }
    below.reflected(cos_theta)
}

/// The reflectance for unpolarised light of a stack at several wavelengths, to the bit that of [`under_films`] at each: its layers and
/// m = n + ik of its base at each wavelength. Each step is taken at all wavelengths before the next, so that a compiler takes several
/// at a time.
pub fn unpolarised_under_films(
    stacks: &[Vec<Layer>],
    bases: &[(f64, f64)],
    cos_theta: f64,
) -> Vec<f64> {
    let count = stacks.first().map_or(0, Vec::len);
    let is_whole =
        |stack: &Vec<Layer>| stack.len() == count && stack.iter().all(|layer| layer.waves > 0.0);
    if count == 0 || stacks.len() != bases.len() || !stacks.iter().all(is_whole) {
        let layers = |i: usize| stacks.get(i).map_or(&[][..], Vec::as_slice);
        let bases = bases.iter().enumerate();
        return bases
            .map(|(i, (n, k))| under_films(layers(i), *n, *k, cos_theta).unpolarised())
            .collect();
    }
    let base = bases.iter().map(|(n, k)| Wave::new(*n, *k, cos_theta));
    let base: Vec<Wave> = base.collect();
    let mut below: Vec<Admittances> = base.iter().map(Wave::alone).collect();
    for place in (0..count).rev() {
        let layers: Vec<Layer> = stacks.iter().map(|stack| stack[place]).collect();
        let waves = layers
            .iter()
            .map(|layer| Wave::new(layer.n, layer.k, cos_theta));
        let waves: Vec<Wave> = waves.collect();
        let phases = waves
            .iter()
            .zip(&layers)
            .map(|(wave, layer)| phases(wave.w, layer.waves));
        let phases: Vec<Phases> = phases.collect();
        for ((below, wave), phases) in below.iter_mut().zip(&waves).zip(&phases) {
            *below = below.through(wave, phases);
        }
    }
    let reflected = below
        .iter()
        .map(|below| below.reflected(cos_theta).unpolarised());
    reflected.collect()
}

/// What lies below a layer: the admittance of s, the impedance of p.
#[derive(Clone, Copy)]
struct Admittances {
    s: Complex<f64>,
    p: Complex<f64>,
}

impl Admittances {
    /// The same with a layer on it.
    #[inline]
    fn through(self, wave: &Wave, (cosine, sine, sine_over_w): &Phases) -> Admittances {
        let through = |y: Complex<f64>, up: Complex<f64>, down: Complex<f64>| {
            quotient(y * *cosine - times_i(up), *cosine - times_i(y * down))
        };
        let up = wave.w * *sine;
        Admittances {
            s: through(self.s, up, *sine_over_w),
            p: through(
                self.p,
                quotient(up, wave.squared),
                wave.squared * *sine_over_w,
            ),
        }
    }

    #[inline]
    fn reflected(self, cos_theta: f64) -> Reflectance<f64> {
        Reflectance {
            s: reflected(cos_theta, self.s),
            p: reflected(cos_theta, self.p),
        }
    }
}

/// m² and w of a medium.
#[derive(Clone, Copy)]
struct Wave {
    squared: Complex<f64>,
    w: Complex<f64>,
}

impl Wave {
    #[inline]
    fn new(n: f64, k: f64, cos_theta: f64) -> Wave {
        Wave {
            squared: Complex::new((n - k) * (n + k), 2.0 * n * k),
            w: root(normal_component(n, k, cos_theta)),
        }
    }

    /// A base without layers.
    #[inline]
    fn alone(&self) -> Admittances {
        Admittances {
            s: self.w,
            p: quotient(self.w, self.squared),
        }
    }
}

/// C, S and S/w of a layer.
type Phases = (Complex<f64>, Complex<f64>, Complex<f64>);

fn phases(w: Complex<f64>, waves: f64) -> Phases {
    let wave_number = 2.0 * std::f64::consts::PI * waves;
    let phase = w.scale(wave_number);
    // A clear film has no decay, and `exp` of 0 is 1.
    let decay = if phase.im == 0.0 {
        1.0
    } else {
        libm::exp(-phase.im)
    };
    let (sin, cos) = libm::sincos(phase.re);
    let once = Complex::new(decay * cos, decay * sin);
    let twice = once * once;
    let cosine = Complex::new(0.5 * (1.0 + twice.re), 0.5 * twice.im);
    if phase.modulus() > SMALL {
        // (e^(2iδ) − 1)/(2i)
        let sine = Complex::new(0.5 * twice.im, 0.5 * (1.0 - twice.re));
        return (cosine, sine, quotient(sine, w));
    }
    // There the difference loses digits, and w may be 0: sin δ/δ is taken by its series instead.
    let square = phase * phase;
    let mut term = Complex::real(1.0);
    let mut ratio = term;
    for i in 1..=TERMS {
        let place = f64::from(2 * i);
        term = (term * square).scale(-1.0 / (place * (place + 1.0)));
        ratio = ratio + term;
    }
    let sine_over_w = (once * ratio).scale(wave_number);
    (cosine, sine_over_w * w, sine_over_w)
}

/// Below this |δ|, sin δ/δ is summed as a series of this many terms after 1. The first that is left out is 2.4e-17 of the sum.
const SMALL: f64 = 0.5;
const TERMS: u32 = 6;

/// |(a − y)/(a + y)|² for a real a ≥ 0; 0 where both are 0, as for a surface that is not there.
#[inline]
fn reflected(a: f64, y: Complex<f64>) -> f64 {
    let outside = Complex::real(a);
    let ratio = power_ratio(outside, y);
    if (outside + y).norm_sqr() == 0.0 {
        0.0
    } else {
        ratio
    }
}

#[inline]
fn times_i(z: Complex<f64>) -> Complex<f64> {
    Complex::new(-z.im, z.re)
}

#[inline]
fn quotient(a: Complex<f64>, b: Complex<f64>) -> Complex<f64> {
    let conjugate = Complex::new(b.re, -b.im);
    (a * conjugate).scale(1.0 / b.norm_sqr())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics::{cosine, normal_incidence};

    const GLASS: f64 = 1.52;

    fn at_normal(layers: &[Layer], n: f64, k: f64) -> f64 {
        under_films(layers, n, k, 1.0).unpolarised()
    }

    fn clear(n: f64, waves: f64) -> Layer {
        Layer { n, k: 0.0, waves }
    }

    #[test]
    fn a_film_of_no_thickness_is_the_base_to_the_bit() {
        for (n, k) in [(1.5, 0.0), (0.2, 3.4), (1.0, 0.0), (0.7, 0.0)] {
            for degrees in [0.0, 30.0, 75.0, 90.0] {
                let c = cosine(degrees);
                let films = [clear(1.4, 0.0), clear(2.4, 0.0)];
                assert_eq!(under_films(&films, n, k, c), conductor(n, k, c));
            }
        }
    }

    #[test]
    fn all_wavelengths_together_are_each_alone_to_the_bit() {
        let media = [(1.5, 0.0), (0.2, 3.4), (1.0, 0.0), (0.7, 0.0), (2.6, 1e-3)];
        let layer = |(n, k): (f64, f64), waves| Layer { n, k, waves };
        for layers in 1..=3 {
            let stack = |i: usize| {
                let of = |j: usize| layer(media[(i * 2 + j) % 5], 0.01 * (1 + 7 * i + j) as f64);
                (0..layers).map(of).collect()
            };
            let mut stacks: Vec<Vec<Layer>> = (0..25).map(stack).collect();
            let bases: Vec<(f64, f64)> = (0..25).map(|i| media[i / 5]).collect();
            for thin in [false, true] {
                for i in 0..=90 {
                    let c = cosine(f64::from(i));
                    let all = unpolarised_under_films(&stacks, &bases, c);
                    for (place, got) in all.iter().enumerate() {
                        let (n, k) = bases[place];
                        let want = under_films(&stacks[place], n, k, c).unpolarised();
                        assert_eq!(got.to_bits(), want.to_bits(), "{layers} {place} {c}");
                    }
                }
                if !thin {
                    stacks[3][0].waves = 0.0;
                }
            }
        }
    }

    /// A film of the base's own index, and one of the medium's, change nothing.
    #[test]
    fn a_film_of_either_neighbours_index_is_not_seen() {
        for (n, k) in [(1.5, 0.0), (0.2, 3.4), (4.0, 0.3), (0.7, 0.0)] {
            for degrees in [0.0, 30.0, 44.0, 75.0, 89.9, 90.0] {
                let c = cosine(degrees);
                let want = conductor(n, k, c);
                for layer in [Layer { n, k, waves: 0.37 }, clear(1.0, 0.81)] {
                    let got = under_films(&[layer], n, k, c);
                    let apart = (got.s - want.s).abs().max((got.p - want.p).abs());
                    assert!(
                        apart < 1e-13,
                        "{n} {k} {degrees} {layer:?}: {got:?} {want:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_quarter_wave_of_the_root_of_an_index_reflects_nothing_and_a_half_wave_is_not_seen() {
        let root = GLASS.sqrt();
        let quarter = 0.25 / root;
        assert!(at_normal(&[clear(root, quarter)], GLASS, 0.0) < 1e-30);
        for shift in [0.97, 1.03] {
            assert!(at_normal(&[clear(root, shift * quarter)], GLASS, 0.0) > 1e-5);
        }
        let bare = normal_incidence(GLASS, 0.0);
        for index in [1.38, 2.4] {
            let half = at_normal(&[clear(index, 0.5 / index)], GLASS, 0.0);
            assert!((half - bare).abs() < 1e-15, "{half}");
        }
    }

    /// Newton's black spot: both faces of a soap film cancel.
    #[test]
    fn a_soap_film_reflects_nothing_as_it_gets_thin() {
        let mut last = 1.0;
        for waves in [0.18, 0.1, 0.03, 0.01, 1e-3, 1e-6] {
            let now = at_normal(&[clear(1.33, waves)], 1.0, 0.0);
            assert!(now < last, "{waves}: {now}");
            last = now;
        }
        assert!(last < 1e-10, "{last}");
    }

    #[test]
    fn fringes_move_to_shorter_waves_with_the_angle() {
        // The first maximum of soap: 2 n d cos θt = λ/2.
        for degrees in [0.0, 40.0, 70.0] {
            let c = cosine(degrees);
            let inside = (1.33 * 1.33 - (1.0 - c * c)).sqrt();
            let at = |waves: f64| under_films(&[clear(1.33, waves)], 1.0, 0.0, c).s;
            let peak = 0.25 / inside;
            assert!(at(peak) > at(0.98 * peak) && at(peak) > at(1.02 * peak));
        }
    }

    /// The characteristic matrices multiplied, which also give what is transmitted; they overflow where layers are thick.
    fn by_matrices(layers: &[Layer], eta: f64, c: f64) -> (f64, f64) {
        let wave = Wave::new(eta, 0.0, c);
        let mut top = [Complex::real(1.0), wave.w];
        for layer in layers.iter().rev() {
            let inner = Wave::new(layer.n, layer.k, c);
            let phase = inner.w.scale(2.0 * std::f64::consts::PI * layer.waves);
            let (sin, cos) = libm::sincos(phase.re);
            let (sinh, cosh) = (libm::sinh(phase.im), libm::cosh(phase.im));
            let (sine, cosine) = (
                Complex::new(sin * cosh, cos * sinh),
                Complex::new(cos * cosh, -sin * sinh),
            );
            let [b, d] = top;
            top = [
                b * cosine - times_i(quotient(d * sine, inner.w)),
                d * cosine - times_i(b * sine * inner.w),
            ];
        }
        let [b, d] = top;
        let whole = b.scale(c) + d;
        let reflected = quotient(b.scale(c) - d, whole).norm_sqr();
        (reflected, 4.0 * c * wave.w.re / whole.norm_sqr())
    }

    #[test]
    fn what_is_not_reflected_is_transmitted() {
        let layers = [clear(2.35, 0.11), clear(1.46, 0.4), clear(1.9, 1.7)];
        for c in [1.0, 0.8, 0.3, 0.05] {
            let (reflected, transmitted) = by_matrices(&layers, GLASS, c);
            let got = under_films(&layers, GLASS, 0.0, c).s;
            assert!((got - reflected).abs() < 1e-14, "{c}: {got} {reflected}");
            assert!((got + transmitted - 1.0).abs() < 1e-13, "{c}");
        }
    }

    #[test]
    fn energy_is_conserved_and_a_thick_metal_hides_its_base() {
        let metal = Layer {
            n: 0.2,
            k: 3.4,
            waves: 1e6,
        };
        for c in [1.0, 0.6, 0.1, 1e-3, 0.0] {
            let want = conductor(metal.n, metal.k, c);
            let got = under_films(&[metal], GLASS, 0.0, c);
            assert!((got.s - want.s).abs() < 1e-14 && (got.p - want.p).abs() < 1e-14);
            let above = under_films(&[clear(1.4, 3.1), metal], GLASS, 0.0, c);
            assert!((0.0..=1.0).contains(&above.s) && (0.0..=1.0).contains(&above.p));
        }
    }

    /// Past the critical angle of a layer its wave fades: a thick one reflects all, a thin one lets light through. At the angle
    /// itself w is 0.
    #[test]
    fn total_reflection_is_frustrated_by_a_thin_layer() {
        let gap = |waves, c| under_films(&[clear(0.6, waves)], 1.0, 0.0, c);
        assert!(gap(40.0, 0.3).s > 1.0 - 1e-15);
        assert!((0.01..0.99).contains(&gap(0.1, 0.3).s));
        let critical = (1.0 - 0.6_f64 * 0.6).sqrt();
        for c in [critical, critical - 1e-12, critical + 1e-12] {
            let near = gap(0.3, c);
            let at = gap(0.3, 0.8);
            assert!(
                (near.s - at.s).abs() < 1e-9 && (near.p - at.p).abs() < 1e-9,
                "{near:?}"
            );
        }
        assert_eq!(gap(0.3, 0.0), Reflectance { s: 1.0, p: 1.0 });
    }

    #[test]
    fn nothing_reflects_nothing() {
        for c in [1.0, 0.4, 0.0] {
            let films = [clear(1.0, 0.3), clear(1.0, 2.0)];
            let got = under_films(&films, 1.0, 0.0, c);
            assert_eq!(got, Reflectance { s: 0.0, p: 0.0 });
        }
    }
}
