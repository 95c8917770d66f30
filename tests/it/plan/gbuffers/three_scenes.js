// Two scenes in three.js: the G-buffer of each, and its picture by the exact law and by functions of fresnel-gen.
//
// Light, normals, filtering and ids are three.js's own: MeshStandardMaterial with its normal map, and its prefiltered environment.
// Only the line that weighs the mirrored light against all other light is replaced, by `F L + (1 - F) O`.
//
// `job` stands before this text: { scene, size, samples, materials: { NAME: { table, text, name } } }. A table holds the exact law at
// 1024 cosines from 0 to 1 as base 64 of floats, `text` is an emitted file in GLSL ES, and `name` is its function.
import * as THREE from "three";
import { exr_file } from "exr";

// The picture by the exact law, the picture by the function, and what the G-buffer holds.
const EXACT = 0, CHOSEN = 1, NUMBERS = 2, LIGHT = 3, OTHER = 4;
const TEXELS = 1024;

const numbers_of = text => new Float32Array(Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer);
const text_of = bytes => {
  let letters = "";
  for (let at = 0; at < bytes.length; at += 32768) letters += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return btoa(letters);
};

const BEFORE_MAIN = (text, name) => `
uniform sampler2D exact_table;
uniform int what, id, body;
uniform bool is_rough;
uniform float index;

${text}

vec3 exact_law(float cos_theta) {
  float at = clamp(cos_theta, 0.0, 1.0) * ${TEXELS - 1}.0;
  int first = min(int(at), ${TEXELS - 2});
  vec3 one = texelFetch(exact_table, ivec2(first, 0), 0).rgb;
  return mix(one, texelFetch(exact_table, ivec2(first + 1, 0), 0).rgb, at - float(first));
}

vec3 law(float cos_theta) { return what == ${CHOSEN} ? ${name}(cos_theta) : exact_law(cos_theta); }

float masked(float alpha, float c) { return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - c * c) / (c * c)) - 1.0); }

// What GGX reflects of light from everywhere: the mean of F G2 / G1 over visible half vectors. Heitz 2014; Dupuy and Benyoub 2023.
vec3 mean_law(float c, float alpha) {
  if (!is_rough) return law(c);
  vec3 view = vec3(sqrt(max(0.0, 1.0 - c * c)), 0.0, max(c, 1e-3));
  vec3 flat_view = normalize(vec3(alpha * view.x, 0.0, view.z));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 128; i++) {
    float turn = 6.2831853 * fract(float(i) * 0.618033989), share = (float(i) + 0.5) / 128.0;
    float up = (1.0 - share) * (1.0 + flat_view.z) - flat_view.z;
    vec3 cap = vec3(sqrt(max(0.0, 1.0 - up * up)) * vec2(cos(turn), sin(turn)), up) + flat_view;
    vec3 between = normalize(vec3(alpha * cap.xy, max(cap.z, 1e-6)));
    float cos_h = clamp(dot(view, between), 0.0, 1.0), leaves = 2.0 * cos_h * between.z - view.z;
    if (leaves <= 0.0) continue;
    float weight = (1.0 + masked(alpha, view.z)) / (1.0 + masked(alpha, view.z) + masked(alpha, leaves));
    sum += weight * law(cos_h);
  }
  return sum / 128.0;
}
`;

const METAL = 0, PAINTED = 1, CLEAR = 2;
const IN_PLACE_OF_OUTPUT = `
float cos_theta = saturate(dot(geometryNormal, geometryViewDir));
vec3 other = vec3(0.0);
if (body == ${PAINTED}) other = iblIrradiance * RECIPROCAL_PI * diffuseColor.rgb;
if (body == ${CLEAR}) {
  vec3 inside = transformDirectionByInverseViewMatrix(refract(-geometryViewDir, geometryNormal, 1.0 / index), viewMatrix);
  other = textureLod(envMap, envMapRotation * inside, roughnessToMip(material.roughness)).rgb * envMapIntensity * diffuseColor.rgb;
}
vec3 reflected = mean_law(cos_theta, material.roughness * material.roughness);
vec3 picture = reflected * radiance + (1.0 - reflected) * other;
if (what == ${NUMBERS}) gl_FragColor = vec4(cos_theta, float(id), is_rough ? material.roughness : 0.0, diffuseColor.a);
else gl_FragColor = vec4(what == ${LIGHT} ? radiance : what == ${OTHER} ? other : picture, diffuseColor.a);
`;

