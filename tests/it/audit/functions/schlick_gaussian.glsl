#version 300 es
// Lagarde, "Spherical Gaussian approximation for Blinn-Phong, Phong and Fresnel", 2012: the weight is a power of two.
precision highp float;

vec3 schlick_gaussian(const in vec3 specularColor, const in float dotLH) {
    float weight = exp2((-5.55473 * dotLH - 6.98316) * dotLH);
    return specularColor * (1.0 - weight) + weight;
}
