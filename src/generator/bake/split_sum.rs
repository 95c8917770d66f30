//! The split-sum table of a method: its files and their rows.
//!
//! A fourth term lies in alpha only where a file's texels reach a GPU unchanged: KTX2 and arrays. Readers of PNG and EXR may
//! multiply colours by alpha (`createImageBitmap` of browsers by default, Core Graphics always), or divide by it, since OpenEXR
//! treats colours as premultiplied. So files of these formats hold three terms, those of others four. What is left has a file of
//! its own, whose name ends in its first term.

use std::ops::Range;

use super::request::{DEFAULT_FORMATS, Error};
use super::row::{BakeRow, Baked, ExactTermWeights, SplitSumLookup, SplitSumRow, WEIGHTS};
use crate::generator::command_line::CommandLine;
use crate::generator::emit::{MARK, comment_lines};
use crate::generator::lut::{
    BetweenSplitSum, Format, LEAST_ROUGHNESS, Orthogonal, Picture, SPLIT_SUM_AXES, SplitSum,
    SplitSumAxis, SplitSumDesign, SplitSumLayout, StoredSplitSum, TABLES, check_side, term_range,
};
use crate::language::ir::Weights;
use crate::language::methods::{self, Basis, Method};

/// The request for a split-sum table.
#[derive(Clone, Debug)]
pub struct SplitSumRequest {
    /// The method whose numbers the table is for.
    pub method: &'static Method,
    /// The meaning of the channels. An engine's layout has the engine's size and axes.
    pub layout: SplitSumLayout,
    /// Texels per side.
    pub size: usize,
    /// The axes of cosine and roughness.
    pub axes: [SplitSumAxis; 2],
    /// The files wanted. Empty: the default ones.
    pub formats: Vec<Format>,
}

/// The least term allowed in an integer format, which stores it as 0.
const LEAST_OF_INTEGERS: f64 = -0.002;

impl SplitSumRequest {
    /// The command that writes the files again, from `bake` on.
    pub fn command_line(&self) -> CommandLine {
        self.command_for(&self.formats())
    }

    fn command_for(&self, formats: &[Format]) -> CommandLine {
        let line = CommandLine::new("bake --dfg").list("method", [self.method.name]);
        let line = match self.layout {
            SplitSumLayout::Terms => line
                .list("size", [self.size])
                .list("axis", self.axes.map(SplitSumAxis::name)),
            engine => line.list("layout", [engine.name()]),
        };
        line.list("format", formats.iter().map(|format| format.name()))
    }

    /// The name of its files: the method's, unless they are an engine's, with the axes if they are not the default ones.
    fn name(&self) -> String {
        match self.layout {
            SplitSumLayout::Terms if self.axes == SPLIT_SUM_AXES => {
                format!("dfg_{}", self.method.name)
            }
            SplitSumLayout::Terms => {
                let axes = self.axes.map(|axis| axis.name().replace('-', "_"));
                format!("dfg_{}_{}", self.method.name, axes.join("_"))
            }
            engine => format!("dfg_{}", engine.name()),
        }
    }

    /// The files wanted. By default, for terms below 0, those in formats that hold them.
    fn formats(&self) -> Vec<Format> {
        let usual = || {
            let formats = DEFAULT_FORMATS.into_iter();
            formats.filter(|format| self.refusal(*format).is_none())
        };
        if self.formats.is_empty() {
            usual().collect()
        } else {
            self.formats.clone()
        }
    }

    /// Why a format cannot hold the terms: integers end at 0 and 1.
    fn refusal(&self, format: Format) -> Option<Error> {
        let basis = self.method.basis()?;
        let [least, most] = term_range(&basis);
        // Orthogonal functions reach below 0.
        let is_held = least >= LEAST_OF_INTEGERS && most <= 1.0 && Orthogonal::of(&basis).is_none();
        let is_refused = format.depth().largest().is_some() && !is_held;
        is_refused.then(|| Error::Integers {
            method: self.method.name,
            format: format.name(),
        })
    }

