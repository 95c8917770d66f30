//! `bake`: writes lookup tables as files, with the error of each.

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::choice::{Choice, in_any_case, one_of, one_or_all};
use crate::cli::flags::material::{MaterialFlags, MediumFlags};
use crate::cli::flags::output::{ReportFlags, TreeFlags};
use crate::cli::flags::viewing::GamutFlags;
use crate::cli::generate::named;
use crate::cli::output::{Output, Progress, reported};
use crate::cli::places::{folder_or_current, refuse_within_tree, try_places};
use crate::generator::bake::{
    ATLAS, BakeRequest, BakeRow, Baked, DEFAULT_AXIS, DEFAULT_FORMATS, FilmTableRequest,
    SplitSumRequest, THICKNESS_ROWS, TableMaterial, TableSize, Thicknesses, as_tables_are_seen,
    bake, bake_film_thickness, bake_split_sum, material_words, split_sum_methods, usual_method,
    viewing_flags,
};
use crate::generator::command_line::CommandLine;
use crate::generator::emit::{Artifact, Naming};
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::generate::tables::{artifacts, table_materials};
use crate::generator::generate::{generate, provenance};
use crate::generator::lut::{
    Format, SPLIT_SUM_AXES, SPLIT_SUM_SIZE, SplitSumAxis, SplitSumLayout, TableAxis, check_size,
};
use crate::generator::output::lock::{Announce, Lock};
use crate::generator::output::manifest::Scope;
use crate::generator::output::tree::plan;
use crate::generator::output::write::write;
use crate::generator::request::{Materials, Methods, Request};
use crate::language::effects::Effect;
use crate::language::methods::{self, Method, TEXELS};
use crate::language::targets::{self, Finish, Target};
use crate::physics::foreign;
use crate::physics::materials::{Material, length_nm};
use crate::physics::names::UnknownName;
use crate::pictures::table;

/// Flags that conflict with `--dfg`.
const NO_MATERIAL: [&str; 8] = [
    "material",
    "film",
    "medium",
    "gamut",
    "atlas",
    "budget",
    "ViewingFlags",
    "ColourFlags",
];

/// The flags of `bake`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Names, paths of material files, or all [default: gold, platinum, water, diamond]")),
    mut_arg("gamut", |arg| arg.help("Colours outside the working space: keep (integers are scaled then), clip to [0, 1], or scale [default: keep]")),
    mut_arg("out_dir", |arg| arg.help("Folder that gets a folder `lut`"))
)]
pub struct BakeFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// Bake the split-sum table of a method (cos θ by roughness, one channel per number of a material) in place of material tables;
    /// one table serves every material
    #[arg(long, conflicts_with_all = NO_MATERIAL)]
    pub dfg: bool,
    /// Whose numbers the split-sum table is for: any method that is affine in numbers of a material, such as schlick, schlick_f90,
    /// f82_tint, hoffman_f82, fitted_f82, fitted, fitted_dielectric [default: fitted; schlick with --layout]
    #[arg(long, value_name = "NAME", requires = "dfg", conflicts_with_all = NO_MATERIAL, value_parser = split_sum_method)]
    pub method: Option<&'static Method>,
    /// What an engine binds in place of its own table: bevy, filament and three (128 x 128), unreal (128 x 32); of schlick
    #[arg(long, value_name = "NAME", requires = "dfg", conflicts_with_all = ["size", "axis", "material", "medium"], value_parser = in_any_case(one_of("layout", SplitSumLayout::ENGINES, SplitSumLayout::name)))]
    pub layout: Option<SplitSumLayout>,
    /// Texels of a table, 2 to 16384 [default: 64; a side of --dfg, 2 to 1024: 128]
    #[arg(long, value_name = "N")]
    pub size: Option<usize>,
    /// How cosines are spread: cos, square, sqrt, rational, steep, grazing [default: rational]; with --dfg how cosines and roughness are
    /// spread, COSINE,ROUGHNESS, each of linear, sqrt, fourth-root; one name is for both [default: sqrt]
    #[arg(long, value_name = "NAME")]
    pub axis: Option<String>,
    /// Files: exr-half, exr-float, png8, png16, ktx2, c, rust, js, all [default: exr-half, png16, ktx2]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = in_any_case(one_or_all("format", Format::ALL, Format::name)))]
    pub format: Vec<Choice<Format>>,
    /// Also write one image with one row per material
    #[arg(long)]
    pub atlas: bool,
    /// One table by cos θ and thickness, for the outermost film of the one material: thicknesses from the first row to the last, such as
    /// 0..800nm
    #[arg(long, value_name = "FROM..TO", conflicts_with_all = ["dfg", "atlas", "budget"], value_parser = thicknesses)]
    pub film_thickness: Option<Thicknesses>,
    /// Search size, axis and bit depth: the smallest table whose filtered lookup errs by at most this, among the formats
    /// and axes named [default: all axes; png8, exr-half, png16 and exr-float]
    #[arg(
        long,
        value_name = "ERR",
        conflicts_with = "size",
        allow_negative_numbers = true
    )]
    pub budget: Option<f64>,
    /// Write the function that reads the table, beside it, in these languages: gles, glsl, hlsl, msl, wgsl; all means those
    /// written by default; with --dfg those of the effect image_light [default: none]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = target)]
    pub target: Vec<Choice<&'static Target>>,
    /// Goes before the names of these functions
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// The folder that gets a folder `lut`.
    #[command(flatten)]
    pub tree: TreeFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
    /// No table and no summary on success
    #[arg(long, short)]
    pub quiet: bool,
}

