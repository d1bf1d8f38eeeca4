"""From a lumen's surface to a mesh with named faces: first_model.py FOLDER [--small]"""
import pathlib
import sys

import ostia

folder = pathlib.Path(sys.argv[1])
lumen = ostia.example_surface(0.6 if "--small" in sys.argv else 0.25)
tree = ostia.extract_centerlines(lumen).tree
meshed = ostia.mesh_lumen(lumen, tree, sizing={"edge_ratio": 0.5}, progress=True)
ostia.export_mesh(folder / "mesh.vtu", meshed.mesh)
print(meshed, "of", ", ".join(vessel.name for vessel in tree.vessels))
