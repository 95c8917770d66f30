// F, its mean and the split-sum tables of fresnel.js in f64.

import { tableSize, tableTexture } from "./three/fresnel.js";

export const f32 = Math.fround;

const horner = {
  fitted: c => { const b = 2 ** (-6.5 * c); return [b, b, b]; },
  fitted_dielectric: c => [(1 - c) ** 3, (1 - c) ** 4, (1 - c) ** 7],
  fitted_film: c => { const g = Math.log2(c + 0.09), u = g + 1.58; return [g * g - 0.75, u, u, c, c]; },
};
function sum({ method, coefficients }, cos, channel) {
  const c = coefficients.map(one => f32(one[channel])), factors = horner[method.name](cos);
  return factors.reduceRight((rest, factor, i) => c[i] + factor * rest, c[factors.length]);
}
export const reflectance = (row, cos, channel) => Math.min(1, Math.max(0, sum(row, cos, channel)));

// A surface that reflects everything, with the coefficients of a method.
export const white = method => ({ method, coefficients: Array.from({ length: method.count }, (_, i) => Array(3).fill(i ? 0 : 1)) });

// 2 times the integral of F c dc, by Simpson's rule over the square root of c, along which F is smooth.
const STEPS = 500, means = new WeakMap();
function integral(row, channel) {
  let all = 0;
  for (let i = 0; i <= STEPS; i++) {
    const x = i / STEPS, weight = i % STEPS === 0 ? 1 : i % 2 ? 4 : 2;
    all += weight * 4 * x ** 3 * sum(row, x * x, channel);
  }
  return all / STEPS / 3;
}
function mean(row, channel) {
  if (!means.has(row)) means.set(row, [0, 1, 2].map(k => integral(row, k)));
  return means.get(row)[channel];
}

const half = h => (h & 0x7c00 ? 2 ** ((h >> 10 & 31) - 15) * (1 + (h & 1023) / 1024) : 2 ** -24 * (h & 1023)) * (h >> 15 ? -1 : 1);
// The channels of a method's tables, between the texels.
export function terms(method, cos, roughness) {
  const { data, height } = tableTexture(method).image, last = tableSize - 1;
  const x = cos ** 0.25 * last, y = roughness ** 0.5 * last;
  const i = Math.min(last - 1, Math.floor(x)), j = Math.min(last - 1, Math.floor(y));
  const mix = (a, b, t) => a + (b - a) * t, channels = [];
  for (let first = 0; first < height; first += tableSize) for (let k = 0; k < 4; k++) {
    const at = (a, b) => half(data[4 * ((first + j + b) * tableSize + i + a) + k]);
    channels.push(mix(mix(at(0, 0), at(1, 0), x - i), mix(at(0, 1), at(1, 1), x - i), y - j));
  }
  return channels;
}

// What an image is multiplied by once, and the series of bounces: lost is what the mean albedo of white lacks.
export function once({ method, coefficients }, cos, roughness, channel) {
  const { numbers } = method, own = coefficients.map(c => c[channel]);
  const all = numbers?.map(row => row.reduce((sum, factor, i) => sum + factor * own[i], 0)) ?? own;
  const t = terms(method, cos, roughness);
  return Math.min(t[0], Math.max(0, all.reduce((sum, one, i) => sum + one * t[i], 0)));
}
export function compensation(row, cos, roughness, channel) {
  const m = mean(row, channel), lost = roughness ** 3 * (0.20275 + roughness * (3.50269 + roughness * (-4.97845 + roughness * 1.8645)));
  return 1 + (1 - terms(row.method, cos, roughness)[0]) * m * m * (1 - lost) / (1 - m * lost) / once(row, cos, roughness, channel);
}
