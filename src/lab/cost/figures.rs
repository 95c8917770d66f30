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

/// The figures of a function, from the statistics of its shorter and its longer chain and of both chains of the empty function.
/// `lengths` are the numbers of evaluations in each chain. None without a count of instructions.
pub fn figures(
    names: &StatisticNames,
    lengths: [usize; 2],
    chains: &[Statistics; 2],
    empty: &[Statistics; 2],
) -> Option<CostFigures> {
    let evaluations = (lengths[1] - lengths[0]) as f64;
    let in_shader = |name: &str| chains[0].get(name).copied();
    // What the further evaluations of the longer chain cost, less what they cost in the empty chain.
    let net = |name: &str| {
        let more = |[short, long]: &[Statistics; 2]| Some(long.get(name)? - short.get(name)?);
        Some(rounded((more(chains)? - more(empty)?) / evaluations))
    };
    Some(CostFigures {
        shader: counts(names, &in_shader)?,
        registers: names.registers.and_then(in_shader),
        net: counts(names, &net)?,
    })
}

/// The counts by the statistics of these names. Of several units the busiest counts.
fn counts(names: &StatisticNames, value: &dyn Fn(&str) -> Option<f64>) -> Option<Counts> {
    let units = names.inverse_throughput.iter();
    Some(Counts {
        instructions: value(names.instructions)?,
        latency: names.latency.and_then(value),
        inverse_throughput: units.filter_map(|unit| value(unit)).reduce(f64::max),
    })
}

/// Rounds to six decimals, as compilers print cycles, so that fresh and recorded figures are equal.
fn rounded(value: f64) -> f64 {
    (1e6 * value).round() / 1e6
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

    fn read(words: &str) -> Statistics {
        remarked(&[words.to_owned()]).unwrap_or_default()
    }

    #[test]
    fn remarks_of_all_drivers_are_read() {
        let adreno = read("FRAG shader: 30 inst, 4 nops, 26 non-nops, 2 half, 3 full, 12 (ss)");
        assert_eq!(adreno["inst"], 30.0);
        assert_eq!(adreno["full"], 3.0);
        let bifrost = read(
            "MESA_SHADER_FRAGMENT shader: 62 tuples, 9 clauses, 2.583333 cycles, 2.583333 arith",
        );
        assert_eq!(bifrost["cycles"], 2.583333);
        let nvidia = read("type: 4, local: 0, shared: 0, gpr: 9, inst: 41, bytes: 328, cached: 0");
        assert_eq!(nvidia["inst"], 41.0);
        let intel = read("FS SIMD8 shader: 52 inst, 0 loops, 210 cycles, 0:0 spills:fills");
        assert_eq!(intel["cycles"], 210.0);
        assert!(read("FS SIMD16 shader: 52 inst, 0 loops").is_empty());
        assert!(read("VERT shader: 3 inst, 0 nops").is_empty());
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
