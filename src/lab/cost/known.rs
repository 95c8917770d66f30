//! What is known of a function's cost without a compiler: by the record, by its shape, or because it computes nothing.

use serde::Serialize;

use crate::generator::emit::FunctionForm;
use crate::language::ir::Checked;
use crate::language::methods::Method;
use crate::physics::num::Precision;

use super::family::{Family, GpuCompiler};
use super::figures::CostFigures;
use super::probe::Probe;
use super::record::{CostRecord, FunctionKey};

/// What an evaluation costs, and how that is known.
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
    /// The same text with other constants was; of several the largest cost counts.
    Shape,
    /// It computes nothing.
    Nothing,
    /// Its operations were counted.
    Operations,
}

impl CostBasis {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            CostBasis::Function => "function",
            CostBasis::Shape => "shape",
            CostBasis::Nothing => "nothing",
            CostBasis::Operations => "operations",
        }
    }
}

/// What is known of the cost of a function on a family. A function that computes nothing costs nothing; operations are counted where
/// the family is theirs; else the record knows the function, or one of the same text with other constants.
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

/// The cost of a function of which no compiler has to be asked.
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

/// What an evaluation of this very function costs on a family: see [`known_cost`].
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

/// What an evaluation of a method's library function, three channels in single precision, costs on a family.
pub fn library_cost(method: &Method, family: &Family, record: &CostRecord) -> Option<f64> {
    let known = known_library_cost(
        method,
        FunctionForm::Library,
        Precision::F32,
        family,
        record,
    );
    known.map(|known| known.cost)
}

/// What an evaluation of a library function costs on a family, and how that is known: its operations where those are counted or where there
/// are none, else what was recorded. `form` is that of three channels or of one.
pub fn known_library_cost(
    method: &Method,
    form: FunctionForm,
    precision: Precision,
    family: &Family,
    record: &CostRecord,
) -> Option<KnownCost> {
    let is_scalar = form == FunctionForm::Scalar;
    if is_scalar && !method.has_scalar_form() {
        return None;
    }
    let function = method.function_in(precision, is_scalar).ok()?;
    let recorded = || {
        let figures = record.of(&FunctionKey::library(method.name, form, precision))?;
        Some(KnownCost {
            cost: figures.cost(),
            basis: CostBasis::Function,
        })
    };
    uncompiled_cost(&function, family).or_else(recorded)
}