    /// Why the functions of the effect `image_light` do not read this table; none if they do.
    pub fn without_functions(&self) -> Option<&'static str> {
        let basis = self.method.basis()?;
        let terms = basis.terms();
        let keeps_all = |format: &Format| terms < 4 || *format == Format::Ktx2;
        if self.layout != SplitSumLayout::Terms {
            Some("an engine that binds its own layout has its own function: leave --target out")
        } else if self.axes != SPLIT_SUM_AXES {
            Some("the functions of --target read tables along square roots: leave --axis out")
        } else if terms > 4 || Orthogonal::of(&basis).is_some() {
            Some(
                "the functions of --target read tables of four terms at most, such as those of fitted, fitted_dielectric and f82_tint",
            )
        } else if !self.formats().iter().any(keeps_all) {
            Some(
                "the functions of --target read the fourth term in alpha, which only ktx2 keeps: name it in --format",
            )
        } else {
            None
        }
    }

    fn design(&self, basis: Basis) -> SplitSumDesign {
        match self.layout {
            SplitSumLayout::Terms => SplitSumDesign::square(basis, self.size, self.axes),
            engine => SplitSumDesign::of_engine(basis, engine),
        }
    }
}

/// A table with the description for its files.
struct DescribedTable<'a> {
    request: &'a SplitSumRequest,
    design: SplitSumDesign,
    name: String,
}

/// Bakes the table. `progress` receives the number of finished rows (of texels and of places between them), and of all rows.
///
/// # Errors
/// The method is not affine; no texture can have this size; or a format cannot hold the terms.
pub fn bake_split_sum(
    request: &SplitSumRequest,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Baked, Error> {
    let name = request.name();
    check_side(request.size)?;
    let method = request.method;
    let fault = Error::NotAffine {
        method: method.name,
    };
    let basis = method.basis().ok_or(fault)?;
    if request.layout != SplitSumLayout::Terms && method.name != ENGINES_METHOD {
        return Err(Error::EnginesMethod {
            layout: request.layout.name(),
            method: method.name,
        });
    }
    let formats = request.formats();
    if let Some(fault) = formats.iter().find_map(|format| request.refusal(*format)) {
        return Err(fault);
    }
    let design = request.design(basis);
    let lines = design.height as u64;
    let all = 3 * lines - 1;
    let table = SplitSum::new(&design, &mut |done, _| {
        progress(done, all, &name);
    })?;
    let between = BetweenSplitSum::new(&design, &mut |done, _| {
        progress(lines + done, all, &name);
    });
    let described = DescribedTable {
        request,
        design,
        name,
    };
    let (mut rows, mut files) = (Vec::new(), Vec::new());
    for depth in Format::depths(&formats) {
        let stored = table.stored(depth);
        let errors = [Weights::Steps256, Weights::Exact]
            .map(|w| between.errors(&stored, w)[..described.design.channels()].to_vec());
        for format in formats.iter().filter(|format| format.depth() == depth) {
            rows.push(described.row(*format, &errors));
            for terms in described.parts(*format) {
                let file = described.file(*format, &terms);
                let picture = described.picture(*format, &stored, &errors, terms);
                files.push((file, format.encode(&picture)?));
            }
        }
    }
    Ok(Baked {
        name: described.name,
        method: method.name,
        material: None,
        command: format!("fresnel-gen {}", String::from(request.command_line())),
        files,
        rows,
    })
}

/// The method whose terms engines use.
const ENGINES_METHOD: &str = "schlick";

/// The default method of a layout.
pub fn usual_method(layout: SplitSumLayout) -> &'static Method {
    let name = match layout {
        SplitSumLayout::Terms => "fitted",
        _ => ENGINES_METHOD,
    };
    methods::find(name).expect("it is in the list of methods")
}

