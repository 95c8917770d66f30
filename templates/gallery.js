// The page: what is chosen, the texts put together from their parts, and what is said of both pictures.

const data = JSON.parse(document.getElementById("data").textContent);
const $ = id => document.getElementById(id);
const DRAG = 12, IDLE = 120;
const named = (list, name) => list.find(one => one.name === name);
const texts = new Map(data.functions.map(one => [one.name, one]));
// What the address asks for, behind ? or #.
const wanted = new URLSearchParams(location.search);
new URLSearchParams(location.hash.slice(1)).forEach((value, name) => wanted.set(name, value));
const figure = value => value && Math.abs(value) < 1e-4 ? value.toExponential(2) : String(Number(value.toPrecision(3)));
const OWN = "";

// What is unpacked once: textures' bytes, meshes, blocks of cameras, inputs of indices.
const unpacked_parts = {};
// The player, its images, and what was drawn last.
const stage = { panel: 380, player: null, images: {}, meshes: {}, targets: {}, drawn: null, is_drawing: false, is_stale: false };

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const floats = bytes => new Float32Array(bytes.buffer, 0, bytes.length / 4);

// A ball of radius 1: rows of rectangles between circles of latitude, two triangles each.
function ball(rows) {
  const columns = 2 * rows, vertices = [], indices = [];
  for (let row = 0; row <= rows; row++)
    for (let column = 0; column <= columns; column++) {
      const u = column / columns, v = row / rows;
      const [sin_u, cos_u, sin_v, cos_v] = [Math.sin(2 * Math.PI * u), Math.cos(2 * Math.PI * u), Math.sin(Math.PI * v), Math.cos(Math.PI * v)];
      const normal = [sin_u * sin_v, cos_v, -cos_u * sin_v];
      vertices.push(...normal, ...normal, cos_u, 0, sin_u, 1, u, v);
    }
  for (let row = 0; row < rows; row++)
    for (let column = 0; column < columns; column++) {
      const a = row * (columns + 1) + column, b = a + columns + 1;
      indices.push(a, a + 1, b, b, a + 1, b + 1);
    }
  return [new Float32Array(vertices), new Uint32Array(indices)];
}

async function unpack() {
  const { textures, meshes, orbits, own } = data, parts = unpacked_parts;
  parts.textures = await Promise.all(textures.map(async ({ size: [width], format, texels }) => {
    const bytes = await unpacked(texels), row = width * (format === "rgb9e5ufloat" ? 4 : 8);
    for (let i = row; i < bytes.length; i++) bytes[i] += bytes[i - row];
    return bytes;
  }));
  parts.meshes = await Promise.all(meshes.map(async mesh => {
    if (mesh.ball) return ball(mesh.ball);
    const vertices = floats(await unpacked(mesh.vertices));
    return [vertices, Uint32Array.from({ length: vertices.length / 12 }, (_, i) => i)];
  }));
  parts.orbits = await Promise.all(orbits.map(async orbit => floats(await unpacked(orbit.blocks))));
  parts.own = await Promise.all(own.map(async ({ inputs }) => {
    const each = Object.entries(inputs).map(async ([method, [count, packed]]) => [method, [count, floats(await unpacked(packed))]]);
    return Object.fromEntries(await Promise.all(each));
  }));
}

// The texts, put together as fresnel-gen does it.

const all_texts = (names, language) => [...new Set(names)].map(name => texts.get(name)[language]).join("");

function module_text(row, calls) {
  return all_texts([...row.functions, ...calls.functions], "wgsl") + data.frame + calls.wgsl + row.text;
}

function program_text(row, calls, part) {
  const names = [...part.functions];
  if (part.calls) names.push(...calls.functions, ...row.functions.filter(name => calls.gles.includes(name + "(")));
  return part.before + all_texts(names, "gles") + (part.calls ? calls.gles : "") + part.after;
}

// What is chosen.

const row = () => named(data.rows, $("effect").value);
const is_transparent = one => one.transparent;
const own_index = one => data.own.findIndex(own => own.transparent === is_transparent(one));
const calls_of = (one, method) => one.calls.map(index => data.calls[index]).find(calls => calls.method === method);
const grid_value = ([first, step], place) => first + step * place;

function material() {
  return $("material").value === OWN ? null : named(data.materials, $("material").value);
}

