#version 300 es
// Colours that artists set, on two curves.
precision highp float;

float dielectric(float c, float ior) {
    float g2 = ior * ior - 1.0 + c * c;
    float g = sqrt(max(g2, 0.0));
    float a = (g - c) / (g + c);
    float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    float r = 0.5 * a * a * (1.0 + b * b);
    return g2 > 0.0 ? r : 1.0;
}

// The exact law between two colours, as in Cycles: closure/bsdf_microfacet.h, microfacet_fresnel, a negative exponent.
vec3 dielectric_rescaled(float cosTheta, float ior, vec3 f0, vec3 f90_colour) {
    float root = (ior - 1.0) / (ior + 1.0);
    float r0 = root * root;
    float s = clamp((dielectric(cosTheta, ior) - r0) / (1.0 - r0), 0.0, 1.0);
    return mix(f0, f90_colour, s);
}

// Schlick's curve with a tint at 81.79 degrees, as in MaterialX: mx_microfacet_specular.glsl, mx_fresnel_hoffman_schlick.
vec3 hoffman_schlick(float cosTheta, vec3 f0, vec3 tint, vec3 f90_colour, float exponent) {
    const float COS_THETA_MAX = 1.0 / 7.0;
    const float COS_THETA_FACTOR = 1.0 / (COS_THETA_MAX * pow(1.0 - COS_THETA_MAX, 6.0));
    float x = clamp(cosTheta, 0.0, 1.0);
    vec3 a = mix(f0, f90_colour, pow(1.0 - COS_THETA_MAX, exponent)) * (vec3(1.0) - tint) * COS_THETA_FACTOR;
    return max(mix(f0, f90_colour, pow(1.0 - x, exponent)) - a * x * pow(1.0 - x, 6.0), vec3(0.0));
}
