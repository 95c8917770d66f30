//! The tables of the README, written from the registries so that they cannot drift.

use crate::fits::promises_by_class;
use fresnel_gen::generator::emit::{Bounds, FunctionForm, Naming, specialised_function};
use fresnel_gen::generator::flavours;
use fresnel_gen::generator::reference::{Derivation, MaterialInMedium};
use fresnel_gen::lab::cost::{self, FunctionId};
use fresnel_gen::language::methods::{self, Class, Contract, Method, Origin, Spread};
use fresnel_gen::language::{effects, targets};
use fresnel_gen::physics::materials::{Material, SurfaceError, ViewingConditions};
use fresnel_gen::physics::num::Precision;

/// The effects with their functions; `...` stands for what the method of R takes.
pub fn effects_table() -> String {
    let record = cost::records("rdna2");
    let usual = methods::find(effects::USUAL_METHOD).expect("it is a method");
    let mut rows = Vec::new();
    for effect in effects::ALL {
        let mut shown = format!("`{}`", effect.name);
        for function in effect.functions {
            let arguments = function.arguments.iter().map(|one| one.name);
            let more = function.reflectance.is_used().then_some("...");
            let arguments: Vec<&str> = arguments.chain(more).collect();
            let id = |channels| FunctionId {
                effect: Some(function.name),
                method: function.reflectance.is_used().then_some(usual),
                channels,
                ..FunctionId::library(usual, FunctionForm::Library, Precision::F32)
            };
            let figures = record.of(&id(3)).or_else(|| record.of(&id(1)));
            rows.push(vec![
                std::mem::take(&mut shown),
                format!("`{}({})`", function.name, arguments.join(", ")),
                function.gives.to_owned(),
                figures.map_or("?".to_owned(), |figures| format!("{:.0}", figures.cost())),
            ]);
        }
    }
    let columns = ["effect", "function", "gives", "cost on RDNA 2"];
    markdown_table(&columns, rows.into_iter())
}

/// The flavours: what each is for, its files as gold has them, and what was seen of it.
pub fn flavours_table() -> String {
    let rows = flavours::ALL.iter().map(|flavour| {
        let shared = flavour.shared_pages().map(|(name, _, _)| name);
        let own = flavour.pages.iter().filter(|page| page.is_of_material());
        let names = shared.chain(own.map(|page| page.file_of("gold")));
        let files: Vec<String> = names
            .filter(|name| name != "README.md")
            .map(|name| format!("`{name}`"))
            .collect();
        vec![
            format!("`{}`", flavour.name),
            format!("[{}]({})", flavour.host, flavour.source),
            flavour.summary.to_owned(),
            files.join(", "),
            flavour.proof.to_owned(),
        ]
    });
    markdown_table(&["flavour", "host", "what it is", "files", "proved"], rows)
}

/// Every method: what it takes, its cost in scalar operations for three channels, what it promises.
pub fn methods_table() -> String {
    let rows = methods::ALL.iter().map(|method| {
        let inputs: Vec<&str> = method.inputs.iter().map(|input| input.name).collect();
        let work = method.function(false).map_or(0, |function| function.work());
        let exempt = if method.contract == Contract::Kept {
            ""
        } else {
            " (exempt)"
        };
        vec![
            format!("`{}`{exempt}", method.name),
            method.summary.to_owned(),
            inputs.join(", "),
            work.to_string(),
            code_cell(method),
            source_cell(method),
        ]
    });
    markdown_table(
        &[
            "method",
            "what it is",
            "takes",
            "operations",
            "code error, ulp",
            "source",
        ],
        rows,
    )
}

fn source_cell(method: &Method) -> String {
    let source = format!("{} {}", method.source.authors, method.source.year);
    match method.origin {
        Origin::Published => source,
        Origin::Adapted(what) => format!("{source}; {what}"),
        Origin::Ours(of) => format!("fresnel-gen; {of}: {source}"),
    }
}

/// Model error of every method on these materials in air, as they are seen by default: largest absolute, and mean
/// relative in per cent.
///
/// # Errors
/// A material was not measured over the whole visible spectrum.
pub fn errors_table(materials: Vec<Material>) -> Result<String, SurfaceError> {
    let subject = |material: Material| {
        let typed = (material.name.clone(), material);
        MaterialInMedium::new(
            typed,
            None,
            &ViewingConditions::default(),
            Derivation::default(),
        )
    };
    let subjects: Vec<MaterialInMedium> = materials
        .into_iter()
        .map(subject)
        .collect::<Result<_, _>>()?;
    let mut head = vec!["method"];
    head.extend(subjects.iter().map(|subject| subject.name.as_str()));
    let rows = methods::ALL
        .iter()
        .filter(|method| method.contract == Contract::Kept)
        .map(|method| {
            let errors = subjects.iter().map(|subject| error_cell(method, subject));
            [format!("`{}`", method.name)]
                .into_iter()
                .chain(errors)
                .collect()
        });
    Ok(markdown_table(&head, rows))
}