/// Parses a language whose functions read tables, or `all`.
fn target(word: &str) -> Result<Choice<&'static Target>, String> {
    if targets::find(word).is_some_and(|target| target.finish == Finish::Spirv) {
        return Err("a module is not a function that a shader could call; take wgsl, and compile it with your shader".to_owned());
    }
    let text = targets::ALL.iter().copied();
    let text = text.filter(|target| target.finish != Finish::Spirv);
    let parse = one_or_all("target", text, |target| target.name);
    parse(word).map_err(|unknown| unknown.to_string())
}

/// The least range of thicknesses, in nanometres.
const LEAST_RANGE_NM: f64 = 0.1;

/// Parses thicknesses with their unit, such as 0..800nm.
fn thicknesses(word: &str) -> Result<Thicknesses, String> {
    let wanted = || {
        format!(
            "`{word}` is no range of thicknesses; both ends are wanted, with a unit, such as 0..800nm"
        )
    };
    let (from, to) = word.split_once("..").ok_or_else(wanted)?;
    if to.starts_with('.') {
        return Err(wanted());
    }
    let to_nm = length_nm(to).map_err(|fault| fault.to_string())?;
    let unit = to.trim_start_matches(|letter: char| letter.is_ascii_digit() || letter == '.');
    let from_nm = length_nm(from).or_else(|_| length_nm(&format!("{from}{unit}")));
    let from_nm = from_nm.map_err(|fault| fault.to_string())?;
    if to_nm - from_nm >= LEAST_RANGE_NM {
        Ok(Thicknesses { from_nm, to_nm })
    } else {
        Err(format!(
            "`{word}`: the last thickness must be larger than the first, by {LEAST_RANGE_NM} nm at least"
        ))
    }
}

/// Parses a method. Those that are not affine are accepted here, and refused with the reason when they are baked.
fn split_sum_method(word: &str) -> Result<&'static Method, UnknownName> {
    methods::find(word).ok_or_else(|| UnknownName::new("method", word, &split_sum_methods()))
}

impl BakeFlags {
    /// The axis of material tables, where one is named.
    ///
    /// # Errors
    /// There is no such axis.
    pub fn table_axis(&self) -> Result<Option<TableAxis>, UnknownName> {
        let parse = in_any_case(one_of("axis", TableAxis::ALL, TableAxis::name));
        self.axis.as_deref().map(parse).transpose()
    }

