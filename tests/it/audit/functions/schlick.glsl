#version 300 es
// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, eq. 15, in the forms that engines write it in.
precision highp float;

// x^2 x^2 x.
vec3 schlick(float VoH, vec3 f0) {
    float x = 1.0 - VoH;
    float x2 = x * x;
    return f0 + (vec3(1.0) - f0) * (x2 * x2 * x);
}

// A power.
vec3 schlick_power(vec3 specularColor, float LdotH) {
    return specularColor + (1.0 - specularColor) * pow(clamp(1.0 - LdotH, 0.0, 1.0), 5.0);
}

// A mix, with a reflectance at 90 degrees.
vec3 schlick_f90(const in vec3 f0, const in float f90, const in float dotVH) {
    float m = clamp(1.0 - dotVH, 0.0, 1.0);
    float m2 = m * m;
    return mix(f0, vec3(f90), m2 * m2 * m);
}

// One channel.
float schlick_scalar(float u, float reflectance0) {
    float x = 1.0 - u;
    float x2 = x * x;
    return reflectance0 + (1.0 - reflectance0) * x2 * x2 * x;
}