// The values of a method's inputs: of the material, or of the index on the sliders. None where the method has none for it.
function inputs_of(one, method) {
  const chosen = material();
  if (chosen) return chosen.inputs[method];
  const place = own_index(one), own = data.own[place], found = unpacked_parts.own[place][method];
  if (!found) return undefined;
  const [count, values] = found;
  const at = (Number($("n").value) * own.k[2] + Number($("k").value)) * count;
  return Array.from({ length: count }, (_, i) => Array(3).fill(values[at + i]));
}

function index_of(one) {
  const chosen = material();
  if (chosen) return one.disperses ? chosen : { ...chosen, n: Array(3).fill(chosen.n[1]) };
  const own = data.own[own_index(one)];
  const n = Array(3).fill(grid_value(own.n, Number($("n").value))), k = Array(3).fill(grid_value(own.k, Number($("k").value)));
  return { n, k, absorption: [0, 0, 0] };
}

function block(one, pass, method) {
  const { layout } = data, orbit = data.orbits[one.orbit], numbers = new Float32Array(layout.size);
  const place = (pass.view * orbit.elevations.length + Number($("elevation").value)) * orbit.azimuths + Number($("azimuth").value);
  numbers.set(unpacked_parts.orbits[one.orbit].subarray(place * orbit.numbers, (place + 1) * orbit.numbers));
  const { n, k, absorption } = index_of(one);
  numbers.set(n, layout.index);
  numbers.set(k, layout.index + 4);
  numbers.set(absorption, layout.absorption);
  inputs_of(one, method).forEach((value, i) => numbers.set(value, layout.inputs + 4 * i));
  if (one.film) numbers[layout.film] = Number($("film").value);
  if (one.roughness) numbers[layout.roughness] = Number($("roughness").value);
  if (one.half) numbers.set([2 * one.half / stage.panel / data.samples, 2 * one.half / stage.panel], layout.pixel);
  return numbers;
}

// Drawing.

function target(name, pass) {
  const side = stage.panel * data.samples;
  stage.targets[name] ??= stage.player.target(pass.side ?? (pass.margin ? side + 2 * Math.floor(side / data.margin) : side));
  return stage.targets[name];
}

// Draws the row by a method; the picture is kept under this name.
function play(one, method, name) {
  const calls = calls_of(one, method), written = new Set();
  // What a pass writes first says how large it is.
  const image = (slot, pass) => stage.images[one.images[slot]] ?? target(slot === "Colour" ? name : one.name + " " + slot, pass);
  one.passes.forEach((pass, i) => {
    const programs = one.programs[i];
    const compiled = part => ({ ...part, text: program_text(one, calls, part) });
    const clears = !pass.writes.some(slot => written.has(slot));
    pass.writes.forEach(slot => written.add(slot));
    stage.player.draw({
      key: stage.player.name === "WebGPU" ? one.name + " " + method : `${one.name} ${method} ${i}`,
      wgsl: () => module_text(one, calls),
      gles: () => ({ vertex: compiled(programs.vertex), fragment: compiled(programs.fragment) }),
      vertex: pass.vertex, fragment: pass.fragment, depth: pass.depth, clears,
      uniforms: block(one, pass, method),
      targets: pass.writes.map(slot => image(slot, pass)), images: pass.reads.map(slot => image(slot)),
      mesh: stage.meshes[pass.mesh] ?? null, count: pass.count, adds: pass.adds,
    });
  });
  return stage.targets[name];
}

async function draw() {
  const one = row(), method = $("method").value;
  stage.drawn = null;
  if (!stage.player) return;
  const chosen = play(one, method, "chosen"), exact = play(one, one.exact, "exact");
  const shown = [stage.panel, data.samples, 2 ** Number($("exposure").value), 2 ** Number($("magnification").value)];
  stage.player.show(data.show, [chosen, exact], new Float32Array(shown));
  stage.drawn = { chosen, exact };
}

// The mean and the largest difference over the pixels of the body.
function apart(chosen, exact) {
  let [sum, most, count] = [0, 0, 0];
  for (let i = 0; i < chosen.length; i += 4) {
    if (exact[i + 3] <= 0) continue;
    for (let channel = i; channel < i + 3; channel++) {
      const difference = Math.abs(chosen[channel] - exact[channel]);
      sum += difference;
      most = Math.max(most, difference);
    }
    count += 3;
  }
  return { mean: sum / Math.max(count, 1), most };
}

