//! Generates a shader for each of two material files into OUT_DIR.

use fresnel_gen::{Method, Request, Target, generate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let request = Request::new()
        .target(Target::WGSL)
        .method(Method::FITTED)
        .material_file("../materials/my_gold.toml")?
        .material_file("../materials/my_silver.toml")?;
    for input in request.inputs() {
        println!("cargo::rerun-if-changed={input}");
    }
    generate(&request)?.write_to(std::env::var("OUT_DIR")?)?;
    Ok(())
}
