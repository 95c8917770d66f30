//! Tables 4 and 5: mean relative error in pictures (section 5.2), by histograms of the cosines that pictures show.
//!
//! The thesis drew a cube and a sculpture. Its cube is ours except for what it does not state: resolution, field of view, and the
//! start of the camera. Its sculpture was a download of 2014, and a relief in closed form stands in its place. Beside both stands
//! the closed form of any convex body, seen from all directions.

use std::sync::LazyLock;

use super::comparison::{self, ComparisonRow, ComparisonVerdict, Figure, Meter};
use super::specialised;
use super::three_wavelengths::{mean, weighted};
use crate::generator::fit::arguments;
use crate::generator::lut::{Depth, Stored, Table, TableAxis};
use crate::generator::reference::{ReferenceCurve, THESIS_MATCHING_COS};
use crate::lab::raster::{Body, CUBE, CosineHistogram, RELIEF, Turntable, mean_relative, shown};
use crate::language::ir::{Checked, Weights, evaluate};
use crate::language::methods::Light;
use crate::physics::materials::{Channels, Surface};
use crate::physics::num::{Half, Num};

/// The texels of the thesis's tables, by the one that it draws.
const TEXELS: usize = 256;

const SCENE: &str = "180 frames, one degree each about (1, 1, 1) from 2 m, an object of 1 m; ours: 640 x 480 pixels, vertical field of view \
    60°, start at (0, 0, -2), pixels whose centre lies in the silhouette. The thesis does not state these, and its figure moves with \
    them. λ is matched at 81.37°, and gold's green term is dropped, as in Table 2";
const SCULPTURE: &str = "the thesis's object is a scanned sculpture that we do not have; ours is a relief in closed form (a sphere with \
    bumps), so that the figures need not agree. `fresnel-gen scene-error --mesh` measures any mesh";
const CONVEX: &str = "the closed form: of any convex body, far away and seen from everywhere, cosines have the density 2c. No picture is \
    drawn";
const AT_84: &str = "λ matched at 84.26°, as the text of section 3.2.4 says";
const PRECISION: &str = "both functions in this precision. The thesis explains its 10.1 % in pictures, more than the 8.68 % of the function, \
    by floats that are not precise. They are not the reason: equal areas of a picture weigh angles by sin 2θ and not \
    evenly, and any convex body seen from everywhere gives 10.68 % with exact numbers";
const PICTURES: &str = "both pictures rounded to 8 bits before they are compared, linear";
const TABLE: &str = "a table of 256 texels of 8 bits on the cosine, read with weights of 1/256, against exact numbers";
const TABLE_PICTURES: &str = "the same, both pictures rounded to 8 bits. Errors below half a step vanish: the thesis's small \
    figures for tables are of this kind";

/// An object and the camera's view of it.
struct View {
    name: &'static str,
    /// The thesis's name of it, if any.
    printed: Option<&'static str>,
    remark: &'static str,
    cosines: Vec<f64>,
    weights: Vec<f64>,
}

static VIEWS: LazyLock<[View; 3]> = LazyLock::new(|| {
    let drawn = |body: &Body| {
        let cameras = Turntable::THESIS.cameras();
        shown(&body.mesh(), &cameras, &mut |_, _| {}).histogram
    };
    let convex = CosineHistogram::of_convex_bodies();
    [
        ("flat cube", Some("cube"), SCENE, drawn(&CUBE)),
        ("relief", Some("sculpture"), SCULPTURE, drawn(&RELIEF)),
        ("density 2c", None, CONVEX, convex),
    ]
    .map(|(name, printed, remark, histogram)| {
        let (cosines, weights) = histogram.seen();
        View {
            name,
            printed,
            remark,
            cosines,
            weights,
        }
    })
});

/// Rows of a material of Table 4 or 5 (`record`). The other rows of these tables are made in other files of this room.
pub fn rows(
    table: &'static str,
    record: &'static str,
    name: &str,
    meter: &mut Meter,
) -> Vec<ComparisonRow> {
    meter.add(0, "pictures of a cube and a relief");
    let channels = &specialised::channels(name);
    let surface = Surface::of_channels(channels);
    let reference = &ReferenceCurve::new(surface, Light::Unpolarised);
    let mut rows = Vec::new();
    for view in &*VIEWS {
        let rendered = Rendered {
            table,
            record,
            name,
            view,
            channels,
            reference,
            want: view.cosines.iter().map(|c| reference.at(*c)).collect(),
        };
        match table {
            "table4" => rows.extend(rendered.metal()),
            _ => rows.extend(rendered.dielectric()),
        }
        // The closed form of convex bodies has no picture.
        if view.printed.is_some() {
            rows.extend(rendered.tables());
        }
    }
    rows
}

/// A material in a view.
struct Rendered<'a> {
    table: &'static str,
    record: &'static str,
    name: &'a str,
    view: &'a View,
    channels: &'a Channels,
    reference: &'a ReferenceCurve,
    want: Vec<[f64; 3]>,
}

