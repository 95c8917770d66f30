// Draws small planes by patched materials, reads the pixel in the middle, and leaves all readings in the page. The page's load waits for
// it: a document that is being written delays it.
//
// The view is along z. A lamp stands at twice the angle of the plane's normal, so that the half vector is the normal and its cosine is
// known. The picture is linear, in 32-bit floats. `white` is the same surface with F = 1 from every direction.
{
  const told = { readings: [], names: [] };
  const hold = document.body.appendChild(document.createElement("iframe"));
  hold.hidden = true;
  hold.contentDocument.open();

  const backend = new URLSearchParams(location.search).get("backend") ?? "webgl2";
  const { materials, patch } = fresnel, B = BABYLON;
  materials.white = { method: fresnel.fitted, f0: [1, 1, 1], coefficients: [[1, 1, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]] };

  const dielectrics = ["water", "oil_on_water"];

  async function start() {
    const canvas = document.getElementById("canvas");
    let engine = null;
    if (backend === "webgpu") {
      engine = new B.WebGPUEngine(canvas);
      await engine.initAsync();
    } else {
      engine = new B.Engine(canvas, false);
    }
    told.drawn_by = engine.isWebGPU ? "webgpu" : `webgl${engine.webGLVersion}`;
    return engine;
  }

  const vector = angle => new B.Vector3(Math.sin(angle), 0, Math.cos(angle));

  // A cube of radiance 1 from everywhere, with the irradiance that belongs to it.
  function surroundings(scene) {
    const side = 8, { TEXTUREFORMAT_RGBA, TEXTURETYPE_FLOAT, TEXTURETYPE_HALF_FLOAT } = B.Constants;
    const six = kind => Array.from({ length: 6 }, () => new kind(4 * side * side));
    const faces = six(Float32Array).map(face => face.fill(1)), halves = six(Uint16Array).map(face => face.fill(B.ToHalfFloat(1)));
    const cube = new B.RawCubeTexture(scene, halves, side, TEXTUREFORMAT_RGBA, TEXTURETYPE_HALF_FLOAT, false);
    cube.gammaSpace = false;
    const names = ["right", "left", "up", "down", "front", "back"];
    cube.sphericalPolynomial = B.CubeMapToSphericalPolynomialTools.ConvertCubeMapToSphericalPolynomial({
      size: side, format: TEXTUREFORMAT_RGBA, type: TEXTURETYPE_FLOAT, gammaSpace: false,
      ...Object.fromEntries(names.map((name, i) => [name, faces[i]])),
    });
    return cube;
  }

  // Every area light as it is, with one number for the albedo of white and one for Schlick's term.
  function area_tables(scene) {
    const constant = four => {
      const halves = new Uint16Array(64 * 64 * 4);
      for (let i = 0; i < halves.length; i++) halves[i] = B.ToHalfFloat(four[i % 4]);
      return B.RawTexture.CreateRGBATexture(halves, 64, 64, scene, false, false, 2, 2);
    };
    scene._ltcTextures = { LTC1: constant([1, 0, 0, 1]), LTC2: constant([1, 0.1, 0, 1]) };
  }

  async function stage(engine) {
    const scene = new B.Scene(engine);
    scene.useRightHandedSystem = true;
    scene.clearColor = new B.Color4(0, 0, 0, 0);
    scene.imageProcessingConfiguration.applyByPostProcess = true; // linear
    const camera = new B.FreeCamera("camera", new B.Vector3(0, 0, 5), scene);
    camera.setTarget(B.Vector3.Zero());
    camera.mode = B.Camera.ORTHOGRAPHIC_CAMERA;
    Object.assign(camera, { orthoLeft: -0.01, orthoRight: 0.01, orthoTop: 0.01, orthoBottom: -0.01, minZ: 0.1, maxZ: 20 });
    const plane = B.MeshBuilder.CreateGround("plane", { width: 2, height: 2 }, scene);
    plane.rotationQuaternion = new B.Quaternion();
    const target = new B.RenderTargetTexture("target", 3, scene, false, true, B.Constants.TEXTURETYPE_FLOAT, false, 1);
    camera.outputRenderTarget = target;
    area_tables(scene);
    return { engine, scene, camera, plane, target, environment: surroundings(scene), lamp: [] };
  }

  const lamps = {
    directional: to => new B.DirectionalLight("lamp", to.scale(-1)),
    point: to => new B.PointLight("lamp", to.scale(3)),
    spot: to => new B.SpotLight("lamp", to.scale(3), to.scale(-1), 2, 1),
    rectangle: to => {
      const lamp = new B.RectAreaLight("lamp", B.Vector3.Zero(), 1, 1);
      const holder = new B.TransformNode("holder");
      holder.position = to.scale(3);
      holder.lookAt(to.scale(6));
      lamp.parent = holder;
      return lamp;
    },
    clustered: (to, scene) => new B.ClusteredLightContainer("lamp", [new B.PointLight("one", to.scale(3))], scene),
  };

  async function reading(stage, { name, kind, angle, roughness, diffuse = [0, 0, 0], set = {}, after = {}, plain = false, energy = true, coat }) {
    const { scene, plane, target, environment } = stage;
    const material = new B.PBRMaterial("surface", scene);
    material.backFaceCulling = false;
    material.metallic = 0;
    material.roughness = roughness;
    material.albedoColor = new B.Color3(...diffuse);
    material.brdf.useEnergyConservation = energy;
    for (const [part, values] of Object.entries(set)) Object.assign(part === "own" ? material : material[part], values);
    if (kind === "image") material.reflectionTexture = environment;
    if (plain) {
      material.metallic = 1;
      material.albedoColor = new B.Color3(...materials[name].f0);
    } else patch(material, name, BABYLON, { coat });
    Object.assign(material.brdf, after);
    if (dielectrics.includes(name)) material.albedoColor = new B.Color3(...diffuse);
    B.Quaternion.FromUnitVectorsToRef(B.Vector3.Up(), vector(angle), plane.rotationQuaternion);
    while (stage.lamp.length) stage.lamp.pop().dispose();
    if (lamps[kind]) stage.lamp.push(lamps[kind](vector(2 * angle), scene));
    for (const lamp of stage.lamp) lamp.intensity = kind === "directional" ? 1 : 9;
    plane.material = material;
    // Everything has been loaded when the scene says so; the second frame is complete.
    const late = new Promise((_, fail) => setTimeout(() => fail(new Error(`${kind} of ${name} is never ready`)), 5000));
    await Promise.race([scene.whenReadyAsync(true), late]);
    for (let frame = 0; frame < 2; frame++) {
      stage.engine.beginFrame();
      scene.render();
      stage.engine.endFrame();
    }
    const pixels = await target.readPixels();
    material.dispose();
    return Array.from(pixels.slice(4 * 4, 4 * 4 + 3));
  }

  const has_few = new URLSearchParams(location.search).has("few"); // of an older version a sample is enough
  const degrees = has_few ? [0, 30, 55, 75, 84] : [0, 15, 30, 45, 55, 65, 75, 80, 84];

  async function all(stage) {
    const record = async row => told.readings.push({ ...row, rgb: await reading(stage, row) });
    for (const name of told.names.concat("white")) {
      for (const degree of degrees) {
        const angle = degree * Math.PI / 180;
        const set = { anisotropy: { isEnabled: true, intensity: 0.5 } };
        for (const kind of Object.keys(lamps)) await record({ name, kind, angle, roughness: 0.5, energy: false });
        await record({ name, kind: "directional", angle, roughness: 0.5, energy: false, set, is_anisotropic: true });
        await record({ name, kind: "directional", angle, roughness: 0.5, energy: true });
        for (const roughness of [0, 0.1, 0.3, 0.6, 1]) {
          for (const energy of [false, true]) await record({ name, kind: "image", angle, roughness, energy });
        }
        // White diffuse below: what is not reflected is scattered.
        await record({ name, kind: "image", angle, roughness: 0.3, diffuse: [1, 1, 1], energy: true, is_furnace: true });
      }
    }
    for (const degree of degrees) {
      await record({ name: "gold", kind: "directional", angle: degree * Math.PI / 180, roughness: 0.5, energy: false, plain: true });
    }
    for (const degree of degrees) {
      const angle = degree * Math.PI / 180, set = { clearCoat: { isEnabled: true } };
      for (const row of [{}, { plain: true }, { coat: 1.5 }]) {
        await record({ name: "gold", kind: "image", angle, roughness: 0, energy: false, set, ...row, is_coated: true });
      }
    }
    // Variants of the shader that must compile: their colours are Babylon.js' own in part.
    const on = values => ({ isEnabled: true, ...values });
    const variants = [
      { clearCoat: on() }, { clearCoat: on({ intensity: 0.5, indexOfRefraction: 1.7 }), iridescence: on(), anisotropy: on() },
      { clearCoat: on({ remapF0OnInterfaceChange: false }) }, { iridescence: on({ intensity: 0.5 }) }, { sheen: on() }, { anisotropy: on({ intensity: 0.5 }), iridescence: on() },
      { subSurface: { isRefractionEnabled: true } }, { subSurface: { isTranslucencyEnabled: true } },
      { own: { environmentBRDFTexture: null } },
      { brdf: { useSmithVisibilityHeightCorrelated: false } }, { own: { useRadianceOcclusion: false, useHorizonOcclusion: false } },
      { brdf: { conductorSpecularModel: 1, dielectricSpecularModel: 1 } }, { brdf: { baseDiffuseModel: 1 } },
      { own: { metallic: null, roughness: null, microSurface: 0.5 } },
    ];
    for (const kind of ["directional", "image"]) {
      const after = { useLegacySpecularEnergyConservation: true };
      await record({ name: "water", kind, angle: 0.5, roughness: 0.5, after, is_variant: true });
    }
    for (const set of variants) {
      for (const kind of ["directional", "image", "rectangle", "none"]) {
        for (const name of ["gold", "water", "oil_on_water"]) await record({ name, kind, angle: 0.5, roughness: 0.5, set, is_variant: true });
      }
    }
  }

  async function refusals(stage) {
    const { scene } = stage;
    const says = call => { try { call(); return "nothing"; } catch (fault) { return fault.message ?? fault; } };
    const material = () => new B.PBRMaterial("surface", scene);
    told.unknown = says(() => patch(material(), "glod", BABYLON));
    told.option = says(() => patch(material(), "gold", BABYLON, { coats: 1.5 }));
    told.foreign = says(() => patch(new B.StandardMaterial("surface", scene), "gold", BABYLON));
    told.without_engine = says(() => patch(material(), "gold"));
    const { ShaderStore } = B, store = backend === "webgpu" ? ShaderStore.IncludesShadersStoreWGSL : ShaderStore.IncludesShadersStore;
    const text = store.lightFragment;
    store.lightFragment = text.replace("coloredFresnel,", "other,");
    told.without_place = says(() => patch(material(), "gold", BABYLON));
    store.lightFragment = text;
    const of_include = patch(material(), "gold", BABYLON).pluginManager.getPlugin("FresnelGen");
    delete store.lightFragment;
    told.without_include = says(() => of_include.bindForSubMesh({ setTexture() {} }));
    store.lightFragment = text;
  }

  // One material patched twice shows what it was patched with last.
  async function again(stage) {
    const twice = patch(new B.PBRMaterial("twice", stage.scene), "water", BABYLON);
    const plugin = twice.pluginManager.getPlugin("FresnelGen"), code = () => plugin.getCustomCode("fragment", 0).CUSTOM_FRAGMENT_BEGIN;
    const before = code();
    patch(twice, "gold", BABYLON);
    const once = patch(new B.PBRMaterial("once", stage.scene), "gold", BABYLON).pluginManager.getPlugin("FresnelGen");
    // A clone is not patched, and can be.
    const clone = twice.clone("clone"), own = () => clone.pluginManager?.getPlugin("FresnelGen") ?? null;
    told.clone = own() === null && patch(clone, "gold", BABYLON) === clone && own() !== null;
    told.again = before !== code() && code() === once.getCustomCode("fragment", 0).CUSTOM_FRAGMENT_BEGIN;
  }

  (async () => {
    try {
      told.names = Object.keys(materials).filter(name => name !== "white");
      told.version = B.AbstractEngine.Version;
      const drawn = await stage(await start());
      await all(drawn);
      await refusals(drawn);
      await again(drawn);
    } catch (fault) { faults.push(`${fault} ${fault?.stack}`); }
    told.faults = faults;
    const place = document.body.appendChild(document.createElement("pre"));
    place.id = "told";
    place.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(told))));
    hold.contentDocument.close();
    hold.remove();
  })();
}
