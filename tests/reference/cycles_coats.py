"""Measures what coated metals reflect in Cycles of Blender 5 and rewrites the last three columns of cycles_coats.csv, which lies beside this file.

    python3.11 -m venv bpy && bpy/bin/pip install bpy==5.0.1 && bpy/bin/python cycles_coats.py

As cycles_films.py, with 65536 samples, since Cycles chooses coat or base by chance.
"""
import csv, math, os, tempfile
import bpy
import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
PATH = os.path.join(HERE, "cycles_coats.csv")
LENGTH = 40.0

with open(PATH) as file:
    note = file.readline()
    rows = list(csv.DictReader(file))

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="cycles")
scene = bpy.context.scene
scene.render.engine = "CYCLES"
cycles, render = scene.cycles, scene.render
cycles.device, cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = "CPU", 65536, False, False
cycles.pixel_filter_type, cycles.filter_width, cycles.blur_glossy = "BOX", 0.01, 0
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
render.resolution_x, render.resolution_y, render.resolution_percentage = len(rows), 1, 100
render.filepath = os.path.join(tempfile.mkdtemp(), "coats.exr")
scene.view_settings.view_transform = "Raw"
world = bpy.data.worlds.new("white")
scene.world = world
world.use_nodes = True
world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)

for place, row in enumerate(rows):
    made = bpy.data.materials.new("coated")
    made.use_nodes = True
    node = made.node_tree.nodes["Principled BSDF"]
    f0, tint = ([float(row[f"{part}_{name}"]) for name in ("red", "green", "blue")] for part in ("f0", "tint"))
    given = {"Metallic": 1, "Roughness": 0, "Base Color": (*f0, 1), "Specular Tint": (*tint, 1)}
    given |= {"Coat Weight": 1, "Coat Roughness": 0, "Coat IOR": float(row["ior"])}
    for name, value in given.items():
        node.inputs[name].default_value = value
    x, angle = place + 0.5 - len(rows) / 2, math.radians(float(row["degrees"]))
    y, z = math.cos(angle) * LENGTH, math.sin(angle) * LENGTH
    mesh = bpy.data.meshes.new("mirror")
    # Without gaps: more than one sample looks beside the pixel's middle.
    mesh.from_pydata([(x - 0.5, -y, -z), (x + 0.5, -y, -z), (x + 0.5, y, z), (x - 0.5, y, z)], [], [(0, 1, 2, 3)])
    mesh.materials.append(made)
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
    row |= {name: f"{value:.4f}" for name, value in zip(("red", "green", "blue"), pixel)}
with open(PATH, "w", newline="") as file:
    file.write(note)
    writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
