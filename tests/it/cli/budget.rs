//! `--budget` as users run it: which function is written, what is said, what is refused.

use super::MY_METAL;
use super::OUT;
use super::Place;

#[test]
fn the_cheapest_within_the_budget_is_written_alone() {
    let place = Place::new();
    let ran = place.done("--material gold --budget 0.002 --target gles");
    assert!(
        ran.err
            .starts_with("gold: fitted is the cheapest within 0.002: error 0.00193, cost 22 "),
        "{ran:?}"
    );
    assert!(ran.err.contains("a smaller error gains nothing"), "{ran:?}");
    assert_eq!(place.listed(), ["gles/materials/gold.glsl"]);
    let functions = place.manifest()["files"][0]["functions"].clone();
    assert_eq!(functions.as_array().unwrap().len(), 1);
    assert_eq!(functions[0]["method"], "fitted");
    assert_eq!(
        place
            .done("--material gold --budget 0.002 --target gles --check")
            .out,
        ""
    );
    // The same function by its name is the same file.
    assert_eq!(
        place
            .done("--material gold --method fitted --target gles -o -")
            .out
            .lines()
            .count(),
        place
            .done("--material gold --budget 0.002 --target gles -o -")
            .out
            .lines()
            .count()
    );
}

#[test]
fn methods_narrow_the_choice_and_a_page_alone_has_no_spread() {
    let place = Place::new();
    place.put("mine.toml", MY_METAL);
    let line = "--material mine.toml --budget 0.3 --method schlick,f82_tint --target wgsl";
    let ran = place.done(line);
    assert!(ran.err.starts_with("my_metal: schlick is "), "{ran:?}");
    assert!(ran.err.contains("is not known"), "{ran:?}");
    assert_eq!(place.listed(), ["wgsl/materials/my_metal.wgsl"]);
    assert_eq!(place.done(&format!("{line} --out-dir b --quiet")).err, "");
    assert!(place.path(OUT).exists());
}

#[test]
fn what_is_no_budget_is_refused() {
    let place = Place::new();
    for (line, says) in [
        (
            "--material gold --budget 1e-9",
            "table has the smallest error, 0.00046",
        ),
        (
            "--budget 0",
            "--budget is 0; it is an error of reflectance, above 0",
        ),
        ("--budget -1", "--budget is -1"),
        ("--budget nan", "--budget is NaN"),
        ("--budget much", "invalid value 'much'"),
        ("--budget 0.1 --gpu rdna9", "rdna2"),
        ("--budget 0.1 --gpu powervr", "no costs are recorded"),
        ("--budget 0.1 --material none", "`none` leaves none"),
        ("--budget 0.1 --precision f16", "single precision"),
        ("--budget 0.1 --method dielectric_exact_s", "unpolarised"),
    ] {
        let ran = place.run(line).ends(2);
        assert!(ran.err.contains(says), "{line}: {ran:?}");
    }
}
