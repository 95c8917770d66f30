#version 300 es
// Kutz, Hasan and Edmondson, "Novel aspects of the Adobe Standard Material", 2021, in the forms that renderers write it in.
precision highp float;

float power5(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

// All constants in one line: b = (49 / 46656) (1 - tint) (7776 + 9031 f0).
vec3 f82_tint_folded(vec3 f0, vec3 tint, float VoH) {
    float x = 1.0 - VoH;
    float x5 = power5(x);
    vec3 b = (49.0 / 46656.0) * (1.0 - tint) * (7776.0 + 9031.0 * f0);
    return clamp(f0 + x5 * ((1.0 - f0) - b * (VoH * x)), 0.0, 1.0);
}

// By Schlick's value at 1/7.
vec3 f82_tint_by_schlick(float cos_theta, vec3 f0, vec3 f82_tint) {
    float x = clamp(1.0 - cos_theta, 0.0, 1.0);
    float x5 = power5(x);
    vec3 schlick82 = mix(f0, vec3(1.0), power5(6.0 / 7.0));
    vec3 b = schlick82 * (1.0 - f82_tint) * (7.0 / (power5(6.0 / 7.0) * (6.0 / 7.0)));
    return clamp(mix(f0, vec3(1.0), x5) - b * clamp(cos_theta, 0.0, 1.0) * x5 * x, 0.0, 1.0);
}

// Hoffman, "Fresnel Equations Considered Harmful", 2019: the colour itself at 82 degrees.
vec3 f82_colour(float cos_theta, vec3 color0, vec3 color82) {
    float x = clamp(1.0 - cos_theta, 0.0, 1.0);
    float x5 = power5(x);
    vec3 b = (mix(color0, vec3(1.0), power5(6.0 / 7.0)) - color82) * (7.0 / (power5(6.0 / 7.0) * (6.0 / 7.0)));
    return clamp(mix(color0, vec3(1.0), x5) - b * clamp(cos_theta, 0.0, 1.0) * x5 * x, 0.0, 1.0);
}

// The tint under the name of the colour.
vec3 f82_tint_named_f82(vec3 F0, vec3 F82, float VoH) {
    return f82_tint_folded(F0, F82, VoH);
}
