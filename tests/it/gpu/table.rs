//! Tables as GPUs sample them: the lookup that is generated, on real stacks, against the filter that errors of tables
//! are computed with; and the usual mistakes, made on purpose, are each seen.

use super::device;
use fresnel_gen::generator::bake::TableMaterial;
use fresnel_gen::generator::emit::{self, EmittedFunction, Naming};
use fresnel_gen::generator::generate::tables::table_materials;
use fresnel_gen::generator::lut::{Depth, Stored, Table, TableAxis};
use fresnel_gen::generator::request::Request;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::{
    Argument, Backend, Program, ShaderCode, Texture, TextureFilter, TextureFormat, TextureShape,
    Uniform, Wrap,
};
use fresnel_gen::lab::verify::{cosines, harness};
use fresnel_gen::language::ir::Weights;
use fresnel_gen::language::{methods, targets};

/// What a sampler may differ by from the model.
const CLOSE: f32 = 1.0 / 4096.0;
const POINTS: usize = 100_000;
/// Software samplers mix 8-bit texels in 8 bits: half a step more.
const EIGHT_BITS: f32 = 0.5 / 255.0;

/// The materials that are committed, unclipped as tables keep them.
fn committed() -> Vec<TableMaterial> {
    table_materials(&Request::default()).unwrap().0
}

fn function() -> EmittedFunction {
    let method = methods::find("table").unwrap();
    emit::library_functions(method, &Naming::default())
        .unwrap()
        .remove(0)
}

/// The library's file in a language.
fn text(target: &str) -> String {
    let target = targets::find(target).unwrap();
    let method = methods::find("table").unwrap();
    let mut files = emit::library(target, method, &[function()], emit::Heading::default()).unwrap();
    String::from_utf8(files.remove(0).bytes).unwrap()
}

/// A stored table, and how it is put before a sampler.
struct Put<'a> {
    stored: &'a Stored,
    format: TextureFormat,
    wrap: Wrap,
    is_flipped: bool,
    /// Texels that the shader is told of: another number moves the half texel.
    told: usize,
}

