"""A room in Mitsuba 3, a path tracer: its G-buffer, and its picture by the exact law and by the functions that `plan` chooses.

    python mitsuba_room.py FRESNEL_GEN

Writes room.exr, room_first.exr, room_all.exr and room_first.csv beside this file. Needs `pip install mitsuba` (made with 3.9.1) and LLVM 15
or later; DRJIT_LIBLLVM_PATH names its library where it is not found.

The pictures of room_all.exr are drawn by Mitsuba's own path tracer, with the law in every bounce. Those of room_first.exr have the
chosen functions where the camera sees a surface, and the exact law in all later bounces, as `plan` assumes; Mitsuba's path tracer
follows the rays that leave these surfaces. Which way a path goes does not depend on the law, so that two pictures have the same noise.
"""

import json
import os
import re
import subprocess
import sys
import tempfile

import drjit as dr
import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

FRESNEL_GEN = os.path.abspath(sys.argv[1])
HERE = os.path.dirname(os.path.abspath(__file__))
SIZE, SAMPLES, TEXELS = 144, 1024, 1024
# By id, as room.toml says: material, roughness (perceptual), albedo under the surface.
MATERIALS = {
    1: ("gold", 0.4, None),
    2: ("silver", 0.0, None),
    3: ("bk7", 0.0, [0.05, 0.12, 0.3]),
    4: ("titanium", 0.2, None),
    5: ("water", 0.0, [0.25, 0.22, 0.18]),
}


