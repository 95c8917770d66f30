#pragma multi_compile_fog
#define TEMPLATE(name) float name##_value(float x) { return x; }
cbuffer Camera : register(b0) { float4x4 view; float3 eye; };
Texture2D albedo : register(t0);
SamplerState linearSampler : register(s0);
struct Input { float4 position : SV_Position; float3 normal : NORMAL; float2 uv : TEXCOORD0; };

static const float3 WHITE = float3(1.0, 1.0, 1.0);
float3 fresnel(float NdotV, float3 F0);
float pow5(float x) { float x2 = x * x; return x2 * x2 * x; }
float3 fresnel(float NdotV, float3 F0) { return F0 + (WHITE - F0) * pow5(1.0 - saturate(NdotV)); }

[earlydepthstencil]
float4 main(Input i) : SV_Target
{
    float3 base = albedo.Sample(linearSampler, i.uv).rgb;
    clip(base.r - 0.1);
    float wide = fwidth(i.normal.x) + ddx(i.uv.x);
    return float4(fresnel(dot(i.normal, eye), base) + wide, 1.0);
}
