//! The plan of a verification from a request and from what an output folder holds. All that needs neither stands in
//! [`crate::lab::verify`].

mod difference;
mod listed;
mod plan;
mod shipped;

pub use plan::plan_of_request;
