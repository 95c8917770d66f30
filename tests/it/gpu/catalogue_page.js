// Draws the function of the page with the bytes of the buffer as a texture, a pixel a cosine, and leaves the pixels of each row that is
// asked for. FRAGMENT, BYTES and ROWS are put in by the test.
const told = { rows: [] };
try {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("no float targets");
  const shader = (kind, text) => {
    const made = gl.createShader(kind);
    gl.shaderSource(made, text);
    gl.compileShader(made);
    if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
    return made;
  };
  const program = gl.createProgram();
  const corners = `#version 300 es
    void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
  gl.attachShader(program, shader(gl.VERTEX_SHADER, corners));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, FRAGMENT));
  gl.linkProgram(program);
  gl.useProgram(program);
  const texture = (unit, format, width, height, pixels) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, gl.RGBA, gl.FLOAT, pixels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return made;
  };
  const bytes = Uint8Array.from(atob(BYTES), (letter) => letter.charCodeAt(0)).buffer;
  texture(0, gl.RGBA32F, 4, bytes.byteLength / 64, new Float32Array(bytes));
  gl.uniform1i(gl.getUniformLocation(program, "catalogue"), 0);
  const width = ROWS.points;
  const target = texture(1, gl.RGBA32F, width, 1, null);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.viewport(0, 0, width, 1);
  for (const row of ROWS.rows) {
    gl.uniform1i(gl.getUniformLocation(program, "row"), row);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const pixels = new Float32Array(4 * width);
    gl.readPixels(0, 0, width, 1, gl.RGBA, gl.FLOAT, pixels);
    told.rows.push([...pixels]);
  }
} catch (fault) { faults.push(`${fault} ${fault.stack}`); }
told.faults = faults;
const place = document.body.appendChild(document.createElement("pre"));
place.id = "told";
place.textContent = btoa(JSON.stringify(told));
