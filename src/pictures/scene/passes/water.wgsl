// Water: the scene mirrored in it, and a picture of what lies below it, each looked up where the waves send the ray.

const BELOW_STEPS = 4;
const MIRROR_STEPS = 3;
const MASK_STEPS = 6;
// What the mirrored ray goes to where it meets nothing.
const FAR = 100.0;

@group(0) @binding(4) var paint: texture_2d<f32>;

@group(0) @binding(4) var below: texture_2d<f32>;
@group(0) @binding(5) var below_positions: texture_2d<f32>;
@group(0) @binding(6) var mirror: texture_2d<f32>;
@group(0) @binding(7) var mirror_positions: texture_2d<f32>;
@group(0) @binding(8) var waves: texture_2d<f32>;

struct Seen {
    @location(0) colour: vec4<f32>,
    @location(1) position: vec4<f32>,
}

fn painted(uv: vec2<f32>) -> vec3<f32> {
    return textureSampleLevel(paint, clamped, uv, 0.0).rgb;
}

@fragment
fn fs_solid(solid: Surface) -> @location(0) vec4<f32> {
    return vec4<f32>(painted(solid.uv), SKY);
}

// Alpha says whether it is below the water.
@fragment
fn fs_below(solid: Surface) -> Seen {
    let is_below = select(0.0, 1.0, solid.position.y < 0.0);
    return Seen(vec4<f32>(painted(solid.uv), is_below), vec4<f32>(solid.position, is_below));
}

@fragment
fn fs_mirror_sky(at: Cover) -> Seen {
    let far = frame.inverse * vec4<f32>(at.ndc, 1.0, 1.0);
    return Seen(vec4<f32>(look_up(far.xyz / far.w - frame.eye.xyz), 1.0), vec4<f32>());
}

@fragment
fn fs_mirror(solid: Surface) -> Seen {
    return Seen(vec4<f32>(painted(solid.uv), 1.0), vec4<f32>(solid.position, 1.0));
}

struct Found {
    colour: vec3<f32>,
    found: bool,
    leaks: bool,
}

// Whether the picture has what the whole bend leads to: else the function shows what is straight behind the water.
fn is_shown(uv: vec2<f32>, bend: vec2<f32>) -> bool {
    let place = fresnel_water_refraction(uv, bend, below_positions, clamped);
    let shown = fresnel_planar_uv(place, frame.margin, UV_SCALE_BIAS).xy;
    return distance(shown, uv + bend) < distance(shown, uv);
}

// The largest share of the bend that leads to something below the water: without it the edge of the mask is seen.
fn shown_bend(uv: vec2<f32>, bend: vec2<f32>) -> vec2<f32> {
    var least = 0.0;
    var most = 1.0;
    for (var i = 0; i < MASK_STEPS; i += 1) {
        let middle = 0.5 * (least + most);
        let shows = is_shown(uv, middle * bend);
        least = select(least, middle, shows);
        most = select(middle, most, shows);
    }
    return least * bend;
}

// What lies along the refracted ray: searched for from what is straight behind the water, and masked.
fn refraction(position: vec3<f32>, uv: vec2<f32>, straight: vec3<f32>, inside: vec3<f32>) -> Found {
    var distance = length(straight - position);
    for (var i = 0; i < BELOW_STEPS; i += 1) {
        distance = fresnel_interior_search_step(position, inside, distance, frame.margin, UV_SCALE_BIAS, below_positions, clamped);
    }
    var bend = fresnel_planar_uv(position + inside * abs(distance), frame.margin, UV_SCALE_BIAS).xy - uv;
    let found = is_shown(uv, bend);
    if (!found) {
        bend = shown_bend(uv, bend);
    }
    let colour = fresnel_water_refraction(uv, bend, below, clamped);
    let place = fresnel_water_refraction(uv, bend, below_positions, clamped);
    let dimmed = exp(-frame.absorption.xyz * length(place - position));
    return Found(colour * dimmed, found, place.y > 0.002);
}

// What lies along the mirrored ray, looked up in the mirrored scene; beyond its edge there is only the sky.
fn reflection(position: vec3<f32>, uv: vec2<f32>, direction: vec3<f32>) -> Found {
    let straight = textureSampleLevel(mirror_positions, clamped, uv, 0.0);
    var distance = select(FAR, length(straight.xyz - position), straight.a > 0.5);
    for (var i = 0; i < MIRROR_STEPS; i += 1) {
        let next = fresnel_interior_search_step(position, direction, distance, frame.mirrored, UV_SCALE_BIAS, mirror_positions, clamped);
        distance = select(FAR, next, next > 0.0);
    }
    let at = fresnel_planar_uv(position + direction * distance, frame.mirrored, UV_SCALE_BIAS);
    if (at.z <= 0.0 || any(at.xy < vec2<f32>(0.0)) || any(at.xy > vec2<f32>(1.0))) {
        return Found(look_up(direction), true, false);
    }
    let place = textureSampleLevel(mirror_positions, clamped, at.xy, 0.0);
    let colour = textureSampleLevel(mirror, clamped, at.xy, 0.0).rgb;
    return Found(colour, true, place.a > 0.5 && place.y < -0.002);
}

@fragment
fn fs_water(water: Surface) -> @location(0) vec4<f32> {
    let uv = fresnel_planar_uv(water.position, frame.margin, UV_SCALE_BIAS).xy;
    let straight = textureSampleLevel(below_positions, clamped, uv, 0.0);
    if (straight.a < 0.5) {
        // Something stands before the water.
        discard;
    }
    let incident = normalize(water.position - frame.eye.xyz);
    let mapped = textureSampleLevel(waves, clamped, water.uv, 0.0).xyz;
    let normal = fresnel_normal_to_world(mapped, water.tangent.xyz, water.tangent.w, water.normal);
    let eta = frame.n.y;
    let r = reflectance(incident, normal);
    let through = refraction(water.position, uv, straight.xyz, fresnel_refracted(incident, normal, eta));
    let mirrored = reflection(water.position, uv, fresnel_reflected(incident, normal));
    var what = select(MISSED, FOUND, through.found);
    if (through.leaks || mirrored.leaks) {
        what = LEAKED;
    }
    return vec4<f32>(r * mirrored.colour + (1.0 - r) * through.colour, what);
}
