//! Materials beside each other: how far the reflectance of each is from that of the first.

use glam::DVec3;
use serde::Serialize;

use super::material::Material;
use super::surface::{Surface, SurfaceError, ViewingConditions};
use crate::physics::optics::{COS_82, cosine};
use crate::physics::spectra::{Gamut, Lab, Space, ciede2000, xyz_to_lab};

/// A material of a comparison, and its surface.
#[derive(Clone, Debug)]
pub struct ComparedMaterial<'a> {
    /// The material.
    pub material: &'a Material,
    /// Its surface, with colours outside the space kept.
    pub surface: Surface,
}

/// A material of a comparison in numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ComparedRow {
    /// Its name.
    pub material: String,
    /// What it is, in a line.
    pub summary: String,
    /// The year of its reference, where that has one.
    pub year: Option<u16>,
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees.
    pub f82: [f64; 3],
    /// How far it is from the first material; none for the first itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_first: Option<ReflectanceDifference>,
    /// Who measured it.
    pub source: String,
}

/// How far the reflectance of two materials lies apart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReflectanceDifference {
    /// The largest difference of a channel at any angle.
    pub max_abs: f64,
    /// The angle at which it occurs.
    pub angle_deg: f64,
    /// The channel.
    pub channel: &'static str,
    /// The difference of the colours at 0 degrees; none where a channel is one wavelength, which is no colour.
    pub delta_e2000: Option<f64>,
    /// Why a figure is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
}

/// The materials under viewing conditions that they share. If one is known at three wavelengths only, all are taken at these.
///
/// # Errors
/// A material or the medium was not measured at a wavelength of these conditions.
pub fn comparable<'a>(
    materials: &'a [Material],
    medium: Option<&Material>,
    viewing: &ViewingConditions,
) -> Result<Vec<ComparedMaterial<'a>>, SurfaceError> {
    let mut known_at_three = materials.iter().chain(medium);
    let three = known_at_three.find_map(|material| material.rgb_nm);
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        wavelengths_nm: viewing.wavelengths_nm.or(three),
        ..viewing.clone()
    };
    let compared = |material: &'a Material| {
        Ok(ComparedMaterial {
            material,
            surface: Surface::new(material, medium, &viewing)?,
        })
    };
    materials.iter().map(compared).collect()
}

/// A row for each material. `space` is that of the channels.
pub fn compared_rows(all: &[ComparedMaterial], space: Space) -> Vec<ComparedRow> {
    let row = |(place, one): (usize, &ComparedMaterial)| {
        let ComparedMaterial { material, surface } = one;
        let first = all.first().filter(|_| place > 0);
        ComparedRow {
            material: material.name.clone(),
            summary: material.summary.clone(),
            year: material.year(),
            f0: surface.unpolarised(1.0).to_array(),
            f82: surface.unpolarised(COS_82).to_array(),
            from_first: first.map(|first| difference(&first.surface, surface, space)),
            source: material.source_words(". ").unwrap_or_default(),
        }
    };
    all.iter().enumerate().map(row).collect()
}

/// Four angles a degree: a difference has no narrower peak.
const ANGLES: u32 = 360;

fn difference(one: &Surface, other: &Surface, space: Space) -> ReflectanceDifference {
    let mut largest = ReflectanceDifference {
        max_abs: 0.0,
        angle_deg: 0.0,
        channel: "red",
        delta_e2000: None,
        reason: None,
    };
    for quarter in 0..=ANGLES {
        let angle_deg = 0.25 * f64::from(quarter);
        let cos_theta = cosine(angle_deg);
        let apart = (other.unpolarised(cos_theta) - one.unpolarised(cos_theta)).abs();
        for (channel, apart) in ["red", "green", "blue"].into_iter().zip(apart.to_array()) {
            if apart > largest.max_abs {
                (largest.max_abs, largest.angle_deg, largest.channel) = (apart, angle_deg, channel);
            }
        }
    }
    if one.is_spectral() {
        let [one, other] = [one, other].map(|surface| lab(surface.unpolarised(1.0), space));
        largest.delta_e2000 = Some(ciede2000(one, other));
    } else {
        largest.reason = Some("one wavelength a channel: no spectrum is integrated");
    }
    largest
}

fn lab(rgb: DVec3, space: Space) -> Lab {
    xyz_to_lab(space.rgb_to_xyz() * rgb, space.white())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::find;

    fn materials(names: &[&str]) -> Vec<Material> {
        let found = names.iter().map(|name| find(name));
        found.map(|it| it.expect("there").expect("good")).collect()
    }

    fn rows(names: &[&str]) -> Vec<ComparedRow> {
        let materials = materials(names);
        let all = comparable(&materials, None, &ViewingConditions::default()).expect("known");
        compared_rows(&all, Space::Srgb)
    }

    #[test]
    fn a_material_does_not_differ_from_itself() {
        let rows = rows(&["gold", "gold"]);
        assert_eq!(rows[0].from_first, None);
        let same = rows[1].from_first.as_ref().expect("it is the second");
        assert_eq!((same.max_abs, same.delta_e2000), (0.0, Some(0.0)));
        assert_eq!(rows[0].f0, rows[1].f0);
    }

    #[test]
    fn gold_is_not_silver() {
        let rows = rows(&["silver", "gold", "silver_babar"]);
        let [gold, babar] = [1, 2].map(|i| rows[i].from_first.clone().expect("not the first"));
        assert_eq!((gold.channel, gold.reason), ("blue", None));
        assert!(gold.max_abs > 0.5 && gold.angle_deg < 80.0, "{gold:?}");
        assert!(gold.delta_e2000 > Some(20.0) && babar.delta_e2000 < Some(3.0));
        assert_eq!([rows[0].year, rows[2].year], [Some(1972), Some(2015)]);
    }

    #[test]
    fn three_wavelengths_are_compared_at_the_same_three() {
        let rows = rows(&["gold", "gold_thesis"]);
        let thesis = rows[1].from_first.as_ref().expect("the second");
        assert!(thesis.delta_e2000.is_none() && thesis.reason.is_some());
        let own = materials(&["gold"]);
        let viewing = ViewingConditions {
            wavelengths_nm: Some([685.0, 535.0, 475.0]),
            ..ViewingConditions::default()
        };
        let alone = comparable(&own, None, &viewing).expect("known");
        assert_eq!(compared_rows(&alone, Space::Srgb)[0].f0, rows[0].f0);
    }
}
