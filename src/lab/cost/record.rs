//! Recorded costs, and the cost of a function as it is known without a compiler: by its record, by its shape, or because it
//! computes nothing. Records lie in `data/records/costs/`, a file for each family, keyed by the hash of the shader.

use std::collections::BTreeMap;

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};

use super::family::{Family, GpuCompiler};
use super::figures::{CostFigures, Counts};
use super::function::{CostedFunction, FunctionId};
use super::probe::Probe;
use crate::generator::emit::FunctionForm;
use crate::language::ir::Checked;
use crate::language::methods::{Gpu, Method};
use crate::physics::num::Precision;
use crate::physics::records;

static FOLDER: Dir = include_dir!("$CARGO_MANIFEST_DIR/data/records/costs");

/// The record of a family.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CostRecord {
    /// The compiler with its version.
    pub compiler: String,
    /// The figures of each shader by its hash.
    pub figures: BTreeMap<String, CostFigures>,
    /// The hash of each function's shader, by the text of its [`FunctionId`]. It distinguishes a shader that changed from one that
    /// was never measured.
    pub functions: BTreeMap<String, String>,
    /// The largest cost among functions whose shaders differ in numbers alone, by the hash of the shader without its numbers.
    pub shapes: BTreeMap<String, f64>,
    /// The family, as functions are written for it.
    pub gpu: Option<Gpu>,
}

impl CostRecord {
    /// The record of a library function of three channels in single precision, as it is written for the family.
    pub fn library(&self, method: &'static Method) -> Option<CostFigures> {
        self.of_library(method, FunctionForm::Library, Precision::F32)
    }

    /// The record of a library function as it is written for the family.
    pub fn of_library(
        &self,
        method: &'static Method,
        form: FunctionForm,
        precision: Precision,
    ) -> Option<CostFigures> {
        let written = self.written(method, form, precision);
        self.of(&FunctionId::library(written, form, precision))
    }

    /// A method as it is written for the family.
    fn written(
        &self,
        method: &'static Method,
        form: FunctionForm,
        precision: Precision,
    ) -> &'static Method {
        let of = |gpu| method.written_for(gpu, form.name(), precision);
        self.gpu.map_or(method, of)
    }

    /// Whether a family's compiler need not be asked about a function: its shader is recorded, or the family has no arithmetic for it.
    pub fn answers(&self, family: &Family, function: &CostedFunction) -> bool {
        let is_known = |dialect| self.figures.contains_key(function.hash(dialect));
        let cannot = function.id.precision.is_half() && !family.half;
        cannot || family.compiler.dialect().is_some_and(is_known)
    }

    /// The record of a function.
    pub fn of(&self, function: &FunctionId) -> Option<CostFigures> {
        let shader = self.functions.get(&function.to_string())?;
        self.figures.get(shader).copied()
    }
}

/// Precedes the compiler's name.
const COMPILER: &str = "# compiler: ";

/// A row of a file.
#[derive(Deserialize)]
struct RecordedCost {
    effect: String,
    method: String,
    variant: String,
    material: String,
    form: String,
    channels: String,
    precision: String,
    shader: String,
    shape: String,
    instructions: f64,
    latency: Option<f64>,
    inverse_throughput: Option<f64>,
    registers: Option<f64>,
    net_instructions: f64,
    net_latency: Option<f64>,
    net_inverse_throughput: Option<f64>,
}

/// The record of a family, empty where there is none.
pub fn records(family: &str) -> CostRecord {
    let file = FOLDER.get_file(format!("{family}.csv"));
    let text = file.and_then(|file| file.contents_utf8());
    let record = text.map(parse).unwrap_or_default();
    CostRecord {
        gpu: Gpu::find(family),
        ..record
    }
}

/// Parses the text of a record.
fn parse(text: &str) -> CostRecord {
    let compiler = text.lines().find_map(|line| line.strip_prefix(COMPILER));
    let mut record = CostRecord {
        compiler: compiler.unwrap_or_default().to_owned(),
        ..CostRecord::default()
    };
    for row in records::rows::<RecordedCost>(text) {
        let figures = CostFigures {
            shader: Counts {
                instructions: row.instructions,
                latency: row.latency,
                inverse_throughput: row.inverse_throughput,
            },
            registers: row.registers,
            net: Counts {
                instructions: row.net_instructions,
                latency: row.net_latency,
                inverse_throughput: row.net_inverse_throughput,
            },
        };
        let largest = record.shapes.entry(row.shape).or_insert(figures.cost());
        *largest = largest.max(figures.cost());
        record.figures.insert(row.shader.clone(), figures);
        let id = [
            row.effect,
            row.method,
            row.variant,
            row.material,
            row.form,
            row.channels,
            row.precision,
        ];
        record.functions.insert(id.join(","), row.shader);
    }
    record
}

