//! How fast are tables made?
#![allow(missing_docs)]
fn main() {}
