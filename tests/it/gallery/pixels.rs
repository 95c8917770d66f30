//! What the pixels of the page are held against: the same row by this program's own device; a rough ball in f64; the exact map of caustics.

use glam::DVec3;

use super::subjects;
use crate::not_checked;
use fresnel_gen::generator::fit::values_for_material;
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::{Device, Wanted};
use fresnel_gen::pictures::gallery::{CUBE, as_stored, own_subject, reduced_tables};
use fresnel_gen::pictures::scene::{
    self, Around, Body, Camera, Environment, OpticalMaterial, RenderRow, RowText, Scenery, Things,
    Window,
};

/// Pixels a side of a panel in `hands.js`.
const PANEL: usize = 50;
/// Samples of a pixel along each side.
const EACH: usize = scene::SAMPLES as usize;
/// Samples a side.
const SIDE: usize = PANEL * EACH;

/// In 99 of 100 pixels radiance differs by less than this, and by less than this share of it. Drivers filter textures with weights of 8
/// bits, and the page's ball has half the rows.
const TOLERANCE: f64 = 0.02;
/// The same where a body magnifies such differences: facets, dents, panes, and the edges of a room's squares.
const MAGNIFIED: f64 = 0.08;
const MAGNIFYING: [&str; 5] = [
    "double_refraction_gem",
    "double_refraction_normal_mapped",
    "normal_mapped",
    "parallax_corrected",
    "stained_glass",
];
/// Of caustics, in the sum of absolute differences as a share of the light.
const CAUSTICS: f64 = 0.05;

/// What pixels are held against.
pub struct Held {
    device: Option<Device>,
    subjects: Vec<MaterialInMedium>,
    sky: Environment,
}

impl Held {
    pub fn new() -> Held {
        let device = match Device::open(&Wanted::default()) {
            Ok(device) => Some(device),
            Err(fault @ Fault::Absent(_)) => {
                not_checked(&format!("pixels of the gallery: {fault}"));
                None
            }
            Err(fault) => panic!("{fault}"),
        };
        Held {
            device,
            subjects: subjects(),
            sky: Environment {
                table: as_stored(&scene::sky().table),
            },
        }
    }

    /// What is wrong with a picture of a row.
    pub fn fault(&mut self, row: &'static RenderRow, pixels: &[DVec3]) -> Option<String> {
        let own = own_subject(row).name;
        let subject = self.subjects.iter().find(|one| one.name == own);
        let subject = subject.expect("a row's material is on the page");
        let surface = &subject.reference.surface;
        let film = subject.material.films.first();
        let film_nm = film.map_or(0.0, |film| film.thickness_nm);
        let glass = OpticalMaterial::under_a_film(surface, film_nm);
        if let Some([below, half]) = row.receiver {
            let window = Window {
                below,
                half,
                pixels: PANEL as u32,
            };
            let exact = scene::exact_caustics(glass.n.y, &window);
            let drawn: Vec<f64> = pixels.iter().map(|pixel| pixel.x).collect();
            let (l1, energy) = scene::caustic_error(&drawn, &exact);
            println!("{}: L1 {l1:.4}, energy {energy:.4}", row.name);
            return (l1 > CAUSTICS).then(|| format!("L1 {l1:.4}"));
        }
        let want = if RowText::usual(row).is_rough() {
            rough(row, subject)
        } else {
            self.drawn(row, subject, &glass)?
        };
        let mut apart: Vec<f64> = pixels.iter().zip(&want).map(apart).collect();
        apart.sort_by(f64::total_cmp);
        let p99 = apart[apart.len() * 99 / 100];
        println!(
            "{}: 99 of 100 pixels differ by less than {p99:.4}",
            row.name
        );
        let tolerance = if MAGNIFYING.contains(&row.name) {
            MAGNIFIED
        } else {
            TOLERANCE
        };
        (p99 > tolerance).then(|| format!("{p99:.4}"))
    }

