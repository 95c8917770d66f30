//! The document: what methods cost on every family that was recorded.

use std::fmt::Write;

use super::{Row, short};

const INTRODUCTION: &str = "\
# What methods cost

Written from the record that `tests/costs` keeps (`data/records/costs/`), and held by a test. `fresnel-gen cost` says the
same of every function, specialised ones too, and asks the compilers that are here; `--check` compares with the record.

- **An evaluation** is what one more of it in a chain adds to a fragment shader (a quarter of what eight cost more than
  four; on GPUs of OpenGL ES 2.0, with their short programs, what two cost more than one), less the price of the chain
  itself, which the empty function tells. Each takes its cosine from the result before it and arguments of its own from
  uniforms, so that nothing is shared and nothing is left out.
- **The figure** is what the compiler itself takes for the cost: RADV's inverse throughput, the cycles of the Malis,
  instructions everywhere else. Adreno's instructions hold the empty ones that wait for a result; where other work stands
  beside the function they are filled.
- **A texture fetch** costs what latency and bandwidth cost, which no count shows: a column of its own.
- **Where a count is no time:** it says nothing of memory, of the unit that divides and takes roots beside the others (on
  RDNA that is in the inverse throughput, on Adreno it is not), of how many registers leave how many waves, of what a draw
  costs whatever its formula. The Adreno 630 computes what depends on uniforms alone once for a draw, before any fragment:
  its counts are of what is left. `fresnel-gen reproduce table6` shows the counts beside times on four phones and a laptop.
- Shares are of `dielectric_exact`.
";

/// The library functions of each family in single precision, three channels: what an evaluation costs, and its share.
pub fn markdown(families: &[Vec<Row>]) -> String {
    let mut page = INTRODUCTION.to_owned();
    for rows in families {
        let wanted =
            |row: &&Row| row.figures.is_ok() && row.precision == "f32" && row.channels == 3;
        let shown: Vec<&Row> = rows.iter().filter(wanted).collect();
        let Some(first) = shown.first() else { continue };
        let family = first.family;
        let compiler = first.compiler.as_deref().unwrap_or("counted in the graph");
        // Writing to a String cannot fail.
        let _ = write!(
            page,
            "\n## {}\n\n{}. {compiler}.\n\n| function | {} | share | fetches |\n|---|---:|---:|---:|\n",
            family.name, family.gpu, family.columns.measure
        );
        for row in shown {
            let cost = row.figures.as_ref().ok().map(|figures| figures.cost());
            let share = row.share.map(|share| format!("{share:.0} %"));
            let _ = writeln!(
                page,
                "| {} | {} | {} | {} |",
                row.label(),
                short(cost),
                share.unwrap_or_default(),
                row.fetches
            );
        }
    }
    page
}
