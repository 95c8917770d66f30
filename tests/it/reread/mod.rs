//! The text of every language, read again and run: a small interpreter of the C-like subset that functions are written
//! in must give, bit for bit, what the graph gives in f32, or in f16 rounded after every operation. It catches a wrong precedence, spelling or literal in any
//! target without a compiler of that language.

pub mod language;

use fresnel_gen::generator::request::{Materials, Request};
use fresnel_gen::generator::{emit, fit, generate, lut};
use fresnel_gen::lab::verify::nearest_half;
use fresnel_gen::language::ir::{Checked, Texels, Ty, Value, evaluate};
use fresnel_gen::language::methods::{self, InHalf, Method};
use fresnel_gen::language::targets;
use fresnel_gen::physics::num::{Half, Num, Precision};
use language::{Program, Term};

const COSINES: [f32; 9] = [-0.5, 0.0, 1e-6, 0.1, 1.0 / 7.0, 0.5, 0.9, 1.0, 1.5];

/// Three channels of each input that make both sides of every choice happen.
fn arguments(name: &str) -> Vec<[f32; 3]> {
    match name {
        "eta" => vec![[1.5, 0.7, 2.4], [1.0, 1.0001, 0.3]],
        "ior" => vec![[1.5; 3], [0.7; 3], [1.0; 3]],
        "n" => vec![[0.23, 1.5, 1.39], [2.49, 1.0, 4.0]],
        "k" => vec![[3.94, 0.0, 1.72], [0.1, 0.0, 1e-20]],
        "lambda" => vec![[6.3, 0.0, 41.8]],
        "f0" | "reflectivity" => vec![[0.95, 0.04, 1.05]],
        "power" | "exponent" => vec![[4.4; 3]],
        "texels" => vec![[64.0; 3]],
        _ => vec![[0.3, 0.7, 1.2]],
    }
}

/// A table whose texels all differ.
fn table() -> Texels {
    fit::texels(|c| [1.0 - 0.9 * c, 1.0 - 0.5 * c * c, 0.5])
}

#[track_caller]
fn check(text: &str, name: &str, function: &Checked, inputs: &[[f32; 3]]) {
    check_in::<f32>(Precision::F32, text, name, function, inputs);
}

/// Text of half precision; its inputs are numbers that f16 has.
#[track_caller]
fn check_half(text: &str, name: &str, function: &Checked, inputs: &[[f32; 3]]) {
    let inputs: Vec<[f32; 3]> = inputs.iter().map(|input| input.map(nearest_half)).collect();
    check_in::<Half>(Precision::F16, text, name, function, &inputs);
}

#[track_caller]
fn check_in<N: Num>(
    precision: Precision,
    text: &str,
    name: &str,
    function: &Checked,
    inputs: &[[f32; 3]],
) {
    let program = Program::parse(text, name, &table(), precision);
    for cos_theta in COSINES.map(|c| precision.rounded(f64::from(c)) as f32) {
        let (mut values, mut terms) = (Vec::new(), Vec::new());
        if function.params[0].is_cosine() {
            values.push(Value::each(vec![N::from_f64(f64::from(cos_theta))]));
            terms.push(Term::Scalar(cos_theta));
        }
        let params = function.params.iter().filter(|param| !param.is_cosine());
        for (param, input) in params.zip(inputs) {
            if param.ty == Ty::Texture {
                values.push(Value::Texture(Some(table())));
                terms.push(Term::Texture);
                continue;
            }
            let wide = input.map(f64::from);
            let is_colour = param.ty.channels() == 3;
            values.push(if is_colour {
                Value::rgb(wide)
            } else {
                Value::scalar(wide[0])
            });
            terms.push(if is_colour {
                Term::Colour(*input)
            } else {
                Term::Scalar(input[0])
            });
        }
        let want = evaluate::<N>(function, &values).at(0);
        let want = want.map(|want| want.to_f64() as f32);
        let got = program.run(&terms).colour();
        let same = got
            .iter()
            .zip(want)
            .all(|(got, want)| got.to_bits() == want.to_bits() || got.is_nan() && want.is_nan());
        assert!(
            same,
            "{name}({cos_theta}, {inputs:?}): the text gives {got:?}, the graph {want:?}\n{text}"
        );
    }
}

/// One of each input's choices, as many rows as the longest has.
fn rows_of(function: &Checked) -> Vec<Vec<[f32; 3]>> {
    let choices: Vec<Vec<[f32; 3]>> = function
        .params
        .iter()
        .filter(|param| !param.is_cosine())
        .map(|param| arguments(&param.name))
        .collect();
    let longest = choices.iter().map(Vec::len).max().unwrap_or(1);
    (0..longest)
        .map(|row| {
            choices
                .iter()
                .map(|choice| choice[row % choice.len()])
                .collect()
        })
        .collect()
}

fn text_targets() -> impl Iterator<Item = &'static &'static targets::Target> {
    targets::ALL
        .iter()
        .filter(|target| target.finish != targets::Finish::Spirv)
}

