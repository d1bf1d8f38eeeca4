"""How a mesh depends on its edges, as a table and curves: study.py FOLDER [--small]"""
import pathlib
import sys

import matplotlib.pyplot as plt
import pandas as pd

import ostia

folder = pathlib.Path(sys.argv[1])
small = "--small" in sys.argv
lumen = ostia.example_surface(0.6 if small else 0.3)
tree = ostia.extract_centerlines(lumen).tree
rows = []
for edge_ratio in [0.5, 0.35] if small else [0.2 + 0.006 * step for step in range(50)]:
    meshed = ostia.mesh_lumen(lumen, tree, sizing={"edge_ratio": edge_ratio})
    quality = meshed.quality
    rows.append({"edge_ratio": edge_ratio, "tetrahedra": len(meshed.mesh.tetrahedra), "ok": meshed.ok,
                 "min_dihedral_deg": quality["volume"]["min_dihedral_deg"], "volume_mm3": quality["volume"]["volume_mm3"]})
table = pd.DataFrame(rows)
table.to_csv(folder / "study.csv", index=False)
print(table)
table.plot(x="edge_ratio", y=["tetrahedra", "min_dihedral_deg", "volume_mm3"], subplots=True, figsize=(6, 7))
plt.savefig(folder / "study.png", dpi=100)