/// The cost of an evaluation, and how it is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct KnownCost {
    /// The cost, in the family's measure.
    pub cost: f64,
    /// How it is known.
    pub basis: CostBasis,
}

/// How a cost is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CostBasis {
    /// This very function was compiled.
    Function,
    /// The same text with other constants was compiled. The largest of several costs counts.
    Shape,
    /// It computes nothing.
    Nothing,
    /// Its operations were counted.
    Operations,
}

/// The cost of a function on a family, where it is known. A function that computes nothing costs nothing. Operations are counted
/// if that is the family's measure. Otherwise the record has the function, or one of the same text with other constants.
pub fn known_cost(
    function: &Checked,
    precision: Precision,
    family: &Family,
    record: &CostRecord,
) -> Option<KnownCost> {
    let known = |basis| move |cost| KnownCost { cost, basis };
    if let Some(known) = uncompiled_cost(function, family) {
        return Some(known);
    }
    let dialect = family.compiler.dialect()?;
    let probe = Probe::new(function, precision);
    let own = record.figures.get(&probe.hash(dialect));
    let own = own.map(CostFigures::cost).map(known(CostBasis::Function));
    let shape = || record.shapes.get(&probe.shape(dialect)).copied();
    own.or_else(|| shape().map(known(CostBasis::Shape)))
}

/// The cost of a function for which no compiler is needed.
fn uncompiled_cost(function: &Checked, family: &Family) -> Option<KnownCost> {
    let basis = match family.compiler {
        GpuCompiler::None(_) => return None,
        _ if function.computes_nothing() => CostBasis::Nothing,
        GpuCompiler::Operations => CostBasis::Operations,
        _ => return None,
    };
    Some(KnownCost {
        cost: function.work() as f64,
        basis,
    })
}

/// The cost of an evaluation on a family, where it is known for this very function, not for its shape: see [`known_cost`].
pub fn function_cost(
    function: &Checked,
    precision: Precision,
    family: &Family,
    record: &CostRecord,
) -> Option<f64> {
    let known = known_cost(function, precision, family, record);
    known
        .filter(|known| known.basis != CostBasis::Shape)
        .map(|known| known.cost)
}

/// The cost of an evaluation of a method's library function on a family, for three channels in single precision.
pub fn library_cost(method: &'static Method, family: &Family, record: &CostRecord) -> Option<f64> {
    let known = known_library_cost(
        method,
        FunctionForm::Library,
        Precision::F32,
        family,
        record,
    );
    known.map(|known| known.cost)
}

/// The cost of an evaluation of a library function on a family, and how it is known: its operations where those are counted or
/// where there are none, otherwise the record. `form` is that of three channels or of one.
pub fn known_library_cost(
    method: &'static Method,
    form: FunctionForm,
    precision: Precision,
    family: &Family,
    record: &CostRecord,
) -> Option<KnownCost> {
    let is_scalar = form == FunctionForm::Scalar;
    if is_scalar && !method.has_scalar_form() {
        return None;
    }
    let recorded = record.of_library(method, form, precision);
    let recorded = recorded.map(|figures| KnownCost {
        cost: figures.cost(),
        basis: CostBasis::Function,
    });
    // What computes nothing is recorded as 0, so that what costs something need not be built.
    if recorded.is_some_and(|known| known.cost > 0.0) && family.compiler.dialect().is_some() {
        return recorded;
    }
    let function = record
        .written(method, form, precision)
        .function_in(precision, is_scalar)
        .ok()?;
    uncompiled_cost(&function, family).or(recorded)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::find;

    #[test]
    fn a_record_is_read() {
        let head = "effect,method,variant,material,form,channels,precision,shader,shape,instructions,latency,inverse_throughput,registers,net_instructions,net_latency,net_inverse_throughput";
        let row = ",schlick,,,library,3,f32,0123456789abcdef,00ff,57,,28,8,9,,7";
        let others = [
            ",schlick,,gold,specialised,3,f32,01,aa,50,,28,8,9,,5",
            ",schlick,,water,specialised,3,f32,02,aa,50,,28,8,9,,6",
        ];
        let text = format!("{COMPILER}X 1.0\n{head}\n{row}\n{}\n", others.join("\n"));
        let record = parse(&text);
        assert_eq!(record.compiler, "X 1.0");
        let figures = record.figures["0123456789abcdef"];
        assert_eq!(figures.cost(), 7.0);
        assert_eq!(figures.shader.latency, None);
        let schlick = find("schlick").unwrap();
        assert_eq!(record.library(schlick), Some(figures));
        assert_eq!(record.shapes["00ff"], 7.0);
        assert_eq!(record.shapes["aa"], 6.0);
    }
}
