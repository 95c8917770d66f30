//! What an effect is: a record in a static table, with its functions. Also the vector operations and the arguments that
//! several effects share.

use crate::language::ir::{
    BrokenRule, Builder, Checked, Expr, Letters, Ty, USED_TWICE, check, specialise,
};
use crate::language::methods::{Input, Inputs, Method, Values};
use crate::physics::cite::Citation;
use crate::physics::names::identifier_fault;
use crate::physics::num::Precision;

/// A visible effect of Fresnel's equations, as functions that an application calls.
#[derive(Debug)]
#[non_exhaustive]
pub struct Effect {
    /// Its one name: of its file, in `--effect`, and as a row in reports.
    pub name: &'static str,
    /// A description in one line.
    pub summary: &'static str,
    /// The formulas in ASCII, one a line.
    pub formula: &'static [&'static str],
    /// Who published it.
    pub source: Citation,
    /// Conventions of its arguments beyond their own descriptions, and what is left to the application, one a line.
    pub conventions: &'static [&'static str],
    /// Where it must be wrong, one a line.
    pub fails: &'static [&'static str],
    /// Its functions. Each returns one result.
    pub functions: &'static [EffectFunction],
}

/// One function of an effect.
#[derive(Debug)]
pub struct EffectFunction {
    /// Its name after the prefix.
    pub name: &'static str,
    /// What it returns.
    pub gives: &'static str,
    /// Its arguments; those of the Fresnel method come after them.
    pub arguments: &'static [Argument],
    /// The reflectance that it uses, if any. A Fresnel method is then part of it.
    pub reflectance: Reflectance,
    /// The largest error of single precision against f64: absolute, or relative for results above 1. It excludes the effect of a
    /// last bit of the arguments, and the error of the method of R. Tests check that it is neither exceeded nor slack.
    pub code_abs: f64,
    /// Whether its triples are colours, or points and directions.
    pub letters: Letters,
    /// Builds the formula.
    pub build: for<'b> fn(&Arguments<'b>) -> Expr<'b>,
}

/// The reflectance that a function uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reflectance {
    /// None.
    Unused,
    /// One for each channel. Where the method has a scalar form, there is a second function with one for all channels.
    EachChannel,
    /// The same for light that leaves a body: a material's index is inverted.
    FromWithin,
}

impl Reflectance {
    /// Whether a Fresnel method is part of the function.
    pub fn is_used(self) -> bool {
        self != Reflectance::Unused
    }
}

/// An argument of an effect's function.
#[derive(Clone, Copy, Debug)]
pub struct Argument {
    /// Its name, the same in every language.
    pub name: &'static str,
    /// What it means, with its unit.
    pub meaning: &'static str,
    /// Its type.
    pub ty: Ty,
    /// The values for which the function's error is stated.
    pub domain: Domain,
}

/// The values of an argument for which a function's error is stated. It returns numbers for others too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Domain {
    /// Vectors of length 1.
    UnitLength,
    /// Each component lies between the first number and the second.
    Within(f64, f64),
    /// All that the argument can mean: a camera's matrix, the map to texture coordinates, a texture.
    Whole,
}

impl Domain {
    /// In words.
    pub fn words(self) -> String {
        match self {
            Domain::UnitLength => "of unit length".to_owned(),
            Domain::Within(least, most) => format!("{least} to {most}"),
            Domain::Whole => "any".to_owned(),
        }
    }
}

impl Argument {
    const fn new(name: &'static str, meaning: &'static str, ty: Ty, domain: Domain) -> Argument {
        Argument {
            name,
            meaning,
            ty,
            domain,
        }
    }

    /// A number between `least` and `most`.
    pub const fn scalar(
        name: &'static str,
        meaning: &'static str,
        [least, most]: [f64; 2],
    ) -> Argument {
        Argument::new(name, meaning, Ty::Scalar, Domain::Within(least, most))
    }

    /// A point or a colour, with components between `least` and `most`.
    pub const fn vector(
        name: &'static str,
        meaning: &'static str,
        [least, most]: [f64; 2],
    ) -> Argument {
        Argument::new(name, meaning, Ty::Vec3, Domain::Within(least, most))
    }

    /// A direction.
    pub const fn direction(name: &'static str, meaning: &'static str) -> Argument {
        Argument::new(name, meaning, Ty::Vec3, Domain::UnitLength)
    }

