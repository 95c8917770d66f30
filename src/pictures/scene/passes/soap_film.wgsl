// A film around nothing. Light goes straight through, and meets the ball of radius 1 at the same angle each time. Three walls are
// followed: what the near side mirrors, what is seen through both sides, and what the far side mirrors.

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let near = normalize(front.position);
    let cos_theta = -dot(incident, near);
    let far = near + 2.0 * cos_theta * incident;
    let inner = fresnel_reflected(incident, -far);
    let third = far + 2.0 * cos_theta * inner;
    let r = film_reflectance(cos_theta, thickness_at(near));
    let r_far = film_reflectance(cos_theta, thickness_at(far));
    let r_third = film_reflectance(cos_theta, thickness_at(third));
    let through = (1.0 - r_far) * look_up(incident) + r_far * (1.0 - r_third) * look_up(inner);
    return vec4<f32>(r * look_up(fresnel_reflected(incident, near)) + (1.0 - r) * through, FOUND);
}
