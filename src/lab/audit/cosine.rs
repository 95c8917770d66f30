//! Finds which argument of a user's function is the cosine, or stands for it: the angle, a sine, a square.
//!
//! The function is run over cosines. An argument of another form gets its value for each cosine. The form is known from the name,
//! or from the body where that takes the argument's cosine, or one minus it. Where neither tells, the user is asked.

use super::quantity::{meanings, plain};
use crate::lab::verify::function_head::{FunctionHead, NumberShape};
use crate::lab::verify::shader_words::{Token, behind, text_at};

/// The quantity of the angle of incidence that an argument takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CosineForm {
    /// Its cosine.
    Cosine,
    /// One minus that.
    OneMinus,
    /// The cosine's square.
    Squared,
    /// The sine.
    Sine,
    /// The sine's square.
    SineSquared,
    /// The angle itself.
    Angle,
    /// The angle in degrees.
    Degrees,
}

use CosineForm::{Angle, Cosine, Degrees, OneMinus, Sine, SineSquared, Squared};

impl CosineForm {
    /// All forms by the names that `--arg` takes.
    pub const NAMED: [(&'static str, CosineForm); 7] = [
        ("cos", Cosine),
        ("1-cos", OneMinus),
        ("cos^2", Squared),
        ("sin", Sine),
        ("sin^2", SineSquared),
        ("angle", Angle),
        ("degrees", Degrees),
    ];

    /// The form of this name.
    pub fn find(name: &str) -> Option<CosineForm> {
        let found = CosineForm::NAMED.iter().find(|(own, _)| *own == name);
        found.map(|(_, form)| *form)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        let found = CosineForm::NAMED.iter().find(|(_, form)| *form == self);
        found.map_or("", |(name, _)| name)
    }

    /// In words, to follow `taken as`.
    pub fn words(self) -> &'static str {
        match self {
            Cosine => "the cosine",
            OneMinus => "one minus the cosine",
            Squared => "the square of the cosine",
            Sine => "the sine, sqrt(1 - cos^2)",
            SineSquared => "the square of the sine, 1 - cos^2",
            Angle => "the angle in radians, acos of the cosine",
            Degrees => "the angle in degrees, acos of the cosine",
        }
    }

    /// The value of this form for a cosine. A cosine above 1 has no angle, so only cosines themselves exceed 1.
    pub fn value_at(self, cosine: f32) -> f32 {
        if self == Cosine {
            return cosine;
        }
        let c = f64::from(cosine).clamp(-1.0, 1.0);
        let value = match self {
            Cosine => c,
            OneMinus => 1.0 - c,
            Squared => c * c,
            Sine => ((1.0 - c) * (1.0 + c)).sqrt(),
            SineSquared => (1.0 - c) * (1.0 + c),
            Angle => libm::acos(c),
            Degrees => libm::acos(c).to_degrees(),
        };
        value as f32
    }
}

/// Names that mean the cosine, in lower case without `_`.
const COSINES: [&str; 48] = [
    "costheta",
    "costhetai",
    "cosine",
    "cosi",
    "cos",
    "costh",
    "costhetav",
    "costhetal",
    "costhetah",
    "costhetain",
    "costheta1",
    "cosangle",
    "cosincidence",
    "ct",
    "c",
    "mu",
    "ndotv",
    "ndotl",
    "ndoth",
    "vdoth",
    "ldoth",
    "hdotv",
    "hdotl",
    "hdotn",
    "vdotn",
    "ldotn",
    "nov",
    "nol",
    "noh",
    "voh",
    "loh",
    "vdoth01",
    "dotnv",
    "dotvh",
    "dotlh",
    "dotnl",
    "dotnh",
    "dothv",
    "dothl",
    "ndv",
    "ndl",
    "vdh",
    "ldh",
    "hov",
    "hol",
    "costhetad",
    "costhetao",
    "u",
];

/// Names that mean the sine.
const SINES: [&str; 6] = ["sin", "sine", "sini", "sinth", "sintheta", "sinthetai"];

/// Names that mean an angle. Many authors give them to a cosine too.
const ANGLES: [&str; 20] = [
    "theta",
    "thetai",
    "thetain",
    "thetad",
    "thetah",
    "thetav",
    "thetal",
    "theta1",
    "angle",
    "anglerad",
    "thetarad",
    "incidence",
    "incidenceangle",
    "incidentangle",
    "angleofincidence",
    "incangle",
    "viewangle",
    "aoi",
    "radians",
    "alphai",
];

/// Suffixes of names of squares.
const SQUARES: [&str; 5] = ["2", "sq", "sqr", "sqrd", "squared"];

/// The meaning of an argument's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NameMeaning {
    Is(CosineForm),
    /// An angle, or a cosine that is called one.
    AnAngle,
}

