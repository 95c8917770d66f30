// A transparent body, behind the text of its second surface.

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    return seen_through(front.position, incident, normalize(front.normal));
}
