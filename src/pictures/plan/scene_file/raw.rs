//! The scene file as TOML states it, with the place of every value that can be wrong.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use toml::Spanned;

/// Three numbers, each with its place.
pub type RawVector = [Spanned<f64>; 3];

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawScene {
    pub exposure: Option<Spanned<f64>>,
    pub tone: Option<Spanned<String>>,
    pub size: Option<[Spanned<i64>; 2]>,
    pub camera: OneOrMany<RawCamera>,
    pub light: Spanned<RawLight>,
    pub object: OneOrMany<RawObject>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawCamera {
    pub orthographic: Option<Spanned<f64>>,
    pub vertical_degrees: Option<Spanned<f64>>,
    pub eye: RawVector,
    pub at: Option<RawVector>,
    pub turntable: Option<Spanned<RawTurntable>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawTurntable {
    pub frames: Spanned<i64>,
    pub axis: Option<RawVector>,
    pub step_degrees: Option<Spanned<f64>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawLight {
    pub uniform: Option<RawVector>,
    pub environment: Option<Spanned<String>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawObject {
    pub name: Option<Spanned<String>>,
    pub body: Option<Spanned<String>>,
    pub mesh: Option<Spanned<String>>,
    pub material: Spanned<String>,
    pub roughness: Option<Spanned<f64>>,
    pub other: Option<RawVector>,
    pub extent: Option<Spanned<f64>>,
    pub at: Option<RawVector>,
    pub coverage: Option<Spanned<f64>>,
}

/// `[camera]` or several `[[camera]]`, each with its place. An untagged enum would lose the places and the messages.
pub struct OneOrMany<T>(pub Vec<Spanned<T>>);

enum Shape<T> {
    One(T),
    Many(Vec<Spanned<T>>),
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMany<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<OneOrMany<T>, D::Error> {
        let whole = Spanned::<Shape<T>>::deserialize(deserializer)?;
        let span = whole.span();
        Ok(OneOrMany(match whole.into_inner() {
            Shape::One(one) => vec![Spanned::new(span, one)],
            Shape::Many(all) => all,
        }))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Shape<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Shape<T>, D::Error> {
        deserializer.deserialize_any(Either(PhantomData))
    }
}

struct Either<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Either<T> {
    type Value = Shape<T>;

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("a table or an array of tables")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Shape<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(Shape::One)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Shape<T>, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Shape::Many)
    }
}
