//! A picture: tables of one size, axis and depth as the rows of a texture, with what its file says about them.

use std::ops::Range;

use super::axis::TableAxis;
use super::split_sum::{StoredSplitSum, TERMS};
use super::table::Stored;
use super::texel::Depth;
use crate::physics::spectra::Space;

/// One or more tables as a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Its name, also that of its file and of the array in a text format: a material's, or `atlas`.
    pub name: String,
    /// The axis of cosines along x.
    pub axis: TableAxis,
    /// The number type.
    pub depth: Depth,
    /// value = texel × scale.
    pub scale: f32,
    /// Texels in a row.
    pub width: usize,
    /// The rows' names, the top one first.
    pub rows: Vec<String>,
    /// The texels row by row, as a sampler returns them.
    pub texels: Vec<[f32; 3]>,
    /// The fourth channel of each texel, if there is one.
    pub alpha: Option<Vec<f32>>,
    /// The working space, if the channels belong to one.
    pub space: Option<Space>,
    /// What the file says about itself: ASCII, one entry per line.
    pub about: Vec<String>,
}

impl Picture {
    /// Named tables, one below the other. All have the first one's axis, depth, scale and size.
    pub fn new(name: &str, rows: &[(&str, &Stored)], space: Option<Space>) -> Picture {
        let first = rows.first().map(|(_, stored)| *stored);
        let width = first.map_or(0, |stored| stored.texels.len());
        let texels = rows.iter().flat_map(|(_, stored)| {
            let texel = |i: usize| stored.texels.get(i).copied().unwrap_or_default();
            (0..width).map(texel)
        });
        Picture {
            name: name.to_owned(),
            axis: first.map_or(TableAxis::Cos, |stored| stored.axis),
            depth: first.map_or(Depth::Float, |stored| stored.depth),
            scale: first.map_or(1.0, |stored| stored.scale),
            width,
            rows: rows.iter().map(|(name, _)| (*name).to_owned()).collect(),
            texels: texels.collect(),
            alpha: None,
            space,
            about: Vec::new(),
        }
    }

    /// These terms of a split-sum table, with its rows' names and what it says about itself. The picture's axis does not describe how it is
    /// looked up.
    pub fn of_terms(
        name: &str,
        stored: &StoredSplitSum,
        terms: Range<usize>,
        rows: Vec<String>,
        about: Vec<String>,
    ) -> Picture {
        let texels = stored.texels.iter();
        let colour = |texel: &[f32; TERMS]| match &texel[terms.clone()] {
            // A lone fourth term, in every channel.
            [fourth] if terms.start > 0 => [*fourth; 3],
            own => [0, 1, 2].map(|i| own.get(i).copied().unwrap_or(0.0)),
        };
        let fourth = (terms.len() == 4).then_some(terms.start + 3);
        Picture {
            name: name.to_owned(),
            axis: TableAxis::Cos,
            depth: stored.depth,
            scale: 1.0,
            width: stored.design.width,
            rows,
            texels: texels.clone().map(colour).collect(),
            alpha: fourth.map(|i| texels.map(|texel| texel[i]).collect()),
            space: None,
            about,
        }
    }

    /// The number of rows.
    pub fn height(&self) -> usize {
        self.rows.len()
    }

    /// How a shader looks a cosine up, in words and formulas, without the scale.
    pub fn lookup(&self) -> Vec<String> {
        let (scale, offset) = TableAxis::half_texel(self.width);
        let mut lines = vec![
            format!(
                "Row of {} texels by cos theta, 0 first; linear; wrap: clamp to edge; filter: linear; no mipmaps, level 0.",
                self.width
            ),
            format!(
                "Lookup: c = clamp(cos_theta, 0, 1), w = {}, u = w * {scale:?} + {offset:?}.",
                self.axis.formula()
            ),
        ];
        if self.height() > 1 {
            lines.push(format!(
                "Row i of {}, the top one being 0: v = (i + 0.5) / {}.",
                self.height(),
                self.height()
            ));
        }
        lines
    }

    /// The factor of a texel, in words; none where it is 1.
    pub fn scaling(&self) -> Option<String> {
        (self.scale != 1.0).then(|| format!("Reflectance = texel * {:?}.", self.scale))
    }

    /// The bits of binary16 of each texel: red, green, blue, and alpha, which is 1 where there is none. Values of other depths
    /// are rounded.
    pub(super) fn half_bits(&self) -> impl Iterator<Item = [u16; 4]> {
        let bits = |value: f32| half::f16::from_f32(value).to_bits();
        self.floats().map(move |texel| texel.map(bits))
    }

    /// Red, green, blue and alpha of each texel; alpha is 1 where there is none.
    pub(super) fn floats(&self) -> impl Iterator<Item = [f32; 4]> {
        let alpha = |i: usize| self.alpha.as_ref().map_or(1.0, |alpha| alpha[i]);
        let texels = self.texels.iter().enumerate();
        texels.map(move |(i, [r, g, b])| [*r, *g, *b, alpha(i)])
    }

    /// The integers of each texel, for an integer depth.
    pub(super) fn integers(&self) -> impl Iterator<Item = u16> {
        let largest = self.depth.largest().unwrap_or(0.0);
        let channels = self.texels.iter().enumerate().flat_map(|(i, texel)| {
            let alpha = self.alpha.as_ref().map(|alpha| alpha[i]);
            texel.iter().copied().chain(alpha)
        });
        channels.map(move |value| (value * largest).round() as u16)
    }
}
