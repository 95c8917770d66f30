// Runs in the page after its own script, does what a reader does, and leaves in the page what was seen. The page's load waits for it: a
// document that is being written delays it.
{
  const told = { rows: {}, changes: {} };
  const hold = document.body.appendChild(document.createElement("iframe"));
  hold.hidden = true;
  hold.contentDocument.open();

  const wait = () => new Promise(next => setTimeout(next, 5));
  const shown = async () => {
    do await wait(); while (stage.is_drawing || stage.is_stale);
    clearTimeout(timer);
    await measure();
    return $("status").textContent;
  };
  const choose = async (id, value) => {
    $(id).value = value;
    $(id).dispatchEvent(new Event("input", { bubbles: true }));
    return shown();
  };
  // What an arrow key does to a slider.
  const step = async id => {
    $(id).stepUp();
    $(id).dispatchEvent(new Event("input", { bubbles: true }));
    return shown();
  };
  // The left panel: means of the samples of each pixel, three channels.
  const picture = async () => {
    const samples = await stage.player.read(stage.drawn.chosen), side = stage.panel, each = data.samples;
    const pixels = new Float32Array(3 * side * side);
    for (let y = 0; y < side * each; y++)
      for (let x = 0; x < side * each; x++)
        for (let channel = 0; channel < 3; channel++)
          pixels[3 * (Math.floor(y / each) * side + Math.floor(x / each)) + channel] += samples[4 * (y * side * each + x) + channel] / each / each;
    const bytes = new Uint8Array(pixels.buffer);
    return btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(""));
  };
  const cells = id => [...document.querySelectorAll(`#${id} td`)].map(cell => cell.textContent);

  async function all_rows() {
    for (const one of data.rows) {
      const status = await choose("effect", one.name);
      told.rows[one.name] = { status, picture: await picture(), label: $("panels").getAttribute("aria-label") };
    }
  }

  async function changes() {
    const seen = async name => { told.changes[name] = { status: $("status").textContent, picture: await picture() }; };
    await choose("effect", "complex_f0");
    await seen("gold_schlick");
    told.errors = cells("errors");
    told.costs = cells("costs");
    await choose("method", "conductor_exact");
    await seen("gold_exact");
    await choose("material", "silver");
    await seen("silver_exact");
    await step("n");
    told.own = $("material").selectedOptions[0].text;
    await seen("own_exact");
    await step("k");
    await seen("own_k");
    await step("azimuth");
    await seen("turned");
    await step("elevation");
    await seen("raised");
    await choose("effect", "ggx_specular");
    await seen("rough");
    await step("roughness");
    await seen("rougher");
    await choose("effect", "thin_film");
    await seen("film");
    await choose("film", String(Number($("film").max) / 3));
    await seen("thinner");
    await choose("method", "iridescence_khr");
    await seen("by_khr");
    await choose("method", "airy_materialx");
    await seen("by_materialx");
    await choose("effect", "ggx_specular");
    told.before = $("right").textContent;
    await step("magnification");
    told.after = $("right").textContent;
  }

  function controls() {
    const all = [...document.querySelectorAll("select, input, button, [tabindex]")];
    const name = one => one.labels?.[0]?.textContent || one.textContent || one.getAttribute("aria-label") || "";
    told.controls = all.length;
    told.unlabelled = all.filter(one => !name(one).trim()).map(one => one.outerHTML);
    const visible = all.filter(one => one.offsetParent);
    const reached = visible.filter(one => { one.focus(); return one.tabIndex === 0 && document.activeElement === one; });
    told.unreached = visible.filter(one => !reached.includes(one)).map(one => one.outerHTML);
    told.live = [...document.querySelectorAll("[aria-live]")].map(one => one.id);
  }

  async function copies() {
    const text = $("text").textContent, written = [];
    const clipboard = writeText => Object.defineProperty(navigator, "clipboard", { value: { writeText }, configurable: true });
    clipboard(async words => { written.push(words); });
    await copy();
    told.copied = [written[0] === text, $("copied").textContent];
    // Without a clipboard the text is selected and copied.
    clipboard(async () => { throw new Error("not allowed"); });
    let selected = "";
    document.execCommand = () => { selected = document.activeElement.value; return true; };
    await copy();
    told.selected = [selected === text, $("copied").textContent];
    $("language").value = "gles";
    $("language").dispatchEvent(new Event("input", { bubbles: true }));
    told.gles = [$("function").value, $("text").textContent];
  }

  // A material is searched, picked and copied, and the address follows.
  async function picks() {
    const balls = [...$("balls").children], written = [];
    $("search").value = "metal silver";
    $("search").dispatchEvent(new Event("input", { bubbles: true }));
    const found = balls.filter(ball => !ball.hidden).map(ball => ball.value);
    named_ball("silver").click();
    await shown();
    Object.defineProperty(navigator, "clipboard", { value: { writeText: async words => { written.push(words); } }, configurable: true });
    const lines = {};
    for (const option of $("lines").options) {
      $("lines").value = option.value;
      $("lines").dispatchEvent(new Event("input", { bubbles: true }));
      lines[option.value] = $("lines-text").textContent;
    }
    await copy_text($("lines-text").textContent, "copy-lines", "copied-lines", "silver");
    const address = location.hash, numbers = cells("card-numbers"), shows = $("material").value;
    named_ball("water").click();
    await shown();
    told.picks = { found, lines, address, numbers, shows, copied: written[0] === lines.filament, water: [$("effect").value, $("material").value, $("card-name").textContent] };
    $("search").value = "";
    $("search").dispatchEvent(new Event("input", { bubbles: true }));
  }
  const named_ball = name => [...$("balls").children].find(ball => ball.value === name);

  (async () => {
    try {
      await begun;
      await shown();
      stage.panel = 50;
      stage.targets = {};
      await all_rows();
      if (wanted.get("backend") === "webgl2") {
        await changes();
        await picks();
        controls();
        await copies();
      }
    } catch (fault) { faults.push(`${fault} ${fault.stack}`); }
    told.drawn_by = stage.player?.name ?? null;
    told.faults = faults;
    told.asked = performance.getEntriesByType("resource").map(one => one.name);
    const place = document.body.appendChild(document.createElement("pre"));
    place.id = "told";
    place.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(told))));
    hold.contentDocument.close();
    hold.remove();
  })();
}
