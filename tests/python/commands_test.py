"""Every command is a function, with the options that the program has. Which functions do its work in process: reach_test.py."""
import json
import pathlib

import pytest

import ostia
from ostia import commands


def leaves(described):
    if not described["commands"]:
        return [described]
    return [leaf for one in described["commands"] for leaf in leaves(one)]


def described():
    return json.loads((pathlib.Path(ostia.__file__).parent / "commands.json").read_text())


def test_every_command_is_a_function():
    assert len(commands.names) == len(leaves(described())) > 40
    for name in commands.names:
        assert callable(getattr(commands, name)) and getattr(commands, name).__doc__


def test_every_option_of_every_command_is_taken():
    """Each option by its keyword becomes its own words again."""
    for one in leaves(described()):
        command = commands._Command(one, described()["options"])
        for name, option in command.named.items():
            value = True if not option["value"] else "x"
            words = command.arguments((), {name: value})
            assert words[-1].split("=")[0] == option["names"][-1]


def test_a_command_and_its_result(tmp_path, surface):
    ostia.write_surface(tmp_path / "lumen.stl", surface)
    told = []
    result = commands.centerline(tmp_path / "lumen.stl", output=tmp_path / "lines.vtp", step=0.5, progress=lambda *at: told.append(at))
    assert result.quality_ok and result.data["vessels"] and "done" in repr(result)
    assert len(ostia.read_centerlines(tmp_path / "lines.vtp")) == len(result.data["vessels"])
    assert told and all(0 <= fraction <= 1 for fraction, _ in told)


def test_places_are_values(tmp_path, surface):
    ostia.write_surface(tmp_path / "lumen.vtp", surface)
    ends = ostia.extract_centerlines(surface).ends
    result = commands.centerline(tmp_path / "lumen.vtp", output=tmp_path / "lines.vtp", target=[tuple(ends[0]), ends[1]])
    assert len(result.data["vessels"]) == 2


def test_what_is_wrong_is_said_as_the_program_says_it(tmp_path):
    with pytest.raises(ostia.InvalidInput, match="none.stl: there is no such file|cannot read .*none.stl"):
        commands.centerline(tmp_path / "none.stl", output=tmp_path / "lines.vtp")
    with pytest.raises(ostia.UsageError, match="no option steps; there are"):
        commands.centerline("a.stl", output="b.vtp", steps=1)
    with pytest.raises(ostia.UsageError, match="strict: True or False"):
        commands.centerline("a.stl", output="b.vtp", strict="yes")
    with pytest.raises(ostia.UsageError, match="2 inputs given"):
        commands.centerline("a.stl", "c.stl", output="b.vtp")
    with pytest.raises(ostia.UsageError, match="output"):
        commands.centerline("a.stl")
    with pytest.raises(ostia.UsageError, match="step"):
        commands.centerline("a.stl", output="b.vtp", step=-1)


def test_a_program_that_is_not_there(tmp_path, monkeypatch):
    monkeypatch.setenv("OSTIA_PROGRAM", str(tmp_path / "ostia"))
    with pytest.raises(OSError):
        commands.centerline("a.stl", output="b.vtp")


def test_a_flag_that_also_takes_a_value():
    ffr = commands._Command(next(one for one in leaves(described()) if one["words"][-1] == "ffr"), [])
    said = [ffr.arguments(("a.csv",), {"uncertainty": value})[2:] for value in (True, 64, False, None)]
    assert said == [["--uncertainty"], ["--uncertainty=64"], [], []]


def test_words():
    assert commands._text((1, 2.5, -3)) == "1,2.5,-3"
    assert commands._text([(1, 2, 3), (4, 5, 6)]) == "1,2,3:4,5,6"
    assert commands._text(["gmsh4", "vtu"]) == "gmsh4,vtu"
    assert commands._text(pathlib.PurePosixPath("a b")) == "a b"
    assert commands._spelled("--edge-ratio") == "edge_ratio" and commands._spelled("--with") == "with_"
