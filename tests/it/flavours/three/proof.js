// What three.js draws in WebGL 2 with patched materials, in figures. Pictures are not looked at: each pixel is a cell with a normal and
// a direction of the light of its own, drawn into a float target.

import * as THREE from "three";
import { RectAreaLightUniformsLib } from "three/addons/lights/RectAreaLightUniformsLib.js";
import { materials, methods, patch, patchWith, tableSize } from "./three/fresnel.js";
import { compensation, reflectance, white } from "./expected.js";

const renderer = new THREE.WebGLRenderer();
const shaderFaults = [];
renderer.debug.onShaderError = (gl, program, vertex, fragment) =>
  shaderFaults.push(gl.getShaderInfoLog(vertex) + gl.getShaderInfoLog(fragment) + gl.getProgramInfoLog(program));

// Cells in a row of quads. A cell is { normal, light }: directions; the eye looks along -z.
function cells(list, width) {
  const height = Math.ceil(list.length / width), position = [], normal = [], cell = [], index = [];
  list.forEach((one, i) => {
    const x = i % width, y = Math.floor(i / width);
    for (const [a, b] of [[0, 0], [1, 0], [1, 1], [0, 1]]) {
      position.push(-one.light[0], -one.light[1], -one.light[2]);
      normal.push(...one.normal);
      cell.push(2 * (x + a) / width - 1, 2 * (y + b) / height - 1);
    }
    index.push(...[0, 1, 2, 0, 2, 3].map(k => 4 * i + k));
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normal, 3));
  geometry.setAttribute("cell", new THREE.Float32BufferAttribute(cell, 2));
  geometry.setIndex(index);
  return { geometry, width, height, count: list.length };
}

