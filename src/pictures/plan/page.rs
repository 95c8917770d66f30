//! The HTML page of a plan: for each material the choice and its reason, the angles with errors over them, and its pixels in the
//! frame where the chosen function is worst.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::DVec3;
use serde::Serialize;
use tera::Context;

use super::candidate::Candidate;
use super::curve::{Curve, PixelPlace, RoughRule};
use super::frame::ScenePixel;
use super::metric::Screen;
use super::planned::{DEGREES, JudgedMaterial, degree_of};
use super::report::{PlanReport, PlanRow, cost_exact, named};
use super::request::PlanRequest;
use crate::physics::spectra::srgb_byte;
use crate::pictures::html;
use crate::pictures::plot::{ChartAxis, LineChart, Look, Series, Style, ticks};
use crate::pictures::png::rgb_png;
use crate::pictures::table::short_number;

const TEMPLATE: &str = include_str!("../../../templates/plan.html.tera");
/// How many times a difference is magnified, as in the thesis's figure 21.
const MAGNIFIED: f64 = 8.0;

/// A chart ends at this many times the budget, or above the chosen function's largest error.
const ABOVE_BUDGET: f64 = 4.0;
/// The height of the histogram, as a share of the chart.
const HISTOGRAM: f64 = 0.9;

const ANGLES: Look = Look {
    colour: "#9aa0a6",
    dashes: "",
    width: 1.2,
    dots: false,
};
const BUDGET: Look = Look {
    colour: "#c0392b",
    dashes: "2 4",
    width: 1.6,
    dots: false,
};

/// What the page says of a material.
#[derive(Serialize)]
struct Section<'a> {
    material: String,
    why: String,
    /// Facts about the choice, as pairs of name and text.
    facts: Vec<[String; 2]>,
    /// The chart as SVG.
    chart: String,
    pictures: &'a [ViewPicture],
    cheaper: Vec<[String; 3]>,
}

/// The page, or why it cannot be made.
///
/// # Errors
/// The template cannot be filled.
pub fn plan_page(report: &PlanReport, views: &[MaterialView]) -> Result<String, String> {
    let sections = report.rows.iter().zip(views);
    let sections = sections.map(|(row, view)| section(report, row, view));
    let sections: Vec<Section> = sections.collect();
    let mut context = Context::new();
    context.insert("sections", &sections);
    context.insert("unplanned", &report.unplanned);
    context.insert("remarks", &report.remarks);
    context.insert("total", &report.total());
    context.insert("cost_of", report.cost_of);
    context.insert("gpu", report.gpu);
    context.insert("unit", report.unit);
    context.insert("command", report.origin.command());
    html::fill(TEMPLATE, &context)
}

fn section<'a>(report: &PlanReport, row: &PlanRow, view: &'a MaterialView) -> Section<'a> {
    let fact = |name: &str, value: String| [name.to_owned(), value];
    let cheaper = row.cheaper.iter().map(|one| {
        let form = format!("{}, {}", one.method, one.form.name());
        [form, short_number(one.cost), format!("{:.4}", one.error)]
    });
    Section {
        material: named(row),
        why: row.why.clone(),
        facts: vec![
            fact("function", format!("{}, {}", row.method, row.form.name())),
            fact("error", format!("{:.4} {}", row.error, report.unit)),
            fact("cost", short_number(row.cost)),
            fact("the exact law costs", cost_exact(row)),
            fact("pixels of a frame", format!("{:.0}", row.pixels)),
            fact("worst frame (the first is 0)", row.worst_frame.to_string()),
        ],
        chart: chart(report, row, view).svg(),
        pictures: &view.pictures,
        cheaper: cheaper.collect(),
    }
}

