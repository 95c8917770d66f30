//! What a plan's page shows of a material: its angles, the errors over them, and its pixels in the frame where the chosen
//! function is worst.

use glam::DVec3;

use super::curve::{Curve, PixelPlace, RoughRule};
use super::metric::{FramePixels, ScenePixel, Screen, radiance};
use super::planned::{DEGREES, JudgedCandidate, JudgedMaterial, degree_of};
use super::request::PlanRequest;
use crate::lab::raster::MAGNIFIED;
use crate::physics::num::each_channel;

/// How many candidates are shown beside the chosen one.
const CHEAPER: usize = 3;
/// The largest side of a picture, in pixels.
const SIDE: u32 = 360;

/// What is shown of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialView {
    /// The share of each degree of angle in the material's coverage, over all frames.
    pub angles: Vec<f64>,
    /// The errors of the chosen function, and of the most accurate ones that cost less.
    pub curves: Vec<AngleCurve>,
    /// Pictures of the worst frame: first the exact law, then for each function its picture and the difference.
    pub pictures: Vec<ViewPicture>,
}

/// The largest difference that a function makes in the pixels of each degree of angle.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleCurve {
    /// The function.
    pub name: String,
    /// The middle of each degree and the difference; NaN where no pixel shows that degree.
    pub points: Vec<(f64, f64)>,
}

/// A crop of a frame that shows one material and nothing else.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewPicture {
    /// What it shows.
    pub title: String,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// What the screen shows, linear, row by row; `None` where the material is not seen.
    pub pixels: Vec<Option<[f64; 3]>>,
}

/// What is shown of a material, with the frame where its chosen function is worst.
pub fn material_view(
    request: &PlanRequest,
    judged: &JudgedMaterial,
    material: usize,
    frame: &FramePixels,
) -> MaterialView {
    let shown = shown_candidates(judged);
    let pixels = &frame.of_material[material];
    let places: Vec<PixelPlace> = pixels.iter().map(PixelPlace::of).collect();
    let seen = SeenPixels {
        rule: RoughRule::new(),
        screen: Screen::new(request.metric, request.display, request.space),
        pixels,
        places,
    };
    let whole: f64 = judged.angles.iter().sum();
    let share = |covered: &f64| covered / whole.max(f64::MIN_POSITIVE);
    MaterialView {
        angles: judged.angles.iter().map(share).collect(),
        curves: curves(judged, &shown, &seen),
        pictures: pictures(judged, &shown, &seen, frame.size),
    }
}

/// The pixels of a material in a frame, and the place where each looks its reflectance up.
struct SeenPixels<'a> {
    pixels: &'a [ScenePixel],
    places: Vec<PixelPlace>,
    rule: RoughRule,
    screen: Screen,
}

impl SeenPixels<'_> {
    /// What the screen shows of each pixel, for a function with these values.
    fn shown(&self, values: &[[f64; 3]]) -> Vec<DVec3> {
        let curve = Curve::new(values, &self.places, &self.rule);
        let each = self.pixels.iter().zip(&self.places);
        each.map(|(pixel, place)| self.screen.shown(radiance(pixel, curve.at(place)), 0.0))
            .collect()
    }
}

/// The chosen function, and the most accurate methods that cost less.
fn shown_candidates(judged: &JudgedMaterial) -> Vec<&JudgedCandidate> {
    let mut shown = vec![judged.chosen()];
    for one in judged.cheaper() {
        // Different forms of a method, and methods of one formula, have the same errors.
        let is_new = |known: &&JudgedCandidate| known.error != one.error;
        if shown.len() <= CHEAPER && shown.iter().all(is_new) {
            shown.push(one);
        }
    }
    shown
}

fn curves(
    judged: &JudgedMaterial,
    shown: &[&JudgedCandidate],
    seen: &SeenPixels,
) -> Vec<AngleCurve> {
    let truth = seen.shown(&judged.truth);
    let curve = |one: &&JudgedCandidate| {
        let drawn = seen.shown(&one.candidate.values);
        let mut largest = [f64::NAN; DEGREES];
        for ((pixel, got), truth) in seen.pixels.iter().zip(drawn).zip(&truth) {
            let [got, truth] = [got, *truth].map(|shown| seen.screen.place(shown));
            let most = &mut largest[degree_of(pixel)];
            *most = most.max(seen.screen.difference(got, truth));
        }
        let points = largest.into_iter().enumerate();
        AngleCurve {
            name: one.candidate.name(),
            points: points
                .map(|(degree, most)| (degree as f64 + 0.5, most))
                .collect(),
        }
    };
    shown.iter().map(curve).collect()
}

/// The part of a frame that a material covers, thinned out to a picture's size.
struct Crop {
    from: [u32; 2],
    every: u32,
    size: [u32; 2],
}

impl Crop {
    fn of(pixels: &[ScenePixel], width: u32) -> Crop {
        let (mut least, mut most) = ([u32::MAX; 2], [0; 2]);
        for pixel in pixels {
            let at = [pixel.place % width, pixel.place / width];
            for axis in 0..2 {
                least[axis] = least[axis].min(at[axis]);
                most[axis] = most[axis].max(at[axis]);
            }
        }
        let sides = [0, 1].map(|axis| most[axis] - least[axis] + 1);
        let every = sides[0].max(sides[1]).div_ceil(SIDE);
        Crop {
            from: least,
            every,
            size: sides.map(|side| side.div_ceil(every)),
        }
    }

    /// The index of a pixel in the picture, if the pixel is kept.
    fn place(&self, pixel: &ScenePixel, width: u32) -> Option<usize> {
        let at = [pixel.place % width, pixel.place / width];
        let at = [0, 1].map(|axis| at[axis] - self.from[axis]);
        let is_kept = at.iter().all(|side| side % self.every == 0);
        let [x, y] = at.map(|side| side / self.every);
        is_kept.then_some((y * self.size[0] + x) as usize)
    }
}

fn pictures(
    judged: &JudgedMaterial,
    shown: &[&JudgedCandidate],
    seen: &SeenPixels,
    [width, _]: [u32; 2],
) -> Vec<ViewPicture> {
    if seen.pixels.is_empty() {
        return Vec::new();
    }
    let crop = Crop::of(seen.pixels, width);
    let picture = |values: &[[f64; 3]]| -> Vec<Option<[f64; 3]>> {
        let mut picture = vec![None; (crop.size[0] * crop.size[1]) as usize];
        for (pixel, shown) in seen.pixels.iter().zip(seen.shown(values)) {
            if let Some(at) = crop.place(pixel, width) {
                picture[at] = Some(shown.to_array());
            }
        }
        picture
    };
    let titled = |title: String, pixels: Vec<Option<[f64; 3]>>| ViewPicture {
        title,
        size: crop.size,
        pixels,
    };
    let truth = picture(&judged.truth);
    let mut all = vec![titled("exact law".to_owned(), truth.clone())];
    // The chosen function, and the first of those that would have cost less.
    for one in shown.iter().take(2) {
        let drawn = picture(&one.candidate.values);
        let apart = drawn.iter().zip(&truth).map(|pair| match pair {
            (Some(a), Some(b)) => Some(each_channel(|i| MAGNIFIED * (a[i] - b[i]).abs())),
            _ => None,
        });
        let apart = apart.collect();
        let name = one.candidate.name();
        all.push(titled(name.clone(), drawn));
        all.push(titled(
            format!("{name}: its difference in linear light, {MAGNIFIED} times"),
            apart,
        ));
    }
    all
}
