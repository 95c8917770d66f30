//! `fit`: computes the coefficients of fitted methods.

use clap::Args;
use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::flags::choice::{family, one_of, precision};
use crate::cli::flags::material::{MaterialFlags, MediumFlags};
use crate::cli::flags::output::ReportFlags;
use crate::cli::flags::viewing::{GamutFlags, colour};
use crate::cli::output::{Output, Progress, report};
use crate::cli::places::try_places;
use crate::cli::search;
use crate::generator::command_line::CommandLine;
use crate::generator::emit::{Missed, missed};
use crate::generator::envelope::Report;
use crate::generator::fit::{
    Coefficients, Exact, FitCurve, FitObjective, Follows, ModelError, Weight, error_from,
    model_error, values_at,
};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request};
use crate::lab::cost::{CostAndError, Family, library_cost, pareto_frontier, records};
use crate::language::methods::{ALL, Class, Method};
use crate::physics::foreign::Foreign;
use crate::physics::materials::ViewingConditions;
use crate::physics::num::{Precision, each_channel, in_parallel};
use crate::physics::spectra::Gamut;
use crate::pictures::table::{self, short_number};

/// The flags of fits.
#[derive(Args, Debug)]
#[command(
    mut_arg("gamut", |arg| arg.help("What reflects outside [0, 1]: clip and scale fit a form that keeps to [0, 1] by itself, as image light needs it; keep leaves it free [default: clip]")),
    mut_arg("material", |arg| arg.help("Names, paths of material files, or all [default: gold, platinum, water, diamond; all for --search]")),
    after_help = "Examples:\n  fresnel-gen fit --material gold\n  fresnel-gen fit --material all --terms 5 --json fits.json\n  fresnel-gen fit --material water --weight relative --exact 0,90\n  fresnel-gen fit --search --terms 4\n  fresnel-gen fit --f0 1.0,0.71,0.29 --f82 0.98,0.91,0.66\n\nFits forms shared by all materials, whose coefficients a shader takes as arguments (see `fresnel-gen methods show fitted`). The fit minimises the largest error over all angles. Colours are linear. A star marks what no other form of the same material beats in cost and error. `fresnel-gen --method fitted --material gold` writes the function with the coefficients in it, of least absolute error.\n\nWeights: relative is |f - F| / F. luminance fits red and blue separately, then green so that the error of luminance is least. delta-e weights each channel by its CIEDE2000 per unit at the true colour; the reported error is of all three channels."
)]
pub struct FitFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// Only forms with so many coefficients: 4 or 5; 6 or 8 for materials under films
    #[arg(long, value_name = "N", value_parser = terms)]
    pub terms: Option<usize>,
    /// Without effect: all forms are shared by all materials
    #[arg(long, hide = true)]
    pub shared: bool,
    /// What is minimised, at its largest over all angles: absolute, relative, luminance or delta-e
    #[arg(long, value_name = "NAME", default_value = "absolute", value_parser = one_of("weight", Weight::ALL, Weight::name))]
    pub weight: Weight,
    /// Make the fit exact at 0 degrees, at 90, or at both; the report also gives the error without this constraint
    #[arg(long, value_delimiter = ',', value_name = "DEGREES", value_parser = one_of("end of the right angle", ["0", "90"], |end| end))]
    pub exact: Vec<&'static str>,
    /// Precision of the coefficients: f32, or f16, where the fit rounds them one after another so that each compensates for the others
    #[arg(long, value_name = "NAME", value_parser = precision(), conflicts_with_all = ["exact", "search"])]
    pub precision: Option<Precision>,
    /// Search over families of short forms. List those on the Pareto frontier of operations and error, and the error of a chosen form
    /// on a substance left out of the choice
    #[arg(long, conflicts_with_all = ["f0", "f82", "gamut"])]
    pub search: bool,
    /// In place of --material: reflectance at 0 degrees, three numbers from 0 to 1 (requires --f82)
    #[arg(long, value_name = "R,G,B", value_parser = colour, requires = "f82", conflicts_with_all = ["material", "film", "medium", "ViewingFlags", "ColourFlags", "gamut"])]
    pub f0: Option<[f64; 3]>,
    /// Reflectance at 81.79 degrees (cos θ = 1/7; requires --f0)
    #[arg(long, value_name = "R,G,B", value_parser = colour, requires = "f0")]
    pub f82: Option<[f64; 3]>,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// Whose cost stands beside the error: rdna2, adreno330, malig72 ... as for `cost`
    #[arg(long, value_name = "NAME", default_value = "rdna2", value_parser = family())]
    pub gpu: &'static Family,
    /// How materials are looked at.
    #[command(flatten)]
    pub gamut: GamutFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl FitFlags {
    /// The command that makes this report again under these viewing conditions, without paths.
    pub fn command_line(&self, viewing: &ViewingConditions) -> CommandLine {
        let weight = (self.weight != Weight::default()).then_some(self.weight.name());
        CommandLine::new("fit")
            .switch("search", self.search)
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
            .list("terms", self.terms)
            .list("weight", weight)
            .list("exact", &self.exact)
            .list("precision", self.precision.map(Precision::name))
            .list("f0", self.f0.iter().flatten())
            .list("f82", self.f82.iter().flatten())
            .list("medium", &self.medium.medium)
            .seen_as(viewing)
    }
}