impl<'a> Put<'a> {
    fn right(stored: &'a Stored) -> Put<'a> {
        let format = match stored.depth {
            Depth::Unorm8 => TextureFormat::Unorm8,
            Depth::Half => TextureFormat::Half,
            Depth::Unorm16 => TextureFormat::Unorm16,
            Depth::Float => TextureFormat::Float,
        };
        let told = stored.texels.len();
        Put {
            stored,
            format,
            wrap: Wrap::Clamp,
            is_flipped: false,
            told,
        }
    }

    /// The largest difference between a stack and the model at these cosines; nothing where the stack is not here or
    /// does not filter the format.
    fn difference(&self, backend: Backend, at: &[f32]) -> Option<f32> {
        let device = device(backend)?;
        let target = if backend == Backend::Gles {
            "gles"
        } else {
            "wgsl"
        };
        let (file, emitted) = (text(target), function());
        let call = harness::Call::to_emitted(&emitted);
        let target = targets::find(target).unwrap();
        let program = harness::program(target, &file, &call).unwrap();
        let (code, prefix) = match backend {
            Backend::Gles => (ShaderCode::Gles(&program), "fg_"),
            _ => (ShaderCode::Wgsl(&program), ""),
        };
        let constant = self.stored.axis.constant().unwrap() as f32;
        let scalars = [
            ("texels", self.told as f32),
            ("warp", constant),
            ("row", 0.5),
            ("table_scale", self.stored.scale),
        ];
        let uniforms = scalars.map(|(name, value)| Uniform {
            name: format!("{prefix}{name}"),
            value: Argument::Scalar(value),
        });
        let kernel = device
            .prepare(&Program {
                code,
                entry: harness::ENTRY,
                uniforms: &uniforms,
                texture: Some(TextureShape::Flat),
            })
            .unwrap();
        let mut texels: Vec<[f32; 4]> = self
            .stored
            .texels
            .iter()
            .map(|[r, g, b]| [*r, *g, *b, 1.0])
            .collect();
        if self.is_flipped {
            texels.reverse();
        }
        let texture = Texture {
            width: texels.len(),
            texels: &texels,
            format: self.format,
            wrap: self.wrap,
            shape: TextureShape::Flat,
            filter: TextureFilter::Linear,
        };
        let got = match kernel.run(at, &uniforms, Some(&texture)) {
            Err(Fault::Absent(_)) => return None,
            got => got.unwrap(),
        };
        let off = |(c, got): (&f32, &[f32; 3])| {
            let model =
                [Weights::Exact, Weights::Steps256].map(|weights| self.stored.lookup(weights, *c));
            // A sampler has the weights of one or of the other.
            let from =
                |want: [f32; 3]| (0..3).map(|i| (got[i] - want[i]).abs()).fold(0.0, f32::max);
            model.map(from).into_iter().fold(f32::INFINITY, f32::min)
        };
        Some(at.iter().zip(&got).map(off).fold(0.0, f32::max))
    }
}

fn stored(lit: &TableMaterial, axis: TableAxis, texels: usize, depth: Depth) -> Stored {
    Stored::new(
        &Table::new(&lit.name, &lit.reference, axis, texels).unwrap(),
        depth,
    )
}

fn at() -> Vec<f32> {
    let mut at = cosines(POINTS);
    at.extend([-1.0, -0.0, 0.0, 1.0, 1.000_000_1, 2.0]);
    at
}

#[test]
fn samplers_agree_with_the_model_of_filtering() {
    let at = at();
    let mut tried = 0;
    for lit in committed() {
        for (axis, texels) in [
            (TableAxis::Rational, 64),
            (TableAxis::Cos, 256),
            (TableAxis::Steep, 37),
        ] {
            for depth in Depth::ALL {
                for backend in [Backend::Vulkan, Backend::OpenGl, Backend::Gles] {
                    let stored = stored(&lit, axis, texels, depth);
                    let Some(off) = Put::right(&stored).difference(backend, &at) else {
                        continue;
                    };
                    tried += 1;
                    let what = format!("{} {axis:?} {texels} {depth:?} {backend:?}", lit.name);
                    let own = if depth == Depth::Unorm8 {
                        EIGHT_BITS
                    } else {
                        0.0
                    };
                    assert!(off <= CLOSE + own, "{what}: {off}");
                }
            }
        }
    }
    assert!(
        tried == 0 || tried > 60,
        "{tried} of 144 combinations were tried"
    );
}

#[test]
fn each_mistake_is_seen() {
    let at = at();
    for lit in committed() {
        let table = stored(&lit, TableAxis::Rational, 64, Depth::Half);
        let bytes = stored(&lit, TableAxis::Rational, 64, Depth::Unorm8);
        let right = Put::right(&table);
        for backend in [Backend::Vulkan, Backend::Gles] {
            let mistakes = [
                (
                    "beyond the edge the texels again, and no half texel",
                    Put {
                        wrap: Wrap::Repeat,
                        told: 1 << 24,
                        ..Put::right(&table)
                    },
                ),
                (
                    "cosine 1 first",
                    Put {
                        is_flipped: true,
                        ..Put::right(&table)
                    },
                ),
                (
                    "as colours of sRGB",
                    Put {
                        format: TextureFormat::Srgb8,
                        ..Put::right(&bytes)
                    },
                ),
                (
                    "no half texel at the ends",
                    Put {
                        told: 1 << 24,
                        ..Put::right(&table)
                    },
                ),
                (
                    "the size of another table",
                    Put {
                        told: 32,
                        ..Put::right(&table)
                    },
                ),
            ];
            let Some(off) = right.difference(backend, &at) else {
                continue;
            };
            assert!(off <= CLOSE, "{}: {off}", lit.name);
            // With the half texel not even a sampler that repeats reaches beyond the edge.
            let repeated = Put {
                wrap: Wrap::Repeat,
                ..Put::right(&table)
            };
            let off = repeated.difference(backend, &at).unwrap();
            assert!(off <= CLOSE, "{}, repeated: {off}", lit.name);
            for (name, put) in mistakes {
                let off = put.difference(backend, &at).unwrap();
                assert!(
                    off > 4.0 * CLOSE + EIGHT_BITS,
                    "{}: {name}: {off}",
                    lit.name
                );
            }
        }
    }
}