// A hook of one's own, which patches must keep: it places the cells on the screen.
const placed = material => {
  material.onBeforeCompile = shader => {
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", "attribute vec2 cell;\nvoid main() {")
      .replace("#include <project_vertex>", "#include <project_vertex>\ngl_Position = vec4( cell, 0.0, 1.0 );");
  };
  return material;
};

const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
const lit = new THREE.Scene(), image = new THREE.Scene(), area = new THREE.Scene();
lit.add(Object.assign(new THREE.PointLight(0xffffff, 1, 0, 0)));
const rectangle = new THREE.RectAreaLight(0xffffff, 1, 3, 2);
rectangle.position.set(0.4, 0.3, 2);
RectAreaLightUniformsLib.init();
area.add(rectangle);

function drawn(scene, material, grid) {
  const target = new THREE.WebGLRenderTarget(grid.width, grid.height, { type: THREE.FloatType, depthBuffer: false });
  const mesh = new THREE.Mesh(grid.geometry, material);
  mesh.frustumCulled = false;
  scene.add(mesh);
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(scene, camera);
  const pixels = new Float32Array(4 * grid.width * grid.height);
  renderer.readRenderTargetPixels(target, 0, 0, grid.width, grid.height, pixels);
  renderer.setRenderTarget(null);
  scene.remove(mesh);
  target.dispose();
  return (i, channel) => pixels[4 * i + channel];
}

const standard = (row, parameters = {}) => patchWith(placed(new THREE.MeshStandardMaterial({ color: 0, ...parameters })), row);
const unit = v => { const l = Math.hypot(...v); return v.map(x => x / l); };
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const V = [0, 0, 1];
const mirrored = h => { const d = 2 * dot(V, h); return h.map((x, i) => d * x - V[i]); };

// 1. F of lamps: a material divided by one that reflects everything.
function lamps() {
  const list = [];
  for (let i = 0; i < 64; i++) for (const tilt of [-0.1, 0, 0.1]) {
    const cos = 0.2 + 0.8 * i / 63, angle = Math.acos(cos);
    const light = mirrored([Math.sin(angle), 0, cos]);
    const normal = [Math.sin(angle - tilt), 0, Math.cos(angle - tilt)];
    if (dot(normal, light) > 0.02 && normal[2] > 0.02) list.push({ cos, light, normal });
  }
  const grid = cells(list, 16), worst = {}, seen = {};
  for (const name of Object.keys(materials)) {
    const row = materials[name], whole = white(row.method), ours = standard(row), all = standard(whole);
    let most = 0;
    for (const roughness of [0.1, 0.3, 0.6, 1]) {
      ours.roughness = all.roughness = roughness;
      const [a, b] = [drawn(lit, ours, grid), drawn(lit, all, grid)];
      list.forEach(({ cos, normal }, i) => {
        for (let channel = 0; channel < 3; channel++) {
          const k = compensation(whole, normal[2], roughness, channel) / compensation(row, normal[2], roughness, channel);
          const f = a(i, channel) / b(i, channel) * k;
          most = Math.max(most, Math.abs(f - reflectance(row, cos, channel)));
          if (row.method.name === "fitted_film") (seen[name] ??= []).push([cos, channel, f]);
        }
      });
    }
    worst[name] = most;
  }
  return { cells: list.length, worst, seen };
}

// 3. Surfaces in light that is 1 from everywhere.
const ROUGHNESS = [0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1];
const COSINES = [0.05, 0.1, 0.2, 0.5, 0.8, 1];
const normalAt = mu => [Math.sqrt(1 - mu * mu), 0, mu];

// Directions of light for an eye at cosine mu, in the frame of the eye, with what a pixel is divided by. Visible normals: Heitz,
// "Sampling the GGX distribution of visible normals", 2018, http://jcgt.org/published/0007/04/01/
function visible(mu, roughness, side) {
  const alpha = roughness ** 2, n = normalAt(mu), t = [mu, 0, -n[0]], b = [0, 1, 0]; // the eye is mu n - n[0] t
  const eye = [-n[0], 0, mu], wide = unit([alpha * eye[0], 0, eye[2]]);
  const l = Math.hypot(wide[0], wide[1]), t1 = l > 0 ? [-wide[1] / l, wide[0] / l, 0] : [1, 0, 0];
  const t2 = [wide[1] * t1[2] - wide[2] * t1[1], wide[2] * t1[0] - wide[0] * t1[2], wide[0] * t1[1] - wide[1] * t1[0]];
  const masked = 2 * mu / (mu + Math.sqrt(alpha ** 2 + (1 - alpha ** 2) * mu * mu)), list = [];
  for (let i = 0; i < side * side; i++) {
    const r = Math.sqrt((i + 0.5) / side / side), phi = 2 * Math.PI * (i * 0.6180339887498949 % 1), s = 0.5 * (1 + wide[2]);
    const p1 = r * Math.cos(phi), p2 = (1 - s) * Math.sqrt(1 - p1 * p1) + s * r * Math.sin(phi);
    const p3 = Math.sqrt(Math.max(0, 1 - p1 * p1 - p2 * p2));
    const h = [0, 1, 2].map(k => p1 * t1[k] + p2 * t2[k] + p3 * wide[k]);
    const micro = unit([alpha * h[0], alpha * h[1], Math.max(0, h[2])]);
    const world = [0, 1, 2].map(k => micro[0] * t[k] + micro[1] * b[k] + micro[2] * n[k]);
    const light = mirrored(world), d = alpha ** 2 / Math.PI / (micro[2] ** 2 * (alpha ** 2 - 1) + 1) ** 2;
    list.push({ normal: n, light, density: masked * d / (4 * mu), isUp: dot(n, light) > 0 });
  }
  return list;
}
function diffuse(mu, side) {
  const n = normalAt(mu), t = [mu, 0, -n[0]], list = [];
  for (let i = 0; i < side; i++) for (let j = 0; j < side; j++) {
    const z = Math.sqrt((i + 0.5) / side), s = Math.sqrt(1 - z * z), phi = 2 * Math.PI * (j + 0.5) / side;
    const light = [0, 1, 2].map(k => s * Math.cos(phi) * t[k] + s * Math.sin(phi) * [0, 1, 0][k] + z * n[k]);
    list.push({ normal: n, light, density: z / Math.PI, isUp: true });
  }
  return list;
}
const total = (list, pixel, channel) => list.reduce((sum, one, i) => sum + (one.isUp ? pixel(i, channel) / one.density : 0), 0) / list.length;

function furnace() {
  const whiteScene = new THREE.Scene();
  whiteScene.background = new THREE.Color(1, 1, 1);
  image.environment = new THREE.PMREMGenerator(renderer).fromScene(whiteScene).texture;
  const plain = parameters => placed(new THREE.MeshStandardMaterial(parameters));
  const rows = {
    white: [standard(white(methods.fitted))], white_dielectric: [standard(white(methods.fitted_dielectric))],
    gold: [standard(materials.gold)], silver: [standard(materials.silver)], water: [standard(materials.water)], diamond: [standard(materials.diamond)],
    white_film: [standard(white(methods.fitted_film))], titanium: [standard(materials.anodised_titanium_purple, { color: 0xffffff })],
    oil_on_white: [standard(materials.oil_on_water, { color: 0xffffff }), standard(materials.oil_on_water)],
    water_on_white: [standard(materials.water, { color: 0xffffff }), standard(materials.water)],
    three_white: [plain({ metalness: 1 })], three_dielectric_on_white: [plain(), plain({ color: 0 })],
  };
  const told = Object.fromEntries(Object.keys(rows).map(name => [name, { image: [9, 0], lamps: [9, 0], apart: {} }]));
  const seen = cells(COSINES.map(mu => ({ normal: normalAt(mu), light: V })), COSINES.length);
  for (const roughness of ROUGHNESS) {
    for (const materials of Object.values(rows)) for (const one of materials) one.roughness = roughness;
    const images = Object.fromEntries(Object.entries(rows).map(([name, [ours]]) => [name, drawn(image, ours, seen)]));
    COSINES.forEach((mu, place) => {
      const list = visible(mu, roughness, 48), grid = cells(list, 48), wide = diffuse(mu, 24), far = cells(wide, 24);
      for (const [name, [ours, black]] of Object.entries(rows)) {
        const pixels = drawn(lit, black ?? ours, grid), [a, b] = black ? [drawn(lit, ours, far), drawn(lit, black, far)] : [];
        const one = told[name];
        for (let channel = 0; channel < 3; channel++) {
          const below = black ? total(wide, (i, c) => a(i, c) - b(i, c), channel) : 0;
          const direct = total(list, pixels, channel) + below, indirect = images[name](place, channel);
          one.image = [Math.min(one.image[0], indirect), Math.max(one.image[1], indirect)];
          one.lamps = [Math.min(one.lamps[0], direct), Math.max(one.lamps[1], direct)];
          one.apart[roughness] = Math.max(one.apart[roughness] ?? 0, Math.abs(direct - indirect));
        }
      }
      grid.geometry.dispose();
      far.geometry.dispose();
    });
  }
  return told;
}

// Metals below a clear coat in light that is 1 from everywhere, three's own and ours: [cosine, channel, three, ours].
function coats() {
  const cosines = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1], seen = cells(cosines.map(mu => ({ normal: normalAt(mu), light: V })), cosines.length);
  const coated = parameters => placed(new THREE.MeshPhysicalMaterial({ roughness: 0.05, clearcoat: 1, ...parameters })), told = {};
  for (const name of ["copper", "gold", "platinum", "anodised_titanium_purple"]) {
    const stock = drawn(image, coated({ color: new THREE.Color(...materials[name].f0), metalness: 1 }), seen);
    const ours = drawn(image, patch(coated({}), name, { coat: 1.5 }), seen);
    told[name] = cosines.flatMap((mu, place) => [0, 1, 2].map(channel => [mu, channel, stock(place, channel), ours(place, channel)]));
  }
  return told;
}

