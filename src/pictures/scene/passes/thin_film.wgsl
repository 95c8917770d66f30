// A metal under a film: one look-up, and R of the film at this cosine and thickness.

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let normal = normalize(front.normal);
    let r = film_reflectance(-dot(incident, normal), thickness_at(front.position));
    return vec4<f32>(r * look_up(fresnel_reflected(incident, normal)), FOUND);
}
