//! The cost of a function on a family of GPUs as a row of reports, from the family's compiler, from the record, or from the graph.

use serde::Serialize;

use super::compilers::FamilyAnswers;
use super::family::{Family, GpuCompiler};
use super::figures::{CostFigures, Counts};
use super::function::CostedFunction;
use super::record::{CostRecord, FunctionKey};
use crate::generator::emit::FunctionForm;
use crate::physics::num::Precision;

/// A function on a family.
#[derive(Clone, Debug, Serialize)]
#[serde(into = "CostRowJson")]
pub struct CostRow {
    /// The function of an effect, by its name after the prefix.
    pub effect: Option<&'static str>,
    /// The method. None for a function of an effect that needs no R.
    pub method: Option<&'static str>,
    /// The material that it is specialised to.
    pub material: Option<String>,
    /// Its form.
    pub form: FunctionForm,
    /// How many channels it returns.
    pub channels: usize,
    /// The precision that it computes in.
    pub precision: Precision,
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

/// The row in a report's JSON.
#[derive(Serialize)]
struct CostRowJson {
    effect: Option<&'static str>,
    method: Option<&'static str>,
    material: Option<String>,
    form: FunctionForm,
    channels: usize,
    precision: Precision,
    constants: &'static str,
    gpu: &'static str,
    vendor: &'static str,
    compiler: Option<String>,
    measure: &'static str,
    instructions: Option<f64>,
    latency: Option<f64>,
    inverse_throughput: Option<f64>,
    registers: Option<f64>,
    fetches: usize,
    net_instructions: Option<f64>,
    net_latency: Option<f64>,
    net_inverse_throughput: Option<f64>,
    share: Option<f64>,
    shader: Option<String>,
    shape: Option<String>,
    from: Option<CostSource>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

impl From<CostRow> for CostRowJson {
    fn from(row: CostRow) -> CostRowJson {
        let figures = row.figures.as_ref().ok();
        let shader = figures.map(|figures| figures.shader);
        let net = figures.map(|figures| figures.net);
        let instructions = |counts: Counts| counts.instructions;
        CostRowJson {
            constants: if row.material.is_some() {
                "folded"
            } else {
                "uniform"
            },
            gpu: row.family.name,
            vendor: row.family.vendor,
            measure: row.family.columns.measure,
            instructions: shader.map(instructions),
            latency: shader.and_then(|counts| counts.latency),
            inverse_throughput: shader.and_then(|counts| counts.inverse_throughput),
            registers: figures.and_then(|figures| figures.registers),
            net_instructions: net.map(instructions),
            net_latency: net.and_then(|counts| counts.latency),
            net_inverse_throughput: net.and_then(|counts| counts.inverse_throughput),
            reason: row.reason(),
            effect: row.effect,
            method: row.method,
            material: row.material,
            form: row.form,
            channels: row.channels,
            precision: row.precision,
            compiler: row.compiler,
            fetches: row.fetches,
            share: row.share,
            shader: row.shader,
            shape: row.shape,
            from: row.source,
        }
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

    /// The key of the function in a record.
    pub fn key(&self) -> FunctionKey {
        FunctionKey {
            effect: self.effect.unwrap_or_default().to_owned(),
            method: self.method.unwrap_or_default().to_owned(),
            material: self.material.clone().unwrap_or_default(),
            form: self.form,
            channels: self.channels,
            precision: self.precision,
        }
    }

    /// The function for people: `schlick`, `schlick, one channel`, `gold: schlick, f16`, `refracted`,
    /// `exit_transmittance: schlick`.
    pub fn label(&self) -> String {
        let of = self.material.as_deref().or(self.effect);
        let names: Vec<&str> = of.into_iter().chain(self.method).collect();
        let channel = match self.channels {
            1 if self.method.is_some() => ", one channel",
            _ => "",
        };
        let half = if self.precision.is_half() {
            ", f16"
        } else {
            ""
        };
        format!("{}{channel}{half}", names.join(": "))
    }
}

/// The rows of a family, in the functions' order.
pub fn cost_rows(
    family: &'static Family,
    answers: Option<&FamilyAnswers>,
    record: &CostRecord,
    functions: &[CostedFunction],
) -> Vec<CostRow> {
    let about = |place: usize, function: &CostedFunction| {
        let row = bare(family, function);
        if function.precision.is_half() && !family.half {
            let why = "it has no 16-bit arithmetic (shaderFloat16)".to_owned();
            return CostRow {
                figures: Err(why),
                ..row
            };
        }
        match (family.compiler, answers) {
            (GpuCompiler::Operations, _) => counted(row, function),
            (GpuCompiler::None(why), _) => CostRow {
                figures: Err(why.to_owned()),
                ..row
            },
            (_, Some(FamilyAnswers::Fresh(compiler, answers))) => CostRow {
                compiler: Some(compiler.clone()),
                source: Some(CostSource::Compiler),
                figures: answers[place].clone(),
                ..row
            },
            (_, Some(FamilyAnswers::Absent(why))) => recorded(row, function, record, why),
            (_, None) => recorded(row, function, record, "its compiler was not asked"),
        }
    };
    let all = functions.iter().enumerate();
    let mut rows: Vec<CostRow> = all
        .map(|(place, function)| about(place, function))
        .collect();
    let reference = functions.iter().position(CostedFunction::is_reference);
    let whole =
        reference.and_then(|place| rows[place].figures.as_ref().ok().map(CostFigures::cost));
    let mut asked = functions.iter().map(|function| function.is_asked);
    rows.retain(|_| asked.next().unwrap_or(false));
    for row in &mut rows {
        let cost = row.figures.as_ref().ok().map(CostFigures::cost);
        row.share = cost.zip(whole).map(|(cost, whole)| cost / whole);
    }
    rows
}

/// A row of which nothing is known yet.
fn bare(family: &'static Family, function: &CostedFunction) -> CostRow {
    let dialect = family.compiler.dialect();
    CostRow {
        effect: function.effect.map(|effect| effect.name),
        method: function.method_by_name(),
        material: function.material.clone(),
        form: function.form,
        channels: function.channels(),
        precision: function.precision,
        fetches: function.graph.fetches(),
        family,
        compiler: None,
        source: None,
        figures: Err(String::new()),
        share: None,
        shader: dialect.map(|dialect| function.hash(dialect).to_owned()),
        shape: dialect.map(|dialect| function.shape(dialect)),
    }
}

fn counted(row: CostRow, function: &CostedFunction) -> CostRow {
    let counts = Counts {
        instructions: function.graph.work() as f64,
        ..Counts::default()
    };
    CostRow {
        source: Some(CostSource::Graph),
        figures: Ok(CostFigures {
            shader: counts,
            registers: None,
            net: counts,
        }),
        ..row
    }
}

fn recorded(row: CostRow, function: &CostedFunction, record: &CostRecord, absent: &str) -> CostRow {
    let found = row
        .shader
        .as_ref()
        .and_then(|hash| record.figures.get(hash));
    if let Some(figures) = found {
        return CostRow {
            compiler: Some(record.compiler.clone()),
            source: Some(CostSource::Record),
            figures: Ok(*figures),
            ..row
        };
    }
    if function.graph.computes_nothing() {
        return counted(row, function);
    }
    let why = if record.functions.contains_key(&row.key()) {
        "what was recorded is of another shader"
    } else {
        "it is not recorded"
    };
    CostRow {
        figures: Err(format!("not measured: {absent}, and {why}")),
        ..row
    }
}