const what = { value: EXACT };

// A material of three.js with the exact law and a function of ours in it.
function surface(name, id, { body = METAL, index = 1, is_rough = false, ...settings }) {
  const { table, text, name: called } = job.materials[name];
  const colours = numbers_of(table), texels = new Float32Array(4 * TEXELS);
  for (let i = 0; i < TEXELS; i++) texels.set(colours.subarray(3 * i, 3 * i + 3), 4 * i);
  const exact = new THREE.DataTexture(texels, TEXELS, 1, THREE.RGBAFormat, THREE.FloatType);
  exact.needsUpdate = true;
  const material = new THREE.MeshStandardMaterial({ metalness: body === METAL ? 1 : 0, roughness: 0, ...settings });
  material.customProgramCacheKey = () => name;
  material.onBeforeCompile = shader => {
    const own = { exact_table: exact, id, body, index, is_rough };
    for (const [key, value] of Object.entries(own)) shader.uniforms[key] = { value };
    shader.uniforms.what = what;
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `${BEFORE_MAIN(text, called)}\nvoid main() {`)
      .replace("#include <opaque_fragment>", IN_PLACE_OF_OUTPUT);
  };
  return material;
}

// A normal map of waves: [waves across, waves down, slope] each.
function waves(list, repeat) {
  const side = 256, texels = new Uint8Array(4 * side * side);
  for (let y = 0; y < side; y++)
    for (let x = 0; x < side; x++) {
      const slope = [0, 0];
      for (const [across, down, steep] of list) {
        const steepness = steep * Math.cos(2 * Math.PI * (across * x + down * y) / side + across * down);
        const length = Math.hypot(across, down);
        slope[0] += steepness * across / length;
        slope[1] += steepness * down / length;
      }
      const normal = new THREE.Vector3(-slope[0], -slope[1], 1).normalize();
      const bytes = normal.toArray().map(part => Math.round(127.5 * (part + 1)));
      texels.set([...bytes, 255], 4 * (y * side + x));
    }
  const map = new THREE.DataTexture(texels, side, side);
  map.wrapS = map.wrapT = THREE.RepeatWrapping;
  map.magFilter = THREE.LinearFilter;
  map.minFilter = THREE.LinearMipmapLinearFilter;
  map.generateMipmaps = true;
  map.repeat.set(...repeat);
  map.needsUpdate = true;
  return map;
}

// A room with bright windows below a sky, as three.js filters it.
function environment(renderer, lamps, ground, sky) {
  const room = new THREE.Scene();
  const dome = new THREE.SphereGeometry(40, 64, 32), colours = [];
  const heights = dome.getAttribute("position");
  for (let i = 0; i < heights.count; i++) {
    const up = heights.getY(i) / 40, share = THREE.MathUtils.smoothstep(up, -0.1, 0.15);
    const bright = 0.6 + 0.4 * Math.sin(5 * heights.getX(i) / 40 + 1);
    const colour = ground.map((part, k) => part + share * (bright * (sky[k] + (1 - up) * 0.25) - part));
    colours.push(...colour);
  }
  dome.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
  room.add(new THREE.Mesh(dome, new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.BackSide })));
  for (const [colour, size, place] of lamps) {
    const material = new THREE.MeshBasicMaterial();
    material.color.setRGB(...colour);
    const lamp = new THREE.Mesh(new THREE.BoxGeometry(...size), material);
    lamp.position.set(...place);
    room.add(lamp);
  }
  const filter = new THREE.PMREMGenerator(renderer);
  return filter.fromScene(room, 0, 0.1, 100).texture;
}

