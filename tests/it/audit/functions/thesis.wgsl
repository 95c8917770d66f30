// The formulas of the thesis, written by hand as its text has them.

// Eqs. 1 to 3: the exact law for dielectrics.
fn dielectric(cos_theta: f32, eta: vec3<f32>) -> vec3<f32> {
    let cos_t = sqrt(1.0 - (1.0 - cos_theta * cos_theta) / (eta * eta));
    let s = (cos_theta - eta * cos_t) / (cos_theta + eta * cos_t);
    let p = (eta * cos_theta - cos_t) / (eta * cos_theta + cos_t);
    return 0.5 * (s * s + p * p);
}

// Eqs. 8 to 12: the exact law for conductors. The second quotient is multiplied by cos^2, so that 90 degrees is a number.
fn conductor(cos_theta: f32, n: vec3<f32>, k: vec3<f32>) -> vec3<f32> {
    let c2 = cos_theta * cos_theta;
    let s2 = 1.0 - c2;
    let t = n * n - k * k - s2;
    let root = sqrt(t * t + 4.0 * n * n * k * k);
    let a = sqrt(0.5 * (root + t));
    let s = (root - 2.0 * a * cos_theta + c2) / (root + 2.0 * a * cos_theta + c2);
    let p = s * (root * c2 - 2.0 * a * s2 * cos_theta + s2 * s2) / (root * c2 + 2.0 * a * s2 * cos_theta + s2 * s2);
    return 0.5 * (s + p);
}

fn pow5(x: f32) -> f32 {
    return x * x * x * x * x;
}

// Eq. 13.
fn schlick(cos_theta: f32, f0: vec3<f32>) -> vec3<f32> {
    return f0 + (1.0 - f0) * pow5(1.0 - cos_theta);
}

// Eq. 14.
fn rescaled(cos_theta: f32, n: vec3<f32>, k: vec3<f32>) -> vec3<f32> {
    let k2 = k * k;
    return ((n - 1.0) * (n - 1.0) + 4.0 * n * pow5(1.0 - cos_theta) + k2) / ((n + 1.0) * (n + 1.0) + k2);
}

// Eq. 15, with the factor that the print lost.
fn corrected(cos_theta: f32, n: vec3<f32>, k: vec3<f32>, lambda: vec3<f32>) -> vec3<f32> {
    let dip = 2.0 * n * cos_theta * pow(vec3<f32>(1.0 - cos_theta), lambda);
    return rescaled(cos_theta, n, k) - select(vec3<f32>(), dip, lambda > vec3<f32>());
}
