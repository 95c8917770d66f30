//! Tells Cargo to look at data and templates again when a file is added.

fn main() {
    println!("cargo::rerun-if-changed=data");
    println!("cargo::rerun-if-changed=templates");
}
