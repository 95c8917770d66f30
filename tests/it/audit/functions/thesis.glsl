#version 300 es
// The formulas of the thesis, written by hand as its text has them.
precision highp float;

// Eqs. 1 to 3: the exact law for dielectrics, a channel at a time.
float dielectric(float cosTheta, float eta) {
    float cosT = sqrt(1.0 - (1.0 - cosTheta * cosTheta) / (eta * eta));
    float s = (cosTheta - eta * cosT) / (cosTheta + eta * cosT);
    float p = (eta * cosTheta - cosT) / (eta * cosTheta + cosT);
    return 0.5 * (s * s + p * p);
}

// Eqs. 8 to 12: the exact law for conductors. The second quotient is multiplied by cos^2, so that 90 degrees is a number.
vec3 conductor(float cosTheta, vec3 n, vec3 k) {
    float c2 = cosTheta * cosTheta;
    float s2 = 1.0 - c2;
    vec3 t = n * n - k * k - s2;
    vec3 root = sqrt(t * t + 4.0 * n * n * k * k);
    vec3 a = sqrt(0.5 * (root + t));
    vec3 s = (root - 2.0 * a * cosTheta + c2) / (root + 2.0 * a * cosTheta + c2);
    vec3 p = s * (root * c2 - 2.0 * a * s2 * cosTheta + s2 * s2) / (root * c2 + 2.0 * a * s2 * cosTheta + s2 * s2);
    return 0.5 * (s + p);
}

float pow5(float x) {
    return x * x * x * x * x;
}

// Eq. 13.
vec3 schlick(float cosTheta, vec3 f0) {
    return f0 + (1.0 - f0) * pow5(1.0 - cosTheta);
}

// Eq. 14.
vec3 rescaled(float cosTheta, vec3 n, vec3 k) {
    vec3 k2 = k * k;
    return ((n - 1.0) * (n - 1.0) + 4.0 * n * pow5(1.0 - cosTheta) + k2) / ((n + 1.0) * (n + 1.0) + k2);
}

// Eq. 15, with the factor that the print lost.
vec3 corrected(float cosTheta, vec3 n, vec3 k, vec3 lambda) {
    vec3 dip = 2.0 * n * cosTheta * pow(vec3(1.0 - cosTheta), lambda);
    return rescaled(cosTheta, n, k) - mix(vec3(0.0), dip, vec3(greaterThan(lambda, vec3(0.0))));
}

// A user's shader has an entry point, too.
out vec3 reflectance;
void main() {
    reflectance = schlick(0.5, vec3(0.04));
    gl_Position = vec4(0.0);
}
