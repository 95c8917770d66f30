#version 300 es
// Walter, Marschner, Li and Torrance, "Microfacet Models for Refraction through Rough Surfaces", 2007, eq. 22: the exact law by
// g^2 = eta^2 - 1 + c^2.
precision highp float;

// Total reflection by a branch.
float dielectric_branch(float cosTheta, float ior) {
    float c = cosTheta;
    float g2 = ior * ior + c * c - 1.0;
    if (g2 < 0.0) {
        return 1.0;
    }
    float g = sqrt(g2);
    float a = (g - c) / (g + c);
    float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Total reflection by a choice.
float dielectric_choice(float ior, float u) {
    float g2 = ior * ior - 1.0 + u * u;
    float g = sqrt(max(g2, 0.0));
    float a = (g - u) / (g + u);
    float b = ((g + u) * u - 1.0) / ((g - u) * u + 1.0);
    float r = 0.5 * a * a * (1.0 + b * b);
    return g2 < 0.0 ? 1.0 : r;
}

// Three channels.
vec3 dielectric_rgb(float cosTheta, vec3 ior) {
    vec3 g = sqrt(max(ior * ior - 1.0 + cosTheta * cosTheta, 0.0));
    vec3 a = (g - cosTheta) / (g + cosTheta);
    vec3 b = ((g + cosTheta) * cosTheta - 1.0) / ((g - cosTheta) * cosTheta + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// An index n_i / n_t under the name that is usual for n_t / n_i.
float dielectric_inverse(float eta, float cosTheta) {
    return dielectric_choice(1.0 / eta, cosTheta);
}
