//! The interpreter: tokens, expressions by precedence, statements. Written from the languages' grammars, not from the
//! printer.

use std::collections::BTreeMap;

use fresnel_gen::language::ir::{Texels, Weights};
use fresnel_gen::physics::num::Precision;

/// A value while a program runs.
#[derive(Clone, Copy, Debug)]
pub enum Term {
    Scalar(f32),
    Colour([f32; 3]),
    Bool(bool),
    Pair([f32; 2]),
    /// A texture; where a language has its sampler apart, that one too.
    Texture,
}

impl Term {
    pub fn colour(self) -> [f32; 3] {
        match self {
            Term::Scalar(value) => [value; 3],
            Term::Colour(value) => value,
            _ => panic!("{self:?} where a number is wanted"),
        }
    }

    fn scalar(self) -> f32 {
        let Term::Scalar(value) = self else {
            panic!("{self:?} where a scalar is wanted")
        };
        value
    }

    /// As a precision has it; of f32 that came of f16 this is what one rounding to f16 had given.
    fn rounded(self, precision: Precision) -> Term {
        let round = |value: f32| precision.rounded(f64::from(value)) as f32;
        match self {
            Term::Scalar(_) | Term::Colour(_) => self.map(round),
            other => other,
        }
    }

    fn map(self, f: impl Fn(f32) -> f32) -> Term {
        match self {
            Term::Scalar(value) => Term::Scalar(f(value)),
            other => Term::Colour(other.colour().map(f)),
        }
    }

    fn zip(self, other: Term, f: impl Fn(f32, f32) -> f32) -> Term {
        match (self, other) {
            (Term::Scalar(a), Term::Scalar(b)) => Term::Scalar(f(a, b)),
            _ => {
                let (a, b) = (self.colour(), other.colour());
                Term::Colour([0, 1, 2].map(|i| f(a[i], b[i])))
            }
        }
    }
}

/// One function: the names of its arguments, its statements as tokens.
pub struct Program {
    params: Vec<String>,
    precision: Precision,
    /// What every texture holds.
    table: Texels,
    /// The variable that a statement sets; nothing for `return`.
    statements: Vec<(Option<String>, Vec<String>)>,
    /// Functions that it calls, by name.
    callees: BTreeMap<String, Program>,
}

impl Program {
    /// Finds a function by name in a file.
    pub fn parse(text: &str, name: &str, table: &Texels, precision: Precision) -> Program {
        let code: String = text
            .lines()
            .map(|line| line.split("//").next().unwrap_or(""))
            .collect::<Vec<_>>()
            .join("\n");
        let plain = code
            .replace("metal::", "")
            .replace("vec3<f32>", "vec3")
            .replace("vec3<f16>", "vec3")
            .replace("half3", "vec3")
            .replace("mediump ", "")
            .replace("vec2<f32>", "vec2")
            .replace("float2", "vec2")
            .replace("float3", "vec3")
            .replace("highp ", "");
        let start = plain
            .find(&format!("{name}("))
            .unwrap_or_else(|| panic!("no {name} in\n{text}"));
        let (params, rest) = plain[start + name.len() + 1..]
            .split_once(')')
            .expect("arguments end");
        let (_, rest) = rest.split_once('{').expect("a body begins");
        let (body, _) = rest.split_once('}').expect("a body ends");
        Program {
            params: params.split(',').map(parameter).collect(),
            precision,
            table: table.clone(),
            statements: body
                .split(';')
                .map(tokens)
                .filter(|line| !line.is_empty())
                .map(statement)
                .collect(),
            callees: BTreeMap::new(),
        }
    }

    /// The same, with another function that it calls.
    pub fn calling(mut self, name: &str, callee: Program) -> Program {
        self.callees.insert(name.to_owned(), callee);
        self
    }

    /// Runs it.
    pub fn run(&self, arguments: &[Term]) -> Term {
        let is_sampler = |name: &&str| name.ends_with("_sampler");
        let names = self.params.iter().map(String::as_str);
        let taken: Vec<&str> = names.clone().filter(|name| !is_sampler(name)).collect();
        assert_eq!(taken.len(), arguments.len());
        let samplers = names.filter(is_sampler).map(|name| (name, Term::Texture));
        let given = taken.into_iter().zip(arguments.iter().copied());
        let mut known: BTreeMap<&str, Term> = given.chain(samplers).collect();
        for (name, tokens) in &self.statements {
            let mut reader = Reader {
                tokens,
                at: 0,
                known: &known,
                precision: self.precision,
                table: &self.table,
                callees: &self.callees,
            };
            let value = reader.ternary();
            assert_eq!(
                reader.at,
                tokens.len(),
                "a statement goes on after its expression: {tokens:?}"
            );
            match name {
                Some(name) => known.insert(name, value),
                None => return value,
            };
        }
        panic!("a function ends without `return`")
    }
}

