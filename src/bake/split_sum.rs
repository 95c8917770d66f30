//! The split-sum table of a fitted method: its files and their rows.

use crate::command_line::CommandLine;
use crate::emit::{MARK, comment_lines};
use crate::ir::Weights;
use crate::lut::{
    BetweenSplitSum, Format, LEAST_ROUGHNESS, Picture, SplitSum, StoredSplitSum, TABLES, TERMS,
    TableAxis, check_side, split_sum_roughness,
};
use crate::methods::{Method, Shape};

use super::row::{BakeRow, ExactTermWeights, SplitSumLookup, SplitSumRow, WEIGHTS};
use super::{Baked, Error, depths};

/// What is baked.
#[derive(Clone, Debug)]
pub struct SplitSumRequest {
    /// The method whose coefficients the table is for.
    pub method: &'static Method,
    /// Texels of a side.
    pub size: usize,
    /// The files wanted.
    pub formats: Vec<Format>,
}

/// What its texels hold.
const CHANNELS: &str = "red T0, green T1, blue T2, alpha T3: no colours, and no opacity";

impl SplitSumRequest {
    /// The command that writes the files again, from `bake` on.
    pub fn command_line(&self) -> CommandLine {
        self.command_for(&self.formats)
    }

    fn command_for(&self, formats: &[Format]) -> CommandLine {
        CommandLine::new("bake --dfg")
            .list("method", [self.method.name])
            .list("size", [self.size])
            .list("format", formats.iter().map(|format| format.name()))
    }

    fn name(&self) -> String {
        format!("dfg_{}", self.method.name)
    }
}

/// Bakes. `progress` gets the number of finished rows (of texels and of places between them), and of all rows.
///
/// # Errors
/// A method that is not fitted, or of more coefficients than a texture has channels; a size that no texture has.
pub fn bake_split_sum(
    request: &SplitSumRequest,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Baked, Error> {
    let name = request.name();
    check_side(request.size)?;
    let method = request.method;
    let fault = Error::NotFitted {
        method: method.name,
    };
    let shape = method.shape.as_ref().ok_or(fault)?;
    let lines = request.size as u64;
    let all = 3 * lines - 1;
    let table = SplitSum::new(shape, request.size, &mut |done, _| {
        progress(done, all, &name);
    })?;
    let between = BetweenSplitSum::new(shape, request.size, &mut |done, _| {
        progress(lines + done, all, &name);
    });
    let (mut rows, mut files) = (Vec::new(), Vec::new());
    for depth in depths(&request.formats) {
        let stored = table.stored(depth);
        let errors = [Weights::Steps256, Weights::Exact].map(|w| between.errors(&stored, w));
        let own = request.formats.iter();
        for format in own.filter(|format| format.depth() == depth) {
            let file = format!("{TABLES}/{name}{}", format.ending());
            let picture = picture(request, *format, &stored, &errors);
            rows.push(row(request, shape, (*format, &file), &errors));
            files.push((file, format.encode(&picture)?));
        }
    }
    Ok(Baked {
        name,
        method: method.name,
        material: None,
        command: format!("fresnel-gen {}", String::from(request.command_line())),
        files,
        rows,
    })
}

/// The largest of some errors.
fn most(errors: &[f64; TERMS]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

fn picture(
    request: &SplitSumRequest,
    format: Format,
    stored: &StoredSplitSum,
    [steps, _]: &[[f64; TERMS]; 2],
) -> Picture {
    let (scale, offset) = TableAxis::half_texel(request.size);
    let about = vec![
        format!(
            "{MARK}: fresnel-gen {}",
            String::from(request.command_for(&[format]))
        ),
        format!(
            "The split-sum table of {}: the directional albedo of a rough surface, GGX with height-correlated Smith masking, is \
             c0 T0 + c1 T1 + c2 T2 + c3 T3 for the coefficients c of any material. alpha = roughness^2.",
            request.method.name
        ),
        format!("Channels: {CHANNELS}. Linear, not sRGB, not premultiplied."),
        format!(
            "Lookup: u = sqrt(sqrt(clamp(cos_theta_v, 0, 1))) * {scale:?} + {offset:?}, v = sqrt(clamp(roughness, 0, 1)) * {scale:?} + \
             {offset:?}; the first row is roughness 0; filter: linear; wrap: clamp to edge; no mipmaps, level 0."
        ),
        format!(
            "Error of a term's filtered lookup, weights in steps of 1/256, from roughness {LEAST_ROUGHNESS} on: at most {:.6}. CC0-1.0.",
            most(steps)
        ),
    ];
    let rows = (0..stored.size).map(|j| {
        let roughness = split_sum_roughness(j as f64 / (stored.size - 1) as f64);
        format!("roughness {roughness:.6}")
    });
    Picture::of_terms(
        &request.name(),
        stored,
        rows.collect(),
        comment_lines(about),
    )
}

fn row(
    request: &SplitSumRequest,
    shape: &Shape,
    (format, file): (Format, &str),
    [steps, exact]: &[[f64; TERMS]; 2],
) -> BakeRow {
    let (scale, offset) = TableAxis::half_texel(request.size);
    BakeRow::SplitSum(Box::new(SplitSumRow {
        material: None,
        medium: None,
        reason: "one table serves every material; no mean is taken over angles",
        name: request.name(),
        method: request.method.name,
        formula: request.method.formula,
        format: format.name(),
        texels: request.size,
        rows: request.size,
        axis: "fourth root",
        file: file.to_owned(),
        scale: 1.0,
        max_abs: most(steps),
        mean_rel: None,
        term_max_abs: *steps,
        weights: WEIGHTS,
        exact_weights: ExactTermWeights {
            max_abs: most(exact),
            term_max_abs: *exact,
        },
        least_roughness: LEAST_ROUGHNESS,
        depth: format.depth().name(),
        bytes: request.size * request.size * format.depth().bytes(),
        channels: CHANNELS,
        averages: shape.averages(),
        albedo: "c0 T0 + c1 T1 + c2 T2 + c3 T3",
        alpha: "roughness^2",
        distribution: "GGX, height-correlated Smith masking",
        lookup: SplitSumLookup {
            u: format!("sqrt(sqrt(clamp(cos_theta_v, 0.0, 1.0))) * {scale:?} + {offset:?}"),
            v: format!("sqrt(clamp(roughness, 0.0, 1.0)) * {scale:?} + {offset:?}"),
            wrap: "clamp to edge",
            filter: "linear",
            level: 0,
            functions: Vec::new(),
        },
    }))
}
