//! How far published measurements of a material differ: fitting one of them better than this gains nothing.

use crate::generator::fit::FitCurve;
use crate::generator::reference::{MaterialInMedium, reference_reflectance};
use crate::language::methods::Light;
use crate::physics::materials::{self, Material, Surface, ViewingConditions};
use crate::physics::num::each_channel;

/// How far measurements differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The largest difference of two at one angle in one channel.
    pub most: f64,
    /// How many there are.
    pub sources: usize,
}

/// The spread of the catalogue's pages of a material's substance that can be seen so. None for a user's own file, for what is known
/// at three wavelengths only, seen from itself, and where there is one page.
pub fn spread(
    subject: &MaterialInMedium,
    catalogue: &[Material],
    viewing: &ViewingConditions,
) -> Option<Spread> {
    let own = &subject.material;
    if materials::source(&subject.argument).is_none() || own.rgb_nm.is_some() {
        return None;
    }
    let medium = subject.medium.as_ref().map(|(_, medium)| medium);
    if medium.is_some_and(|medium| medium.substance == own.substance) {
        return None;
    }
    let curve = |(_, surface): (_, Surface)| {
        FitCurve::new(|c| reference_reflectance(&surface, Light::Unpolarised, c)).seen
    };
    let pages = materials::surfaces_of(&own.substance, catalogue, medium, viewing);
    let curves: Vec<Vec<[f64; 3]>> = pages.map(curve).collect();
    (curves.len() > 1).then(|| Spread {
        most: apart(&curves),
        sources: curves.len(),
    })
}

/// The largest difference of two curves, over all points and channels.
fn apart(curves: &[Vec<[f64; 3]>]) -> f64 {
    let points = curves.iter().map(Vec::len).min().unwrap_or(0);
    let at = |point: usize, channel: usize| {
        let values = curves.iter().map(move |curve| curve[point][channel]);
        let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| {
            (a.min(value), b.max(value))
        });
        most - least
    };
    let all = (0..points).flat_map(|point| each_channel(|channel| at(point, channel)));
    all.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn curves_lie_as_far_apart_as_at_their_worst_point() {
        let grey = |values: &[f64]| values.iter().map(|v| [*v; 3]).collect::<Vec<_>>();
        let (a, b, c) = (grey(&[0.5, 0.9]), grey(&[0.25, 0.8]), grey(&[0.625, 0.9]));
        assert_eq!(apart(&[a.clone(), b.clone()]), 0.25);
        assert_eq!(apart(&[a.clone(), b, c]), 0.375);
        assert_eq!(apart(&[a]), 0.0);
        assert_eq!(apart(&[]), 0.0);
    }
}