fn name_meaning(name: &str) -> Option<NameMeaning> {
    let name = plain(name).to_lowercase();
    let name = name.as_str();
    let square = SQUARES.iter().find_map(|end| name.strip_suffix(end));
    // `cos2theta` is as often the square.
    let squared = |word: &str| {
        let rest = name
            .strip_prefix(word)
            .and_then(|rest| rest.strip_prefix("2"));
        rest.is_some_and(|rest| ["theta", "thetai"].contains(&rest))
    };
    let is_degrees = ["deg", "degs", "degree", "degrees"].iter().any(|end| {
        let rest = name.strip_suffix(end);
        rest.is_some_and(|rest| rest.is_empty() || ANGLES.contains(&rest.trim_end_matches("in")))
    });
    let one_minus = name.strip_prefix("oneminus").or(name.strip_prefix("om"));
    if COSINES.contains(&name) {
        Some(NameMeaning::Is(Cosine))
    } else if one_minus
        .is_some_and(|rest| rest.is_empty() && name != "om" || COSINES.contains(&rest))
    {
        Some(NameMeaning::Is(OneMinus))
    } else if square.is_some_and(|rest| rest.len() > 1 && COSINES.contains(&rest)) || squared("cos")
    {
        Some(NameMeaning::Is(Squared))
    } else if SINES.contains(&name) {
        Some(NameMeaning::Is(Sine))
    } else if square.is_some_and(|rest| SINES.contains(&rest)) || squared("sin") {
        Some(NameMeaning::Is(SineSquared))
    } else if is_degrees {
        Some(NameMeaning::Is(Degrees))
    } else {
        ANGLES.contains(&name).then_some(NameMeaning::AnAngle)
    }
}

/// Whether a name says that the argument is a quantity of the angle.
pub fn is_named(name: &str) -> bool {
    name_meaning(name).is_some()
}

/// What a function's body shows of an argument: it takes its cosine, or one minus it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Use {
    As(CosineForm),
    /// The body takes the cosine of something computed from it: an angle in degrees, or another angle.
    Unclear,
}

fn used_as(name: &str, body: &[Token]) -> Option<Use> {
    let is_it = |at: usize| body.get(at).is_some_and(|token| token.text == name);
    let text = |at: usize| text_at(body, at);
    let call = |words: &[&str]| {
        let is_call = |at: &usize| words.contains(&text(*at)) && text(at + 1) == "(";
        (0..body.len()).filter(is_call).collect::<Vec<usize>>()
    };
    let calls = |words: &[&str]| {
        let is_whole = |at: &usize| is_it(at + 2) && [")", ","].contains(&text(at + 3));
        call(words).iter().any(is_whole)
    };
    let angles = ["cos", "sin", "tan", "sincos"];
    let computes = || {
        call(&angles).iter().any(|at| {
            let behind = behind(body, at + 1);
            (at + 2..behind).any(is_it)
        })
    };
    // `1`, `1.`, `1.0f`
    let number = |from: usize, to: usize| {
        let words = (from..to).map(|at| text(at).trim_end_matches(['f', 'h', 'F']));
        words.collect::<String>()
    };
    let takes_from_one = || {
        let mut all = 2..body.len();
        all.any(|at| {
            let is_one = |length: usize| {
                let from = (at - 1).checked_sub(length);
                from.is_some_and(|from| ["1", "1.", "1.0"].contains(&number(from, at - 1).as_str()))
            };
            is_it(at) && text(at - 1) == "-" && (1..=3).any(is_one)
        })
    };
    if calls(&["radians"]) {
        Some(Use::As(Degrees))
    } else if calls(&angles) {
        Some(Use::As(Angle))
    } else if calls(&["acos"]) || takes_from_one() {
        Some(Use::As(Cosine))
    } else {
        computes().then_some(Use::Unclear)
    }
}

/// The argument that is the cosine, or stands for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CosineArgument {
    /// Its index.
    pub place: usize,
    /// Its form. None where that is not clear.
    pub form: Option<CosineForm>,
    /// Whether it was chosen only because no other argument is left.
    pub is_alone: bool,
}

impl CosineArgument {
    /// What an argument of this name is taken as, in words, where the name does not say so.
    pub fn words(&self, form: CosineForm, name: &str) -> Option<String> {
        let says = form == Cosine && !self.is_alone && is_named(name);
        let alone = if self.is_alone {
            ": no other number is without a value"
        } else {
            ""
        };
        (!says).then(|| format!("{}{alone}", form.words()))
    }
}

