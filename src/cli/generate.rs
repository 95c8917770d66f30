//! `fresnel-gen` without a subcommand: generates, checks or lists files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::choice::{
    Choice, PrecisionFlags, effect_or_all, flavour, gpu, method_or_all, one_of, target_or_all,
};
use crate::cli::flags::material::{MaterialFlags, MediumFlags};
use crate::cli::flags::output::{TreeFlags, file_only};
use crate::cli::flags::viewing::GamutFlags;
use crate::cli::method_remarks::{budget_remarks, unsuited};
use crate::cli::output::Output;
use crate::cli::places::{folder_or_current, refuse_read, refuse_within_tree};
use crate::cli::plan_file::{self, material_paths, planned};
use crate::generator::bake::as_tables_are_seen;
use crate::generator::emit::{Artifact, HeaderForm};
use crate::generator::error::RequestFault;
use crate::generator::flavours::Flavour;
use crate::generator::generate::catalogue::add_catalogue;
use crate::generator::generate::tables::add_tables;
use crate::generator::generate::{Generated, KeptMethods, generate_beside, generate_single, kept};
use crate::generator::output::depfile;
use crate::generator::output::lock::{Announce, Lock};
use crate::generator::output::manifest::Manifest;
use crate::generator::output::tree::{self, TreePlan, plan};
use crate::generator::output::write::{OutputFile, write, write_outputs};
use crate::generator::request::{Materials, Methods, Request};
use crate::lab::budget::{Budget, BudgetRow, choose_within};
use crate::lab::cost;
use crate::language::effects::Effect;
use crate::language::methods::{self, Gpu, Method};
use crate::language::targets::{self, Target};
use crate::physics::foreign::{self, Foreign, one_line};

/// The flags of generation.
#[derive(Args, Debug)]
#[command(mut_arg("material", |arg| arg.help("Material to specialise to: names, paths of material files, all; or none [default: gold, platinum, water, diamond; none with -o or --effect]")))]
pub struct GenerateFlags {
    /// Output language, see `fresnel-gen targets`; all means those written by default [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = target_or_all())]
    pub target: Vec<Choice<&'static Target>>,
    /// Method, see `fresnel-gen methods` [default: all; for a material: exact, fitted, two Schlick variants and table, with -o exact alone]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Effect, see `fresnel-gen effects`, or all: write its functions and nothing else, with R by --method, specialised to --material [default: all where nothing is named]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = effect_or_all(), conflicts_with = "budget")]
    pub effect: Vec<Choice<&'static Effect>>,
    /// Engine or renderer: write an adapter for it and nothing else, in its own folder; --target beside it writes that too
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = flavour(), conflicts_with_all = ["budget", "plan", "output"])]
    pub flavour: Vec<&'static Flavour>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// What functions compute in.
    #[command(flatten)]
    pub precision: PrecisionFlags,
    /// Degrees at which the corrected Schlick meets the exact law [default: that of cosine 0.15, 81.373]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub matching_angle: Option<f64>,
    /// Goes before every function's name
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// Comments of generated files: short (what a function is, its largest error, its cost, its source, and warnings; the rest stands in manifest.json) or full
    #[arg(long, value_name = "FORM", default_value = "short", value_parser = one_of("form of comments", HeaderForm::ALL, HeaderForm::name))]
    pub header: HeaderForm,
    /// Write one function per material: the cheapest whose largest error over angles and channels is at most this
    #[arg(long, value_name = "ERR", allow_negative_numbers = true)]
    pub budget: Option<f64>,
    /// Write the catalogue of these materials, in this order, in place of a function for each: coefficients as constants, buffer, textures and JSON, and the functions that take them
    #[arg(long, requires = "material", conflicts_with_all = ["method", "effect", "flavour", "film", "plan", "budget", "output", "matching_angle"])]
    pub catalogue: bool,
    /// GPU that functions are written for, and whose recorded costs --budget compares: a family as for `cost` (rdna2, adreno330 ...), desktop or phones [default: phones for gles, desktop for other targets; for --budget rdna2]
    #[arg(long, value_name = "NAME", value_parser = gpu())]
    pub gpu: Option<Gpu>,
    /// Write exactly the functions of this plan, which `fresnel-gen plan --json FILE` made
    #[arg(long, value_name = "FILE", value_parser = file_only("--plan"), conflicts_with_all = ["method", "effect", "material", "film", "medium", "matching_angle", "precision", "force", "budget", "space", "illuminant", "observer", "adaptation", "step", "wavelengths", "extrapolate", "gamut"])]
    pub plan: Option<PathBuf>,
    /// A material file that the plan may name though it lies outside of the plan's folder, or a folder of such files
    #[arg(long, value_name = "PATH", requires = "plan")]
    pub allow: Vec<PathBuf>,
    /// The folder for the generated tree.
    #[command(flatten)]
    pub tree: TreeFlags,
    /// Write the functions asked for into this one file and nothing else, or to stdout (`-`); one target [default: by the file's ending; wgsl for `-`]
    #[arg(short = 'o', value_name = "FILE", conflicts_with_all = ["check", "list", "out_dir"])]
    pub output: Option<PathBuf>,
    /// Write nothing: compare with the folder, print a diff, exit 1 where it differs
    #[arg(long, conflicts_with_all = ["list", "depfile"])]
    pub check: bool,
    /// Write the run's outputs and inputs as a Makefile rule
    #[arg(long, value_name = "FILE", value_parser = file_only("--depfile"), conflicts_with = "list")]
    pub depfile: Option<PathBuf>,
    /// What the rule of --depfile is for, as the build system names it [default: the file of -o, or all files of the folder]
    #[arg(long, value_name = "FILE", value_parser = file_only("--depfile-target"), requires = "depfile")]
    pub depfile_target: Option<PathBuf>,
    /// Print the names of the files that would be written, and write nothing
    #[arg(long)]
    pub list: bool,
    /// No summary on success
    #[arg(long, short)]
    pub quiet: bool,
}

