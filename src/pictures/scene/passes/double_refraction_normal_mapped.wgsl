// A hammered body of glass, behind the text of its second surface: a normal map turns the normals of both. The picture of the back holds
// turned normals, and the search finds them as it finds others.

@group(0) @binding(4) var back_relief: texture_2d<f32>;
@group(0) @binding(6) var front_relief: texture_2d<f32>;

fn turned(mapped: vec3<f32>, surface: Surface) -> vec3<f32> {
    let tangent = normalize(surface.tangent.xyz);
    return fresnel_normal_to_world(mapped, tangent, surface.tangent.w, normalize(surface.normal));
}

@fragment
fn fs_dented_back(back: Surface) -> Back {
    let normal = turned(textureSampleLevel(back_relief, around, back.uv, 0.0).xyz, back);
    return Back(vec4<f32>(back.position, 1.0), vec4<f32>(normal, 1.0));
}

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let normal = turned(textureSampleLevel(front_relief, around, front.uv, 0.0).xyz, front);
    let incident = normalize(front.position - frame.eye.xyz);
    return seen_through(front.position, incident, normal);
}
