// Eq. (14) of the thesis as it is printed, its fifth power by `pow`.
highp vec3 printed(highp float c, highp vec3 n, highp vec3 k) {
    return ((n - 1.0) * (n - 1.0) + 4.0 * n * pow(1.0 - c, 5.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
}
