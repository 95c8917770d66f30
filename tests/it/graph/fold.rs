//! What folding makes of small graphs.

use super::text::parse;
use fresnel_gen::language::ir::{fold, print};

#[track_caller]
fn check(input: &str, expected: &str) {
    let function = parse(input).expect("the case parses");
    assert_eq!(print(&fold(&function)).trim(), expected.trim());
}

#[test]
fn constants_are_computed() {
    check(
        "fn f(x: scalar) -> scalar\n  a = mul 2 3\n  b = add a x\n  return b",
        "fn f(x: scalar) -> scalar\n  b = add 6 x\n  return b",
    );
}

#[test]
fn a_comparison_that_always_holds_is_dropped_and_its_choice_gives_the_name() {
    check(
        "fn f(x: scalar) -> scalar\n  c = saturate x\n  t = sub c 2\n  l = less t 0\n  s = select l c t\n  return s",
        "fn f(x: scalar) -> scalar\n  s = saturate x\n  return s",
    );
}

#[test]
fn a_guard_that_never_acts_is_dropped_and_one_that_may_stays() {
    check(
        "fn f(x: scalar) -> scalar\n  c = saturate x\n  t = add c 1\n  g = max t 1e-30\n  q = div c g\n  return q",
        "fn f(x: scalar) -> scalar\n  c = saturate x\n  t = add c 1\n  q = div c t\n  return q",
    );
    check(
        "fn f(x: scalar) -> scalar\n  c = saturate x\n  g = max c 1e-30\n  q = div 1 g\n  return q",
        "fn f(x: scalar) -> scalar\n  c = saturate x\n  g = max c 1e-30\n  q = div 1 g\n  return q",
    );
}

#[test]
fn constants_merge_through_a_sum() {
    check(
        "fn f(x: scalar) -> scalar\n  a = mul 3 x\n  b = add 2 a\n  c = div b 4\n  return c",
        "fn f(x: scalar) -> scalar\n  %0 = mul 0.75 x\n  c = add 0.5 %0\n  return c",
    );
}

#[test]
fn three_channels_of_one_colour_are_the_colour() {
    check(
        "fn f(x: rgb) -> rgb\n  r = channel 0 x\n  g = channel 1 x\n  b = channel 2 x\n  y = compose r g b\n  z = mul y 2\n  return z",
        "fn f(x: rgb) -> rgb\n  z = mul x 2\n  return z",
    );
}
