//! The cost of a function on a family of GPUs as a row of reports, from the family's compiler, from the record, or from the graph.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::compilers::{FamilyAnswers, NOT_ASKED};
use super::family::{Dialect, Family, GpuCompiler};
use super::figures::{CostFigures, Counts};
use super::function::{CostedFunction, FunctionId};
use super::record::CostRecord;

/// A function on a family.
#[derive(Clone, Debug)]
pub struct CostRow {
    /// The function.
    pub id: FunctionId,
    /// The number of texture fetches.
    pub fetches: usize,
    /// The family.
    pub family: &'static Family,
    /// The compiler with its version, where there is one.
    pub compiler: Option<String>,
    /// Where the figures come from. None where nothing is known.
    pub source: Option<CostSource>,
    /// The figures, or why there are none.
    pub figures: Result<CostFigures, String>,
    /// The cost divided by that of the reference.
    pub share: Option<f64>,
    /// The hash of the shader.
    pub shader: Option<String>,
    /// The hash of the shader without its numbers.
    pub shape: Option<String>,
}

/// Where the cost of a function comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum CostSource {
    /// The compiler, now.
    Compiler,
    /// The compiler, when it was recorded.
    Record,
    /// The graph.
    Graph,
}

impl Serialize for CostRow {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let is_folded = self.id.material.is_some();
        let figures = self.figures.as_ref().ok();
        let shader = figures.map(|figures| figures.shader);
        let net = figures.map(|figures| figures.net);
        let instructions = |counts: Counts| counts.instructions;
        let latency = |counts: Counts| counts.latency;
        let inverse_throughput = |counts: Counts| counts.inverse_throughput;
        let mut row = to.serialize_map(None)?;
        row.serialize_entry("effect", &self.id.effect)?;
        self.id.serialize_columns(&mut row)?;
        row.serialize_entry("constants", if is_folded { "folded" } else { "uniform" })?;
        row.serialize_entry("gpu", self.family.name)?;
        row.serialize_entry("vendor", self.family.vendor)?;
        row.serialize_entry("compiler", &self.compiler)?;
        row.serialize_entry("measure", self.family.columns.measure)?;
        row.serialize_entry("instructions", &shader.map(instructions))?;
        row.serialize_entry("latency", &shader.and_then(latency))?;
        row.serialize_entry("inverse_throughput", &shader.and_then(inverse_throughput))?;
        row.serialize_entry("registers", &figures.and_then(|figures| figures.registers))?;
        row.serialize_entry("fetches", &self.fetches)?;
        row.serialize_entry("net_instructions", &net.map(instructions))?;
        row.serialize_entry("net_latency", &net.and_then(latency))?;
        row.serialize_entry("net_inverse_throughput", &net.and_then(inverse_throughput))?;
        row.serialize_entry("share", &self.share)?;
        row.serialize_entry("shader", &self.shader)?;
        row.serialize_entry("shape", &self.shape)?;
        row.serialize_entry("from", &self.source)?;
        if let Some(reason) = self.reason() {
            row.serialize_entry("reason", &reason)?;
        }
        row.end()
    }
}

impl CostRow {
    /// Why nothing is known, or which figures this compiler does not report.
    fn reason(&self) -> Option<String> {
        let figures = match &self.figures {
            Err(why) => return Some(why.clone()),
            Ok(figures) => figures,
        };
        let columns = [
            ("latency", figures.shader.latency),
            ("inverse_throughput", figures.shader.inverse_throughput),
            ("registers", figures.registers),
        ];
        let missing = columns.into_iter().filter(|(_, figure)| figure.is_none());
        let missing: Vec<&str> = missing.map(|(name, _)| name).collect();
        (!missing.is_empty()).then(|| format!("not told here: {}", missing.join(", ")))
    }
}

/// The rows of a family, in the functions' order.
pub fn cost_rows(
    family: &'static Family,
    answers: Option<&FamilyAnswers>,
    record: &CostRecord,
    functions: &[CostedFunction],
) -> Vec<CostRow> {
    let row = |(place, function): (usize, &CostedFunction)| {
        let dialect = family.compiler.dialect();
        let (source, compiler, figures) = match (family.compiler, answers) {
            _ if function.id.precision.is_half() && !family.half => {
                let why = "it has no 16-bit arithmetic (shaderFloat16)";
                (None, None, Err(why.to_owned()))
            }
            (GpuCompiler::Operations, _) => counted(function),
            (GpuCompiler::None(why), _) => (None, None, Err(why.to_owned())),
            (_, Some(FamilyAnswers::Fresh(compiler, answers))) => match &answers[place] {
                Some(answer) => {
                    let source = CostSource::Compiler;
                    (Some(source), Some(compiler.clone()), answer.clone())
                }
                None => recorded(function, dialect, record, NOT_ASKED),
            },
            (_, Some(FamilyAnswers::Absent(why))) => recorded(function, dialect, record, why),
            (_, None) => recorded(function, dialect, record, NOT_ASKED),
        };
        CostRow {
            id: function.id.clone(),
            fetches: function.graph.fetches(),
            family,
            compiler,
            source,
            figures,
            share: None,
            shader: dialect.map(|dialect| function.hash(dialect).to_owned()),
            shape: dialect.map(|dialect| function.shape(dialect).to_owned()),
        }
    };
    let rows: Vec<CostRow> = functions.iter().enumerate().map(row).collect();
    let cost = |row: &CostRow| row.figures.as_ref().ok().map(CostFigures::cost);
    let reference = functions.iter().position(CostedFunction::is_reference);
    let whole = reference.and_then(|place| cost(&rows[place]));
    let asked = rows.into_iter().zip(functions);
    asked
        .filter(|(_, function)| function.is_asked)
        .map(|(row, _)| CostRow {
            share: cost(&row).zip(whole).map(|(cost, whole)| cost / whole),
            ..row
        })
        .collect()
}

/// Figures with their source and the compiler, or why there are none.
type KnownFigures = (
    Option<CostSource>,
    Option<String>,
    Result<CostFigures, String>,
);

fn counted(function: &CostedFunction) -> KnownFigures {
    let counts = Counts {
        instructions: function.graph.work() as f64,
        ..Counts::default()
    };
    let figures = CostFigures {
        shader: counts,
        registers: None,
        net: counts,
    };
    (Some(CostSource::Graph), None, Ok(figures))
}

fn recorded(
    function: &CostedFunction,
    dialect: Option<Dialect>,
    record: &CostRecord,
    absent: &str,
) -> KnownFigures {
    let found = dialect.and_then(|dialect| record.figures.get(function.hash(dialect)));
    if let Some(figures) = found {
        let compiler = Some(record.compiler.clone());
        return (Some(CostSource::Record), compiler, Ok(*figures));
    }
    if function.graph.computes_nothing() {
        return counted(function);
    }
    let why = if record.functions.contains_key(&function.id.to_string()) {
        "what was recorded is of another shader"
    } else {
        "it is not recorded"
    };
    let why = format!("not measured: {absent}, and {why}");
    (None, None, Err(why))
}