// Rectangular lights: a material over white is what it is for an image.
function rectangles() {
  const list = COSINES.slice(2).map(mu => ({ normal: normalAt(mu), light: [0, 0, 0.5] })), grid = cells(list, list.length);
  const pairs = ["gold", "anodised_titanium_purple"].map(name => [standard(materials[name]), standard(white(materials[name].method))]);
  let most = 0;
  for (const [ours, all] of pairs) for (const roughness of [0.1, 0.4, 0.9]) {
    ours.roughness = all.roughness = roughness;
    const [a, b, c, d] = [drawn(area, ours, grid), drawn(area, all, grid), drawn(image, ours, grid), drawn(image, all, grid)];
    for (let i = 0; i < list.length; i++) for (let k = 0; k < 3; k++) {
      if (!(b(i, k) > 0)) continue;
      most = Math.max(most, Math.abs(a(i, k) / b(i, k) - c(i, k) / d(i, k)));
    }
  }
  return most;
}

// 4. Two spheres in one scene: one is patched, the other stays as it was, bit by bit.
function spheres() {
  const side = 128, scene = new THREE.Scene(), eye = new THREE.OrthographicCamera(-2, 2, 1, -1, 0.1, 20);
  eye.position.z = 6;
  scene.environment = image.environment;
  const gold = () => new THREE.MeshStandardMaterial({ color: new THREE.Color(...materials.gold.f0), metalness: 1, roughness: 0.2 });
  const left = new THREE.Mesh(new THREE.SphereGeometry(1, 128, 96), gold()), right = new THREE.Mesh(left.geometry, gold());
  left.position.x = -1;
  right.position.x = 1;
  const lamp = new THREE.DirectionalLight(0xffffff, 2);
  lamp.position.set(0, 1, -2); // behind the spheres: half vectors are grazing
  scene.add(left, right, lamp);
  const target = new THREE.WebGLRenderTarget(2 * side, side, { type: THREE.FloatType });
  const picture = () => {
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, eye);
    const pixels = new Float32Array(8 * side * side);
    renderer.readRenderTargetPixels(target, 0, 0, 2 * side, side, pixels);
    renderer.setRenderTarget(null);
    return pixels;
  };
  // Differences of pixels in the left half (sphere 0) or the right one, by the cosine at the sphere.
  const differences = (one, other, sphere) => {
    const told = { steep: 0, grazing: 0, relative: 0, changed: 0 };
    for (let y = 0; y < side; y++) for (let x = 0; x < side; x++) for (let k = 0; k < 4; k++) {
      const place = 4 * (y * 2 * side + x + sphere * side) + k, cos2 = 1 - (2 * (x + 0.5) / side - 1) ** 2 - (2 * (y + 0.5) / side - 1) ** 2;
      const difference = Math.abs(one[place] - other[place]);
      told.changed += !Object.is(one[place], other[place]);
      if (cos2 > 0.01) told.relative = Math.max(told.relative, difference / Math.max(1e-3, one[place]));
      if (cos2 > 0.01) told[cos2 < 0.16 ? "grazing" : "steep"] = Math.max(told[cos2 < 0.16 ? "grazing" : "steep"], difference);
    }
    return told;
  };
  const middle = pixels => pixels[4 * (side / 2 * 2 * side + side / 2) + 2];
  const before = picture();
  patch(left.material, "gold");
  const after = picture(), programs = renderer.info.programs.length;
  patch(patch(left.material, "gold"), "gold");
  const twice = picture();
  patch(right.material, "silver");
  picture();
  const more = renderer.info.programs.length - programs; // the unpatched program goes, and none comes
  patch(left.material, "silver");
  const silver = picture();
  patch(left.material, "water");
  const water = picture();
  patch(left.material, "gold");
  // A hook that is set later takes the place of ours, and a new patch runs it.
  const third = gold();
  const own = third.onBeforeCompile;
  patch(third, "silver");
  third.onBeforeCompile = shader => own.call(third, shader);
  right.material = third;
  const later = picture();
  right.material = gold();
  const plain = picture();
  right.material = patch(third, "gold");
  const again = picture();
  right.material = patch(gold(), "gold");
  const ours = picture();
  patch(right.material, "silver");
  return {
    hooked_later: differences(later, plain, 1).changed, hooked_and_patched: differences(again, ours, 1).changed,
    patched: differences(before, after, 0), unpatched: differences(before, after, 1).changed, twice: differences(after, twice, 0).changed,
    more_programs: more, blue_of_gold_silver_water: [after, silver, water].map(middle), back: differences(after, picture(), 0).changed,
  };
}

