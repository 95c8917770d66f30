//! `materials params`: the numbers that an engine wants of a material, and how well each is known.

use serde_json::{Value, json};

use crate::app::args::ParamsFlags;
use crate::app::error::Error;
use crate::app::request::load;
use crate::fit::{BOUNCES, Params, abbe, colour_errors, ior_d, params};
use crate::materials::{self, Material, MaterialKind, Surface, ViewingConditions};
use crate::reference::By;
use crate::report::SCHEMA;
use crate::report::table;
use crate::spectra::{Gamut, Illuminant};

use super::materials::medium;
use super::{Output, report};

/// All that is told.
struct Told {
    material: Material,
    medium: Option<Material>,
    viewing: ViewingConditions,
    params: Params,
    held: Option<String>,
    seen: String,
    /// ΔE 2000 by light and number of bounces; none where three wavelengths are not a spectrum.
    colour_errors: Option<Vec<(Illuminant, [f64; 3])>>,
    /// F0 of the other measurements of the same substance.
    others: Vec<(String, [f64; 3])>,
}

/// `fresnel-gen materials params NAME`.
pub fn run(flags: &ParamsFlags, json: Option<&std::path::Path>) -> Result<Output, Error> {
    let material = load(&flags.name.source()?)?.material;
    let medium = medium(&flags.medium)?;
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..flags.viewing.conditions()?
    };
    let told = told(material, medium.map(|medium| medium.material), viewing)?;
    report(text(&told), &object(&told), json)
}

fn told(
    material: Material,
    medium: Option<Material>,
    viewing: ViewingConditions,
) -> Result<Told, Error> {
    // What is known at three wavelengths is compared with others at the same.
    let own = [Some(&material), medium.as_ref()]
        .into_iter()
        .flatten()
        .find_map(|m| m.rgb_nm);
    let viewing = ViewingConditions {
        wavelengths_nm: viewing.wavelengths_nm.or(own),
        ..viewing
    };
    let surface = Surface::new(&material, medium.as_ref(), &viewing)?;
    let colour_errors = colour_errors(&surface, &viewing.integration);
    Ok(Told {
        held: surface.extrapolation(),
        seen: surface.seen.clone(),
        colour_errors,
        others: others(&material, medium.as_ref(), &viewing)?,
        params: params(surface, material.kind),
        material,
        medium,
        viewing,
    })
}

/// F0 of the other measurements of the same substance over the whole spectrum.
fn others(
    material: &Material,
    medium: Option<&Material>,
    viewing: &ViewingConditions,
) -> Result<Vec<(String, [f64; 3])>, Error> {
    let catalogue = materials::list()?;
    let measured = materials::surfaces_of(&material.substance, &catalogue, medium, viewing);
    let f0 = |(other, surface): (&Material, Surface)| {
        (other.name.clone(), surface.unpolarised(1.0).to_array())
    };
    let others = measured.filter(|(other, _)| other.name != material.name);
    Ok(others.map(f0).collect())
}

/// Smallest and largest F0 of all measurements, this one among them.
fn spread(told: &Told) -> ([f64; 3], [f64; 3]) {
    let mut ends = (told.params.f0, told.params.f0);
    for (_, f0) in &told.others {
        for (i, value) in f0.iter().enumerate() {
            ends.0[i] = ends.0[i].min(*value);
            ends.1[i] = ends.1[i].max(*value);
        }
    }
    ends
}

fn object(told: &Told) -> Value {
    let (params, integration) = (&told.params, &told.viewing.integration);
    let mut object = json!({
        "schema": SCHEMA, "name": told.material.name, "class": told.material.kind.name(),
        "medium": told.medium.as_ref().map_or("air", |medium| &medium.name),
        "space": integration.space.name(), "illuminant": integration.illuminant.name(),
        "observer": integration.observer.name(), "adaptation": integration.adaptation.name(),
        "step_nm": integration.step.nm(), "gamut": told.viewing.gamut.name(), "truth": told.seen, "extrapolated": told.held,
        "f0": params.f0, "f82": params.f82, "f82_tint": params.f82_tint, "f90": params.f90,
        "reflectivity": params.reflectivity, "edge_tint": params.edge_tint,
        "n": params.effective.channels.n, "k": params.effective.channels.k, "nk_by": params.effective.by.map(By::text),
        "average": params.average, "ior_d": ior_d(&told.material), "abbe": dispersion(&told.material),
    });
    if told.viewing.wavelengths_nm.is_some() {
        for key in ["space", "illuminant", "observer", "adaptation", "step_nm"] {
            object[key] = Value::Null;
        }
        object["reason"] = json!("one wavelength a channel: no spectrum is integrated");
    }
    object["colour_error"] = colour_error_json(told);
    let (least, most) = spread(told);
    let others = told
        .others
        .iter()
        .map(|(name, f0)| json!({ "name": name, "f0": f0 }));
    object["spread"] =
        json!({ "f0_min": least, "f0_max": most, "others": others.collect::<Vec<_>>() });
    object
}

