# Draws F over cosines, lamps and image light, and hands the pixels to the page, which sends them to run.py.
extends Node

func _ready():
	var told = { "engine": Engine.get_version_info().string }
	told.sweep = await sweep()
	var stage = make_stage()
	told.lamps = await lamps(stage)
	told.image = await image(stage)
	told.smooth = await smooth(stage)
	told.sky = await sky(stage)
	told.widths = await widths(stage)
	JavaScriptBridge.get_interface("window").told(JSON.stringify(told, "", true, true))

# What a viewport shows some frames after a change.
func picture(viewport):
	for i in 3:
		await RenderingServer.frame_post_draw
	return viewport.get_texture().get_image()

func make_viewport(size):
	var viewport = SubViewport.new()
	viewport.size = size
	viewport.own_world_3d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	return viewport

func make_material(name):
	var material = ShaderMaterial.new()
	material.shader = load("res://%s.gdshader" % name)
	if material.shader.get_shader_uniform_list().is_empty():
		push_error("%s.gdshader does not compile" % name)
	return material

# One picture a channel, as the bytes of its pixels.
func sweep():
	var viewport = make_viewport(Vector2i(128, 5))
	var rect = ColorRect.new()
	rect.size = viewport.size
	rect.material = make_material("sweep")
	viewport.add_child(rect)
	add_child(viewport)
	var pictures = []
	for channel in 3:
		rect.material.set_shader_parameter("channel", channel)
		var drawn = await picture(viewport)
		drawn.convert(Image.FORMAT_RGB8)
		pictures.append(Array(drawn.get_data()))
	viewport.queue_free()
	return pictures

# A camera without perspective sees a small part of a plane under one lamp. Nothing else is lit.
func make_stage():
	var viewport = make_viewport(Vector2i(8, 8))
	var camera = Camera3D.new()
	camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	camera.size = 0.1
	camera.position = Vector3(0, 0, 4)
	var world = WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_COLOR
	world.environment.background_color = Color.BLACK
	var plane = MeshInstance3D.new()
	plane.mesh = QuadMesh.new()
	plane.mesh.size = Vector2(2, 2)
	var light = DirectionalLight3D.new()
	for node in [camera, world, plane, light]:
		viewport.add_child(node)
	add_child(viewport)
	return { "viewport": viewport, "plane": plane, "light": light, "environment": world.environment }

func middle(stage):
	var pixel = (await picture(stage.viewport)).get_pixel(4, 4)
	return [pixel.r8, pixel.g8, pixel.b8]

func table_of(kind):
	return load("res://addons/fresnel/table_fitted%s.tres" % { "water": "_dielectric", "film": "_film" }.get(kind, ""))

func lamps(stage):
	var black = GradientTexture2D.new()
	black.gradient = Gradient.new()
	black.gradient.colors = PackedColorArray([Color.BLACK, Color.BLACK])
	var seen = []
	for kind in ["readme", "water", "film", "schlick", "builtin"]:
		var material = make_material(kind)
		stage.plane.material_override = material
		material.set_shader_parameter("table", table_of(kind))
		material.set_shader_parameter("sky", black)
		for roughness in [0.3, 0.6]:
			material.set_shader_parameter("roughness", roughness)
			stage.light.light_energy = 0.2 if roughness > 0.5 else 0.05
			for spin in [0, 20, 40, 60]:
				stage.plane.rotation_degrees = Vector3(0, spin, 0)
				for height in [10, 45, 75]:
					stage.light.rotation_degrees = Vector3(-height, 20, 0)
					var to_light = stage.light.global_basis.z
					seen.append({
						"kind": kind, "roughness": roughness, "spin": spin, "energy": stage.light.light_energy,
						"to_light": [to_light.x, to_light.y, to_light.z], "pixel": await middle(stage),
					})
	return seen

# A picture of one light everywhere, in floats.
func panorama(paint, width = 64):
	var picture = Image.create(width, width / 2, true, Image.FORMAT_RGBF)
	for x in width:
		for y in width / 2:
			picture.set_pixel(x, y, paint.call(64.0 * x / width))
	picture.generate_mipmaps()
	return ImageTexture.create_from_image(picture)

func gold(kind = "readme"):
	var material = make_material(kind)
	material.set_shader_parameter("table", table_of(kind))
	return material

# A sky of one light and no lamp. The exposure keeps the pixel within its bits.
func image(stage):
	stage.light.visible = false
	var seen = []
	for kind in ["readme", "film"]:
		var material = gold(kind)
		stage.plane.material_override = material
		for light in [0.01, 0.3, 1.0, 40.0]:
			material.set_shader_parameter("sky", panorama(func(_x): return Color(light, light, light)))
			stage.environment.tonemap_exposure = 1.0 / light
			for roughness in [0.1, 0.3, 0.6, 1.0]:
				material.set_shader_parameter("roughness", roughness)
				for spin in [0, 20, 40, 60, 75]:
					stage.plane.rotation_degrees = Vector3(0, spin, 0)
					seen.append({ "kind": kind, "roughness": roughness, "spin": spin, "pixel": await middle(stage) })
	stage.environment.tonemap_exposure = 1.0
	return seen

# Roughness 0, where the lamp shines on the back.
func smooth(stage):
	var material = gold()
	stage.plane.material_override = material
	material.set_shader_parameter("sky", panorama(func(_x): return Color.BLACK))
	material.set_shader_parameter("roughness", 0.0)
	stage.plane.rotation_degrees = Vector3(0, 60, 0)
	stage.light.visible = true
	stage.light.light_energy = 1.0
	var seen = []
	for turn in [-60, -90, -120]:
		stage.light.rotation_degrees = Vector3(0, turn, 0)
		seen.append(await middle(stage))
	stage.light.visible = false
	return seen

# Four quarters, each of a colour, as this material and as Godot's own mirror reflect them.
func sky(stage):
	var colours = [Color.RED, Color.GREEN, Color.BLUE, Color.GREEN]
	var quarters = panorama(func(x): return colours[int(x / 16.0)])
	var environment = stage.environment
	environment.background_mode = Environment.BG_SKY
	environment.sky = Sky.new()
	environment.sky.sky_material = PanoramaSkyMaterial.new()
	environment.sky.sky_material.panorama = quarters
	environment.reflected_light_source = Environment.REFLECTION_SOURCE_SKY
	var ours = gold()
	ours.set_shader_parameter("sky", quarters)
	ours.set_shader_parameter("roughness", 0.05)
	var mirror = StandardMaterial3D.new()
	mirror.metallic = 1.0
	mirror.roughness = 0.0
	var seen = []
	for material in [ours, mirror]:
		stage.plane.material_override = material
		var row = []
		for spin in [-60, -20, 20, 60]:
			stage.plane.rotation_degrees = Vector3(0, spin, 0)
			await picture(stage.viewport)
			row.append(await middle(stage))
		seen.append(row)
	return seen

# A rough mirror of one half that is lit, by panoramas of several sizes.
func widths(stage):
	var material = gold()
	stage.plane.material_override = material
	var seen = []
	for width in [64, 256, 1024]:
		material.set_shader_parameter("sky", panorama(func(x): return Color.WHITE if x < 32 else Color.BLACK, width))
		for roughness in [0.5, 0.8]:
			material.set_shader_parameter("roughness", roughness)
			for spin in [-50, -20, 20, 50]:
				stage.plane.rotation_degrees = Vector3(0, spin, 0)
				seen.append(await middle(stage))
	return seen
