"""Reads layers of USD, asks USD's own validators, and prints the inputs of their surfaces as JSON.

    read_usd.py FOLDER_OF_PACKAGES FILE...
"""

import json
import sys

sys.path.insert(0, sys.argv[1])

from pxr import Gf, Sdr, Usd, UsdShade, UsdValidation

known = set(Sdr.Registry().GetShaderNodeByIdentifier("UsdPreviewSurface").GetShaderInputNames())
validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()

told = {}
for path in sys.argv[2:]:
    stage = Usd.Stage.Open(path)
    prim = stage.GetDefaultPrim()
    material = UsdShade.Material(prim)
    assert material, f"{path}: no material"
    faults = UsdValidation.ValidationContext(validators).Validate(stage)
    assert not faults, f"{path}: {[fault.GetMessage() for fault in faults]}"
    surface, _, _ = material.ComputeSurfaceSource()
    assert surface and surface.GetShaderId() == "UsdPreviewSurface", path
    numbers = {}
    for one in surface.GetInputs():
        assert one.GetBaseName() in known, f"{path}: {one.GetBaseName()}"
        value = one.Get()
        numbers[one.GetBaseName()] = list(value) if isinstance(value, Gf.Vec3f) else value
    told[path] = numbers
print(json.dumps(told))
