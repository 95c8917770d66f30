//! The rows of a family: from its compiler, from the record, or from the graph.

use super::compilers::FamilyAnswers;
use super::family::{Family, GpuCompiler};
use super::figures::{CostFigures, Counts};
use super::function::CostedFunction;
use super::record::CostRecord;
use super::row::{CostRow, CostSource};

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