/// Generates. `announce` gets what a person should know before the run ends.
pub fn run(flags: &GenerateFlags, announce: Announce) -> Result<Output, Error> {
    let request = request(flags)?;
    let (request, said) = match &flags.plan {
        Some(file) => {
            let plan = plan_file::read(file)?;
            let outputs = flags.output.iter().chain(&flags.depfile);
            let paths = material_paths(&plan).map(Path::new);
            refuse_read(paths, outputs.map(PathBuf::as_path))?;
            (planned(file, &plan, &flags.allow, request)?, Vec::new())
        }
        None => chosen(flags, request)?,
    };
    let unsuited = if flags.quiet {
        Vec::new()
    } else {
        unsuited(&request)?
    };
    let mut output = match &flags.output {
        Some(file) => single(flags, &request, file)?,
        None => tree(flags, &request, announce)?,
    };
    let said = said.into_iter().filter(|_| !flags.quiet);
    output.remarks = said.chain(unsuited).chain(output.remarks).collect();
    Ok(output)
}

/// Lists, compares or writes the tree of files.
fn tree(flags: &GenerateFlags, request: &Request, announce: Announce) -> Result<Output, Error> {
    let out_dir = folder_or_current(&flags.tree.out_dir);
    let changes_nothing = flags.check || flags.list;
    let mut lock = (!changes_nothing).then(|| Lock::take(out_dir, announce));
    // Only a run that names methods adds to the methods of a material's file.
    let kept = if flags.method.is_empty() && request.chosen.is_empty() {
        KeptMethods::new()
    } else {
        let manifest = Manifest::in_folder(out_dir)?;
        manifest.map_or_else(KeptMethods::new, |(manifest, _)| {
            kept(&manifest, request.precision)
        })
    };
    if request.catalogue {
        refuse_stale_arrays(request, out_dir)?;
    }
    let mut generated = generate_beside(request, &kept)?;
    if request.selects_nothing() {
        add_catalogue(&mut generated, request)?;
    }
    if generated.scope.whole {
        let viewing = as_tables_are_seen(&request.viewing, flags.viewing.gamut.is_some());
        let request = Request {
            viewing,
            ..request.clone()
        };
        add_tables(&mut generated, &request)?;
    }
    if flags.list {
        let paths = generated.artifacts.iter();
        let names: String = paths.map(|one| one.path.clone() + "\n").collect();
        return Ok(Output {
            stdout: names.into_bytes(),
            ..Output::default()
        });
    }
    let plan = plan(
        out_dir,
        &generated.artifacts,
        &generated.scope,
        &generated.provenance,
    )?;
    match &mut lock {
        Some(lock) => written(flags, request, &generated, &plan, lock),
        None => Ok(checked(flags, &plan)),
    }
}

