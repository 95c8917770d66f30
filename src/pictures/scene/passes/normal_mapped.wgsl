// A metal with a normal map: the normal is taken to the world, and the ray stays there.

@group(0) @binding(4) var relief: texture_2d<f32>;

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let mapped = textureSampleLevel(relief, around, front.uv, 0.0).xyz;
    let tangent = normalize(front.tangent.xyz);
    let normal = fresnel_normal_to_world(mapped, tangent, front.tangent.w, normalize(front.normal));
    let r = reflectance(incident, normal);
    return vec4<f32>(r * look_up(fresnel_reflected(incident, normal)), FOUND);
}
