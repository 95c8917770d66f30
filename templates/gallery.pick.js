// The first view: a material is picked, looked at in numbers, and copied as a function or as lines for an engine.

const SHIPPED = [["three", "three.js", "patch(material, NAME);"], ["babylon", "Babylon.js", "patch(material, NAME, BABYLON);"], ["playcanvas", "PlayCanvas", "patch(material, NAME, pc);"]];
const ADAPTERS = ["bevy", "godot", "materialx", "unity", "unreal"], FORMATS = ["blender", "gltf", "openpbr", "usd", "filament"];
const VECTORS = { wgsl: "vec3<f32>", gles: "vec3", hlsl: "float3" };
const picked = { name: null };

const in_code = value => { const text = String(Number(value.toPrecision(8))); return /[.e]/.test(text) ? text : text + ".0"; };
const colour = values => values.map(value => Number(value.toFixed(4))).join(", ");

// The function of a material: our fitted form, and a call of it with the material's coefficients.
function function_of(one, language) {
  const vector = VECTORS[language], own = texts.get("fresnel_" + one.method);
  if (!own) return `No fitted form follows ${one.name}. All functions: fresnel-gen --material ${one.argument} --target ${language}\n`;
  const values = one.inputs[one.method].map(value => `${vector}(${value.map(in_code).join(", ")})`);
  const body = `    return fresnel_${one.method}(cos_theta, ${values.join(", ")});\n}\n`;
  const head = language === "wgsl" ? `fn ${one.name}_reflectance(cos_theta: f32) -> ${vector} {\n` : `${vector} ${one.name}_reflectance(float cos_theta) {\n`;
  const said = `// ${one.name}: errs by at most ${figure(one.errors[one.method][0])}. A file holds fresnel_${one.method} once.\n`;
  return `${own[language].trim()}\n\n${said}${head}${body}`;
}

function lines_of(one, choice) {
  if (VECTORS[choice]) return function_of(one, choice);
  const shipped = SHIPPED.find(([name]) => name === choice);
  const command = `fresnel-gen --flavour ${choice} --material ${one.argument}`;
  if (shipped) return `// ${command} writes shaders-generated/${choice}/fresnel.js\nimport { patch } from "./fresnel.js";\n${shipped[2].replace("NAME", JSON.stringify(one.name))}\n`;
  return ADAPTERS.includes(choice) ? command + "\n" : `fresnel-gen materials params ${one.argument} --as ${choice}\n`;
}

function tell_lines() {
  const one = named(data.materials, picked.name);
  $("lines-text").textContent = one ? lines_of(one, $("lines").value) : "";
  $("copied-lines").textContent = "";
}

function tell_card() {
  const one = named(data.materials, picked.name);
  if (!one) return;
  for (const ball of $("balls").children) ball.setAttribute("aria-pressed", String(ball.value === one.name));
  $("card-name").textContent = one.name.replaceAll("_", " ");
  $("card-about").textContent = `${one.summary}. ${one.reference}`;
  rows_of($("card-numbers"), [
    ["F0", `${colour(one.f0)}  ${one.hex[0]}`], ["F82, at 81.79°", `${colour(one.f82)}  ${one.hex[1]}`],
    ["n of red, green, blue", colour(one.effective_n)], ["k", colour(one.effective_k)],
  ]);
  const errors = Object.entries(one.errors).filter(([, values]) => values[0] != null).sort((a, b) => a[1][0] - b[1][0]);
  rows_of($("card-errors"), errors.map(([method, values]) => [method + (method === one.method ? " (in adapters)" : ""), figure(values[0])]));
  tell_lines();
}

const can = one => one.materials.includes(picked.name);
// What a link holds besides: sliders as they stand.
const HELD = ["film", "roughness", "azimuth", "elevation", "magnification", "exposure"];

// Shows a picked material by the effect that is chosen, or by the first that can.
function pick(name) {
  picked.name = name;
  const effect = can(row()) ? row() : data.rows.find(can);
  if (effect) {
    if (effect !== row()) { $("effect").value = effect.name; fill_row(); }
    const method = $("method").value;
    $("material").value = name;
    follow_material();
    fill_methods(method);
    fill_functions();
    refresh();
  }
  tell_card();
  write_address();
}

function search() {
  const words = $("search").value.toLowerCase().split(/\s+/).filter(Boolean);
  let found = 0;
  for (const ball of $("balls").children) {
    const { name, summary, kind } = named(data.materials, ball.value), text = `${name.replaceAll("_", " ")} ${name} ${summary} ${kind}`.toLowerCase();
    ball.hidden = !words.every(word => text.includes(word));
    if (!ball.hidden) found++;
  }
  $("found").textContent = `${found} of ${data.materials.length}`;
}

// The address after # says what is chosen, so that a link shows it again.
function write_address() {
  const said = new URLSearchParams({ effect: $("effect").value, method: $("method").value });
  const shown = id => !$(id + "-part")?.hidden, held = material() ? HELD : [...HELD, "n", "k"];
  if (material() ?? (picked.name && !can(row()))) said.set("material", picked.name);
  for (const id of held) if (shown(id)) said.set(id, $(id).value);
  said.set("lines", $("lines").value);
  try { history.replaceState(null, "", "#" + said); } catch { /* a page in a frame may not */ }
}

function begin_pick() {
  for (const { name, colours, summary } of data.materials) {
    const ball = document.createElement("button"), stops = colours.map(([at, hex]) => `${hex} ${at}%`);
    Object.assign(ball, { type: "button", value: name, title: summary });
    const disc = ball.appendChild(document.createElement("span"));
    disc.className = "ball";
    disc.style.background = `radial-gradient(closest-side, ${stops.join(", ")})`;
    ball.append(name.replaceAll("_", " "));
    ball.addEventListener("click", () => pick(name));
    $("balls").append(ball);
  }
  const languages = [["wgsl", "WGSL, a function"], ["gles", "GLSL ES 3.00, a function"], ["hlsl", "HLSL, a function"]];
  const others = [...SHIPPED.map(([name, title]) => [name, title]), ...[...ADAPTERS, ...FORMATS].map(name => [name, name])];
  fill($("lines"), [...languages, ...others].map(([value, text]) => ({ value, text })), wanted.get("lines") ?? "wgsl");
  if (!$("lines").value) $("lines").selectedIndex = 0;
  $("search").addEventListener("input", search);
  $("lines").addEventListener("input", () => { tell_lines(); write_address(); });
  $("copy-lines").addEventListener("click", () => copy_text($("lines-text").textContent, "copy-lines", "copied-lines", `${picked.name} for ${$("lines").value}`));
  addEventListener("hashchange", () => location.reload());
  search();
  // What the address asks for, or what is drawn first.
  const asked = named(data.materials, wanted.get("material"));
  picked.name = (asked ?? material() ?? data.materials[0]).name;
  tell_card();
}
