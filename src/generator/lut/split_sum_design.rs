//! The design of a split-sum table: its axes, size, masking and channels, and the layouts that engines bind.
//!
//! The layouts of four engines are taken from their shaders. All take n·v along u and roughness along v, both linear, with texel
//! i of N at (i + 1/2)/N and the smoothest row first; three.js has roughness along u and n·v along v. All have two terms of Schlick's
//! approximation, w = (1 - h·v)⁵:
//!
//! | engine | red | green | texels | masking |
//! |---|---|---|---|---|
//! | Bevy | ∫ (1 - w) | ∫ w | 128 × 128 | height-correlated Smith |
//! | Filament | ∫ w | ∫ 1 | 128 × 128 | the same |
//! | three.js | ∫ (1 - w) | ∫ w | 128 × 128, its own 16 × 16 | the same |
//! | Unreal | ∫ (1 - w) | ∫ w | 128 × 32 | the same with roots replaced by lines: Λ is linear in α |
//!
//! Sources: Guy and Agopian, "Physically Based Rendering in Filament", 2018, <https://google.github.io/filament/Filament.html>,
//! and its `cmgen --ibl-dfg-multiscatter`, whose own rows are shifted by one texel: it integrates row i at (i + 3/2)/N. Karis,
//! "Real Shading in Unreal Engine 4", 2013, <https://blog.selfshadow.com/publications/s2013-shading-course/>, `PreIntegratedGF`
//! and `Vis_SmithJointApprox`. Bevy's `pbr_lighting.wgsl`, `F_AB` with `DFG_LUT`, which reads `environment_map/dfg.ktx2`; three.js's
//! `DFGLUTData.js` and `lights_physical_pars_fragment.glsl.js` (r184 to r187).

use super::orthogonal::Orthogonal;
use super::split_sum::TERMS;
use crate::language::methods::Basis;
use crate::physics::optics::Ggx;

/// The spacing of a number from 0 to 1 along a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplitSumAxis {
    /// Linear.
    Linear,
    /// By its square root.
    Sqrt,
    /// By its fourth root.
    FourthRoot,
}

impl SplitSumAxis {
    /// All axes, the cheapest first.
    pub const ALL: [SplitSumAxis; 3] = [
        SplitSumAxis::Linear,
        SplitSumAxis::Sqrt,
        SplitSumAxis::FourthRoot,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            SplitSumAxis::Linear => "linear",
            SplitSumAxis::Sqrt => "sqrt",
            SplitSumAxis::FourthRoot => "fourth-root",
        }
    }

    /// The place of a number along the axis, both from 0 to 1.
    pub fn place(self, value: f64) -> f64 {
        match self {
            SplitSumAxis::Linear => value,
            SplitSumAxis::Sqrt => value.sqrt(),
            SplitSumAxis::FourthRoot => value.sqrt().sqrt(),
        }
    }

    /// The number at a place.
    pub fn value(self, place: f64) -> f64 {
        match self {
            SplitSumAxis::Linear => place,
            SplitSumAxis::Sqrt => place * place,
            SplitSumAxis::FourthRoot => place * place * place * place,
        }
    }

    /// The place of a number, as a formula in shading languages.
    pub fn formula(self, number: &str) -> String {
        match self {
            SplitSumAxis::Linear => format!("clamp({number}, 0.0, 1.0)"),
            SplitSumAxis::Sqrt => format!("sqrt(clamp({number}, 0.0, 1.0))"),
            SplitSumAxis::FourthRoot => format!("sqrt(sqrt(clamp({number}, 0.0, 1.0)))"),
        }
    }
}

/// The meaning of each channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplitSumLayout {
    /// One term per channel: the factor of each of a material's numbers.
    Terms,
    /// The layout of Bevy.
    Bevy,
    /// The layout of Filament.
    Filament,
    /// The layout of three.js.
    Three,
    /// The layout of Unreal Engine.
    Unreal,
}

