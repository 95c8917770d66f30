// A transparent body with an index for each channel: the search of double_refraction for each of several samples of the spectrum.

const STEPS = 4;
const COUNT = 8;

@group(0) @binding(4) var positions: texture_2d<f32>;
@group(0) @binding(5) var normals: texture_2d<f32>;

struct Back {
    @location(0) position: vec4<f32>,
    @location(1) normal: vec4<f32>,
}

@fragment
fn fs_back(back: Surface) -> Back {
    return Back(vec4<f32>(back.position, 1.0), vec4<f32>(normalize(back.normal), 1.0));
}

// What comes along a ray inside, and in alpha what its search found.
fn through(entry: vec3<f32>, inside: vec3<f32>, eta: f32) -> vec4<f32> {
    var distance = frame.eye.w;
    for (var i = 0; i < STEPS; i += 1) {
        distance = fresnel_interior_search_step(entry, inside, distance, frame.view_projection, UV_SCALE_BIAS, positions, clamped);
    }
    let exit = entry + inside * abs(distance);
    let uv = fresnel_planar_uv(exit, frame.view_projection, UV_SCALE_BIAS).xy;
    let seen = textureSampleLevel(normals, clamped, uv, 0.0);
    if (distance <= 0.0 || seen.a <= 0.0) {
        return vec4<f32>(look_up(inside), MISSED);
    }
    let normal_out = normalize(seen.xyz);
    let out = fresnel_exit_direction(inside, normal_out, 1.0 / eta);
    if (dot(out, normal_out) < 0.0) {
        return vec4<f32>(look_up(out), TOTAL);
    }
    let t = transmittance_out(inside, normal_out, 1.0 / eta);
    return vec4<f32>(t * look_up(out), FOUND);
}

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let normal = normalize(front.normal);
    let r = reflectance(incident, normal);
    var refraction = vec3<f32>(0.0);
    var what = FOUND;
    for (var i = 0; i < COUNT; i += 1) {
        let t = (f32(i) + 0.5) / f32(COUNT);
        // The weights of red and blue have their middles at 1/4 and 3/4, where their indices are.
        let s = 2.0 * t - 0.5;
        let reddish = frame.n.x + (frame.n.y - frame.n.x) * 2.0 * s;
        let bluish = frame.n.y + (frame.n.z - frame.n.y) * (2.0 * s - 1.0);
        let eta = select(bluish, reddish, s < 0.5);
        let seen = through(front.position, fresnel_refracted(incident, normal, eta), eta);
        refraction += fresnel_spectral_weight(f32(i), f32(COUNT)) * seen.rgb;
        if (i == COUNT / 2) {
            what = seen.a;
        }
    }
    let reflection = look_up(fresnel_reflected(incident, normal));
    return vec4<f32>(r * reflection + (1.0 - r) * refraction, what);
}
