//! Pictures of a row beside their truth: drawing and tracing both, the differences as the eye sees them, and the facts for the
//! report. Also the way from radiance to the screen: exposure, and a tone curve that keeps bright things apart.

use glam::DVec3;
use serde::Serialize;

use super::SAMPLES;
use super::caustics::{FOUR_PICTURES, Gathering, Window, caustic_error, caustics, exact_caustics};
use super::draw::{DrawFault, Drawn, Scenery, draw};
use super::environment::Environment;
use super::frame::Camera;
use super::glass::Glass;
use super::room::Relief;
use super::table::RenderRow;
use super::text::RowText;
use super::trace::{Around, Things, Traced, trace};
use crate::lab::gpu::Device;
use crate::physics::spectra::{Lab, Space, ciede2000};

/// The order for a picture.
#[derive(Clone, Copy, Debug)]
pub struct Order<'a> {
    /// The effect.
    pub row: &'static RenderRow,
    /// The body's material.
    pub glass: &'a Glass,
    /// The surroundings.
    pub environment: &'a Environment,
    /// Whether the effect is drawn with the environment clamped to white, as in an 8-bit picture.
    pub is_ldr: bool,
    /// Pixels a side.
    pub size: u32,
    /// How radiance is shown.
    pub display: Display,
}

/// A picture with its truth, of `size` pixels a side.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The picture as the effect draws it.
    pub drawn: Vec<DVec3>,
    /// The picture by the laws of light.
    pub truth: Vec<DVec3>,
    /// The difference of each pixel.
    pub map: Vec<f64>,
    /// The facts for the report.
    pub row: RenderedRow,
}

/// The facts that a report states about a picture. Shares are of the samples that show the body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RenderedRow {
    /// The effect's name.
    pub effect: &'static str,
    /// The body's name.
    pub body: &'static str,
    /// The material's name.
    pub material: String,
    /// The index that the passes take for green.
    pub n: f64,
    /// Pixels a side.
    pub size: u32,
    /// Samples in a pixel.
    pub samples: u32,
    /// The metric of errors.
    pub metric: &'static str,
    /// The error against the truth.
    pub error: Difference,
    /// The error against light that goes only as far as the effect follows it.
    pub own_error: Difference,
    /// Whether rays are searched for in a picture of the body's back. Only then do the shares below mean something.
    #[serde(skip)]
    pub searches: bool,
    /// Rays whose search ended on the body.
    pub hits: f64,
    /// Rays whose search ended beside the body.
    pub misses: f64,
    /// Rays drawn as reflected totally where they first meet the surface from inside.
    pub total: f64,
    /// The same by the truth.
    pub true_total: f64,
    /// Rays that are drawn as reflected totally although they are not.
    pub false_total: f64,
    /// Rays that are reflected totally although they are not drawn so.
    pub missed_total: f64,
    /// For light on a receiver: the sum of absolute differences, as a share of the truth's sum.
    pub l1: Option<f64>,
    /// For light on a receiver: the sum, as a share of the truth's sum.
    pub energy: Option<f64>,
    /// For water: samples whose refraction shows what is above it, or whose reflection shows what is below it.
    pub leaks: Option<u64>,
    /// Where the effect must be wrong.
    pub wrong: &'static str,
}

/// The metric of errors, as reports name it.
const METRIC: &str = "CIEDE2000 over the pixels that show the body";