async function measure() {
  const { player, drawn } = stage;
  if (!drawn) return;
  const [chosen, exact] = [await player.read(drawn.chosen), await player.read(drawn.exact)];
  if (stage.drawn !== drawn) return;
  const { mean, most } = apart(chosen, exact);
  say(`${subject()} by ${$("method").value}, drawn by ${player.name}. Difference from ${row().exact_is}, in linear light: mean ${figure(mean)}, largest ${figure(most)}.`);
}

const subject = () => `${row().name}, ${material()?.name ?? "an index of your own"}`;

let timer = 0;
function say(text) { $("status").textContent = text; }

// Draws once for all changes that come together, and tells of it once they rest.
async function redraw() {
  stage.is_stale = true;
  if (stage.is_drawing) return;
  stage.is_drawing = true;
  clearTimeout(timer);
  try {
    while (stage.is_stale) {
      stage.is_stale = false;
      await draw();
    }
    timer = setTimeout(() => measure().catch(failed), IDLE);
  } catch (fault) { failed(fault); }
  stage.is_drawing = false;
}

// What one backend cannot draw another may, unless the reader asked for that one.
async function failed(fault) {
  if (stage.player?.name === "WebGPU" && $("backend").value === "auto") {
    await open_player(["webgl2"]);
    return redraw();
  }
  say(`${stage.player?.name ?? "Nothing"} cannot draw ${subject()}: ${fault.message ?? fault}`);
}

// The player that is asked for, or the first that is here.
async function open_player(only) {
  stage.player?.close();
  Object.assign(stage, { player: null, images: {}, meshes: {}, targets: {}, drawn: null });
  const wish = $("backend").value, names = only ?? (wish === "auto" ? ["webgpu", "webgl2"] : [wish]);
  for (const name of names) {
    const old = $("panels"), canvas = old.cloneNode();
    old.replaceWith(canvas);
    listen_to_drags(canvas);
    stage.player = await PLAYERS[name].open(canvas).catch(() => null);
    if (stage.player) break;
  }
  $("panels").hidden = !stage.player;
  if (!stage.player) {
    say(`Nothing is drawn: this browser offers ${wish === "auto" ? "neither WebGPU nor WebGL 2" : $("backend").selectedOptions[0].text + " not"} with pictures of floats. Functions, errors and costs stand below.`);
    return;
  }
  stage.player.failed = failed;
  data.textures.forEach((texture, i) => { stage.images[texture.name] = stage.player.texture(texture, unpacked_parts.textures[i]); });
  data.meshes.forEach((mesh, i) => { stage.meshes[mesh.name] = stage.player.mesh(...unpacked_parts.meshes[i]); });
}

// The lists and what stands beside them.

function fill(select, options, chosen) {
  select.textContent = "";
  for (const { value, text, disabled } of options) {
    const option = new Option(text, value, false, value === chosen);
    option.disabled = !!disabled;
    select.add(option);
  }
}

function range(id, count, value) {
  Object.assign($(id), { min: 0, max: count - 1, step: 1 });
  $(id).value = value;
}

function fill_row() {
  const one = row(), orbit = data.orbits[one.orbit], own = data.own[own_index(one)];
  const suited = data.materials.filter(other => one.materials.includes(other.name));
  const first = named(suited, one.material) ?? suited[0];
  const sliders = one.film ? [] : [{ value: OWN, text: "index of the sliders" }];
  fill($("material"), [...sliders, ...suited.map(({ name, summary }) => ({ value: name, text: `${name}: ${summary}` }))], first?.name ?? OWN);
  range("n", own.n[2], 0);
  range("k", own.k[2], 0);
  $("n-part").hidden = one.film;
  $("k-part").hidden = one.film || is_transparent(one);
  $("film-part").hidden = !one.film;
  $("roughness-part").hidden = !one.roughness;
  if (one.roughness) $("roughness").value = one.roughness;
  $("exposure").value = one.exposure;
  for (const id of ["azimuth", "elevation"]) $(id + "-part").hidden = orbit.azimuths === 1;
  range("azimuth", orbit.azimuths, 0);
  range("elevation", orbit.elevations.length, orbit.first);
  fill_methods(one.method);
  follow_material();
}

