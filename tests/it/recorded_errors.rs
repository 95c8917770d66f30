//! `data/records/errors.csv` holds what the program finds without it.

use std::path::Path;

use super::fits::catalogue;
use fresnel_gen::lab::chart::error_rows;
use fresnel_gen::physics::spectra::Space;
use fresnel_gen::pictures::gallery::films;

/// What the file is, in its own words.
const ABOUT: &str = "\
# The errors of methods over all angles for the catalogue and for the films of the gallery, in sRGB. A row with `best` is of the inputs with
# the least error. BLESS=1 cargo test recorded_errors writes it.
";

#[test]
fn errors_are_as_recorded() {
    let subjects = [catalogue().to_vec(), films(true)].concat();
    let mut table = csv::Writer::from_writer(ABOUT.as_bytes().to_vec());
    for row in error_rows(&subjects, Space::Srgb) {
        table.serialize(row).expect("it is plain");
    }
    let text = table.into_inner().expect("it is in memory");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/records/errors.csv");
    super::bless::check(&path, &text);
}
