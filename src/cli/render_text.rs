//! The report of a drawn effect: what is known of it as text, and three panels as PNG or EXR: drawn, truth, error.

use glam::DVec3;

use crate::generator::emit::MARK;
use crate::physics::spectra::srgb_byte;
use crate::pictures::scene::{Difference, Display, Picture, RenderedRow};

use crate::pictures::pixels::rgb_png;
use crate::pictures::plot::shade_bytes;

/// The brightest colour of the error map, in CIEDE2000.
pub const ERROR_SCALE: f64 = 20.0;

/// What is known of a picture, a line each.
pub fn render_text(row: &RenderedRow, adapter: &str) -> String {
    let error = |of: Difference| format!("mean {:.2}, 99th percentile {:.2}", of.mean, of.p99);
    let mut lines = vec![
        ("effect", row.effect.to_owned()),
        (
            "body",
            format!("{} of {}, n {:.4}", row.body, row.material, row.n),
        ),
        (
            "size",
            match row.samples {
                1 => format!("{0} x {0} pixels", row.size),
                samples => format!("{0} x {0} pixels of {samples} samples", row.size),
            },
        ),
        ("drawn by", adapter.to_owned()),
        ("error", format!("{}: {}", row.metric, error(row.error))),
        (
            "own paths",
            format!(
                "{}, against light that goes as far as the effect follows it",
                error(row.own_error)
            ),
        ),
        ("wrong", row.wrong.to_owned()),
    ];
    if row.searches {
        lines.insert(lines.len() - 1, ("search", searched(row)));
    }
    if let (Some(l1), Some(energy)) = (row.l1, row.energy) {
        let light = format!("relative L1 {}, energy {}", percent(l1), percent(energy));
        lines.insert(5, ("light", light));
    }
    if let Some(leaks) = row.leaks {
        let samples = format!("{leaks} samples show what lies on the other side of the water");
        lines.insert(lines.len() - 1, ("leaks", samples));
    }
    let line = |(name, value): &(&str, String)| format!("{name:11}{value}\n");
    lines.iter().map(line).collect()
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

/// What the search for the second surface came to.
fn searched(row: &RenderedRow) -> String {
    format!(
        "{} hits, {} misses; {} reflected totally inside, {} in truth; {} falsely, {} missed",
        percent(row.hits),
        percent(row.misses),
        percent(row.total),
        percent(row.true_total),
        percent(row.false_total),
        percent(row.missed_total)
    )
}

/// The three panels side by side as PNG, in sRGB; the map goes from 0 to [`ERROR_SCALE`].
///
/// # Errors
/// The picture cannot be encoded, and why.
pub fn panels_png(picture: &Picture, display: &Display, about: &str) -> Result<Vec<u8>, String> {
    let shown = |radiance: &DVec3| display.shown(*radiance).to_array().map(srgb_byte);
    let error = |error: &f64| shade_bytes(error / ERROR_SCALE);
    let panels: [Vec<[u8; 3]>; 3] = [
        picture.drawn.iter().map(shown).collect(),
        picture.truth.iter().map(shown).collect(),
        picture.map.iter().map(error).collect(),
    ];
    let size = picture.row.size;
    let pixels = beside(&panels, size as usize).concat();
    rgb_png(&pixels, [3 * size, size], format!("{MARK}: {about}"))
}

/// The three panels side by side as OpenEXR in binary32: radiance, radiance, and the error in all three channels.
///
/// # Errors
/// The picture cannot be encoded, and why.
pub fn panels_exr(picture: &Picture) -> Result<Vec<u8>, String> {
    let radiance = |of: &[DVec3]| {
        of.iter()
            .map(|of| of.to_array().map(|v| v as f32))
            .collect()
    };
    let panels: [Vec<[f32; 3]>; 3] = [
        radiance(&picture.drawn),
        radiance(&picture.truth),
        picture.map.iter().map(|error| [*error as f32; 3]).collect(),
    ];
    let size = picture.row.size as usize;
    let pixels = beside(&panels, size);
    let channel = |i: usize| pixels.iter().map(|pixel| pixel[i]).collect::<Vec<f32>>();
    let channels = exr::prelude::AnyChannels::sort(
        ["R", "G", "B"]
            .into_iter()
            .enumerate()
            .map(|(i, name)| {
                let samples = exr::prelude::FlatSamples::F32(channel(i));
                exr::prelude::AnyChannel::new(name, samples)
            })
            .collect(),
    );
    let image = exr::prelude::Image::from_channels((3 * size, size), channels);
    let mut bytes = std::io::Cursor::new(Vec::new());
    let writer = exr::prelude::WritableImage::write(&image).non_parallel();
    writer
        .to_buffered(&mut bytes)
        .map_err(|why| why.to_string())?;
    Ok(bytes.into_inner())
}

/// The rows of squares, each beside the others.
fn beside<T: Copy>(panels: &[Vec<T>; 3], size: usize) -> Vec<T> {
    let row = |y: usize| {
        panels
            .iter()
            .flat_map(move |panel| &panel[y * size..][..size])
    };
    (0..size).flat_map(row).copied().collect()
}