/// A number of coefficients that some form has.
fn terms(word: &str) -> Result<usize, &'static str> {
    let terms = word.parse().ok();
    let terms = terms.filter(|terms| [4, 5, 6, 8].contains(terms));
    terms.ok_or("no form has so many coefficients; there are forms with 4 or 5, and with 6 or 8 for materials under films")
}

/// Fits.
pub fn run(flags: &FitFlags, progress: Progress) -> Result<Output, Error> {
    let aim = aim(flags)?;
    if flags.search {
        return search::run(flags, aim, progress);
    }
    let forms = forms(flags);
    try_places(flags.report.json(), None)?;
    let (rows, left_out) = match flags.f0.zip(flags.f82) {
        None => of_materials(flags, aim, &forms, progress)?,
        Some(colours) => (of_colours(colours, aim, &forms)?, Vec::new()),
    };
    let text = fits_text(&rows, flags.gpu.name);
    let json = Report::new(flags.command_line(&flags.gamut.conditions()?), rows);
    let mut output = report(text, &json, flags.report.json())?;
    output.remarks = left_out;
    Ok(output)
}

/// The objective: what is minimised, and which constraints hold.
fn aim(flags: &FitFlags) -> Result<FitObjective, Error> {
    if flags.weight.is_of_colours() && flags.f0.is_some() {
        let why = format!(
            "--weight {} wants a space, which --f0 and --f82 have not; absolute and relative go with them",
            flags.weight.name()
        );
        return Err(Error::usage(why));
    }
    Ok(FitObjective {
        weight: flags.weight,
        precision: flags.precision.unwrap_or_default(),
        exact: Exact {
            normal: flags.exact.contains(&"0"),
            grazing: flags.exact.contains(&"90"),
        },
        space: flags.gamut.viewing.colour.space.unwrap_or_default(),
        // Forms are compared by what they can represent, before any limit is applied.
        gamut: if flags.search {
            Gamut::Keep
        } else {
            flags.gamut.gamut.unwrap_or_default()
        },
    })
}

/// A fitted method, and the cost of an evaluation of its library function, where that is known.
struct Form {
    method: &'static Method,
    cost: Option<f64>,
}

/// The fitted methods with this many coefficients, the fewest first.
fn forms(flags: &FitFlags) -> Vec<Form> {
    let fitted = ALL.iter().copied().filter(|method| method.is_fitted());
    let mut chosen: Vec<&Method> = fitted
        .filter(|method| flags.terms.is_none_or(|terms| method.inputs.len() == terms))
        .collect();
    chosen.sort_by_key(|method| (method.inputs.len(), method.name));
    let record = records(flags.gpu.name);
    let cost = |method| library_cost(method, flags.gpu, &record);
    let form = |method: &'static Method| Form {
        method,
        cost: cost(method),
    };
    chosen.into_iter().map(form).collect()
}