/// `highp vec3 f0` and `f0: vec3` alike.
fn parameter(text: &str) -> String {
    let text = text.trim();
    match text.split_once(':') {
        Some((name, _)) => name.trim().to_owned(),
        None => text.rsplit(' ').next().expect("it has a name").to_owned(),
    }
}

fn statement(tokens: Vec<String>) -> (Option<String>, Vec<String>) {
    if tokens[0] == "return" {
        return (None, tokens[1..].to_vec());
    }
    let equals = tokens
        .iter()
        .position(|token| token == "=")
        .expect("a declaration has a value");
    (
        Some(tokens[equals - 1].clone()),
        tokens[equals + 1..].to_vec(),
    )
}

fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut joined = false;
    for c in text.chars() {
        let last = tokens.last().map_or("", String::as_str);
        let in_number = last.starts_with(|c: char| c.is_ascii_digit());
        let word = c.is_ascii_alphanumeric() || c == '_' || c == '.' && in_number;
        let exponent = (c == '-' || c == '+') && in_number && last.ends_with('e');
        let extends = joined && (word || exponent);
        if extends {
            tokens.last_mut().expect("it is there").push(c);
        } else if !c.is_whitespace() {
            tokens.push(c.to_string());
        }
        joined = extends || word;
    }
    tokens
}

struct Reader<'a> {
    tokens: &'a [String],
    at: usize,
    known: &'a BTreeMap<&'a str, Term>,
    precision: Precision,
    table: &'a Texels,
    callees: &'a BTreeMap<String, Program>,
}