impl SplitSumLayout {
    /// The layouts of engines.
    pub const ENGINES: [SplitSumLayout; 4] = [
        SplitSumLayout::Bevy,
        SplitSumLayout::Filament,
        SplitSumLayout::Three,
        SplitSumLayout::Unreal,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            SplitSumLayout::Terms => "terms",
            SplitSumLayout::Bevy => "bevy",
            SplitSumLayout::Three => "three",
            SplitSumLayout::Filament => "filament",
            SplitSumLayout::Unreal => "unreal",
        }
    }

    /// Turns the terms, T0 of 1 and T1 of w, into what the channels hold.
    fn arrange(self, terms: &mut [f64; TERMS]) {
        let [white, grazing] = [terms[0], terms[1]];
        match self {
            SplitSumLayout::Terms => {}
            SplitSumLayout::Filament => [terms[0], terms[1]] = [grazing, white],
            SplitSumLayout::Bevy | SplitSumLayout::Three | SplitSumLayout::Unreal => {
                [terms[0], terms[1]] = [white - grazing, grazing];
            }
        }
    }
}

/// How a split-sum table is made.
#[derive(Clone, Debug)]
pub struct SplitSumDesign {
    /// What is integrated.
    pub basis: Basis,
    /// What stands in place of its terms, where a texture would hold them poorly.
    pub functions: Option<Orthogonal>,
    /// The meaning of each channel. An engine's layout also decides how masking is computed and where texels lie.
    pub layout: SplitSumLayout,
    /// Texels along u: n·v, or roughness in three.js's layout.
    pub width: usize,
    /// Texels along v: roughness, or n·v.
    pub height: usize,
    /// The axis of cosines.
    pub cosine: SplitSumAxis,
    /// The axis of roughness.
    pub roughness: SplitSumAxis,
}

/// The default axes: `sqrt(vec2(cos_v, roughness))` in a shader, within .002 with 128 texels a side.
pub const SPLIT_SUM_AXES: [SplitSumAxis; 2] = [SplitSumAxis::Sqrt; 2];

impl SplitSumDesign {
    /// A square table of all terms, along these axes of cosine and roughness.
    pub fn square(basis: Basis, size: usize, [cosine, roughness]: [SplitSumAxis; 2]) -> Self {
        SplitSumDesign {
            functions: Orthogonal::of(&basis),
            basis,
            layout: SplitSumLayout::Terms,
            width: size,
            height: size,
            cosine,
            roughness,
        }
    }

    /// An engine's table, of a basis whose terms are 1 and (1 - c)⁵.
    pub fn of_engine(basis: Basis, layout: SplitSumLayout) -> Self {
        let height = match layout {
            SplitSumLayout::Unreal => 32,
            _ => 128,
        };
        SplitSumDesign {
            basis,
            functions: None,
            layout,
            width: 128,
            height,
            cosine: SplitSumAxis::Linear,
            roughness: SplitSumAxis::Linear,
        }
    }

    /// The number of channels used.
    pub fn channels(&self) -> usize {
        match self.layout {
            SplitSumLayout::Terms => self.basis.terms(),
            _ => 2,
        }
    }

    /// Whether the first and last texel lie at 0 and 1. An engine's texel i of N lies at (i + 1/2)/N.
    fn ends_are_centres(&self) -> bool {
        self.layout == SplitSumLayout::Terms
    }

    /// Whether roughness lies along u.
    pub fn is_transposed(&self) -> bool {
        self.layout == SplitSumLayout::Three
    }

    /// The scale and offset that turn the place on an axis into u: u = scale place + offset.
    pub fn half_texel(&self, texels: usize) -> (f64, f64) {
        if self.ends_are_centres() {
            super::axis::TableAxis::half_texel(texels)
        } else {
            (1.0, 0.0)
        }
    }

    /// The cosine and the roughness at a texel, or between texels.
    pub fn at(&self, column: f64, row: f64) -> (f64, f64) {
        let place = |texel: f64, texels: usize| {
            if self.ends_are_centres() {
                texel / (texels - 1) as f64
            } else {
                (texel + 0.5) / texels as f64
            }
        };
        let (u, v) = (place(column, self.width), place(row, self.height));
        let (cosine, roughness) = if self.is_transposed() { (v, u) } else { (u, v) };
        (self.cosine.value(cosine), self.roughness.value(roughness))
    }

