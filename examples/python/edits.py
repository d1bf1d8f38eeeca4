"""A narrowing is opened by an edit, and what that does to lumen and pressure: edits.py FOLDER [--small]"""
import pathlib
import sys

import numpy as np

import ostia

folder = pathlib.Path(sys.argv[1])
z = np.linspace(0, 40, 161)
radius = 1.5 - 0.4 * (1 + np.cos(np.pi * np.clip((z - 20) / 5, -1, 1)))
model = ostia.model_of_tubes(ostia.VesselTree.single(np.column_stack([0 * z, 0 * z, z]), radius, "LAD"))

with ostia.Case.create(folder / "case.ostia", model) as case:
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    for s in (17.0, 18.5, 20.0, 21.5, 23.0):
        ring = np.column_stack([1.3 * np.cos(angles), 1.3 * np.sin(angles), np.full(24, s)])
        case.edit("section.contour", vessel=1, s_mm=s, closed=True, points=ring)
    for name, one in {"before": case.starting_model, "after": case.model}.items():
        found = ostia.find_stenoses(one, 1)
        ffr = [lesion["ffr"] for lesion in ostia.pressure(one)["lesions"]]
        print(name, found, "FFR", ffr)
    case.undo()