/// All functions of a library file.
fn library(method: &'static methods::Method, naming: &emit::Naming) -> Vec<emit::EmittedFunction> {
    let own = emit::library_functions(method, naming).expect("well formed");
    let means = emit::companions(method, naming).expect("well formed");
    own.into_iter().chain(means).collect()
}

#[test]
fn every_library_function_reads_as_it_was_meant() {
    for method in methods::ALL {
        let functions = library(method, &emit::Naming::default());
        for target in text_targets() {
            for file in emit::library(target, method, &functions, emit::Heading::default())
                .expect("it prints")
            {
                let text = String::from_utf8(file.bytes).expect("text");
                for emitted in &functions {
                    for inputs in rows_of(&emitted.function) {
                        check(&text, &emitted.name, &emitted.function, &inputs);
                    }
                }
            }
        }
    }
}

#[test]
fn every_library_function_in_half_precision_reads_as_it_was_meant() {
    let naming = emit::Naming {
        precision: Precision::F16,
        ..emit::Naming::default()
    };
    let refused = |method: &Method| matches!(method.half, InHalf::Refused(_));
    let written = methods::ALL.iter().filter(|method| !refused(method));
    for method in written.filter(|method| !method.is_textured()) {
        let functions = library(method, &naming);
        for target in text_targets() {
            for file in emit::library(target, method, &functions, emit::Heading::default())
                .expect("it prints")
            {
                let text = String::from_utf8(file.bytes).expect("text");
                for emitted in &functions {
                    for inputs in rows_of(&emitted.function) {
                        check_half(&text, &emitted.name, &emitted.function, &inputs);
                    }
                }
            }
        }
    }
}

#[test]
fn specialised_functions_in_half_precision_read_as_they_were_meant() {
    let request = Request {
        precision: Precision::F16,
        ..Request::default()
    };
    for subject in request
        .subjects()
        .expect("the catalogue is good")
        .materials()
    {
        for name in subject
            .default_methods()
            .iter()
            .filter(|name| **name != "table")
        {
            let method = methods::find(name).expect("it is there");
            let bounds = emit::Bounds::default();
            let emitted = emit::specialised_function(method, &subject, &request.naming(), &bounds)
                .expect("it specialises");
            for target in text_targets() {
                let text = emit::single(target, &emitted, Some(&subject), emit::Heading::default())
                    .expect("it prints");
                let text = String::from_utf8(text).expect("text");
                check_half(&text, &emitted.name, &emitted.function, &[]);
            }
        }
    }
}

#[test]
fn every_specialised_function_reads_as_it_was_meant() {
    let request = Request {
        targets: targets::ALL.to_vec(),
        materials: Materials::All,
        ..Request::default()
    };
    let artifacts = generate(&request)
        .expect("the catalogue generates")
        .artifacts;
    for subject in request
        .subjects()
        .expect("the catalogue is good")
        .materials()
    {
        for name in subject.default_methods() {
            let method = methods::find(name).expect("it is there");
            let (naming, bounds) = (emit::Naming::default(), emit::Bounds::recorded());
            let emitted = emit::specialised_function(method, &subject, &naming, &bounds);
            let function = emitted.expect("it specialises").function;
            let suffix = if name == subject.main_method() {
                String::new()
            } else {
                format!("_{name}")
            };
            let own = |path: &str| {
                path.contains(&format!("materials/{}.", subject.name)) && !path.ends_with(".spv")
            };
            for artifact in artifacts.iter().filter(|artifact| own(&artifact.path)) {
                let text = String::from_utf8(artifact.bytes.clone()).expect("text");
                check(
                    &text,
                    &format!("fresnel_{}{suffix}", subject.name),
                    &function,
                    // A texture, where there is one.
                    &[[0.0; 3]],
                );
            }
        }
    }
}

#[test]
fn every_lookup_reads_as_it_was_meant() {
    for axis in lut::TableAxis::ALL {
        for (scale, rows) in [(Some(1.0), 1), (Some(1.058_7), 4), (None, 1), (None, 4)] {
            let function = lut::lookup(axis, 64, scale, rows).expect("well formed");
            for target in text_targets() {
                let name = "fresnel_gold_table".to_owned();
                let bytes = emit::lookup(target, name.clone(), function.clone(), Vec::new());
                let text = String::from_utf8(bytes.expect("it prints")).expect("text");
                for inputs in rows_of(&function) {
                    check(&text, &name, &function, &inputs);
                }
            }
        }
    }
}

#[test]
#[should_panic(expected = "the text gives")]
fn a_wrong_number_in_the_text_is_seen() {
    let method = methods::find("schlick").expect("it is there");
    let functions = emit::library_functions(method, &emit::Naming::default()).expect("well formed");
    let target = targets::find("gles").expect("it is there");
    let file = emit::library(target, method, &functions, emit::Heading::default())
        .expect("it prints")
        .remove(0);
    let text = String::from_utf8(file.bytes)
        .expect("text")
        .replace("m2 * m2 * m", "m2 * m2 * m2");
    check(
        &text,
        "fresnel_schlick",
        &functions[0].function,
        &[[0.04; 3]],
    );
}
