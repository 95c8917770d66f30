// Photons along the light, through a body by the search in pictures of its front and back, onto a receiver; there as triangles, splats or
// points. The camera is the light's; eye holds the receiver's depth, half the window's width, the photons of a row, and a step's begin;
// room_min.zw the widths of a sample and of a pixel.

const STEPS = 8;
const ALONG = vec3<f32>(0.0, 0.0, -1.0);
// A triangle of fewer samples of the window is a point.
const SMALLEST = 2.0;
// Of a splat, in pixels of the window.
const RADIUS = 2.0;

@group(0) @binding(4) var front_positions: texture_2d<f32>;
@group(0) @binding(5) var front_normals: texture_2d<f32>;
@group(0) @binding(6) var positions: texture_2d<f32>;
@group(0) @binding(7) var normals: texture_2d<f32>;

struct Pair {
    @location(0) first: vec4<f32>,
    @location(1) second: vec4<f32>,
}

struct Lit {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) light: vec3<f32>,
    @location(1) offset: vec2<f32>,
}

@fragment
fn fs_side(side: Surface) -> Pair {
    return Pair(vec4<f32>(side.position, 1.0), vec4<f32>(normalize(side.normal), 1.0));
}

// The side of a photon's cell.
fn cell() -> f32 {
    return 2.0 / frame.eye.z;
}

// Where a photon lands, and its energy; zero where it does not.
@fragment
fn fs_photon(at: Cover) -> Pair {
    let texel = vec2<i32>(at.clip.xy);
    let entry = textureLoad(front_positions, texel, 0);
    let nowhere = Pair(vec4<f32>(0.0), vec4<f32>(0.0));
    if (entry.a == 0.0) {
        return nowhere;
    }
    let normal = normalize(textureLoad(front_normals, texel, 0).xyz);
    let eta = frame.n.y;
    let inside = fresnel_refracted(ALONG, normal, eta);
    var distance = frame.eye.w;
    for (var i = 0; i < STEPS; i += 1) {
        distance = fresnel_interior_search_step(entry.xyz, inside, distance, frame.view_projection, UV_SCALE_BIAS, positions, clamped);
    }
    let exit = entry.xyz + inside * abs(distance);
    let uv = fresnel_planar_uv(exit, frame.view_projection, UV_SCALE_BIAS).xy;
    let seen = textureSampleLevel(normals, clamped, uv, 0.0);
    if (distance <= 0.0 || seen.a <= 0.0) {
        return nowhere;
    }
    let normal_out = normalize(seen.xyz);
    let out = fresnel_exit_direction(inside, normal_out, 1.0 / eta);
    if (dot(out, normal_out) <= 0.0 || out.z >= -1e-3) {
        return nowhere;
    }
    let t_entry = 1.0 - reflectance(ALONG, normal);
    let t_exit = transmittance_out(inside, normal_out, 1.0 / eta);
    let energy = fresnel_photon_energy(t_entry, vec3<f32>(t_exit), cell() * cell());
    let land = exit + out * ((-frame.eye.x - exit.z) / out.z);
    return Pair(vec4<f32>(land, 1.0), vec4<f32>(energy, 1.0));
}

// Below, photons are read from the places of the front: 4 holds where they land, 5 their energy.

fn in_window(land: vec2<f32>) -> vec4<f32> {
    return vec4<f32>(land / frame.eye.y, 0.5, 1.0);
}

const BESIDE = vec4<f32>(2.0, 2.0, 2.0, 1.0);