fn colour_error_json(told: &Told) -> Value {
    match &told.colour_errors {
        None => Value::Null,
        Some(errors) => {
            let row = |(light, error): &(Illuminant, [f64; 3])| json!({ "illuminant": light.name(), "delta_e2000": error });
            json!({ "bounces": BOUNCES, "rows": errors.iter().map(row).collect::<Vec<_>>() })
        }
    }
}

/// Abbe's number, of what is clear enough to have one.
fn dispersion(material: &Material) -> Option<f64> {
    abbe(material).filter(|_| material.kind == MaterialKind::Dielectric)
}

fn text(told: &Told) -> String {
    let params = &told.params;
    let row = |name: &str, values: [f64; 3], what: &str| {
        let mut cells = vec![name.to_owned()];
        cells.extend(values.map(|value| format!("{value:.5}")));
        cells.push(what.to_owned());
        cells
    };
    let rows = [
        row("F0", params.f0, "at 0 degrees"),
        row("F82", params.f82, "at 81.79 degrees"),
        row(
            "F82 tint",
            params.f82_tint,
            "F82 over Schlick's value there",
        ),
        row("F90", params.f90, "at 90 degrees"),
        row("average", params.average, "hemispherical reflectance"),
        row("reflectivity", params.reflectivity, "Gulbrandsen's r"),
        row("edge tint", params.edge_tint, "Gulbrandsen's g"),
        row(
            "n",
            params.effective.channels.n,
            &params.effective.by.map(By::text).join(", "),
        ),
        row("k", params.effective.channels.k, ""),
    ];
    let mut lines = vec![
        format!("{}: {}", told.material.name, told.material.summary),
        told.seen.clone(),
    ];
    let around = told.medium.as_ref();
    lines.extend(around.map(|medium| format!("in {}: n and k are relative to it", medium.name)));
    lines.extend(told.held.iter().map(|held| format!("extrapolated: {held}")));
    lines.push(String::new());
    lines.push(table::text_table(&["", "red", "green", "blue", ""], &rows));
    let number =
        |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value:.5}"));
    lines.push(format!(
        "its own index at the d line {}, Abbe number {}",
        number(ior_d(&told.material)),
        number(dispersion(&told.material))
    ));
    lines.extend(colour_error_text(told));
    lines.extend(spread_text(told));
    lines.join("\n") + "\n"
}

fn colour_error_text(told: &Told) -> Vec<String> {
    let Some(errors) = &told.colour_errors else {
        return Vec::new();
    };
    let row = |(light, error): &(Illuminant, [f64; 3])| {
        let cells = error.map(|error| format!("{error:.2}"));
        [light.name().to_owned()].into_iter().chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = errors.iter().map(row).collect();
    vec![
        String::new(),
        "Colour error, of three channels in place of a spectrum, in Delta E 2000 after 1, 2, 3 bounces under another light.".to_owned(),
        "More accuracy than this is not worth having:".to_owned(),
        table::text_table(&["light", "1", "2", "3"], &rows),
    ]
}

fn spread_text(told: &Told) -> Vec<String> {
    if told.others.is_empty() {
        return Vec::new();
    }
    let (least, most) = spread(told);
    let row = |name: &str, values: &[f64; 3]| {
        [name.to_owned()]
            .into_iter()
            .chain(values.map(|value| format!("{value:.5}")))
            .collect()
    };
    let mut rows: Vec<Vec<String>> = told.others.iter().map(|(name, f0)| row(name, f0)).collect();
    rows.push(row("least of all", &least));
    rows.push(row("most of all", &most));
    vec![
        "How well it is known: F0 by the other measurements".to_owned(),
        table::text_table(&["", "red", "green", "blue"], &rows),
    ]
}
