"""What the tests of the package share: a tube and a tree whose sizes are known."""
import pathlib
import os

import numpy as np
import pytest

import ostia

SOURCE = pathlib.Path(os.environ.get("OSTIA_SOURCE", pathlib.Path(__file__).parents[2]))


@pytest.fixture(scope="session")
def source():
    return SOURCE


@pytest.fixture(scope="session")
def surface():
    """The lumen of a tree like a coronary one, its ends open."""
    return ostia.example_surface(0.4)


@pytest.fixture(scope="session")
def tree():
    """A straight vessel along z, 40 mm, of radius 1.5 mm with a narrowing to 0.75 mm at 20 mm."""
    z = np.linspace(0, 40, 161)
    radius = 1.5 - 0.375 * (1 + np.cos(np.pi * np.clip((z - 20) / 4, -1, 1)))
    return ostia.VesselTree.single(np.column_stack([0 * z, 0 * z, z]), radius, "LAD")


@pytest.fixture(scope="session")
def model(tree):
    return ostia.model_of_tubes(tree)


@pytest.fixture
def ball():
    """A mask of a ball of radius 4 mm, voxels of 0.5 mm."""
    k, j, i = np.mgrid[-12:13, -12:13, -12:13]
    inside = (i**2 + j**2 + k**2) * 0.25 <= 16
    return ostia.Volume(inside, spacing=(0.5, 0.5, 0.5), origin=(-6, -6, -6))