/// The chart of errors over angles, above a histogram of the angles.
fn chart(report: &PlanReport, row: &PlanRow, view: &MaterialView) -> LineChart {
    let most = |curve: &AngleCurve| curve.points.iter().map(|(_, e)| *e).fold(0.0, f64::max);
    let all = view.curves.iter().map(most).fold(0.0, f64::max);
    let chosen = view.curves.first().map_or(0.0, most);
    let high = (1.05 * all).min((ABOVE_BUDGET * row.budget).max(1.2 * chosen));
    let high = if high > 0.0 { high } else { 1.0 };
    let largest = view.angles.iter().copied().fold(0.0, f64::max);
    let steps = view.angles.iter().enumerate().flat_map(|(degree, share)| {
        let y = HISTOGRAM * high * share / largest.max(f64::MIN_POSITIVE);
        [(degree as f64, y), (degree as f64 + 1.0, y)]
    });
    let mut series = vec![Series {
        name: format!(
            "pixels (highest: {} % a degree)",
            short_number(100.0 * largest)
        ),
        style: Style::Own(ANGLES),
        points: steps.collect(),
    }];
    let line = |(number, curve): (usize, &AngleCurve)| Series {
        name: curve.name.clone(),
        style: match number {
            0 => Style::Exact,
            other => Style::Approximate(other - 1),
        },
        points: curve.points.clone(),
    };
    series.extend(view.curves.iter().enumerate().map(line));
    series.push(Series {
        name: format!("budget, {}", row.budget),
        style: Style::Own(BUDGET),
        points: vec![(0.0, row.budget), (90.0, row.budget)],
    });
    LineChart {
        title: format!(
            "{}: what is seen, and what functions err there",
            row.material
        ),
        subtitle: format!(
            "the largest difference on screen in the pixels of each degree, frame {}; grey: how often an angle is seen in all frames",
            row.worst_frame
        ),
        x: ChartAxis::angle_of_incidence(),
        y: ChartAxis {
            label: format!("difference, {}", report.unit),
            low: 0.0,
            high,
            ticks: ticks(0.0, high, 5),
            unit: "",
        },
        series,
        marks: Vec::new(),
        foot: String::new(),
    }
}

/// How many candidates are shown beside the chosen one.
const CHEAPER: usize = 3;
/// The largest side of a picture, in pixels.
const SIDE: u32 = 360;
/// The colour of a picture's empty pixels.
const EMPTY: [u8; 3] = [40, 42, 46];

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
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewPicture {
    title: String,
    /// Pixels across and down.
    size: [u32; 2],
    /// The bytes of its PNG in base64.
    png: String,
}

/// What is shown of a material, with its pixels in the frame where its chosen function is worst, and the width of the frame.
///
/// # Errors
/// A picture cannot be encoded; the text says why.
pub fn material_view(
    request: &PlanRequest,
    judged: &JudgedMaterial,
    pixels: &[ScenePixel],
    width: u32,
) -> Result<MaterialView, String> {
    let places: Vec<PixelPlace> = pixels.iter().map(PixelPlace::of).collect();
    let (rule, screen) = (RoughRule::new(), request.screen());
    let shown = |values: &[[f64; 3]]| -> Vec<DVec3> {
        let curve = Curve::new(values, &places, &rule);
        let each = pixels.iter().zip(&places);
        each.map(|(pixel, place)| screen.shown(pixel, curve.at(place), 0.0))
            .collect()
    };
    let whole: f64 = judged.angles.iter().sum();
    let share = |covered: &f64| covered / whole.max(f64::MIN_POSITIVE);
    let mut view = MaterialView {
        angles: judged.angles.iter().map(share).collect(),
        curves: Vec::new(),
        pictures: Vec::new(),
    };
    let truth = shown(&judged.truth);
    let mut pictures = vec![("exact law".to_owned(), truth.clone())];
    for (i, one) in shown_candidates(judged).into_iter().enumerate() {
        let (name, drawn) = (one.name(), shown(&one.values));
        view.curves.push(AngleCurve {
            name: name.clone(),
            points: largest_differences(&screen, pixels, &drawn, &truth),
        });
        // The chosen function, and the first of those that would have cost less.
        if i < 2 {
            let apart = drawn.iter().zip(&truth);
            let apart = apart.map(|(a, b)| MAGNIFIED * (a - b).abs()).collect();
            let title = format!("{name}: its difference in linear light, {MAGNIFIED} times");
            pictures.extend([(name, drawn), (title, apart)]);
        }
    }
    if let Some(crop) = Crop::of(pixels, width) {
        let pictures = pictures.into_iter();
        let pictures = pictures.map(|(title, colours)| crop.picture(title, pixels, &colours));
        view.pictures = pictures.collect::<Result<_, _>>()?;
    }
    Ok(view)
}

