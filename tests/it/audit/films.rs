//! KHR_materials_iridescence, written by hand after the extension's text, is held against the film, and not against the bare base.

use super::{audit, rows};
use crate::cli::Place;
use crate::physics::films::filmed;
use fresnel_gen::generator::emit::fitted_error;
use fresnel_gen::generator::reference::{Derivation, MaterialInMedium};
use fresnel_gen::language::methods;
use fresnel_gen::physics::materials::ViewingConditions;

#[test]
fn the_extension_errs_as_its_method_does() {
    let place = Place::new();
    place.put("khr.glsl", include_str!("functions/khr_iridescence.glsl"));
    let method = methods::find("iridescence_khr").unwrap();
    // The index of the film at 550 nm is an argument, as in the extension.
    for (base, film, index, nm) in [
        ("titanium", "titanium_dioxide:45nm", "2.43584", 45),
        ("bk7", "1.38:110nm", "1.38", 110),
        ("gold", "1.4:300nm", "1.4", 300),
    ] {
        let line = format!(
            "khr.glsl --function iridescence --material {base} --film {film} --arg eta2={index} --arg thickness={nm} --gpu none --json -"
        );
        let Some(ran) = audit(&place, &line) else {
            continue;
        };
        let typed = (base.to_owned(), filmed(film, base));
        let viewing = ViewingConditions::default();
        let subject = MaterialInMedium::new(typed, None, &viewing, Derivation::default()).unwrap();
        let ours = fitted_error(&subject, method).unwrap().max_abs;
        let told = rows(&ran)[0]["model_error"]["max_abs"].as_f64().unwrap();
        assert!((told - ours).abs() < 1e-4, "{base}: {told} {ours}");
    }
}
