// KHR_materials_iridescence, as its text states it: Belcour and Barla 2017 with Schlick's approximation of both faces.
const mat3 XYZ_TO_REC709 = mat3(
     3.2404542, -0.9692660,  0.0556434,
    -1.5371385,  1.8760108, -0.2040259,
    -0.4985314,  0.0415560,  1.0572252);

vec3 fresnel0_to_ior(vec3 fresnel0) {
    vec3 root = sqrt(fresnel0);
    return (vec3(1.0) + root) / (vec3(1.0) - root);
}

vec3 ior_to_fresnel0(vec3 transmitted, float incident) {
    vec3 ratio = (transmitted - vec3(incident)) / (transmitted + vec3(incident));
    return ratio * ratio;
}

float schlick(float f0, float cosine) {
    return f0 + (1.0 - f0) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0);
}

vec3 schlick3(vec3 f0, float cosine) {
    return f0 + (vec3(1.0) - f0) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0);
}

vec3 sensitivity(float opd, vec3 shift) {
    float phase = 2.0 * 3.14159265 * opd * 1.0e-9;
    vec3 value = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13);
    vec3 position = vec3(1.6810e+06, 1.7953e+06, 2.2084e+06);
    vec3 variance = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);
    vec3 xyz = value * sqrt(2.0 * 3.14159265 * variance) * cos(position * phase + shift) * exp(-phase * phase * variance);
    xyz.x += 9.7470e-14 * sqrt(2.0 * 3.14159265 * 4.5282e+09) * cos(2.2399e+06 * phase + shift.x) * exp(-4.5282e+09 * phase * phase);
    xyz /= 1.0685e-7;
    return XYZ_TO_REC709 * xyz;
}

vec3 iridescence(float cosTheta1, float thickness, float eta2, vec3 baseF0) {
    float filmIor = mix(1.0, eta2, smoothstep(0.0, 0.03, thickness));
    float sinTheta2Sq = (1.0 / filmIor) * (1.0 / filmIor) * (1.0 - cosTheta1 * cosTheta1);
    float cosTheta2Sq = 1.0 - sinTheta2Sq;
    if (cosTheta2Sq < 0.0) return vec3(1.0);
    float cosTheta2 = sqrt(cosTheta2Sq);
    float root = (filmIor - 1.0) / (filmIor + 1.0);
    float r12 = schlick(root * root, cosTheta1);
    float t121 = 1.0 - r12;
    float phi12 = filmIor < 1.0 ? 3.14159265 : 0.0;
    float phi21 = 3.14159265 - phi12;
    vec3 baseIor = fresnel0_to_ior(clamp(baseF0, 0.0, 0.9999));
    vec3 r1 = ior_to_fresnel0(baseIor, filmIor);
    vec3 r23 = schlick3(r1, cosTheta2);
    vec3 phi23 = vec3(
        baseIor.x < filmIor ? 3.14159265 : 0.0,
        baseIor.y < filmIor ? 3.14159265 : 0.0,
        baseIor.z < filmIor ? 3.14159265 : 0.0);
    float opd = 2.0 * filmIor * thickness * cosTheta2;
    vec3 phi = vec3(phi21) + phi23;
    vec3 r123 = clamp(r12 * r23, 1e-5, 0.9999);
    vec3 r123root = sqrt(r123);
    vec3 rs = t121 * t121 * r23 / (vec3(1.0) - r123);
    vec3 sum = vec3(r12) + rs;
    vec3 cm = rs - vec3(t121);
    for (int m = 1; m <= 2; ++m) {
        cm *= r123root;
        sum += cm * 2.0 * sensitivity(float(m) * opd, float(m) * phi);
    }
    return max(sum, vec3(0.0));
}
