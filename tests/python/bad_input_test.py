"""Whatever a function is given: what it can take, or an exception that says what is wrong and the way out."""
import gc
import threading

import numpy as np
import pytest

import ostia

ANGLES = np.linspace(0, 2 * np.pi, 16, endpoint=False)
RING = np.column_stack([np.cos(ANGLES), -np.sin(ANGLES), 0 * ANGLES])
LINE = np.column_stack([np.zeros(50), np.zeros(50), np.linspace(0, 20, 50)])


@pytest.fixture(scope="module")
def motion():
    still = ostia.example_surface(1.0, False)
    return ostia.fit_motion({k / 4: still for k in range(4)}, registration={"depth": 1}, template_phase=0.0).motion


@pytest.fixture(scope="module")
def wall():
    z = np.linspace(0, 20, 41)
    return ostia.model_of_tubes(ostia.VesselTree.single(np.column_stack([0 * z, 0 * z, z]), np.full(41, 1.5), "LAD")).solve().surface(1)


# Functions of places: what is asked of them, with places (n, 3).
PLACES = {
    "carried": lambda places, motion, wall: motion.carried(places, 0.3),
    "velocity": lambda places, motion, wall: motion.velocity(places, 0.3),
    "values": lambda places, motion, wall: wall.values(places),
    "gradients": lambda places, motion, wall: wall.gradients(places),
    "contour": lambda places, motion, wall: ostia.ContourSection("s", "LAD", [0.0, 1.0], [places, RING + [0, 0, 1]]),
    "graph": lambda places, motion, wall: ostia.VesselGraph(places, [(0, 1)], 1.0),
    "reference": lambda places, motion, wall: ostia.ReferenceLine(places, np.ones(len(places))),
    "centres": lambda places, motion, wall: ostia.ImplicitSurface(places, np.ones(len(places)), 1.0),
}


def same_answer(a, b):
    if isinstance(a, np.ndarray):
        return np.array_equal(a, b)
    names = [name for name in ("points", "centres", "contours") if hasattr(a, name)]
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in names)


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("layout", [
    lambda a: a.tolist(), np.asfortranarray, lambda a: np.repeat(a, 2, axis=0)[::2], lambda a: a[::-1].copy()[::-1], lambda a: a.astype(">f8"),
    lambda a: np.frombuffer(a.tobytes()).reshape(a.shape),
])
def test_any_layout_of_the_same_numbers_is_the_same(name, layout, motion, wall):
    assert same_answer(PLACES[name](layout(RING), motion, wall), PLACES[name](RING, motion, wall))


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("bad", [
    RING.T, RING[:, :2], RING[0], np.zeros((2, 2, 3)), np.where(np.arange(48).reshape(16, 3) == 7, np.nan, RING), np.where(np.arange(48).reshape(16, 3) == 7, np.inf, RING),
    np.array([[None] * 3] * 4), RING.astype(complex), RING.astype(str), "places", [[0, 0, 0], [1, 2]], {"x": 1},
])
def test_no_other_array_is_taken(name, bad, motion, wall):
    with pytest.raises((ostia.InvalidInput, ostia.UsageError, TypeError, ValueError)) as refusal:
        PLACES[name](bad, motion, wall)
    assert len(str(refusal.value)) > 10


def test_arrays_that_nobody_may_write_to_are_taken(motion, wall):
    still = RING.copy()
    still.flags.writeable = False
    for call in PLACES.values():
        call(still, motion, wall)
    assert np.array_equal(still, RING)


def test_what_was_given_may_go(motion):
    given = RING.copy()
    graph = ostia.VesselGraph(given, [(0, 1)], 1.0)
    surface = ostia.ImplicitSurface(given, np.ones(16), 1.0)
    given[:] = 1e30
    del given
    gc.collect()
    assert np.array_equal(graph.points, RING) and np.array_equal(surface.centres, RING)
    centres = ostia.ImplicitSurface(RING, np.ones(16), 1.0).centres
    gc.collect()
    assert np.array_equal(centres, RING)


