//! The statistics that compilers report of shaders, and the cost of one evaluation of a function that follows from them.

use std::collections::BTreeMap;

/// A compiler's statistics of a shader, under its own names.
pub type Statistics = BTreeMap<String, f64>;

/// The names of the reported quantities among a compiler's statistics.
#[derive(Debug)]
pub struct StatisticNames {
    /// Instructions.
    pub instructions: &'static str,
    /// Cycles from the first instruction to the last.
    pub latency: Option<&'static str>,
    /// Cycles that a unit is busy: the cost where many invocations run. Of several units the busiest counts, each net of the
    /// empty chain.
    pub inverse_throughput: &'static [&'static str],
    /// Registers per lane.
    pub registers: Option<&'static str>,
    /// The unit of the main figure, in the compiler's own words: of the inverse throughput, or else of instructions.
    pub measure: &'static str,
}

/// The counts of a shader or of one evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// Instructions.
    pub instructions: f64,
    /// Cycles from the first to the last.
    pub latency: Option<f64>,
    /// Cycles that a unit is busy.
    pub inverse_throughput: Option<f64>,
}

/// The cost of a function on a GPU.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CostFigures {
    /// The counts of the fragment shader with its shorter chain.
    pub shader: Counts,
    /// Registers of that shader.
    pub registers: Option<f64>,
    /// The counts of one evaluation, net of the chain.
    pub net: Counts,
}

impl CostFigures {
    /// All figures, for a message.
    pub fn text(&self) -> String {
        let shown = |value: Option<f64>| value.map_or("none".to_owned(), |value| value.to_string());
        format!(
            "{} (instructions {} of the shader, {} of an evaluation; latency {}; registers {})",
            self.cost(),
            self.shader.instructions,
            self.net.instructions,
            shown(self.shader.latency),
            shown(self.registers)
        )
    }

    /// These figures for a function that computes nothing, whose net cost is 0. Nothing in its chain depends on the cosine, so
    /// compilers remove the chain, and its measured net cost would be negative.
    pub fn of_nothing(self) -> CostFigures {
        let none = |cycles: Option<f64>| cycles.map(|_| 0.0);
        CostFigures {
            net: Counts {
                instructions: 0.0,
                latency: none(self.net.latency),
                inverse_throughput: none(self.net.inverse_throughput),
            },
            ..self
        }
    }

    /// The main figure of one evaluation.
    pub fn cost(&self) -> f64 {
        self.net.inverse_throughput.unwrap_or(self.net.instructions)
    }
}

/// The counts among a compiler's statistics. None without a count of instructions.
fn counts(names: &StatisticNames, statistics: &Statistics) -> Option<Counts> {
    let value = |name: Option<&str>| name.and_then(|name| statistics.get(name).copied());
    Some(Counts {
        instructions: *statistics.get(names.instructions)?,
        latency: value(names.latency),
        inverse_throughput: busiest(
            names
                .inverse_throughput
                .iter()
                .map(|unit| value(Some(unit))),
        ),
    })
}

/// The figures of a function, from the statistics of its shorter and its longer chain and of both chains of the empty function.
/// `lengths` are the numbers of evaluations in each chain.
pub fn figures(
    names: &StatisticNames,
    lengths: [usize; 2],
    chains: &[Statistics; 2],
    empty: &[Statistics; 2],
) -> Option<CostFigures> {
    let more = (lengths[1] - lengths[0]) as f64;
    let [short, long] = chains
        .each_ref()
        .map(|statistics| counts(names, statistics));
    let [bare_short, bare_long] = empty.each_ref().map(|statistics| counts(names, statistics));
    let (own, bare) = (
        slope(short?, long?, more),
        slope(bare_short?, bare_long?, more),
    );
    let of_unit = |unit: &&str| {
        let value = |statistics: &Statistics| statistics.get(*unit).copied();
        let [[a, b], [c, d]] = [chains, empty].map(|pair| pair.each_ref().map(value));
        Some(rounded((b? - a? - (d? - c?)) / more))
    };
    let busy = busiest(names.inverse_throughput.iter().map(of_unit));
    let registers = names.registers;
    Some(CostFigures {
        shader: short?,
        registers: registers.and_then(|name| chains[0].get(name).copied()),
        net: Counts {
            inverse_throughput: busy,
            ..less(own, bare)
        },
    })
}