/// Refuses to leave arrays of a catalogue beside the buffer of another one: those of languages that this run does not write.
fn refuse_stale_arrays(request: &Request, out_dir: &Path) -> Result<(), Error> {
    let Some((manifest, _)) = Manifest::in_folder(out_dir)? else {
        return Ok(());
    };
    let targets = request.targets_or_default();
    let is_written = |name: &str| targets.iter().any(|target| target.name == name);
    let is_array = |file: &str| {
        file.split('/')
            .nth(1)
            .is_some_and(|name| name.starts_with("catalogue."))
    };
    let mut stale = manifest.files.iter();
    match stale.find(|entry| is_array(&entry.file) && !is_written(&entry.target)) {
        None => Ok(()),
        Some(entry) => {
            let (file, target) = (Foreign(&entry.file), Foreign(&entry.target));
            let folder = foreign::path(&out_dir);
            let why = format!(
                "{folder} holds {file}, whose rows would not be those of the new buffer: name {target} with --target too, or another folder with --out-dir"
            );
            Err(RequestFault::refused(why).into())
        }
    }
}

/// The request with the methods that a budget chooses, where one is given, and the remarks on the choice.
fn chosen(flags: &GenerateFlags, request: Request) -> Result<(Request, Vec<String>), Error> {
    let Some(most) = flags.budget else {
        return Ok((request, Vec::new()));
    };
    let gpu = flags.gpu.map_or(USUAL_GPU, Gpu::name);
    let Some(family) = cost::find(gpu) else {
        let why = format!(
            "--budget compares costs on one family of GPUs, and {gpu} are several; name one with --gpu"
        );
        return Err(Error::usage(why));
    };
    let budget = Budget::new(most, family)?;
    if request.precision.is_half() {
        let why = "--budget is of functions in single precision; leave --precision f16 out";
        return Err(Error::usage(why));
    }
    if request.materials == Materials::None {
        let why = "--budget chooses for materials; `none` leaves none to choose for";
        return Err(Error::usage(why));
    }
    within(budget, request)
}

/// The request with one method for each material.
fn within(budget: Budget, request: Request) -> Result<(Request, Vec<String>), Error> {
    // A run with a budget names its materials, so it includes no catalogue and no tables.
    let materials = match request.materials {
        Materials::Default => Materials::These(Materials::Default.sources()),
        named => named,
    };
    let request = Request {
        materials,
        ..request
    };
    let subjects = request.subjects()?.materials();
    let named = request.methods.named();
    let methods = named.unwrap_or_else(|| methods::ALL.to_vec());
    let rows = choose_within(budget, methods, &subjects, &request.viewing)?;
    let chosen = |row: &BudgetRow| (row.material.clone(), row.choice.chosen.method);
    let request = Request {
        chosen: rows.iter().map(chosen).collect(),
        methods: Methods::Default,
        ..request
    };
    Ok((request, rows.iter().flat_map(budget_remarks).collect()))
}

/// The GPU family whose costs decide where none is named.
const USUAL_GPU: &str = "rdna2";

fn request(flags: &GenerateFlags) -> Result<Request, Error> {
    Ok(Request {
        targets: requested_targets(&flags.target, flags.output.as_deref())?,
        methods: Choice::requested(&flags.method),
        effects: Choice::effects(&flags.effect),
        flavours: flags.flavour.clone(),
        materials: flags.materials.materials()?,
        medium: flags.medium.source()?,
        prefix: flags.prefix.clone(),
        matching_angle: flags.matching_angle,
        precision: flags.precision.precision(),
        gpu: flags.gpu,
        force: flags.precision.force,
        chosen: BTreeMap::new(),
        viewing: flags.viewing.conditions()?,
        header: flags.header,
        tables: false,
        catalogue: flags.catalogue,
    })
}

/// The targets of a request: those of `--target`, or the one of the file's extension. Empty where neither names one.
///
/// # Errors
/// No language's files have this extension, or the extension is of another language than `--target`.
fn requested_targets(
    words: &[Choice<&'static Target>],
    file: Option<&Path>,
) -> Result<Vec<&'static Target>, Error> {
    let named = Choice::targets(words);
    let Some(file) = file.filter(|file| *file != Path::new("-")) else {
        return Ok(named);
    };
    let ending = file.extension().and_then(|ending| ending.to_str());
    let ending = ending.map(str::to_lowercase);
    let of_ending = of_ending(ending.as_deref().unwrap_or_default());
    // If two languages share the extension, the default one.
    let usual = of_ending.iter().find(|target| target.by_default);
    match (usual.or(of_ending.first()), words) {
        (Some(first), []) => Ok(vec![*first]),
        (None, []) if ending.is_some() => Err(no_language(file).into()),
        (Some(first), [Choice::One(one, _)]) if of_ending.iter().all(|it| it.name != one) => {
            let (file, language) = (foreign::path(&file), first.name);
            let why = format!("`{file}` ends as a file of {language}, and --target is {one}");
            Err(Error::usage(why))
        }
        _ => Ok(named),
    }
}

