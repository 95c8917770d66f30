//! The document: what methods cost on every family that was recorded.

use std::fmt::Write;

use fresnel_gen::lab::cost::CostRow;
use fresnel_gen::physics::num::Precision;
use fresnel_gen::pictures::cost_page::{percent, short};

const INTRODUCTION: &str = "\
# What methods cost

Of one evaluation of the exact law for dielectrics `schlick` costs {schlick}, `fitted` {fitted} and `f82_tint` {f82_tint}, by family of GPUs.

Written from the record that `tests/costs` keeps (`data/records/costs/`), and held by a test. `fresnel-gen cost` says the
same of every function, specialised ones too; of one that is not recorded it asks the compilers that are here. `--check` asks them
of all, and compares with the record.

- **One evaluation** is the cost that one more evaluation in a chain adds to a fragment shader: (cost of eight − cost of four) / 4.
  GPUs of OpenGL ES 2.0 limit program length; there it is cost of two − cost of one. The cost of the chain itself, measured with an
  empty function, is subtracted. Each takes its cosine from the result before it and arguments of its own from
  uniforms, so that nothing is shared and nothing is left out.
- **The figure** is what the compiler itself takes for the cost: RADV's inverse throughput, bundles on
  the Mali-T860, cycles of arithmetic on the Mali-G72 and of the busiest unit on the Mali-G57, instructions everywhere else. Adreno's counts
  include the nops that wait for a result; in a larger shader other work can fill them.
- **A function that computes nothing** (`constant_f0`) costs 0 by definition: compilers leave out a chain in which nothing depends on the cosine.
- **`shape`** in the record is the hash of a shader without its numbers. Functions that differ in constants alone share it, and mostly their cost.
- **A texture fetch** costs latency and bandwidth, which instruction counts do not include: it has a column of its own.
- **Where a count is no time:** it says nothing of memory, of the unit that divides and takes roots beside the others (on
  RDNA that is in the inverse throughput, on Adreno it is not), of how many registers leave how many waves, of what a draw
  costs whatever its formula. The Adreno 630 computes what depends only on uniforms once per draw, before the
  fragments; its counts exclude that part. `fresnel-gen reproduce table6` shows the counts beside times on three phones and a laptop.
- **Families that share a compiler** differ little: the Adrenos 320 and 330 not at all, RDNA 1 and 2 in a few functions.
- Shares are of `dielectric_exact`.
";

/// The functions of three channels in single precision, all families side by side, and what the families are. All figures are in the
/// record.
pub fn cost_document(families: &[Vec<CostRow>]) -> String {
    let library = side_by_side(families, &|row| is_shown(row) && is_library(row));
    let materials = side_by_side(families, &|row| is_shown(row) && row.id.material.is_some());
    let effects = side_by_side(families, &|row| row.id.effect.is_some());
    let mut introduction = INTRODUCTION.to_owned();
    for method in ["schlick", "fitted", "f82_tint"] {
        let mark = format!("{{{method}}}");
        introduction = introduction.replace(&mark, &range(families, method));
    }
    format!(
        "{introduction}\n## Library functions\n\nShares in per cent; `+` is a texture fetch, `?` is not measured.\n\n{library}\n\
         ## Functions of materials\n\n{materials}\n\
         ## Functions of effects\n\nWith R by `dielectric_exact` where a function asks for it. Each evaluation has a matrix of its own here, where an application has one for \
         all. On the Mali-G57 eight matrices are too many for the registers of uniforms, and the figures are those of loading them. \
         A vector that comes first is three weights times the number that the chain hands on; \
         where a function gives one number, two of these products count as its own.\n\n{effects}\n## Families\n\n{}",
        families_table(families)
    )
}

fn is_shown(row: &CostRow) -> bool {
    row.id.precision == Precision::F32 && row.id.channels == 3
}

fn is_library(row: &CostRow) -> bool {
    row.id.material.is_none() && row.id.effect.is_none()
}

/// Shares, a column for each family of which anything is known.
fn side_by_side(families: &[Vec<CostRow>], is_wanted: &dyn Fn(&CostRow) -> bool) -> String {
    let known: Vec<&Vec<CostRow>> = families.iter().filter(|rows| is_known(rows)).collect();
    let names: Vec<&str> = known.iter().map(|rows| rows[0].family.name).collect();
    let mut table = format!(
        "| function | {} |\n|---|{}\n",
        names.join(" | "),
        "---:|".repeat(names.len())
    );
    for (place, row) in known[0]
        .iter()
        .enumerate()
        .filter(|(_, row)| is_wanted(row))
    {
        let cells: Vec<String> = known.iter().map(|rows| percent(&rows[place])).collect();
        // Writing to a String cannot fail.
        let _ = writeln!(table, "| {} | {} |", row.id.label(), cells.join(" | "));
    }
    table
}

/// The least and the largest share of a library function over all families that a compiler spoke for.
fn range(families: &[Vec<CostRow>], method: &str) -> String {
    let rows = families
        .iter()
        .flatten()
        .filter(|row| row.compiler.is_some() && is_shown(row));
    let own = rows.filter(|row| is_library(row) && row.id.method_name() == Some(method));
    let shares = own.filter_map(|row| row.share);
    let ends = shares.fold((f64::MAX, f64::MIN), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    format!("{:.0} to {:.0} %", 100.0 * ends.0, 100.0 * ends.1)
}

fn is_known(rows: &[CostRow]) -> bool {
    rows.iter().any(|row| row.figures.is_ok())
}

/// Which GPU each family is, who compiled, what the figure is, what one evaluation of the exact law for dielectrics costs by it.
fn families_table(families: &[Vec<CostRow>]) -> String {
    let mut table =
        "| family | GPU | compiler | figure | `dielectric_exact` | all figures |\n|---|---|---|---|---:|---|\n".to_owned();
    for rows in families.iter().filter(|rows| is_known(rows)) {
        let family = rows[0].family;
        let compiler = rows.iter().find_map(|row| row.compiler.as_deref());
        let is_whole = |row: &&CostRow| {
            is_shown(row) && is_library(row) && row.id.method_name() == Some("dielectric_exact")
        };
        let whole = rows
            .iter()
            .find(is_whole)
            .and_then(|row| row.figures.as_ref().ok());
        let record = match compiler {
            Some(_) => format!("[CSV](../data/records/costs/{}.csv)", family.name),
            None => "`fresnel-gen cost --gpu operations`".to_owned(),
        };
        let _ = writeln!(
            table,
            "| {} | {} | {} | {} | {} | {record} |",
            family.name,
            family.gpu,
            compiler.unwrap_or("counted in the graph"),
            family.columns.measure,
            short(whole.map(|figures| figures.cost())),
        );
    }
    table
}
