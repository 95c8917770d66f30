//! The split-sum table: the albedo of a rough surface by it, filtered as GPUs do, against direct integration over GGX.

use fresnel_gen::fit::values_for_material;
use fresnel_gen::ir::Weights;
use fresnel_gen::lut::{Depth, SPLIT_SUM_SIZE, SplitSum, StoredSplitSum};
use fresnel_gen::methods::{self, Input, Method, Shape};
use fresnel_gen::optics::Ggx;
use fresnel_gen::reference::{MaterialInMedium, reference_reflectance};
use fresnel_gen::spectra::Gamut;

/// What the table promises at every angle and roughness from .05 on, for the fitted reflectance.
const PROMISED: f64 = 2e-3;

/// Materials with the method whose table serves them.
const MATERIALS: [(&str, &str); 9] = [
    ("gold", "fitted"),
    ("silver", "fitted"),
    ("copper", "fitted"),
    ("aluminium", "fitted"),
    ("platinum", "fitted"),
    ("silicon", "fitted"),
    ("water", "fitted_dielectric"),
    ("bk7", "fitted_dielectric"),
    ("diamond", "fitted_dielectric"),
];

const ROUGHNESS: [f64; 16] = [
    0.05, 0.0512, 0.055, 0.06, 0.0663, 0.075, 0.09, 0.11, 0.15, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0,
];
const ANGLES: usize = 301;
/// Points between which a spectrum's reflectance is taken for straight, even in the square root of the cosine: within 1e-6.
const POINTS: usize = 1025;

/// What stands under the integral, for three channels: the fitted form before its limit, and the spectrum's.
struct Reflectance {
    name: &'static str,
    shape: Shape,
    coefficients: Vec<[f64; 3]>,
    spectrum: Vec<[f64; 3]>,
}

impl Reflectance {
    fn new(name: &'static str, subject: &MaterialInMedium, method: &Method) -> Reflectance {
        let values = values_for_material(subject, method);
        let coefficients = Input::COEFFICIENTS.iter();
        let mut surface = subject.reference.surface.clone();
        surface.gamut = Gamut::Keep;
        let at = |i: usize| {
            reference_reflectance(
                &surface,
                method.light,
                (i as f64 / (POINTS - 1) as f64).powi(2),
            )
        };
        Reflectance {
            name,
            shape: method.shape.unwrap(),
            coefficients: coefficients
                .filter_map(|c| values.get(c.name).copied())
                .collect(),
            spectrum: (0..POINTS).map(at).collect(),
        }
    }

    fn linear(&self, terms: &[f64; 4], channel: usize) -> f64 {
        let products = self.coefficients.iter().zip(terms);
        products.map(|(c, term)| c[channel] * term).sum()
    }

    fn spectrum(&self, cos_h: f64, channel: usize) -> f64 {
        let at = cos_h.sqrt() * (POINTS - 1) as f64;
        let before = (at as usize).min(POINTS - 2);
        let [a, b] = [before, before + 1].map(|i| self.spectrum[i][channel]);
        a + (at - before as f64) * (b - a)
    }
}

/// The largest errors for one material: against the fitted form, and against the spectrum, with the place of the latter.
#[derive(Clone, Copy, Default)]
struct Errors {
    fitted: (f64, f64, f64),
    spectrum: (f64, f64, f64),
}

fn compare(stored: &StoredSplitSum, all: &[Reflectance]) -> Vec<Errors> {
    let rule = Ggx::new(40, 24);
    let mut errors = vec![Errors::default(); all.len()];
    for i in 0..ANGLES {
        let cos_v = (i as f64 / (ANGLES - 1) as f64).powi(4);
        for roughness in ROUGHNESS {
            let mut points = Vec::new();
            rule.each(cos_v, roughness * roughness, |cos_h, weight| {
                points.push((cos_h, weight))
            });
            let looked_up = stored.lookup(Weights::Steps256, cos_v, roughness);
            for (one, errors) in all.iter().zip(&mut errors) {
                let mut terms = [0.0; 4];
                for (cos_h, weight) in &points {
                    one.shape.add(*cos_h, *weight, &mut terms);
                }
                for channel in 0..3 {
                    let got = one.linear(&looked_up, channel);
                    let spectrum = points
                        .iter()
                        .map(|(c, w)| w * one.spectrum(*c, channel))
                        .sum::<f64>();
                    for (worst, want) in [
                        (&mut errors.fitted, one.linear(&terms, channel)),
                        (&mut errors.spectrum, spectrum),
                    ] {
                        if (got - want).abs() > worst.0 {
                            *worst = ((got - want).abs(), cos_v, roughness);
                        }
                    }
                }
            }
        }
    }
    errors
}

#[test]
fn the_albedo_is_what_direct_integration_gives() {
    for method in ["fitted", "fitted_dielectric"] {
        let method = methods::find(method).unwrap();
        let own = MATERIALS.iter().filter(|(_, name)| *name == method.name);
        let all: Vec<Reflectance> = own
            .map(|(name, _)| Reflectance::new(name, &super::subjects(&[name])[0], method))
            .collect();
        let table = SplitSum::new(&method.shape.unwrap(), SPLIT_SUM_SIZE, &mut |_, _| {}).unwrap();
        for depth in [Depth::Half, Depth::Float] {
            let errors = compare(&table.stored(depth), &all);
            for (one, errors) in all.iter().zip(errors) {
                let Errors { fitted, spectrum } = errors;
                println!(
                    "{} {depth:?}: fitted {fitted:?}, spectrum {spectrum:?}",
                    one.name
                );
                assert!(fitted.0 <= PROMISED, "{}: {fitted:?}", one.name);
                // The model error comes on top: it is at most .0036 for these.
                assert!(
                    spectrum.0 <= PROMISED + 0.0036,
                    "{}: {spectrum:?}",
                    one.name
                );
            }
        }
        let again = SplitSum::new(&method.shape.unwrap(), SPLIT_SUM_SIZE, &mut |_, _| {}).unwrap();
        assert!(again == table, "another run gives other numbers");
    }
}
