// What lies behind a transparent body: a search in a picture of its back for where a ray leaves.

const STEPS = 4;

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
        // Reflected totally: all of it goes on, and is taken as outside.
        return vec4<f32>(look_up(out), TOTAL);
    }
    let t = transmittance_out(inside, normal_out, 1.0 / eta);
    return vec4<f32>(t * look_up(out), FOUND);
}

// What a place of the front shows, and in alpha what became of the ray.
fn seen_through(position: vec3<f32>, incident: vec3<f32>, normal: vec3<f32>) -> vec4<f32> {
    let eta = frame.n.y;
    let r = reflectance(incident, normal);
    let seen = through(position, fresnel_refracted(incident, normal, eta), eta);
    let reflection = look_up(fresnel_reflected(incident, normal));
    return vec4<f32>(r * reflection + (1.0 - r) * seen.rgb, seen.a);
}