    /// The axes of cosine and roughness of a split-sum table.
    ///
    /// # Errors
    /// There is no such axis.
    pub fn split_sum_axes(&self) -> Result<[SplitSumAxis; 2], UnknownName> {
        let parse = in_any_case(one_of("axis", SplitSumAxis::ALL, SplitSumAxis::name));
        let Some(words) = self.axis.as_deref() else {
            return Ok(SPLIT_SUM_AXES);
        };
        let (cosine, roughness) = words.split_once(',').unwrap_or((words, words));
        Ok([parse(cosine)?, parse(roughness)?])
    }
}

/// The formats that a search chooses from where none are named: one for each bit depth.
const SEARCHED_FORMATS: [Format; 4] = [
    Format::Png8,
    Format::ExrHalf,
    Format::Png16,
    Format::ExrFloat,
];

/// Bakes.
pub fn run(flags: &BakeFlags, progress: Progress, announce: Announce) -> Result<Output, Error> {
    if flags.dfg {
        return split_sum(flags, progress, announce);
    }
    let shape = shape(flags)?;
    let viewing = flags.viewing.conditions()?;
    let wanted = Request {
        materials: flags.materials.materials()?,
        medium: flags.medium.source()?,
        viewing: as_tables_are_seen(&viewing, flags.viewing.gamut.is_some()),
        ..Request::default()
    };
    if let Some(thicknesses) = flags.film_thickness {
        return film_table(flags, &wanted, thicknesses, progress, announce);
    }
    let (subjects, left_out) = table_materials(&wanted)?;
    check_names(&subjects, flags.atlas)?;
    let request = BakeRequest {
        typed: if flags.materials.choices().eq([&Choice::All]) {
            vec!["all".to_owned()]
        } else {
            material_words(&subjects)
        },
        flags: viewing_flags(&subjects, &wanted.viewing),
        subjects,
        formats: formats(flags),
        shape,
        atlas: flags.atlas,
        targets: targets(&flags.target),
        prefix: flags.prefix.clone(),
    };
    try_places(flags.report.json(), None)?;
    let baked = bake(&request, progress)?;
    let command = request.command_line();
    finished(flags, command, baked, Vec::new(), &left_out, announce)
}

/// The most texels of a row of a table by thickness: its error is sought between them too.
const MOST_FILM_TEXELS: usize = 8192;

/// Bakes one table by thickness.
fn film_table(
    flags: &BakeFlags,
    wanted: &Request,
    thicknesses: Thicknesses,
    progress: Progress,
    announce: Announce,
) -> Result<Output, Error> {
    if let Some(size) = flags.size.filter(|size| *size > MOST_FILM_TEXELS) {
        return Err(RequestFault::OutOfRange {
            flag: "size",
            value: size.to_string(),
            allowed: format!("is at most {MOST_FILM_TEXELS} with --film-thickness"),
        }
        .into());
    }
    let subjects = wanted.subjects()?.materials();
    let one = match subjects.as_slice() {
        [one] if one.has_films() => one,
        _ => {
            return Err(Error::usage(
                "--film-thickness takes one material with a film, whose thickness it replaces: --material titanium --film titanium_dioxide:60nm",
            ));
        }
    };
    let of = |material: &Material| {
        TableMaterial::new(
            (&one.argument, material),
            one.medium.as_ref(),
            &wanted.viewing,
        )
    };
    let at = |half: usize| {
        let mut material = one.material.clone();
        // A film of no thickness would be integrated in wider steps than all others.
        material.films[0].thickness_nm = thicknesses.at(half as f64 / 2.0).max(1e-6);
        of(&material)
    };
    let halves = (0..2 * THICKNESS_ROWS - 1).map(at);
    let halves = halves.collect::<Result<Vec<_>, _>>()?;
    let subject = vec![of(&one.material)?];
    let request = FilmTableRequest {
        thicknesses,
        halves,
        own: BakeRequest {
            typed: material_words(&subject),
            flags: viewing_flags(&subject, &wanted.viewing),
            subjects: subject,
            formats: formats(flags),
            shape: shape(flags)?,
            atlas: false,
            targets: targets(&flags.target),
            prefix: flags.prefix.clone(),
        },
    };
    try_places(flags.report.json(), None)?;
    let baked = bake_film_thickness(&request, progress)?;
    let command = request.command_line();
    finished(flags, command, vec![baked], Vec::new(), &[], announce)
}