/// The chosen function, and the most accurate methods that cost less.
fn shown_candidates(judged: &JudgedMaterial) -> Vec<&Candidate> {
    let mut shown = vec![judged.chosen()];
    for one in judged.cheaper() {
        // Different forms of a method, and methods of one formula, have the same errors.
        let is_new = |known: &&Candidate| known.error != one.error;
        if shown.len() <= CHEAPER && shown.iter().all(is_new) {
            shown.push(one);
        }
    }
    shown
}

/// The middle of each degree of angle, and the largest difference of the pixels there.
fn largest_differences(
    screen: &Screen,
    pixels: &[ScenePixel],
    drawn: &[DVec3],
    truth: &[DVec3],
) -> Vec<(f64, f64)> {
    let mut largest = [f64::NAN; DEGREES];
    for ((pixel, got), truth) in pixels.iter().zip(drawn).zip(truth) {
        let [got, truth] = [got, truth].map(|shown| screen.place(*shown));
        let most = &mut largest[degree_of(pixel)];
        *most = most.max(screen.difference(got, truth));
    }
    let points = largest.into_iter().enumerate();
    points
        .map(|(degree, most)| (degree as f64 + 0.5, most))
        .collect()
}

/// The part of a frame that a material covers, thinned out to a picture's size.
struct Crop {
    /// The width of the frame.
    width: u32,
    from: [u32; 2],
    every: u32,
    size: [u32; 2],
}

impl Crop {
    /// `None` where the frame does not show the material.
    fn of(pixels: &[ScenePixel], width: u32) -> Option<Crop> {
        let (mut least, mut most) = ([u32::MAX; 2], [0; 2]);
        for pixel in pixels {
            let at = [pixel.place % width, pixel.place / width];
            for axis in 0..2 {
                least[axis] = least[axis].min(at[axis]);
                most[axis] = most[axis].max(at[axis]);
            }
        }
        if pixels.is_empty() {
            return None;
        }
        let sides = [0, 1].map(|axis| most[axis] - least[axis] + 1);
        let every = sides[0].max(sides[1]).div_ceil(SIDE);
        Some(Crop {
            width,
            from: least,
            every,
            size: sides.map(|side| side.div_ceil(every)),
        })
    }

    /// The index of a pixel in the picture, if the pixel is kept.
    fn place(&self, pixel: &ScenePixel) -> Option<usize> {
        let at = [pixel.place % self.width, pixel.place / self.width];
        let at = [0, 1].map(|axis| at[axis] - self.from[axis]);
        let is_kept = at.iter().all(|side| side % self.every == 0);
        let [x, y] = at.map(|side| side / self.every);
        is_kept.then_some((y * self.size[0] + x) as usize)
    }

    /// The picture of pixels with these linear colours.
    fn picture(
        &self,
        title: String,
        pixels: &[ScenePixel],
        colours: &[DVec3],
    ) -> Result<ViewPicture, String> {
        let mut texels = vec![EMPTY; (self.size[0] * self.size[1]) as usize];
        for (pixel, colour) in pixels.iter().zip(colours) {
            if let Some(at) = self.place(pixel) {
                texels[at] = colour.to_array().map(srgb_byte);
            }
        }
        let png = rgb_png(texels.as_flattened(), self.size, String::new())?;
        Ok(ViewPicture {
            title,
            size: self.size,
            png: BASE64_STANDARD.encode(png),
        })
    }
}
