//! The drawings: those of the measured functions, and the reference shaders that they are compared with.

use core::ops::Range;

use half::f16;

use crate::lab::cost::{BLOCKS, FunctionId, Probe, WGSL_VERTEX};
use crate::language::ir::{Checked, Param, Texels, Ty};
use crate::language::methods::Values;
use crate::physics::num::Precision;

/// A function that is to be timed.
#[derive(Clone, Debug)]
pub struct TimedFunction {
    /// Which function it is.
    pub id: FunctionId,
    /// Its name in a text.
    pub name: String,
    /// Its graph.
    pub graph: Checked,
    /// The values of its arguments. A specialised function has none.
    pub values: Values,
    /// The table that it reads, if any.
    pub table: Option<Texels>,
}

/// A shader ready to be compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Its name, for messages.
    pub name: String,
    /// The module in WGSL with both entry points, [`VERTEX`](crate::lab::cost::VERTEX) and [`ENTRY`](crate::lab::cost::ENTRY).
    pub text: String,
    /// The bytes at binding 0.
    pub uniforms: Vec<u8>,
    /// The texture at binding 3.
    pub table: Option<Texels>,
    /// The precision that it computes in.
    pub precision: Precision,
    /// Whether it is blended additively.
    pub blends: bool,
}

/// A chain of evaluations in a draw, and one of twice as many. The difference of their times is that of evaluations alone,
/// whatever the draw itself costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawnChain {
    /// The index of the shorter one among the drawings. The longer one is the next.
    pub short: usize,
    /// Evaluations in the shorter one. The longer one has twice as many.
    pub evaluations: usize,
}

/// All drawings: the reference shaders first, then the functions.
#[derive(Clone, Debug)]
pub struct DrawingPlan {
    /// The drawings, in order.
    pub drawings: Vec<Drawing>,
    /// The approximate number of operations in a long chain.
    pub operations: usize,
    /// The chain of the function whose cost is 1.
    pub reference: DrawnChain,
    /// The chain of the empty shader of three channels in single precision.
    pub empty: DrawnChain,
    /// The indices of the reference shaders, before those of the functions.
    pub fixed: Range<usize>,
    /// The chain of each function, and of the empty one that belongs to it.
    pub chains: Vec<[DrawnChain; 2]>,
}

/// Operations in a long chain if none are given. A graphics card hides cheap evaluations behind the draw, a processor does not.
pub const fn usual_operations(is_software: bool) -> usize {
    if is_software { 400 } else { 2000 }
}

/// The most arguments of all evaluations of a long chain, at 16 bytes each. OpenGL guarantees 16 KiB of uniforms.
const MOST_ARGUMENTS: usize = 1000;

impl TimedFunction {
    fn drawing(&self, evaluations: usize) -> Drawing {
        let probe = Probe::new(&self.graph, self.id.precision);
        Drawing {
            name: self.name.clone(),
            uniforms: uniforms(&probe, &self.values, self.id.precision, evaluations),
            table: self.table.clone(),
            ..drawing(&probe, self.id.precision, evaluations)
        }
    }

    /// Evaluations in the shorter of its chains.
    fn evaluations(&self, operations: usize) -> usize {
        let probe = Probe::new(&self.graph, self.id.precision);
        let arguments = probe.uniforms().count();
        half_chain(
            operations,
            self.graph.work(),
            arguments,
            self.id.channels == 1,
        )
    }
}

impl DrawnChain {
    /// The index of the longer one among the drawings.
    pub fn long(self) -> usize {
        self.short + 1
    }
}

impl DrawingPlan {
    /// The index of the heavy shader among the drawings.
    pub const HEAVY: usize = 0;
    /// The index of a draw without a function: the empty shader, once.
    pub const BARE: usize = 1;