def test_two_threads_ask_the_same_values(motion, wall):
    expected = {name: call(RING, motion, wall) for name, call in PLACES.items()}
    wrong = []

    def ask():
        for _ in range(20):
            for name, call in PLACES.items():
                if not same_answer(call(RING, motion, wall), expected[name]):
                    wrong.append(name)

    threads = [threading.Thread(target=ask) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


@pytest.mark.parametrize("call, says", [
    (lambda: ostia.fit_motion({0.0: 3, 0.5: 4, 0.7: 5}), "surfaces: a TriMesh"),
    (lambda: ostia.fit_motion([1, 2, 3]), "surfaces: a dictionary"),
    (lambda: ostia.fit_motion({0.0: None, 0.5: None}), "phase"),
    (lambda: ostia.fit_motion({}, depth=3), "there is no option depth; there are"),
    (lambda: ostia.fit_motion({}, registration={"depth": "deep"}), "registration.depth: a whole number"),
    (lambda: ostia.fit_motion({}, method="guess"), "method: one of gauss_newton, gradient_descent"),
    (lambda: ostia.grow_tree(ostia.VesselGraph(LINE, [(i, i + 1) for i in range(49)], 1.0), "heart"), "domain: "),
    (lambda: ostia.grow_tree(ostia.VesselGraph(LINE, [(i, i + 1) for i in range(49)], 1.0), ostia.example_surface(0.8)), "open edges"),
    (lambda: ostia.grow_tree(ostia.VesselGraph(LINE, [(0, 1), (2, 3)], 1.0), artery="vein"), "artery: one of right"),
    (lambda: ostia.reconstruct_surface(ostia.VesselGraph(LINE, [(0, 1)], -1.0)), "graph"),
    (lambda: ostia.reconstruct_surface(ostia.VesselGraph(LINE, [(0, 1)], 1.0), sides=5), "sides"),
    (lambda: ostia.measure_tree(ostia.example_surface(0.8)), "of: a VesselGraph or a VesselTree"),
    (lambda: ostia.skeleton_of(ostia.Volume(np.zeros((5, 5, 5), np.uint8))), "no object|holds nothing|empty|object"),
    (lambda: ostia.skeleton_of(ostia.Volume(np.zeros((5, 5, 5), np.int16))), "mask: a Volume of int16; it must be of uint8"),
    (lambda: ostia.evaluate_lumen(ostia.ContourSet([]), ostia.example_surface(0.8)), "no section"),
    (lambda: ostia.evaluate_lumen(ostia.ContourSet([]), LINE), "result: a TriMesh or a ContourSet"),
    (lambda: ostia.bland_altman([1.0, 2.0], [1.0]), "pairs|lengths|values"),
    (lambda: ostia.detect_stenoses([0.5], [0.5, 0.6]), "result: 2 grades for 1"),
    (lambda: ostia.evaluate_volume(ostia.Volume(np.zeros((3, 3, 3), np.float32)), ostia.Volume(np.zeros((3, 3, 3), np.uint8))), "labels are int16 or uint8"),
    (lambda: ostia.evaluate_motion([1, 2], [3, 4]), "reference: a list of TriMesh"),
    (lambda: ostia.phantom_case(preset="huge"), "preset: one of tiny, small, full"),
    (lambda: ostia.phantom_case(disease=-1), "disease"),
    (lambda: ostia.phantom_case(scan={"noise": 3}), "there is no option scan.noise"),
    (lambda: ostia.phantom_case(scan={"realism": {"tail": 0.7}}), "tail is 0.7"),
    (lambda: ostia.waveform("renal"), "coronary-left"),
    (lambda: ostia.ImplicitSurface(RING, np.ones(16), 1.0, kernel="gauss"), "kernel"),
    (lambda: ostia.ImplicitSurface(RING, np.ones(15), 1.0), "weight|centre|15|16"),
    (lambda: ostia.ImplicitSurface(RING, np.ones(16), 1.0, polynomial=[1, 2]), "polynomial"),
    (lambda: ostia.Frame((0, 0, 1), (0, 0, 2)), "normal"),
    (lambda: ostia.ContourSection("s", "LAD", [0.0], [RING, RING]), "s_mm: 1 numbers for 2 contours"),
    (lambda: ostia.ContourSection("s", "LAD", [0.0, 0.0], [RING, RING]), "contours: "),
    (lambda: ostia.ContourSection("s", "LAD", [0.0, 1.0], [RING, RING], health="ill"), "health: one of healthy, diseased"),
    (lambda: ostia.write_markups("x.mrk.json", [{"name": "a"}]), "points"),
    (lambda: ostia.write_markups("x.mrk.json", [{"points": RING, "kind": "cloud"}]), "kind: fiducials"),
    (lambda: ostia.experiment_smoothness(0), "orientations: 1 to 12"),
    (lambda: ostia.pressure(ostia.VesselTree.single(LINE, np.ones(50)), what_ifs=[{"vessel": 1, "kind": "stent"}]), "kind: one of open, narrow"),
    (lambda: ostia.pressure(ostia.VesselTree.single(LINE, np.ones(50)), image=3), "image: a tree has no walls"),
    (lambda: ostia.pressure(ostia.VesselTree.single(LINE, np.ones(50)), uncertainty={"samples": 3}), "number of trees"),
    (lambda: ostia.pressure(ostia.VesselTree.single(LINE, np.ones(50)), uncertainty_inputs={"sistolic": 3}), "sistolic"),
    (lambda: ostia.export_network(ostia.VesselTree.single(LINE, np.ones(50)), "comsol"), "comsol|svzerod"),
])
def test_what_cannot_be_is_refused_with_the_way_out(call, says):
    with pytest.raises((ostia.InvalidInput, ostia.UsageError), match=says):
        call()


@pytest.mark.parametrize("call", [
    lambda folder: ostia.read_motion(folder / "none.json"), lambda folder: ostia.read_contours(folder / "none.json"), lambda folder: ostia.read_markups(folder / "none.csv"),
    lambda folder: ostia.read_flow_result(folder / "none"), lambda folder: ostia.read_ct(folder / "none"), lambda folder: ostia.ReferenceLine.read(folder / "none.txt"),
    lambda folder: ostia.solve_network(folder / "none.json"), lambda folder: ostia.evaluate_suite(folder / "none", folder / "no"), lambda folder: ostia.read_mesh_fields(folder / "no.vtu"),
    lambda folder: ostia.continue_openfoam_case(folder / "none", iterations=3),
])
def test_files_that_are_not_there(call, tmp_path):
    with pytest.raises((ostia.IoError, ostia.InvalidInput), match="no"):
        call(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("call", [
    lambda at, values: ostia.write_motion(at / "m.json", values), lambda at, values: ostia.export_motion(at / "m", values, times=3),
])
def test_a_folder_that_cannot_be_written_to(call, motion, tmp_path):
    (tmp_path / "file").write_text("here")
    with pytest.raises(ostia.Error):
        call(tmp_path / "file", motion)
    assert (tmp_path / "file").read_text() == "here" and len(list(tmp_path.iterdir())) == 1
