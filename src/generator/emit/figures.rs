//! Errors and costs in the words of headers: what methods promise, and what is known of one function.

use super::code_bound::{CodeBound, FILTERED};
use super::function::EmittedFunction;
use crate::generator::fit::{Measured, ModelError, SEEN_DEGREES, rounded_up};
use crate::language::ir::Op;
use crate::language::methods::{ColourClaim, Input, Method};
use crate::physics::num::Precision;

/// What a method promises in half precision, or why it is not available there.
pub fn half_promise(method: &Method) -> String {
    match (method.half.claim(), method.half.refusal()) {
        (Some(claim), _) => {
            let media = method.media(claim.over);
            let (bound, beyond) = (absolute(claim.max_abs), beyond(claim.beyond));
            format!("Code error for {media}: {bound}{beyond}")
        }
        (None, Some(why)) => format!("Code error: nothing is promised; {why}"),
        (None, None) => format!(
            "Code error: nothing is promised but for materials; {}",
            method.half.library_refusal().unwrap_or_default()
        ),
    }
}

/// What a method promises in a precision, one line each.
pub fn promises(precision: Precision, method: &Method) -> Vec<String> {
    let mut lines = model_promises(method);
    if precision.is_half() {
        lines.push(half_promise(method));
        return lines;
    }
    let media = method.code_media();
    lines.push(if method.is_textured() {
        format!("Code error: {FILTERED}")
    } else if method.claims.code_abs > 0.0 {
        let bound = unfused(method.claims.code_abs);
        format!("Code error for films of up to 1000 nm, cos_theta from {FILM_COSINE}: {bound}")
    } else {
        format!("Code error for {media}: {}", bound(method.claims.code_ulp))
    });
    let colours = method.claims.colours;
    lines.extend(colours.map(|colours| colours_line(method, colours)));
    lines.extend(method.coefficients.map(|finds| {
        let bound = unfused(finds.code_abs);
        format!("Code error of the coefficients for {media}: {bound}")
    }));
    lines
}

/// What a method promises of its model error, one line for each set of media.
pub(super) fn model_promises(method: &Method) -> Vec<String> {
    if method.claims.model.is_empty() && method.class.is_of_films() {
        return vec!["Model error: the head of a material's function has it".to_owned()];
    }
    let claims = method.claims.model.iter().map(|claim| {
        let error = match claim.max_abs {
            0.0 => "none, it is the exact law".to_owned(),
            most => format!("at most {most}, worst at {} degrees", claim.at_degrees),
        };
        format!("Model error for {}: {error}", claim.over.text())
    });
    claims.collect()
}

/// What a method promises to artists, if colours outside its range may be far off.
pub(super) fn beyond_colours(method: &Method) -> Option<String> {
    let colours = method.claims.colours?;
    (!colours.beyond.is_empty()).then(|| colours_line(method, colours))
}

/// What a method promises to artists.
fn colours_line(method: &Method, colours: ColourClaim) -> String {
    let range = |input: &Input| format!("{} {}", input.name, colours.range(input).words());
    let ranges: Vec<String> = method.inputs.iter().map(range).collect();
    format!(
        "Code error for colours with {}: at most {:e} absolute, unfused or fused{}",
        ranges.join(", "),
        colours.max_abs,
        beyond(colours.beyond)
    )
}

/// How a bound goes on about what lies beyond its range.
fn beyond(words: &str) -> String {
    match words {
        "" => String::new(),
        words => format!("; {words}"),
    }
}

/// The largest error after the words "at most": rounded up.
pub(super) fn at_most(error: &ModelError) -> String {
    format!("at most {}", rounded_up(error.max_abs))
}

