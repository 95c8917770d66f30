"""Measures F of films in Cycles of Blender 5 and rewrites the last three columns of cycles_films.csv, which lies beside this file.

    python3.11 -m venv bpy && bpy/bin/pip install bpy==5.0.1 && bpy/bin/python cycles_films.py

Each row is one flat mirror, tilted by its angle, in a picture one pixel high: its mirror ray meets the white world alone. Roughness 0, one
sample, the narrowest filter, raw floats.
"""
import csv, math, os, tempfile
import bpy
import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
PATH = os.path.join(HERE, "cycles_films.csv")
LENGTH = 40.0

with open(PATH) as file:
    note = file.readline()
    rows = list(csv.DictReader(file))

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="cycles")
scene = bpy.context.scene
scene.render.engine = "CYCLES"
cycles, render = scene.cycles, scene.render
cycles.device, cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = "CPU", 1, False, False
cycles.pixel_filter_type, cycles.filter_width, cycles.blur_glossy = "BOX", 0.01, 0
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
render.resolution_x, render.resolution_y, render.resolution_percentage = len(rows), 1, 100
render.filepath = os.path.join(tempfile.mkdtemp(), "films.exr")
scene.view_settings.view_transform = "Raw"
world = bpy.data.worlds.new("white")
scene.world = world
world.use_nodes = True
background = world.node_tree.nodes["Background"]
background.inputs["Color"].default_value = (1, 1, 1, 1)


def material(row):
    made = bpy.data.materials.new("film")
    made.use_nodes = True
    nodes = made.node_tree.nodes
    a, b = ([float(row[f"{part}_{name}"]) for name in ("red", "green", "blue")] for part in "ab")
    if row["base"] == "conductor":
        node = nodes.new("ShaderNodeBsdfMetallic")
        node.fresnel_type = "PHYSICAL_CONDUCTOR"
        made.node_tree.links.new(node.outputs[0], nodes["Material Output"].inputs["Surface"])
        given = {"IOR": a, "Extinction": b}
    else:
        node = nodes["Principled BSDF"]
        if row["base"] == "tinted":
            given = {"Metallic": 1, "Base Color": (*a, 1), "Specular Tint": (*b, 1)}
        else:
            given = {"Metallic": 0, "Base Color": (0, 0, 0, 1), "IOR": a[0]}
    given |= {"Roughness": 0, "Thin Film Thickness": float(row["thickness_nm"]), "Thin Film IOR": float(row["ior"])}
    for name, value in given.items():
        node.inputs[name].default_value = value
    return made


for place, row in enumerate(rows):
    x, angle = place + 0.5 - len(rows) / 2, math.radians(float(row["degrees"]))
    y, z = math.cos(angle) * LENGTH, math.sin(angle) * LENGTH
    mesh = bpy.data.meshes.new("mirror")
    corners = [(x - 0.45, -y, -z), (x + 0.45, -y, -z), (x + 0.45, y, z), (x - 0.45, y, z)]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    mesh.materials.append(material(row))
    scene.collection.objects.link(bpy.data.objects.new("mirror", mesh))
camera = bpy.data.cameras.new("eye")
camera.type, camera.ortho_scale, camera.clip_end = "ORTHO", len(rows), 1000
eye = bpy.data.objects.new("eye", camera)
eye.location = (0, 0, 100)
scene.collection.objects.link(eye)
scene.camera = eye
bpy.ops.render.render(write_still=True)
picture = bpy.data.images.load(render.filepath)
picture.colorspace_settings.name = "Non-Color"
high = render.resolution_y  # Blender has a least height
pixels = numpy.array(picture.pixels[:], numpy.float32).reshape(high, len(rows), -1)[high // 2, :, :3]
for row, pixel in zip(rows, pixels):
    row |= {name: f"{value:.6f}" for name, value in zip(("red", "green", "blue"), pixel)}
with open(PATH, "w", newline="") as file:
    file.write(note)
    writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
