// The formulas of the thesis, written by hand as its text has them.

// Eqs. 1 to 3: the exact law for dielectrics.
float3 dielectric(float cosTheta, float3 eta)
{
    float3 cosT = sqrt(1.0 - (1.0 - cosTheta * cosTheta) / (eta * eta));
    float3 s = (cosTheta - eta * cosT) / (cosTheta + eta * cosT);
    float3 p = (eta * cosTheta - cosT) / (eta * cosTheta + cosT);
    return 0.5 * (s * s + p * p);
}

// Eqs. 8 to 12: the exact law for conductors. The second quotient is multiplied by cos^2, so that 90 degrees is a number.
float3 conductor(float cosTheta, float3 n, float3 k)
{
    float c2 = cosTheta * cosTheta;
    float s2 = 1.0 - c2;
    float3 t = n * n - k * k - s2;
    float3 root = sqrt(t * t + 4.0 * n * n * k * k);
    float3 a = sqrt(0.5 * (root + t));
    float3 s = (root - 2.0 * a * cosTheta + c2) / (root + 2.0 * a * cosTheta + c2);
    float3 p = s * (root * c2 - 2.0 * a * s2 * cosTheta + s2 * s2) / (root * c2 + 2.0 * a * s2 * cosTheta + s2 * s2);
    return 0.5 * (s + p);
}

float pow5(float x)
{
    return x * x * x * x * x;
}

// Eq. 13.
float3 schlick(float cosTheta, float3 f0)
{
    return f0 + (1.0 - f0) * pow5(1.0 - cosTheta);
}

// Eq. 14.
float3 rescaled(float cosTheta, float3 n, float3 k)
{
    float3 k2 = k * k;
    return ((n - 1.0) * (n - 1.0) + 4.0 * n * pow5(1.0 - cosTheta) + k2) / ((n + 1.0) * (n + 1.0) + k2);
}

// Eq. 15, with the factor that the print lost.
float3 corrected(float cosTheta, float3 n, float3 k, float3 lambda)
{
    float3 dip = 2.0 * n * cosTheta * pow((1.0 - cosTheta).xxx, lambda);
    return rescaled(cosTheta, n, k) - dip * step(1e-6, lambda);
}
