//! A program that calls functions at many points, with arguments from a buffer. The buffer has slots of four numbers. Each
//! argument begins in a slot of its own, and a matrix takes four, column by column. Such a program is a module of an effect, and
//! runs effects when they are verified.

use super::function::EmittedFunction;
use crate::language::ir::{Param, Ty};
use crate::language::targets::{PointHarness, Spelling, Target, filled};

/// How many slots of four numbers an argument takes.
fn places_of(ty: Ty) -> usize {
    match ty {
        Ty::Texture | Ty::Cube => 0,
        Ty::Mat4 => 4,
        _ => 1,
    }
}

/// How many slots of four numbers a function's arguments take; one unused slot where there are none.
pub fn places(params: &[Param]) -> usize {
    let places: usize = params.iter().map(|param| places_of(param.ty)).sum();
    places.max(1)
}

/// The program around the text of a file, with one entry point per function; none for a language that nothing here runs. In GLSL
/// the entry point is `main`, so there can be only one function.
pub fn batch_program(
    target: &Target,
    file: &str,
    functions: &[&EmittedFunction],
) -> Option<String> {
    let harness = target.stack.harness()?;
    let batch = harness.points;
    let params = || functions.iter().flat_map(|one| &one.function.params);
    let texture = match params().find(|param| places_of(param.ty) == 0) {
        None => "",
        Some(param) if param.ty == Ty::Cube => batch.cube,
        Some(_) => harness.texture,
    };
    let most = functions.iter().map(|one| places(&one.function.params));
    let inputs: String = (0..most.max().unwrap_or(0))
        .map(|at| filled(batch.input, &[("at", &at.to_string())]))
        .collect();
    let mut entries = String::new();
    for one in functions {
        let value = value(batch, &target.spelling, harness.texture_argument, one);
        let value = match one.function.ty() {
            Ty::Scalar => filled(harness.splat, &[("value", &value)]),
            _ => value,
        };
        let entry = batch_entry(&one.name);
        entries += &filled(batch.entry, &[("entry", &entry), ("value", &value)]);
    }
    let holes: &[(&str, &str)] = &[("inputs", &inputs), ("texture", texture)];
    let declarations = filled(batch.declarations, holes);
    Some(format!("{}{file}{declarations}{entries}", harness.before))
}

/// The entry point that calls a function of this name.
pub fn batch_entry(function: &str) -> String {
    format!("run_{function}")
}

fn value(
    batch: &PointHarness,
    spelling: &Spelling,
    texture: &str,
    emitted: &EmittedFunction,
) -> String {
    let params = &emitted.function.params;
    let stride = places(params).to_string();
    let place = |at: usize| {
        let holes: &[(&str, &str)] = &[("stride", &stride), ("at", &at.to_string())];
        filled(batch.place, holes)
    };
    let mut next = 0;
    let mut argument = |param: &Param| {
        let at = next;
        next += places_of(param.ty);
        match param.ty {
            Ty::Texture => texture.to_owned(),
            Ty::Cube => batch.cube_argument.to_owned(),
            Ty::Mat4 => {
                let columns: Vec<String> = (at..at + 4).map(place).collect();
                let holes: &[(&str, &str)] =
                    &[("type", spelling.mat4), ("columns", &columns.join(", "))];
                filled(batch.matrix, holes)
            }
            Ty::Vec4 => place(at),
            Ty::Vec3 => place(at) + ".xyz",
            Ty::Vec2 => place(at) + ".xy",
            Ty::Scalar | Ty::Bool => place(at) + ".x",
        }
    };
    let arguments: Vec<String> = params.iter().map(&mut argument).collect();
    format!("{}({})", emitted.name, arguments.join(", "))
}
