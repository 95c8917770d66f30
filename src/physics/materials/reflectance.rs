//! The reflectance of a material as rows: by angle and wavelength, or the colour by angle. All of it is by the exact law, under the
//! material's films.

use serde::Serialize;

use super::formula::Extrapolate;
use super::material::Material;
use super::surface::{AtWavelength, Surface, SurfaceError};
use crate::physics::optics::{Reflectance, cosine};

/// The reflectance at one angle and wavelength.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReflectanceRow {
    /// The material's name.
    pub material: String,
    /// The angle of incidence.
    pub angle_deg: f64,
    /// The wavelength in vacuum.
    pub wavelength_nm: f64,
    /// The reflectance of s-polarised light.
    pub r_s: f64,
    /// The reflectance of p-polarised light.
    pub r_p: f64,
    /// The reflectance of unpolarised light.
    pub r: f64,
}

/// The colour of the reflection of unpolarised light at one angle, linear, where a mirror is (1, 1, 1). Colours outside the space
/// are kept.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReflectedColour {
    /// The material's name.
    pub material: String,
    /// The angle of incidence.
    pub angle_deg: f64,
    /// The red channel.
    pub red: f64,
    /// The green channel.
    pub green: f64,
    /// The blue channel.
    pub blue: f64,
}

/// A row for each angle and wavelength.
///
/// # Errors
/// The material, a film or the medium is not known at a wavelength.
pub fn reflectance_rows(
    material: &Material,
    medium: Option<&Material>,
    beyond: Extrapolate,
    angles_deg: &[f64],
    wavelengths_nm: &[f64],
) -> Result<Vec<ReflectanceRow>, SurfaceError> {
    let known = AtWavelength::each(material, medium, wavelengths_nm, beyond)?;
    let row = |angle_deg: f64, at: &AtWavelength, nm: f64| {
        let both = at.reflectance(cosine(angle_deg));
        ReflectanceRow {
            material: material.name.clone(),
            angle_deg,
            wavelength_nm: nm,
            r_s: both.s,
            r_p: both.p,
            r: Reflectance::unpolarised(both),
        }
    };
    let at_angle = |angle: &f64| {
        let each = known.iter().zip(wavelengths_nm);
        each.map(|(at, nm)| row(*angle, at, *nm))
            .collect::<Vec<_>>()
    };
    Ok(angles_deg.iter().flat_map(at_angle).collect())
}

/// The colour at each angle. `name` is the material's.
pub fn reflected_colours(
    name: &str,
    surface: &Surface,
    angles_deg: &[f64],
) -> Vec<ReflectedColour> {
    let colour = |angle: &f64| {
        let [red, green, blue] = surface.unpolarised(cosine(*angle)).to_array();
        ReflectedColour {
            material: name.to_owned(),
            angle_deg: *angle,
            red,
            green,
            blue,
        }
    };
    angles_deg.iter().map(colour).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::{ConstantIndex, DispersionCurve, ViewingConditions, find};

    fn gold() -> Material {
        find("gold").expect("it is there").expect("it is good")
    }

    fn rows(material: &Material, angles: &[f64], nm: &[f64]) -> Vec<ReflectanceRow> {
        reflectance_rows(material, None, Extrapolate::Refuse, angles, nm).expect("it is known")
    }

    #[test]
    fn at_normal_incidence_n_and_k_give_reflectance() {
        let index = gold().index(700.0, Extrapolate::Refuse).expect("known");
        let (n, k) = (index.n, index.k);
        let wanted = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
        for row in rows(&gold(), &[0.0], &[700.0]) {
            for r in [row.r_s, row.r_p, row.r] {
                assert!((r - wanted).abs() < 1e-14, "{row:?}");
            }
        }
    }

    #[test]
    fn glass_reflects_no_p_at_brewsters_angle() {
        let glass = find("bk7").expect("it is there").expect("it is good");
        let n = glass.index(550.0, Extrapolate::Refuse).expect("known").n;
        let brewster = libm::atan(n).to_degrees();
        let row = &rows(&glass, &[brewster], &[550.0])[0];
        assert!(row.r_p < 1e-15 && row.r_s > 0.1, "{row:?}");
        assert_eq!(row.r, 0.5 * (row.r_s + row.r_p));
    }

    /// What reflects the same at every wavelength is grey under any light.
    #[test]
    fn a_constant_spectrum_is_grey() {
        let plain = ConstantIndex::parse("1.5")
            .expect("a number")
            .expect("allowed");
        let level = |value: f64| DispersionCurve::table(vec![(300.0, value), (900.0, value)]);
        let mirror = Material {
            n: level(0.1).expect("they ascend"),
            k: level(5.0),
            ..plain.material()
        };
        let surface = Surface::new(&mirror, None, &ViewingConditions::default()).expect("known");
        for row in reflected_colours("mirror", &surface, &[0.0, 60.0, 90.0]) {
            assert!(row.red > 0.9, "{row:?}");
            assert!((row.red - row.green).abs() < 1e-12, "{row:?}");
            assert!((row.red - row.blue).abs() < 1e-12, "{row:?}");
        }
    }

    #[test]
    fn rows_go_by_angle_and_then_by_wavelength() {
        let places: Vec<_> = rows(&gold(), &[0.0, 90.0], &[450.0, 650.0])
            .iter()
            .map(|row| (row.angle_deg, row.wavelength_nm))
            .collect();
        assert_eq!(
            places,
            [(0.0, 450.0), (0.0, 650.0), (90.0, 450.0), (90.0, 650.0)]
        );
    }

    #[test]
    fn an_unknown_wavelength_is_refused_with_advice() {
        let refused = |name: &str, nm: f64| {
            let material = find(name).expect("it is there").expect("it is good");
            let rows = reflectance_rows(&material, None, Extrapolate::Refuse, &[0.0], &[nm]);
            rows.expect_err("it is unknown").to_string()
        };
        let why = refused("gold", 1e5);
        assert!(
            why.contains("100000 nm is wanted") && why.ends_with("--extrapolate hold"),
            "{why}"
        );
        let why = refused("gold_thesis", 600.0);
        assert!(
            why.contains("known at 685, 535 and 475 nm only, and 600 nm is wanted"),
            "{why}"
        );
    }
}