/// Bakes the split-sum table of a method.
fn split_sum(flags: &BakeFlags, progress: Progress, announce: Announce) -> Result<Output, Error> {
    let layout = flags.layout.unwrap_or(SplitSumLayout::Terms);
    let request = SplitSumRequest {
        method: flags.method.unwrap_or(usual_method(layout)),
        layout,
        size: flags.size.unwrap_or(SPLIT_SUM_SIZE),
        axes: flags.split_sum_axes()?,
        formats: if flags.format.is_empty() {
            Vec::new()
        } else {
            formats(flags)
        },
    };
    let targets = targets(&flags.target);
    if let Some(why) = request.without_functions().filter(|_| !targets.is_empty()) {
        return Err(Error::usage(why));
    }
    try_places(flags.report.json(), None)?;
    let baked = bake_split_sum(&request, progress)?;
    let command = request
        .command_line()
        .list("target", targets.iter().map(|target| target.name))
        .list("prefix", Naming::flag_of_prefix(&flags.prefix));
    let functions = match targets.is_empty() {
        true => Vec::new(),
        false => {
            let of = |effects, methods| Request {
                targets: targets.clone(),
                effects,
                methods,
                materials: Materials::None,
                prefix: flags.prefix.clone(),
                ..Request::default()
            };
            // The effect reads the table; the method has F for lamps, and its mean.
            let effect = of(vec![Effect::IMAGE_LIGHT], Methods::Default);
            let method = of(Vec::new(), Methods::These(vec![request.method]));
            let files = [generate(&effect)?.artifacts, generate(&method)?.artifacts];
            files.concat()
        }
    };
    finished(flags, command, vec![baked], functions, &[], announce)
}

/// Writes the baked files and reports on them.
fn finished(
    flags: &BakeFlags,
    command: CommandLine,
    baked: Vec<Baked>,
    functions: Vec<Artifact>,
    left_out: &[String],
    announce: Announce,
) -> Result<Output, Error> {
    let out_dir = folder_or_current(&flags.tree.out_dir);
    let rows: Vec<BakeRow> = baked.iter().flat_map(|one| one.rows.clone()).collect();
    let tables = baked.into_iter().flat_map(artifacts);
    let files: Vec<Artifact> = tables.chain(functions).collect();
    let mut lock = Lock::take(out_dir, announce);
    let plan = plan(out_dir, &files, &Scope::default(), &provenance(Vec::new()))?;
    refuse_within_tree(&plan, flags.report.json())?;
    let text = if flags.quiet {
        String::new()
    } else {
        bake_text(&rows)
    };
    let (mut output, json) = reported(text, &Report::new(command, rows), flags.report.json());
    let written = write(&plan, json.as_slice(), flags.tree.overwrite, &mut lock)?;
    output
        .remarks
        .extend(named(&plan, flags.tree.overwrite, "replaced"));
    if flags.quiet {
        return Ok(output);
    }
    let left_out = left_out.iter();
    let remarks = left_out.map(|why| format!("left out: {}", foreign::one_line(why)));
    output.remarks.extend(remarks);
    output.remarks.push(format!(
        "{}: {} written, {} unchanged",
        foreign::path(&out_dir),
        written.written,
        written.unchanged
    ));
    Ok(output)
}

