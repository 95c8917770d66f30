//! How long generation takes.

fn main() {}