/// The cost of one evaluation: the difference of two chains, divided by the difference of their numbers of evaluations.
fn slope(short: Counts, long: Counts, more: f64) -> Counts {
    let difference = less(long, short);
    Counts {
        instructions: difference.instructions / more,
        latency: difference.latency.map(|cycles| cycles / more),
        inverse_throughput: difference.inverse_throughput.map(|cycles| cycles / more),
    }
}

/// The cycles of the busiest unit.
fn busiest(units: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    units.flatten().reduce(f64::max)
}

/// Rounds to six decimals, as compilers print cycles, so that fresh and recorded figures are equal.
fn rounded(value: f64) -> f64 {
    (1e6 * value).round() / 1e6
}

fn less(counts: Counts, other: Counts) -> Counts {
    let each = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| rounded(a - b));
    Counts {
        instructions: rounded(counts.instructions - other.instructions),
        latency: each(counts.latency, other.latency),
        inverse_throughput: each(counts.inverse_throughput, other.inverse_throughput),
    }
}

/// The statistics in an OpenGL driver's debug messages about the fragment shader: `FRAG shader: 30 inst, 4 nops, …` or
/// `type: 4, inst: 30, …`.
pub fn remarked(remarks: &[String]) -> Option<Statistics> {
    let of_fragment = remarks.iter().rev().filter_map(|remark| {
        let parts = remark.split_once("shader:");
        let (head, list) = parts.unwrap_or(("", remark));
        let head = head.to_lowercase();
        let is_fragment = ["frag", "fs"].iter().any(|word| head.contains(word));
        // NVIDIA's gives the stage as a number. Intel's reports each SIMD width, of which every shader has the first.
        let is_numbered = parts.is_none() && remark.starts_with("type: 4,");
        let is_wide = head.contains("simd") && !head.contains("simd8");
        ((is_fragment && !is_wide) || is_numbered).then(|| pairs(list))
    });
    of_fragment
        .into_iter()
        .find(|statistics| !statistics.is_empty())
}

/// `30 inst` or `inst: 30`, between commas.
fn pairs(list: &str) -> Statistics {
    let pair = |part: &str| {
        let part = part.trim();
        if let Some((name, value)) = part.split_once(": ") {
            return Some((name.to_owned(), value.parse().ok()?));
        }
        let (value, name) = part.split_once(' ')?;
        Some((name.to_owned(), value.parse().ok()?))
    };
    list.split(',').filter_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(words: &str) -> Statistics {
        remarked(&[words.to_owned()]).unwrap_or_default()
    }

    #[test]
    fn remarks_of_all_drivers_are_read() {
        let adreno = told("FRAG shader: 30 inst, 4 nops, 26 non-nops, 2 half, 3 full, 12 (ss)");
        assert_eq!(adreno["inst"], 30.0);
        assert_eq!(adreno["full"], 3.0);
        let bifrost = told(
            "MESA_SHADER_FRAGMENT shader: 62 tuples, 9 clauses, 2.583333 cycles, 2.583333 arith",
        );
        assert_eq!(bifrost["cycles"], 2.583333);
        let nvidia = told("type: 4, local: 0, shared: 0, gpr: 9, inst: 41, bytes: 328, cached: 0");
        assert_eq!(nvidia["inst"], 41.0);
        let intel = told("FS SIMD8 shader: 52 inst, 0 loops, 210 cycles, 0:0 spills:fills");
        assert_eq!(intel["cycles"], 210.0);
        assert!(told("FS SIMD16 shader: 52 inst, 0 loops").is_empty());
        assert!(told("VERT shader: 3 inst, 0 nops").is_empty());
    }

    #[test]
    fn an_evaluation_is_the_slope_net_of_the_empty_chain() {
        let columns = StatisticNames {
            instructions: "inst",
            latency: None,
            inverse_throughput: &[],
            registers: Some("full"),
            measure: "instructions",
        };
        let shader =
            |inst: f64| Statistics::from([("inst".to_owned(), inst), ("full".to_owned(), 4.0)]);
        let found = figures(
            &columns,
            [4, 8],
            &[shader(57.0), shader(97.0)],
            &[shader(17.0), shader(21.0)],
        );
        let found = found.expect("both are complete");
        assert_eq!(found.net.instructions, 9.0);
        assert_eq!(
            (found.shader.instructions, found.registers),
            (57.0, Some(4.0))
        );
        assert_eq!(found.cost(), 9.0);
    }
}
