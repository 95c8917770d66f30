#version 300 es
// Born and Wolf, "Principles of Optics", section 14.2: the exact law of a real index and an extinction.
precision highp float;

vec3 conductor(float cosTheta, vec3 n, vec3 k) {
    float c2 = cosTheta * cosTheta;
    float s2 = 1.0 - c2;
    vec3 t0 = n * n - k * k - s2;
    vec3 a2b2 = sqrt(t0 * t0 + 4.0 * n * n * k * k);
    vec3 t1 = a2b2 + c2;
    vec3 a = sqrt(max(0.5 * (a2b2 + t0), 0.0));
    vec3 t2 = 2.0 * a * cosTheta;
    vec3 rs = (t1 - t2) / (t1 + t2);
    vec3 t3 = c2 * a2b2 + s2 * s2;
    vec3 t4 = t2 * s2;
    vec3 rp = rs * (t3 - t4) / (t3 + t4);
    return 0.5 * (rp + rs);
}
