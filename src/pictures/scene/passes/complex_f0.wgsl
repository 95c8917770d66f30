// A metal by Schlick's approximation, with F0 from its complex index.

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let normal = normalize(front.normal);
    let r = reflectance(incident, normal);
    return vec4<f32>(r * look_up(fresnel_reflected(incident, normal)), FOUND);
}
