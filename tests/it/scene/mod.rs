//! Effects as they are drawn: what physics says of pixels, the truth beside them, and the command.

mod caustics;
mod command;
mod film;
mod glass;
mod mirror;
mod one_surface;
mod recorded;
mod water;
mod window;

use glam::DVec3;

use super::not_checked;
use fresnel_gen::generator::fit::values_for_material;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::{Device, Wanted};
use fresnel_gen::pictures::gallery::own_subject;
use fresnel_gen::pictures::scene::{
    self, Around, Camera, Display, Environment, OpticalMaterial, Paths, Picture, PictureRequest,
    RenderRow, RowText, TONE_CURVES, Things,
};

/// The device at hand, or a word that there is none.
#[track_caller]
fn device() -> Option<Device> {
    match Device::open(&Wanted::default()) {
        Ok(device) => Some(device),
        Err(fault @ Fault::Absent(_)) => {
            assert!(std::env::var_os("CI").is_none(), "not checked: {fault}");
            not_checked(&format!("effects as they are drawn: {fault}"));
            None
        }
        Err(fault) => panic!("{fault}"),
    }
}

/// Shown as it is.
fn plain() -> Display {
    Display {
        exposure: 0.0,
        curve: TONE_CURVES[0],
    }
}

fn row(name: &str) -> &'static RenderRow {
    scene::find(name).expect("a row")
}

/// A row's own body, under its film.
fn glass_of(row: &RenderRow) -> OpticalMaterial {
    let subject = own_subject(row);
    let film = subject.material.films.first();
    let film_nm = film.map_or(0.0, |film| film.thickness_nm);
    OpticalMaterial::under_a_film(&subject.reference.surface, film_nm)
}

/// A picture of a row in an environment.
fn pictured(
    device: &Device,
    name: &str,
    glass: &OpticalMaterial,
    environment: &Environment,
    size: u32,
) -> Picture {
    pictured_in(device, name, glass, (environment, false), size)
}

/// The same, drawn with the environment as it is or clamped to white.
fn pictured_in(
    device: &Device,
    name: &str,
    glass: &OpticalMaterial,
    environment: (&Environment, bool),
    size: u32,
) -> Picture {
    pictured_row(device, row(name), glass, environment, size)
}

/// The same of any row.
fn pictured_row(
    device: &Device,
    row: &'static RenderRow,
    glass: &OpticalMaterial,
    (environment, is_ldr): (&Environment, bool),
    size: u32,
) -> Picture {
    let method = RowText::usual(row).method;
    let values = row
        .film
        .map(|_| values_for_material(&own_subject(row), method));
    let request = PictureRequest {
        row,
        material: glass,
        material_name: "a test",
        values: values.as_ref(),
        environment,
        is_ldr,
        size,
        display: plain(),
    };
    scene::render(device, &request, &mut |_, _, _| {}).expect("it is drawn")
}

/// An environment from a formula.
fn around(radiance: impl Fn(DVec3) -> DVec3 + Sync) -> Environment {
    Environment::baked(256, radiance)
}

/// Radiance of the pixel at this place, 0 to 1 from left to right and from top to bottom.
fn at(picture: &[DVec3], x: f64, y: f64) -> DVec3 {
    let size = (picture.len() as f64).sqrt();
    let place = |share: f64| (share * size) as usize;
    picture[place(y) * size as usize + place(x)]
}

/// What is seen of a ball by a tracer along the picture's pixels.
fn traced(name: &str, n: f64, environment: &Environment, side: usize, paths: Paths) -> Vec<DVec3> {
    let (body, glass) = (row(name).body, OpticalMaterial::of_index(n));
    let things = Things {
        body,
        material: &glass,
        around: Around::Far(environment),
        relief: None,
    };
    let camera = Camera::around(DVec3::from_array(row(name).eye), body.radius());
    let seen = scene::trace(things, &camera, side, [paths; 2], &mut |_, _| {});
    seen.iter().map(|one| one.colour).collect()
}
