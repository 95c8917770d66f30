//! The spaces that a method is scanned over.

use crate::generator::fit::values;
use crate::generator::reference::Derivation;
use crate::language::methods::{Class, Input, Method};
use crate::physics::materials::Channels;
use crate::physics::num::Precision;
use crate::physics::optics;

use super::axis::{ScanAxis, argument, cosines, extinction, index};
use super::failure::is_flushed;

/// A space: its axes, and what a point of it means to a method.
#[derive(Clone, Debug)]
pub struct ScanSpace {
    /// Whether its points are media, which have a law; else they are the method's arguments themselves.
    pub is_media: bool,
    /// The axes of what a method is given; the cosines are apart.
    pub axes: Vec<ScanAxis>,
    /// The cosines.
    pub cosines: ScanAxis,
}

/// The spaces of a method, with numbers of a precision.
pub fn spaces(method: &Method, precision: Precision) -> Vec<ScanSpace> {
    let mut all = Vec::new();
    if method.class != Class::Metal {
        all.push(vec![index("eta", 40)]);
    }
    if method.class != Class::Dielectric {
        all.push(vec![index("n", 12), extinction()]);
    }
    let media = all.into_iter().map(|axes| (true, axes));
    let arguments = method.inputs.iter().map(argument).collect();
    media
        .chain([(false, arguments)])
        .map(|(is_media, axes)| ScanSpace {
            is_media,
            axes: axes
                .iter()
                .map(|axis: &ScanAxis| axis.rounded(precision))
                .collect(),
            cosines: cosines().rounded(precision),
        })
        .collect()
}

/// A point of a space without the cosine.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanPoint {
    /// The method's arguments after the cosine, rounded.
    pub arguments: Vec<f64>,
    /// The medium, where there is one.
    pub medium: Option<(f64, f64)>,
    /// What a result may not exceed.
    pub limit: f64,
}

impl ScanSpace {
    /// How many points it has, without the cosines.
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// The values of a point, one for each axis.
    pub fn at(&self, mut index: usize) -> Vec<f64> {
        let mut values = vec![0.0; self.axes.len()];
        for (value, axis) in values.iter_mut().zip(&self.axes).rev() {
            *value = axis.values[index % axis.values.len()];
            index /= axis.values.len();
        }
        values
    }

    /// The point at an index, for a method.
    pub fn point(&self, method: &Method, index: usize, precision: Precision) -> ScanPoint {
        let at = self.at(index);
        if !self.is_media {
            let limit = limit(method.inputs, &at);
            return ScanPoint {
                arguments: at,
                medium: None,
                limit,
            };
        }
        let medium = (at[0], at.get(1).copied().unwrap_or(0.0));
        let arguments = arguments(method, medium)
            .into_iter()
            .map(|x| precision.rounded(x))
            .collect();
        ScanPoint {
            arguments,
            medium: Some(medium),
            limit: 1.0,
        }
    }
}

/// A method's arguments for a medium.
fn arguments(method: &Method, (n, k): (f64, f64)) -> Vec<f64> {
    let channels = Channels {
        n: [n; 3],
        k: [k; 3],
    };
    let values = values(method, &channels, &Derivation::default());
    method
        .inputs
        .iter()
        .map(|input| values[input.name][0])
        .collect()
}

/// The function contract: results lie between 0 and 1, or an F0 above it.
fn limit(inputs: &[Input], at: &[f64]) -> f64 {
    let raised = inputs
        .iter()
        .zip(at)
        .filter(|(input, _)| input.raises_limit);
    raised.fold(1.0, |most, (_, value)| most.max(*value))
}

/// Below this k a medium reflects as if it absorbed nothing, and an approximation has been held against the law already.
const ABSORBS: f64 = 0.1;

/// Whether a method is held against the law for this medium; an exact one always is.
pub fn is_lawful(method: &Method, (_, k): (f64, f64)) -> bool {
    let is_exact = method.claims.model.iter().all(|claim| claim.max_abs == 0.0);
    !is_flushed(k) && (is_exact || k == 0.0 || k >= ABSORBS)
}

/// What the law says of a medium in a method's light.
pub fn law(method: &Method, (n, k): (f64, f64), cos_theta: f64) -> f64 {
    use crate::language::methods::Light;
    let reflectance = optics::conductor(n, k, cos_theta);
    match method.light {
        Light::Unpolarised => reflectance.unpolarised(),
        Light::S => reflectance.s,
        Light::P => reflectance.p,
    }
}