def program(*arguments):
    ran = subprocess.run([FRESNEL_GEN, *arguments], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def exact_law(name):
    """The exact law of a material as a table over the cosine."""
    with tempfile.TemporaryDirectory() as folder:
        flags = f"--gamut clip --axis cos --size {TEXELS} --format exr-float -q --json -"
        said = json.loads(program("bake", "--material", name, *flags.split(), "--out-dir", folder))
        bitmap = mi.Bitmap(os.path.join(folder, said["rows"][0]["file"]))
    table = mi.Float(np.array(bitmap)[..., :3].astype(np.float32).ravel())

    def law(cosine):
        at = dr.clip(cosine, 0, 1) * (TEXELS - 1)
        first = dr.minimum(mi.UInt32(at), TEXELS - 2)
        part = at - mi.Float(first)
        both = [dr.gather(mi.Color3f, table, first + i) for i in (0, 1)]
        return both[0] * (1 - part) + both[1] * part

    return law


WORDS = {
    "clamp": dr.clip, "exp2": dr.exp2, "log2": dr.log2, "sqrt": dr.sqrt, "max": dr.maximum, "min": dr.minimum,
    "inversesqrt": dr.rsqrt, "pow": dr.power, "abs": dr.abs, "mix": dr.lerp,
    "vec3": lambda *parts: mi.Color3f(*parts),
}


def chosen_law(name, method):
    """An emitted function in GLSL ES, run line by line: assignments and a last line that returns."""
    text = program("--material", name, "--method", method, "--target", "gles", "-o", "-")
    body = text[text.index("{") + 1 : text.rindex("}")]
    body = re.sub(r"//.*", "", body)
    body = re.sub(r"\b(highp|const|float|vec3(?!\())\s+", "", body)
    lines = [line.strip() for line in body.split(";") if line.strip()]
    lines = [re.sub(r"^return\b", "result =", " ".join(line.split())) for line in lines]

    def law(cosine):
        names = {"cos_theta": cosine}
        for line in lines:
            exec(line, WORDS, names)
        return names["result"]

    return law


class Surface(mi.BSDF):
    """F L + (1 - F) O: a smooth or rough surface, above a diffuse body or none."""

    laws = {}

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.material = props["material"]
        self.alpha = props["roughness"] ** 2
        self.albedo = mi.Color3f(props["albedo"]) if "albedo" in props else None
        above = mi.BSDFFlags.DeltaReflection if self.alpha == 0 else mi.BSDFFlags.GlossyReflection
        flags = [above | mi.BSDFFlags.FrontSide]
        if self.albedo is not None:
            flags.append(mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.FrontSide)
        self.m_components = flags
        self.m_flags = int(np.bitwise_or.reduce([int(flag) for flag in flags]))
        self.distribution = mi.MicrofacetDistribution(mi.MicrofacetType.GGX, max(self.alpha, 1e-4), True)

    def law(self, cosine):
        return Surface.laws[self.material](cosine)

    def sample(self, ctx, si, sample1, sample2, active=True):
        cos_i = mi.Frame3f.cos_theta(si.wi)
        active &= cos_i > 0
        bs = dr.zeros(mi.BSDFSample3f)
        bs.eta = 1
        if self.alpha > 0:
            half, _ = self.distribution.sample(si.wi, sample2)
            bs.wo = mi.reflect(si.wi, half)
            bs.sampled_component = mi.UInt32(0)
            bs.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
            bs.pdf = self.pdf(ctx, si, bs.wo, active)
            weight = self.eval(ctx, si, bs.wo, active) / bs.pdf
            active &= (mi.Frame3f.cos_theta(bs.wo) > 0) & (bs.pdf > 0)
            return bs, dr.select(active, weight, 0)
        share = 1.0 if self.albedo is None else 0.5
        mirrored = sample1 < share
        bs.wo = dr.select(mirrored, mi.reflect(si.wi), mi.warp.square_to_cosine_hemisphere(sample2))
        diffuse_pdf = (1 - share) * mi.warp.square_to_cosine_hemisphere_pdf(bs.wo)
        bs.pdf = dr.select(mirrored, share, diffuse_pdf)
        bs.sampled_component = dr.select(mirrored, mi.UInt32(0), mi.UInt32(1))
        delta, diffuse = +mi.BSDFFlags.DeltaReflection, +mi.BSDFFlags.DiffuseReflection
        bs.sampled_type = dr.select(mirrored, mi.UInt32(delta), mi.UInt32(diffuse))
        reflected = self.law(cos_i)
        weight = reflected / share
        if self.albedo is not None:
            weight = dr.select(mirrored, weight, (1 - reflected) * self.albedo / (1 - share))
        return bs, dr.select(active, weight, 0)

    def eval(self, ctx, si, wo, active=True):
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active &= (cos_i > 0) & (cos_o > 0)
        value = mi.Color3f(0)
        if self.alpha > 0:
            half = dr.normalize(si.wi + wo)
            shape = self.distribution.eval(half) * smith(si.wi, wo, self.alpha) / (4 * cos_i)
            value = self.law(dr.dot(si.wi, half)) * shape
        elif self.albedo is not None:
            value = (1 - self.law(cos_i)) * self.albedo * cos_o / dr.pi
        return dr.select(active, value, 0)

    def pdf(self, ctx, si, wo, active=True):
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active &= (cos_i > 0) & (cos_o > 0)
        value = mi.Float(0)
        if self.alpha > 0:
            half = dr.normalize(si.wi + wo)
            value = self.distribution.pdf(si.wi, half) / (4 * dr.dot(wo, half))
        elif self.albedo is not None:
            value = 0.5 * mi.warp.square_to_cosine_hemisphere_pdf(wo)
        return dr.select(active, value, 0)

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def traverse(self, callback):
        pass

    def to_string(self):
        return f"Surface[{self.material}]"


def smith(wi, wo, alpha):
    """G2 of height-correlated Smith masking."""
    def slope(w):
        cos2 = dr.maximum(mi.Frame3f.cos_theta_2(w), 1e-8)
        return (dr.sqrt(1 + alpha**2 * (1 - cos2) / cos2) - 1) / 2

    return 1 / (1 + slope(wi) + slope(wo))


def directional_albedo(cosine, alpha, count=512):
    """What a rough surface with F = 1 reflects of light from everywhere."""
    view = np.stack([np.sqrt(1 - cosine**2), 0 * cosine, cosine], -1)[:, None]
    flat = view * [alpha, alpha, 1]
    flat /= np.linalg.norm(flat, axis=-1, keepdims=True)
    i = np.arange(count)
    turn, up = 2 * np.pi * ((i * 0.6180339887) % 1), (1 - (i + 0.5) / count) * (1 + flat[..., 2]) - flat[..., 2]
    across = np.sqrt(np.maximum(0, 1 - up**2))
    cap = np.stack([across * np.cos(turn), across * np.sin(turn), up], -1) + flat
    half = cap * [alpha, alpha, 1]
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    cos_h = (view * half).sum(-1)
    leaves = 2 * cos_h * half[..., 2] - view[..., 2]
    slope = lambda c: (np.sqrt(1 + alpha**2 * (1 - c * c) / np.maximum(c * c, 1e-12)) - 1) / 2
    weight = (1 + slope(view[..., 2])) / (1 + slope(view[..., 2]) + slope(np.maximum(leaves, 1e-9)))
    return np.where(leaves > 0, weight, 0).mean(-1)


def room():
    to, rgb = mi.ScalarTransform4f, lambda *colour: {"type": "rgb", "value": list(colour)}

    def body(identity, shape, place):
        material, roughness, albedo = MATERIALS[identity]
        bsdf = {"type": "surface", "material": material, "roughness": roughness}
        if albedo:
            bsdf["albedo"] = mi.ScalarColor3f(albedo)
        return {"type": shape, "to_world": place, "bsdf": bsdf}

    def lamp(place, target, size, colour):
        emitter = {"type": "area", "radiance": rgb(*colour)}
        where = to().look_at(origin=place, target=target, up=[0, 0, 1]).scale([*size, 1])
        return {"type": "rectangle", "to_world": where, "emitter": emitter}

    wall = {"type": "diffuse", "reflectance": rgb(0.5, 0.45, 0.4)}
    sensor = {
        "type": "perspective",
        "fov": 33,
        "to_world": to().look_at(origin=[0, 1.8, 6], target=[0, 0.35, 0], up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": SIZE, "height": SIZE, "rfilter": {"type": "box"}},
    }
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 8, "rr_depth": 100},
        "sensor": sensor,
        "floor": body(3, "rectangle", to().rotate([1, 0, 0], -90).scale(6)),
        "statue": body(1, "sphere", to().translate([-1.15, 0.8, 0]).scale(0.8)),
        "mirror": body(2, "sphere", to().translate([0.75, 0.75, -0.4]).scale(0.75)),
        "drum": body(4, "sphere", to().translate([0, 0.35, 1.3]).scale(0.35)),
        "drop": body(5, "sphere", to().translate([1.05, 0.4, 1.1]).scale(0.4)),
        "back": {"type": "rectangle", "to_world": to().translate([0, 2, -4]).scale(6), "bsdf": wall},
        "window": lamp([-4, 4, 3], [0, 0, 0], [1.3, 1.3], [7, 6.6, 6]),
        "lamp": lamp([4, 3, 2], [0, 0.5, 0], [0.5, 1.2], [5, 6.5, 9]),
        "sky": {"type": "constant", "radiance": rgb(0.18, 0.22, 0.28)},
    }


