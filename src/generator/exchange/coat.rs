//! Clear coats of hosts. All of them draw `R_c + (1 - R_c) B` with the same angle for both: the coat bends no light. So B, what the base
//! is to add, is [`Surface::through_coat`](crate::physics::materials::Surface::through_coat).

use super::sheet::Field;
use crate::physics::optics::dielectric;

/// The clear coat of a format.
#[derive(Debug)]
pub struct ClearCoat {
    /// What it reflects itself.
    pub law: CoatLaw,
    /// Its numbers, by its index.
    pub fields: fn(f64) -> Vec<Field>,
    /// The node that has it; the format's other nodes are left out below a coat.
    pub node: &'static str,
    /// What has to be set beside the numbers.
    pub remark: Option<&'static str>,
}

/// What a coat reflects itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoatLaw {
    /// The law for one index, which can be chosen.
    Exact,
    /// Schlick's approximation with F0 = .04, of an index of 1.5.
    Schlick,
}

impl CoatLaw {
    /// The only index of this coat, if there is only one.
    pub fn only_index(self) -> Option<f64> {
        (self == CoatLaw::Schlick).then_some(1.5)
    }

    /// The reflectance of a coat of this index at a cosine.
    pub fn reflectance(self, index: f64, cos_theta: f64) -> f64 {
        match self {
            CoatLaw::Exact => dielectric(index, cos_theta).unpolarised(),
            CoatLaw::Schlick => {
                let rest = 1.0 - cos_theta;
                0.04 + 0.96 * (rest * rest * rest * rest * rest)
            }
        }
    }
}
