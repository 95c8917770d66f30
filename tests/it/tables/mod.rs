//! Tables of the documents, written from the registries and records so that they cannot drift.

pub mod costs;
pub mod markdown;
pub mod stability;