SHAPES = {"statue": 1, "mirror": 2, "floor": 3, "drum": 4, "drop": 5}


def ids_of(scene, si):
    found = mi.UInt32(0)
    for shape in scene.shapes():
        identity = SHAPES.get(shape.id(), 0)
        found = dr.select(si.is_valid() & (si.shape == mi.ShapePtr(shape)), identity, found)
    return dr.select(mi.Frame3f.cos_theta(si.wi) > 0, found, 0)


def light_and_other(scene, sampler, si, ids):
    """Radiance along the mirrored direction, or around it by visible half vectors, and from the body; and h·v."""
    light, other, weight = mi.Color3f(0), mi.Color3f(0), mi.Float(1)
    direction, cos_half = mi.reflect(si.wi), mi.Frame3f.cos_theta(si.wi)
    sample = sampler.next_2d()
    for identity, (_, roughness, _) in MATERIALS.items():
        if roughness > 0:
            distribution = mi.MicrofacetDistribution(mi.MicrofacetType.GGX, roughness**2, True)
            half, _ = distribution.sample(si.wi, sample)
            rough = mi.reflect(si.wi, half)
            is_this = ids == identity
            direction = dr.select(is_this, rough, direction)
            cos_half = dr.select(is_this, dr.dot(si.wi, half), cos_half)
            slope = smith(si.wi, rough, roughness**2) / smith(si.wi, mi.Vector3f(0, 0, 1), roughness**2)
            weight = dr.select(is_this, slope, weight)
    weight = dr.select(mi.Frame3f.cos_theta(direction) > 0, weight, 0)
    active = (ids > 0) & (weight > 0)
    follow = lambda wo, active: scene.integrator().sample(scene, sampler, si.spawn_ray(si.to_world(wo)), None, active)[0]
    light = dr.select(active, follow(direction, active) * weight, 0)
    below = mi.warp.square_to_cosine_hemisphere(sampler.next_2d())
    for identity, (_, _, albedo) in MATERIALS.items():
        if albedo:
            is_this = ids == identity
            other = dr.select(is_this, follow(below, is_this) * mi.Color3f(albedo), other)
    return light, other, cos_half