function fill_methods(wish) {
  const one = row(), has = method => !!inputs_of(one, method);
  const chosen = has(wish) ? wish : one.exact;
  fill($("method"), one.calls.map(index => data.calls[index].method).map(method => ({ value: method, text: method + (has(method) ? "" : " (not for this body)"), disabled: !has(method) })), chosen);
}

// The sliders of the index go to where the material has it.
function follow_material() {
  const chosen = material(), own = data.own[own_index(row())];
  const nearest = ([first, step, count], value) => Math.min(Math.max(Math.round((value - first) / step), 0), count - 1);
  if (row().film) Object.assign($("film"), { max: chosen.film_nm, step: chosen.film_nm / 100 }).value = chosen.film_nm;
  if (chosen) {
    $("n").value = nearest(own.n, chosen.n[1]);
    $("k").value = nearest(own.k, chosen.k[1]);
  }
}

function tell_values() {
  const one = row(), own = data.own[own_index(one)], chosen = material(), orbit = data.orbits[one.orbit];
  const value = (id, text) => {
    $(id + "-value").textContent = text;
    $(id).setAttribute("aria-valuetext", text);
  };
  value("n", figure(chosen ? chosen.n[1] : grid_value(own.n, Number($("n").value))) + (chosen ? " (green)" : ""));
  value("k", figure(chosen ? chosen.k[1] : grid_value(own.k, Number($("k").value))) + (chosen ? " (green)" : ""));
  value("film", figure(Number($("film").value)));
  value("roughness", $("roughness").value);
  value("magnification", String(2 ** Number($("magnification").value)));
  value("exposure", $("exposure").value);
  value("azimuth", String(Number($("azimuth").value) * 360 / orbit.azimuths));
  value("elevation", String(orbit.elevations[Number($("elevation").value)]));
  const method = $("method").value, factor = 2 ** Number($("magnification").value);
  $("left").textContent = method;
  $("middle").textContent = `${one.exact}, ${one.exact_is}`;
  $("right").textContent = `difference × ${factor}; white is ${figure(1 / factor)}`;
  $("panels").setAttribute("aria-label", `${subject()}. Three panels: by ${method}; by ${one.exact_is}, ${one.exact}; their difference, times ${factor}.`);
}

function rows_of(body, rows) {
  body.textContent = "";
  for (const [name, value] of rows) {
    const line = body.insertRow(), head = document.createElement("th");
    head.scope = "row";
    head.textContent = name;
    line.append(head);
    line.insertCell().textContent = value;
  }
}

function tell_figures() {
  const one = row(), method = $("method").value, chosen = material(), place = Number($("cost").value);
  const errors = chosen?.errors[method];
  $("error-caption").textContent = `${method} for ${subject().split(", ")[1]}`;
  $("error-method").textContent = method;
  rows_of($("errors"), data.errors.map(([, title], i) => [title, errors?.[i] == null ? (chosen ? "not known" : "only of materials") : figure(errors[i])]));
  $("cost-caption").textContent = `Library functions, three channels: ${data.costs[place][1]}`;
  const cost = name => named(data.methods, name).costs[place];
  rows_of($("costs"), [...new Set([method, one.exact])].map(name => [name, cost(name) == null ? "not recorded" : figure(cost(name))]));
  const known = named(data.methods, method), exit = calls_of(one, method).exit;
  $("about").textContent = `At first: ${one.summary[0].toLowerCase()}${one.summary.slice(1)}. Wrong by design: ${one.wrong}.`
    + (exit ? ` Light that leaves the body: by ${exit}, since only an index says where it is reflected totally.` : "");
  $("about-method").textContent = `${method}: ${known.summary}.` + (known.fails ? ` It fails: ${known.fails}.` : "") + ` ${known.source}`;
}

function fill_functions() {
  const one = row(), own = calls_of(one, $("method").value).functions, before = $("function").value;
  const names = [...new Set([...own, ...one.functions])];
  fill($("function"), names.map(name => ({ value: name, text: name })), one.functions.includes(before) ? before : names[0]);
  tell_text();
}

function tell_text() {
  $("text").textContent = texts.get($("function").value)[$("language").value].trim() + "\n";
  $("copied").textContent = "";
}

const copy = () => copy_text($("text").textContent, "copy", "copied", $("function").value);