/// What fitted methods promise of classes of materials.
pub fn classes_table() -> String {
    let spread = |spread: Spread| format!("{}, {}", spread.median, spread.percentile_90);
    let rows = promises_by_class().map(|(method, row)| {
        vec![
            format!("`{}`", method.name),
            format!("{}s", row.class),
            spread(row.catalogue),
            spread(row.outside),
            row.limit.to_string(),
        ]
    });
    markdown_table(
        &[
            "method",
            "class",
            "catalogue: median, 90th percentile",
            "pages outside it",
            "nine of ten of both",
        ],
        rows,
    )
}

/// Every target.
pub fn targets_table() -> String {
    let rows = targets::ALL.iter().map(|target| {
        let validators: Vec<&str> = target
            .validators
            .iter()
            .map(|validator| validator.name)
            .collect();
        let by_default = if target.by_default { "yes" } else { "by name" };
        vec![
            format!("`{}`", target.name),
            target.summary.to_owned(),
            by_default.to_owned(),
            validators.join(", "),
        ]
    });
    markdown_table(
        &[
            "target",
            "what it is",
            "written by default",
            "compilers that can judge it",
        ],
        rows,
    )
}

/// A line of the record of bounds in half precision.
#[derive(serde::Deserialize)]
struct HalfBound {
    material: String,
    method: String,
    max_abs: f64,
}

/// Half precision: what each method promises, and the largest error of its specialised functions over the catalogue.
pub fn half_table() -> String {
    let record = include_str!("../../../data/code-bounds-f16.csv");
    let bounds: Vec<HalfBound> = fresnel_gen::physics::records::rows(record);
    let worst = |method: &Method| {
        let rows = bounds.iter().filter(|row| row.method == method.name);
        let largest = rows.max_by(|a, b| a.max_abs.total_cmp(&b.max_abs));
        largest.map_or("not written".to_owned(), |row| {
            format!("{:.5} ({})", row.max_abs, row.material)
        })
    };
    let library = |method: &Method| match method.half.claim() {
        Some(claim) => claim.max_abs.to_string(),
        None => format!(
            "refused: {}",
            method.half.library_refusal().unwrap_or_default()
        ),
    };
    let rows = methods::ALL
        .iter()
        .map(|method| vec![format!("`{}`", method.name), library(method), worst(method)]);
    markdown_table(
        &[
            "method",
            "library function",
            "worst material of the catalogue",
        ],
        rows,
    )
}

/// A bound in ulp, or that the method stays within the absolute one; of what reads a texture its sampler's.
fn code_cell(method: &Method) -> String {
    let ulp = method.claims.code_ulp;
    if method.is_textured() {
        "the sampler's: 1/256 of the difference of two neighbouring texels".to_owned()
    } else if ulp > 0.0 {
        ulp.to_string()
    } else {
        "within 2⁻²²".to_owned()
    }
}

fn error_cell(method: &'static Method, subject: &MaterialInMedium) -> String {
    let (naming, bounds) = (Naming::default(), Bounds::default());
    let Ok(emitted) = specialised_function(method, subject, &naming, &bounds) else {
        return match method.class {
            Class::Metal => "metals only".to_owned(),
            Class::Film => "films only".to_owned(),
            _ => "dielectrics only".to_owned(),
        };
    };
    match emitted.model_error {
        Some(error) if error.max_abs < 1e-9 => "exact".to_owned(),
        Some(error) => {
            let mean = error
                .mean_rel
                .map(|mean| format!(" ({:.2} %)", 100.0 * mean));
            format!("{:.4}{}", error.max_abs, mean.unwrap_or_default())
        }
        None => "not measured".to_owned(),
    }
}

pub(super) fn markdown_table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let head: Vec<String> = head.iter().map(|cell| (*cell).to_owned()).collect();
    let rule: Vec<String> = head.iter().map(|_| "---".to_owned()).collect();
    [line(&head), line(&rule)]
        .into_iter()
        .chain(rows.map(|row| line(&row)))
        .collect()
}