fn shape(flags: &BakeFlags) -> Result<TableSize, Error> {
    let axis = flags.table_axis()?;
    match flags.budget {
        None => {
            let texels = flags.size.unwrap_or(TEXELS);
            check_size(texels)?;
            Ok(TableSize::Fixed {
                axis: axis.unwrap_or(DEFAULT_AXIS),
                texels,
            })
        }
        Some(budget) if budget > 0.0 && budget.is_finite() => Ok(TableSize::Within {
            budget,
            axes: axis.map_or(TableAxis::ALL.to_vec(), |axis| vec![axis]),
        }),
        Some(budget) => Err(RequestFault::OutOfRange {
            flag: "budget",
            value: budget.to_string(),
            allowed: "is an error of reflectance, above 0, such as 0.001".to_owned(),
        }
        .into()),
    }
}

/// The formats in the list's order, each once.
fn formats(flags: &BakeFlags) -> Vec<Format> {
    match (flags.format.is_empty(), flags.budget) {
        (true, Some(_)) => SEARCHED_FORMATS.to_vec(),
        (true, None) => DEFAULT_FORMATS.to_vec(),
        (false, _) => Choice::chosen(&flags.format, Format::ALL, |format| format.name()),
    }
}

/// The languages that get functions, each once; `all` means those that are written by default.
fn targets(words: &[Choice<&'static Target>]) -> Vec<&'static Target> {
    let is_text = |target: &&Target| target.finish != Finish::Spirv;
    let is_chosen = |target: &&Target| {
        words.iter().any(|word| match word {
            Choice::One(name, _) => name == target.name,
            Choice::All | Choice::None => target.by_default,
        })
    };
    let text = targets::ALL.iter().copied().filter(is_text);
    text.filter(is_chosen).collect()
}

/// Checks that there is something to bake, and that no material has the name of another table.
fn check_names(subjects: &[TableMaterial], atlas: bool) -> Result<(), Error> {
    if subjects.is_empty() {
        let why = "`--material none` leaves nothing to bake; name materials, or all";
        return Err(Error::usage(why));
    }
    for TableMaterial { name, .. } in subjects {
        let meaning = match name.as_str() {
            ATLAS if atlas => "the picture of all",
            name if name.starts_with("dfg_") => "a table of `bake --dfg`",
            _ => continue,
        };
        let name = name.clone();
        return Err(RequestFault::NameTaken { name, meaning }.into());
    }
    Ok(())
}

/// A line for each row.
fn bake_text(rows: &[BakeRow]) -> String {
    let cells = |row: &BakeRow| {
        let (name, format, texels, axis, file) = match row {
            BakeRow::Table(row) => (&row.name, row.format, row.texels, row.axis, &row.file),
            BakeRow::SplitSum(row) => (&row.name, row.format, row.texels, &*row.axis, &row.file),
            BakeRow::Film(row) => (&row.name, row.format, row.texels, row.axis, &row.file),
        };
        let file = match row {
            BakeRow::SplitSum(row) => row.files(),
            BakeRow::Table(_) | BakeRow::Film(_) => file.clone(),
        };
        let (scale, max_abs, mean_rel) = match row {
            BakeRow::Table(row) => (row.scale, row.max_abs, row.mean_rel),
            BakeRow::SplitSum(row) => (row.scale, row.max_abs, row.mean_rel),
            BakeRow::Film(row) => (row.scale, row.max_abs, None),
        };
        vec![
            name.clone(),
            format.to_owned(),
            texels.to_string(),
            axis.to_owned(),
            file,
            format!("{scale:?}"),
            format!("{max_abs:.6}"),
            mean_rel.map_or("none".to_owned(), |mean| format!("{:.4}", 100.0 * mean)),
        ]
    };
    let head = [
        "name",
        "format",
        "texels",
        "axis",
        "file",
        "scale",
        "max error",
        "mean error, %",
    ];
    table::text_table(&head, &rows.iter().map(cells).collect::<Vec<_>>())
}