async function copy_text(text, button, told, what) {
  let is_done = await navigator.clipboard?.writeText(text).then(() => true, () => false);
  if (!is_done) {
    const field = document.body.appendChild(document.createElement("textarea"));
    field.value = text;
    field.select();
    is_done = document.execCommand("copy");
    field.remove();
    $(button).focus();
  }
  $(told).textContent = is_done ? `${what} is copied.` : "The browser does not allow it; select the text and copy it.";
}

// Dragging turns what the sliders turn.
function listen_to_drags(canvas) {
  let last = null;
  canvas.addEventListener("pointerdown", event => { last = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointerup", () => { last = null; });
  canvas.addEventListener("pointermove", event => {
    if (!last) return;
    const steps = [event.clientX - last[0], event.clientY - last[1]].map(distance => Math.trunc(distance / DRAG));
    if (!steps[0] && !steps[1]) return;
    last = [last[0] + steps[0] * DRAG, last[1] + steps[1] * DRAG];
    const { azimuths } = data.orbits[row().orbit];
    $("azimuth").value = (Number($("azimuth").value) - steps[0] % azimuths + azimuths) % azimuths;
    $("elevation").value = Number($("elevation").value) + steps[1];
    refresh();
  });
}

function refresh() {
  tell_values();
  tell_figures();
  redraw();
}

async function changed(event) {
  const { id } = event.target, method = $("method").value;
  if (id === "effect") fill_row();
  if (id === "n" || id === "k") $("material").value = OWN;
  if (id === "material") follow_material();
  if (["n", "k", "material"].includes(id)) fill_methods(method);
  if (["effect", "method", "n", "k", "material"].includes(id)) fill_functions();
  if (id === "backend") await open_player();
  if (material() && material().name !== picked.name) { picked.name = material().name; tell_card(); }
  write_address();
  refresh();
}

async function begin() {
  fill($("effect"), data.rows.map(({ name }) => ({ value: name, text: name.replaceAll("_", " ") })), wanted.get("effect") ?? data.rows[0].name);
  fill($("backend"), [["auto", "WebGPU, else WebGL 2"], ["webgpu", "WebGPU"], ["webgl2", "WebGL 2"]].map(([value, text]) => ({ value, text })), wanted.get("backend") ?? "auto");
  fill($("cost"), data.costs.map(([name, title], i) => ({ value: String(i), text: name === "time" ? title : name })), String(Math.max(data.costs.findIndex(([name]) => name === "rdna2"), 0)));
  if (typeof DecompressionStream === "undefined") return say("This browser cannot unpack the page: it knows no DecompressionStream.");
  await unpack();
  const asked = named(data.materials, wanted.get("material")), shows = one => one.materials.includes(asked.name);
  if (!row()) $("effect").selectedIndex = 0;
  if (asked && !wanted.has("effect") && data.rows.some(shows)) $("effect").value = data.rows.find(shows).name;
  fill_row();
  // What is seen first differs from the exact law.
  if (!wanted.has("effect") && !wanted.has("method") && !asked) fill_methods("schlick_ior");
  if (asked && shows(row())) { $("material").value = asked.name; follow_material(); fill_methods($("method").value); }
  if (wanted.has("method")) fill_methods(wanted.get("method"));
  if (!asked && wanted.has("n") && !$("n-part").hidden) $("material").value = OWN;
  for (const id of [...HELD, ...(material() ? [] : ["n", "k"])]) if (wanted.has(id)) $(id).value = wanted.get(id);
  if (!material()) fill_methods(wanted.get("method") ?? $("method").value);
  const ignored = ["effect", "method", "material", "backend"].filter(id => wanted.has(id) && $(id).value !== wanted.get(id));
  $("ignored").textContent = ignored.map(id => `The page's address asks for ${id} ${wanted.get(id)}, which is not to be had here.`).join(" ");
  fill_functions();
  begin_pick();
  if (wanted.has("lines") && $("lines").value !== wanted.get("lines")) $("ignored").textContent += ` It asks for lines ${wanted.get("lines")}, which are not to be had here.`;
  await open_player();
  $("choice").addEventListener("input", event => changed(event).catch(failed));
  $("cost").addEventListener("input", tell_figures);
  for (const id of ["function", "language"]) $(id).addEventListener("input", tell_text);
  $("copy").addEventListener("click", copy);
  refresh();
}

const begun = begin().catch(failed);
