//! Where tools and temporary files lie.

use std::env::current_exe;
use std::path::{Path, PathBuf};

/// The variable that says where temporary files go.
pub const TEMPORARY: &str = if cfg!(windows) { "TMP" } else { "TMPDIR" };

/// The folders of tools that belong to this program: `tools` beside it and, where Cargo has built it, `tools` in the target
/// folder, where `tests/run` puts what it fetches.
pub fn beside() -> Vec<PathBuf> {
    let program = current_exe().unwrap_or_default();
    let Some(folder) = program.parent().filter(|folder| folder.is_absolute()) else {
        return Vec::new();
    };
    // Cargo keeps its own notes beside a program, and one folder above a test.
    let mut above = folder.ancestors().take(2);
    let built = above.find(|folder| folder.join(".fingerprint").is_dir());
    let target = built.and_then(Path::parent);
    let places = [Some(folder), target].into_iter().flatten();
    places.map(|place| place.join("tools")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tools_of_a_build_lie_beside_its_profiles() {
        let target = current_exe().unwrap();
        let target = target.ancestors().nth(3).unwrap();
        assert!(beside().contains(&target.join("tools")));
    }
}