impl Rendered<'_> {
    fn metal(&self) -> Vec<ComparisonRow> {
        let error = |matching_cos: f64, name: &str| {
            self.error(&specialised::matched_at(matching_cos, name, self.channels))
        };
        let rescaled = error(THESIS_MATCHING_COS, "schlick_rescaled");
        let corrected = error(THESIS_MATCHING_COS, "schlick_corrected");
        let as_in_text = error(comparison::TEXT_MATCHING_COS, "schlick_corrected");
        vec![
            self.beside("rescaled", "rescaled", rescaled),
            self.beside("corrected", "corrected", corrected),
            self.beside("corrected", "corrected, λ at 84.26°", as_in_text)
                .remark(AT_84),
            self.weighted("rescaled, by luminance", rescaled),
            self.weighted("corrected, by luminance", corrected),
        ]
    }

    fn dielectric(&self) -> Vec<ComparisonRow> {
        let function = |name| specialised::function(name, self.channels);
        let (schlick, exact) = (function("schlick_ior"), function("dielectric_textbook"));
        let mut rows = vec![
            self.beside("schlick", "schlick", self.error(&schlick)),
            self.weighted("schlick, by luminance", self.error(&schlick)),
        ];
        if self.name != "water" {
            return rows;
        }
        for (column, error) in [
            ("schlick, in f32", self.error_in::<f32>(&schlick, &exact)),
            ("schlick, in f16", self.error_in::<Half>(&schlick, &exact)),
        ] {
            rows.push(self.beside("schlick", column, error).remark(PRECISION));
        }
        let got = self.values::<f64>(&schlick);
        let error = self.error_of(&in_bytes(&got), &in_bytes(&self.want));
        let row = self.beside("schlick", "schlick, pictures of 8 bits", error);
        rows.push(row.remark(PICTURES));
        rows
    }

    /// Rows of an 8-bit lookup table.
    fn tables(&self) -> [ComparisonRow; 2] {
        let table = Table::new(self.name, self.reference, TableAxis::Cos, TEXELS);
        let table = table.expect("this size is the size of a texture");
        let stored = Stored::new(&table, Depth::Unorm8);
        let lookup = |c: &f64| stored.lookup(Weights::Steps256, *c as f32).map(f64::from);
        let got: Vec<[f64; 3]> = self.view.cosines.iter().map(lookup).collect();
        let exact = self.error_of(&got, &self.want);
        let bytes = self.error_of(&in_bytes(&got), &in_bytes(&self.want));
        [
            self.beside("table", "table, 8 bits", exact).remark(TABLE),
            self.beside("table", "table, pictures of 8 bits", bytes)
                .remark(TABLE_PICTURES),
        ]
    }

    /// A row beside the thesis's figure, where it has one for this view.
    fn beside(&self, key: &str, column: &str, error: [f64; 3]) -> ComparisonRow {
        let ours = mean(error);
        let row = ComparisonRow::new(self.table, &self.row(), column)
            .ours(Figure::Number(ours, 3, " %"))
            .remark(self.view.remark);
        let Some(object) = self.view.printed else {
            return row.thesis(Figure::Missing("the thesis does not derive it"));
        };
        let printed = comparison::number(&[self.record, self.name, object, key]);
        row.thesis(Figure::percent(printed))
            .verdict(ComparisonVerdict::of_digits(printed, ours, 2))
            .explained()
    }

    fn weighted(&self, column: &str, error: [f64; 3]) -> ComparisonRow {
        weighted(self.table, &self.row(), column, error)
    }

    fn row(&self) -> String {
        format!("{}, {}", self.name, self.view.name)
    }

    fn error(&self, function: &Checked) -> [f64; 3] {
        self.error_of(&self.values::<f64>(function), &self.want)
    }

    fn error_in<N: Num>(&self, got: &Checked, want: &Checked) -> [f64; 3] {
        self.error_of(&self.values::<N>(got), &self.values::<N>(want))
    }

    fn error_of(&self, got: &[[f64; 3]], want: &[[f64; 3]]) -> [f64; 3] {
        let error = mean_relative(got, want, &self.view.weights);
        error
            .expect("the thesis's materials reflect something at every angle")
            .map(|share| 100.0 * share)
    }

    fn values<N: Num>(&self, function: &Checked) -> Vec<[f64; 3]> {
        let cosines: Vec<N> = (self.view.cosines.iter())
            .map(|c| N::from_f64(*c))
            .collect();
        let points = cosines.len();
        let values = evaluate(function, &arguments(cosines, None));
        (0..points)
            .map(|point| values.at(point).map(N::to_f64))
            .collect()
    }
}

/// Values rounded to those of an 8-bit picture.
fn in_bytes(values: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let byte = |value: f64| f64::from(Depth::Unorm8.nearest(value));
    values.iter().map(|values| values.map(byte)).collect()
}
