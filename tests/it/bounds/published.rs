//! Our stable forms beside the best that are published, at the same inputs: where an engine would change to ours it must
//! not lose digits.

use super::Medium;
use super::double;
use super::exact;
use super::unfused;
use crate::subjects;
use fresnel_gen::physics::num::ulp_distance;

/// The angles that published figures are given for.
const COSINES: [f32; 14] = [
    1e-6, 1e-4, 0.01, 0.1, 0.15, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99, 0.999, 1.0,
];

/// The g-form, as MaterialX has it (Cook and Torrance, 1982).
fn g_form(eta: f32, _: f32, c: f32) -> f32 {
    let g2 = eta * eta + c * c - 1.0;
    if g2 < 0.0 {
        return 1.0;
    }
    let (g, more, less) = (g2.sqrt(), g2.sqrt() + c, g2.sqrt() - c);
    let (s, p) = ((g - c) / (g + c), (more * c - 1.0) / (less * c + 1.0));
    0.5 * s * s * (1.0 + p * p)
}

/// The a, b form, as MaterialX has it (Glassner, 1995).
fn a_form(n: f32, k: f32, c: f32) -> f32 {
    let (c2, n2, k2) = (c * c, n * n, k * k);
    let s2 = 1.0 - c2;
    let t = n2 - k2 - s2;
    let whole = (t * t + 4.0 * n2 * k2).sqrt();
    let a = (0.5 * (whole + t)).max(0.0).sqrt();
    let (sum, u) = (whole + c2, 2.0 * a * c);
    let r_s = (sum - u) / (sum + u);
    let (x, y) = (c2 * whole + s2 * s2, u * s2);
    0.5 * (r_s + r_s * (x - y) / (x + y))
}

/// The worst of ours and of another form at these angles, in ulp.
fn both(name: &str, other: fn(f32, f32, f32) -> f32, media: &[Medium]) -> (f64, f64) {
    let function = exact(name);
    let mut worst: (f64, f64) = (0.0, 0.0);
    for medium in media {
        let got = unfused(&function, &[*medium; 3], &COSINES);
        for (c, [ours, ..]) in COSINES.iter().zip(got) {
            let (n, k) = *medium;
            let want = double(&function, f64::from(n), f64::from(k), f64::from(*c));
            worst.0 = worst.0.max(ulp_distance(ours, want));
            worst.1 = worst.1.max(ulp_distance(other(n, k, *c), want));
        }
    }
    worst
}

/// The indices of a material at every wavelength.
fn spectrum(name: &str) -> Vec<Medium> {
    let subject = &subjects(&[name])[0];
    let indices = subject.reference.surface.indices.iter();
    indices
        .map(|index| (index.n as f32, index.k as f32))
        .collect()
}

#[test]
fn glass_has_the_digits_of_the_g_form() {
    let media: Vec<Medium> = (0..=2000)
        .map(|i| (1.33 + 10.67 * i as f32 / 2000.0, 0.0))
        .collect();
    let (ours, theirs) = both("dielectric_exact", g_form, &media);
    println!("eta 1.33 to 12: {ours:.2} ulp, the g-form {theirs:.2}");
    assert!(ours <= 7.0 && ours <= 2.0 * theirs, "{ours} and {theirs}");
}

/// Next to 1 the g-form has no digits left, and ours has them all.
#[test]
fn next_to_one_the_g_form_has_none() {
    let media: Vec<Medium> = (1..=200).map(|i| (1.0 + 1e-4 * i as f32, 0.0)).collect();
    let (ours, theirs) = both("dielectric_exact", g_form, &media);
    println!("eta 1.0001 to 1.02: {ours:.2} ulp, the g-form {theirs:.0}");
    assert!(ours <= 12.0 && theirs > 100.0 * ours, "{ours} and {theirs}");
}

#[test]
fn metals_have_more_digits_than_in_the_a_form() {
    for (name, most) in [("gold", 9.4), ("silver", 26.0)] {
        let (ours, theirs) = both("conductor_exact", a_form, &spectrum(name));
        println!("{name}: {ours:.2} ulp, the a form {theirs:.2}");
        assert!(
            ours <= most && ours <= theirs,
            "{name}: {ours} and {theirs}"
        );
    }
}
