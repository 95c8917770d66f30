//! The builder: operators that push nodes, so that a method reads like its formula. Equal nodes are shared.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::graph::{Function, Label, Node, NodeId, Param};
use super::op::{Letters, Op, Payload, Signature, Ty};
use crate::physics::num::Precision;

/// Collects the nodes of one function.
#[derive(Debug, Default)]
pub struct Builder {
    state: RefCell<State>,
}

#[derive(Debug, Default)]
struct State {
    params: Vec<Param>,
    nodes: Vec<Node>,
    known: BTreeMap<(Op, Vec<NodeId>, u64), NodeId>,
    letters: Letters,
}

/// A value under construction.
#[derive(Clone, Copy, Debug)]
pub struct Expr<'b> {
    builder: &'b Builder,
    id: NodeId,
}

impl Builder {
    /// An empty builder.
    pub fn new() -> Builder {
        Builder::default()
    }

    /// An empty builder of a function whose channels have these names.
    pub fn with_letters(letters: Letters) -> Builder {
        let state = State {
            letters,
            ..State::default()
        };
        Builder {
            state: RefCell::new(state),
        }
    }

    /// Adds an argument of the function.
    pub fn param(&self, name: &str, ty: Ty) -> Expr<'_> {
        let index = self.state.borrow().params.len();
        self.state.borrow_mut().params.push(Param {
            name: name.to_owned(),
            ty,
        });
        self.push(Op::Param, &[], Payload::Index(index))
    }

    /// A constant.
    pub fn number(&self, value: f64) -> Expr<'_> {
        self.push(Op::Number, &[], Payload::Number(value))
    }

    /// A constant colour.
    pub fn colour(&self, value: [f64; 3]) -> Expr<'_> {
        if value[0] == value[1] && value[1] == value[2] {
            return self.number(value[0]).rgb();
        }
        let [red, green, blue] = value.map(|channel| self.number(channel));
        self.compose(red, green, blue)
    }

    /// A colour from three scalars.
    pub fn compose<'b>(&'b self, red: Expr<'b>, green: Expr<'b>, blue: Expr<'b>) -> Expr<'b> {
        self.push(Op::Compose, &[red.id, green.id, blue.id], Payload::None)
    }

    /// The finished function, without the nodes that the result does not need.
    pub fn finish(&self, name: &str, result: Expr<'_>) -> Function {
        let state = self.state.borrow();
        let whole = Function {
            name: name.to_owned(),
            params: state.params.clone(),
            nodes: state.nodes.clone(),
            result: result.id,
            letters: state.letters,
        };
        whole.compact()
    }

    /// Adds a node, or returns the equal one that exists.
    pub(super) fn push(&self, op: Op, args: &[NodeId], payload: Payload) -> Expr<'_> {
        let bits = match payload {
            Payload::None => 0,
            Payload::Number(value) => value.to_bits(),
            Payload::Index(index) => index as u64,
        };
        let mut state = self.state.borrow_mut();
        let key = (op, args.to_vec(), bits);
        if let Some(id) = state.known.get(&key) {
            return self.expr(*id);
        }
        let ty = state.result_type(op, args, payload);
        state.nodes.push(Node {
            op,
            args: args.to_vec(),
            payload,
            ty,
            label: None,
        });
        let id = state.nodes.len() - 1;
        state.known.insert(key, id);
        self.expr(id)
    }

    pub(super) fn node(&self, id: NodeId) -> Node {
        self.state.borrow().nodes[id].clone()
    }

    pub(super) fn expr(&self, id: NodeId) -> Expr<'_> {
        Expr { builder: self, id }
    }
}

impl State {
    /// Panics where types do not match. That is a mistake in a method's source, found by the first test that
    /// builds it. No user input can cause it.
    fn result_type(&self, op: Op, args: &[NodeId], payload: Payload) -> Ty {
        if let (Op::Param, Payload::Index(index)) = (op, payload) {
            return self.params[index].ty;
        }
        let types: Vec<Ty> = args.iter().map(|id| self.nodes[*id].ty).collect();
        match op.info().signature.result(&types) {
            Some(ty) => ty,
            None => panic!("{} does not take {types:?}", op.info().name),
        }
    }
}

