"""Reads documents of MaterialX, validates them, writes a shader of each material, and prints their nodes with their numbers as JSON.

    read_materialx.py FOLDER_OF_PACKAGES FILE...
"""

import json
import sys

sys.path.insert(0, sys.argv[1])

import MaterialX as mx
import MaterialX.PyMaterialXGenGlsl as glsl
import MaterialX.PyMaterialXGenShader as shader

library = mx.createDocument()
mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
generator = glsl.EsslShaderGenerator.create()

told = {}
for path in sys.argv[2:]:
    document = mx.createDocument()
    with open(path, encoding="utf-8") as file:
        mx.readFromXmlString(document, file.read())
    document.setDataLibrary(library)
    is_valid, why = document.validate()
    assert is_valid, f"{path}: {why}"
    context = shader.GenContext(generator)
    context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
    generator.registerTypeDefs(document)
    materials = document.getMaterialNodes()
    assert materials, path
    for material in materials:
        made = generator.generate(material.getName(), material, context)
        assert made.getSourceCode(shader.PIXEL_STAGE), material.getName()
    nodes = {}
    for node in document.getNodes():
        definition = node.getNodeDef()
        assert definition, f"{path}: nothing defines {node.getName()}"
        for one in node.getInputs():
            assert definition.getActiveInput(one.getName()), f"{path}: {node.getName()} has no {one.getName()}"
        numbers = {}
        for one in node.getInputs():
            value = one.getValue()
            if isinstance(value, mx.Color3):
                numbers[one.getName()] = [value[0], value[1], value[2]]
            elif isinstance(value, float):
                numbers[one.getName()] = value
        nodes[node.getCategory()] = numbers
    told[path] = nodes
    told[path]["colorspaces"] = {
        f"{node.getCategory()} {one.getName()}": one.getActiveColorSpace() for node in document.getNodes() for one in node.getInputs() if one.getType() == "color3"
    }
print(json.dumps(told))
