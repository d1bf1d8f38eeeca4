"""A thousand calls of each factory leave no memory behind."""
import gc

import numpy as np
import pytest

import ostia

Z = np.linspace(0, 20, 41)
LINE = np.column_stack([0 * Z, 0 * Z, Z])
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
SIDES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], np.int32)
ANGLES = np.linspace(0, 2 * np.pi, 16, endpoint=False)
RING = np.column_stack([np.cos(ANGLES), -np.sin(ANGLES), 0 * ANGLES])
CALLS = 1000
NOISE = 1 << 20  # of the allocator, as it keeps what it has for later: 1 kB a call


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096


@pytest.fixture(scope="module")
def parts():
    tree = ostia.VesselTree.single(LINE, np.full(41, 1.5), "LAD")
    model = ostia.model_of_tubes(tree)
    walls = model.solve()
    still = ostia.example_surface(2.0, False)
    motion = ostia.fit_motion({k / 4: still for k in range(4)}, registration={"depth": 1}, template_phase=0.0).motion
    mesh = ostia.tetrahedralize(ostia.FacedSurface(ostia.TriMesh(CORNERS, SIDES), np.ones(4, np.int32), [ostia.Face(1, "wall")]))
    section = ostia.ContourSection("s", "LAD", [0.0, 1.0], [RING, RING + [0, 0, 1]])
    graph = ostia.VesselGraph.of_tree(tree)
    return dict(tree=tree, model=model, walls=walls, motion=motion, mesh=mesh, section=section, graph=graph, profile=ostia.lumen_profile(model, 1, walls))


FACTORIES = {
    "Volume": lambda p: ostia.Volume(np.zeros((16, 16, 16), np.int16)).array,
    "Volume, copied": lambda p: ostia.Volume(np.zeros((16, 16, 16), np.float32), copy=True).array,
    "TriMesh": lambda p: ostia.TriMesh(CORNERS.copy(), SIDES.copy()).points,
    "FacedSurface": lambda p: ostia.FacedSurface(ostia.TriMesh(CORNERS, SIDES), np.ones(4, np.int32), [ostia.Face(1, "wall")]).mesh.points,
    "MixedMesh": lambda p: p["mesh"].mixed().points,
    "VesselTree": lambda p: ostia.VesselTree.single(LINE, np.ones(41)).segments[0].axis.points,
    "Centerline": lambda p: ostia.Centerline(LINE, np.ones(41)).frames,
    "VesselGraph": lambda p: ostia.VesselGraph(LINE, [(0, 1)], 1.0).edges,
    "VesselGraph of a tree": lambda p: ostia.VesselGraph.of_tree(p["tree"]).faults,
    "LumenModel": lambda p: ostia.model_of_tubes(p["tree"]).digest,
    "samples": lambda p: p["model"].samples(1),
    "edits": lambda p: ostia.apply_edit(p["model"], "vessel.rename", vessel=1, name="RCA").model,
    "ImplicitSurface": lambda p: ostia.ImplicitSurface(LINE, np.ones(41), 1.0).values(LINE),
    "SolvedWalls": lambda p: p["walls"].surface(1).centres,
    "ContourSection": lambda p: ostia.ContourSection("s", "LAD", [0.0, 1.0], [RING, RING + [0, 0, 1]]).contours,
    "ContourSet": lambda p: ostia.ContourSet([p["section"]]).sections,
    "Frame": lambda p: ostia.Frame((0, 0, 1), (1, 0, 0)).normal,
    "AxisCurve": lambda p: ostia.AxisCurve(p["tree"].axis(1)).frame(3.0),
    "Motion": lambda p: p["motion"].carried(CORNERS, 0.3),
    "ReferenceLine": lambda p: ostia.ReferenceLine(LINE, np.ones(41)).points,
    "stenoses": lambda p: ostia.find_stenoses(p["model"], 1, p["walls"], p["profile"]),
    "agreement": lambda p: ostia.bland_altman([1.0, 2, 3], [1.0, 2, 4]),
    "measures": lambda p: ostia.measure_tree(p["graph"]).tables,
    "refusals": lambda p: pytest.raises(ostia.InvalidInput, ostia.TriMesh, CORNERS, SIDES + 9),
}


@pytest.mark.parametrize("name", FACTORIES)
def test_nothing_is_left(name, parts):
    def many():
        for _ in range(CALLS):
            FACTORIES[name](parts)
        gc.collect()

    many()  # what is made once, and the allocator's own store
    before = resident()
    many()
    left = resident() - before
    if left > NOISE:  # once more: another test's pages may have come in
        before = resident()
        many()
        left = resident() - before
    assert left <= NOISE, f"{left / CALLS:.0f} bytes a call"