// Everything that MeshPhysicalMaterial has, compiled.
function features() {
  const all = {
    plain: {}, clearcoat: { clearcoat: 1 }, sheen: { sheen: 1, sheenColor: new THREE.Color(1, 0, 0) }, anisotropy: { anisotropy: 0.5 },
    transmission: { transmission: 1, thickness: 0.5 }, dispersion: { transmission: 1, dispersion: 2, thickness: 0.5 },
    retroreflection: { retroreflectivity: 0.5 }, diffuse_roughness: { diffuseRoughness: 0.5 }, flat: { flatShading: true, side: THREE.DoubleSide },
  };
  const eye = new THREE.PerspectiveCamera(40, 1, 0.1, 20), told = {};
  eye.position.z = 4;
  const known = new THREE.MeshPhysicalMaterial(), has = parameters => Object.keys(parameters).every(name => known[name] !== undefined);
  for (const [name, parameters] of Object.entries(all).filter(([, parameters]) => has(parameters))) for (const material of ["gold", "water", "oil_on_water"]) {
    const scene = new THREE.Scene();
    scene.environment = image.environment;
    scene.add(rectangle.clone(), new THREE.DirectionalLight(), new THREE.PointLight(), new THREE.SpotLight(), new THREE.HemisphereLight());
    const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 16, 12), patch(new THREE.MeshPhysicalMaterial({ roughness: 0.4, ...parameters }), material));
    scene.add(mesh);
    const target = new THREE.WebGLRenderTarget(16, 16, { type: THREE.FloatType });
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, eye);
    const pixel = new Float32Array(4);
    renderer.readRenderTargetPixels(target, 8, 8, 1, 1, pixel);
    renderer.setRenderTarget(null);
    told[`${material} ${name}`] = Array.from(pixel).every(Number.isFinite) && pixel[3] > 0 ? "drawn" : Array.from(pixel).join();
  }
  return told;
}

