//! Pictures of a row beside their truth: drawing and tracing both, the differences as the eye sees them, and the facts for the
//! report. Also the way from radiance to the screen: exposure, and a tone curve that keeps bright things apart.

use glam::{DVec3, DVec4};
use serde::Serialize;

use super::SAMPLES;
use super::caustics::{FOUR_PICTURES, TRIANGLES, Window, caustic_error, caustics, exact_caustics};
use super::draw::{Scenery, draw};
use super::environment::Environment;
use super::frame::Camera;
use super::light::{Around, Traced};
use super::material::OpticalMaterial;
use super::room::Relief;
use super::table::RenderRow;
use super::texels::square_means;
use super::text::RowText;
use super::trace::{Things, trace};
use crate::lab::fault::Fault;
use crate::lab::gpu::Device;
use crate::language::methods::Values;
use crate::physics::spectra::{Space, ciede2000, xyz_to_lab};

/// What is asked of a picture.
#[derive(Clone, Copy, Debug)]
pub struct PictureRequest<'a> {
    /// The effect.
    pub row: &'static RenderRow,
    /// The body's material.
    pub material: &'a OpticalMaterial,
    /// The material's name.
    pub material_name: &'a str,
    /// The values of the method's inputs where they are not those of an index: under a film.
    pub values: Option<&'a Values>,
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
    /// The thickness of the film in nanometres where it is thickest, at the body's bottom.
    pub film_nm: Option<f64>,
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
    request: &PictureRequest,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Picture, Fault> {
    let row = request.row;
    progress(0, 1, "drawing");
    if let Some(receiver) = row.receiver {
        return received(device, request, receiver);
    }
    let relief = row.dents.map(Relief::hammered);
    let flat = request.material.at_one_index();
    let things = Things {
        body: row.body,
        material: if row.disperses {
            request.material
        } else {
            &flat
        },
        around: if row.in_room {
            Around::Room
        } else {
            Around::Far(request.environment)
        },
        relief: relief.as_ref(),
    };
    let camera = Camera::around(DVec3::from_array(row.eye), row.body.radius());
    let side = request.size * SAMPLES;
    let clamped = request.is_ldr.then(|| request.environment.clamped());
    let environment = clamped.as_ref().unwrap_or(request.environment);
    let text = RowText::usual(row);
    let inputs = match request.values {
        Some(values) => text.inputs(values),
        None => text.inputs_for(things.material),
    };
    let by = (&text, inputs);
    let samples = draw(device, by, &Scenery::of(things, environment), &camera, side)?;
    let mut hear = |done, whole| progress(done, whole, "tracing rays");
    let paths = [row.true_paths, row.own_paths];
    let traced = trace(things, &camera, side as usize, paths, &mut hear);
    let pixels = |samples: Vec<DVec3>| square_means(&samples, SAMPLES as usize);
    let colour = |of: fn(&Traced) -> DVec3| pixels(traced.iter().map(of).collect());
    let (truth, own) = (colour(|one| one.colour), colour(|one| one.own));
    let radiance = |sample: &[f32; 4]| DVec4::from_array(sample.map(f64::from)).truncate();
    let drawn = pixels(samples.iter().map(radiance).collect());
    let is_body: Vec<f64> = traced
        .iter()
        .map(|one| f64::from(u8::from(one.is_body)))
        .collect();
    let shares_of_body = square_means(&is_body, SAMPLES as usize);
    let counts: Vec<bool> = shares_of_body.iter().map(|share| *share > 0.0).collect();
    let (map, error) = compare(&drawn, &truth, &counts, &request.display);
    let (_, own_error) = compare(&drawn, &own, &counts, &request.display);
    Ok(Picture {
        row: rendered_row(request, [error, own_error], &samples, &traced),
        drawn,
        truth,
        map,
    })
}

