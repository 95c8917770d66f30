//! The identities by which formulas are rewritten, and the models of cost by which some are drawn.

use core::hash::{Hash, Hasher};
use std::collections::BTreeSet;
use std::collections::hash_map::DefaultHasher;

use egg::{Analysis, CostFunction, DidMerge, EGraph, Id, Language, Pattern, Rewrite};
use fresnel_gen::language::ir::{Checked, Ty};

use crate::formula::{Formula, Number};

/// Both sides are equal over the reals, where both are defined.
const IDENTITIES: &[(&str, &str)] = &[
    ("(+ ?a ?b)", "(+ ?b ?a)"),
    ("(* ?a ?b)", "(* ?b ?a)"),
    ("(+ ?a (+ ?b ?c))", "(+ (+ ?a ?b) ?c)"),
    ("(* ?a (* ?b ?c))", "(* (* ?a ?b) ?c)"),
    ("(- ?a (- ?b ?c))", "(+ (- ?a ?b) ?c)"),
    ("(- ?a (+ ?b ?c))", "(- (- ?a ?b) ?c)"),
    ("(- (+ ?a ?b) ?c)", "(+ ?a (- ?b ?c))"),
    ("(* ?a (+ ?b ?c))", "(+ (* ?a ?b) (* ?a ?c))"),
    ("(* ?a (- ?b ?c))", "(- (* ?a ?b) (* ?a ?c))"),
    ("(+ ?a (* ?a ?b))", "(* ?a (+ 1.0 ?b))"),
    ("(- ?a (* ?a ?b))", "(* ?a (- 1.0 ?b))"),
    ("(- (* ?a ?b) ?a)", "(* ?a (- ?b 1.0))"),
    ("(+ ?a ?a)", "(* 2.0 ?a)"),
    ("(* (- ?a ?b) ?c)", "(* (- ?b ?a) (- 0.0 ?c))"),
    ("(- ?a (* ?b ?c))", "(+ ?a (* ?b (- 0.0 ?c)))"),
    ("(/ (* ?a ?b) ?c)", "(* ?a (/ ?b ?c))"),
    ("(/ ?a (* ?b ?c))", "(/ (/ ?a ?b) ?c)"),
    ("(* (/ ?a ?b) (/ ?c ?d))", "(/ (* ?a ?c) (* ?b ?d))"),
    ("(- 1.0 (/ ?a ?b))", "(/ (- ?b ?a) ?b)"),
    ("(* ?a (rsqrt ?b))", "(/ ?a (sqrt ?b))"),
    ("(* (sqrt ?a) (sqrt ?a))", "?a"),
    ("(* ?a (rsqrt ?a))", "(sqrt ?a)"),
    ("(sat (min ?a 1.0))", "(sat ?a)"),
];

/// One way only: the right side is simpler.
const SIMPLER: &[(&str, &str)] = &[
    ("(+ ?a 0.0)", "?a"),
    ("(- ?a 0.0)", "?a"),
    ("(* ?a 1.0)", "?a"),
    ("(* ?a 0.0)", "0.0"),
    ("(- 0.0 (- ?a ?b))", "(- ?b ?a)"),
    ("(- 0.0 (- 0.0 ?a))", "?a"),
];

pub fn rules() -> Vec<Rewrite<Formula, Known>> {
    let rule = |(name, from, to): (String, &str, &str)| {
        let side = |text: &str| -> Pattern<Formula> { text.parse().expect("it is a pattern") };
        Rewrite::new(name, side(from), side(to)).expect("its right side has no new variables")
    };
    let there = IDENTITIES.iter().chain(SIMPLER).enumerate();
    let there = there.map(|(i, (from, to))| (format!("{i}"), *from, *to));
    // A bare variable on the left would match everything.
    let back = IDENTITIES
        .iter()
        .enumerate()
        .filter(|(_, (_, to))| to.starts_with('('));
    let back = back.map(|(i, (from, to))| (format!("-{i}"), *to, *from));
    there
        .chain(back)
        .filter(|(_, from, to)| variables(from).is_superset(&variables(to)))
        .map(rule)
        .collect()
}

fn variables(text: &str) -> BTreeSet<&str> {
    let words = text.split(['(', ')', ' ']);
    words.filter(|word| word.starts_with('?')).collect()
}