/// The requested materials under viewing conditions, and the remarks on those left out. A search takes all unless some are named.
pub(super) fn subjects(flags: &FitFlags) -> Result<(Vec<MaterialInMedium>, Vec<String>), Error> {
    let materials = if flags.search && flags.materials.material.is_empty() {
        Materials::All
    } else {
        flags.materials.materials()?
    };
    if materials == Materials::None {
        return Err(Error::usage(
            "a fit is of materials; `none` leaves nothing to fit",
        ));
    }
    let request = Request {
        materials,
        medium: flags.medium.source()?,
        viewing: flags.gamut.conditions()?,
        ..Request::default()
    };
    let found = request.subjects()?;
    let left_out = found.left_out_lines();
    Ok((found.materials(), left_out))
}

/// A row for each material and method that describes it, and the remarks on what was left out.
fn of_materials(
    flags: &FitFlags,
    aim: FitObjective,
    forms: &[Form],
    progress: Progress,
) -> Result<(Vec<FitRow>, Vec<String>), Error> {
    let (subjects, mut remarks) = subjects(flags)?;
    let of = |i: usize| of_subject(&subjects[i], aim, forms);
    let found = in_parallel(subjects.len(), &of, &mut |done, whole| {
        progress(done, whole, "materials");
    });
    let mut rows = Vec::new();
    for row in found.into_iter().flatten() {
        match row {
            Ok(row) => rows.push(row),
            Err(left_out) => remarks.push(left_out),
        }
    }
    Ok((rows, remarks))
}

/// Why a fit has no row.
const NO_FIT: &str = "under these weights its terms do not tell angles apart";

/// A row for each form that describes a material, or the remark that there is no fit.
fn of_subject(
    subject: &MaterialInMedium,
    aim: FitObjective,
    forms: &[Form],
) -> Vec<Result<FitRow, String>> {
    let free = FitObjective {
        gamut: Gamut::Keep,
        ..aim
    };
    let (curve, before_gamut) = (FitCurve::of(subject), FitCurve::unclipped(subject));
    // Promises for classes hold for functions, whose fit is the default one without a gamut.
    let promised = aim.weight == Weight::Absolute && !aim.exact.is_any();
    let error = |method: &'static Method, fitted: &Coefficients| {
        let function = method.specialise(&fitted.values);
        let function = function.expect("a test specialises every method");
        model_error(&function, &subject.truth_for(method))
    };
    let row = |form: &Form| {
        let method = form.method;
        let fitted = Coefficients::fit(method, &curve, aim)?;
        let without_gamut = error(method, &Coefficients::fit(method, &before_gamut, free)?).max_abs;
        let missed = promised.then(|| missed(subject, method, without_gamut));
        let error = error(method, &fitted);
        Some(FitRow {
            material: Some(subject.label().to_owned()),
            class: Some(subject.class()),
            max_abs_without_gamut: (aim.gamut != Gamut::Keep).then_some(without_gamut),
            misses_its_class: missed.flatten(),
            ..FitRow::new(method, &fitted, &error, form.cost, aim.space.name())
        })
    };
    let left_out = |form: &Form| {
        let (material, method) = (Foreign(subject.label()), form.method.name);
        format!("left out: {material} with {method}: {NO_FIT}")
    };
    let own = forms.iter();
    let own = own.filter(|form| subject.is_described_by(form.method));
    own.map(|form| row(form).ok_or_else(|| left_out(form)))
        .collect()
}

/// A row for each method, fitted to two colours.
fn of_colours(
    (f0, f82): ([f64; 3], [f64; 3]),
    aim: FitObjective,
    forms: &[Form],
) -> Result<Vec<FitRow>, Error> {
    let follows = each_channel(|i| Follows::of(f0[i], f82[i]));
    let seen = |cos_theta: f64| follows.map(|channel| channel.at(cos_theta));
    let curve = FitCurve::new(seen);
    let row = |form: &Form| {
        let method = form.method;
        let fitted = Coefficients::fit(method, &curve, aim).ok_or_else(|| {
            Error::usage(format!(
                "{} has no fit to these colours: {NO_FIT}",
                method.name
            ))
        })?;
        let function = method.function(false);
        let function = function.expect("a test builds every method");
        let error = error_from(seen, &|cosines| {
            values_at(&function, method.inputs, &fitted.values, cosines)
        });
        Ok(FitRow {
            follows: Some(follows),
            ..FitRow::new(method, &fitted, &error, form.cost, "any")
        })
    };
    let of_any = forms.iter().filter(|form| form.method.class == Class::Any);
    of_any.map(row).collect()
}

