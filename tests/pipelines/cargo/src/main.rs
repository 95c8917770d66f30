//! Shows where the build script wrote what this program includes.

fn main() {
    let gold = include_str!(concat!(env!("OUT_DIR"), "/wgsl/materials/my_gold.wgsl"));
    let silver = include_str!(concat!(env!("OUT_DIR"), "/wgsl/materials/my_silver.wgsl"));
    assert!(gold.contains("fn fresnel_my_gold_fitted("));
    assert!(silver.contains("fn fresnel_my_silver_fitted("));
    println!("{}", concat!(env!("OUT_DIR"), "/wgsl/materials"));
}