impl<'b> Expr<'b> {
    /// The node of this value.
    pub fn id(self) -> NodeId {
        self.id
    }

    /// The builder that this value belongs to.
    pub fn builder(self) -> &'b Builder {
        self.builder
    }

    /// The type of this value.
    pub fn ty(self) -> Ty {
        self.builder.state.borrow().nodes[self.id].ty
    }

    /// Names this step and gives its reason. A name that it already has stays.
    pub fn named(self, name: &str, why: &str) -> Expr<'b> {
        let label = Label {
            name: name.to_owned(),
            why: why.to_owned(),
        };
        self.builder.state.borrow_mut().nodes[self.id]
            .label
            .get_or_insert(label);
        self
    }

    /// The same, replacing any name it has.
    pub(super) fn renamed(self, label: Label) -> Expr<'b> {
        self.builder.state.borrow_mut().nodes[self.id].label = Some(label);
        self
    }

    /// |x|
    pub fn abs(self) -> Expr<'b> {
        self.unary(Op::Abs)
    }

    /// √x
    pub fn sqrt(self) -> Expr<'b> {
        self.unary(Op::Sqrt)
    }

    /// 1/√x
    pub fn inverse_sqrt(self) -> Expr<'b> {
        self.unary(Op::InverseSqrt)
    }

    /// x limited to [0, 1]
    pub fn saturate(self) -> Expr<'b> {
        self.unary(Op::Saturate)
    }

    /// 2ˣ
    pub fn exp2(self) -> Expr<'b> {
        self.unary(Op::Exp2)
    }

    /// log₂ x
    pub fn log2(self) -> Expr<'b> {
        self.unary(Op::Log2)
    }

    /// sin x, x in radians
    pub fn sin(self) -> Expr<'b> {
        self.unary(Op::Sin)
    }

    /// cos x, x in radians
    pub fn cos(self) -> Expr<'b> {
        self.unary(Op::Cos)
    }

    /// x²
    pub fn squared(self) -> Expr<'b> {
        self * self
    }

    /// xᵖ for a real p and x ≥ 0, as exp2(p log2(max(x, 2⁻¹²⁶))). 2⁻¹²⁶ is the smallest normal f32, so the
    /// logarithm stays finite on every target. In half precision the same clamp at 2⁻¹⁴, its smallest normal
    /// number, would be visible, so the power is 0 below it.
    pub fn power(self, exponent: Expr<'b>, precision: Precision) -> Expr<'b> {
        let power = (exponent * self.at_least(precision.smallest()).log2()).exp2();
        if !precision.is_half() {
            return power;
        }
        let number = |value: f64| self.builder.number(value);
        let power = power.named("raised", "");
        self.choose_below(number(precision.smallest()), number(0.0), power)
    }

    /// Samples this texture at (u, v).
    pub fn sample(self, u: Expr<'b>, v: Expr<'b>) -> Expr<'b> {
        let args = [self.id, u.id, v.id];
        self.builder.push(Op::Sample, &args, Payload::None)
    }

    /// The fourth channel of this texture at (u, v).
    pub fn sample_alpha(self, u: Expr<'b>, v: Expr<'b>) -> Expr<'b> {
        let args = [self.id, u.id, v.id];
        self.builder.push(Op::SampleAlpha, &args, Payload::None)
    }

    /// Samples this cube in a direction.
    pub fn sample_cube(self, direction: Expr<'b>) -> Expr<'b> {
        let args = [self.id, direction.id];
        self.builder.push(Op::SampleCube, &args, Payload::None)
    }

    /// The dot product of two vectors.
    pub fn dot(self, other: Expr<'b>) -> Expr<'b> {
        self.builder
            .push(Op::Dot, &[self.id, other.id], Payload::None)
    }

    /// A row of this matrix times the column vector (point, 1).
    pub fn transform(self, row: usize, place: Expr<'b>) -> Expr<'b> {
        let args = [self.id, place.id];
        self.builder.push(Op::Transform, &args, Payload::Index(row))
    }

    /// The larger of this and a number.
    pub fn at_least(self, low: f64) -> Expr<'b> {
        self.max(self.builder.number(low))
    }

    /// The smaller of this and a number.
    pub fn at_most(self, high: f64) -> Expr<'b> {
        self.min(self.builder.number(high))
    }

    /// The larger.
    pub fn max(self, other: Expr<'b>) -> Expr<'b> {
        self.alike(Op::Max, other)
    }

    /// The smaller.
    pub fn min(self, other: Expr<'b>) -> Expr<'b> {
        self.alike(Op::Min, other)
    }

    /// One channel of a colour.
    pub fn channel(self, index: usize) -> Expr<'b> {
        self.builder
            .push(Op::Channel, &[self.id], Payload::Index(index))
    }

    /// This value as a colour: a scalar goes into each channel.
    pub fn rgb(self) -> Expr<'b> {
        if self.ty() == Ty::Vec3 {
            self
        } else {
            self.unary(Op::Splat)
        }
    }

    /// `yes` in the channels where this is below `bound`, else `no`. It is a scalar select for each channel.
    pub fn choose_below(self, bound: Expr<'b>, yes: Expr<'b>, no: Expr<'b>) -> Expr<'b> {
        let parts = [self, bound, yes, no];
        if parts.iter().all(|part| part.ty() == Ty::Scalar) {
            return self.choose(bound, yes, no);
        }
        let pick = |index: usize| {
            let [value, bound, yes, no] = parts.map(|part| {
                if part.ty() == Ty::Vec3 {
                    part.channel(index)
                } else {
                    part
                }
            });
            value.choose(bound, yes, no)
        };
        self.builder.compose(pick(0), pick(1), pick(2))
    }

    fn choose(self, bound: Expr<'b>, yes: Expr<'b>, no: Expr<'b>) -> Expr<'b> {
        let condition = self
            .builder
            .push(Op::Less, &[self.id, bound.id], Payload::None);
        self.builder
            .push(Op::Select, &[condition.id, yes.id, no.id], Payload::None)
    }

    fn unary(self, op: Op) -> Expr<'b> {
        self.builder.push(op, &[self.id], Payload::None)
    }

    fn alike(self, op: Op, other: Expr<'b>) -> Expr<'b> {
        debug_assert_eq!(op.info().signature, Signature::Alike);
        let (a, b) = if self.ty() == other.ty() {
            (self, other)
        } else {
            (self.rgb(), other.rgb())
        };
        self.builder.push(op, &[a.id, b.id], Payload::None)
    }
}

impl<'b> Neg for Expr<'b> {
    type Output = Expr<'b>;

    fn neg(self) -> Expr<'b> {
        self.unary(Op::Neg)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $op:expr) => {
        impl<'b> $trait for Expr<'b> {
            type Output = Expr<'b>;

            fn $method(self, other: Expr<'b>) -> Expr<'b> {
                self.builder.push($op, &[self.id, other.id], Payload::None)
            }
        }

        impl<'b> $trait<f64> for Expr<'b> {
            type Output = Expr<'b>;

            fn $method(self, other: f64) -> Expr<'b> {
                self.$method(self.builder.number(other))
            }
        }

        impl<'b> $trait<Expr<'b>> for f64 {
            type Output = Expr<'b>;

            fn $method(self, other: Expr<'b>) -> Expr<'b> {
                other.builder.number(self).$method(other)
            }
        }
    };
}

operator!(Add, add, Op::Add);
operator!(Sub, sub, Op::Sub);
operator!(Mul, mul, Op::Mul);
operator!(Div, div, Op::Div);
