//! The graph of a shader function that looks a cosine up in a baked table.
//!
//! The table's axis, size and scale are constants in it, so a caller passes only the cosine, the texture, and the row where there
//! are several. It computes the same as [`Stored::lookup`](super::Stored::lookup).

use super::axis::TableAxis;
use crate::language::ir::{BrokenRule, Builder, Checked, Expr, check, fold};
use crate::language::methods::{Input, Inputs, ONLY_ROW, fetch, warped_step};
use crate::physics::num::Precision;

/// The function that reads a table of `texels` texels along an axis.
///
/// Its arguments are `cos_theta`, `table`, then `row` (the coordinate of the row's middle) for more than one row, then
/// `table_scale` where no scale is given. Without a scale, one function serves files that are scaled differently.
///
/// # Errors
/// The graph breaks a rule of the representation: a bug.
pub fn lookup(
    axis: TableAxis,
    texels: usize,
    scale: Option<f32>,
    rows: usize,
) -> Result<Checked, BrokenRule> {
    let builder = Builder::new();
    let inputs = [
        Some(Input::TABLE),
        (rows > 1).then_some(Input::ROW),
        scale.is_none().then_some(Input::TABLE_SCALE),
    ];
    let inputs: Vec<Input> = inputs.into_iter().flatten().collect();
    let x = Inputs::declare(&builder, &inputs, false, Precision::F32);
    let given = |input: Input, constant: Option<f64>| {
        constant.map_or_else(|| x.get(input), |value| builder.number(value))
    };
    let reflectance = fetch(
        x.get(Input::TABLE),
        warp(axis, x.cosine()),
        builder.number(texels as f64),
        given(Input::ROW, (rows <= 1).then_some(ONLY_ROW)),
    ) * given(Input::TABLE_SCALE, scale.map(f64::from));
    check(fold(&builder.finish("lookup", reflectance)))
}

/// The function that reads a table of several thicknesses, a row each, between its rows too.
///
/// Its arguments are `cos_theta`, `table`, `thickness_nm`, and `table_scale` where no scale is given. Thicknesses beyond both ends are
/// those of the ends.
///
/// # Errors
/// The graph breaks a rule of the representation: a bug.
pub fn lookup_by_thickness(
    (axis, texels): (TableAxis, usize),
    scale: Option<f32>,
    rows: usize,
    [from_nm, to_nm]: [f64; 2],
) -> Result<Checked, BrokenRule> {
    let builder = Builder::new();
    let inputs = [Some(Input::TABLE), Some(Input::THICKNESS)].into_iter();
    let inputs: Vec<Input> = inputs
        .chain([scale.is_none().then_some(Input::TABLE_SCALE)])
        .flatten()
        .collect();
    let x = Inputs::declare(&builder, &inputs, false, Precision::F32);
    let share = (x.get(Input::THICKNESS) - from_nm) * (1.0 / (to_nm - from_nm));
    let (all, half) = (rows as f64, 0.5 / rows as f64);
    let row = share.saturate() * (1.0 - 1.0 / all) + half;
    let scale = match scale {
        Some(scale) => builder.number(f64::from(scale)),
        None => x.get(Input::TABLE_SCALE),
    };
    let texels = builder.number(texels as f64);
    let table = x.get(Input::TABLE);
    let reflectance = fetch(table, warp(axis, x.cosine()), texels, row.named("v", "")) * scale;
    check(fold(&builder.finish("lookup", reflectance)))
}

/// w of a clamped cosine: [`TableAxis::warp`] as nodes of a graph.
fn warp(axis: TableAxis, c: Expr) -> Expr {
    let why = "0 at grazing, 1 at normal incidence; dense near grazing";
    match (axis, axis.constant()) {
        (TableAxis::Cos, _) => c,
        (_, Some(constant)) => warped_step(c.builder().number(constant), c),
        (TableAxis::Sqrt, None) => c.sqrt().named("w", why),
        (_, None) => (c * (2.0 - c)).named("w", why),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::lut::{Depth, Stored};
    use crate::language::ir::{Texels, Ty, Value, Weights, evaluate};
    use crate::language::methods::{TEXELS, WARP, find};

    /// A table whose texels all differ.
    fn stored(axis: TableAxis, texels: usize, scale: f32) -> Stored {
        let value = |i: usize| [i as f32, 1.0 / (1.0 + i as f32), 0.25];
        Stored {
            axis,
            depth: Depth::Float,
            scale,
            texels: (0..texels).map(value).collect(),
        }
    }

    #[test]
    fn it_gives_what_the_model_of_the_filter_gives() {
        for axis in TableAxis::ALL {
            for (texels, scale) in [(2, 1.0), (64, 1.0), (255, 1.058_7)] {
                let stored = stored(axis, texels, scale);
                let function = lookup(axis, texels, Some(scale), 1).unwrap();
                for i in 0..=1000 {
                    let cos_theta = (i as f32 - 100.0) / 800.0;
                    let arguments = [
                        Value::scalar(f64::from(cos_theta)),
                        Value::Texture(Some(Texels::row(&stored.texels))),
                    ];
                    let got = evaluate::<f64>(&function, &arguments).at(0);
                    let want = stored.lookup(Weights::Exact, cos_theta);
                    for (got, want) in got.into_iter().zip(want) {
                        let within = texels as f64 * 1e-6;
                        assert!(
                            (got - f64::from(want)).abs() < within,
                            "{axis:?} {texels} at {cos_theta}: {got} {want}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn arguments_are_what_cannot_be_known() {
        for (scale, rows, want) in [
            (Some(1.0), 1, &["cos_theta", "table"][..]),
            (Some(1.0), 4, &["cos_theta", "table", "row"]),
            (None, 1, &["cos_theta", "table", "table_scale"]),
            (None, 4, &["cos_theta", "table", "row", "table_scale"]),
        ] {
            let function = lookup(TableAxis::Rational, 64, scale, rows).unwrap();
            let names: Vec<&str> = function.params.iter().map(|p| p.name.as_str()).collect();
            assert_eq!(names, want);
            assert_eq!((function.ty(), function.fetches()), (Ty::Vec3, 1));
        }
    }

    #[test]
    fn the_usual_table_is_read_as_the_method_reads_it() {
        let method = find("table").unwrap();
        let values = [
            (Input::TEXELS, TEXELS as f64),
            (Input::WARP, WARP),
            (Input::ROW, ONLY_ROW),
            (Input::TABLE_SCALE, 1.0),
        ];
        let values = values.map(|(input, value)| (input.name.to_owned(), [value; 3]));
        let specialised = method.specialise(&values.into_iter().collect()).unwrap();
        let own = lookup(TableAxis::Rational, TEXELS, Some(1.0), 1).unwrap();
        assert_eq!(specialised.nodes, own.nodes);
    }
}
