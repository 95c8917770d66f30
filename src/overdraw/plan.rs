//! What is drawn: the functions that are measured, and what they are held against.

use half::f16;

use crate::cost::{BLOCKS, ENTRY, Probe, VERTEX, WGSL_VERTEX};
use crate::emit::Emitted;
use crate::ir::{Param, Texels, Ty};
use crate::methods::Values;
use crate::num::Precision;

/// A function that is to be timed.
#[derive(Clone, Debug)]
pub struct TimedFunction {
    /// The function.
    pub emitted: Emitted,
    /// The material that it is specialised to, as a user types it.
    pub material: Option<String>,
    /// What its arguments are; a specialised function has none.
    pub values: Values,
    /// The table that it reads, where it reads one.
    pub table: Option<Texels>,
}

/// A shader ready to be compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// What it is, for messages.
    pub name: String,
    /// The module in WGSL with both entry points, [`Drawing::VERTEX`] and [`Drawing::FRAGMENT`].
    pub text: String,
    /// The bytes at binding 0.
    pub uniforms: Vec<u8>,
    /// The texture at binding 3.
    pub table: Option<Texels>,
    /// What it computes in.
    pub precision: Precision,
    /// Whether it is added to what lies below.
    pub blends: bool,
}

/// Everything that is drawn: what functions are held against first, then the functions.
#[derive(Clone, Debug)]
pub struct DrawingPlan {
    /// All of it.
    pub drawings: Vec<Drawing>,
    /// How often a draw evaluates its function.
    pub evaluations: usize,
    /// How many drawings stand before the functions.
    fixed: usize,
    /// The place of each function among the drawings, and of the empty shader that belongs to it.
    places: Vec<(usize, usize)>,
}

impl TimedFunction {
    fn drawing(&self, evaluations: usize) -> Drawing {
        let probe = Probe::new(&self.emitted.function, self.emitted.precision);
        Drawing {
            name: self.emitted.name.clone(),
            uniforms: uniforms(&probe, &self.values, self.emitted.precision),
            table: self.table.clone(),
            ..drawing(&probe, self.emitted.precision, evaluations)
        }
    }

    fn is_scalar(&self) -> bool {
        self.emitted.function.ty() == Ty::Scalar
    }
}

impl Drawing {
    /// The entry point for vertices.
    pub const VERTEX: &str = VERTEX;
    /// The entry point for pixels.
    pub const FRAGMENT: &str = ENTRY;
}

impl DrawingPlan {
    /// The heavy shader's place among the drawings.
    pub const HEAVY: usize = 0;
    /// That of the function whose cost is 1.
    pub const REFERENCE: usize = 1;
    /// That of the empty shader of three channels in single precision.
    pub const EMPTY: usize = 2;

    /// What is drawn for these functions: `reference` is what shares are of, `heavy` lies below all.
    pub fn new(
        heavy: &TimedFunction,
        reference: &TimedFunction,
        timed: &[TimedFunction],
        evaluations: usize,
    ) -> DrawingPlan {
        let heavy = Drawing {
            blends: false,
            ..heavy.drawing(1)
        };
        let mut drawings = vec![heavy, reference.drawing(evaluations)];
        let has_half = timed.iter().any(|timed| timed.emitted.precision.is_half());
        let precisions = if has_half { 2 } else { 1 };
        for precision in Precision::ALL.into_iter().take(precisions) {
            for result in [Ty::Rgb, Ty::Scalar] {
                let probe = Probe::empty(Ty::Scalar, result, precision);
                drawings.push(drawing(&probe, precision, evaluations));
            }
        }
        let fixed = drawings.len();
        let mut places = Vec::new();
        for timed in timed {
            let half = usize::from(timed.emitted.precision.is_half());
            let empty = DrawingPlan::EMPTY + 2 * half + usize::from(timed.is_scalar());
            let own = timed.drawing(evaluations);
            if own == drawings[DrawingPlan::REFERENCE] {
                places.push((DrawingPlan::REFERENCE, empty));
            } else {
                places.push((drawings.len(), empty));
                drawings.push(own);
            }
        }
        DrawingPlan {
            drawings,
            evaluations,
            fixed,
            places,
        }
    }

    /// The places of what functions are held against.
    pub fn fixed(&self) -> std::ops::Range<usize> {
        0..self.fixed
    }

    /// The places of each function and of its empty shader.
    pub fn places(&self) -> &[(usize, usize)] {
        &self.places
    }
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

/// A block of arguments for each evaluation: each argument begins at a multiple of 16 bytes and is no longer.
fn uniforms(probe: &Probe, values: &Values, precision: Precision) -> Vec<u8> {
    let member = |param: &Param| {
        let value = values.get(&param.name).copied().unwrap_or_default();
        let channels = if param.ty == Ty::Rgb { 3 } else { 1 };
        let number = |value: &f64| match precision {
            Precision::F32 => (*value as f32).to_ne_bytes().to_vec(),
            Precision::F16 => f16::from_f64(*value).to_ne_bytes().to_vec(),
        };
        let mut bytes: Vec<u8> = value[..channels].iter().flat_map(number).collect();
        bytes.resize(16, 0);
        bytes
    };
    let block: Vec<u8> = probe.uniforms().flat_map(member).collect();
    block.repeat(BLOCKS)
}
