// One surface: what is refracted by it is taken as outside. That is all that a cube map allows.

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let normal = normalize(front.normal);
    let eta = frame.n.y;
    let r = reflectance(incident, normal);
    let reflection = look_up(fresnel_reflected(incident, normal));
    let refraction = look_up(fresnel_refracted(incident, normal, eta));
    return vec4<f32>(r * reflection + (1.0 - r) * refraction, FOUND);
}