/// A fitted method and what it was fitted to.
#[derive(Clone, Debug, Serialize)]
pub struct FitRow {
    /// The material's name, if the fit is of a material.
    material: Option<String>,
    /// Its class.
    class: Option<&'static str>,
    /// The working space.
    space: &'static str,
    method: &'static str,
    terms: usize,
    shape: &'static [&'static str],
    /// Always true: every shape is shared by all materials.
    shared: bool,
    /// The coefficients of each channel.
    coefficients: [Vec<f64>; 3],
    max_abs: f64,
    mean_rel: Option<f64>,
    cost: Option<f64>,
    weight: &'static str,
    error: f64,
    exact: Vec<u32>,
    precision: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    error_without_exact: Option<f64>,
    /// The largest error of a form that need not stay in [0, 1] before its limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    max_abs_without_gamut: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// The promise of its method for the material's class, where the fit misses it.
    #[serde(skip_serializing_if = "Option::is_none")]
    misses_its_class: Option<Missed>,
    /// The curve that each channel follows, where two colours were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    follows: Option<[Follows; 3]>,
    #[serde(skip)]
    aim: FitObjective,
}

impl FitRow {
    /// The row of a method with these coefficients and errors, and with the cost of its library function where that was recorded.
    /// It has no material yet.
    fn new(
        method: &'static Method,
        fitted: &Coefficients,
        error: &ModelError,
        cost: Option<f64>,
        space: &'static str,
    ) -> FitRow {
        let inputs = || method.inputs.iter();
        let channel = |i: usize| inputs().map(|input| fitted.values[input.name][i]).collect();
        FitRow {
            material: None,
            class: None,
            space,
            method: method.name,
            terms: method.inputs.len(),
            shape: method.formula,
            shared: true,
            coefficients: each_channel(channel),
            max_abs: error.max_abs,
            mean_rel: error.mean_rel,
            cost,
            weight: fitted.aim.weight.name(),
            error: fitted.error,
            exact: fitted.aim.exact.degrees(),
            precision: fitted.aim.precision.name(),
            error_without_exact: fitted.error_without_exact,
            max_abs_without_gamut: None,
            reason: lacking(error.mean_rel, cost),
            misses_its_class: None,
            follows: None,
            aim: fitted.aim,
        }
    }

    fn name(&self) -> &str {
        self.material.as_deref().unwrap_or("two colours")
    }
}

/// Why a figure is missing, where one is.
fn lacking(mean_rel: Option<f64>, cost: Option<f64>) -> Option<String> {
    let mut reasons = Vec::new();
    if mean_rel.is_none() {
        reasons.push("a channel that reflects nothing has no relative error");
    }
    if cost.is_none() {
        reasons.push("its cost is not recorded there");
    }
    (!reasons.is_empty()).then(|| reasons.join("; "))
}

/// The meaning of the first column.
const STAR: &str = "A star marks the frontier of a material: what errs less costs more, and what costs less errs more.";

/// The rows for a terminal. A star marks a row if no other of the same material is both cheaper and as accurate.
fn fits_text(rows: &[FitRow], gpu: &str) -> String {
    let aim = rows.first().map_or(FitObjective::default(), |row| row.aim);
    let mut head = vec!["", "material", "method", "terms", "largest error"];
    let mut columns = measure_columns(aim);
    columns.retain(|(_, value)| rows.iter().any(|row| value(row).is_some()));
    head.extend(columns.iter().map(|(title, _)| *title));
    head.extend(["mean relative, %", gpu]);
    let mut lines = Vec::new();
    for alike in rows.chunk_by(|a, b| a.material == b.material) {
        let points: Vec<_> = alike
            .iter()
            .map(|row| {
                let error = row.max_abs;
                row.cost.map(|cost| CostAndError { cost, error })
            })
            .collect();
        let best = pareto_frontier(&points);
        let starred = alike.iter().enumerate();
        lines.extend(starred.map(|(place, row)| cells(row, best.contains(&place), &columns)));
    }
    let table = table::text_table(&head, &lines);
    let few = rows.len() <= SHOWN;
    let coefficients: String = rows.iter().filter(|_| few).map(coefficient_lines).collect();
    format!("{table}\n{STAR}\n{coefficients}{}", remarks(rows))
}