/// The targets whose files have this extension.
fn of_ending(ending: &str) -> Vec<&'static Target> {
    let all = targets::ALL.iter().copied();
    all.filter(|target| target.endings().any(|one| one == ending))
        .collect()
}

fn no_language(file: &Path) -> RequestFault {
    let endings: BTreeSet<&str> = targets::ALL.iter().flat_map(|it| it.endings()).collect();
    let endings: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
    RequestFault::refused(format!(
        "`{}` says no language by its ending; name one with --target, or end the file in {}",
        foreign::path(&file),
        endings.join(", ")
    ))
}

fn single(flags: &GenerateFlags, request: &Request, file: &Path) -> Result<Output, Error> {
    let bytes = generate_single(request)?;
    let mut files = depfile(flags, request, &[file.display().to_string()])?;
    if file != Path::new("-") {
        files.push(OutputFile::named(file, bytes));
        write_outputs(&files)?;
        return Ok(Output::default());
    }
    write_outputs(&files)?;
    Ok(Output {
        stdout: bytes,
        is_file: true,
        ..Output::default()
    })
}

fn checked(flags: &GenerateFlags, plan: &TreePlan) -> Output {
    let (text, drift) = tree::report(plan);
    let mut output = Output {
        stdout: text.into_bytes(),
        code: u8::from(drift),
        ..Output::default()
    };
    output.remarks = named(plan, flags.tree.overwrite, "to be replaced");
    if drift && !flags.quiet {
        output.remarks.push(
            "the folder differs from what this run would write; run without --check to write it"
                .into(),
        );
    }
    output
}

/// Remarks on files that stay, or that are not as this program left them.
pub(super) fn named(plan: &TreePlan, overwrite: bool, replaced: &str) -> Vec<String> {
    let kept = plan.kept.iter();
    let kept = kept.map(|kept| format!("left alone: {}: {}", Foreign(&kept.path), kept.why));
    let edited = plan.edited.iter();
    let edited = edited.map(Foreign).map(|path| {
        format!(
            "{replaced}: {path}, which was changed since fresnel-gen wrote it, or is in no manifest"
        )
    });
    let obstacles = plan.obstacles.iter().map(|obstacle| {
        if overwrite {
            format!(
                "{replaced}: {}, which fresnel-gen did not write",
                Foreign(&obstacle.path)
            )
        } else {
            format!(
                "{}: fresnel-gen did not write it; a run replaces it only with --overwrite",
                Foreign(&obstacle.path)
            )
        }
    });
    let remarks = plan.remarks.iter().cloned();
    kept.chain(edited).chain(obstacles).chain(remarks).collect()
}

fn written(
    flags: &GenerateFlags,
    request: &Request,
    generated: &Generated,
    plan: &TreePlan,
    lock: &mut Lock,
) -> Result<Output, Error> {
    let out_dir = &plan.out_dir;
    // Material files first: the output that a build names is one of these, if there are any.
    let (of_materials, others): (Vec<&Artifact>, Vec<&Artifact>) = generated
        .artifacts
        .iter()
        .partition(|artifact| artifact.material.is_some());
    let outputs: Vec<String> = of_materials
        .into_iter()
        .chain(others)
        .map(|artifact| out_dir.join(&artifact.path).display().to_string())
        .collect();
    refuse_within_tree(plan, flags.depfile.as_deref())?;
    let depfile = depfile(flags, request, &outputs)?;
    let counts = write(plan, &depfile, flags.tree.overwrite, lock)?;
    let mut output = Output::default();
    if !flags.quiet {
        let unseen = generated.left_out.iter().map(|fault| fault.why.as_str());
        let left_out = unseen.chain(generated.refused.iter().map(String::as_str));
        let left_out = left_out.map(|why| format!("left out: {}", one_line(why)));
        let removed = plan.orphans.iter().map(|orphan| Foreign(&orphan.file));
        let removed = removed.map(|file| format!("removed: {file}, which is no longer generated"));
        output.remarks.extend(left_out.chain(removed));
    }
    output
        .remarks
        .extend(named(plan, flags.tree.overwrite, "replaced"));
    if !flags.quiet {
        let folder = foreign::path(&out_dir);
        output.remarks.push(format!(
            "{folder}: {} written, {} unchanged, {} removed",
            counts.written, counts.unchanged, counts.removed
        ));
        if plan.manifest.old.is_none() {
            output
                .remarks
                .extend(first_steps(flags, generated, out_dir));
        }
    }
    Ok(output)
}