const WINDOWS = [
  [[9, 8.5, 8], [6, 8, 0.2], [-10, 8, -6]],
  [[3, 4, 5.5], [0.2, 5, 7], [12, 5, 2]],
  [[14, 9, 5], [2, 2, 2], [2, 13, 9]],
];

function statue(renderer, scene) {
  scene.environment = environment(renderer, WINDOWS, [0.12, 0.1, 0.08], [0.35, 0.45, 0.6]);
  const place = (geometry, material, [x, y, z]) => {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.set(x, y, z);
    scene.add(mesh);
    return mesh;
  };
  const hammered = waves([[3, 5, 0.12], [7, -2, 0.1], [-4, 9, 0.08]], [8, 1]);
  const ripples = waves([[2, 3, 0.1], [5, 1, 0.06]], [3, 2]);
  place(new THREE.TorusKnotGeometry(0.75, 0.27, 240, 40), surface("gold", 1, { normalMap: hammered }), [-0.35, 0.75, 0]);
  place(new THREE.SphereGeometry(0.62, 96, 64), surface("water", 2, { body: CLEAR, index: 1.333, normalMap: ripples }), [1.25, 0.1, 0.9]);
  place(new THREE.CylinderGeometry(0.95, 1.1, 0.5, 96), surface("platinum", 3, { is_rough: true, roughness: 0.35 }), [-0.35, -0.8, 0]);
  const varnish = surface("bk7", 4, { body: PAINTED, color: new THREE.Color(0.22, 0.09, 0.05) });
  place(new THREE.PlaneGeometry(9, 9), varnish, [0, -1.05, 0]).rotation.x = -Math.PI / 2;
  const camera = new THREE.PerspectiveCamera(38, 1, 0.1, 50);
  camera.position.set(0.6, 1.5, 5.2);
  camera.lookAt(0.15, 0.2, 0);
  return camera;
}

function table(renderer, scene) {
  scene.environment = environment(renderer, WINDOWS.slice(0, 2), [0.3, 0.28, 0.25], [0.5, 0.5, 0.5]);
  const place = (geometry, material, [x, y, z]) => {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.set(x, y, z);
    scene.add(mesh);
    return mesh;
  };
  const outline = [[0, -0.7], [0.5, -0.7], [0.72, -0.3], [0.6, 0.25], [0.32, 0.5], [0.4, 0.75]];
  const pot = new THREE.LatheGeometry(outline.map(point => new THREE.Vector2(...point)), 96);
  place(pot, surface("copper", 10, { side: THREE.DoubleSide }), [-0.95, 0, -0.2]);
  const facets = surface("silver", 20, { flatShading: true });
  place(new THREE.IcosahedronGeometry(0.6, 1), facets, [0.35, -0.1, -0.4]).rotation.set(0.3, 0.5, 0);
  place(new THREE.OctahedronGeometry(0.42, 0), surface("diamond", 30, { body: CLEAR, index: 2.42, flatShading: true }), [1.25, -0.25, 0.7]).rotation.y = 0.4;
  const sheet = surface("soda_lime_glass", 40, { body: PAINTED, color: new THREE.Color(0.1, 0.3, 0.25), transparent: true, opacity: 0.4, side: THREE.DoubleSide });
  place(new THREE.PlaneGeometry(1.1, 1.3), sheet, [0.35, -0.05, 1.1]).rotation.y = -0.5;
  const brushed = surface("chromium", 50, { is_rough: true, roughness: 0.5 });
  place(new THREE.CylinderGeometry(2.2, 2.2, 0.12, 128), brushed, [0.1, -0.78, 0]);
  const camera = new THREE.PerspectiveCamera(32, 1, 0.1, 50);
  camera.position.set(-0.6, 1.3, 5);
  camera.lookAt(0.1, -0.2, 0);
  return camera;
}

