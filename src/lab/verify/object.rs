//! Pairs as an object of JSON, in order.

use serde::{Serialize, Serializer};

/// Writes names with what is said of each as an object, in order.
///
/// # Errors
/// The writer refuses.
pub fn as_object<S: Serializer, K: Serialize, T: Serialize>(
    pairs: &[(K, T)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}