/// What is known of a class: its value where it is constant, and whether it is a colour.
#[derive(Clone, Debug, Default)]
pub struct Fact {
    pub constant: Option<f64>,
    pub is_colour: bool,
}

/// Which arguments and named steps are colours.
#[derive(Clone, Debug, Default)]
pub struct Known {
    colours: BTreeSet<String>,
}

impl Known {
    pub fn of(graph: &Checked) -> Known {
        let arguments = graph.params.iter().map(|param| (&param.name, param.ty));
        let steps = graph.nodes.iter();
        let steps = steps.filter_map(|node| Some((&node.label.as_ref()?.name, node.ty)));
        let colours = arguments.chain(steps).filter(|(_, ty)| *ty == Ty::Vec3);
        Known {
            colours: colours.map(|(name, _)| name.clone()).collect(),
        }
    }
}

impl Analysis<Formula> for Known {
    type Data = Fact;

    fn make(egraph: &mut EGraph<Formula, Known>, formula: &Formula, _: Id) -> Fact {
        let value = |id: &Id| egraph[*id].data.constant;
        let both = |[a, b]: &[Id; 2], of: fn(f64, f64) -> f64| Some(of(value(a)?, value(b)?));
        let constant = match formula {
            Formula::Number(number) => Some(number.value()),
            Formula::Add(two) => both(two, |a, b| a + b),
            Formula::Sub(two) => both(two, |a, b| a - b),
            Formula::Mul(two) => both(two, |a, b| a * b),
            _ => None,
        };
        let is_colour = match formula {
            Formula::Argument(name) => egraph.analysis.colours.contains(name.as_str()),
            _ => formula
                .children()
                .iter()
                .any(|id| egraph[*id].data.is_colour),
        };
        Fact {
            constant,
            is_colour,
        }
    }

    fn merge(&mut self, to: &mut Fact, from: Fact) -> DidMerge {
        // A class is a colour only where each of its expressions is: `x - x` of a colour is 0.
        let before = to.clone();
        to.constant = to.constant.or(from.constant);
        to.is_colour &= from.is_colour;
        DidMerge(
            before.constant.is_some() != to.constant.is_some() || before.is_colour != to.is_colour,
            from.constant.is_some() != to.constant.is_some() || from.is_colour != to.is_colour,
        )
    }

    fn modify(egraph: &mut EGraph<Formula, Known>, id: Id) {
        if let Some(value) = egraph[id].data.constant {
            let number = egraph.add(Formula::Number(Number::new(value)));
            egraph.union(id, number);
        }
    }
}

/// A model of cost: what operations and colours weigh is drawn, and each expression is a little cheaper or dearer.
pub struct Drawn<'a> {
    egraph: &'a EGraph<Formula, Known>,
    seed: u64,
    colour: f64,
    division: f64,
    spread: f64,
}

impl<'a> Drawn<'a> {
    pub fn new(egraph: &'a EGraph<Formula, Known>, seed: u64) -> Drawn<'a> {
        let pick = |of: &str, choices: &[f64]| {
            choices[(hash(&(of, seed)) % choices.len() as u64) as usize]
        };
        Drawn {
            egraph,
            seed,
            colour: pick("colour", &[1.0, 2.0, 3.0]),
            division: pick("division", &[1.0, 4.0, 8.0]),
            spread: pick("spread", &[0.1, 0.3, 0.8, 1.5]),
        }
    }
}

fn hash(of: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    hasher.finish()
}

impl CostFunction<Formula> for Drawn<'_> {
    type Cost = f64;

    fn cost<C: FnMut(Id) -> f64>(&mut self, formula: &Formula, mut costs: C) -> f64 {
        let weight = match formula {
            Formula::Number(_) | Formula::Argument(_) => 0.01,
            Formula::Saturate(_) | Formula::Abs(_) | Formula::Neg(_) => 0.5,
            Formula::Div(_) | Formula::Sqrt(_) | Formula::InverseSqrt(_) => self.division,
            _ => 1.0,
        };
        let is_colour = formula
            .children()
            .iter()
            .any(|id| self.egraph[*id].data.is_colour);
        let weight = if is_colour {
            weight * self.colour
        } else {
            weight
        };
        let part = (hash(&(formula, self.seed)) >> 11) as f64 / (1u64 << 53) as f64;
        formula.fold(weight * (1.0 + self.spread * part), |sum, id| {
            sum + costs(id)
        })
    }
}
