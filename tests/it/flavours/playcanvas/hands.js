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
  const { materials, patch } = fresnel;
  materials.white = { method: fresnel.fitted, f0: [1, 1, 1], coefficients: [[1, 1, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]] };

  const dielectrics = ["water", "oil_on_water"];

  async function start() {
    const device = await pc.createGraphicsDevice(document.getElementById("canvas"), { deviceTypes: [backend], antialias: false });
    device.wgpu?.addEventListener("uncapturederror", event => faults.push(event.error.message));
    if (device.deviceType !== backend) throw new Error(`${device.deviceType} in place of ${backend}`);
    const options = new pc.AppOptions();
    options.graphicsDevice = device;
    options.componentSystems = [pc.CameraComponentSystem, pc.LightComponentSystem, pc.RenderComponentSystem];
    const app = new pc.AppBase(device.canvas);
    app.init(options);
    app.autoRender = false;
    app.scene.ambientLight = new pc.Color(0, 0, 0);
    return app;
  }

  const vector = angle => new pc.Vec3(Math.sin(angle), 0, Math.cos(angle));
  const turned = (from, to) => new pc.Quat().setFromDirections(from, to);

  function stage(app) {
    const side = 3;
    const picture = new pc.Texture(app.graphicsDevice, {
      width: side, height: side, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false,
      minFilter: pc.FILTER_NEAREST, magFilter: pc.FILTER_NEAREST,
    });
    const target = new pc.RenderTarget({ colorBuffer: picture, depth: true, samples: 1 });
    const camera = new pc.Entity();
    camera.addComponent("camera", {
      projection: pc.PROJECTION_ORTHOGRAPHIC, orthoHeight: 0.01, nearClip: 0.1, farClip: 20,
      clearColor: new pc.Color(0, 0, 0, 0), renderTarget: target, gammaCorrection: pc.GAMMA_NONE, toneMapping: pc.TONEMAP_NONE,
    });
    camera.camera.requestSceneColorMap(true); // for dynamic refraction
    camera.setPosition(0, 0, 5);
    app.root.addChild(camera);
    const plane = new pc.Entity();
    const mesh = pc.Mesh.fromGeometry(app.graphicsDevice, new pc.PlaneGeometry({ halfExtents: new pc.Vec2(1, 1) }));
    plane.addComponent("render", { meshInstances: [new pc.MeshInstance(mesh, new pc.StandardMaterial())], castShadows: false });
    app.root.addChild(plane);
    const texels = size => new Array(size * size).fill([1, 1, 1, 1]).flat();
    const environment = new pc.Texture(app.graphicsDevice, {
      width: 512, height: 512, format: pc.PIXELFORMAT_RGBA16F, mipmaps: false, levels: [new Uint16Array(texels(512).map(() => 0x3c00))],
    });
    // Every area light as it is, with one number for the albedo of white and one for Schlick's term.
    const luts = 64 * 64, identity = [1, 0, 0, 1], albedo = [1, 0.1, 0, 1];
    app.setAreaLightLuts(new Array(luts).fill(identity).flat(), new Array(luts).fill(albedo).flat());
    return { app, plane, picture, target, side, environment, light: null };
  }

  // A lamp or an image, and the surface below it.
  const lamps = {
    directional: { type: "directional" },
    omni: { type: "omni", range: 100 },
    spot: { type: "spot", range: 100, innerConeAngle: 60, outerConeAngle: 70 },
    rectangle: { type: "spot", range: 100, innerConeAngle: 60, outerConeAngle: 70, shape: pc.LIGHTSHAPE_RECT },
  };

  async function reading(stage, { name, kind, clustered = false, angle, gloss, diffuse = [0, 0, 0], set = {}, plain = false, coat }) {
    const { app, plane, picture, target, side, environment } = stage;
    if (backend !== "webgpu") app.scene.clusteredLightingEnabled = clustered;
    if (clustered) app.scene.lighting.areaLightsEnabled = kind === "rectangle";
    app.scene.envAtlas = kind === "image" ? environment : null;
    const material = new pc.StandardMaterial();
    Object.assign(material, { gloss, enableGGXSpecular: true, diffuse: new pc.Color(...diffuse), useMetalness: false }, set);
    if (plain) material.specular = new pc.Color(...materials[name].f0).gamma();
    else patch(material, name, pc, { coat });
    if (kind === "image" && dielectrics.includes(name)) material.diffuse = new pc.Color(...diffuse);
    material.update();
    plane.render.meshInstances[0].material = material;
    plane.setRotation(turned(pc.Vec3.UP, vector(angle)));
    stage.light?.destroy();
    stage.light = null;
    if (lamps[kind]) {
      stage.light = new pc.Entity();
      stage.light.addComponent("light", { ...lamps[kind], intensity: 1, castShadows: false, affectSpecularity: true });
      const to = vector(2 * angle);
      stage.light.setPosition(to.clone().mulScalar(3));
      stage.light.setRotation(turned(pc.Vec3.DOWN, to.clone().mulScalar(-1)));
      app.root.addChild(stage.light);
    }
    app.update(0);
    app.render();
    const at = Math.floor(side / 2);
    const pixel = await picture.read(at, at, 1, 1, { renderTarget: target, immediate: true });
    return Array.from(pixel.slice(0, 3));
  }

  const has_few = new URLSearchParams(location.search).has("few"); // of an older version a sample is enough
  const degrees = has_few ? [0, 30, 55, 75, 84] : [0, 15, 30, 45, 55, 65, 75, 80, 84];

  async function all(stage) {
    const record = async row => told.readings.push({ ...row, rgb: await reading(stage, row) });
    // Clustered light cannot be turned on again, so it comes first. With WebGPU all light is clustered.
    for (const clustered of backend === "webgpu" ? [true] : [true, false]) {
      for (const name of told.names.concat("white")) {
        for (const degree of degrees) {
          const angle = degree * Math.PI / 180;
          for (const kind of Object.keys(lamps)) await record({ name, kind, clustered, angle, gloss: 0.5 });
        }
      }
    }
    for (const name of told.names.concat("white")) {
      for (const degree of degrees) {
        const row = { name, kind: "image", angle: degree * Math.PI / 180 };
        for (const gloss of [1, 0.9, 0.7, 0.4, 0]) await record({ ...row, gloss });
        // White diffuse below: what is not reflected is scattered.
        await record({ ...row, gloss: 0.7, diffuse: [1, 1, 1], is_furnace: true });
      }
    }
    for (const degree of degrees) {
      await record({ name: "gold", kind: "directional", clustered: backend === "webgpu", angle: degree * Math.PI / 180, gloss: 0.5, plain: true });
    }
    for (const degree of degrees) {
      for (const row of [{}, { plain: true }, { coat: 1.5 }]) {
        await record({ name: "gold", kind: "image", angle: degree * Math.PI / 180, gloss: 1, set: { clearCoat: 1 }, ...row, is_coated: true });
      }
    }
    // Variants of the shader that must compile: their colours are PlayCanvas' own in part.
    const variants = [
      { clearCoat: 0.5 }, { useIridescence: true, iridescence: 0.5 }, { useSheen: true }, { anisotropyIntensity: 0.5 },
      { refraction: 0.5, useDynamicRefraction: true }, { enableGGXSpecular: false }, { refraction: 0.5 },
    ];
    for (const set of variants) {
      for (const kind of ["directional", "image", "rectangle", "none"]) {
        // In older versions PlayCanvas's own shader of this does not compile: it has no F without light.
        const post = pc.ShaderChunks.get(stage.app.graphicsDevice, "glsl").get("litForwardPostCodePS");
        if (kind === "none" && set.refraction && !/SPECULAR_OR_REFLECTION\) \|\| defined\(LIT_REFRACTION/.test(post)) continue;
        for (const name of ["gold", "water", "oil_on_water"]) await record({ name, kind, angle: 0.5, gloss: 0.5, set, is_variant: true });
      }
    }
  }

  function refusals(stage) {
    const says = call => { try { call(); return "nothing"; } catch (fault) { return fault.message; } };
    const material = () => new pc.StandardMaterial();
    told.unknown = says(() => patch(material(), "glod", pc));
    told.option = says(() => patch(material(), "gold", pc, { coats: 1.5 }));
    told.foreign = says(() => patch(new pc.ShaderMaterial(), "gold", pc));
    told.without_engine = says(() => patch(material(), "gold"));
    const chunks = pc.ShaderChunks.get(stage.app.graphicsDevice, "glsl"), text = chunks.get("fresnelSchlickPS");
    chunks.delete("fresnelSchlickPS");
    told.without_chunk = says(() => patch(material(), "gold", pc));
    chunks.set("fresnelSchlickPS", text.replace(/\bret\b/g, "other"));
    told.without_place = says(() => patch(material(), "gold", pc));
    chunks.set("fresnelSchlickPS", text);
    // Patching again, and a copy, change nothing.
    const [one, other] = [material(), material()].map(one => patch(one, "gold", pc));
    patch(patch(other, "water", pc), "gold", pc);
    const chunk = surface => JSON.stringify([...surface.getShaderChunks("glsl"), ...surface.getShaderChunks("wgsl")]);
    told.again = chunk(one) === chunk(other) && chunk(one.clone()) === chunk(other);
  }

  (async () => {
    try {
      told.names = Object.keys(materials).filter(name => name !== "white");
      told.version = pc.version;
      const drawn = stage(await start());
      told.drawn_by = drawn.app.graphicsDevice.deviceType;
      await all(drawn);
      refusals(drawn);
    } catch (fault) { faults.push(`${fault} ${fault.stack}`); }
    told.faults = faults;
    const place = document.body.appendChild(document.createElement("pre"));
    place.id = "told";
    place.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(told))));
    hold.contentDocument.close();
    hold.remove();
  })();
}
