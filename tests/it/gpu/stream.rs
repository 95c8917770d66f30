//! A stream gives each number of a range once, in order.

use super::device;
use super::program;
use fresnel_gen::lab::gpu::{Backend, ShaderCode};

const IDENTITY: &str = "
@group(0) @binding(1) var<uniform> first: u32;
@group(0) @binding(2) var<storage, read_write> results: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if index < arrayLength(&results) {
        results[index] = vec4<f32>(bitcast<f32>(first + index), 1.0, 2.0, 3.0);
    }
}
";

#[test]
fn every_number_comes_once() {
    for backend in [Backend::Vulkan, Backend::OpenGl] {
        let Some(device) = device(backend) else {
            continue;
        };
        let stream = device.prepare_stream(&program(ShaderCode::Wgsl(IDENTITY), &[]));
        let stream = stream.unwrap();
        let (from, count) = (0x3F00_0001, 1_000_001);
        let mut bits = from;
        let taken = stream.run(from, count, &[], None, |first, results| {
            assert_eq!(first, bits);
            for result in results {
                assert_eq!(*result, [f32::from_bits(bits), 1.0, 2.0, 3.0]);
                bits += 1;
            }
        });
        taken.unwrap();
        assert_eq!(u64::from(bits - from), count);
    }
}