    /// The drawings for these functions in chains of so many operations. Shares are relative to `reference`, and `heavy` is drawn
    /// below all.
    pub fn new(
        heavy: &TimedFunction,
        reference: &TimedFunction,
        timed: &[TimedFunction],
        operations: usize,
    ) -> DrawingPlan {
        let heavy = Drawing {
            blends: false,
            ..heavy.drawing(1)
        };
        let empty = |result: Ty, precision: Precision, evaluations: usize| {
            let probe = Probe::empty(Ty::Scalar, result, precision);
            drawing(&probe, precision, evaluations)
        };
        let mut drawings = vec![heavy, empty(Ty::Vec3, Precision::F32, 1)];
        let mut add = |evaluations: usize, of: &dyn Fn(usize) -> Drawing| {
            drawings.extend([of(evaluations), of(2 * evaluations)]);
            DrawnChain {
                short: drawings.len() - 2,
                evaluations,
            }
        };
        let own = |timed: &TimedFunction| timed.evaluations(operations);
        let reference_once = reference.drawing(1);
        let reference_chain = add(own(reference), &|n| reference.drawing(n));
        let has_half = timed.iter().any(|timed| timed.id.precision.is_half());
        let precisions = if has_half { 2 } else { 1 };
        let mut empties = Vec::new();
        for precision in Precision::ALL.into_iter().take(precisions) {
            for result in [Ty::Vec3, Ty::Scalar] {
                let evaluations = half_chain(operations, 0, 0, result == Ty::Scalar);
                empties.push(add(evaluations, &|n| empty(result, precision, n)));
            }
        }
        let fixed = 0..empties[empties.len() - 1].long() + 1;
        let mut chain = |timed: &TimedFunction| {
            let half = usize::from(timed.id.precision.is_half());
            let empty = empties[2 * half + usize::from(timed.id.channels == 1)];
            let own = if timed.graph.work() == 0 {
                // A function that computes nothing costs 0: a compiler removes a chain in which nothing depends on the cosine.
                empty
            } else if timed.drawing(1) == reference_once {
                reference_chain
            } else {
                add(own(timed), &|n| timed.drawing(n))
            };
            [own, empty]
        };
        let chains = timed.iter().map(&mut chain).collect();
        DrawingPlan {
            drawings,
            operations,
            reference: reference_chain,
            empty: empties[0],
            fixed,
            chains,
        }
    }

    /// All chains that a function's figure depends on: its own two, and those of the function whose cost is 1.
    pub fn held(&self, function: usize) -> [DrawnChain; 4] {
        let [own, empty] = self.chains[function];
        [own, empty, self.reference, self.empty]
    }
}

/// Evaluations in the shorter chain of a function of so much work and so many arguments. They fill half of the operations,
/// including those between one evaluation and the next.
fn half_chain(operations: usize, work: usize, arguments: usize, is_scalar: bool) -> usize {
    let link = if is_scalar { 1 } else { 2 };
    (operations / 2 / (work + link)).clamp(1, MOST_ARGUMENTS / 2 / arguments.max(1))
}

fn drawing(probe: &Probe, precision: Precision, evaluations: usize) -> Drawing {
    Drawing {
        name: "the empty shader".to_owned(),
        text: probe.wgsl(evaluations) + WGSL_VERTEX,
        uniforms: Vec::new(),
        table: None,
        precision,
        blends: true,
    }
}

/// A block of arguments for each evaluation. Each argument begins at a multiple of 16 bytes and takes at most 16.
fn uniforms(probe: &Probe, values: &Values, precision: Precision, evaluations: usize) -> Vec<u8> {
    let member = |param: &Param| {
        let value = values.get(&param.name).copied().unwrap_or_default();
        let channels = if param.ty == Ty::Vec3 { 3 } else { 1 };
        let number = |value: &f64| match precision {
            Precision::F32 => (*value as f32).to_ne_bytes().to_vec(),
            Precision::F16 => f16::from_f64(*value).to_ne_bytes().to_vec(),
        };
        let mut bytes: Vec<u8> = value[..channels].iter().flat_map(number).collect();
        bytes.resize(16, 0);
        bytes
    };
    let block: Vec<u8> = probe.uniforms().flat_map(member).collect();
    block.repeat(evaluations.max(BLOCKS))
}