/// Light on a receiver, compared with the exact map.
fn received(
    device: &Device,
    request: &PictureRequest,
    [below, half]: [f64; 2],
) -> Result<Picture, Fault> {
    let window = Window {
        below,
        half,
        pixels: request.size,
    };
    let n = request.material.n.y;
    let (drawn, hits) = caustics(device, n, &window, TRIANGLES, FOUR_PICTURES)?;
    let exact = exact_caustics(n, &window);
    let (l1, energy) = caustic_error(&drawn, &exact);
    let grey = |map: Vec<f64>| map.into_iter().map(DVec3::splat).collect();
    let (drawn, truth): (Vec<DVec3>, Vec<DVec3>) = (grey(drawn), grey(exact));
    let all = vec![true; truth.len()];
    let (map, error) = compare(&drawn, &truth, &all, &request.display);
    Ok(Picture {
        row: RenderedRow {
            samples: 1,
            metric: "CIEDE2000 over all pixels",
            hits,
            misses: 1.0 - hits,
            l1: Some(l1),
            energy: Some(energy),
            ..rendered_row(request, [error; 2], &[], &[])
        },
        drawn,
        truth,
        map,
    })
}

/// The report's row, with shares of the samples that show the body both as drawn and in truth.
fn rendered_row(
    request: &PictureRequest,
    [error, own_error]: [Difference; 2],
    drawn: &[[f32; 4]],
    truth: &[Traced],
) -> RenderedRow {
    let row = request.row;
    let seen: Vec<(f32, &Traced)> = drawn
        .iter()
        .map(|sample| sample[3])
        .zip(truth)
        .filter(|(what, traced)| *what > 0.0 && traced.is_body)
        .collect();
    let share = |of: fn(f32, &Traced) -> bool| {
        let holds = seen.iter().filter(|(what, traced)| of(*what, traced));
        holds.count() as f64 / seen.len().max(1) as f64
    };
    fn is_total(what: f32) -> bool {
        (2.5..3.5).contains(&what)
    }
    let leaks = seen.iter().filter(|(what, _)| *what > 3.5).count() as u64;
    let misses = share(|what, _| (1.5..2.5).contains(&what));
    RenderedRow {
        effect: row.name,
        body: row.body.name(),
        material: request.material_name.to_owned(),
        n: request.material.n.y,
        film_nm: row.film.map(|_| request.material.film_nm),
        size: request.size,
        samples: SAMPLES * SAMPLES,
        metric: METRIC,
        error,
        own_error,
        searches: row.searches(),
        hits: 1.0 - misses,
        misses,
        total: share(|what, _| is_total(what)),
        true_total: share(|_, traced| traced.is_total),
        false_total: share(|what, traced| is_total(what) && !traced.is_total),
        missed_total: share(|what, traced| !is_total(what) && traced.is_total),
        l1: None,
        energy: None,
        leaks: row.has_water().then_some(leaks),
        wrong: row.wrong,
    }
}

/// Differences of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The mean.
    pub mean: f64,
    /// The 99th percentile.
    pub p99: f64,
}

/// CIEDE2000 between two pictures as shown on the screen: of each pixel, and of the pixels whose entry in `counts` is true, taken
/// together.
pub fn compare(
    one: &[DVec3],
    other: &[DVec3],
    counts: &[bool],
    display: &Display,
) -> (Vec<f64>, Difference) {
    let lab = |radiance: &DVec3| {
        let shown = display.shown(*radiance);
        xyz_to_lab(Space::Srgb.rgb_to_xyz() * shown, Space::Srgb.white())
    };
    let pairs = one.iter().zip(other);
    let map: Vec<f64> = pairs.map(|(a, b)| ciede2000(lab(a), lab(b))).collect();
    let counted = map.iter().zip(counts).filter(|(_, counts)| **counts);
    let mut sorted: Vec<f64> = counted.map(|(error, _)| *error).collect();
    sorted.sort_by(f64::total_cmp);
    let difference = Difference {
        mean: sorted.iter().sum::<f64>() / sorted.len().max(1) as f64,
        p99: sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(0.0),
    };
    (map, difference)
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