    /// The row by this program's own device, with what the page holds of the sky and of tables.
    fn drawn(
        &self,
        row: &'static RenderRow,
        subject: &MaterialInMedium,
        material: &OpticalMaterial,
    ) -> Option<Vec<DVec3>> {
        let device = self.device.as_ref()?;
        let flat = material.at_one_index();
        let body = row.body;
        let relief = row.dents.map(scene::Relief::hammered);
        let things = Things {
            body,
            material: if row.disperses { material } else { &flat },
            around: if row.in_room {
                Around::Room
            } else {
                Around::Far(&self.sky)
            },
            relief: relief.as_ref(),
        };
        let text = RowText::usual(row);
        let inputs = text.inputs(&values_for_material(subject, text.method));
        let scenery = Scenery {
            tables: reduced_tables(body),
            cube: CUBE,
            ..Scenery::of(things, &self.sky)
        };
        let camera = Camera::around(DVec3::from_array(row.eye), body.radius());
        let drawn = scene::draw(device, (&text, inputs), &scenery, &camera, SIDE as u32);
        let samples = drawn.expect("it is drawn");
        let colours = samples
            .iter()
            .map(|[r, g, b, _]| [*r, *g, *b].map(f64::from));
        Some(means(&colours.map(DVec3::from_array).collect::<Vec<_>>()))
    }
}

fn apart((one, other): (&DVec3, &DVec3)) -> f64 {
    let most = one.max(*other).max_element();
    (*one - *other).abs().max_element() / (1.0 + most)
}

/// The means of the samples of each pixel.
fn means(samples: &[DVec3]) -> Vec<DVec3> {
    let mut means = vec![DVec3::ZERO; PANEL * PANEL];
    for (i, sample) in samples.iter().enumerate() {
        let pixel = i / SIDE / EACH * PANEL + i % SIDE / EACH;
        means[pixel] += *sample / (EACH * EACH) as f64;
    }
    means
}

/// Roughness that the page begins with.
const ROUGHNESS: f64 = 0.3;
const LAMPS: [[[f64; 3]; 2]; 3] = [
    [[-0.6, 0.6, 0.55], [4.0, 3.8, 3.5]],
    [[0.9, 0.3, 0.15], [1.2, 1.6, 2.4]],
    [[0.2, 0.25, -0.95], [5.0, 5.0, 5.0]],
];

/// A rough ball in f64: GGX with Smith's correlated masking (Heitz 2014) and Schlick's approximation.
fn rough(row: &RenderRow, subject: &MaterialInMedium) -> Vec<DVec3> {
    let camera = Camera::around(DVec3::from_array(row.eye), 1.0);
    let schlick = fresnel_gen::language::methods::find("schlick").expect("a method");
    let f0 = DVec3::from_array(values_for_material(subject, schlick)["f0"]);
    let sample = |i: usize| {
        let place = |at: usize| (at as f64 + 0.5) / SIDE as f64;
        let direction = camera.direction(place(i % SIDE), place(i / SIDE));
        let Some(crossing) = Body::Ball.crossing(camera.eye, direction) else {
            let up = 1.0 - place(i / SIDE);
            return DVec3::new(0.035, 0.036, 0.04).lerp(DVec3::new(0.09, 0.1, 0.12), up);
        };
        let lit = LAMPS.map(|[lamp, light]| {
            let lamp = DVec3::from_array(lamp).normalize();
            lobe(crossing.entry.1, -direction, lamp, f0) * DVec3::from_array(light)
        });
        lit.iter().sum()
    };
    means(&(0..SIDE * SIDE).map(sample).collect::<Vec<_>>())
}

/// The BRDF times the cosine of the light.
fn lobe(n: DVec3, v: DVec3, l: DVec3, f0: DVec3) -> DVec3 {
    let half = (v + l).normalize();
    let (nv, nl, nh) = (n.dot(v), n.dot(l), n.dot(half));
    if nv <= 0.0 || nl <= 0.0 {
        return DVec3::ZERO;
    }
    let a2 = ROUGHNESS.powi(4);
    let d = a2 / (std::f64::consts::PI * (nh * nh * (a2 - 1.0) + 1.0).powi(2));
    let masked = |one: f64, other: f64| other * (one * one * (1.0 - a2) + a2).sqrt();
    let f = f0 + (DVec3::ONE - f0) * (1.0 - v.dot(half)).powi(5);
    f * d * 0.5 / (masked(nv, nl) + masked(nl, nv)) * nl
}