    /// Two numbers between `least` and `most`.
    pub const fn pair(
        name: &'static str,
        meaning: &'static str,
        [least, most]: [f64; 2],
    ) -> Argument {
        Argument::new(name, meaning, Ty::Vec2, Domain::Within(least, most))
    }

    /// A matrix, a map of texture coordinates or a texture.
    pub const fn whole(name: &'static str, meaning: &'static str, ty: Ty) -> Argument {
        Argument::new(name, meaning, ty, Domain::Whole)
    }
}

/// The arguments of a function while it is built.
#[derive(Debug)]
pub struct Arguments<'b> {
    builder: &'b Builder,
    given: Vec<(&'static str, Expr<'b>)>,
    fresnel: Option<(&'static Method, Vec<Expr<'b>>)>,
}

impl<'b> Arguments<'b> {
    /// An argument that the function declares.
    pub fn get(&self, argument: Argument) -> Expr<'b> {
        let found = self.given.iter().find(|(name, _)| *name == argument.name);
        let found = found.expect("a function asks only for arguments that it declares");
        found.1
    }

    /// A constant.
    pub fn number(&self, value: f64) -> Expr<'b> {
        self.builder.number(value)
    }

    /// A point or a direction from three numbers.
    pub fn vector(&self, x: Expr<'b>, y: Expr<'b>, z: Expr<'b>) -> Expr<'b> {
        self.builder.compose(x, y, z)
    }

    /// The reflectance by the chosen method at the cosine of an angle of incidence.
    pub fn fresnel(&self, cos_theta: Expr<'b>) -> Expr<'b> {
        let (method, inputs) = self.fresnel.as_ref().expect("the function asks for it");
        let inputs = Inputs::given(cos_theta, method.inputs, inputs, Precision::F32);
        (method.build)(&inputs)
    }
}

/// A function of an effect, made for a Fresnel method and a number of channels.
#[derive(Clone, Debug)]
pub struct BuiltEffect {
    /// Its name after the prefix.
    pub name: String,
    /// What it was made from.
    pub record: &'static EffectFunction,
    /// The graph.
    pub function: Checked,
}

impl EffectFunction {
    /// The defaults: colours, without a Fresnel method, within the error that all functions keep so far. The rest is empty.
    pub(super) const BASE: EffectFunction = EffectFunction {
        name: "",
        gives: "",
        arguments: &[],
        reflectance: Reflectance::Unused,
        code_abs: 2e-7,
        letters: Letters::Rgb,
        build: |with| with.number(0.0),
    };

    /// This function in each form that it has with this method: a single one, or a colour form and a scalar form.
    ///
    /// # Errors
    /// The graph breaks a rule of [`crate::language::ir::RULES`]; tests hold that none does.
    pub fn built(&'static self, method: &'static Method) -> Result<Vec<BuiltEffect>, BrokenRule> {
        let form = |is_scalar: bool, suffix: &str| {
            Ok(BuiltEffect {
                name: format!("{}{suffix}", self.name),
                record: self,
                function: self.graph(method, is_scalar, &Values::new())?,
            })
        };
        let mut forms = vec![form(false, "")?];
        if self.reflectance.is_used() && method.has_scalar_form() {
            forms.push(form(true, "_scalar")?);
        }
        Ok(forms)
    }

    /// This function with the arguments fixed that have a value here; nothing where none has.
    ///
    /// # Errors
    /// With these constants the graph breaks a rule of [`crate::language::ir::RULES`]: one is not finite in f32, for example.
    pub fn specialised(
        &self,
        method: &'static Method,
        values: &Values,
    ) -> Option<Result<Checked, BrokenRule>> {
        let own = self.arguments.iter().map(|argument| argument.name);
        let inputs = method.inputs.iter().map(|input| input.name);
        let inputs = inputs.filter(|_| self.reflectance.is_used());
        let mut names = own.chain(inputs);
        let has_one = names.any(|name| values.contains_key(name));
        has_one.then(|| self.graph(method, false, values))
    }

    fn graph(
        &self,
        method: &'static Method,
        is_scalar: bool,
        values: &Values,
    ) -> Result<Checked, BrokenRule> {
        let builder = Builder::with_letters(self.letters);
        let declare = |argument: &Argument| {
            debug_assert_eq!(identifier_fault(argument.name), None);
            (argument.name, builder.param(argument.name, argument.ty))
        };
        let given = self.arguments.iter().map(declare).collect();
        let fresnel = (self.reflectance.is_used()).then(|| {
            let declare = |input: &Input| {
                let ty = if is_scalar { Ty::Scalar } else { input.ty };
                builder.param(input.name, ty)
            };
            (method, method.inputs.iter().map(declare).collect())
        });
        let arguments = Arguments {
            builder: &builder,
            given,
            fresnel,
        };
        let result = (self.build)(&arguments);
        let whole = builder.finish(self.name, result);
        check(specialise(&whole, values))
    }
}

/// A vector with a squared length below this counts as zero.
const SHORTEST: f64 = 1e-30;

/// The direction of arriving light.
pub const INCIDENT: Argument = Argument::direction(
    "incident",
    "direction of travel, of unit length, toward the surface",
);
/// The surface normal, as all functions but exits take it.
pub const NORMAL: Argument = Argument::direction(
    "normal",
    "of unit length, on the side that the light comes from; the function never flips it",
);
/// The relative index.
pub const ETA: Argument = Argument::scalar(
    "eta",
    "n_t / n_i, the index behind the surface by that before it, above 0; GLSL's refract takes the inverse",
    [0.4, 2.5],
);
/// A matrix from the world to clip space.
pub const VIEW_PROJECTION: Argument = Argument::whole(
    "view_projection",
    "from world to clip space, applied to columns",
    Ty::Mat4,
);
/// The map from normalised device coordinates to texture coordinates.
pub const UV_SCALE_BIAS: Argument = Argument::whole(
    "uv_scale_bias",
    "uv = ndc.xy * this.xy + this.zw: (.5, .5, .5, .5) where v points up, (.5, -.5, .5, .5) where it points down",
    Ty::Vec4,
);

/// A vector divided by its length. A zero vector stays zero.
pub fn unit_or_zero<'b>(vector: Expr<'b>) -> Expr<'b> {
    vector * vector.dot(vector).at_least(SHORTEST).inverse_sqrt()
}

