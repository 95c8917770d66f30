//! OpenEXR: binary16 or binary32, compressed without loss, no dates.
//!
//! Source: Academy Software Foundation, *OpenEXR File Layout*, 2013, <https://openexr.com/en/latest/OpenEXRFileLayout.html>. Red,
//! green and blue, with alpha if there is one, in one part of scan lines. The working space's primaries stand in
//! `chromaticities`, so that no reader has to guess them.

use std::io::Cursor;

use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer,
    LayerAttributes, LineOrder, Text, Vec2, WritableImage, f16,
};

use super::picture::Picture;
use super::texel::Depth;
use crate::physics::spectra::Space;

/// ZIP over sixteen lines: lossless, and supported by every reader.
const ENCODING: Encoding = Encoding {
    compression: Compression::ZIP16,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// The file, or the reason why it cannot be made.
pub fn exr(picture: &Picture) -> Result<Vec<u8>, String> {
    let colour = |i: usize| picture.texels.iter().map(move |texel| texel[i]);
    let colours = ["R", "G", "B"].into_iter().enumerate();
    let mut channels: Vec<_> = colours
        .map(|(i, name)| AnyChannel::new(name, samples(picture.depth, colour(i))))
        .collect();
    if let Some(alpha) = &picture.alpha {
        let alpha = alpha.iter().copied();
        channels.push(AnyChannel::new("A", samples(picture.depth, alpha)));
    }
    let attributes = LayerAttributes {
        software_name: Text::new_or_none("fresnel-gen"),
        comments: Text::new_or_none(picture.about.join("\n")),
        ..LayerAttributes::default()
    };
    let size = (picture.width, picture.height());
    let channels = AnyChannels::sort(channels.into());
    let mut image = Image::from_layer(Layer::new(size, attributes, ENCODING, channels));
    image.attributes.chromaticities = picture.space.map(chromaticities);
    let mut bytes = Cursor::new(Vec::new());
    let writer = image.write().non_parallel();
    writer
        .to_buffered(&mut bytes)
        .map_err(|why| why.to_string())?;
    Ok(bytes.into_inner())
}

/// One channel of all texels.
fn samples(depth: Depth, values: impl Iterator<Item = f32>) -> FlatSamples {
    if depth == Depth::Half {
        FlatSamples::F16(values.map(f16::from_f32).collect())
    } else {
        FlatSamples::F32(values.collect())
    }
}

fn chromaticities(space: Space) -> Chromaticities {
    let place = |[x, y]: [f64; 2]| Vec2(x as f32, y as f32);
    let [red, green, blue] = space.primaries().map(place);
    Chromaticities {
        red,
        green,
        blue,
        white: place(space.white_xy()),
    }
}
