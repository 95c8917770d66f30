//! The digits of the stable forms on a real graphics stack: the WGSL of the library, as shipped, over the media that `bounds`
//! has.

use crate::bounds::{Medium, absorbing, beside, glasses, worst};
use crate::not_checked;
use fresnel_gen::generator::emit::{self, Naming};
use fresnel_gen::generator::fit::Measured;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::Wanted;
use fresnel_gen::lab::verify::run::{Devices, ExecutionPath, ShippedFunction};
use fresnel_gen::lab::verify::{ABSOLUTE_FLOOR, Trial, cosines};
use fresnel_gen::language::methods;
use fresnel_gen::language::targets;

#[track_caller]
fn check(name: &str, media: &[Medium]) {
    let devices = Devices::new(Wanted::default());
    let method = methods::find(name).unwrap();
    let functions = emit::library_functions(method, &Naming::default()).unwrap();
    let emitted = &functions[0];
    let files = emit::library(
        targets::find("wgsl").unwrap(),
        method,
        &functions,
        emit::Heading::default(),
    )
    .unwrap();
    let shown = ShippedFunction {
        target: targets::find("wgsl").unwrap(),
        bytes: &files[0].bytes,
        function: emitted,
        entry: "main",
    };
    let trial = |media: &[Medium; 3]| Trial {
        function: emitted.function.clone(),
        values: vec![media.map(|(n, _)| n), media.map(|(_, k)| k)],
        table: None,
        bound: Measured::Yes(method.claims.code_ulp),
        floor: ABSOLUTE_FLOOR,
        is_guarded: true,
    };
    let runnable = match devices.prepare(&shown, ExecutionPath::Own, &trial(&[(1.5, 0.0); 3])) {
        Err(Fault::Absent(why)) => {
            let remark = format!("digits of {name} on a device: {why}");
            assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
            return not_checked(&remark);
        }
        runnable => runnable.unwrap(),
    };
    let points = cosines(1000);
    let around = |media: &[Medium; 3]| [points.clone(), beside(media)].concat();
    let run = |media: &[Medium; 3], cosines: &[f32]| runnable.run(&trial(media), cosines).unwrap();
    worst(&emitted.function, media, &around, &run).check(&format!("{name} in WGSL"));
}

#[test]
fn dielectrics_keep_their_digits_on_a_device() {
    check("dielectric_exact", &glasses(900));
}

#[test]
fn conductors_keep_their_digits_on_a_device() {
    check("conductor_exact", &absorbing(900));
}
