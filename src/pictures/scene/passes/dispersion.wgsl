// One surface with an index for each channel: a look-up along each ray, one R for all.

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let normal = normalize(front.normal);
    let etas = frame.n.xyz;
    let r = reflectance(incident, normal);
    let refraction = vec3<f32>(
        look_up(fresnel_refracted_red(incident, normal, etas)).r,
        look_up(fresnel_refracted_green(incident, normal, etas)).g,
        look_up(fresnel_refracted_blue(incident, normal, etas)).b,
    );
    let reflection = look_up(fresnel_reflected(incident, normal));
    return vec4<f32>(r * reflection + (1.0 - r) * refraction, FOUND);
}