/// The cosine among the arguments that have no value: found by its name, or the only one left. None where that is not clear.
pub fn cosine(
    function: &FunctionHead,
    has_value: &[bool],
    body: &[Token],
) -> Option<CosineArgument> {
    let is_open =
        |place: &usize| !has_value[*place] && function.params[*place].shape == NumberShape::Scalar;
    let meaning = |place: &usize| name_meaning(&function.params[*place].name);
    // An argument whose name means a quantity of the material is asked for.
    let may_be = |place: &usize| {
        meaning(place).is_some() || meanings(&function.params[*place].name, function).is_empty()
    };
    let open = (0..has_value.len()).filter(is_open);
    let open: Vec<usize> = open.filter(may_be).collect();
    let is = |place: &&usize| meaning(place) == Some(NameMeaning::Is(Cosine));
    let cosines: Vec<usize> = open.iter().filter(is).copied().collect();
    let named = open.iter().filter(|place| meaning(place).is_some());
    let named: Vec<usize> = named.copied().collect();
    let place = match (cosines.as_slice(), named.as_slice(), open.as_slice()) {
        ([one], _, _) | ([], [one], _) | ([], [], [one]) => *one,
        _ => return None,
    };
    let used = used_as(&function.params[place].name, body);
    let form = match (meaning(&place), used) {
        // The name means a cosine, but the function takes the cosine of it.
        (Some(NameMeaning::Is(Cosine)), Some(Use::As(Angle | Degrees))) => None,
        (Some(NameMeaning::Is(form)), _) => Some(form),
        (_, Some(Use::As(form))) => Some(form),
        (Some(NameMeaning::AnAngle), None) | (_, Some(Use::Unclear)) => None,
        (None, None) => Some(Cosine),
    };
    Some(CosineArgument {
        place,
        form,
        is_alone: meaning(&place).is_none() && used.is_none(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::language::Language;
    use super::super::parts::functions;
    use super::*;
    use crate::lab::verify::shader_words::tokens;
    use core::f32::consts::FRAC_PI_3;

    #[track_caller]
    fn check(head: &str, body: &str, expected: Option<(usize, Option<CosineForm>)>) {
        let found = functions(&format!("float f({head}) {{ }}"), Language::Gles).remove(0);
        let none = vec![false; found.params.len()];
        let got = cosine(&found, &none, &tokens(body));
        let got = got.map(|one| (one.place, one.form));
        assert_eq!(got, expected, "{head}: {body}");
    }

    #[test]
    fn names_say_what_of_the_angle_it_is() {
        for (name, form) in [
            ("NdotV", Cosine),
            ("oneMinusVoH", OneMinus),
            ("one_minus_cos_theta", OneMinus),
            ("omc", OneMinus),
            ("oneMinus", OneMinus),
            ("cos2", Squared),
            ("cosSquared", Squared),
            ("cosTheta2", Squared),
            ("cos2_theta", Squared),
            ("sinTheta", Sine),
            ("sin_theta", Sine),
            ("sin2", SineSquared),
            ("sinThetaSq", SineSquared),
            ("sin2Theta", SineSquared),
            ("thetaDeg", Degrees),
            ("angle_in_degrees", Degrees),
        ] {
            check(&format!("float {name}"), "", Some((0, Some(form))));
        }
    }

    #[test]
    fn an_angle_is_one_where_the_function_takes_it_so() {
        for name in ["theta", "incidence", "angle", "theta_i"] {
            let head = format!("float {name}");
            check(&head, &format!("cos({name})"), Some((0, Some(Angle))));
            check(&head, &format!("radians({name})"), Some((0, Some(Degrees))));
            check(
                &head,
                &format!("pow(1.0 - {name}, 5.0)"),
                Some((0, Some(Cosine))),
            );
            check(&head, &format!("1 - {name}"), Some((0, Some(Cosine))));
            check(&head, &format!("helper({name})"), Some((0, None)));
            check(&head, &format!("cos({name} * 0.0174)"), Some((0, None)));
        }
        check("float x", "cos(x)", Some((0, Some(Angle))));
        check("float x", "x", Some((0, Some(Cosine))));
        check("float x", "cos(PI * x / 180.0)", Some((0, None)));
        check("float x", "sincos(x, s, c)", Some((0, Some(Angle))));
        check("float c", "cos(c)", Some((0, None)));
        check("float cosTheta, float theta", "", Some((0, Some(Cosine))));
        check("float a, float b", "", None);
        check("vec3 f0, float ior", "", None);
        check("float theta, float sinTheta", "", None);
    }

    #[test]
    fn each_form_has_its_value() {
        let at = |form: CosineForm| form.value_at(0.5);
        assert_eq!(at(OneMinus), 0.5);
        assert_eq!(at(Squared), 0.25);
        assert_eq!(at(SineSquared), 0.75);
        assert!((at(Sine) - 0.866_025_4).abs() < 1e-7);
        assert!((at(Angle) - FRAC_PI_3).abs() < 1e-7);
        assert!((at(Degrees) - 60.0).abs() < 1e-5);
        assert!(
            Angle.value_at(f32::NAN).is_nan()
                && Cosine.value_at(2.0) == 2.0
                && Sine.value_at(2.0) == 0.0
        );
    }
}
