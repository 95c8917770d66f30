// Born and Wolf, "Principles of Optics", section 14.2: the exact law of a real index and an extinction.
#define real float
#define real3 float3

real3 conductor(real3 eta, real3 k, real cosTheta)
{
    real c2 = cosTheta * cosTheta;
    real s2 = 1.0 - c2;
    real3 eta2 = eta * eta;
    real3 k2 = k * k;
    real3 t0 = eta2 - k2 - s2;
    real3 a2b2 = sqrt(t0 * t0 + 4.0 * eta2 * k2);
    real3 t1 = a2b2 + c2;
    real3 t2 = 2.0 * cosTheta * sqrt(0.5 * (a2b2 + t0));
    real3 rs = (t1 - t2) / (t1 + t2);
    real3 t3 = c2 * a2b2 + s2 * s2;
    real3 t4 = t2 * s2;
    return 0.5 * (rs + rs * (t3 - t4) / (t3 + t4));
}

// The square of the extinction is given.
real3 conductor_squared(real3 eta, real3 etak2, real cosTheta)
{
    return conductor(eta, sqrt(etak2), cosTheta);
}
