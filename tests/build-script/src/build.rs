//! Generates a shader into OUT_DIR.

use fresnel_gen::{Materials, Request, Source, generate, write_file};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let request = Request {
        targets: vec!["wgsl".into()],
        methods: vec!["conductor_exact".into()],
        materials: Materials::These(vec![Source::Named("gold".into())]),
        ..Request::default()
    };
    let out_dir = std::path::PathBuf::from(std::env::var("OUT_DIR")?);
    for artifact in generate(&request)?.artifacts {
        write_file(&out_dir.join(&artifact.path), &artifact.bytes)?;
    }
    Ok(())
}
