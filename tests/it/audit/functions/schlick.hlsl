// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, eq. 15, in the forms that engines write it in.
#ifdef MOBILE
#define real half
#define real3 half3
#else
#define real float
#define real3 float3
#endif

// What f0 leaves, beside the weight.
real3 schlick(real3 SpecularColor, real VoH)
{
    real x = saturate(1.0 - VoH);
    real x2 = x * x;
    real weight = x2 * x2 * x;
    return weight + (1.0 - weight) * SpecularColor;
}

// With a reflectance at 90 degrees.
real3 schlick_f90(real3 f0, real f90, real u)
{
    real x = 1.0 - u;
    real x2 = x * x;
    return f0 * (1.0 - x2 * x2 * x) + f90 * (x2 * x2 * x);
}

// One channel.
real schlick_scalar(real f0, real u)
{
    real x = 1.0 - u;
    real x2 = x * x;
    return f0 + (1.0 - f0) * (x2 * x2 * x);
}
