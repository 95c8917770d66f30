#version 330 core
#extension GL_ARB_shading_language_420pack : enable
in vec3 vNormal;
in vec3 vView;
in vec2 vUv;
uniform sampler2D albedoMap;
uniform samplerCube environment;
uniform mat4 viewMatrix;
layout(location = 0) out vec4 fragColor;

const float PI = 3.14159265;
#define saturate(x) clamp(x, 0.0, 1.0)
#define SATURATE_DOT(a, b) \
    saturate(dot(a, b))
float pow5(float x) { float x2 = x * x; return x2 * x2 * x; }

struct Surface { vec3 f0; float roughness; };

vec3 fresnel(float cosTheta, vec3 f0) {
    return f0 + (vec3(1.0) - f0) * pow5(1.0 - saturate(cosTheta));
}

float edge(vec3 n) {
    return fwidth(n.x) + dFdx(vUv.x);
}

void main() {
    Surface s = Surface(texture(albedoMap, vUv).rgb, 0.5);
    if (s.f0.r < 0.1) discard;
    vec3 n = normalize(vNormal);
    vec3 light = textureLod(environment, reflect(-vView, n), 3.0).rgb;
    fragColor = vec4(light * fresnel(SATURATE_DOT(n, vView), s.f0) + edge(n), gl_FragCoord.w);
}
