//! The split-sum table: the albedo of a rough surface by it, filtered as GPUs do, against direct integration over GGX.

use fresnel_gen::generator::fit::values_for_material;
use fresnel_gen::generator::lut::{
    Depth, SPLIT_SUM_AXES, SPLIT_SUM_SIZE, SplitSum, SplitSumAxis, SplitSumDesign, SplitSumLayout,
    StoredSplitSum,
};
use fresnel_gen::generator::reference::{MaterialInMedium, reference_reflectance};
use fresnel_gen::language::ir::Weights;
use fresnel_gen::language::methods::{self, Input, Method, Shape};
use fresnel_gen::physics::optics::Ggx;
use fresnel_gen::physics::spectra::Gamut;

/// What tables along these axes promise at every angle and roughness from .05 on, for the fitted reflectance.
const PROMISED: [([SplitSumAxis; 2], f64); 2] = [
    (SPLIT_SUM_AXES, 2e-3),
    ([SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt], 8e-4),
];

/// What both are worth against the spectrum, with the model error of the fitted reflectance.
const AGAINST_SPECTRA: f64 = 0.0050;

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

    fn linear(&self, terms: &[f64], channel: usize) -> f64 {
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
    for (axes, promised) in PROMISED {
        let (mut worst, mut worst_spectrum) = (0.0, 0.0);
        for method in ["fitted", "fitted_dielectric"] {
            let method = methods::find(method).unwrap();
            let own = MATERIALS.iter().filter(|(_, name)| *name == method.name);
            let all: Vec<Reflectance> = own
                .map(|(name, _)| Reflectance::new(name, &super::subjects(&[name])[0], method))
                .collect();
            let design = SplitSumDesign::square(method.basis().unwrap(), SPLIT_SUM_SIZE, axes);
            let table = SplitSum::new(&design, &mut |_, _| {}).unwrap();
            let errors = compare(&table.stored(Depth::Half), &all);
            for (one, errors) in all.iter().zip(errors) {
                let Errors { fitted, spectrum } = errors;
                println!(
                    "{} {axes:?}: fitted {fitted:?}, spectrum {spectrum:?}",
                    one.name
                );
                worst = f64::max(worst, fitted.0);
                worst_spectrum = f64::max(worst_spectrum, spectrum.0);
            }
            let again = SplitSum::new(&design, &mut |_, _| {}).unwrap();
            assert!(
                again.texels == table.texels,
                "another run gives other numbers"
            );
        }
        // The model error comes on top: `docs/tables.md` says so, and silicon is the worst.
        assert!(
            (0.9 * AGAINST_SPECTRA..=AGAINST_SPECTRA).contains(&worst_spectrum),
            "{axes:?}: {worst_spectrum} against spectra"
        );
        assert!(
            worst <= promised && worst >= 0.8 * promised,
            "{axes:?}: {worst} for {promised}"
        );
    }
}

/// What an engine's texture holds, by its definition: half vectors spread by D, of each the visibility `G2 / (4 n·l n·v)` that the
/// engine has, times `4 n·l v·h / n·h`; and the same times (1 - v·h)⁵.
fn by_definition(layout: SplitSumLayout, cos_v: f64, roughness: f64) -> [f64; 2] {
    const STEPS: (usize, usize) = (1500, 300);
    let alpha = roughness * roughness;
    let sin_v = (1.0 - cos_v * cos_v).sqrt();
    let length = |c: f64| match layout {
        SplitSumLayout::Unreal => c * (1.0 - alpha) + alpha,
        _ => (c * c * (1.0 - alpha * alpha) + alpha * alpha).sqrt(),
    };
    let mut sums = [0.0; 2];
    for i in 0..STEPS.0 {
        // Even in the root of what is left of u: shares grow as its reciprocal.
        let left = (i as f64 + 0.5) / STEPS.0 as f64;
        let up = left / (1.0 + (alpha * alpha - 1.0) * (1.0 - left * left)).sqrt();
        for j in 0..STEPS.1 {
            let azimuth = std::f64::consts::PI * (j as f64 + 0.5) / STEPS.1 as f64;
            let cos_h = sin_v * (1.0 - up * up).sqrt() * azimuth.cos() + cos_v * up;
            let light = 2.0 * cos_h * up - cos_v;
            if light > 0.0 {
                let visibility = 0.5 / (light * length(cos_v) + cos_v * length(light));
                let share = 2.0 * left * 4.0 * light * visibility * cos_h / up;
                sums[0] += share;
                sums[1] += share * (1.0 - cos_h).powi(5);
            }
        }
    }
    sums.map(|sum| sum / (STEPS.0 * STEPS.1) as f64)
}

/// Filament mixes from red to green by F0, `mix(dfg.x, dfg.y, f0)`; the others take F0 times red, and green. Texel i of N lies at (i + 1/2)/N;
/// three.js has roughness along u.
#[test]
fn engines_get_what_they_bind() {
    let basis = methods::find("schlick").unwrap().basis().unwrap();
    for layout in SplitSumLayout::ENGINES {
        let height = if layout == SplitSumLayout::Unreal {
            32
        } else {
            128
        };
        let design = SplitSumDesign::of_engine(basis, layout);
        assert_eq!((design.width, design.height), (128, height));
        let table = SplitSum::new(&design, &mut |_, _| {}).unwrap();
        let mut other_masking = 0.0;
        for column in [3, 20, 64, 127] {
            for row in [3, height / 2, height - 1] {
                let centre = |i: usize, of: usize| (i as f64 + 0.5) / of as f64;
                let (u, v) = (centre(column, 128), centre(row, height));
                let (cos_v, roughness) = match layout {
                    SplitSumLayout::Three => (v, u),
                    _ => (u, v),
                };
                let [white, grazing] = by_definition(layout, cos_v, roughness);
                let want = match layout {
                    SplitSumLayout::Filament => [grazing, white],
                    _ => [white - grazing, grazing],
                };
                let texel = table.texels[row * 128 + column];
                let where_ = format!("{layout:?} {column} {row}: {texel:?} {want:?}");
                assert!((texel[0] - want[0]).abs() < 1e-4, "{where_}");
                assert!((texel[1] - want[1]).abs() < 1e-4, "{where_}");
                assert_eq!(texel[2..], [0.0; 6]);
                let [exact, _] = by_definition(SplitSumLayout::Filament, cos_v, roughness);
                other_masking = f64::max(other_masking, (exact - white).abs());
            }
        }
        // The two engines do not mask alike, so that one's table is not the other's with channels exchanged.
        assert_eq!(other_masking > 0.01, layout == SplitSumLayout::Unreal);
    }
}
