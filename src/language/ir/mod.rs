//! The intermediate representation: a pure dataflow graph, small enough to be printed in any shading language.
//!
//! # Rules of evaluation
//! 1. A [`Function`] is a list of [`Node`]s; a node's arguments stand before it. There is no control flow, no
//!    loop, no array, no memory and no call: every node is evaluated once, in order, for every input.
//! 2. Values are a `Scalar`, a `Vec3` (three channels that mix only in `channel`, `compose`, `dot` and `transform`) or a
//!    `Bool`. Textures, cubes, vectors of two or four numbers and matrices are arguments only. `add`, `sub`, `mul` and
//!    `div` accept a scalar beside a colour and apply it to each channel; `min` and `max` want equal types.
//! 3. A choice is a scalar `select`: both sides are evaluated, one is taken. It is never a blend, because a blend
//!    with weight 0 turns infinity into NaN.
//! 4. A comparison with a NaN is false; `min` and `max` with a NaN give the other operand; `saturate` of a NaN
//!    gives 0. Targets may promise less, so no formula may rely on this.
//! 5. Numbers are f64 in the graph. Each evaluation rounds them to its own precision first, and then rounds
//!    after every operation.
//! 6. Integer powers are written as multiplications. A real power is `exp2(p * log2(max(x, 2^-126)))`
//!    ([`Expr::power`]), never `pow`; in half precision it is 0 below 2^-14.
//! 7. A labelled node becomes a named variable with its reason as a comment, in every language.
//!
//! This room knows no method, no target and no material.

mod build;
mod check;
mod evaluate;
mod fold;
mod graph;
mod op;
mod texture;

pub use build::{Builder, Expr};
pub use check::{BrokenRule, Checked, RULES, check, check_in};
pub use evaluate::{Column, Repeated, Value, evaluate};
pub use fold::{USED_TWICE, fold, fold_in, specialise, specialise_in};
pub use graph::{COSINE, Function, Label, Node, NodeId, Param, print};
pub use op::{Letters, OPS, Op, Payload, Signature, Ty};
pub use texture::{CubeTexels, Filter, Texels, Weights, filtered};
