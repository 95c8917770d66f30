//! Generates a shader for each of two material files into OUT_DIR.

use std::path::PathBuf;
use std::{env, fs};

use fresnel_gen::{Materials, Request, Source, generate, write_file};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut materials = Vec::new();
    for name in ["my_gold", "my_silver"] {
        let file = format!("../materials/{name}.toml");
        println!("cargo::rerun-if-changed={file}");
        let text = fs::read_to_string(&file)?;
        materials.push(Source::File { file, text });
    }
    let request = Request {
        targets: vec!["wgsl".into()],
        methods: vec!["fitted".into()],
        materials: Materials::These(materials),
        ..Request::default()
    };
    let out_dir = PathBuf::from(env::var("OUT_DIR")?);
    for artifact in generate(&request)?.artifacts {
        // A file whose content is the same keeps its time.
        write_file(&out_dir.join(&artifact.path), &artifact.bytes)?;
    }
    Ok(())
}
