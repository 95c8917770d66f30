// Two players behind the same functions: `texture`, `mesh`, `target`, `draw`, `show`, `read`. A draw names all that it reads and writes.
// Bindings: 0 the frame's block, 1 a sampler that clamps, 2 one that repeats along u, textures from 3 on.

const VERTEX = [[0, 3], [3, 3], [6, 4], [10, 2]];
const VERTEX_BYTES = 48;
const ONE = { srcFactor: "one", dstFactor: "one", operation: "add" }, SUM = { color: ONE, alpha: ONE };

function from_half(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, part = bits & 1023;
  if (exponent === 31) return part ? NaN : sign * Infinity;
  return exponent ? sign * 2 ** (exponent - 15) * (1 + part / 1024) : sign * 2 ** -24 * part;
}

class WebGpuPlayer {
  static async open(canvas) {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) return null;
    const requiredFeatures = ["float32-filterable", "float32-blendable"].filter(name => adapter.features.has(name));
    const device = await adapter.requestDevice({ requiredFeatures });
    const context = canvas.getContext("webgpu");
    if (!context) return null;
    return new WebGpuPlayer(device, context, requiredFeatures.length === 2);
  }

  constructor(device, context, is_wide) {
    this.device = device;
    this.context = context;
    this.name = "WebGPU";
    this.format = is_wide ? "rgba32float" : "rgba16float";
    this.shown = navigator.gpu.getPreferredCanvasFormat();
    context.configure({ device, format: this.shown, alphaMode: "opaque" });
    const linear = { magFilter: "linear", minFilter: "linear" };
    this.samplers = ["clamp-to-edge", "repeat"].map(addressModeU => device.createSampler({ ...linear, addressModeU }));
    this.modules = new Map();
    this.pipelines = new Map();
    this.depths = new Map();
    device.addEventListener("uncapturederror", event => this.failed?.(event.error.message));
    device.lost.then(info => { if (info.reason !== "destroyed") this.failed?.(info.message); });
  }

  texture({ size: [width, height, layers], format }, bytes) {
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
    const texture = this.device.createTexture({ size: [width, height, layers], format, usage });
    const bytesPerRow = width * (format === "rgb9e5ufloat" ? 4 : 8);
    this.device.queue.writeTexture({ texture }, bytes, { bytesPerRow, rowsPerImage: height }, [width, height, layers]);
    return { texture, dimension: layers === 6 ? "cube" : "2d" };
  }

  mesh(vertices, indices) {
    const filled = (data, usage) => {
      const buffer = this.device.createBuffer({ size: data.byteLength, usage: usage | GPUBufferUsage.COPY_DST });
      this.device.queue.writeBuffer(buffer, 0, data);
      return buffer;
    };
    return { vertices: filled(vertices, GPUBufferUsage.VERTEX), indices: filled(indices, GPUBufferUsage.INDEX), count: indices.length };
  }

  target(side) {
    const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_SRC;
    return { texture: this.device.createTexture({ size: [side, side], format: this.format, usage }), dimension: "2d", side };
  }

  release(image) { image.texture.destroy(); }

  module(key, text) {
    if (!this.modules.has(key)) this.modules.set(key, this.device.createShaderModule({ code: text() }));
    return this.modules.get(key);
  }

  depth(side) {
    if (!this.depths.has(side)) {
      const usage = GPUTextureUsage.RENDER_ATTACHMENT;
      this.depths.set(side, this.device.createTexture({ size: [side, side], format: "depth32float", usage }));
    }
    return this.depths.get(side);
  }

  layout(images, sampleType) {
    const visibility = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;
    const entries = [{ binding: 0, visibility, buffer: { type: "uniform" } }];
    if (sampleType === "float") for (const binding of [1, 2]) entries.push({ binding, visibility, sampler: { type: "filtering" } });
    images.forEach((image, i) => entries.push({ binding: 3 + i, visibility, texture: { sampleType, viewDimension: image.dimension } }));
    return this.device.createBindGroupLayout({ entries });
  }

  pipeline(order) {
    const key = [order.key, order.vertex, order.fragment, order.depth].join(" ");
    if (!this.pipelines.has(key)) {
      const module = this.module(order.key, order.wgsl);
      const layout = this.layout(order.images, order.sampleType ?? "float");
      const attributes = VERTEX.map(([at, count], shaderLocation) => ({ shaderLocation, offset: 4 * at, format: "float32x" + count }));
      const descriptor = {
        layout: this.device.createPipelineLayout({ bindGroupLayouts: [layout] }),
        vertex: { module, entryPoint: order.vertex, buffers: order.mesh ? [{ arrayStride: VERTEX_BYTES, attributes }] : [] },
        fragment: { module, entryPoint: order.fragment, targets: order.targets.map(() => ({ format: order.format ?? this.format, blend: order.adds ? SUM : undefined })) },
      };
      if (order.depth !== "none")
        descriptor.depthStencil = { format: "depth32float", depthWriteEnabled: true, depthCompare: order.depth === "nearest" ? "less" : "greater" };
      this.pipelines.set(key, [this.device.createRenderPipeline(descriptor), layout]);
    }
    return this.pipelines.get(key);
  }

  draw(order) {
    const { device } = this, [pipeline, layout] = this.pipeline(order);
    const block = device.createBuffer({ size: order.uniforms.byteLength, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    device.queue.writeBuffer(block, 0, order.uniforms);
    const entries = [{ binding: 0, resource: { buffer: block } }];
    if (!order.sampleType) this.samplers.forEach((resource, i) => entries.push({ binding: 1 + i, resource }));
    order.images.forEach((image, i) => entries.push({ binding: 3 + i, resource: image.texture.createView({ dimension: image.dimension }) }));
    const encoder = device.createCommandEncoder();
    const loadOp = order.clears ? "clear" : "load";
    const descriptor = { colorAttachments: order.targets.map(target => ({ view: target.texture.createView(), loadOp, storeOp: "store" })) };
    if (order.depth !== "none")
      descriptor.depthStencilAttachment = { view: this.depth(order.targets[0].side).createView(), depthClearValue: order.depth === "nearest" ? 1 : 0, depthLoadOp: "clear", depthStoreOp: "discard" };
    const pass = encoder.beginRenderPass(descriptor);
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout, entries }));
    if (order.mesh) {
      pass.setVertexBuffer(0, order.mesh.vertices);
      pass.setIndexBuffer(order.mesh.indices, "uint32");
      pass.drawIndexed(order.mesh.count);
    } else pass.draw(order.count);
    pass.end();
    device.queue.submit([encoder.finish()]);
    block.destroy();
  }

  show(programs, images, uniforms) {
    const target = { texture: this.context.getCurrentTexture() };
    this.draw({ key: "show", wgsl: () => programs.wgsl, vertex: "vs_cover", fragment: "fs_show", sampleType: "unfilterable-float",
      format: this.shown, images, uniforms, targets: [target], clears: true, depth: "none", count: 3 });
  }

  async read({ texture, side }) {
    const { device } = this, wide = this.format === "rgba32float";
    const bytesPerRow = Math.ceil(side * (wide ? 16 : 8) / 256) * 256;
    const buffer = device.createBuffer({ size: bytesPerRow * side, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow }, [side, side]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const bytes = buffer.getMappedRange(), numbers = new Float32Array(4 * side * side);
    for (let y = 0; y < side; y++) {
      const row = wide ? new Float32Array(bytes, y * bytesPerRow, 4 * side) : Float32Array.from(new Uint16Array(bytes, y * bytesPerRow, 4 * side), from_half);
      numbers.set(row, 4 * side * y);
    }
    buffer.destroy();
    return numbers;
  }

  close() { this.failed = null; this.device.destroy(); }
}

