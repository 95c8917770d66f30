//! The report of `scene-error`: a table for people, pictures as PNG and OpenEXR.

use crate::generator::lut::{Depth, Format, Picture, TableAxis};
use crate::lab::raster::{Painted, SceneErrorRow};
use crate::physics::foreign::Foreign;
use crate::physics::spectra::{Space, srgb_byte};

use crate::pictures::pixels::rgb_png;
use crate::pictures::table::{short_number, text_table};

/// The errors, a line each.
pub fn scene_error_text(rows: &[SceneErrorRow]) -> String {
    let Some(first) = rows.first() else {
        return String::new();
    };
    let (object, view) = (Foreign(&first.object), first.view);
    let head = format!(
        "{object}, {view}: {} frames, {} pixels. Mean relative error against the exact law in per cent, over pixels, then frames\n\n",
        first.frames, first.pixels
    );
    let columns = [
        "material",
        "method",
        "red",
        "green",
        "blue",
        "mean",
        "by luminance",
        "max abs",
        "at",
    ];
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    head + &text_table(&columns, &cells)
}

fn cells(row: &SceneErrorRow) -> Vec<String> {
    let errors = row.mean_rel.map_or([f64::NAN; 5], |errors| {
        [
            errors.red,
            errors.green,
            errors.blue,
            errors.mean,
            errors.by_luminance,
        ]
    });
    let error = |error: f64| match error.is_nan() {
        true => "not defined".to_owned(),
        false => format!("{error:.3}"),
    };
    let angle = libm::acos(row.worst_cos).to_degrees();
    let names = [row.material.clone(), row.method.clone()].into_iter();
    let last = [short_number(row.max_abs), format!("{angle:.1}°")];
    names.chain(errors.map(error)).chain(last).collect()
}

/// A picture as PNG, in sRGB. `about` is ASCII.
///
/// # Errors
/// It cannot be encoded, and why.
pub fn painted_png(picture: &Painted, about: &str) -> Result<Vec<u8>, String> {
    let bytes = picture.pixels.iter().map(|pixel| pixel.map(srgb_byte));
    let bytes = bytes.collect::<Vec<_>>().concat();
    rgb_png(&bytes, picture.size, about.to_owned())
}

/// A picture as OpenEXR in binary32, linear, with the space of its channels where they are one.
///
/// # Errors
/// It cannot be encoded, and why.
pub fn painted_exr(
    picture: &Painted,
    space: Option<Space>,
    about: &str,
) -> Result<Vec<u8>, String> {
    let texels = picture.pixels.iter();
    let texture = Picture {
        name: String::new(),
        axis: TableAxis::Cos,
        depth: Depth::Float,
        scale: 1.0,
        width: picture.size[0] as usize,
        rows: vec![String::new(); picture.size[1] as usize],
        texels: texels
            .map(|pixel| pixel.map(|value| value as f32))
            .collect(),
        alpha: None,
        space,
        about: vec![about.to_owned()],
    };
    let encoded = Format::ExrFloat.encode(&texture);
    encoded.map_err(|why| why.to_string())
}