/// What the channels of the file of these terms hold.
fn meanings(terms: &Range<usize>) -> String {
    let names = ["red", "green", "blue", "alpha"]
        .into_iter()
        .zip(terms.clone());
    let each: Vec<String> = names.map(|(name, i)| format!("{name} T{i}")).collect();
    let each = each.join(", ");
    match (terms.start, terms.len()) {
        (0, 1) => format!("{each}; the others nothing"),
        (0, 2) => format!("{each}; blue nothing"),
        (0, 3) => each,
        (0, _) => format!("{each}: no colours, and no opacity"),
        (first, 1) => format!("the file _t{first} holds T{first} in every channel"),
        (first, _) => format!("the file _t{first}: {each}"),
    }
}

fn most(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

impl DescribedTable<'_> {
    /// The terms in each file of a format.
    fn parts(&self, format: Format) -> Vec<Range<usize>> {
        let (all, most) = (
            self.design.channels(),
            3 + usize::from(format.keeps_alpha()),
        );
        let starts = (0..all).step_by(most);
        starts.map(|from| from..all.min(from + most)).collect()
    }

    /// The name of the picture of these terms.
    fn part(&self, terms: &Range<usize>) -> String {
        match terms.start {
            0 => self.name.clone(),
            first => format!("{}_t{first}", self.name),
        }
    }

    fn file(&self, format: Format, terms: &Range<usize>) -> String {
        format!("{TABLES}/{}{}", self.part(terms), format.ending())
    }

    /// The meaning of the channels in a format's files.
    fn channels(&self, format: Format) -> String {
        match self.request.layout {
            SplitSumLayout::Filament => {
                "red the mean of w, green the mean of 1, w = (1 - h.v)^5; blue nothing".to_owned()
            }
            SplitSumLayout::Bevy | SplitSumLayout::Three | SplitSumLayout::Unreal => {
                "red the mean of 1 - w, green the mean of w, w = (1 - h.v)^5; blue nothing"
                    .to_owned()
            }
            SplitSumLayout::Terms => {
                let parts = self.parts(format);
                let meanings: Vec<String> = parts.iter().map(meanings).collect();
                meanings.join("; ")
            }
        }
    }

    /// The albedo as a sum of the looked-up terms.
    fn albedo(&self) -> String {
        match self.request.layout {
            SplitSumLayout::Filament => "mix(red, green, f0)".to_owned(),
            SplitSumLayout::Bevy | SplitSumLayout::Three | SplitSumLayout::Unreal => {
                "f0 red + green".to_owned()
            }
            SplitSumLayout::Terms => {
                let numbers = self.numbers().into_iter().enumerate();
                let term = |(i, number): (usize, String)| {
                    if number.contains(' ') {
                        format!("({number}) T{i}")
                    } else {
                        format!("{number} T{i}")
                    }
                };
                numbers.map(term).collect::<Vec<_>>().join(" + ")
            }
        }
    }

    /// What the terms are multiplied by, as formulas of the method's inputs.
    fn numbers(&self) -> Vec<String> {
        let own = self.design.basis.numbers();
        let Some(functions) = &self.design.functions else {
            return own.into_iter().map(str::to_owned).collect();
        };
        let product = |(factor, name): (&f64, &&str)| match *factor {
            0.0 => None,
            1.0 => Some((*name).to_owned()),
            factor => Some(format!("{:?} {name}", factor as f32)),
        };
        let number = |row: &Vec<f64>| {
            let products = row.iter().zip(&own).filter_map(product);
            products.collect::<Vec<_>>().join(" + ")
        };
        functions.rows.iter().map(number).collect()
    }

    /// The mean over the hemisphere of what the terms are means of.
    fn averages(&self) -> Vec<f64> {
        let own = self.design.basis.averages();
        let functions = self.design.functions.as_ref();
        functions.map_or(own.clone(), |functions| functions.functions(&own))
    }

    /// The coordinate of a number along a side.
    fn place(&self, axis: SplitSumAxis, number: &str, texels: usize) -> String {
        match self.design.half_texel(texels) {
            (1.0, _) => axis.formula(number),
            (scale, offset) => format!("{} * {scale:?} + {offset:?}", axis.formula(number)),
        }
    }

    fn places(&self) -> [String; 2] {
        let design = &self.design;
        let of = [
            (design.cosine, "cos_theta_v"),
            (design.roughness, "roughness"),
        ];
        let [(u, along_u), (v, along_v)] = match design.is_transposed() {
            true => [of[1], of[0]],
            false => of,
        };
        [
            self.place(u, along_u, design.width),
            self.place(v, along_v, design.height),
        ]
    }

    fn masking(&self) -> &'static str {
        match self.request.layout {
            SplitSumLayout::Unreal => {
                "GGX, height-correlated Smith masking with c (1 - alpha) + alpha in place of roots"
            }
            _ => "GGX, height-correlated Smith masking",
        }
    }

    fn picture(
        &self,
        format: Format,
        stored: &StoredSplitSum,
        [steps, _]: &[Vec<f64>; 2],
        terms: Range<usize>,
    ) -> Picture {
        let [u, v] = self.places();
        let first = match self.design.is_transposed() {
            true => "grazing",
            false => "the smoothest",
        };
        let about = vec![
            format!(
                "{MARK}: fresnel-gen {}",
                String::from(self.request.command_for(&[format]))
            ),
            format!(
                "The split-sum table of {}: the directional albedo of a rough surface of any material is {}. {}, alpha = roughness^2.",
                self.request.method.name,
                self.albedo(),
                self.masking()
            ),
            format!(
                "Channels: {}. Linear, not sRGB, not premultiplied.",
                self.channels(format)
            ),
            format!(
                "Lookup: u = {u}, v = {v}; the first row is {first}; filter: linear; wrap: clamp to edge; no mipmaps, level 0."
            ),
            format!(
                "Error of a channel's filtered lookup, weights in steps of 1/256, from roughness {LEAST_ROUGHNESS} on: at most {:.6}. CC0-1.0.",
                most(steps)
            ),
        ];
        let rows = (0..self.design.height).map(|j| {
            let (cos_v, roughness) = self.design.at(0.0, j as f64);
            match self.design.is_transposed() {
                true => format!("cos_theta_v {cos_v:.6}"),
                false => format!("roughness {roughness:.6}"),
            }
        });
        Picture::of_terms(
            &self.part(&terms),
            stored,
            terms,
            rows.collect(),
            comment_lines(about),
        )
    }

    fn row(&self, format: Format, [steps, exact]: &[Vec<f64>; 2]) -> BakeRow {
        let [u, v] = self.places();
        let design = &self.design;
        let parts = self.parts(format);
        BakeRow::SplitSum(Box::new(SplitSumRow {
            material: None,
            medium: None,
            reason: "one table serves every material; no mean is taken over angles",
            name: self.name.clone(),
            method: self.request.method.name,
            formula: self.request.method.formula,
            layout: self.request.layout.name(),
            format: format.name(),
            texels: design.width,
            rows: design.height,
            axis: format!("{},{}", design.cosine.name(), design.roughness.name()),
            file: self.file(format, &parts[0]),
            second_file: parts.get(1).map(|terms| self.file(format, terms)),
            third_file: parts.get(2).map(|terms| self.file(format, terms)),
            scale: 1.0,
            max_abs: most(steps),
            mean_rel: None,
            term_max_abs: steps.clone(),
            weights: WEIGHTS,
            exact_weights: ExactTermWeights {
                max_abs: most(exact),
                term_max_abs: exact.clone(),
            },
            least_roughness: LEAST_ROUGHNESS,
            depth: format.depth().name(),
            bytes: design.width * design.height * format.depth().bytes() * parts.len(),
            channels: self.channels(format),
            numbers: self.numbers(),
            averages: self.averages(),
            albedo: self.albedo(),
            alpha: "roughness^2",
            distribution: self.masking(),
            lookup: SplitSumLookup {
                u,
                v,
                wrap: "clamp to edge",
                filter: "linear",
                level: 0,
                functions: Vec::new(),
            },
        }))
    }
}
