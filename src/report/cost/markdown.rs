//! The document: what methods cost on every family that was recorded.

use std::fmt::Write;

use super::{Row, percent, short};

const INTRODUCTION: &str = "\
# What methods cost

Written from the record that `tests/costs` keeps (`data/records/costs/`), and held by a test. `fresnel-gen cost` says the
same of every function, specialised ones too, and asks the compilers that are here; `--check` compares with the record.

- **One evaluation** is the cost that one more evaluation in a chain adds to a fragment shader: (cost of eight − cost of four) / 4.
  GPUs of OpenGL ES 2.0 limit program length; there it is cost of two − cost of one. The cost of the chain itself, measured with an
  empty function, is subtracted. Each takes its cosine from the result before it and arguments of its own from
  uniforms, so that nothing is shared and nothing is left out.
- **The figure** is what the compiler itself takes for the cost: RADV's inverse throughput, bundles on
  the Mali-T860, cycles of arithmetic on the Mali-G72 and of the busiest unit on the Mali-G57, instructions everywhere else. Adreno's counts
  include the nops that wait for a result; in a larger shader other work can fill them.
- **A texture fetch** costs what latency and bandwidth cost, which no count shows: a column of its own.
- **Where a count is no time:** it says nothing of memory, of the unit that divides and takes roots beside the others (on
  RDNA that is in the inverse throughput, on Adreno it is not), of how many registers leave how many waves, of what a draw
  costs whatever its formula. The Adreno 630 computes what depends only on uniforms once per draw, before the
  fragments; its counts exclude that part. `fresnel-gen reproduce table6` shows the counts beside times on three phones and a laptop.
- **Families that share a compiler** differ little: the Adrenos 320 and 330 not at all, RDNA 1 and 2 in a few functions.
- Shares are of `dielectric_exact`.
";

/// The functions of three channels in single precision: all families side by side, then each with its figures.
pub fn markdown(families: &[Vec<Row>]) -> String {
    let sections = families.iter().map(|rows| section(rows));
    INTRODUCTION.to_owned() + &side_by_side(families) + &sections.collect::<String>()
}

fn is_shown(row: &Row) -> bool {
    row.precision == "f32" && row.channels == 3
}

/// Shares, a column for each family of which anything is known.
fn side_by_side(families: &[Vec<Row>]) -> String {
    let known: Vec<&Vec<Row>> = families
        .iter()
        .filter(|rows| rows.iter().any(|row| row.figures.is_ok()))
        .collect();
    let names: Vec<&str> = known.iter().map(|rows| rows[0].family.name).collect();
    let mut page = format!(
        "\n## Side by side\n\nShares in per cent; `+` is a texture fetch.\n\n| function | {} |\n|---|{}\n",
        names.join(" | "),
        "---:|".repeat(names.len())
    );
    for (place, row) in known[0].iter().enumerate().filter(|(_, row)| is_shown(row)) {
        let cells: Vec<String> = known.iter().map(|rows| percent(&rows[place])).collect();
        // Writing to a String cannot fail.
        let _ = writeln!(page, "| {} | {} |", row.label(), cells.join(" | "));
    }
    page
}

fn section(rows: &[Row]) -> String {
    let shown: Vec<&Row> = rows
        .iter()
        .filter(|row| is_shown(row) && row.figures.is_ok())
        .collect();
    let Some(first) = shown.first() else {
        return String::new();
    };
    let family = first.family;
    let compiler = first.compiler.as_deref().unwrap_or("Counted in the graph");
    let head = format!(
        "\n## {}\n\n{}. {compiler}.\n\n| function | {} | share | fetches |\n|---|---:|---:|---:|\n",
        family.name, family.gpu, family.columns.measure
    );
    let line = |row: &&Row| {
        let cost = row.figures.as_ref().ok().map(|figures| figures.cost());
        let share = row.share.map(|share| format!("{:.0} %", 100.0 * share));
        format!(
            "| {} | {} | {} | {} |\n",
            row.label(),
            short(cost),
            share.unwrap_or_default(),
            row.fetches
        )
    };
    head + &shown.iter().map(line).collect::<String>()
}
