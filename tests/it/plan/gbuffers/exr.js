// Writes an OpenEXR file with channels of any names: one part, scan lines, ZIP over sixteen lines.
// What it writes is described in https://openexr.com/en/latest/OpenEXRFileLayout.html.

const TYPES = { uint: 0, half: 1, float: 2 };

// binary16 of a number, rounded to the nearest, ties to even.
function half(value) {
  const bits = new Uint32Array(new Float32Array([value]).buffer)[0];
  const sign = (bits >>> 16) & 0x8000, magnitude = Math.abs(value);
  if (Number.isNaN(value)) return 0x7e00;
  if (magnitude >= 65520) return sign | 0x7c00;
  const exponent = magnitude < 2 ** -14 ? -14 : Math.floor(Math.log2(magnitude));
  const scaled = magnitude / 2 ** (exponent - 10);
  let whole = Math.floor(scaled);
  if (scaled - whole > 0.5 || (scaled - whole === 0.5 && whole % 2 === 1)) whole++;
  // A carry into the next exponent is right as it is.
  return sign | (whole < 1024 ? whole : ((exponent + 15) << 10) + (whole - 1024));
}

// Little-endian bytes of a row of samples.
function row_bytes(type, samples) {
  const bytes = new DataView(new ArrayBuffer(samples.length * (type === "half" ? 2 : 4)));
  samples.forEach((sample, i) => {
    if (type === "half") bytes.setUint16(2 * i, half(sample), true);
    else if (type === "float") bytes.setFloat32(4 * i, sample, true);
    else bytes.setUint32(4 * i, sample, true);
  });
  return new Uint8Array(bytes.buffer);
}

// Bytes of even places, then those of odd places, each less the one before: what ZIP compresses.
async function zipped(bytes) {
  const half_way = (bytes.length + 1) >> 1, apart = new Uint8Array(bytes.length);
  bytes.forEach((byte, i) => { apart[i % 2 ? half_way + (i >> 1) : i >> 1] = byte; });
  const steps = apart.map((byte, i) => (i ? byte - apart[i - 1] + 128 : byte));
  const stream = new Blob([steps]).stream().pipeThrough(new CompressionStream("deflate"));
  const packed = new Uint8Array(await new Response(stream).arrayBuffer());
  return packed.length < bytes.length ? packed : bytes;
}

function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => { all.set(part, at); return at + part.length; }, 0);
  return all;
}

const words = text => new TextEncoder().encode(text + "\0");
const ints = (...numbers) => new Uint8Array(new Int32Array(numbers).buffer);
const floats = (...numbers) => new Uint8Array(new Float32Array(numbers).buffer);
const attribute = (name, type, value) => joined([words(name), words(type), ints(value.length), value]);

// `channels`: a list of { name, type: "half", "float" or "uint", samples }, samples row by row from the top left.
export async function exr_file(width, height, channels) {
  const sorted = [...channels].sort((a, b) => (a.name < b.name ? -1 : 1));
  const list = sorted.map(channel => joined([words(channel.name), ints(TYPES[channel.type], 0, 1, 1)]));
  const window = ints(0, 0, width - 1, height - 1);
  const header = joined([
    new Uint8Array([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]),
    attribute("channels", "chlist", joined([...list, new Uint8Array(1)])),
    attribute("compression", "compression", new Uint8Array([3])),
    attribute("dataWindow", "box2i", window),
    attribute("displayWindow", "box2i", window),
    attribute("lineOrder", "lineOrder", new Uint8Array([0])),
    attribute("pixelAspectRatio", "float", floats(1)),
    attribute("screenWindowCenter", "v2f", floats(0, 0)),
    attribute("screenWindowWidth", "float", floats(1)),
    new Uint8Array(1),
  ]);
  const chunks = [];
  for (let top = 0; top < height; top += 16) {
    const rows = [];
    for (let y = top; y < Math.min(top + 16, height); y++)
      for (const { type, samples } of sorted) rows.push(row_bytes(type, samples.slice(y * width, (y + 1) * width)));
    const packed = await zipped(joined(rows));
    chunks.push(joined([ints(top, packed.length), packed]));
  }
  const offsets = new DataView(new ArrayBuffer(8 * chunks.length));
  chunks.reduce((at, chunk, i) => {
    offsets.setUint32(8 * i, at, true);
    return at + chunk.length;
  }, header.length + 8 * chunks.length);
  return joined([header, new Uint8Array(offsets.buffer), ...chunks]);
}
