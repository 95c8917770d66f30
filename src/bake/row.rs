//! The rows of the report: what a file is, how to look it up, how wrong that is.

use serde_json::{Value, json};

use crate::fit::ModelError;
use crate::lut::{Axis, Format, Picture};

use super::picture::Rounded;
use super::subject::Lit;

/// A row for each material of a picture.
pub fn rows<'a>(
    subjects: &'a [Lit],
    rounded: &'a Rounded,
    picture: &'a Picture,
    format: Format,
    file: &'a str,
) -> impl Iterator<Item = Value> + 'a {
    let all = subjects.iter().zip(&rounded.errors).enumerate();
    all.map(move |(i, (subject, errors))| {
        let mut row = shape(picture, format, file);
        row["row"] = json!(i);
        row["rows"] = json!(picture.height());
        seen(&mut row, subject);
        measured(&mut row, errors);
        row
    })
}

/// The keys in their order, with what all rows of a picture share.
fn shape(picture: &Picture, format: Format, file: &str) -> Value {
    let (scale, offset) = Axis::half_texel(picture.width);
    let mut row = json!({
        "material": null, "medium": null, "format": format.name(), "texels": picture.width,
        "axis": picture.axis.name(), "file": file, "row": null, "rows": null, "scale": picture.scale,
        "max_abs": null, "mean_rel": null, "mean_abs": null, "worst_cos": null, "exact_weights": null,
        "depth": picture.depth.name(), "bytes": picture.width * picture.depth.bytes(),
        "channels": "linear red, green, blue", "texel_centres": "the first at cos_theta = 0, the last at 1",
        "lookup": {
            "c": "clamp(cos_theta, 0.0, 1.0)", "w": picture.axis.formula(), "u": format!("w * {scale:?} + {offset:?}"),
            "v": "(row + 0.5) / rows", "wrap": "clamp to edge", "filter": "linear", "level": 0,
            "warp": picture.axis.constant(), "functions": [],
        },
    });
    if picture.axis.constant().is_none() {
        row["lookup"]["reason"] = json!(
            "the library's fresnel_table warps by (1 + warp) c / (1 + warp c), and this axis is no such: take the functions of --target"
        );
    }
    row
}

fn seen(row: &mut Value, subject: &Lit) {
    let surface = &subject.truth.surface;
    row["material"] = json!(subject.argument);
    row["medium"] = json!(subject.medium.as_deref().unwrap_or("air"));
    row["name"] = json!(subject.name);
    row["space"] = json!(subject.space.map(|space| space.name()));
    row["gamut"] = json!(surface.gamut.name());
    row["truth"] = json!(surface.seen);
    row["extrapolated"] = json!(surface.held());
}

fn measured(row: &mut Value, [steps, exact]: &[ModelError; 2]) {
    for (key, value) in [
        ("max_abs", json!(steps.max_abs)),
        ("mean_rel", json!(steps.mean_rel)),
        ("mean_abs", json!(steps.mean_abs)),
        ("worst_cos", json!(steps.worst_cos)),
        ("weights", json!("steps of 1/256, as GPUs filter")),
    ] {
        row[key] = value;
    }
    row["exact_weights"] = json!({
        "max_abs": exact.max_abs, "mean_rel": exact.mean_rel, "mean_abs": exact.mean_abs, "worst_cos": exact.worst_cos,
    });
    if steps.mean_rel.is_none() {
        row["reason"] = json!(
            "a channel reflects nothing at some angle, so that no relative error can be taken there"
        );
    }
}

/// The errors of all rows in one line, for the file itself.
pub fn error_line(errors: &[[ModelError; 2]]) -> String {
    let all = errors.iter().map(|[steps, _]| steps);
    let most = |value: fn(&ModelError) -> f64| all.clone().map(value).fold(0.0, f64::max);
    format!(
        "Error of the filtered lookup, weights in steps of 1/256: at most {:.6}; in the mean over angles at most {:.4} %.",
        most(|error| error.max_abs),
        100.0 * most(|error| error.mean_rel.unwrap_or(0.0))
    )
}
