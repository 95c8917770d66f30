//! `F = table_scale table((w (texels - 1) + 1/2) / texels, row)`: reflectance read from a texture, by a warped cosine.
//!
//! Source: Selan, "Using Lookup Tables to Accelerate Color Transformations", GPU Gems 2, chapter 24, 2005,
//! <https://developer.nvidia.com/gpugems/gpugems2/part-iii-high-quality-rendering/chapter-24-using-lookup-tables-accelerate-color>
//! (half a texel is left at each end, so that both ends of the range are texel centres). The warp
//! `w = (1 + warp) c / (1 + warp c)` is ours: reflectance bends near grazing, and with warp = 4 half as many texels suffice.
//! Domain: a texture of one mip level, filtered linearly and clamped to the edge. Error: that of the table, and 1/256 of
//! the difference of two neighbouring texels for the sampler's weights.

use super::*;
use crate::language::ir::Ty;
use crate::physics::num::Num;

/// The default number of texels of a table. With it, the rounding of texels is the largest error in half precision. More
/// texels gain nothing there, and half as many quadruple the filtering error.
pub const TEXELS: usize = 64;
/// The default warp of the axis: the one with the smallest errors at equal size.
pub const WARP: f64 = 4.0;
/// The row of a texture that holds one table: its middle.
pub const ONLY_ROW: f64 = 0.5;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const TABLE: Input = Input {
        ty: Ty::Texture,
        ..Input::rgb(
            "table",
            "the texture, and after it the sampler: reflectance along x, cos theta = 0 first, linear and not sRGB; the sampler filters linearly and clamps to the edge",
            [0.0, 1.0],
            InputSource::Texture,
        )
        // The table of one dielectric stands for all. The number is not used.
        .tried(&[0.0])
    };

    pub const TEXELS: Input = Input::scalar(
        "texels",
        "texels in a row of the table",
        [2.0, 16384.0],
        InputSource::TextureLayout(TEXELS as f64),
    )
    .tried(&[64.0, 2.0, 16_384.0]);

    pub const WARP: Input = Input::scalar(
        "warp",
        "how dense the axis is near grazing: 0 for cos theta itself, 4 for `--axis rational`",
        [0.0, 100.0],
        InputSource::TextureLayout(WARP),
    )
    .tried(&[4.0, 0.0, 64.0]);

    pub const ROW: Input = Input::scalar(
        "row",
        "where the row's middle lies: (index + 0.5) / rows, 0.5 for a table of its own",
        [0.0, 1.0],
        InputSource::TextureLayout(ONLY_ROW),
    )
    .tried(&[0.5, 0.0, 1.0]);

    pub const TABLE_SCALE: Input = Input::scalar(
        "table_scale",
        "reflectance of a texel of 1: the `scale` beside the table",
        [1.0, 100.0],
        InputSource::TextureLayout(1.0),
    )
    .tried(&[1.0]);
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "table",
    summary: "a lookup table in a texture, as `bake` writes it",
    formula: &[
        "c = clamp(cos_theta, 0, 1)",
        "w = (1 + warp) c / (1 + warp c)",
        "u = (w (texels - 1) + 1/2) / texels",
        "F = table_scale table(u, row), level 0",
    ],
    source: Citation {
        authors: "Selan",
        title: "Using Lookup Tables to Accelerate Color Transformations",
        place: "GPU Gems 2, chapter 24",
        year: 2005,
        link: "https://developer.nvidia.com/gpugems/gpugems2/part-iii-high-quality-rendering/chapter-24-using-lookup-tables-accelerate-color",
    },
    origin: Origin::Adapted("the warp is fresnel-gen's"),
    inputs: &[
        Input::TABLE,
        Input::TEXELS,
        Input::WARP,
        Input::ROW,
        Input::TABLE_SCALE,
    ],
    domain: "a sampler that filters linearly and clamps to the edge, linear texels (not sRGB), cos theta = 0 first. The errors below are \
             those of 64 texels and warp 4",
    claims: Claims {
        model: &[
            Claim::dielectrics(0.00027, 84.3),
            Claim::metals(0.00045, 15.2),
        ],
        code_ulp: 0.0,
        ..Claims::NONE
    },
    half: InHalf::Refused("11 bits of a coordinate do not tell the texels of a table apart"),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    fetch(
        x.get(Input::TABLE),
        warped_step(x.get(Input::WARP), x.cosine()),
        x.get(Input::TEXELS),
        x.get(Input::ROW),
    ) * x.get(Input::TABLE_SCALE)
}

/// w of a cosine in [0, 1] as a node: [`warped`] in a graph.
pub fn warped_step<'b>(warp: Expr<'b>, c: Expr<'b>) -> Expr<'b> {
    let w = (1.0 + warp) * c / (1.0 + warp * c);
    w.named(
        "w",
        "0 at grazing, 1 at normal incidence; dense near grazing",
    )
}

/// Samples a row of a texture that is `texels` wide at w in [0, 1]. The ends are the centres of the first and the last texel.
pub fn fetch<'b>(table: Expr<'b>, w: Expr<'b>, texels: Expr<'b>, row: Expr<'b>) -> Expr<'b> {
    let u = w * (1.0 - 1.0 / texels) + 0.5 / texels;
    let u = u.named("u", "half a texel is left at each end");
    table.sample(u, row)
}

/// w of a cosine in [0, 1], in any number type: exactly 0 at 0 and 1 at 1.
pub fn warped<N: Num>(warp: f64, c: N) -> N {
    let number = N::from_f64;
    number(1.0 + warp) * c / (number(warp) * c + number(1.0))
}

/// The cosine of a w in [0, 1].
pub fn unwarped(warp: f64, w: f64) -> f64 {
    w / (1.0 + warp - warp * w)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::ir::{Texels, Value, evaluate};

    #[test]
    fn ends_are_the_centres_of_the_outer_texels() {
        let function = METHOD.function(false).expect("it is well formed");
        let table = Texels::row(&[[1.0; 3], [0.5; 3], [0.25; 3]]);
        let at = |cos_theta: f64, warp: f64| {
            let numbers = [3.0, warp, 0.5, 2.0].map(Value::scalar);
            let mut arguments = vec![
                Value::scalar(cos_theta),
                Value::Texture(Some(table.clone())),
            ];
            arguments.extend(numbers);
            evaluate::<f64>(&function, &arguments).at(0)[0]
        };
        for (cos_theta, warp, want) in [
            (0.0, 4.0, 2.0),
            (-1.0, 4.0, 2.0),
            (1.0, 4.0, 0.5),
            (1.5, 4.0, 0.5),
            (0.5, 0.0, 1.0),
            (0.25, 0.0, 1.5),
            (1.0 / 6.0, 4.0, 1.0),
        ] {
            let got = at(cos_theta, warp);
            assert!((got - want).abs() < 1e-12, "{cos_theta} {warp}: {got}");
        }
    }
}
