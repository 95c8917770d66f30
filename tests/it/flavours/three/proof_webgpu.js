// What three.js draws in WebGPU with TSL, in figures: F as a node, and patched node materials.

import * as THREE from "three/webgpu";
import { float, positionView, screenCoordinate, uniform, vec3, vec4 } from "three/tsl";
import { MeshStandardMaterial } from "three";
import { RectAreaLightTexturesLib } from "three/addons/lights/RectAreaLightTexturesLib.js";
import { materials, methods, patch as patchWebGL } from "./three/fresnel.js";
import { fresnel, patch, patchWith } from "./three/fresnel.tsl.js";
import { compensation, f32, once, reflectance, terms, white } from "./expected.js";

const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
async function drawn(renderer, scene, mesh, width, height) {
  const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType, depthBuffer: false });
  mesh.frustumCulled = false;
  scene.add(mesh);
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
  renderer.setRenderTarget(null);
  scene.remove(mesh);
  target.dispose();
  const row = pixels.length / height; // rows may be padded
  return (x, channel, y = 0) => pixels[y * row + 4 * x + channel];
}

async function nodes(renderer) {
  const width = 256, told = {};
  for (const name of Object.keys(materials)) {
    const material = new THREE.NodeMaterial();
    material.fragmentNode = vec4(fresnel(name, screenCoordinate.x.sub(0.5).div(width - 1)), 1);
    const pixel = await drawn(renderer, new THREE.Scene(), new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material), width, 1);
    let most = 0;
    for (let x = 0; x < width; x++) for (let k = 0; k < 3; k++)
      most = Math.max(most, Math.abs(pixel(x, k) - reflectance(materials[name], f32(x / (width - 1)), k)));
    told[name] = most;
  }
  return told;
}

// Pixels in a row, on a plane behind which or in front of which a lamp stands. The normal is the half vector, tilted.
const WIDTH = 128;
function pixels(height, tilt) {
  return Array.from({ length: WIDTH }, (_, i) => {
    const x = 2 * (i + 0.5) / WIDTH - 1, l = Math.hypot(x, height), light = [-x / l, 0, height / l];
    const half = [light[0], 0, light[2] + 1], h = Math.hypot(half[0], half[2]);
    const n = [half[0] / h + tilt, half[2] / h], length = Math.hypot(...n);
    const cosH = (n[0] * half[0] + n[1] * half[2]) / h / length;
    return { cos: half[2] / h, cosV: n[1] / length, cosL: (n[0] * light[0] + n[1] * light[2]) / length, cosH };
  });
}
const tilted = (material, lamp, tilt) => {
  const light = lamp.sub(positionView).normalize();
  material.normalNode = light.add(vec3(0, 0, 1)).normalize().add(vec3(tilt, 0, 0)).normalize();
  return material;
};

