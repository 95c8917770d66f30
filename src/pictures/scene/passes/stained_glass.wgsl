// Stained glass: the normal map turns the normal of the inner surface, and light from outside is refracted by both surfaces and
// tinted along its path. What is not glass is lead or stone, by the light of the room.

@group(0) @binding(4) var paint: texture_2d<f32>;
@group(0) @binding(5) var relief: texture_2d<f32>;

// The light in the room, by where it comes from.
fn room(direction: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.055, 0.048, 0.04) * (1.2 - 0.8 * direction.y);
}

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let colour = textureSampleLevel(paint, clamped, front.uv, 0.0);
    let mapped = textureSampleLevel(relief, clamped, front.uv, 0.0).xyz;
    let normal = fresnel_normal_to_world(mapped, front.tangent.xyz, front.tangent.w, front.normal);
    if (colour.a < 0.5) {
        return vec4<f32>(colour.rgb * room(normal), SKY);
    }
    let eta = frame.n.y;
    let r = reflectance(incident, normal);
    let inside = fresnel_refracted(incident, normal, eta);
    let outward = -front.normal;
    let out = fresnel_exit_direction(inside, outward, 1.0 / eta);
    let t = transmittance_out(inside, outward, 1.0 / eta);
    let tint = pow(colour.rgb, vec3<f32>(1.0 / dot(inside, outward)));
    let light = t * tint * look_up(out);
    return vec4<f32>(r * room(fresnel_reflected(incident, normal)) + (1.0 - r) * light, FOUND);
}
