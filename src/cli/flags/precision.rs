//! What functions compute in, as the command line says it: single or half precision.

use clap::Args;

use crate::physics::num::Precision;

use crate::cli::flags::choice::precision;

/// The flags of every command that writes or runs functions.
#[derive(Args, Clone, Debug, Default)]
pub struct PrecisionFlags {
    /// What functions compute in: f32, or f16, whose names end in _f16 [default: f32]
    #[arg(long, value_name = "NAME", value_parser = precision())]
    pub precision: Option<Precision>,
    /// Also write methods that f16 cannot compute accurately, without an error bound
    #[arg(long, requires = "precision")]
    pub force: bool,
}

impl PrecisionFlags {
    /// What functions compute in.
    pub fn precision(&self) -> Precision {
        self.precision.unwrap_or_default()
    }
}

/// The precisions of these, each once and in order; both where none is named.
pub fn each_once(named: &[Precision]) -> Vec<Precision> {
    let all = Precision::ALL.into_iter();
    all.filter(|precision| named.is_empty() || named.contains(precision))
        .collect()
}