// Two triangles a cell; without a corner there is none.
@vertex
fn vs_triangle(@builtin(vertex_index) index: u32) -> Lit {
    var corners = array<vec2<i32>, 6>(
        vec2<i32>(0, 0), vec2<i32>(1, 0), vec2<i32>(0, 1), vec2<i32>(0, 1), vec2<i32>(1, 0), vec2<i32>(1, 1));
    let row = u32(frame.eye.z) - 1u;
    let place = index / 6u;
    let low = vec2<i32>(i32(place % row), i32(place / row));
    let first = (index % 6u) / 3u * 3u;
    var lands: array<vec3<f32>, 3>;
    var flux = vec3<f32>(0.0);
    for (var i = 0u; i < 3u; i += 1u) {
        let texel = low + corners[first + i];
        let land = textureLoad(front_positions, texel, 0);
        if (land.a == 0.0) {
            return Lit(BESIDE, vec3<f32>(0.0), vec2<f32>(0.0));
        }
        lands[i] = land.xyz;
        // A triangle has half of a photon's area, and the mean of three energies.
        flux += textureLoad(front_normals, texel, 0).rgb / 6.0;
    }
    let pixel = frame.room_min.z;
    let along = lands[1].xy - lands[0].xy;
    let beside = lands[2].xy - lands[0].xy;
    if (abs(along.x * beside.y - along.y * beside.x) < 2.0 * SMALLEST * pixel * pixel) {
        // Too small for a rasteriser: all of its flux goes to the pixel of its middle.
        let whole = vec3<f32>(2.0 * pixel, 0.0, 0.0);
        let light = fresnel_triangle_irradiance(flux, vec3<f32>(0.0), whole, whole.yxz * 0.5);
        let middle = floor((lands[0].xy + lands[1].xy + lands[2].xy) / 3.0 / pixel) + 0.5;
        var around_middle = array<vec2<f32>, 3>(
            vec2<f32>(-0.3, -0.3), vec2<f32>(0.6, -0.3), vec2<f32>(-0.3, 0.6));
        return Lit(in_window((middle + around_middle[index % 3u]) * pixel), light, vec2<f32>(0.0));
    }
    let light = fresnel_triangle_irradiance(flux, lands[0], lands[1], lands[2]);
    return Lit(in_window(lands[index % 3u].xy), light, vec2<f32>(0.0));
}

// The corner of a square, -1 to 1.
fn corner(index: u32) -> vec2<f32> {
    let i = (index % 6u) % 3u + (index % 6u) / 3u;
    return vec2<f32>(f32(i & 1u) * 2.0 - 1.0, f32(i >> 1u) * 2.0 - 1.0);
}

fn photon(index: u32) -> vec2<i32> {
    let row = u32(frame.eye.z);
    return vec2<i32>(i32(index / 6u % row), i32(index / 6u / row));
}

@vertex
fn vs_splat(@builtin(vertex_index) index: u32) -> Lit {
    let land = textureLoad(front_positions, photon(index), 0);
    if (land.a == 0.0) {
        return Lit(BESIDE, vec3<f32>(0.0), vec2<f32>(0.0));
    }
    let offset = corner(index) * RADIUS * frame.room_min.w;
    return Lit(in_window(land.xy + offset), textureLoad(front_normals, photon(index), 0).rgb, offset);
}

// The pixel that a photon lands in.
@vertex
fn vs_point(@builtin(vertex_index) index: u32) -> Lit {
    let land = textureLoad(front_positions, photon(index), 0);
    if (land.a == 0.0) {
        return Lit(BESIDE, vec3<f32>(0.0), vec2<f32>(0.0));
    }
    let pixel = frame.room_min.w;
    let middle = (floor(land.xy / pixel) + 0.5) * pixel;
    let light = textureLoad(front_normals, photon(index), 0).rgb / (pixel * pixel);
    return Lit(in_window(middle + corner(index) * 0.5 * pixel), light, vec2<f32>(0.0));
}

@fragment
fn fs_lit(lit: Lit) -> @location(0) vec4<f32> {
    return vec4<f32>(lit.light, 1.0);
}

@fragment
fn fs_splat(lit: Lit) -> @location(0) vec4<f32> {
    return vec4<f32>(lit.light * fresnel_splat_weight(lit.offset, RADIUS * frame.room_min.w), 1.0);
}
