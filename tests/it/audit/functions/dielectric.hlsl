// Walter, Marschner, Li and Torrance, "Microfacet Models for Refraction through Rough Surfaces", 2007, eq. 22.
#define real float

real dielectric(real ior, real u)
{
    real g = sqrt(max(ior * ior - 1.0 + u * u, 0.0));
    real a = (g - u) / (g + u);
    real b = ((g + u) * u - 1.0) / ((g - u) * u + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}
