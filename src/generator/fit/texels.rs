//! The texels of a table as the method `table` reads it where nothing else is asked for, in half precision.

use crate::language::ir::{Function, Texels, Ty, Value};
use crate::language::methods::{TEXELS, WARP, unwarped};
use crate::physics::num::{Half, Num};

/// The table of what is seen at a cosine.
pub fn texels(seen: impl Fn(f64) -> [f64; 3]) -> Texels {
    let centre = |i: usize| unwarped(WARP, i as f64 / (TEXELS - 1) as f64);
    let half = |value: f64| Half::from_f64(value).to_f32();
    let texels: Vec<_> = (0..TEXELS).map(|i| seen(centre(i)).map(half)).collect();
    Texels::row(&texels)
}

/// The table that a function with a material's constants folded in reads, where it reads one.
pub fn table_of(function: &Function, seen: impl Fn(f64) -> [f64; 3]) -> Option<Texels> {
    let is_textured = function.params.iter().any(|param| param.ty == Ty::Texture);
    is_textured.then(|| texels(seen))
}

/// The arguments of such a function.
pub fn arguments<N: Num>(cosines: Vec<N>, table: Option<&Texels>) -> Vec<Value<N>> {
    let table = table.map(|table| Value::Texture(Some(table.clone())));
    [Value::each(cosines)].into_iter().chain(table).collect()
}