/// Draws and traces a picture. `progress` gets the amount done and the total.
///
/// # Errors
/// The device does not draw it.
pub fn render(
    device: &Device,
    order: &Order,
    material: &str,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Picture, DrawFault> {
    let row = order.row;
    if let Some([below, half]) = row.receiver {
        progress(0, 1, "drawing");
        return received(device, order, material, (below, half));
    }
    let body = row.body.body();
    let relief = row.dents.map(Relief::hammered);
    let flat = order.glass.at_one_index();
    let things = Things {
        body: &body,
        glass: if row.disperses { order.glass } else { &flat },
        around: if row.in_room {
            Around::Room
        } else {
            Around::Far(order.environment)
        },
        relief: relief.as_ref(),
    };
    let camera = Camera::around(DVec3::from_array(row.eye), body.radius());
    let side = order.size * SAMPLES;
    progress(0, 1, "drawing");
    let clamped = order.is_ldr.then(|| order.environment.clamped());
    let environment = clamped.as_ref().unwrap_or(order.environment);
    let text = RowText::usual(row);
    let by = (&text, text.inputs_for(things.glass));
    let drawn = draw(device, by, &Scenery::of(things, environment), &camera, side)?;
    let mut hear = |done, whole| progress(done, whole, "tracing rays");
    let paths = [row.true_paths, row.own_paths];
    let truth = trace(things, &camera, side as usize, paths, &mut hear);
    let pixels = |samples: Vec<DVec3>| averaged(&samples, side as usize);
    let colour = |of: fn(&Traced) -> DVec3| pixels(truth.iter().map(of).collect());
    let (true_colours, own_colours) = (colour(|one| one.colour), colour(|one| one.own));
    let shown = pixels(drawn.samples.iter().map(radiance).collect());
    let is_body = |one: &Traced| DVec3::splat(f64::from(u8::from(one.is_body)));
    let shares_of_body = pixels(truth.iter().map(is_body).collect());
    let counts: Vec<bool> = shares_of_body.iter().map(|share| share.x > 0.0).collect();
    let against = |other: &[DVec3]| compare(&shown, other, &counts, &order.display);
    let Comparison { map, difference } = against(&true_colours);
    Ok(Picture {
        row: RenderedRow {
            n: order.glass.n.y,
            material: material.to_owned(),
            size: order.size,
            error: difference,
            own_error: against(&own_colours).difference,
            ..shares(row, &drawn, &truth)
        },
        truth: true_colours,
        drawn: shown,
        map,
    })
}

/// The radiance of a sample, without its alpha.
fn radiance([red, green, blue, _]: &[f32; 4]) -> DVec3 {
    DVec3::new((*red).into(), (*green).into(), (*blue).into())
}

/// Light on a receiver, compared with the exact map.
fn received(
    device: &Device,
    order: &Order,
    material: &str,
    (below, half): (f64, f64),
) -> Result<Picture, DrawFault> {
    let window = Window {
        below,
        half,
        pixels: order.size,
    };
    let n = order.glass.n.y;
    let (drawn, hits) = caustics(device, n, &window, Gathering::Triangles, FOUR_PICTURES)?;
    let exact = exact_caustics(n, &window);
    let (l1, energy) = caustic_error(&drawn, &exact);
    let grey = |map: &[f64]| map.iter().map(|light| DVec3::splat(*light)).collect();
    let (drawn, truth): (Vec<DVec3>, Vec<DVec3>) = (grey(&drawn), grey(&exact));
    let all = vec![true; exact.len()];
    let Comparison { map, difference } = compare(&drawn, &truth, &all, &order.display);
    let nothing = Drawn {
        samples: Vec::new(),
    };
    Ok(Picture {
        row: RenderedRow {
            n,
            material: material.to_owned(),
            size: order.size,
            samples: 1,
            metric: "CIEDE2000 over all pixels",
            error: difference,
            own_error: difference,
            hits,
            misses: 1.0 - hits,
            l1: Some(l1),
            energy: Some(energy),
            ..shares(order.row, &nothing, &[])
        },
        drawn,
        truth,
        map,
    })
}

/// The report's row with its shares; the rest is empty.
fn shares(row: &'static RenderRow, drawn: &Drawn, truth: &[Traced]) -> RenderedRow {
    let seen = drawn.samples.iter().zip(truth);
    let seen: Vec<(f32, &Traced)> = seen
        .map(|(sample, traced)| (sample[3], traced))
        .filter(|(what, traced)| *what > 0.0 && traced.is_body)
        .collect();
    let share = |of: &dyn Fn(f32, &Traced) -> bool| {
        let holds = seen.iter().filter(|(what, traced)| of(*what, traced));
        holds.count() as f64 / seen.len().max(1) as f64
    };
    let is_total = |what: f32| (2.5..3.5).contains(&what);
    let leaks = seen.iter().filter(|(what, _)| *what > 3.5).count() as u64;
    let misses = share(&|what, _| (1.5..2.5).contains(&what));
    let none = Difference {
        mean: 0.0,
        p99: 0.0,
    };
    RenderedRow {
        effect: row.name,
        body: row.body.name(),
        material: String::new(),
        n: 0.0,
        size: 0,
        samples: SAMPLES * SAMPLES,
        metric: METRIC,
        error: none,
        own_error: none,
        searches: row.searches(),
        hits: 1.0 - misses,
        misses,
        total: share(&|what, _| is_total(what)),
        true_total: share(&|_, traced| traced.is_total),
        false_total: share(&|what, traced| is_total(what) && !traced.is_total),
        missed_total: share(&|what, traced| !is_total(what) && traced.is_total),
        l1: None,
        energy: None,
        leaks: row.has_water().then_some(leaks),
        wrong: row.wrong,
    }
}

/// The mean of the samples of each pixel.
fn averaged(samples: &[DVec3], side: usize) -> Vec<DVec3> {
    let each = SAMPLES as usize;
    let pixels = side / each;
    let pixel = |i: usize| {
        let (x, y) = (i % pixels * each, i / pixels * each);
        let rows = (y..y + each).flat_map(|y| samples[y * side + x..][..each].iter());
        rows.sum::<DVec3>() / (each * each) as f64
    };
    (0..pixels * pixels).map(pixel).collect()
}

/// Differences of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The mean.
    pub mean: f64,
    /// The 99th percentile.
    pub p99: f64,
}

