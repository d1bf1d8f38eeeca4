"""Options are the structs' members: their names, their defaults, their refusals."""
import numpy as np
import pytest

import ostia
from ostia import _ostia


def test_defaults_are_those_of_the_libraries():
    assert _ostia._options["extract_centerlines"] == {
        "step_mm": 0.1, "smoothing_radii": 2.0, "recentre": True, "merge_fraction": 0.15, "vessel_names": []}
    sizing = _ostia._options["mesh_lumen"]["sizing"]
    assert sizing["edge_ratio"] == 0.4 and sizing["measure"] == "distance" and sizing["max_edge_mm"] == float("inf")
    assert _ostia._options["mesh_lumen"]["volume"]["layers"] is None


def test_the_help_names_them():
    assert "step_mm=0.1" in ostia.extract_centerlines.__doc__ and "lambda_=0.33" in ostia.taubin_smoothed.__doc__


def test_an_unknown_option_is_refused_with_those_that_are_there(surface):
    with pytest.raises(ostia.UsageError, match="no option stepmm; there are step_mm, smoothing_radii"):
        ostia.extract_centerlines(surface, stepmm=1)
    tree = ostia.extract_centerlines(surface).tree
    with pytest.raises(ostia.UsageError, match=r"no option sizing\.ratio; there are edge_ratio"):
        ostia.mesh_lumen(surface, tree, sizing={"ratio": 0.3})


@pytest.mark.parametrize("how, says", [
    (dict(step_mm="1"), "step_mm: a number, not str '1'"), (dict(recentre=1), "recentre: True or False"),
    (dict(step_mm=True), "step_mm: a number"), (dict(vessel_names="LAD"), "vessel_names: a list"),
    (dict(vessel_names=[1]), r"vessel_names\[0\]: a text"), (dict(step_mm=None), "step_mm: a number"),
])
def test_another_type_is_refused(surface, how, says):
    with pytest.raises(ostia.UsageError, match=says):
        ostia.extract_centerlines(surface, **how)


@pytest.mark.parametrize("how", [dict(step_mm=0.0), dict(step_mm=float("nan")), dict(merge_fraction=1.5)])
def test_values_out_of_range_are_refused_by_the_library(surface, how):
    with pytest.raises(ostia.InvalidInput, match=next(iter(how))):
        ostia.extract_centerlines(surface, **how)


def test_words_and_whole_numbers(surface):
    tree = ostia.extract_centerlines(surface).tree
    with pytest.raises(ostia.InvalidInput, match='measure: one of distance, radius, not "size"'):
        ostia.target_edge_lengths(surface, tree, measure="size")
    with pytest.raises(ostia.UsageError, match="iterations: a whole number"):
        ostia.taubin_smoothed(surface, iterations=2.5)
    with pytest.raises(ostia.InvalidInput, match="iterations: 1099511627776 is out of range"):
        ostia.taubin_smoothed(surface, iterations=2**40)
    assert len(ostia.taubin_smoothed(surface, iterations=np.int64(2), lambda_=np.float32(0.3)).points) == len(surface.points)


def test_numbers_arrive(surface):
    coarse = ostia.extract_centerlines(surface, step_mm=1.0).tree
    fine = ostia.extract_centerlines(surface, step_mm=0.2).tree
    assert sum(len(s.axis) for s in fine.segments) > 3 * sum(len(s.axis) for s in coarse.segments)
    names = ["one", "two", "three", "four", "five"][: len(coarse.vessels)]
    assert [v.name for v in ostia.extract_centerlines(surface, vessel_names=names).tree.vessels] == names
