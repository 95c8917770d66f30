//! What is known of each function alone.

use std::f64::consts::PI;

use super::add;
use super::at_once;
use super::dot;
use super::function;
use super::function_by;
use super::many;
use super::numbers;
use super::unit;
use super::vector;
use super::vectors;
use fresnel_gen::language::ir::{CubeTexels, Filter, Texels, Value, evaluate};
use fresnel_gen::physics::optics;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// A ray that arrives at this angle, in radians.
fn arriving(theta: f64) -> [f64; 3] {
    [theta.sin(), 0.0, -theta.cos()]
}

#[test]
fn rays_obey_snell_and_the_mirror() {
    for eta in [0.6, 1.0, 1.333, 1.5, 2.42] {
        for step in 0..=89 {
            let theta = f64::from(step).to_radians();
            let incident = arriving(theta);
            let mirrored = at_once("reflected", &[vector(incident), vector(UP)]);
            assert!((dot(mirrored, UP) - theta.cos()).abs() < 1e-12);
            let refracted = at_once(
                "refracted",
                &[vector(incident), vector(UP), Value::scalar(eta)],
            );
            if theta.sin() > eta {
                assert_eq!(refracted, [0.0; 3], "past the critical angle");
            } else {
                assert!(
                    (refracted[0] - theta.sin() / eta).abs() < 1e-12,
                    "Snell's law"
                );
                assert!((dot(refracted, refracted) - 1.0).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn zero_vectors_give_zero_and_reflect_all() {
    let (zero, up, eta) = (vector([0.0; 3]), vector(UP), Value::scalar(1.5));
    let ray = vector(arriving(0.3));
    for arguments in [[&zero, &up], [&ray, &zero], [&zero, &zero]] {
        let [incident, normal] = arguments.map(Clone::clone);
        let pair = [incident, normal];
        assert_eq!(at_once("reflected", &pair), [0.0; 3]);
        let three = [pair[0].clone(), pair[1].clone(), eta.clone()];
        assert_eq!(at_once("refracted", &three), [0.0; 3]);
        let r = evaluate(
            &function("interface_reflectance"),
            &[pair[0].clone(), pair[1].clone(), vector([1.5; 3])],
        );
        assert_eq!(r.at(0), [1.0; 3]);
    }
    let to_world = [zero.clone(), zero.clone(), Value::scalar(1.0), zero.clone()];
    assert_eq!(at_once("normal_to_world", &to_world), [0.0; 3]);
    let boxed = [
        zero.clone(),
        zero.clone(),
        vector([-1.0; 3]),
        vector([1.0; 3]),
        vector([0.5; 3]),
    ];
    assert_eq!(at_once("box_parallax", &boxed), [0.0; 3]);
}

#[test]
fn the_share_is_that_of_the_law_and_of_any_method() {
    let angles: Vec<f64> = (0..90)
        .map(|degree| f64::from(degree).to_radians())
        .collect();
    let rays: Vec<[f64; 3]> = angles.iter().map(|theta| arriving(*theta)).collect();
    let got = evaluate(
        &function("interface_reflectance_scalar"),
        &[vectors(&rays), vector(UP), Value::scalar(0.7)],
    );
    for (i, theta) in angles.iter().enumerate() {
        let want = optics::dielectric(0.7, theta.cos()).unpolarised();
        assert!((got.at(i)[0] - want).abs() < 1e-9, "{theta}");
    }
    let schlick = function_by("interface_reflectance", "schlick");
    let got = evaluate(
        &schlick,
        &[vector(arriving(1.2)), vector(UP), vector([0.04; 3])],
    );
    let want = 0.04 + 0.96 * (1.0 - f64::cos(1.2)).powi(5);
    assert!((got.at(0)[2] - want).abs() < 1e-12);
}

/// The transmitted share of the power by the amplitudes of transmission (Born, Wolf, section 1.5.2, equations 20 and 35), which know
/// nothing of R: `η cos θt / cos θi |t|²`, the mean of both polarisations.
fn transmitted(eta: f64, cos_i: f64, cos_t: f64) -> f64 {
    let across = 2.0 * cos_i / (cos_i + eta * cos_t);
    let within = 2.0 * cos_i / (eta * cos_i + cos_t);
    eta * cos_t / cos_i * (across * across + within * within) / 2.0
}

/// Light that is reflected and light that is refracted are all light, from both sides and beyond total reflection, with the refracted
/// ray that the effect gives.
#[test]
fn reflection_and_refraction_share_all_light() {
    for eta in [1.0001, 1.333, 1.5, 2.42, 4.0]
        .into_iter()
        .flat_map(|eta| [eta, 1.0 / eta])
    {
        let rays: Vec<[f64; 3]> = (0..900)
            .map(|i| arriving((f64::from(i) / 10.0).to_radians()))
            .collect();
        let values = [vectors(&rays), vector(UP), Value::scalar(eta)];
        let [reflected, shares, refracted] =
            ["reflected", "interface_reflectance_scalar", "refracted"].map(|name| {
                let count = if name == "reflected" { 2 } else { 3 };
                evaluate(&function(name), &values[..count])
            });
        let leaves = evaluate(
            &function("exit_transmittance_scalar"),
            &[vectors(&rays), vector([0.0, 0.0, -1.0]), Value::scalar(eta)],
        );
        for (i, ray) in rays.iter().enumerate() {
            let (cos_i, share): (f64, f64) = (-ray[2], shares.at(i)[0]);
            assert!(
                (dot(reflected.at(i), UP) - cos_i).abs() < 1e-12,
                "{eta} {ray:?}"
            );
            let out: [f64; 3] = refracted.at(i);
            let is_total = ray[0] > eta;
            assert_eq!(out == [0.0; 3], is_total, "{eta} {ray:?}");
            let passes = if is_total {
                0.0
            } else {
                transmitted(eta, cos_i, -out[2])
            };
            assert!(
                (share + passes - 1.0).abs() < 1e-7,
                "{eta} {ray:?}: {share} and {passes}"
            );
            let leaves: f64 = leaves.at(i)[0];
            assert!(
                (share + leaves - 1.0).abs() < 1e-12,
                "{eta} {ray:?}: {share} and {leaves}"
            );
        }
    }
}

/// A ball: light is turned by 2 (theta_i - theta_t), and rays near the axis meet it at n R / (2 (n - 1)).
#[test]
fn a_ball_turns_and_gathers_light_as_it_must() {
    for n in [1.333, 1.5, 2.42] {
        for height in [0.01, 0.2, 0.5, 0.8, 0.99] {
            let entry = [height, 0.0, f64::sqrt(1.0 - height * height)];
            let incident = [0.0, 0.0, -1.0];
            let inside = at_once(
                "refracted",
                &[vector(incident), vector(entry), Value::scalar(n)],
            );
            let exit = add(entry, inside, -2.0 * dot(entry, inside));
            let outside = at_once(
                "exit_direction",
                &[vector(inside), vector(exit), Value::scalar(1.0 / n)],
            );
            let turned = dot(incident, outside).acos();
            let want = 2.0 * (height.asin() - (height / n).asin());
            assert!(
                (turned - want).abs() < 1e-6,
                "{n} {height}: {turned} {want}"
            );
            if height == 0.01 {
                let meets = exit[2] - exit[0] / outside[0] * outside[2];
                let focus = n / (2.0 * (n - 1.0));
                assert!((-meets - focus).abs() < 1e-3, "{n}: {meets} {focus}");
            }
            let t = evaluate(
                &function("exit_transmittance_scalar"),
                &[vector(inside), vector(exit), Value::scalar(1.0 / n)],
            );
            let r = optics::dielectric(n, (1.0 - height * height).sqrt()).unpolarised();
            assert!(
                (t.at(0)[0] - (1.0 - r)).abs() < 1e-9,
                "R is the same from both sides"
            );
        }
    }
}

/// Inside, past the critical angle, a ray is mirrored.
#[test]
fn total_reflection_mirrors_the_ray_inside() {
    let inside = [0.8, 0.0, 0.6];
    let got = at_once(
        "exit_direction",
        &[vector(inside), vector(UP), Value::scalar(1.0 / 1.5)],
    );
    assert_eq!(got, [0.8, 0.0, -0.6]);
}

/// The mean of F (1 - F) over the disc of a ball that light crosses: what the exit takes from it.
#[test]
fn the_exit_of_a_ball_takes_what_it_must() {
    for (n, want) in [(1.5168, 0.075), (2.42, 0.161)] {
        let steps = 4000;
        let mut sum = 0.0;
        for i in 0..steps {
            let share = (f64::from(i) + 0.5) / f64::from(steps);
            let height = share.sqrt();
            let r = evaluate(
                &function("interface_reflectance_scalar"),
                &[
                    vector([0.0, 0.0, -1.0]),
                    vector([height, 0.0, (1.0 - share).sqrt()]),
                    Value::scalar(n),
                ],
            );
            let r = r.at(0)[0];
            sum += r * (1.0 - r) / f64::from(steps);
        }
        assert!((sum - want).abs() < 5e-4, "{n}: {sum}");
    }
}

#[test]
fn a_mapped_normal_is_of_unit_length_and_mirrored_textures_mirror_it() {
    let (tangent, normal) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let map = |tangent_normal: [f64; 3], sign: f64| {
        at_once(
            "normal_to_world",
            &[
                vector(tangent_normal),
                vector(tangent),
                Value::scalar(sign),
                vector(normal),
            ],
        )
    };
    assert_eq!(
        map([0.0, 0.0, 1.0], 1.0),
        normal,
        "a flat map changes nothing"
    );
    assert_eq!(map([1.0, 0.0, 0.0], 1.0), tangent);
    assert_eq!(
        map([0.0, 1.0, 0.0], 1.0),
        [-1.0, 0.0, 0.0],
        "cross(normal, tangent)"
    );
    assert_eq!(map([0.0, 1.0, 0.0], -1.0), [1.0, 0.0, 0.0]);
    let slanted = map([0.3, -0.2, 0.5], 1.0);
    assert!((dot(slanted, slanted) - 1.0).abs() < 1e-12);
}

#[test]
fn the_box_is_met_on_its_wall_by_every_ray() {
    let (low, high, centre) = ([-1.0, -2.0, -3.0], [4.0, 5.0, 6.0], [0.5, 0.25, 0.125]);
    let start = [0.3, -0.4, 0.7];
    let directions = [
        [1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [-0.3, 0.2, 0.9],
        [1e-30, 1.0, -1e-25],
        [2.0, -7.0, 3.0],
    ];
    for direction in directions {
        let got = at_once(
            "box_parallax",
            &[
                vector(start),
                vector(direction),
                vector(low),
                vector(high),
                vector(centre),
            ],
        );
        let wall = add(got, centre, 1.0);
        let off = (0..3).map(|i| (wall[i] - low[i]).abs().min((wall[i] - high[i]).abs()));
        assert!(
            off.fold(1.0, f64::min) < 1e-9,
            "{direction:?}: {wall:?} lies on no wall"
        );
        let along = unit(add(wall, start, -1.0));
        assert!(
            dot(along, unit(direction)) > 1.0 - 1e-9,
            "{direction:?}: {along:?}"
        );
    }
}

/// A ball as a room: the cube holds 1 everywhere, and the ray's way to the wall is known.
#[test]
fn the_search_in_a_cube_finds_the_wall() {
    let cube = Value::Cube(Some(CubeTexels {
        size: 8,
        texels: vec![[2.0; 3]; 6 * 64].into(),
    }));
    let (centre, start, direction) = ([0.1, 0.2, 0.3], [0.6, -0.3, 0.5], unit([0.4, 0.7, -0.2]));
    let mut distance = 2.0;
    for _ in 0..12 {
        let arguments = [
            vector(start),
            vector(direction),
            Value::scalar(distance),
            vector(centre),
            cube.clone(),
        ];
        distance = at_once("cube_search_step", &arguments)[0];
    }
    let from_centre = add(start, centre, -1.0);
    let b = dot(from_centre, direction);
    let want = -b + (b * b - dot(from_centre, from_centre) + 4.0).sqrt();
    assert!((distance - want).abs() < 1e-4, "{distance} {want}");
}

#[test]
fn spectral_weights_sum_to_one_and_go_from_red_to_blue() {
    let weight = function("spectral_weight");
    for count in [1, 2, 3, 7, 16, 81] {
        let indices: Vec<f64> = (0..count).map(f64::from).collect();
        let got = evaluate(
            &weight,
            &[numbers(&indices), Value::scalar(f64::from(count))],
        );
        for channel in 0..3 {
            let sum: f64 = (0..count as usize).map(|i| got.at(i)[channel]).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{count} {channel}: {sum}");
        }
        if count > 2 {
            let (first, last) = (got.at(0), got.at(count as usize - 1));
            assert!(first[0] > 4.0 * first[2] && last[2] > 4.0 * last[0]);
        }
    }
}

#[test]
fn a_place_in_front_of_the_camera_has_its_texture_coordinates() {
    // A camera at the origin that looks along -z, 90 degrees wide.
    let matrix = [
        1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0, -0.2, 0.0,
    ];
    let uv = |place: [f64; 3], down: f64| {
        at_once(
            "planar_uv",
            &[
                vector(place),
                many(&matrix),
                many(&[0.5, 0.5 * down, 0.5, 0.5]),
            ],
        )
    };
    assert_eq!(uv([0.0, 0.0, -4.0], 1.0), [0.5, 0.5, 4.0]);
    assert_eq!(uv([2.0, 4.0, -4.0], 1.0), [0.75, 1.0, 4.0]);
    assert_eq!(uv([2.0, 4.0, -4.0], -1.0), [0.75, 0.0, 4.0]);
    assert!(uv([0.0, 0.0, 4.0], 1.0)[2] < 0.0, "behind the camera");
    assert!(uv([1.0, 2.0, 0.0], 1.0).iter().all(|part| part.is_finite()));
}

/// Left half below the water and blue, right half before it and red: no distortion brings red to the left.
#[test]
fn nothing_before_the_water_leaks_into_it() {
    let width = 64;
    let is_below = |i: usize| i % width < width / 2;
    let texels = Texels {
        width,
        texels: (0..width * width)
            .map(|i| {
                if is_below(i) {
                    [0.0, 0.0, 1.0]
                } else {
                    [1.0, 0.0, 0.0]
                }
            })
            .collect(),
        alpha: Some((0..width * width).map(|i| f32::from(is_below(i))).collect()),
        filter: Filter::Linear,
    };
    let refraction = function("water_refraction");
    let mut leaks = 0;
    let mut bent = 0;
    for pixel in 0..31 {
        for step in 0..200 {
            let u = (f64::from(pixel) + 0.5) / 64.0;
            let distortion = -0.5 + f64::from(step) / 200.0;
            let arguments = [
                many(&[u, 0.5]),
                many(&[distortion, 0.0]),
                Value::Texture(Some(texels.clone())),
            ];
            let got = evaluate(&refraction, &arguments).at(0);
            leaks += usize::from(got[0] > 0.0);
            bent += usize::from(got[2] > 0.0);
        }
    }
    assert_eq!(leaks, 0);
    assert_eq!(bent, 31 * 200, "there is water everywhere");
}

#[test]
fn triangles_and_splats_keep_the_flux() {
    let (a, b, c) = ([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]);
    let got = at_once(
        "triangle_irradiance",
        &[vector([12.0, 6.0, 0.0]), vector(a), vector(b), vector(c)],
    );
    assert_eq!(got, [2.0, 1.0, 0.0]);
    let line = at_once(
        "triangle_irradiance",
        &[vector([1.0; 3]), vector(a), vector(b), vector(b)],
    );
    assert_eq!(line, [0.0; 3], "a triangle without area makes no light");
    let steps = 400;
    let mut sum = 0.0;
    for radius in [0.5, 2.0] {
        sum = 0.0;
        let places: Vec<(f64, f64)> = (0..steps * steps)
            .map(|i| {
                let at = |i: i32| (f64::from(i) + 0.5) / f64::from(steps) * 2.0 * radius - radius;
                (at(i / steps), at(i % steps))
            })
            .collect();
        let splat = function("splat_weight");
        for (x, y) in places {
            let cell = (2.0 * radius / f64::from(steps)).powi(2);
            sum += evaluate(&splat, &[many(&[x, y]), Value::scalar(radius)]).at(0)[0] * cell;
        }
        assert!((sum - 1.0).abs() < 1e-4, "{radius}: {sum}");
    }
    assert!(sum > 0.0);
    let energy = at_once(
        "photon_energy",
        &[vector([0.9; 3]), vector([0.5; 3]), Value::scalar(2.0)],
    );
    assert!((energy[0] - 0.9).abs() < 1e-15);
}

#[test]
fn complex_f0_is_that_of_the_law() {
    let (n, k) = ([0.18, 0.42, 1.37], [3.43, 2.35, 1.77]);
    let got = at_once("complex_f0", &[vector(n), vector(k)]);
    for i in 0..3 {
        let want: f64 = optics::normal_incidence(n[i], k[i]);
        assert!((got[i] - want).abs() < 1e-14);
    }
}

/// r_s and r_p by complex numbers, as (real, imaginary).
fn amplitudes(n: f64, k: f64, c: f64) -> [(f64, f64); 2] {
    let times = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let over = |a: (f64, f64), b: (f64, f64)| {
        let size = b.0 * b.0 + b.1 * b.1;
        let (real, imaginary) = times(a, (b.0, -b.1));
        (real / size, imaginary / size)
    };
    let plus = |a: (f64, f64), b: f64| (a.0 + b, a.1);
    let eta2 = times((n, k), (n, k));
    let (x, y) = (eta2.0 - (1.0 - c * c), eta2.1);
    let size = x.hypot(y);
    let q = (
        ((size + x) / 2.0).max(0.0).sqrt(),
        ((size - x) / 2.0).max(0.0).sqrt(),
    );
    let dense = (eta2.0 * c, eta2.1 * c);
    let sum = |a: (f64, f64), b: (f64, f64), sign: f64| (a.0 + sign * b.0, a.1 + sign * b.1);
    let r_s = over(plus((-q.0, -q.1), c), plus(q, c));
    [r_s, over(sum(q, dense, -1.0), sum(q, dense, 1.0))]
}

/// The four numbers are those of the complex amplitudes, they neither make nor lose light of one polarisation, and total reflection of
/// glass turns the phase by the 45 degrees of Fresnel's rhomb (Born, Wolf, section 1.5.4: n = 1.51 at 54.62 degrees).
#[test]
fn polarised_light_is_that_of_complex_amplitudes() {
    let media = [
        (1.5, 0.0),
        (0.7, 0.0),
        (0.2, 3.4),
        (1.37, 1.77),
        (3.0, 0.01),
        (1.0, 0.0),
    ];
    for (n, k) in media {
        for step in 0..=90 {
            let c = f64::from(step).to_radians().cos();
            let arguments = [Value::scalar(c), vector([n; 3]), vector([k; 3])];
            let got =
                ["m", "d", "c", "s"].map(|name| at_once(&format!("mueller_{name}"), &arguments)[1]);
            let [m, d, real, imaginary] = got;
            assert!((m * m - d * d - real * real - imaginary * imaginary).abs() < 1e-12);
            if n == 1.0 {
                assert_eq!(got, [0.0; 4]);
                continue;
            }
            let [s, p] = amplitudes(n, k, c);
            let [big, small] = [s, p].map(|r| r.0 * r.0 + r.1 * r.1);
            let want = [
                (big + small) / 2.0,
                (big - small) / 2.0,
                p.0 * s.0 + p.1 * s.1,
                p.1 * s.0 - p.0 * s.1,
            ];
            for (got, want) in got.iter().zip(want) {
                assert!((got - want).abs() < 1e-9, "{n} {k} {step}: {got} {want}");
            }
        }
    }
    let c = 54.0_f64 + 37.0 / 60.0;
    let arguments = [
        Value::scalar(c.to_radians().cos()),
        vector([1.0 / 1.51; 3]),
        vector([0.0; 3]),
    ];
    let [real, imaginary] = ["mueller_c", "mueller_s"].map(|name| at_once(name, &arguments)[0]);
    let turned = imaginary.atan2(real).to_degrees().abs();
    assert!(
        (turned - 135.0).abs() < 0.05 || (turned - 45.0).abs() < 0.05,
        "{turned}"
    );
    println!("Fresnel's rhomb turns the phase by {turned:.3} degrees");
}

/// The white furnace: with F = 1 no more light leaves than arrives, and nearly all of it where the surface is smooth.
#[test]
fn a_rough_mirror_keeps_nearly_all_light_and_never_gains() {
    let specular = function_by("ggx_specular", "schlick");
    let reflected = |alpha: f64, view: f64| {
        let (steps, around) = (1200, 64);
        let mut sum = 0.0;
        let sin_view = (1.0 - view * view).sqrt();
        let v = [sin_view, 0.0, view];
        let mut arguments: [Vec<f64>; 3] = Default::default();
        let mut weights = Vec::new();
        // Half vectors, dense at the peak: tan theta_h = alpha sqrt(u / (1 - u)), each with an equal share of D cos.
        for i in 0..steps {
            let u = (f64::from(i) + 0.5) / f64::from(steps);
            let tan2 = alpha * alpha * u / (1.0 - u);
            let cos_h = 1.0 / (1.0 + tan2).sqrt();
            let sin_h = (1.0 - cos_h * cos_h).sqrt();
            for j in 0..around {
                let phi = (f64::from(j) + 0.5) / f64::from(around) * PI;
                let h = [sin_h * phi.cos(), sin_h * phi.sin(), cos_h];
                let v_dot_h = dot(v, h);
                let l = add(v.map(|part| -part), h, 2.0 * v_dot_h);
                if v_dot_h <= 0.0 || l[2] <= 0.0 {
                    continue;
                }
                let d =
                    alpha * alpha / (PI * (cos_h * cos_h * (alpha * alpha - 1.0) + 1.0).powi(2));
                let density = d * cos_h / (4.0 * v_dot_h);
                weights.push(l[2] / density / f64::from(steps * around));
                for (list, value) in arguments.iter_mut().zip([l[2], cos_h, v_dot_h]) {
                    list.push(value);
                }
            }
        }
        let [l, h, vh] = arguments;
        let values = [
            Value::scalar(view),
            numbers(&l),
            numbers(&h),
            numbers(&vh),
            Value::scalar(alpha),
            vector([1.0; 3]),
        ];
        let got = evaluate(&specular, &values);
        for (i, weight) in weights.iter().enumerate() {
            sum += got.at(i)[0] * weight;
        }
        sum
    };
    for view in [0.1, 0.5, 0.9] {
        assert!(
            (reflected(0.002, view) - 1.0).abs() < 1e-3,
            "a smooth mirror: {}",
            reflected(0.002, view)
        );
        for alpha in [0.1, 0.3, 0.6, 1.0] {
            let share = reflected(alpha, view);
            assert!(
                share < 1.0 + 1e-6 && share > 0.3,
                "alpha {alpha}, view {view}: {share}"
            );
        }
    }
}

/// Light that leaves diamond is reflected totally from 24.4 degrees on: a function of the material has the inverse index.
#[test]
fn an_exit_from_a_material_reflects_totally() {
    let subjects = crate::subjects(&["diamond"]);
    let request = fresnel_gen::generator::emit::EffectRequest {
        effect: fresnel_gen::language::effects::find("interior").expect("an effect"),
        method: fresnel_gen::language::methods::find("dielectric_exact").expect("a method"),
        subject: Some(&subjects[0]),
    };
    let functions = request.functions(&Default::default()).expect("well formed");
    let names: Vec<&str> = functions.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["fresnel_exit_transmittance_diamond"]);
    for (degrees, passes) in [
        (0.0, true),
        (20.0, true),
        (24.0, true),
        (25.0, false),
        (60.0, false),
    ] {
        let theta = f64::to_radians(degrees);
        let direction = [theta.sin(), 0.0, theta.cos()];
        let t: [f64; 3] = evaluate(&functions[0].function, &[vector(direction), vector(UP)]).at(0);
        let want = 1.0 - optics::dielectric(1.0 / 2.4229, theta.cos()).unpolarised();
        assert_eq!(t[1] > 1e-7, passes, "{degrees}: {t:?}");
        assert!((t[1] - want).abs() < 1e-3, "{degrees}: {t:?} {want}");
    }
}