/// The differences of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The difference of each pixel.
    pub map: Vec<f64>,
    /// The differences of the counted pixels, taken together.
    pub difference: Difference,
}

/// CIEDE2000 between two pictures as shown on the screen. Only pixels whose entry in `counts` is true are counted.
pub fn compare(one: &[DVec3], other: &[DVec3], counts: &[bool], display: &Display) -> Comparison {
    let lab = |radiance: &DVec3| {
        let shown = display.shown(*radiance);
        Lab::from_xyz(Space::Srgb.rgb_to_xyz() * shown, Space::Srgb.white())
    };
    let pairs = one.iter().zip(other);
    let map: Vec<f64> = pairs.map(|(a, b)| ciede2000(lab(a), lab(b))).collect();
    let counted = map.iter().zip(counts).filter(|(_, counts)| **counts);
    let mut sorted: Vec<f64> = counted.map(|(error, _)| *error).collect();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len().max(1);
    let difference = Difference {
        mean: sorted.iter().sum::<f64>() / count as f64,
        p99: sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(0.0),
    };
    Comparison { map, difference }
}

/// A tone curve.
#[derive(Clone, Copy, Debug)]
pub struct ToneCurve {
    /// Its name on the command line.
    pub name: &'static str,
    /// From a channel of exposed radiance to one of the screen, both linear.
    pub curve: fn(f64) -> f64,
}

/// The tone curves. That of ACES is the fit by K. Narkowicz, 2015,
/// <https://knarkowicz.wordpress.com/2016/01/06/aces-filmic-tone-mapping-curve/>; Reinhard's is of SIGGRAPH 2002,
/// <https://doi.org/10.1145/566654.566575>, equation 3.
pub const TONE_CURVES: [ToneCurve; 3] = [
    ToneCurve {
        name: "none",
        curve: |x| x,
    },
    ToneCurve {
        name: "aces",
        curve: |x| x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14),
    },
    ToneCurve {
        name: "reinhard",
        curve: |x| x / (1.0 + x),
    },
];

/// How radiance is shown.
#[derive(Clone, Copy, Debug)]
pub struct Display {
    /// The exposure in stops: 1 doubles.
    pub exposure: f64,
    /// The tone curve.
    pub curve: ToneCurve,
}

impl Display {
    /// What the screen shows, linear, 0 to 1.
    pub fn shown(&self, radiance: DVec3) -> DVec3 {
        self.shown_within(radiance, 1.0)
    }

    /// What a screen with this peak shows, linear; white is 1.
    pub fn shown_within(&self, radiance: DVec3, brightest: f64) -> DVec3 {
        let exposed = radiance.max(DVec3::ZERO) * libm::exp2(self.exposure);
        let shown = exposed.to_array().map(self.curve.curve);
        DVec3::from_array(shown).clamp(DVec3::ZERO, DVec3::splat(brightest))
    }
}