// What the scene shows, four numbers a sample, row by row from the top left.
function drawn(renderer, scene, camera, kind, side) {
  what.value = kind;
  const is_data = ![EXACT, CHOSEN].includes(kind);
  scene.traverse(mesh => {
    if (mesh.isMesh) mesh.material.blending = is_data ? THREE.NoBlending : THREE.NormalBlending;
  });
  const target = new THREE.WebGLRenderTarget(side, side, { type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.clear();
  renderer.render(scene, camera);
  const upside_down = new Float32Array(4 * side * side), samples = new Float32Array(4 * side * side);
  renderer.readRenderTargetPixels(target, 0, 0, side, side, upside_down);
  for (let y = 0; y < side; y++) samples.set(upside_down.subarray(4 * side * (side - 1 - y), 4 * side * (side - y)), 4 * side * y);
  target.dispose();
  return samples;
}

// The means of each pixel's samples, three channels.
function pixels(samples, size, each) {
  const means = new Float32Array(3 * size * size), side = size * each;
  for (let y = 0; y < side; y++)
    for (let x = 0; x < side; x++)
      for (let k = 0; k < 3; k++)
        means[3 * (Math.floor(y / each) * size + Math.floor(x / each)) + k] += samples[4 * (y * side + x) + k] / each / each;
  return means;
}

// The share of a pixel's samples with the id of its middle.
function shares(fine, ids, size, each) {
  const counts = new Float32Array(size * size), side = size * each;
  for (let y = 0; y < side; y++)
    for (let x = 0; x < side; x++) {
      const pixel = Math.floor(y / each) * size + Math.floor(x / each);
      if (fine[4 * (y * side + x) + 1] === ids[pixel]) counts[pixel] += 1 / each / each;
    }
  return counts;
}

async function render() {
  const { size, samples: each } = job;
  const renderer = new THREE.WebGLRenderer({ antialias: false });
  renderer.getContext().getExtension("EXT_float_blend");
  renderer.toneMapping = THREE.NoToneMapping;
  const scene = new THREE.Scene();
  const camera = { statue, table }[job.scene](renderer, scene);
  const channel = (samples, k) => samples.filter((_, i) => i % 4 === k);
  const [numbers, light, other] = [NUMBERS, LIGHT, OTHER].map(kind => drawn(renderer, scene, camera, kind, size));
  const ids = channel(numbers, 1);
  const fine = drawn(renderer, scene, camera, NUMBERS, size * each);
  const opacity = channel(numbers, 3), share = shares(fine, ids, size, each);
  const planes = { cos_theta: channel(numbers, 0), material_id: ids, roughness: channel(numbers, 2), coverage: share.map((part, i) => part * opacity[i]) };
  [["light", light], ["other", other]].forEach(([name, samples]) => {
    ["R", "G", "B"].forEach((letter, k) => { planes[`${name}.${letter}`] = channel(samples, k); });
  });
  const channels = Object.entries(planes).map(([name, samples]) => ({ name, samples, type: name === "material_id" ? "uint" : "half" }));
  const file = await exr_file(size, size, channels);
  const pictures = [EXACT, CHOSEN].map(kind => pixels(drawn(renderer, scene, camera, kind, size * each), size, each));
  return { version: THREE.REVISION, file: text_of(file), pictures: pictures.map(picture => text_of(new Uint8Array(picture.buffer))) };
}

// The page's load waits for a document that is being written.
const hold = document.body.appendChild(document.createElement("iframe"));
hold.hidden = true;
hold.contentDocument.open();
let told = {};
try { told = await render(); } catch (fault) { faults.push(`${fault} ${fault.stack}`); }
told.faults = faults;
const place = document.body.appendChild(document.createElement("pre"));
place.id = "told";
place.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(told))));
hold.contentDocument.close();
hold.remove();
