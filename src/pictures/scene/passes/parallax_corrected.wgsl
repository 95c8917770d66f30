// A mirror in a room of which there is one cube map, taken beside it: looked up where a ray meets the room's box.

@group(0) @binding(4) var room: texture_cube<f32>;

fn seen_from(position: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    let centre = frame.room_centre.xyz;
    let towards = fresnel_box_parallax(position, direction, frame.room_min.xyz, frame.room_max.xyz, centre);
    return textureSampleLevel(room, clamped, towards, 0.0).rgb;
}

@fragment
fn fs_room(at: Cover) -> @location(0) vec4<f32> {
    let far = frame.inverse * vec4<f32>(at.ndc, 1.0, 1.0);
    return vec4<f32>(seen_from(frame.eye.xyz, far.xyz / far.w - frame.eye.xyz), SKY);
}

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let normal = normalize(front.normal);
    let r = reflectance(incident, normal);
    return vec4<f32>(r * seen_from(front.position, fresnel_reflected(incident, normal)), FOUND);
}
