//! Shows what the build script generated.

fn main() {
    let shader = include_str!(concat!(env!("OUT_DIR"), "/wgsl/materials/gold.wgsl"));
    assert!(shader.contains("fn fresnel_gold("));
    println!("{} lines of WGSL", shader.lines().count());
}