/// A column's title and its value in a row.
type Column = (&'static str, fn(&FitRow) -> Option<f64>);

/// The columns of the minimised measure, and of what the gamut and an exact end cost in error.
fn measure_columns(aim: FitObjective) -> Vec<Column> {
    let title = match aim.weight {
        Weight::Absolute => "largest on paper",
        Weight::Relative => "largest relative",
        Weight::Luminance => "largest of luminance",
        Weight::DeltaE => "largest CIEDE2000",
    };
    let (is_exact, is_free) = (aim.exact.is_any(), aim.gamut == Gamut::Keep);
    let mut columns: Vec<Column> = Vec::new();
    if !is_free {
        columns.push(("the same, not kept to [0, 1]", |row| {
            row.max_abs_without_gamut
        }));
    }
    if is_exact || is_free || aim.weight != Weight::Absolute {
        columns.push((title, |row| Some(row.error)));
    }
    if is_exact {
        columns.push(("the same, not exact at an end", |row| {
            row.error_without_exact
        }));
    }
    columns
}

/// The most rows for which the coefficients are printed too.
const SHOWN: usize = 6;

fn cells(row: &FitRow, is_best: bool, columns: &[Column]) -> Vec<String> {
    let shown = |value: Option<f64>| value.map_or_else(String::new, short_number);
    let mut cells = vec![
        if is_best { "*" } else { "" }.to_owned(),
        row.name().to_owned(),
        row.method.to_owned(),
        row.terms.to_string(),
        short_number(row.max_abs),
    ];
    cells.extend(columns.iter().map(|(_, value)| shown(value(row))));
    cells.push(shown(row.mean_rel.map(|share| 100.0 * share)));
    cells.push(shown(row.cost));
    cells
}

/// The coefficients as arguments, in order.
fn coefficient_lines(row: &FitRow) -> String {
    let line = |i: usize| {
        let channels = row.coefficients.iter();
        let numbers: Vec<String> = channels.map(|c| (c[i] as f32).to_string()).collect();
        format!("  c{i} = {}\n", numbers.join(", "))
    };
    let lines: String = (0..row.terms).map(line).collect();
    format!("\n{}, {}:\n{lines}", Foreign(row.name()), row.method)
}

/// The note on coefficients in half precision.
const HALF: &str = "\ncoefficients are rounded to f16, errors are those of exact arithmetic with them, and costs those of single precision\n";

fn remarks(rows: &[FitRow]) -> String {
    let is_half = rows.first().is_some_and(|row| row.aim.precision.is_half());
    let half = if is_half { HALF } else { "" };
    let missed = rows.iter().filter_map(|row| {
        let missed = row.misses_its_class.as_ref()?;
        Some(format!("{}: {}\n", Foreign(row.name()), missed.words()))
    });
    let half = half.to_owned() + &missed.collect::<String>();
    let Some(follows) = rows.first().and_then(|row| row.follows) else {
        return half;
    };
    let channels = ["red", "green", "blue"].into_iter().zip(follows);
    let remark = |(channel, follows): (&str, Follows)| match follows {
        Follows::Law { n, k } => format!("{channel}: n {n:.4}, k {k:.4}\n"),
        Follows::F82Tint { tint, .. } => format!(
            "{channel}: no n and k with an F0 of at most .985 give both colours, so it follows f82_tint with a tint of {tint:.4}\n"
        ),
    };
    half + "\n" + &channels.map(remark).collect::<String>()
}
