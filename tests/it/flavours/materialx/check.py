"""Reads the files of the flavour `materialx` with MaterialX, generates shaders of every target, and prints what it did as JSON.

    check.py FOLDER_OF_PACKAGES FLAVOUR OUT

FOLDER_OF_PACKAGES holds the Python package MaterialX. FLAVOUR is the folder of files. Each file is read alone, with each other file in
both orders, and twice; each document must be valid. Then the README's document becomes a shader of each target, as does a document with
F of one material for each material. The shaders are written into the folder OUT, as `<document>_<target>.<stage>`, where the stage is
`frag` or `vert`.

    version    MaterialX's version
    files      the files that were read
    documents  how many documents were valid
    shaders    by document and target: the names of the files
"""

import json
import pathlib
import re
import sys

PACKAGES, FLAVOUR, OUT = sys.argv[1:]
sys.path.insert(0, PACKAGES)

import MaterialX as mx
import MaterialX.PyMaterialXGenGlsl as glsl
import MaterialX.PyMaterialXGenMdl as mdl
import MaterialX.PyMaterialXGenMsl as msl
import MaterialX.PyMaterialXGenOsl as osl
import MaterialX.PyMaterialXGenShader as shader
import MaterialX.PyMaterialXGenSlang as slang

FLAVOUR, OUT = pathlib.Path(FLAVOUR), pathlib.Path(OUT)
TARGETS = {
    "glsl": glsl.GlslShaderGenerator,
    "essl": glsl.EsslShaderGenerator,
    "vulkan": glsl.VkShaderGenerator,
    "msl": msl.MslShaderGenerator,
    "osl": osl.OslShaderGenerator,
    "mdl": mdl.MdlShaderGenerator,
    "slang": slang.SlangShaderGenerator,
}
STAGES = {"frag": shader.PIXEL_STAGE, "vert": shader.VERTEX_STAGE}
# OSL and MDL have no stages.
STAGELESS = ["osl", "mdl"]
SEARCH = mx.getDefaultDataSearchPath()
LIBRARY = mx.createDocument()
mx.loadLibraries(mx.getDefaultDataLibraryFolders(), SEARCH, LIBRARY)
HEAD = '<?xml version="1.0"?>\n<materialx version="1.39" colorspace="lin_rec709" xmlns:xi="http://www.w3.org/2001/XInclude">\n'
# F as emitted light.
UNLIT = """  <facingratio name="facing" type="float" />
  <{node} name="reflectance" type="color3">
    <input name="cos_theta" type="float" nodename="facing" />
  </{node}>
  <surface_unlit name="shader" type="surfaceshader">
    <input name="emission_color" type="color3" nodename="reflectance" />
  </surface_unlit>
  <surfacematerial name="mirror" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="shader" />
  </surfacematerial>
"""


def document(text):
    made = mx.createDocument()
    mx.readFromXmlString(made, text, mx.FileSearchPath(str(FLAVOUR)))
    made.setDataLibrary(LIBRARY)
    is_valid, why = made.validate()
    assert is_valid, f"{why} in {text}"
    return made


def including(names, rest=""):
    """A document that includes these files."""
    lines = [f'  <xi:include href="{name}" />\n' for name in names]
    return document(HEAD + "".join(lines) + rest + "</materialx>\n")


def nodes(made):
    """The nodes that files of ours define: our names, without those of the library."""
    return {one.getNodeString() for one in made.getNodeDefs() if one.getNodeString().startswith("fresnel_")}


def generated(name, made, target):
    """The files of a document's one material in a target."""
    generator = TARGETS[target].create()
    context = shader.GenContext(generator)
    context.registerSourceCodeSearchPath(SEARCH)
    colours = shader.DefaultColorManagementSystem.create(generator.getTarget())
    colours.loadLibrary(LIBRARY)
    generator.setColorManagementSystem(colours)
    context.getOptions().targetColorSpaceOverride = "lin_rec709"
    generator.registerTypeDefs(made)
    (material,) = made.getMaterialNodes()
    of_target = generator.generate(material.getName(), material, context)
    files = []
    for ending, stage in STAGES.items():
        if stage == shader.VERTEX_STAGE and target in STAGELESS:
            continue
        text = of_target.getSourceCode(stage)
        assert text, f"{target} has no {stage} stage"
        files.append(f"{name}_{target}.{ending}")
        (OUT / files[-1]).write_text(text, encoding="utf-8", newline="\n")
    return files


FILES = sorted(path.name for path in FLAVOUR.glob("*.mtlx"))
assert len(FILES) > 2, FILES
count = 0
for one in FILES:
    document((FLAVOUR / one).read_text(encoding="utf-8"))
    for other in FILES:
        # With itself it is included twice.
        including([one, other])
    count += 1 + len(FILES)
including(FILES + FILES)
count += 1

readme = (FLAVOUR / "README.md").read_text(encoding="utf-8")
documents = {"readme": document(re.search(r"```xml\n(.*?)```", readme, re.DOTALL)[1])}
for one in FILES:
    if one != "fresnel.mtlx":
        name = one.removesuffix(".mtlx")
        own = nodes(including([one])) - nodes(including(["fresnel.mtlx"]))
        # A metal has a second node: what it reflects below a clear coat.
        coated = {node for node in own if "_under_coat" in node}
        (node,) = own - coated
        documents[name] = including([one], UNLIT.format(node=node))
        for node in coated:
            documents[f"{name}_under_coat"] = including([one], UNLIT.format(node=node))
count += len(documents)

OUT.mkdir(parents=True, exist_ok=True)
shaders = {name: {target: generated(name, made, target) for target in TARGETS} for name, made in documents.items()}
print(json.dumps({"version": mx.getVersionString(), "files": FILES, "documents": count, "shaders": shaders}))