// A map of metalness: 1 is the metal as without a map, 0 is three's own paint, and between them is a mixture.
function painted() {
  const texel = value => {
    const map = new THREE.DataTexture(new Uint8Array([0, 0, value, 255]), 1, 1);
    map.needsUpdate = true;
    return map;
  };
  const list = [];
  for (let i = 0; i < 32; i++) for (const tilt of [-0.1, 0.1]) {
    const cos = 0.25 + 0.75 * i / 31, angle = Math.acos(cos), normal = [Math.sin(angle - tilt), 0, Math.cos(angle - tilt)];
    const light = mirrored([Math.sin(angle), 0, cos]);
    if (dot(normal, light) > 0.02 && normal[2] > 0.02) list.push({ light, normal });
  }
  const grid = cells(list, 16), given = { color: 0x906040, roughness: 0.4, metalness: 1 }, told = {};
  for (const [name, scene] of Object.entries({ lamps: lit, image, rectangle: area })) {
    const seen = value => drawn(scene, standard(materials.gold, { ...given, metalnessMap: texel(value) }), grid);
    const metal = drawn(scene, standard(materials.gold, given), grid), paint = drawn(scene, placed(new THREE.MeshStandardMaterial({ ...given, metalness: 0 })), grid);
    const [whole, none, part] = [255, 0, 102].map(seen), off = told[name] = { metal: 0, paint: 0, mixture: 0, apart: 0 };
    list.forEach((_, i) => {
      for (let k = 0; k < 3; k++) {
        const scale = Math.max(1, metal(i, k)), more = (what, error) => { off[what] = Math.max(off[what], Math.abs(error) / scale); };
        more("metal", whole(i, k) - metal(i, k));
        more("paint", none(i, k) - paint(i, k));
        more("mixture", part(i, k) - 0.4 * metal(i, k) - 0.6 * paint(i, k));
        more("apart", metal(i, k) - paint(i, k));
      }
    });
  }
  return told;
}

const refused = act => { try { act(); return null; } catch (fault) { return fault.message; } };
function refusals() {
  const told = {
    name: refused(() => patch(new THREE.MeshStandardMaterial(), "glod")),
    material: refused(() => patch(new THREE.MeshBasicMaterial(), "gold")),
    method: refused(() => patchWith(new THREE.MeshStandardMaterial(), { method: "fited", coefficients: [] })),
    coefficients: refused(() => patchWith(new THREE.MeshStandardMaterial(), { method: methods.fitted, coefficients: [[1, 1, 1]] })),
    coefficients_of_film: refused(() => patchWith(new THREE.MeshStandardMaterial(), { method: methods.fitted_film, coefficients: white(methods.fitted).coefficients })),
    coat_of_water: refused(() => patch(new THREE.MeshPhysicalMaterial(), "water", { coat: 1.5 })),
    coat_of_another_index: refused(() => patch(new THREE.MeshPhysicalMaterial(), "gold", { coat: 1.6 })),
    coat_of_a_standard_material: refused(() => patch(new THREE.MeshStandardMaterial(), "gold", { coat: 1.5 })),
    iridescence: refused(() => drawn(lit, patch(new THREE.MeshPhysicalMaterial({ iridescence: 1 }), "gold"), cells([{ normal: V, light: V }], 1))),
  };
  // A released version has no uses that are new.
  const { ShaderChunk } = THREE, isReleased = parseInt(THREE.REVISION) < 186;
  for (const [name, from, to] of [
    ["lights_physical_pars_fragment", "singleScatter += FssEss;", "singleScatter += vec3( 1.0 ) * FssEss;"],
    ["lights_fragment_begin", "1.0 / EssMs", "1.0 / Ess"],
    ["lights_physical_pars_fragment", "void RE_Direct_Physical", "vec3 more( vec3 f ) { return F_Schlick( f, 1.0, 0.5 ); }\nvoid RE_Direct_Physical"],
  ]) {
    const text = ShaderChunk[name];
    if (isReleased && !from.startsWith("singleScatter")) continue;
    ShaderChunk[name] = text.replace(from, to);
    told[`foreign ${from}`] = refused(() => patch(new THREE.MeshStandardMaterial(), "gold"));
    ShaderChunk[name] = text;
  }
  return told;
}

export async function proof() {
  const start = performance.now(), told = { revision: THREE.REVISION, table: [tableSize, Object.keys(methods)] };
  for (const part of [lamps, furnace, coats, rectangles, spheres, features, painted, refusals]) {
    told[part.name] = part();
    told[`${part.name}_ms`] = Math.round(performance.now() - start);
  }
  told.shader_faults = shaderFaults;
  return told;
}