/// The length of a vector.
pub fn length<'b>(vector: Expr<'b>) -> Expr<'b> {
    vector.dot(vector).sqrt()
}

/// The cross product.
pub fn cross<'b>(with: &Arguments<'b>, a: Expr<'b>, b: Expr<'b>) -> Expr<'b> {
    let part = |i: usize, j: usize| a.channel(i) * b.channel(j) - a.channel(j) * b.channel(i);
    with.vector(part(1, 2), part(2, 0), part(0, 1))
}

/// incident - 2 (incident . normal) normal
pub fn mirrored<'b>(incident: Expr<'b>, normal: Expr<'b>) -> Expr<'b> {
    incident - normal * (2.0 * incident.dot(normal))
}

/// A direction refracted by Snell's law.
pub struct Refraction<'b> {
    /// The refracted direction; meaningless where `passes` is 0.
    pub direction: Expr<'b>,
    /// 1 where light passes. 0 past the critical angle, at grazing incidence and for a zero vector.
    pub passes: Expr<'b>,
}

/// Snell's law for vectors: t = r (i + c n) - n sqrt(1 - r^2 (1 - c^2)) with r = 1/eta and c = -i . n.
pub fn refraction<'b>(
    with: &Arguments<'b>,
    incident: Expr<'b>,
    normal: Expr<'b>,
    eta: Expr<'b>,
) -> Refraction<'b> {
    let c = -incident.dot(normal);
    let c = c
        .saturate()
        .named("c", "clamp: a rounded dot product may exceed 1");
    let r = (1.0 / eta).named("r", "sin theta_t = r sin theta_i");
    let along_normal = (r * c).named("rc", USED_TWICE);
    let squared = ((1.0 - r) * (1.0 + r) + along_normal * along_normal).named(
        "cos2_t",
        "1 - r^2 (1 - c^2), the squared cosine behind the surface; negative past the critical angle",
    );
    let meets = with.number(0.0).choose_below(c, squared, with.number(-1.0));
    let passes = with
        .number(0.0)
        .choose_below(meets, with.number(1.0), with.number(0.0))
        .named("passes", "0 past the critical angle and for a zero vector");
    let along = squared.at_least(0.0).sqrt();
    let direction = (incident + normal * c) * r - normal * along;
    Refraction { direction, passes }
}
