//! One R for all channels: right for real media, wrong for invented ones.

use super::function;
use super::numbers;
use super::vector;
use super::vectors;
use crate::subjects;
use fresnel_gen::language::ir::evaluate;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// By how many steps of 255 one R, that of green, is off in the worst channel at the worst angle.
fn steps_off(n: [f64; 3]) -> f64 {
    let rays: Vec<[f64; 3]> = (1..=1000)
        .map(|i| f64::from(i) / 1000.0)
        .map(|c| [f64::sqrt(1.0 - c * c), 0.0, -c])
        .collect();
    let each = evaluate(
        &function("interface_reflectance"),
        &[vectors(&rays), vector(UP), vector(n)],
    );
    let one = evaluate(
        &function("interface_reflectance_scalar"),
        &[vectors(&rays), vector(UP), numbers(&vec![n[1]; rays.len()])],
    );
    let off = |i: usize| {
        let each: [f64; 3] = each.at(i);
        let one: [f64; 3] = one.at(i);
        let off = each.map(|r| (r - one[0]).abs());
        255.0 * off.into_iter().fold(0.0, f64::max)
    };
    (0..rays.len()).map(off).fold(0.0, f64::max)
}

#[test]
fn one_reflectance_serves_all_channels_of_real_media() {
    let names = ["bk7", "diamond", "sf11", "water"];
    let stated = [0.5, 0.8, 1.5, 0.5];
    for ((subject, name), stated) in subjects(&names).iter().zip(names).zip(stated) {
        let off = steps_off(subject.effective.channels.n);
        assert!(
            off <= stated && off > stated / 2.0,
            "{name}: {off:.2} steps of 255, stated {stated}"
        );
    }
    let invented = steps_off([1.2, 1.5, 1.8]);
    assert!(invented > 10.0, "{invented:.2}");
}