def samples(scene, first_seed):
    """What each sample of each pixel shows: id, cosine, light, other, h·v."""
    index = dr.arange(mi.UInt32, SIZE * SIZE)
    corner = mi.Vector2f(mi.Float(index % SIZE), mi.Float(index // SIZE))
    sensor = scene.sensors()[0]

    def seen(within):
        ray, _ = sensor.sample_ray(0, 0.5, (corner + within) / SIZE, mi.Point2f(0.5))
        si = scene.ray_intersect(ray)
        return si, ids_of(scene, si)

    yield np.array(seen(mi.Point2f(0.5))[1])
    for number in range(SAMPLES):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(first_seed + number, SIZE * SIZE)
        si, ids = seen(sampler.next_2d())
        yield ids, mi.Frame3f.cos_theta(si.wi), *light_and_other(scene, sampler, si, ids)


def gbuffer(scene):
    """The means of each pixel's samples that show what its middle shows, row by row."""
    each = samples(scene, 1)
    middle = next(each)
    sums = np.zeros((SIZE * SIZE, 8))
    for ids, cosine, light, other, _ in each:
        columns = [cosine, *light, *other, mi.Float(1)]
        dr.eval(columns, ids)
        same = np.array(ids) == middle
        for k, column in enumerate(columns):
            sums[:, k] += np.where(same, np.array(column), 0)
    count = np.maximum(sums[:, 7], 1)
    means = sums / count[:, None]
    planes = {"cos_theta": means[:, 0], "material_id": middle, "coverage": sums[:, 7] / SAMPLES}
    roughness = np.zeros(SIZE * SIZE)
    for identity, (_, rough, _) in MATERIALS.items():
        is_this = middle == identity
        roughness[is_this] = rough
        if rough > 0:
            means[is_this, 1:4] /= directional_albedo(means[is_this, 0], rough**2)[:, None]
    planes["roughness"] = roughness
    for k, letter in enumerate("RGB"):
        planes[f"light.{letter}"], planes[f"other.{letter}"] = means[:, 1 + k], means[:, 4 + k]
    shown = middle > 0
    return {name: np.where(shown, plane, 0) for name, plane in planes.items()}


def write(file, planes):
    names = list(planes)
    samples = np.stack([planes[name].reshape(SIZE, SIZE) for name in names], -1).astype(np.float16)
    bitmap = mi.Bitmap(samples, mi.Bitmap.PixelFormat.MultiChannel, channel_names=names)
    bitmap.write(os.path.join(HERE, file))


def first_pictures(scene, exact, chosen):
    """Two pictures with one law or the other where the camera sees a surface. Walls and lamps are black."""
    each = samples(scene, SAMPLES + 1)
    next(each)
    sums = np.zeros((2, SIZE * SIZE, 3))
    for ids, cosine, light, other, cos_half in each:
        for k, laws in enumerate((exact, chosen)):
            colour = mi.Color3f(0)
            for identity, (name, _, _) in MATERIALS.items():
                shaded = laws[name](cos_half) * light + (1 - laws[name](cosine)) * other
                colour = dr.select(ids == identity, shaded, colour)
            dr.eval(colour)
            sums[k] += np.array(colour).T
    return sums / SAMPLES


def all_picture(laws):
    Surface.laws = laws
    return np.array(mi.render(mi.load_dict(room()), spp=SAMPLES, seed=7)).reshape(-1, 3)


def write_pictures(file, shown, exact, chosen):
    """The second picture as its difference from the first, which half precision holds to as many digits."""
    pictures = {"exact": np.where(shown, exact, 0), "change": np.where(shown, chosen - exact, 0)}
    write(file, {f"{name}.{letter}": both[:, k] for name, both in pictures.items() for k, letter in enumerate("RGB")})


def main():
    mi.register_bsdf("surface", Surface)
    names = [name for name, _, _ in MATERIALS.values()]
    exact = {name: exact_law(name) for name in names}
    Surface.laws = exact
    scene = mi.load_dict(room())
    planes = gbuffer(scene)
    write("room.exr", planes)
    flags = ["--gbuffer", os.path.join(HERE, "room.exr"), "--materials", os.path.join(HERE, "room.toml")]
    rows = json.loads(program("plan", *flags, "--json", "-"))["rows"]
    chosen = {row["material"]: chosen_law(row["material"], row["method"]) for row in rows}
    shown = (planes["material_id"] > 0)[:, None]
    write_pictures("room_first.exr", shown, *first_pictures(scene, exact, chosen))
    write_pictures("room_all.exr", shown, all_picture(exact), all_picture(chosen))
    with open(os.path.join(HERE, "room_first.csv"), "w") as file:
        file.write("material,method,seen\n")
        file.writelines(f"{row['material']},{row['method']},0\n" for row in rows)


main()
