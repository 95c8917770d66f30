//! Tells Cargo to build again when a file is added to a folder that is embedded whole. Single files are the compiler's to watch.

fn main() {
    println!("cargo::rerun-if-changed=data/films");
    println!("cargo::rerun-if-changed=data/materials");
    println!("cargo::rerun-if-changed=data/records/costs");
}
