// A rough ball under three lamps, far away; nothing else lights it. The roughness stands in absorption.w.

const LAMPS = 3;

@fragment
fn fs_dark(at: Cover) -> @location(0) vec4<f32> {
    let up = at.ndc.y * 0.5 + 0.5;
    return vec4<f32>(mix(vec3<f32>(0.035, 0.036, 0.04), vec3<f32>(0.09, 0.1, 0.12), up), SKY);
}

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    var lamps = array<vec3<f32>, 3>(vec3<f32>(-0.6, 0.6, 0.55), vec3<f32>(0.9, 0.3, 0.15), vec3<f32>(0.2, 0.25, -0.95));
    var lights = array<vec3<f32>, 3>(vec3<f32>(4.0, 3.8, 3.5), vec3<f32>(1.2, 1.6, 2.4), vec3<f32>(5.0, 5.0, 5.0));
    let normal = normalize(front.normal);
    let view = normalize(frame.eye.xyz - front.position);
    let roughness = frame.absorption.w;
    var sum = vec3<f32>(0.0);
    for (var i = 0; i < LAMPS; i += 1) {
        let lamp = normalize(lamps[i]);
        let half_way = normalize(view + lamp);
        let n_dot_l = dot(normal, lamp);
        let brdf = specular(dot(normal, view), n_dot_l, dot(normal, half_way), dot(view, half_way), roughness * roughness);
        sum += brdf * max(n_dot_l, 0.0) * lights[i];
    }
    return vec4<f32>(sum, FOUND);
}
