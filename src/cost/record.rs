//! What compilers said, kept in `data/records/costs/`, a file for each family, keyed by the hash of the shader: it serves
//! where a compiler is absent.

use std::collections::BTreeMap;

use include_dir::{Dir, include_dir};

use crate::ir::Checked;
use crate::methods::Method;
use crate::num::Precision;

use super::family::{Family, GpuCompiler};
use super::figures::{CostFigures, Counts};
use super::probe::Probe;

static FOLDER: Dir = include_dir!("$CARGO_MANIFEST_DIR/data/records/costs");

/// What was recorded of a family.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CostRecord {
    /// The compiler with its version.
    pub compiler: String,
    /// The figures of each shader by its hash.
    pub figures: BTreeMap<String, CostFigures>,
    /// The hash of each function by its other cells, to tell a shader that changed from one that was never measured.
    pub functions: BTreeMap<String, String>,
}

impl CostRecord {
    /// What was recorded of a library function of three channels in single precision.
    pub fn library(&self, method: &str) -> Option<CostFigures> {
        let shader = self.functions.get(&format!("{method},,library,3,f32"))?;
        self.figures.get(shader).copied()
    }
}

/// What an evaluation of a method's library function, three channels, costs on a family: its operations where those are counted,
/// else what was recorded.
pub fn library_cost(method: &Method, family: &Family, record: &CostRecord) -> Option<f64> {
    if family.compiler == GpuCompiler::Operations {
        let function = method.function(false);
        return Some(function.expect("a test builds every method").work() as f64);
    }
    record.library(method.name).map(|figures| figures.cost())
}

/// What an evaluation of a function of `cos_theta` costs on a family: its operations where those are counted, else what was
/// recorded of the same shader.
pub fn function_cost(function: &Checked, family: &Family, record: &CostRecord) -> Option<f64> {
    if family.compiler == GpuCompiler::Operations {
        return Some(function.work() as f64);
    }
    let dialect = family.compiler.dialect()?;
    let shader = Probe::new(function, Precision::F32).hash(dialect);
    record.figures.get(&shader).map(CostFigures::cost)
}

/// The columns of a file.
#[cfg(test)]
const HEAD: &str = "method,material,form,channels,precision,shader,instructions,latency,inverse_throughput,registers,net_instructions,net_latency,net_inverse_throughput";
/// How many of them say which function it is.
const KEYS: usize = 5;
/// What stands before the compiler's name.
const COMPILER: &str = "# compiler: ";

/// The record of a family, empty where there is none.
pub fn records(family: &str) -> CostRecord {
    let file = FOLDER.get_file(format!("{family}.csv"));
    let text = file.and_then(|file| file.contents_utf8());
    text.map(parse).unwrap_or_default()
}

/// A file as [`CostRecord`].
fn parse(text: &str) -> CostRecord {
    let mut record = CostRecord::default();
    for line in text.lines() {
        if let Some(compiler) = line.strip_prefix(COMPILER) {
            compiler.clone_into(&mut record.compiler);
        } else if let Some((function, shader, figures)) = row(line) {
            record.functions.insert(function, shader.clone());
            record.figures.insert(shader, figures);
        }
    }
    record
}

fn row(line: &str) -> Option<(String, String, CostFigures)> {
    let cells: Vec<&str> = line.split(',').collect();
    let number = |place: usize| cells.get(place)?.parse::<f64>().ok();
    let first = KEYS + 1;
    Some((
        cells.get(..KEYS)?.join(","),
        (*cells.get(KEYS)?).to_owned(),
        CostFigures {
            shader: Counts {
                instructions: number(first)?,
                latency: number(first + 1),
                inverse_throughput: number(first + 2),
            },
            registers: number(first + 3),
            net: Counts {
                instructions: number(first + 4)?,
                latency: number(first + 5),
                inverse_throughput: number(first + 6),
            },
        },
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_read() {
        let text = format!(
            "{COMPILER}X 1.0\n{HEAD}\nschlick,,library,3,f32,0123456789abcdef,57,,28,8,9,,7\n"
        );
        let record = parse(&text);
        assert_eq!(record.compiler, "X 1.0");
        let figures = record.figures["0123456789abcdef"];
        assert_eq!(figures.cost(), 7.0);
        assert_eq!(figures.shader.latency, None);
        assert_eq!(
            record.functions["schlick,,library,3,f32"],
            "0123456789abcdef"
        );
    }
}