async function lighting(renderer) {
  const told = { lamps: {}, image: {}, rectangle: {}, white_diffuse: 0, least_cos: 1 };
  const lit = new THREE.Scene(), image = new THREE.Scene(), area = new THREE.Scene();
  const point = new THREE.PointLight(0xffffff, 1, 0, 0), lamp = uniform(point.position);
  lit.add(point);
  const whiteScene = new THREE.Scene();
  whiteScene.background = new THREE.Color(1, 1, 1);
  image.environment = new THREE.PMREMGenerator(renderer).fromScene(whiteScene).texture;
  THREE.RectAreaLightNode.setLTC(RectAreaLightTexturesLib.init());
  const rectangle = new THREE.RectAreaLight(0xffffff, 1, 3, 2);
  rectangle.position.set(0.4, 0.3, 2);
  area.add(rectangle);
  const roughness = 0.4, tilt = 0.05, plane = new THREE.PlaneGeometry(2, 2).translate(0, 0, -1);
  const material = (row, color = 0) => patchWith(tilted(new THREE.MeshStandardNodeMaterial({ roughness, color }), lamp, tilt), row);
  const seen = (scene, one) => drawn(renderer, scene, new THREE.Mesh(plane, one), WIDTH, 1);
  for (const name of Object.keys(materials)) {
    const row = materials[name], ours = material(row), all = material(white(row.method));
    const most = { lamps: 0, image: 0, rectangle: 0 };
    for (const height of [0.2, -0.3]) {
      point.position.set(0, 0, height - 1);
      const [a, b] = [await seen(lit, ours), await seen(lit, all)];
      const [c, d, e, g] = [await seen(image, ours), await seen(image, all), await seen(area, ours), await seen(area, all)];
      pixels(height, tilt).forEach(({ cos, cosV, cosL }, i) => {
        if (cos < 0.2 || cosV < 0.05 || cosL < 0.05) return;
        told.least_cos = Math.min(told.least_cos, cos);
        const lobe = terms(row.method, cosV, roughness)[0];
        for (let k = 0; k < 3; k++) {
          const more = compensation(row, cosV, roughness, k), reflected = once(row, cosV, roughness, k) * more;
          most.lamps = Math.max(most.lamps, Math.abs(a(i, k) / b(i, k) / lobe / more - reflectance(row, cos, k)));
          most.image = Math.max(most.image, Math.abs(c(i, k) - reflected), Math.abs(d(i, k) - 1));
          if (g(i, k) > 0) most.rectangle = Math.max(most.rectangle, Math.abs(e(i, k) / g(i, k) - c(i, k)));
        }
      });
    }
    for (const part of Object.keys(most)) told[part][name] = most[part];
  }
  // The lobe of lamps where three's own distribution loses digits, relative.
  told.lobe = 0;
  const least = parseInt(THREE.REVISION) < 187 ? 0.0525 : 0.05; // the roughness that three draws where it is given .05
  point.position.set(0, 0, -0.8);
  for (const tilt of [0.0005, 0.003, 0.01]) {
    const narrow = patchWith(tilted(new THREE.MeshStandardNodeMaterial({ roughness: 0.05, color: 0 }), lamp, tilt), white(methods.fitted));
    const seen = await drawn(renderer, lit, new THREE.Mesh(plane, narrow), WIDTH, 1);
    pixels(0.2, tilt).forEach(({ cosV, cosL, cosH }, i) => {
      if (cosV < 0.2 || cosL < 0.2) return;
      const a2 = least ** 4, root = cos => Math.sqrt(a2 + (1 - a2) * cos * cos);
      const d = a2 / Math.PI / (1 - cosH ** 2 + a2 * cosH ** 2) ** 2, v = 0.5 / (cosL * root(cosV) + cosV * root(cosL));
      const ours = d * v * cosL / terms(methods.fitted, cosV, least)[0];
      told.lobe = Math.max(told.lobe, Math.abs(seen(i, 0) / ours - 1));
    });
  }
  for (const name of ["water", "oil_on_water"]) {
    const below = await seen(image, material(materials[name], 0xffffff));
    pixels(-0.3, tilt).forEach((_, i) => { told.white_diffuse = Math.max(told.white_diffuse, Math.abs(below(i, 0) - 1)); });
  }
  const opaque = [0, 0xffffff].map(color => material(materials.anodised_titanium_purple, color)), [black, bright] = [await seen(image, opaque[0]), await seen(image, opaque[1])];
  told.opaque_diffuse = Math.abs(bright(64, 0) - black(64, 0));
  // Materials of one method share a program, and an unpatched one is not changed.
  point.position.set(0, 0, -0.8);
  const plain = () => tilted(new THREE.MeshStandardNodeMaterial({ roughness, metalness: 1 }), lamp, tilt);
  const one = plain(), before = await seen(lit, one);
  const [silver, gold] = [await seen(lit, patch(plain(), "silver")), await seen(lit, patch(plain(), "gold"))];
  const after = await seen(lit, one), all = Array.from({ length: WIDTH }, (_, i) => i);
  told.unpatched_changed = all.filter(i => [0, 1, 2].some(k => before(i, k) !== after(i, k))).length;
  told.blue_of_silver_and_gold = [silver(64, 2), gold(64, 2)];
  // A map of metalness, here a node: paint is three's own.
  told.painted = {};
  for (const [name, scene] of Object.entries({ lamps: lit, image, rectangle: area })) {
    const given = { roughness, color: 0x906040 }, plain = more => tilted(new THREE.MeshStandardNodeMaterial({ ...given, ...more }), lamp, tilt);
    const mixed = share => seen(scene, patch(Object.assign(plain({}), { metalnessNode: float(share) }), "gold"));
    const [whole, none, part] = [await mixed(1), await mixed(0), await mixed(0.4)];
    const [metal, paint] = [await seen(scene, patch(plain({}), "gold")), await seen(scene, plain({ metalness: 0 }))];
    told.painted[name] = Math.max(...all.flatMap(i => [0, 1, 2].flatMap(k => [
      whole(i, k) - metal(i, k), none(i, k) - paint(i, k), part(i, k) - 0.4 * metal(i, k) - 0.6 * paint(i, k),
    ].map(off => Math.abs(off) / Math.max(1, metal(i, k))))));
  }
  const hasDiffuseRoughness = new THREE.MeshPhysicalNodeMaterial().diffuseRoughness !== undefined;
  const physical = patch(tilted(new THREE.MeshPhysicalNodeMaterial({ roughness, clearcoat: 1, anisotropy: 0.5, ...hasDiffuseRoughness ? { diffuseRoughness: 0.5 } : {} }), lamp, tilt), "gold");
  const coated = await seen(image, physical);
  told.physical_drawn = [0, 1, 2].every(k => Number.isFinite(coated(64, k)) && coated(64, k) > 0);
  return told;
}

async function refusals(renderer) {
  // three catches errors in the middle of a frame and writes them to the console.
  const refused = async act => {
    const said = console.error;
    let heard = null;
    console.error = (...words) => { heard ??= words.join(" ").split(/ "|\n/)[0]; };
    try { await act(); } catch (fault) { heard = fault.message; } finally { console.error = said; }
    return heard;
  };
  const mesh = one => drawn(renderer, new THREE.Scene().add(new THREE.PointLight()), new THREE.Mesh(new THREE.PlaneGeometry(2, 2), one), 4, 1);
  return {
    webgl_patch: await refused(() => mesh(patchWebGL(new MeshStandardMaterial(), "gold"))),
    sheen: await refused(() => mesh(patch(new THREE.MeshPhysicalNodeMaterial({ sheen: 1 }), "gold"))),
    name: await refused(() => fresnel("glod", 0.5)),
    material: await refused(() => patch(new MeshStandardMaterial(), "gold")),
  };
}

export async function proof() {
  const told = {};
  for (const forceWebGL of [false, true]) {
    const renderer = new THREE.WebGPURenderer({ forceWebGL });
    await renderer.init();
    const one = told[forceWebGL ? "webgl2" : "webgpu"] = { is_webgpu: renderer.backend.isWebGPUBackend === true };
    for (const part of [nodes, lighting, refusals]) {
      try { one[part.name] = await part(renderer); } catch (fault) { one[part.name] = `${fault} ${fault.stack}`; }
    }
    renderer.dispose();
  }
  return told;
}