    /// The column and the row of a cosine and a roughness, both clamped to [0, 1]. Texels are clamped to the edge.
    pub fn texel(&self, cos_v: f64, roughness: f64) -> (f64, f64) {
        let texel = |place: f64, texels: usize| {
            let last = (texels - 1) as f64;
            if self.ends_are_centres() {
                place * last
            } else {
                (place * texels as f64 - 0.5).clamp(0.0, last)
            }
        };
        let cosine = self.cosine.place(cos_v.clamp(0.0, 1.0));
        let roughness = self.roughness.place(roughness.clamp(0.0, 1.0));
        let (u, v) = if self.is_transposed() {
            (roughness, cosine)
        } else {
            (cosine, roughness)
        };
        (texel(u, self.width), texel(v, self.height))
    }

    /// What the channels hold at a cosine and a roughness, both in [0, 1]; α is roughness².
    pub fn channels_at(&self, rule: &Ggx, cos_v: f64, roughness: f64) -> [f64; TERMS] {
        let (mut channels, terms) = ([0.0; TERMS], self.basis.terms());
        self.add_terms(rule, cos_v, roughness, &mut channels[..terms]);
        if let Some(functions) = &self.functions {
            let own = functions.functions(&channels[..terms]);
            channels[..terms].copy_from_slice(&own);
        }
        self.layout.arrange(&mut channels);
        channels
    }

    /// What the channels are multiplied by, from a material's numbers in the method.
    pub fn numbers(&self, numbers: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let own = self.functions.as_ref();
        own.map_or(numbers.to_vec(), |functions| functions.numbers(numbers))
    }

    /// Adds the means of all terms to their sums.
    fn add_terms(&self, rule: &Ggx, cos_v: f64, roughness: f64, sums: &mut [f64]) {
        let alpha = roughness * roughness;
        rule.each_lit(cos_v, alpha, |cos_h, light, weight| {
            let weight = match self.layout {
                SplitSumLayout::Unreal => weight * lines_for_roots(cos_v, light, alpha),
                _ => weight,
            };
            self.basis.add(cos_h, weight, sums);
        });
    }
}

/// The ratio of Unreal's masking to the exact one. Unreal replaces `√(c² + α² (1 - c²))` by `c (1 - α) + α`.
fn lines_for_roots(cos_v: f64, light: f64, alpha: f64) -> f64 {
    let root = |c: f64| (c * c + alpha * alpha * (1.0 - c * c).max(0.0)).sqrt();
    let line = |c: f64| c * (1.0 - alpha) + alpha;
    let with = |of: &dyn Fn(f64) -> f64| light * of(cos_v) + cos_v * of(light);
    let own = with(&line);
    if own > 0.0 { with(&root) / own } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::find;

    #[test]
    fn places_are_undone() {
        for axis in SplitSumAxis::ALL {
            assert_eq!((axis.place(0.0), axis.place(1.0)), (0.0, 1.0));
            for step in 0..=100 {
                let value = f64::from(step) / 100.0;
                assert!((axis.value(axis.place(value)) - value).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn texels_are_found_again() {
        let basis = find("schlick").and_then(|method| method.basis()).unwrap();
        let axes = [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt];
        let engines = SplitSumLayout::ENGINES.map(|one| SplitSumDesign::of_engine(basis, one));
        for design in [
            &engines[0],
            &engines[1],
            &engines[2],
            &engines[3],
            &SplitSumDesign::square(basis, 9, axes),
        ] {
            for (column, row) in [(0.0, 0.0), (3.5, 2.0), (8.0, 7.25)] {
                let (cos_v, roughness) = design.at(column, row);
                let (x, y) = design.texel(cos_v, roughness);
                assert!((x - column).abs() < 1e-9 && (y - row).abs() < 1e-9);
            }
        }
        assert_eq!(engines[3].at(0.0, 0.0), (0.5 / 128.0, 0.5 / 32.0));
        assert_eq!(
            engines[2].at(3.5, 0.0),
            (0.5 / 128.0, 4.0 / 128.0),
            "roughness lies along u"
        );
    }
}