pub(super) fn model_line(error: &ModelError) -> String {
    let undefined = match error.undefined {
        0 => String::new(),
        _ => "; where it gives no number it is not counted".to_owned(),
    };
    if error.max_abs < 1e-9 {
        return format!("Model error: none, it is the exact law{undefined}.");
    }
    let most = at_most(error);
    let degrees = libm::acos(error.worst_cos).to_degrees();
    let mean = match error.mean_rel {
        // For a reflectance next to 0, any relative error is large.
        Some(mean) if mean > 100.0 => "above 10000 % in the mean over angles".to_owned(),
        Some(mean) => format!("{:.2} % in the mean over angles", 100.0 * mean),
        None => "no relative mean, as a channel reflects nothing".to_owned(),
    };
    format!("Model error: {most} (at {degrees:.2} degrees), {mean}{undefined}.")
}

/// For a method that computes at a few wavelengths: its error at all thicknesses.
pub(super) fn thickness_line(emitted: &EmittedFunction) -> Option<String> {
    let (most_nm, error) = emitted.thicknesses?;
    Some(format!(
        "That is of {most_nm} nm. Of thicknesses from 0 to {most_nm} nm, up to {SEEN_DEGREES} degrees: at most {}. Nearer to grazing a narrow fringe may fall between its wavelengths.",
        rounded_up(error)
    ))
}

/// The least cosine at which methods of films promise a code error: nearer to grazing fringes are as narrow as the cosine is small.
const FILM_COSINE: f64 = 0.05;

/// A line that says that a fit misses its class, and which method serves.
pub(super) fn missed_line(emitted: &EmittedFunction) -> Option<String> {
    let missed = emitted.missed.as_ref()?;
    Some(format!("Misses its class: {}.", missed.words()))
}

pub(super) fn code_line(emitted: &EmittedFunction) -> String {
    match &emitted.code {
        Measured::Yes(CodeBound::Ulp(ulp)) => format!("Code error: {}.", bound(*ulp)),
        Measured::Yes(CodeBound::Absolute(most)) if emitted.precision.is_half() => {
            format!("Code error: {}.", absolute(*most))
        }
        Measured::Yes(CodeBound::Absolute(most)) if emitted.form.coefficient().is_some() => {
            format!("Code error: {}.", unfused(*most))
        }
        Measured::Yes(CodeBound::Absolute(most)) => format!(
            "Code error for films of up to 1000 nm, cos_theta from {FILM_COSINE}: {}.",
            unfused(*most)
        ),
        Measured::No(why) => format!("Code error: {why}."),
    }
}

/// A bound in ulp, with the absolute one that holds near zeros.
fn bound(ulp: f64) -> String {
    let ulp = (ulp > 0.0).then(|| format!("{ulp} ulp or "));
    let ulp = ulp.unwrap_or_default();
    format!("at most {ulp}2^-22, unfused f32 against f64")
}

/// A bound in half precision. Rounded up: it says "at most".
fn absolute(most: f64) -> String {
    let most = (most * 1e5 - 1e-6).ceil() / 1e5;
    format!("at most {most} absolute, f16 rounded after every operation, against f64")
}

/// A bound of coefficients.
fn unfused(most: f64) -> String {
    format!("at most {most:e} absolute, unfused f32 against f64")
}

pub(super) fn operations(emitted: &EmittedFunction) -> String {
    let function = &emitted.function;
    let mut parts = Vec::new();
    for (ops, one, many) in [
        (&[Op::Sqrt, Op::InverseSqrt][..], "root", "roots"),
        (&[Op::Div], "division", "divisions"),
        (
            &[Op::Exp2, Op::Log2],
            "exponential or logarithm",
            "exponentials or logarithms",
        ),
        (&[Op::Sin, Op::Cos], "sine or cosine", "sines or cosines"),
    ] {
        match ops.iter().map(|op| function.count(*op)).sum::<usize>() {
            0 => {}
            1 => parts.push(format!("1 {one}")),
            count => parts.push(format!("{count} {many}")),
        }
    }
    let among = if parts.is_empty() {
        String::new()
    } else {
        format!(", among them {}", parts.join(", "))
    };
    let fetches = match function.fetches() {
        0 => "",
        _ => ", and one texture fetch",
    };
    format!("{} scalar operations{among}{fetches}", function.work())
}
