"""Values can be pickled, copied and looked at."""
import copy
import pickle

import numpy as np
import pytest

import ostia


def same(a, b):
    assert type(a) is type(b)
    if isinstance(a, ostia.Volume):
        return np.array_equal(a.array, b.array) and (a.spacing, a.origin) == (b.spacing, b.origin) and np.array_equal(a.direction, b.direction)
    if isinstance(a, ostia.TriMesh):
        return np.array_equal(a.points, b.points) and np.array_equal(a.triangles, b.triangles)
    if isinstance(a, ostia.FacedSurface):
        return same(a.mesh, b.mesh) and np.array_equal(a.face_ids, b.face_ids) and [f.name for f in a.faces] == [f.name for f in b.faces]
    if isinstance(a, ostia.VesselTree):
        lines = zip(a.segments, b.segments)
        return [v.name for v in a.vessels] == [v.name for v in b.vessels] and all(np.array_equal(s.axis.frames, t.axis.frames) for s, t in lines)
    return a == b


@pytest.fixture(params=["volume", "surface", "faced", "tree", "model"])
def value(request, ball, surface, tree, model):
    faced = ostia.FacedSurface(surface, np.ones(len(surface.triangles), np.int32), [ostia.Face(1, "wall")])
    return dict(volume=ball, surface=surface, faced=faced, tree=tree, model=model)[request.param]


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickle_brings_back_the_same_bits(value, protocol):
    assert same(value, pickle.loads(pickle.dumps(value, protocol)))


def test_a_copy_of_an_immutable_value_is_itself(value):
    assert copy.copy(value) is value and copy.deepcopy([value])[0] is value


def test_it_says_what_it_is(value):
    text = repr(value)
    assert text.startswith(f"<ostia.{type(value).__name__}") and len(text) < 200


def test_faces_and_axes_can_be_pickled(tree):
    face = pickle.loads(pickle.dumps(ostia.Face(3, "outlet_LAD", "outlet")))
    assert (face.id, face.name, face.kind) == (3, "outlet_LAD", "outlet")
    axis = pickle.loads(pickle.dumps(tree.axis("LAD")))
    assert np.array_equal(axis.radius, tree.axis("LAD").radius) and axis.length == 40


def test_a_volume_is_an_array_for_numpy(ball):
    assert np.asarray(ball).sum() == ball.array.sum()
    assert np.asarray(ball, np.float32).dtype == np.float32
    assert ball.astype("int16").dtype == "int16"
    with pytest.raises(ostia.InvalidInput, match="cannot hold"):
        ostia.Volume(np.full((1, 1, 1), -5, np.int16)).astype("uint8")