/// After the first run in a folder: the next steps with adapters, and with one of the functions.
fn first_steps(flags: &GenerateFlags, generated: &Generated, out_dir: &Path) -> Vec<String> {
    let artifacts = generated.artifacts.iter();
    let pages = artifacts.filter(|artifact| artifact.path.ends_with("/README.md"));
    let pages = pages.map(|page| {
        let page = out_dir.join(&page.path);
        format!(
            "next: {} says how the host takes the files, with an example",
            foreign::path(&page)
        )
    });
    // An adapter's folder holds no functions for `verify`.
    let is_of_functions = flags.flavour.is_empty() || !flags.target.is_empty();
    let functions = is_of_functions.then(|| first_function(flags, generated, out_dir));
    pages.chain(functions.into_iter().flatten()).collect()
}

/// One of the functions, and the next step with it.
fn first_function<'g>(
    flags: &GenerateFlags,
    generated: &'g Generated,
    out_dir: &Path,
) -> Vec<String> {
    let first = |artifact: &'g Artifact| Some((artifact, artifact.detail.functions().first()?));
    let mut functions = generated.artifacts.iter().filter_map(first);
    let of_material = functions
        .clone()
        .find(|(artifact, _)| artifact.material.is_some());
    let Some((artifact, function)) = of_material.or_else(|| functions.next()) else {
        return Vec::new();
    };
    let file = out_dir.join(&artifact.path);
    let next = if flags.catalogue {
        "next: element 4 i + j of a catalogue's buffer, or texel (j, i) of its texture, is c_j of the material i, counted from 0; the fourth number of c_0 is 1 where fitted takes it, 2 where fitted_dielectric does; for image light `fresnel-gen bake --dfg --method fitted` and `--method fitted_dielectric`, a table for each".to_owned()
    } else {
        next_step(flags)
    };
    vec![
        format!(
            "for example {}: {}",
            foreign::path(&file),
            function.signature
        ),
        next,
    ]
}

/// The command that runs the functions. Flags that chose them, or that set the header's form, are no flags of `verify`.
fn next_step(flags: &GenerateFlags) -> String {
    let is_chosen = flags.plan.is_some() || flags.budget.is_some();
    let run = if is_chosen {
        "with its --target, --material and --method"
    } else if flags.header != HeaderForm::default() {
        "with the same flags, but without --header,"
    } else {
        "with the same flags"
    };
    format!("next: use it; `fresnel-gen verify` {run} runs it on this machine")
}

/// The depfile, where one is requested. Its rule has these outputs, unless the build system names another target.
fn depfile(
    flags: &GenerateFlags,
    request: &Request,
    outputs: &[String],
) -> Result<Vec<OutputFile>, Error> {
    let Some(file) = &flags.depfile else {
        return Ok(Vec::new());
    };
    let named = flags.depfile_target.iter();
    let named: Vec<String> = named.map(|file| file.display().to_string()).collect();
    let outputs = if named.is_empty() { outputs } else { &named };
    if outputs == ["-"] {
        let why = "--depfile with `-o -` has no file that its rule is for; name one with --depfile-target";
        return Err(Error::usage(why));
    }
    let paths = flags.materials.paths().chain(flags.medium.path());
    let paths = paths.chain(flags.viewing.viewing.path());
    let mut inputs: Vec<String> = paths.map(str::to_owned).collect();
    if let Some(plan) = &flags.plan {
        inputs.push(plan.display().to_string());
        for source in request.materials.sources() {
            inputs.extend(source.files().into_iter().map(str::to_owned));
        }
    }
    if let Some(own) = outputs.iter().find(|output| inputs.contains(output)) {
        let why = format!("--depfile-target {own} is a file that the run reads");
        return Err(Error::usage(why));
    }
    inputs.extend(depfile::own_program());
    let rule = depfile::depfile(outputs, &inputs)?;
    Ok(vec![OutputFile::named(file, rule)])
}
