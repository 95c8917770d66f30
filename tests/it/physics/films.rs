//! Reflectance under films beside two independent computations: PyPI's package `tmm` (`tests/reference/film_stacks.py`), and colours
//! of films from spectra (`tests/reference/film.csv`).

use fresnel_gen::physics::materials::{
    self, AtWavelength, ConstantIndex, Extrapolate, Film, Index, Material, film_of_word,
};
use fresnel_gen::physics::optics::{Layer, cosine, under_films};
use fresnel_gen::physics::spectra::{Integration, Integrator};

fn rows(file: &str) -> Vec<Vec<String>> {
    let path = format!("{}/tests/reference/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().skip(1);
    rows.map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

fn number(word: &str) -> f64 {
    word.parse().expect(word)
}

#[test]
fn it_agrees_with_tmm_over_random_stacks() {
    let rows = rows("film_stacks.csv");
    assert_eq!(rows.len(), 1000);
    let mut worst = (0.0, Vec::new());
    for row in rows {
        let [c, outside, n, k, s, p] = [0, 1, 2, 3, 4, 5].map(|i| number(&row[i]));
        let relative = |n: f64, k: f64| Index { n, k }.relative_to(Index { n: outside, k: 0.0 });
        let words: Vec<f64> = row[6].split(' ').map(number).collect();
        let layers = words.chunks(3).map(|layer| {
            let Index { n, k } = relative(layer[0], layer[1]);
            let waves = layer[2] * outside;
            Layer { n, k, waves }
        });
        let layers: Vec<Layer> = layers.collect();
        let base = relative(n, k);
        let got = under_films(&layers, base.n, base.k, c);
        let apart = (got.s - s).abs().max((got.p - p).abs());
        if apart > worst.0 {
            worst = (apart, row);
        }
    }
    assert!(worst.0 < 1e-12, "{worst:?}");
}

/// A material of the catalogue or an index, under a film.
pub fn filmed(film: &str, base: &str) -> Material {
    let named = |word: &str| match ConstantIndex::parse(word) {
        Some(index) => index.unwrap().material(),
        None => materials::find(word).unwrap().unwrap(),
    };
    let (name, thickness_nm) = film_of_word(film).unwrap();
    let film = Film {
        material: named(name),
        thickness_nm,
        argument: film.to_owned(),
    };
    named(base).under_films(vec![film]).unwrap()
}

#[test]
fn colours_of_films_agree_with_an_independent_computation() {
    // The independent computation takes 5 nm.
    let integrator = Integrator::new(&Integration::default()).unwrap();
    let mut worst: (f64, Vec<String>) = (0.0, Vec::new());
    for row in rows("film.csv") {
        let film = row[0].trim_start_matches("index ");
        let base = row[1].trim_start_matches("index ");
        let material = filmed(&format!("{film}:{}nm", row[2]), base);
        let c = cosine(number(&row[3]));
        let law = |nm: &f64| {
            let at = AtWavelength::new(&material, None, *nm, Extrapolate::Refuse).unwrap();
            at.reflectance(c).unpolarised()
        };
        let spectrum: Vec<f64> = integrator.wavelengths.iter().map(law).collect();
        let got = integrator.colour(&spectrum).to_array();
        for (got, want) in got.iter().zip(&row[4..]) {
            let apart = (got - number(want)).abs();
            if apart > worst.0 {
                worst = (apart, row.clone());
            }
        }
    }
    assert!(worst.0 < 3e-4, "{worst:?}");
}
