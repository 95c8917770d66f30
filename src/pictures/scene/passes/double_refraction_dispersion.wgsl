// A transparent body with an index for each channel, behind the text of its second surface: the search for each of several samples of the
// spectrum.

const COUNT = 8;

@fragment
fn fs_front(front: Surface) -> @location(0) vec4<f32> {
    let incident = normalize(front.position - frame.eye.xyz);
    let normal = normalize(front.normal);
    let r = reflectance(incident, normal);
    var refraction = vec3<f32>(0.0);
    var what = FOUND;
    for (var i = 0; i < COUNT; i += 1) {
        let t = (f32(i) + 0.5) / f32(COUNT);
        // The weights of red and blue have their middles at 1/4 and 3/4, where their indices are.
        let s = 2.0 * t - 0.5;
        let reddish = frame.n.x + (frame.n.y - frame.n.x) * 2.0 * s;
        let bluish = frame.n.y + (frame.n.z - frame.n.y) * (2.0 * s - 1.0);
        let eta = select(bluish, reddish, s < 0.5);
        let seen = through(front.position, fresnel_refracted(incident, normal, eta), eta);
        refraction += fresnel_spectral_weight(f32(i), f32(COUNT)) * seen.rgb;
        if (i == COUNT / 2) {
            what = seen.a;
        }
    }
    let reflection = look_up(fresnel_reflected(incident, normal));
    return vec4<f32>(r * reflection + (1.0 - r) * refraction, what);
}