impl Reader<'_> {
    fn peek(&self) -> &str {
        self.tokens.get(self.at).map_or("", String::as_str)
    }

    fn take(&mut self, token: &str) -> bool {
        let found = self.peek() == token;
        self.at += usize::from(found);
        found
    }

    fn ternary(&mut self) -> Term {
        let condition = self.comparison();
        if !self.take("?") {
            return condition;
        }
        let yes = self.ternary();
        assert!(self.take(":"));
        let no = self.ternary();
        choose(condition, yes, no)
    }

    fn comparison(&mut self) -> Term {
        let left = self.sum();
        if self.take("<") {
            Term::Bool(left.scalar() < self.sum().scalar())
        } else {
            left
        }
    }

    fn sum(&mut self) -> Term {
        let mut left = self.product();
        loop {
            if self.take("+") {
                left = left
                    .zip(self.product(), |a, b| a + b)
                    .rounded(self.precision);
            } else if self.take("-") {
                left = left
                    .zip(self.product(), |a, b| a - b)
                    .rounded(self.precision);
            } else {
                return left;
            }
        }
    }

    fn product(&mut self) -> Term {
        let mut left = self.prefix();
        loop {
            if self.take("*") {
                left = left
                    .zip(self.prefix(), |a, b| a * b)
                    .rounded(self.precision);
            } else if self.take("/") {
                left = left
                    .zip(self.prefix(), |a, b| a / b)
                    .rounded(self.precision);
            } else {
                return left;
            }
        }
    }

    fn prefix(&mut self) -> Term {
        if self.take("-") {
            self.prefix().map(|a| -a)
        } else {
            self.postfix()
        }
    }

    fn postfix(&mut self) -> Term {
        let value = self.primary();
        if !self.take(".") {
            return value;
        }
        self.at += 1;
        match self.tokens[self.at - 1].as_str() {
            "r" | "x" => Term::Scalar(value.colour()[0]),
            "g" | "y" => Term::Scalar(value.colour()[1]),
            "b" | "z" => Term::Scalar(value.colour()[2]),
            "xxx" => Term::Colour([value.scalar(); 3]),
            method => {
                let method = method.to_owned();
                assert!(self.take("("), "no member {method}");
                let arguments = self.arguments();
                self.member(value, &method, &arguments)
            }
        }
    }

    fn primary(&mut self) -> Term {
        if self.take("(") {
            let value = self.ternary();
            assert!(
                self.take(")"),
                "a parenthesis stays open: {:?}",
                self.tokens
            );
            return value;
        }
        let name = self.peek().to_owned();
        self.at += 1;
        if self.take("(") {
            let arguments = self.arguments();
            return self.called(&name, &arguments);
        }
        match name.trim_end_matches(['f', 'h']).parse() {
            Ok(number) if name.starts_with(|c: char| c.is_ascii_digit()) => {
                Term::Scalar(number).rounded(self.precision)
            }
            _ => *self
                .known
                .get(name.as_str())
                .unwrap_or_else(|| panic!("`{name}` is not known: {:?}", self.tokens)),
        }
    }

    /// `table.SampleLevel(table_sampler, at, 0.0).rgb` and `table.sample(table_sampler, at, level(0.0)).rgb`
    fn member(&mut self, value: Term, method: &str, arguments: &[Term]) -> Term {
        let sampled = match (value, method, arguments) {
            (Term::Texture, "SampleLevel" | "sample", [Term::Texture, at, level])
                if is_base(*level) =>
            {
                self.sample(*at)
            }
            _ => panic!("no member {method} of {value:?} with {arguments:?}"),
        };
        assert!(self.take(".") && self.take("rgb"));
        sampled
    }

    /// A texture's colour, or an ordinary function's result.
    fn called(&mut self, name: &str, arguments: &[Term]) -> Term {
        match (name, arguments) {
            ("textureLod", [Term::Texture, at, level])
            | ("textureSampleLevel", [Term::Texture, Term::Texture, at, level])
                if is_base(*level) =>
            {
                let sampled = self.sample(*at);
                assert!(self.take(".") && self.take("rgb"));
                sampled
            }
            ("dot", [Term::Colour(a), Term::Colour(b)]) => {
                let rounded = |x: f32| Term::Scalar(x).rounded(self.precision).scalar();
                let [x, y, z] = [0, 1, 2].map(|i| rounded(a[i] * b[i]));
                Term::Scalar(rounded(rounded(x + y) + z))
            }
            _ => match self.callees.get(name) {
                Some(callee) => callee.run(arguments),
                None => call(name, arguments).rounded(self.precision),
            },
        }
    }

    fn sample(&self, at: Term) -> Term {
        let Term::Pair([u, v]) = at else {
            panic!("{at:?} where two coordinates are wanted")
        };
        Term::Colour(self.table.sample(Weights::Exact, u, v))
    }

    fn arguments(&mut self) -> Vec<Term> {
        let mut arguments = vec![self.ternary()];
        while self.take(",") {
            arguments.push(self.ternary());
        }
        assert!(self.take(")"), "a call stays open: {:?}", self.tokens);
        arguments
    }
}

/// Level 0, where a language wraps it.
fn is_base(level: Term) -> bool {
    level.scalar() == 0.0
}

fn choose(condition: Term, yes: Term, no: Term) -> Term {
    let Term::Bool(condition) = condition else {
        panic!("a condition is a Bool")
    };
    if condition { yes } else { no }
}

fn call(name: &str, arguments: &[Term]) -> Term {
    let saturate = |x: f32| x.clamp(0.0, 1.0);
    match (name, arguments) {
        ("vec2", [u, v]) => Term::Pair([u.scalar(), v.scalar()]),
        ("level", [level]) => *level,
        ("vec3", [x]) => Term::Colour([x.scalar(); 3]),
        ("vec3", [r, g, b]) => Term::Colour([r.scalar(), g.scalar(), b.scalar()]),
        ("saturate", [x]) => x.map(saturate),
        ("clamp", [x, low, high]) if low.scalar() == 0.0 && high.scalar() == 1.0 => x.map(saturate),
        ("sqrt", [x]) => x.map(f32::sqrt),
        ("rsqrt" | "inversesqrt" | "inverseSqrt", [x]) => x.map(|x| 1.0 / x.sqrt()),
        ("abs", [x]) => x.map(f32::abs),
        ("exp2", [x]) => x.map(libm::exp2f),
        ("log2", [x]) => x.map(libm::log2f),
        ("sin", [x]) => x.map(libm::sinf),
        ("cos", [x]) => x.map(libm::cosf),
        ("min", [a, b]) => a.zip(*b, f32::min),
        ("max", [a, b]) => a.zip(*b, f32::max),
        ("select", [no, yes, condition]) => choose(*condition, *yes, *no),
        _ => panic!(
            "this reader knows no function {name} of {arguments:?}: tests/it/reread/language.rs"
        ),
    }
}
