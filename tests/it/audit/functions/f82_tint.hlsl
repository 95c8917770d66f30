// Kutz, Hasan and Edmondson, "Novel aspects of the Adobe Standard Material", 2021.
#define real float
#define real3 float3

real3 f82_tint_folded(real3 F0, real3 edgeTint, real VoH)
{
    real x = saturate(1.0 - VoH);
    real x2 = x * x;
    real x5 = x2 * x2 * x;
    real3 b = (49.0 / 46656.0) * (1.0 - edgeTint) * (7776.0 + 9031.0 * F0);
    return saturate(F0 + x5 * ((1.0 - F0) - b * (VoH * x)));
}
