// Eq. (7) of the thesis as it is printed, its fifth power by `pow`.
highp vec3 printed(highp float c, highp vec3 eta) {
    highp vec3 f0 = (eta - 1.0) / (eta + 1.0);
    f0 *= f0;
    return f0 + (1.0 - f0) * pow(1.0 - c, 5.0);
}