class WebGl2Player {
  static async open(canvas) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, preserveDrawingBuffer: true });
    if (!gl || !gl.getExtension("EXT_color_buffer_float")) return null;
    return new WebGl2Player(gl, ["OES_texture_float_linear", "EXT_float_blend"].every(name => gl.getExtension(name)));
  }

  constructor(gl, is_wide) {
    this.gl = gl;
    this.name = "WebGL 2";
    this.is_wide = is_wide;
    this.samplers = [gl.CLAMP_TO_EDGE, gl.REPEAT].map(along_u => {
      const sampler = gl.createSampler();
      for (const [name, value] of [["MIN_FILTER", gl.LINEAR], ["MAG_FILTER", gl.LINEAR], ["WRAP_S", along_u], ["WRAP_T", gl.CLAMP_TO_EDGE], ["WRAP_R", gl.CLAMP_TO_EDGE]])
        gl.samplerParameteri(sampler, gl["TEXTURE_" + name], value);
      return sampler;
    });
    this.block = gl.createBuffer();
    this.programs = new Map();
    this.depths = new Map();
    this.nothing = gl.createVertexArray();
    gl.canvas.addEventListener("webglcontextlost", () => this.failed?.("the context is lost"));
  }

  texture({ size: [width, height, layers], format }, bytes) {
    const { gl } = this, kind = layers === 6 ? gl.TEXTURE_CUBE_MAP : gl.TEXTURE_2D, texture = gl.createTexture();
    const [inner, outer, type, view] = format === "rgb9e5ufloat"
      ? [gl.RGB9_E5, gl.RGB, gl.UNSIGNED_INT_5_9_9_9_REV, Uint32Array] : [gl.RGBA16F, gl.RGBA, gl.HALF_FLOAT, Uint16Array];
    gl.bindTexture(kind, texture);
    for (let layer = 0; layer < layers; layer++) {
      const length = bytes.length / layers, part = new view(bytes.buffer, layer * length, length / view.BYTES_PER_ELEMENT);
      gl.texImage2D(layers === 6 ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + layer : kind, 0, inner, width, height, 0, outer, type, part);
    }
    for (const name of ["MIN_FILTER", "MAG_FILTER"]) gl.texParameteri(kind, gl["TEXTURE_" + name], gl.LINEAR);
    return { texture, kind };
  }

  mesh(vertices, indices) {
    const { gl } = this, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    VERTEX.forEach(([at, count], location) => {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, count, gl.FLOAT, false, VERTEX_BYTES, 4 * at);
    });
    gl.bindVertexArray(null);
    return { array, count: indices.length };
  }

  target(side) {
    const { gl } = this, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, this.is_wide ? gl.RGBA32F : gl.RGBA16F, side, side);
    for (const name of ["MIN_FILTER", "MAG_FILTER"]) gl.texParameteri(gl.TEXTURE_2D, gl["TEXTURE_" + name], gl.LINEAR);
    return { texture, kind: gl.TEXTURE_2D, side };
  }

  release(image) { this.gl.deleteTexture(image.texture); }

  depth(side) {
    const { gl } = this;
    if (!this.depths.has(side)) {
      const depth = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, side, side);
      this.depths.set(side, depth);
    }
    return this.depths.get(side);
  }

  shader(type, text) {
    const { gl } = this, shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    return shader;
  }

  program(order) {
    const { gl } = this;
    if (!this.programs.has(order.key)) {
      const { vertex, fragment } = order.gles(), program = gl.createProgram();
      gl.attachShader(program, this.shader(gl.VERTEX_SHADER, vertex.text));
      gl.attachShader(program, this.shader(gl.FRAGMENT_SHADER, fragment.text));
      gl.linkProgram(program);
      if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
      for (const { block } of [vertex, fragment]) {
        const index = block ? gl.getUniformBlockIndex(program, block) : gl.INVALID_INDEX;
        if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, index, 0);
      }
      gl.useProgram(program);
      const textures = [...vertex.textures, ...fragment.textures];
      textures.forEach(({ name }, unit) => gl.uniform1i(gl.getUniformLocation(program, name), unit));
      this.programs.set(order.key, [program, textures]);
    }
    return this.programs.get(order.key);
  }

  bound(targets, depth) {
    const { gl } = this, buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    targets.forEach((target, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, target.texture, 0));
    if (depth) gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    gl.drawBuffers(targets.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    return buffer;
  }

  draw(order) {
    const { gl } = this, [program, textures] = this.program(order), has_depth = order.depth !== "none";
    const side = order.targets[0]?.side, buffer = side ? this.bound(order.targets, has_depth && this.depth(side)) : null;
    if (!buffer) gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, side ?? gl.drawingBufferWidth, side ?? gl.drawingBufferHeight);
    gl.useProgram(program);
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.block);
    gl.bufferData(gl.UNIFORM_BUFFER, order.uniforms, gl.STREAM_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, this.block);
    textures.forEach(({ texture, sampler }, unit) => {
      const image = order.images[texture - 3];
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(image.kind, image.texture);
      gl.bindSampler(unit, sampler ? this.samplers[sampler - 1] : null);
    });
    (has_depth ? gl.enable : gl.disable).call(gl, gl.DEPTH_TEST);
    (order.adds ? gl.enable : gl.disable).call(gl, gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.depthFunc(order.depth === "farthest" ? gl.GREATER : gl.LESS);
    gl.clearColor(0, 0, 0, 0);
    gl.clearDepth(order.depth === "farthest" ? 0 : 1);
    gl.clear((order.clears ? gl.COLOR_BUFFER_BIT : 0) | (has_depth ? gl.DEPTH_BUFFER_BIT : 0));
    gl.bindVertexArray(order.mesh ? order.mesh.array : this.nothing);
    if (order.mesh) gl.drawElements(gl.TRIANGLES, order.mesh.count, gl.UNSIGNED_INT, 0);
    else gl.drawArrays(gl.TRIANGLES, 0, order.count);
    if (buffer) gl.deleteFramebuffer(buffer);
    const fault = gl.getError();
    if (fault) this.failed?.(`WebGL's error ${fault} in ${order.key}`);
  }

  show(programs, images, uniforms) {
    const text = part => ({ ...part, text: part.before + part.after });
    const gles = () => ({ vertex: text(programs.vertex), fragment: text(programs.fragment) });
    this.draw({ key: "show", gles, images, uniforms, targets: [], clears: true, depth: "none", count: 3 });
  }

  async read(target) {
    const { gl } = this, { side } = target, buffer = this.bound([target]);
    const numbers = new Float32Array(4 * side * side);
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.FLOAT, numbers);
    gl.deleteFramebuffer(buffer);
    return numbers;
  }

  close() { this.failed = null; this.gl.getExtension("WEBGL_lose_context")?.loseContext(); }
}

const PLAYERS = { webgpu: WebGpuPlayer, webgl2: WebGl2Player };
